// SPDX-License-Identifier: Apache-2.0
// ./run bench marking: what a time step costs, beside what it is compared with, in one run. A step is the surface of a valve that
// moved, its scene, the marking, and the list of marked nodes with distances and triangles. Contenders take turns, so that what else
// the machine does falls on all alike. Prints the measured times and the bars as tables in markdown; argv[1], if given, is a file for
// them as JSON. argv[2]: thousands of nodes in the place of a million, for a quick look.
#include <malloc.h>
#include <riis/riis.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cylinder.hpp"
#include "references.hpp"

namespace {

using namespace bench;

// About 3 % of the nodes are within 0.1 cm of the aortic valve, as in the paper's meshes by the ratio of its searches.
constexpr Cylinder cylinder{2.0, -2.1, 1.3, 0};

double milliseconds_of(const std::function<void()> &work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// What is timed, in turns.
class Contest {
 public:
  // before() prepares a turn, outside its time. At most n_turns.
  void add(
      const std::string &name, int n_turns, std::function<void()> work, std::function<void()> before = [] {}) {
    contenders_.push_back({name, n_turns, std::move(work), std::move(before)});
  }
  void run() {
    int most = 0;
    for (const Contender &contender : contenders_) most = std::max(most, contender.n_turns);
    for (Contender &contender : contenders_) {  // memory and caches settle
      contender.before();
      contender.work();
    }
    for (int turn = 0; turn < most; ++turn)
      for (const Contender &contender : contenders_) {
        // Those with fewer turns have them spread over all.
        if (turn * contender.n_turns / most == (turn + 1) * contender.n_turns / most) continue;
        contender.before();
        times_[contender.name].push_back(milliseconds_of(contender.work));
      }
    contenders_.clear();
  }
  double least(const std::string &name) const {
    return *std::min_element(times_.at(name).begin(), times_.at(name).end());
  }
  // Of the ratio of two least times, the median of five parts of the run.
  double ratio(const std::string &above, const std::string &below) const {
    const std::vector<double> &a = times_.at(above), &b = times_.at(below);
    constexpr std::size_t n_parts = 5;
    std::vector<double> ratios;
    const auto least_of = [](const std::vector<double> &times, std::size_t part) {
      const std::size_t begin = part * times.size() / n_parts, end = (part + 1) * times.size() / n_parts;
      return *std::min_element(times.begin() + static_cast<std::ptrdiff_t>(begin),
                               times.begin() + static_cast<std::ptrdiff_t>(std::max(end, begin + 1)));
    };
    for (std::size_t part = 0; part < n_parts; ++part) ratios.push_back(least_of(a, part) / least_of(b, part));
    return median(ratios);
  }
  void print() const {
    std::printf("| what | least, ms | median, ms | turns |\n|---|---|---|---|\n");
    for (const auto &[name, times] : times_)
      std::printf("| %s | %.3f | %.3f | %zu |\n", name.c_str(), *std::min_element(times.begin(), times.end()),
                  median(times), times.size());
  }
  nlohmann::json json() const {
    nlohmann::json all;
    for (const auto &[name, times] : times_)
      all[name] = {{"least_ms", *std::min_element(times.begin(), times.end())},
                   {"median_ms", median(times)},
                   {"turns", times.size()}};
    return all;
  }

 private:
  struct Contender {
    std::string name;
    int n_turns;
    std::function<void()> work, before;
  };
  std::vector<Contender> contenders_;
  std::map<std::string, std::vector<double>> times_;
};

// A valve on its way, its surface, and a result: what a solver has.
class Steps {
 public:
  Steps(const riis_mesh *mesh, double tolerance, double half_thickness, int n_threads, std::int32_t instructions)
      : mesh_(mesh), valve_(make_valve("aortic")), result_(make_result()) {
    riis_surface_options options;
    check(riis_surface_options_init(&options, sizeof options));
    options.tolerance = tolerance;
    options.half_thickness = half_thickness;
    riis_surface *surface = nullptr;
    check(riis_surface_create(valve_.get(), &options, &surface));
    surface_.reset(surface);
    check(riis_mark_options_init(&marking_, sizeof marking_));
    marking_.search = RIIS_SEARCH_CLUSTERS;
    marking_.n_threads = n_threads;
    marking_.instructions = instructions;
  }

  // Outside the time of a step: what the step moves to.
  void move() {
    step_ = (step_ + 1) % 10;
    check(riis_valve_set_scalar(valve_.get(), "leaflet_angle", 45 + 0.5 * (step_ < 5 ? step_ : 10 - step_)));
  }
  void step() {
    check(riis_surface_update(surface_.get(), valve_.get(), nullptr));
    check(riis_mark_nodes(surface_.get(), mesh_, &marking_, result_.get()));
    std::int64_t n;
    const std::int64_t *node_id, *triangle_id;
    const double *distance;
    check(riis_mark_result_marked(result_.get(), &n, &node_id, &distance, &triangle_id, nullptr));
  }
  void add_to(Contest &contest, const std::string &name, int n_turns) {
    contest.add(
        name, n_turns, [this] { step(); }, [this] { move(); });
  }
  const riis_surface *surface() const { return surface_.get(); }
  riis_mark_stats stats() const {
    riis_mark_stats stats;
    check(riis_mark_result_stats(result_.get(), &stats, sizeof stats));
    return stats;
  }

 private:
  const riis_mesh *mesh_;
  Valve valve_;
  Surface surface_;
  Result result_;
  riis_mark_options marking_;
  int step_ = 0;
};

struct Bar {
  std::string name;
  double value, bar;
  bool at_most;  // otherwise at least
};

Mesh mesh_over(const CylinderMesh &nodes) {
  const double *xyz = nodes.xyz().data();
  riis_mesh *mesh = nullptr;
  check(riis_mesh_create(nodes.n_nodes(), xyz, xyz + 1, xyz + 2, 3, &mesh));
  return Mesh(mesh);
}

double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

bool has(std::int32_t instructions, const riis_surface *surface, const riis_mesh *mesh) {
  riis_mark_options options;
  check(riis_mark_options_init(&options, sizeof options));
  options.instructions = instructions;
  const riis_status status = riis_mark_nodes(surface, mesh, &options, make_result().get());
  if (status != RIIS_UNAVAILABLE) check(status);
  return status == RIIS_OK;
}

}  // namespace

int main(int argc, char **argv) {
  const std::int64_t million = 1000 * (argc > 2 ? std::strtoll(argv[2], nullptr, 10) : 1000);
  constexpr double coarse = 0.056, fine = 0.0034;  // tolerances for about 2,500 and 36,000 triangles
  constexpr int n_turns = 40, n_slow_turns = 5;
  Contest contest;
  std::vector<Bar> bars;
  const auto at_least = [&](const std::string &name, double value, double bar) {
    bars.push_back({name, value, bar, false});
  };
  const auto at_most = [&](const std::string &name, double value, double bar) {
    bars.push_back({name, value, bar, true});
  };

  const CylinderMesh nodes(cylinder, million);
  Mesh mesh = mesh_over(nodes);
  const double before_preparing = allocated();
  check(riis_mesh_prepare(mesh.get(), 2));
  const double bytes_a_node = (allocated() - before_preparing) / static_cast<double>(nodes.n_nodes());

  Steps one(mesh.get(), coarse, 0.1, 1, 0), two(mesh.get(), coarse, 0.1, 2, 0), four(mesh.get(), coarse, 0.1, 4, 0);
  Steps fine_two(mesh.get(), fine, 0.1, 2, 0), thick(mesh.get(), coarse * 0.1 / 0.3, 0.3, 2, 0);
  Steps avx2(mesh.get(), coarse, 0.1, 1, RIIS_INSTRUCTIONS_AVX2),
      baseline(mesh.get(), coarse, 0.1, 1, RIIS_INSTRUCTIONS_BASELINE);
  const bool has_avx512 = has(RIIS_INSTRUCTIONS_AVX512, one.surface(), mesh.get());

  const Triangles triangles(one.surface());
  PaperSearch paper(nodes.n_nodes(), nodes.xyz().data(), nodes.rows());
  paper.begin_at(triangles);
  const EveryTriangle every_triangle(triangles);
  const PointQuery point_query(triangles);
  std::int64_t n_by_paper = 0, n_asked = 0, n_by_query = 0;

  one.add_to(contest, "step, 1 thread", n_turns);
  two.add_to(contest, "step, 2 threads", n_turns);
  four.add_to(contest, "step, 4 threads", n_turns);
  fine_two.add_to(contest, "step, 2 threads, fine triangles", n_turns);
  thick.add_to(contest, "step, 2 threads, d_min 0.3", n_turns);
  if (has_avx512) {
    avx2.add_to(contest, "step, 1 thread, AVX2", n_turns);
    baseline.add_to(contest, "step, 1 thread, baseline", n_turns);
  }
  contest.add("coordinates, 1 thread", n_turns, [&] { pass_over_coordinates(nodes.n_nodes(), nodes.xyz().data(), 1); });
  contest.add("coordinates, 2 threads", n_turns,
              [&] { pass_over_coordinates(nodes.n_nodes(), nodes.xyz().data(), 2); });
  for (const int n_threads : {1, 2}) {
    const std::string threads = n_threads == 1 ? ", 1 thread" : ", 2 threads";
    contest.add("the paper's search, every triangle" + threads, n_slow_turns, [&, n_threads] {
      n_by_paper = paper.run(every_triangle, 0.1, n_threads);
      n_asked = paper.n_asked();
    });
    contest.add("the paper's search, point queries" + threads, n_turns / 2,
                [&, n_threads] { n_by_query = paper.run(point_query, 0.1, n_threads); });
  }
  Mesh fresh;
  contest.add(
      "prepare the mesh, 2 threads", n_turns / 2, [&] { check(riis_mesh_prepare(fresh.get(), 2)); },
      [&] { fresh = mesh_over(nodes); });
  const Result first_result = make_result();
  riis_mark_options automatic;
  check(riis_mark_options_init(&automatic, sizeof automatic));
  automatic.n_threads = 2;
  contest.add(
      "first marking, 2 threads", n_turns / 2,
      [&] { check(riis_mark_nodes(one.surface(), fresh.get(), &automatic, first_result.get())); },
      [&] { fresh = mesh_over(nodes); });
  riis_mark_options exhaustive = automatic;
  exhaustive.search = RIIS_SEARCH_EXHAUSTIVE;
  contest.add("exhaustive search, 2 threads", n_turns / 2,
              [&] { check(riis_mark_nodes(one.surface(), mesh.get(), &exhaustive, first_result.get())); });
  contest.run();

  const riis_mark_stats stats = two.stats();
  std::printf(
      "Aortic valve, half thickness 0.1 cm: %.0f triangles, fine %.0f. %lld nodes, %lld marked (%.1f %%), with 0.3 cm "
      "%lld.\n",
      n_triangles_of(two.surface()), n_triangles_of(fine_two.surface()), static_cast<long long>(stats.n_nodes),
      static_cast<long long>(stats.n_marked),
      100.0 * static_cast<double>(stats.n_marked) / static_cast<double>(stats.n_nodes),
      static_cast<long long>(thick.stats().n_marked));
  std::printf(
      "The paper's search asks %lld nodes and marks %lld (%lld by point queries), at %.2f ns a pair of a node and a "
      "triangle.\n\n",
      static_cast<long long>(n_asked), static_cast<long long>(n_by_paper), static_cast<long long>(n_by_query),
      1e6 * contest.least("the paper's search, every triangle, 1 thread") / static_cast<double>(n_asked) /
          static_cast<double>(triangles.n()));

  at_least("the paper's search with every triangle / step, 1 thread",
           contest.ratio("the paper's search, every triangle, 1 thread", "step, 1 thread"), 200);
  at_least("the same, 2 threads", contest.ratio("the paper's search, every triangle, 2 threads", "step, 2 threads"),
           200);
  at_least("the paper's search with point queries / step, 1 thread",
           contest.ratio("the paper's search, point queries, 1 thread", "step, 1 thread"), 10);
  at_most("step / pass over the coordinates, 2 threads", contest.ratio("step, 2 threads", "coordinates, 2 threads"), 6);
  at_least("step with 1 thread / with 2", contest.ratio("step, 1 thread", "step, 2 threads"), 1.8);
  at_most("step with 4 threads / with 2", contest.ratio("step, 4 threads", "step, 2 threads"), 1.3);
  at_most("fine / coarse triangles", contest.ratio("step, 2 threads, fine triangles", "step, 2 threads"), 3);
  at_most("d_min 0.3 / d_min 0.1", contest.ratio("step, 2 threads, d_min 0.3", "step, 2 threads"), 5);
  at_most("preparing the mesh / step, 2 threads", contest.ratio("prepare the mesh, 2 threads", "step, 2 threads"), 40);
  at_most("bytes a node", bytes_a_node, 48);
  if (has_avx512) {
    at_most("AVX2 / AVX-512", contest.ratio("step, 1 thread, AVX2", "step, 1 thread"), 1.8);
    at_most("baseline / AVX-512", contest.ratio("step, 1 thread, baseline", "step, 1 thread"), 3.5);
  }
  at_most("first marking / exhaustive search",
          contest.ratio("first marking, 2 threads", "exhaustive search, 2 threads"), 1.1);

  contest.print();
  std::printf("\n| bar | value | wanted | |\n|---|---|---|---|\n");
  nlohmann::json json{{"times", contest.json()}};
  for (const Bar &bar : bars) {
    const bool is_met = bar.at_most ? bar.value <= bar.bar : bar.value >= bar.bar;
    std::printf("| %s | %.2f | %s %g | %s |\n", bar.name.c_str(), bar.value, bar.at_most ? "<=" : ">=", bar.bar,
                is_met ? "met" : "NOT met");
    json["bars"].push_back({{"name", bar.name},
                            {"value", bar.value},
                            {"bar", bar.bar},
                            {"kind", bar.at_most ? "at most" : "at least"},
                            {"met", is_met}});
  }
  if (argc > 1) {
    std::ofstream file(argv[1]);
    file << json.dump(2) << '\n';
    if (!file) {
      std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
      return 1;
    }
  }
  return 0;
}
