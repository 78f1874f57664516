// SPDX-License-Identifier: Apache-2.0
// The inputs are a surface and the pieces of a mesh. The result is the share of the leaflets' area that is farther than the half
// thickness from the mesh. Skirts and the housing of a bileaflet valve do not count, because they may reach beyond the wall.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/base/area_samples.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/mark/moving_valve.hpp"
#include "program/output/report.hpp"

namespace riis::program {

class LeafletsOutside {
 public:
  // Takes the surface at the valve's present position.
  explicit LeafletsOutside(const MovingValve &valve);
  // Takes another surface of a valve with the given options.
  LeafletsOutside(const MarkOptions &options, const riis_surface *surface, std::optional<double> opening);
  void add(const Piece &piece);
  std::optional<double> opening() const { return opening_; }
  // Returns the share of the area that is outside all pieces of this rank so far.
  double share_so_far() const { return share_of(is_outside_); }
  // Returns the shares of the area that are outside the pieces of all ranks.
  OutsideReport report() const;

 private:
  double share_of(const std::vector<std::uint8_t> &is_outside) const;

  const MarkOptions &options_;
  riis_surface_info info_;
  std::optional<double> opening_;
  AreaSamples samples_;
  std::vector<std::uint8_t> is_outside_;  // of all pieces so far
};

// Warns if more than a small share of the leaflets is outside the mesh. Open leaflets may rightly lie against the wall and reach
// into it. The closed state, `closed`, therefore decides whether the valve is in a wrong place. A surface from a file has no
// `closed`. In the warning, `name` names the surface.
void warn_of_outside(const OutsideReport &report, const std::optional<OutsideReport> &closed, double half_thickness,
                     const std::string &name);
// Returns the share of the leaflets' area outside the mesh, and of single leaflets, such as "26 %" and "right 61 %".
std::string outside_text(const OutsideReport &report);

}  // namespace riis::program
