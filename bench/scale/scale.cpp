// SPDX-License-Identifier: Apache-2.0
// Marks a mesh that never exists as a whole: a box of hexahedra in pieces. Each piece is made, written, read by the program's
// loop, marked, written, checked and deleted. Prints the peak memory and the times. docs/scale.md has the results.
//   riis_bench_scale [PIECES] [NODES_PER_SIDE] [mark|leaks]
#include <riis/riis_vtk.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "program/base/ranks.hpp"
#include "program/mark/marking.hpp"
#include "program/output/report.hpp"

namespace {

using namespace riis::program;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

[[noreturn]] void give_up(const std::string &text) {
  std::fprintf(stderr, "riis_bench_scale: %s\n", text.c_str());
  std::exit(1);
}

double peak_megabytes() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1000 * 1.024;
}

// The processor time of this process. The wall time would be longer on a busy machine.
double processor_seconds() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval &time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// The numbers of pieces along x, y and z.
std::array<std::int64_t, 3> shape_of(std::int64_t n_pieces) {
  std::array<std::int64_t, 3> best = {n_pieces, 1, 1};
  for (std::int64_t a = 1; a * a * a <= n_pieces; ++a)
    for (std::int64_t b = a; n_pieces % a == 0 && a * b * b <= n_pieces; ++b)
      if (n_pieces / a % b == 0) best = {n_pieces / a / b, b, a};
  return best;
}

// Writes files whose arrays are read through offsets.
class File {
 public:
  File(const std::string &path, const char *mode) : path_(path), file_(std::fopen(path.c_str(), mode)) {
    if (!file_) give_up(path + " cannot be opened");
  }
  ~File() { std::fclose(file_); }
  File(const File &) = delete;
  File &operator=(const File &) = delete;

  void write(const void *bytes, std::size_t n) {
    if (std::fwrite(bytes, 1, n, file_) != n) give_up(path_ + " cannot be written");
  }
  template <class T>
  void write_block_of(std::int64_t n) {
    const auto size = static_cast<std::uint64_t>(n) * sizeof(T);
    write(&size, sizeof size);
  }
  template <class T>
  void write_all(const std::vector<T> &values) {
    write(values.data(), values.size() * sizeof(T));
  }
  void read(void *bytes, std::size_t n) {
    if (std::fread(bytes, 1, n, file_) != n) give_up(path_ + " cannot be read");
  }
  void seek(long at) {
    if (std::fseek(file_, at, SEEK_SET) != 0) give_up(path_ + " cannot be read");
  }

 private:
  std::string path_;
  std::FILE *file_;
};

// The pieces are boxes of side^3 nodes. Neighbours share their outer nodes.
class GridPieces : public MeshPieces {
 public:
  GridPieces(const MarkOptions &options, const std::string &folder, std::int64_t n_pieces, std::int64_t side)
      : MeshPieces(options, files_in(folder, n_pieces)), folder_(folder), shape_(shape_of(n_pieces)), side_(side) {
    const std::int64_t most = *std::max_element(shape_.begin(), shape_.end()) * (side - 1);
    spacing_ = 6.0 / static_cast<double>(most);
  }

  std::int64_t n_nodes() const {
    std::int64_t n = 1;
    for (const std::int64_t pieces : shape_) n *= pieces * (side_ - 1) + 1;
    return n;
  }
  std::int64_t n_cells() const { return shape_[0] * shape_[1] * shape_[2] * (side_ - 1) * (side_ - 1) * (side_ - 1); }
  const std::array<std::int64_t, 3> &shape() const { return shape_; }
  double spacing() const { return spacing_; }
  // Returns the z of a plane of nodes. Planes are counted from the lowest.
  double z_of(std::int64_t plane) const { return coordinate(2, plane); }

  MeshFile read(std::int64_t piece) const override {
    const std::string &path = files()[static_cast<std::size_t>(piece)];
    const auto begin = Clock::now();
    make(piece, path);
    const double making = seconds_since(begin);
    riis_vtk_mesh *mesh = nullptr;
    check(riis_vtk_mesh_read(path.c_str(), &mesh));
    std::filesystem::remove(path);
    seconds_making += making;
    seconds_reading += seconds_since(begin) - making;
    return MeshFile(mesh);
  }

  // Counts the marks in the written file, and then deletes the file. A node of several pieces counts only in the first of these
  // pieces.
  void finished(std::int64_t piece) const override {
    const auto begin = Clock::now();
    const std::string digits = std::to_string(piece), zeros(4 - std::min<std::size_t>(4, digits.size()), '0');
    const std::string path = folder_ + "/marked/marked_" + zeros + digits + ".vtu";
    if (std::filesystem::exists(path)) {
      count_marks(piece, path);
      std::filesystem::remove(path);
    }
    seconds_checking += seconds_since(begin);
  }

  mutable double seconds_making = 0, seconds_reading = 0, seconds_checking = 0;
  mutable std::int64_t n_marked = 0, n_wrong = 0;
  double half_thickness = 0;

 private:
  static std::vector<std::string> files_in(const std::string &folder, std::int64_t n) {
    std::vector<std::string> files;
    for (std::int64_t i = 0; i < n; ++i) files.push_back(folder + "/piece_" + std::to_string(i) + ".vtu");
    return files;
  }

  double coordinate(int axis, std::int64_t plane) const {
    const std::int64_t all = shape_[static_cast<std::size_t>(axis)] * (side_ - 1);
    return (static_cast<double>(plane) - 0.5 * static_cast<double>(all)) * spacing_ - (axis == 2 ? 0.4 : 0);
  }

  std::array<std::int64_t, 3> place_of(std::int64_t piece) const {
    return {piece % shape_[0], piece / shape_[0] % shape_[1], piece / shape_[0] / shape_[1]};
  }

  void make(std::int64_t piece, const std::string &path) const {
    const std::int64_t n = side_, m = n - 1, n_nodes = n * n * n, n_cells = m * m * m, plane = n * n;
    const std::array<std::int64_t, 3> place = place_of(piece);
    const std::int64_t blocks[] = {24 * n_nodes, 64 * n_cells, 8 * n_cells};
    std::string text =
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "<UnstructuredGrid><Piece NumberOfPoints=\"" +
        std::to_string(n_nodes) + "\" NumberOfCells=\"" + std::to_string(n_cells) +
        "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" "
        "offset=\"0\"/></Points>\n<Cells>";
    std::int64_t offset = 8 + blocks[0];
    for (const char *name : {"connectivity", "offsets", "types"}) {
      text += std::string("<DataArray type=\"") + (name[0] == 't' ? "UInt8" : "Int64") + "\" Name=\"" + name +
              "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>";
      offset += 8 + (name[0] == 'c' ? blocks[1] : blocks[2]);
    }
    text += "</Cells></Piece></UnstructuredGrid>\n<AppendedData encoding=\"raw\">_";
    File file(path, "wb");
    file.write(text.data(), text.size());
    file.write_block_of<double>(3 * n_nodes);
    std::vector<double> xyz;
    for (std::int64_t i = 0; i < n_nodes; ++i) {
      const std::int64_t at[3] = {i % n, i / n % n, i / plane};
      for (int k = 0; k < 3; ++k) {
        xyz.push_back(coordinate(k, place[static_cast<std::size_t>(k)] * m + at[k]));
      }
      if (static_cast<std::int64_t>(xyz.size()) == 3 * n || i + 1 == n_nodes) {
        file.write_all(xyz);
        xyz.clear();
      }
    }
    file.write_block_of<std::int64_t>(8 * n_cells);
    std::vector<std::int64_t> ids;
    for (std::int64_t i = 0; i < n_cells; ++i) {
      const std::int64_t first = i % m + n * (i / m % m) + plane * (i / m / m);
      for (const std::int64_t corner : {first, first + 1, first + n + 1, first + n, first + plane, first + plane + 1,
                                        first + plane + n + 1, first + plane + n})
        ids.push_back(corner);
      if (static_cast<std::int64_t>(ids.size()) == 8 * m) {
        file.write_all(ids);
        ids.clear();
      }
    }
    file.write_block_of<std::int64_t>(n_cells);
    for (std::int64_t i = 0; i < n_cells; ++i) {
      ids.push_back(8 * (i + 1));
      if (static_cast<std::int64_t>(ids.size()) == m) {
        file.write_all(ids);
        ids.clear();
      }
    }
    file.write_block_of<std::uint8_t>(n_cells);
    const std::vector<std::uint8_t> types(static_cast<std::size_t>(m), 12);
    for (std::int64_t i = 0; i < m * m; ++i) file.write_all(types);
    const std::string end = "\n</AppendedData>\n</VTKFile>\n";
    file.write(end.data(), end.size());
  }

  // Returns the position of an array's values in a file that VTK wrote with raw appended data.
  static long position_of(const std::string &head, const std::string &name) {
    const std::size_t at = head.find("Name=\"" + name + "\""), data = head.find('_', head.find("<AppendedData"));
    const std::size_t offset = at == std::string::npos ? at : head.find("offset=\"", at);
    if (offset == std::string::npos || data == std::string::npos) give_up("an output has no array " + name);
    return static_cast<long>(data) + 1 + 8 + std::atol(head.c_str() + offset + 8);
  }

  void count_marks(std::int64_t piece, const std::string &path) const {
    File marks(path, "rb"), distances(path, "rb");
    std::string head(8192, ' ');
    marks.read(head.data(), head.size());
    marks.seek(position_of(head, "riis_marked"));
    distances.seek(position_of(head, "riis_distance"));
    const std::array<std::int64_t, 3> place = place_of(piece);
    std::vector<std::uint8_t> marked(static_cast<std::size_t>(side_));
    std::vector<double> distance(marked.size());
    for (std::int64_t row = 0; row < side_ * side_; ++row) {
      marks.read(marked.data(), marked.size());
      distances.read(distance.data(), distance.size() * sizeof(double));
      const bool first_row = (row % side_ == 0 && place[1] > 0) || (row / side_ == 0 && place[2] > 0);
      for (std::size_t i = 0; i < marked.size(); ++i) {
        n_wrong += (marked[i] != 0) != (distance[i] <= half_thickness);
        n_marked += marked[i] && !first_row && !(i == 0 && place[0] > 0);
      }
    }
  }

  std::string folder_;
  std::array<std::int64_t, 3> shape_;
  std::int64_t side_;
  double spacing_ = 0;
};

int run(int argc, char **argv) {
  const std::int64_t n_pieces = argc > 1 ? std::atoll(argv[1]) : 10, side = argc > 2 ? std::atoll(argv[2]) : 101;
  const bool with_leaks = argc > 3 && std::strcmp(argv[3], "leaks") == 0;
  if (n_pieces < 1 || n_pieces > 1000000 || side < 2 || side > 1000 ||
      (argc > 3 && !with_leaks && std::strcmp(argv[3], "mark") != 0))
    give_up("usage: riis_bench_scale [PIECES] [NODES_PER_SIDE] [mark|leaks]");
  const auto begin = Clock::now();
  const char *const scratch = std::getenv("TMPDIR");
  std::string folder = std::string(scratch ? scratch : "/tmp") + "/riis-scale-XXXXXX";
  if (!mkdtemp(folder.data())) give_up(folder + " cannot be made");
  MarkOptions options;
  options.mesh = folder + "/mesh.pvtu";
  options.valve = "coapting";
  options.quiet = true;
  if (with_leaks) {
    options.measures = true;
  } else {
    options.output = folder + "/marked.pvtu";
  }
  Case all = case_of_command_line(options);
  GridPieces pieces(all.options, folder, n_pieces, side);
  {
    riis_surface *made = nullptr;
    check(riis_surface_create(all.valves[0].valve.get(), &options.surface_options, &made));
    const riis::Surface surface(made);
    const riis_surface_info info = info_of(made);
    pieces.half_thickness = info.half_thickness;
    // Two points on the axis, inside the box: one below and one above the valve.
    const double low = pieces.z_of(0), high = pieces.z_of(pieces.shape()[2] * (side - 1));
    if (with_leaks)
      all.options.check_leaks = all.valves[0].options.check_leaks =
          LeakCheck{{0, 0, std::max(info.lower[2] - 0.3, low), 0, 0, std::min(info.upper[2] + 0.3, high)},
                    "--between",
                    exit_wrong_usage};
  }
  const Report report = mark_case(all, pieces);
  const ValveReport &marked = report.valves[0];
  const double seconds = seconds_since(begin);
  std::filesystem::remove_all(folder);
  std::printf("pieces    %lld of %lld nodes (%lld x %lld x %lld), edges of %.4f cm, %.1f nodes across the band\n",
              static_cast<long long>(n_pieces), static_cast<long long>(side * side * side),
              static_cast<long long>(pieces.shape()[0]), static_cast<long long>(pieces.shape()[1]),
              static_cast<long long>(pieces.shape()[2]), pieces.spacing(),
              2 * marked.surface.half_thickness / pieces.spacing());
  std::printf("mesh      %s nodes, %s cells\n", grouped(marked.marks.n_nodes).c_str(), grouped(report.n_cells).c_str());
  std::printf("marked    %s nodes\n", grouped(marked.marks.n_marked).c_str());
  const std::string table = table_of(report);
  const std::size_t passage = table.find("passage ");
  if (with_leaks)
    std::printf("%sregions   %lld\n", table.substr(passage, table.find('\n', passage) + 1 - passage).c_str(),
                static_cast<long long>(*marked.flow.n_open_regions));
  std::printf(
      "seconds   %.1f, of which processors worked %.1f: making %.1f, reading %.1f, marking %.1f, leaks and shared "
      "nodes %.1f, writing %.1f, checking "
      "%.1f\n",
      seconds, processor_seconds(), pieces.seconds_making, pieces.seconds_reading,
      report.seconds.mesh + report.seconds.search, report.seconds.leaks, report.seconds.write, pieces.seconds_checking);
  std::printf("memory    %.0f MB at most\n", peak_megabytes());
  if (marked.marks.n_nodes != pieces.n_nodes() || report.n_cells != pieces.n_cells())
    give_up("the mesh has other numbers of nodes or cells");
  if (!with_leaks && (pieces.n_marked != marked.marks.n_marked || pieces.n_wrong > 0))
    give_up("the files have " + std::to_string(pieces.n_marked) + " marks, of which " + std::to_string(pieces.n_wrong) +
            " are wrong");
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  const ranks::Session session(&argc, &argv);
  try {
    return run(argc, argv);
  } catch (const Refusal &refusal) {
    give_up(refusal.text);
  } catch (const ranks::AgreedRefusal &agreed) {
    give_up(agreed.refusal.text);
  }
}
