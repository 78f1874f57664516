// SPDX-License-Identifier: Apache-2.0
// ./run bench moving: measures the cost of a valve's velocity, of the fields of the closest points and of the resistance. All
// costs are compared with a plain time step on the same nodes in the same run. Further comparisons cover fixed triangulations,
// coarse and fine, and the search for crossings. A step of an annulus that moves by landmarks is compared with a moving update of
// the same patches. The program prints times and bars.
//   argv[1]  thousands of nodes instead of a million, for a quick look
#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "shared/contest.hpp"
#include "shared/cylinder.hpp"
#include "shared/handles.hpp"

namespace {

using namespace bench;

// Marks with one kind of triangulation, and keeps the change of K in the last step.
class ResistanceChange {
 public:
  ResistanceChange(const riis_valve *valve, const CylinderNodes &nodes, double tolerance, std::int32_t triangulation)
      : mesh_(mesh_over(nodes)), k_(static_cast<std::size_t>(nodes.n_nodes())), change_(k_.size()) {
    riis_surface_options options;
    check(riis_surface_options_init(&options, sizeof options));
    options.tolerance = tolerance;
    options.triangulation = triangulation;
    surface_ = make_surface(valve, &options);
    check(riis_resistance_init(&resistance_, sizeof resistance_));
    resistance_.R = 1;
  }

  // Returns the largest K.
  double step(const riis_valve *valve) {
    check(riis_surface_update(surface_.get(), valve, nullptr));
    riis_mark_options marking;
    check(riis_mark_options_init(&marking, sizeof marking));
    check(riis_mark_nodes(surface_.get(), mesh_.get(), &marking, result_.get()));
    change_.swap(k_);
    std::fill(k_.begin(), k_.end(), 0.0);
    add_resistance(result_.get(), resistance_, k_, nullptr);
    for (std::size_t i = 0; i < k_.size(); ++i) change_[i] = k_[i] - change_[i];
    return *std::max_element(k_.begin(), k_.end());
  }
  const std::vector<double> &change() const { return change_; }

 private:
  Mesh mesh_;
  Surface surface_;
  Result result_ = make_result();
  riis_resistance resistance_;
  std::vector<double> k_, change_;
};

double largest_difference(const std::vector<double> &a, const std::vector<double> &b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// Measures how much the resistance K jumps because the triangles of a valve change between two steps.
struct KJump {
  double motion;        // the largest change of K in a step, on triangles so fine that their change does not matter
  double with_adapted;  // the largest difference from the change `motion`, with adapted triangles
  double with_fixed;
};

// Makes n_steps separate steps, which start at evenly spaced openings. A step changes the opening by `step`. All results are
// fractions of the largest K.
KJump measure_k_jump(riis_valve *valve, const CylinderNodes &nodes, double step, int n_steps) {
  constexpr double tolerance = 0.05, fine = 0.0005;
  ResistanceChange adapted(valve, nodes, tolerance, RIIS_TRIANGULATION_ADAPTED),
      fixed(valve, nodes, tolerance, RIIS_TRIANGULATION_FIXED), smooth(valve, nodes, fine, RIIS_TRIANGULATION_FIXED);
  KJump made{0, 0, 0};
  double largest_k = 0;
  for (int i = 0; i < n_steps; ++i)
    for (const bool is_after : {false, true}) {
      const double from = (i + 0.5) / n_steps * (1 - step);
      check(riis_valve_set_scalar(valve, "opening", is_after ? from + step : from));
      largest_k = std::max(largest_k, smooth.step(valve));
      adapted.step(valve);
      fixed.step(valve);
      if (!is_after) continue;
      for (const double change : smooth.change()) made.motion = std::max(made.motion, std::abs(change));
      made.with_adapted = std::max(made.with_adapted, largest_difference(adapted.change(), smooth.change()));
      made.with_fixed = std::max(made.with_fixed, largest_difference(fixed.change(), smooth.change()));
    }
  return {made.motion / largest_k, made.with_adapted / largest_k, made.with_fixed / largest_k};
}

constexpr int n_turns = 60;
constexpr std::int32_t all_fields = 255;

// The mitral valve already has an open state. The aortic valve opens to the state in README.md.
Valve opening_valve(const char *kind) {
  Valve valve = make_valve(kind);
  if (std::string(kind) != "aortic") return valve;
  const Valve open = make_valve(kind);
  check(riis_valve_set_scalar(open.get(), "leaflet_radius_in", 1));
  check(riis_valve_set_scalar(open.get(), "bending_radius_in", 1.1));
  check(riis_valve_set_open_state(valve.get(), open.get()));
  return valve;
}

// A valve whose opening changes by a thousandth in each step, up and down, on one thread.
class MovingSteps {
 public:
  MovingSteps(const char *kind, const CylinderNodes &nodes)
      : valve_(opening_valve(kind)),
        before_(opening_valve(kind)),
        after_(opening_valve(kind)),
        earlier_(opening_valve(kind)),
        mesh_(mesh_over(nodes)),
        n_nodes_(nodes.n_nodes()) {
    move();
    riis_surface_options of_surface;
    check(riis_surface_options_init(&of_surface, sizeof of_surface));
    of_surface.n_threads = 1;
    surface_ = make_surface(valve_.get(), &of_surface);
    of_surface.triangulation = RIIS_TRIANGULATION_FIXED;
    fixed_ = make_surface(valve_.get(), &of_surface);
    check(riis_mesh_prepare(mesh_.get(), 1));
    check(riis_mark_options_init(&marking_, sizeof marking_));
    marking_.n_threads = 1;
    check(riis_crossing_options_init(&crossing_, sizeof crossing_));
    crossing_.n_threads = 1;
    check(riis_resistance_init(&resistance_, sizeof resistance_));
    resistance_.R = 1;
    coefficient_.resize(static_cast<std::size_t>(n_nodes_));
    momentum_.resize(3 * static_cast<std::size_t>(n_nodes_));
  }

  void move() {
    step_ = (step_ + 1) % 100;
    const int now = step_ < 50 ? step_ : 100 - step_;
    check(riis_valve_set_scalar(before_.get(), "opening", opening_));
    check(riis_valve_set_scalar(valve_.get(), "opening", opening_ = 0.45 + 0.001 * now));
  }
  void update() { check(riis_surface_update(surface_.get(), valve_.get(), nullptr)); }
  void update_fixed() { check(riis_surface_update(fixed_.get(), valve_.get(), nullptr)); }
  // Chooses the grid lines of the fixed triangulation again.
  void choose() {
    riis_surface_options options;
    check(riis_surface_options_init(&options, sizeof options));
    options.n_threads = 1;
    options.triangulation = RIIS_TRIANGULATION_FIXED;
    make_surface(valve_.get(), &options);
  }
  void update_moving() {
    check(riis_surface_update_moving(surface_.get(), valve_.get(), before_.get(), 1e-3, nullptr, nullptr));
  }
  void find_crossings() { check(riis_find_crossings(surface_.get(), &crossing_, crossings_.get())); }
  void mark(std::int32_t fields) {
    marking_.fields = fields;
    check(riis_mark_nodes(surface_.get(), mesh_.get(), &marking_, result_.get()));
  }
  // Adds n directions in which the opening changes. Directions of other parameters would take the same time.
  void add_directions(int n) {
    riis_valve *const after = after_.get(), *const earlier = earlier_.get();
    check(riis_valve_set_scalar(after, "opening", opening_ + 1e-4));
    check(riis_valve_set_scalar(earlier, "opening", opening_ - 1e-4));
    for (int i = 0; i < n; ++i)
      check(riis_surface_add_direction(surface_.get(), after, earlier, 2e-4, nullptr, nullptr));
  }
  void add_resistance() { bench::add_resistance(result_.get(), resistance_, coefficient_, momentum_.data()); }
  riis_mark_stats stats() const { return stats_of(result_.get()); }
  double n_triangles() const { return n_triangles_of(surface_.get()); }
  double n_fixed_triangles() const { return n_triangles_of(fixed_.get()); }
  // Returns the largest number of triangles that an adapted triangulation has at 1,001 openings.
  double most_triangles() {
    double most = 0;
    for (int i = 0; i <= 1000; ++i) {
      check(riis_valve_set_scalar(valve_.get(), "opening", 0.001 * i));
      update();
      most = std::max(most, n_triangles());
    }
    return most;
  }

 private:
  Valve valve_, before_, after_, earlier_;
  Mesh mesh_;
  std::int64_t n_nodes_;
  Surface surface_, fixed_;
  Result result_ = make_result();
  Crossings crossings_ = make_crossings();
  riis_mark_options marking_;
  riis_crossing_options crossing_;
  riis_resistance resistance_;
  std::vector<double> coefficient_, momentum_;
  int step_ = 0;
  double opening_ = 0.45;
};

// With this tolerance there are about ten times as many triangles as by default.
constexpr double fine = 0.0034;

// Measures the time of the valve's motion with fine triangulations, adapted and fixed, without a mesh.
class FineSteps {
 public:
  explicit FineSteps(const char *kind) : valve_(opening_valve(kind)) {
    move();
    riis_surface_options options;
    check(riis_surface_options_init(&options, sizeof options));
    options.n_threads = 1;
    options.tolerance = fine;
    surface_ = make_surface(valve_.get(), &options);
    options.triangulation = RIIS_TRIANGULATION_FIXED;
    fixed_ = make_surface(valve_.get(), &options);
  }
  void move() {
    step_ = (step_ + 1) % 100;
    check(riis_valve_set_scalar(valve_.get(), "opening", 0.45 + 0.001 * (step_ < 50 ? step_ : 100 - step_)));
  }
  void update() { check(riis_surface_update(surface_.get(), valve_.get(), nullptr)); }
  void update_fixed() { check(riis_surface_update(fixed_.get(), valve_.get(), nullptr)); }
  double n_triangles() const { return n_triangles_of(surface_.get()); }
  double n_fixed_triangles() const { return n_triangles_of(fixed_.get()); }

 private:
  Valve valve_;
  Surface surface_, fixed_;
  int step_ = 0;
};

// Measures the time of a step of an annulus that moves by landmarks: new targets, a warped valve, and a moving update. The first
// contender is a valve of the patches that were read from the warped valve before. Both valves are asymmetric. Arcs cannot be
// given as patches, so a mitral valve lacks the first contender. The second contender is the symmetric valve, which has no warp
// and opens.
class WarpedSteps {
 public:
  WarpedSteps(const char *kind, int n_landmarks)
      : n_landmarks_(n_landmarks), has_patches_(std::string(kind) != "mitral") {
    riis_surface_options options;
    check(riis_surface_options_init(&options, sizeof options));
    options.n_threads = 1;
    for (int i = 0; i < n_landmarks; ++i) {
      const double angle = 2.399963 * i, height = -1.2 + 1.2 * i / n_landmarks;
      for (const double x : {1.25 * std::cos(angle), 1.25 * std::sin(angle), height}) sources_.push_back(x);
    }
    riis_warp *warp = nullptr;
    const riis_points sources = points_of(sources_);
    check(riis_warp_create(&sources, nullptr, &warp));
    warp_.reset(warp);
    for (Valve &valve : valves_) {
      valve = make_valve(kind);
      check(riis_valve_set_scalar(valve.get(), "opening", 0.5));
    }
    for (int k = 0; k < n_positions; ++k) {
      targets_.push_back(sources_);
      for (std::size_t i = 0; i < sources_.size(); i += 3) {
        const double swing = 0.002 * k, x = sources_[i], y = sources_[i + 1];
        targets_.back()[i] += swing * x;
        targets_.back()[i + 1] -= 0.5 * swing * y;
        targets_.back()[i + 2] += swing * x * y;
      }
      set_targets(k);
      check(riis_valve_set_warp(valves_[0].get(), warp_.get(), nullptr));
      if (has_patches_) read_out(valves_[0].get());
      symmetric_.push_back(make_valve(kind));
      check(riis_valve_set_scalar(symmetric_.back().get(), "opening", 0.5 + 0.002 * k));
    }
    check(riis_valve_set_warp(valves_[1].get(), warp_.get(), nullptr));
    surface_ = make_surface(valves_[0].get(), &options);
    if (has_patches_) surface_of_patches_ = make_surface(of_patches_[0].get(), &options);
    symmetric_surface_ = make_surface(symmetric_[0].get(), &options);
  }
  bool has_patches() const { return has_patches_; }

  void move() { step_ = (step_ + 1) % n_positions; }
  void step() {
    set_targets(step_);
    valves_[0].swap(valves_[1]);
    riis_valve *now = valves_[0].get(), *before = valves_[1].get();
    check(riis_valve_set_warp(now, warp_.get(), nullptr));
    check(riis_surface_update_moving(surface_.get(), now, before, 1e-3, nullptr, nullptr));
  }
  void update_of_patches() { update(surface_of_patches_, of_patches_); }
  void update_symmetric() { update(symmetric_surface_, symmetric_); }

 private:
  static constexpr int n_positions = 20;

  struct DestroyWarp {
    void operator()(riis_warp *warp) const { riis_warp_destroy(&warp); }
  };

  riis_points points_of(const std::vector<double> &xyz) const {
    riis_points points;
    check(riis_points_init(&points, sizeof points));
    points.n_points = n_landmarks_;
    points.x = xyz.data(), points.y = xyz.data() + 1, points.z = xyz.data() + 2;
    points.stride = 3;
    return points;
  }
  void update(const Surface &surface, const std::vector<Valve> &valves) {
    const riis_valve *before = valves[static_cast<std::size_t>((step_ + n_positions - 1) % n_positions)].get();
    check(riis_surface_update_moving(surface.get(), valves[static_cast<std::size_t>(step_)].get(), before, 1e-3,
                                     nullptr, nullptr));
  }
  void set_targets(int k) {
    const riis_points points = points_of(targets_[static_cast<std::size_t>(k)]);
    check(riis_warp_set_targets(warp_.get(), &points));
  }
  void read_out(riis_valve *valve) {
    riis_valve_patches read;
    riis_patches patches;
    check(riis_valve_get_patches(valve, &read, sizeof read));
    check(riis_patches_init(&patches, sizeof patches));
    patches.n_curves = read.n_curves, patches.degree = read.degree, patches.control = read.control;
    patches.n_patches = read.n_patches, patches.curve_id = read.curve_id, patches.reversed = read.reversed;
    riis_valve *made = nullptr;
    check(riis_valve_create_from_patches(&patches, &made));
    of_patches_.emplace_back(made);
  }

  int n_landmarks_, step_ = 0;
  bool has_patches_;
  std::vector<double> sources_;
  std::vector<std::vector<double>> targets_;
  std::unique_ptr<riis_warp, DestroyWarp> warp_;
  Valve valves_[2];
  std::vector<Valve> of_patches_, symmetric_;
  Surface surface_, surface_of_patches_, symmetric_surface_;
};

void measure_warps(Contest &contest, Bars &bars, WarpedSteps &steps, const std::string &name) {
  const std::string step = name + ": step", of_patches = name + ": moving update of the same patches",
                    symmetric = name + ": moving update of the symmetric valve";
  const auto move = [&] { steps.move(); };
  contest.add(
      step, n_turns, [&] { steps.step(); }, move);
  if (steps.has_patches())
    contest.add(
        of_patches, n_turns, [&] { steps.update_of_patches(); }, move);
  contest.add(
      symmetric, n_turns, [&] { steps.update_symmetric(); }, move);
  contest.run();
  if (steps.has_patches())
    bars.add(name + ": step / moving update of the same patches", contest.ratio(step, of_patches), Wanted::at_most, 2);
  // In a symmetric update, the work for one cusp serves all three cusps. The work for one half of a mitral valve serves both
  // halves.
  bars.add(name + ": step / moving update of the symmetric valve", contest.ratio(step, symmetric), Wanted::at_most,
           steps.has_patches() ? 5 : 2.5);
}

void add(Contest &contest, const std::string &name, MovingSteps &steps, const Contest::Work &work) {
  contest.add(name, n_turns, work, [&steps] { steps.move(); });
}

void measure(Contest &contest, Bars &bars, int valve, std::int64_t about_n_nodes) {
  const char *kind = valve == 0 ? "aortic" : "mitral";
  const CylinderNodes nodes(cylinders[valve], about_n_nodes);
  MovingSteps steps(kind, nodes);
  FineSteps fine_steps(kind);
  const auto name = [&](const char *what) { return std::string(kind) + ": " + what; };
  add(contest, name("update"), steps, [&] { steps.update(); });
  add(contest, name("moving update"), steps, [&] { steps.update_moving(); });
  add(contest, name("fixed update"), steps, [&] { steps.update_fixed(); });
  contest.add(
      name("fine update"), n_turns, [&] { fine_steps.update(); }, [&] { fine_steps.move(); });
  contest.add(
      name("fine fixed update"), n_turns, [&] { fine_steps.update_fixed(); }, [&] { fine_steps.move(); });
  add(contest, name("search for crossings"), steps, [&] { steps.find_crossings(); });
  contest.add(name("choice of fixed triangles"), 5, [&] { steps.choose(); });
  add(contest, name("step"), steps, [&] {
    steps.update();
    steps.mark(0);
  });
  add(contest, name("step with velocity"), steps, [&] {
    steps.update_moving();
    steps.mark(RIIS_FIELD_VELOCITY);
  });
  add(contest, name("step with all fields"), steps, [&] {
    steps.update_moving();
    steps.mark(all_fields);
  });
  for (const int n : {1, 4, 10})
    add(contest, name("step with ") + std::to_string(n) + " directions", steps, [&steps, n] {
      steps.update();
      steps.add_directions(n);
      steps.mark(RIIS_FIELD_GRADIENT);
    });
  // The contender with the caller's arrays comes last, because its arrays push the mesh out of the caches.
  add(contest, name("step with velocity, K and K u"), steps, [&] {
    steps.update_moving();
    steps.mark(RIIS_FIELD_VELOCITY);
    steps.add_resistance();
  });
  contest.run();
  std::printf("%s valve: %.0f triangles, %lld nodes, %lld marked.\n", kind, steps.n_triangles(),
              static_cast<long long>(nodes.n_nodes()), static_cast<long long>(steps.stats().n_marked));
  const auto ratio = [&](const char *above, const char *below, double bar) {
    bars.add(name(above) + " / " + below, contest.ratio(name(above), name(below)), Wanted::at_most, bar);
  };
  ratio("moving update", "update", 1.7);
  std::printf("Fixed triangles: %.0f. Fine: %.0f triangles, %.0f fixed ones.\n", steps.n_fixed_triangles(),
              fine_steps.n_triangles(), fine_steps.n_fixed_triangles());
  ratio("fixed update", "update", 1.0 / 3);
  ratio("fine fixed update", "fine update", 1.0 / 3);
  ratio("search for crossings", "update", 3);
  bars.add(name("fixed triangles / most adapted ones"), steps.n_fixed_triangles() / steps.most_triangles(),
           Wanted::at_most, 1.5);
  const CylinderNodes fewer(cylinders[valve], about_n_nodes / 10);
  const KJump jump = measure_k_jump(opening_valve(kind).get(), fewer, 0.0005, 100);
  std::printf(
      "In a step of 0.0005, K changes by up to %.2f %% of its largest value by the motion. The triangles add up to "
      "%.2f %% if they are adapted, %.2f %% if they are fixed.\n",
      100 * jump.motion, 100 * jump.with_adapted, 100 * jump.with_fixed);
  ratio("step with all fields", "step", 1.5);
  for (const int n : {1, 4, 10}) ratio(("step with " + std::to_string(n) + " directions").c_str(), "step", 1 + 0.3 * n);
}

}  // namespace

int main(int argc, char **argv) {
  const std::int64_t about_n_nodes = n_nodes_given(argc, argv, 1, 10);
  Contest contest;
  Bars bars;
  for (const int valve : {0, 1}) measure(contest, bars, valve, about_n_nodes);
  bars.add("update, mitral / aortic", contest.ratio("mitral: update", "aortic: update"), Wanted::at_most, 2.3);
  bars.add("fixed update, mitral / aortic", contest.ratio("mitral: fixed update", "aortic: fixed update"),
           Wanted::at_most, 1.8);
  for (const char *kind : {"trileaflet", "coapting", "aortic", "mitral"})
    for (const int n_landmarks : {30, 200}) {
      WarpedSteps steps(kind, n_landmarks);
      measure_warps(contest, bars, steps, kind + (", " + std::to_string(n_landmarks)) + " landmarks");
    }
  std::printf("\n");
  contest.print();
  std::printf("\n");
  bars.print();
  return 0;
}
