/* SPDX-License-Identifier: Apache-2.0
 *
 * Makes random meshes of tetrahedra, hexahedra and wedges, and cuts them into pieces at random. Writes the pieces as files of the
 * scratch folder. The files are written without VTK. */
#ifndef RIIS_TESTS_RANDOM_PIECES_H
#define RIIS_TESTS_RANDOM_PIECES_H

#include <math.h>

#include "program.h"
#include "scratch.h"
#include "test_support.h"

enum { most_pieces = 8, most_corners = 8, tetrahedron = 10, hexahedron = 12, wedge = 13 };

static random_source rng;

static int below(int n) { return (int)(random_bits(&rng) % (uint64_t)n); }

/* A mesh of cells of several types. */
typedef struct whole_mesh {
  int n_nodes, n_cells;
  double *xyz;
  int (*corners)[most_corners], *n_corners, *type, *piece; /* by cell */
} whole_mesh;

static whole_mesh whole;
static int n_pieces, has_ids, has_attribute, has_ghosts;
/* The ids that each piece's nodes have in the whole mesh. */
static int *nodes_of[most_pieces], n_nodes_of[most_pieces];

static void add_cell(int type, int n, const int *corners, const int *positions) {
  for (int i = 0; i < n; ++i) whole.corners[whole.n_cells][i] = corners[positions[i]];
  whole.n_corners[whole.n_cells] = n;
  whole.type[whole.n_cells++] = type;
}

/* Makes a box of n x n x n randomly shifted nodes. Each small box is a hexahedron, two wedges or six tetrahedra. */
static void make_whole(int n, int mode) {
  static const int all[8] = {0, 1, 2, 3, 4, 5, 6, 7}, wedges[2][6] = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
  static const int ring[7] = {1, 2, 3, 7, 4, 5, 1};
  const int most = 6 * (n - 1) * (n - 1) * (n - 1), up = n * n;
  const double edge = 3.4 / (n - 1);
  whole.n_nodes = n * n * n;
  whole.n_cells = 0;
  whole.xyz = malloc(sizeof *whole.xyz * 3 * (size_t)whole.n_nodes);
  whole.corners = malloc(sizeof *whole.corners * (size_t)most);
  whole.n_corners = malloc(sizeof(int) * (size_t)most);
  whole.type = malloc(sizeof(int) * (size_t)most);
  whole.piece = malloc(sizeof(int) * (size_t)most);
  for (int i = 0; i < whole.n_nodes; ++i) {
    const int at[3] = {i % n, i / n % n, i / n / n};
    for (int c = 0; c < 3; ++c)
      whole.xyz[3 * i + c] = -1.7 + edge * at[c] + random_between(&rng, -0.2, 0.2) * edge - (c == 2 ? 0.3 : 0);
  }
  for (int i = 0; i < (n - 1) * (n - 1) * (n - 1); ++i) {
    const int m = n - 1, first = i % m + n * (i / m % m + n * (i / m / m));
    const int corners[8] = {first,      first + 1,      first + n + 1,      first + n,
                            first + up, first + up + 1, first + up + n + 1, first + up + n};
    const int kind = mode < 2 ? mode : below(3);
    if (kind == 0) add_cell(hexahedron, 8, corners, all);
    for (int k = 0; kind == 1 && k < 6; ++k) add_cell(tetrahedron, 4, corners, (int[4]){0, ring[k], ring[k + 1], 6});
    for (int k = 0; kind == 2 && k < 2; ++k) add_cell(wedge, 6, corners, wedges[k]);
  }
}

/* Keeps the cells inside a tube around the valve, so that the valve can close the tube. Some nodes outside remain without a cell,
 * and all other nodes outside are removed. */
static void keep_tube(double radius) {
  int n_cells = 0, n_nodes = 0, *new_id = malloc(sizeof(int) * (size_t)whole.n_nodes);
  for (int i = 0; i < whole.n_nodes; ++i) new_id[i] = below(20) == 0;
  for (int i = 0; i < whole.n_cells; ++i) {
    int is_inside = 1;
    for (int c = 0; c < whole.n_corners[i]; ++c) {
      const double *p = whole.xyz + 3 * whole.corners[i][c];
      is_inside &= hypot(p[0], p[1]) <= radius;
    }
    if (!is_inside) continue;
    for (int c = 0; c < whole.n_corners[i]; ++c) new_id[whole.corners[n_cells][c] = whole.corners[i][c]] = 1;
    whole.n_corners[n_cells] = whole.n_corners[i];
    whole.type[n_cells++] = whole.type[i];
  }
  for (int i = 0; i < whole.n_nodes; ++i) {
    if (!new_id[i]) continue;
    memcpy(whole.xyz + 3 * n_nodes, whole.xyz + 3 * i, 3 * sizeof *whole.xyz);
    new_id[i] = n_nodes++;
  }
  for (int i = 0; i < n_cells; ++i)
    for (int c = 0; c < whole.n_corners[i]; ++c) whole.corners[i][c] = new_id[whole.corners[i][c]];
  whole.n_cells = n_cells;
  whole.n_nodes = n_nodes;
  free(new_id);
}

static void forget_whole(void) {
  free(whole.xyz);
  free(whole.corners);
  free(whole.n_corners);
  free(whole.type);
  free(whole.piece);
  for (int i = 0; i < most_pieces; ++i) {
    free(nodes_of[i]);
    nodes_of[i] = NULL;
  }
}

/* Distributes the cells, either at random or in layers with a rough boundary. Some pieces may get no cell. */
static void cut(void) {
  const int by_layers = below(2);
  n_pieces = 1 + below(most_pieces);
  for (int i = 0; i < whole.n_cells; ++i) {
    const double z = whole.xyz[3 * whole.corners[i][0] + below(3)] + 1.7;
    const int layer = (int)(z / 3.4 * n_pieces + random_between(&rng, -0.3, 0.3));
    whole.piece[i] = by_layers ? (layer < 0 ? 0 : layer >= n_pieces ? n_pieces - 1 : layer) : below(n_pieces);
  }
  if (n_pieces > 2 && below(2)) /* an empty piece */
    for (int i = 0; i < whole.n_cells; ++i) whole.piece[i] += whole.piece[i] == 1;
}

/* Writes an array as text. `format` contains one %. */
#define WRITE_ARRAY(type, name, n, value)                                                \
  do {                                                                                   \
    fprintf(file, "<DataArray type=\"%s\" Name=\"%s\" format=\"ascii\">\n", type, name); \
    for (int i = 0; i < (n); ++i) fprintf(file, "%d ", (int)(value));                    \
    fprintf(file, "\n</DataArray>\n");                                                   \
  } while (0)

/* Writes cells and nodes of the whole mesh. `is_ghost` may be NULL. */
static void write_grid(const char *path, int n_nodes, const int *nodes, int n_cells, const int *cells,
                       const int *is_ghost, const char *dropped) {
  int *local = malloc(sizeof(int) * (size_t)whole.n_nodes), end = 0;
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  for (int i = 0; i < n_nodes; ++i) local[nodes[i]] = i;
  fprintf(file,
          "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n");
  fprintf(file, "<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n", n_nodes, n_cells);
  fprintf(file, "<PointData%s>\n", has_ids && has_attribute ? " GlobalIds=\"GlobalNodeId\"" : "");
  if (strcmp(dropped, "pressure") != 0) WRITE_ARRAY("Float64", "pressure", n_nodes, 7 * nodes[i]);
  if (has_ids) WRITE_ARRAY("Int64", "GlobalNodeId", n_nodes, nodes[i]);
  fprintf(file, "</PointData>\n<CellData>\n");
  if (is_ghost) WRITE_ARRAY("UInt8", "vtkGhostType", n_cells, is_ghost[i]);
  fprintf(file, "</CellData>\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n");
  for (int i = 0; i < n_nodes; ++i)
    for (int c = 0; c < 3; ++c) fprintf(file, "%.17g ", whole.xyz[3 * nodes[i] + c]);
  fprintf(file,
          "\n</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
  for (int i = 0; i < n_cells; ++i)
    for (int c = 0; c < whole.n_corners[cells[i]]; ++c) fprintf(file, "%d ", local[whole.corners[cells[i]][c]]);
  fprintf(file, "\n</DataArray>\n");
  WRITE_ARRAY("Int64", "offsets", n_cells, end += whole.n_corners[cells[i]]);
  WRITE_ARRAY("UInt8", "types", n_cells, whole.type[cells[i]]);
  fprintf(file, "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  fclose(file);
  free(local);
}

static void write_joined(void) {
  int *ids = malloc(sizeof(int) * (size_t)(whole.n_nodes + whole.n_cells));
  for (int i = 0; i < whole.n_nodes + whole.n_cells; ++i) ids[i] = i;
  write_grid(scratch_path("joined.vtu"), whole.n_nodes, ids, whole.n_cells, ids, NULL, "");
  free(ids);
}

static const char *piece_name(int piece) {
  static char name[32];
  snprintf(name, sizeof name, "piece%d.vtu", piece);
  return name;
}

/* Writes a piece, with its nodes in a random order. Ghosts are cells of other pieces that share a node with this piece. */
static void write_piece(int piece) {
  char *has_node = calloc((size_t)whole.n_nodes, 1);
  int *cells = malloc(sizeof(int) * (size_t)whole.n_cells), *ghosts = calloc((size_t)whole.n_cells, sizeof(int)), n = 0;
  for (int i = 0; i < whole.n_cells; ++i) {
    if (whole.piece[i] != piece) continue;
    cells[n++] = i;
    for (int c = 0; c < whole.n_corners[i]; ++c) has_node[whole.corners[i][c]] = 1;
  }
  char *has_ghost_node = malloc((size_t)whole.n_nodes);
  memcpy(has_ghost_node, has_node, (size_t)whole.n_nodes);
  /* A node without cells is in the first piece, and may be in other pieces. */
  char *is_used = calloc((size_t)whole.n_nodes, 1);
  for (int i = 0; i < whole.n_cells; ++i)
    for (int c = 0; c < whole.n_corners[i]; ++c) is_used[whole.corners[i][c]] = 1;
  for (int i = 0; i < whole.n_nodes; ++i)
    if (!is_used[i] && (piece == 0 || (n > 0 && below(2)))) has_ghost_node[i] = 1;
  free(is_used);
  for (int i = 0; has_ghosts && i < whole.n_cells; ++i) {
    int touches = 0;
    for (int c = 0; c < whole.n_corners[i]; ++c) touches |= has_node[whole.corners[i][c]];
    if (whole.piece[i] == piece || !touches || below(10) < 3) continue;
    ghosts[n] = 1;
    cells[n++] = i;
    for (int c = 0; c < whole.n_corners[i]; ++c) has_ghost_node[whole.corners[i][c]] = 1;
  }
  int *nodes = nodes_of[piece] = malloc(sizeof(int) * (size_t)whole.n_nodes), n_nodes = 0;
  for (int i = 0; i < whole.n_nodes; ++i)
    if (has_ghost_node[i]) nodes[n_nodes++] = i;
  for (int i = n_nodes - 1; i > 0; --i) {
    const int j = below(i + 1), swap = nodes[i];
    nodes[i] = nodes[j];
    nodes[j] = swap;
  }
  n_nodes_of[piece] = n_nodes;
  write_grid(scratch_path(piece_name(piece)), n_nodes, nodes, n, cells, has_ghosts ? ghosts : NULL, "");
  free(has_node);
  free(has_ghost_node);
  free(cells);
  free(ghosts);
}

static void write_list(const char *name, int n, const char *const *sources) {
  FILE *file = fopen(scratch_path(name), "w");
  assert_non_null(file);
  fprintf(file, "<?xml version=\"1.0\"?>\n<!-- a list -->\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\">\n");
  fprintf(file, "<PUnstructuredGrid GhostLevel=\"%d\">\n<PPointData>\n", has_ghosts);
  fprintf(file, "<PDataArray type=\"Float64\" Name=\"pressure\"%s/>\n",
          has_ghosts ? " NumberOfComponents=\"0\"" : ""); /* as dolfinx 0.5 writes it */
  if (has_ids) fprintf(file, "<PDataArray type=\"Int64\" Name=\"GlobalNodeId\"/>\n");
  fprintf(file, "</PPointData>\n<PCellData>%s</PCellData>\n",
          has_ghosts ? "<PDataArray type=\"UInt8\" Name=\"vtkGhostType\"/>" : "");
  fprintf(file, "<PPoints><PDataArray type=\"Float64\" NumberOfComponents=\"3\"/></PPoints>\n");
  for (int i = 0; i < n; ++i) fprintf(file, "<Piece Source=\"%s\"/>\n", sources[i]);
  fprintf(file, "</PUnstructuredGrid>\n</VTKFile>\n");
  fclose(file);
}

/* Writes the list of the pieces, by relative and absolute paths. */
static void write_pieces(void) {
  static char names[most_pieces][4096];
  const char *sources[most_pieces];
  for (int i = 0; i < n_pieces; ++i) {
    write_piece(i);
    if (i % 3 == 2) {
      char folder[2048];
      assert_non_null(realpath(scratch_path("."), folder));
      snprintf(names[i], sizeof names[i], "%s/%s", folder, piece_name(i));
    } else {
      snprintf(names[i], sizeof names[i], "%s", piece_name(i));
    }
    sources[i] = names[i];
  }
  write_list("mesh.pvtu", n_pieces, sources);
}

#endif
