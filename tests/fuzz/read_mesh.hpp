// SPDX-License-Identifier: Apache-2.0
// Reads a mesh. A mesh is read completely, or refused with its name and a reason. The content must be usable. Nodes make a mesh,
// or are refused because of their coordinates. Cells make an adjacency.
#pragma once

#include <riis/riis_vtk.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "input.hpp"

namespace fuzz {

// Returns whether the status is RIIS_OK. Any other status must be one of two kinds of refusal, with a message. If a file was
// refused, the message must contain `named`.
inline bool is_fine(riis_status status, riis_status refusal, const char *named) {
  if (status == RIIS_OK) return true;
  const char *text = riis_last_error();
  EXPECT(status == refusal || status == RIIS_OUT_OF_MEMORY, "status %d: %s", status, text);
  EXPECT(std::strlen(text) > 8 && std::strlen(text) < 512, "the text '%s'", text);
  if (refusal == RIIS_FILE_ERROR) EXPECT(std::strstr(text, named), "no file in '%s'", text);
  return false;
}

inline void use_rows(riis_mesh *mesh, const riis_vtk_mesh *read, std::int64_t n_nodes) {
  riis_adjacency *adjacency = nullptr;
  if (!is_fine(riis_vtk_mesh_create_adjacency(read, 1, &adjacency), RIIS_OUT_OF_MEMORY, "")) return;
  riis_csr rows;
  EXPECT(riis_adjacency_get_csr(adjacency, &rows, sizeof rows) == RIIS_OK, "%s", riis_last_error());
  EXPECT(rows.n_rows == n_nodes, "%lld rows", static_cast<long long>(rows.n_rows));
  if (mesh) EXPECT(riis_mesh_set_adjacency(mesh, &rows) == RIIS_OK, "%s", riis_last_error());
  riis_adjacency_destroy(&adjacency);
}

// Marks a mesh that is given by axes, without making its points. Returns whether the mesh is too large for the later steps, which
// make points and cells.
inline bool use_axes(const riis_vtk_mesh *read) {
  constexpr std::int64_t most_nodes = 100'000;
  riis_grid axes;
  EXPECT(riis_vtk_mesh_get_axes(read, &axes, sizeof axes) == RIIS_OK, "%s", riis_last_error());
  std::int64_t n_nodes = 0;
  EXPECT(riis_vtk_mesh_get_nodes(read, &n_nodes, nullptr, nullptr) == RIIS_OK, "%s", riis_last_error());
  if (axes.ni == 0) return false;
  riis_mesh *mesh = nullptr;
  const riis_status status = riis_mesh_create_grid(&axes, &mesh);
  EXPECT(status == RIIS_OK || status == RIIS_INVALID_MESH || status == RIIS_LIMIT_EXCEEDED, "status %d: %s", status,
         riis_last_error());
  riis_mesh_destroy(&mesh);
  return n_nodes > most_nodes;
}

inline void use_mesh(const riis_vtk_mesh *read) {
  if (use_axes(read)) return;
  std::int64_t n_nodes = 0, n_cells = -1;
  const double *xyz = nullptr;
  EXPECT(riis_vtk_mesh_get_nodes(read, &n_nodes, &n_cells, &xyz) == RIIS_OK, "%s", riis_last_error());
  EXPECT(n_nodes > 0 && n_cells >= 0, "%lld nodes", static_cast<long long>(n_nodes));
  double sum = 0;
  // Reads all numbers, so that the sanitizer checks the reads.
  for (std::int64_t i = 0; i < 3 * n_nodes; ++i) sum += xyz[i];
  riis_mesh *mesh = nullptr;
  if (is_fine(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh), RIIS_INVALID_MESH, ""))
    EXPECT(std::isfinite(sum), "%g", sum);
  use_rows(mesh, read, n_nodes);
  std::int64_t n_volume_cells = -1, n_left_out = -1;
  EXPECT(riis_vtk_mesh_get_volume_cells(read, &n_volume_cells, &n_left_out) == RIIS_OK, "%s", riis_last_error());
  EXPECT(0 <= n_left_out && n_left_out <= n_volume_cells && n_volume_cells <= n_cells, "%lld cells of volume",
         static_cast<long long>(n_volume_cells));
  double edge = -1;
  EXPECT(riis_vtk_mesh_get_median_edge(read, &edge) == RIIS_OK, "%s", riis_last_error());
  EXPECT(edge >= 0 && std::isfinite(edge), "edge %g", edge);
  riis_mesh_destroy(&mesh);
}

// Returns the mesh, or NULL if it is refused.
inline riis_vtk_mesh *read_mesh(const char *path, const char *named) {
  riis_vtk_mesh *read = nullptr;
  if (!is_fine(riis_vtk_mesh_read(path, &read), RIIS_FILE_ERROR, named)) {
    EXPECT(read == nullptr, "a refused mesh was written");
    return nullptr;
  }
  use_mesh(read);
  return read;
}

}  // namespace fuzz
