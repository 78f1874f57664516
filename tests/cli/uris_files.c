/* SPDX-License-Identifier: Apache-2.0 */
/* clang-format off: test_support.h includes CMocka's headers in the right order */
#include "test_support.h"
/* clang-format on */

#include "uris_files.h"

#include <ctype.h>

#include "scratch.h"

/* Copies the value of the first <element> after `from` without blanks, like the solver's reader of parameters. Returns the
 * position after the element, or NULL if `end` comes first. */
static const char *value_of(const char *from, const char *end, const char *element, char *value, size_t size) {
  char tag[80];
  snprintf(tag, sizeof tag, "<%s>", element);
  const char *at = strstr(from, tag);
  if (!at || at >= end) return NULL;
  size_t n = 0;
  for (at += strlen(tag); *at && *at != '<'; ++at) {
    if (isspace((unsigned char)*at)) continue;
    assert_true(n + 1 < size);
    value[n++] = *at;
  }
  value[n] = 0;
  return at;
}

static void must_value(const char *from, const char *end, const char *element, char *value, size_t size) {
  if (!value_of(from, end, element, value, size)) fail_msg("there is no %s in:\n%s", element, from);
}

double uris_number(const char *block, const char *element) {
  char text[64], *rest = NULL;
  must_value(block, block + strlen(block), element, text, sizeof text);
  const double number = strtod(text, &rest);
  assert_true(rest != text && *rest == 0);
  return number;
}

/* Returns the numbers of a named array in a .vtu file in text form. */
static double *numbers_of(const char *vtu, const char *name, int n) {
  char key[80];
  snprintf(key, sizeof key, "Name=\"%s\"", name);
  const char *head = strstr(vtu, key);
  if (!head) fail_msg("the .vtu has no array %s", name);
  char *at = strchr(head, '>') + 1;
  double *numbers = calloc((size_t)n, sizeof *numbers);
  for (int i = 0; i < n; ++i) {
    char *rest = NULL;
    numbers[i] = strtod(at, &rest);
    assert_ptr_not_equal(rest, at);
    at = rest;
  }
  while (isspace((unsigned char)*at)) ++at;
  assert_int_equal(*at, '<');
  return numbers;
}

static int attribute(const char *text, const char *name) {
  char key[80];
  snprintf(key, sizeof key, "%s=\"", name);
  const char *at = strstr(text, key);
  if (!at) fail_msg("the .vtu has no %s", name);
  return atoi(at + strlen(key));
}

static void read_triangles(const char *path, uris_face *face) {
  char *vtu = scratch_read(path, NULL);
  face->n_nodes = attribute(vtu, "NumberOfPoints");
  face->n_triangles = attribute(vtu, "NumberOfCells");
  assert_true(face->n_nodes > 2 && face->n_triangles > 0);
  face->xyz = numbers_of(vtu, "Points", 3 * face->n_nodes);
  double *corner = numbers_of(vtu, "connectivity", 3 * face->n_triangles);
  double *offset = numbers_of(vtu, "offsets", face->n_triangles), *type = numbers_of(vtu, "types", face->n_triangles);
  face->corner = calloc(3 * (size_t)face->n_triangles, sizeof *face->corner);
  for (int i = 0; i < 3 * face->n_triangles; ++i) {
    face->corner[i] = (int)corner[i];
    assert_true(face->corner[i] >= 0 && face->corner[i] < face->n_nodes && face->corner[i] == corner[i]);
  }
  for (int i = 0; i < face->n_triangles; ++i) assert_true(offset[i] == 3 * (i + 1) && type[i] == 5);
  free(corner);
  free(offset);
  free(type);
  free(vtu);
}

/* Reads a motion file: two counts, then positions to the end of the file. */
static double *read_motion(const char *path, int n_nodes, int *n_frames) {
  FILE *file = fopen(path, "r");
  if (!file) fail_msg("%s: cannot be read", path);
  int nodes = 0;
  assert_int_equal(fscanf(file, "%d %d", n_frames, &nodes), 2);
  assert_int_equal(nodes, n_nodes);
  const size_t n = 3 * (size_t)nodes * (size_t)*n_frames;
  double *motion = calloc(n, sizeof *motion), more = 0;
  for (size_t i = 0; i < n; ++i) assert_int_equal(fscanf(file, "%lf", &motion[i]), 1);
  assert_int_equal(fscanf(file, "%lf", &more), EOF);
  fclose(file);
  return motion;
}

static void read_face(const char *from, const char *end, uris_face *face) {
  char path[256];
  must_value(from, end, "Face_file_path", path, sizeof path);
  read_triangles(path, face);
  must_value(from, end, "Open_motion_file_path", path, sizeof path);
  face->open = read_motion(path, face->n_nodes, &face->n_open);
  must_value(from, end, "Close_motion_file_path", path, sizeof path);
  face->close = read_motion(path, face->n_nodes, &face->n_close);
}

uris_valve uris_read(const char *block) {
  uris_valve valve;
  memset(&valve, 0, sizeof valve);
  const char *const end = block + strlen(block);
  char path[256];
  const char *at = strstr(block, "<Add_URIS_mesh name=\"");
  assert_non_null(at);
  assert_int_equal(sscanf(at, "<Add_URIS_mesh name=\"%63[^\"]\"", valve.name), 1);
  while ((at = strstr(at, "<Add_URIS_face name=\""))) {
    assert_true(valve.n_faces < uris_most_faces);
    uris_face *face = &valve.face[valve.n_faces++];
    assert_int_equal(sscanf(at, "<Add_URIS_face name=\"%63[^\"]\"", face->name), 1);
    valve.n_leaflets += strcmp(face->name, "box") != 0;
    const char *const face_end = strstr(at, "</Add_URIS_face>");
    assert_non_null(face_end);
    read_face(at, face_end, face);
    assert_int_equal(face->n_open, valve.face[0].n_open); /* the solver needs the same number of frames for each face */
    assert_int_equal(face->n_close, valve.face[0].n_close);
    at = face_end;
  }
  /* The solver would add a scaffold's K to the K of the faces. */
  assert_false(value_of(block, end, "Scaffold_file_path", path, sizeof path));
  valve.thickness = uris_number(block, "Thickness");
  valve.closed_thickness = uris_number(block, "Closed_thickness");
  valve.resistance = uris_number(block, "Resistance");
  assert_true(uris_number(block, "Mesh_scale_factor") == 1);
  must_value(block, end, "Positive_flow_normal_file_path", path, sizeof path);
  char *normal = scratch_read(path, NULL);
  assert_int_equal(sscanf(normal, "%lf %lf %lf", &valve.normal[0], &valve.normal[1], &valve.normal[2]), 3);
  free(normal);
  return valve;
}

void uris_free(uris_valve *valve) {
  for (int i = 0; i < uris_most_faces; ++i) {
    free(valve->face[i].corner);
    free(valve->face[i].xyz);
    free(valve->face[i].open);
    free(valve->face[i].close);
  }
  memset(valve, 0, sizeof *valve);
}

const double *uris_frame(const uris_face *face, const double *motion, int k) {
  return motion + 3 * (size_t)face->n_nodes * (size_t)k;
}

static void add_to_box(uris_state *state, const double *xyz, int n_nodes) {
  for (int i = 0; i < 3 * n_nodes; ++i) {
    if (xyz[i] < state->lower[i % 3]) state->lower[i % 3] = xyz[i];
    if (xyz[i] > state->upper[i % 3]) state->upper[i % 3] = xyz[i];
  }
}

/* To find the middle of a triangle, the solver adds the corners to 0 in their order, and then divides. The test needs the
 * solver's bits, because they decide which of two middles is nearer. */
static void add_triangles(uris_state *state, const uris_face *face, const double *xyz) {
  const size_t n = (size_t)(state->n + face->n_triangles);
  state->middle = realloc(state->middle, 3 * n * sizeof *state->middle);
  state->normal = realloc(state->normal, 3 * n * sizeof *state->normal);
  for (int i = 0; i < face->n_triangles; ++i, ++state->n) {
    const double *p[3];
    double u[3], v[3], *const middle = state->middle + 3 * state->n, *const normal = state->normal + 3 * state->n;
    for (int c = 0; c < 3; ++c) p[c] = xyz + 3 * face->corner[3 * i + c];
    for (int j = 0; j < 3; ++j) {
      middle[j] = 0;
      for (int c = 0; c < 3; ++c) middle[j] += p[c][j];
      middle[j] /= 3;
      u[j] = p[1][j] - p[0][j];
      v[j] = p[2][j] - p[0][j];
    }
    for (int j = 0; j < 3; ++j) normal[j] = u[(j + 1) % 3] * v[(j + 2) % 3] - u[(j + 2) % 3] * v[(j + 1) % 3];
  }
}

static uris_state empty_state(void) {
  return (uris_state){.lower = {INFINITY, INFINITY, INFINITY}, .upper = {-INFINITY, -INFINITY, -INFINITY}};
}

/* The box grows by a tenth on each side. A box without thickness grows by a tenth of its diagonal. */
static void widen(uris_state *state) {
  double side[3], square = 0;
  for (int j = 0; j < 3; ++j) side[j] = state->upper[j] - state->lower[j], square += side[j] * side[j];
  for (int j = 0; j < 3; ++j) {
    const double more = 0.1 * (side[j] > 0 ? side[j] : sqrt(square));
    state->lower[j] -= more;
    state->upper[j] += more;
  }
}

uris_state uris_state_of(const uris_valve *valve, int n_faces, int is_closing, int k) {
  uris_state state = empty_state();
  for (int f = 0; f < n_faces; ++f) {
    const uris_face *face = &valve->face[f];
    const double *xyz = uris_frame(face, is_closing ? face->close : face->open, k);
    add_to_box(&state, xyz, face->n_nodes);
    add_triangles(&state, face, xyz);
  }
  widen(&state);
  return state;
}

void uris_state_free(uris_state *state) {
  free(state->middle);
  free(state->normal);
  *state = empty_state();
}

int uris_nearest(const uris_state *state, const double point[3], double *distance) {
  int nearest = -1;
  *distance = INFINITY;
  for (int i = 0; i < state->n; ++i) {
    double square = 0;
    for (int j = 0; j < 3; ++j) {
      const double from = point[j] - state->middle[3 * i + j];
      square += from * from;
    }
    const double d = sqrt(square);
    if (!(d < *distance)) continue;
    *distance = d;
    nearest = i;
  }
  return nearest;
}

int uris_is_in_box(const uris_state *state, const double point[3]) {
  for (int j = 0; j < 3; ++j)
    if (point[j] < state->lower[j] || point[j] > state->upper[j]) return 0;
  return 1;
}

int uris_sign(const uris_valve *valve, const uris_state *state, int triangle, int is_closing, const double point[3]) {
  double across = 0, along = 0;
  for (int j = 0; j < 3; ++j) {
    const double from = point[j] - state->middle[3 * triangle + j];
    across += from * state->normal[3 * triangle + j];
    along += from * valve->normal[j];
  }
  return across < 0 && (!is_closing || along < 0) ? -1 : 1;
}
