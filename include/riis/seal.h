/* SPDX-License-Identifier: Apache-2.0
 * seal.h - whether the marks close the surface on a mesh: leaks, open regions, and the widest passage.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_SEAL_H
#define RIIS_SEAL_H

#include "marks.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Leaks: where the mesh is too coarse for the marks to close the surface (docs/meshes.md) ----------- */

/* The edges that riis_find_leaks found. Make one object and reuse it. */
typedef struct riis_leaks riis_leaks;
RIIS_API riis_status riis_leaks_create(riis_leaks **leaks); /* makes leaks without an edge */
RIIS_API void riis_leaks_destroy(riis_leaks **leaks); /* destroys the leaks and their list */

/* Finds the leaking edges: edges of the mesh's adjacency between two unmarked nodes that cross or touch a triangle of
 * the surface.
 *   `surface`, `mesh`: the surface and the mesh of the marking. The mesh must have an adjacency.
 *   `marks`: marks from riis_mark_nodes.
 *   `options`: the options of the marking. An edge with a node that node_mask leaves out does not leak.
 *   `leaks`: its content is replaced.
 * The decision is exact for coordinates in double precision; coordinates below 1e-90 count as 0. An edge may be given in one
 * row or in both, and appears once in the list. Edges to ghosts are ignored. Edges that are at most two half thicknesses long
 * do not leak (docs/meshes.md). With an offset o, edges of at most 2 (1 - |o|) half thicknesses do not leak. Longer edges may
 * leak beside rims, but seldom if they are at most 2 sqrt(1 - o^2) half thicknesses long. With an offset, an edge does not leak
 * if both of its nodes are off rims and on the same side, because it only cuts the corner of a fold. If the same triangles are
 * marked again with the half thickness of riis_leak_list, no edge leaks. Only RIIS_SEARCH_PAPER may still leave leaks. However,
 * riis_surface_update with the half thickness of riis_leak_list moves a valve's triangles by up to tolerance * half_thickness.
 * Search for leaks again after such an update.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, and for marks that no marking has filled, or that
 * have another number of nodes or half thickness. RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_find_leaks(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_marks *marks, const riis_mark_options *options,
                                     riis_leaks *leaks);

/* Mesh edges that leak, ascending by their first node, then by their second. Lengths are in mesh units. */
typedef struct riis_leak_list {
  int64_t n_edges;            /* the number of edges that leak. If this number is 0, node ids are -1, and all other fields except
                                 seconds are 0 */
  const int64_t *node_id;     /* (2, n_edges): the two nodes, the lower id first */
  const double *length;       /* (n_edges) */
  const double *distance;     /* (n_edges): the least half thickness that closes the edge. Without an offset this is the distance
                                 of the edge's nearer node */
  double half_thickness;      /* the smallest half thickness that gives each edge a marked node, for these triangles */
  int64_t longest_node_id[2]; /* the nodes of the longest edge, ascending. Of equally long edges, the first edge counts */
  double longest_length;      /* the length of this edge */
  double longest_middle[3];   /* the middle of this edge */
  double seconds;             /* wall time of riis_find_leaks */
} riis_leak_list;
/* Gives the edges of the last riis_find_leaks, until the next riis_find_leaks with these leaks. */
RIIS_API riis_status riis_leaks_get_list(const riis_leaks *leaks, riis_leak_list *list, int64_t struct_size);

/* ---- Open regions and passages: whether the unmarked nodes connect two regions (docs/meshes.md) -------- */

/* Labels the open regions: the connected components of the nodes that a marking left unmarked, along mesh edges.
 *   `mesh`: the mesh of the marking, with an adjacency.
 *   `marks`: marks from riis_mark_nodes.
 *   `options`: the options of the marking; nodes that node_mask leaves out are in no region.
 *   `n_nodes`: the number of nodes of the marking.
 *   `label` (n_nodes), the lowest node id of the node's region, -1 for nodes in no region.
 *   `n_regions`: the number of regions; may be NULL.
 * An edge may be given in one row or in both. Edges to ghosts are ignored: with MPI, ranks must exchange their labels
 * (examples/mpi_leaks.c).
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, and for marks that no marking has filled, or that
 * have another number of nodes. */
RIIS_API riis_status riis_label_open_regions(const riis_mesh *mesh, const riis_marks *marks,
                                             const riis_mark_options *options, int64_t n_nodes, int64_t *label,
                                             int64_t *n_regions);

/* Whether there is a passage between two sets of nodes. */
enum {
  RIIS_PASSAGE_CLOSED = 0, /* no: each path between the sets has a node within the half thickness */
  RIIS_PASSAGE_OPEN = 1,   /* yes: some path has no node within the half thickness */
  RIIS_PASSAGE_NONE = 2    /* no: the mesh itself has no path between the sets */
};
/* The widest passage from one set of nodes to another: the path whose nearest node is as far from the surface as possible. */
typedef struct riis_passage {
  int64_t node_id;  /* the path's node that is nearest to the surface; -1 without a path. If nodes have equal distances,
                       the higher id counts as nearest */
  double distance;  /* the distance of node_id. A half thickness of at least this distance closes the passage between these
                       triangles. A smaller half thickness leaves the passage open. 0 without a path. With an offset o, `distance`
                       is the least half thickness that marks the node, and nodes are ordered by it: s / (1 + o) for a signed
                       distance s >= 0, and -s / (1 - o) for s < 0 */
  double point[3];  /* the coordinates of node_id; 0 without a path */
  double seconds;   /* wall time of riis_find_passage */
  int32_t state;    /* RIIS_PASSAGE_* */
  int32_t reserved; /* 0 */
} riis_passage;
/* The two sets of nodes that a passage joins. */
typedef struct riis_passage_ends {
  int64_t struct_size; /* set by the init function */
  int64_t n_from;      /* at least 1 */
  const int64_t *from; /* (n_from), node ids in any order: where paths begin */
  int64_t n_to;        /* at least 1 */
  const int64_t *to;   /* (n_to), node ids in any order: where paths end. A node in both sets is a path by itself */
} riis_passage_ends;
RIIS_API riis_status riis_passage_ends_init(riis_passage_ends *ends, int64_t struct_size); /* the defaults */
/* Finds the widest passage along the edges of the mesh's adjacency, whether it is open or closed.
 *   `mesh`: must have an adjacency, and need not have been marked.
 *   `ends`: a path includes its two ends, so the distances of the ends from the surface also limit the passage.
 *   `options`: only node_mask, n_threads and instructions are used. No path passes through a node that node_mask leaves out.
 * A new half thickness moves a valve's triangles by up to tolerance * half_thickness: search again after
 * riis_surface_update.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency; also if a node of from or to is not in the mesh, is left
 * out by node_mask, or is within the half thickness. RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_find_passage(const riis_surface *surface, const riis_mesh *mesh,
                                       const riis_passage_ends *ends, const riis_mark_options *options,
                                       riis_passage *passage, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
