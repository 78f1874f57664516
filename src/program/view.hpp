// SPDX-License-Identifier: Apache-2.0
// `riis view` replaces this process by `python3 -m riis view` with the same words.
#pragma once

namespace riis::program {

// Returns only by a Refusal, which says how to install the Python package riis if it is missing. The environment variable
// RIIS_PYTHON names another Python.
[[noreturn]] void run_view(int argc, char **argv);

}  // namespace riis::program
