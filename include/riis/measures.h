/* SPDX-License-Identifier: Apache-2.0 measures.h - sizes of a valve that matter for a flow: leaflets, orifice, opening from an
 * area, coaptation, leak, first passage, cells across the band, swept volume. The header riis.h includes this file, and has the
 * rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_MEASURES_H
#define RIIS_MEASURES_H

#include "seal.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Measures: what a valve means for the flow --------------------------------------------------------- */

/* A leaflet of a surface. Lengths are in mesh units. */
typedef struct riis_leaflet {
  int64_t n_triangles; /* the number of the leaflet's triangles with an area above 0 */
  double area;         /* the sum of the areas of these triangles */
  double free_edge;    /* the length of the free edge, 0 for a skirt. The free edge of a valve's leaflet consists of the sides v =
                          1 that belong to only one patch of the leaflet. In a surface from arrays, the free edge consists of the
                          edges that belong to only one triangle, without the longest closed line of such edges */
  int32_t leaflet_id;  /* as in riis_triangles */
  int32_t reserved;    /* 0 */
} riis_leaflet;
/* Gives the number of leaflets of the surface. */
RIIS_API riis_status riis_surface_get_n_leaflets(const riis_surface *surface, int64_t *n_leaflets);
/* Gives the sizes of a leaflet.
 *   `leaflet`: the position of the leaflet in the list of leaflets, which ascends by leaflet_id; 0 to n_leaflets - 1. */
RIIS_API riis_status riis_surface_get_leaflet(const riis_surface *surface, int64_t leaflet, riis_leaflet *sizes,
                                              int64_t struct_size);

/* The ways to find the outline of an orifice. A surface from arrays or keyframes that has the triangles of a valve also has the
 * outline of this valve. */
enum {
  RIIS_OUTLINE_NONE = 0,      /* the boundary of the leaflets does not surround a centre, or encloses no area */
  RIIS_OUTLINE_DISC = 1,      /* bileaflet: a disc around the z axis, with the radius riis_orifice.radius */
  RIIS_OUTLINE_ATTACHMENT = 2, /* other valves: in each direction from the centre, the farthest edge of the leaflets. The farthest
                                  edge is the attachment, except where a free edge lies farther out */
  RIIS_OUTLINE_BOUNDARY = 3,  /* a surface from arrays or keyframes: in each direction from the centre, the farthest edge that
                                 belongs to only one triangle */
  RIIS_OUTLINE_WALL = 4       /* riis_surface_get_orifice_in_wall: the longest line of open edges of the wall */
};
/* The orifice of a surface: the part of the area inside an outline that the triangles do not cover, seen along an axis. The axis
 * has the direction of the vector area that the edges of the outline enclose. For a valve, the axis points towards the valve's
 * +z. For a surface from arrays or keyframes, the axis points to the side of the normals. For a bileaflet valve, the axis is the
 * valve's z axis. Skirts are left out. If leaflets from arrays do not touch at the commissures, straight lines join their ends.
 * Lengths are in mesh units (docs/theory/measures.md, "Outline"). */
typedef struct riis_orifice {
  double area;           /* the area of the orifice. If there is no outline, all fields except axis and rim_reach are 0 */
  double outline_area;   /* the area inside the outline */
  double perimeter;      /* the length of the orifice's edge along the triangles. Before the measurement, the edge is moved
                            inwards by a tenth of the half thickness, so that narrow slits vanish. Parts of the edge that lie on
                            the outline count as walls, and do not add to the perimeter */
  double effective_area; /* the area that the band around the leaflets leaves for the flow. To find it, the edge of the orifice
                            along the triangles is moved inwards by rim_reach * half_thickness. To first order the effective area
                            is area - rim_reach * half_thickness * perimeter. The effective area is never below 0 */
  double rim_reach;      /* how far the band narrows the orifice, in half thicknesses: 0.84 for a round rim, 0.70 for a cut rim.
                            Computed flows through open valves gave 0.70 to 0.98 for a round rim, and 0.46 to 0.95 for a cut rim
                            (docs/validation.md). If the surface has an offset o, rim_reach is multiplied by max(0, 1 - o / 1.05)
                            for a round rim, by max(0, 1 - o / 0.85) for a cut rim, by max(0, 1 - o / 0.8) for a cut rim of a
                            mitral valve, and by 1 for a bileaflet valve */
  double half_thickness; /* the half thickness of the resistance */
  double radius;         /* the radius of the disc; 0 for other outlines */
  double axis[3];        /* unit vector; 0 for a surface from arrays or keyframes without an outline */
  int32_t outline;       /* RIIS_OUTLINE_* */
  int32_t reserved;      /* 0 */
} riis_orifice;
/* Measures the orifice of a surface.
 *   `resistance`: the call uses only half_thickness and rim. For half_thickness, RIIS_AUTO stands for the surface's half
 *     thickness. NULL stands for the defaults. The offset is that of the surface. */
RIIS_API riis_status riis_surface_get_orifice(const riis_surface *surface, const riis_resistance *resistance,
                                              riis_orifice *orifice, int64_t struct_size);
/* Measures the orifice inside a wall, such as a ring or a tube around the leaflets. Use this call if the leaflets do not reach
 * the wall, as in a mechanical valve from arrays. The longest connected line of open edges of the wall gives the outline and the
 * axis (docs/theory/measures.md, "Outline"). The other arguments are as in riis_surface_get_orifice.
 *   `wall`: the wall, in the same coordinates as the surface. If the line of the outline does not surround a centre, the call
 *     returns RIIS_INVALID_ARGUMENT. */
RIIS_API riis_status riis_surface_get_orifice_in_wall(const riis_surface *surface, const riis_surface *wall,
                                                      const riis_resistance *resistance, riis_orifice *orifice,
                                                      int64_t struct_size);

/* Which area of the orifice riis_find_by_area compares with the given areas. */
enum {
  RIIS_AREA_GEOMETRIC = 0, /* riis_orifice.area */
  RIIS_AREA_EFFECTIVE = 1  /* riis_orifice.effective_area */
};
/* How riis_find_by_area searches. */
typedef struct riis_area_search {
  int64_t struct_size;                 /* set by the init function */
  const riis_surface_options *surface; /* options of the valve's surface. NULL, the default, stands for defaults */
  const riis_resistance *resistance;   /* as in riis_surface_get_orifice. NULL, the default, stands for defaults */
  double from, to;    /* the range to search, with `from` below `to`. NaN, the default, stands for a range that depends on the
                         name. For "opening" this range is 0 to 1, and for "scale" 0.1 to 10 times the present scale. For any
                         other parameter it is 0.5 to 2 times the present value. If the present value is 0, a parameter with a
                         range from 0 to at most 1 is searched over its whole range. For other parameters that are 0 at present,
                         `from` and `to` must be set */
  double tolerance;   /* the largest error of a reached area, as a fraction of the wanted area, 1e-12 to 1e-2. Default 1e-8 */
  int32_t n_samples;  /* the number of values at which the area is sampled first, 2 to 100,001. Default 33 */
  int32_t area;       /* RIIS_AREA_*, default RIIS_AREA_GEOMETRIC */
} riis_area_search;
/* Fills *search with the defaults. */
RIIS_API riis_status riis_area_search_init(riis_area_search *search, int64_t struct_size);
/* The areas of a valve in the range of openings or sizes that riis_find_by_area searched. */
typedef struct riis_area_range {
  double from, to;          /* the range that was searched */
  double least, most;       /* the least and the largest area in this range */
  double least_at, most_at; /* the opening or size with the least area, and the one with the largest area */
  double turns[4];          /* the first openings or sizes at which the area turns from growing to falling, or from falling to
                               growing. Unused entries are NaN. A change of the area by less than 1e-4 of the largest area does
                               not count */
  double seconds;           /* wall time of riis_find_by_area */
  int64_t n_turns;          /* the number of all such openings or sizes. If n_turns is 0, the area only grows or only falls */
  int64_t n_surfaces;       /* the number of surfaces that the search made. The cost of the search grows with this number */
  int64_t n_refused;        /* the number of sampled openings or sizes for which there is no valve or no orifice. The search
                               leaves them out */
} riis_area_range;
/* Finds the openings, or the sizes, at which the orifice of a valve has given areas (docs/theory/measures.md, "From an area to
 * a valve").
 *   `valve`: the valve. If the call searches for openings, it ignores the valve's own opening.
 *   `name`: "opening", "scale" (of the placement), or the name of a parameter for which riis_valve_get gives one value.
 *   `n_areas`: 0 to 1,000,000. With n_areas 0, only *range is written, and `areas` may be NULL.
 *   `areas` (n_areas): the wanted areas, 0 to 1e120, in mesh units squared.
 *   `search`: NULL stands for the defaults.
 *   `values` (n_areas): the openings or sizes that were found. NULL: not wanted.
 *   `reached` (n_areas): the areas at these openings or sizes. NULL: not wanted.
 *   `range`: the areas that the valve can have. NULL: not wanted.
 * The area 0 stands for the closed valve: the call then gives the opening with the least area, even if this area is not 0. If
 * several openings have the wanted area, the call gives the smallest opening. If several sizes have the wanted area, the call
 * gives the size nearest to the present size. With RIIS_TRIANGULATION_ADAPTED the area jumps by up to 1e-4 of the largest area
 * wherever the triangles change. If a wanted area lies within such a jump, the call gives the end of the jump with the nearer
 * area. The search may miss an area that occurs only between two neighbouring samples.
 * Errors: RIIS_INVALID_ARGUMENT for a bad area; the message names the area. If no opening or size has the area, the message names
 * the range of areas. RIIS_INVALID_PARAMETER for an unknown name, and for a parameter that has three values or does not change
 * the area. RIIS_INVALID_PARAMETER also for a valve with only one state, and for a valve without an orifice. If a surface cannot
 * be made, the message names the opening or size. After an error nothing is written. */
RIIS_API riis_status riis_find_by_area(const riis_valve *valve, const char *name, int64_t n_areas,
                                       const double *areas, const riis_area_search *search, double *values,
                                       double *reached, riis_area_range *range, int64_t struct_size);

/* A value of the argument leaflet_id that stands for all leaflets. */
enum {
  RIIS_ALL_LEAFLETS = -1 /* the sum over all leaflets, without a skirt */
};
/* The coaptation of a leaflet: the part of the leaflet that touches other leaflets. Lengths are in mesh units. */
typedef struct riis_coaptation {
  double area;  /* the area of the part of the leaflet whose distance from another leaflet is at most `reach` */
  double edge;  /* the length of the part of the free edge (riis_leaflet) whose distance from another leaflet is at most
                   `reach` */
  double reach; /* the distance up to which leaflets count as touching */
} riis_coaptation;
/* Measures the coaptation. Contact with a skirt or with the bileaflet housing does not count.
 *   `reach`: 1e-50 to 1e50. RIIS_AUTO stands for the surface's half thickness.
 *   `leaflet_id`: as in riis_triangles, or RIIS_ALL_LEAFLETS for the sum over all leaflets. In this sum each contact counts
 *     twice, once for each of the two leaflets.
 * The error of an area is at most 1e-3 times the reach times the length of the outline of the touching part
 * (docs/theory/measures.md). If the reach is below 1/250 of the diagonal of the surface's bounding box, details smaller than
 * 1/2000 of this diagonal are lost.
 * Errors: RIIS_INVALID_ARGUMENT if the surface lacks the leaflet, and if the reach is out of range. */
RIIS_API riis_status riis_surface_get_coaptation(const riis_surface *surface, double reach, int32_t leaflet_id,
                                                 riis_coaptation *coaptation, int64_t struct_size);

/* Gives the ideal leak of a closed surface: the volume flow drop * (eps / R) * area that a pressure drop causes. The area is that
 * of the surface without a bileaflet housing. If the surface has an offset o, the area is that of the surface after a shift by o
 * eps along its normals. The leak in a solver differs from the ideal leak (docs/solvers.md).
 *   `resistance`: the call uses only R, 1e-60 to 1e60, and half_thickness, which is eps. For half_thickness, RIIS_AUTO stands for
 *     the surface's half thickness.
 *   `drop`: upstream pressure minus downstream pressure, at most 1e30 in magnitude.
 *   `flow`: the volume flow, in the unit of drop * area * eps / R. In SI units this is m^3/s.
 * Errors: RIIS_INVALID_ARGUMENT for a bad field or argument; the message names the field or argument and its value. */
RIIS_API riis_status riis_surface_get_leak(const riis_surface *surface, const riis_resistance *resistance,
                                           double drop, double *flow);

/* Options of riis_find_first_passage. */
typedef struct riis_first_passage_options {
  int64_t struct_size;                 /* set by the init function */
  const riis_surface_options *surface; /* options of the valve's surface. NULL, the default, stands for defaults */
  const riis_mark_options *marking;    /* options of riis_find_passage. NULL, the default, stands for defaults */
  double tolerance;                    /* tolerance of the opening, 1e-6 to 1. Default 1e-3 */
} riis_first_passage_options;
/* Fills *options with the defaults. */
RIIS_API riis_status riis_first_passage_options_init(riis_first_passage_options *options, int64_t struct_size);
/* The result of riis_find_first_passage. */
enum {
  RIIS_FIRST_PASSAGE_FOUND = 0,  /* the mesh has no passage at opening 0, and has one at a larger opening */
  RIIS_FIRST_PASSAGE_ALWAYS = 1, /* the mesh has a passage already at opening 0 */
  RIIS_FIRST_PASSAGE_NEVER = 2,  /* no opening that was tried has a passage */
  RIIS_FIRST_PASSAGE_NONE = 3    /* the mesh itself has no path */
};
/* The first opening at which the marked mesh has a passage. */
typedef struct riis_first_passage {
  double opening;        /* the first opening with a passage; 0 for ALWAYS, 1 for NEVER, 0 for NONE */
  double closed_opening; /* with RIIS_FIRST_PASSAGE_FOUND, the largest opening below `opening` at which the call found no passage.
                            In other states it equals `opening` */
  int64_t node_id;       /* the node of the passage at `opening`, as in riis_passage */
  double distance;       /* as in riis_passage */
  double point[3];       /* as in riis_passage */
  double seconds;        /* wall time of riis_find_first_passage */
  int32_t n_openings;    /* the number of openings that were tried */
  int32_t state;         /* RIIS_FIRST_PASSAGE_* */
} riis_first_passage;
/* Finds the first opening of a valve at which riis_find_passage finds a passage.
 *   `valve`: the valve, whose own opening is ignored.
 *   `mesh`: a mesh with an adjacency, marked or not.
 *   `ends`: as for riis_find_passage. At each opening that is tried, all ends must be outside the band.
 * The call tries the openings 0, 1/8, 2/8, ... until it finds a passage. Then it halves the interval between closed_opening and
 * opening until the interval is at most as long as the tolerance. A passage may close again when the valve opens further. The
 * call may therefore miss a passage that exists only between two multiples of 1/8.
 * Errors: as riis_surface_create and riis_find_passage; the message also names the opening. RIIS_INVALID_PARAMETER for a valve
 * with only one state. */
RIIS_API riis_status riis_find_first_passage(const riis_valve *valve, const riis_mesh *mesh,
                                             const riis_passage_ends *ends,
                                             const riis_first_passage_options *options,
                                             riis_first_passage *first, int64_t struct_size);

/* How many mesh edges fit across the band, computed from the lengths of the mesh edges with a marked node. */
typedef struct riis_cells_across {
  double least, mean, most; /* the numbers of mesh edges across the band: 2 * half_thickness divided by longest_edge, by mean_edge
                               and by shortest_edge */
  double shortest_edge, mean_edge, longest_edge; /* the lengths of the mesh edges with a marked node */
  double half_thickness; /* the half thickness of the marking */
  int64_t n_edges;       /* the number of edges with at least one marked node. If n_edges is 0, all fields except half_thickness
                            are 0 */
} riis_cells_across;
/* Computes how many mesh edges fit across the band. An edge counts once, even if the adjacency has it in the rows of both of its
 * nodes. Edges to ghosts and edges of length 0 do not count.
 *   `marks`: marks from riis_mark_nodes.
 *   `mesh`: the mesh of the marking, with an adjacency.
 * Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, if the marks are empty, and if the marks and the mesh differ in the
 * number of nodes. RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_marks_get_cells_across(const riis_marks *marks, const riis_mesh *mesh,
                                                 riis_cells_across *cells, int64_t struct_size);

/* Gives the volume that the valve sweeps between two openings, in mesh units cubed. The volume is the integral of u_surface . n
 * over surface and time, so motion in the direction of the normals counts as positive. In a flow, a valve displaces less blood
 * than this volume, because blood slips past the leaflets.
 *   `opening_from`, `opening_to`: 0 to 1. The valve's own opening is ignored.
 *   `options`: only scale, flip_normals and n_threads are used. NULL stands for the defaults.
 *   `leaflet_id`: RIIS_LEAFLET_*, a leaflet_id of the caller's patches, or RIIS_ALL_LEAFLETS.
 * The error is at most 1e-3 times the largest volume that any single leaflet sweeps from opening 0 to 1
 * (docs/theory/measures.md).
 * Errors: RIIS_INVALID_ARGUMENT if an opening is out of range, and if the valve has no leaflet of this id. RIIS_INVALID_PARAMETER
 * if parameters do not fit together, and for an opening above 0 of a valve that has only one state. */
RIIS_API riis_status riis_valve_get_swept_volume(const riis_valve *valve, double opening_from, double opening_to,
                                                 const riis_surface_options *options, int32_t leaflet_id,
                                                 double *volume);

#ifdef __cplusplus
}
#endif

#endif
