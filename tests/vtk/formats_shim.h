/* SPDX-License-Identifier: Apache-2.0
 *
 * C wrappers of VTK for tests of mesh formats. The wrappers use no code of riis. Files are .vtu or legacy .vtk files. */
#ifndef RIIS_TESTS_FORMATS_SHIM_H
#define RIIS_TESTS_FORMATS_SHIM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The ways to compare meshes. SHIM_BITS compares the bits of coordinates, and the order of the corners of each cell. SHIM_SETS
 * ignores the order of corners. SHIM_FLOATS compares as SHIM_BITS does, after rounding to single precision. */
enum { SHIM_BITS, SHIM_SETS, SHIM_FLOATS };
/* Compares two meshes whose nodes and cells may have different orders. counts[0] and counts[1] get the numbers of points and
 * cells of `a`. counts[2] and counts[3] get the numbers of points and cells that only one mesh has. Returns 0 if a file cannot be
 * read. */
int shim_compare_meshes(const char *a, const char *b, int how, int64_t counts[4]);

/* Counts the cells of each of VTK's types. For each node inside a side, face or cell of second order, VTK's parametric
 * coordinates give a place between the corners. Returns the largest distance of a node from its place. Returns -1 if the file
 * cannot be read. */
double shim_bend(const char *path, int64_t n_of_type[100]);

/* Writes the mesh in two blocks with separate points: one has the even cells, and one the odd cells. The file is a .vtm, or
 * Exodus by VTK. With with_ids, the points of a .vtm's blocks have global ids. Returns 1 on success, or 0 if VTK lacks Exodus. */
int shim_write_exodus(const char *path, const char *mesh);
int shim_write_vtm(const char *path, const char *mesh, int with_ids);

#ifdef __cplusplus
}
#endif

#endif
