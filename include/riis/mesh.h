/* SPDX-License-Identifier: Apache-2.0
 * mesh.h - meshes: the nodes that are marked, and their neighbours.
 * The header riis.h includes this file, and has the rules that hold for every call.
 */
/* clang-format off: argument lists in comments are laid out by hand */
#ifndef RIIS_MESH_H
#define RIIS_MESH_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Mesh: the nodes that are marked ------------------------------------------------------------------- */

/* The nodes of the caller's mesh. riis_mesh_create and riis_mesh_update borrow the coordinates of the nodes. The calls whose
 * names end in _copy copy the coordinates. */
typedef struct riis_mesh riis_mesh;

/* Makes a mesh that borrows the coordinates of its nodes, and checks them once. The coordinates must stay in place until the mesh
 * is updated or destroyed. With MPI, a process without nodes must also make a mesh, with n_nodes 0.
 *   `n_nodes`: 0 to 2^40; with 0 the pointers may be NULL.
 * Errors: RIIS_INVALID_MESH for a bad coordinate; the message names the node and the value. RIIS_LIMIT_EXCEEDED for too many
 * nodes. */
RIIS_API riis_status riis_mesh_create(int64_t n_nodes, const double *x, const double *y, const double *z,
                                      int64_t stride, riis_mesh **mesh);
/* Tells the mesh that coordinates have changed or are now in other arrays, and checks them again. Call this function after every
 * change of coordinates. If n_nodes is the same, the mesh keeps its adjacency. For a different mesh, make a new handle. Arguments
 * and errors are as in riis_mesh_create. */
RIIS_API riis_status riis_mesh_update(riis_mesh *mesh, int64_t n_nodes, const double *x, const double *y,
                                      const double *z, int64_t stride);
/* Makes a mesh with copies of the coordinates of its nodes, and checks them. Use this call for a temporary array of Fortran, or
 * for coordinates in single precision, which become doubles without rounding. The copies take 24 bytes per node.
 * Errors: as riis_mesh_create. */
RIIS_API riis_status riis_mesh_create_copy(const riis_points *nodes, riis_mesh **mesh);
/* Does the same as riis_mesh_update, but copies the coordinates. A mesh may change from borrowed coordinates to copies, and
 * back. */
RIIS_API riis_status riis_mesh_update_copy(riis_mesh *mesh, const riis_points *nodes);
/* Destroys the handle. The caller's coordinates and all marks stay. */
RIIS_API void riis_mesh_destroy(riis_mesh **mesh);
/* Makes the clusters for RIIS_SEARCH_CLUSTERS in advance, so that no marking has to make them. The clusters contain a copy of the
 * coordinates, so they take 41 bytes per node until the mesh is destroyed. While the call makes the clusters, it needs 32 more
 * bytes per node. For a grid, the call stores nothing per node.
 * Errors: RIIS_LIMIT_EXCEEDED for 2^32 nodes or more. RIIS_INVALID_MESH as riis_mark_nodes. */
RIIS_API riis_status riis_mesh_prepare(riis_mesh *mesh, int32_t n_threads);

/* A rectilinear grid: three axes, and the place of each node in the caller's arrays. Node (i, j, k) is at (x[i], y[j], z[k]), and
 * its number is first + i stride[0] + j stride[1] + k stride[2]. All these numbers count from 0. Some numbers below n_nodes may
 * belong to no node of the grid, for example if the caller's arrays have entries for a halo. */
typedef struct riis_grid {
  int64_t struct_size;   /* set by the init function */
  int64_t ni, nj, nk;    /* the numbers of nodes along the three axes, each >= 1 */
  const void *x;         /* (ni): the coordinates along the first axis, finite, strictly ascending, and at most 1e60 in magnitude.
                            NULL, the default, stands for origin[0] + i spacing[0] */
  const void *y;         /* (nj), likewise */
  const void *z;         /* (nk), likewise */
  double origin[3];      /* the first coordinate along each axis whose array is NULL. Default 0 */
  double spacing[3];     /* the spacing along each axis whose array is NULL, above 0. Default 1 */
  int64_t first;         /* the number of node (0, 0, 0), >= 0. Default 0 */
  int64_t stride[3];     /* for each axis, the difference between the numbers of two neighbouring nodes, >= 1. Two nodes must not
                            have the same number. The default 0 of all three entries stands for 1, ni and ni nj */
  int64_t n_nodes;       /* the length of the caller's arrays, more than the largest number of a node and at most 2^40. The
                            default 0 stands for the shortest possible length */
  int32_t real_bits;     /* of x, y and z: 64, the default, or 32 */
  int32_t reserved;      /* 0 */
} riis_grid;
RIIS_API riis_status riis_grid_init(riis_grid *grid, int64_t struct_size); /* the defaults */
/* Makes a mesh from the axes of a grid, and stores nothing for each node. A marking gives bitwise the same results as for a mesh
 * that riis_mesh_create makes from the same nodes. If riis_mesh_set_adjacency is not called, the mesh has the adjacency of
 * riis_adjacency_create_from_grid. Axes are not periodic. Markings of the mesh refuse RIIS_SEARCH_NEIGHBOR and RIIS_SEARCH_PAPER.
 * If the grid has more than 10^8 nodes, markings also refuse sampling and minimisation.
 *   `grid`: the grid; the call copies its axes. For all other calls, grid->n_nodes is the number of nodes of the mesh.
 * Errors: RIIS_INVALID_MESH for a bad axis; the message names the axis, the index and the value. RIIS_LIMIT_EXCEEDED if a node
 * has a number of 2^40 or more. */
RIIS_API riis_status riis_mesh_create_grid(const riis_grid *grid, riis_mesh **mesh);
/* Gives a mesh the axes of a grid, in place of its axes or points. riis_mesh_update makes such a mesh a mesh of points again.
 * Errors: as riis_mesh_create_grid. After an error the mesh keeps its nodes. */
RIIS_API riis_status riis_mesh_update_grid(riis_mesh *mesh, const riis_grid *grid);

/* The neighbours of nodes, as compressed sparse rows. Let base be the value of index_base. The neighbours of node i, with i from
 * 0 to n_rows - 1, are columns[k] - base, with k from offsets[i] - base to offsets[i + 1] - base - 1. */
typedef struct riis_csr {
  int64_t struct_size;   /* set by the init function */
  int64_t n_rows;        /* the mesh's n_nodes */
  int64_t n_all;         /* the number of nodes including ghosts, which are nodes of other ranks; at least n_rows. Every column is
                            below this number. Columns from n_rows on are ghosts, and are ignored. The default 0 stands for
                            n_rows */
  const void *offsets;   /* (n_rows + 1), ascending; the first offset is index_base, and a row may be empty. NULL only for 0
                            rows */
  const void *columns;   /* (offsets[n_rows] - base), the neighbours of each row in any order; repetitions and the row's own node
                            are ignored */
  int32_t offset_bits;   /* of offsets */
  int32_t column_bits;   /* of columns */
  int32_t index_base;    /* of both offsets and columns */
  int32_t reserved;      /* 0 */
} riis_csr;
RIIS_API riis_status riis_csr_init(riis_csr *csr, int64_t struct_size); /* the defaults */

/* Gives the mesh an adjacency, and checks the adjacency once. The adjacency is the edges along which the neighbour search walks.
 *   `csr`: the mesh borrows the arrays of the struct. These arrays must stay in place, unchanged, until the mesh is destroyed or
 *     gets another adjacency. NULL removes the adjacency. A call of riis_mesh_update with another n_nodes also removes the
 *     adjacency.
 * Errors: RIIS_INVALID_MESH for a bad row; the message names the row and its value. */
RIIS_API riis_status riis_mesh_set_adjacency(riis_mesh *mesh, const riis_csr *csr);

/* ---- Adjacency from cells, faces, or a structured grid ------------------------------------------------- */

/* An adjacency: compressed sparse rows that the library owns. The columns ascend without repetition, the adjacency is symmetric,
 * and the base is 0. */
typedef struct riis_adjacency riis_adjacency;

/* Cells of a mesh, with the ids of their nodes. The nodes of a cell have the order of VTK, Abaqus, CGNS and Gmsh: first the base,
 * then the apex or the nodes above the base. The number of nodes tells the shape: 4 for a tetrahedron, 5 for a pyramid, 6 for a
 * prism, 8 for a hexahedron. */
typedef struct riis_mesh_cells {
  int64_t struct_size;     /* set by the init function */
  int64_t n_nodes;         /* of the mesh, >= 0 */
  int64_t n_cells;         /* >= 0 */
  const void *node_ids;    /* the nodes of all cells, cell after cell; NULL only without cells */
  const void *offsets;     /* (n_cells + 1): the position in node_ids at which each cell begins, then the end of the last cell;
                              ascending from 0 or from index_base. NULL: all cells have nodes_per_cell nodes */
  int32_t nodes_per_cell;  /* the number of nodes of each cell: 4, 5, 6 or 8. Not used with offsets. Default 4 */
  int32_t id_bits;         /* of node_ids and offsets */
  int32_t index_base;      /* of node_ids */
  int32_t n_threads;       /* default 0 */
} riis_mesh_cells;
RIIS_API riis_status riis_mesh_cells_init(riis_mesh_cells *cells, int64_t struct_size); /* the defaults */
/* Makes an adjacency of nodes from cells. Two nodes are neighbours if an edge of a cell joins them.
 * Errors: RIIS_INVALID_MESH for a bad cell; the message names the cell and its value. */
RIIS_API riis_status riis_adjacency_create_from_cells(const riis_mesh_cells *cells, riis_adjacency **adjacency);

/* Faces between cells, for codes that mark cell centres. */
typedef struct riis_mesh_faces {
  int64_t struct_size;     /* set by the init function */
  int64_t n_cells;         /* the number of cells, >= 0. The nodes of the mesh are cell centres */
  int64_t n_faces;         /* >= 0 */
  const void *owner;       /* face i joins the cells owner[i * stride] and neighbor[i * stride] */
  const void *neighbor;    /* the second cell of each face. For a face at the boundary, which joins no cells, pass index_base - 1
                              (-1 or 0) */
  int64_t stride;          /* the distance between the entries of two successive faces, 1 to 1024. Default 1; for one array
                              face_cells(2, n_faces), pass 2 */
  int32_t id_bits;         /* of owner and neighbor */
  int32_t index_base;      /* of owner and neighbor */
  int32_t n_threads;       /* default 0 */
  int32_t reserved;        /* 0 */
} riis_mesh_faces;
RIIS_API riis_status riis_mesh_faces_init(riis_mesh_faces *faces, int64_t struct_size); /* the defaults */
/* Makes an adjacency of cells from faces. Two cells are neighbours if they have a common face.
 * Errors: RIIS_INVALID_MESH if an owner or neighbor is not a cell; the message names the face and the value. */
RIIS_API riis_status riis_adjacency_create_from_faces(const riis_mesh_faces *faces, riis_adjacency **adjacency);

/* Makes the adjacency of a structured grid. Two nodes (i, j, k) are neighbours if exactly one of the three numbers differs, by 1.
 *   `ni`, `nj`, `nk`: the numbers of nodes along the three axes, each >= 1. The number of node (i, j, k) is i + ni (j + nj k),
 *     all from 0.
 * Errors: RIIS_LIMIT_EXCEEDED for more nodes than memory can hold. */
RIIS_API riis_status riis_adjacency_create_from_grid(int64_t ni, int64_t nj, int64_t nk, int32_t n_threads,
                                                     riis_adjacency **adjacency);
/* Gives the compressed sparse rows of an adjacency, for riis_mesh_set_adjacency. The arrays belong to the adjacency. Offsets have
 * 64 bits. Columns have 32 bits for fewer than 2^31 nodes, otherwise 64 bits. */
RIIS_API riis_status riis_adjacency_get_csr(const riis_adjacency *adjacency, riis_csr *csr,
                                            int64_t struct_size);
/* Destroys the adjacency and its arrays. If a mesh borrows these arrays, destroy the mesh first. */
RIIS_API void riis_adjacency_destroy(riis_adjacency **adjacency);

#ifdef __cplusplus
}
#endif

#endif
