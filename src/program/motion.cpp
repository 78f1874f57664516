// SPDX-License-Identifier: Apache-2.0
#include "program/motion.hpp"

#include <algorithm>
#include <vector>

#include "program/numbers.hpp"
#include "program/outputs.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"

namespace riis::program {
namespace {

Motion read_motion(const Options &options) {
  const bool by_pieces = options.leaflets == "connected";
  const char *leaflets = options.leaflets.empty() || by_pieces ? nullptr : options.leaflets.c_str();
  riis_vtk_motion *handle = nullptr;
  check(riis_vtk_motion_read_pvd(options.surface.c_str(), leaflets, &handle));
  Motion motion(handle);
  if (by_pieces) check(riis_vtk_motion_number_pieces(motion.get()));
  return motion;
}

std::vector<std::string> files_of(const riis_vtk_motion *motion) {
  int64_t n_files = 0;
  const char *const *paths = nullptr;
  check(riis_vtk_motion_get_files(motion, &n_files, &paths));
  return {paths, paths + n_files};
}

Keyframes keyframes_of(const Options &options, const riis_vtk_motion *motion) {
  riis_surface_arrays arrays;
  riis_keyframe_arrays frames;
  check(riis_vtk_motion_get_arrays(motion, &arrays, sizeof arrays));
  check(riis_vtk_motion_get_frames(motion, &frames, sizeof frames));
  frames.period = options.period;
  riis_keyframes *handle = nullptr;
  check(riis_keyframes_create(&arrays, &frames, &handle), options.surface);
  return Keyframes(handle);
}

}  // namespace

bool is_motion_file(const std::string &surface) {
  const std::string ending = surface.substr(surface.size() - std::min<std::size_t>(surface.size(), 4));
  return ending == ".pvd" || ending == ".PVD";
}

void parse_motion(const std::string &time, const std::string &period, Options &options) {
  const auto refuse = [](const std::string &text) { throw Refusal{exit_wrong_usage, text}; };
  const bool is_motion = is_motion_file(options.surface), is_series = !options.series.times.empty();
  if (is_motion && time.empty() && !is_series)
    refuse("--surface " + options.surface + " is a motion: it needs --time T");
  if (is_series && !time.empty()) refuse("--time has no effect with --times");
  if (!is_motion && !time.empty())
    refuse("--time has no effect with --surface " + options.surface + ": a motion is a .pvd file");
  if (!period.empty() && !is_motion && options.series.cycle.empty())
    refuse("--period needs a motion, --surface FILE.pvd, or --cycle");
  if (!time.empty()) options.time = parse_number(time, "--time");
  if (!period.empty()) options.period = parse_number(period, "--period");
  if (!period.empty() && !(options.period > 0)) refuse("--period: " + period + " is not above 0");
}

KeyframeFiles read_keyframes(const Options &options, Seconds &seconds) {
  const Stage stage("reading " + options.surface, options.quiet);
  const Motion motion = read_motion(options);
  seconds.read += stage.seconds();
  KeyframeFiles read{nullptr, files_of(motion.get())};
  // Outputs are written when all frames have been read, and would replace them unnoticed.
  check_no_output_is("a frame of --surface " + options.surface, read.files, options);
  read.keyframes = keyframes_of(options, motion.get());
  return read;
}

Surface surface_of_keyframes(const Options &options, const riis_keyframes *keyframes) {
  riis_surface *surface = nullptr;
  check(riis_surface_create_from_keyframes(keyframes, *options.time, 0, &options.surface_options, &surface),
        options.surface);
  return Surface(surface);
}

}  // namespace riis::program
