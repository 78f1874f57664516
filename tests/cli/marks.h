/* SPDX-License-Identifier: Apache-2.0
 *
 * Compares riis's marks with the marks of the C interface on the mesh in.vtu of the scratch folder. */
#ifndef RIIS_TESTS_MARKS_H
#define RIIS_TESTS_MARKS_H

#include <riis/riis.h>

#include "program.h"

typedef struct expected_marks {
  riis_surface *surface;
  uint8_t marked[n_box];
  double distance[n_box];
  int32_t leaflet[n_box];
  riis_mark_stats stats;
} expected_marks;

/* The result of the last mark_by_c. */
extern expected_marks by_c;

void mark_by_c(const riis_valve *valve, const riis_surface_options *surface_options, double distance_limit,
               double far_distance);

/* Checks that out.vtu has the mesh of in.vtu with points as doubles, and the expected marks. More than 20 nodes must be
   marked. */
void expect_marked_mesh(void);
/* Checks that out.vtp is the expected surface. */
void expect_surface_output(void);

void forget_marks(void);

#endif
