// SPDX-License-Identifier: Apache-2.0
// Sets the default floating-point environment within a scope, and restores the caller's environment at the end of the scope.
// Solvers may run with traps (-ffpe-trap), flush-to-zero (-ffast-math) or another rounding mode. Inside the scope no trap fires,
// and no result depends on the caller's settings. Each thread that computes needs its own scope.
#pragma once

#include <cfenv>
#include <cstdint>

namespace riis {

class FloatEnvironment {
 public:
  FloatEnvironment() noexcept {
    std::fegetenv(&caller_);
    std::fesetenv(FE_DFL_ENV);
#if defined(__aarch64__)
    // The C library's default environment does not reset the mode "default NaN", in which operations lose the bits of a NaN.
    constexpr std::uint64_t default_nan = std::uint64_t{1} << 25;
    std::uint64_t control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    if (control & default_nan) __asm__ volatile("msr fpcr, %0" : : "r"(control & ~default_nan));
#endif
  }
  ~FloatEnvironment() { std::fesetenv(&caller_); }
  FloatEnvironment(const FloatEnvironment &) = delete;
  FloatEnvironment &operator=(const FloatEnvironment &) = delete;

 private:
  std::fenv_t caller_;
};

}  // namespace riis
