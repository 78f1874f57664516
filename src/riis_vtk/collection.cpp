// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/collection.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLParser.h>

#include "common/array_view.hpp"
#include "common/message.hpp"
#include "riis_vtk/files.hpp"
#include "riis_vtk/frames.hpp"
#include "riis_vtk/xml_scan.hpp"

namespace riis::vtk {
namespace {

// A DataSet element as it stands in the file.
struct NamedDataSet {
  std::optional<std::string> file, timestep;
};

// Collects the elements /VTKFile/Collection/DataSet. It builds no tree, whose destruction would recurse as deep as a hostile
// file nests.
class CollectionParser : public vtkXMLParser {
 public:
  static CollectionParser *New();
  vtkTypeMacro(CollectionParser, vtkXMLParser);

  std::vector<NamedDataSet> data_sets;
  std::exception_ptr failure;  // in one of the functions below, whose caller is in C

 protected:
  void StartElement(const char *name, const char **attributes) override {
    constexpr const char *way[] = {"VTKFile", "Collection", "DataSet"};
    if (depth_ == n_right_ && depth_ < 3 && std::strcmp(name, way[depth_]) == 0) {
      if (++n_right_ == 3) keep(attributes);
    }
    ++depth_;
  }
  void EndElement(const char *) override {
    --depth_;
    if (n_right_ > depth_) n_right_ = depth_;
  }

 private:
  void keep(const char **attributes) noexcept {
    try {
      NamedDataSet data_set;
      for (; attributes[0] && attributes[1]; attributes += 2) {
        if (std::strcmp(attributes[0], "file") == 0) data_set.file = attributes[1];
        if (std::strcmp(attributes[0], "timestep") == 0) data_set.timestep = attributes[1];
      }
      data_sets.push_back(std::move(data_set));
    } catch (...) {
      failure = std::current_exception();
    }
  }

  std::int64_t depth_ = 0, n_right_ = 0;  // of the open elements, the outermost that are on the way
};
vtkStandardNewMacro(CollectionParser);

double time_of(const std::string &path, const std::string &which, const std::string &timestep) {
  const std::size_t begin = timestep.find_first_not_of(" \t\r\n"), end = timestep.find_last_not_of(" \t\r\n") + 1;
  double time = 0;
  const char *const first = timestep.data() + (begin == std::string::npos ? 0 : begin), *const last = timestep.data() + end;
  const auto [read_to, error] = std::from_chars(first, last, time);
  if (error != std::errc() || read_to != last || !is_time(time))
    fail_file(path, which + " has the timestep '" + timestep.substr(0, 40) + "', which is no number from -1e30 to 1e30");
  return time;
}

std::vector<NamedDataSet> data_sets_of(const std::string &path, const CaughtOutput &caught) {
  check_xml(path, "Collection");
  vtkNew<CollectionParser> parser;
  parser->SetFileName(path.c_str());
  const bool parsed = parser->Parse() != 0;
  if (parser->failure) std::rethrow_exception(parser->failure);
  caught.check(path);
  if (!parsed) fail_file(path, "cannot be parsed");
  return std::move(parser->data_sets);
}

}  // namespace

Collection read_collection(const std::string &path, const CaughtOutput &caught) {
  if (ending_of(path) != "pvd") fail_file(path, "a collection of files in time must be a .pvd file");
  const std::vector<NamedDataSet> data_sets = data_sets_of(path, caught);
  if (data_sets.empty()) fail_file(path, "names no files: it has no DataSet in a Collection");
  if (view(data_sets).size() > most_frames)
    fail_file(path, Message("names ", view(data_sets).size(), " files, more than ", most_frames).text());
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  Collection collection;
  for (const NamedDataSet &data_set : data_sets) {
    const std::string which = "DataSet " + std::to_string(collection.paths.size());
    if (!data_set.file || data_set.file->empty()) fail_file(path, which + " names no file");
    if (!data_set.timestep) fail_file(path, which + " has no timestep");
    const double time = time_of(path, which, *data_set.timestep);
    if (!collection.times.empty() && !(time > collection.times.back()))
      fail_file(path, Message(which, " has the timestep ", time, ", which is not above that of the DataSet before, ",
                              collection.times.back())
                          .text());
    collection.times.push_back(time);
    collection.paths.push_back((folder / *data_set.file).string());
  }
  return collection;
}

}  // namespace riis::vtk
