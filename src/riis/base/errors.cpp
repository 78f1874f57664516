// SPDX-License-Identifier: Apache-2.0
#include "base/errors.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "common/component.h"

namespace riis {
namespace {

thread_local char last_error[message_size] = "";

// Records the text as the calling thread's last error. Returns the status.
riis_status record_error(riis_status status, const char *text) noexcept {
  const std::size_t n = std::min(std::strlen(text), message_size - 1);
  std::memmove(last_error, text, n);  // memmove, because a component may pass the last error itself as `text`, which
                                      // then overlaps with the target
  last_error[n] = '\0';
  return status;
}

}  // namespace

const char *recorded_error() noexcept { return last_error; }

riis_status record_current_exception() noexcept {
  try {
    throw;
  } catch (const Error &error) {
    return record_error(error.status, error.message.text());
  } catch (const std::bad_alloc &) {
    return record_error(RIIS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error &) {  // a container would need more elements than it can ever hold
    return record_error(RIIS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception &exception) {
    return record_error(RIIS_INTERNAL_ERROR, Message("internal error: ", exception.what()).text());
  } catch (...) {
    return record_error(RIIS_INTERNAL_ERROR, "internal error: unknown exception");
  }
}

}  // namespace riis

extern "C" riis_status riis_component_error(riis_status status, const char *text) {
  return riis::record_error(status, text);
}
