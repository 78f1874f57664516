// SPDX-License-Identifier: Apache-2.0
#include "k_jump.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bench {
namespace {

// One kind of triangulation, with the change of K in the last step.
class Change {
 public:
  Change(const riis_valve *valve, const CylinderNodes &nodes, double tolerance, std::int32_t triangulation)
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

}  // namespace

KJump measure_k_jump(riis_valve *valve, const CylinderNodes &nodes, double step, int n_steps) {
  constexpr double tolerance = 0.05, fine = 0.0005;
  Change adapted(valve, nodes, tolerance, RIIS_TRIANGULATION_ADAPTED),
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

}  // namespace bench
