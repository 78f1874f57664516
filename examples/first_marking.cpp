// SPDX-License-Identifier: Apache-2.0
// Does in C++17 what first_marking.c does in C, with the same output. Handles destroy themselves, and errors are exceptions.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <riis/riis.hpp>
#include <vector>

static void print_node(const double *node, double distance) {
  std::printf("(%6.3f, %6.3f, %6.3f) at %8.6f cm\n", node[0], node[1], node[2], distance);
}

int main() try {
  constexpr int n = 27, n_nodes = n * n * n;
  std::vector<double> nodes(3 * n_nodes);  // a cube of 3.25 cm around the origin, a node every 1.25 mm
  double *const xyz = nodes.data();
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -1.625 + 0.125 * (i % n);
    xyz[3 * i + 1] = -1.625 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -1.625 + 0.125 * (i / (n * n));
  }

  riis::Valve valve;
  riis::Surface surface;
  riis::Mesh mesh;
  riis::Marks marks;
  riis::check(riis_valve_create("coapting", valve.out()));
  // Half thickness 0.1 cm, tolerance 5 % of the half thickness.
  riis::check(riis_surface_create(valve, nullptr, surface.out()));
  riis::check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, mesh.out()));
  riis::check(riis_marks_create(marks.out()));
  riis::check(riis_mark_nodes(surface, mesh, nullptr, marks));  // repeated in every time step
  const auto marked = riis::get<riis_mark_list>(riis_marks_get_list, marks, RIIS_LIST_MARKED);

  std::printf("%d nodes, marked: %lld, the first of them:\n", n_nodes, static_cast<long long>(marked.n_nodes));
  std::int64_t closest = 0;
  for (std::int64_t i = 0; i < marked.n_nodes; ++i) {
    if (i < 5) print_node(xyz + 3 * marked.node_id[i], marked.distance[i]);
    if (marked.distance[i] < marked.distance[closest]) closest = i;
  }
  std::printf("and the closest:\n");
  if (marked.n_nodes > 0) print_node(xyz + 3 * marked.node_id[closest], marked.distance[closest]);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
