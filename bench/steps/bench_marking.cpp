// SPDX-License-Identifier: Apache-2.0
// ./run bench marking: measures in one run the times of a time step, of making an adjacency, and of their competitors. A step
// makes the surface and the scene of a valve that moved, and marks nodes. The step then reads the list of marked nodes with
// distances and triangles (time_steps.hpp). The program prints the times and the bars, which are required ratios of two times.
// The program fails if a competitor marks other nodes or makes other rows.
//   argv[1]  a file for the times and bars as JSON, optional
//   argv[2]  the number of nodes in thousands, 1000 by default
#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "compare_adjacencies.hpp"
#include "shared/contest.hpp"
#include "shared/cylinder.hpp"
#include "shared/memory.hpp"
#include "shared/references.hpp"
#include "shared/time_steps.hpp"
#if defined(RIIS_WITH_CGAL)
#include "shared/cgal_reference.hpp"
#endif

namespace {

using namespace bench;

constexpr double half_thickness = 0.1;
constexpr double coarse = 0.056, fine = 0.0034;  // tolerances for about 2,500 and 36,000 triangles
constexpr int n_turns = 40, n_slow_turns = 20;

const RatioBar ratio_bars[] = {
    {"the paper's search with every triangle / step, 1 thread", "the paper's search, every triangle, 1 thread",
     "step, 1 thread", Wanted::at_least, 200},
    {"the paper's search with every triangle / step, 2 threads", "the paper's search, every triangle, 2 threads",
     "step, 2 threads", Wanted::at_least, 200},
    {"the paper's search with point queries / step, 1 thread", "the paper's search, point queries, 1 thread",
     "step, 1 thread", Wanted::at_least, 8},
    {"CGAL's fastest query of every node / step, 1 thread", "CGAL, every node, 1 thread", "step, 1 thread",
     Wanted::at_least, 17},
    {"CGAL's fastest query of every node / step, 2 threads", "CGAL, every node, 2 threads", "step, 2 threads",
     Wanted::at_least, 17},
    {"step / pass over the coordinates, 2 threads", "step, 2 threads", "coordinates, 2 threads", Wanted::at_most, 6},
    {"step with 1 thread / with 2", "step, 1 thread", "step, 2 threads", Wanted::at_least, 1.8},
    {"step with 4 threads / with 2", "step, 4 threads", "step, 2 threads", Wanted::at_most, 1.3},
    {"fine / coarse triangles", "step, 2 threads, fine triangles", "step, 2 threads", Wanted::at_most, 2.9},
    {"fine / coarse triangles, fixed triangulation", "step, 2 threads, fine triangles, fixed", "step, 2 threads, fixed",
     Wanted::at_most, 2.5},
    {"d_min 0.3 / d_min 0.1", "step, 2 threads, d_min 0.3", "step, 2 threads", Wanted::at_most, 5},
    {"10 times the nodes, 2 threads", "step, 2 threads, 10 times the nodes", "step, 2 threads, the nodes",
     Wanted::at_most, 10},
    {"preparing the mesh / step, 2 threads", "prepare the mesh, 2 threads", "step, 2 threads", Wanted::at_most, 18},
    {"AVX2 / AVX-512", "step, 1 thread, AVX2", "step, 1 thread", Wanted::at_most, 1.8},
    {"baseline / AVX-512", "step, 1 thread, baseline", "step, 1 thread", Wanted::at_most, 3.5},
    {"grid by its axes / as points", "step, 1 thread, grid by its axes", "step, 1 thread, grid as points",
     Wanted::at_most, 1.05},
    {"first marking / exhaustive search", "first marking, 2 threads", "exhaustive search, 2 threads", Wanted::at_most,
     1.1},
};

StepOptions step_options(int n_threads, std::int32_t instructions = RIIS_INSTRUCTIONS_AUTO) {
  StepOptions options;
  options.half_thickness = half_thickness;
  options.tolerance = coarse;
  options.n_threads = n_threads;
  options.instructions = instructions;
  return options;
}

// Runs a brief loop of OpenMP, as a solver does before its step. The threads of a contender are therefore awake when its turn
// begins.
void wake_threads(int n_threads) {
  const double coordinates[3 * 64] = {};
  pass_over_coordinates(64, coordinates, n_threads);
}

void add(Contest &contest, const std::string &name, TimeSteps &steps) {
  contest.add(
      name, n_turns, [&steps] { steps.step(); },
      [&steps] {
        steps.move();
        wake_threads(steps.n_threads());
      });
}

std::string of_threads(int n_threads) { return n_threads == 1 ? ", 1 thread" : ", 2 threads"; }

#if defined(RIIS_WITH_CGAL)
// Returns whether CGAL marks the same nodes as the library. The marks may differ at nodes whose distance equals the half
// thickness up to rounding.
bool is_same(const std::vector<double> &distance, const riis_mark_list &marked) {
  constexpr double rounding = 1e-12;
  std::int64_t n_different = 0, n_unexplained = 0, next = 0;
  double largest = 0;
  for (std::int64_t node = 0; node < static_cast<std::int64_t>(distance.size()); ++node) {
    const double by_cgal = distance[static_cast<std::size_t>(node)];
    const bool is_marked = next < marked.n_nodes && marked.node_id[next] == node;
    const double by_step = is_marked ? marked.distance[next++] : by_cgal;
    if (is_marked && by_cgal <= half_thickness) largest = std::max(largest, std::abs(by_cgal - by_step));
    if (is_marked == (by_cgal <= half_thickness)) continue;
    ++n_different;
    n_unexplained += std::abs(by_step - half_thickness) > rounding;
  }
  std::printf(
      "CGAL marks %lld nodes differently, %lld of them by more than rounding; its distances differ by %.1g cm.\n",
      static_cast<long long>(n_different), static_cast<long long>(n_unexplained), largest);
  return n_unexplained == 0 && largest <= rounding;
}
#endif

// Measures the times of steps and of their competitors on one set of nodes. Returns false if a competitor marks other nodes.
bool compare_with_others(Contest &contest, Bars &bars, std::int64_t about_n_nodes, nlohmann::json &counts) {
  const CylinderMesh nodes(wide_cylinder, about_n_nodes);
  const std::int64_t n = nodes.n_nodes();
  const double *xyz = nodes.xyz().data();
  const Mesh mesh = mesh_over(nodes);
  const double before_preparing = allocated();
  check(riis_mesh_prepare(mesh.get(), 2));
  bars.add("bytes a node", (allocated() - before_preparing) / static_cast<double>(n), Wanted::at_most, 48);

  TimeSteps one(mesh.get(), step_options(1)), two(mesh.get(), step_options(2)), four(mesh.get(), step_options(4));
  add(contest, "step, 1 thread", one);
  add(contest, "step, 2 threads", two);
  StepOptions options = step_options(2);
  options.tolerance = fine;
  TimeSteps fine_two(mesh.get(), options);
  add(contest, "step, 2 threads, fine triangles", fine_two);
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  TimeSteps fine_fixed(mesh.get(), options);
  add(contest, "step, 2 threads, fine triangles, fixed", fine_fixed);
  options.tolerance = coarse;
  TimeSteps coarse_fixed(mesh.get(), options);
  add(contest, "step, 2 threads, fixed", coarse_fixed);
  options.triangulation = RIIS_TRIANGULATION_ADAPTED;
  options.half_thickness = 0.3;
  options.tolerance = coarse * half_thickness / options.half_thickness;  // so that the triangles are the same
  TimeSteps thick(mesh.get(), options);
  add(contest, "step, 2 threads, d_min 0.3", thick);
  TimeSteps avx2(mesh.get(), step_options(1, RIIS_INSTRUCTIONS_AVX2)),
      baseline(mesh.get(), step_options(1, RIIS_INSTRUCTIONS_BASELINE));
  if (TimeSteps(mesh.get(), step_options(1, RIIS_INSTRUCTIONS_AVX512)).can_mark()) {
    add(contest, "step, 1 thread, AVX2", avx2);
    add(contest, "step, 1 thread, baseline", baseline);
  } else {
    for (const char *name : {"step, 1 thread, AVX2", "step, 1 thread, baseline"})
      contest.leave_out(name, "the processor has no AVX-512");
  }

  // The competitors mark the nodes near the surface in its present state.
  const riis_mark_list marked = two.step();
  const Triangles triangles(two.surface());
  PaperSearch paper(n, xyz, nodes.rows());
  paper.begin_at(triangles);
  const EveryTriangle every_triangle(triangles);
  const PointQuery point_query(triangles);
  std::int64_t n_by_paper = 0, n_asked = 0, n_by_query = 0;
  bool is_right = true;
#if defined(RIIS_WITH_CGAL)
  const CgalQuery cgal(triangles);
  std::vector<double> distance(nodes.xyz().size() / 3);
  cgal.distances(n, xyz, half_thickness, 2, distance.data());
  is_right = is_same(distance, marked);
#endif
  for (const int n_threads : {1, 2}) {
    const auto before = [n_threads] { wake_threads(n_threads); };
    const auto add_competitor = [&](const char *name, int turns, const Contest::Work &work) {
      contest.add(name + of_threads(n_threads), turns, work, before);
    };
    add_competitor("coordinates", n_turns, [&, n_threads] { pass_over_coordinates(n, xyz, n_threads); });
    add_competitor("the paper's search, every triangle", n_slow_turns, [&, n_threads] {
      n_by_paper = paper.run(every_triangle, half_thickness, n_threads);
      n_asked = paper.n_asked();
    });
    add_competitor("the paper's search, point queries", n_slow_turns,
                   [&, n_threads] { n_by_query = paper.run(point_query, half_thickness, n_threads); });
#if defined(RIIS_WITH_CGAL)
    add_competitor("CGAL, every node", n_slow_turns,
                   [&, n_threads] { cgal.distances(n, xyz, half_thickness, n_threads, distance.data()); });
#else
    contest.leave_out("CGAL, every node" + of_threads(n_threads), "CGAL was not found when this was built");
#endif
  }

  Mesh fresh;
  const auto renew = [&] {
    fresh = mesh_over(nodes);
    wake_threads(2);
  };
  contest.add(
      "prepare the mesh, 2 threads", n_slow_turns, [&] { check(riis_mesh_prepare(fresh.get(), 2)); }, renew);
  const Result first_result = make_result();
  riis_mark_options automatic;
  check(riis_mark_options_init(&automatic, sizeof automatic));
  automatic.n_threads = 2;
  contest.add(
      "first marking, 2 threads", n_slow_turns,
      [&] { check(riis_mark_nodes(one.surface(), fresh.get(), &automatic, first_result.get())); }, renew);
  riis_mark_options exhaustive = automatic;
  exhaustive.search = RIIS_SEARCH_EXHAUSTIVE;
  contest.add(
      "exhaustive search, 2 threads", n_slow_turns,
      [&] { check(riis_mark_nodes(one.surface(), mesh.get(), &exhaustive, first_result.get())); },
      [] { wake_threads(2); });

  std::printf("Aortic valve, half thickness %g cm: %lld triangles, fine %.0f. %lld nodes, %lld marked (%.1f %%).\n",
              half_thickness, static_cast<long long>(triangles.n()), n_triangles_of(fine_two.surface()),
              static_cast<long long>(n), static_cast<long long>(marked.n_nodes),
              100.0 * static_cast<double>(marked.n_nodes) / static_cast<double>(n));
  std::fflush(stdout);
  contest.run();
  // Contenders with more threads than processors come last. OpenMP starts and ends threads for these contenders. In the same run,
  // this would slow the contenders on two threads.
  add(contest, "step, 4 threads", four);
  contest.run();
  const double ns_a_pair = 1e6 * contest.least("the paper's search, every triangle, 1 thread") /
                           static_cast<double>(n_asked) / static_cast<double>(triangles.n());
  std::printf(
      "With 0.3 cm %lld are marked. The paper's search asks %lld nodes and marks %lld (%lld by point queries), at "
      "%.2f ns a pair of a node and a triangle.\n",
      static_cast<long long>(thick.stats().n_marked), static_cast<long long>(n_asked),
      static_cast<long long>(n_by_paper), static_cast<long long>(n_by_query), ns_a_pair);
  const double step_ns = 1e6 * contest.least("step, 1 thread");
  std::printf("A step on one thread takes %.1f ns for each node, and %.0f ns for each marked node.\n\n",
              step_ns / static_cast<double>(n), step_ns / static_cast<double>(marked.n_nodes));
  counts["nodes"] = n;
  counts["half_thickness"] = half_thickness;
  counts["triangles"] = triangles.n();
  counts["fine_triangles"] = n_triangles_of(fine_two.surface());
  counts["marked"] = marked.n_nodes;
  counts["fixed_triangles"] = n_triangles_of(coarse_fixed.surface());
  counts["fine_fixed_triangles"] = n_triangles_of(fine_fixed.surface());
  counts["marked_with_0.3"] = thick.stats().n_marked;
  counts["asked_by_paper"] = n_asked;
  counts["marked_by_paper"] = n_by_paper;
  return is_right;
}

// Measures the times for a tenth of the nodes, for all nodes, and for ten times as many nodes. The meshes have coordinates, but
// no adjacency.
void compare_sizes(Contest &contest, std::int64_t about_n_nodes, nlohmann::json &counts) {
  struct Size {
    CylinderNodes nodes;
    Mesh mesh;
    TimeSteps steps;
    explicit Size(std::int64_t n)
        : nodes(wide_cylinder, n), mesh(mesh_over(nodes)), steps((prepare(mesh), mesh.get()), step_options(2)) {}
    static void prepare(const Mesh &mesh) { check(riis_mesh_prepare(mesh.get(), 2)); }
  };
  Size tenth(about_n_nodes / 10), same(about_n_nodes), tenfold(10 * about_n_nodes);
  const auto add_size = [&](const std::string &name, Size &size) {
    contest.add(
        name, n_turns, [&] { size.steps.step(); },
        [&] {  // an untimed step, so that another mesh's data in the caches does not matter
          size.steps.move();
          size.steps.step();
          size.steps.move();
        });
  };
  add_size("step, 2 threads, a tenth of the nodes", tenth);
  add_size("step, 2 threads, the nodes", same);
  add_size("step, 2 threads, 10 times the nodes", tenfold);
  contest.run();
  const riis_mark_stats stats = tenfold.steps.stats();
  counts["tenfold_nodes"] = stats.n_nodes;
  std::printf("Ten times as many nodes: %lld, %lld marked.\n\n", static_cast<long long>(stats.n_nodes),
              static_cast<long long>(stats.n_marked));
}

// Measures the times of markings of a grid, which is given by its axes, and also as a prepared mesh of points. The nodes fill a
// box that is 1.5 times as wide as the valve. The half thickness is 1.5 times the spacing of the grid. Returns whether both
// meshes get the same marks.
bool compare_grid(Contest &contest, std::int64_t about_n_nodes, nlohmann::json &counts) {
  constexpr double box_of_valves = 1.5, cells_of_half = 1.5;
  const auto n = static_cast<std::int64_t>(std::lround(std::cbrt(static_cast<double>(about_n_nodes))));
  riis_surface_info info;
  check(riis_surface_get_info(make_surface(make_valve("aortic").get()).get(), &info, sizeof info));
  double size = 0;
  for (int c = 0; c < 3; ++c) size = std::max(size, box_of_valves * (info.upper[c] - info.lower[c]));
  riis_grid grid;
  check(riis_grid_init(&grid, sizeof grid));
  grid.ni = grid.nj = grid.nk = n;
  const double spacing = size / static_cast<double>(n - 1);
  for (int c = 0; c < 3; ++c) {
    grid.origin[c] = (info.lower[c] + info.upper[c] - size) / 2;
    grid.spacing[c] = spacing;
  }
  riis_mesh *made = nullptr;
  check(riis_mesh_create_grid(&grid, &made));
  const Mesh of_axes(made);
  std::vector<double> xyz;
  const auto place = [&](int c, std::int64_t i) { return grid.origin[c] + static_cast<double>(i) * spacing; };
  for (std::int64_t k = 0; k < n; ++k)
    for (std::int64_t j = 0; j < n; ++j)
      for (std::int64_t i = 0; i < n; ++i) xyz.insert(xyz.end(), {place(0, i), place(1, j), place(2, k)});
  check(riis_mesh_create(n * n * n, xyz.data(), xyz.data() + 1, xyz.data() + 2, 3, &made));
  const Mesh of_points(made);
  check(riis_mesh_prepare(of_points.get(), 1));
  StepOptions options = step_options(1);
  options.half_thickness = cells_of_half * spacing;
  TimeSteps by_axes(of_axes.get(), options), by_points(of_points.get(), options);
  add(contest, "step, 1 thread, grid by its axes", by_axes);
  add(contest, "step, 1 thread, grid as points", by_points);
  contest.run();
  by_axes.move_to(0.5);
  by_points.move_to(0.5);
  const riis_mark_list a = by_axes.step(), b = by_points.step();
  counts["grid_nodes"] = n * n * n;
  counts["marked_in_grid"] = a.n_nodes;
  std::printf("A grid of %lld nodes: %lld marked.\n\n", static_cast<long long>(n * n * n),
              static_cast<long long>(a.n_nodes));
  return a.n_nodes == b.n_nodes && std::equal(a.node_id, a.node_id + a.n_nodes, b.node_id);
}

}  // namespace

int main(int argc, char **argv) {
  const std::int64_t about_n_nodes = n_nodes_given(argc, argv, 2, 10);
  Contest contest;
  Bars bars;
  nlohmann::json counts;
  const bool has_same_rows = compare_adjacencies(contest, bars, about_n_nodes, counts);
  const bool is_right = compare_with_others(contest, bars, about_n_nodes, counts) && has_same_rows &&
                        compare_grid(contest, about_n_nodes, counts);
  compare_sizes(contest, about_n_nodes, counts);
  for (const RatioBar &ratio : ratio_bars) bars.add(contest, ratio);
  contest.print();
  std::printf("\n");
  bars.print();
  if (argc > 1) {
    std::ofstream file(argv[1]);
    const nlohmann::json all{{"counts", counts},
                             {"times", contest.json()},
                             {"bars", bars.json()},
                             {"left_out", bars.left_out()},
                             {"same_marks", is_right}};
    file << all.dump(2) << '\n';
    if (!file) {
      std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
      return 1;
    }
  }
  return is_right ? 0 : 1;
}
