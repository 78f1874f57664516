// SPDX-License-Identifier: Apache-2.0
// The attachment and the skirt of a surface from arrays (docs/theory/skirt.md, "Surfaces from arrays"). This file finds the
// attached edges of the caller's faces, and makes the triangles of a strip that leads outwards from these edges.
#pragma once

#include <riis/riis.h>

#include "arrays/user_arrays.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// Finds the edges of the attachment, with the vertices of the arrays. Does nothing if the arrays have neither a skirt nor
// attached vertices. The edges stay the same when the vertices of the faces move later. Fails with RIIS_INVALID_SURFACE if the
// faces do not determine the edges.
void find_attachment(UserFaces &faces, const riis_surface_arrays &arrays);

// Gives the placed triangles of these faces their attachment and their skirt. The outer vertices follow the caller's vertices,
// and have velocities if the caller's vertices have them. `scale` is the scale of the placement. Fails with RIIS_INVALID_SURFACE
// if the outward direction is not determined, and with RIIS_INVALID_ARGUMENT for a length that does not fit. Fails with
// RIIS_LIMIT_EXCEEDED for too many triangles, and if no larger leaflet_id is left.
void add_skirt_of_arrays(const UserFaces &faces, double scale, bool flip_normals, TriangleSet &set);

}  // namespace riis
