// SPDX-License-Identifier: Apache-2.0
#include "landmarks/fit.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"

namespace riis {
namespace {

// The stated noise gives each size a standard error. The landmarks determine the size if this error moves the valve by at most
// `determined_share` of the valve's radius. The residuals are not used here: they are large for a patient who differs from the
// model, even if the best sizes are well defined.
constexpr double determined_share = 1.0 / 15;

// Additional sizes lower the sum of squares even if the residuals are only noise. Such a decrease has a chi-squared distribution
// with one degree of freedom for each additional size. A decrease is significant if it exceeds the mean of this distribution by
// `surely_more` standard deviations.
constexpr double surely_more = 3;
// If the residuals are below `exact_share` of the stated noise, the landmarks count as exact.
constexpr double exact_share = 0.01;
// The rounding error of exact landmarks, as a share of the valve's radius.
constexpr double rounding_share = 1e-9;

// The least-squares problem of the fit. The unknowns are the sizes that are not held, a rotation vector and a shift, all in
// centimetres.
class Problem {
 public:
  Problem(const LandmarkModel &model, const Landmarks &landmarks, const Pose &base)
      : prior_noise(landmarks.noise), model_(model), landmarks_(landmarks), base_(base), local_(landmarks.list.size()) {
    for (std::size_t i = 0; i < model.sizes.size(); ++i) {
      values_.push_back(model.sizes[i].value);
      if (!model.sizes[i].held) free_.push_back(i);
    }
    with_prior.assign(free_.size(), false);
    std::vector<double> x(n_unknowns());
    place(x);
    model_.offsets(values_, local_, offsets_);
    std::vector<double> shares(landmarks.list.size());
    for (const auto &offset : offsets_) shares[offset.landmark] += 1;
    for (const auto &offset : offsets_) weights_.push_back(std::sqrt(1 / shares[offset.landmark]));
  }

  std::vector<bool> with_prior;  // for each free size: whether it is drawn to its expected value
  bool has_differences = false;  // whether the model's differences are drawn to their expected values
  double prior_noise;            // the noise of the landmarks, with which the spread of expected values is compared
  const std::vector<std::size_t> &free_sizes() const { return free_; }
  std::size_t n_unknowns() const { return free_.size() + 6; }
  std::size_t n_residuals() const {
    return 3 * offsets_.size() + static_cast<std::size_t>(std::count(with_prior.begin(), with_prior.end(), true)) +
           (has_differences ? model_.differences.size() : 0);
  }

  std::vector<double> start() const {
    std::vector<double> x(n_unknowns());
    for (std::size_t k = 0; k < free_.size(); ++k) x[k] = size(k).value * size(k).reach;
    return x;
  }

  Bounded bounds() const {
    const double any = std::numeric_limits<double>::infinity();
    Bounded made{std::vector<double>(n_unknowns(), -any), std::vector<double>(n_unknowns(), any)};
    for (std::size_t k = 0; k < free_.size(); ++k) {
      made.lower[k] = size(k).minimum * size(k).reach;
      made.upper[k] = size(k).maximum * size(k).reach;
    }
    return made;
  }

  void residuals(const std::vector<double> &x, std::vector<double> &r) {
    place(x);
    model_.offsets(values_, local_, offsets_);
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const Vec3 v = weights_[i] * offsets_[i].vector;
      r[3 * i] = v.x, r[3 * i + 1] = v.y, r[3 * i + 2] = v.z;
    }
    std::size_t row = 3 * offsets_.size();
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (with_prior[k]) r[row++] = prior_noise * (value_of(k, x) - size(k).expected) / size(k).spread;
    if (!has_differences) return;
    for (const auto &[first, second, spread] : model_.differences) {
      const double expected = model_.sizes[first].expected - model_.sizes[second].expected;
      r[row++] = prior_noise * (values_[first] - values_[second] - expected) / spread;
    }
  }

  Minimum minimize(std::vector<double> &x) {
    return riis::minimize([this](const auto &at, auto &r) { residuals(at, r); }, n_residuals(), model_.radius, bounds(),
                          x);
  }
  std::vector<double> normals(const std::vector<double> &x) {
    return normal_matrix([this](const auto &at, auto &r) { residuals(at, r); }, n_residuals(), model_.radius, x);
  }

  double value_of(std::size_t k, const std::vector<double> &x) const { return x[k] / size(k).reach; }
  Pose pose_at(const std::vector<double> &x) const {
    const std::size_t at = free_.size();
    const Vec3 turn = (1 / model_.radius) * Vec3{x[at], x[at + 1], x[at + 2]};
    const double angle = length(turn);
    Pose pose = base_;
    if (angle > 0) pose.rotation = rotation_about(turn, angle * (180 / pi)) * base_.rotation;
    pose.translation = base_.translation + Vec3{x[at + 3], x[at + 4], x[at + 5]};
    return pose;
  }
  const std::vector<LandmarkModel::Offset> &offsets() const { return offsets_; }
  // Returns the landmarks' places on the valve. The place of a landmark without an offset is the landmark itself.
  std::vector<Vec3> places() const {
    std::vector<Vec3> places = local_;
    for (std::size_t i = 0; i < offsets_.size(); ++i)
      places[offsets_[i].landmark] = places[offsets_[i].landmark] - (weights_[i] * weights_[i]) * offsets_[i].vector;
    return places;
  }

 private:
  const FittedSize &size(std::size_t k) const { return model_.sizes[free_[k]]; }

  void place(const std::vector<double> &x) {
    for (std::size_t k = 0; k < free_.size(); ++k) values_[free_[k]] = value_of(k, x);
    const Pose pose = pose_at(x);
    const Rotation back = transposed(pose.rotation);
    for (std::size_t i = 0; i < local_.size(); ++i) local_[i] = back * (landmarks_.at(i) - pose.translation);
  }

  const LandmarkModel &model_;
  const Landmarks &landmarks_;
  Pose base_;
  std::vector<double> values_;
  std::vector<std::size_t> free_;
  std::vector<Vec3> local_;
  std::vector<LandmarkModel::Offset> offsets_;
  std::vector<double> weights_;
};

double sum_of_squares(const Problem &problem, std::vector<double> &longest) {
  double sum = 0;
  std::vector<double> squares(longest.size()), counts(longest.size());
  for (const auto &[landmark, vector] : problem.offsets()) {
    squares[landmark] += dot(vector, vector);
    counts[landmark] += 1;
    longest[landmark] = std::max(longest[landmark], length(vector));
  }
  for (std::size_t i = 0; i < longest.size(); ++i)
    if (counts[i] > 0) sum += squares[i] / counts[i];
  return sum;
}

// Returns the noise estimated from the residuals, or 0 if there are no more equations than unknowns.
double seen_noise(const LandmarkModel &model, double squares, std::size_t n_unknowns) {
  const std::size_t n = model.n_equations();
  return n > n_unknowns ? std::sqrt(squares / static_cast<double>(n - n_unknowns)) : 0;
}

// Writes the values and standard errors of parameters that follow from the fitted sizes. `covariance` is the covariance of the
// problem's unknowns at a noise of 1.
void derive(LandmarkModel &model, const Problem &problem, const std::vector<double> &covariance, double noise) {
  const std::size_t n = problem.n_unknowns();
  const std::vector<std::size_t> &free = problem.free_sizes();
  for (DerivedSize &derived : model.derived) {
    std::vector<double> values, weights(free.size());
    for (const FittedSize &size : model.sizes) values.push_back(size.value);
    derived.value = derived.of.at(values);
    derived.determined = true;
    for (const auto &[size, weight] : derived.of.terms) {
      const auto found = std::find(free.begin(), free.end(), size);
      if (found == free.end()) continue;
      weights[static_cast<std::size_t>(found - free.begin())] = weight / model.sizes[size].reach;
      derived.determined = derived.determined && model.sizes[size].determined;
    }
    double variance = 0;
    for (std::size_t i = 0; i < free.size(); ++i)
      for (std::size_t k = 0; k < free.size(); ++k)
        if (weights[i] != 0 && weights[k] != 0) variance += weights[i] * weights[k] * covariance[i * n + k];
    derived.standard_error = noise * std::sqrt(std::max(variance, 0.0));
  }
}

}  // namespace

double LinearValue::at(const std::vector<double> &values) const {
  double sum = constant;
  for (const auto &[size, weight] : terms) sum += weight * values[size];
  return sum;
}

LandmarkFit fit(LandmarkModel &model, const Landmarks &landmarks, const std::vector<Pose> &starts) {
  const std::size_t n_landmarks = landmarks.list.size();
  // In the first fit, every size has an additional residual that draws it to its expected value. Even if the landmarks determine
  // few sizes, the first fit thus ends near a real valve.
  Pose best{};
  std::vector<FittedSize> best_sizes;
  double least = std::numeric_limits<double>::infinity();
  for (const Pose &start : starts) {
    Problem problem(model, landmarks, start);
    problem.with_prior.assign(problem.with_prior.size(), true);
    problem.has_differences = true;
    std::vector<double> x = problem.start();
    const double cost = problem.minimize(x).cost;
    // If a later start lowers the sum of squares by less than the squared noise, it has found the same minimum up to rounding.
    if (!(cost < least - landmarks.noise * landmarks.noise)) continue;
    least = cost;
    best = problem.pose_at(x);
    best_sizes = model.sizes;
    for (std::size_t k = 0; k < problem.free_sizes().size(); ++k)
      best_sizes[problem.free_sizes()[k]].value = problem.value_of(k, x);
  }
  model.sizes = best_sizes;

  // In the second fit, the sizes that the landmarks determine are no longer drawn to their expected values.
  Problem problem(model, landmarks, best);
  const std::size_t n = problem.n_unknowns();
  std::vector<double> x = problem.start();
  const std::vector<double> alone = covariance(problem.normals(x), n);
  for (std::size_t k = 0; k < problem.free_sizes().size(); ++k) {
    FittedSize &size = model.sizes[problem.free_sizes()[k]];
    size.determined = landmarks.noise * std::sqrt(alone[k * n + k]) <= determined_share * model.radius;
    problem.with_prior[k] = !size.determined;
  }
  problem.has_differences = true;
  const std::vector<double> start = x;
  Minimum minimum = problem.minimize(x);
  // The fit does not converge if the sum of squares hardly depends on some size. The size that the landmarks determine least is
  // then also drawn to its expected value.
  while (!minimum.converged) {
    std::size_t weakest = problem.free_sizes().size();
    for (std::size_t k = 0; k < problem.free_sizes().size(); ++k)
      if (!problem.with_prior[k] &&
          (weakest == problem.free_sizes().size() || alone[k * n + k] > alone[weakest * n + weakest]))
        weakest = k;
    if (weakest == problem.free_sizes().size()) break;
    problem.with_prior[weakest] = true;
    model.sizes[problem.free_sizes()[weakest]].determined = false;
    x = start;
    minimum = problem.minimize(x);
  }
  std::vector<double> r(problem.n_residuals());
  problem.residuals(x, r);
  // If the landmarks are more exact than the caller stated, the residuals show less noise. The fit is then repeated with this
  // lower noise, which gives the expected values less weight.
  for (int i = 0; i < 12 && minimum.converged && model.n_equations() > n; ++i) {
    std::vector<double> unused(n_landmarks), before = x;
    const double seen = std::sqrt(sum_of_squares(problem, unused) / static_cast<double>(model.n_equations() - n));
    const double noise_before = problem.prior_noise;
    problem.prior_noise = std::min(landmarks.noise, seen);
    if (!(problem.prior_noise < 0.8 * noise_before)) {
      problem.prior_noise = noise_before;
      break;
    }
    if (!problem.minimize(x).converged) {
      problem.prior_noise = noise_before;
      x = before;
    }
    problem.residuals(x, r);
  }

  LandmarkFit made{
      problem.pose_at(x), std::vector<double>(n_landmarks), problem.places(), 0, 0, 0, minimum.converged, 0, n};
  made.squares = sum_of_squares(problem, made.residuals);
  made.noise = std::max(landmarks.noise, seen_noise(model, made.squares, n));
  const std::vector<double> errors = covariance(problem.normals(x), n);
  for (std::size_t k = 0; k < problem.free_sizes().size(); ++k) {
    FittedSize &size = model.sizes[problem.free_sizes()[k]];
    size.value = problem.value_of(k, x);
    size.standard_error = made.noise * std::sqrt(errors[k * n + k]) / size.reach;
  }
  derive(model, problem, errors, made.noise);
  const auto error_of_three = [&](std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < first + 3; ++i) sum += errors[i * n + i];
    return made.noise * std::sqrt(sum);
  };
  made.rotation_error = error_of_three(n - 6) / model.radius * (180 / pi);
  made.position_error = error_of_three(n - 3);
  return made;
}

bool is_as_good(const LandmarkFit &simple, const LandmarkFit &general, const LandmarkModel &general_model,
                const Landmarks &landmarks) {
  if (!simple.converged) return false;
  const double seen = seen_noise(general_model, general.squares, general.n_unknowns);
  const double noise =
      std::max(seen < exact_share * landmarks.noise ? seen : landmarks.noise, rounding_share * general_model.radius);
  const auto n_more = static_cast<double>(general.n_unknowns - simple.n_unknowns);
  return simple.squares - general.squares <= (n_more + surely_more * std::sqrt(2 * n_more)) * noise * noise;
}

void check_converged(const LandmarkFit &fit, const Landmarks &landmarks) {
  if (fit.converged) return;
  const double worst = *std::max_element(fit.residuals.begin(), fit.residuals.end());
  fail(RIIS_INVALID_ARGUMENT, "the fit to the landmarks does not converge; the worst residual is ",
       rounded(landmarks.scale * worst, 3), ": look for a misplaced landmark");
}

Rotation operator*(const Rotation &a, const Rotation &b) {
  const Rotation columns = transposed(b);
  return transposed({a * columns.row_x, a * columns.row_y, a * columns.row_z});
}

Rotation rotation_to(Vec3 x, Vec3 z) {
  const Vec3 up = unit(z), along = unit(x - dot(x, up) * up);
  return transposed({along, cross(up, along), up});
}

}  // namespace riis
