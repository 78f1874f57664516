// SPDX-License-Identifier: Apache-2.0
// Python's exceptions: one class for each status of riis.h (riis/_errors.py).
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <riis/riis.h>

#include <sstream>
#include <string>

namespace riis_python {

namespace nb = nanobind;

// Throws the Python exception of a status.
[[noreturn]] void raise_status(riis_status status, const std::string &message);

// Returns a text of the library with Python names instead of C names.
std::string in_python(const char *text);

template <class... Parts>
std::string text_of(const Parts &...parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

// Refuses the value of an argument.
template <class... Parts>
[[noreturn]] void refuse_value(const char *name, const Parts &...parts) {
  raise_status(RIIS_INVALID_ARGUMENT, text_of(name, ": ", parts...));
}

// Refuses the type of an argument.
template <class... Parts>
[[noreturn]] void refuse_type(const char *name, const Parts &...parts) {
  throw nb::type_error(text_of(name, ": ", parts...).c_str());
}

// Throws the exception of a property's getter again. If it refuses the object, it also becomes an AttributeError.
[[noreturn]] void raise_as_attribute_error(const nb::python_error &error);

// Returns the getter of a property. If marks lack the property's field, or the object is closed, hasattr and inspect.getmembers
// then work. They expect an AttributeError.
template <class Result, class Self>
auto attribute(Result (*get)(Self)) {
  return [get](Self self) -> Result {
    try {
      return get(self);
    } catch (const nb::python_error &error) {
      raise_as_attribute_error(error);
    }
  };
}

// Returns the name of an object's type, such as "list".
std::string name_of_type(nb::handle object);

}  // namespace riis_python
