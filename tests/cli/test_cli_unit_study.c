/* SPDX-License-Identifier: Apache-2.0
 *
 * The unit advice in meshes whose unit is known: pipes, roots and chambers with all kinds of valves, in metres, centimetres and
 * millimetres. Without --unit, the advice names the true unit, alone or among others. A mesh in centimetres gets no advice, and
 * a mesh whose unit is named gets none. If two units remain, the next run says how many nodes each unit marks. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"
#include "scratch.h"
#include "test_support.h"

enum { n_units = 3, n_kinds = 5, most_nodes = 20000, most_layers = 2000 };
static const char *const units[n_units] = {"m", "cm", "mm"};
static const char *const words[n_units] = {"in metres", "in centimetres", "in millimetres"};
static const double factors[n_units] = {0.01, 1, 10}; /* from centimetres to each unit */
static const char *const kinds[n_kinds] = {"aortic", "coapting", "trileaflet", "mitral", "bileaflet"};

typedef enum shape { pipe_shape, root_shape, chamber_shape } shape;

/* A vessel along z around a valve at the origin. Lengths are in centimetres. */
typedef struct vessel {
  shape shape;
  double radius, length, half_length; /* half_length is that of a chamber */
  double edge, growth; /* an edge at the valve, and how much longer an edge is at a length farther away */
  double centre;       /* of the length, on the axis */
} vessel;

static random_source rng;
static double axis[3], angle, shift[3]; /* of the valve and its vessel, with shift in the mesh's unit */
static char mesh_path[256], rotate[128], translate[128];

static double between(double a, double b) { return random_between(&rng, a, b); }
static int below(int n) { return (int)(random_bits(&rng) % (uint64_t)n); }

static double radius_at(const vessel *v, double z) {
  if (v->shape == pipe_shape) return v->radius;
  if (v->shape == root_shape) return v->radius * (1 + 0.35 * exp(-4 * (z - 0.8) * (z - 0.8)));
  const double t = (z - v->centre) / v->half_length;
  return v->radius * sqrt(fmax(1 - t * t, 0.01));
}

/* Returns the lengths along the axis at which there are nodes. They are closer near the valve. */
static int make_layers(const vessel *v, double z[most_layers]) {
  const double end = v->centre + v->length / 2;
  int n = 0;
  double at = v->centre - v->length / 2;
  while (at < end && n < most_layers - 1) {
    z[n++] = at;
    at += v->edge * (1 + v->growth * fmax(fabs(at) - 1.5, 0) / v->edge);
  }
  z[n++] = end;
  return n;
}

static void place(double p[3], double factor) {
  const double c = cos(angle), s = sin(angle), along = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
  const double across[3] = {axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2],
                            axis[0] * p[1] - axis[1] * p[0]};
  for (int k = 0; k < 3; ++k) p[k] = factor * (c * p[k] + s * across[k] + (1 - c) * along * axis[k]) + shift[k];
}

/* Writes hexahedra in n x n squares for each layer. A square is mapped to a disc. */
static void write_vessel(const vessel *v, double factor) {
  static double z[most_layers];
  const int n_layers = make_layers(v, z), n = (int)ceil(2 * v->radius / v->edge) + 1;
  FILE *file = fopen(mesh_path, "w");
  assert_non_null(file);
  fprintf(file, "# vtk DataFile Version 3.0\nvessel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n",
          n * n * n_layers);
  for (int k = 0; k < n_layers; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double a = 2.0 * i / (n - 1) - 1, b = 2.0 * j / (n - 1) - 1, r = radius_at(v, z[k]);
        double p[3] = {r * a * sqrt(1 - b * b / 2), r * b * sqrt(1 - a * a / 2), z[k]};
        place(p, factor);
        fprintf(file, "%.9g %.9g %.9g\n", p[0], p[1], p[2]);
      }
  const int n_cells = (n - 1) * (n - 1) * (n_layers - 1);
  fprintf(file, "CELLS %d %d\n", n_cells, 9 * n_cells);
  for (int k = 0; k + 1 < n_layers; ++k)
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        const int first = (k * n + j) * n + i, above = first + n * n;
        fprintf(file, "8 %d %d %d %d %d %d %d %d\n", first, first + 1, first + n + 1, first + n, above, above + 1,
                above + n + 1, above + n);
      }
  fprintf(file, "CELL_TYPES %d\n", n_cells);
  for (int i = 0; i < n_cells; ++i) fputs("12\n", file);
  assert_int_equal(fclose(file), 0);
}

static vessel random_vessel(void) {
  vessel v = {.shape = (shape)below(3), .radius = between(1, 2), .growth = below(2) == 0 ? 0 : between(0.05, 0.3)};
  v.length = below(2) == 0 ? between(3, 60) : exp(between(log(3), log(60)));
  if (v.shape == root_shape) v.length = between(5, 12);
  v.centre = below(2) == 0 ? 0 : between(-0.3, 0.3) * v.length;
  if (v.shape == chamber_shape) {
    v.radius = between(2, 3.5);
    v.half_length = between(3, 5);
    v.length = 1.8 * v.half_length;
    v.centre = -0.75 * v.half_length;
  }
  static double z[most_layers];
  v.edge = between(0.08, 0.3);
  while (make_layers(&v, z) * pow(ceil(2 * v.radius / v.edge) + 1, 2) > most_nodes) v.edge *= 1.1;
  return v;
}

/* Places the valve and its vessel, half of them obliquely. */
static void random_place(double factor) {
  const int is_oblique = below(2);
  double length = 0;
  for (int k = 0; k < 3; ++k) axis[k] = between(-1, 1), length += axis[k] * axis[k];
  for (int k = 0; k < 3; ++k) {
    axis[k] /= sqrt(length);
    shift[k] = is_oblique ? factor * between(-100, 100) : 0;
  }
  const double degrees = is_oblique ? between(10, 170) : 0;
  angle = degrees * acos(-1) / 180;
  snprintf(rotate, sizeof rotate, "%.17g,%.17g,%.17g,%.17g", axis[0], axis[1], axis[2], degrees);
  snprintf(translate, sizeof translate, "%.17g,%.17g,%.17g", shift[0], shift[1], shift[2]);
}

static void run_on_mesh(const char *kind, const char *unit) {
  run_program("mark", mesh_path, "--valve", kind, "--rotate", rotate, "--translate", translate, "--stats", "-",
              unit ? "--unit" : NULL, unit, NULL);
  if (program_exit_code != 0 && program_exit_code != 3) fail_msg("exit code %d: %s", program_exit_code, program_err);
}

/* Returns the part of stderr that begins with this text and ends with its line, or "". */
static const char *line_with(const char *text) {
  static char line[1024];
  const char *found = strstr(program_err, text);
  snprintf(line, sizeof line, "%s", found ? found : "");
  line[strcspn(line, "\n")] = 0;
  return line;
}

static int advises(const char *line, const char *unit) {
  char wanted[32];
  snprintf(wanted, sizeof wanted, "--unit %s", unit);
  const char *found = strstr(line, wanted);
  return found && (found[strlen(wanted)] == 0 || found[strlen(wanted)] == ' ');
}

/* Checks that the run with the true unit says how many nodes each advised unit marks, and that both numbers are right. */
static void check_counts(const char *kind, int true_unit, const int is_advised[n_units]) {
  static char line[1024];
  run_on_mesh(kind, units[true_unit]);
  snprintf(line, sizeof line, "%s", line_with("the unit is not sure: "));
  for (int k = 0; k < n_units; ++k) {
    if (!is_advised[k]) continue;
    char wanted[64], number[32];
    run_on_mesh(kind, units[k]);
    const int n = (int)json_number(program_out, "n_marked");
    snprintf(number, sizeof number, n >= 1000 ? "%d,%03d" : "%d", n >= 1000 ? n / 1000 : n, n % 1000);
    snprintf(wanted, sizeof wanted, "--unit %s marks %s node", units[k], number);
    if (!strstr(line, wanted)) fail_msg("no \"%s\" in \"%s\"", wanted, line);
  }
}

TEST(test_known_units) {
  const int n = is_long_test() ? 300 : 20;
  int n_alone = 0, n_both = 0;
  rng = random_start("known units");
  for (int trial = 0; trial < n; ++trial) {
    const int unit = trial % n_units;
    const char *const kind = kinds[below(n_kinds)];
    const vessel v = random_vessel();
    random_place(factors[unit]);
    write_vessel(&v, factors[unit]);
    char what[160];
    snprintf(what, sizeof what, "%s in %s, shape %d, radius %g, length %g, edge %g, growth %g", kind, units[unit],
             (int)v.shape, v.radius, v.length, v.edge, v.growth);
    run_on_mesh(kind, NULL);
    char advice[1024];
    snprintf(advice, sizeof advice, "%s", line_with("looks as if it were in "));
    int is_advised[n_units], n_advised = 0;
    for (int k = 0; k < n_units; ++k) n_advised += is_advised[k] = advises(advice, units[k]);
    if (unit == 1) {
      if (n_advised > 0) fail_msg("%s: advice for a right unit: %s", what, program_err);
    } else {
      if (!is_advised[unit]) fail_msg("%s: %s", what, program_err);
      assert_non_null(strstr(advice, words[unit] + strlen("in ")));
      n_alone += n_advised == 1;
      n_both += n_advised > 1;
      if (n_advised > 1) check_counts(kind, unit, is_advised);
    }
    run_on_mesh(kind, units[unit]);
    if (strstr(program_err, "looks as if") || strstr(program_err, "write --unit"))
      fail_msg("%s: advice for the named unit: %s", what, program_err);
    if (n_advised < 2 && strstr(program_err, "the unit is not sure")) fail_msg("%s: %s", what, program_err);
  }
  print_message("%d meshes: %d advised one unit, %d several\n", n, n_alone, n_both);
}

static int set_up(void **state) {
  const int status = scratch_setup(state);
  snprintf(mesh_path, sizeof mesh_path, "%s", scratch_path("vessel.vtk"));
  return status;
}

int main(void) { return run_cases(set_up, scratch_teardown); }
