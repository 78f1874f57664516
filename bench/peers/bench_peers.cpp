// SPDX-License-Identifier: Apache-2.0
// ./run bench peers: compares the library with other programs (CGAL, VTK, OpenVDB) on the same nodes and triangles, on one
// thread. The marks of all programs are compared with the marks of a loop over all triangles. Then the programs are timed in
// turns. A bar is the required ratio of two times. The bars for queries without a limit compare queries over leaves with queries
// node by node, with FCPW and with CGAL. Fails if the library or CGAL marks other nodes than the loop. Also fails if queries over
// leaves give other bits than queries node by node.
//   argv[1]  a file for the results as JSON
//   argv[2]  thousands of nodes; default 100
//   argv[3]  a folder for nodes, triangles and distances as raw binary numbers, for peers.py
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "shared/contest.hpp"
#include "shared/cylinder.hpp"
#include "shared/middles.hpp"
#include "shared/references.hpp"
#if defined(RIIS_WITH_CGAL)
#include "shared/cgal_reference.hpp"
#endif
#if defined(RIIS_WITH_FCPW) || defined(RIIS_WITH_OPENVDB)
#include "peer_references.hpp"
#endif
#if defined(RIIS_WITH_VTK)
#include "shared/vtk_reference.hpp"
#endif

namespace {

using namespace bench;
using nlohmann::json;

constexpr double half_thickness = 0.1;
constexpr int n_turns = 10, n_slow_turns = 5;
constexpr double fine = 0.0034;  // the tolerance of the fine triangles of ./run bench marking
// The width of the box around the points, in widths of the cylinder. In this wide box, leaves are larger than the valve.
constexpr double wide = 40;
constexpr double infinity = std::numeric_limits<double>::infinity();

// In the rows named "node by node", Embree answers one query for each point, without leaves and groups.
constexpr RatioBar distance_bars[] = {
    {"every distance of a prepared mesh: node by node / leaves", "riis, every distance, node by node",
     "riis, every distance of a prepared mesh", Wanted::at_least, 8},
    {"from raw coordinates: node by node / leaves", "riis, every distance, node by node", "riis, every distance",
     Wanted::at_least, 5},
    {"raw coordinates / a prepared mesh", "riis, every distance", "riis, every distance of a prepared mesh",
     Wanted::at_most, 1.15},
    {"fine triangles, a prepared mesh: node by node / leaves", "riis, fine triangles, node by node",
     "riis, fine triangles, a prepared mesh", Wanted::at_least, 5.5},
    {"fine / coarse triangles, a prepared mesh", "riis, fine triangles, a prepared mesh",
     "riis, every distance of a prepared mesh", Wanted::at_most, 2.9},
    {"all fields: node by node / leaves", "riis, all fields, node by node", "riis, all fields", Wanted::at_least, 5},
    {"leaves larger than the valve: node by node / leaves", "riis, large leaves, node by node", "riis, large leaves",
     Wanted::at_least, 1},
    {"FCPW, 8 wide / riis, from raw coordinates", "FCPW, 8 wide, every distance", "riis, every distance",
     Wanted::at_least, 5},
    {"CGAL's every distance / riis, from raw coordinates", "CGAL, AABB_tree, every distance", "riis, every distance",
     Wanted::at_least, 15},
};

// Holds arrays for every field of closest points.
struct Fields {
  std::vector<double> distance, point, barycentric, normal;
  std::vector<std::int64_t> triangle_id;
  std::vector<std::int32_t> leaflet_id, side;

  explicit Fields(std::size_t n)
      : distance(n), point(3 * n), barycentric(3 * n), normal(3 * n), triangle_id(n), leaflet_id(n), side(n) {}
  bool operator==(const Fields &other) const {
    return distance == other.distance && point == other.point && barycentric == other.barycentric &&
           normal == other.normal && triangle_id == other.triangle_id && leaflet_id == other.leaflet_id &&
           side == other.side;
  }
};

// Finds the closest points of `per_piece` points at a time, on one thread. If `per_piece` is small, the library queries the
// points one by one.
constexpr std::int64_t in_one_piece = std::numeric_limits<std::int64_t>::max(), node_by_node = 63;
void find_closest(const riis_surface *surface, const std::vector<double> &xyz, std::int64_t per_piece, Fields &to) {
  riis_closest_options options;
  check(riis_closest_options_init(&options, sizeof options));
  options.n_threads = 1;
  riis_closest_arrays arrays;
  check(riis_closest_arrays_init(&arrays, sizeof arrays));
  const auto n = static_cast<std::int64_t>(to.distance.size());
  for (std::int64_t begin = 0; begin < n; begin += std::min(per_piece, n)) {
    const riis_points points = points_of(std::min(per_piece, n - begin), xyz.data() + 3 * begin);
    arrays.distance = to.distance.data() + begin;
    arrays.point = to.point.data() + 3 * begin;
    arrays.barycentric = to.barycentric.data() + 3 * begin;
    arrays.normal = to.normal.data() + 3 * begin;
    arrays.triangle_id = to.triangle_id.data() + begin;
    arrays.leaflet_id = to.leaflet_id.data() + begin;
    arrays.side = to.side.data() + begin;
    check(riis_closest_points(surface, &points, &options, &arrays));
  }
}

// Adds two contenders that compute all fields at the given points. One contender works over leaves, and the other node by node.
// Returns whether both give the same bits.
bool add_closest(Contest &contest, const std::string &name, const riis_surface *surface,
                 const std::vector<double> &xyz) {
  const std::size_t n = xyz.size() / 3;
  const auto leaves = std::make_shared<Fields>(n), one_by_one = std::make_shared<Fields>(n);
  find_closest(surface, xyz, in_one_piece, *leaves);
  find_closest(surface, xyz, node_by_node, *one_by_one);
  contest.add(name, n_slow_turns, [=, &xyz] { find_closest(surface, xyz, in_one_piece, *leaves); });
  contest.add(name + ", node by node", n_slow_turns,
              [=, &xyz] { find_closest(surface, xyz, node_by_node, *one_by_one); });
  if (!(*leaves == *one_by_one)) std::fprintf(stderr, "%s: other bits than node by node\n", name.c_str());
  return *leaves == *one_by_one;
}

// The reference for all peers is a loop over all triangles.
struct Truth {
  std::vector<double> distance;
  std::vector<bool> nearest_is_thin;  // whether the nearest triangle's height is below 1e-6 of its longest edge
};

// Tells whether a peer measures distances to the triangles, or to an approximation of the triangles.
enum class Measures { triangles, approximately };

// Compares a peer's distances with the truth. Counts the nodes whose marks differ, separately for each reason.
json compared(const Truth &truth, const std::vector<double> &distance, Measures measures = Measures::triangles) {
  // The errors, in cm, from rounding coordinates of a few centimetres to double and to single precision.
  constexpr double rounding = 1e-12, single = 2e-6;
  std::map<std::string, std::int64_t> reasons;
  std::int64_t n_marked = 0, n_different = 0;
  double largest = 0, largest_anywhere = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (std::isfinite(distance[i]))
      largest_anywhere = std::max(largest_anywhere, std::abs(distance[i] - truth.distance[i]));
    const bool by_peer = distance[i] <= half_thickness, is_marked = truth.distance[i] <= half_thickness;
    n_marked += by_peer;
    if ((by_peer || is_marked) && std::isfinite(distance[i]))
      largest = std::max(largest, std::abs(distance[i] - truth.distance[i]));
    if (by_peer == is_marked) continue;
    ++n_different;
    const double margin = std::abs(truth.distance[i] - half_thickness);
    const char *reason = measures == Measures::approximately    ? "approximation"
                         : margin <= rounding                   ? "rounding"
                         : margin <= single                     ? "float"
                         : truth.nearest_is_thin[i]             ? "degenerate"
                         : is_marked && distance[i] == infinity ? "radius"
                                                                : "unexplained";
    ++reasons[reason];
  }
  return {{"marked", n_marked},
          {"different", n_different},
          {"reasons", reasons},
          {"largest_difference", largest},
          {"largest_anywhere", largest_anywhere}};
}

bool is_equal(const json &comparison) {
  const json &reasons = comparison["reasons"];
  const std::int64_t n_rounding = reasons.value("rounding", std::int64_t{0});
  return comparison["different"] == n_rounding && comparison["largest_difference"] <= 1e-12;
}

// Computes the truth by the loop over triangles, on all processors.
Truth truth_of(const riis_surface *surface, const Triangles &triangles, const CylinderNodes &nodes) {
  const std::int64_t n = nodes.n_nodes();
  Truth truth;
  truth.distance.resize(static_cast<std::size_t>(n));
  const EveryTriangle every_triangle(triangles);
  const int n_threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
#pragma omp parallel for num_threads(n_threads) schedule(static)
  for (std::int64_t i = 0; i < n; ++i)
    truth.distance[static_cast<std::size_t>(i)] =
        every_triangle(nodes.xyz().data() + 3 * i, std::numeric_limits<double>::infinity());
  // The library gives the nearest triangle, and the comparison measures the distance to this triangle.
  std::vector<std::int64_t> nearest(static_cast<std::size_t>(n));
  riis_closest_arrays arrays;
  check(riis_closest_arrays_init(&arrays, sizeof arrays));
  arrays.triangle_id = nearest.data();
  const riis_points points = points_of(n, nodes.xyz().data());
  check(riis_closest_points(surface, &points, nullptr, &arrays));
  for (const std::int64_t id : nearest) {
    const double *c = triangles.corners.data() + 9 * id;
    double longest = 0, ab[3], ac[3];
    for (int k = 0; k < 3; ++k) ab[k] = c[3 + k] - c[k], ac[k] = c[6 + k] - c[k];
    for (int side = 0; side < 3; ++side) {
      const double *p = c + 3 * side, *q = c + 3 * ((side + 1) % 3);
      longest = std::max(longest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    const double twice_area =
        std::hypot(ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]);
    truth.nearest_is_thin.push_back(twice_area < 1e-6 * longest * longest);
  }
  return truth;
}

template <class Number>
void write(const std::string &path, const std::vector<Number> &numbers) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char *>(numbers.data()),
             static_cast<std::streamsize>(numbers.size() * sizeof(Number)));
  if (!file) {
    std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
    std::exit(1);
  }
}

// Writes nodes (3, n), distances (n) and vertices (3, n) as float64, and triangles (3, n) as int64.
void write_all(const std::string &prefix, const riis_surface *surface, const CylinderNodes &nodes, const Truth &truth) {
  const riis_triangles triangles = triangles_of(surface);
  const double *xyz = triangles.xyz;
  const std::int64_t *vertex_id = triangles.vertex_id;
  write(prefix + "nodes.f64", nodes.xyz());
  write(prefix + "distances.f64", truth.distance);
  write(prefix + "vertices.f64", std::vector<double>(xyz, xyz + 3 * triangles.n_vertices));
  write(prefix + "triangles.i64", std::vector<std::int64_t>(vertex_id, vertex_id + 3 * triangles.n_triangles));
}

// Returns the distances of marked nodes, and infinity for the other nodes.
std::vector<double> marked_distances(const riis_marks *result, std::int64_t n_nodes) {
  std::vector<double> distance(static_cast<std::size_t>(n_nodes));
  get_distances(result, infinity, distance);
  return distance;
}

// A tolerance of 0 means the default.
Surface made_surface(const char *kind, double tolerance) {
  const Valve valve = make_valve(kind);
  if (kind[0] == 'm') check(riis_valve_set_scalar(valve.get(), "opening", 0.5));
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  if (tolerance > 0) options.tolerance = tolerance;
  return make_surface(valve.get(), &options);
}

// Returns false if the library or CGAL marks other nodes than the loop.
bool compare(const char *kind, const Cylinder &cylinder, std::int64_t about_n_nodes, const std::string &folder,
             json &out) {
  const Surface made = made_surface(kind, 0);
  const riis_surface *surface = made.get();
  const CylinderNodes nodes(cylinder, about_n_nodes);
  const std::int64_t n = nodes.n_nodes();
  const double *xyz = nodes.xyz().data();
  const Mesh mesh = mesh_over(nodes);
  check(riis_mesh_prepare(mesh.get(), 1));
  const Triangles triangles(surface);
  const Truth truth = truth_of(surface, triangles, nodes);
  if (!folder.empty()) write_all(folder + "/" + kind + "_", surface, nodes, truth);

  Contest contest;
  json marks;
  bool is_right = true;
  std::vector<double> distance(static_cast<std::size_t>(n));
  const Result result = make_result();
  for (const auto &[name, search] : {std::pair{"riis, clusters", RIIS_SEARCH_CLUSTERS},
                                     std::pair{"riis, exhaustive search", RIIS_SEARCH_EXHAUSTIVE}}) {
    riis_mark_options options;
    check(riis_mark_options_init(&options, sizeof options));
    options.search = search;
    options.n_threads = 1;
    const auto mark = [&, options] { check(riis_mark_nodes(surface, mesh.get(), &options, result.get())); };
    mark();
    marks[name] = compared(truth, marked_distances(result.get(), n));
    is_right = is_right && is_equal(marks[name]);
    contest.add(name, n_turns, mark);
  }
  const auto all_distances = [&] {
    riis_closest_options options;
    check(riis_closest_options_init(&options, sizeof options));
    options.n_threads = 1;
    riis_closest_arrays arrays;
    check(riis_closest_arrays_init(&arrays, sizeof arrays));
    arrays.distance = distance.data();
    const riis_points points = points_of(n, nodes.xyz().data());
    check(riis_closest_points(surface, &points, &options, &arrays));
  };
  const auto add = [&](const std::string &name, int turns, const Contest::Work &work,
                       Measures measures = Measures::triangles) {
    work();
    marks[name] = compared(truth, distance, measures);
    contest.add(name, turns, work);
  };
  const auto add_right = [&](const std::string &name, int turns, const Contest::Work &work) {
    add(name, turns, work);
    is_right = is_right && is_equal(marks[name]) && marks[name]["largest_anywhere"] <= 1e-12;
  };
  add_right("riis, every distance", n_slow_turns, all_distances);
  // Measures the time of a marking with a limit that includes every node. The marking runs once over the clusters of a prepared
  // mesh, and once node by node with Embree.
  const auto marking = [&](const riis_surface *of, std::int32_t search) {
    riis_mark_options options;
    check(riis_mark_options_init(&options, sizeof options));
    options.distance_limit = 1e60;
    options.search = search;
    options.n_threads = 1;
    return [&, of, options] { check(riis_mark_nodes(of, mesh.get(), &options, result.get())); };
  };
  for (const auto &[name, search] : {std::pair{"riis, every distance of a prepared mesh", RIIS_SEARCH_CLUSTERS},
                                     std::pair{"riis, every distance, node by node", RIIS_SEARCH_EXHAUSTIVE}}) {
    const auto mark = marking(surface, search);
    mark();
    get_distances(result.get(), infinity, distance);
    add_right(name, n_slow_turns, mark);
  }
  const Surface fine_surface = made_surface(kind, fine);
  for (const auto &[name, search] : {std::pair{"riis, fine triangles, a prepared mesh", RIIS_SEARCH_CLUSTERS},
                                     std::pair{"riis, fine triangles, node by node", RIIS_SEARCH_EXHAUSTIVE}})
    contest.add(name, n_slow_turns, marking(fine_surface.get(), search));
  std::vector<double> far_apart = nodes.xyz();
  for (double &coordinate : far_apart) coordinate *= wide;
  is_right = add_closest(contest, "riis, all fields", surface, nodes.xyz()) && is_right;
  is_right = add_closest(contest, "riis, large leaves", surface, far_apart) && is_right;
  json making_ms = json::object();
#if defined(RIIS_WITH_CGAL)
  const auto start = std::chrono::steady_clock::now();
  const CgalQuery cgal(triangles);
  const std::chrono::duration<double, std::milli> making = std::chrono::steady_clock::now() - start;
  making_ms["CGAL, AABB_tree bounded"] = making_ms["CGAL, AABB_tree, every distance"] = making.count();
  add("CGAL, AABB_tree, every distance", n_slow_turns, [&] { cgal.distances(n, xyz, infinity, 1, distance.data()); });
  add("CGAL, AABB_tree bounded", n_turns, [&] { cgal.distances(n, xyz, half_thickness, 1, distance.data()); });
  is_right = is_right && is_equal(marks["CGAL, AABB_tree bounded"]);
#else
  for (const char *name : {"CGAL, AABB_tree bounded", "CGAL, AABB_tree, every distance"})
    contest.leave_out(name, "CGAL was not found when this was built");
#endif
#if defined(RIIS_WITH_FCPW)
  const auto fcpw_start = std::chrono::steady_clock::now();
  const FcpwQuery fcpw(triangles);
  const std::chrono::duration<double, std::milli> fcpw_making = std::chrono::steady_clock::now() - fcpw_start;
  making_ms["FCPW, 8 wide, every distance"] = fcpw_making.count();
  add("FCPW, 8 wide, every distance", n_slow_turns, [&] { fcpw.distances(n, xyz, distance.data()); });
#else
  contest.leave_out("FCPW, 8 wide, every distance", "RIIS_FCPW_DIR was not given when this was built");
#endif
  const std::vector<double> middles = middles_of(triangles);
  add(
      "loop over middles of triangles", n_slow_turns, [&] { distances_to_middles(middles, n, xyz, distance.data()); },
      Measures::approximately);
#if defined(RIIS_WITH_OPENVDB)
  // Sizes of OpenVDB's voxels: 4 and 8 per half thickness.
  constexpr std::pair<const char *, double> voxels[] = {{"0.025", 0.025}, {"0.0125", 0.0125}};
  std::vector<std::unique_ptr<OpenVdbBand>> bands;
  for (const auto &[text, voxel] : voxels) {
    OpenVdbBand &band = *bands.emplace_back(std::make_unique<OpenVdbBand>(triangles, voxel, half_thickness));
    const auto sample = [&] { band.distances(n, xyz, distance.data()); };
    add(
        std::string("OpenVDB, band of voxels of ") + text + ", made and sampled", n_slow_turns,
        [&band, sample] {
          band.make();
          sample();
        },
        Measures::approximately);
    add(std::string("OpenVDB, band of voxels of ") + text + ", sampled", n_slow_turns, sample, Measures::approximately);
  }
#else
  contest.leave_out("OpenVDB, band of voxels", "OpenVDB was not found when this was built");
#endif
#if defined(RIIS_WITH_VTK)
  const VtkPoints points(middles);
  add(
      "VTK, vtkStaticPointLocator of middles within a radius", n_slow_turns,
      [&] { points.distances(n, xyz, half_thickness, distance.data()); }, Measures::approximately);
  const VtkLocator locator(triangles);
  add("VTK, vtkStaticCellLocator within a radius", n_slow_turns,
      [&] { locator.distances(n, xyz, half_thickness, distance.data()); });
  const VtkDistance vtk_distance(triangles);
  add("VTK, vtkImplicitPolyDataDistance", n_slow_turns, [&] { vtk_distance.distances(n, xyz, distance.data()); });
#else
  for (const char *name : {"VTK, vtkStaticPointLocator of middles within a radius",
                           "VTK, vtkStaticCellLocator within a radius", "VTK, vtkImplicitPolyDataDistance"})
    contest.leave_out(name, "built without VTK");
#endif
  contest.run();
  std::int64_t n_marked = 0;
  for (const double d : truth.distance) n_marked += d <= half_thickness;
  std::printf("%s valve: %lld triangles, %lld nodes, %lld marked\n", kind, static_cast<long long>(triangles.n()),
              static_cast<long long>(n), static_cast<long long>(n_marked));
  contest.print();
  Bars bars;
  for (const RatioBar &bar : distance_bars) bars.add(contest, bar);
  std::printf("\n");
  bars.print();
  std::printf("\n%s\n\n", marks.dump(2).c_str());
  out[kind] = {
      {"nodes", n},         {"triangles", triangles.n()}, {"marked", n_marked},      {"half_thickness", half_thickness},
      {"marks", marks},     {"made", making_ms},          {"times", contest.json()}, {"left_out", contest.left_out()},
      {"bars", bars.json()}};
  return is_right;
}

}  // namespace

int main(int argc, char **argv) {
  const std::int64_t about_n_nodes = 1000 * (argc > 2 ? std::strtoll(argv[2], nullptr, 10) : 100);
  if (argc < 2 || about_n_nodes < 1000) {
    std::fprintf(stderr, "usage: %s FILE.json [THOUSANDS_OF_NODES [FOLDER]]\n", argv[0]);
    return 2;
  }
  const std::string folder = argc > 3 ? argv[3] : "";
  json out;
  bool is_right = compare("aortic", cylinders[0], about_n_nodes, folder, out);
  is_right = compare("mitral", cylinders[1], about_n_nodes, folder, out) && is_right;
  std::ofstream file(argv[1]);
  file << out.dump(2) << '\n';
  if (!file) {
    std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
    return 1;
  }
  if (!is_right) std::fprintf(stderr, "%s: riis or CGAL gives other results than the loop or the queries\n", argv[0]);
  return is_right ? 0 : 1;
}
