/* SPDX-License-Identifier: Apache-2.0
 *
 * Reads the files of `riis export uris` as svMultiPhysics does, and marks nodes by the solver's rule. The code of these functions
 * does not call the library. The test fails if a file is not as the solver expects it. */
#ifndef RIIS_TESTS_URIS_FILES_H
#define RIIS_TESTS_URIS_FILES_H

#include <stdint.h>

enum { uris_most_faces = 5 };

/* A face of the solver's input has triangles, and positions (3, n_nodes) of each frame in turn. */
typedef struct {
  char name[64];
  int n_nodes, n_triangles, n_open, n_close;
  int *corner; /* (3, n_triangles) */
  /* xyz has the nodes of the .vtu file, (3, n_nodes). open and close have the nodes of each frame of the two motions. */
  double *xyz, *open, *close;
} uris_face;

/* The description of a valve in the solver's input. */
typedef struct {
  char name[64];
  int n_faces, n_leaflets; /* faces: the leaflets, then the face that enlarges the box */
  uris_face face[uris_most_faces];
  double thickness, closed_thickness, resistance, normal[3];
} uris_valve;

/* Reads the printed block and all files that it names. */
uris_valve uris_read(const char *block);
void uris_free(uris_valve *valve);

/* Returns the number in <element>. The test fails if the element is missing. */
double uris_number(const char *block, const char *element);

/* Returns frame k of a motion, (3, n_nodes). */
const double *uris_frame(const uris_face *face, const double *motion, int k);

/* A frame as the solver uses it: the box, and the triangles of all faces in the order of faces. */
typedef struct {
  int n;
  double lower[3], upper[3];
  double *middle, *normal; /* (3, n): the mean of the corners; a normal of any length */
} uris_state;

/* Returns frame k of the closing or of the opening, with the first n_faces faces. The caller frees it. */
uris_state uris_state_of(const uris_valve *valve, int n_faces, int is_closing, int k);
void uris_state_free(uris_state *state);

/* Returns the distance to the nearest middle of a triangle, and the first triangle at this distance. */
int uris_nearest(const uris_state *state, const double point[3], double *distance);
/* Returns whether the point is in the box in which the solver looks for nodes. */
int uris_is_in_box(const uris_state *state, const double point[3]);
/* Returns the sign that the solver gives a distance. The sign depends on the side of the triangle. In a closing valve, the sign
 * also depends on the flow. */
int uris_sign(const uris_valve *valve, const uris_state *state, int triangle, int is_closing, const double point[3]);

#endif
