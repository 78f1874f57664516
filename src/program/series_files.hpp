// SPDX-License-Identifier: Apache-2.0
// The files of a series: one file for each time, in a folder, and next to the folder a .pvd file that lists them with their
// times.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "program/case.hpp"
#include "program/moving_valve.hpp"

namespace riis::program {

// The files of the series cycle.pvd are cycle.pvd, cycle/cycle_0000.vtu, cycle/cycle_0001.vtu, ...
class SeriesFiles {
 public:
  // `ending` is the ending of the steps' files, such as ".vtu".
  SeriesFiles(const std::string &pvd, const std::string &ending, std::size_t n_times);

  const std::string &pvd() const { return pvd_; }
  const std::string &folder() const { return folder_; }
  bool is_wanted() const { return !pvd_.empty(); }
  // Refuses a folder that cannot be written to, and a path that is a file.
  void check_folder() const;
  // Makes the folder if it does not exist.
  void make_folder() const;
  // Returns the path of a step's file. If a step has several files, `part`, a valve's name, distinguishes them. Otherwise it is
  // "".
  std::string path_of(std::size_t step, const std::string &part) const;
  // Adds a file to the list, once the file is complete.
  void add(double time, std::size_t part_number, const std::string &path);
  std::size_t n_written() const { return entries_.size(); }
  // Writes the list of all complete files.
  void write_list() const;

 private:
  struct Entry {
    double time;
    std::size_t part_number;
    std::string name;  // the path relative to the .pvd
  };
  std::string pvd_, folder_, stem_, ending_;
  std::size_t n_digits_;
  std::vector<Entry> entries_;
};

// Writes the lists of a series within half a second after its files, even during a long step. So a killed process leaves lists
// of nearly all its files. The lists are not written after every file, because writing a long list takes longer than writing a
// file.

class SeriesLists {
 public:
  // `write` must write all lists. The object's thread calls it with false, and end() calls it with true.
  explicit SeriesLists(std::function<void(bool is_last)> write);
  ~SeriesLists();
  SeriesLists(const SeriesLists &) = delete;
  SeriesLists &operator=(const SeriesLists &) = delete;

  // Calls `note`, which adds to the lists, while the thread does not write them. Rethrows an exception of `write`.
  void add(const std::function<void()> &note);
  // Ends the thread, and writes the lists for the last time.
  void end();

 private:
  void follow();
  void stop();

  const std::function<void(bool)> write_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_news_ = false, has_ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

// The table of a series in CSV, with a line for each time.

// The columns are time, opening, n_marked, largest_speed and seconds. Each of several valves has its own columns, NAME_opening
// and so on.
class SeriesTable {
 public:
  explicit SeriesTable(const Case &all);
  void add(double time, const std::vector<MovingValve> &valves, double seconds);
  // Takes the numbers of marked nodes, by valve, from the caller.
  void add(double time, const std::vector<MovingValve> &valves, const std::vector<int64_t> &n_marked, double seconds);
  const std::string &text() const { return text_; }
  // Returns the largest number of marked nodes of any valve at any time.
  int64_t most_marked() const;
  // Returns a line for each valve, with its openings, marked nodes and speed.
  std::string summary() const;

 private:
  struct Range {
    double least, most;
    void add(double value);
  };
  struct Row {
    std::string name;
    Range opening, n_marked, speed;
  };
  std::string text_;
  std::vector<Row> rows_;
};

}  // namespace riis::program
