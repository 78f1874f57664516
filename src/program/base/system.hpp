// SPDX-License-Identifier: Apache-2.0
// What the program needs of the system beyond POSIX. system_linux.cpp and system_darwin.cpp define these functions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace riis::program {

// Throws a Refusal if the system does not say.
std::string path_of_this_program();

// Makes a pipe whose ends no other program inherits. Returns true after success; otherwise errno has the reason.
bool make_pipe(int ends[2]);

// The end of the parent sends the signal to this process, a child by fork(). A parent that has ended before is not noticed.
void end_with_parent(int signal);

// Returns the bytes of this process that count towards the limit of its memory (RLIMIT_AS). Returns nothing if the system does
// not say, or ignores the limit.
std::optional<std::uintmax_t> limited_memory();

}  // namespace riis::program
