// SPDX-License-Identifier: Apache-2.0
// Takes the place of svMultiPhysics's uris.h and of the classes that it uses. This header has only the members that
// examples/svmultiphysics uses, with the solver's names. model.cpp defines the functions.
#pragma once

#include <array>
#include <string>
#include <vector>

template <class T>
class Vector {
 public:
  explicit Vector(int size = 0) : values_(size) {}
  Vector &operator=(double value) {
    values_.assign(values_.size(), value);
    return *this;
  }
  void resize(int size) { values_.assign(size, T{}); }
  int size() const { return static_cast<int>(values_.size()); }
  T *data() const { return const_cast<T *>(values_.data()); }  // the solver's data() also removes const
  T &operator()(int i) { return values_.at(i); }
  const T &operator()(int i) const { return values_.at(i); }
  Vector operator-(const Vector &other) const {
    Vector result(size());
    for (int i = 0; i < size(); ++i) result(i) = values_[i] - other(i);
    return result;
  }
  T operator*(const Vector &other) const {
    T sum{};
    for (int i = 0; i < size(); ++i) sum += values_[i] * other(i);
    return sum;
  }

 private:
  std::vector<T> values_;
};

template <class T>
class Array {
 public:
  explicit Array(int rows = 0, int columns = 0) : rows_(rows), columns_(columns), values_(rows * columns) {}
  Array &operator=(double value) {
    values_.assign(values_.size(), value);
    return *this;
  }
  void resize(int rows, int columns) { *this = Array(rows, columns); }
  int ncols() const { return columns_; }
  T *data() const { return const_cast<T *>(values_.data()); }
  T &operator()(int i, int j) { return values_.at(i + rows_ * j); }
  const T &operator()(int i, int j) const { return values_.at(i + rows_ * j); }
  Vector<T> col(int j) const {
    Vector<T> result(rows_);
    for (int i = 0; i < rows_; ++i) result(i) = (*this)(i, j);
    return result;
  }

 private:
  int rows_, columns_;
  std::vector<T> values_;
};

template <class T>
class Array3 {
 public:
  void push_back(const Array<T> &slice) { slices_.push_back(slice); }
  int nslices() const { return static_cast<int>(slices_.size()); }
  Array<T> rslice(int slice) const { return slices_.at(slice); }

 private:
  std::vector<Array<T>> slices_;
};

struct mshType {
  std::string name;
  int nEl = 0, eNoN = 0;
  Array<int> IEN;
  Array<double> x;
};

struct fsType {
  int nG = 0, eNoN = 0;
  Array<double> N;
};

struct urisType {
  std::string name;
  int tnNo = 0, nFa = 0, cnt = 1000000;
  Array<double> x, x_prev, valve_velocity, valve_velocity_fluid;
  double sdf_default = 0, sdf_deps = 0, sdf_deps_close = 0, resistance = 0;
  bool clsFlg = true, include_uris_velocity = true, scaffold_flag = false, sdf_computed = false,
       scaffold_udf_computed = false;
  Array3<double> DxOpen, DxClose;
  Vector<double> nrm, sdf, scaffold_udf;
  std::vector<mshType> msh;
  mshType scaffold_msh;
};

struct cmType {
  int idcm() const { return 0; }
};

struct ComMod {
  int nsd = 3, tnNo = 0, cTS = 0;
  double dt = 0;
  bool urisActFlag = true;
  cmType cm;
  Array<double> x;
  std::vector<bool> urisFluidNodeMask;
  std::vector<urisType> uris;
  std::vector<mshType> msh;
};

namespace uris {

void uris_calc_sdf(ComMod &com_mod);
void eval_uris_ris_factors_quadrature(const ComMod &com_mod, const mshType &mesh, const fsType &space,
                                      const int element, Vector<double> &K, Array<double> &K_u);
void uris_build_fluid_node_mask(ComMod &com_mod);
void surface_element_barycenter(const urisType &uris, int face, int element, Vector<double> &middle);
void uris_face_unit_normal(const urisType &uris, const int nsd, const int face, const int element,
                           Vector<double> &normal);
double uris_compute_sdf_sign(const urisType &uris, const Vector<double> &place, const Vector<double> &middle,
                             const double above);

}  // namespace uris
