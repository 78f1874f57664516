// SPDX-License-Identifier: Apache-2.0
// Measures how much the resistance K jumps because a valve's triangles change between two steps.
// Input: a valve that opens, nodes. Output: the largest jump as a fraction of the largest K.
#pragma once

#include <cstdint>
#include <string>

#include "shared/cylinder.hpp"
#include "shared/handles.hpp"

namespace bench {

struct KJump {
  double motion;        // the largest change of K in a step, on triangles so fine that their change does not matter
  double with_adapted;  // the largest difference from the change `motion`, with adapted triangles
  double with_fixed;
};

// Makes n_steps steps of the opening by `step`, from evenly spaced openings. All values are fractions of the largest K.
KJump measure_k_jump(riis_valve *valve, const CylinderNodes &nodes, double step, int n_steps);

}  // namespace bench
