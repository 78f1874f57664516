// SPDX-License-Identifier: Apache-2.0
// Logs a warning if leaflets go through each other, once for each shape of the valve.
// In: the valve and its new surface. Out: a log message or none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "scene/surface.hpp"
#include "valve/valve.hpp"

namespace riis {

class CrossingWatch {
 public:
  // Examines the first surface of each shape in each range of the opening, until it has warned about the shape. Without a log
  // function it does nothing and allocates nothing. It never fails, because the surface is good: if memory for the search is
  // lacking, there is no warning.
  void look(const Valve &valve, const Surface &surface, int n_threads) noexcept;

 private:
  struct Shape {
    std::uint64_t digest = 0;
    unsigned looked_at = 0;  // a bit for each range of the opening
    bool is_said = false;
  };
  Shape &remembered(std::uint64_t digest);

  // The number of shapes that are remembered. A caller that alternates between no more shapes than this gets one warning for each
  // shape.
  static constexpr std::size_t n_remembered = 8;

  std::array<Shape, n_remembered> shapes_{};
  std::size_t next_ = 0;
};

}  // namespace riis
