// SPDX-License-Identifier: Apache-2.0
#include "valve/warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "common/elementary.hpp"
#include "kernels/kernels.hpp"

namespace riis {
namespace {

// Sources count as planar if they are nearly in a plane: their rms distance from the plane is below `thinnest_share` times their
// largest rms extent.
constexpr double thinnest_share = 0.05;
// Sources also count as planar in another case: noise would change the stretch across the plane by more than
// `largest_stretch_error`.
constexpr double largest_stretch_error = 0.1;
// The residuals should be the share `residual_share` of the noise. The share is below 1, because the map fits a part of the
// noise. The attachments of random patients were met best with shares from 0.5 to 0.7 (docs/theory/warp.md, "Equations").
constexpr double residual_share = 0.6;
constexpr double line_share = 1e-6, same_place_share = 1e-6;

struct SymmetricThree {
  double xx, yy, zz, xy, xz, yz;
};

// Returns the eigenvectors of a symmetric matrix by Jacobi's method, the largest eigenvalue first.
void principal_axes(const SymmetricThree &given, Vec3 *axes, double *values) {
  double a[3][3] = {{given.xx, given.xy, given.xz}, {given.xy, given.yy, given.yz}, {given.xz, given.yz, given.zz}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 50; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + hypotenuse(theta, 1.0));
        const double c = 1 / hypotenuse(t, 1.0), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
        }
        for (int k = 0; k < 3; ++k) {
          const double kp = v[k][p], kq = v[k][q];
          v[k][p] = c * kp - s * kq, v[k][q] = s * kp + c * kq;
        }
      }
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return a[i][i] != a[j][j] ? a[i][i] > a[j][j] : i < j; });
  for (int k = 0; k < 3; ++k) {
    const int i = view(order)[k];
    axes[k] = {v[0][i], v[1][i], v[2][i]};
    values[k] = std::max(a[i][i], 0.0);
  }
  axes[2] = cross(axes[0], axes[1]);
}

const Kernels &best_kernels() {
  static const Kernels &best = kernels(best_instruction_set());
  return best;
}

Vec3 vector(const double (&x)[3]) { return {x[0], x[1], x[2]}; }

double cubed_distance(Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double square = dot(d, d);
  return square * std::sqrt(square);
}

}  // namespace

CubeSources WarpMap::cubes() const {
  return {{source_x.data(), source_y.data(), source_z.data()},
          {weight_x.data(), weight_y.data(), weight_z.data()},
          static_cast<std::int64_t>(source_x.size())};
}

Vec3 WarpMap::value(Vec3 x) const {
  const Vec3 y = (1 / size) * (x - centre);
  const double at[3] = {y.x, y.y, y.z};
  CubeSums sums;
  best_kernels().sum_cubes(cubes(), at, sums);
  return x + size * (shift + y.x * linear_x + y.y * linear_y + y.z * linear_z + vector(sums.value));
}

MapAt WarpMap::at(Vec3 x) const {
  const Vec3 y = (1 / size) * (x - centre);
  const double at[3] = {y.x, y.y, y.z};
  CubeSums sums;
  best_kernels().sum_cubes_with_derivatives(cubes(), at, sums);
  return {x + size * (shift + y.x * linear_x + y.y * linear_y + y.z * linear_z + vector(sums.value)),
          Vec3{1, 0, 0} + linear_x + 3 * vector(sums.third_along[0]),
          Vec3{0, 1, 0} + linear_y + 3 * vector(sums.third_along[1]),
          Vec3{0, 0, 1} + linear_z + 3 * vector(sums.third_along[2])};
}

Vec3 BlendedWarp::value(Vec3 x) const {
  if (opening_ == 0) return closed_.value(x);
  if (opening_ == 1) return open_.value(x);
  return mix(closed_.value(x), open_.value(x), opening_);
}

MapAt BlendedWarp::at(Vec3 x) const {
  if (opening_ == 0) return closed_.at(x);
  if (opening_ == 1) return open_.at(x);
  const MapAt a = closed_.at(x), b = open_.at(x);
  return {mix(a.value, b.value, opening_), mix(a.along_x, b.along_x, opening_), mix(a.along_y, b.along_y, opening_),
          mix(a.along_z, b.along_z, opening_)};
}

Vec3 BlendedWarp::rate(Vec3 x) const {
  return changes_with_opening() ? open_.value(x) - closed_.value(x) : Vec3{0, 0, 0};
}

WarpLandmarks::WarpLandmarks(const Vector<Vec3> &sources, double noise, const char *name)
    : sources_(sources), noise_(noise) {
  const std::size_t n = sources_.size();
  if (n < 3) fail(RIIS_INVALID_ARGUMENT, name, ".n_points is ", n, "; a warp needs at least 3 landmarks");
  for (const Vec3 &p : sources_) centre_ = centre_ + (1.0 / static_cast<double>(n)) * p;
  SymmetricThree spread{0, 0, 0, 0, 0, 0};
  for (const Vec3 &p : sources_) {
    const Vec3 d = p - centre_;
    spread.xx += d.x * d.x, spread.yy += d.y * d.y, spread.zz += d.z * d.z;
    spread.xy += d.x * d.y, spread.xz += d.x * d.z, spread.yz += d.y * d.z;
  }
  double values[3];
  principal_axes(spread, axis_, values);
  const double root_n = std::sqrt(static_cast<double>(n));
  const double widest = std::sqrt(values[0]) / root_n, middle = std::sqrt(values[1]) / root_n,
               thinnest = std::sqrt(values[2]) / root_n;
  // The nearest pair is checked first, because landmarks in one place also lie on a line, but get another message.
  Vector<std::size_t> nearest_to;
  for (std::size_t i = 0; i < n; ++i) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double between = distance(sources_[i], sources_[k]);
      if (k != i && between < least) least = between, nearest = k;
    }
    if (!(least > same_place_share * widest))
      fail(RIIS_INVALID_ARGUMENT, name, ": landmarks ", std::min(i, nearest), " and ", std::max(i, nearest),
           " are in one place, (", sources_[i].x, ", ", sources_[i].y, ", ", sources_[i].z, ")");
    nearest_to.push_back(nearest);
    // If two landmarks are each other's nearest landmarks, the place between them is taken only once.
    if (nearest > i || nearest_to[nearest] != i)
      probes_.push_back({0.5 * (sources_[i] + sources_[nearest]), static_cast<std::int64_t>(i)});
  }
  if (!(middle > line_share * widest))
    fail(RIIS_INVALID_ARGUMENT, name, ": all ", n, " landmarks lie on a line, so they do not determine a warp");
  is_planar_ = n < 4 || thinnest < thinnest_share * widest || noise > largest_stretch_error * thinnest * root_n;
  size_ = widest;
  n_terms_ = is_planar_ ? 3 : 4;
  n_free_ = n - n_terms_;
  for (const Vec3 &p : sources_) scaled_.push_back((1 / size_) * (p - centre_));
  reduce();
}

// Finds the columns U that are orthogonal to the polynomials and make U^T K U tridiagonal, where K_ij = |r_ij|^3. U^T K U is
// positive definite.
void WarpLandmarks::reduce() {
  const std::size_t n = size(), m = n_terms_;
  const auto term = [&](std::size_t k, Vec3 y) { return k == 0 ? 1.0 : dot(axis_[k - 1], y); };
  // Makes an orthonormal basis of the polynomials by the Gram-Schmidt method. Two passes are enough, because the terms are nearly
  // orthogonal.
  Vector<double> orthonormal(m * n), upper(m * m, 0.0);
  for (std::size_t k = 0; k < m; ++k) {
    double *column = orthonormal.data() + k * n;
    for (std::size_t i = 0; i < n; ++i) column[i] = term(k, scaled_[i]);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t j = 0; j < k; ++j) {
        const double *before = orthonormal.data() + j * n;
        double product = 0;
        for (std::size_t i = 0; i < n; ++i) product += before[i] * column[i];
        for (std::size_t i = 0; i < n; ++i) column[i] -= product * before[i];
        upper[j * m + k] += product;
      }
    double square = 0;
    for (std::size_t i = 0; i < n; ++i) square += column[i] * column[i];
    upper[k * m + k] = std::sqrt(square);
    for (std::size_t i = 0; i < n; ++i) column[i] /= upper[k * m + k];
  }
  // The polynomial nearest to values v: R^-1 Q^T v.
  least_squares_.resize(m * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = m; k-- > 0;) {
      double sum = orthonormal[k * n + i];
      for (std::size_t j = k + 1; j < m; ++j) sum -= upper[k * m + j] * least_squares_[j * n + i];
      least_squares_[k * n + i] = sum / upper[k * m + k];
    }
  Vector<double> kernel(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) kernel[i * n + k] = cubed_distance(scaled_[i], scaled_[k]);
  of_kernel_.assign(m * n, 0.0);
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) of_kernel_[k * n + i] += least_squares_[k * n + j] * kernel[j * n + i];
  // With the projector P = 1 - Q Q^T, the matrix P K P has the polynomials in its null space.
  Vector<double> projected = kernel;
  for (int side = 0; side < 2; ++side)
    for (std::size_t row = 0; row < n; ++row) {
      const auto entry = [&](std::size_t i) -> double & {
        return side == 0 ? projected[row * n + i] : projected[i * n + row];
      };
      for (std::size_t k = 0; k < m; ++k) {
        const double *column = orthonormal.data() + k * n;
        double product = 0;
        for (std::size_t i = 0; i < n; ++i) product += column[i] * entry(i);
        for (std::size_t i = 0; i < n; ++i) entry(i) -= product * column[i];
      }
    }
  basis_ = std::move(orthonormal);
  tridiagonalise(projected);
}

// Continues the orthonormal columns of the polynomials by Lanczos' method with full orthogonalisation in two passes.
void WarpLandmarks::tridiagonalise(Vector<double> &matrix) {
  const std::size_t n = size(), m = n_terms_;
  Vector<double> columns = std::move(basis_), next(n);
  columns.resize(n * n);
  double largest = 0;
  for (const double entry : matrix) largest = std::max(largest, std::abs(entry));
  const auto orthogonalise = [&](std::size_t n_columns) {
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t k = 0; k < n_columns; ++k) {
        const double *column = columns.data() + k * n;
        double product = 0;
        for (std::size_t i = 0; i < n; ++i) product += column[i] * next[i];
        for (std::size_t i = 0; i < n; ++i) next[i] -= product * column[i];
      }
    double square = 0;
    for (const double x : next) square += x * x;
    return std::sqrt(square);
  };
  diagonal_.assign(n_free_, 0.0), beside_.assign(n_free_, 0.0);
  std::size_t unit = 0;
  for (std::size_t k = 0; k < n_free_; ++k) {
    double norm = 0;
    if (k > 0) {
      const double *last = columns.data() + (m + k - 1) * n;
      for (std::size_t i = 0; i < n; ++i) {
        next[i] = 0;
        for (std::size_t j = 0; j < n; ++j) next[i] += matrix[i * n + j] * last[j];
      }
      norm = orthogonalise(m + k);
    }
    beside_[k] = norm;
    // The method begins with a unit vector, and begins again with another one whenever an invariant subspace is complete.
    while (!(norm > 1e-13 * largest)) {
      beside_[k] = 0;
      std::fill(next.begin(), next.end(), 0.0);
      next[unit++] = 1;
      norm = orthogonalise(m + k);
      if (norm > 1e-3 / std::sqrt(static_cast<double>(n))) break;
      norm = 0;
    }
    double *column = columns.data() + (m + k) * n;
    for (std::size_t i = 0; i < n; ++i) column[i] = next[i] / norm;
    for (std::size_t i = 0; i < n; ++i) {
      double product = 0;
      for (std::size_t j = 0; j < n; ++j) product += matrix[i * n + j] * column[j];
      diagonal_[k] += column[i] * product;
    }
  }
  basis_.assign(columns.begin() + static_cast<std::ptrdiff_t>(m * n), columns.end());
}

// Solves (T + lambda 1) solution = reduced. The residuals are lambda * solution. Returns the sum of the squares of the residuals.
double WarpLandmarks::solve(double lambda) {
  solution_ = reduced_;
  double square = 0;
  for (std::size_t k = 0; k < n_free_; ++k) {
    pivot_[k] = diagonal_[k] + lambda;
    if (k == 0) continue;
    const double factor = beside_[k] / pivot_[k - 1];
    pivot_[k] -= factor * beside_[k];
    solution_[k] = solution_[k] - factor * solution_[k - 1];
  }
  for (std::size_t k = n_free_; k-- > 0;) {
    if (k + 1 < n_free_) solution_[k] = solution_[k] - beside_[k + 1] * solution_[k + 1];
    solution_[k] = (1 / pivot_[k]) * solution_[k];
    square += lambda * lambda * dot(solution_[k], solution_[k]);
  }
  return square;
}

// Returns the lambda at which the residuals' sum of squares is a given share of its expected value. The expected value is 3
// noise^2 for each free landmark. The sum of squares grows with lambda, so at most one lambda gives the wanted share. Returns
// infinity if even the affine map has a smaller sum.
double WarpLandmarks::smoothing_for_noise() {
  const double noise = noise_ / size_, wanted = residual_share * 3 * noise * noise * static_cast<double>(n_free_);
  if (wanted == 0) return 0;
  double whole = 0, largest = 0;
  for (std::size_t k = 0; k < n_free_; ++k) {
    whole += dot(reduced_[k], reduced_[k]);
    largest = std::max(largest, diagonal_[k] + beside_[k]);
  }
  if (whole <= wanted) return std::numeric_limits<double>::infinity();
  double low = 1e-16 * largest, high = 1e16 * largest;
  if (solve(low) >= wanted) return low;
  if (solve(high) <= wanted) return high;
  const auto middle = [&] { return std::sqrt(low) * std::sqrt(high); };  // the geometric mean
  for (int i = 0; i < 60; ++i) (solve(middle()) < wanted ? low : high) = middle();
  return middle();
}

Vector<double> WarpLandmarks::bending_matrix() {
  const std::size_t n = size();
  Vector<double> made(n * n, 0.0);
  pivot_.resize(n_free_);
  // solve() solves for vectors of three components, so one call gives three columns.
  for (std::size_t first = 0; first < n; first += 3) {
    const auto in_column = [&](std::size_t k, std::size_t j) { return j < n ? basis_[k * n + j] : 0; };
    reduced_.clear();
    for (std::size_t k = 0; k < n_free_; ++k)
      reduced_.push_back({in_column(k, first), in_column(k, first + 1), in_column(k, first + 2)});
    solve(0);
    for (std::size_t k = 0; k < n_free_; ++k)
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3 part = basis_[k * n + i] * solution_[k];
        const double parts[3] = {part.x, part.y, part.z};
        for (std::size_t j = first; j < std::min(first + 3, n); ++j) made[i * n + j] += view(parts)[j - first];
      }
  }
  return made;
}

void WarpLandmarks::fit(const Vector<Vec3> &targets, WarpMap &map, WarpQuality &quality) {
  const std::size_t n = size();
  displacement_.resize(n), reduced_.assign(n_free_, Vec3{0, 0, 0}), solution_.resize(n_free_), pivot_.resize(n_free_);
  for (std::size_t i = 0; i < n; ++i) displacement_[i] = (1 / size_) * (targets[i] - sources_[i]);
  std::array<Vec3, 4> terms{};  // the terms of the map's polynomial
  if (is_planar_) {
    // Within the plane, the landmarks give a linear map by least squares. The map takes the direction across the plane to the
    // normal of the mapped plane. It stretches this direction by the mean stretch within the plane.
    Vec3 slopes[2] = {axis_[0], axis_[1]};
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < n; ++i) slopes[k] = slopes[k] + least_squares_[(k + 1) * n + i] * displacement_[i];
    const Vec3 across = cross(slopes[0], slopes[1]);
    const double area = length(across);
    terms[3] = (area > 0 ? 1 / std::sqrt(area) : 0) * across - axis_[2];
    for (std::size_t i = 0; i < n; ++i) displacement_[i] = displacement_[i] - dot(axis_[2], scaled_[i]) * terms[3];
  }
  for (std::size_t k = 0; k < n_free_; ++k) {
    // Computes two sums at the same time, which hides the time that an addition takes.
    const double *column = basis_.data() + k * n;
    Vec3 even{0, 0, 0}, odd{0, 0, 0};
    std::size_t i = 0;
    for (; i + 1 < n; i += 2) {
      even = even + column[i] * displacement_[i];
      odd = odd + column[i + 1] * displacement_[i + 1];
    }
    if (i < n) even = even + column[i] * displacement_[i];
    reduced_[k] = even + odd;
  }
  quality.smoothing = smoothing_for_noise();
  if (std::isinf(quality.smoothing))
    solution_.assign(n_free_, Vec3{0, 0, 0});
  else
    solve(quality.smoothing);

  map.centre = centre_, map.size = size_, map.n_sources = n;
  for (Vector<double> *list :
       {&map.source_x, &map.source_y, &map.source_z, &map.weight_x, &map.weight_y, &map.weight_z})
    list->assign((n + 7) / 8 * 8, 0.0);
  for (std::size_t k = 0; k < n_free_; ++k) {
    const double *column = basis_.data() + k * n;
    const Vec3 z = solution_[k];
    for (std::size_t i = 0; i < n; ++i) map.weight_x[i] += column[i] * z.x;
    for (std::size_t i = 0; i < n; ++i) map.weight_y[i] += column[i] * z.y;
    for (std::size_t i = 0; i < n; ++i) map.weight_z[i] += column[i] * z.z;
  }
  for (std::size_t i = 0; i < n; ++i) {
    map.source_x[i] = scaled_[i].x, map.source_y[i] = scaled_[i].y, map.source_z[i] = scaled_[i].z;
    const Vec3 weight{map.weight_x[i], map.weight_y[i], map.weight_z[i]};
    for (std::size_t k = 0; k < n_terms_; ++k)
      terms[k] = terms[k] + least_squares_[k * n + i] * displacement_[i] - of_kernel_[k * n + i] * weight;
  }
  map.shift = terms[0];
  map.linear_x = axis_[0].x * terms[1] + axis_[1].x * terms[2] + axis_[2].x * terms[3];
  map.linear_y = axis_[0].y * terms[1] + axis_[1].y * terms[2] + axis_[2].y * terms[3];
  map.linear_z = axis_[0].z * terms[1] + axis_[1].z * terms[2] + axis_[2].z * terms[3];

  // The map misses a target by lambda times the weight of the landmark. Without weights, the map is affine.
  quality.rms_residual = quality.largest_residual = 0, quality.largest_landmark = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 weight{map.weight_x[i], map.weight_y[i], map.weight_z[i]};
    const double residual = std::isinf(quality.smoothing) ? distance(map.value(sources_[i]), targets[i])
                                                          : size_ * quality.smoothing * length(weight);
    quality.rms_residual += residual * residual / static_cast<double>(n);
    if (residual > quality.largest_residual)
      quality.largest_residual = residual, quality.largest_landmark = static_cast<std::int64_t>(i);
  }
  quality.least_determinant = std::numeric_limits<double>::infinity();
  for (const Probe &probe : probes_) {
    const double determinant = map.at(probe.place).determinant();
    if (determinant < quality.least_determinant)
      quality.least_determinant = determinant, quality.least_point = probe.place,
      quality.least_landmark = probe.landmark;
  }
  quality.rms_residual = std::sqrt(quality.rms_residual);
}

}  // namespace riis
