// SPDX-License-Identifier: Apache-2.0
// The way of a failure out of this library: fail() throws, and guarded() turns any exception into a status and the core's last
// error. While a body runs, VTK's messages are caught instead of printed.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <new>
#include <string>

#include <vtkSmartPointer.h>

#include "common/float_environment.hpp"
#include "riis_vtk/numeric_locale.hpp"

class vtkOutputWindow;

namespace riis::vtk {

struct Failure {
  riis_status status;
  std::string text;
};

[[noreturn]] void fail(riis_status status, std::string text);
// Throws a RIIS_FILE_ERROR with the message "PATH: reason". A path too long for the message loses its beginning, not the reason.
[[noreturn]] void fail_file(const std::string &path, const std::string &reason);
// Throws RIIS_OUT_OF_MEMORY with the message "PATH: out of memory". It takes no memory itself.
[[noreturn]] void fail_memory(const std::string &path);
// Calls `work`, which reads or writes the file. If memory runs out, the error names the file.
template <class Work>
auto naming(const std::string &path, const Work &work) {
  try {
    return work();
  } catch (const std::bad_alloc &) {
    fail_memory(path);
  }
}
// Passes on an error of the core, with the core's message.
void check_core(riis_status status);
// Fails unless a struct has the size of some release: first_size is that of the first release that had it, size_here that of this
// one.
void check_struct_size(std::int64_t size, std::int64_t first_size, std::int64_t size_here, const char *name);

template <class T>
T *require(T *pointer, const char *argument) {
  if (!pointer) fail(RIIS_INVALID_ARGUMENT, std::string(argument) + " is NULL");
  return pointer;
}

// Takes the place of VTK's process-wide output window while it lives, and silences VTK's log on stderr, which repeats every
// error. VTK does not tell the level of the log's stderr part, only the highest level of its parts. So that level is put back.
class CaughtOutput {
 public:
  CaughtOutput();
  ~CaughtOutput();
  CaughtOutput(const CaughtOutput &) = delete;
  CaughtOutput &operator=(const CaughtOutput &) = delete;

  // Returns the first error since the scope began, in one line without VTK's source positions, or "" if there was none. The first
  // error is the cause. Later ones come from VTK's layers above.
  std::string first_error() const;
  // Fails with RIIS_FILE_ERROR for the path if VTK reported an error.
  void check(const std::string &path) const;

 private:
  class Window;
  vtkSmartPointer<Window> window_;
  vtkSmartPointer<vtkOutputWindow> caller_window_;
  int caller_displays_;
  int caller_log_level_;
};

// Records the message of the exception that is being handled, and returns its status.
riis_status record_current_exception() noexcept;

// Every public function's body runs in this function and receives the caught output.
template <class Body>
riis_status guarded(Body &&body) noexcept {
  const FloatEnvironment environment;
  try {
    const NumericLocale locale;
    const CaughtOutput caught;
    body(caught);
    return RIIS_OK;
  } catch (...) {
    return record_current_exception();
  }
}

}  // namespace riis::vtk
