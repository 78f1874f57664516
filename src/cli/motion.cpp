// SPDX-License-Identifier: Apache-2.0
#include "cli/motion.hpp"

#include <algorithm>
#include <vector>

#include "cli/numbers.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/refusal.hpp"

namespace riis::cli {
namespace {

using Motion = Handle<riis_vtk_motion, riis_vtk_motion_destroy>;
using Keyframes = Handle<riis_keyframes, riis_keyframes_destroy>;

Motion read_motion(const Options &options) {
  const bool by_pieces = options.leaflets == "connected";
  const char *leaflets = options.leaflets.empty() || by_pieces ? nullptr : options.leaflets.c_str();
  riis_vtk_motion *handle = nullptr;
  check(riis_vtk_motion_read_pvd(options.surface.c_str(), leaflets, &handle));
  Motion motion(handle);
  if (by_pieces) check(riis_vtk_motion_number_pieces(motion.get()));
  return motion;
}

// Outputs are written when all frames have been read, and would replace them unnoticed.
void check_frames_stay(const Options &options, const riis_vtk_motion *motion) {
  int64_t n_files = 0;
  const char *const *paths = nullptr;
  check(riis_vtk_motion_files(motion, &n_files, &paths));
  check_no_output_is("a frame of --surface " + options.surface, {paths, paths + n_files}, options);
}

Keyframes keyframes_of(const Options &options, const riis_vtk_motion *motion) {
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  check(riis_surface_arrays_init(&faces, sizeof faces));
  check(riis_keyframe_arrays_init(&frames, sizeof frames));
  check(riis_vtk_motion_arrays(motion, &faces, &frames));
  frames.period = options.period;
  riis_keyframes *handle = nullptr;
  check(riis_keyframes_create(&faces, &frames, &handle), options.surface);
  return Keyframes(handle);
}

}  // namespace

bool is_motion_file(const std::string &surface) {
  const std::string ending = surface.substr(surface.size() - std::min<std::size_t>(surface.size(), 4));
  return ending == ".pvd" || ending == ".PVD";
}

void parse_motion(const std::string &time, const std::string &period, Options &options) {
  const auto refuse = [](const std::string &text) { throw Refusal{exit_wrong_usage, text}; };
  const bool is_motion = is_motion_file(options.surface);
  if (is_motion && time.empty()) refuse("--surface " + options.surface + " is a motion: it needs --time T");
  if (!is_motion && !time.empty())
    refuse("--time has no effect with --surface " + options.surface + ": a motion is a .pvd file");
  if (!time.empty()) options.time = parse_number(time, "--time");
  if (!period.empty()) options.period = parse_number(period, "--period");
  if (!period.empty() && !(options.period > 0)) refuse("--period: " + period + " is not above 0");
}

MovedSurface surface_of_motion(const Options &options) {
  const Stage stage("reading " + options.surface, options.quiet);
  const Motion motion = read_motion(options);
  const double seconds = stage.seconds();
  check_frames_stay(options, motion.get());
  const Keyframes keyframes = keyframes_of(options, motion.get());
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_keyframes(keyframes.get(), *options.time, *options.time, &options.surface_options,
                                           &surface),
        options.surface);
  return {Surface(surface), seconds};
}

}  // namespace riis::cli
