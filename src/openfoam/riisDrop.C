// SPDX-License-Identifier: Apache-2.0
// Estimates the drop across the closed valve in this mesh, and finds the factor of K for `calibrate yes`.
//
// A closed leaflet should have the pressure drop (R / eps) u, with u = flow / area of the leaflets. The drop in the mesh differs,
// because the solver interpolates 1/A to faces, which favours the cell with less resistance. The estimate gives the blood a
// pressure of 1 upstream of the closed valve and 0 downstream. Then it solves the solver's own equation of p with the schemes of
// the case: laplacian(1/A, p) = 0. The drop follows from the flow between the two sides. The two pressures are given at a
// distance from the band (endsOf). The flow is steady, so A is K / rho and has no term rho / dt. A contains neither convection
// nor viscosity, because they are small compared with K.
#include "boundBox.H"
#include "fvScalarMatrix.H"
#include "fvmLaplacian.H"
#include "regionSplit.H"
#include "riisValve.H"
#include "syncTools.H"
#include "volFields.H"
#include "zeroGradientFvPatchFields.H"

#include <vector>

namespace Foam {
namespace fv {

namespace {

constexpr scalar openShare = 1e-5;  // the resistance of blood outside the band, divided by the largest K
constexpr scalar leastShare = 0.2;  // calibration refuses a closed valve whose drop is a smaller share of (R / eps) u

// Returns -1 for each cell upstream of the closed band, and 1 for each cell downstream. Cells in the band get 0, and so do
// pockets that the band encloses. If the band does not separate the blood into two sides, all entries are 0. `middle` is the
// distance between the middle of the band and the leaflets.
labelList sidesOf(const fvMesh &mesh, const scalarField &K, const riis_mark_list &marked, scalar middle) {
  labelList band(mesh.nCells(), 0), bandBeyond;
  forAll(K, cell) band[cell] = K[cell] > 0;
  syncTools::swapBoundaryCellList(mesh, band, bandBeyond);
  boolList blocked(mesh.nFaces(), false);
  const labelUList &owner = mesh.faceOwner(), &neighbour = mesh.faceNeighbour();
  forAll(blocked, face) {
    const bool beyond = face < mesh.nInternalFaces() ? band[neighbour[face]] : bandBeyond[face - mesh.nInternalFaces()];
    blocked[face] = band[owner[face]] || beyond;
  }
  // Each cell of the band becomes a separate region. The other regions consist of open blood or of pockets.
  const regionSplit region(mesh, blocked, List<labelPair>(), true);
  labelList regionBeyond;
  syncTools::swapBoundaryCellList(mesh, region, regionBeyond);

  // A face between the band and another region lies on one side of the middle of the band. The face votes for this side with its
  // area.
  scalarField votes(region.nRegions(), 0), all(region.nRegions(), 0), volume(region.nRegions(), 0);
  labelList entry(mesh.nCells(), -1);
  for (int64_t i = 0; i < marked.n_nodes; ++i) {
    if (!marked.rim[i]) entry[marked.node_id[i]] = i;
  }
  const auto vote = [&](label cell, label other, label face) {
    const label i = entry[cell];
    if (i < 0) return;
    const vector away =
        mesh.faceCentres()[face] - vector(marked.point[3 * i], marked.point[3 * i + 1], marked.point[3 * i + 2]);
    const scalar along = away & vector(marked.normal[3 * i], marked.normal[3 * i + 1], marked.normal[3 * i + 2]);
    const scalar area = mag(mesh.faceAreas()[face]);
    votes[other] += along > middle ? area : -area;
    all[other] += area;
  };
  forAll(blocked, face) {
    const label here = owner[face];
    if (face < mesh.nInternalFaces()) {
      const label there = neighbour[face];
      if (band[here] && !band[there]) vote(here, region[there], face);
      if (band[there] && !band[here]) vote(there, region[here], face);
    } else if (band[here] && !bandBeyond[face - mesh.nInternalFaces()]) {
      vote(here, regionBeyond[face - mesh.nInternalFaces()], face);
    }
  }
  forAll(K, cell) {
    if (!band[cell]) volume[region[cell]] += mesh.V()[cell];
  }
  addOverRanks(votes);
  addOverRanks(all);
  addOverRanks(volume);

  // The two sides are the largest regions whose votes are clearly for one side. Together the two regions contain most of the
  // blood, because pockets are small.
  label up = -1, down = -1;
  forAll(volume, i) {
    if (votes[i] < -0.5 * all[i] && (up < 0 || volume[i] > volume[up])) up = i;
    if (votes[i] > 0.5 * all[i] && (down < 0 || volume[i] > volume[down])) down = i;
  }
  labelList side(mesh.nCells(), 0);
  if (up < 0 || down < 0 || volume[up] + volume[down] < 0.5 * sum(volume)) return side;
  forAll(side, cell) side[cell] = region[cell] == up ? -1 : region[cell] == down ? 1 : 0;
  return side;
}

// Chooses the cells on both sides that keep the pressure 1 or 0. Between the chosen cells and the band there are more than four
// cells, or fewer if the mesh ends sooner. If an edge between cell centres is not orthogonal to its face, the solver corrects the
// flow by the gradient in the cells. Beside the band, the correction includes the gradient in the band. The pressure beside the
// band must therefore be free to balance the correction.
boolList endsOf(const fvMesh &mesh, const scalarField &K, const labelList &side) {
  constexpr label most = 4;
  labelList layer(mesh.nCells(), most + 1), beyond;
  forAll(K, cell) layer[cell] = K[cell] > 0 ? 0 : most + 1;
  for (label now = 1; now <= most; ++now) {
    syncTools::swapBoundaryCellList(mesh, layer, beyond);
    const labelList before(layer);
    forAll(mesh.faceOwner(), face) {
      const label here = mesh.faceOwner()[face];
      if (face < mesh.nInternalFaces()) {
        const label there = mesh.faceNeighbour()[face];
        if (before[here] == now - 1) layer[there] = min(layer[there], now);
        if (before[there] == now - 1) layer[here] = min(layer[here], now);
      } else if (beyond[face - mesh.nInternalFaces()] == now - 1) {
        layer[here] = min(layer[here], now);
      }
    }
  }
  label deepest[2] = {0, 0};
  forAll(side, cell) {
    if (side[cell] != 0) deepest[side[cell] > 0] = max(deepest[side[cell] > 0], layer[cell]);
  }
  reduce(deepest[0], maxOp<label>());
  reduce(deepest[1], maxOp<label>());
  const label limit = min(deepest[0], deepest[1]) - 1;
  boolList isEnd(mesh.nCells(), false);
  forAll(side, cell) isEnd[cell] = side[cell] != 0 && layer[cell] > limit;
  return isEnd;
}

// Returns the part of the closed area that lies in this rank's cells (docs/theory/measures.md, "Closed area"). Triangles are cut
// into parts whose edges are below a quarter of the half thickness. If the middle of a part lies in this rank's cells, the part
// counts. On the normal through the middle, eight points stand for equal shares of the integral of K across the band. The band
// lies beside the leaflet by the offset, in half thicknesses. If another leaflet is nearer to a point, the point's share belongs
// to the other leaflet. Leaflets that touch thus count only once. The leaflet with the id leftOut does not count.
template <class Check>
scalar closedArea(const polyMesh &mesh, const riis_surface *surface, scalar halfThickness, scalar offset,
                  int32_t leftOut, int32_t nThreads, const Check &check) {
  struct Part {
    point a, b, c;
  };
  // The distances x, in half thicknesses, for which x + sin(pi x) / pi is 1/8, 3/8, 5/8 and 7/8.
  constexpr scalar places[] = {0.0627, 0.1933, 0.3441, 0.5629};
  constexpr scalar share = 1.0 / 8;
  (void)mesh.tetBasePtIs();  // all ranks must make these points together
  if (mesh.nCells() == 0) return 0;
  riis_triangles triangles;
  check(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  const boundBox box(mesh.points(), false);
  const auto isInside = [&](const point &at) { return mesh.findCell(at, polyMesh::CELL_TETS) >= 0; };
  const auto corner = [&](int64_t vertex) {
    return point(triangles.xyz[3 * vertex], triangles.xyz[3 * vertex + 1], triangles.xyz[3 * vertex + 2]);
  };
  std::vector<point> samples;
  std::vector<scalar> heights, areas;
  std::vector<Part> parts;
  for (int64_t i = 0; i < triangles.n_triangles; ++i) {
    if (triangles.leaflet_id[i] == leftOut) continue;
    const int64_t *ids = triangles.vertex_id + 3 * i;
    parts.push_back({corner(ids[0]), corner(ids[1]), corner(ids[2])});
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      const point &a = part.a, &b = part.b, &c = part.c;
      boundBox around(a, a);
      around.add(b);
      around.add(c);
      if (!around.overlaps(box)) continue;
      if (max(mag(b - a), max(mag(c - b), mag(a - c))) < halfThickness / 4) {
        const point middle = (a + b + c) / 3;
        const vector twice = (b - a) ^ (c - a);
        if (mag(twice) == 0 || !isInside(middle)) continue;
        for (const scalar place : places) {
          for (const scalar height : {(offset + place) * halfThickness, (offset - place) * halfThickness}) {
            samples.push_back(middle + height / mag(twice) * twice);
            heights.push_back(mag(height));
            areas.push_back(share * mag(twice) / 2);
          }
        }
        continue;
      }
      const point ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
      parts.push_back({a, ab, ca});
      parts.push_back({ab, b, bc});
      parts.push_back({ca, bc, c});
      parts.push_back({ab, bc, ca});
    }
  }
  if (samples.empty()) return 0;
  const double *xyz = samples[0].cdata();
  const riisPtr<riis_mesh> nodes =
      made<riis_mesh>([&](riis_mesh **to) { check(riis_mesh_create(samples.size(), xyz, xyz + 1, xyz + 2, 3, to)); });
  riis_mark_options options;
  check(riis_mark_options_init(&options, sizeof options));
  options.distance_limit = (1 + mag(offset)) * halfThickness;
  options.n_threads = nThreads;
  const riisPtr<riis_marks> marks = made<riis_marks>([&](riis_marks **to) { check(riis_marks_create(to)); });
  check(riis_mark_nodes(surface, nodes.get(), &options, marks.get()));
  riis_mark_list list;
  check(riis_marks_get_list(marks.get(), RIIS_LIST_WITHIN_LIMIT, &list, sizeof list));
  scalar area = 0;
  for (int64_t i = 0; i < list.n_nodes; ++i) {
    const int64_t sample = list.node_id[i];
    if (list.distance[i] > 0.99 * heights[sample]) area += areas[sample];
  }
  return area;
}

// Returns the area of all leaflets except the leaflet leftOut.
template <class Check>
scalar areaOf(const riis_surface *surface, int32_t leftOut, const Check &check) {
  int64_t n = 0;
  check(riis_surface_get_n_leaflets(surface, &n));
  scalar area = 0;
  for (int64_t i = 0; i < n; ++i) {
    riis_leaflet leaflet;
    check(riis_surface_get_leaflet(surface, i, &leaflet, sizeof leaflet));
    if (leaflet.leaflet_id != leftOut) area += leaflet.area;
  }
  return area;
}

// Returns whether the case has a scheme with this name, or a default.
bool hasScheme(const dictionary &schemes, const word &name) {
  return schemes.found(name) || (schemes.found("default") && word(schemes.lookup("default")) != "none");
}

}  // namespace

// Returns the flow in m3/s from the upstream to the downstream side. The difference of the kinematic pressure is 1 m2/s2.
scalar riisValve::conductance(const scalarField &K, const labelList &side, const boolList &isEnd) const {
  const word step = mesh_.time().timeName();
  volScalarField rAU(IOobject("(1|A(" + UName_ + "))", step, mesh_, IOobject::NO_READ, IOobject::NO_WRITE, false),
                     mesh_, dimensionedScalar(dimTime, Zero));
  rAU.primitiveFieldRef() = rho_.value() / max(K, openShare * gMax(K));
  rAU.correctBoundaryConditions();
  // The field has the solver's name of p, so that it is solved by the case's schemes for p. The field is not registered.
  volScalarField p(IOobject(pName_, step, mesh_, IOobject::NO_READ, IOobject::NO_WRITE, false), mesh_,
                   dimensionedScalar(sqr(dimVelocity), Zero), zeroGradientFvPatchScalarField::typeName);
  DynamicList<label> fixed;
  DynamicList<scalar> pressures;
  forAll(side, cell) {
    if (side[cell] == 0) continue;
    p[cell] = side[cell] < 0 ? 1 : 0;
    if (!isEnd[cell]) continue;
    fixed.append(cell);
    pressures.append(p[cell]);
  }
  p.correctBoundaryConditions();
  dictionary controls;
  controls.add("solver", "PCG");
  controls.add("preconditioner", "DIC");
  controls.add("tolerance", 1e-10);
  controls.add("relTol", 0);
  controls.add("maxIter", 10000);

  scalar flow = 0;
  for (int corrector = 0; corrector < 30; ++corrector) {
    fvScalarMatrix equation(fvm::laplacian(rAU, p));
    if (corrector > 0) {
      const scalarField out((equation & p)().primitiveField() * mesh_.V().field());
      scalar before = flow;
      flow = 0;
      forAll(side, cell) flow -= side[cell] < 0 && isEnd[cell] ? out[cell] : 0;
      reduce(flow, sumOp<scalar>());
      if (mag(flow - before) < 5e-4 * mag(flow)) break;  // the corrections for non-orthogonal edges have converged
    }
    equation.setValues(fixed, pressures);
    // fvMatrix::solve is not used, because it would add its residuals to those of the solver's own p.
    scalarField &diagonal = equation.diag();
    forAll(equation.internalCoeffs(), patch) {
      const labelUList &cells = mesh_.boundary()[patch].faceCells();
      forAll(cells, i) diagonal[cells[i]] += equation.internalCoeffs()[patch][i];
    }
    // setValues removes the coefficients between a fixed cell and the cells of other ranks. A cell whose neighbours are all on
    // other ranks thus loses its diagonal coefficient.
    forAll(fixed, i) {
      const label cell = fixed[i];
      if (diagonal[cell] != 0) continue;
      diagonal[cell] = -rAU[cell] * cbrt(mesh_.V()[cell]);
      equation.source()[cell] = diagonal[cell] * pressures[i];
    }
    lduMatrix::solver::New(pName_, equation, equation.boundaryCoeffs(), equation.internalCoeffs(),
                           p.boundaryField().scalarInterfaces(), controls)
        ->solve(p.primitiveFieldRef(), equation.source());
    p.correctBoundaryConditions();
  }
  return flow;
}

// Logs the drop of the closed valve divided by (R / eps) u. With `calibrate yes`, also finds the factor of K with which the drop
// is (R / eps) u.
void riisValve::estimateDrop() {
  estimated_ = true;
  factor_ = 1;
  const auto without = [&](const char *reason) {
    if (calibrate_) {
      FatalIOErrorInFunction(coeffs_) << "calibrate is yes, but " << reason << exit(FatalIOError);
    }
    Info << "riis " << name_ << ": no estimate of the closed valve's drop: " << reason << endl;
  };
  if (resistance_.R == 0) return without("resistance is 0");
  if (!hasScheme(mesh_.schemesDict().subOrEmptyDict("laplacianSchemes"),
                 "laplacian((1|A(" + UName_ + "))," + pName_ + ")")) {
    return without("fvSchemes has no laplacian of p");
  }

  check(riis_valve_set_scalar(valve_.get(), "opening", 0));
  check(riis_surface_update(surface_.get(), valve_.get(), &placement_));
  riis_mark_options options = markOptions_;
  options.fields = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_RIM;
  const riisPtr<riis_marks> marks = made<riis_marks>([&](riis_marks **to) { check(riis_marks_create(to)); });
  check(riis_mark_nodes(surface_.get(), cells_.get(), &options, marks.get()));
  riis_mark_list list;
  check(riis_marks_get_list(marks.get(), RIIS_LIST_MARKED, &list, sizeof list));
  scalarField K(mesh_.nCells());
  computeResistance(marks.get(), resistance_, check, K, nullptr);
  const labelList side = sidesOf(mesh_, K, list, placement_.offset * halfThickness_);
  if (!returnReduce(gMax(mag(scalarField(K))()) > 0 && side.found(-1), orOp<bool>())) {
    return without("blood passes the closed band in this mesh");
  }
  const boolList isEnd = endsOf(mesh_, K, side);
  riis_surface_info info;
  check(riis_surface_get_info(surface_.get(), &info, sizeof info));
  const int32_t housing = info.housing_leaflet_id;
  scalar area = returnReduce(
      closedArea(mesh_, surface_.get(), halfThickness_, placement_.offset, housing, placement_.n_threads, check),
      sumOp<scalar>());
  if (placement_.offset != 0) {
    // The middle of the band, through which blood passes, has another area than the leaflets. The library's ideal leak uses the
    // area of the band's middle.
    double leak = 0;
    check(riis_surface_get_leak(surface_.get(), &resistance_, 1, &leak));
    area *= leak * resistance_.R / halfThickness_ / areaOf(surface_.get(), housing, check);
  }

  // A flow of 1 should have the drop R / (eps area). In the mesh, a flow of 1 has the drop rho / conductance.
  const auto share = [&](scalar factor) {
    return rho_.value() / conductance(scalarField(factor * K), side, isEnd) / (resistance_.R / (halfThickness_ * area));
  };
  const scalar expected = share(1);
  if (calibrate_) {
    if (!(expected > leastShare)) {
      FatalIOErrorInFunction(coeffs_) << "calibrate is yes, but the closed valve drops only " << expected
                                      << " of (R / eps) u in this mesh, and must drop at least " << leastShare
                                      << ": halfThickness " << halfThickness_ << " is too small for these cells"
                                      << exit(FatalIOError);
    }
    // The drop is nearly proportional to K.
    scalar now = expected;
    for (int i = 0; i < 5 && mag(now - 1) > 1e-3; ++i) {
      factor_ /= now;
      now = share(factor_);
    }
  }
  Info << "riis " << name_ << ": the closed valve has " << area << " m2 in the mesh, and is expected to drop "
       << expected << " of (R / eps) u, u = flow / area";
  if (calibrate_) Info << ". K is multiplied by " << factor_;
  Info << endl;
}

}  // namespace fv
}  // namespace Foam
