// SPDX-License-Identifier: Apache-2.0
// ./run bench roofline: compares the time of each stage of a step with the machine's limits. A step makes the surface of a valve
// that moved, and marks by the search over clusters, on one thread. The search first runs with kernels that read a clock. The
// search then runs with kernels that count operations and pairs, and record which memory they use.
//   argv[1]  the file for counts, times and peaks as JSON
//   argv[2]  the number of nodes in thousands, 1000 by default
#include <riis/riis.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>
#include <vector>

#include "api/handles.hpp"
#include "kernels/lanes.hpp"
#include "kernels/table.hpp"
#include "marks/marks.hpp"
#include "peak.hpp"
#include "search/cluster_search.hpp"
#include "shared/cylinder.hpp"
#include "shared/time_steps.hpp"

namespace riis {
Counts counts_of_kernels{0, 0};
}  // namespace riis

namespace {

using namespace bench;
using Clock = std::chrono::steady_clock;

constexpr double half_thickness = 0.1;
constexpr double coarse = 0.056, fine = 0.0034;  // the tolerances of ./run bench marking
constexpr int n_turns = 100;

double nanoseconds(Clock::duration duration) { return std::chrono::duration<double, std::nano>(duration).count(); }

// The sums that the timing kernels below collect. Only one thread calls these kernels.
struct Measured {
  const riis::Kernels *kernels;
  Clock::time_point regions_end;  // when the last comparison of boxes ended
  Clock::duration filter, decide;
  std::int64_t n_boxes, n_filter, n_decide;  // numbers of calls
};
Measured measured;

// `near` is one of the two kernels that compare boxes.
template <auto near>
bool measured_boxes(const riis::FilterTask &task, const riis::Boxes &boxes, const std::int32_t *candidates,
                    std::int32_t n_candidates, std::uint16_t *bits) {
  const bool is_near = (measured.kernels->*near)(task, boxes, candidates, n_candidates, bits);
  measured.regions_end = Clock::now();
  ++measured.n_boxes;
  return is_near;
}

void measured_begin_cluster(const riis::FilterTask &task, riis::ClusterTask &cluster) {
  const auto start = Clock::now();
  measured.kernels->begin_cluster(task, cluster);
  measured.filter += Clock::now() - start;
  ++measured.n_filter;
}

std::int32_t measured_filter_cluster(const riis::FilterTask &task, riis::ClusterTask &cluster,
                                     const riis::PairArrays &pairs, std::int32_t room) {
  const auto start = Clock::now();
  const std::int32_t n = measured.kernels->filter_cluster(task, cluster, pairs, room);
  measured.filter += Clock::now() - start;
  ++measured.n_filter;
  return n;
}

void measured_decide(std::int32_t n, const std::int32_t *point, const std::int32_t *triangle, const double *points,
                     const double *corners, double *distance_sq) {
  const auto start = Clock::now();
  measured.kernels->decide(n, point, triangle, points, corners, distance_sq);
  measured.decide += Clock::now() - start;
  ++measured.n_decide;
}

riis::Kernels measuring(const riis::Kernels &kernels) {
  measured.kernels = &kernels;
  riis::Kernels with_clocks = kernels;
  with_clocks.near_boxes = measured_boxes<&riis::FilterKernels::near_boxes>;
  with_clocks.near_own_boxes = measured_boxes<&riis::FilterKernels::near_own_boxes>;
  with_clocks.begin_cluster = measured_begin_cluster;
  with_clocks.filter_cluster = measured_filter_cluster;
  with_clocks.decide = measured_decide;
  return with_clocks;
}

// Sums the sizes of the blocks of memory that a stage uses. Each block counts once.
class Touched {
 public:
  void add(const void *piece, std::size_t size) {
    if (pieces_.insert(piece).second) bytes_ += size;
  }
  template <class Piece>
  void add(const Piece &piece) {
    add(&piece, sizeof piece);
  }
  double bytes() const { return static_cast<double>(bytes_); }
  std::size_t n() const { return pieces_.size(); }

 private:
  std::unordered_set<const void *> pieces_;
  std::size_t bytes_ = 0;
};

// The numbers that the counting kernels below collect.
struct Counted {
  Touched boxes, filter, decide, leaves;
  riis::Counts in_boxes{0, 0}, in_filter{0, 0}, in_decide{0, 0};
  std::int64_t n_near_groups = 0, n_decided = 0;
};
Counted *counted = nullptr;

// While an object of this type lives, it collects the operations and pairs that the kernels count.
class CountsOf {
 public:
  explicit CountsOf(riis::Counts &to) : to_(to), before_(riis::counts_of_kernels) {}
  ~CountsOf() {
    to_.operations += riis::counts_of_kernels.operations - before_.operations;
    to_.pairs += riis::counts_of_kernels.pairs - before_.pairs;
  }
  CountsOf(const CountsOf &) = delete;
  CountsOf &operator=(const CountsOf &) = delete;

 private:
  riis::Counts &to_;
  riis::Counts before_;
};

// `near` is one of the two kernels that compare boxes.
template <auto near>
bool counted_boxes(const riis::FilterTask &task, const riis::Boxes &boxes, const std::int32_t *candidates,
                   std::int32_t n_candidates, std::uint16_t *bits) {
  const CountsOf counts(counted->in_boxes);
  counted->boxes.add(boxes);
  for (std::int32_t k = 0; k < n_candidates; ++k) {
    const riis::GroupBounds &bounds = task.bounds[candidates[k]];
    if constexpr (near == &riis::FilterKernels::near_own_boxes)
      counted->boxes.add(bounds.axis, sizeof bounds.axis + sizeof bounds.from + sizeof bounds.to);
    else
      counted->boxes.add(&bounds, sizeof bounds.lower + sizeof bounds.upper);
  }
  return (riis::filter_kernels_counted.*near)(task, boxes, candidates, n_candidates, bits);
}

void counted_begin_cluster(const riis::FilterTask &task, riis::ClusterTask &cluster) {
  const CountsOf counts(counted->in_filter);
  for (std::int32_t i = 0; i < cluster.n_leaves; ++i) {
    const riis::LeafTask &leaf = cluster.leaf[i];
    counted->n_near_groups += leaf.n_groups;
    counted->leaves.add(*leaf.leaf);
    counted->filter.add(*leaf.leaf);
    for (std::int32_t k = 0; k < leaf.n_groups; ++k) {
      counted->filter.add(task.bounds[leaf.near_groups[k]]);
      counted->filter.add(task.groups[leaf.near_groups[k]]);
    }
  }
  riis::filter_kernels_counted.begin_cluster(task, cluster);
}

std::int32_t counted_filter_cluster(const riis::FilterTask &task, riis::ClusterTask &cluster,
                                    const riis::PairArrays &pairs, std::int32_t room) {
  const CountsOf counts(counted->in_filter);
  return riis::filter_kernels_counted.filter_cluster(task, cluster, pairs, room);
}

void counted_decide(std::int32_t n, const std::int32_t *point, const std::int32_t *triangle, const double *points,
                    const double *corners, double *distance_sq) {
  const CountsOf counts(counted->in_decide);
  counted->n_decided += n;
  for (std::int32_t i = 0; i < n; ++i) {
    constexpr int coordinates_of_point = 3, coordinates_of_triangle = 9;
    counted->decide.add(points + coordinates_of_point * point[i], coordinates_of_point * sizeof *points);
    counted->decide.add(corners + std::int64_t{coordinates_of_triangle} * triangle[i],
                        coordinates_of_triangle * sizeof *corners);
  }
  riis::decision_kernels_counted.decide(n, point, triangle, points, corners, distance_sq);
}

riis::Kernels counting() {
  riis::Kernels kernels{riis::filter_kernels_counted, riis::decision_kernels_counted};
  kernels.near_boxes = counted_boxes<&riis::FilterKernels::near_boxes>;
  kernels.near_own_boxes = counted_boxes<&riis::FilterKernels::near_own_boxes>;
  kernels.begin_cluster = counted_begin_cluster;
  kernels.filter_cluster = counted_filter_cluster;
  kernels.decide = counted_decide;
  return kernels;
}

template <class Number>
std::size_t bytes_of(const std::vector<Number> &numbers) {
  return numbers.size() * sizeof(Number);
}

// Returns the bytes of a surface's triangles and groups. Embree's scene needs more memory, which Embree does not report.
double bytes_of(const riis::Surface &surface) {
  const riis::TriangleSet &set = surface.triangles();
  const riis::TriangleGroups &groups = surface.scene().groups();
  return static_cast<double>(bytes_of(set.xyz) + bytes_of(set.uv) + bytes_of(set.vertex_id) +
                             bytes_of(set.triangle_id) + bytes_of(set.leaflet_id) + bytes_of(set.patch_id) +
                             bytes_of(groups.corners) + bytes_of(groups.groups) + bytes_of(groups.bounds));
}

// The nanoseconds of each stage of one step.
struct Times {
  double update, regions, filter, decide, rest, order;

  double sum() const { return update + regions + filter + decide + rest + order; }
};

double nanoseconds_of_thread() {
  timespec time;
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) != 0) {
    std::fprintf(stderr, "the thread's clock cannot be read\n");
    std::exit(1);
  }
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

double nanoseconds_of_clock() {
  constexpr int n = 100000;
  const auto start = Clock::now();
  Clock::time_point last = start;
  for (int i = 0; i < n; ++i) last = Clock::now();
  return nanoseconds(last - start) / n;
}

// A valve that moves, and the stages of its steps.
class StagedSteps {
 public:
  StagedSteps(const riis_mesh *mesh, const StepOptions &options)
      : steps_(mesh, options), mesh_(mesh->mesh), kernels_(riis::kernels(riis::best_instruction_set())) {}

  void move() { steps_.move(); }
  // Makes a step as a solver does. Measures only the processor time of this thread, because other work on a busy machine
  // interrupts every whole step.
  double whole() {
    const double start = nanoseconds_of_thread();
    steps_.step();
    return nanoseconds_of_thread() - start;
  }

  // Makes a step and reads a clock between its stages. The time for reading the clock is subtracted.
  Times staged(double of_clock) {
    const auto start = Clock::now();
    steps_.update();
    const auto updated = Clock::now();
    measured = {};
    search(measuring(kernels_));
    const auto searched = Clock::now();
    put_in_order();
    const auto ordered = Clock::now();
    const auto n_boxes = static_cast<double>(measured.n_boxes), n_filter = static_cast<double>(measured.n_filter),
               n_decide = static_cast<double>(measured.n_decide);
    Times times;
    times.update = nanoseconds(updated - start);
    times.regions = nanoseconds(measured.regions_end - updated) - n_boxes * of_clock;
    // An interval lies between two readings of the clock, and includes the time that one reading takes.
    times.filter = nanoseconds(measured.filter) - n_filter * of_clock;
    times.decide = nanoseconds(measured.decide) - n_decide * of_clock;
    times.rest = nanoseconds(searched - measured.regions_end - measured.filter - measured.decide) -
                 (n_filter + n_decide) * of_clock;
    times.order = nanoseconds(ordered - searched);
    return times;
  }

  // Counts the operations of the present step's stages, and the bytes that the stages use.
  nlohmann::json count() {
    Counted counts;
    counted = &counts;
    search(counting());
    put_in_order();
    counted = nullptr;
    const auto n_found = static_cast<double>(found_.size());
    const riis::NodeList &list = marks_.within.nodes;
    const auto in_lists = static_cast<double>(bytes_of(list.node_id) + bytes_of(list.distance) +
                                              bytes_of(list.triangle_id) + bytes_of(list.leaflet_id));
    constexpr double found_bytes = sizeof(riis::FoundNode);
    const auto operations = [](const riis::Counts &of) { return static_cast<double>(of.operations); };
    const riis::Surface &surface = content();
    return {{"marked", list.size()},
            {"triangles", surface.triangles().n_triangles()},
            {"groups", surface.scene().groups().groups.size()},
            {"leaves", counts.leaves.n()},
            {"near_groups", counts.n_near_groups},
            {"filtered_pairs", counts.in_filter.pairs},
            {"decided_pairs", counts.n_decided},
            {"operations",
             {{"regions", operations(counts.in_boxes)},
              {"filter", operations(counts.in_filter)},
              {"decide", operations(counts.in_decide)}}},
            {"bytes",
             {{"update", bytes_of(surface)},
              {"regions", counts.boxes.bytes()},
              {"filter", counts.filter.bytes()},
              {"decide", counts.decide.bytes()},
              {"rest", n_found * found_bytes},
              // The found nodes are read, copied bin by bin, read again, and written into the lists.
              {"order", 3 * n_found * found_bytes + in_lists}}}};
  }

 private:
  const riis::Surface &content() const { return riis::content_of(steps_.surface()); }

  void search(const riis::Kernels &kernels) {
    const riis::SearchRequest request{{content(), half_thickness, nullptr, 1, riis::best_instruction_set()}, mesh_};
    found_.numbers = {0, mesh_.nodes().n};
    riis::search_clusters(request, mesh_.clusters(1), kernels, marks_.cluster_scratch, found_);
  }
  void put_in_order() {
    const riis::OrderScratch::Counts n = riis::prepare_order(content(), found_, false, 1, marks_.order_scratch);
    riis::NodeList &list = marks_.within.nodes;
    if (!list.has_room(n.n_within)) list.reserve(n.n_within);
    list.resize(n.n_within);
    riis::put_in_order(content(), false, found_.numbers, 1, marks_.order_scratch, list, marks_.marked.nodes);
  }

  TimeSteps steps_;
  const riis::Mesh &mesh_;
  const riis::Kernels &kernels_;
  riis::Marks marks_;
  riis::FoundNodes &found_ = marks_.found;
};

// Measures the stages of a step with triangles of the given tolerance.
nlohmann::json measure(const riis_mesh *mesh, double tolerance, double of_clock) {
  StepOptions options;
  options.half_thickness = half_thickness;
  options.tolerance = tolerance;
  StagedSteps steps(mesh, options);
  // Whole steps and steps with clock readings take turns. For each stage the shortest time counts, because other work makes times
  // longer.
  Times least{};
  double whole = 1e300;
  for (int turn = 0; turn < n_turns + 1; ++turn) {
    steps.move();
    const double of_whole = steps.whole();
    steps.move();
    const Times times = steps.staged(of_clock);
    if (turn == 0) continue;  // the first turn does not count, because caches and memory settle
    whole = std::min(whole, of_whole);
    if (turn == 1) least = times;
    for (double Times::*stage :
         {&Times::update, &Times::regions, &Times::filter, &Times::decide, &Times::rest, &Times::order})
      least.*stage = std::min(least.*stage, times.*stage);
  }
  nlohmann::json all = steps.count();
  all["tolerance"] = tolerance;
  all["nanoseconds"] = {
      {"update", least.update}, {"regions", least.regions}, {"filter", least.filter}, {"decide", least.decide},
      {"rest", least.rest},     {"order", least.order},     {"sum", least.sum()},     {"whole", whole}};
  return all;
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FILE [THOUSANDS OF NODES]\n", argv[0]);
    return 2;
  }
  const CylinderNodes nodes(wide_cylinder, n_nodes_given(argc, argv, 2, 10));
  const Mesh mesh = mesh_over(nodes);
  check(riis_mesh_prepare(mesh.get(), 1));
  const riis::InstructionSet set = riis::best_instruction_set();
  constexpr const char *names[] = {"the baseline", "AVX2", "AVX-512"};
  const Peak peak = measure_peak(set);
  const double of_clock = nanoseconds_of_clock();
  const nlohmann::json all{{"nodes", nodes.n_nodes()},
                           {"instructions", names[static_cast<int>(set)]},
                           {"peak", {{"floats", peak.floats}, {"doubles", peak.doubles}, {"bytes", peak.bytes}}},
                           {"clock", of_clock},
                           {"coarse", measure(mesh.get(), coarse, of_clock)},
                           {"fine", measure(mesh.get(), fine, of_clock)}};
  std::ofstream file(argv[1]);
  file << all.dump(2) << '\n';
  if (!file) {
    std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
