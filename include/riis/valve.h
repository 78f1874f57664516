/* SPDX-License-Identifier: Apache-2.0
 * valve.h - valves: a kind and its parameters, or the caller's own patches.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_VALVE_H
#define RIIS_VALVE_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Valve: named parameters (paper, tables "Aortic valve parameters" and "Mitral valve parameters"), or patches */

/* A parametric valve: a kind, and values for the parameters of this kind. riis_surface_create makes the geometry. */
typedef struct riis_valve riis_valve;

/* Makes a valve with the default parameter values. For "aortic" and "mitral" the defaults come from the paper.
 *   `kind`: one of these names (docs/theory.md). Any other name gives RIIS_INVALID_PARAMETER.
 *     - "aortic" and "mitral", the paper's three cusps and two leaflets
 *     - "coapting", "bicuspid" and "quadricuspid", three, two and four cusps with a zone of coaptation
 *     - "tricuspid" and "mitral_coapting", three and two leaflets of an annulus, with a zone of coaptation
 *     - "trileaflet", three equal cusps that close in straight lines
 *     - "bileaflet", a mechanical prosthesis. */
RIIS_API riis_status riis_valve_create(const char *kind, riis_valve **valve);
/* Makes a copy of a valve, including its parameters, patches and open state. The caller destroys both valves. */
RIIS_API riis_status riis_valve_copy(const riis_valve *valve, riis_valve **copy);
/* Destroys the valve. Surfaces that were made from the valve do not change. Valves with this valve as their open state do not
 * change either. */
RIIS_API void riis_valve_destroy(riis_valve **valve);

/* Sets a parameter by its name. This call checks only the range of the values; riis_surface_create checks whether all parameters
 * fit together.
 *   `name`: such as "root_radius". A name such as "right.leaflet_angle", "commissure_0.fusion" or "bump_0.open" sets a parameter
 *     of one part. The name "leaflet_angle" without a part sets this parameter for all parts. However, if the whole valve also
 *     has a parameter of the name, only the whole valve's parameter is set.
 *   `n_values`: the number of values: 3 for translation (x, y, z), 3 for rotation, t0_* and t3_* (right, left, non-coronary
 *     cusp), and 1 for all other parameters.
 *   `values` (n_values): the values, within the parameter's range.
 * Two parameters change the whole valve:
 * - "opening", 0 to 1, moves the valve from its closed to its open state. The other parameters describe the closed and the open
 *   state. The default opening is 1 (open) for "mitral", and 0 for other kinds. An "aortic" valve at opening 0 has the paper's
 *   closed state, which leaves a hole. A valve from patches can have only opening 0 until riis_valve_set_open_state gives it an
 *   open state. To move a valve, set "opening" and call riis_surface_update.
 * - "skirt_length" gives any valve except "bileaflet" a skirt. The skirt is a strip that leads outwards from the attachment and
 *   closes the gap to the wall (docs/theory/skirt.md). The length is 0 (the default), or 1e-4 to 10 times the attachment's mean
 *   distance from its axis. The skirt_length of an open state is ignored.
 * Errors: RIIS_INVALID_PARAMETER for a bad name or value; the message names the parameter and the value. */
RIIS_API riis_status riis_valve_set(riis_valve *valve, const char *name, int64_t n_values,
                                    const double *values);
/* Sets a parameter that has one value. Arguments and errors are as in riis_valve_set. */
RIIS_API riis_status riis_valve_set_scalar(riis_valve *valve, const char *name, double value);
/* Copies the values of a parameter to the caller's array. Arguments are as in riis_valve_set.
 * Errors: RIIS_INVALID_PARAMETER for an unknown name, and for a name that stands for a parameter of several cusps. */
RIIS_API riis_status riis_valve_get(const riis_valve *valve, const char *name, int64_t n_values,
                                    double *values);

/* Surgeons' names of sizes, and sizes that follow from other sizes (docs/theory/sizes.md). Each of the three names below stands
 * for a parameter or for twice a parameter. If a kind of valve lacks the size, calls refuse its name, and the message says why.
 * The names are:
 *   `annulus`: the diameter of the annulus, 2 root_radius (kinds with cusps) or 2 radius (bileaflet).
 *   `stj`: the diameter at the commissures, 2 leaflet_radius_out (aortic, trileaflet) or 2 commissure_radius (coapting, bicuspid,
 *     quadricuspid).
 *   `effective_height`: the height of the free edges above the annulus, leaflet_height (aortic, trileaflet). The other kinds with
 *     cusps have a parameter of the name effective_height: the height of the middle of the free edges above the annulus.
 * Some parameters have a rule. Until such a parameter is set, the rule computes its value from other parameters. Parameters may
 * be set in any order. riis_valve_get also gives values that come from a rule. A copy of a valve, also one that is an open state,
 * stores which parameters were set. */

/* Undoes riis_valve_set: the parameter gets the value of its rule again, or its default if it has no rule.
 *   `name`: as in riis_valve_set.
 * Errors: RIIS_INVALID_PARAMETER for an unknown name. */
RIIS_API riis_status riis_valve_unset(riis_valve *valve, const char *name);
/* Tells whether a parameter was set.
 *   `name`: as in riis_valve_get.
 *   `is_set`: 1 if the parameter was set; 0 if its value is the default or comes from its rule.
 * Errors: RIIS_INVALID_PARAMETER for an unknown name, and for a name that stands for a parameter of several cusps. */
RIIS_API riis_status riis_valve_is_set(const riis_valve *valve, const char *name, int32_t *is_set);

/* Gives a valve an open state. The valve then has its own shape at opening 0, and the shape of the valve `open` at opening 1.
 *   `open`: a valve of the same kind, which is copied. The opening, leaflet ids and open state of `open` are ignored. If the
 *     valves come from patches, `open` must have the same curves, sides and degrees (degree 1 may stand for degree 2). Two
 *     bileaflet valves must both have a ring, or both lack it.
 * A second call replaces the open state. No call removes an open state. At openings between 0 and 1, control points are
 * interpolated linearly between the two states (docs/theory/openings.md). For bileaflet valves, lengths and angles are
 * interpolated instead. The middle of a coapting cusp's free edge hangs as low as the length of the free edge requires. For all
 * kinds except aortic and bileaflet, the valve's own parameters give the closed shape, and the parameters of `open` give the open
 * shape.
 * Errors: RIIS_INVALID_PARAMETER if `open` has another kind, or other curves, degrees or sides. */
RIIS_API riis_status riis_valve_set_open_state(riis_valve *valve, const riis_valve *open);

/* The caller's own valve, such as a prosthesis. The valve consists of Coons patches, each with four boundary curves (paper, 3.3).
 * - The sides v = 0 and v = 1 run from the side u = 0 to the side u = 1.
 * - The sides u = 0 and u = 1 run from the side v = 0 to the side v = 1.
 * - At a corner, the ends of two sides may differ by at most 1e-9 of the valve's size. A side may consist of a single point.
 * - Normals point along S_u x S_v.
 * - Patches that share a curve meet along this curve without cracks. */
typedef struct riis_patches {
  int64_t struct_size;       /* set by the init function */
  int64_t n_curves;          /* the number of curves, 1 to 4,000,000. Each curve is a side of a patch */
  const int32_t *degree;     /* (n_curves): 1, 2 or 3. Each curve is a Bezier curve with degree + 1 control points */
  const double *control;     /* (3, the sum of degree + 1 over all curves): the control points, curve after curve; finite, at most
                                1e30 in magnitude */
  int64_t n_patches;         /* 1 to 1,000,000 */
  const int32_t *curve_id;   /* (4, n_patches): the curves at v = 0, v = 1, u = 0, u = 1 */
  const int32_t *reversed;   /* (4, n_patches): 1 if the side runs opposite to the direction of its curve, else 0; NULL: all 0 */
  const int32_t *leaflet_id; /* (n_patches), >= 0; NULL: all 0 */
  int32_t index_base;        /* of curve_id */
  int32_t reserved;          /* 0 */
} riis_patches;
RIIS_API riis_status riis_patches_init(riis_patches *patches, int64_t struct_size); /* the defaults */

/* Makes a valve from patches, which are copied. The valve's parameters are "opening" and "skirt_length". If the valve has a
 * skirt, the skirt continues each side v = 0 that belongs to only one patch. The patch_id of a triangle is the number of its
 * patch, counted from 0.
 * Errors: RIIS_INVALID_PARAMETER for a bad curve or patch, for example for a patch whose sides do not meet. The message names the
 * curve or patch and its value. */
RIIS_API riis_status riis_valve_create_from_patches(const riis_patches *patches, riis_valve **valve);

/* The description of a parameter. The texts are static. */
typedef struct riis_parameter {
  const char *name;        /* the name as riis_valve_set takes it */
  const char *unit;        /* "length", "degree" or "1" */
  const char *description; /* one line */
  int64_t n_values;        /* 1 or 3 */
  double default_values[3];/* entries beyond n_values are 0 */
  double minimum;          /* the least permitted number for each value, inclusive */
  double maximum;          /* the largest permitted number for each value, inclusive */
  const char *rule;        /* the rule for the value of a parameter that was not set, such as "0.5 leaflet_height". "": the value
                              is the default */
  const char *other_name;  /* a second name that riis_valve_set takes, such as "annulus". "": there is none */
  double other_factor;     /* the value under other_name divided by the parameter's value: 1 or 2; 0 without other_name */
} riis_parameter;
/* Gives the number of the valve's parameters. */
RIIS_API riis_status riis_valve_get_n_parameters(const riis_valve *valve, int64_t *n_parameters);
/* Gives the description of a parameter.
 *   `parameter_id`: 0 to n_parameters - 1. */
RIIS_API riis_status riis_valve_get_parameter(const riis_valve *valve, int64_t parameter_id,
                                              riis_parameter *parameter, int64_t struct_size);

/* The curves and patches of a valve at its present opening, after the warp and before the placement. If n_pieces equals n_curves,
 * the arrays of this struct can be passed as riis_patches, and give a valve of the same shape. In trileaflet and aortic valves,
 * and in valves from patches, each curve is one piece. If the valve has a warp, landmarks on the curves add pieces
 * (riis_valve_set_warp). */
typedef struct riis_valve_patches {
  int64_t n_curves;           /* the number of curves. Each curve is a side of a patch */
  int64_t n_pieces;           /* the number of Bezier pieces of all curves. Sides of mitral and bileaflet patches may have several
                                 pieces */
  const int64_t *first_piece; /* (n_curves + 1): the pieces of curve i are first_piece[i] to first_piece[i + 1] - 1 */
  const int32_t *degree;      /* (n_pieces): 2 or 3 */
  const double *control;      /* (3, the sum of degree + 1 over all pieces): the control points, piece after piece */
  int64_t n_patches;          /* the number of patches */
  const int32_t *curve_id;    /* (4, n_patches): the curves at v = 0, v = 1, u = 0, u = 1 */
  const int32_t *reversed;    /* (4, n_patches): 1 if the side runs opposite to the direction of its curve, else 0 */
  const int32_t *leaflet_id;  /* (n_patches): as in riis_triangles */
  const int32_t *patch_id;    /* (n_patches): as in riis_triangles */
  const int32_t *attached;    /* (n_patches): the side that is attached, 0 to 3 in the order of curve_id; -1 if no side is
                                 attached */
  const double *bulge;        /* (n_patches): 0 for a Coons patch. If the bulge is not 0, the line at each u is an arc from v = 0
                                 to v = 1. Let W be the vector from the start to the end of the arc, and T the unit tangent of the
                                 side v = 0. The middle control point of the arc is the midpoint of start and end plus bulge |W|
                                 unit(W x T) */
} riis_valve_patches;
/* Gives the curves and patches of a valve at its present opening. The arrays are valid until the next call that may change the
 * valve. Along a side, u or v of a point is the length from the side's start to this point, divided by the length of the side.
 * The normals S_u x S_v have the directions in the comment of riis_surface_create. A mitral patch has a bulge, so it differs from
 * the Coons patch with the same sides.
 * Errors: RIIS_INVALID_PARAMETER as riis_surface_create. */
RIIS_API riis_status riis_valve_get_patches(riis_valve *valve, riis_valve_patches *patches, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
