/* SPDX-License-Identifier: Apache-2.0
 *
 * VTK itself, for tests: makes files and reads them back without any code of riis. C, since a failed assertion leaves
 * by longjmp; every function has let go of its VTK objects when it returns. */
#ifndef RIIS_TESTS_VTK_SHIM_H
#define RIIS_TESTS_VTK_SHIM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a file is encoded. */
enum { SHIM_ASCII, SHIM_BINARY, SHIM_COMPRESSED, SHIM_RAW, SHIM_LEGACY_ASCII, SHIM_LEGACY_BINARY };

/* Writes a box of n x n x n nodes from lower to upper, each small box cut into 6 tetrahedra, the nodes in a shuffled
 * order; point arrays "pressure" (double), "velocity" (3 float), "name" (string, XML only), cell array "region"
 * (short), field array "time" (double). Points are double or float. Returns 1 on success. */
int shim_write_box(const char *path, int encoding, int n, const double lower[3], const double upper[3],
                   int float_points);

/* Writes a legacy file of 40 points and one tetrahedron, of version 42 or 51, with what VTK's writer puts behind
 * arrays: ranges, the name of one component of "flow"; last a bit array "bits". Returns 1 on success. */
int shim_write_legacy(const char *path, int binary, int version);

/* Numbers of points and cells of a .vtu or .vtp or .vtk grid file; points as doubles to xyz (3, n) if it is not NULL.
 * point_type gets VTK's name of the points' type. Returns 0 if VTK cannot read the file. */
int shim_read_points(const char *path, int64_t *n_points, int64_t *n_cells, char point_type[32], double *xyz);

/* The corners of all cells, one after the other; returns how many, or -1. ids may be NULL. */
int64_t shim_read_corners(const char *path, int64_t *ids);

/* Writes a .vtu of cells of many types among n_shim_zoo nodes, several of each type, their nodes drawn at random: the linear
 * volumes that have edges for riis, and vertices, lines, triangles, quads, a pentagonal prism, a quadratic tetrahedron, a
 * polyhedron. The last nodes are in no cell of volume. Returns 1 on success. */
enum { n_shim_zoo = 60 };
int shim_write_zoo(const char *path);

/* Edges of the cells of one VTK type by vtkCell::GetEdge, as pairs of nodes; returns how many, or -1. edges may be NULL. */
int64_t shim_read_edges(const char *path, int cell_type, int64_t *edges);

/* Writes a .vtu of the tetrahedra by vtkDelaunay3D between the points, xyz (3, n), all of them in their order, as doubles.
 * Returns 1 on success. */
int shim_write_delaunay(const char *path, int64_t n, const double *xyz);

/* An array: where is 'p' point, 'c' cell or 'f' field. Values as doubles if values is not NULL. Returns 0 if there is
 * none. */
int shim_read_array(const char *path, char where, const char *name, char type[32], int64_t *n_components,
                    int64_t *n_tuples, double *values);

/* Width, height, how many different colours, and how many pixels of the left and the right half differ from the
 * corner's colour. */
int shim_read_png(const char *path, int *width, int *height, int *n_colours, int n_coloured[2]);

/* The picture's pixels, rgb (3, width, height), the lower left corner first, for free(); NULL if it cannot be read. */
unsigned char *shim_read_pixels(const char *path, int *width, int *height);

/* Compares the outside of the volumes of a grid, as pictures draw it, with VTK's. Returns how many faces are only in one of them, or -1
 * where the grid cannot be read; *n_faces gets how many the pictures have, *n_inwards how many look into their cell. */
int64_t shim_compare_outside(const char *path, int64_t *n_faces, int64_t *n_inwards);

/* Distances of points to triangles by VTK's own searches. */
enum { SHIM_STATIC_LOCATOR, SHIM_CELL_LOCATOR, SHIM_IMPLICIT_DISTANCE };
void shim_distances(int method, int64_t n_vertices, const double *vertices, int64_t n_triangles, const int64_t *corners,
                    int64_t n_points, const double *points, double *distances);

/* Makes VTK's output window one that counts; shim_n_messages is how many messages reached it since. */
void shim_watch_window(void);
int shim_n_messages(void);
/* Sends an error to whatever output window there is now, as VTK code of the caller's would. */
void shim_say_error(void);

#ifdef __cplusplus
}
#endif

#endif
