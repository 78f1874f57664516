// SPDX-License-Identifier: Apache-2.0
// Messages go to the caller's log function, or nowhere.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "common/message.hpp"

namespace riis {

// Returns whether there is a log function.
bool is_logging() noexcept;

void log_message(std::int32_t level, const Message &message) noexcept;

// Composes the message only if there is a log function.
template <class... Parts>
void log_message(std::int32_t level, const Parts &...parts) noexcept {
  if (is_logging()) log_message(level, Message(parts...));
}

// Sets the log function; NULL stands for no log. Any thread may call the functions of this file.
void set_log_function(riis_log_function function, void *user_data) noexcept;

}  // namespace riis
