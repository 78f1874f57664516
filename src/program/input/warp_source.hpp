// SPDX-License-Identifier: Apache-2.0
// The input is the warp of a valve, {"sources": [[x, y, z], ...], "targets": ..., ...}. The warp stands in a case, in a placed
// valve, or in a separate file, which may also be a CSV. The result is the warp at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/input/json.hpp"

namespace riis::program {

// Landmarks on the valve, with their targets at one or several times.
class LandmarkPairs {
 public:
  // With a placement, the landmarks are in the mesh's coordinates. Without a placement (NULL), the landmarks are in the valve's
  // coordinates. `factor` converts the file's lengths to the mesh's unit.
  LandmarkPairs(const CaseValues &values, double noise, const riis_surface_options *placement, double factor);

  bool moves() const { return times_.size() > 1; }
  const std::vector<double> &sources() const { return sources_; }
  const std::vector<double> &targets() const { return targets_; }  // one time after the other
  // Moves the landmarks to their places at a time, and returns the warp.
  const riis_warp *at(double time);

 private:
  std::string subject_;
  Warp warp_;
  std::vector<double> sources_, times_, targets_;  // one time if the landmarks do not move
  double period_ = 0;
  std::int32_t interpolation_ = 0;
  std::int64_t n_landmarks_ = 0;
};

// The warp of a valve. Without landmarks, the valve is not warped.
class WarpSource {
 public:
  WarpSource() = default;
  // Reads the landmarks of the closed and the open state from a JSON object that describes the warp. `placement` is the placement
  // of the valve.
  WarpSource(const std::string &path, const std::string &object, const Json &warp,
             const riis_surface_options &placement, double factor = 1);

  bool is_empty() const { return pairs_.empty(); }
  bool moves() const;
  // Returns the landmarks of the closed state, followed by the landmarks of the open state if there are any.
  const std::vector<LandmarkPairs> &pairs() const { return pairs_; }
  bool is_in_mesh() const { return is_in_mesh_; }  // whether the landmarks are in the mesh's coordinates
  double noise() const { return noise_; }
  // Gives the valve its warp at the given time.
  void apply(double time, riis_valve *valve);

 private:
  std::string subject_;
  std::vector<LandmarkPairs> pairs_;
  bool is_in_mesh_ = true;
  double noise_ = 0;
};

// Reads the warp of --warp or of a placed valve. Refuses --warp for a placed valve that has a warp.
WarpSource read_warp(const ValveOptions &options);

}  // namespace riis::program
