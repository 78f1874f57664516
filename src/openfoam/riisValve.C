// SPDX-License-Identifier: Apache-2.0
#include "riisValve.H"

#include "ListListOps.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMatrices.H"
#include "fvmSup.H"

#include <chrono>
#include <cstring>

namespace Foam {
namespace fv {

defineTypeNameAndDebug(riisValve, 0);
addToRunTimeSelectionTable(option, riisValve, dictionary);

bool riisState::writeData(Ostream &os) const {
  const int digits = os.precision(17);
  const bool good = IOdictionary::writeData(os);
  os.precision(digits);
  return good;
}

// The list is written as text, because OpenFOAM cannot read the lists of a binary dictionary.
#if OPENFOAM < 2006
bool riisState::writeObject(IOstream::streamFormat, IOstream::versionNumber version,
                            IOstream::compressionType compression, const bool valid) const {
  return IOdictionary::writeObject(IOstream::ASCII, version, compression, valid);
}
#else
bool riisState::writeObject(IOstreamOption stream, const bool valid) const {
  stream.format(IOstreamOption::ASCII);
  return IOdictionary::writeObject(stream, valid);
}
#endif

riisValve::riisValve(const word &name, const word &modelType, const dictionary &dict, const fvMesh &mesh)
    : option(name, modelType, dict, mesh),
      check(name, mesh),
      rho_("rho", dimDensity, 1),  // readAll reads it
      law_(Law::time),
      factor_(1),
      estimated_(false),
      opening_(0),
      timeIndex_(mesh.time().timeIndex()),
      K_(IOobject(IOobject::groupName("K", name), mesh.time().timeName(), mesh, IOobject::NO_READ,
                  IOobject::AUTO_WRITE),
         mesh, dimensionedScalar(dimDensity / dimTime, Zero)),
      state_(IOobject(name + "State", mesh.time().timeName(), "uniform", mesh, IOobject::READ_IF_PRESENT,
                      IOobject::AUTO_WRITE)) {
  static_assert(sizeof(scalar) == sizeof(double), "riis needs OpenFOAM in double precision");
  riis_set_log(riisWarn, nullptr);
  readAll();
  restart();

  copyValve();
  placeCells(mesh_, check, cells_);
  result_ = made<riis_marks>([&](riis_marks **to) { check(riis_marks_create(to)); });
  keepState();
}

void riisValve::copyValve() {
  check(riis_valve_set_scalar(valve_.get(), "opening", opening_));
  before_ = made<riis_valve>([&](riis_valve **to) { check(riis_valve_copy(valve_.get(), to)); });
}

void riisValve::readAll() {
  // If the entry has a subdictionary for the keys, OpenFOAM reads the keys only from there. Keys beside the subdictionary would
  // have no effect.
  const word part = modelType_ + "Coeffs";
  if (dict_.found(part)) {
    refuseOthers(dict_, {"type", "active", "libs", "selectionMode", "fields", part.c_str()});
  }
  refuseOthers(
      coeffs_,
      {"type",     "active",  "libs",      "selectionMode", "fields",        "U",          "p",           "phi",
       "rho",      "valve",   "placement", "warp",          "halfThickness", "resistance", "calibrate",   "rim",
       "velocity", "opening", "nThreads",  "writeLeaflets", "offset",        "skirt",      "largestSpeed"});
  rho_.read(coeffs_);
  if (!(rho_.value() > 0)) {
    FatalIOErrorInFunction(coeffs_) << "rho is " << rho_.value() << ", and must be positive" << exit(FatalIOError);
  }
  UName_ = coeffs_.getOrDefault<word>("U", "U");
  pName_ = coeffs_.getOrDefault<word>("p", "p");
  phiName_ = coeffs_.getOrDefault<word>("phi", "phi");
  withVelocity_ = coeffs_.getOrDefault<Switch>("velocity", true);
  writeLeaflets_ = coeffs_.getOrDefault<Switch>("writeLeaflets", false);
  calibrate_ = coeffs_.getOrDefault<Switch>("calibrate", false);
  // The default of 50 m/s would need a pressure difference of about 10,000 mmHg. The jets of the narrowest valves have 6 m/s.
  largestSpeed_ = coeffs_.found("largestSpeed") ? positive(coeffs_, "largestSpeed") : 50;
  estimated_ = false;
  readFields(dict_);
  readFields(coeffs_);
  fieldNames_ = wordList(1, UName_);
  applied_.setSize(1, false);
  if (withVelocity_ && !KU_) {
    const IOobject io(IOobject::groupName("KU", name_), mesh_.time().timeName(), mesh_, IOobject::NO_READ,
                      IOobject::AUTO_WRITE);
    KU_.reset(new volVectorField(io, mesh_, dimensionedVector(dimDensity * dimVelocity / dimTime, Zero)));
  } else if (!withVelocity_) {
    KU_.clear();
  }

  kind_ = coeffs_.subDict("valve").get<word>("kind");
  valve_ = readValve(coeffs_.subDict("valve"), check);
  check(riis_surface_options_init(&placementAtRest_, sizeof placementAtRest_));
  const dictionary &placement = coeffs_.subDict("placement");
  refuseOthers(placement, {"scale", "rotationAxis", "rotationAngle", "translation", "flipNormals", "follow"});
  readPlacement(placement, placementAtRest_);
  follow_.reset(placement.found("follow") ? new riisFollow(mesh_, placement.subDict("follow")) : nullptr);
  halfThickness_ = dimensionedScalar("halfThickness", dimLength, coeffs_).value();
  placementAtRest_.half_thickness = halfThickness_;
  placementAtRest_.offset = coeffs_.getOrDefault<scalar>("offset", 0);
  // By default, the library uses one thread in each rank, because the solver does so.
  placementAtRest_.n_threads = coeffs_.getOrDefault<label>("nThreads", 1);
  readWarp(coeffs_.subOrEmptyDict("warp"));
  readSkirt(coeffs_.subOrEmptyDict("skirt"));
  follow();
  readLaw(coeffs_.subDict("opening"));
  surface_ = made<riis_surface>(
      [&](riis_surface **to) { check(riis_surface_create(valve_.get(), &placement_, to), coeffs_); });

  check(riis_mark_options_init(&markOptions_, sizeof markOptions_));
  markOptions_.n_threads = placement_.n_threads;
  markOptions_.fields = RIIS_FIELD_POINT | (withVelocity_ ? RIIS_FIELD_VELOCITY : 0);  // moments need the points
  readResistance(coeffs_, check, resistance_);
  if (resistance_.rim == RIIS_RIM_CUT) markOptions_.fields |= RIIS_FIELD_RIM;
}

// Reads the keys by which other options choose cells and fields. The leaflets choose the cells, so each key accepts only one
// value.
void riisValve::readFields(const dictionary &dict) const {
  const word mode = dict.getOrDefault<word>("selectionMode", "all");
  if (mode != "all") {
    FatalIOErrorInFunction(dict) << "selectionMode is '" << mode << "', and must be all: the leaflets choose the cells"
                                 << exit(FatalIOError);
  }
  const wordList fields = dict.getOrDefault<wordList>("fields", wordList(1, UName_));
  if (fields.size() != 1 || fields[0] != UName_) {
    FatalIOErrorInFunction(dict) << "fields is " << fields << ", and must be (" << UName_ << "), the velocity"
                                 << exit(FatalIOError);
  }
}

// Reads the landmarks of a warp. The sources lie on the valve. The targets are the sources' places in the mesh at rest.
void riisValve::readWarp(const dictionary &dict) {
  warp_.reset();
  warpMoves_ = dict.found("follow");
  if (dict.empty()) return;
  refuseOthers(dict, {"sources", "targets", "noise", "follow"});
  const pointField sources(dict.get<pointField>("sources"));
  targetsAtRest_ = dict.getOrDefault<pointField>("targets", sources);
  riis_warp_options options;
  check(riis_warp_options_init(&options, sizeof options));
  options.noise = dict.getOrDefault<scalar>("noise", 0);
  options.placement = &placementAtRest_;
  const riis_points points = pointsOf(sources);
  warp_ = made<riis_warp>([&](riis_warp **to) { check(riis_warp_create(&points, &options, to), dict); });
  if (warpMoves_) {
    if (follow_) {
      FatalIOErrorInFunction(dict) << "the warp of valve " << name_
                                   << " follows the mesh, and its placement does too. One of them "
                                   << "must rest" << exit(FatalIOError);
    }
    follow_.reset(new riisFollow(mesh_, dict.subDict("follow")));
    follow_->chooseNearest(targetsAtRest_, dict.subDict("follow"));
  }
  setWarp(targetsAtRest_, &dict);
}

// Returns the faces of a patch as triangles, in the mesh at rest. All ranks get the faces of all ranks.
riisPtr<riis_surface> riisValve::wallAtRest(const dictionary &dict) const {
  const word name = dict.get<word>("patch");
  const label at = mesh_.boundaryMesh().findPatchID(name);
  if (at < 0) {
    FatalIOErrorInFunction(dict) << "patch is '" << name << "', and the mesh has no such patch. Its patches are "
                                 << mesh_.boundaryMesh().names() << exit(FatalIOError);
  }
  const pointField points(pointsAtRest(mesh_));
  DynamicList<point> corners;
  for (const face &polygon : mesh_.boundaryMesh()[at]) {
    for (label i = 1; i + 1 < polygon.size(); ++i) {
      for (const label corner : {0, i, i + 1}) corners.append(points[polygon[corner]]);
    }
  }
  List<pointField> parts(Pstream::nProcs());
  parts[Pstream::myProcNo()] = pointField(corners);
  Pstream::gatherList(parts);
  pointField all;
  if (Pstream::master()) all = ListListOps::combine<pointField>(parts, accessOp<pointField>());
  giveToAll(all);
  if (all.empty()) FatalIOErrorInFunction(dict) << "the patch " << name << " has no faces" << exit(FatalIOError);
  const labelList ids(identity(all.size()));
  riis_surface_arrays arrays;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = all.size();
  arrays.x = all[0].cdata();
  arrays.y = all[0].cdata() + 1;
  arrays.z = all[0].cdata() + 2;
  arrays.stride = 3;
  arrays.n_faces = all.size() / 3;
  arrays.vertex_ids = ids.cdata();
  arrays.id_bits = 8 * sizeof(label);
  arrays.index_base = 0;
  arrays.real_bits = 8 * sizeof(scalar);
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  options.n_threads = placementAtRest_.n_threads;
  return made<riis_surface>(
      [&](riis_surface **to) { check(riis_surface_create_from_arrays(&arrays, &options, to), dict); });
}

// Gives the valve a skirt, which ends at a patch of the mesh at rest. Refuses a wall that is farther away than `longest` at any
// opening, because the attachment may move when the valve opens.
void riisValve::readSkirt(const dictionary &dict) {
  if (dict.empty()) return;
  refuseOthers(dict, {"patch", "longest"});
  constexpr int nOpenings = 11;
  constexpr scalar mostBeyond = 0.01;  // the gap is measured at other points than the skirt's length
  const scalar longest = positive(dict, "longest");
  const riisPtr<riis_surface> wall = wallAtRest(dict);
  check(riis_valve_set_skirt_to_wall(valve_.get(), wall.get(), longest, &placementAtRest_), dict);
  riis_gap widest = {};
  scalar widestAt = 0;
  for (int i = 0; i < nOpenings; ++i) {
    const scalar opening = scalar(i) / (nOpenings - 1);
    check(riis_valve_set_scalar(valve_.get(), "opening", opening));
    const riisPtr<riis_surface> surface = made<riis_surface>(
        [&](riis_surface **to) { check(riis_surface_create(valve_.get(), &placementAtRest_, to), coeffs_); });
    riis_gap gap;
    check(riis_surface_get_gap(surface.get(), wall.get(), nullptr, &gap, sizeof gap), dict);
    if (i > 0 && gap.most <= widest.most) continue;
    widest = gap;
    widestAt = opening;
  }
  if (widest.most > (1 + mostBeyond) * longest) {
    FatalIOErrorInFunction(dict) << "valve " << name_ << ": at the opening " << widestAt << " the gap to patch "
                                 << dict.get<word>("patch") << " is " << widest.most << " m at ("
                                 << widest.widest_point[0] << ' ' << widest.widest_point[1] << ' '
                                 << widest.widest_point[2] << "), and longest is " << longest << exit(FatalIOError);
  }
  Info << "riis " << name_ << ": the skirt ends at patch " << dict.get<word>("patch") << ", up to " << widest.most
       << " m away, at the opening " << widestAt << endl;
}

riis_points riisValve::pointsOf(const pointField &list) const {
  riis_points points;
  check(riis_points_init(&points, sizeof points));
  points.n_points = list.size();
  const double *xyz = list.empty() ? nullptr : list[0].cdata();
  points.x = xyz;
  points.y = xyz + 1;
  points.z = xyz + 2;
  points.stride = 3;
  return points;
}

// Warps the valve so that its landmarks come to the given places.
void riisValve::setWarp(const pointField &targets, const dictionary *dict) {
  const riis_points points = pointsOf(targets);
  const auto checked = [&](riis_status status) { dict ? check(status, *dict) : check(status); };
  checked(riis_warp_set_targets(warp_.get(), &points));
  checked(riis_valve_set_warp(valve_.get(), warp_.get(), nullptr));
}

// Moves the placement of the valve with the points of the mesh. A warp that follows points gets the part of the points' motion
// that is not rigid.
void riisValve::follow() {
  placement_ = placementAtRest_;
  if (!follow_) return;
  follow_->update();
  follow_->motion().place(placementAtRest_, placement_);
  if (warpMoves_) setWarp(follow_->deformed(targetsAtRest_), nullptr);
}

// Continues from the state in the folder of the start time. If the run starts for the first time, there is no state.
void riisValve::restart() {
  const bool found = state_.found("kind");
  if (returnReduce(found, orOp<bool>()) != returnReduce(found, andOp<bool>())) {
    FatalErrorInFunction << "valve " << name_ << " at time " << mesh_.time().timeName() << ": some ranks have "
                         << state_.IOobject::objectPath() << " and others lack it" << exit(FatalError);
  }
  const word law = coeffs_.subDict("opening").get<word>("law");
  if (found) {
    const word kind = state_.get<word>("kind"), lawBefore = state_.get<word>("law");
    if (kind != kind_ || lawBefore != law) {
      FatalIOErrorInFunction(state_) << "this state is that of a valve of kind " << kind << " with the law "
                                     << lawBefore << ", and valve " << name_ << " has kind " << kind_
                                     << " with the law " << law << exit(FatalIOError);
    }
    const dictionary before = state_.subDict("parameters"), now = parameters();
    for (const entry &parameter : now) {
      const word &name = parameter.keyword();
      const scalarList then = before.get<scalarList>(name), values = now.get<scalarList>(name);
      forAll(values, c) {
        if (c < then.size() && then[c] == values[c]) continue;
        FatalIOErrorInFunction(state_) << "this state is that of a valve whose " << name << " is " << then
                                       << ", and that of valve " << name_ << " is " << values[c] << exit(FatalIOError);
      }
    }
    opening_ = state_.get<scalar>("opening");
  }

  restartLaw(found);
  if (found) restartFactor();
  Info << "riis " << name_ << ": " << (found ? "continues" : "starts") << " at time " << mesh_.time().timeName()
       << " with opening " << opening_ << (found ? " from " : ", without ") << state_.IOobject::objectPath() << endl;
}

void riisValve::restartFactor() {
  if (!calibrate_ || !state_.found("factor")) return;
  if (state_.get<scalar>("resistance") != resistance_.R || state_.get<scalar>("halfThickness") != halfThickness_ ||
      state_.getOrDefault<scalar>("offset", 0) != placement_.offset)
    return;
  factor_ = state_.get<scalar>("factor");
  estimated_ = true;
  Info << "riis " << name_ << ": K is multiplied by " << factor_ << ", as before" << endl;
}

dictionary riisValve::parameters() const {
  dictionary found;
  int64_t n = 0;
  check(riis_valve_get_n_parameters(valve_.get(), &n));
  for (int64_t i = 0; i < n; ++i) {
    riis_parameter parameter;
    check(riis_valve_get_parameter(valve_.get(), i, &parameter, sizeof parameter));
    if (!strcmp(parameter.name, "opening")) continue;
    scalarList values(label(parameter.n_values));
    check(riis_valve_get(valve_.get(), parameter.name, values.size(), values.data()));
    // OpenFOAM itself would write a list with only six digits.
    tokenList tokens(values.size() + 2);
    tokens.first() = token(token::BEGIN_LIST);
    forAll(values, c) tokens[c + 1] = token(values[c]);
    tokens.last() = token(token::END_LIST);
    found.add(new primitiveEntry(parameter.name, std::move(tokens)));
  }
  return found;
}

void riisValve::keepState() {
  state_.clear();
  state_.add("kind", kind_);
  state_.add("law", coeffs_.subDict("opening").get<word>("law"));
  state_.add("opening", opening_);
  if (calibrate_ && estimated_) {
    state_.add("factor", factor_);
    state_.add("resistance", resistance_.R);
    state_.add("halfThickness", halfThickness_);
    state_.add("offset", placement_.offset);
  }
  keepLaw();
  state_.add("parameters", parameters());
}

riis_resistance riisValve::calibrated() const {
  riis_resistance resistance = resistance_;
  resistance.R *= factor_;
  return resistance;
}

riis_orifice riisValve::orifice() const {
  riis_orifice orifice;
  check(riis_surface_get_orifice(surface_.get(), &resistance_, &orifice, sizeof orifice));
  return orifice;
}

void riisValve::forces(const volVectorField &U, const vector &about, vectorField &force, vectorField &moment) const {
  riis_surface_info info;
  check(riis_surface_get_info(surface_.get(), &info, sizeof info));
  force.setSize(info.largest_leaflet_id + 1);
  moment.setSize(force.size());
  force = Zero;
  moment = Zero;
  riis_flow_arrays flow;
  check(riis_flow_arrays_init(&flow, sizeof flow));
  flow.n_nodes = mesh_.nCells();
  const double *velocity = U.primitiveField().empty() ? nullptr : U.primitiveField()[0].cdata();
  for (int c = 0; velocity && c < 3; ++c) flow.velocity[c] = velocity + c;
  flow.velocity_stride = 3;
  flow.weight = mesh_.V().field().cdata();
  riis_reaction reaction;
  check(riis_reaction_init(&reaction, sizeof reaction));
  copy(about, reaction.about);
  reaction.n_leaflets = force.size();
  reaction.leaflet_force = force[0].data();
  reaction.leaflet_moment = moment[0].data();
  const riis_resistance resistance = calibrated();
  check(riis_marks_add_reaction(result_.get(), &resistance, &flow, &reaction));
  addOverRanks(force);
  addOverRanks(moment);
}

// Moves the valve to its position at the end of the step, marks the cells, and computes K. The cells are marked once in a step,
// so that all outer correctors of the step use the same K.
void riisValve::mark() {
  const Time &time = mesh_.time();
  const riis_surface_options placementBefore = placement_;
  if (warpMoves_) check(riis_valve_set_warp(before_.get(), warp_.get(), nullptr));
  if (mesh_.changing()) {
    follow();
    placeCells(mesh_, check, cells_);
    if (hasSensors()) readSensors(coeffs_.subDict("opening"));
  }

  if (!estimated_) estimateDrop();
  OStringStream report;
  check(riis_valve_set_scalar(before_.get(), "opening", opening_));
  opening_ = openingAt(time.value(), report);
  check(riis_valve_set_scalar(valve_.get(), "opening", opening_));

  const auto start = std::chrono::steady_clock::now();
  if (withVelocity_) {
    check(riis_surface_update_moving(surface_.get(), valve_.get(), before_.get(), time.deltaTValue(), &placement_,
                                     &placementBefore));
  } else {
    check(riis_surface_update(surface_.get(), valve_.get(), &placement_));
  }
  check(riis_mark_nodes(surface_.get(), cells_.get(), &markOptions_, result_.get()));
  computeResistance(result_.get(), calibrated(), check, K_.primitiveFieldRef(),
                    withVelocity_ ? &KU_->primitiveFieldRef() : nullptr);
  const std::chrono::duration<scalar> seconds = std::chrono::steady_clock::now() - start;

  const label all = countMarked(result_.get(), surface_.get(), name_, mesh_, check);
  K_.correctBoundaryConditions();
  if (withVelocity_) KU_->correctBoundaryConditions();
  keepState();
  if (follow_) {
    report << ", turned by " << follow_->motion().degrees() << " degrees, points rigid to "
           << follow_->motion().residual() << " m";
  }
  const dimensionedScalar integral = gSum(K_.primitiveField() * mesh_.V().field());
  const scalar slowest = returnReduce(seconds.count(), maxOp<scalar>());
  Info << "riis " << name_ << ": opening " << opening_ << ", " << all << " cells marked, integral of K "
       << integral.value() << " kg/s, " << slowest << " s in the library" << report.str().c_str() << endl;
  if (writeLeaflets_ && time.writeTime() && Pstream::master()) writeLeaflets();
}

// Writes the leaflets with their velocity for ParaView.
void riisValve::writeLeaflets() const {
  const fileName folder = mesh_.time().globalPath() / "postProcessing" / name_ / mesh_.time().timeName();
  mkDir(folder);
  OFstream os(folder / "leaflets.vtk");
  os.precision(9);
  riis_triangles triangles;
  check(riis_surface_get_triangles(surface_.get(), &triangles, sizeof triangles));
  const int64_t nVertices = triangles.n_vertices, nTriangles = triangles.n_triangles;
  const double *xyz = triangles.xyz, *velocity = triangles.velocity;
  const int64_t *corners = triangles.vertex_id;
  os << "# vtk DataFile Version 3.0" << nl << "leaflets of " << name_ << nl << "ASCII" << nl << "DATASET POLYDATA" << nl
     << "POINTS " << label(nVertices) << " double" << nl;
  for (int64_t i = 0; i < nVertices; ++i) os << xyz[3 * i] << ' ' << xyz[3 * i + 1] << ' ' << xyz[3 * i + 2] << nl;
  os << "POLYGONS " << label(nTriangles) << ' ' << label(4 * nTriangles) << nl;
  for (int64_t i = 0; i < nTriangles; ++i) {
    os << "3 " << label(corners[3 * i]) << ' ' << label(corners[3 * i + 1]) << ' ' << label(corners[3 * i + 2]) << nl;
  }
  if (velocity) {
    os << "POINT_DATA " << label(nVertices) << nl << "VECTORS velocity double" << nl;
    for (int64_t i = 0; i < nVertices; ++i)
      os << velocity[3 * i] << ' ' << velocity[3 * i + 1] << ' ' << velocity[3 * i + 2] << nl;
  }
  if (!os.good()) FatalErrorInFunction << "cannot write " << os.name() << exit(FatalError);
}

void riisValve::addSup(fvMatrix<vector> &eqn, const label) {
  checkDimensions(eqn.dimensions(), eqn.psi().name(), name_, mesh_);
  if (timeIndex_ != mesh_.time().timeIndex()) {
    mark();
    timeIndex_ = mesh_.time().timeIndex();
  }
  eqn -= fvm::Sp(K_ / rho_, eqn.psi());
  if (withVelocity_) eqn += KU_() / rho_;
}

void riisValve::addSup(const volScalarField &, fvMatrix<vector> &eqn, const label) {
  FatalErrorInFunction
      << "valve " << name_ << " at time " << mesh_.time().timeName() << ": the equation of " << eqn.psi().name()
      << " is multiplied by a density. riisValve is for equations divided by a constant density, such as the "
      << "equations of pimpleFoam" << exit(FatalError);
}

// Ends a run that diverges, before the run writes a time with impossible speeds.
void riisValve::checkSpeed(const vectorField &U) const {
  scalar squared = -1;
  point fastest = vector::min;
  forAll(U, cell) {
    if (magSqr(U[cell]) <= squared) continue;
    squared = magSqr(U[cell]);
    fastest = mesh_.cellCentres()[cell];
  }
  const scalar most = returnReduce(squared, maxOp<scalar>());
  if (most <= sqr(largestSpeed_)) return;
  if (squared < most) fastest = vector::min;  // another rank has the fastest cell
  reduce(fastest, maxOp<vector>());
  FatalErrorInFunction << "valve " << name_ << " at time " << mesh_.time().timeName()
                       << ": the run diverges: the blood at " << fastest << " has " << std::sqrt(most)
                       << " m/s, and more than largestSpeed, " << largestSpeed_
                       << " m/s, cannot be: halve deltaT in system/controlDict, and start again from the beginning "
                       << "(in a case of riis patient: ./Allrun --fresh)" << exit(FatalError);
}

void riisValve::correct(volVectorField &U) {
  checkSpeed(U.primitiveField());
  vectorField force(K_.primitiveField() * U.primitiveField());
  if (withVelocity_) force -= KU_->primitiveField();
  const vector sum = gSum(vectorField(force * mesh_.V().field()));
  Info << "riis " << name_ << ": force of the flow " << sum << " N" << endl;
}

bool riisValve::read(const dictionary &dict) {
  if (dict == dict_) return true;
  const word before = coeffs_.subDict("opening").get<word>("law");
  dict_ = dict;
  coeffs_ = dict.optionalSubDict(modelType_ + "Coeffs");
  active_ = dict_.getOrDefault<Switch>("active", true);
  readAll();
  if (coeffs_.subDict("opening").get<word>("law") != before) {
    FatalIOErrorInFunction(dict) << "the law of valve " << name_ << " changed during the run: start again from time "
                                 << mesh_.time().timeName() << exit(FatalIOError);
  }
  copyValve();
  return true;
}

}  // namespace fv
}  // namespace Foam
