// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/stl_files.hpp"

#include <cstdint>
#include <string_view>

#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include "riis_vtk/files.hpp"
#include "riis_vtk/text.hpp"

namespace riis::vtk {
namespace {

constexpr std::int64_t binary_header_size = 84;  // 80 arbitrary bytes, then the number of triangles
constexpr std::int64_t binary_triangle_size = 50;

// Returns the number of triangles in the header of a binary file (little endian), or 0 if the file is too short for a header.
std::int64_t binary_count(std::string_view bytes) {
  if (bytes.size() < static_cast<std::size_t>(binary_header_size)) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<std::int64_t>(static_cast<unsigned char>(bytes[i])); };
  return byte(80) | byte(81) << 8 | byte(82) << 16 | byte(83) << 24;
}

// Returns the number of triangles in an ASCII file. Only the first word of a line is a keyword: in "solid endfacet part" the
// second word is a name. Blank lines may follow the last endsolid.
std::int64_t ascii_count(const std::string &path, std::string_view text) {
  std::int64_t n = 0;
  std::string keyword;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word.empty()) continue;
    keyword = lower_case(word);
    n += keyword == "endfacet";
  }
  if (keyword != "endsolid") fail_file(path, "is truncated: endsolid is missing");
  return n;
}

// Returns how many triangles the file must give. VTK ignores the count in a binary file and the end mark of an ASCII one, so it
// reads a truncated file as a smaller surface.
std::int64_t promised_triangles(const std::string &path, std::string_view bytes) {
  const std::int64_t n = binary_count(bytes);
  const std::int64_t n_behind =
      static_cast<std::int64_t>(bytes.size()) - (binary_header_size + n * binary_triangle_size);
  if (n_behind == 0) return n;
  std::string_view begin = bytes;
  if (lower_case(take_word(begin)) == "solid") return ascii_count(path, bytes);
  if (n_behind > 0) {
    fail_file(path, "has " + std::to_string(n_behind) + " bytes behind the " + std::to_string(n) +
                        " triangles that its header promises");
  }
  fail_file(path, "is truncated or not an STL file: " + std::to_string(bytes.size()) + " bytes, " + std::to_string(n) +
                      " triangles in its header");
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_stl(const std::string &path, const CaughtOutput &caught) {
  const std::int64_t n_promised = promised_triangles(path, MappedFile(path, check_readable(path)).bytes());
  if (n_promised == 0) fail_file(path, "holds no faces");
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(path.c_str());
  reader->MergingOff();
  reader->Update();
  caught.check(path);
  vtkSmartPointer<vtkPolyData> data = reader->GetOutput();
  if (data->GetNumberOfCells() != n_promised) {
    fail_file(path, "gives " + std::to_string(data->GetNumberOfCells()) + " of the " + std::to_string(n_promised) +
                        " triangles that it promises");
  }
  data->BuildCells();
  return data;
}

}  // namespace riis::vtk
