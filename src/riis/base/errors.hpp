// SPDX-License-Identifier: Apache-2.0
// A failure travels as an exception: fail() throws the exception, and guarded() turns it into a status and a message. The message
// is stored in the exception and then in the thread's own memory, so reporting an error allocates nothing.
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

// Throws an Error. The parts are the words and numbers of the message, which names the argument and its value.
template <class... Parts>
[[noreturn]] void fail(riis_status status, const Parts &...parts) {
  throw Error{status, Message(parts...)};
}

// Returns the calling thread's last error, or "" if no call of this thread has failed.
const char *recorded_error() noexcept;

// Called inside a catch block. Records the message of the current exception, and returns its status.
riis_status record_current_exception() noexcept;

// Runs the body of a public function. Turns every exception into a status. The body runs in the default floating-point
// environment.
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

// Refuses NaN and numbers outside of [least, most]. `owner` is the argument that has the number as a field. If the number is
// itself an argument, `owner` is "".
inline void check_range(const char *owner, const char *name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    fail(RIIS_INVALID_ARGUMENT, owner, *owner ? "." : "", name, " is ", value, "; it must be from ", least, " to ",
         most);
}

}  // namespace riis
