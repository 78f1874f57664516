// SPDX-License-Identifier: Apache-2.0
#include "arrays.hpp"

#include <cstring>

namespace riis_python {
namespace {

constexpr bool is_little_endian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
static_assert(is_little_endian, "formats of buffers are compared for little-endian machines");

// Returns the letter of a format for single entries, such as 'd', or 0 for other formats.
char letter_of(const char *format) {
  if (!format) return 'B';
  if (std::strchr("@=<", *format) && *format) ++format;
  return format[0] && !format[1] ? format[0] : '\0';
}

bool is_of(const Py_buffer &view, const char *wanted) {
  const char letter = letter_of(view.format);
  if (!letter) return false;
  const auto is_integer = [&](Py_ssize_t size) { return std::strchr("iqlnh", letter) && view.itemsize == size; };
  const std::string type = wanted;
  if (type == "float64") return letter == 'd';
  if (type == "int32") return is_integer(4);
  if (type == "int64") return is_integer(8);
  if (type == "int32 or int64") return is_integer(4) || is_integer(8);
  return letter == '?' || letter == 'B';
}

std::string dtype_of(nb::handle object, const char *format) {
  if (nb::hasattr(object, "dtype")) return nb::cast<std::string>(nb::str(nb::object(object.attr("dtype"))));
  return format ? format : "uint8";
}

template <class Sizes>
std::string tuple_of(const Sizes &sizes) {
  std::string text = "(";
  for (const auto size : sizes) text += text_of(text.size() > 1 ? ", " : "", size < 0 ? "n" : std::to_string(size));
  return text + (sizes.size() == 1 ? ",)" : ")");
}

std::vector<std::int64_t> shape_of(const Array &array) {
  std::vector<std::int64_t> shape;
  for (int i = 0; i < array.n_dimensions(); ++i) shape.push_back(array.size(i));
  return shape;
}

// Returns whether an address or a stride of an array is a whole number of doubles.
bool is_whole(std::int64_t n_bytes) { return n_bytes % static_cast<std::int64_t>(sizeof(double)) == 0; }

// Returns the stride, in doubles, from point to point.
std::int64_t stride_of_points(const Array &array) {
  if (!is_whole(static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(array.data<void>()))))
    refuse_value(array.name(), "its entries are not aligned to 8 bytes; copy the array");
  if (array.size(0) < 2) return 1;
  const std::int64_t n_bytes = array.stride(0);
  if (!is_whole(n_bytes) || n_bytes < 8)
    refuse_value(array.name(), "its points are ", n_bytes,
                 " bytes apart, which is not a positive multiple of 8; copy the array");
  return n_bytes / 8;
}

const double *moved(const double *from, std::int64_t n_bytes) {
  return reinterpret_cast<const double *>(reinterpret_cast<const char *>(from) + n_bytes);
}

nb::tuple python_shape(std::initializer_list<std::int64_t> shape) {
  nb::list sizes;
  for (const std::int64_t size : shape) sizes.append(size);
  return nb::tuple(sizes);
}

// Returns numpy's argument dtype for the wanted type of entries.
const char *dtype_for(const std::string &wanted) {
  if (wanted == "float64") return "float";
  if (wanted == "int32") return "numpy.int32";
  return wanted == "bool or uint8" ? "bool" : "numpy.int64";
}

// Returns whether numpy can convert an object to real numbers.
bool is_convertible(nb::handle object) {
  if (nb::hasattr(object, "dtype") && nb::hasattr(object.attr("dtype"), "kind"))
    return std::strchr("biuf", nb::cast<std::string>(object.attr("dtype").attr("kind"))[0]);
  return (PySequence_Check(object.ptr()) && !PyUnicode_Check(object.ptr()) && !PyBytes_Check(object.ptr())) ||
         nb::hasattr(object, "__array__");
}

// Returns the Python expression of the object that numpy can convert: the argument itself, or the points of a mesh of PyVista,
// meshio, trimesh or dolfinx. Returns an empty string for other objects.
std::string convertible_part(nb::handle object, const std::string &name, const std::string &wanted) {
  static const char *const places[][2] = {{"points", nullptr}, {"vertices", nullptr}, {"geometry", "x"}};
  for (const auto &[attribute, inner] : places) {
    if (wanted != "float64" || nb::hasattr(object, "dtype") || !nb::hasattr(object, attribute)) continue;
    const nb::object outer = object.attr(attribute);
    if (inner && !nb::hasattr(outer, inner)) continue;
    if (is_convertible(inner ? nb::object(outer.attr(inner)) : outer))
      return text_of(name, ".", attribute, inner ? "." : "", inner ? inner : "");
  }
  return is_convertible(object) ? name : "";
}

}  // namespace

template <class... Parts>
void Array::refuse_entries(nb::handle object, const char *wanted, const Parts &...parts) const {
  std::string text = text_of(parts...);
  if (access_ == Access::write)
    text += text_of("; the call writes it, so make it by numpy.zeros(..., dtype=", dtype_for(wanted), ")");
  else if (std::string(name_) == "xyz" && (PyUnicode_Check(object.ptr()) || nb::hasattr(object, "__fspath__")))
    text += "; read a file by pyvista.read, and pass its points.astype(float)";
  else if (const std::string part = convertible_part(object, name_, wanted); !part.empty())
    text += text_of("; pass numpy.ascontiguousarray(", part, ", dtype=", dtype_for(wanted), ")");
  refuse_type(name_, text);
}

Array::Array(nb::handle object, const char *name, Access access, const char *wanted)
    : name_(name), access_(access), view_{} {
  refuse_mask(object, name);
  if (!PyObject_CheckBuffer(object.ptr()))
    refuse_entries(object, wanted, "must be a numpy array of ", wanted, ", not ", name_of_type(object));
  if (PyObject_GetBuffer(object.ptr(), &view_, PyBUF_FULL_RO)) {
    PyErr_Clear();
    view_.obj = nullptr;
    refuse_entries(object, wanted, "must be a numpy array of ", wanted, ", not ",
                   dtype_of(object, name_of_type(object).c_str()));
  }
  // The buffer is released here, because the destructor does not run if a constructor throws.
  try {
    if (view_.suboffsets) refuse_type(name, "must be a numpy array, not a buffer with suboffsets");
    if (!is_of(view_, wanted))
      refuse_entries(object, wanted, "its dtype is ", dtype_of(object, view_.format), "; it must be ", wanted);
    if (access == Access::write && view_.readonly) refuse_value(name, "is read-only, and the call writes it");
  } catch (...) {
    PyBuffer_Release(&view_);
    throw;
  }
}

template <>
Array Array::of<double>(nb::handle object, const char *name, Access access) {
  return {object, name, access, "float64"};
}
template <>
Array Array::of<std::int32_t>(nb::handle object, const char *name, Access access) {
  return {object, name, access, "int32"};
}
template <>
Array Array::of<std::int64_t>(nb::handle object, const char *name, Access access) {
  return {object, name, access, "int64"};
}
template <>
Array Array::of<std::uint8_t>(nb::handle object, const char *name, Access access) {
  return {object, name, access, "bool or uint8"};
}
Array Array::of_integers(nb::handle object, const char *name) { return {object, name, Access::read, "int32 or int64"}; }

const Array &Array::expect_shape(std::initializer_list<std::int64_t> shape) const {
  bool fits = static_cast<std::size_t>(view_.ndim) == shape.size();
  for (int i = 0; fits && i < view_.ndim; ++i) fits = shape.begin()[i] < 0 || shape.begin()[i] == view_.shape[i];
  if (!fits) refuse_value(name_, "its shape is ", tuple_of(shape_of(*this)), "; it must be ", tuple_of(shape));
  return *this;
}

const Array &Array::expect(std::initializer_list<std::int64_t> shape) const {
  expect_shape(shape);
  if (!PyBuffer_IsContiguous(&view_, 'C'))
    refuse_value(name_, "its entries must lie in C order without gaps; ",
                 access_ == Access::read ? text_of("pass numpy.ascontiguousarray(", name_, ")")
                                         : "the call writes it, so make it by numpy.zeros");
  if (reinterpret_cast<std::uintptr_t>(view_.buf) % static_cast<std::uintptr_t>(view_.itemsize) != 0)
    refuse_value(name_, "its entries are not aligned to ", view_.itemsize, " bytes; copy the array");
  return *this;
}

Points points_of(nb::handle xyz, const char *name) {
  Points points;
  points.arrays.push_back(Array::of<double>(xyz, name));
  const Array &array = points.arrays.back().expect_shape({-1, 3});
  points.n = array.size(0);
  points.stride = stride_of_points(array);
  const std::int64_t step = array.stride(1);
  if (!is_whole(step))
    refuse_value(name, "its coordinates are ", step, " bytes apart, which is not a multiple of 8; copy the array");
  points.x = array.data<double>();
  points.y = moved(points.x, step);
  points.z = moved(points.x, 2 * step);
  return points;
}

Points points_of(nb::handle xyz, nb::handle y, nb::handle z) {
  if (y.is_none() && z.is_none()) return points_of(xyz, "xyz");
  Points points;
  const nb::handle given[] = {xyz, y, z};
  const char *const names[] = {"x", "y", "z"};
  const double **const to[] = {&points.x, &points.y, &points.z};
  for (int i = 0; i < 3; ++i) {
    points.arrays.push_back(Array::of<double>(given[i], names[i]));
    const Array &array = points.arrays.back();
    array.expect_shape({i == 0 ? -1 : points.n});
    const std::int64_t stride = stride_of_points(array);
    if (i > 0 && stride != points.stride)
      refuse_value(names[i], "its stride is ", stride, " doubles, that of x is ", points.stride,
                   "; they must be equal");
    points.n = array.size(0);
    points.stride = stride;
    *to[i] = array.data<double>();
  }
  return points;
}

nb::object new_array(const char *type, std::initializer_list<std::int64_t> shape) {
  return nb::module_::import_("numpy").attr("empty")(python_shape(shape), type);
}

nb::object new_filled_array(const char *type, std::initializer_list<std::int64_t> shape, nb::handle value) {
  return nb::module_::import_("numpy").attr("full")(python_shape(shape), value, type);
}

}  // namespace riis_python
