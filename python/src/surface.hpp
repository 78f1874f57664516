// SPDX-License-Identifier: Apache-2.0
// What surfaces from arrays and keyframes share.
#pragma once

#include "module.hpp"

namespace riis_python {

// Faces of the caller, and vertices if there are any.
struct FaceArrays {
  // faces may be None: the vertices alone move.
  FaceArrays(nb::handle faces, nb::handle leaflet_id, nb::handle index_base);
  void set_vertices(nb::handle vertices, nb::handle velocities);

  riis_surface_arrays arrays;
  std::optional<Array> faces, leaflets;
  Points vertices, velocities;
};

std::int32_t interpolation_of(nb::handle value);

}  // namespace riis_python
