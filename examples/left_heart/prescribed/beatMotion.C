// SPDX-License-Identifier: Apache-2.0
// Moves the wall of a ventricle in closed form: x = f(x0, a(t)), with the amplitude a from a table. The points above the
// base z = 0
// stay. Below it, an amplitude of 1 draws the wall towards the axis by the share `radial`, and towards the base by the share
// `axial`.
// Both shares grow smoothly from 0 at the base to their whole at the depth `ramp` times `length`.
//
// The displacement is taken from the points of the first time step, so it does not add up rounding, and a restart is exact.
#include "Function1.H"
#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "points0MotionSolver.H"
#include "polyMesh.H"

namespace Foam {

class beatMotion : public points0MotionSolver {
  autoPtr<Function1<scalar>> amplitude_;
  scalar length_, ramp_, radial_, axial_;

 public:
  TypeName("beatMotion");

  beatMotion(const polyMesh &mesh, const IOdictionary &dict)
      : points0MotionSolver(mesh, dict, typeName),
        amplitude_(Function1<scalar>::New("amplitude", coeffDict())),
        length_(coeffDict().get<scalar>("length")),
        ramp_(coeffDict().get<scalar>("ramp")),
        radial_(coeffDict().get<scalar>("radial")),
        axial_(coeffDict().get<scalar>("axial")) {
    for (const scalar value : {length_, ramp_}) {
      if (!(value > 0)) {
        FatalIOErrorInFunction(coeffDict()) << "length is " << length_ << " and ramp is " << ramp_
                                            << ", and both must be positive" << exit(FatalIOError);
      }
    }
  }

  tmp<pointField> curPoints() const override {
    tmp<pointField> moved(new pointField(points0_));
    const scalar amplitude = amplitude_->value(mesh().time().value());
    for (point &x : moved.ref()) {
      if (x.z() >= 0) continue;
      const scalar depth = min(scalar(1), -x.z() / (length_ * ramp_)), grip = depth * depth * (3 - 2 * depth);
      const scalar across = 1 - amplitude * radial_ * grip;
      x.x() *= across;
      x.y() *= across;
      x.z() *= 1 - amplitude * axial_ * grip;
    }
    return moved;
  }

  void solve() override {}
};

defineTypeNameAndDebug(beatMotion, 0);
addToRunTimeSelectionTable(motionSolver, beatMotion, dictionary);

}  // namespace Foam
