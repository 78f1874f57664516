// SPDX-License-Identifier: Apache-2.0
// The common part of surfaces from arrays and of keyframes.
#pragma once

#include "module.hpp"

#define RIIS_SKIRT                                                                                                \
  "skirt_length: float = 0.0, attached: numpy.typing.NDArray[numpy.bool_] | numpy.typing.NDArray[numpy.uint8] | " \
  "None = None, skirt_lengths: numpy.typing.NDArray[numpy.float64] | None = None"

namespace riis_python {

// The skirt of a surface from arrays, as the caller gave it.
struct SkirtArguments {
  nb::handle length, attached, lengths;
};

// The caller's faces, and the vertices if they are given.
struct FaceArrays {
  // Takes the faces. If they are None, only the vertices move.
  FaceArrays(nb::handle faces, nb::handle leaflet_id, nb::handle index_base);
  void set_vertices(nb::handle vertices, nb::handle velocities);
  // The number of vertices must be set before.
  void set_skirt(const SkirtArguments &skirt);

  riis_surface_arrays arrays;
  std::optional<Array> faces, leaflets, attached, skirt_lengths;
  Points vertices, velocities;
};

std::int32_t interpolation_of(nb::handle value);

}  // namespace riis_python
