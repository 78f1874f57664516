// SPDX-License-Identifier: Apache-2.0
#include "handles.hpp"

#include <pthread.h>

#include <atomic>

namespace riis_python {
namespace {

std::atomic<int> n_inside{0};
std::atomic<int> n_forks{0};
std::atomic<bool> inside_at_fork{false};

// In the child process, no thread is inside the library. Other threads do not exist in the child process, and the thread that
// forked was not inside.
void begin_child() {
  inside_at_fork = n_inside.exchange(0) > 0;
  ++n_forks;
}

const int registered = pthread_atfork(nullptr, nullptr, begin_child);

}  // namespace

bool is_forked() noexcept { return fork_number() > 0; }

bool was_inside_at_fork() noexcept { return inside_at_fork; }

int fork_number() noexcept { return n_forks; }

void check_surfaces_allowed(const char *name) {
  if (registered != 0) raise_status(RIIS_OUT_OF_MEMORY, "fork() is not watched, because memory ran out");
  if (was_inside_at_fork())
    raise_status(RIIS_UNAVAILABLE,
                 text_of(name,
                         ": this process was forked while another thread was inside riis, so it makes no "
                         "surface"));
}

void Usage::check(const char *name) {
  if (is_closed) refuse_value(name, "is closed");
  if (fork == fork_number()) return;
  if (is_written || n_readers > 0)
    raise_status(RIIS_UNAVAILABLE, text_of(name, ": another thread was using it when this process was forked"));
  fork = fork_number();
}

void Reading::refuse_busy(const char *name) {
  raise_status(RIIS_UNAVAILABLE,
               text_of(name, ": another thread is using it; one thread may write an object while no other reads it"));
}

Inside::Inside() noexcept { ++n_inside; }
Inside::~Inside() { --n_inside; }

void check_not_logging() {
  if (is_in_log_function()) raise_status(RIIS_UNAVAILABLE, "the log function must not call riis");
}

}  // namespace riis_python
