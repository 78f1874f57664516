// SPDX-License-Identifier: Apache-2.0
// Defines the laws of opening of riisValve, and the pressures and the flow that they use.
#include "riisValve.H"
#include "surfaceFields.H"

#include <cmath>

namespace Foam {
namespace fv {

void riisValve::readLaw(const dictionary &dict) {
  const word name = dict.get<word>("law");
  if (timeLaw_.read(dict, check)) {
    law_ = Law::time;
  } else if (name == "switch") {
    refuseOthers(dict, {"law", "openingSeconds", "closingSeconds", "openAbove", "closeBelow", "filterSeconds",
                        "dwellSeconds", "closed", "upstream", "downstream", "flowPatch", "forward"});
    law_ = Law::pressure;
    check(riis_opening_switch_init(&switch_, sizeof switch_));
    switch_.opening_duration = dict.get<scalar>("openingSeconds");
    switch_.closing_duration = dict.get<scalar>("closingSeconds");
    switch_.open_above = dict.getOrDefault<scalar>("openAbove", switch_.open_above);
    switch_.close_below = dict.getOrDefault<scalar>("closeBelow", switch_.close_below);
    switch_.filter_time = dict.getOrDefault<scalar>("filterSeconds", switch_.filter_time);
    switch_.dwell_time = dict.getOrDefault<scalar>("dwellSeconds", switch_.dwell_time);
    closed_ = dict.getOrDefault<scalar>("closed", 0);
    if (!(closed_ >= 0 && closed_ < 1)) {
      FatalIOErrorInFunction(dict) << "closed is " << closed_ << ", and must be at least 0 and below 1"
                                   << exit(FatalIOError);
    }
    riis_opening_switch_state state;
    check(riis_opening_switch_state_init(&state, sizeof state));
    check(riis_opening_switch_advance(&switch_, &state, 0, 0, 0, &state), dict);
    readSensors(dict);
  } else if (name == "angle") {
    refuseOthers(dict, {"law", "pressureGain", "flowGain", "friction", "vortexGain", "angleMin", "angleMax", "upstream",
                        "downstream", "flowPatch", "forward"});
    law_ = Law::angle;
    check(riis_opening_angle_init(&angle_, sizeof angle_));
    angle_.pressure_gain = dict.get<scalar>("pressureGain");
    angle_.flow_gain = dict.get<scalar>("flowGain");
    angle_.friction = dict.get<scalar>("friction");
    angle_.vortex_gain = dict.get<scalar>("vortexGain");
    angle_.angle_min = dict.getOrDefault<scalar>("angleMin", angle_.angle_min);
    angle_.angle_max = dict.getOrDefault<scalar>("angleMax", angle_.angle_max);
    riis_opening_angle_state state;
    check(riis_opening_angle_state_init(&state, sizeof state));
    check(riis_opening_angle_advance(&angle_, &state, 0, 0, 0, &state), dict);
    readSensors(dict);
  } else {
    FatalIOErrorInFunction(dict) << "law is '" << name << "', and must be constant, times, table, switch or angle"
                                 << exit(FatalIOError);
  }
}

void riisValve::readSensors(const dictionary &dict) {
  upstream_ = sensor(dict.subDict("upstream"));
  downstream_ = sensor(dict.subDict("downstream"));
  flowPatch_ = flowPatch(dict);
}

riisValve::FlowPatch riisValve::flowPatch(const dictionary &dict) const {
  const word patch = dict.get<word>("flowPatch"), forward = dict.getOrDefault<word>("forward", "out");
  FlowPatch found;
  found.patch = mesh_.boundaryMesh().findPatchID(patch);
  if (found.patch < 0) {
    FatalIOErrorInFunction(dict) << "flowPatch is '" << patch << "', and the mesh has no such patch. Its patches are "
                                 << mesh_.boundaryMesh().names() << exit(FatalIOError);
  }
  if (forward != "out" && forward != "in") {
    FatalIOErrorInFunction(dict) << "forward is '" << forward << "', and must be out or in" << exit(FatalIOError);
  }
  found.sign = forward == "out" ? 1 : -1;
  return found;
}

riisValve::Sensor riisValve::sensor(const dictionary &dict) const {
  refuseOthers(dict, {"centre", "radius"});
  const vector atRest = dict.get<vector>("centre"), centre = follow_ ? follow_->motion()(atRest) : atRest;
  const scalar radius = dict.get<scalar>("radius");
  Sensor found;
  found.volume = 0;
  forAll(mesh_.cellCentres(), cell) {
    if (mag(mesh_.cellCentres()[cell] - centre) > radius) continue;
    found.cells.append(cell);
    found.volume += mesh_.V()[cell];
  }
  reduce(found.volume, sumOp<scalar>());
  if (!(found.volume > 0)) {
    FatalIOErrorInFunction(dict) << "no cell has its centre within " << radius << " of " << centre
                                 << exit(FatalIOError);
  }
  return found;
}

// Gives the law its state at the beginning of the run. If `found` is true, the state comes from an earlier run.
void riisValve::restartLaw(bool found) {
  const scalar start = mesh_.time().value();
  switch (law_) {
    case Law::time:
      if (!found) opening_ = timeLaw_.at(start, check);
      break;
    case Law::pressure:
      check(riis_opening_switch_state_init(&switchState_, sizeof switchState_));
      switchState_.time = start;
      if (found) {
        switchState_.time = state_.get<scalar>("time");
        switchState_.rate = state_.get<scalar>("rate");
        switchState_.progress = state_.get<scalar>("progress");
        switchState_.phase = state_.get<label>("phase");
        // If the switch had no state yet, the keys pressureDifference, flow and turnTime are missing in the file.
        state_.readIfPresent("pressureDifference", switchState_.pressure_difference);
        state_.readIfPresent("flow", switchState_.flow);
        state_.readIfPresent("turnTime", switchState_.turn_time);
      }
      if (!found) opening_ = closed_;
      break;
    case Law::angle:
      check(riis_opening_angle_state_init(&angleState_, sizeof angleState_));
      angleState_.time = start;
      if (found) {
        angleState_.time = state_.get<scalar>("time");
        angleState_.opening = opening_;
        angleState_.rate = state_.get<scalar>("rate");
        angleState_.angle = state_.get<scalar>("angle");
        angleState_.angle_rate = state_.get<scalar>("angleRate");
        state_.readIfPresent("pressureDifference", angleState_.pressure_difference);
        state_.readIfPresent("flow", angleState_.flow);
      }
      opening_ = angleState_.opening;
      break;
  }
}

// Adds the state of the law to the file of the state.
void riisValve::keepLaw() {
  const auto add = [&](const char *key, scalar value) {
    if (!std::isnan(value)) state_.add(key, value);
  };
  if (law_ == Law::pressure) {
    add("time", switchState_.time);
    add("rate", switchState_.rate);
    add("progress", switchState_.progress);
    state_.add("phase", label(switchState_.phase));
    add("pressureDifference", switchState_.pressure_difference);
    add("flow", switchState_.flow);
    add("turnTime", switchState_.turn_time);
  }
  if (law_ == Law::angle) {
    add("time", angleState_.time);
    add("rate", angleState_.rate);
    add("angle", angleState_.angle);
    add("angleRate", angleState_.angle_rate);
    add("pressureDifference", angleState_.pressure_difference);
    add("flow", angleState_.flow);
  }
}

// Returns the mean pressure over the sensor's cells on all ranks.
scalar riisValve::meanPressure(const Sensor &sensor) const {
  const volScalarField &p = mesh_.lookupObject<volScalarField>(pName_);
  scalar sum = 0;
  for (const label cell : sensor.cells) sum += mesh_.V()[cell] * p[cell];
  reduce(sum, sumOp<scalar>());
  return (p.dimensions() == dimPressure ? 1 : rho_.value()) * sum / sensor.volume;
}

scalar riisValve::flow(const FlowPatch &patch) const {
  const surfaceScalarField &phi = mesh_.lookupObject<surfaceScalarField>(phiName_);
  scalar sum = 0;
  for (const scalar flux : phi.boundaryField()[patch.patch]) sum += flux;
  return patch.sign * returnReduce(sum, sumOp<scalar>());
}

// Advances the law to the end of the step. The law uses the pressures and the flow at the beginning of the step.
scalar riisValve::openingAt(scalar time, Ostream &report) {
  scalar opening = 0;
  if (law_ == Law::time) opening = timeLaw_.at(time, check);
  if (hasSensors()) {
    const scalar difference = meanPressure(upstream_) - meanPressure(downstream_), volume = flow(flowPatch_);
    // A restart rounds OpenFOAM's time. The time in the state is not rounded.
    const scalar dt = mesh_.time().deltaTValue();
    const scalar exact = (law_ == Law::pressure ? switchState_.time : angleState_.time) + dt;
    if (mag(exact - time) < 1e-6 * dt) time = exact;
    if (law_ == Law::pressure) {
      check(riis_opening_switch_advance(&switch_, &switchState_, time, difference, volume, &switchState_));
      opening = closed_ + (1 - closed_) * switchState_.opening;
    } else {
      check(riis_opening_angle_advance(&angle_, &angleState_, time, difference, volume, &angleState_));
      opening = angleState_.opening;
    }
    report << ", pressure difference " << difference << " Pa, flow " << volume << " m3/s";
  }
  return opening;
}

}  // namespace fv
}  // namespace Foam
