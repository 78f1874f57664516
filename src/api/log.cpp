// SPDX-License-Identifier: Apache-2.0
#include "api/log.hpp"

#include <riis/riis.h>

#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace riis {
namespace {

struct Sink {
  riis_log_function function = nullptr;
  void *user_data = nullptr;
};

// Constant-initialised and never destroyed: usable from the first to the last instruction of the process.
std::mutex sink_mutex;
Sink sink;

Sink current_sink() noexcept {
  const std::lock_guard<std::mutex> lock(sink_mutex);
  return sink;
}

}  // namespace

bool is_logging() noexcept { return current_sink().function != nullptr; }

void log_message(std::int32_t level, const char *format, ...) noexcept {
  // The function is called without the lock, so that it may take its time or set another one.
  const Sink to = current_sink();
  if (!to.function) return;
  char text[512];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  to.function(to.user_data, level, text);
}

}  // namespace riis

extern "C" void riis_set_log(riis_log_function function, void *user_data) {
  const std::lock_guard<std::mutex> lock(riis::sink_mutex);
  riis::sink = {function, user_data};
}
