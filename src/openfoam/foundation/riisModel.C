// SPDX-License-Identifier: Apache-2.0
// Defines riisValve for the Foundation's OpenFOAM, as an fvModel. The model adds a heart valve to the momentum equation, and a
// volume source to the equation of p.
//
// The model moves the valve by a law in time, and marks the cells once in each step. The model adds K (U - U_valve) / rho to the
// equation of a solver with kinematic pressure, such as the module incompressibleFluid. The source comes from ../riisNetSource.H.
// The solver gets the source by fvModels().sourceProxy(p), so that no linear solver is needed here. ../../README.md lists the
// entries.
#include "addToRunTimeSelectionTable.H"
#include "fvMatrices.H"
#include "fvModel.H"
#include "fvModels.H"
#include "fvmSup.H"
#include "riisNetSource.H"

namespace Foam {
namespace fv {

class riisModel : public fvModel {
  riisCheck check;
  scalar rho_;
  word UName_;
  Switch withVelocity_, withSource_, netSource_;
  riisTimeLaw law_;

  riis_surface_options placement_;
  riisPtr<riis_valve> valve_, before_;  // before_ is the valve at the end of the last step
  riisPtr<riis_surface> surface_;
  riisPtr<riis_mesh> cells_;
  riisPtr<riis_marks> marks_;
  riis_mark_options markOptions_;
  riis_resistance resistance_;

  scalar opening_;    // the opening at the end of step timeIndex_
  label timeIndex_;   // the step of the last marking
  bool meshChanged_;  // whether the mesh has changed since the last marking
  volScalarField K_;
  volVectorField KU_;  // K times the velocity of the leaflets
  mutable riisNetSource source_;

  void readAll(const dictionary &whole);
  void printForce() const;
  void refuse(const char *equation, const word &field) const;

 public:
  TypeName("riisValve");

  riisModel(const word &name, const word &modelType, const fvMesh &mesh, const dictionary &dict);

  wordList addSupFields() const override { return wordList(1, UName_); }
  // The name of a volume source is empty.
  bool addsSupToField(const word &field) const override {
    return field == UName_ || (field == fieldName() && withSource_ && withVelocity_);
  }

  using fvModel::addSup;
  void addSup(const volVectorField &U, fvMatrix<vector> &eqn) const override;
  void addSup(fvMatrix<scalar> &eqn) const override;
  // Equations that are multiplied by a density or by the fraction of a phase are refused.
  void addSup(const volScalarField &rho, const volVectorField &U, fvMatrix<vector> &eqn) const override;
  void addSup(const volScalarField &alpha, const volScalarField &rho, const volVectorField &U,
              fvMatrix<vector> &eqn) const override;

  // The solver calls this function before each momentum predictor.
  void correct() override;
  bool movePoints() override {
    meshChanged_ = true;
    return true;
  }
  void topoChange(const polyTopoChangeMap &) override { meshChanged_ = true; }
  void mapMesh(const polyMeshMap &) override { meshChanged_ = true; }
  void distribute(const polyDistributionMap &) override { meshChanged_ = true; }
  // Reads the dictionary again after its file has changed during the run. The valve keeps its opening.
  bool read(const dictionary &dict) override;
};

defineTypeNameAndDebug(riisModel, 0);
addToRunTimeSelectionTable(fvModel, riisModel, dictionary);

riisModel::riisModel(const word &name, const word &modelType, const fvMesh &mesh, const dictionary &dict)
    : fvModel(name, modelType, mesh, dict),
      check(name, mesh),
      rho_(1),
      opening_(0),
      timeIndex_(mesh.time().timeIndex()),
      meshChanged_(true),
      K_(IOobject(IOobject::groupName("K", name), timeName(mesh), mesh, IOobject::NO_READ, IOobject::AUTO_WRITE), mesh,
         dimensionedScalar("K", dimDensity / dimTime, 0)),
      KU_(IOobject(IOobject::groupName("KU", name), timeName(mesh), mesh, IOobject::NO_READ, IOobject::AUTO_WRITE),
          mesh, dimensionedVector("KU", dimDensity * dimVelocity / dimTime, vector::zero)) {
  static_assert(sizeof(scalar) == sizeof(double), "riis needs OpenFOAM in double precision");
  riis_set_log(riisWarn, nullptr);
  readAll(dict);
  marks_ = made<riis_marks>([&](riis_marks **to) { check(riis_marks_create(to)); });
  opening_ = law_.at(mesh.time().value(), check);
  Info << "riis " << name << ": starts at time " << timeName(mesh) << " with opening " << opening_ << endl;
}

void riisModel::readAll(const dictionary &whole) {
  // If the entry has a subdictionary for the keys, OpenFOAM reads the keys only from there.
  const word part = type() + "Coeffs";
  if (whole.found(part)) refuseOthers(whole, {"type", "libs", part.c_str()});
  const dictionary &dict = whole.optionalSubDict(part);
  refuseOthers(dict, {"type", "libs", "U", "rho", "valve", "placement", "halfThickness", "offset", "resistance", "rim",
                      "velocity", "source", "netSource", "opening", "nThreads"});
  rho_ = dimensionedScalar("rho", dimDensity, dict).value();
  if (!(rho_ > 0)) {
    FatalIOErrorInFunction(dict) << "rho is " << rho_ << ", and must be positive" << exit(FatalIOError);
  }
  UName_ = getOr<word>(dict, "U", "U");
  withVelocity_ = getOr<Switch>(dict, "velocity", true);
  withSource_ = getOr<Switch>(dict, "source", true);
  netSource_ = getOr<Switch>(dict, "netSource", true);
  if (!withVelocity_) KU_.primitiveFieldRef() = vector::zero;
  const dictionary &opening = dict.subDict("opening");
  if (!law_.read(opening, check)) {
    FatalIOErrorInFunction(opening) << "law is '" << get<word>(opening, "law")
                                    << "', and must be constant, times or table" << exit(FatalIOError);
  }

  valve_ = readValve(dict.subDict("valve"), check);
  before_ = made<riis_valve>([&](riis_valve **to) { check(riis_valve_copy(valve_.get(), to)); });
  check(riis_surface_options_init(&placement_, sizeof placement_));
  const dictionary &placement = dict.subDict("placement");
  refuseOthers(placement, {"scale", "rotationAxis", "rotationAngle", "translation", "flipNormals"});
  readPlacement(placement, placement_);
  placement_.half_thickness = dimensionedScalar("halfThickness", dimLength, dict).value();
  placement_.offset = getOr<scalar>(dict, "offset", 0);
  placement_.n_threads = getOr<label>(dict, "nThreads", 1);
  readResistance(dict, check, resistance_);
  surface_ =
      made<riis_surface>([&](riis_surface **to) { check(riis_surface_create(valve_.get(), &placement_, to), dict); });
  check(riis_mark_options_init(&markOptions_, sizeof markOptions_));
  markOptions_.n_threads = placement_.n_threads;
  markOptions_.fields =
      (withVelocity_ ? RIIS_FIELD_VELOCITY : 0) | (resistance_.rim == RIIS_RIM_CUT ? RIIS_FIELD_RIM : 0);
}

bool riisModel::read(const dictionary &dict) {
  if (!fvModel::read(dict)) return false;
  readAll(dict);
  return true;
}

// Prints the force of the flow on the valve at the end of the last step.
void riisModel::printForce() const {
  const volVectorField &U = mesh().lookupObject<volVectorField>(UName_);
  const scalarField &volume = mesh().V();
  const vectorField force(K_.primitiveField() * U.primitiveField() - KU_.primitiveField());
  Info << "riis " << name() << ": force of the flow at the end of the last step " << gSum(vectorField(force * volume))
       << " N" << endl;
}

// Moves the valve to its position at the end of the step, marks the cells, and computes K. The cells are marked once in a step,
// so that all outer correctors of the step use the same K.
void riisModel::correct() {
  const Time &time = mesh().time();
  if (timeIndex_ == time.timeIndex()) return;
  if (timeIndex_ > time.startTimeIndex()) printForce();
  timeIndex_ = time.timeIndex();
  if (meshChanged_) placeCells(mesh(), check, cells_);
  meshChanged_ = false;

  check(riis_valve_set_scalar(before_.get(), "opening", opening_));
  opening_ = law_.at(time.value(), check);
  check(riis_valve_set_scalar(valve_.get(), "opening", opening_));
  if (withVelocity_) {
    check(riis_surface_update_moving(surface_.get(), valve_.get(), before_.get(), time.deltaTValue(), &placement_,
                                     &placement_));
  } else {
    check(riis_surface_update(surface_.get(), valve_.get(), &placement_));
  }
  check(riis_mark_nodes(surface_.get(), cells_.get(), &markOptions_, marks_.get()));
  computeResistance(marks_.get(), resistance_, check, K_.primitiveFieldRef(),
                    withVelocity_ ? &KU_.primitiveFieldRef() : nullptr);
  const label marked = countMarked(marks_.get(), surface_.get(), name(), mesh(), check);
  K_.correctBoundaryConditions();
  KU_.correctBoundaryConditions();
  const scalarField &volume = mesh().V();
  const scalar integral = gSum(scalarField(K_.primitiveField() * volume));
  Info << "riis " << name() << ": opening " << opening_ << ", " << marked << " cells marked, integral of K " << integral
       << " kg/s" << endl;
}

void riisModel::addSup(const volVectorField &U, fvMatrix<vector> &eqn) const {
  checkDimensions(eqn.dimensions(), U.name(), name(), mesh());
  if (timeIndex_ != mesh().time().timeIndex()) {
    FatalErrorInFunction << "valve " << name() << " at time " << timeName(mesh()) << ": the solver has not called "
                         << "fvModels().correct() in this step" << exit(FatalError);
  }
  const dimensionedScalar rho("rho", dimDensity, rho_);
  eqn -= fvm::Sp(K_ / rho, eqn.psi());
  if (withVelocity_) eqn += KU_ / rho;
}

// Adds the volume source to the solver's equation of p. One source serves all valves, so only the first valve adds it.
void riisModel::addSup(fvMatrix<scalar> &eqn) const {
  if (!mesh().conformal()) {
    FatalErrorInFunction << "valve " << name() << " at time " << timeName(mesh())
                         << ": source is yes, and the mesh has "
                         << "non-conformal couples, which the source cannot cross. Set source to no"
                         << exit(FatalError);
  }
  const bool hasReference = !eqn.psi().needReference();
  bool takesBack = !hasReference;
  const riisModel *first = nullptr;
  std::vector<riisBand> bands;
  const PtrListDictionary<fvModel> &models = fvModels::New(mesh());
  forAll(models, i) {
    const auto *valve = dynamic_cast<const riisModel *>(&models[i]);
    if (!valve) continue;
    if (!first && valve->addsSupToField(fieldName())) first = valve;
    takesBack = takesBack || !valve->netSource_;
    bands.push_back(
        {valve->K_.primitiveField(), valve->withVelocity_ ? &valve->KU_.primitiveField() : nullptr, valve->rho_});
  }
  if (this != first) return;
  eqn.source() -= source_.ofThisStep(mesh(), bands, hasReference, takesBack);
}

void riisModel::refuse(const char *equation, const word &field) const {
  FatalErrorInFunction << "valve " << name() << " at time " << timeName(mesh()) << ": the equation of " << field
                       << " is multiplied by " << equation
                       << ". riisValve is for equations divided by a constant density, such as the equations of "
                       << "incompressibleFluid" << exit(FatalError);
}

void riisModel::addSup(const volScalarField &, const volVectorField &U, fvMatrix<vector> &) const {
  refuse("a density", U.name());
}

void riisModel::addSup(const volScalarField &, const volScalarField &, const volVectorField &U,
                       fvMatrix<vector> &) const {
  refuse("the fraction of a phase", U.name());
}

}  // namespace fv
}  // namespace Foam
