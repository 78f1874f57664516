// SPDX-License-Identifier: Apache-2.0
// Python's arrays through the buffer protocol, which numpy supports: the caller's arrays, new ones, and views of the library's
// memory.
#pragma once

#include <nanobind/ndarray.h>

#include <functional>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <vector>

#include "arguments.hpp"
#include "handles.hpp"

namespace riis_python {

enum class Access { read, write };

// The caller's array, borrowed during this object's lifetime. A wrong type of entries raises TypeError, and any other
// fault InvalidArgumentError.
class Array {
 public:
  // T is double, std::int32_t, std::int64_t or std::uint8_t, which also stands for bool.
  template <class T>
  static Array of(nb::handle object, const char *name, Access access = Access::read);
  // Makes an array of 32-bit or 64-bit integers.
  static Array of_integers(nb::handle object, const char *name);

  Array(Array &&other) noexcept : name_(other.name_), access_(other.access_), view_(other.view_) {
    other.view_.obj = nullptr;
  }
  Array &operator=(Array &&other) noexcept {
    std::swap(name_, other.name_);
    std::swap(access_, other.access_);
    std::swap(view_, other.view_);
    return *this;
  }
  ~Array() {
    if (view_.obj) PyBuffer_Release(&view_);
  }

  const char *name() const { return name_; }
  int n_dimensions() const { return view_.ndim; }
  std::int64_t size(int dimension) const { return view_.shape[dimension]; }
  std::int64_t stride(int dimension) const { return view_.strides[dimension]; }
  std::int32_t bits() const { return static_cast<std::int32_t>(8 * view_.itemsize); }
  template <class T>
  T *data() const {
    return static_cast<T *>(view_.buf);
  }
  nb::object object() const { return nb::borrow(view_.obj); }

  // Refuses an array unless it has the given shape, in which -1 stands for any size. The entries must be in C order without
  // gaps.
  const Array &expect(std::initializer_list<std::int64_t> shape) const;
  // Refuses an array unless it has the given shape. The entries may have any strides.
  const Array &expect_shape(std::initializer_list<std::int64_t> shape) const;

 private:
  Array(nb::handle object, const char *name, Access access, const char *wanted);

  // Refuses an object, and explains how to convert it. If the call writes an array, the message proposes no conversion,
  // because the call would write the converted copy.
  template <class... Parts>
  [[noreturn]] void refuse_entries(nb::handle object, const char *wanted, const Parts &...parts) const;

  const char *name_;
  Access access_;
  Py_buffer view_;
};

// Three coordinates of points in the caller's arrays, in the form of riis.h.
struct Points {
  std::vector<Array> arrays;
  std::int64_t n = 0;
  const double *x = nullptr, *y = nullptr, *z = nullptr;
  std::int64_t stride = 1;
};
// Returns the points of an array (n, 3). The strides of the array may be any positive whole numbers of doubles.
Points points_of(nb::handle xyz, const char *name);
// Returns the points of one array (n, 3), or of three arrays (n) with equal strides.
Points points_of(nb::handle xyz, nb::handle y, nb::handle z);

// Returns a new numpy array with undefined entries.
nb::object new_array(const char *type, std::initializer_list<std::int64_t> shape);
// Returns a new numpy array of equal entries.
nb::object new_filled_array(const char *type, std::initializer_list<std::int64_t> shape, nb::handle value);

// Returns a read-only numpy array that shows memory without a copy. The array keeps the memory's owner alive.
template <class T>
nb::object view_of(const T *data, std::initializer_list<std::size_t> shape, nb::handle owner) {
  static const T empty[1] = {};
  return nb::cast(nb::ndarray<nb::numpy, const T>(data ? data : empty, shape.size(), shape.begin(), owner));
}

// Returns a read-only numpy array with a copy of memory, because a later call may write that memory.
template <class T>
nb::object copy_of(const T *data, std::initializer_list<std::size_t> shape) {
  const std::size_t n = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  std::vector<T> copy(data, data + (data ? n : 0));
  const T *const copied = copy.data();  // this address stays valid if the vector moves
  return view_of(copied, shape, keeper_of(std::move(copy)));
}

// Returns three numbers as a new numpy array.
template <class T, std::size_t n>
nb::object array_of(const T (&numbers)[n], const char *type) {
  const nb::object array = new_array(type, {n});
  const Array to = Array::of<T>(array, "array", Access::write);
  for (std::size_t i = 0; i < n; ++i) to.template data<T>()[i] = numbers[i];
  return array;
}

// An array that a call writes: a new array, the caller's array, or none.
struct Output {
  nb::object array = nb::none();
  std::optional<Array> memory;
  template <class T>
  T *data() const {
    return memory ? memory->data<T>() : nullptr;
  }
};
// Makes the output that an argument requests. The argument is True, False, or an array to write.
template <class T>
Output output_of(nb::handle wanted, const char *name, const char *type, std::initializer_list<std::int64_t> shape,
                 nb::handle fill = nb::none()) {
  Output output;
  if (wanted.ptr() == Py_False) return output;
  if (wanted.ptr() == Py_True)
    output.array = fill.is_none() ? new_array(type, shape) : new_filled_array(type, shape, fill);
  else
    output.array = nb::borrow(wanted);
  output.memory.emplace(Array::of<T>(output.array, name, Access::write));
  output.memory->expect(shape);
  return output;
}

}  // namespace riis_python
