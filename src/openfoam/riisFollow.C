// SPDX-License-Identifier: Apache-2.0
#include "riisFollow.H"

#include "ListListOps.H"
#include "Pstream.H"
#include "labelIOList.H"
#include "pointIOField.H"
#include "riisValve.H"
#include "unitConversion.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Foam {
namespace fv {

namespace {

constexpr scalar leastGap = 1e-6;  // if the points' width is below about 1e-3 of their length, they do not fix a
                                   // rotation

using Matrix = std::array<std::array<scalar, 4>, 4>;

// Finds the eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations. Afterwards the matrix is diagonal. The
// columns of `vectors` are the eigenvectors.
void diagonalise(Matrix &a, Matrix &vectors) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) vectors[i][j] = i == j;
  }
  for (int sweep = 0; sweep < 50; ++sweep) {
    bool done = true;
    for (int p = 0; p < 3; ++p) {
      for (int q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0 || mag(a[p][q]) < 1e-20 * (mag(a[p][p]) + mag(a[q][q]))) continue;
        done = false;
        const scalar theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const scalar t = (theta < 0 ? -1 : 1) / (mag(theta) + std::sqrt(theta * theta + 1));
        const scalar c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 4; ++k) {
          const scalar kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 4; ++k) {
          const scalar pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        a[p][q] = a[q][p] = 0;
        for (int k = 0; k < 4; ++k) {
          const scalar kp = vectors[k][p], kq = vectors[k][q];
          vectors[k][p] = c * kp - s * kq;
          vectors[k][q] = s * kp + c * kq;
        }
      }
    }
    if (done) return;
  }
}

}  // namespace

// B. Horn, "Closed-form solution of absolute orientation using unit quaternions", J. Opt. Soc. Am. A 4 (1987): the rotation is
// the eigenvector of a 4 x 4 matrix for its largest eigenvalue.
riisRigid::riisRigid(const pointField &atRest, const pointField &now, scalar &gap) {
  gap = 0;
  const label n = atRest.size();
  if (n < 3) return;
  const point from = sum(atRest) / n, to = sum(now) / n;
  tensor s = Zero;
  forAll(atRest, i) s += (atRest[i] - from) * (now[i] - to);
  Matrix a = {{{{s.xx() + s.yy() + s.zz(), s.yz() - s.zy(), s.zx() - s.xz(), s.xy() - s.yx()}},
               {{0, s.xx() - s.yy() - s.zz(), s.xy() + s.yx(), s.zx() + s.xz()}},
               {{0, 0, -s.xx() + s.yy() - s.zz(), s.yz() + s.zy()}},
               {{0, 0, 0, -s.xx() - s.yy() + s.zz()}}}};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) a[i][j] = a[j][i];
  }
  Matrix vectors;
  diagonalise(a, vectors);
  int best = 0;
  for (int i = 1; i < 4; ++i) best = a[i][i] > a[best][best] ? i : best;
  scalar second = -GREAT;
  for (int i = 0; i < 4; ++i) second = i == best ? second : max(second, a[i][i]);
  if (!(a[best][best] > 0)) return;
  gap = (a[best][best] - second) / a[best][best];
  const scalar sign = vectors[0][best] < 0 ? -1 : 1;
  w_ = sign * vectors[0][best];
  v_ = sign * vector(vectors[1][best], vectors[2][best], vectors[3][best]);
  shift_ = to - turned(from);
  scalar squares = 0;
  forAll(atRest, i) squares += magSqr((*this)(atRest[i]) - now[i]);
  residual_ = std::sqrt(squares / n);
}

scalar riisRigid::degrees() const { return radToDeg(2 * std::atan2(mag(v_), w_)); }

void riisRigid::place(const riis_surface_options &atRest, riis_surface_options &now) const {
  now = atRest;
  const vector translation = (*this)(vector(atRest.translation[0], atRest.translation[1], atRest.translation[2]));
  for (direction c = 0; c < 3; ++c) now.translation[c] = translation[c];
  if (v_ == vector::zero) return;
  const vector axis(atRest.rotation_axis[0], atRest.rotation_axis[1], atRest.rotation_axis[2]);
  const scalar half = degToRad(atRest.rotation_angle) / 2, w = std::cos(half);
  const vector v = std::sin(half) / mag(axis) * axis;
  const vector sum = w_ * v + w * v_ + (v_ ^ v);
  const scalar length = mag(sum);
  now.rotation_angle = radToDeg(2 * std::atan2(length, w_ * w - (v_ & v)));
  for (direction c = 0; c < 3 && length > 0; ++c) now.rotation_axis[c] = sum[c] / length;
}

void riisRigid::share() {
  scalarList numbers({w_, v_.x(), v_.y(), v_.z(), shift_.x(), shift_.y(), shift_.z(), residual_});
  giveToAll(numbers);
  w_ = numbers[0];
  v_ = vector(numbers[1], numbers[2], numbers[3]);
  shift_ = vector(numbers[4], numbers[5], numbers[6]);
  residual_ = numbers[7];
}

riisFollow::riisFollow(const fvMesh &mesh, const dictionary &dict) : mesh_(mesh) {
  refuseOthers(dict, {"patch", "faceZone", "points"});
  if (dict.size() != 1) {
    FatalIOErrorInFunction(dict) << "follow has " << dict.size()
                                 << " of the keys patch, faceZone and points, and needs one" << exit(FatalIOError);
  }
  if (dict.found("points")) {
    readLabels(dict);
  } else if (dict.found("patch")) {
    const word patch = dict.get<word>("patch");
    const label at = mesh_.boundaryMesh().findPatchID(patch);
    if (at < 0) {
      FatalIOErrorInFunction(dict) << "patch is '" << patch << "', and the mesh has no such patch. Its patches are "
                                   << mesh_.boundaryMesh().names() << exit(FatalIOError);
    }
    readFaces(mesh_.boundaryMesh()[at].meshPoints(), " of patch " + patch);
  } else {
    const word zone = dict.get<word>("faceZone");
    const label at = mesh_.faceZones().findZoneID(zone);
    if (at < 0) {
      FatalIOErrorInFunction(dict) << "faceZone is '" << zone << "', and the mesh has no such zone. Its face zones are "
                                   << mesh_.faceZones().names() << exit(FatalIOError);
    }
    readFaces(mesh_.faceZones()[at]().meshPoints(), " of faceZone " + zone);
  }
  giveToAll(name_);
  fit(atRest_);  // refuses points that do not fix a rotation
}

// Returns the points of all ranks on the first rank. If order_ is set, the points are sorted by order_. Other ranks get an empty
// field.
pointField riisFollow::gathered(const pointField &points) const {
  List<pointField> parts(Pstream::nProcs());
  parts[Pstream::myProcNo()] = pointField(points, local_);
  Pstream::gatherList(parts);
  if (!Pstream::master()) return pointField();
  const pointField all(ListListOps::combine<pointField>(parts, accessOp<pointField>()));
  return order_.empty() ? all : pointField(all, order_);
}

pointField pointsAtRest(const fvMesh &mesh) {
  const pointIOField points(IOobject("points", mesh.time().constant(), polyMesh::meshSubDir, mesh, IOobject::MUST_READ,
                                     IOobject::NO_WRITE, false));
  if (points.size() != mesh.nPoints()) {
    FatalErrorInFunction << "the mesh in " << points.objectPath() << " has " << points.size()
                         << " points, and the present mesh " << mesh.nPoints()
                         << ": the valve is placed in that mesh, whose points must not become more or fewer"
                         << exit(FatalError);
  }
  return points;
}

// Takes the points of faces. The points are sorted by their coordinates at rest. Points with equal coordinates count as one
// point.
void riisFollow::readFaces(const labelList &points, const string &place) {
  local_ = points;
  const pointField all(gathered(pointsAtRest(mesh_)));
  if (!Pstream::master()) return;
  std::vector<label> order(all.size());
  forAll(all, i) order[i] = i;
  const auto isBefore = [&](label i, label j) {
    for (direction c = 0; c < 3; ++c) {
      if (all[i][c] != all[j][c]) return all[i][c] < all[j][c];
    }
    return false;
  };
  std::stable_sort(order.begin(), order.end(), isBefore);
  order.erase(std::unique(order.begin(), order.end(), [&](label i, label j) { return all[i] == all[j]; }), order.end());
  order_.setSize(order.size());
  std::copy(order.begin(), order.end(), order_.begin());
  atRest_ = pointField(all, order_);
  name_ = Foam::name(atRest_.size()) + " points" + place;
}

// Takes points by their labels in the undecomposed mesh. The points have the order of the list.
void riisFollow::readLabels(const dictionary &dict) {
  const labelList wanted(dict.get<labelList>("points"));
  name_ = Foam::name(wanted.size()) + " points";
  Map<label> place;  // the place of each wanted label in the list
  forAll(wanted, i) {
    if (!place.insert(wanted[i], i)) {
      FatalIOErrorInFunction(dict) << "points has " << wanted[i] << " twice" << exit(FatalIOError);
    }
  }
  labelList ids;
  if (Pstream::parRun()) {
    ids = labelIOList(IOobject("pointProcAddressing", mesh_.facesInstance(), polyMesh::meshSubDir, mesh_,
                               IOobject::MUST_READ, IOobject::NO_WRITE, false));
  } else {
    ids = identity(mesh_.nPoints());
  }
  List<labelList> places(Pstream::nProcs());
  labelList &mine = places[Pstream::myProcNo()];
  forAll(ids, point) {
    const auto found = place.cfind(ids[point]);
    if (!found.found()) continue;
    local_.append(point);
    mine.append(*found);
  }
  Pstream::gatherList(places);
  giveToAll(places);
  const labelList all(ListListOps::combine<labelList>(places, accessOp<labelList>()));
  labelList order(wanted.size(), -1);
  forAll(all, i) order[all[i]] = order[all[i]] < 0 ? i : order[all[i]];
  forAll(order, i) {
    if (order[i] < 0) {
      FatalIOErrorInFunction(dict) << "points has " << wanted[i] << ", and the mesh has no such point"
                                   << exit(FatalIOError);
    }
  }
  if (Pstream::master()) order_ = order;
  atRest_ = gathered(pointsAtRest(mesh_));
}

void riisFollow::chooseNearest(const pointField &places, const dictionary &dict) {
  if (dict.found("points")) {
    const label n = dict.get<labelList>("points").size();
    if (n == places.size()) return;
    FatalIOErrorInFunction(dict) << "points has " << n << " points, and the warp has " << places.size() << " landmarks"
                                 << exit(FatalIOError);
  }
  labelList chosen(places.size());
  scalar farthest = 0;
  if (Pstream::master()) {
    forAll(places, i) {
      label best = 0;
      forAll(atRest_, j) {
        if (magSqr(atRest_[j] - places[i]) < magSqr(atRest_[best] - places[i])) best = j;
      }
      chosen[i] = order_[best];
      farthest = max(farthest, mag(atRest_[best] - places[i]));
    }
  }
  giveToAll(chosen);
  // Each rank keeps the points that were chosen on it. The numbers of points on the ranks give the points' new places in the list
  // of all ranks' points.
  labelList sizes(Pstream::nProcs(), 0);
  sizes[Pstream::myProcNo()] = local_.size();
  Pstream::gatherList(sizes);
  giveToAll(sizes);
  labelList kept, order(places.size());
  label before = 0, place = 0;
  forAll(sizes, rank) {
    forAll(chosen, i) {
      const label at = chosen[i] - before;
      if (at < 0 || at >= sizes[rank]) continue;
      if (rank == Pstream::myProcNo()) kept.append(local_[at]);
      order[i] = place++;
    }
    before += sizes[rank];
  }
  local_ = kept;
  if (Pstream::master()) order_ = order;
  atRest_ = gathered(pointsAtRest(mesh_));
  Info << "riis: " << places.size() << " landmarks follow their nearest of " << name_.c_str() << ", up to " << farthest
       << " m away" << endl;
  name_ = Foam::name(places.size()) + " of " + name_;
  fit(atRest_);
}

void riisFollow::fit(const pointField &now) {
  scalar gap = 0;
  if (Pstream::master()) {
    motion_ = riisRigid(atRest_, now, gap);
    if (!(gap > leastGap)) {
      FatalErrorInFunction << "at time " << mesh_.time().timeName() << ": the valve follows " << name_.c_str()
                           << ", and needs at least 3 that do not lie on a line" << exit(FatalError);
    }
  }
  motion_.share();
}

void riisFollow::update() {
  if (mesh_.topoChanging()) {
    FatalErrorInFunction << "at time " << mesh_.time().timeName()
                         << ": the cells of the mesh change, and the valve follows " << name_.c_str()
                         << ": a valve cannot follow a mesh whose points become more or fewer" << exit(FatalError);
  }
  fit(gathered(mesh_.points()));
}

pointField riisFollow::deformed(const pointField &places) const {
  pointField found(gathered(mesh_.points()));
  forAll(found, i) found[i] = places[i] + motion_.turnedBack(found[i] - motion_(atRest_[i]));
  giveToAll(found);
  return found;
}

}  // namespace fv
}  // namespace Foam
