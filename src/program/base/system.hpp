// SPDX-License-Identifier: Apache-2.0
// The functions that the program needs from the system beyond POSIX. system_linux.cpp and system_darwin.cpp define these
// functions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace riis::program {

// Throws a Refusal if the system does not report the path.
std::string path_of_this_program();

// Makes a pipe whose ends no other program inherits. Returns true after success. After a failure, errno has the reason.
bool make_pipe(int ends[2]);

// Makes the system send the signal to this child process when the parent ends. The function does not notice a parent that has
// ended before the call.
void end_with_parent(int signal);

// Returns how many bytes of this process count towards the limit of its memory (RLIMIT_AS). If the system does not report this
// number, or ignores the limit, returns nothing.
std::optional<std::uintmax_t> limited_memory();

}  // namespace riis::program
