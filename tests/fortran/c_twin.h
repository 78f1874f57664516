/* SPDX-License-Identifier: Apache-2.0
 * Declares the results that c_twin.c computes for the Fortran tests. The types in c_twin.f90 mirror these structs. */
#ifndef RIIS_TESTS_FORTRAN_C_TWIN_H
#define RIIS_TESTS_FORTRAN_C_TWIN_H

#include <riis/riis.h>

/* The lists of a surface. */
typedef struct twin_surface {
  riis_surface_info info;
  riis_triangles triangles;
} twin_surface;

/* A mesh's rows and the statistics of a marking by walking along them. */
typedef struct twin_walk {
  riis_csr csr;
  riis_mark_stats stats;
} twin_walk;

/* The list of leaking edges. */
typedef struct twin_leaks {
  riis_leak_list list;
  const int64_t *label; /* number of each node's open region */
  int64_t n_regions;
  riis_passage passage; /* the passage from the first node to the last one */
} twin_leaks;

/* An aortic valve that opens, and the results that use its fields. */
typedef struct twin_motion {
  twin_surface surface;
  riis_direction direction; /* the second one */
  riis_mark_list marked, within_limit;
  const double *coefficient, *momentum; /* (n_nodes), (3, n_nodes) */
  double force[30];
  riis_band_sums sums;
  twin_surface framed; /* the surface at half the time between two frames of a square */
} twin_motion;

/* Results of the laws of opening. */
typedef struct twin_laws {
  double by_table[2], by_times[2]; /* opening and its rate */
  riis_opening_switch_state by_switch;
  riis_opening_angle_state by_angle;
} twin_laws;

/* All results of the calls of twin_run. Pointers stay valid until twin_end. */
typedef struct twin_numbers {
  int64_t n_parameters;
  const riis_parameter *parameters; /* (n_parameters) */
  twin_surface aortic;
  twin_surface mitral;     /* half open */
  twin_surface opening;    /* the aortic valve, between its two states */
  twin_surface patches;    /* a valve from patches */
  riis_closest closest;    /* the first node's closest point on the aortic valve */
  riis_closest_arrays all; /* all nodes' closest points on the surface from arrays */
  riis_mark_list marked, within_limit;
  const uint8_t *dense_mark;
  const double *dense_distance;
  const int64_t *dense_triangle_id;
  const int32_t *dense_leaflet_id;
  riis_mark_stats stats;
  twin_walk cells, faces, grid; /* marked by RIIS_SEARCH_NEIGHBOR */
  riis_mark_stats paper;        /* of a marking by RIIS_SEARCH_PAPER along the grid */
  twin_leaks leaks;             /* the leaks of a thin aortic valve, along the tetrahedra */
  riis_crossing_list crossings; /* the crossings of an aortic valve with one cusp turned */
  twin_motion motion;
  twin_laws laws;
} twin_numbers;

/* Makes the calls of test_calls.f90 from C, on its grid of per_side^3 nodes. Returns the first status that is not RIIS_OK. */
riis_status twin_run(int64_t per_side, const double *xyz, twin_numbers *numbers);
void twin_end(void);

double twin_auto(void);
double twin_far_distance(void);

#endif
