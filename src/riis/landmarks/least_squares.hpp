// SPDX-License-Identifier: Apache-2.0
// Small dense least squares (Levenberg 1944, Marquardt 1963) and symmetric eigenvalues (Jacobi 1846).
// In: a function that gives residuals. Out: the unknowns for which the sum of their squares is least, and the covariance there.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace riis {

// Writes the residuals of the unknowns x. Their number is the same in each call.
using Residuals = std::function<void(const std::vector<double> &x, std::vector<double> &residuals)>;

struct Minimum {
  bool converged;
  double cost;  // the sum of squares
};

// Changes x until the sum of squares is least. Unknowns have one unit, and `size` is a length in this unit over which the
// residuals are smooth. Derivatives are central differences. The unknowns stay between their bounds.
struct Bounded {
  std::vector<double> lower, upper;
};
Minimum minimize(const Residuals &residuals, std::size_t n_residuals, double size, const Bounded &bounds,
                 std::vector<double> &x);

// Returns J^T J, row after row, for the Jacobian J of the residuals at x.
std::vector<double> normal_matrix(const Residuals &residuals, std::size_t n_residuals, double size,
                                  const std::vector<double> &x);

// Eigenvalues of a symmetric matrix in ascending order, and the unit eigenvectors, which are the rows of `vectors`.
struct Eigen {
  std::vector<double> values, vectors;
};
Eigen symmetric_eigen(std::vector<double> a, std::size_t n);

// Returns the inverse of J^T J. If the residuals do not depend on some combination of unknowns, the diagonal entry of each
// unknown in the combination is infinite. The other entries of its row and column are then 0.
std::vector<double> covariance(const std::vector<double> &normal_matrix, std::size_t n);

}  // namespace riis
