// SPDX-License-Identifier: Apache-2.0
// Defines a linear solver for the pressure. The solver adds a volume source in cells that the band of a moving valve seals off.
//
// The band imposes the velocity of the leaflets. In the mesh, the divergence of the leaflets' velocity is not 0, because the
// velocity points through walls, leaflets stretch, and the velocity jumps between leaflets. If all faces of a cell are resisted,
// only a very large pressure could drive blood through them. Therefore riisSource adds a source to the right-hand side of the
// pressure equation, and then calls the linearSolver of its dictionary. README.md says how to switch the source on, and
// riisNetSource.H describes the source.
#include "addToRunTimeSelectionTable.H"
#include "fvOptions.H"
#include "lduMatrix.H"
#include "riisNetSource.H"
#include "riisValve.H"

namespace Foam {

namespace {

using Valves = std::vector<const fv::riisValve *>;

// Returns the valves whose dictionaries give the pressure this name.
Valves valvesOf(const fvMesh &mesh, const word &pressure) {
  Valves valves;
  if (!mesh.foundObject<fv::options>(fv::options::typeName)) return valves;
  const fv::optionList &options = mesh.lookupObject<fv::options>(fv::options::typeName);
  for (const fv::option &option : options) {
    const auto *valve = dynamic_cast<const fv::riisValve *>(&option);
    if (valve && valve->pName() == pressure) valves.push_back(valve);
  }
  return valves;
}

}  // namespace

// Holds the source of a time step in the mesh's registry.
class riisStoredSource : public regIOobject, public fv::riisNetSource {
 public:
  explicit riisStoredSource(const fvMesh &mesh, const word &name)
      : regIOobject(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE)) {}
  bool writeData(Ostream &os) const override { return os.good(); }  // a restart needs no file
};

class riisSource : public lduMatrix::solver {
 public:
  TypeName("riisSource");

  using lduMatrix::solver::solver;

  solverPerformance solve(scalarField &psi, const scalarField &source, const direction component) const override {
    const auto *mesh = dynamic_cast<const fvMesh *>(&matrix_.mesh());
    if (!mesh) {
      FatalErrorInFunction << "riisSource solves for " << fieldName_ << ", which has no mesh of finite volumes"
                           << exit(FatalError);
    }
    const word name = controlDict_.get<word>("linearSolver");
    if (name == typeName) {
      FatalIOErrorInFunction(controlDict_)
          << "linearSolver is riisSource, and must be another solver" << exit(FatalIOError);
    }
    const Valves valves = valvesOf(*mesh, fieldName_);
    if (valves.empty()) {
      FatalIOErrorInFunction(controlDict_)
          << "riisSource solves for " << fieldName_ << ", and fvOptions has no riisValve with this pressure"
          << exit(FatalIOError);
    }
    const word key = "riisSource." + fieldName_;
    if (!mesh->foundObject<riisStoredSource>(key)) regIOobject::store(new riisStoredSource(*mesh, key));
    std::vector<fv::riisBand> bands;
    for (const fv::riisValve *valve : valves) {
      if (!valve->isOn()) continue;
      bands.push_back(
          {valve->K().primitiveField(), valve->KU() ? &valve->KU()->primitiveField() : nullptr, valve->rho()});
    }
    const bool hasReference = !mesh->lookupObject<volScalarField>(fieldName_).needReference();
    const bool takesBack = !hasReference || !controlDict_.getOrDefault<Switch>("netSource", true);
    const scalarField &volumes =
        mesh->lookupObjectRef<riisStoredSource>(key).ofThisStep(*mesh, bands, hasReference, takesBack);

    // In OpenFOAM, the equation laplacian(rAU, p) = div(HbyA) - S has a negative diagonal, and -S V on its right-hand side. If a
    // solver uses the opposite sign, the diagonal is positive, and the right-hand side has +S V.
    const scalar sign = gSum(matrix_.diag()) < 0 ? -1 : 1;
    dictionary controls(controlDict_);
    controls.set("solver", name);
    return lduMatrix::solver::New(fieldName_, matrix_, interfaceBouCoeffs_, interfaceIntCoeffs_, interfaces_, controls)
        ->solve(psi, scalarField(source + sign * volumes), component);
  }
};

defineTypeNameAndDebug(riisSource, 0);
lduMatrix::solver::addsymMatrixConstructorToTable<riisSource> addRiisSourceForSymmetric_;
lduMatrix::solver::addasymMatrixConstructorToTable<riisSource> addRiisSourceForAsymmetric_;

}  // namespace Foam
