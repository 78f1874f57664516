/* SPDX-License-Identifier: Apache-2.0 seal.h - tests whether the marked nodes stop the flow through the surface: leaks, open
 * regions, and the widest passage. The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_SEAL_H
#define RIIS_SEAL_H

#include "marks.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Leaks: where the mesh is too coarse for the marks to close the surface (docs/meshes.md) ----------- */

/* The edges that riis_find_leaks found. Make one object, and pass this object to every call of riis_find_leaks. */
typedef struct riis_leaks riis_leaks;
RIIS_API riis_status riis_leaks_create(riis_leaks **leaks); /* makes an object without edges */
RIIS_API void riis_leaks_destroy(riis_leaks **leaks); /* destroys the leaks and their list */

/* Finds the mesh edges that leak through the surface. An edge of the mesh's adjacency leaks if its two nodes are unmarked and the
 * edge crosses or touches a triangle of the surface.
 *   `surface`, `mesh`: the surface and the mesh of the marking. The mesh must have an adjacency.
 *   `marks`: marks from riis_mark_nodes.
 *   `options`: the options of the marking. If node_mask leaves out a node of an edge, the edge does not leak.
 *   `leaks`: its content is replaced.
 * The test is exact for coordinates in double precision; coordinates below 1e-90 in magnitude count as 0. Each edge is listed
 * once, even if the adjacency has it in the rows of both of its nodes. Edges to ghosts are ignored. Edges whose length is at most
 * two half thicknesses do not leak (docs/meshes.md). With an offset o, edges whose length is at most 2 (1 - |o|) half thicknesses
 * do not leak. Longer edges of up to 2 sqrt(1 - o^2) half thicknesses seldom leak, and only beside rims. With an offset, an edge
 * also does not leak if both of its nodes are on the same side of the surface and away from rims. Such an edge only cuts the
 * corner of a fold. If the same triangles are marked with the half thickness riis_leak_list.half_thickness, no edge leaks, except
 * with RIIS_SEARCH_PAPER. However, an update with this half thickness moves a valve's triangles by up to tolerance *
 * half_thickness, so call riis_find_leaks again after the update.
 * Errors: RIIS_INVALID_ARGUMENT if the mesh has no adjacency, if the marks are empty, if the marks and the mesh differ in the
 * number of nodes, and if the marks and the surface differ in the half thickness. RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_find_leaks(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_marks *marks, const riis_mark_options *options,
                                     riis_leaks *leaks);

/* Mesh edges that leak, in the order of the first node's id, then of the second node's id. Lengths are in mesh units. */
typedef struct riis_leak_list {
  int64_t n_edges;            /* the number of edges that leak. If n_edges is 0, the node ids are -1, and all other fields except
                                 seconds are 0 */
  const int64_t *node_id;     /* (2, n_edges): the two nodes, the lower id first */
  const double *length;       /* (n_edges) */
  const double *distance;     /* (n_edges): for each edge, the least half thickness with which the edge does not leak. Without an
                                 offset, this is the distance of the edge's nearer node from the surface */
  double half_thickness;      /* the least half thickness with which each edge of the list has a marked node, for the present
                                 triangles */
  int64_t longest_node_id[2]; /* the nodes of the longest edge, the lower id first. Of equally long edges, the first one counts */
  double longest_length;      /* the length of this edge */
  double longest_middle[3];   /* the middle of this edge */
  double seconds;             /* wall time of riis_find_leaks */
} riis_leak_list;
/* Gives the edges that the last riis_find_leaks found. The list is valid until the next riis_find_leaks with the same object. */
RIIS_API riis_status riis_leaks_get_list(const riis_leaks *leaks, riis_leak_list *list, int64_t struct_size);

/* ---- Open regions and passages: whether the unmarked nodes connect two regions (docs/meshes.md) -------- */

/* Labels the open regions: the connected components of the unmarked nodes, along mesh edges.
 *   `mesh`: the mesh of the marking, with an adjacency.
 *   `marks`: marks from riis_mark_nodes.
 *   `options`: the options of the marking. Nodes that node_mask leaves out belong to no region.
 *   `n_nodes`: the number of nodes of the marking.
 *   `label` (n_nodes): for each node the lowest node id in its region, or -1 if the node belongs to no region.
 *   `n_regions`: the number of regions; may be NULL.
 * The adjacency need not be symmetric: it is enough if each edge is in the row of one of its two nodes. Edges to ghosts are
 * ignored, so with MPI the ranks must exchange their labels (examples/mpi_leaks.c).
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, for empty marks, and if the marks and the mesh differ in the number
 * of nodes. */
RIIS_API riis_status riis_label_open_regions(const riis_mesh *mesh, const riis_marks *marks,
                                             const riis_mark_options *options, int64_t n_nodes, int64_t *label,
                                             int64_t *n_regions);

/* Whether there is a passage between two sets of nodes. */
enum {
  RIIS_PASSAGE_CLOSED = 0, /* no: each path between the sets has a node in the band around the surface */
  RIIS_PASSAGE_OPEN = 1,   /* yes: at least one path has no node in the band */
  RIIS_PASSAGE_NONE = 2    /* no: the mesh itself has no path between the sets */
};
/* The widest passage from one set of nodes to another: the path along mesh edges that stays farthest from the surface. */
typedef struct riis_passage {
  int64_t node_id;  /* the node of the path that is nearest to the surface; -1 if there is no path. Of equally near nodes, the one
                       with the highest id counts */
  double distance;  /* the distance of node_id from the surface; 0 if there is no path. The passage is closed if the half
                       thickness is at least this distance, otherwise open. If the surface has an offset o, the distance of a node
                       is replaced by the least half thickness that marks the node. With the signed distance s, this is s / (1 +
                       o) for s >= 0, and -s / (1 - o) for s < 0 */
  double point[3];  /* the coordinates of node_id; 0 without a path */
  double seconds;   /* wall time of riis_find_passage */
  int32_t state;    /* RIIS_PASSAGE_* */
  int32_t reserved; /* 0 */
} riis_passage;
/* The two sets of nodes that a passage connects. */
typedef struct riis_passage_ends {
  int64_t struct_size; /* set by the init function */
  int64_t n_from;      /* at least 1 */
  const int64_t *from; /* (n_from): the ids of the nodes at which paths begin, in any order */
  int64_t n_to;        /* at least 1 */
  const int64_t *to;   /* (n_to): the ids of the nodes at which paths end, in any order. A node in both sets is itself a path */
} riis_passage_ends;
RIIS_API riis_status riis_passage_ends_init(riis_passage_ends *ends, int64_t struct_size); /* the defaults */
/* Finds the widest passage along the edges of the mesh's adjacency, whether it is open or closed.
 *   `mesh`: a mesh with an adjacency, marked or not.
 *   `ends`: the two sets. The first and the last node belong to the path, so their distances from the surface also limit the
 *     width of the passage.
 *   `options`: only node_mask, n_threads and instructions are used. No path passes through a node that node_mask leaves out.
 * An update with another half thickness moves a valve's triangles by up to tolerance * half_thickness, so search for the passage
 * again after the update.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, and for a bad node in `from` or `to`. A node is bad if it is not in
 * the mesh, if node_mask leaves it out, or if it lies in the band around the surface. RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_find_passage(const riis_surface *surface, const riis_mesh *mesh,
                                       const riis_passage_ends *ends, const riis_mark_options *options,
                                       riis_passage *passage, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
