// SPDX-License-Identifier: Apache-2.0
// ./run bench leaks measures how fine a mesh must be, for the tables of docs/meshes.md:
//   the edges that leak through a closed valve, by the longest edge
//   the part of the aortic valve's cross-section that its triangles leave open
//   the cost of riis_find_leaks, riis_label_open_regions and riis_find_passage, compared with a marking
// argv[1], optional: thousands of nodes for the last item. Random positions come from printed seeds.
#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "shared/cylinder.hpp"
#include "shared/shortest.hpp"

namespace {

using namespace bench;
using Point = std::array<double, 3>;

constexpr double half_thickness = 0.1;
constexpr int n_seeds = 5;

Surface surface_of(const char *kind, double opening) {
  const Valve valve = make_valve(kind);
  check(riis_valve_set_scalar(valve.get(), "opening", opening));
  return make_surface(valve.get());
}

riis_surface_info info_of(const Surface &surface) {
  riis_surface_info info;
  check(riis_surface_get_info(surface.get(), &info, sizeof info));
  return info;
}

// Returns a surface that has the triangles of the given surface, and another half thickness.
Surface with_half_thickness(const Surface &surface, double thickness) {
  riis_surface_arrays arrays;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  const riis_triangles triangles = triangles_of(surface.get());
  arrays.n_vertices = triangles.n_vertices;
  arrays.x = triangles.xyz, arrays.y = triangles.xyz + 1, arrays.z = triangles.xyz + 2;
  arrays.stride = 3;
  arrays.n_faces = triangles.n_triangles;
  arrays.vertex_ids = triangles.vertex_id;
  arrays.id_bits = 64;
  return make_surface(arrays, thickness);
}

// Nodes lie at the corners and in the middles of small cubes, which fill a large cube. The large cube is turned and shifted at
// random, and cut into equal tetrahedra. Some edges of the tetrahedra are edges of the small cubes. All other edges lead from a
// middle to the eight corners around it, and are 0.87 times as long.
struct Crystal {
  std::vector<double> xyz;
  std::vector<std::int64_t> offsets{0}, columns;
  std::int64_t n = 0;
};

std::array<Point, 3> random_rotation(std::mt19937_64 &random) {
  std::normal_distribution<double> normal;
  double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  w /= length, x /= length, y /= length, z /= length;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

Crystal crystal_round(const riis_surface_info &info, double edge, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::array<Point, 3> rotation = random_rotation(random);
  std::uniform_real_distribution<double> share(0, 1);
  double reach = 0;  // radius of a ball around the surface
  Point middle, shift;
  for (std::size_t i = 0; i < 3; ++i) {
    middle[i] = 0.5 * (info.lower[i] + info.upper[i]);
    reach += std::pow(info.upper[i] - middle[i], 2);
    shift[i] = share(random);
  }
  const auto half = static_cast<std::int64_t>(std::sqrt(reach) / edge) + 3;
  const std::int64_t side = 2 * half + 1, n_corners = side * side * side;
  Crystal made;
  made.n = 2 * n_corners;  // corners, then middles
  for (std::int64_t i = 0; i < made.n; ++i) {
    const bool is_middle = i >= n_corners;
    const std::int64_t k = i % n_corners, at[3] = {k % side, k / side % side, k / side / side};
    Point q;
    for (std::size_t c = 0; c < 3; ++c)
      q[c] = edge * (static_cast<double>(at[c] - half) + shift[c] + (is_middle ? 0.5 : 0));
    for (std::size_t c = 0; c < 3; ++c)
      made.xyz.push_back(middle[c] + rotation[c][0] * q[0] + rotation[c][1] * q[1] + rotation[c][2] * q[2]);
    const auto join = [&](std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t first) {
      if (x >= 0 && y >= 0 && z >= 0 && x < side && y < side && z < side)
        made.columns.push_back(first + x + side * (y + side * z));
    };
    for (int step : {-1, 1}) {
      join(at[0] + step, at[1], at[2], is_middle ? n_corners : 0);
      join(at[0], at[1] + step, at[2], is_middle ? n_corners : 0);
      join(at[0], at[1], at[2] + step, is_middle ? n_corners : 0);
    }
    for (int corner = 0; corner < 8; ++corner) {
      const int to = is_middle ? 0 : -1;
      join(at[0] + to + corner % 2, at[1] + to + corner / 2 % 2, at[2] + to + corner / 4, is_middle ? 0 : n_corners);
    }
    made.offsets.push_back(static_cast<std::int64_t>(made.columns.size()));
  }
  return made;
}

Mesh mesh_over(const Crystal &crystal) {
  riis_mesh *mesh = nullptr;
  const double *xyz = crystal.xyz.data();
  check(riis_mesh_create(crystal.n, xyz, xyz + 1, xyz + 2, 3, &mesh));
  riis_csr rows;
  check(riis_csr_init(&rows, sizeof rows));
  rows.n_rows = crystal.n;
  rows.offsets = crystal.offsets.data();
  rows.columns = crystal.columns.data();
  rows.offset_bits = rows.column_bits = 64;
  check(riis_mesh_set_adjacency(mesh, &rows));
  return Mesh(mesh);
}

// Returns the numbers of leaks. The arrays of the list are NULL, because the function destroys the leaks before it returns.
riis_leak_list leaks_of(const Surface &surface, const Mesh &mesh) {
  const Result result = make_result();
  const Leaks leaks = make_leaks();
  riis_leak_list list;
  check(riis_mark_nodes(surface.get(), mesh.get(), nullptr, result.get()));
  check(riis_find_leaks(surface.get(), mesh.get(), result.get(), nullptr, leaks.get()));
  check(riis_leaks_get_list(leaks.get(), &list, sizeof list));
  list.node_id = nullptr, list.length = list.distance = nullptr;
  return list;
}

void print_leaks(const char *kind) {
  const Surface surface = surface_of(kind, 0), thin = with_half_thickness(surface, 1e-9);
  const riis_surface_info info = info_of(surface);
  for (const double ratio : {0.8, 1.0, 1.05, 1.1, 1.2, 1.3, 1.5, 2.0, 3.0}) {
    std::int64_t n_crossing = 0, n_leaking = 0;
    double closing = 0;
    for (std::uint64_t seed = 1; seed <= n_seeds; ++seed) {
      const Crystal crystal = crystal_round(info, 2 * half_thickness * ratio, seed);
      const Mesh mesh = mesh_over(crystal);
      const riis_leak_list leaks = leaks_of(surface, mesh);
      n_crossing += leaks_of(thin, mesh).n_edges;
      n_leaking += leaks.n_edges;
      closing = std::max(closing, leaks.half_thickness);
    }
    std::printf("| %s | %.2f | %lld | %lld | %.3g %% | %s |\n", kind, 2 * ratio, static_cast<long long>(n_crossing),
                static_cast<long long>(n_leaking),
                100 * static_cast<double>(n_leaking) / static_cast<double>(n_crossing),
                n_leaking ? (std::to_string(closing / half_thickness).substr(0, 4)).c_str() : "-");
  }
}

// Returns the fraction of a disc around the axis that no triangle covers, seen along the axis. The fraction is counted on the
// points of a square grid.
double open_share(const Surface &surface, double radius, int n_per_radius) {
  const int side = 2 * n_per_radius + 1;
  const auto place = [&](int i) { return radius * (i - n_per_radius) / n_per_radius; };
  std::vector<char> is_covered(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const riis_triangles triangles = triangles_of(surface.get());
  const double *xyz = triangles.xyz;
  const std::int64_t *ids = triangles.vertex_id;
  for (std::int64_t t = 0; t < triangles.n_triangles; ++t) {
    const double *a = xyz + 3 * ids[3 * t], *b = xyz + 3 * ids[3 * t + 1], *c = xyz + 3 * ids[3 * t + 2];
    const auto to_grid = [&](double x) { return x / radius * n_per_radius + n_per_radius; };
    const auto from = [&](int k) {
      return std::max(0, static_cast<int>(std::floor(to_grid(std::min({a[k], b[k], c[k]})))));
    };
    const auto to = [&](int k) {
      return std::min(side - 1, static_cast<int>(std::ceil(to_grid(std::max({a[k], b[k], c[k]})))));
    };
    const auto turn = [](const double *p, const double *q, double x, double y) {
      return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    };
    for (int j = from(1); j <= to(1); ++j)
      for (int i = from(0); i <= to(0); ++i) {
        const double u = turn(a, b, place(i), place(j)), v = turn(b, c, place(i), place(j)),
                     w = turn(c, a, place(i), place(j));
        if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))
          is_covered[static_cast<std::size_t>(i) + static_cast<std::size_t>(side) * static_cast<std::size_t>(j)] = 1;
      }
  }
  std::int64_t n_disc = 0, n_open = 0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      if (std::hypot(place(i), place(j)) > radius) continue;
      ++n_disc;
      n_open += !is_covered[static_cast<std::size_t>(i) + static_cast<std::size_t>(side) * static_cast<std::size_t>(j)];
    }
  return static_cast<double>(n_open) / static_cast<double>(n_disc);
}

// Prints times in milliseconds: of a marking by clusters, of a first search for leaks, and of a second search with known edges.
// Also prints the times to label regions, and to find the passage from the first node to the last node.
void print_cost(double thickness, const CylinderMesh &nodes) {
  const Surface surface = with_half_thickness(surface_of("aortic", 0), thickness);
  const double *xyz = nodes.xyz().data();
  riis_mesh *handle = nullptr;
  check(riis_mesh_create(nodes.n_nodes(), xyz, xyz + 1, xyz + 2, 3, &handle));
  const Mesh mesh(handle);
  const riis_csr rows = nodes.rows();
  const Result result = make_result();
  riis_mark_options options;
  check(riis_mark_options_init(&options, sizeof options));
  options.n_threads = 1;
  check(riis_mesh_prepare(mesh.get(), 1));
  const double marking =
      1e3 * shortest([&] { check(riis_mark_nodes(surface.get(), mesh.get(), &options, result.get())); });
  const Leaks leaks = make_leaks();
  const auto find = [&] { check(riis_find_leaks(surface.get(), mesh.get(), result.get(), &options, leaks.get())); };
  const double first = 1e3 * shortest(find, [&] { check(riis_mesh_set_adjacency(mesh.get(), &rows)); });
  std::vector<std::int64_t> label(static_cast<std::size_t>(nodes.n_nodes()));
  const double labelling =
      1e3 * shortest([&] {
        check(riis_label_open_regions(mesh.get(), result.get(), &options, nodes.n_nodes(), label.data(), nullptr));
      });
  const std::int64_t from = 0, to = nodes.n_nodes() - 1;
  riis_passage_ends ends;
  check(riis_passage_ends_init(&ends, sizeof ends));
  ends.n_from = ends.n_to = 1;
  ends.from = &from, ends.to = &to;
  riis_passage passage;
  const double passing =
      1e3 *
      shortest([&] { check(riis_find_passage(surface.get(), mesh.get(), &ends, &options, &passage, sizeof passage)); });
  riis_leak_list list;
  check(riis_leaks_get_list(leaks.get(), &list, sizeof list));
  std::printf("| %g | %lld | %.2f | %.1f | %.3f | %.1f | %.1f |\n", thickness, static_cast<long long>(list.n_edges),
              marking, first, 1e3 * shortest(find), labelling, passing);
}

}  // namespace

int main(int argc, char **argv) {
  const std::int64_t about_n_nodes = n_nodes_given(argc, argv, 1, 1);
  std::printf(
      "Closed valves, seeds 1 to %d:\n\n| valve | longest edge / half thickness | edges across | of these leak | share "
      "| closed by, half thicknesses |\n|---|---|---|---|---|---|\n",
      n_seeds);
  print_leaks("mitral");
  print_leaks("aortic");
  std::printf(
      "\nAortic valve at opening 0: how much of a disc stays open, seen along the axis\n\n"
      "| radius of the disc | stays open |\n|---|---|\n");
  const Surface aortic = surface_of("aortic", 0);
  for (const double radius : {0.6, 0.9, 1.2})
    std::printf("| %.1f | %.1f %% |\n", radius, 100 * open_share(aortic, radius, 1200));
  std::printf(
      "\nAortic valve, about %lld nodes, 1 thread, milliseconds:\n\n| half thickness | edges that leak | marking | "
      "first "
      "riis_find_leaks | later ones | riis_label_open_regions | riis_find_passage |\n|---|---|---|---|---|---|---|\n",
      static_cast<long long>(about_n_nodes));
  const CylinderMesh nodes(cylinders[0], about_n_nodes);
  for (const double thickness : {0.1, 0.01}) print_cost(thickness, nodes);
  return 0;
}
