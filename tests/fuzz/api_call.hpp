// SPDX-License-Identifier: Apache-2.0
// Makes one call of the library in some floating-point environment, and checks the promises that hold after any call.
#pragma once

#include <riis/riis.h>

#include <cfenv>
#include <cstring>
#include <string>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "expect.hpp"
#include "input.hpp"

namespace fuzz {

// The parts of the floating-point environment that a caller would notice.
struct FloatSettings {
  int rounding = std::fegetround(), traps = fegetexcept(), raised = std::fetestexcept(FE_ALL_EXCEPT);
#if defined(__SSE__)
  unsigned int sse = _mm_getcsr();
#endif
  bool operator==(const FloatSettings &other) const {
#if defined(__SSE__)
    if (sse != other.sse) return false;
#endif
    return rounding == other.rounding && traps == other.traps && raised == other.raised;
  }
};

inline void set_float_environment(int choice) {
  std::fesetenv(FE_DFL_ENV);
  if (choice == 1) std::fesetround(FE_UPWARD);
  if (choice == 2) std::fesetround(FE_TOWARDZERO);
  if (choice == 3) feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#if defined(__SSE__)
  if (choice == 4) _mm_setcsr(_mm_getcsr() | 0x8040);  // sets "flush to zero" and "denormals are zero"
#endif
}

inline void check_status(riis_status status, const std::string &text_before) {
  const char *text = riis_last_error();
  EXPECT(text != nullptr, "after status %d", status);
  if (status == RIIS_OK) {
    EXPECT(text == text_before, "a successful call changed the text of the last error to '%s'", text);
    return;
  }
  // RIIS_UNAVAILABLE is returned for instructions that this processor lacks.
  EXPECT((status >= RIIS_INVALID_ARGUMENT && status <= RIIS_OUT_OF_MEMORY) || status == RIIS_UNAVAILABLE,
         "status %d: %s", status, text);
  EXPECT(std::strcmp(riis_status_name(status), "unknown status") != 0, "status %d", status);
  EXPECT(std::strlen(text) > 8 && std::strlen(text) < 512, "status %d has the text '%s'", status, text);
}

// Makes the call and returns its status, which must be RIIS_OK or a refusal with a message.
template <class Call>
riis_status call(Input &in, const Call &make_call) {
  const std::string text_before = riis_last_error();
  const int environment = in.byte();
  set_float_environment(environment < 192 ? 0 : environment % 5);
  const FloatSettings before;
  const riis_status status = make_call();
  const FloatSettings after;
  std::fesetenv(FE_DFL_ENV);
  EXPECT(before == after, "the floating-point environment %d changed", environment);
  check_status(status, text_before);
  return status;
}

// Makes a call that must succeed in any state, however little memory there is.
#define EXPECT_OK(call_)                                                                \
  do {                                                                                  \
    const riis_status status_ = (call_);                                                \
    EXPECT(status_ == RIIS_OK, "%s: %s", riis_status_name(status_), riis_last_error()); \
  } while (0)

// Makes a call that creates an object. It must write the handle if it succeeds, and only then.
template <class Handle, class Make>
Handle *made_by(Input &in, const Make &make) {
  auto *const untouched = reinterpret_cast<Handle *>(0x5a5a5a5a5a5a5a50);
  Handle *handle = untouched;
  const bool into_nothing = in.one_in(64);
  const riis_status status = call(in, [&] { return make(into_nothing ? nullptr : &handle); });
  EXPECT((status == RIIS_OK) == (handle != untouched), "status %d", status);
  EXPECT(handle != nullptr, "status %d", status);
  return status == RIIS_OK ? handle : nullptr;
}

// Returns an option struct that its init function filled. Sometimes its size is wrong.
template <class Struct>
Struct initialised(Input &in, riis_status (*init)(Struct *, int64_t)) {
  Struct made;
  EXPECT_OK(init(&made, sizeof made));
  static const int64_t wrong[] = {0, 8, -8, 1, sizeof(Struct) - 8, sizeof(Struct) + 8, sizeof(Struct) + 1, INT64_MAX};
  if (in.one_in(48)) made.struct_size = in.one_of(wrong);
  return made;
}

}  // namespace fuzz
