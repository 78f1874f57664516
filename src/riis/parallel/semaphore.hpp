// SPDX-License-Identifier: Apache-2.0
// A semaphore for the threads of this process. On Darwin, the call that makes a POSIX semaphore without a name fails with ENOSYS.
// The semaphores of Darwin's dispatch library are therefore used there.
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
  // Returns whether the system could make the semaphore. If it could not, no other function may be called.
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
