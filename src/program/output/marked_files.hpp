// SPDX-License-Identifier: Apache-2.0
// The files of a run: the marked mesh, the surfaces, and the lists of these files. A run has one time or many, and a whole mesh
// or pieces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "program/input/case.hpp"
#include "program/mark/mesh_pieces.hpp"
#include "program/output/report.hpp"

namespace riis::program {

// A file whose text grows by lines during a run. After each line the text in the file is complete, so a killed process leaves a
// complete text. Writing the whole text after each line would take longer than writing the meshes of a long series.
class GrowingText {
 public:
  // The text begins with `head`, and ends with `tail` after each line. If the path is "", no text is written.
  GrowingText(std::string path, std::string head, std::string tail)
      : path_(std::move(path)), text_(std::move(head)), tail_(std::move(tail)), n_head_(text_.size()) {}
  void add(const std::string &line);
  // Writes the text to a device, to a pipe or to stdout, where lines cannot be inserted before the tail.
  void finish() const;

 private:
  std::string path_, text_, tail_;
  std::size_t n_head_;
};

// The files of the series cycle.pvd are cycle.pvd, cycle/cycle_0000.vtu, cycle/cycle_0001.vtu, ...
class SeriesFiles {
 public:
  // `ending` is the ending of the steps' files, such as ".vtu".
  SeriesFiles(const std::string &pvd, const std::string &ending, std::size_t n_times);

  const std::string &folder() const { return folder_; }
  bool is_wanted() const { return !pvd_.empty(); }
  // Refuses a folder without permission to write, and a path that is a file.
  void check_folder() const;
  // Finds the files of steps that an earlier run wrote and this run does not write. These files would look like a part of this
  // run's series, so make_folder removes them. Refuses such a file if no earlier list by riis names it, or if the list of another
  // series names it. `parts` are the parts that path_of accepts. `has_pieces` says whether each step also has files of pieces,
  // whose parts are p0000, p0001 and so on.
  void find_earlier(const std::vector<std::string> &parts, bool has_pieces);
  // Makes the folder if the user wants one and it does not exist. Removes the files of an earlier run.
  void make_folder() const;
  // Returns the path of a step's file. If a step has several files, `part`, the name of the valve, distinguishes these files. If
  // a step has one file, `part` is "".
  std::string path_of(std::size_t step, const std::string &part) const { return path_of(step, part, ending_); }
  std::string path_of(std::size_t step, const std::string &part, const std::string &ending) const;
  // Adds a complete file to the list, and writes the list.
  void add(double time, std::size_t part_number, const std::string &path);
  // Adds the list to the report if the user wants a list.
  void report(Report &report) const;

 private:
  std::string pvd_, folder_, stem_, ending_;
  std::size_t n_times_, n_digits_;
  std::int64_t n_listed_ = 0;
  GrowingText list_;
  std::vector<std::string> earlier_;  // files of an earlier run
};

// The files of the marked mesh. In a series, there is a file for each time. A mesh in pieces has a file for each piece, and for
// each time a .pvtu file that lists the pieces.
class MarkedFiles {
 public:
  // The case and the mesh must outlive this object.
  MarkedFiles(const Case &all, const MeshPieces &mesh);

  bool is_wanted() const { return !path_.empty(); }
  // Returns whether the files of a series are in a list.
  bool has_list() const { return is_wanted() && all_.is_series() && !is_foam_case_; }
  // If the run has a series, finds the files that an earlier run left behind.
  void find_earlier();
  // Makes the folder of the files if there are several files.
  void make_folder() const;
  void write(std::int64_t piece, std::size_t step, const riis_vtk_mesh *file);
  // Adds the complete file of a whole mesh to the list of the series.
  void add(std::size_t step);
  // Writes a .pvtu file for each time. All ranks must have written their pieces.
  void list_pieces();
  const std::string &folder() const { return steps_.folder(); }
  // Adds the written files to the report.
  void report(Report &report) const;

 private:
  std::string path_of(std::int64_t piece, std::size_t step) const;

  const Case &all_;
  const MeshPieces &mesh_;
  const std::string &path_;
  const bool is_foam_case_;  // the fields of a series go to times of OpenFOAM
  SeriesFiles steps_;
  std::vector<std::array<std::int64_t, 2>> written_;  // the step and the piece of each file of this rank
  PieceList sample_;  // with the arrays of this rank's first file that has nodes, if there is one
};

}  // namespace riis::program
