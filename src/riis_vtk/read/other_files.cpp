// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/read/other_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>

#include "common/number_from_chars.hpp"

namespace riis::vtk {

void add_note(vtkUnstructuredGrid *grid, const std::string &note) {
  const auto array = named_array<vtkStringArray>(note_array, 1);
  array->SetValue(0, note);
  grid->GetFieldData()->AddArray(array);
}

PlainGrid::PlainGrid() {
  xyz->SetNumberOfComponents(3);
  ends->InsertNextValue(0);
}

void PlainGrid::end_cell(int vtk_type) {
  types->InsertNextValue(static_cast<unsigned char>(vtk_type));
  ends->InsertNextValue(ids->GetNumberOfValues());
  has_polyhedra = has_polyhedra || vtk_type == VTK_POLYHEDRON;
}

vtkSmartPointer<vtkUnstructuredGrid> PlainGrid::grid(const std::string &path) {
  const vtkIdType n_points = xyz->GetNumberOfTuples(), n_cells = types->GetNumberOfValues();
  const double *const coordinates = xyz->GetPointer(0);
  const double *const end = coordinates + 3 * n_points;
  const double *const bad = std::find_if(coordinates, end, [](double x) { return !std::isfinite(x); });
  if (bad != end) {
    const char *const axes[] = {"x", "y", "z"};
    fail_file(path, axes[(bad - coordinates) % 3], " of node ", (bad - coordinates) / 3, " is ", *bad);
  }
  const auto made = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  made->SetPoints(points);
  if (!has_polyhedra) {
    vtkNew<vtkCellArray> cells;
    cells->SetData(ends.Get(), ids.Get());
    made->SetCells(types, cells);
    return made;
  }
  made->AllocateEstimate(n_cells, 8);
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < n_cells; ++cell) {
    const vtkIdType begin = ends->GetValue(cell), size = ends->GetValue(cell + 1) - begin;
    corners->SetNumberOfIds(size);
    std::copy_n(ids->GetPointer(begin), size, corners->GetPointer(0));
    made->InsertNextCell(types->GetValue(cell), corners);
  }
  return made;
}

std::string Source::place() const {
  const auto at = static_cast<std::int64_t>(rest_.data() - bytes_.data());
  if (is_binary) return joined("byte ", at, ": ");
  return joined("line ", 1 + std::count(bytes_.begin(), bytes_.begin() + at, '\n'), ": ");
}

template <class T>
T Source::raw() {
  char bytes[sizeof(T)];
  if (rest_.size() < sizeof bytes) fail_file(path_, "is truncated: it ends within its numbers");
  std::memcpy(bytes, rest_.data(), sizeof bytes);
  skip(sizeof bytes);
  if (is_swapped) std::reverse(bytes, bytes + sizeof bytes);
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}
template std::int8_t Source::raw();
template std::uint8_t Source::raw();
template std::int16_t Source::raw();
template std::uint16_t Source::raw();
template std::uint32_t Source::raw();
template std::uint64_t Source::raw();

std::int64_t Source::integer(int n_bytes, bool is_unsigned) {
  if (!is_binary) return integer_of(word());
  switch (n_bytes) {
    case 1:
      return is_unsigned ? std::int64_t{raw<std::uint8_t>()} : raw<std::int8_t>();
    case 2:
      return is_unsigned ? std::int64_t{raw<std::uint16_t>()} : raw<std::int16_t>();
    case 4:
      return is_unsigned ? std::int64_t{raw<std::uint32_t>()} : raw<std::int32_t>();
    default:
      return raw<std::int64_t>();
  }
}

double Source::real(int n_bytes) {
  if (is_binary) return n_bytes == 4 ? static_cast<double>(raw<float>()) : raw<double>();
  return real_of(word());
}

std::int64_t Source::integer_of(std::string_view text) const {
  if (text.empty()) fail_file(path_, "is truncated: it ends within its numbers");
  std::int64_t value = 0;
  if (!read_number(text, value)) refuse("\"", std::string(text.substr(0, 40)), "\" is not a whole number");
  return value;
}

double Source::real_of(std::string_view text) const {
  if (text.empty()) fail_file(path_, "is truncated: it ends within its numbers");
  double value = 0;
  const std::string_view digits = text[0] == '+' ? text.substr(1) : text;
  const auto [end, error] = number_from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = end == digits.data() + digits.size();
  // A number counts as 0 if it is too small for a double.
  if (is_whole && error == std::errc::result_out_of_range && digits.find("e-") != std::string_view::npos) return 0;
  if (!is_whole || error != std::errc()) refuse("\"", std::string(text.substr(0, 40)), "\" is not a number");
  return value;
}

void Source::check_count(std::int64_t n, std::int64_t least_bytes, const char *things) const {
  const auto n_left = static_cast<std::int64_t>(rest_.size());
  if (n >= 0 && n <= n_left / least_bytes) return;
  refuse("claims ", n, " ", things, ", but only ", n_left, " bytes follow");
}

std::int64_t Source::count(int n_bytes, std::int64_t least_bytes, const char *things) {
  const std::int64_t n = integer(n_bytes);
  check_count(n, least_bytes, things);
  return n;
}

}  // namespace riis::vtk
