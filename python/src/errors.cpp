// SPDX-License-Identifier: Apache-2.0
#include "errors.hpp"

#include <cstring>

namespace riis_python {

void raise_status(riis_status status, const std::string &message) {
  const nb::object error = nb::module_::import_("riis._errors").attr("class_of")(status);
  PyErr_SetObject(error.ptr(), nb::str(message.c_str(), message.size()).ptr());
  throw nb::python_error();
}

void raise_as_attribute_error(const nb::python_error &error) {
  const nb::object errors = nb::module_::import_("riis._errors");
  if (!error.matches(errors.attr("InvalidArgumentError"))) throw error;
  PyErr_SetObject(nb::object(errors.attr("MissingAttributeError")).ptr(), nb::str(error.value()).ptr());
  throw nb::python_error();
}

std::string in_python(const char *text) {
  // The library may have truncated a long name within a character.
  const nb::object letters =
      nb::steal(PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(std::strlen(text)), "replace"));
  if (!letters.is_valid()) throw nb::python_error();
  return nb::cast<std::string>(nb::object(nb::module_::import_("riis._errors").attr("in_python")(letters)));
}

std::string name_of_type(nb::handle object) { return nb::cast<std::string>(nb::str(object.type().attr("__name__"))); }

}  // namespace riis_python
