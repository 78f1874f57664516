// SPDX-License-Identifier: Apache-2.0
// The attachment and the skirt of a surface from arrays (docs/theory/skirt.md, "Surfaces from arrays"). This file finds the
// attached edges of the caller's faces, and makes the triangles of a strip that leads outwards from these edges.
#pragma once

#include <riis/riis.h>

#include "arrays/user_arrays.hpp"
#include "triangulate/triangle_set.hpp"

namespace riis {

// Finds the edges of the attachment from the vertices of the arrays. Does nothing if the arrays have neither a skirt nor attached
// vertices. If the vertices move later, the edges stay the same. Fails with RIIS_INVALID_SURFACE if the faces do not determine
// the edges.
void find_attachment(UserFaces &faces, const riis_surface_arrays &arrays);

// Adds the attachment and the skirt to the placed triangles of these faces. In the list of vertices, the skirt's outer vertices
// come after the caller's vertices. They have velocities if the caller's vertices have velocities. `scale` is the scale of the
// placement. Fails with RIIS_INVALID_SURFACE if the outward direction is not determined, and with RIIS_INVALID_ARGUMENT for a
// length that does not fit. Fails with RIIS_LIMIT_EXCEEDED if there are too many triangles, or if no leaflet_id is left for the
// skirt.
void add_skirt_of_arrays(const UserFaces &faces, double scale, bool flip_normals, TriangleSet &set);

}  // namespace riis
