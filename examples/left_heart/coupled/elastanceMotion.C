// SPDX-License-Identifier: Apache-2.0
// Moves the wall of a ventricle by its elastance: the pressure of the blood on the wall equals E(t) (V - V0).
//
// elastanceMotion is a motion solver. In each outer corrector volumeSearch.H says which volume to try. The amplitude of the
// motion then gives the mesh this volume. elastance is an fvOption that adds nothing to the equations. This fvOption reads the
// pressure after each pressure equation. By the residual `elastance` in residualControl, it tells PIMPLE when the step is solved.
// elastanceTable is a function object that writes a row for each step.
//
// The pressure p does the work of the wall: it is the sum of p_f dV_f over the sum of dV_f. dV_f is the volume that the face f
// sweeps, relative to the base, if the amplitude grows. The work of the blood on the wall is therefore exactly the integral of p
// dV. It does not include the work of the descent of the whole heart.
#include "Function1.H"
#include "IOdictionary.H"
#include "OSspecific.H"
#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"
#include "fvMeshFunctionObject.H"
#include "fvOption.H"
#include "points0MotionSolver.H"
#include "solverPerformance.H"
#include "volFields.H"
#include "volumeSearch.H"
#include "wallMotion.H"
#include "writeFile.H"

namespace Foam {

// The state that a restart needs, as text with all digits: <time>/uniform/elastanceState.
class elastanceState : public IOdictionary {
 public:
  using IOdictionary::IOdictionary;
  bool writeObject(IOstream::streamFormat, IOstream::versionNumber version, IOstream::compressionType compression,
                   const bool valid) const override {
    return IOdictionary::writeObject(IOstream::ASCII, version, compression, valid);
  }
  bool writeData(Ostream &os) const override {
    const int digits = os.precision(17);
    const bool good = IOdictionary::writeData(os);
    os.precision(digits);
    return good;
  }
};

class elastanceMotion : public points0MotionSolver {
  const fvMesh &fvMesh_;
  wallMotion wall_;
  autoPtr<Function1<scalar>> elastance_;  // Pa/m3 over the phase
  scalar period_, phase_, unstressed_, rest_, rho_;
  volumeSearch search_;
  scalar amplitude_, descended_, meshAtRest_;  // the base has the amplitude descended_, that of the last step
  label timeIndex_;
  bool measured_;
  elastanceState state_;
  autoPtr<volScalarField> name_;  // PIMPLE looks for residuals of fields only

  // Returns the volume of the mesh at an amplitude, from its outer faces.
  scalar meshVolume(scalar amplitude) const {
    scalar volume = 0;
    for (const polyPatch &patch : mesh().boundaryMesh()) {
      if (patch.coupled()) continue;
      pointField points(patch.nPoints());
      forAll(points, i) points[i] = wall_.moved(points0_[patch.meshPoints()[i]], amplitude);
      for (const face &f : patch.localFaces()) volume += (f.centre(points) & f.areaNormal(points)) / 3;
    }
    return returnReduce(volume, sumOp<scalar>());
  }

  scalar cavity(scalar amplitude) const { return rest_ + meshVolume(amplitude) - meshAtRest_; }

  // Finds the amplitude for a volume by secants.
  void reach(scalar volume) {
    scalar before = amplitude_ + 1e-3, a = amplitude_, missBefore = cavity(before) - volume;
    for (int i = 0; i < 30; ++i) {
      const scalar miss = cavity(a) - volume;
      if (mag(miss) < 1e-13 * rest_ || miss == missBefore) {
        amplitude_ = a;
        return;
      }
      const scalar next = a - miss * (a - before) / (miss - missBefore);
      before = a;
      missBefore = miss;
      a = next;
    }
    FatalErrorInFunction << "the motion has no amplitude for the volume " << volume << " m3 at time "
                         << mesh().time().timeName() << exit(FatalError);
  }

  scalar elastanceAt(scalar time) const {
    const scalar beats = (time + phase_) / period_;
    return elastance_->value((beats - std::floor(beats)) * period_);
  }

  void keepState() {
    state_.clear();
    state_.add("volume", search_.volume);
    state_.add("flow", search_.flow);
    state_.add("pressure", search_.pressure);
    state_.add("slope", search_.slope);
    state_.add("echo", search_.echo);
    state_.add("fit", FixedList<scalar, 5>(search_.fit));
    state_.add("drift", search_.drift);
    state_.add("surprise", search_.largestSurprise());
    state_.add("amplitude", amplitude_);
    state_.add("descended", descended_);
  }

  void checkCase() const {
    const dictionary &pimple = fvMesh_.solutionDict().subDict("PIMPLE");
    if (!pimple.getOrDefault<bool>("moveMeshOuterCorrectors", false)) {
      FatalIOErrorInFunction(pimple)
          << "moveMeshOuterCorrectors is no, and elastanceMotion needs yes: each outer corrector "
          << "tries another volume" << exit(FatalIOError);
    }
  }

 public:
  TypeName("elastanceMotion");

  elastanceMotion(const polyMesh &mesh, const IOdictionary &dict)
      : points0MotionSolver(mesh, dict, typeName),
        fvMesh_(refCast<const fvMesh>(mesh)),
        wall_(coeffDict()),
        elastance_(Function1<scalar>::New("elastance", coeffDict())),
        period_(positive(coeffDict(), "period")),
        phase_(coeffDict().get<scalar>("phase")),
        unstressed_(coeffDict().get<scalar>("unstressedVolume")),
        rest_(positive(coeffDict(), "volume")),
        rho_(positive(coeffDict(), "rho")),
        amplitude_(0),
        descended_(0),
        meshAtRest_(0),
        timeIndex_(mesh.time().timeIndex()),
        measured_(false),
        state_(IOobject("elastanceState", mesh.time().timeName(), "uniform", mesh, IOobject::READ_IF_PRESENT,
                        IOobject::AUTO_WRITE)) {
    meshAtRest_ = meshVolume(0);
    search_.leastSlope = positive(coeffDict(), "leastSlope");
    search_.largestSlope = positive(coeffDict(), "largestSlope");
    if (search_.leastSlope >= search_.largestSlope) {
      FatalIOErrorInFunction(coeffDict())
          << "leastSlope is " << search_.leastSlope << ", and must be below largestSlope, which is "
          << search_.largestSlope << exit(FatalIOError);
    }
    search_.jump = positive(coeffDict(), "jump");
    search_.safeguards = coeffDict().getOrDefault<bool>("safeguards", true);
    const bool found = state_.found("volume");
    const auto kept = [&](const word &key, scalar value) { return found ? state_.get<scalar>(key) : value; };
    search_.volume = kept("volume", rest_);
    search_.flow = kept("flow", 0);
    search_.pressure = kept("pressure", elastanceAt(mesh.time().value()) * (rest_ - unstressed_));
    search_.slope = kept("slope", search_.largestSlope);
    search_.echo = kept("echo", 0);
    if (found) {
      const auto fit = state_.get<FixedList<scalar, 5>>("fit");
      std::copy(fit.begin(), fit.end(), search_.fit);
    }
    search_.drift = kept("drift", 0);
    search_.surprise = kept("surprise", 0);
    amplitude_ = kept("amplitude", 0);
    descended_ = kept("descended", 0);
    keepState();
    Info << "elastanceMotion: " << (found ? "continues" : "starts") << " with a volume of " << search_.volume
         << " m3 and a pressure of " << search_.pressure << " Pa" << endl;
  }

  tmp<pointField> curPoints() const override {
    tmp<pointField> points(new pointField(points0_));
    const vector descent = wall_.descent(descended_);
    for (point &p : points.ref()) p = wall_.deformed(p, amplitude_) - descent;
    return points;
  }

  void solve() override {
    const Time &time = mesh().time();
    if (time.timeIndex() != timeIndex_) {
      checkCase();
      timeIndex_ = time.timeIndex();
      // All trials of a step have the same base, because the valves follow the base and are marked once in a step.
      descended_ = amplitude_;
      reach(search_.begin(time.deltaTValue(), elastanceAt(time.value()), unstressed_));
    } else {
      if (!measured_) {
        FatalErrorInFunction << "fvOptions has no option of type elastance, which takes the pressure"
                             << exit(FatalError);
      }
      reach(search_.next());
    }
    measured_ = false;
    Info << "elastance: trial " << search_.trials << ", volume " << search_.volume << " m3, dV/dt " << search_.flow
         << " m3/s, Z " << search_.slope << " Pa s/m3" << endl;
  }

  // Computes the pressure on the wall from the field p.
  void measure(const volScalarField &p) {
    scalar work = 0, volume = 0;
    for (const fvPatchScalarField &values : p.boundaryField()) {
      const polyPatch &patch = values.patch().patch();
      if (patch.coupled()) continue;
      pointField more(patch.nPoints()), less(patch.nPoints());
      forAll(more, i) {
        const point &from = points0_[patch.meshPoints()[i]];
        more[i] = wall_.deformed(from, amplitude_ + 0.5e-3);
        less[i] = wall_.deformed(from, amplitude_ - 0.5e-3);
      }
      forAll(patch, i) {
        const face &f = patch.localFaces()[i];
        const scalar swept = (f.centre(more) - f.centre(less)) & values.patch().Sf()[i];
        work += values[i] * swept;
        volume += swept;
      }
    }
    reduce(work, sumOp<scalar>());
    reduce(volume, sumOp<scalar>());
    search_.measured(rho_ * work / volume);
    measured_ = true;
    keepState();
    if (!name_) {
      name_.reset(new volScalarField(
          IOobject("elastance", fvMesh_.time().timeName(), fvMesh_, IOobject::NO_READ, IOobject::NO_WRITE), fvMesh_,
          dimensionedScalar(dimless, Zero)));
    }
    const scalar residual = search_.miss();
    fvMesh_.setSolverPerformance("elastance", solverPerformance("elastanceMotion", "elastance", residual, residual));
  }

  const volumeSearch &search() const { return search_; }
  scalar amplitude() const { return amplitude_; }

  static elastanceMotion &of(const fvMesh &mesh) {
    elastanceMotion *found = mesh.getObjectPtr<elastanceMotion>("dynamicMeshDict");
    if (!found) {
      FatalErrorInFunction << "the motion solver of constant/dynamicMeshDict is not elastanceMotion"
                           << exit(FatalError);
    }
    return *found;
  }
};

defineTypeNameAndDebug(elastanceMotion, 0);
addToRunTimeSelectionTable(motionSolver, elastanceMotion, dictionary);

namespace fv {

class elastance : public option {
 public:
  TypeName("elastance");
  elastance(const word &name, const word &modelType, const dictionary &dict, const fvMesh &mesh)
      : option(name, modelType, dict, mesh) {
    fieldNames_ = wordList(1, "U");
    applied_.setSize(1, true);
    active_ = dict.getOrDefault<Switch>("active", true);
  }
  using option::correct;
  void correct(volVectorField &) override {
    elastanceMotion::of(mesh_).measure(mesh_.lookupObject<volScalarField>("p"));
  }
  bool read(const dictionary &) override { return true; }
};

defineTypeNameAndDebug(elastance, 0);
addToRunTimeSelectionTable(option, elastance, dictionary);

}  // namespace fv

namespace functionObjects {

class elastanceTable : public fvMeshFunctionObject, public writeFile {
 public:
  TypeName("elastanceTable");
  elastanceTable(const word &name, const Time &time, const dictionary &dict)
      : fvMeshFunctionObject(name, time, dict), writeFile(obr_, name, "elastance", dict) {
    read(dict);
  }
  bool read(const dictionary &dict) override { return fvMeshFunctionObject::read(dict) && writeFile::read(dict); }
  bool execute() override { return true; }
  bool write() override {
    if (mesh_.time().timeIndex() == mesh_.time().startTimeIndex() || !Pstream::master()) return true;
    if (!writtenHeader_) {
      writeHeader(file(), "The cavity, SI units");
      writeCommented(file(), "Time");
      for (const char *column :
           {"volume", "dVdt", "pressure", "wall_pressure", "residual", "slope", "trials", "amplitude"})
        writeTabbed(file(), column);
      file() << endl;
      writtenHeader_ = true;
    }
    const elastanceMotion &motion = elastanceMotion::of(mesh_);
    const volumeSearch &s = motion.search();
    writeCurrentTime(file());
    for (const scalar value : {s.volume, s.flow, s.pressure, s.wallPressure(), s.residual(), s.slope, scalar(s.trials),
                               motion.amplitude()}) {
      file() << token::TAB << value;
    }
    file() << endl;
    return true;
  }
};

defineTypeNameAndDebug(elastanceTable, 0);
addToRunTimeSelectionTable(functionObject, elastanceTable, dictionary);

}  // namespace functionObjects
}  // namespace Foam
