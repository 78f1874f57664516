// SPDX-License-Identifier: Apache-2.0
// Readers of VTK that are watched while they read. If the file has less data than an array needs, the array is refused before VTK
// reads it. The resulting data set is as large as the file states.
#pragma once

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <vtkCharArray.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkErrorCode.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLUnstructuredDataReader.h>

#include "common/array_view.hpp"
#include "riis_vtk/read/grid_files.hpp"

namespace riis::vtk {

[[noreturn]] inline void fail_faces(const std::string &path, vtkIdType cell) {
  fail_file(path, "cell ", cell, " has broken polyhedron faces");
}

// Runs functions in callbacks from VTK. An exception must not pass through VTK. Therefore the first exception is stored, and
// rethrow() throws it later.
class Steps {
 public:
  template <class Step>
  bool run(const Step &step) noexcept {
    try {
      if (!failure_) step();
    } catch (...) {
      failure_ = std::current_exception();
    }
    return !failure_;
  }
  bool have_failed() const { return failure_ != nullptr; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::exception_ptr failure_;
};

// Returns a value as an id of VTK. A value that is no id becomes -1 or a very large id, and later checks refuse it.
inline vtkIdType id_at(vtkDataArray *array, vtkIdType i) {
  constexpr double most = 1e15;
  const double value = array->GetTuple1(i);
  return value >= 0 ? static_cast<vtkIdType>(std::min(value, most)) : -1;
}

// Reports failures that VTK's XML readers only record. If the file has less data than VTK would read for an array, the array is
// refused before VTK reads it.
template <class Reader>
class WatchedReader : public Reader {
 public:
  static WatchedReader *New() { VTK_STANDARD_NEW_BODY(WatchedReader); }

  enum class Data { all, without_arrays };
  void read(const std::string &path, Data wanted) {
    path_ = path;
    sizes_.emplace(path_);
    this->SetFileName(path.c_str());
    this->UpdateInformation();
    if (wanted == Data::without_arrays) {
      this->GetPointDataArraySelection()->DisableAllArrays();
      this->GetCellDataArraySelection()->DisableAllArrays();
    }
    if (!this->InformationError) steps_.run([&] { sizes_->check_pieces(this->XMLParser); });
    if (!steps_.have_failed()) this->Update();
    steps_.rethrow();
  }
  bool has_failed() const {
    return this->DataError || this->InformationError || this->ErrorCode != vtkErrorCode::NoError;
  }

 protected:
  using FieldType = typename Reader::FieldType;

  int ReadArrayValues(vtkXMLDataElement *element, vtkIdType index, vtkAbstractArray *array, vtkIdType begin,
                      vtkIdType n, FieldType type = Reader::OTHER) override {
    const auto check_number = [&] { check_held(element, begin + n, array); };
    const auto check_next = [&] {
      if constexpr (std::is_base_of_v<vtkXMLUnstructuredDataReader, Reader>)
        check_next_array(element, vtkDataArray::SafeDownCast(array), begin + n);
    };
    return steps_.run(check_number) && Reader::ReadArrayValues(element, index, array, begin, n, type) &&
           steps_.run(check_next);
  }

  // Fails if the file does not have n values for an element.
  void check_held(vtkXMLDataElement *element, vtkIdType n, vtkAbstractArray *array) {
    sizes_->check_values(this->XMLParser, element, n, array);
  }
  const std::string &path() const { return path_; }
  Steps &steps() { return steps_; }

 private:
  // Checks the array that VTK reads after an array of offsets. The last offset is the number of values in this array.
  void check_next_array(vtkXMLDataElement *element, vtkDataArray *array, vtkIdType n) {
    const std::string name = element->GetAttribute("Name") ? element->GetAttribute("Name") : "";
    const std::string parent = element->GetParent() ? element->GetParent()->GetName() : "";
    const bool are_cells =
        parent == "Cells" || parent == "Verts" || parent == "Lines" || parent == "Strips" || parent == "Polys";
    if (!are_cells || !array || n == 0) return;
    if (name == "offsets") check_length("connectivity", element, array, array->GetNumberOfTuples() - 1);
    if (name == "faceoffsets") {
      face_ends_.assign(static_cast<std::size_t>(n), -1);
      for (vtkIdType i = 0; i < n; ++i) view(face_ends_)[i] = id_at(array, i);
      for (vtkIdType i = n; i-- > 0;)
        if (view(face_ends_)[i] > -1) return check_length("faces", element, array, i);
    }
    if (name == "faces") check_stream(array, n);
  }

  void check_length(const char *name, vtkXMLDataElement *offsets, vtkDataArray *array, vtkIdType last) {
    vtkXMLDataElement *next = this->FindDataArrayWithName(offsets->GetParent(), name);
    if (!next) return;
    const auto values = vtkSmartPointer<vtkAbstractArray>::Take(this->CreateArray(next));
    if (values) check_held(next, id_at(array, last), values);
  }

  // Checks the faces of polyhedra, because VTK's reader uses them without a check.
  void check_stream(vtkDataArray *faces, vtkIdType n) const {
    vtkIdType at = 0;
    for (std::int64_t cell = 0; cell < view(face_ends_).size(); ++cell) {
      if (view(face_ends_)[cell] < 0) continue;
      const auto next = [&] {
        if (at >= n) fail_faces(path_, cell);
        return id_at(faces, at++);
      };
      for (vtkIdType n_left = next(); n_left > 0; --n_left) {
        const vtkIdType n_corners = next();
        if (n_corners < 0 || n_corners > n - at) fail_faces(path_, cell);
        at += n_corners;
      }
    }
  }

  std::string path_;
  std::optional<XmlSizes> sizes_;
  Steps steps_;
  std::vector<vtkIdType> face_ends_;  // for each cell of the piece, the end of its faces; -1 for cells that are not
                                      // polyhedra
};

// Explains why a file could not be read. VTK 9.1 crashes when it writes its message about an unreadable array. The file was
// therefore first read without VTK's messages. This function reads it again without the arrays, so that VTK reports all other
// faults.
template <class Watched>
[[noreturn]] void explain_failure(const std::string &path, const CaughtOutput &caught) {
  vtkNew<Watched> reader;
  reader->read(path, Watched::Data::without_arrays);
  caught.check(path);
  fail_file(path, "is damaged: not all of its arrays can be read");
}

// Reads a file with a VTK XML reader that is watched. The data set is then compared with the sizes that the file states.
template <class Watched, class DataSet>
vtkSmartPointer<DataSet> read_xml(const std::string &path, const CaughtOutput &caught) {
  vtkNew<Watched> reader;
  vtkObject::SetGlobalWarningDisplay(0);
  reader->read(path, Watched::Data::all);
  vtkObject::SetGlobalWarningDisplay(1);
  vtkSmartPointer<DataSet> data = reader->GetOutput();
  if (reader->has_failed() || !data || data->GetNumberOfPoints() != reader->GetNumberOfPoints() ||
      data->GetNumberOfCells() != reader->GetNumberOfCells()) {
    explain_failure<Watched>(path, caught);
  }
  return data;
}

// Reads a legacy file by VTK. `content` is the result of the scan.
template <class Reader, class DataSet>
vtkSmartPointer<DataSet> read_scanned(const std::string &path, const LegacyContent &content,
                                      const CaughtOutput &caught) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkCharArray> rewritten;
  if (!content.rewritten.empty()) {
    // The array does not own the bytes, and VTK only reads them.
    rewritten->SetArray(const_cast<char *>(content.rewritten.data()), view(content.rewritten).size(), 1);
    reader->ReadFromInputStringOn();
    reader->SetInputArray(rewritten);
  }
  // Without these calls, the reader would keep only one array of each kind.
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  reader->Update();
  caught.check(path);
  vtkSmartPointer<DataSet> data = reader->GetOutput();
  if (!data) fail_file(path, "could not be read");
  if (data->GetNumberOfCells() != content.n_cells) {
    fail_file(path, "gives ", data->GetNumberOfCells(), " of the ", content.n_cells, " cells that it promises");
  }
  return data;
}

}  // namespace riis::vtk
