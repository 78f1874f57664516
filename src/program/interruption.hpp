// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and its like while a file is written. Every file is written beside its place and then moved. A process that ends in
// between leaves the unfinished file behind.
#pragma once

#include <csignal>

namespace riis::program {

// While an object of this type lives, the first SIGINT, SIGTERM or SIGHUP waits. It ends the process when the object ends. A
// second signal, from a user who will not wait, acts at once. Signals that were ignored stay ignored. Only the first of
// several objects counts: objects made while it lives do nothing. Other threads make
// objects only while it lives.
class UnbrokenWrite {
 public:
  UnbrokenWrite();
  ~UnbrokenWrite();
  UnbrokenWrite(const UnbrokenWrite &) = delete;
  UnbrokenWrite &operator=(const UnbrokenWrite &) = delete;

  // Whether a signal waits. Work in several parts ends after the part.
  static bool has_signal();

 private:
  static constexpr int signals_[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction before_[3];
};

}  // namespace riis::program
