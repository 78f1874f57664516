/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the advice on units in meshes whose unit is known. The meshes are pipes, roots, chambers, basins and flat chambers with
 * all kinds of valves, in metres, centimetres and millimetres. Without --unit, the advice names the true unit, alone or among
 * others. There is no advice for a vessel in centimetres, or for a mesh with --unit. A coarse basin in centimetres can have the
 * numbers of a vessel in millimetres, so its advice may name both units. If two units remain, the next run says how many nodes
 * each unit marks. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"
#include "scratch.h"
#include "test_support.h"

enum { n_units = 3, n_kinds = 5, most_nodes = 20000, most_layers = 2000 };
static const double longest_edge = 1; /* of a basin: ten half thicknesses */
static const char *const units[n_units] = {"m", "cm", "mm"};
static const char *const words[n_units] = {"in metres", "in centimetres", "in millimetres"};
static const double factors[n_units] = {0.01, 1, 10}; /* from centimetres to each unit */
static const char *const kinds[n_kinds] = {"aortic", "coapting", "trileaflet", "mitral", "bileaflet"};

typedef enum shape { pipe_shape, root_shape, chamber_shape, basin_shape, flat_shape, n_shapes } shape;

/* A vessel along z, around a valve at the origin. Lengths are in centimetres. */
typedef struct vessel {
  shape shape;
  double radius, length, half_length; /* half_length is that of a chamber */
  double edge, growth; /* an edge at the valve, and the increase of edges per unit of distance from there */
  double centre;       /* of the length, on the axis */
  double side[3];      /* of a basin or a flat chamber, around the valve */
} vessel;

static int is_basin(const vessel *v) { return v->shape >= basin_shape; }

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

/* Returns the coordinates of the nodes between two ends. The nodes are closer together near the valve. */
static int make_layers(const vessel *v, double from, double to, double z[most_layers]) {
  int n = 0;
  double at = from;
  while (at < to && n < most_layers - 1) {
    z[n++] = at;
    at += v->edge * (1 + v->growth * fmax(fabs(at) - 1.5, 0) / v->edge);
  }
  z[n++] = to;
  return n;
}

/* The nodes along the three directions of the grid. Across a vessel, the coordinates are from -1 to 1. */
typedef struct grid {
  int n[3];
  double at[3][most_layers];
} grid;

static void make_grid(const vessel *v, grid *made) {
  if (is_basin(v)) {
    for (int k = 0; k < 3; ++k) {
      const double middle = k == 2 ? v->centre : 0;
      made->n[k] = make_layers(v, middle - v->side[k] / 2, middle + v->side[k] / 2, made->at[k]);
    }
    return;
  }
  made->n[0] = made->n[1] = (int)ceil(2 * v->radius / v->edge) + 1;
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < made->n[k]; ++i) made->at[k][i] = 2.0 * i / (made->n[k] - 1) - 1;
  made->n[2] = make_layers(v, v->centre - v->length / 2, v->centre + v->length / 2, made->at[2]);
}

static void place(double p[3], double factor) {
  const double c = cos(angle), s = sin(angle), along = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
  const double across[3] = {axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2],
                            axis[0] * p[1] - axis[1] * p[0]};
  for (int k = 0; k < 3; ++k) p[k] = factor * (c * p[k] + s * across[k] + (1 - c) * along * axis[k]) + shift[k];
}

/* Writes hexahedra. Across a vessel, squares are mapped to discs. */
static void write_vessel(const vessel *v, double factor) {
  static grid g;
  make_grid(v, &g);
  FILE *file = fopen(mesh_path, "w");
  assert_non_null(file);
  fprintf(file, "# vtk DataFile Version 3.0\nvessel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n",
          g.n[0] * g.n[1] * g.n[2]);
  for (int k = 0; k < g.n[2]; ++k)
    for (int j = 0; j < g.n[1]; ++j)
      for (int i = 0; i < g.n[0]; ++i) {
        const double a = g.at[0][i], b = g.at[1][j], z = g.at[2][k], r = is_basin(v) ? 1 : radius_at(v, z);
        double p[3] = {r * a * (is_basin(v) ? 1 : sqrt(1 - b * b / 2)), r * b * (is_basin(v) ? 1 : sqrt(1 - a * a / 2)),
                       z};
        place(p, factor);
        fprintf(file, "%.9g %.9g %.9g\n", p[0], p[1], p[2]);
      }
  const int n_cells = (g.n[0] - 1) * (g.n[1] - 1) * (g.n[2] - 1);
  fprintf(file, "CELLS %d %d\n", n_cells, 9 * n_cells);
  for (int k = 0; k + 1 < g.n[2]; ++k)
    for (int j = 0; j + 1 < g.n[1]; ++j)
      for (int i = 0; i + 1 < g.n[0]; ++i) {
        const int n = g.n[0], first = (k * g.n[1] + j) * n + i, above = first + n * g.n[1];
        fprintf(file, "8 %d %d %d %d %d %d %d %d\n", first, first + 1, first + n + 1, first + n, above, above + 1,
                above + n + 1, above + n);
      }
  fprintf(file, "CELL_TYPES %d\n", n_cells);
  for (int i = 0; i < n_cells; ++i) fputs("12\n", file);
  assert_int_equal(fclose(file), 0);
}

/* Makes a random basin of 8 to 60 cm, or a flat chamber of 6 to 40 cm with a height of 2 to 5 cm. Draws new sizes until the grid
 * is small enough and has no edge longer than longest_edge. */
static vessel random_basin(shape of) {
  static grid g;
  while (1) {
    vessel v = {.shape = of, .growth = below(3) == 0 ? 0 : between(0.05, 0.5)};
    const double least = of == basin_shape ? 8 : 6, most = of == basin_shape ? 60 : 40;
    for (int k = 0; k < 3; ++k) v.side[k] = exp(between(log(least), log(most)));
    if (of == flat_shape) v.side[2] = between(2, 5);
    v.centre = between(-0.2, 0.2) * v.side[2];
    v.edge = exp(between(log(0.1), log(longest_edge)));
    make_grid(&v, &g);
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      for (int i = 1; i < g.n[k]; ++i) longest = fmax(longest, g.at[k][i] - g.at[k][i - 1]);
    if (longest <= longest_edge && (double)g.n[0] * g.n[1] * g.n[2] <= 3 * most_nodes) return v;
  }
}

static vessel random_vessel(void) {
  const shape of = (shape)below(n_shapes);
  if (of >= basin_shape) return random_basin(of);
  vessel v = {.shape = of, .radius = between(1, 2), .growth = below(2) == 0 ? 0 : between(0.05, 0.3)};
  v.length = below(2) == 0 ? between(3, 60) : exp(between(log(3), log(60)));
  if (v.shape == root_shape) v.length = between(5, 12);
  v.centre = below(2) == 0 ? 0 : between(-0.3, 0.3) * v.length;
  if (v.shape == chamber_shape) {
    v.radius = between(2, 3.5);
    v.half_length = between(3, 5);
    v.length = 1.8 * v.half_length;
    v.centre = -0.75 * v.half_length;
  }
  static grid g;
  v.edge = between(0.08, 0.3);
  make_grid(&v, &g);
  while (g.n[0] * g.n[1] * g.n[2] > most_nodes) {
    v.edge *= 1.1;
    make_grid(&v, &g);
  }
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

/* Returns the part of stderr from this text to the end of the text's line, or "". */
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

/* Checks the run with the true unit. The run must say how many nodes each advised unit marks, and both numbers must be right. */
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
  const int n = is_long_test() ? 2000 : 20;
  int n_alone = 0, n_both = 0, n_basins_both = 0;
  rng = random_start("known units");
  for (int trial = 0; trial < n; ++trial) {
    const int unit = trial % n_units;
    const char *const kind = kinds[below(n_kinds)];
    const vessel v = random_vessel();
    random_place(factors[unit]);
    write_vessel(&v, factors[unit]);
    char what[240];
    snprintf(what, sizeof what, "%s in %s, shape %d, radius %g, length %g, sides %g %g %g, edge %g, growth %g", kind,
             units[unit], (int)v.shape, v.radius, v.length, v.side[0], v.side[1], v.side[2], v.edge, v.growth);
    run_on_mesh(kind, NULL);
    char advice[1024];
    snprintf(advice, sizeof advice, "%s", line_with("looks as if it were in "));
    int is_advised[n_units], n_advised = 0;
    for (int k = 0; k < n_units; ++k) n_advised += is_advised[k] = advises(advice, units[k]);
    if (unit == 1 && is_basin(&v) && n_advised > 0) {
      if (!is_advised[unit]) fail_msg("%s: %s", what, program_err);
      ++n_basins_both;
      check_counts(kind, unit, is_advised);
    } else if (unit == 1) {
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
  print_message("%d meshes: %d advised one unit, %d several, %d basins in cm several\n", n, n_alone, n_both,
                n_basins_both);
}

static int set_up(void **state) {
  const int status = scratch_setup(state);
  snprintf(mesh_path, sizeof mesh_path, "%s", scratch_path("vessel.vtk"));
  return status;
}

int main(void) { return run_cases(set_up, scratch_teardown); }
