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
// In the memory of triangles that are no longer wanted. Fails with RIIS_LIMIT_EXCEEDED for more than max_triangles.
TriangleSet triangulate(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals,
                        int n_threads, TriangleSet memory = {});

// A quad by its corners at (u,v) = (0,0), (1,0), (1,1) and (0,1), bilinear in between; split into triangles along p00 p11.
struct Quad {
  Vec3 p00, p10, p11, p01;

  // Along an edge this is the mix of the edge's two ends, whichever quad asks: neighbours agree to the last bit.
  Vec3 at(double s, double t) const { return mix(mix(p00, p10, s), mix(p01, p11, s), t); }
};

// kappa_quad: the distance between the middle of the bilinear quad and the middle of its diagonal p00 p11; no point of the
// quad is farther from the two triangles' point at the same (u,v).
double quad_flatness(const Quad &quad);

// A bound on the distance between the bilinear quad and its two triangles as surfaces: kappa_quad, or, where both are graphs
// over a plane along both diagonals, half of what of the twist is across that plane (docs/theory.md, section 2).
double split_error(const Quad &quad);

}  // namespace riis
