/* SPDX-License-Identifier: Apache-2.0
 *
 * Makes boxes of cells of one type, and the Gauss points that svMultiPhysics has in them. The volumes of nodes are in closed
 * form, so no shape functions are evaluated. */
#ifndef RIIS_TESTS_BRICK_MESHES_H
#define RIIS_TESTS_BRICK_MESHES_H

/* clang-format off: test_support.h includes CMocka's headers in the right order */
#include "test_support.h"
/* clang-format on */

#include "scratch.h"

/* ---- Meshes: a box of cells, mapped by a matrix ---- */

enum { most_side = 33, most_nodes = most_side * most_side * most_side, most_of_cell = 27 };

typedef struct {
  const char *name;
  int vtk, n_nodes, n_in_brick; /* the number of elements in a brick of the box */
} element;

static const element elements[] = {{"tet4", 10, 4, 6},   {"wedge6", 13, 6, 2}, {"hex8", 12, 8, 1},
                                   {"tet10", 24, 10, 6}, {"hex20", 25, 20, 1}, {"hex27", 29, 27, 1}};
enum { n_elements_types = sizeof elements / sizeof elements[0] };

typedef struct {
  const element *type;
  int n_nodes, n_cells;
  double *xyz, *volume; /* the volume of a node is the integral of its shape function */
  int *node;            /* (type->n_nodes, n_cells) */
  double cell_volume;
} mesh;

/* Places in a brick in VTK's order. The unit is half a side. */
static const int hexahedron_places[27][3] = {
    {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0},
    {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1},
    {2, 2, 1}, {0, 2, 1}, {0, 1, 1}, {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0}, {1, 1, 2}, {1, 1, 1}};
static const int wedge_places[2][3][2] = {{{0, 0}, {2, 0}, {0, 2}}, {{2, 2}, {0, 2}, {2, 0}}};
static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
static const int tetrahedron_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

/* The place of node a of element i of a brick. Half of the tetrahedra are inside out, and the solver reverses them. */
static inline void place_in_brick(const element *type, int i, int a, int at[3]) {
  if (type->n_in_brick == 1) {
    memcpy(at, hexahedron_places[a], 3 * sizeof *at);
  } else if (type->n_in_brick == 2) {
    at[0] = wedge_places[i][a % 3][0];
    at[1] = wedge_places[i][a % 3][1];
    at[2] = a < 3 ? 0 : 2;
  } else if (a < 4) {
    memset(at, 0, 3 * sizeof *at);
    for (int step = 0; step < a; ++step) at[orders[i][step]] = 2;
  } else {
    int p[3], q[3];
    place_in_brick(type, i, tetrahedron_edges[a - 4][0], p);
    place_in_brick(type, i, tetrahedron_edges[a - 4][1], q);
    for (int k = 0; k < 3; ++k) at[k] = (p[k] + q[k]) / 2;
  }
}

/* The share of the cell's volume that belongs to its node a. */
static inline double share_of_node(const element *type, int a) {
  switch (type->vtk) {
    case 24:
      return a < 4 ? -1.0 / 20 : 1.0 / 5;
    case 25:
      return a < 8 ? -1.0 / 8 : 1.0 / 6;
    case 29:
      return a < 8 ? 1.0 / 216 : a < 20 ? 1.0 / 54 : a < 26 ? 2.0 / 27 : 8.0 / 27;
    default:
      return 1.0 / type->n_nodes;
  }
}

/* Makes a box of n bricks in each direction. The columns of `side` are the sides of the box. */
static inline mesh make_mesh(const element *type, const int n[3], const double corner[3], double side[3][3]) {
  mesh made = {type, 0, 0, NULL, NULL, NULL, 0};
  const int n_bricks = n[0] * n[1] * n[2], lines[3] = {2 * n[0] + 1, 2 * n[1] + 1, 2 * n[2] + 1};
  static int number[most_nodes];
  assert_true(lines[0] * lines[1] * lines[2] <= most_nodes);
  memset(number, -1, sizeof number);
  made.n_cells = n_bricks * type->n_in_brick;
  made.node = calloc((size_t)(made.n_cells * type->n_nodes), sizeof *made.node);
  made.xyz = calloc(3 * (size_t)most_nodes, sizeof *made.xyz);
  made.volume = calloc((size_t)most_nodes, sizeof *made.volume);
  made.cell_volume = fabs(side[0][0] * (side[1][1] * side[2][2] - side[2][1] * side[1][2]) -
                          side[1][0] * (side[0][1] * side[2][2] - side[2][1] * side[0][2]) +
                          side[2][0] * (side[0][1] * side[1][2] - side[1][1] * side[0][2])) /
                     made.n_cells;
  for (int cell = 0; cell < made.n_cells; ++cell) {
    const int brick = cell / type->n_in_brick;
    const int first[3] = {2 * (brick % n[0]), 2 * (brick / n[0] % n[1]), 2 * (brick / n[0] / n[1])};
    for (int a = 0; a < type->n_nodes; ++a) {
      int at[3];
      place_in_brick(type, cell % type->n_in_brick, a, at);
      for (int k = 0; k < 3; ++k) at[k] += first[k];
      int *id = &number[at[0] + lines[0] * (at[1] + lines[1] * at[2])];
      if (*id < 0) {
        *id = made.n_nodes++;
        for (int k = 0; k < 3; ++k) {
          made.xyz[3 * *id + k] = corner[k];
          for (int s = 0; s < 3; ++s) made.xyz[3 * *id + k] += side[s][k] * at[s] / (2.0 * n[s]);
        }
      }
      made.node[type->n_nodes * cell + a] = *id;
      made.volume[*id] += share_of_node(type, a) * made.cell_volume;
    }
  }
  return made;
}

static inline void free_mesh(mesh *of) {
  free(of->xyz);
  free(of->volume);
  free(of->node);
}

static inline void write_mesh(const mesh *of, const char *name) {
  FILE *file = fopen(scratch_path(name), "w");
  assert_non_null(file);
  fprintf(file, "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n", of->n_nodes);
  for (int i = 0; i < of->n_nodes; ++i)
    fprintf(file, "%.17g %.17g %.17g\n", of->xyz[3 * i], of->xyz[3 * i + 1], of->xyz[3 * i + 2]);
  fprintf(file, "CELLS %d %d\n", of->n_cells, of->n_cells * (of->type->n_nodes + 1));
  for (int cell = 0; cell < of->n_cells; ++cell) {
    fprintf(file, "%d", of->type->n_nodes);
    for (int a = 0; a < of->type->n_nodes; ++a) fprintf(file, " %d", of->node[of->type->n_nodes * cell + a]);
    fprintf(file, "\n");
  }
  fprintf(file, "CELL_TYPES %d\n", of->n_cells);
  for (int cell = 0; cell < of->n_cells; ++cell) fprintf(file, "%d\n", of->type->vtk);
  assert_int_equal(fclose(file), 0);
}

/* ---- Gauss points in VTK's unit cells ---- */

typedef struct {
  int n;
  double point[27][3], weight[27]; /* weights are shares of the cell's volume */
} rule;

static inline void add_point(rule *to, double x, double y, double z, double weight) {
  const double point[3] = {x, y, z};
  memcpy(to->point[to->n], point, sizeof point);
  to->weight[to->n++] = weight;
}

/* All points whose four barycentric coordinates are a, a, b, b or a, b, b, b, in any order. */
static inline void add_barycentric(rule *to, double a, double b, int n_a, double weight) {
  for (int set = 0; set < 16; ++set) {
    double l[4];
    int n = 0;
    for (int k = 0; k < 4; ++k) {
      l[k] = set >> k & 1 ? a : b;
      n += set >> k & 1;
    }
    if (n == n_a) add_point(to, l[0], l[1], l[2], weight);
  }
}

static inline rule gauss_of(const element *type) {
  rule to;
  memset(&to, 0, sizeof to);
  if (type->vtk == 10) {
    add_barycentric(&to, (5 + 3 * sqrt(5)) / 20, (5 - sqrt(5)) / 20, 1, 0.25);
  } else if (type->vtk == 24) {
    add_point(&to, 0.25, 0.25, 0.25, 6 * 0.0302836780970890);
    add_barycentric(&to, 0, 1.0 / 3, 1, 6 * 0.0060267857142860);
    add_barycentric(&to, 8.0 / 11, 1.0 / 11, 1, 6 * 0.0116452490860290);
    add_barycentric(&to, 0.0665501535736640, 0.4334498464263360, 2, 6 * 0.0109491415613860);
  } else if (type->vtk == 13) {
    for (int i = 0; i < 6; ++i) {
      const double far = 2.0 / 3, near = 1.0 / 6;
      add_point(&to, i % 3 == 0 ? far : near, i % 3 == 1 ? far : near, (1 + (i < 3 ? -1 : 1) / sqrt(3)) / 2, 1.0 / 6);
    }
  } else {
    const int n = type->vtk == 12 ? 2 : 3;
    const double at[2][3] = {{(1 - sqrt(1.0 / 3)) / 2, (1 + sqrt(1.0 / 3)) / 2, 0},
                             {(1 - sqrt(0.6)) / 2, 0.5, (1 + sqrt(0.6)) / 2}};
    const double weight[2][3] = {{0.5, 0.5, 0}, {5.0 / 18, 4.0 / 9, 5.0 / 18}};
    for (int i = 0; i < n * n * n; ++i) {
      const int x = i % n, y = i / n % n, z = i / n / n;
      add_point(&to, at[n - 2][x], at[n - 2][y], at[n - 2][z], weight[n - 2][x] * weight[n - 2][y] * weight[n - 2][z]);
    }
  }
  return to;
}

#endif
