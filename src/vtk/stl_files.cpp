// SPDX-License-Identifier: Apache-2.0
#include "vtk/stl_files.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>

#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include "vtk/files.hpp"

namespace riis::vtk {
namespace {

constexpr std::int64_t binary_header_size = 84;  // 80 bytes of anything, then the number of triangles
constexpr std::int64_t binary_triangle_size = 50;

// The number of triangles in the header of a binary file, little endian; 0 for files too short to have one.
std::int64_t binary_count(const std::string &path) {
  unsigned char header[binary_header_size] = {};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char *>(header), sizeof header);
  return header[80] | header[81] << 8 | header[82] << 16 | static_cast<std::int64_t>(header[83]) << 24;
}

bool begins_with_solid(const std::string &path) {
  char word[5] = {};
  std::ifstream(path, std::ios::binary).read(word, sizeof word);
  return std::equal(word, word + sizeof word, "solid");
}

std::int64_t count_words(const std::string &path, const std::string &word) {
  std::ifstream file(path);
  std::int64_t n = 0;
  for (std::string text; file >> text;) n += text == word;
  return n;
}

// How many triangles the file must give. VTK ignores the count in a binary file and the end mark of an ASCII one, and
// so reads a truncated file as a smaller surface.
std::int64_t promised_triangles(const std::string &path, std::int64_t size) {
  const std::int64_t n = binary_count(path);
  if (size == binary_header_size + n * binary_triangle_size) return n;
  if (!begins_with_solid(path)) {
    fail_file(path, "is truncated or not an STL file: " + std::to_string(size) + " bytes, " + std::to_string(n) +
                        " triangles in its header");
  }
  if (tail_of(path, 4096).find("endsolid") == std::string::npos) fail_file(path, "is truncated: endsolid is missing");
  return count_words(path, "endfacet");
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_stl(const std::string &path, const CaughtOutput &caught) {
  const std::int64_t n_promised = promised_triangles(path, check_readable(path));
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
