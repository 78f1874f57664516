// SPDX-License-Identifier: Apache-2.0
// Sets the default floating-point environment within a scope, and restores the caller's environment at its end. Solvers may
// run with traps (-ffpe-trap), flush-to-zero (-ffast-math) or another rounding mode. Inside the scope no trap fires, and no
// result depends on the caller's settings. Each thread that computes needs its own scope.
#pragma once

#include <cfenv>

namespace riis {

class FloatEnvironment {
 public:
  FloatEnvironment() noexcept {
    std::fegetenv(&caller_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatEnvironment() { std::fesetenv(&caller_); }
  FloatEnvironment(const FloatEnvironment &) = delete;
  FloatEnvironment &operator=(const FloatEnvironment &) = delete;

 private:
  std::fenv_t caller_;
};

}  // namespace riis
