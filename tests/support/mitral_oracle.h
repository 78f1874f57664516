/* SPDX-License-Identifier: Apache-2.0
 * Evaluates the smooth mitral valve independently of the library. The oracle computes each point from the paper's appendix, as
 * corrected in docs/theory/mitral.md, in extended precision. A "row" is a row of the table in docs/theory/mitral.md. The oracle
 * has no polylines and no tolerance, and shares no code with the library. */
#ifndef RIIS_TEST_MITRAL_ORACLE_H
#define RIIS_TEST_MITRAL_ORACLE_H

/* The parameters of the paper's table. All lengths have one unit, and angles are in degrees. The functions do not check the
 * parameters. Results are meaningful if 2 triangle_size_ratio < anterior_ratio < 1 and 0 < leaflet_arc_angle < 360. */
typedef struct mitral_parameters {
  double anterior_ratio, AP_diameter, ALPM_diameter, ALPM_position_ratio, IT_distance, indent_depth;
  double anterior_horn_height, posterior_horn_height;
  double anterior_length, posteromedial_commissure_height, posterior_scallop_length1, posterior_scallop_length2;
  double leaflet_arc_angle, leaflet_inward_angle, surface_angle, triangle_size_ratio;
  double opening, translation[3];
} mitral_parameters;

typedef struct mitral_oracle mitral_oracle;

/* Returns the paper's values, with opening 1 and translation 0 0 1. */
mitral_parameters mitral_defaults(void);

/* Makes the valve at the opening closed->opening, and ignores open->opening. The control points of the closed state come from
 * *closed, and those of the open state from *open. The control points, anterior_ratio, triangle_size_ratio, tan(surface_angle),
 * the translation and the cleft's parameter are interpolated linearly. For a valve with one set of parameters, pass this set
 * twice. Returns NULL if memory runs out. */
mitral_oracle *mitral_oracle_create(const mitral_parameters *closed, const mitral_parameters *open);
void mitral_oracle_destroy(mitral_oracle *oracle);

/* Give A(u), A'(u) = dA/du and L(u) before the translation, for u in [0, 1]. */
void mitral_oracle_annulus(const mitral_oracle *oracle, double u, double *point);
void mitral_oracle_annulus_derivative(const mitral_oracle *oracle, double u, double *derivative);
void mitral_oracle_leaflet(const mitral_oracle *oracle, double u, double *point);

/* Gives D(u, v) after the translation. v is 0 on the annulus and 1 on the leaflet's free edge. */
void mitral_oracle_point(const mitral_oracle *oracle, double u, double v, double *point);

/* The parameters at the seam and where L'(u) jumps, in ascending order: 0, cleft, u_pm, u_pm + r_tr, u_al - r_tr, u_al, cleft,
 * 1. */
enum { MITRAL_ORACLE_BREAKS = 8 };
void mitral_oracle_breaks(const mitral_oracle *oracle, double *u);

/* Returns the parameter u of the cleft on the posteromedial side, where the cleft meets the closed anterior edge. */
double mitral_oracle_anterior_cleft(const mitral_oracle *oracle);

double mitral_oracle_annulus_length(const mitral_oracle *oracle);
double mitral_oracle_anterior_length(const mitral_oracle *oracle);             /* the length of the curve L_at */
double mitral_oracle_scallop_length(const mitral_oracle *oracle, int scallop); /* scallops 0, 1, 2 from pm to al */

/* Returns the area of triangles, with n_u steps between neighbouring breaks and n_v steps of v. The error of the area is
 * O(n^-2). */
double mitral_oracle_area(const mitral_oracle *oracle, int n_u, int n_v);

#endif
