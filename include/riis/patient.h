/* SPDX-License-Identifier: Apache-2.0 patient.h - valves of a patient: sizes and placement from landmarks, a warp that moves a
 * valve to landmarks, and a skirt that reaches the wall. The header riis.h includes this file, and has the rules that hold for
 * every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_PATIENT_H
#define RIIS_PATIENT_H

#include "surface.h"
#include "queries.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Landmarks: a valve's sizes and placement from points that a person marks in an image ----------------- */

/* The anatomical place of a landmark. A person marks landmarks on the closed valve. The comment of each value below names the
 * kinds of valves, the place, and the permitted number of such landmarks. */
enum {
  RIIS_LANDMARK_COMMISSURE = 0,     /* kinds with cusps: the top of the attachment between two cusps; as many as there are cusps.
                                       tricuspid: the point of the annulus between two leaflets; exactly 3 */
  RIIS_LANDMARK_NADIR = 1,          /* kinds with cusps: the lowest point of a cusp's attachment; as many as there are cusps */
  RIIS_LANDMARK_COAPTATION = 2,     /* kinds with cusps: the point where the closed cusps meet; at most 1. The valve's axis passes
                                       through this point. The height of the point is not used */
  RIIS_LANDMARK_ANNULUS = 3,        /* mitral, mitral_coapting, tricuspid: a point of the annulus; 4 or more, in their order
                                       around the annulus. bileaflet: a point of the housing's circle at mid-height; 3 or more */
  RIIS_LANDMARK_ANTERIOR_HORN = 4,  /* the point of the annulus at the middle of the anterior leaflet. mitral: exactly 1.
                                       mitral_coapting: at most 1; without this point, both commissures and the flow are needed */
  RIIS_LANDMARK_POSTERIOR_HORN = 5, /* mitral, mitral_coapting: the point of the annulus at the middle of the posterior leaflet;
                                       at most 1 */
  RIIS_LANDMARK_TRIGONE = 6,        /* mitral: a trigone, which is a point of the annulus at an end of the length IT_distance; at
                                       most 2. A trigone behind the anterior horn counts only as a point of the annulus
                                       (riis_placement.n_as_annulus) */
  RIIS_LANDMARK_POSTEROMEDIAL = 7,  /* mitral, mitral_coapting: the point of the annulus at the posteromedial commissure; at most
                                       1 */
  RIIS_LANDMARK_ANTEROLATERAL = 8,  /* mitral, mitral_coapting: the point of the annulus at the anterolateral commissure; at most
                                       1 */
  RIIS_LANDMARK_HINGE = 9,          /* bileaflet: an end of a leaflet's hinge line; 2 for one leaflet, or 4 for both */
  RIIS_LANDMARK_ATTACHMENT = 10     /* kinds with cusps: any other point of the attachment; at most 900. The sizes and the
                                       placement do not depend on these points, but a warp can use them
                                       (riis_placement_arrays.place) */
};
/* Landmarks of a patient, in the caller's arrays. */
typedef struct riis_landmarks {
  int64_t struct_size;       /* set by the init function */
  int64_t n_landmarks;       /* 1 to 10,000 */
  const void *x, *y, *z;     /* (n_landmarks) by stride, in mesh units */
  int64_t stride;            /* of x, y and z. Default 1 */
  const int32_t *role;       /* (n_landmarks): RIIS_LANDMARK_* */
  const int32_t *leaflet_id; /* (2, n_landmarks): the ids of up to two leaflets for each landmark. For a nadir or an attachment
                                point, pass the id of its cusp, and -1. For a commissure, pass the ids of its two leaflets in any
                                order. Pass -1 and -1 if the leaflets are not known. NULL: all ids are -1. For an aortic or
                                tricuspid valve, enough ids must be known to name all leaflets. For other kinds with cusps, if no
                                id is known, the cusp of the first nadir becomes cusp 0 */
  double scale;              /* the number of mesh units in a centimetre: 10 for millimetres, 1 for centimetres, or 0.01 for
                                metres. This field must be set */
  double noise;              /* the standard deviation of each coordinate of the landmarks, mesh units, >= 0. Default RIIS_AUTO:
                                0.03 * scale */
  double flow[3];            /* the direction of flow, a vector of any length. Default 0: not known. bileaflet: must be set.
                                mitral: needed unless both commissures or both horns show the side of the atrium. mitral_coapting:
                                needed unless the anterior horn and both commissures are among the landmarks. tricuspid: needed
                                unless the leaflets of two commissures are known */
  int32_t real_bits;         /* of x, y and z */
  int32_t reserved;          /* 0 */
} riis_landmarks;
RIIS_API riis_status riis_landmarks_init(riis_landmarks *landmarks, int64_t struct_size); /* the defaults */

/* Where a parameter's value comes from. */
enum {
  RIIS_SIZE_KEPT = 0,        /* the parameter keeps the valve's own value */
  RIIS_SIZE_DETERMINED = 1,  /* the landmarks determine the parameter. A change of the parameter by its standard error moves the
                                valve by at most a fifteenth of the valve's radius */
  RIIS_SIZE_TIED = 2,        /* no landmark has an influence on the parameter. Its value follows from other sizes by the valve's
                                proportions */
  RIIS_SIZE_UNDETERMINED = 3 /* landmarks have an influence on the parameter but do not determine it, so its value stays near what
                                the valve's proportions give */
};
/* The placement that riis_place finds. To place a surface, copy scale, rotation and translation to the fields of the same names
 * in riis_surface_options. */
typedef struct riis_placement {
  double scale;              /* riis_landmarks.scale. With this scale, the default half thickness of a surface is 0.1 cm */
  double rotation_axis[3];   /* unit vector */
  double rotation_angle;     /* degrees, 0 to 180 */
  double translation[3];     /* mesh units */
  double rms;                /* the root mean square of the residuals (riis_placement_arrays.residual), mesh units */
  double worst;              /* the largest residual, mesh units */
  double noise;              /* the noise that the standard errors are computed from: riis_landmarks.noise, or more if the
                                residuals show more noise */
  double rotation_error;     /* standard error of the rotation, degrees */
  double position_error;     /* standard error of the position of the valve's origin, mesh units */
  int64_t worst_landmark_id; /* the landmark with the largest residual */
  int32_t n_undetermined;    /* the number of parameters with RIIS_SIZE_UNDETERMINED */
  int32_t n_as_annulus;      /* the number of trigones that lie behind the anterior horn. The model has no trigones there, so
                                these landmarks count as points of the annulus, and have no influence on IT_distance */
} riis_placement;
/* The caller's arrays for the results of riis_place. Arrays that are NULL, the default, are not written. */
typedef struct riis_placement_arrays {
  int64_t struct_size;       /* set by the init function */
  double *residual;          /* (n_landmarks): the distance of each landmark from its place on the closed valve, mesh units */
  double *standard_error;    /* (number of parameters, in the order of riis_valve_get_parameter): the standard error of each
                                parameter, in the parameter's unit; infinite for RIIS_SIZE_TIED, 0 for RIIS_SIZE_KEPT */
  int32_t *size_state;       /* (number of parameters): RIIS_SIZE_* */
  double *place;             /* (3, n_landmarks): the places of the landmarks on the closed valve, in mesh units. A warp with
                                these places as sources and the landmarks as targets takes the valve to the landmarks. The place
                                of a commissure is the mean of the ends of its two cusps. The places of attachment points are
                                those with which this warp bends least. Landmarks with equal coordinates on the annulus, or on the
                                attachment of one cusp, have the same place */
} riis_placement_arrays;
RIIS_API riis_status riis_placement_arrays_init(riis_placement_arrays *arrays, int64_t struct_size); /* NULL arrays */
/* Sets a valve's sizes to a patient's sizes, in centimetres, and finds the placement of the valve.
 *   `valve`: a valve of any kind with any parameters. Lengths that no landmark determines keep their proportions. Translation,
 *     opening and the open state of riis_valve_set_open_state do not change.
 *   `held`: the names of the parameters whose values must not change, separated by blanks or commas. "" stands for no name.
 *   `arrays`: the arrays that the call writes. NULL: not wanted.
 * The result minimises the sum of squared distances between the landmarks and their places on the closed valve
 * (docs/theory/landmarks.md). If the landmarks of a bicuspid, coapting or quadricuspid valve show differences above the noise,
 * its cusps get different sectors, with a sum of 360 degrees. In the same way its commissures get different heights, and
 * commissure_height becomes the mean height. If the differences are below the noise, the sectors and the proportions of the
 * heights do not change. For an aortic valve, the call computes rotation and the leaflet angles from the landmarks. If cusps
 * would overlap, the call lowers leaflet_power.
 * Errors: RIIS_INVALID_ARGUMENT if landmarks are missing, too many, in one place, collinear or mirrored, and if they do not show
 * the direction of flow. RIIS_INVALID_ARGUMENT also if the distances between landmarks are too large or too small for a heart
 * valve at this scale. The message names the landmarks. The axis of a tricuspid or mitral_coapting valve must be at most 20
 * degrees from the normal of the annulus. A mitral valve must satisfy three conditions:
 * - The posterior horn is on the posterior side of the annulus, and the trigones are on the anterior side.
 * - The axis of the fitted valve is at most 20 degrees from the annulus' normal.
 * - The fitted AP_diameter differs from the depth of the annulus by at most a twelfth of this depth, or by at most five times the
 *   noise. The depth is measured from the anterior horn to the posterior horn, or if there is no posterior horn, to the farthest
 *   point of the annulus.
 * RIIS_INVALID_PARAMETER for a valve from patches, for an unknown name in `held`, and for sizes that do not fit together. */
RIIS_API riis_status riis_place(riis_valve *valve, const riis_landmarks *landmarks, const char *held,
                                const riis_placement_arrays *arrays, riis_placement *placement,
                                int64_t struct_size);

/* ---- Warp: a valve that meets a patient's landmarks, and moves with them ------------------------------- */

/* A smooth map of space that takes landmarks on a valve, its sources, to landmarks in a patient, its targets. The map is the sum
 * of an affine map and a multiple of |r|^3 for each landmark, where |r| is the distance from the landmark (docs/theory/warp.md).
 * Setting new targets in each time step is fast, because the matrix of the warp is factored only once. */
typedef struct riis_warp riis_warp;

/* Options of riis_warp_create. */
typedef struct riis_warp_options {
  int64_t struct_size; /* set by the init function */
  double noise;        /* the standard deviation of each coordinate of the targets, 0 to 1e50. The map is smoothed until it misses
                          the targets by about this noise. Default 0: the map takes the landmarks exactly to the targets */
  const riis_surface_options *placement; /* the scale, rotation and translation that place the valve in the mesh. Landmarks and
                                            noise are then in mesh coordinates. Use the same placement for the surface. NULL, the
                                            default: landmarks and noise are in the valve's own coordinates */
} riis_warp_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_warp_options_init(riis_warp_options *options, int64_t struct_size);

/* Makes a warp from landmarks on the unwarped valve. The map is the identity until riis_warp_set_targets gives it targets.
 *   `sources`: 3 to 1000 landmarks. If the landmarks lie nearly in a plane (riis_warp_info.is_planar), the map stretches lengths
 *     normal to the plane as much as lengths in the plane. Lines normal to the plane stay normal to it.
 * Errors: RIIS_INVALID_ARGUMENT for a bad landmark or field, if two landmarks coincide, and if all landmarks lie on a line. The
 * message names the landmark or field and its value. */
RIIS_API riis_status riis_warp_create(const riis_points *sources, const riis_warp_options *options, riis_warp **warp);
/* Destroys the warp. Valves with this warp keep their copies. */
RIIS_API void riis_warp_destroy(riis_warp **warp);
/* Sets the targets to which the warp takes its landmarks. Earlier targets have no influence on the map, not even on its last
 * bits.
 *   `targets`: one point for each source, in the order of the sources.
 * Errors: RIIS_INVALID_ARGUMENT for a bad point; the message names the point. RIIS_INVALID_PARAMETER for a warp that folds. To
 * find folds, the call computes the determinant of the map's derivative half way between each landmark and the landmark nearest
 * to it. The warp folds if any of these determinants is 0 or less. A larger noise in the options smooths the map more, and may
 * prevent folds. */
RIIS_API riis_status riis_warp_set_targets(riis_warp *warp, const riis_points *targets);
/* Sets the targets of a warp to the places of the landmarks at a given time. The places are interpolated between the frames of a
 * table.
 *   `frames`: the table, in which n_vertices is the number of landmarks. The call reads the arrays of the table only while it
 *     runs.
 *   `time`: magnitude at most 1e30.
 * Errors: as riis_warp_set_targets. RIIS_INVALID_ARGUMENT also for a bad field, key or landmark; the message names the bad entry
 * and its value. */
RIIS_API riis_status riis_warp_set_targets_at(riis_warp *warp, const riis_keyframe_arrays *frames, double time);

/* How well a warp takes its sources to its targets, in the units of the landmarks. */
typedef struct riis_warp_info {
  int64_t n_landmarks;         /* the number of landmarks */
  double rms_residual;         /* the root mean square of the distances between the mapped sources and their targets. For the
                                  distance of a target from a warped valve, call riis_closest_point */
  double largest_residual;     /* the largest distance between a mapped source and its target */
  int64_t largest_landmark_id; /* the landmark with the largest residual */
  double smoothing;            /* the parameter lambda of the smoothing; 0 without noise, infinite if the map is affine */
  double least_determinant;    /* the least determinant of the map's derivative among the points half way between each landmark
                                  and the landmark nearest to it */
  double least_point[3];       /* the point with the least determinant */
  int32_t is_planar;           /* 1 if the landmarks lie nearly in a plane, else 0 */
  int32_t reserved;            /* 0 */
} riis_warp_info;
/* Tells how well a warp takes its sources to its targets. */
RIIS_API riis_status riis_warp_get_info(const riis_warp *warp, riis_warp_info *info, int64_t struct_size);
/* Moves points by the map of a warp, for example points on the chords of a mitral valve.
 *   `points`: the points, in the coordinates of the landmarks.
 *   `mapped` (3, n_points): the moved points. This may be the array of `points`.
 * Errors: RIIS_INVALID_ARGUMENT for a bad point; the message names the point. */
RIIS_API riis_status riis_warp_map(const riis_warp *warp, const riis_points *points, double *mapped);

/* Warps a valve by one or two maps, which are copied. At every opening the maps move the valve's curves, before the placement.
 *   `closed`: the map at opening 0. If both maps are NULL, the valve loses its warp.
 *   `open`: the map at opening 1. If it is NULL, `closed` is the map at all openings.
 * Between openings 0 and 1 the map is (1 - opening) times `closed` plus opening times `open`. The valve's patches lie between the
 * mapped curves, so error bounds, fixed triangulations and velocities are as for any other valve. The warp may change even with
 * RIIS_TRIANGULATION_FIXED. The curves of the closed valve are cut at the landmarks of `closed`, and the curves of the open valve
 * at the landmarks of `open`. If landmarks lie on its curves, the warped valve therefore passes exactly through the mapped
 * landmarks. For a moving annulus, use two valves in turn. In each step, call riis_warp_set_targets and this function for one of
 * the two valves, and pass both valves to riis_surface_update_moving. Of these two valves, both or neither must have a warp. The
 * warp must not fold at the valve or turn a part of the valve over. Otherwise a call that makes or updates a surface returns
 * RIIS_INVALID_PARAMETER, and its message names the place and the value.
 * Errors: RIIS_INVALID_ARGUMENT for `open` without `closed`. RIIS_INVALID_PARAMETER for a bileaflet valve, which is rigid. */
RIIS_API riis_status riis_valve_set_warp(riis_valve *valve, const riis_warp *closed, const riis_warp *open);

/* ---- Skirt: the gap between the attachment and a wall -------------------------------------------------- */

/* The sizes of the gap between the attachment of a valve and a wall. Lengths are in mesh units. */
typedef struct riis_gap {
  double least, mean, most; /* the least, the mean and the largest gap at the ends of the edges of riis_attachment. The mean is
                               weighted by the lengths of the edges. All three are 0 if no end has a gap */
  double widest_point[3];   /* the coordinates of that end of an edge that has the largest gap */
  int64_t n_ends;           /* the number of ends of edges, 2 * riis_attachment.n_edges */
  int64_t n_without_wall;   /* the number of ends from which a line in the skirt's direction does not meet the wall. These ends
                               have no gap, and count only here and in n_ends */
} riis_gap;
/* Measures the gap between a valve's attachment and a wall, such as a patient's vessel.
 *   `wall`: a surface in the same coordinates as the valve's surface, usually from riis_surface_create_from_arrays.
 *   `distance` (2, n_edges): the array to which the call writes the gap at both ends of each edge of riis_attachment. If an end
 *     has no gap, its entry is RIIS_FAR_DISTANCE. NULL: not wanted.
 * The gap is the distance to the wall in the skirt's direction, which leads outwards from the valve's axis at a right angle
 * (docs/theory/skirt.md). If a line in this direction meets the wall several times, the nearest meeting point counts. The gap is
 * negative if the wall lies inside the attachment.
 * Errors: RIIS_INVALID_ARGUMENT if the surface has no attachment, and if the attachment encloses no area. */
RIIS_API riis_status riis_surface_get_gap(const riis_surface *surface, const riis_surface *wall, double *distance,
                                          riis_gap *gap, int64_t struct_size);
/* Gives a valve a skirt that just reaches a wall. An earlier skirt of the valve is replaced.
 *   `wall`: as in riis_surface_get_gap.
 *   `longest`: the largest permitted length of the skirt, in mesh units, 1e-50 to 1e50.
 *   `options`: only scale, rotation, translation and n_threads are used. NULL stands for the defaults.
 * At each point of the closed valve's attachment, the skirt is as long as the gap, but at least 0.01 times the attachment's mean
 * distance from the axis. These lengths do not change while the valve opens. The parameter "skirt_length" becomes the largest of
 * these lengths before placement. If the caller later sets "skirt_length", the skirt has this length at all points.
 * Errors: RIIS_INVALID_ARGUMENT if the skirt from a point of the attachment does not meet the wall, or would be longer than
 * `longest`. The message names the first such point. RIIS_INVALID_PARAMETER for a bileaflet valve, and for an attachment that
 * encloses no area. */
RIIS_API riis_status riis_valve_set_skirt_to_wall(riis_valve *valve, const riis_surface *wall, double longest,
                                                  const riis_surface_options *options);

#ifdef __cplusplus
}
#endif

#endif
