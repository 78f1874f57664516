// SPDX-License-Identifier: Apache-2.0
// The common part of surfaces from arrays and of keyframes.
#pragma once

#include "module.hpp"

namespace riis_python {

// The caller's faces, and the vertices if they are given.
struct FaceArrays {
  // Takes the faces. If they are None, only the vertices move.
  FaceArrays(nb::handle faces, nb::handle leaflet_id, nb::handle index_base);
  void set_vertices(nb::handle vertices, nb::handle velocities);

  riis_surface_arrays arrays;
  std::optional<Array> faces, leaflets;
  Points vertices, velocities;
};

std::int32_t interpolation_of(nb::handle value);

}  // namespace riis_python
