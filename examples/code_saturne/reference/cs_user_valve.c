/* SPDX-License-Identifier: Apache-2.0
 * Makes the reference of ./run code_saturne: the solver's own head-loss zone, without riis. The zone's cells and their K are read
 * from the file named by REFERENCE_CELLS. This file contains all the files cells_*.csv of a run with the valve. */
#include "cs_defs.h"
#include "cs_headers.h"
#include "record.h"
#include "settings.h"

#include <stdio.h>
#include <stdlib.h>

BEGIN_C_DECLS

static cs_lnum_t n_zone;
static cs_lnum_t *zone_cell;
static double *zone_k;

/* Reads the table once, and keeps the cells of this rank. */
static void read_table(void) {
  const char *name = getenv("REFERENCE_CELLS");
  FILE *file = name != NULL ? fopen(name, "r") : NULL;
  if (file == NULL) bft_error(__FILE__, __LINE__, 0, "cannot read REFERENCE_CELLS, '%s'", name != NULL ? name : "");
  const cs_mesh_t *m = cs_glob_mesh;
  double *k_of = calloc((size_t)m->n_g_cells + 1, sizeof *k_of);
  unsigned long long g;
  double x, y, z, k;
  int n_read;
  while ((n_read = fscanf(file, "%llu,%la,%la,%la,%la\n", &g, &x, &y, &z, &k)) == 5) {
    if (g < 1 || g > m->n_g_cells)
      bft_error(__FILE__, __LINE__, 0, "%s has a cell %llu of %llu", name, g, (unsigned long long)m->n_g_cells);
    k_of[g] = k;
  }
  if (n_read != EOF) bft_error(__FILE__, __LINE__, 0, "%s is no list of cells", name);
  fclose(file);
  BFT_MALLOC(zone_cell, m->n_cells, cs_lnum_t);
  BFT_MALLOC(zone_k, m->n_cells, double);
  for (cs_lnum_t c = 0; c < m->n_cells; ++c) {
    g = m->global_cell_num != NULL ? m->global_cell_num[c] : (cs_gnum_t)c + 1;
    if (!(k_of[g] > 0)) continue;
    zone_cell[n_zone] = c;
    zone_k[n_zone++] = k_of[g];
  }
  free(k_of);
}

static void select_cells(void *input, const cs_mesh_t *m, int location_id, cs_lnum_t *n_elts, cs_lnum_t **elt_list) {
  CS_UNUSED(input);
  CS_UNUSED(m);
  CS_UNUSED(location_id);
  if (zone_cell == NULL) read_table();
  *n_elts = n_zone;
  BFT_MALLOC(*elt_list, n_zone, cs_lnum_t);
  for (cs_lnum_t i = 0; i < n_zone; ++i) (*elt_list)[i] = zone_cell[i];
}

void cs_user_zones(void) { cs_volume_zone_define_by_func("table", select_cells, NULL, CS_VOLUME_ZONE_HEAD_LOSS); }

void cs_user_head_losses(const cs_zone_t *zone, cs_real_t cku[][6]) {
  const double density = cs_glob_fluid_properties->ro0;
  if (zone->n_elts != n_zone)
    bft_error(__FILE__, __LINE__, 0, "the zone has %d cells, the table %d", (int)zone->n_elts, (int)n_zone);
  for (cs_lnum_t i = 0; i < zone->n_elts; ++i) {
    for (int k = 0; k < 3; ++k) cku[i][k] = zone_k[i] / density;
    for (int k = 3; k < 6; ++k) cku[i][k] = 0;
  }
}

void cs_user_extra_operations(cs_domain_t *domain) {
  CS_UNUSED(domain);
  record_step();
}

END_C_DECLS
