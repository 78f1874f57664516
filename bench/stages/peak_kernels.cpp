// SPDX-License-Identifier: Apache-2.0
// These kernels do as many operations as the processor can, on registers alone. The kernels are compiled for each instruction
// set, like the library's kernels.
#include "kernels/lanes.hpp"
#include "kernels/table.hpp"
#include "peak.hpp"

namespace bench {
namespace {

// Twelve independent chains of operations keep all units of a core busy. The chains fit into sixteen registers.
constexpr int n_chains = 12;

template <class Register, class Scalar, class Step>
RIIS_INLINE double repeat_chains(int64_t n, const Step &step) {
  Register x[n_chains];
  for (int i = 0; i < n_chains; ++i) x[i] = static_cast<Scalar>(i) - Register{};
  for (int64_t repetition = 0; repetition < n; ++repetition)
#pragma GCC unroll 12
    for (int i = 0; i < n_chains; ++i) x[i] = step(x[i], i);
  double sum = 0;
  for (int i = 0; i < n_chains; ++i)
    for (unsigned lane = 0; lane < sizeof(Register) / sizeof(Scalar); ++lane) sum += static_cast<double>(x[i][lane]);
  return sum;
}

double multiply_add_floats(int64_t n) {
  typedef riis::FloatRegister Register;
  const Register factor = 0.999f - Register{}, term = 1e-3f - Register{};
  return repeat_chains<Register, float>(
      n, [&](Register x, int) RIIS_LAMBDA { return riis::multiply_add(x, factor, term); });
}

double multiply_add_and_add_floats(int64_t n) {
  typedef riis::FloatRegister Register;
  const Register factor = 0.999f - Register{}, term = 1e-3f - Register{};
  return repeat_chains<Register, float>(
      n, [&](Register x, int i) RIIS_LAMBDA { return i % 2 == 0 ? riis::multiply_add(x, factor, term) : x + term; });
}

template <class Register, class Scalar>
double multiply_and_add(int64_t n) {
  const Register factor = Scalar(0.999) - Register{}, term = Scalar(1e-3) - Register{};
  return repeat_chains<Register, Scalar>(
      n, [&](Register x, int i) RIIS_LAMBDA { return i % 2 == 0 ? x * factor : x + term; });
}

constexpr int64_t n_floats = n_chains * riis::Floats::per_register, n_doubles = n_chains * riis::Doubles::per_register;

}  // namespace

const PeakKernels RIIS_KERNELS(peak_kernels) = {{{n_floats, multiply_add_floats},
                                                 {n_floats, multiply_add_and_add_floats},
                                                 {n_floats, multiply_and_add<riis::FloatRegister, float>}},
                                                {n_doubles, multiply_and_add<riis::DoubleRegister, double>}};

}  // namespace bench
