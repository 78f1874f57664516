// SPDX-License-Identifier: Apache-2.0
// The lower line of a coaptation zone, along which two patches meet without a crease (docs/theory/coapting.md, "No crease").
// In: the free edge above the line, the line's ends, and the tangents of the patch below. Out: the line.
#pragma once

#include "geometry/bezier.hpp"

namespace riis {

// Along the coaptation line K, the derivative of the lower patch by v is T = K - c + (1 - u) Y + u A, with the chord c of K. Y
// and A are the end tangents of the symmetry curve and of the attachment, and are as long as these curves.
struct EndTangents {
  Vec3 of_symmetry, of_attachment;

  Vec3 at(double u) const { return mix(of_symmetry, of_attachment, u); }
};

// Returns a first coaptation line below the free edge F. The derivative of the upper patch by v is F - K. At the parameters 1/3
// and 2/3 of both curves, F - K is T times a factor. The factor decreases from the middle to 0 at the commissure.
Bezier first_coaptation_line(const Bezier &free_edge, Vec3 middle, const EndTangents &tangents);

// Moves the inner control points of the coaptation line, so that the two patches that meet in it have a common tangent plane.
Bezier smoothed(Bezier line, const Bezier &free_edge, const EndTangents &tangents);

}  // namespace riis
