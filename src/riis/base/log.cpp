// SPDX-License-Identifier: Apache-2.0
#include "base/log.hpp"

#include <mutex>

#include "base/fork_lock.hpp"

namespace riis {
namespace {

struct Sink {
  riis_log_function function = nullptr;
  void *user_data = nullptr;
};

// The log function and its lock are initialised at compile time and never destroyed. The log can therefore be used during the
// whole life of the process.
std::mutex sink_mutex;
Sink sink;
[[maybe_unused]] const bool sink_is_free_in_children = is_free_in_children<sink_mutex>();

Sink current_sink() noexcept {
  const std::lock_guard<std::mutex> lock(sink_mutex);
  return sink;
}

}  // namespace

bool is_logging() noexcept { return current_sink().function != nullptr; }

void log_message(std::int32_t level, const Message &message) noexcept {
  // The lock is not held while the log function runs, because this function may take long, and may set another log function.
  const Sink to = current_sink();
  if (to.function) to.function(to.user_data, level, message.text());
}

void set_log_function(riis_log_function function, void *user_data) noexcept {
  const std::lock_guard<std::mutex> lock(sink_mutex);
  sink = {function, user_data};
}

}  // namespace riis
