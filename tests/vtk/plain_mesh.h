/* SPDX-License-Identifier: Apache-2.0
 *
 * Makes meshes as plain arrays, and .vtu files of these meshes. The files are written without VTK, so they can have layouts that
 * the installed VTK does not write. */
#ifndef RIIS_TESTS_PLAIN_MESH_H
#define RIIS_TESTS_PLAIN_MESH_H

#include <stdint.h>

/* Cells of one type, given by VTK's number. */
typedef struct plain_mesh {
  int type, n_corners;
  int64_t n_nodes, n_cells;
  double *xyz;  /* (3, n_nodes) */
  int64_t *ids; /* (n_corners, n_cells) */
} plain_mesh;

/* Makes a box of n x n x n nodes with hexahedra. */
plain_mesh plain_hexahedra(int n, const double lower[3], const double upper[3]);
/* Cuts each hexahedron into six tetrahedra around one of its diagonals. Each side of a tetrahedron gets a node in its middle. */
plain_mesh plain_quadratic_tetrahedra(const plain_mesh *hexahedra);
/* Cuts each quadratic tetrahedron at its nodes into eight tetrahedra. Four are at the corners, and four around a line between the
 * middles of two opposite sides. If n_parts is 4, makes only the tetrahedra at the corners. */
plain_mesh plain_cut(const plain_mesh *quadratic, int n_parts);
void plain_free(plain_mesh *mesh);

/* The layout of hexahedra in the file. Either all hexahedra stay, or two of three become polyhedra. The faces of polyhedra are in
 * a stream for each cell, or in one list for all cells. VTK writes one list for all cells since version 9.4. */
enum plain_layout { PLAIN_CELLS, PLAIN_STREAMS, PLAIN_LISTS };
/* Writes the file `name` into the scratch folder. Each piece has all nodes, and a part of the cells. */
void plain_write(const char *name, const plain_mesh *mesh, enum plain_layout layout, int n_pieces);

#endif
