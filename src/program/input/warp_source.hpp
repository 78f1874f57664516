// SPDX-License-Identifier: Apache-2.0
// In: the warp of a valve, {"sources": [[x, y, z], ...], "targets": ..., ...}, in a case, in a placed valve, or in a file of its
// own, which may also be a CSV. Out: the warp at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/base/handles.hpp"
#include "program/base/options.hpp"
#include "program/input/json.hpp"

namespace riis::program {

// Landmarks on the valve, and their targets at one time or at several.
class LandmarkPairs {
 public:
  // The landmarks are in the mesh's coordinates if the placement is given, and in the valve's own if it is NULL. `factor`
  // converts lengths of the file to the mesh's unit.
  LandmarkPairs(const CaseValues &values, double noise, const riis_surface_options *placement, double factor);

  bool moves() const { return times_.size() > 1; }
  const std::vector<double> &sources() const { return sources_; }
  const std::vector<double> &targets() const { return targets_; }  // one time after the other
  // Takes the landmarks to their places at a time, and returns the warp.
  const riis_warp *at(double time);

 private:
  std::string subject_;
  Warp warp_;
  std::vector<double> sources_, times_, targets_;  // one time if the landmarks do not move
  double period_ = 0;
  std::int32_t interpolation_ = 0;
  std::int64_t n_landmarks_ = 0;
};

// The warp of a valve. Without landmarks the valve has none.
class WarpSource {
 public:
  WarpSource() = default;
  // Reads the landmarks of both states from the object of a warp. `placement` places the valve.
  WarpSource(const std::string &path, const std::string &object, const Json &warp,
             const riis_surface_options &placement, double factor = 1);

  bool is_empty() const { return pairs_.empty(); }
  bool moves() const;
  // The landmarks of the closed state, and of the open state if it has its own.
  const std::vector<LandmarkPairs> &pairs() const { return pairs_; }
  bool is_in_mesh() const { return is_in_mesh_; }  // whether the landmarks are in the mesh's coordinates
  double noise() const { return noise_; }
  // Gives the valve its warp at a time.
  void apply(double time, riis_valve *valve);

 private:
  std::string subject_;
  std::vector<LandmarkPairs> pairs_;
  bool is_in_mesh_ = true;
  double noise_ = 0;
};

// Reads the warp of --warp, or that of a placed valve. Refuses both together.
WarpSource read_warp(const ValveOptions &options);

}  // namespace riis::program
