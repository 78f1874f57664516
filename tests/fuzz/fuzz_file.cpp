// SPDX-License-Identifier: Apache-2.0
// Fuzzes files of meshes, surfaces and motions in the format RIIS_FUZZ_ENDING. A file is read whole, or refused with the file's
// name and a reason. The content must be usable: nodes make a mesh or are refused for their coordinates, cells make an adjacency,
// faces make a surface, frames make keyframes.
#include <riis/riis_vtk.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "expect.hpp"
#include "scratch_file.hpp"

namespace {

const fuzz::ScratchFile &file() {
  static const fuzz::ScratchFile scratch("input." RIIS_FUZZ_ENDING);
  return scratch;
}

// Returns whether the status is RIIS_OK. Any other status must be a refusal of one of two kinds, with a message.
bool is_fine(riis_status status, riis_status refusal) {
  if (status == RIIS_OK) return true;
  const char *text = riis_last_error();
  EXPECT(status == refusal || status == RIIS_OUT_OF_MEMORY, "status %d: %s", status, text);
  EXPECT(std::strlen(text) > 8 && std::strlen(text) < 512, "the text '%s'", text);
  if (refusal == RIIS_FILE_ERROR) EXPECT(std::strstr(text, "input." RIIS_FUZZ_ENDING ": "), "no file in '%s'", text);
  return false;
}

void use_rows(riis_mesh *mesh, const riis_vtk_mesh *read, std::int64_t n_nodes) {
  riis_adjacency *adjacency = nullptr;
  if (!is_fine(riis_vtk_mesh_create_adjacency(read, 1, &adjacency), RIIS_OUT_OF_MEMORY)) return;
  riis_csr rows;
  EXPECT(riis_adjacency_get_csr(adjacency, &rows, sizeof rows) == RIIS_OK, "%s", riis_last_error());
  EXPECT(rows.n_rows == n_nodes, "%lld rows", static_cast<long long>(rows.n_rows));
  if (mesh) EXPECT(riis_mesh_set_adjacency(mesh, &rows) == RIIS_OK, "%s", riis_last_error());
  riis_adjacency_destroy(&adjacency);
}

void read_mesh() {
  riis_vtk_mesh *read = nullptr;
  if (!is_fine(riis_vtk_mesh_read(file().path().c_str(), &read), RIIS_FILE_ERROR)) {
    EXPECT(read == nullptr, "a refused mesh was written");
    return;
  }
  std::int64_t n_nodes = 0, n_cells = -1;
  const double *xyz = nullptr;
  EXPECT(riis_vtk_mesh_get_nodes(read, &n_nodes, &n_cells, &xyz) == RIIS_OK, "%s", riis_last_error());
  EXPECT(n_nodes > 0 && n_cells >= 0, "%lld nodes", static_cast<long long>(n_nodes));
  double sum = 0;
  // Reads all numbers, so that the sanitizer checks the reads.
  for (std::int64_t i = 0; i < 3 * n_nodes; ++i) sum += xyz[i];
  riis_mesh *mesh = nullptr;
  if (is_fine(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh), RIIS_INVALID_MESH))
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
  riis_vtk_mesh_destroy(&read);
}

void read_surface() {
  riis_vtk_surface *read = nullptr;
  if (!is_fine(riis_vtk_surface_read(file().path().c_str(), nullptr, &read), RIIS_FILE_ERROR)) {
    EXPECT(read == nullptr, "a refused surface was written");
    return;
  }
  riis_surface_arrays arrays;
  EXPECT(riis_surface_arrays_init(&arrays, sizeof arrays) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_vtk_surface_get_arrays(read, &arrays, sizeof arrays) == RIIS_OK, "%s", riis_last_error());
  EXPECT(arrays.n_faces > 0 && arrays.n_vertices > 0, "%lld faces", static_cast<long long>(arrays.n_faces));
  EXPECT(riis_vtk_surface_number_pieces(read) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_vtk_surface_get_arrays(read, &arrays, sizeof arrays) == RIIS_OK, "%s", riis_last_error());
  EXPECT(arrays.leaflet_id && arrays.leaflet_id[0] == 0, "the first face is not of the first piece");
  riis_surface_options options;
  EXPECT(riis_surface_options_init(&options, sizeof options) == RIIS_OK, "%s", riis_last_error());
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_surface *surface = nullptr;
  is_fine(riis_surface_create_from_arrays(&arrays, &options, &surface), RIIS_INVALID_SURFACE);
  riis_surface_destroy(&surface);
  riis_vtk_surface_destroy(&read);
}

// Makes keyframes of a motion. A collection may name any file.
void use_motion(riis_status status, riis_vtk_motion *read, const char *named) {
  if (status != RIIS_OK) {
    const char *text = riis_last_error();
    EXPECT(status == RIIS_FILE_ERROR || status == RIIS_OUT_OF_MEMORY, "status %d: %s", status, text);
    EXPECT(read == nullptr, "a refused motion was written");
    EXPECT(std::strstr(text, named) || status == RIIS_OUT_OF_MEMORY, "no file in '%s'", text);
    return;
  }
  riis_surface_arrays faces;
  riis_keyframe_arrays frames;
  EXPECT(riis_surface_arrays_init(&faces, sizeof faces) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_keyframe_arrays_init(&frames, sizeof frames) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_vtk_motion_get_arrays(read, &faces, sizeof faces) == RIIS_OK, "%s", riis_last_error());
  EXPECT(riis_vtk_motion_get_frames(read, &frames, sizeof frames) == RIIS_OK, "%s", riis_last_error());
  riis_keyframes *keyframes = nullptr;
  is_fine(riis_keyframes_create(&faces, &frames, &keyframes), RIIS_INVALID_SURFACE);
  riis_keyframes_destroy(&keyframes);
  riis_vtk_motion_destroy(&read);
}

// Uses the file as both frames of a motion, and possibly as displacements.
void read_motion() {
  static const double times[2] = {0, 1};
  const char *const paths[2] = {file().path().c_str(), file().path().c_str()};
  const std::string ending = RIIS_FUZZ_ENDING;
  riis_vtk_motion *read = nullptr;
  riis_status status = riis_vtk_motion_read_files(2, paths, times, nullptr, &read);
  use_motion(status, read, "input." RIIS_FUZZ_ENDING ": ");
  if (ending == "stl") return;
  read = nullptr;
  status = riis_vtk_motion_read_displacements(paths[0], "d", 0, nullptr, nullptr, &read);
  use_motion(status, read, "input." RIIS_FUZZ_ENDING ": ");
}

// Reads the list of a mesh in pieces. A piece that it names is refused, because the folder has no grid.
void read_pieces() {
  riis_vtk_pieces *read = nullptr;
  if (!is_fine(riis_vtk_pieces_read(file().path().c_str(), &read), RIIS_FILE_ERROR)) {
    EXPECT(read == nullptr, "refused pieces were written");
    return;
  }
  std::int64_t n = 0;
  EXPECT(riis_vtk_pieces_get_files(read, &n, nullptr) == RIIS_OK && n > 0, "%lld pieces", static_cast<long long>(n));
  riis_vtk_pieces_destroy(&read);
}

// Makes the file frame.stl, which the collection may name.
void make_frame() {
  static const fuzz::ScratchFile frame(file(), "frame.stl");
  static const char facet[] =
      "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid x\n";
  frame.hold(reinterpret_cast<const std::uint8_t *>(facet), sizeof facet - 1);
}

void read_collection() {
  make_frame();
  riis_vtk_motion *read = nullptr;
  const riis_status status = riis_vtk_motion_read_pvd(file().path().c_str(), nullptr, &read);
  use_motion(status, read, ": ");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  file().hold(bytes, size);
  const std::string ending = RIIS_FUZZ_ENDING;
  if (ending == "msh" || ending == "xdmf") {
    read_mesh();
    return 0;
  }
  if (ending == "vtk" || ending == "vtu") read_mesh();
  if (ending == "pvd") read_collection();
  if (ending == "pvtu") read_pieces();
  if (ending == "vtk" || ending == "pvd" || ending == "pvtu") return 0;
  read_surface();
  read_motion();
  return 0;
}
