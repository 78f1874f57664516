// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include <cstring>
#include <limits>

#include "handles.hpp"

namespace riis_python {
namespace {

bool is_text(nb::handle value) { return PyUnicode_Check(value.ptr()) || PyBytes_Check(value.ptr()); }

}  // namespace

void refuse_mask(nb::handle value, const char *name) {
  // Masked arrays have the attributes mask and filled. Both attributes are checked, because objects of pandas also have a method
  // mask.
  if (nb::hasattr(value, "mask") && nb::hasattr(value, "filled"))
    refuse_type(name, "is a masked array, and its mask would be lost; pass ", name, ".filled(...), or ", name,
                ".data if the mask does not matter");
}

bool has_entries(nb::handle value) {
  if (is_text(value) || !PySequence_Check(value.ptr())) return false;
  if (PySequence_Size(value.ptr()) >= 0) return true;
  PyErr_Clear();
  return false;
}

double number(nb::handle value, const char *name) {
  if (PyFloat_CheckExact(value.ptr())) return PyFloat_AsDouble(value.ptr());
  refuse_mask(value, name);
  if (!is_text(value) && !PyBool_Check(value.ptr())) {
    const double found = PyFloat_AsDouble(value.ptr());
    if (found != -1.0 || !PyErr_Occurred()) return found;
    PyErr_Clear();
  }
  refuse_type(name, "must be a number, not ", name_of_type(value));
}

double number_or(nb::handle value, const char *name, double none) {
  return value.is_none() ? none : number(value, name);
}

double number_or_auto(nb::handle value, const char *name) {
  if (value.is_none()) return RIIS_AUTO;
  const double found = number(value, name);
  if (found == RIIS_AUTO) refuse_value(name, "is ", found, "; it must be above 0");
  return found;
}

std::int64_t integer(nb::handle value, const char *name) {
  if (!PyBool_Check(value.ptr())) {
    const nb::object index = nb::steal(PyNumber_Index(value.ptr()));
    if (index.is_valid()) {
      const long long found = PyLong_AsLongLong(index.ptr());
      if (found != -1 || !PyErr_Occurred()) return found;
      PyErr_Clear();
      refuse_value(name, "is ", nb::cast<std::string>(nb::str(index)), ", which is not a 64-bit integer");
    }
    PyErr_Clear();
  }
  refuse_type(name, "must be an integer, not ", name_of_type(value));
}

std::int32_t integer32(nb::handle value, const char *name) {
  const std::int64_t found = integer(value, name);
  using Limits = std::numeric_limits<std::int32_t>;
  if (found < Limits::min() || found > Limits::max())
    refuse_value(name, "is ", found, ", which is not a 32-bit integer");
  return static_cast<std::int32_t>(found);
}

bool flag(nb::handle value, const char *name) {
  if (!PyBool_Check(value.ptr())) refuse_type(name, "must be True or False, not ", name_of_type(value));
  return value.ptr() == Py_True;
}

std::string text(nb::handle value, const char *name) {
  if (!PyUnicode_Check(value.ptr())) refuse_type(name, "must be a str, not ", name_of_type(value));
  const auto found = nb::cast<std::string>(value);
  if (std::strlen(found.c_str()) != found.size()) refuse_value(name, "contains a null character");
  return found;
}

std::int32_t choice(nb::handle value, const char *name, std::initializer_list<Word> words) {
  const std::string found = text(value, name);
  std::string all;
  for (const Word &word : words) {
    if (found == word.word) return word.value;
    all += text_of(all.empty() ? "" : ", ", "'", word.word, "'");
  }
  refuse_value(name, "is '", found, "'; it must be one of ", all);
}

void three_numbers(nb::handle value, const char *name, double (&numbers)[3]) {
  refuse_mask(value, name);
  if (!has_entries(value)) refuse_type(name, "must be three numbers, not ", name_of_type(value));
  const Py_ssize_t size = PySequence_Size(value.ptr());
  if (size != 3) refuse_value(name, "has ", size, size == 1 ? " entry" : " entries", "; it must have three numbers");
  for (Py_ssize_t i = 0; i < 3; ++i) {
    const nb::object entry = nb::steal(PySequence_GetItem(value.ptr(), i));
    if (!entry.is_valid()) throw nb::python_error();
    numbers[i] = number(entry, name);
  }
}

std::int32_t thread_count(nb::handle value, const char *name) {
  const std::int32_t found = integer32(value, name);
  if (!is_forked()) return found;
  if (found > 1)
    raise_status(RIIS_UNAVAILABLE, text_of(name, ": is ", found, "; a child of fork() may use 1 thread only"));
  return found == 0 ? 1 : found;
}

}  // namespace riis_python
