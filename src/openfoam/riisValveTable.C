// SPDX-License-Identifier: Apache-2.0
// Defines riisValveTable, a function object that writes a table of a valve: postProcessing/NAME/TIME/riisValve.dat.
//
// A row of the table has the opening, the pressure difference, the flow and its volumes, the areas, and the largest speed at the
// band. A row also has the force and the moment of the flow on each leaflet. README.md lists keys and columns. The volumes are
// summed in every time step, so they do not depend on the interval of writing. After a restart, the volumes continue.
#include "addToRunTimeSelectionTable.H"
#include "fvMeshFunctionObject.H"
#include "fvOptions.H"
#include "riisValve.H"
#include "writeFile.H"

#include <cmath>

namespace Foam {
namespace functionObjects {

class riisValveTable : public fvMeshFunctionObject, public writeFile {
  dictionary dict_;
  word valveName_;
  vector about_;
  scalar period_;
  const fv::riisValve *valve_;  // nullptr until the solver has made the valve
  fv::riisValve::Sensor upstream_, downstream_;
  fv::riisValve::FlowPatch flowPatch_;
  fv::riisState state_;

  scalar forward_, backward_, flow_;
  label beat_, timeIndex_;

  void find();
  void readSensors();
  void writeNames(label nLeaflets);
  scalar fastest(const volVectorField &U) const;

 public:
  TypeName("riisValveTable");

  riisValveTable(const word &name, const Time &time, const dictionary &dict);

  bool read(const dictionary &dict) override;
  bool execute() override;
  bool write() override;
};

defineTypeNameAndDebug(riisValveTable, 0);
addToRunTimeSelectionTable(functionObject, riisValveTable, dictionary);

riisValveTable::riisValveTable(const word &name, const Time &time, const dictionary &dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(obr_, name, "riisValve", dict),
      valve_(nullptr),
      state_(IOobject(name + "State", mesh_.time().timeName(), "uniform", mesh_, IOobject::READ_IF_PRESENT,
                      IOobject::NO_WRITE)),
      forward_(state_.getOrDefault<scalar>("forwardVolume", 0)),
      backward_(state_.getOrDefault<scalar>("regurgitantVolume", 0)),
      flow_(0),
      beat_(state_.getOrDefault<label>("beat", 0)),
      timeIndex_(mesh_.time().timeIndex()) {
  read(dict);
}

bool riisValveTable::read(const dictionary &dict) {
  fv::refuseOthers(dict, {"type",
                          "libs",
                          "functionObjectLibs",
                          "region",
                          "enabled",
                          "log",
                          "timeStart",
                          "timeEnd",
                          "executeControl",
                          "executeInterval",
                          "writeControl",
                          "writeInterval",
                          "writePrecision",
                          "writeToFile",
                          "useUserTime",
                          "errors",
                          "valve",
                          "upstream",
                          "downstream",
                          "flowPatch",
                          "forward",
                          "period",
                          "about"});
  fvMeshFunctionObject::read(dict);
  writeFile::read(dict);
  dict_ = dict;
  valveName_ = dict.get<word>("valve");
  about_ = dict.getOrDefault<vector>("about", Zero);
  period_ = dict.found("period") ? fv::positive(dict, "period") : 0;
  valve_ = nullptr;
  find();
  return true;
}

// Finds the valve. If the table has no sensors of its own, it uses the sensors of the valve's law.
void riisValveTable::find() {
  if (!mesh_.foundObject<fv::options>(fv::options::typeName)) return;
  const fv::optionList &options = mesh_.lookupObject<fv::options>(fv::options::typeName);
  wordList names;
  for (const fv::option &option : options) {
    const auto *valve = dynamic_cast<const fv::riisValve *>(&option);
    if (!valve) continue;
    names.append(option.name());
    if (option.name() == valveName_) valve_ = valve;
  }
  if (!valve_) {
    FatalIOErrorInFunction(dict_) << "valve is '" << valveName_
                                  << "', and fvOptions has no such riisValve. Its valves are " << names
                                  << exit(FatalIOError);
  }
  readSensors();
}

void riisValveTable::readSensors() {
  const dictionary &law = valve_->coeffs().subDict("opening");
  const auto from = [&](const word &key) -> const dictionary & { return dict_.found(key) ? dict_ : law; };
  for (const word key : {"upstream", "downstream", "flowPatch"}) {
    if (from(key).found(key)) continue;
    FatalIOErrorInFunction(dict_) << "neither this table nor the law of valve " << valveName_ << " has the key " << key
                                  << exit(FatalIOError);
  }
  upstream_ = valve_->sensor(from("upstream").subDict("upstream"));
  downstream_ = valve_->sensor(from("downstream").subDict("downstream"));
  flowPatch_ = valve_->flowPatch(from("flowPatch"));
}

// Adds the flow of a time step to the volumes of the beat.
bool riisValveTable::execute() {
  if (!valve_) find();
  if (!valve_ || timeIndex_ == mesh_.time().timeIndex()) return true;
  timeIndex_ = mesh_.time().timeIndex();
  if (mesh_.changing()) readSensors();
  const scalar dt = mesh_.time().deltaTValue();
  // A step belongs to the beat that contains the middle of the step. The rounding of the time thus does not matter.
  const label beat = period_ > 0 ? label(std::floor((mesh_.time().value() - dt / 2) / period_)) : 0;
  if (beat != beat_) forward_ = backward_ = 0;
  beat_ = beat;
  flow_ = valve_->flow(flowPatch_);
  (flow_ > 0 ? forward_ : backward_) += mag(flow_) * dt;
  if (mesh_.time().writeTime()) {
    state_.clear();
    state_.add("forwardVolume", forward_);
    state_.add("regurgitantVolume", backward_);
    state_.add("beat", beat_);
    state_.regIOobject::write();
  }
  return true;
}

void riisValveTable::writeNames(label nLeaflets) {
  writeHeader(file(), "Valve " + valveName_ + ", SI units. Moments are about " + Foam::name(about_.x()) + " " +
                          Foam::name(about_.y()) + " " + Foam::name(about_.z()));
  writeCommented(file(), "Time");
  for (const char *column : {"opening", "pressure_difference", "flow", "forward_volume", "regurgitant_volume",
                             "orifice_area", "band_free_area", "effective_area", "speed_at_band"}) {
    writeTabbed(file(), column);
  }
  for (label i = 0; i < nLeaflets; ++i) {
    writeTabbed(file(), "force_" + Foam::name(i));
    writeTabbed(file(), "moment_" + Foam::name(i));
  }
  file() << endl;
}

// Returns the largest speed in the cells of the band, and in their neighbours on the same rank.
scalar riisValveTable::fastest(const volVectorField &U) const {
  const scalarField &K = valve_->K().primitiveField();
  scalar speed = 0;
  forAll(K, cell) speed = K[cell] > 0 ? max(speed, mag(U[cell])) : speed;
  forAll(mesh_.neighbour(), face) {
    const label a = mesh_.owner()[face], b = mesh_.neighbour()[face];
    if (K[a] > 0 || K[b] > 0) speed = max(speed, max(mag(U[a]), mag(U[b])));
  }
  return returnReduce(speed, maxOp<scalar>());
}

bool riisValveTable::write() {
  if (!valve_ || timeIndex_ == mesh_.time().startTimeIndex()) return true;
  const volVectorField &U = mesh_.lookupObject<volVectorField>(valve_->UName());
  const scalar difference = valve_->meanPressure(upstream_) - valve_->meanPressure(downstream_);
  const bool drives = difference > 0 && flow_ > 0;
  const scalar effective = drives ? flow_ / std::sqrt(2 * difference / valve_->rho()) : 0;
  vectorField force, moment;
  valve_->forces(U, about_, force, moment);
  const scalar speed = fastest(U);
  if (!Pstream::master()) return true;
  const riis_orifice orifice = valve_->orifice();
  if (!writtenHeader_) writeNames(force.size());
  writtenHeader_ = true;
  writeCurrentTime(file());
  for (const scalar value : {valve_->opening(), difference, flow_, forward_, backward_, orifice.area,
                             orifice.effective_area, effective, speed}) {
    file() << token::TAB << value;
  }
  forAll(force, i) file() << token::TAB << force[i] << token::TAB << moment[i];
  file() << endl;
  return true;
}

}  // namespace functionObjects
}  // namespace Foam
