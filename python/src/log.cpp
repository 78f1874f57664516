// SPDX-License-Identifier: Apache-2.0
#include "errors.hpp"
#include "module.hpp"

namespace riis_python {
namespace {

thread_local bool in_log_function = false;

// The present log function. References to earlier functions are never released, because a thread may still be sending a message
// to one of them. The pointer to the log function is replaced under the interpreter's lock.
PyObject *log_function = nullptr;

void forward(void *, std::int32_t level, const char *message) {
  const nb::gil_scoped_acquire acquire;
  if (!log_function) return;
  const nb::object function = nb::borrow(log_function);
  const nb::error_scope pending;
  in_log_function = true;
  try {
    function(level, in_python(message));
  } catch (nb::python_error &error) {
    error.discard_as_unraisable(function);
  } catch (...) {  // no exception may pass through the library
  }
  in_log_function = false;
}

void set_log(nb::handle function) {
  if (!function.is_none() && !PyCallable_Check(function.ptr()))
    refuse_type("function", "must be callable or None, not ", name_of_type(function));
  PyObject *former = log_function;
  log_function = function.is_none() ? nullptr : function.inc_ref().ptr();
  riis_set_log(log_function ? forward : nullptr, nullptr);
  Py_XDECREF(former);
}

}  // namespace

bool is_in_log_function() noexcept { return in_log_function; }

void add_log(nb::module_ &module) {
  module.attr("LOG_INFO") = static_cast<int>(RIIS_LOG_INFO);
  module.attr("LOG_WARNING") = static_cast<int>(RIIS_LOG_WARNING);
  module.def("set_log", &set_log, nb::arg("function").none(),
             nb::sig("def set_log(function: collections.abc.Callable[[int, str], object] | None) -> None"),
             R"(Sets the function that receives the library's messages, for the whole process. None stops the messages.

function(level, message) is called on any thread that calls riis; level is LOG_INFO or LOG_WARNING. It must not
call riis. Its exceptions go to sys.unraisablehook.)");
  // At the interpreter's end the log function is removed, because no message may reach Python afterwards.
  nb::module_::import_("atexit").attr("register")(nb::cpp_function([] { set_log(nb::none()); }));
}

}  // namespace riis_python
