/* SPDX-License-Identifier: Apache-2.0 */
#include "plain_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scratch.h"

/* The faces' normals point out of the cell. */
static const int hexahedron_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

static plain_mesh new_mesh(int type, int n_corners, int64_t n_nodes, int64_t n_cells) {
  plain_mesh mesh = {type, n_corners, n_nodes, n_cells, NULL, NULL};
  mesh.xyz = malloc((size_t)n_nodes * 3 * sizeof *mesh.xyz);
  mesh.ids = malloc((size_t)(n_corners * n_cells) * sizeof *mesh.ids);
  return mesh;
}

void plain_free(plain_mesh *mesh) {
  free(mesh->xyz);
  free(mesh->ids);
  memset(mesh, 0, sizeof *mesh);
}

plain_mesh plain_hexahedra(int n, const double lower[3], const double upper[3]) {
  plain_mesh mesh = new_mesh(12, 8, (int64_t)n * n * n, (int64_t)(n - 1) * (n - 1) * (n - 1));
  for (int64_t i = 0; i < mesh.n_nodes; ++i) {
    const int64_t at[3] = {i % n, i / n % n, i / n / n};
    for (int c = 0; c < 3; ++c) mesh.xyz[3 * i + c] = lower[c] + (upper[c] - lower[c]) * (double)at[c] / (n - 1);
  }
  for (int64_t i = 0; i < mesh.n_cells; ++i) {
    const int m = n - 1;
    const int64_t first = i % m + n * (i / m % m + n * (i / m / m)), up = (int64_t)n * n;
    const int64_t corners[8] = {first,      first + 1,      first + n + 1,      first + n,
                                first + up, first + up + 1, first + up + n + 1, first + up + n};
    memcpy(mesh.ids + 8 * i, corners, sizeof corners);
  }
  return mesh;
}

/* Returns the node in the middle of a and b. Makes the middle node if it does not exist. `middles` lists the pairs that already
 * have a middle node. */
static int64_t middle_of(plain_mesh *mesh, int64_t (*middles)[2], int64_t first, int64_t a, int64_t b) {
  const int64_t low = a < b ? a : b, high = a < b ? b : a;
  for (int64_t i = first; i < mesh->n_nodes; ++i)
    if (middles[i - first][0] == low && middles[i - first][1] == high) return i;
  middles[mesh->n_nodes - first][0] = low, middles[mesh->n_nodes - first][1] = high;
  for (int c = 0; c < 3; ++c) mesh->xyz[3 * mesh->n_nodes + c] = 0.5 * (mesh->xyz[3 * a + c] + mesh->xyz[3 * b + c]);
  return mesh->n_nodes++;
}

plain_mesh plain_quadratic_tetrahedra(const plain_mesh *hexahedra) {
  /* The tetrahedra of a cube lie around the diagonal from corner 0 to corner 6. `ring` lists the other corners of the tetrahedra
   * in order. */
  static const int ring[7] = {1, 2, 3, 7, 4, 5, 1};
  static const int sides[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  const int64_t n_cells = 6 * hexahedra->n_cells, most = hexahedra->n_nodes + 6 * n_cells;
  plain_mesh mesh = new_mesh(24, 10, most, n_cells);
  int64_t(*middles)[2] = malloc((size_t)(6 * n_cells) * sizeof *middles);
  mesh.n_nodes = hexahedra->n_nodes;
  memcpy(mesh.xyz, hexahedra->xyz, (size_t)mesh.n_nodes * 3 * sizeof *mesh.xyz);
  for (int64_t i = 0; i < n_cells; ++i) {
    const int64_t *corners = hexahedra->ids + 8 * (i / 6);
    int64_t *ids = mesh.ids + 10 * i;
    ids[0] = corners[0], ids[1] = corners[ring[i % 6]], ids[2] = corners[ring[i % 6 + 1]], ids[3] = corners[6];
    for (int side = 0; side < 6; ++side)
      ids[4 + side] = middle_of(&mesh, middles, hexahedra->n_nodes, ids[sides[side][0]], ids[sides[side][1]]);
  }
  free(middles);
  return mesh;
}

plain_mesh plain_cut(const plain_mesh *quadratic, int n_parts) {
  static const int parts[8][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3},
                                  {6, 8, 4, 5}, {6, 8, 5, 9}, {6, 8, 9, 7}, {6, 8, 7, 4}};
  plain_mesh mesh = new_mesh(10, 4, quadratic->n_nodes, n_parts * quadratic->n_cells);
  memcpy(mesh.xyz, quadratic->xyz, (size_t)mesh.n_nodes * 3 * sizeof *mesh.xyz);
  for (int64_t i = 0; i < mesh.n_cells; ++i)
    for (int k = 0; k < 4; ++k) mesh.ids[4 * i + k] = quadratic->ids[10 * (i / n_parts) + parts[i % n_parts][k]];
  return mesh;
}

static void write_numbers(FILE *file, const char *name, int64_t n, const int64_t *numbers) {
  fprintf(file, "<DataArray type=\"Int64\" Name=\"%s\" format=\"ascii\">\n", name);
  for (int64_t i = 0; i < n; ++i) fprintf(file, "%lld\n", (long long)numbers[i]);
  fprintf(file, "</DataArray>\n");
}

static int is_polyhedron(int64_t cell, enum plain_layout layout) { return layout != PLAIN_CELLS && cell % 3 != 2; }

/* Writes a stream for each cell: the number of faces, then the size and the corners of each face. An offset is the end of a
 * cell's stream, or -1 for a cell without a stream. */
static void write_streams(FILE *file, const plain_mesh *mesh, int64_t first, int64_t n, int64_t *numbers,
                          int64_t *ends) {
  int64_t at = 0;
  for (int64_t i = 0; i < n; ++i) {
    ends[i] = -1;
    if (!is_polyhedron(first + i, PLAIN_STREAMS)) continue;
    numbers[at++] = 6;
    for (int face = 0; face < 6; ++face) {
      numbers[at++] = 4;
      for (int k = 0; k < 4; ++k) numbers[at++] = mesh->ids[8 * (first + i) + hexahedron_faces[face][k]];
    }
    ends[i] = at;
  }
  write_numbers(file, "faces", at, numbers);
  write_numbers(file, "faceoffsets", n, ends);
}

static int is_same_face(const int64_t *a, const int64_t *b) {
  int n = 0;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) n += a[i] == b[k];
  return n == 4;
}

/* Neighbouring cells share a face in the list of faces. */
static void write_lists(FILE *file, const plain_mesh *mesh, int64_t first, int64_t n, int64_t *numbers, int64_t *ends) {
  int64_t *corners = numbers, *of_cells = numbers + 24 * n, n_faces = 0, at = 0;
  for (int64_t i = 0; i < n; ++i) {
    for (int face = 0; is_polyhedron(first + i, PLAIN_LISTS) && face < 6; ++face) {
      int64_t mine[4], found = 0;
      for (int k = 0; k < 4; ++k) mine[k] = mesh->ids[8 * (first + i) + hexahedron_faces[face][k]];
      while (found < n_faces && !is_same_face(corners + 4 * found, mine)) ++found;
      if (found == n_faces) memcpy(corners + 4 * n_faces++, mine, sizeof mine);
      of_cells[at++] = found;
    }
    ends[i] = at;
  }
  write_numbers(file, "face_connectivity", 4 * n_faces, corners);
  write_numbers(file, "polyhedron_to_faces", at, of_cells);
  write_numbers(file, "polyhedron_offsets", n, ends);
  for (int64_t i = 0; i < n_faces; ++i) numbers[i] = 4 * (i + 1);
  write_numbers(file, "face_offsets", n_faces, numbers);
}

void plain_write(const char *name, const plain_mesh *mesh, enum plain_layout layout, int n_pieces) {
  FILE *file = fopen(scratch_path(name), "w");
  int64_t *numbers = malloc((size_t)(40 * mesh->n_cells) * sizeof *numbers),
          *ends = malloc((size_t)mesh->n_cells * sizeof *ends);
  if (!file || !numbers || !ends) abort();
  fprintf(file, "<VTKFile type=\"UnstructuredGrid\" version=\"%s\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n",
          layout == PLAIN_LISTS ? "2.3" : "1.0");
  for (int piece = 0; piece < n_pieces; ++piece) {
    const int64_t first = mesh->n_cells * piece / n_pieces, n = mesh->n_cells * (piece + 1) / n_pieces - first;
    fprintf(
        file,
        "<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n<Points><DataArray type=\"Float64\" Name=\"Points\" "
        "NumberOfComponents=\"3\" format=\"ascii\">\n",
        (long long)mesh->n_nodes, (long long)n);
    for (int64_t i = 0; i < 3 * mesh->n_nodes; ++i) fprintf(file, "%.17g\n", mesh->xyz[i]);
    fprintf(file, "</DataArray></Points>\n<Cells>\n");
    write_numbers(file, "connectivity", mesh->n_corners * n, mesh->ids + mesh->n_corners * first);
    for (int64_t i = 0; i < n; ++i) ends[i] = mesh->n_corners * (i + 1);
    write_numbers(file, "offsets", n, ends);
    for (int64_t i = 0; i < n; ++i) ends[i] = is_polyhedron(first + i, layout) ? 42 : mesh->type;
    write_numbers(file, "types", n, ends);
    if (layout == PLAIN_STREAMS) write_streams(file, mesh, first, n, numbers, ends);
    if (layout == PLAIN_LISTS) write_lists(file, mesh, first, n, numbers, ends);
    fprintf(file, "</Cells></Piece>\n");
  }
  fprintf(file, "</UnstructuredGrid></VTKFile>\n");
  if (fclose(file) != 0) abort();
  free(numbers);
  free(ends);
}
