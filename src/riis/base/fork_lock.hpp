// SPDX-License-Identifier: Apache-2.0
// Keeps a mutex free in each child process of fork().
#pragma once

#include <pthread.h>

#include <mutex>

namespace riis {

// A process may be forked while another thread holds a mutex. The child lacks that thread, so its copy of the mutex would stay
// locked. Therefore the forking thread locks the mutex before the fork, and unlocks it in both processes. The mutex may protect
// only a few instructions. A thread that holds the mutex must not take another lock. Returns false if the handlers of fork()
// could not be installed for lack of memory.
template <std::mutex &mutex>
bool is_free_in_children() noexcept {
  return pthread_atfork([] { mutex.lock(); }, [] { mutex.unlock(); }, [] { mutex.unlock(); }) == 0;
}

}  // namespace riis
