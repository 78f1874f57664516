/* SPDX-License-Identifier: Apache-2.0
 *
 * Writes structured grids by VTK, and unstructured grids of the same nodes and cells. No code of riis is used. */
#ifndef RIIS_TESTS_GRIDS_SHIM_H
#define RIIS_TESTS_GRIDS_SHIM_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct shim_grid {
  int n[3], first[3]; /* the number of nodes along each axis, and the index of an image's first node */
  double origin[3], spacing[3];
  double turn;        /* the turn of an image about z, in radians */
  const double *x[3]; /* (n) of a rectilinear grid; NULL for an image */
  int is_single;      /* coordinates of a rectilinear or curvilinear grid have single precision */
  double bend;        /* the size of the smooth shift of a curvilinear grid */
  int is_curved;
  int n_zones; /* the number of values of a cell array "zone"; 0: no such array */
} shim_grid;

/* Writes an image, a rectilinear or a curvilinear grid with the point array "value" and the cell array "sample". The path ends in
 * .vti, .vtr, .vts or .vtk. vtk_shim.h lists the encodings. Returns 1 on success. */
int shim_write_grid(const char *path, int encoding, const shim_grid *grid);
/* Writes the nodes, cells and arrays to a .vtu. Cells of volume are hexahedra. */
int shim_write_grid_as_cells(const char *path, const shim_grid *grid);
/* Reads a .vti or .vtr. Gives the coordinates along each axis, and the values of a point array as doubles, (n_components, n).
 * Returns 1 on success. */
int shim_read_grid(const char *path, int n[3], double *const x[3], const char *array, double *values);

#ifdef __cplusplus
}
#endif

#endif
