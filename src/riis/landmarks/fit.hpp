// SPDX-License-Identifier: Apache-2.0
// Fits a valve's sizes and its pose to landmarks by least squares.
// A model knows the place of each landmark on the valve. The fit finds the valve's sizes, its pose and the landmarks' offsets
// from their places. The fit also says which sizes the landmarks determine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "geometry/placement.hpp"
#include "landmarks/landmarks.hpp"
#include "valve/valve.hpp"

namespace riis {

// Small dense least squares (Levenberg 1944, Marquardt 1963) and symmetric eigenvalues (Jacobi 1846). This part minimises the sum
// of squares of a function's residuals, and gives the covariance of the unknowns.

// Computes the residuals for the unknowns x. The number of residuals is the same in each call.
using Residuals = std::function<void(const std::vector<double> &x, std::vector<double> &residuals)>;

struct Minimum {
  bool converged;
  double cost;  // the sum of squares
};

// Changes x until the sum of squares is least. All unknowns have the same unit. `size` is a length in this unit, over which the
// residuals are smooth. Derivatives are central differences. The unknowns stay between their bounds.
struct Bounded {
  std::vector<double> lower, upper;
};
Minimum minimize(const Residuals &residuals, std::size_t n_residuals, double size, const Bounded &bounds,
                 std::vector<double> &x);

// Returns J^T J, row after row, for the Jacobian J of the residuals at x.
std::vector<double> normal_matrix(const Residuals &residuals, std::size_t n_residuals, double size,
                                  const std::vector<double> &x);

// Replaces b by the solution of matrix * x = b, for a positive definite matrix, by Cholesky's method. Returns false if rounding
// makes the matrix indefinite.
bool solve_positive(std::vector<double> matrix, std::vector<double> &b);

// Eigenvalues of a symmetric matrix in ascending order, and the unit eigenvectors, which are the rows of `vectors`.
struct Eigen {
  std::vector<double> values, vectors;
};
Eigen symmetric_eigen(std::vector<double> a, std::size_t n);

// Returns the inverse of J^T J. If the residuals do not depend on some combination of unknowns, the diagonal entries of these
// unknowns are infinite. The other entries in their rows and columns are then 0.
std::vector<double> covariance(const std::vector<double> &normal_matrix, std::size_t n);

// A size of the valve that the fit adapts to the landmarks.
struct FittedSize {
  std::string name;
  double value;             // where the fit begins, and its result
  double reach;             // centimetres by which the valve moves if the parameter grows by 1
  double minimum, maximum;  // limits of the value
  double expected, spread;  // the value that the valve's proportions give, and its spread between people
  bool held = false;        // keeps its value
  // Results:
  bool determined = false;
  double standard_error = 0;
};

// A value that depends linearly on the fitted sizes.
struct LinearValue {
  struct Term {
    std::size_t size;
    double weight;
  };
  double constant = 0;
  std::vector<Term> terms{};

  // `values` contains the values of the sizes.
  double at(const std::vector<double> &values) const;
};

// A parameter whose value follows from the fitted sizes.
struct DerivedSize {
  std::string name;
  LinearValue of;
  // Results:
  double value = 0;
  bool determined = false;
  double standard_error = 0;
};

// The data of a valve that the fit needs, in the valve's own frame. Lengths are in centimetres.
class LandmarkModel {
 public:
  virtual ~LandmarkModel() = default;
  std::vector<FittedSize> sizes;
  std::vector<DerivedSize> derived;
  // Two sizes whose difference the landmarks determine badly. The fit always draws this difference to its expected value.
  struct Difference {
    std::size_t first, second;
    double spread;
  };
  std::vector<Difference> differences;
  double radius = 0;  // radius of the valve, for steps and thresholds

  // An offset of a landmark from its place on the valve. Several offsets of one landmark share the landmark's weight.
  struct Offset {
    std::size_t landmark;
    Vec3 vector;
  };
  // Writes the offsets of landmarks whose coordinates in the valve's frame are `local`. Each call writes the same number of
  // offsets, in the same order. `values` contains the values of the sizes.
  virtual void offsets(const std::vector<double> &values, const std::vector<Vec3> &local,
                       std::vector<Offset> &out) const = 0;
  // Returns the number of independent equations that the landmarks give.
  virtual std::size_t n_equations() const = 0;
};

// The map x -> rotation * x + translation from the valve's frame to the frame of the landmarks.
struct Pose {
  Rotation rotation;
  Vec3 translation;
};

struct LandmarkFit {
  Pose pose;
  std::vector<double> residuals;  // the length of each landmark's longest offset, in centimetres
  std::vector<Vec3> places;       // places of the landmarks on the valve, in its frame; the mean for several offsets
  double noise;                   // the noise from which the standard errors follow, in centimetres
  double rotation_error;          // degrees
  double position_error;          // standard error of the landmarks' mean, in centimetres
  bool converged;
  double squares;          // the sum of the landmarks' squared residuals
  std::size_t n_unknowns;  // sizes that are not held, and the pose
};

// Fits the model's sizes and the pose. Runs the fit once from each of the poses, always beginning with the model's sizes, and
// keeps the best result.
LandmarkFit fit(LandmarkModel &model, const Landmarks &landmarks, const std::vector<Pose> &starts);

// Returns whether the simple model is as good as the general model, which means that the general model fits the landmarks better
// only by chance. The sizes of the simple model are among the sizes of the general model.
bool is_as_good(const LandmarkFit &simple, const LandmarkFit &general, const LandmarkModel &general_model,
                const Landmarks &landmarks);

// Refuses a fit that has not converged.
void check_converged(const LandmarkFit &fit, const Landmarks &landmarks);

// Returns the rotation whose columns are unit vectors along x, y and z. `x` is first made perpendicular to z.
Rotation rotation_to(Vec3 x, Vec3 z);
Rotation operator*(const Rotation &a, const Rotation &b);
inline Vec3 unit(Vec3 a) { return (1 / length(a)) * a; }

// This part says, for each kind of valve, which landmarks are needed, where they lie on the valve, and which sizes they
// determine.

// Returns a parameter's value in the template. The fit begins with the proportions of the template.
double value_of(const Valve &valve, const std::string &name);
Vec3 vector_of(const Valve &valve, const char *name);

// Says whether the caller keeps the parameter of this name fixed.
using IsHeld = std::function<bool(const std::string &name)>;

struct KindOfLandmarks {
  // The models, from the fewest sizes to the most. The fit takes the first model that agrees with the landmarks. If no model
  // agrees, the fit takes the last model.
  std::vector<std::unique_ptr<LandmarkModel>> models;
  std::vector<Pose> starts;
  const char *size_name;  // the parameter that stands for the valve's size
  // Sets the remaining parameters. It is called after the model's sizes and the lengths that grow with the valve's size have been
  // set. `own` is the template valve. The function pointer is NULL if there is nothing to set.
  void (*finish)(const Valve &own, Valve &valve) = nullptr;
  // Refuses a fit that leaves something undetermined or that contradicts the landmarks. If the function is empty, no fit is
  // refused.
  std::function<void(const LandmarkModel &fitted, const LandmarkFit &fit, const Landmarks &landmarks)> check{};
  std::int32_t n_as_annulus = 0;  // trigones that count as points of the annulus
};

KindOfLandmarks one_model(std::unique_ptr<LandmarkModel> model, std::vector<Pose> starts, const char *size_name);

// Checks the landmarks and prepares the fit, for the kinds with two to four cusps.
KindOfLandmarks cusp_landmarks(const Valve &valve, const Landmarks &landmarks, const IsHeld &is_held);
KindOfLandmarks mitral_landmarks(const Valve &valve, const Landmarks &landmarks);
KindOfLandmarks mitral_coapting_landmarks(const Valve &valve, const Landmarks &landmarks);
KindOfLandmarks tricuspid_landmarks(const Valve &valve, const Landmarks &landmarks);
KindOfLandmarks bileaflet_landmarks(const Valve &valve, const Landmarks &landmarks);

}  // namespace riis
