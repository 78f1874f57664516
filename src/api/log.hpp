// SPDX-License-Identifier: Apache-2.0
// What the library would like to say goes to the caller's log function, or nowhere.
#pragma once

#include <cstdint>

namespace riis {

// Whether anybody listens.
bool is_logging() noexcept;

void log_message(std::int32_t level, const char *format, ...) noexcept __attribute__((format(printf, 2, 3)));

}  // namespace riis
