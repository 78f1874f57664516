// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_keyframes_*. The work is in arrays/keyframes.cpp.
#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"
#include "pipeline/skirt_of_arrays.hpp"

using riis::guarded_with_handles;
using riis::require;

namespace {

const riis_keyframe_arrays default_frames{sizeof(riis_keyframe_arrays), 0, 0, nullptr, nullptr, 0,
                                          RIIS_INTERPOLATION_LINEAR,    64};

riis_surface_arrays default_keyframes_arrays() {
  riis_surface_arrays arrays;
  riis_surface_arrays_init(&arrays, sizeof arrays);
  return arrays;
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_keyframe_arrays_init, riis_keyframe_arrays, frames, default_frames)

riis_status riis_keyframes_create(const riis_surface_arrays *arrays, const riis_keyframe_arrays *frames,
                                  riis_keyframes **keyframes) {
  return guarded_with_handles([&] {
    require(keyframes, "keyframes");
    const riis_surface_arrays whole_arrays =
        riis::completed(require(arrays, "arrays"), "arrays", default_keyframes_arrays());
    const riis_keyframe_arrays whole = riis::completed(require(frames, "frames"), "frames", default_frames);
    riis::Keyframes made(whole_arrays, whole);
    riis::find_attachment(made.faces(), made.first_frame());
    *keyframes = new riis_keyframes(std::move(made));
  });
}

void riis_keyframes_destroy(riis_keyframes **keyframes) { riis::destroy_handle(keyframes, "keyframes"); }
}
