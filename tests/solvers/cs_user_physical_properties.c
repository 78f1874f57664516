/* SPDX-License-Identifier: Apache-2.0
 * Makes the solver diverge: from the third time step on, its pressures are NaN. Only tests use this file. */
#include "cs_defs.h"
#include "cs_headers.h"

#include <math.h>

BEGIN_C_DECLS

void cs_user_physical_properties(cs_domain_t *domain) {
  if (domain->time_step->nt_cur < 3) return;
  for (cs_lnum_t c = 0; c < cs_glob_mesh->n_cells; ++c) CS_F_(p)->val[c] = NAN;
}

END_C_DECLS
