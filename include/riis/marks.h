/* SPDX-License-Identifier: Apache-2.0
 * marks.h - marks: the nodes near a surface, with their distances and their resistance K.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_MARKS_H
#define RIIS_MARKS_H

#include "mesh.h"
#include "surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Marking (paper, 4.2) ------------------------------------------------------------------------------ */

/* The nodes that a marking found. Make one object and reuse it in every time step, because it keeps its memory for the next
 * marking. */
typedef struct riis_marks riis_marks;
/* Makes empty marks, which belong to no mesh and no surface. */
RIIS_API riis_status riis_marks_create(riis_marks **marks);
RIIS_API void riis_marks_destroy(riis_marks **marks); /* destroys the marks and their lists */

/* How a marking searches for the nodes near the surface. All searches except RIIS_SEARCH_PAPER find the same nodes
 * (docs/theory/search.md). */
enum {
  RIIS_SEARCH_AUTO = 0,       /* uses clusters or the exhaustive search, whichever is expected to be faster. If distances are
                                 measured by sampling or minimisation, the exhaustive search runs. If the distance limit is above
                                 a fifth of the surface's extent, the exhaustive search runs only for few nodes. If the limit is
                                 smaller, the exhaustive search runs only in the first marking of a mesh that riis_mesh_prepare
                                 has not prepared. A grid (riis_mesh_create_grid) is searched by clusters from the first marking
                                 on */
  RIIS_SEARCH_EXHAUSTIVE = 1, /* queries every node (paper, algorithm "Exhaustive node iteration") */
  RIIS_SEARCH_NEIGHBOR = 2,   /* walks from marked nodes to their neighbours (paper, algorithm "Recursive neighbor search"), and
                                 also queries all other nodes that may be near the surface. The mesh must have an adjacency, which
                                 need not be connected */
  RIIS_SEARCH_PAPER = 3,      /* the paper's algorithm without any change, for comparison. This search has only one starting node,
                                 and misses nodes that are not connected to it. The mesh must have an adjacency */
  RIIS_SEARCH_CLUSTERS = 4    /* discards distant clusters of nodes in single precision, and tests the other nodes in double
                                 precision. The exhaustive search runs instead if there are 2^32 nodes or more. It also runs if
                                 the mesh is a million times as large as the surface, or if the mesh is farther from the surface
                                 than a million times the surface's size. riis_mark_stats.search tells which search ran */
};

/* The processor's instructions that a marking uses. The results are bitwise the same for all instruction sets. */
enum {
  RIIS_INSTRUCTIONS_AUTO = 0,     /* the best available */
  RIIS_INSTRUCTIONS_BASELINE = 1, /* available on every processor that the library was built for: SSE2 on x86-64, NEON
                                     on 64-bit ARM */
  RIIS_INSTRUCTIONS_AVX2 = 2,     /* AVX2 and FMA */
  RIIS_INSTRUCTIONS_AVX512 = 3    /* AVX-512 F, DQ, BW and VL */
};

/* Fields of the closest points that a marking stores on request. To request several fields, add their values. If distances are
 * measured by sampling or minimisation, only RIIS_FIELD_POINT, RIIS_FIELD_NORMAL and RIIS_FIELD_PATCH are available. */
enum {
  RIIS_FIELD_POINT = 1,      /* riis_mark_list.point */
  RIIS_FIELD_NORMAL = 2,     /* riis_mark_list.normal */
  RIIS_FIELD_BARYCENTRIC = 4, /* riis_mark_list.barycentric */
  RIIS_FIELD_SIDE = 8,       /* riis_mark_list.side */
  RIIS_FIELD_RIM = 16,       /* riis_mark_list.rim */
  RIIS_FIELD_UV = 32,        /* riis_mark_list.uv; refused for surfaces from arrays */
  RIIS_FIELD_VELOCITY = 64,  /* riis_mark_list.velocity; refused unless the last update gave velocities */
  RIIS_FIELD_PATCH = 128,    /* riis_mark_list.patch_id */
  RIIS_FIELD_GRADIENT = 256  /* riis_mark_list.distance_gradient, and K_gradient with a resistance; refused unless the
                                surface has directions (riis_surface_add_direction) */
};

/* How the band around a surface ends at the rim of the surface. */
enum {
  RIIS_RIM_ROUND = 0, /* the band ends in half a tube around the rim: K acts at every node within the half thickness */
  RIIS_RIM_CUT = 1    /* there is no half tube: K is 0 at nodes whose closest point is on the rim */
};

/* The term K (u - u_surface) of the momentum equation, where u is the velocity of the fluid and u_surface that of the surface
 * (paper, 2.1; docs/theory/marks.md, "Resistance"). Let d be the distance of a node from the surface, and let eps be the field
 * half_thickness. For d < eps, K = (R / eps) delta(d) with delta(d) = (1 + cos(pi d / eps)) / (2 eps). For d >= eps, K is 0. If
 * the surface has an offset o, d is the distance from the middle of the band, |s - o eps|, with the signed distance s
 * (riis_surface_create). */
typedef struct riis_resistance {
  int64_t struct_size;   /* set by the init function */
  double R;              /* the resistance, 0 or 1e-300 to 1e60, in mass / (length time), such as kg/(m s). In a flow of velocity
                            u, the pressure drop across a flat closed valve is (R / eps) u. Default NaN, which is refused */
  double half_thickness; /* eps, at least 1e-50. If the surface has an offset o, (1 + |o|) eps must be at most the distance limit.
                            Default RIIS_AUTO: the marking's half thickness */
  int32_t rim;           /* RIIS_RIM_*, default RIIS_RIM_ROUND */
  int32_t reserved;      /* 0 */
} riis_resistance;
RIIS_API riis_status riis_resistance_init(riis_resistance *resistance, int64_t struct_size); /* the defaults */

/* Options of a marking. */
typedef struct riis_mark_options {
  int64_t struct_size;       /* set by the init function */
  double distance_limit;     /* the search finds all nodes whose distance from the surface is at most this limit. If o is the
                                offset of the surface, the limit must be at least (1 + |o|) half thicknesses, and at most 1e60.
                                Default RIIS_AUTO: the search finds only the marked nodes. The limit has no influence on which
                                nodes are marked */
  const uint8_t *node_mask;  /* (n_nodes): 0 leaves a node out of the search. The coordinates of the node must still be finite.
                                NULL: all nodes */
  const riis_resistance *resistance; /* the resistance for riis_mark_list.K. If the surface has velocities, the marking also gives
                                        riis_mark_list.K_u_surface. Default NULL: no K */
  int32_t fields;            /* a sum of RIIS_FIELD_*, for the nodes of riis_mark_list. Default 0 */
  int32_t search;            /* RIIS_SEARCH_*, default RIIS_SEARCH_AUTO */
  int32_t n_threads;         /* default 0 */
  int32_t instructions;      /* RIIS_INSTRUCTIONS_*, for tests and measurements; default RIIS_INSTRUCTIONS_AUTO. If the processor
                                lacks these instructions, the marking returns RIIS_UNAVAILABLE. Sampling and minimisation always
                                use RIIS_INSTRUCTIONS_BASELINE */
} riis_mark_options;
RIIS_API riis_status riis_mark_options_init(riis_mark_options *options, int64_t struct_size); /* the defaults */

/* Finds the marked nodes, which lie in the band around the surface (riis_surface_create), and the nodes within the distance
 * limit. Without an offset, the band holds the nodes whose distance from the surface is at most the half thickness. Distances in
 * double precision decide which nodes are found.
 *   `marks`: its content is replaced.
 * The log gets a warning if the mesh and the surface seem to have different units: the largest sides of their bounding boxes
 * differ by more than a factor of 50, or one of these sides is below the half thickness. The warning comes once for each pair of
 * surface and mesh, at most eight times for each mesh, and never for fewer than 1000 nodes.
 * Errors: RIIS_INVALID_MESH if a coordinate has become non-finite since the mesh was created or updated. */
RIIS_API riis_status riis_mark_nodes(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_mark_options *options, riis_marks *marks);

/* The lists of a marking. */
enum {
  RIIS_LIST_MARKED = 0,      /* the marked nodes, which lie in the band around the surface */
  RIIS_LIST_WITHIN_LIMIT = 1 /* the nodes within the distance limit, marked or not. Without a distance limit, this list has the
                                same nodes as RIIS_LIST_MARKED */
};
/* A list of nodes, ascending by node_id. Lengths are in mesh units. The arrays from `point` to `K_gradient` are NULL if
 * options.fields did not request them. Values that riis_closest_point also gives are bitwise the same in both calls. */
typedef struct riis_mark_list {
  int64_t n_nodes;            /* in the list */
  const int64_t *node_id;     /* (n_nodes) */
  const double *distance;     /* (n_nodes) */
  const int64_t *triangle_id; /* (n_nodes): of the closest triangle, as in riis_closest */
  const int32_t *leaflet_id;  /* (n_nodes): of that triangle */
  const double *K;            /* (n_nodes): K of options.resistance; NULL without a resistance */
  const double *K_u_surface;  /* (3, n_nodes): K u_surface; NULL without a resistance or velocities */
  const double *point;        /* (3, n_nodes): the closest point of the surface */
  const double *normal;       /* (3, n_nodes): the unit normal of its triangle */
  const double *barycentric;  /* (3, n_nodes): the closest point's weights for the vertices of its triangle */
  const double *uv;           /* (2, n_nodes): u and v of the closest point on its patch S(u,v), in [0,1]. The vector S_u x S_v
                                 points along the normal. On mirrored patches (cusps: patch_id % 4 >= 2; mitral: 3, 4, 5, 8, 9),
                                 this vector points against the normal. With flip_normals, both directions are reversed */
  const double *velocity;     /* (3, n_nodes): the velocity of the surface at the closest point, from the surface's last update.
                                 If several leaflets are equally near (within 1e-6 half thicknesses), the velocity is the mean of
                                 the velocities at their closest points (docs/theory/marks.md). The same holds for several patches
                                 of one leaflet (within 1e-9 half thicknesses). All other fields come from the closest triangle */
  const int32_t *side;        /* (n_nodes): as riis_closest.side */
  const int32_t *rim;         /* (n_nodes): 1 if the closest point lies on the rim of the surface, else 0. The rim of a valve
                                 consists of those sides of patches that belong to only one patch, such as free edges and the
                                 annulus. Where free edges of a closed valve coincide, they are not part of the rim. The rim of a
                                 surface from arrays consists of the edges that belong to only one triangle. Vertices with equal
                                 coordinates count as one vertex */
  const int32_t *patch_id;    /* (n_nodes): as in riis_triangles */
  int64_t n_directions;       /* the number of directions that the surface had during the marking; 0 without
                                 RIIS_FIELD_GRADIENT */
  const double *distance_gradient; /* (n_directions, n_nodes): the derivative of the distance in each direction, which is -n.V.
                                      The unit vector n points from the closest point to the node, and V is the rate of the
                                      closest point in the triangle triangle_id. Nodes on the surface get 0, because the distance
                                      has a kink there. The distance also has a kink at nodes with several closest points */
  const double *K_gradient;   /* (n_directions, n_nodes): the derivative of K in each direction, for constant R and half
                                 thickness. The derivative is 0 where K is 0. NULL without a resistance. If the surface has an
                                 offset, the unit vector n of a node on the surface is the surface's normal. At a rim, the
                                 derivative then includes the rotation of this normal */
  const double *height;       /* (n_nodes): for a surface with an offset, the signed distance s of riis_surface_create. If the
                                 closest point p is on a rim, the height of a node x is n.(x - p) with the normal n. NULL without
                                 an offset */
} riis_mark_list;
/* Gives one of the two lists of the last marking. The list is valid until the marks are destroyed or passed to riis_mark_nodes
 * again.
 *   `which`: RIIS_LIST_*. */
RIIS_API riis_status riis_marks_get_list(const riis_marks *marks, int32_t which, riis_mark_list *list,
                                         int64_t struct_size);

/* The caller's arrays, which have an entry for each node of the mesh. Pass NULL for arrays that are not wanted. */
typedef struct riis_dense_arrays {
  int64_t struct_size;  /* set by the init function */
  int64_t n_nodes;      /* the number of nodes of the marking, 0 for empty marks */
  double far_distance;  /* the number that `distance` gets for nodes that are masked out or beyond the limit. This number may be
                           NaN, or any value outside [0, distance limit]. Default RIIS_FAR_DISTANCE */
  uint8_t *mark;        /* (n_nodes): 1 for marked nodes, 0 for others */
  double *distance;     /* (n_nodes): the distance for nodes within the distance limit, far_distance for others */
  int64_t *triangle_id; /* (n_nodes): the closest triangle for nodes within the distance limit, -1 for others */
  int32_t *leaflet_id;  /* (n_nodes): the leaflet of this triangle, -1 for others */
} riis_dense_arrays;
RIIS_API riis_status riis_dense_arrays_init(riis_dense_arrays *arrays, int64_t struct_size); /* the defaults */
/* Writes the marks of all nodes to the caller's arrays.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field; the message names the field. */
RIIS_API riis_status riis_marks_get_dense(const riis_marks *marks, const riis_dense_arrays *arrays);

/* Counts and times of the last marking. */
typedef struct riis_mark_stats {
  int64_t n_nodes;      /* the number of nodes of the mesh, masked out or not */
  int64_t n_marked;     /* the length of RIIS_LIST_MARKED */
  int64_t n_within_limit; /* the number of nodes within the distance limit, marked or not */
  int64_t n_queries;    /* the number of closest-point queries for nodes and for parts of the mesh */
  double seconds;       /* wall time of riis_mark_nodes */
  int32_t search;       /* the search that ran, never RIIS_SEARCH_AUTO */
  int32_t n_threads;    /* the largest number of threads that any part of the marking used. A limit that the caller sets for TBB's
                           threads affects only the walks of the neighbour search */
  int32_t complete;     /* 1: all nodes within the limit were found, for the coordinates that the mesh had when it was made or
                           last updated. 0: nodes may have been missed */
  int32_t instructions; /* the instructions that were used, never RIIS_INSTRUCTIONS_AUTO */
  int64_t n_unreached;  /* the number of nodes within the limit that the neighbour search found without walking to them */
} riis_mark_stats;
/* Gives counts and times of the marking that last filled these marks. For empty marks all fields are 0. */
RIIS_API riis_status riis_marks_get_stats(const riis_marks *marks, riis_mark_stats *stats, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
