// SPDX-License-Identifier: Apache-2.0
// How a failure travels: fail() throws, guarded() is the wall that turns whatever is thrown into a status and a text.
// The text has a fixed size and lives in the exception and in the thread, so that reporting an error allocates nothing
// of the library's own.
#pragma once

#include <riis/riis.h>

#include <charconv>
#include <cstddef>
#include <new>

#include "base/float_environment.hpp"

namespace riis {

inline constexpr std::size_t error_text_size = 512;

struct Error {
  riis_status status;
  char text[error_text_size];
};

// A number as the shortest text that reads back as the same number, for the texts of errors: two different numbers never look
// the same.
struct Number {
  explicit Number(double value) noexcept { *std::to_chars(text, text + sizeof text - 1, value).ptr = '\0'; }
  char text[32];
};

// Throws an Error. The text names the argument and its value.
[[noreturn]] void fail(riis_status status, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Stores the text as the calling thread's last error and returns the status.
riis_status record_error(riis_status status, const char *text) noexcept;

// The calling thread's last error, "" if it has none.
const char *recorded_error() noexcept;

// Status and text of the exception that is being handled.
riis_status record_current_exception() noexcept;

// Every public function's body runs in here: no exception leaves, the floating-point environment is the default one.
template <class Body>
riis_status guarded(Body &&body) noexcept {
  const FloatEnvironment environment;
  try {
    body();
    return RIIS_OK;
  } catch (...) {
    return record_current_exception();
  }
}

template <class T>
T *require(T *pointer, const char *argument) {
  if (!pointer) fail(RIIS_INVALID_ARGUMENT, "%s is NULL", argument);
  return pointer;
}

}  // namespace riis
