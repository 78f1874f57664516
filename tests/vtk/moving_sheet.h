/* SPDX-License-Identifier: Apache-2.0
 *
 * Makes a sheet of triangles whose vertices move in straight lines, and writes its files. At the times 0, 1/4, 1/2 and 1, the
 * coordinates are whole multiples of 1/64, so every file holds them exactly. */
#ifndef RIIS_TESTS_MOVING_SHEET_H
#define RIIS_TESTS_MOVING_SHEET_H

#include <stdint.h>

enum { sheet_n_vertices = 20, sheet_n_triangles = 24 };

/* Gives a vertex at a time, and its velocity. */
void sheet_vertex(int64_t vertex, double time, double xyz[3], double velocity[3]);
/* Gives the corners of a triangle, and the leaflet that the files state for it, 3 or 7. */
void sheet_triangle(int64_t triangle, int64_t corners[3], int32_t *leaflet);

/* Writes the sheet at a time into the scratch folder. The given text is inserted between the elements of a .vtp or .vtu file.
 *   name  ends in .vtp, .vtu or .stl (binary), or .STL (ASCII) */
typedef struct sheet_extras {
  const char *point_data, *field_data; /* XML text to insert, or NULL */
} sheet_extras;
void sheet_write(const char *name, double time, const sheet_extras *extras);

/* Appends a point array to a text: the displacements of the sheet from time 0 to another time. Returns the end of the text. */
char *sheet_displacement(char *text, const char *name, double time);

#endif
