// SPDX-License-Identifier: Apache-2.0
// Prints in C++17 what marks.c prints.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <riis/riis.hpp>
#include <vector>

int main() try {
  constexpr int n = 41, n_nodes = n * n * n;
  std::vector<double> nodes(3 * n_nodes);
  double *const xyz = nodes.data();
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -2.5 + 0.125 * (i % n);
    xyz[3 * i + 1] = -2.5 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -2.5 + 0.125 * (i / (n * n));
  }
  riis::Valve valve;
  riis::Surface surface;
  riis::Mesh mesh;
  riis::Marks marks;
  riis::check(riis_valve_create("mitral", valve.out()));
  riis::check(riis_valve_set_scalar(valve, "opening", 0.5));
  riis::check(riis_surface_create(valve, nullptr, surface.out()));
  riis::check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, mesh.out()));
  riis::check(riis_marks_create(marks.out()));
  riis::check(riis_mark_nodes(surface, mesh, nullptr, marks));
  const auto marked = riis::get<riis_mark_list>(riis_marks_get_list, marks, RIIS_LIST_MARKED);
  for (std::int64_t i = 0; i < marked.n_nodes; ++i) {
    std::uint64_t bits;
    std::memcpy(&bits, &marked.distance[i], sizeof bits);
    std::printf("%lld %016llX\n", static_cast<long long>(marked.node_id[i]), static_cast<unsigned long long>(bits));
  }
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
