// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace riis {

// Adds numbers by Neumaier's method (1974), which also adds up the rounding errors. The sums of the leaflets therefore add up to
// the sum over the surface, with an error of a few units in the last place. The error does not depend on the number of nodes.
class Sum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  double total() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

}  // namespace riis
