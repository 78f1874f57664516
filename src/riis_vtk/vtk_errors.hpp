// SPDX-License-Identifier: Apache-2.0
// Reports the failures of this library. fail() throws, and guarded() turns any exception into a status and the core's last
// error. While a body runs, VTK's messages are caught and not printed.
#pragma once

#include <locale.h>
#include <riis/riis.h>

#include <charconv>
#include <cstdint>
#include <new>
#include <string>
#include <type_traits>

#include <vtkSmartPointer.h>

#include "common/float_environment.hpp"

class vtkOutputWindow;

namespace riis::vtk {

struct Failure {
  riis_status status;
  std::string text;
};

[[noreturn]] void fail(riis_status status, std::string text);

// Returns words and numbers as one text. A real number has its shortest exact text, such as "nan" and "0.1".
template <class... Parts>
std::string joined(const Parts &...parts) {
  std::string text;
  const auto add = [&](const auto &part) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(part)>>) {
      char digits[32];
      text.append(digits, std::to_chars(digits, digits + sizeof digits, part).ptr);
    } else {
      text += part;
    }
  };
  (add(parts), ...);
  return text;
}

// Throws RIIS_INVALID_ARGUMENT with a message of these parts.
template <class... Parts>
[[noreturn]] void refuse_argument(const Parts &...parts) {
  fail(RIIS_INVALID_ARGUMENT, joined(parts...));
}

// Throws a RIIS_FILE_ERROR with the message "PATH: reason". A path that is too long for the message loses its beginning. The
// reason stays complete.
[[noreturn]] void fail_reason(const std::string &path, const std::string &reason);
template <class... Parts>
[[noreturn]] void fail_file(const std::string &path, const Parts &...parts) {
  fail_reason(path, joined(parts...));
}

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
// Fails unless a struct has the size of some release. first_size is its size in the first release that had it, and size_here
// its size in this release.
void check_struct_size(std::int64_t size, std::int64_t first_size, std::int64_t size_here, const char *name);

template <class T>
T *require(T *pointer, const char *argument) {
  if (!pointer) refuse_argument(argument, " is NULL");
  return pointer;
}

// Replaces VTK's process-wide output window while it lives, and silences VTK's log on stderr, which repeats every error. VTK
// does not give the level of the log on stderr, only the highest level of all logs. So the destructor restores this highest
// level.
class CaughtOutput {
 public:
  CaughtOutput();
  ~CaughtOutput();
  CaughtOutput(const CaughtOutput &) = delete;
  CaughtOutput &operator=(const CaughtOutput &) = delete;

  // Fails with RIIS_FILE_ERROR for the path if VTK reported an error. The message is the first error since the scope began, in
  // one line without VTK's source positions. The first error is the cause. Later errors come from higher layers of VTK.
  void check(const std::string &path) const;

 private:
  class Window;
  vtkSmartPointer<Window> window_;
  vtkSmartPointer<vtkOutputWindow> caller_window_;
  int caller_displays_;
  int caller_log_level_;
};

// Numbers have decimal points while this object lives. After a caller's setlocale(LC_ALL, "de_DE.UTF-8") VTK's readers would
// read "1.5" as 1. Only this thread's locale changes. VTK's legacy reader also sets the process's locale to "C" and leaves it
// there, so the destructor restores the caller's locale.
class NumericLocale {
 public:
  NumericLocale() : callers_(setlocale(LC_ALL, nullptr)), points_(newlocale(LC_NUMERIC_MASK, "C", nullptr)) {
    if (!points_) throw std::bad_alloc();
    threads_ = uselocale(points_);
  }
  ~NumericLocale() {
    uselocale(threads_);
    freelocale(points_);
    if (callers_ != setlocale(LC_ALL, nullptr)) setlocale(LC_ALL, callers_.c_str());
  }
  NumericLocale(const NumericLocale &) = delete;
  NumericLocale &operator=(const NumericLocale &) = delete;

 private:
  std::string callers_;  // the process's locale
  locale_t points_;
  locale_t threads_;
};

// Records the message of the current exception, and returns its status.
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
