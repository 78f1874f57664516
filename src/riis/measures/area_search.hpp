// SPDX-License-Identifier: Apache-2.0
// Finds the values of a variable at which an area has a given size. For example, a valve's orifice area depends on its opening.
// The area may jump slightly, may grow in one part of the range and fall in another, and has no derivative.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace riis {

class AreaSearch {
 public:
  // Returns the area at a value, or nothing if the value has no area. The search by find() needs an area at each value.
  using Area = std::function<std::optional<double>(double value)>;

  // A change of at most `largest_jump` times the largest area may be only a jump.
  static constexpr double largest_jump = 1e-4;

  struct Point {
    double value, area;
  };

  // Tries n_samples values from `from` to `to`. If `grows` is true, the steps between the values grow with the value. Otherwise
  // they are equal. After that, finds the exact values at which the area stops growing or falling.
  AreaSearch(Area area, double from, double to, std::int32_t n_samples, bool grows);

  bool has_area() const { return !points_.empty(); }
  // All functions below need at least one value with an area.
  const Point &least() const { return points_[least_]; }
  const Point &most() const { return points_[most_]; }
  // Returns whether all areas are equal, apart from jumps.
  bool is_constant() const { return most().area - least().area <= largest_jump * most().area; }
  // Returns, in ascending order, the values at which the area stops growing or falling.
  const std::vector<double> &turns() const { return turns_; }
  std::int64_t n_refused() const { return n_refused_; }

  // Returns a value with this area. The relative error of the area is at most `tolerance`. If several values have the area, the
  // value nearest to `near` is returned. If the area jumps past the wanted area, the nearer end of the jump is returned. Returns
  // nothing if no value has this area.
  std::optional<Point> find(double area, double near, double tolerance) const;

 private:
  // The points from `first` to `last`, over which the area only grows or only falls, apart from jumps. No value between `first`
  // and `last` was refused.
  struct Part {
    std::size_t first, last;
  };

  void sample(double from, double to, std::int32_t n_samples, bool grows);
  void add_extreme(std::size_t at);
  void part();
  std::optional<Point> in_part(const Part &part, double area, double near, double tolerance) const;
  Point between(Point a, Point b, double area, double tolerance) const;

  Area area_;
  std::vector<Point> points_;           // ascending by value
  std::vector<char> is_after_refused_;  // for each point, whether a value between it and the previous point was refused
  std::vector<Part> parts_;
  std::vector<double> turns_;
  std::size_t least_ = 0, most_ = 0;
  std::int64_t n_refused_ = 0;
};

}  // namespace riis
