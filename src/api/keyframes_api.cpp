// SPDX-License-Identifier: Apache-2.0
// riis_keyframes_*: argument checks around surface/keyframes.hpp.
#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"

using riis::guarded;
using riis::require;
using riis::require_handle;

namespace {

// The structs' sizes in the first release.
constexpr std::int64_t frames_size = 56, faces_size = 88;

const riis_keyframe_arrays default_frames{sizeof(riis_keyframe_arrays), 0, 0, nullptr, nullptr, 0,
                                          RIIS_INTERPOLATION_LINEAR,    0};

riis_surface_arrays default_faces() {
  riis_surface_arrays faces;
  riis_surface_arrays_init(&faces, sizeof faces);
  return faces;
}

}  // namespace

extern "C" {

riis_status riis_keyframe_arrays_init(riis_keyframe_arrays *frames, int64_t struct_size) {
  return guarded([&] { riis::init_struct<frames_size>(frames, struct_size, "frames", default_frames); });
}

riis_status riis_keyframes_create(const riis_surface_arrays *faces, const riis_keyframe_arrays *frames,
                                  riis_keyframes **keyframes) {
  return guarded([&] {
    require(keyframes, "keyframes");
    const riis_surface_arrays whole_faces =
        riis::completed<faces_size>(require(faces, "faces"), "faces", default_faces());
    const riis_keyframe_arrays whole =
        riis::completed<frames_size>(require(frames, "frames"), "frames", default_frames);
    *keyframes = new riis_keyframes(riis::Keyframes(whole_faces, whole));
  });
}

void riis_keyframes_destroy(riis_keyframes **keyframes) { riis::destroy_handle(keyframes, "keyframes"); }
}
