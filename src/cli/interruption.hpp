// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and its like while a file is written. Every file is written beside its place and then moved; a process that
// ends in between leaves the unfinished one behind.
#pragma once

#include <csignal>

namespace riis::cli {

// As long as one of these lives, the first SIGINT, SIGTERM or SIGHUP waits for its end, where it ends the process as it
// would have; the second, of a user who will not wait, acts at once. Signals that were ignored stay ignored. One at a
// time.
class UnbrokenWrite {
 public:
  UnbrokenWrite();
  ~UnbrokenWrite();
  UnbrokenWrite(const UnbrokenWrite &) = delete;
  UnbrokenWrite &operator=(const UnbrokenWrite &) = delete;

 private:
  static constexpr int signals_[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction before_[3];
};

}  // namespace riis::cli
