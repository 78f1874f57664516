/* SPDX-License-Identifier: Apache-2.0
 * queries.h - queries of a surface: its closest points to given points, and places where it goes through itself.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_QUERIES_H
#define RIIS_QUERIES_H

#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Closest points (paper, 4.1) ----------------------------------------------------------------------- */

/* The point of the surface that is closest to a given point. For closest points by sampling or minimisation, see
 * RIIS_MEASURE_*. */
typedef struct riis_closest {
  double distance;        /* >= 0, mesh units */
  double point[3];        /* the closest point, on the triangle triangle_id, mesh units */
  double barycentric[3];  /* the closest point's weights for the triangle's vertices, >= 0, with sum 1 */
  double normal[3];       /* unit normal of the triangle, by the right-hand rule */
  int64_t triangle_id;    /* the id of the closest triangle. Of several equally close triangles, the one with the lowest id
                             counts */
  int32_t leaflet_id;     /* of the triangle */
  int32_t side;           /* +1 if the given point is on the side to which normals point (downstream), -1 if it is on the other
                             side. The side is 0 for a point on the surface, and for a point where the surface would continue
                             beyond its rim. If the closest point is on an edge or vertex of several triangles, the angle-weighted
                             mean of their normals gives the side (Baerentzen, Aanaes 2005). Vertices with equal coordinates after
                             placement count as one vertex */
} riis_closest;
/* Finds the point of the surface that is closest to a given point, however far away, in double precision. The result is the same
 * as from a loop over all triangles. Distances below 1e-154 underflow to 0.
 *   `point`: the given point: 3 finite coordinates, each at most 1e60 in magnitude.
 * Errors: RIIS_INVALID_ARGUMENT for a bad coordinate; the message names the coordinate. */
RIIS_API riis_status riis_closest_point(const riis_surface *surface, const double *point, riis_closest *closest,
                                        int64_t struct_size);

/* The distance that points beyond a limit get by default. It is finite, so that calculations with it raise no floating-point
 * exceptions. */
#define RIIS_FAR_DISTANCE 1.0e30

/* Options of riis_closest_points. */
typedef struct riis_closest_options {
  int64_t struct_size;       /* set by the init function */
  double distance_limit;     /* >= 0, default infinity. Points beyond this limit get far_distance as their distance, -1 as ids,
                                and 0 in all other fields */
  double far_distance;       /* the distance that points beyond the limit get. It must be outside [0, distance_limit]. Default
                                RIIS_FAR_DISTANCE */
  const uint8_t *point_mask; /* (n_points): 0 leaves a point out, so that the point gets no result. The coordinates of the point
                                must still be finite. NULL: no mask */
  int64_t n_point_ids;       /* the length of point_ids, or 0 if point_ids is NULL */
  const int64_t *point_ids;  /* (n_point_ids): the ids of the wanted points, strictly ascending, 0 to n_points - 1. The call reads
                                only these points, and writes only their entries. NULL: all points. Only one of point_ids and
                                point_mask may be set */
  int32_t n_threads;         /* default 0 */
  int32_t reserved;          /* 0 */
} riis_closest_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_closest_options_init(riis_closest_options *options, int64_t struct_size);

/* The caller's arrays for the fields of riis_closest. Pass NULL for fields that are not wanted. */
typedef struct riis_closest_arrays {
  int64_t struct_size;    /* set by the init function */
  double *distance;       /* (n_points) */
  double *point;          /* (3, n_points) */
  double *barycentric;    /* (3, n_points) */
  double *normal;         /* (3, n_points) */
  int64_t *triangle_id;   /* (n_points) */
  int32_t *leaflet_id;    /* (n_points) */
  int32_t *side;          /* (n_points) */
} riis_closest_arrays;
/* Fills *arrays with NULL. */
RIIS_API riis_status riis_closest_arrays_init(riis_closest_arrays *arrays, int64_t struct_size);

/* Finds the closest point of the surface for each of many points, in parallel.
 *   `arrays`: the arrays that the call writes. These arrays must overlap neither each other nor the coordinates.
 * Errors: RIIS_INVALID_ARGUMENT for a bad point; the message names the first bad point, and nothing is written. */
RIIS_API riis_status riis_closest_points(const riis_surface *surface, const riis_points *points,
                                         const riis_closest_options *options,
                                         const riis_closest_arrays *arrays);

/* ---- Crossings: self-intersections, where the surface goes through itself ------------------------------ */

/* Options of riis_find_crossings. */
typedef struct riis_crossing_options {
  int64_t struct_size; /* set by the init function */
  double depth;        /* the largest depth of a pair of triangles that counts as touching, in half thicknesses, 0 to 1. Default
                          1e-6 */
  int32_t n_threads;   /* default 0 */
  int32_t reserved;    /* 0 */
} riis_crossing_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_crossing_options_init(riis_crossing_options *options, int64_t struct_size);

/* The pairs of triangles that riis_find_crossings found. Make one object, and pass this object to every call of
 * riis_find_crossings. */
typedef struct riis_crossings riis_crossings;
RIIS_API riis_status riis_crossings_create(riis_crossings **crossings); /* makes an object without pairs */
RIIS_API void riis_crossings_destroy(riis_crossings **crossings); /* destroys the crossings and their list */

/* Finds every pair of the surface's triangles that go through each other.
 *   `options`: two triangles cross if the depth of the pair is more than options->depth. If the depth is within the rounding
 *     error, they only touch. The rounding error is 2^-24 of their longest edge plus 2^-46 of the surface's largest coordinate.
 *   `crossings`: its content is replaced.
 * The depth of a pair of triangles is the length of the shortest shift of one triangle after which the two only touch
 * (docs/theory/crossings.md). Triangles that touch or lie in one plane have depth 0. Triangles of one leaflet that share a vertex
 * (equal coordinates after placement) are neighbours, and do not count as a pair. The call always tests the triangles, even if
 * the surface measures distances by sampling or minimisation. Where the smooth leaflets only touch, their triangles may cross as
 * deep as twice riis_surface_info.error_bound. If a log function is set (riis_set_log), it also gets warnings of deeper crossings
 * when a surface is made or updated from a valve.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field; the message names the field. */
RIIS_API riis_status riis_find_crossings(const riis_surface *surface, const riis_crossing_options *options,
                                         riis_crossings *crossings);

/* Pairs of triangles that cross, in the order of the first triangle's id, then of the second triangle's id. Lengths are in mesh
 * units. */
typedef struct riis_crossing_list {
  int64_t n_pairs;            /* the number of pairs. If n_pairs is 0, the ids in this struct are -1, and all other fields except
                                 seconds are 0 */
  const int64_t *triangle_id; /* (2, n_pairs): the two triangles, the lower id first */
  const double *point;        /* (3, n_pairs): the middle of the segment where the two triangles meet */
  const double *depth;        /* (n_pairs): the penetration depth */
  const double *length;       /* (n_pairs): the length of the segment where the two triangles meet */
  double total_length;        /* the sum of all lengths */
  double deepest_depth;       /* the depth of the deepest pair. Of equally deep pairs, the first one counts as the deepest */
  double deepest_point[3];    /* the point of the deepest pair */
  int64_t deepest_triangle_id[2]; /* the triangles of the deepest pair */
  int32_t deepest_leaflet_id[2];  /* the leaflets of the deepest pair's triangles */
  double seconds;             /* wall time of riis_find_crossings */
} riis_crossing_list;
/* Gives the pairs that the last riis_find_crossings found. The list is valid until the next riis_find_crossings with the same
 * object. */
RIIS_API riis_status riis_crossings_get_list(const riis_crossings *crossings, riis_crossing_list *list,
                                             int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
