/* SPDX-License-Identifier: Apache-2.0
 * surface.h - surfaces: triangles from a valve, from the caller's arrays or from frames in time, with their sizes, attachment and
 * velocities. The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_SURFACE_H
#define RIIS_SURFACE_H

#include "valve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Surface: triangles in space that answer closest-point queries ------------------------------------- */

/* A surface: triangles with a half thickness. It borrows nothing from the caller. The first query that needs an Embree scene of
 * the triangles builds this scene. Several threads may send such queries at once. */
typedef struct riis_surface riis_surface;

/* The values of leaflet_id for the leaflets of the parametric valves. */
enum {
  RIIS_LEAFLET_RIGHT = 0,       /* aortic: the right coronary cusp, "right" in names of parameters; other kinds with cusps: the
                                   cusp on the x axis. The next ids follow counter-clockwise, seen from +z */
  RIIS_LEAFLET_LEFT = 1,        /* aortic: the left coronary cusp, "left"; other kinds with cusps: the second cusp */
  RIIS_LEAFLET_NON_CORONARY = 2,/* aortic: the cusp "non_coronary"; other kinds with cusps: the third cusp. A fourth cusp has the
                                   id 3 */
  RIIS_LEAFLET_ANTERIOR = 0,    /* mitral, mitral_coapting, tricuspid: the anterior leaflet */
  RIIS_LEAFLET_POSTERIOR = 1,   /* mitral, mitral_coapting: the posterior leaflet, with all its scallops. tricuspid: 1 is the
                                   septal leaflet, and 2 is the posterior leaflet */
  RIIS_LEAFLET_POSITIVE = 0,    /* bileaflet: the leaflet at x > 0 */
  RIIS_LEAFLET_NEGATIVE = 1,    /* bileaflet: the leaflet at x < 0 */
  RIIS_LEAFLET_HOUSING = 2,     /* bileaflet: the housing's wall, if ring_height is not 0 */
  RIIS_LEAFLET_SKIRT = 3        /* the skirt, if skirt_length is not 0. A fourth cusp, or a leaflet from patches or arrays, may
                                   have an id of 3 or more. The skirt's id is then the largest leaflet_id + 1.
                                   riis_surface_info.skirt_leaflet_id gives the skirt's id */
};

/* What a call does with triangles of zero area in the caller's arrays. */
enum {
  RIIS_ZERO_AREA_REFUSE = 0, /* the call refuses the surface with RIIS_INVALID_SURFACE, and the message names the first such
                                triangle */
  RIIS_ZERO_AREA_SKIP = 1    /* the call skips and counts such triangles, and logs a warning. Other triangles keep their ids */
};

/* How the distance of a point to the surface is measured (paper, 4.1). Sampling and minimisation serve comparisons with the
 * paper, and work only for surfaces of valves. These two ways measure the distance to points S(u,v) of the patches, with the
 * tolerance e = measure_tolerance * half_thickness (docs/theory/paper-distances.md). The closest points that they find have the
 * leaflet_id of the patch, the normal of S (0 0 0 if S has none), triangle_id -1, barycentric 0 and side 0. With sampling or
 * minimisation, calls return RIIS_INVALID_ARGUMENT if they are passed RIIS_SEARCH_CLUSTERS or an array for barycentric or
 * side. */
enum {
  RIIS_MEASURE_TRIANGLES = 0,   /* the distance to the closest point of all triangles, without approximation */
  RIIS_MEASURE_SAMPLING = 1,    /* the distance to the nearest of up to 16,777,216 sample points, which are spaced evenly on the
                                   patches. The distance is at most e too large, and at most e / 10 too small */
  RIIS_MEASURE_MINIMIZATION = 2 /* Powell's method (1964) runs on every patch. The distance is at most e / 10 too small. If the
                                   method stops in a local minimum, the distance may be too large by any amount, and nothing shows
                                   the error */
};

/* How the smooth valve is cut into triangles. */
enum {
  RIIS_TRIANGULATION_ADAPTED = 0, /* as few triangles as each opening needs, so the triangles change as the valve opens */
  RIIS_TRIANGULATION_FIXED = 1    /* triangles keep their ids, vertices and neighbours at every opening. The first call with this
                                     option chooses the triangles. Afterwards only the opening and the placement may change. If
                                     another parameter changes, the call returns RIIS_INVALID_PARAMETER, and the message names the
                                     parameter. If the triangles do not meet the tolerance at an opening, the call returns
                                     RIIS_LIMIT_EXCEEDED. A triangle without area is left out, and no other triangle gets its id.
                                     An update with RIIS_TRIANGULATION_ADAPTED forgets the chosen triangles. In a mitral or warped
                                     valve that moves, vertices also slide along the surface. Velocities do not include this
                                     sliding */
};

/* Options of a surface. The placement of a valve or of arrays is x -> scale * rotation * x + translation. */
typedef struct riis_surface_options {
  int64_t struct_size;     /* set by the init function */
  double half_thickness;   /* the half thickness of the band, in mesh units, 1e-50 to 1e50: d_min in the paper (4.2). Default
                              RIIS_AUTO: 0.1 * scale */
  double tolerance;        /* 1e-6 to 1, default 0.05. The distance to a valve's triangles differs from the distance to its smooth
                              surface by at most tolerance * half_thickness (docs/theory.md) */
  double scale;            /* 1e-12 to 1e12, default 1 */
  double rotation_axis[3]; /* a vector with a length of at least 1e-50 and components up to 1e50; default (0, 0, 1) */
  double rotation_angle;   /* degrees, counter-clockwise seen from the axis's tip; -1e6 to 1e6, default 0 */
  double translation[3];   /* a shift in mesh units, -1e50 to 1e50, default 0. Calls refuse a shift of a valve that would round
                              coordinates by more than a thousandth of tolerance * half_thickness */
  double measure_tolerance; /* tolerance of sampling and minimisation, in half thicknesses, 1e-6 to 1. Default: the field
                               tolerance */
  int32_t measure;         /* RIIS_MEASURE_*, for closest points and marking only. Default RIIS_MEASURE_TRIANGLES; surfaces from
                              arrays accept only this value */
  int32_t triangulation;   /* RIIS_TRIANGULATION_*; default RIIS_TRIANGULATION_ADAPTED */
  int32_t zero_area;       /* surfaces from arrays: RIIS_ZERO_AREA_*; default RIIS_ZERO_AREA_REFUSE */
  int32_t flip_normals;    /* 1 turns every triangle over, so that normal and side change sign; default 0 */
  int32_t n_threads;       /* default 0 */
  int32_t reserved;        /* 0 */
  double offset;           /* the offset o, in half thicknesses, above -1 and below 1, default 0. The middle of the band is the
                              surface moved by o half thicknesses along its normals (after flip_normals). RIIS_MEASURE_SAMPLING
                              and RIIS_MEASURE_MINIMIZATION need the offset 0 */
} riis_surface_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_surface_options_init(riis_surface_options *options, int64_t struct_size);

/* Makes the surface of a valve from curves, by way of polylines, Coons patches, quads and triangles (paper, 3 and 4.1;
 * docs/theory.md).
 *   `valve`: a valve whose parameters fit together.
 *   `options`: accuracy and placement.
 * Normals point downstream: from the ventricular to the sinus face of the cusps, from the atrial to the ventricular face of the
 * mitral valve, and to +z on closed bileaflet leaflets. On the bileaflet ring, normals point outwards. Triangles of zero area are
 * skipped. They occur at the root of each cusp, at the mitral commissures and at the ends of bileaflet middle edges. The band is
 * the set of nodes whose distance from the surface is at most the half thickness eps. An offset o moves the band by o eps along
 * the normals. Let s be the signed distance of a node, which is positive on the side to which normals point. The band with the
 * offset then holds the nodes with |s - o eps| <= eps. A node x whose closest point p lies on a rim is in the band if |x - p - o
 * eps n| <= eps, with the normal n at p (docs/theory/marks.md, "Offset"). An offset does not change distances, sides and closest
 * points.
 * Errors: RIIS_INVALID_PARAMETER for parameters that do not fit together or that put a curve out of range. RIIS_INVALID_SURFACE
 * if two neighbouring triangles have opposite windings in a surface with an offset. RIIS_LIMIT_EXCEEDED if a tolerance needs more
 * than 16,777,216 triangles, quads or samples, or is smaller than the rounding error of coordinates. */
RIIS_API riis_status riis_surface_create(const riis_valve *valve, const riis_surface_options *options,
                                         riis_surface **surface);

/* The caller's own surface of triangles or quads. */
typedef struct riis_surface_arrays {
  int64_t struct_size;       /* set by the init function */
  int64_t n_vertices;        /* 1 to 2^31 - 1 */
  const void *x, *y, *z;     /* (n_vertices) by stride: the coordinates of the vertices before placement */
  int64_t stride;            /* of x, y and z. Default 1 */
  const void *vx, *vy, *vz;  /* (n_vertices) by velocity_stride: velocities of the vertices, in the unit of x, y and z per unit of
                                time. The placement rotates and scales the velocities. All NULL: no velocities */
  int64_t velocity_stride;   /* of vx, vy and vz. Default 1 */
  int64_t n_faces;           /* 1 to 16,777,216 triangles, half as many quads */
  const void *vertex_ids;    /* (corners_per_face, n_faces): the vertices of each face. The normal follows the right-hand rule */
  const int32_t *leaflet_id; /* (n_faces), >= 0; NULL: all 0 */
  int32_t corners_per_face;  /* 3 or 4. A quad 0 1 2 3 becomes the triangles 0 1 2 and 0 2 3. Default 3 */
  int32_t id_bits;           /* of vertex_ids */
  int32_t index_base;        /* of vertex_ids */
  int32_t real_bits;         /* of vertices and velocities */
  double skirt_length;       /* the length of a skirt before placement. A skirt is a strip that leads outwards from the
                                attachment. The length is 1e-4 to 10 times the attachment's mean distance from its axis. 0, the
                                default: no skirt */
  const uint8_t *attached;   /* (n_vertices): a number above 0 marks a vertex of the attachment. The attachment consists of the
                                open edges whose two vertices are attached. NULL: if there is a skirt, the call chooses the
                                attachment */
  const double *skirt_lengths; /* (n_vertices): the skirt's length at each attached vertex, at most skirt_length. If a length is
                                  below the least permitted skirt_length, the call raises it to this least value. NULL:
                                  skirt_length everywhere */
} riis_surface_arrays;
/* Fills *arrays with the defaults. */
RIIS_API riis_status riis_surface_arrays_init(riis_surface_arrays *arrays, int64_t struct_size);

/* Makes a surface from arrays, and keeps the winding of the caller's faces. The id of a triangle is the number of its face. The
 * halves of quad q have the ids 2 q and 2 q + 1. No other triangle gets the id of a skipped triangle. A triangle has zero area if
 * its longest edge is shorter than 1e-60, or if its height over its longest edge is at most 1e-12 of this edge. A skirt leads
 * outwards from the axis of the attachment. This axis passes through the centroid of the attachment, in the direction of the
 * vector area that the attachment encloses (docs/theory/skirt.md). The skirt's vertices and triangles come after the caller's
 * vertices and triangles. An open edge belongs to only one triangle. Without `attached`, the attachment is the closed line of
 * open edges that encloses the largest area. The call refuses the skirt if this area is less than 0.8 times the area inside the
 * leaflets' outline (RIIS_OUTLINE_BOUNDARY).
 * Errors: RIIS_LIMIT_EXCEEDED for too many triangles. RIIS_INVALID_SURFACE for a bad face or vertex, and if no attachment is
 * found. The message names the face or vertex and its value, or says why there is no attachment. RIIS_INVALID_ARGUMENT if a
 * length of the skirt is out of range. */
RIIS_API riis_status riis_surface_create_from_arrays(const riis_surface_arrays *arrays,
                                                     const riis_surface_options *options,
                                                     riis_surface **surface);

/* Replaces the content of a surface by the surface of a valve, for example after the valve has moved. The handle stays the same.
 *   `options`: NULL keeps the present options of the surface.
 * Errors: as riis_surface_create. */
RIIS_API riis_status riis_surface_update(riis_surface *surface, const riis_valve *valve,
                                         const riis_surface_options *options);
/* Replaces the content of a surface by a surface from arrays. The handle stays the same.
 *   `arrays`: with n_faces 0, only the vertices move, while the faces and the attachment with its skirt stay. Then vertex_ids,
 *     leaflet_id, attached and skirt_lengths must be NULL, and skirt_length must be 0.
 *   `options`: as in riis_surface_update.
 * Errors: as riis_surface_create_from_arrays. With n_faces 0, also RIIS_INVALID_ARGUMENT if n_vertices has changed since the last
 * arrays, or if the surface was not made from arrays. */
RIIS_API riis_status riis_surface_update_from_arrays(riis_surface *surface, const riis_surface_arrays *arrays,
                                                     const riis_surface_options *options);
/* Destroys the surface. Marks of the surface stay valid. */
RIIS_API void riis_surface_destroy(riis_surface **surface);

/* The size of a surface, and the wall times of the call that last made or updated it. */
typedef struct riis_surface_info {
  int64_t n_vertices;        /* as riis_triangles.n_vertices */
  int64_t n_triangles;       /* triangles that answer queries */
  int64_t n_zero_area;       /* the number of triangles that were skipped because they have no area */
  double half_thickness;     /* mesh units */
  double area;               /* of all triangles, mesh units squared */
  double lower[3], upper[3]; /* bounds of the triangles, mesh units */
  double seconds_triangles;  /* wall time for checks and for making triangles, in the last call that made or updated the
                                surface */
  double seconds_scene;      /* wall time for groups of triangles, sampling and minimisation, in the same call. The time does not
                                include Embree's scene, because the first query that needs the scene builds it */
  double error_bound;        /* an upper bound of the error of distances. The error is the difference between the distances to the
                                triangles and to the smooth valve. The bound is at most tolerance * half_thickness, and 0 for a
                                surface from arrays */
  int64_t largest_leaflet_id; /* of the triangles */
  double offset;             /* of the band, in half thicknesses */
  double contact_depth;      /* where triangles of different leaflets cross by at most this depth, the leaflets only touch
                                (docs/theory/crossings.md) */
  int32_t skirt_leaflet_id;  /* the leaflet_id of the skirt; -1: no skirt */
  int32_t housing_leaflet_id; /* bileaflet: RIIS_LEAFLET_HOUSING; -1 for other surfaces */
} riis_surface_info;
/* Gives the size of the surface, and the time that the last call took to make or update it. */
RIIS_API riis_status riis_surface_get_info(const riis_surface *surface, riis_surface_info *info,
                                           int64_t struct_size);

/* The triangles of a surface, after placement. */
typedef struct riis_triangles {
  int64_t n_vertices;         /* of the surface */
  const double *xyz;          /* (3, n_vertices): the vertices */
  const double *uv;           /* (2, n_vertices): each vertex's u and v on its patch, in [0,1]; NULL from arrays */
  const double *velocity;     /* (3, n_vertices): each vertex's velocity; NULL if the last update gave no velocities. Where closed
                                 cusps meet, each vertex has the velocity of its own cusp */
  int64_t n_triangles;        /* triangles that answer queries */
  const int64_t *vertex_id;   /* (3, n_triangles): the vertices of each triangle */
  const int64_t *triangle_id; /* (n_triangles), ascending: the ids of the triangles in results of queries; 0, 1, 2, ... for a
                                 valve */
  const int32_t *leaflet_id;  /* (n_triangles): RIIS_LEAFLET_*, or the caller's leaflet_id if the surface comes from patches or
                                 arrays */
  const int32_t *patch_id;    /* (n_triangles): the number of the patch. In a surface from arrays, leaflets have 0 and a skirt has
                                 1. Patches of the caller are numbered from 0. In a valve of n cusps, the bottom of the cusp with
                                 leaflet_id i has 4 i, and the top 4 i + 1. The mirror images of bottom and top have 4 i + 2 and 4
                                 i + 3. In a fused part, each of these ids is 4 n larger. In the anterior mitral leaflet, the
                                 triangle at the posteromedial commissure has 0, the side has 1, and the middle has 2. The mirror
                                 images of 2, 1 and 0 have 3, 4 and 5. In the posterior mitral leaflet, a side scallop has 6, and
                                 half of the middle scallop has 7. The mirror images of 7 and 6 have 8 and 9. In a bileaflet
                                 valve, the halves of leaflet i have 2 i and 2 i + 1, and the quarters of the ring have 4 to 7. A
                                 patch of a skirt has the id of the leaflet's patch that it continues, plus the number of patch
                                 ids of the leaflets. This number is 10 for mitral, and 12 for three cusps without a fused
                                 commissure */
} riis_triangles;
/* Gives the triangles of the surface. They are valid until the surface is updated or destroyed. */
RIIS_API riis_status riis_surface_get_triangles(const riis_surface *surface, riis_triangles *triangles,
                                                int64_t struct_size);

/* The attachment of a valve, after placement: the edges at which tissue or a stent holds the leaflets. The edges are in the order
 * of the patches. Along each side of a patch, u or v ascends. */
typedef struct riis_attachment {
  int64_t n_edges;           /* the number of edges; edges of length 0 are left out */
  const double *edges;       /* (3, 2, n_edges): the coordinates of both ends of each edge, in the layout of
                                riis_reaction.edges */
  const int64_t *vertex_id;  /* (2, n_edges): the vertices at the ends, in riis_triangles.xyz */
  const int32_t *leaflet_id; /* (n_edges): the leaflet that is attached there */
  const int32_t *patch_id;   /* (n_edges): the patch of this leaflet, as in riis_triangles */
} riis_attachment;
/* Gives the attachment of a surface. The arrays are valid until the surface is updated or destroyed.
 * - A cusp is attached at the sinus, u = 1, from the root to the commissures.
 * - A mitral leaflet is attached at the annulus, v = 0.
 * - A valve from patches is attached at the sides v = 0 that belong to only one patch.
 * - A bileaflet valve has no attachment, because pivots hold its leaflets.
 * - A surface from arrays or keyframes has an attachment only if the arrays have `attached` or a skirt.
 * A skirt continues the leaflets outwards from the attachment. The attachment itself does not change.
 * Errors: RIIS_INVALID_ARGUMENT for a surface from arrays or keyframes without an attachment. */
RIIS_API riis_status riis_surface_get_attachment(const riis_surface *surface, riis_attachment *attachment,
                                                 int64_t struct_size);

/* ---- Motion: surfaces with velocities, from two states of a valve or from frames ----------------------- */

/* Replaces the content of a surface by the surface of a valve, and gives every vertex a velocity. The triangles are bitwise the
 * same as those of riis_surface_update. For a valve at rest, pass the same valve as valve_before.
 *   `valve_before`: the valve in its earlier state, of the same kind. Valves from patches must have the same curves and sides.
 *   `dt`: the time from valve_before to valve, 1e-30 to 1e30, or -1e30 to -1e-30 if time runs backwards.
 *   `options_before`: scale, rotation and translation of the earlier state; other fields are ignored. NULL: the earlier state has
 *     the placement of the new state.
 * The velocity of a vertex is its displacement divided by dt. The displacement leads to the vertex from the point of the earlier
 * state with the same patch, u and v (docs/theory/velocity.md). A warp does not change u and v. If a warp takes vertices to a
 * moving wall, the vertices therefore have the velocity of the wall (docs/theory/warp.md). The velocity is a mean over the step
 * from valve_before to valve. As the velocity in the middle of the step, it has an error of second order in dt. As the velocity
 * at either end, it has an error of first order.
 * Errors: as riis_surface_update. RIIS_INVALID_PARAMETER if valve_before differs from `valve` in kind or patches, or if its
 * parameters do not fit together. */
RIIS_API riis_status riis_surface_update_moving(riis_surface *surface, const riis_valve *valve,
                                                const riis_valve *valve_before, double dt,
                                                const riis_surface_options *options,
                                                const riis_surface_options *options_before);

/* The ways to interpolate between keys, which are times with given values. A time is rounded to a key if the difference is at
 * most 2^-49 times the largest of time, key and period. A key plus whole periods also counts as a key. */
enum {
  RIIS_INTERPOLATION_LINEAR = 0, /* the rate jumps at keys; the rate at a key is the value after the jump */
  RIIS_INTERPOLATION_CUBIC = 1   /* the interpolation is monotone between keys, with a continuous rate (Fritsch, Butland 1984) */
};
/* The frames of a surface that moves, such as a patient's valve. The vertices move from frame to frame, and the faces stay the
 * same. */
typedef struct riis_keyframes riis_keyframes;
/* The frames of a surface that moves, in the caller's arrays. */
typedef struct riis_keyframe_arrays {
  int64_t struct_size;   /* set by the init function */
  int64_t n_keys;        /* 1 to 1,000,000 */
  int64_t n_vertices;    /* of each frame, as in riis_surface_arrays */
  const double *time;    /* (n_keys), strictly ascending, magnitude at most 1e30 */
  const void *xyz;       /* (3, n_vertices, n_keys): the vertices, frame after frame; magnitude at most 1e60 */
  double period;         /* if above 0, the motion repeats with this period. All keys must lie within one period after the first
                            key. If the last key is exactly one period after the first key, the two keys must have the same frame.
                            With 0, the default, the surface rests before the first key and after the last key */
  int32_t interpolation; /* RIIS_INTERPOLATION_*, of each coordinate. Default RIIS_INTERPOLATION_LINEAR */
  int32_t real_bits;     /* of xyz */
} riis_keyframe_arrays;
/* Fills *frames with the defaults. */
RIIS_API riis_status riis_keyframe_arrays_init(riis_keyframe_arrays *frames, int64_t struct_size);
/* Makes keyframes from arrays and frames, which are copied.
 *   `arrays`: as for riis_surface_create_from_arrays, except that vertices and velocities are ignored, and may be NULL. If
 *     `attached` is NULL, the attachment of a skirt is found in the first frame.
 * Errors: RIIS_INVALID_SURFACE for a bad frame, vertex or face; the message names it. RIIS_LIMIT_EXCEEDED for too many frames,
 * vertices or faces. */
RIIS_API riis_status riis_keyframes_create(const riis_surface_arrays *arrays,
                                           const riis_keyframe_arrays *frames, riis_keyframes **keyframes);
/* Destroys the keyframes. Surfaces made from them stay. */
RIIS_API void riis_keyframes_destroy(riis_keyframes **keyframes);
/* Makes the surface that keyframes have at a given time, with velocities.
 *   `time`: the time, finite and at most 1e30 in magnitude.
 *   `dt`: the length of the time interval that ends at `time`, over which the velocity is the mean. With dt 0, the velocity is
 *     the time derivative of the interpolation.
 * Errors: as riis_surface_create_from_arrays. */
RIIS_API riis_status riis_surface_create_from_keyframes(const riis_keyframes *keyframes, double time, double dt,
                                                        const riis_surface_options *options,
                                                        riis_surface **surface);
/* Replaces the content of a surface by the surface that keyframes have at a given time. Arguments and errors are as in
 * riis_surface_create_from_keyframes, but NULL options keep the present options of the surface. */
RIIS_API riis_status riis_surface_update_from_keyframes(riis_surface *surface, const riis_keyframes *keyframes,
                                                        double time, double dt,
                                                        const riis_surface_options *options);

#ifdef __cplusplus
}
#endif

#endif
