/* SPDX-License-Identifier: Apache-2.0 */
#include "settings.h"

#include "cs_defs.h"
#include "cs_headers.h"

#include <stdlib.h>
#include <string.h>

static const struct {
  const char *name;
  double fallback, lowest, highest;
} numbers[] = {
    /* The number of the last time step, which counts from the start even after a restart. */
    {"RUN_STEPS", 10, 1, 1e6},
    {"RUN_DT", 0.002, 1e-9, 1}, /* s */
    /* A time step after which a checkpoint is written, in addition to the last time step. */
    {"RUN_CHECKPOINT", 0, 0, 1e6},
    {"RUN_INFLOW", 0, 0, 10},                 /* m/s at the inlet; 0: pressures at the inlet and the outlet */
    {"RUN_CELLS_EVERY", 0, 0, 1e6},           /* steps from one list of marked cells to the next; 0: none */
    {"RUN_SLICE_EVERY", 0, 0, 1e6},           /* steps from one slice to the next; 0: none */
    {"VALVE_PRESENT", 1, 0, 1},               /* 0: the root has no valve */
    {"VALVE_OPENING", -1, -1, 1},             /* 0 to 1: the opening is constant; -1: the pressures move the valve */
    {"VALVE_RESISTANCE", 20, 0, 1e9},         /* R in kg/(m s) */
    {"VALVE_HALF_THICKNESS", 0.002, 1e-6, 1}, /* eps in m */
    {"VALVE_VELOCITY", 1, 0, 1},              /* 0: u_surface is left out of K (u - u_surface) */
    {"VALVE_Z", 0, -1, 1},                    /* m by which the valve is shifted along the root */
};

double setting(const char *name) {
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
    if (strcmp(name, numbers[i].name) != 0) continue;
    const char *text = getenv(name);
    if (text == NULL) return numbers[i].fallback;
    char *end = NULL;
    const double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= numbers[i].lowest && value <= numbers[i].highest))
      bft_error(__FILE__, __LINE__, 0, "%s is '%s', but must be a number from %g to %g", name, text, numbers[i].lowest,
                numbers[i].highest);
    return value;
  }
  bft_error(__FILE__, __LINE__, 0, "there is no setting '%s'", name);
  return 0;
}

const char *valve_kind(void) {
  const char *kind = getenv("VALVE_KIND");
  return kind != NULL ? kind : "trileaflet";
}
