// SPDX-License-Identifier: Apache-2.0
// Fuzzes cases of OpenFOAM. The input contains the files of a case one after the other. Each file begins with a line such as:
//   === points                 the file constant/polyMesh/points
//   === 0.5/points             the file 0.5/polyMesh/points
//   === processor1/owner.gz    the file processor1/constant/polyMesh/owner.gz, which the harness compresses
//   === faces.gz as it is      the file constant/polyMesh/faces.gz, which is compressed in the input
// The case and its time 0.5 are read completely, or refused with the case's name and a reason. If the mesh was read, a field at
// the centres of its cells is written or refused.
#include <riis/riis_vtk.h>
#include <vtk_zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input.hpp"
#include "read_mesh.hpp"

namespace {

namespace fs = std::filesystem;
constexpr const char *name = "input.foam";
constexpr std::string_view separator = "=== ";

// A case of OpenFOAM in a folder of this process.
class Case {
 public:
  Case() {
    const char *folder = std::getenv("TMPDIR");
    std::string pattern = std::string(folder && *folder ? folder : "/tmp") + "/riis-fuzz-XXXXXX";
    EXPECT(mkdtemp(pattern.data()) != nullptr, "%s cannot be made", pattern.c_str());
    parent_ = pattern;
  }
  ~Case() { fs::remove_all(parent_); }
  Case(const Case &) = delete;
  Case &operator=(const Case &) = delete;

  std::string path() const { return (parent_ / name).string(); }
  std::string path(const char *inner) const { return (parent_ / name / inner).string(); }

  void clear() const {
    fs::remove_all(path());
    fs::create_directory(path());
  }

  void hold(const fs::path &file, std::string_view content) const {
    const fs::path at = fs::path(path()) / file;
    fs::create_directories(at.parent_path());
    std::ofstream(at, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }

 private:
  fs::path parent_;
};

const Case &the_case() {
  static const Case made;
  return made;
}

std::string compressed(std::string_view content) {
  z_stream stream{};
  EXPECT(deflateInit2(&stream, 1, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK, "no memory for %zu bytes",
         content.size());
  std::string packed(deflateBound(&stream, content.size()), '\0');
  stream.next_in = reinterpret_cast<unsigned char *>(const_cast<char *>(content.data()));
  stream.avail_in = static_cast<unsigned>(content.size());
  stream.next_out = reinterpret_cast<unsigned char *>(packed.data());
  stream.avail_out = static_cast<unsigned>(packed.size());
  EXPECT(deflate(&stream, Z_FINISH) == Z_STREAM_END, "%zu bytes cannot be compressed", content.size());
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// Removes this ending from a text that has it.
bool take_end(std::string_view &text, std::string_view end) {
  if (text.size() < end.size() || text.substr(text.size() - end.size()) != end) return false;
  text.remove_suffix(end.size());
  return true;
}

// Returns the file's place in the case if a case may have a file of this name.
std::optional<fs::path> place_of(std::string_view file) {
  static const std::array<std::string_view, 7> files = {
      "points", "faces", "owner", "neighbour", "boundary", "pointProcAddressing", "cellProcAddressing"};
  static const std::array<std::array<std::string_view, 2>, 5> folders = {
      {{"0.5/", "0.5/polyMesh"},
       {"processor0/", "processor0/constant/polyMesh"},
       {"processor1/", "processor1/constant/polyMesh"},
       {"processors2/", "processors2"},
       {"", "constant/polyMesh"}}};
  for (const auto &[prefix, folder] : folders) {
    if (file.substr(0, prefix.size()) != prefix) continue;
    for (const std::string_view known : files)
      if (file.substr(prefix.size()) == known) return fs::path(folder) / known;
  }
  return std::nullopt;
}

void hold_file(std::string_view heading, std::string_view content) {
  const bool is_as_it_is = take_end(heading, " as it is");
  const bool is_packed = take_end(heading, ".gz");
  std::optional<fs::path> place = place_of(heading);
  if (!place) return;
  if (is_packed) *place += ".gz";
  the_case().hold(*place, is_packed && !is_as_it_is ? compressed(content) : content);
}

void hold_case(std::string_view bytes) {
  the_case().clear();
  const auto next = [&](std::size_t from) {
    const std::size_t at = bytes.find("\n=== ", from);
    return at == std::string_view::npos ? bytes.size() : at + 1;
  };
  for (std::size_t at = bytes.substr(0, separator.size()) == separator ? 0 : next(0); at < bytes.size();) {
    const std::size_t end = next(at);
    std::string_view file = bytes.substr(at, end - at);
    const std::size_t line = std::min(file.find('\n'), file.size() - 1);
    hold_file(file.substr(separator.size(), line - std::min(line, separator.size())), file.substr(line + 1));
    at = end;
  }
}

// Writes a field at the centres of the cells. To write the field, riis reads the patches of the boundary.
void write_field(riis_vtk_mesh *mesh) {
  EXPECT(riis_vtk_mesh_use_centers(mesh) == RIIS_OK, "%s", riis_last_error());
  std::int64_t n_cells = 0;
  EXPECT(riis_vtk_mesh_get_nodes(mesh, &n_cells, nullptr, nullptr) == RIIS_OK, "%s", riis_last_error());
  if (n_cells == 0) return;
  fuzz::use_mesh(mesh);
  const std::vector<double> values(static_cast<std::size_t>(n_cells), 0.5);
  EXPECT(riis_vtk_mesh_set_point_array(mesh, "K", n_cells, 1, values.data()) == RIIS_OK, "%s", riis_last_error());
  const std::string time = the_case().path("0.25");
  // If the whole mesh is missing, the folder is not a time of a case. The field would then be written as a .vtu file.
  if (!fs::exists(the_case().path("constant"))) return;
  fuzz::is_fine(riis_vtk_mesh_write(mesh, time.c_str()), RIIS_FILE_ERROR, name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *bytes, std::size_t size) {
  hold_case({reinterpret_cast<const char *>(bytes), size});
  riis_vtk_mesh *mesh = fuzz::read_mesh(the_case().path().c_str(), name);
  if (mesh) write_field(mesh);
  riis_vtk_mesh_destroy(&mesh);
  if (fs::exists(the_case().path("0.5"))) mesh = fuzz::read_mesh(the_case().path("0.5").c_str(), name);
  riis_vtk_mesh_destroy(&mesh);
  return 0;
}
