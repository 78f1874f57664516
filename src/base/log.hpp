// SPDX-License-Identifier: Apache-2.0
// What the library would like to say goes to the caller's log function, or nowhere.
#pragma once

#include <riis/riis.h>

#include <cstdint>

namespace riis {

void log_message(std::int32_t level, const char *format, ...) noexcept __attribute__((format(printf, 2, 3)));

// NULL is silence. Both functions are safe from any thread.
void set_log_function(riis_log_function function, void *user_data) noexcept;

}  // namespace riis
