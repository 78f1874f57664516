// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "errors.hpp"

namespace riis_python {

// Returns whether the calling thread is inside the log function.
bool is_in_log_function() noexcept;

void add_log(nb::module_ &module);

}  // namespace riis_python
