// SPDX-License-Identifier: Apache-2.0
// Reports the failures of this library. fail() throws, and guarded() turns any exception into a status and the core's last error.
// While guarded() runs a body, VTK's messages are caught, so that VTK does not print them.
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

// Returns words and numbers as one text. The text of a real number is the shortest text that reads back exactly, such as "0.1" or
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

// Throws RIIS_FILE_ERROR with the message "PATH: reason". If the path is too long for the message, the beginning of the path is
// left out. The reason stays complete.
[[noreturn]] void fail_reason(const std::string &path, const std::string &reason);
template <class... Parts>
[[noreturn]] void fail_file(const std::string &path, const Parts &...parts) {
  fail_reason(path, joined(parts...));
}

// Throws RIIS_OUT_OF_MEMORY with the message "PATH: out of memory". The function itself allocates no memory.
[[noreturn]] void fail_memory(const std::string &path);
// Calls `work`, which reads or writes a file. If memory runs out, the error message names the file.
template <class Work>
auto naming(const std::string &path, const Work &work) {
  try {
    return work();
  } catch (const std::bad_alloc &) {
    fail_memory(path);
  }
}
// Throws an exception if `status` is an error of the core. The exception has the core's message.
void check_core(riis_status status);
// Checks the size of a struct. The size must be a multiple of 8, and at least first_size, the struct's size in its first release.
// It must be at most size_here, the struct's size in this release.
void check_struct_size(std::int64_t size, std::int64_t first_size, std::int64_t size_here, const char *name);

template <class T>
T *require(T *pointer, const char *argument) {
  if (!pointer) refuse_argument(argument, " is NULL");
  return pointer;
}

// Does the work of a public function that destroys an object.
template <class Object>
void destroy(Object **object) {
  if (!object) return;
  delete *object;
  *object = nullptr;
}

// While an object of this type lives, it takes the place of VTK's output window in the whole process. The object also silences
// VTK's log on stderr, which would repeat every error. VTK has no function for the level of this log, but only for the highest
// level of all its logs. The destructor therefore sets the log on stderr to this highest level.
class CaughtOutput {
 public:
  CaughtOutput();
  ~CaughtOutput();
  CaughtOutput(const CaughtOutput &) = delete;
  CaughtOutput &operator=(const CaughtOutput &) = delete;

  // If VTK reported an error, fails with RIIS_FILE_ERROR for the path. The message has the first error since this object was
  // made, as one line without VTK's source positions. The first error is the cause of all later errors, which come from higher
  // layers of VTK.
  void check(const std::string &path) const;

 private:
  class Window;
  vtkSmartPointer<Window> window_;
  vtkSmartPointer<vtkOutputWindow> caller_window_;
  int caller_displays_;
  int caller_log_level_;
};

// While an object of this type lives, numbers have decimal points, whatever the locale is. After a caller's setlocale(LC_ALL,
// "de_DE.UTF-8"), VTK's readers would read "1.5" as 1. Only the locale of this thread changes. However, VTK's legacy reader sets
// the locale of the whole process to "C", and leaves it so. Therefore the destructor also restores the locale of the process.
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
  std::string callers_;  // the process's locale before this object was made
  locale_t points_;
  locale_t threads_;
};

// Stores the message of the current exception, and returns its status.
riis_status record_current_exception() noexcept;

// Runs the body of a public function, and passes VTK's caught output to this body.
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
