// SPDX-License-Identifier: Apache-2.0
// A linear solver for the pressure that lets a moving valve change the volume of cells which its band seals off.
//
// The band imposes the velocity of the leaflets, and that is not free of divergence on the mesh: it points through walls,
// leaflets stretch, it jumps from one leaflet to the next. Where every face of a cell is resisted, nothing can flow to make up
// for it, and the pressure becomes what a force of K needs. This solver adds a source to the right-hand side of the equation of
// p, and then calls the solver that its dictionary names as linearSolver. README.md says how to switch it on.
//
// A face is resisted if K dt > rho in both of its cells. A sealed set consists of cells that are joined through other faces, and
// is bounded only by resisted faces and walls. With A outward, u_f as the equation has it, and |set| its volume:
//   S = 1/|set| * sum over the resisted faces of the set of u_f . A in sealed sets, and 0 elsewhere.
#include "addToRunTimeSelectionTable.H"
#include "cyclicPolyPatch.H"
#include "emptyPolyPatch.H"
#include "fvOptions.H"
#include "fvcFlux.H"
#include "lduMatrix.H"
#include "processorPolyPatch.H"
#include "regionSplit.H"
#include "riisValve.H"
#include "surfaceFields.H"
#include "surfaceInterpolate.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"

#include <vector>

namespace Foam {

namespace {

using Valves = std::vector<const fv::riisValve *>;

// The valves whose pressure is called so.
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

// No blood passes through the faces of such a patch.
bool isClosed(const polyPatch &patch) {
  return isA<wallPolyPatch>(patch) || isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch) ||
         isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch);
}

// Cells at both sides of such a patch are joined.
bool isJoined(const polyPatch &patch) { return isA<processorPolyPatch>(patch) || isA<cyclicPolyPatch>(patch); }

void addOverRanks(scalarField &values) {
  Pstream::listCombineGather(values, plusEqOp<scalar>());
  Pstream::listCombineScatter(values);
}

}  // namespace

// The source of a time step. Pressure correctors of the same step find it in the mesh's registry.
class riisNetSource : public regIOobject {
  label timeIndex_;
  scalarField volumes_;  // S times the cell's volume, m3/s

  void compute(const fvMesh &mesh, const Valves &valves, bool hasReference);

 public:
  explicit riisNetSource(const fvMesh &mesh, const word &name)
      : regIOobject(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE)),
        timeIndex_(-1) {}
  bool writeData(Ostream &os) const override { return os.good(); }  // nothing needs it later

  const scalarField &ofThisStep(const fvMesh &mesh, const Valves &valves, bool hasReference) {
    if (timeIndex_ != mesh.time().timeIndex() || volumes_.size() != mesh.nCells()) compute(mesh, valves, hasReference);
    timeIndex_ = mesh.time().timeIndex();
    return volumes_;
  }
};

void riisNetSource::compute(const fvMesh &mesh, const Valves &valves, bool hasReference) {
  const scalar dt = mesh.time().deltaTValue();
  const scalarField &volume = mesh.V();
  // K dt / rho, its share of A in the momentum equation, and the velocity of the leaflets times this share, as H/A has it. That
  // one bears the name of H/A, so that the solver's own scheme interpolates it to the faces.
  volScalarField strength(IOobject("riisStrength", mesh.time().timeName(), mesh), mesh,
                          dimensionedScalar(dimless, Zero));
  volScalarField share(IOobject("riisShare", mesh.time().timeName(), mesh), mesh, dimensionedScalar(dimless, Zero));
  volVectorField imposed(IOobject("HbyA", mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false),
                         mesh, dimensionedVector(dimVelocity, Zero));
  for (const fv::riisValve *valve : valves) {
    if (!valve->isOn()) continue;
    strength.primitiveFieldRef() += valve->K().primitiveField() * (dt / valve->rho());
    if (valve->KU()) imposed.primitiveFieldRef() += valve->KU()->primitiveField() * (dt / valve->rho());
  }
  imposed.primitiveFieldRef() /= 1 + strength.primitiveField();
  share.primitiveFieldRef() = strength.primitiveField() / (1 + strength.primitiveField());
  volumes_.setSize(mesh.nCells());
  volumes_ = 0;
  if (gMax(mag(imposed.primitiveField())()) == 0) return;
  strength.correctBoundaryConditions();
  share.correctBoundaryConditions();
  imposed.correctBoundaryConditions();
  // Divided by the share on the face, so that leaflets of one velocity give no source where K varies.
  const surfaceScalarField flux(fvc::flux(imposed) /
                                (fvc::interpolate(share, "flux(HbyA)") + dimensionedScalar("least", dimless, VSMALL)));

  boolList resisted(mesh.nFaces(), false);
  const labelUList &owner = mesh.owner(), &neighbour = mesh.neighbour();
  forAll(neighbour, face) resisted[face] = strength[owner[face]] > 1 && strength[neighbour[face]] > 1;
  for (const polyPatch &patch : mesh.boundaryMesh()) {
    if (!isJoined(patch)) continue;
    const scalarField there(strength.boundaryField()[patch.index()].patchNeighbourField());
    forAll(patch, i) resisted[patch.start() + i] = strength[patch.faceCells()[i]] > 1 && there[i] > 1;
  }

  // Sums over all ranks, by the number of a set.
  const regionSplit set(mesh, resisted, true);
  scalarField ends(set.nRegions(), 0), out(set.nRegions(), 0), size(set.nRegions(), 0);
  forAll(neighbour, face) {
    if (!resisted[face]) continue;
    out[set[owner[face]]] += flux[face];
    out[set[neighbour[face]]] -= flux[face];
  }
  for (const polyPatch &patch : mesh.boundaryMesh()) {
    const scalarField &through = flux.boundaryField()[patch.index()];
    forAll(patch, i) {
      const label here = set[patch.faceCells()[i]];
      if (isJoined(patch)) {
        if (resisted[patch.start() + i]) out[here] += through[i];
      } else if (!isClosed(patch)) {
        ends[here] += 1;
      }
    }
  }
  forAll(volume, cell) size[set[cell]] += volume[cell];
  addOverRanks(ends);
  addOverRanks(out);
  addOverRanks(size);
  // A box without ends: its largest set is where the blood is, and no pocket.
  if (!hasReference && max(ends) == 0) ends[findMax(size)] = 1;

  label sets = 0, cells = 0;
  forAll(ends, i) sets += ends[i] == 0 && out[i] != 0;
  scalar band = 0;  // the volume of resisted cells that are not sealed: the outermost of the band
  forAll(volume, cell) {
    const label here = set[cell];
    if (ends[here] == 0) {
      volumes_[cell] = out[here] / size[here] * volume[cell];
      cells += volumes_[cell] != 0;
    } else if (strength[cell] > 1) {
      band += volume[cell];
    }
  }
  const scalar net = gSum(volumes_);
  reduce(band, sumOp<scalar>());
  reduce(cells, sumOp<label>());
  // Without a fixed pressure inflow equals outflow. If no such cell is there, all sets are sealed, and their sums cancel.
  if (!hasReference && band > 0) {
    forAll(volume, cell) {
      if (ends[set[cell]] != 0 && strength[cell] > 1) volumes_[cell] -= net / band * volume[cell];
    }
  }
  Info << "riisSource: " << sets << " sealed sets, " << cells << " cells, net source " << net << " m3/s"
       << (hasReference ? "" : ", which the outermost cells of the band take back") << endl;
}

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
    if (!mesh->foundObject<riisNetSource>(key)) regIOobject::store(new riisNetSource(*mesh, key));
    const bool hasReference = !mesh->lookupObject<volScalarField>(fieldName_).needReference();
    const scalarField &volumes = mesh->lookupObjectRef<riisNetSource>(key).ofThisStep(*mesh, valves, hasReference);

    // OpenFOAM's laplacian of p is negative on the diagonal, and the equation laplacian(rAU, p) = div(HbyA) - S has -S V on the
    // right. An equation that is written with the other sign has +S V.
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
