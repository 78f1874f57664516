// SPDX-License-Identifier: Apache-2.0
// Datasets of HDF5 files. Only hdf5_file.cpp includes HDF5's headers, and riis_vtk can be built without HDF5. HDF5 itself can
// crash on a damaged file.
#pragma once

#include <string>
#include <vector>

#include "riis_vtk/base/files.hpp"

namespace riis::vtk {

// Whether this build has HDF5.
extern const bool has_hdf5;

// Reads n numbers of a dataset as doubles or as 64-bit integers. Fails unless the dataset has exactly n and the file holds them.
// is_single tells whether they are real numbers of 32 bits in the file.
template <class Number>
std::vector<Number> read_hdf5(const std::string &path, const std::string &name, std::int64_t n, bool &is_single);

// An HDF5 file that is complete or does not exist, as ReplacingFile.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::string &path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer &) = delete;
  Hdf5Writer &operator=(const Hdf5Writer &) = delete;

  const std::string &path() const { return path_; }
  void write(const std::string &dataset, const double *values, std::int64_t n_rows, std::int64_t n_columns);
  void write(const std::string &dataset, const std::int64_t *values, std::int64_t n_rows, std::int64_t n_columns);
  void commit();

 private:
  void close();

  std::string path_;
  ReplacingFile file_;
  std::int64_t id_ = -1;  // HDF5's identifier of the file, below 0 if it is closed
};

}  // namespace riis::vtk
