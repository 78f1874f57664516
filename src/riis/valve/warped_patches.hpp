// SPDX-License-Identifier: Apache-2.0
// Patches in space: every image becomes a patch of its own, and a warp may move its curves (docs/theory/warp.md).
// In: the patches of a kind of valve, a map. Out: patches that are their own images.
#pragma once

#include "valve/patches.hpp"
#include "valve/warp.hpp"

namespace riis {

// Returns the patches with every image as a patch of its own. The order and the labels u and v stay. Patches that met still share
// their curves. Patches that are their own images already keep the numbers of their curves.
PatchSet without_images(const PatchSet &set);

// Returns the same patches with warped curves. A warped curve has the warped ends and the directions of the warped end tangents.
// The lengths of these tangents make it the nearest to the warped points of the curve, by least squares. Arcs are bent anew
// between warped curves. Unless `check` is no, fails with RIIS_INVALID_PARAMETER if the warp folds at a patch or turns a part of
// it over. The message names the place and the value.
enum class FoldCheck { no, yes };
PatchSet warped(const PatchSet &set, const BlendedWarp &warp, FoldCheck check = FoldCheck::yes);

// Writes the points of the warped curve and the shares of its length, where `points` says which points they are.
void locate_on_curve(const Curve &curve, MaterialPoints &points);

}  // namespace riis
