// SPDX-License-Identifier: Apache-2.0
// A semaphore for the threads of this process. Darwin has a call for POSIX's unnamed semaphores, but this call fails with ENOSYS.
// The semaphores of Darwin's dispatch library are used instead.
#pragma once

#if defined(__APPLE__)
#include <dispatch/dispatch.h>
#else
#include <semaphore.h>
#endif

namespace riis {

// A semaphore is never destroyed, because threads may wait on it until the process ends.
class Semaphore {
 public:
  // Returns whether the system made the semaphore. All other functions need a semaphore that was made.
  bool is_made() const noexcept { return is_made_; }
#if defined(__APPLE__)
  void post() noexcept { dispatch_semaphore_signal(semaphore_); }
  void wait() noexcept { dispatch_semaphore_wait(semaphore_, DISPATCH_TIME_FOREVER); }

 private:
  const dispatch_semaphore_t semaphore_ = dispatch_semaphore_create(0);
  const bool is_made_ = semaphore_ != nullptr;
#else
  void post() noexcept { sem_post(&semaphore_); }
  void wait() noexcept {
    while (sem_wait(&semaphore_) != 0) {  // a signal has interrupted the wait
    }
  }

 private:
  sem_t semaphore_{};
  const bool is_made_ = sem_init(&semaphore_, 0, 0) == 0;
#endif
};

}  // namespace riis
