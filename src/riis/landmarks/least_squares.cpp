// SPDX-License-Identifier: Apache-2.0
#include "common/elementary.hpp"
#include "landmarks/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace riis {
namespace {

// The step of central differences, as a share of `size`. The step balances two errors: the differences' own error is about
// step^2, and their rounding error is about 1e-16 / step.
constexpr double difference_step = 1e-5;
// The iteration ends if a step is shorter than `negligible_step` times `size`.
constexpr double negligible_step = 1e-13;
// The iteration also ends if a step lowers the sum of squares by less than `negligible_decrease` times the sum. The unknowns then
// differ from their final values by less than a thousandth of their standard errors. If all residuals can become 0, the sum falls
// much faster. The iteration then ends only when rounding alone is left.
constexpr double negligible_decrease = 1e-9;
constexpr int most_iterations = 400;

double sum_of_squares(const std::vector<double> &r) { return std::inner_product(r.begin(), r.end(), r.begin(), 0.0); }

// Returns the Jacobian, column after column.
std::vector<std::vector<double>> jacobian(const Residuals &residuals, std::size_t n_residuals, double size,
                                          std::vector<double> x) {
  std::vector<std::vector<double>> columns(x.size(), std::vector<double>(n_residuals));
  std::vector<double> ahead(n_residuals), behind(n_residuals);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double at = x[i], upper = at + difference_step * size, lower = at - difference_step * size;
    x[i] = upper;
    residuals(x, ahead);
    x[i] = lower;
    residuals(x, behind);
    x[i] = at;
    for (std::size_t k = 0; k < n_residuals; ++k) columns[i][k] = (ahead[k] - behind[k]) / (upper - lower);
  }
  return columns;
}

std::vector<double> normal_matrix(const std::vector<std::vector<double>> &columns) {
  const std::size_t n = columns.size();
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      matrix[i * n + j] = matrix[j * n + i] =
          std::inner_product(columns[i].begin(), columns[i].end(), columns[j].begin(), 0.0);
  return matrix;
}

}  // namespace

bool solve_positive(std::vector<double> matrix, std::vector<double> &b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    double pivot = matrix[j * n + j];
    for (std::size_t k = 0; k < j; ++k) pivot -= matrix[j * n + k] * matrix[j * n + k];
    if (!(pivot > 0)) return false;
    const double root = std::sqrt(pivot);
    matrix[j * n + j] = root;
    for (std::size_t i = j + 1; i < n; ++i) {
      double value = matrix[i * n + j];
      for (std::size_t k = 0; k < j; ++k) value -= matrix[i * n + k] * matrix[j * n + k];
      matrix[i * n + j] = value / root;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= matrix[i * n + k] * b[k];
    b[i] /= matrix[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= matrix[k * n + i] * b[k];
    b[i] /= matrix[i * n + i];
  }
  return true;
}

std::vector<double> normal_matrix(const Residuals &residuals, std::size_t n_residuals, double size,
                                  const std::vector<double> &x) {
  return normal_matrix(jacobian(residuals, n_residuals, size, x));
}

Minimum minimize(const Residuals &residuals, std::size_t n_residuals, double size, const Bounded &bounds,
                 std::vector<double> &x) {
  const std::size_t n = x.size();
  std::vector<double> r(n_residuals), r_tried(n_residuals);
  const auto clamped = [&](std::vector<double> at) {
    for (std::size_t i = 0; i < n; ++i) at[i] = std::clamp(at[i], bounds.lower[i], bounds.upper[i]);
    return at;
  };
  x = clamped(x);
  residuals(x, r);
  double cost = sum_of_squares(r), damping = 1e-3;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const auto columns = jacobian(residuals, n_residuals, size, x);
    std::vector<double> matrix = normal_matrix(columns);
    std::vector<double> gradient(n);
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      gradient[i] = std::inner_product(columns[i].begin(), columns[i].end(), r.begin(), 0.0);
      largest = std::max(largest, matrix[i * n + i]);
    }
    // An unknown that is at its bound and would move beyond it is left out of the step. This unknown thus does not change the
    // steps of the others.
    for (std::size_t i = 0; i < n; ++i) {
      const bool rests = gradient[i] > 0 ? x[i] <= bounds.lower[i] : x[i] >= bounds.upper[i];
      if (!rests) continue;
      for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] = matrix[j * n + i] = 0;
      matrix[i * n + i] = largest;
      gradient[i] = 0;
    }
    for (bool accepted = false; !accepted; damping *= 8) {
      std::vector<double> damped = matrix, step(n);
      // The second damping term keeps the step finite if no residual depends on an unknown.
      for (std::size_t i = 0; i < n; ++i) damped[i * n + i] += damping * matrix[i * n + i] + 1e-3 * damping * largest;
      for (std::size_t i = 0; i < n; ++i) step[i] = -gradient[i];
      if (solve_positive(std::move(damped), step)) {
        std::vector<double> tried(n);
        for (std::size_t i = 0; i < n; ++i) tried[i] = x[i] + step[i];
        tried = clamped(tried);
        double moved = 0;
        for (std::size_t i = 0; i < n; ++i) moved = std::max(moved, std::abs(tried[i] - x[i]));
        residuals(tried, r_tried);
        const double new_cost = sum_of_squares(r_tried);
        accepted = new_cost < cost;
        const bool is_level = accepted && cost - new_cost <= negligible_decrease * cost;
        if (accepted) {
          x = tried;
          r = r_tried;
          cost = new_cost;
          damping = std::max(damping / 64, 1e-14);
        }
        if (is_level || moved <= negligible_step * size) return {true, cost};
      }
      if (damping > 1e12) return {true, cost};  // not even a tiny step lowers the cost, so only rounding is left
    }
  }
  return {false, cost};
}

Eigen symmetric_eigen(std::vector<double> a, std::size_t n) {
  std::vector<double> v(n * n);
  for (std::size_t i = 0; i < n; ++i) v[i * n + i] = 1;
  for (int sweep = 0; sweep < 60; ++sweep) {
    double beside = 0, on = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) (i == j ? on : beside) += a[i * n + j] * a[i * n + j];
    if (!(beside > 1e-32 * on)) break;
    for (std::size_t p = 0; p + 1 < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        if (a[p * n + q] == 0) continue;
        const double theta = (a[q * n + q] - a[p * n + p]) / (2 * a[p * n + q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + hypotenuse(theta, 1));
        const double c = 1 / hypotenuse(t, 1), s = t * c;
        for (std::size_t k = 0; k < n; ++k) {
          const double kp = a[k * n + p], kq = a[k * n + q];
          a[k * n + p] = c * kp - s * kq;
          a[k * n + q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < n; ++k) {
          const double pk = a[p * n + k], qk = a[q * n + k], vp = v[p * n + k], vq = v[q * n + k];
          a[p * n + k] = c * pk - s * qk;
          a[q * n + k] = s * pk + c * qk;
          v[p * n + k] = c * vp - s * vq;
          v[q * n + k] = s * vp + c * vq;
        }
      }
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return a[i * n + i] != a[j * n + j] ? a[i * n + i] < a[j * n + j] : i < j;
  });
  Eigen sorted;
  for (const std::size_t i : order) {
    sorted.values.push_back(a[i * n + i]);
    for (std::size_t k = 0; k < n; ++k) sorted.vectors.push_back(v[i * n + k]);
  }
  return sorted;
}

std::vector<double> covariance(const std::vector<double> &normal_matrix, std::size_t n) {
  const Eigen eigen = symmetric_eigen(normal_matrix, n);
  // Eigenvalues below this limit count as 0. The eigenvalues are the squares of J's singular values. The entries of J are
  // accurate only to about 1e-10 of the largest entry.
  const double least = 1e-12 * (n == 0 ? 0 : eigen.values.back());
  constexpr double small_share = 1e-8;
  std::vector<double> matrix(n * n);
  std::vector<bool> is_free(n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i) {
      const double vi = eigen.vectors[k * n + i];
      if (!(eigen.values[k] > least)) {
        if (vi * vi > small_share) is_free[i] = true;
        continue;
      }
      for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] += vi * eigen.vectors[k * n + j] / eigen.values[k];
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n && is_free[i]; ++j)
      matrix[i * n + j] = matrix[j * n + i] = i == j ? std::numeric_limits<double>::infinity() : 0;
  return matrix;
}

}  // namespace riis
