// SPDX-License-Identifier: Apache-2.0
#include "program/interruption.hpp"

#include <atomic>

namespace riis::program {
namespace {

volatile std::sig_atomic_t waiting_signal = 0;
std::atomic<int> n_alive{0};

void keep_for_later(int signal) { waiting_signal = signal; }

}  // namespace

UnbrokenWrite::UnbrokenWrite() {
  if (n_alive++ > 0) return;
  struct sigaction keep {};
  keep.sa_handler = keep_for_later;
  keep.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (int i = 0; i < 3; ++i) {
    sigaction(signals_[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(signals_[i], &keep, nullptr);
  }
}

UnbrokenWrite::~UnbrokenWrite() {
  if (--n_alive > 0) return;
  for (int i = 0; i < 3; ++i) sigaction(signals_[i], &before_[i], nullptr);
  if (waiting_signal != 0) std::raise(waiting_signal);
}

bool UnbrokenWrite::has_signal() { return waiting_signal != 0; }

}  // namespace riis::program
