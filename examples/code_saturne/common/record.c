/* SPDX-License-Identifier: Apache-2.0 */
#include "record.h"

#include "cs_defs.h"
#include "cs_headers.h"
#include "settings.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* Numbers of the valve in this time step, set by record_valve. */
static int64_t n_marked;
static const int64_t *cell_id;
static const double *coefficient;
static double opening, valve_seconds;

void record_valve(int64_t n, const int64_t *id, const double *k, double o, double seconds) {
  n_marked = n;
  cell_id = id;
  coefficient = k;
  opening = o;
  valve_seconds = seconds;
}

double record_clock(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static cs_gnum_t global_number(int64_t cell) {
  const cs_gnum_t *numbers = cs_glob_mesh->global_cell_num;
  return numbers != NULL ? numbers[cell] : (cs_gnum_t)cell + 1;
}

/* Mixes the bits of a number, so that a sum over cells depends on all cells but not on their order. The function is the last step
 * of MurmurHash3. */
static cs_gnum_t mix(cs_gnum_t x) {
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdULL;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

static cs_gnum_t bits(double x) {
  cs_gnum_t b;
  memcpy(&b, &x, sizeof b);
  return b;
}

static FILE *open_file(const char *name, const char *mode) {
  FILE *file = fopen(name, mode);
  if (file == NULL) bft_error(__FILE__, __LINE__, 0, "cannot write %s", name);
  return file;
}

static void close_file(FILE *file, const char *name) {
  const int failed = ferror(file);
  if (fclose(file) != 0 || failed) bft_error(__FILE__, __LINE__, 0, "cannot write %s", name);
}

/* Writes this rank's marked cells with the bits of their centres and of K. */
static void write_cells(int step) {
  char name[64];
  snprintf(name, sizeof name, "cells_%05d.%d.csv", step, cs_glob_rank_id < 0 ? 0 : cs_glob_rank_id);
  FILE *file = open_file(name, "w");
  const cs_real_t *centre = cs_glob_mesh_quantities->cell_cen;
  for (int64_t i = 0; i < n_marked; ++i) {
    const int64_t c = cell_id[i];
    fprintf(file, "%llu,%a,%a,%a,%a\n", (unsigned long long)global_number(c), centre[3 * c], centre[3 * c + 1],
            centre[3 * c + 2], coefficient[c]);
  }
  close_file(file, name);
}

/* Writes this rank's cells within a millimetre of the plane y = 0. */
static void write_slice(int step) {
  char name[64];
  snprintf(name, sizeof name, "slice_%05d.%d.csv", step, cs_glob_rank_id < 0 ? 0 : cs_glob_rank_id);
  FILE *file = open_file(name, "w");
  const cs_real_t *centre = cs_glob_mesh_quantities->cell_cen;
  const cs_real_3_t *u = (const cs_real_3_t *)CS_F_(vel)->val;
  for (cs_lnum_t c = 0; c < cs_glob_mesh->n_cells; ++c)
    if (fabs(centre[3 * c + 1]) < 0.001)
      fprintf(file, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", centre[3 * c], centre[3 * c + 2], u[c][0], u[c][1], u[c][2],
              CS_F_(p)->val[c]);
  close_file(file, name);
}

void record_step(void) {
  static double end_of_last_step;
  const cs_mesh_t *m = cs_glob_mesh;
  const cs_mesh_quantities_t *q = cs_glob_mesh_quantities;
  const cs_time_step_t *ts = cs_glob_time_step;
  const cs_real_t *p = CS_F_(p)->val;
  const cs_real_3_t *u = (const cs_real_3_t *)CS_F_(vel)->val;
  const double now = record_clock();
  double seconds[2] = {valve_seconds, end_of_last_step > 0 ? now - end_of_last_step : 0};

  cs_gnum_t sums[4] = {(cs_gnum_t)n_marked, 0, 0, 0};
  double integral = 0;
  for (int64_t i = 0; i < n_marked; ++i) {
    const int64_t c = cell_id[i];
    const cs_gnum_t g = global_number(c);
    sums[1] += mix(g);
    sums[2] += mix(g ^ mix(bits(coefficient[c])));
    for (int k = 0; k < 3; ++k) sums[3] += mix(g ^ mix(bits(q->cell_cen[3 * c + k]) + (cs_gnum_t)k));
    integral += coefficient[c] * q->cell_vol[c];
  }
  /* Sums the pressures over slabs of the tubes and the flow through the upstream slab, and finds the largest speed. */
  double slab[5] = {0}, fastest = 0;
  for (cs_lnum_t c = 0; c < m->n_cells; ++c) {
    const double z = q->cell_cen[3 * c + 2], v = q->cell_vol[c];
    if (z > -0.022 && z < -0.018) {
      slab[0] += p[c] * v;
      slab[1] += v;
      slab[2] += u[c][2] * v;
    } else if (z > 0.010 && z < 0.014) {
      slab[3] += p[c] * v;
      slab[4] += v;
    }
    fastest = fmax(fastest, cs_math_3_norm(u[c]));
  }
  cs_parall_counter(sums, 4);
  cs_parall_sum(1, CS_DOUBLE, &integral);
  cs_parall_sum(5, CS_DOUBLE, slab);
  cs_parall_max(1, CS_DOUBLE, &fastest);
  cs_parall_max(2, CS_DOUBLE, seconds);

  if (cs_glob_rank_id <= 0) {
    FILE *file = open_file("history.csv", end_of_last_step > 0 ? "a" : "w");
    if (!(end_of_last_step > 0))
      fprintf(file,
              "step,time,opening,cells,marked,ids,resistances,centres,integral,upstream,downstream,flow,fastest,"
              "seconds_riis,seconds\n");
    fprintf(file, "%d,%.17g,%.17g,%llu,%llu,%016llx,%016llx,%016llx,%.17g,%.17g,%.17g,%.17g,%.17g,%.6f,%.6f\n",
            ts->nt_cur, ts->t_cur, opening, (unsigned long long)m->n_g_cells, (unsigned long long)sums[0],
            (unsigned long long)sums[1], (unsigned long long)sums[2], (unsigned long long)sums[3], integral,
            slab[0] / slab[1], slab[3] / slab[4], slab[2] / 0.004, fastest, seconds[0], seconds[1]);
    close_file(file, "history.csv");
  }
  const int cells_every = (int)setting("RUN_CELLS_EVERY"), slice_every = (int)setting("RUN_SLICE_EVERY");
  if (cells_every > 0 && ts->nt_cur % cells_every == 0) write_cells(ts->nt_cur);
  if (slice_every > 0 && ts->nt_cur % slice_every == 0) write_slice(ts->nt_cur);
  end_of_last_step = record_clock();
}
