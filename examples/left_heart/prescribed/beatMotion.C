// SPDX-License-Identifier: Apache-2.0
// Moves the wall of a ventricle as wallMotion.H says, with the amplitude from a table. The motion starts from the points of the
// first time step. Rounding errors therefore do not add up, and a restart is exact.
#include "Function1.H"
#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "points0MotionSolver.H"
#include "polyMesh.H"
#include "wallMotion.H"

namespace Foam {

class beatMotion : public points0MotionSolver {
  autoPtr<Function1<scalar>> amplitude_;
  wallMotion wall_;

 public:
  TypeName("beatMotion");

  beatMotion(const polyMesh &mesh, const IOdictionary &dict)
      : points0MotionSolver(mesh, dict, typeName),
        amplitude_(Function1<scalar>::New("amplitude", coeffDict())),
        wall_(coeffDict()) {}

  tmp<pointField> curPoints() const override {
    tmp<pointField> points(new pointField(points0_));
    const scalar amplitude = amplitude_->value(mesh().time().value());
    for (point &p : points.ref()) p = wall_.moved(p, amplitude);
    return points;
  }

  void solve() override {}
};

defineTypeNameAndDebug(beatMotion, 0);
addToRunTimeSelectionTable(motionSolver, beatMotion, dictionary);

}  // namespace Foam
