/* SPDX-License-Identifier: Apache-2.0 Laminar flow of blood, with a constant time step. */
#include "cs_defs.h"
#include "cs_headers.h"
#include "settings.h"

BEGIN_C_DECLS

void cs_user_model(void) { cs_get_glob_turb_model()->iturb = CS_TURB_NONE; }

void cs_user_parameters(cs_domain_t *domain) {
  cs_get_glob_time_step_options()->idtvar = 0;
  domain->time_step->dt_ref = setting("RUN_DT");
  domain->time_step->nt_max = (int)setting("RUN_STEPS");
  cs_fluid_properties_t *fluid = cs_get_glob_fluid_properties();
  fluid->ro0 = 1060;
  fluid->viscl0 = 0.004;
  fluid->p0 = 0; /* the pressures of this study are relative */
  if (setting("RUN_CHECKPOINT") > 0) cs_restart_checkpoint_set_next_ts((int)setting("RUN_CHECKPOINT"));
}

END_C_DECLS
