// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/read/other_files.hpp"

#ifdef RIIS_VTK_HDF5
#include <vtk_hdf5.h>
#endif

namespace riis::vtk {

#ifdef RIIS_VTK_HDF5
namespace {

// An identifier of HDF5. The destructor closes it.
class Identifier {
 public:
  Identifier(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Identifier() {
    if (id_ >= 0) close_(id_);
  }
  Identifier(const Identifier &) = delete;
  Identifier &operator=(const Identifier &) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// While an object of this type lives, HDF5 prints no errors.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence &) = delete;
  Silence &operator=(const Silence &) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void *data_ = nullptr;
};

hid_t type_in_memory(const double *) { return H5T_NATIVE_DOUBLE; }
hid_t type_in_memory(const std::int64_t *) { return H5T_NATIVE_INT64; }

// Fails if the file does not contain all values of the dataset. HDF5 would fill in a default for values that were never written.
// Data can be at most 1032 times as large as its compressed chunk, because deflate compresses by no larger factor.
void check_storage(const std::string &path, const std::string &name, hid_t dataset, std::int64_t n_bytes) {
  const Identifier properties(H5Dget_create_plist(dataset), H5Pclose);
  const bool is_filtered = H5Pget_layout(properties) == H5D_CHUNKED && H5Pget_nfilters(properties) > 0;
  const auto n_stored = static_cast<std::int64_t>(H5Dget_storage_size(dataset));
  constexpr std::int64_t most_ratio = 1032;
  if (is_filtered ? n_stored < n_bytes / most_ratio : n_stored < n_bytes)
    fail_file(path, "dataset ", name, " claims ", n_bytes, " bytes, but the file holds ", n_stored, " of them");
}

template <class Number>
void write_dataset(const std::string &path, hid_t file, const std::string &name, const Number *values,
                   std::int64_t n_rows, std::int64_t n_columns) {
  const hsize_t size[] = {static_cast<hsize_t>(n_rows), static_cast<hsize_t>(n_columns)};
  const Silence silence;
  const Identifier space(H5Screate_simple(n_columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
  const Identifier dataset(
      H5Dcreate2(file, ("/" + name).c_str(), type_in_memory(values), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  if (dataset < 0 || H5Dwrite(dataset, type_in_memory(values), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail_file(path, "could not be written completely (is the disk full?)");
}

}  // namespace

const bool has_hdf5 = true;

template <class Number>
std::vector<Number> read_hdf5(const std::string &path, const std::string &name, std::int64_t n, bool &is_single) {
  const std::int64_t file_size = check_readable(path);
  const Silence silence;
  const Identifier file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file < 0) fail_file(path, "is not an HDF5 file, is damaged, or is truncated (it has ", file_size, " bytes)");
  const Identifier dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) fail_file(path, "has no dataset ", name);
  const Identifier space(H5Dget_space(dataset), H5Sclose), type(H5Dget_type(dataset), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && (kind != H5T_FLOAT || !std::is_same_v<Number, double>))
    fail_file(path, "dataset ", name, " does not hold ", std::is_same_v<Number, double> ? "numbers" : "whole numbers");
  const auto n_held = static_cast<std::int64_t>(H5Sget_simple_extent_npoints(space));
  if (n_held != n) fail_file(path, "dataset ", name, " has ", n_held, " numbers in place of ", n);
  const auto n_bytes = static_cast<std::int64_t>(H5Tget_size(type));
  is_single = kind == H5T_FLOAT && n_bytes < 8;
  check_storage(path, name, dataset, n * n_bytes);
  std::vector<Number> values(static_cast<std::size_t>(n));
  if (n > 0 && H5Dread(dataset, type_in_memory(values.data()), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail_file(path, "is damaged: dataset ", name, " cannot be read");
  return values;
}

Hdf5Writer::Hdf5Writer(const std::string &path) : path_(path), file_(path) {
  const Silence silence;
  id_ = H5Fcreate(file_.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (id_ < 0) fail_file(path, "cannot be written");
}

Hdf5Writer::~Hdf5Writer() { close(); }

void Hdf5Writer::close() {
  const Silence silence;
  if (id_ >= 0) H5Fclose(id_);
  id_ = -1;
}

void Hdf5Writer::write(const std::string &dataset, const double *values, std::int64_t n_rows, std::int64_t n_columns) {
  write_dataset(path_, id_, dataset, values, n_rows, n_columns);
}
void Hdf5Writer::write(const std::string &dataset, const std::int64_t *values, std::int64_t n_rows,
                       std::int64_t n_columns) {
  write_dataset(path_, id_, dataset, values, n_rows, n_columns);
}

void Hdf5Writer::commit() {
  {
    const Silence silence;
    if (H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0) fail_file(path_, "could not be written completely (is the disk full?)");
  }
  close();
  file_.commit("");
}

#else

const bool has_hdf5 = false;

template <class Number>
std::vector<Number> read_hdf5(const std::string &path, const std::string &, std::int64_t, bool &) {
  fail_file(path, "is an HDF5 file, but this riis was built without HDF5; meshio converts its .xdmf to a .vtu");
}

Hdf5Writer::Hdf5Writer(const std::string &path) : path_(path), file_(path) {
  fail_file(path, "this riis was built without HDF5");
}
void Hdf5Writer::write(const std::string &, const double *, std::int64_t, std::int64_t) {}
void Hdf5Writer::write(const std::string &, const std::int64_t *, std::int64_t, std::int64_t) {}
Hdf5Writer::~Hdf5Writer() = default;
void Hdf5Writer::close() {}
void Hdf5Writer::commit() {}

#endif

template std::vector<double> read_hdf5(const std::string &, const std::string &, std::int64_t, bool &);
template std::vector<std::int64_t> read_hdf5(const std::string &, const std::string &, std::int64_t, bool &);

}  // namespace riis::vtk
