// SPDX-License-Identifier: Apache-2.0
// Computes the resistance K by the library, at the points of the solvers of ./run validate:
//   validation_marks EPS R round|cut < INPUT > OUTPUT
// INPUT has the numbers of vertices, triangles and points as 64-bit integers. Then INPUT has xyz of each vertex as doubles, and
// three 64-bit vertex numbers of each triangle, counted from 0. Finally INPUT has xyz of each point as doubles. OUTPUT has K of
// each point as a double. All numbers have the machine's byte order. The solvers call this program instead of the Python package,
// because the package cannot be built on Debian 12 without PyPI.
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fail(const char *message) {
  fprintf(stderr, "validation_marks: %s\n", message);
  exit(1);
}

static void check(riis_status status) {
  if (status != RIIS_OK) fail(riis_last_error());
}

static double number(const char *name, const char *text) {
  char *end;
  const double value = strtod(text, &end);
  if (end == text || *end) {
    fprintf(stderr, "validation_marks: %s is '%s', which is not a number\n", name, text);
    exit(2);
  }
  return value;
}

static void *read_array(int64_t n, size_t size) {
  void *array = malloc(n > 0 ? (size_t)n * size : 1);
  if (!array) fail("out of memory");
  if (fread(array, size, (size_t)n, stdin) != (size_t)n) fail("the input ends early");
  return array;
}

int main(int argc, char **argv) {
  if (argc != 4 || (strcmp(argv[3], "round") && strcmp(argv[3], "cut"))) {
    fputs("usage: validation_marks EPS R round|cut < INPUT > OUTPUT\n", stderr);
    return 2;
  }
  int64_t count[3];
  if (fread(count, sizeof *count, 3, stdin) != 3 || count[0] < 1 || count[1] < 1 || count[2] < 0)
    fail("the input does not begin with three counts");
  double *vertices = read_array(3 * count[0], sizeof(double));
  int64_t *faces = read_array(3 * count[1], sizeof(int64_t));
  double *points = read_array(3 * count[2], sizeof(double)), *K = calloc((size_t)count[2] + 1, sizeof *K);
  if (!K) fail("out of memory");

  riis_surface_arrays arrays;
  riis_surface_options options;
  riis_resistance resistance;
  riis_mark_options marking;
  riis_mark_list list;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  check(riis_surface_options_init(&options, sizeof options));
  check(riis_resistance_init(&resistance, sizeof resistance));
  check(riis_mark_options_init(&marking, sizeof marking));
  arrays.n_vertices = count[0];
  arrays.x = vertices, arrays.y = vertices + 1, arrays.z = vertices + 2;
  arrays.stride = 3;
  arrays.n_faces = count[1];
  arrays.vertex_ids = faces;
  arrays.id_bits = 64;
  options.half_thickness = number("EPS", argv[1]);
  resistance.R = number("R", argv[2]);
  resistance.rim = strcmp(argv[3], "cut") ? RIIS_RIM_ROUND : RIIS_RIM_CUT;
  marking.resistance = &resistance;

  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  check(riis_surface_create_from_arrays(&arrays, &options, &surface));
  check(riis_mesh_create(count[2], points, points + 1, points + 2, 3, &mesh));
  check(riis_marks_create(&marks));
  check(riis_mark_nodes(surface, mesh, &marking, marks));
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &list, sizeof list));
  for (int64_t i = 0; i < list.n_nodes; ++i) K[list.node_id[i]] = list.K[i];
  if (fwrite(K, sizeof *K, (size_t)count[2], stdout) != (size_t)count[2] || fflush(stdout))
    fail("the output cannot be written");
  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  free(K), free(points), free(faces), free(vertices);
  return 0;
}
