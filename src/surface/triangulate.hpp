// SPDX-License-Identifier: Apache-2.0
// Patches to triangles (paper, 3.3 and 4.1 "Triangulation").
// In: curves and patches of a valve, the error allowed, where to put it. Out: triangles with their patch, leaflet, u
// and v.
#pragma once

#include "geometry/placement.hpp"
#include "surface/triangle_set.hpp"
#include "valve/patches.hpp"

namespace riis {

// max_error bounds the distance between the triangles and the smooth surface, in the patches' units (before placement).
// Fails with RIIS_LIMIT_EXCEEDED for more than max_triangles.
TriangleSet triangulate(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals);

// kappa_quad: the distance between the middle of the bilinear quad p00 p10 p11 p01 and the middle of its diagonal p00
// p11; no point of the quad is farther from the two triangles' point at the same (u,v).
double quad_flatness(Vec3 p00, Vec3 p10, Vec3 p11, Vec3 p01);

}  // namespace riis
