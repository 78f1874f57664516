/* SPDX-License-Identifier: Apache-2.0
 * Records the measurements of ./run code_saturne. A user's own case does not need these files. */
#ifndef RECORD_H
#define RECORD_H

#include <stdint.h>

/* Records the valve in this time step.
 *   n_marked     number of marked cells of this rank
 *   cell_id      (n_marked), from 0
 *   coefficient  K of every cell of this rank
 *   opening      the opening in this time step
 *   seconds      wall time of the calls of riis in this time step */
void record_valve(int64_t n_marked, const int64_t *cell_id, const double *coefficient, double opening, double seconds);

/* Appends a line to history.csv, and writes the lists and slices that the settings request. Called at the end of a time step. */
void record_step(void);

/* Returns a wall clock in seconds. */
double record_clock(void);

#endif
