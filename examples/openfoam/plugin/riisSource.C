// SPDX-License-Identifier: Apache-2.0
// Defines a linear solver for the pressure. It gives a volume source to cells that the band of a moving valve seals off.
//
// The band imposes the velocity of the leaflets. On the mesh this velocity is not free of divergence, because it points through
// walls, leaflets stretch, and it jumps from one leaflet to the next. If all faces of a cell are resisted, blood can pass them
// only under a very large pressure. This solver adds a source to the right-hand side of the pressure equation, and then calls
// the solver that its dictionary names as linearSolver. README.md says how to switch it on.
//
// A face is resisted if K dt > rho in both of its cells. Faces that are not resisted join cells to sets. A set is sealed if only
// resisted faces and walls bound it, and if it is smaller than the bands. In a sealed set of the volume |set|, the source is
//   S = 1/|set| * sum of u_f . A over the resisted faces of the set and its walls.
// A points outward, and u_f is the velocity of the leaflets on the face, or of the wall. In all other cells S is 0.
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

// Returns the valves whose dictionary has this name of the pressure.
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

// Tells whether no blood passes through the faces of a patch.
bool isClosed(const polyPatch &patch) {
  return isA<wallPolyPatch>(patch) || isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch) ||
         isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch);
}

// Tells whether a patch joins the cells on its two sides.
bool isJoined(const polyPatch &patch) { return isA<processorPolyPatch>(patch) || isA<cyclicPolyPatch>(patch); }

void addOverRanks(scalarField &values) {
  Pstream::listCombineGather(values, plusEqOp<scalar>());
  Pstream::listCombineScatter(values);
}

}  // namespace

// The source of a time step. The mesh's registry holds it, so that all pressure correctors of the step use the same source.
class riisNetSource : public regIOobject {
  label timeIndex_;
  scalarField volumes_;  // S times the cell's volume, m3/s

  void compute(const fvMesh &mesh, const Valves &valves, bool hasReference, bool takesBack);

 public:
  explicit riisNetSource(const fvMesh &mesh, const word &name)
      : regIOobject(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE)),
        timeIndex_(-1) {}
  bool writeData(Ostream &os) const override { return os.good(); }  // a restart needs no file

  const scalarField &ofThisStep(const fvMesh &mesh, const Valves &valves, bool hasReference, bool takesBack) {
    if (timeIndex_ != mesh.time().timeIndex() || volumes_.size() != mesh.nCells()) {
      compute(mesh, valves, hasReference, takesBack);
    }
    timeIndex_ = mesh.time().timeIndex();
    return volumes_;
  }
};

void riisNetSource::compute(const fvMesh &mesh, const Valves &valves, bool hasReference, bool takesBack) {
  const scalar dt = mesh.time().deltaTValue();
  const scalarField &volume = mesh.V();
  // strength is K dt / rho. share is the part of K in the diagonal A of the momentum equation. imposed is the velocity of the
  // leaflets times share. This product is the leaflets' part of H/A. The field has the name HbyA, so that the scheme for HbyA
  // interpolates it to faces.
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
  // The division by share on the face removes the effect of a varying K. A uniform velocity of the leaflets then gives no source.
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

  // Each array has one entry for each set of cells, and is later summed over all ranks.
  const regionSplit set(mesh, resisted, List<labelPair>(), true);
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
      } else if (mesh.moving() && isA<wallPolyPatch>(patch)) {
        out[here] += mesh.phi().boundaryField()[patch.index()][i];
      }
    }
  }
  forAll(volume, cell) size[set[cell]] += volume[cell];
  addOverRanks(ends);
  addOverRanks(out);
  addOverRanks(size);
  // A closed box has no set with an open end. Its largest set holds most of the blood, so this set does not count as sealed.
  if (!hasReference && max(ends) == 0) ends[findMax(size)] = 1;
  // A set that is larger than all bands is a chamber between closed valves. Its blood leaks through the valves, and its wall may
  // move, so it does not count as sealed.
  scalar bands = 0;
  forAll(volume, cell) bands += strength[cell] > 1 ? volume[cell] : 0;
  reduce(bands, sumOp<scalar>());
  if (hasReference) {
    forAll(ends, i) {
      if (size[i] > bands) ends[i] = 1;
    }
  }

  label sets = 0, cells = 0;
  forAll(ends, i) sets += ends[i] == 0 && out[i] != 0;
  // Each valve has a net source, and outermost cells of its band, which are resisted but in no sealed set. Where bands overlap, a
  // cell belongs to the valve with the largest K.
  scalarField net(valves.size(), 0), band(valves.size(), 0);
  labelList belongs(mesh.nCells(), 0);
  forAll(volume, cell) {
    for (label i = 1; i < label(valves.size()); ++i) {
      if (valves[i]->isOn() && valves[i]->K()[cell] > valves[belongs[cell]]->K()[cell]) belongs[cell] = i;
    }
    const label here = set[cell];
    if (ends[here] == 0) {
      volumes_[cell] = out[here] / size[here] * volume[cell];
      cells += volumes_[cell] != 0;
      net[belongs[cell]] += volumes_[cell];
    } else if (strength[cell] > 1) {
      band[belongs[cell]] += volume[cell];
    }
  }
  addOverRanks(net);
  addOverRanks(band);
  reduce(cells, sumOp<label>());
  // Without a fixed pressure, inflow equals outflow, so the net source must be 0. The outermost cells of the band take the net
  // source back. If the band has no such cells, all sets are sealed, and their sources cancel.
  if (takesBack) {
    forAll(volume, cell) {
      const label valve = belongs[cell];
      if (ends[set[cell]] != 0 && strength[cell] > 1) volumes_[cell] -= net[valve] / band[valve] * volume[cell];
    }
  }
  Info << "riisSource: " << sets << " sealed sets, " << cells << " cells, net source " << sum(net) << " m3/s"
       << (takesBack ? ", which the outermost cells of the band take back" : "") << endl;
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
    const bool takesBack = !hasReference || !controlDict_.getOrDefault<Switch>("netSource", true);
    const scalarField &volumes =
        mesh->lookupObjectRef<riisNetSource>(key).ofThisStep(*mesh, valves, hasReference, takesBack);

    // The equation laplacian(rAU, p) = div(HbyA) - S has a negative diagonal in OpenFOAM, and -S V on the right-hand side. If a
    // solver uses the other sign of the equation, the diagonal is positive, and the right-hand side has +S V.
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
