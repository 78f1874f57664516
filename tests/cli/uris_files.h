/* SPDX-License-Identifier: Apache-2.0
 *
 * Reads what riis-mark --export-uris wrote as svMultiPhysics reads it, and marks by its rule. Nothing here calls the library.
 * Functions fail the test if a file is not as the solver expects it. */
#ifndef RIIS_TESTS_URIS_FILES_H
#define RIIS_TESTS_URIS_FILES_H

#include <stdint.h>

enum { uris_most_faces = 4 };

/* One face of the solver's input: triangles, and positions (3, n_nodes) frame after frame. */
typedef struct {
  char name[64];
  int n_nodes, n_triangles, n_open, n_close;
  int *corner;                /* (3, n_triangles) */
  double *xyz, *open, *close; /* of the .vtu, (3, n_nodes), and of the motions */
} uris_face;

/* What the solver's input says of a valve. */
typedef struct {
  char name[64];
  int n_faces, has_scaffold;
  uris_face face[uris_most_faces]; /* the scaffold comes after the faces; it has no motion */
  double thickness, closed_thickness, resistance, normal[3];
} uris_valve;

/* Reads the printed block and all files that it names. */
uris_valve uris_read(const char *block);
void uris_free(uris_valve *valve);

/* The number behind <element>. Fails the test without it. */
double uris_number(const char *block, const char *element);

/* Frame k of a motion, (3, n_nodes). */
const double *uris_frame(const uris_face *face, const double *motion, int k);

/* The solver's signed distance of a point, in frame k of the opening: to the nearest middle of a triangle. The sign is that of
 * the nearest triangle's face, and in a closed valve also that of the direction of flow. */
double uris_distance(const uris_valve *valve, int k, int is_closed, const double point[3]);

#endif
