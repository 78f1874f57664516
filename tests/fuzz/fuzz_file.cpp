// SPDX-License-Identifier: Apache-2.0
// Fuzzes files of meshes, surfaces and motions in the format whose ending is fuzz_ending. A file is read completely, or refused
// with its name and a reason. The content must be usable. Nodes make a mesh, or are refused because of their coordinates. Cells
// make an adjacency, faces make a surface, and frames make keyframes.
#include <riis/riis_vtk.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "input.hpp"
#include "read_mesh.hpp"

extern const char *const fuzz_ending;  // each harness has its own ending, which CMakeLists.txt defines

namespace {

const fuzz::ScratchFile &file() {
  static const fuzz::ScratchFile scratch(std::string("input.") + fuzz_ending);
  return scratch;
}

// Returns the name by which messages must call the file.
const char *named() {
  static const std::string name = std::string("input.") + fuzz_ending + ": ";
  return name.c_str();
}

bool is_fine(riis_status status, riis_status refusal) { return fuzz::is_fine(status, refusal, named()); }

void read_mesh() {
  riis_vtk_mesh *read = fuzz::read_mesh(file().path().c_str(), named());
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

// Makes keyframes of a motion. A collection may name any file, so the message of a refusal need only contain `part`.
void use_motion(riis_status status, riis_vtk_motion *read, const char *part) {
  if (status != RIIS_OK) {
    const char *text = riis_last_error();
    EXPECT(status == RIIS_FILE_ERROR || status == RIIS_OUT_OF_MEMORY, "status %d: %s", status, text);
    EXPECT(read == nullptr, "a refused motion was written");
    EXPECT(std::strstr(text, part) || status == RIIS_OUT_OF_MEMORY, "no file in '%s'", text);
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
  const std::string ending = fuzz_ending;
  riis_vtk_motion *read = nullptr;
  riis_status status = riis_vtk_motion_read_files(2, paths, times, nullptr, &read);
  use_motion(status, read, named());
  if (ending != "vtp" && ending != "vtu") return;
  read = nullptr;
  status = riis_vtk_motion_read_displacements(paths[0], "d", 0, nullptr, nullptr, &read);
  use_motion(status, read, named());
}

// Reads the list of a mesh in pieces. A listed piece is refused, because the folder has no grid.
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
  const std::string ending = fuzz_ending;
  if (ending == "msh" || ending == "xdmf" || ending == "vti" || ending == "vtr" || ending == "vts") {
    read_mesh();
    return 0;
  }
  if (ending == "vtk" || ending == "vtu") read_mesh();
  if (ending == "pvd") read_collection();
  if (ending == "pvtu") read_pieces();
  if (ending == "pvd" || ending == "pvtu") return 0;
  read_surface();
  read_motion();
  return 0;
}
