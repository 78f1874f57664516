// SPDX-License-Identifier: Apache-2.0
// Reports the failures of this library. fail() throws, and guarded() turns any exception into a status and the core's last
// error. While guarded() runs a body, VTK's messages are caught and not printed.
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

// Returns words and numbers as one text. A real number is written as the shortest text that reads back exactly, such as "0.1" or
// "nan".
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

// Throws RIIS_INVALID_ARGUMENT. The parts form the message.
template <class... Parts>
[[noreturn]] void refuse_argument(const Parts &...parts) {
  fail(RIIS_INVALID_ARGUMENT, joined(parts...));
}

// Throws RIIS_FILE_ERROR with the message "PATH: reason". If the path is too long for the message, its beginning is cut off. The
// reason stays complete.
[[noreturn]] void fail_reason(const std::string &path, const std::string &reason);
template <class... Parts>
[[noreturn]] void fail_file(const std::string &path, const Parts &...parts) {
  fail_reason(path, joined(parts...));
}

// Throws RIIS_OUT_OF_MEMORY with the message "PATH: out of memory". Allocates no memory itself.
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
// Throws if `status` is an error of the core. Keeps the core's message.
void check_core(riis_status status);
// Fails unless the size is a multiple of 8 and lies between first_size and size_here, both included. The limits are the struct's
// sizes in its first release and in this release.
void check_struct_size(std::int64_t size, std::int64_t first_size, std::int64_t size_here, const char *name);

template <class T>
T *require(T *pointer, const char *argument) {
  if (!pointer) refuse_argument(argument, " is NULL");
  return pointer;
}

// The body of a destroy function.
template <class Object>
void destroy(Object **object) {
  if (!object) return;
  delete *object;
  *object = nullptr;
}

// While it exists, an object of this type replaces VTK's process-wide output window. It also silences VTK's log on stderr, which
// repeats every error. VTK tells only the highest level of all its logs, so the destructor gives this level to the log on stderr.
class CaughtOutput {
 public:
  CaughtOutput();
  ~CaughtOutput();
  CaughtOutput(const CaughtOutput &) = delete;
  CaughtOutput &operator=(const CaughtOutput &) = delete;

  // Fails with RIIS_FILE_ERROR for the path if VTK reported an error. The message is the first error since this object was made,
  // in one line without VTK's source positions. The first error is the cause. Later errors come from higher layers of VTK.
  void check(const std::string &path) const;

 private:
  class Window;
  vtkSmartPointer<Window> window_;
  vtkSmartPointer<vtkOutputWindow> caller_window_;
  int caller_displays_;
  int caller_log_level_;
};

// While an object of this type lives, numbers have decimal points. After a caller's setlocale(LC_ALL, "de_DE.UTF-8"), VTK's
// readers would read "1.5" as 1. Only this thread's locale changes. VTK's legacy reader, however, sets the locale of the whole
// process to "C" for good. Therefore the destructor also restores the process's locale.
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
  std::string callers_;  // the process's locale before
  locale_t points_;
  locale_t threads_;
};

// Records the message of the current exception, and returns its status.
riis_status record_current_exception() noexcept;

// Runs the body of a public function, and passes the caught output to it.
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
