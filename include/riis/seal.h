/* SPDX-License-Identifier: Apache-2.0
 * seal.h - tests whether the marked nodes let no flow through the surface: leaks, open regions, and the widest passage.
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

/* Finds the mesh edges that leak through the surface. An edge of the mesh's adjacency leaks if both of its nodes are unmarked and
 * the edge crosses or touches a triangle of the surface.
 *   `surface`, `mesh`: the surface and the mesh of the marking. The mesh must have an adjacency.
 *   `marks`: marks from riis_mark_nodes.
 *   `options`: the options of the marking. An edge with a node that node_mask leaves out does not leak.
 *   `leaks`: its content is replaced.
 * The decision is exact for coordinates in double precision; coordinates below 1e-90 count as 0. The adjacency may have an edge
 * in the row of one of its nodes or in the rows of both. The list has the edge once. Edges to ghosts are ignored. Edges that are
 * at most two half thicknesses long do not leak (docs/meshes.md). With an offset o, this length is 2 (1 - |o|) half thicknesses.
 * Longer edges may leak beside rims, but seldom if they are at most 2 sqrt(1 - o^2) half thicknesses long. With an offset, an
 * edge does not leak if both of its nodes are on the same side and away from rims, because the edge then only cuts the corner of
 * a fold. If the same triangles are marked again with the half thickness of riis_leak_list, no edge leaks, except with
 * RIIS_SEARCH_PAPER. However, an update with this half thickness moves a valve's triangles by up to tolerance * half_thickness,
 * so search for leaks again after the update.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, for empty marks, and for marks with another number of nodes or
 * another half thickness. RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_find_leaks(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_marks *marks, const riis_mark_options *options,
                                     riis_leaks *leaks);

/* Mesh edges that leak, in the order of the first node's id, then of the second node's id. Lengths are in mesh units. */
typedef struct riis_leak_list {
  int64_t n_edges;            /* the number of edges that leak. If this number is 0, node ids are -1, and all other fields except
                                 seconds are 0 */
  const int64_t *node_id;     /* (2, n_edges): the two nodes, the lower id first */
  const double *length;       /* (n_edges) */
  const double *distance;     /* (n_edges): the least half thickness at which the edge does not leak. Without an offset this is
                                 the distance of the edge's nearer node */
  double half_thickness;      /* the smallest half thickness that gives each edge a marked node, for these triangles */
  int64_t longest_node_id[2]; /* the nodes of the longest edge, the lower id first. If several edges are equally long, the first
                                 edge counts */
  double longest_length;      /* the length of this edge */
  double longest_middle[3];   /* the middle of this edge */
  double seconds;             /* wall time of riis_find_leaks */
} riis_leak_list;
/* Gives the edges of the last riis_find_leaks, until the next riis_find_leaks with these leaks. */
RIIS_API riis_status riis_leaks_get_list(const riis_leaks *leaks, riis_leak_list *list, int64_t struct_size);

/* ---- Open regions and passages: whether the unmarked nodes connect two regions (docs/meshes.md) -------- */

/* Labels the open regions: the connected components of the unmarked nodes, along mesh edges.
 *   `mesh`: the mesh of the marking, with an adjacency.
 *   `marks`: marks from riis_mark_nodes.
 *   `options`: the options of the marking; nodes that node_mask leaves out are in no region.
 *   `n_nodes`: the number of nodes of the marking.
 *   `label` (n_nodes): for each node, the lowest node id of its region, or -1 outside all regions.
 *   `n_regions`: the number of regions; may be NULL.
 * The adjacency may have an edge in the row of one of its nodes or in the rows of both. Edges to ghosts are ignored: with MPI,
 * ranks must exchange their labels (examples/mpi_leaks.c).
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency, for empty marks, and for marks with another number of nodes. */
RIIS_API riis_status riis_label_open_regions(const riis_mesh *mesh, const riis_marks *marks,
                                             const riis_mark_options *options, int64_t n_nodes, int64_t *label,
                                             int64_t *n_regions);

/* Whether there is a passage between two sets of nodes. */
enum {
  RIIS_PASSAGE_CLOSED = 0, /* no: each path between the sets has a node within the half thickness */
  RIIS_PASSAGE_OPEN = 1,   /* yes: some path has no node within the half thickness */
  RIIS_PASSAGE_NONE = 2    /* no: the mesh itself has no path between the sets */
};
/* The widest passage from one set of nodes to another: the path along mesh edges that stays as far from the surface as
 * possible. */
typedef struct riis_passage {
  int64_t node_id;  /* of all nodes of the path, the node nearest to the surface; -1 without a path. If nodes have equal
                       distances, the higher id counts as nearest */
  double distance;  /* the distance of node_id. If the half thickness is at least this distance, the passage is closed, otherwise
                       it is open. 0 without a path. With an offset o, `distance` is the least half thickness that marks the node,
                       and nodes are ordered by it: s / (1 + o) for a signed distance s >= 0, and -s / (1 - o) for s < 0 */
  double point[3];  /* the coordinates of node_id; 0 without a path */
  double seconds;   /* wall time of riis_find_passage */
  int32_t state;    /* RIIS_PASSAGE_* */
  int32_t reserved; /* 0 */
} riis_passage;
/* The two sets of nodes between which a passage is searched. */
typedef struct riis_passage_ends {
  int64_t struct_size; /* set by the init function */
  int64_t n_from;      /* at least 1 */
  const int64_t *from; /* (n_from): the ids of the nodes at which paths begin, in any order */
  int64_t n_to;        /* at least 1 */
  const int64_t *to;   /* (n_to): the ids of the nodes at which paths end, in any order. A node in both sets is a path by
                          itself */
} riis_passage_ends;
RIIS_API riis_status riis_passage_ends_init(riis_passage_ends *ends, int64_t struct_size); /* the defaults */
/* Finds the widest passage along the edges of the mesh's adjacency, whether it is open or closed.
 *   `mesh`: must have an adjacency, and need not have been marked.
 *   `ends`: a path includes its two ends, so the distances of the ends from the surface also limit the passage.
 *   `options`: only node_mask, n_threads and instructions are used. No path passes through a node that node_mask leaves out.
 * An update with another half thickness moves a valve's triangles by up to tolerance * half_thickness, so search again after the
 * update.
 * Errors: RIIS_INVALID_ARGUMENT for a mesh without adjacency. RIIS_INVALID_ARGUMENT also for a node in `from` or `to` that is not
 * in the mesh, that node_mask leaves out, or whose distance from the surface is at most the half thickness. RIIS_INVALID_MESH as
 * riis_mark_nodes. */
RIIS_API riis_status riis_find_passage(const riis_surface *surface, const riis_mesh *mesh,
                                       const riis_passage_ends *ends, const riis_mark_options *options,
                                       riis_passage *passage, int64_t struct_size);

#ifdef __cplusplus
}
#endif

#endif
