// SPDX-License-Identifier: Apache-2.0
// Checks files, reads files as bytes, lines and words, and writes files under a temporary name. VTK itself reads and writes the
// formats of the files. This header also has the names of the arrays in files.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkType.h>

#include "common/number_from_chars.hpp"
#include "riis_vtk/base/vtk_errors.hpp"

class vtkDataObject;
class vtkFieldData;

namespace riis::vtk {

// The names of the arrays in files. riis_vtk.h documents them.
inline constexpr const char *marked_array = "riis_marked";
inline constexpr const char *distance_array = "riis_distance";
inline constexpr const char *leaflet_array = "riis_leaflet";
inline constexpr const char *patch_array = "riis_patch";
inline constexpr const char *triangle_array = "riis_triangle";
inline constexpr const char *uv_array = "riis_uv";
inline constexpr const char *velocity_array = "riis_velocity";
inline constexpr const char *attached_array = "riis_attached";
inline constexpr const char *node_id_array = "riis_node_id";
inline constexpr const char *cell_id_array = "riis_cell_id";
// The field array in which VTK's filters store the times.
inline constexpr const char *time_array = "TimeValue";
// The default prefix of the names PREFIX_marked, PREFIX_distance and PREFIX_leaflet.
inline constexpr const char *default_prefix = "riis";

// Returns an array with this name and size. Its values are not set.
template <class Array>
vtkSmartPointer<Array> named_array(const std::string &name, vtkIdType n_tuples, int n_components = 1) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(n_components);
  array->SetNumberOfTuples(n_tuples);
  return array;
}

// Returns a text such as "; there are: a, b", for the end of a message about a missing array.
std::string list_of_arrays(vtkFieldData *data);

// Functions for the lines and words of files that are scanned before VTK reads them. Blanks and capitals are those of ASCII, even
// if the locale has others.
bool is_blank(char c);

std::string lower_case(std::string_view text);

// Removes the first line from the text, and returns this line without its line feed.
std::string_view take_line(std::string_view &text);

// Removes the first word from the text, and the blanks before the word. Returns the removed word, or "" if there is none.
std::string_view take_word(std::string_view &text);

// Reads the whole text as a number. Returns false if the text is not a number of the type.
template <class Number>
bool read_number(std::string_view text, Number &number) {
  const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

// Functions that visit an XML file element by element (xml_elements.cpp). No tree of elements is built. A hostile file could nest
// its elements so deeply that the destruction of a tree would overflow the stack.

// The attributes of an element, as a list in which names and values alternate. NULL ends the list.
using XmlAttributes = const char **;
std::optional<std::string> value_of(XmlAttributes attributes, const char *name);

// Calls visit(way, attributes) for each element that is at most three elements deep. `way` has the names of all elements around
// the element, beginning with the outermost, and then the element's own name. Fails if the file is not XML.
using VisitElement = std::function<void(const std::vector<std::string> &way, XmlAttributes attributes)>;
void for_each_element(const std::string &path, const CaughtOutput &caught, const VisitElement &visit);

// Returns the path's ending in lower case without the dot, or "" if there is none.
std::string ending_of(const std::string &path);

// Returns the size of the file. Fails if the path is not a regular and readable file, or if the file is empty. VTK's own messages
// would not give the reason of the failure.
std::int64_t check_readable(const std::string &path);

// The bytes of a file, which can be read while this object lives.
class MappedFile {
 public:
  // Maps the file into memory. `size` must be the result of check_readable.
  MappedFile(const std::string &path, std::int64_t size);
  ~MappedFile();
  MappedFile(const MappedFile &) = delete;
  MappedFile &operator=(const MappedFile &) = delete;

  std::string_view bytes() const { return {static_cast<const char *>(bytes_), size_}; }

 private:
  std::size_t size_;
  void *bytes_;
};

// A file that appears at its path only when it is complete. The file is written to temporary(), a path in the same folder.
// commit() moves it to its final path. The new file gets the permissions of the file that it replaces. Without commit(), the
// destructor removes the temporary file, and nothing changes at the final path.
class ReplacingFile {
 public:
  // Makes the temporary file. Fails if the path cannot be written to. Possible reasons are a missing folder or permission, a path
  // that is not a regular file, and a circle of links.
  explicit ReplacingFile(const std::string &path);
  ~ReplacingFile();
  ReplacingFile(const ReplacingFile &) = delete;
  ReplacingFile &operator=(const ReplacingFile &) = delete;

  const std::string &temporary() const { return temporary_; }
  // Writes content from memory to the temporary file.
  void write(const unsigned char *bytes, std::int64_t n_bytes);
  // Moves the file to its final path. Fails if the temporary file does not end with `closing`, the bytes with which every file of
  // its format ends. On a full disk the temporary file is too short, and not every writer notices this.
  void commit(const std::string &closing);

 private:
  std::string path_;   // the path as the caller gave it
  std::string place_;  // the path with links resolved, so that a link stays and the file behind it is replaced or
                       // made
  std::string temporary_;
};

// Writes a data set to a VTK XML file. The data is raw and appended, which is as fast as the disk and keeps every bit of each
// double. The sizes of blocks have 64 bits, because VTK's default would limit blocks to 4 GiB.
template <class Writer>
void write_xml(const std::string &path, const std::string &ending, vtkDataObject *data, const CaughtOutput &caught) {
  if (ending_of(path) != ending) fail_file(path, "the file's ending must be .", ending);
  ReplacingFile file(path);
  vtkNew<Writer> writer;
  writer->SetFileName(file.temporary().c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  const bool written = writer->Write() != 0;
  if (writer->GetErrorCode() != vtkErrorCode::NoError) {
    fail_file(path, "cannot be written: ", vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
  caught.check(path);
  if (!written) fail_file(path, "cannot be written");
  file.commit("</VTKFile>");
}

}  // namespace riis::vtk
