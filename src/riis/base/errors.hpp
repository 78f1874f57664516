// SPDX-License-Identifier: Apache-2.0
// A failure travels as an exception: fail() throws, and guarded() is the wall that turns any exception into a status and a
// message. The message lives in the exception and in the thread, so the library itself allocates nothing to report an error.
#pragma once

#include <riis/riis.h>

#include <new>

#include "common/float_environment.hpp"
#include "common/message.hpp"

namespace riis {

struct Error {
  riis_status status;
  Message message;
};

// Throws an Error. Its message names the argument and its value, and is put together from words and numbers.
template <class... Parts>
[[noreturn]] void fail(riis_status status, const Parts &...parts) {
  throw Error{status, Message(parts...)};
}

// Makes the text the calling thread's last error and returns the status.
riis_status record_error(riis_status status, const char *text) noexcept;

// Returns the calling thread's last error, "" if it has none.
const char *recorded_error() noexcept;

// Records the message of the exception that is being handled, and returns its status.
riis_status record_current_exception() noexcept;

// Runs the body of a public function: no exception leaves, and the floating-point environment is the default one.
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
  if (!pointer) fail(RIIS_INVALID_ARGUMENT, argument, " is NULL");
  return pointer;
}

// Refuses a field outside of least to most, also NaN. `owner` is the argument that has the field, or "" if the number is the
// argument itself.
inline void check_range(const char *owner, const char *name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    fail(RIIS_INVALID_ARGUMENT, owner, *owner ? "." : "", name, " is ", value, "; it must be from ", least, " to ",
         most);
}

}  // namespace riis
