/* SPDX-License-Identifier: Apache-2.0
 *
 * Wraps VTK for tests in C. The functions make files and read files without any code of riis. The assertions stay in C, because a
 * failed assertion leaves the test by longjmp. Every function releases its VTK objects before it returns. */
#ifndef RIIS_TESTS_VTK_SHIM_H
#define RIIS_TESTS_VTK_SHIM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The encoding of a file. */
enum { SHIM_ASCII, SHIM_BINARY, SHIM_COMPRESSED, SHIM_RAW, SHIM_LEGACY_ASCII, SHIM_LEGACY_BINARY };

/* Writes a box of n x n x n nodes from `lower` to `upper`. The order of the nodes is shuffled, and each small box is cut into 6
 * tetrahedra. The point arrays are "pressure" (double), "velocity" (3 float) and "name" (string, XML only). The cell array is
 * "region" (short), and the field array is "time" (double). Points are double or float. Returns 1 on success. */
int shim_write_box(const char *path, int encoding, int n, const double lower[3], const double upper[3],
                   int float_points);

/* Writes a box like shim_write_box. A .vtu has tetrahedra and polyhedra, and a .vtp has the outer triangles. Both files have the
 * numeric arrays of shim_write_box. The encoding is SHIM_ASCII, SHIM_BINARY, appended base64 (SHIM_COMPRESSED) or appended raw
 * (SHIM_RAW).
 *   compressor   0 none, 1 zlib, 2 LZ4, 3 LZMA; blocks are small, so that there are several
 *   header_bits  32 or 64
 * Returns 1 on success. */
int shim_write_blocks(const char *path, int encoding, int compressor, int header_bits);

/* Writes a legacy file of version 42 or 51 with 40 points and one tetrahedron. The file has the data that VTK's writer puts after
 * arrays: ranges, and the name of one component of "flow". The file's last array is the bit array "bits". Returns 1 on
 * success. */
int shim_write_legacy(const char *path, int binary, int version);

/* Reads the numbers of points and cells of a .vtu, .vtp or .vtk grid file. If xyz is not NULL, writes the points as doubles to
 * xyz (3, n). point_type gets VTK's name of the points' type. Returns 0 if VTK cannot read the file. */
int shim_read_points(const char *path, int64_t *n_points, int64_t *n_cells, char point_type[32], double *xyz);

/* Writes the pieces of a .vtu or .pvtu file to a .pvtu file with the same number of pieces, by VTK's parallel writer. Returns 1
 * on success. */
int shim_write_pieces(const char *path, const char *pvtu, int n_pieces);
/* Reads a .pvtu file by VTK's reader, as ParaView does. Adds up a point array over all points of all pieces. Returns the number
 * of points, or -1. */
int64_t shim_read_pieces(const char *pvtu, const char *array, double *sum, int64_t *n_cells);

/* Reads the corners of all cells, one after the other. Returns the number of corners, or -1. ids may be NULL. */
int64_t shim_read_corners(const char *path, int64_t *ids);

/* Writes a .vtu of random cells among n_shim_zoo nodes, several cells of each type. The types are the linear volumes, vertices,
 * lines, triangles and quads. Pentagonal prisms, quadratic tetrahedra and polyhedra also occur. Returns 1 on success. */
enum { n_shim_zoo = 60 };
int shim_write_zoo(const char *path);

/* Reads the edges of the cells of one VTK type by vtkCell::GetEdge, as pairs of nodes. Returns the number of edges, or -1. edges
 * may be NULL. */
int64_t shim_read_edges(const char *path, int cell_type, int64_t *edges);

/* Gives VTK's shape functions of a type of cells at a point of its unit cell, and their derivatives. First come the
 * derivatives of all nodes with respect to the first coordinate, then those for the second and for the third. Returns the number
 * of nodes. */
int shim_shape_functions(int cell_type, const double point[3], double *values, double *derivatives);

/* Writes a .vtu of random cells of all types of higher order. The cells use n_nodes nodes, which must be 64 or more. Returns 1 on
 * success. */
int shim_write_curved(const char *path, int n_nodes, uint32_t seed);
/* Reads the edges of cells of higher order from a .vtu file, as pairs of nodes. The edges are found from the nodes' positions
 * in unit cells. Returns the number of edges. `edges` may be NULL. */
int64_t shim_read_curved_edges(const char *path, int64_t *edges);

/* Writes a .vtu of the tetrahedra that vtkDelaunay3D makes between the points xyz (3, n). The file has all points, in their order
 * and as doubles. Returns 1 on success. */
int shim_write_delaunay(const char *path, int64_t n, const double *xyz);

/* Reads an array. `where` is 'p' for point, 'c' for cell or 'f' for field. If `values` is not NULL, writes the values as doubles.
 * Returns 0 if there is no such array. */
int shim_read_array(const char *path, char where, const char *name, char type[32], int64_t *n_components,
                    int64_t *n_tuples, double *values);

/* Reads the picture's width, height and number of different colours. Also counts the strongly coloured pixels in the left and
 * the right half. */
int shim_read_png(const char *path, int *width, int *height, int *n_colours, int n_coloured[2]);

/* Returns the picture's pixels, rgb (3, width, height), from the lower left corner on. Returns NULL if the picture cannot be
 * read. The caller frees them. */
unsigned char *shim_read_pixels(const char *path, int *width, int *height);

/* Does what shim_read_pixels does, with the opacity as fourth channel. Returns NULL if the picture has only three channels. */
unsigned char *shim_read_clear_pixels(const char *path, int *width, int *height);

/* Finds the flat ends of a wall of triangles, corners (3, n_triangles), as pictures do. is_end (n_triangles) gets 1 for each
 * triangle of an end. Returns whether nearly all of the wall is ends. */
int shim_flat_ends(int64_t n_points, const double *xyz, int64_t n_triangles, const int64_t *corners,
                   unsigned char *is_end);

/* Compares the outside of a grid's volume cells, as pictures draw it, with VTK's outside. Returns the number of faces that occur
 * in only one of the two outsides, or -1 if the grid cannot be read. *n_faces gets the number of faces in pictures. *n_inwards
 * gets the number of these faces that point into their cell. */
int64_t shim_compare_outside(const char *path, int64_t *n_faces, int64_t *n_inwards);

/* VTK's searches for the distance from a point to triangles. */
enum { SHIM_STATIC_LOCATOR, SHIM_CELL_LOCATOR, SHIM_IMPLICIT_DISTANCE };
void shim_distances(int method, int64_t n_vertices, const double *vertices, int64_t n_triangles, const int64_t *corners,
                    int64_t n_points, const double *points, double *distances);

/* Replaces VTK's output window by a counter. shim_n_messages returns the number of messages since this call. */
void shim_watch_window(void);
int shim_n_messages(void);
/* Sends an error to the current output window, as a caller that uses VTK might do. */
void shim_say_error(void);

#ifdef __cplusplus
}

class vtkPolyData;
template <class T>
class vtkSmartPointer;

// Returns triangles with the vertices xyz (3, n_points) and corners (3, n_triangles). The functions of other shims use the
// returned triangles.
vtkSmartPointer<vtkPolyData> shim_polydata(int64_t n_points, const double *xyz, int64_t n_triangles,
                                           const int64_t *corners);
#endif

#endif
