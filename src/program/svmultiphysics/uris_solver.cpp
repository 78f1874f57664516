// SPDX-License-Identifier: Apache-2.0
#include "program/svmultiphysics/uris_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/array_view.hpp"
#include "program/base/handles.hpp"
#include "program/base/refusal.hpp"
#include "program/mark/moving_valve.hpp"

namespace riis::program {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The share by which the solver widens its box on each side. The second number is the distance of nodes outside the box, in half
// thicknesses.
constexpr double widening = 0.1, far_in_half_thicknesses = 1e6;

// ---- The nearest middle of a triangle ----

// A tree over points. The tree finds the point nearest to a place. If several points are equally near, the tree finds the first
// of them.
class PointTree {
 public:
  explicit PointTree(std::vector<Vector3> points) : points_(std::move(points)), order_(points_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    split(0, order_.size(), 0);
  }

  std::size_t nearest(const Vector3 &to, double &distance) const {
    Search search{to, infinity, 0};
    visit(0, order_.size(), 0, search);
    distance = std::sqrt(search.squared);
    return search.found;
  }

 private:
  struct Search {
    Vector3 to;
    double squared;
    std::size_t found;
  };

  void split(std::size_t begin, std::size_t end, std::size_t axis) {
    if (end - begin < 2) return;
    const std::size_t middle = (begin + end) / 2;
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [this, axis](std::size_t a, std::size_t b) { return points_[a][axis] < points_[b][axis]; });
    split(begin, middle, (axis + 1) % 3);
    split(middle + 1, end, (axis + 1) % 3);
  }

  void visit(std::size_t begin, std::size_t end, std::size_t axis, Search &search) const {
    if (begin == end) return;
    const std::size_t middle = (begin + end) / 2, point = order_[middle], next = (axis + 1) % 3;
    const Vector3 away = search.to - points_[point];
    const double squared = dot(away, away);
    if (squared < search.squared || (squared == search.squared && point < search.found)) {
      search.squared = squared;
      search.found = point;
    }
    const bool is_below = away[axis] < 0;
    is_below ? visit(begin, middle, next, search) : visit(middle + 1, end, next, search);
    if (away[axis] * away[axis] <= search.squared)
      is_below ? visit(middle + 1, end, next, search) : visit(begin, middle, next, search);
  }

  std::vector<Vector3> points_;
  std::vector<std::size_t> order_;
};

// ---- The triangles of a frame ----

struct FrameTriangles {
  Box box = empty_box();  // as the solver widens it
  std::vector<Vector3> middles, normals;
  std::vector<Corners> corners;  // as vertices of the frame
};

FrameTriangles triangles_of(const UrisLeaflets &leaflets, const std::vector<double> &xyz) {
  FrameTriangles frame;
  for (const UrisLeaflet &leaflet : leaflets.leaflets()) {
    for (const std::int64_t vertex : leaflet.nodes) frame.box.grow(xyz.data() + 3 * vertex);
    for (const Corners &corners : leaflet.triangles) {
      const Corners of_frame{view(leaflet.nodes)[corners[0]], view(leaflet.nodes)[corners[1]],
                             view(leaflet.nodes)[corners[2]]};
      Vector3 middle = vertex_of(xyz, of_frame[0]) + vertex_of(xyz, of_frame[1]) + vertex_of(xyz, of_frame[2]);
      for (double &x : middle) x /= 3;
      frame.corners.push_back(of_frame);
      frame.middles.push_back(middle);
      frame.normals.push_back(twice_area(xyz, of_frame));
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double more = (frame.box.upper[k] - frame.box.lower[k]) * widening;
    frame.box.lower[k] -= more;
    frame.box.upper[k] += more;
  }
  return frame;
}

// ---- The mesh ----

double determinant(const double m[3][3]) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// If a tetrahedron or a wedge is inside out, the solver swaps its nodes 0 and 1. In a tetrahedron, the swap changes the sign of
// the determinant, but leaves the points and weights of integration as they are.
void turn_elements(SolverMesh &mesh, const std::string &path) {
  const SolverElement &element = *mesh.element;
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e) {
    const double volume = determinant_at(mesh, e, element.at_gauss[0]);
    if (volume > 0) continue;
    const std::string subject = path + ": volume element " + std::to_string(e);
    if (!(volume < 0)) refuse_data(subject + " has no volume");
    std::int64_t *const nodes = mesh.nodes.data() + e * static_cast<std::int64_t>(element.n_nodes);
    if (element.n_corners == 8) refuse_data(subject + " is inside out, and svMultiPhysics does not turn hexahedra");
    std::swap(nodes[0], nodes[1]);
    if (element.n_nodes == 6) std::swap(nodes[3], nodes[4]);
    if (element.n_nodes == 10) {
      std::swap(nodes[5], nodes[6]);
      std::swap(nodes[7], nodes[8]);
    }
  }
}

std::vector<double> node_volumes(const SolverMesh &mesh) {
  const SolverElement &element = *mesh.element;
  std::vector<double> volume;
  resize(volume, mesh.n_nodes);
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e) {
    for (std::size_t g = 0; g < element.gauss.size(); ++g) {
      const double determinant = determinant_at(mesh, e, element.at_gauss[g]);
      for (std::size_t a = 0; a < element.n_nodes; ++a)
        view(volume)[mesh.nodes_of(e)[a]] += element.gauss[g].weight * determinant * element.at_gauss[g].values[a];
    }
  }
  return volume;
}

}  // namespace

SolverMesh solver_mesh_of(const riis_vtk_mesh *file, const std::string &path, double to_solver) {
  SolverMesh mesh;
  std::int64_t n_cells = 0;
  const double *xyz = nullptr;
  check(riis_vtk_mesh_get_nodes(file, &mesh.n_nodes, &n_cells, &xyz));
  mesh.points.assign(xyz, xyz + 3 * mesh.n_nodes);
  for (double &x : mesh.points) x *= to_solver;
  std::vector<std::int64_t> offsets, nodes;
  std::vector<std::uint8_t> types;
  resize(offsets, n_cells + 1);
  resize(types, n_cells);
  check(riis_vtk_mesh_copy_cells(file, n_cells, offsets.data(), types.data(), 0, nullptr), path);
  resize(nodes, offsets.back());
  check(riis_vtk_mesh_copy_cells(file, n_cells, nullptr, nullptr, offsets.back(), nodes.data()), path);
  // The types of VTK for points, lines and faces. Points, lines and faces bound the volume, and the solver reads them from other
  // files.
  constexpr std::uint8_t without_volume[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 21, 22, 23, 28, 30, 34, 35, 36};
  for (std::int64_t i = 0; i < n_cells; ++i) {
    const std::uint8_t type = view(types)[i];
    if (std::count(std::begin(without_volume), std::end(without_volume), type) > 0) continue;
    const SolverElement *const element = solver_element_of(type);
    if (!element)
      refuse_data(path + ": cell " + std::to_string(i) + " has VTK's type " + std::to_string(type) +
                  ", and svMultiPhysics has only " + solver_element_names());
    if (mesh.element && element != mesh.element)
      refuse_data(path + ": has " + mesh.element->name + " and " + element->name +
                  ", but svMultiPhysics takes only one type of element in a mesh");
    mesh.element = element;
    mesh.nodes.insert(mesh.nodes.end(), nodes.data() + view(offsets)[i], nodes.data() + view(offsets)[i + 1]);
  }
  if (!mesh.element) refuse_data(path + ": has no volume cells, so nothing is computed in it");
  turn_elements(mesh, path);
  mesh.node_volume = node_volumes(mesh);
  return mesh;
}

double determinant_at(const SolverMesh &mesh, std::int64_t e, const ShapeFunctions &functions) {
  const std::int64_t *const nodes = mesh.nodes_of(e);
  double to[3][3] = {};  // first index: coordinate in space; second index: coordinate in the reference element
  for (std::size_t a = 0; a < mesh.element->n_nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        to[i][k] += mesh.xyz()[3 * nodes[a] + static_cast<std::int64_t>(i)] * functions.slopes[a][k];
  return determinant(to);
}

SolverDistances solver_distances(const SolverMesh &mesh, const UrisLeaflets &leaflets, const std::vector<double> &xyz,
                                 bool is_closing, double half_thickness, double margin) {
  SolverDistances distances;
  const double far = far_in_half_thicknesses * half_thickness;
  const FrameTriangles frame = triangles_of(leaflets, xyz);
  distances.box = frame.box.widened(margin);
  distances.to_leaflets.assign(static_cast<std::size_t>(mesh.n_nodes), far);
  distances.nearest.assign(static_cast<std::size_t>(mesh.n_nodes), -1);
  const PointTree middles(frame.middles);
  for (std::int64_t i = 0; i < mesh.n_nodes; ++i) {
    const Vector3 p = mesh.point(i);
    if (!distances.box.contains(p.data())) continue;
    ++distances.n_in_box;
    double distance = 0;
    const std::size_t nearest = middles.nearest(p, distance);
    const Vector3 off = p - frame.middles[nearest];
    const bool is_before = dot(off, frame.normals[nearest]) < 0 && (!is_closing || dot(off, leaflets.forward()) < 0);
    view(distances.to_leaflets)[i] = is_before ? -distance : distance;
    view(distances.nearest)[i] = static_cast<std::int64_t>(nearest);
  }
  return distances;
}

double delta_of(double distance, double half_thickness) {
  if (!(distance < half_thickness)) return 0;
  // In the solver, delta is periodic, so an interpolated distance below -eps belongs to another period.
  return (1 + sine_cosine(pi * distance / half_thickness).cosine) / (2 * half_thickness * half_thickness);
}

double interpolated_distance(const SolverMesh &mesh, std::int64_t e, const ShapeFunctions &at,
                             const std::vector<double> &distances) {
  double distance = 0;
  for (std::size_t a = 0; a < mesh.element->n_nodes; ++a)
    distance += at.values[a] * std::abs(view(distances)[mesh.nodes_of(e)[a]]);
  return distance;
}

double solver_delta(const SolverMesh &mesh, std::int64_t e, const ShapeFunctions &at, const SolverDistances &distances,
                    double half_thickness) {
  return delta_of(interpolated_distance(mesh, e, at, distances.to_leaflets), half_thickness);
}

SolverBand solver_band(const SolverMesh &mesh, const SolverDistances &distances, double from, double to,
                       const std::array<double, 3> &forward) {
  SolverBand band{0, 0, infinity, -infinity};
  for (std::int64_t i = 0; i < mesh.n_nodes; ++i) {
    const double distance = view(distances.to_leaflets)[i];
    if (!(distance >= from && distance <= to)) continue;
    const double place = dot(mesh.point(i), forward);
    ++band.n_nodes;
    band.volume += view(mesh.node_volume)[i];
    band.from = std::min(band.from, place);
    band.to = std::max(band.to, place);
  }
  return band;
}

SolverSpeeds solver_speeds(const SolverMesh &mesh, const UrisLeaflets &leaflets, const SolverDistances &distances,
                           const std::vector<double> &xyz, const std::vector<double> &before, double time_step,
                           double half_thickness) {
  SolverSpeeds speeds;
  const auto velocity_of = [&](std::int64_t vertex) {
    Vector3 v = vertex_of(xyz, vertex) - vertex_of(before, vertex);
    for (double &x : v) x /= time_step;
    return v;
  };
  const auto length = [](const Vector3 &v) { return std::sqrt(dot(v, v)); };
  for (const UrisLeaflet &leaflet : leaflets.leaflets())
    if (leaflet.name != "box")
      for (const std::int64_t vertex : leaflet.nodes)
        speeds.of_leaflets = std::max(speeds.of_leaflets, length(velocity_of(vertex)));
  const FrameTriangles frame = triangles_of(leaflets, xyz);
  for (std::int64_t i = 0; i < mesh.n_nodes; ++i) {
    if (!(std::abs(view(distances.to_leaflets)[i]) < half_thickness)) continue;
    const Corners &corners = view(frame.corners)[view(distances.nearest)[i]];
    const Vector3 a = vertex_of(xyz, corners[0]), u = vertex_of(xyz, corners[1]) - a,
                  v = vertex_of(xyz, corners[2]) - a, p = mesh.point(i) - a;
    // The component of p across the plane does not change the products, so p need not be projected.
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), pu = dot(p, u), pv = dot(p, v);
    const double xi = (vv * pu - uv * pv) / (uu * vv - uv * uv), eta = (uu * pv - uv * pu) / (uu * vv - uv * uv);
    const Vector3 velocity =
        (1 - xi - eta) * velocity_of(corners[0]) + xi * velocity_of(corners[1]) + eta * velocity_of(corners[2]);
    speeds.of_nodes = std::max(speeds.of_nodes, length(velocity));
  }
  return speeds;
}

double solver_area(const SolverMesh &mesh, const SolverDistances &distances, double half_thickness) {
  const SolverElement &element = *mesh.element;
  double integral = 0;
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e) {
    for (std::size_t g = 0; g < element.gauss.size(); ++g) {
      const double delta = solver_delta(mesh, e, element.at_gauss[g], distances, half_thickness);
      if (delta == 0) continue;
      integral += element.gauss[g].weight * determinant_at(mesh, e, element.at_gauss[g]) * delta;
    }
  }
  return half_thickness * integral;
}

std::vector<double> exact_distances(std::int64_t n_nodes, const double *xyz, const riis_surface *surface, double limit,
                                    std::int32_t n_threads) {
  std::vector<double> distances(static_cast<std::size_t>(n_nodes), infinity);
  const auto mesh = create<Mesh>(riis_mesh_create, n_nodes, xyz, xyz + 1, xyz + 2, 3);
  auto options = defaults<riis_mark_options>();
  options.distance_limit = limit;
  options.n_threads = n_threads;
  const Marks marks = marks_of(surface, mesh, options);
  const riis_mark_list list = list_of(marks, RIIS_LIST_WITHIN_LIMIT);
  for (std::int64_t i = 0; i < list.n_nodes; ++i) view(distances)[list.node_id[i]] = list.distance[i];
  return distances;
}

double exact_area(const SolverMesh &mesh, const riis_surface *surface, const std::vector<double> &near,
                  double half_thickness, std::int32_t n_threads, bool at_solver_points, double error) {
  const SolverElement &element = *mesh.element;
  const std::vector<ReferencePoint> &points = at_solver_points ? element.gauss : element.fine;
  const std::vector<ShapeFunctions> &functions = at_solver_points ? element.at_gauss : element.at_fine;
  // Most points of the elements near the band are outside the band, and the bound below finds them quickly. A point's distance
  // from the leaflets is at least a node's distance from the leaflets minus the distance between node and point.
  const double reach = (1 + 1e-6) * half_thickness + error;  // rounding changes less
  const auto excludes = [&](std::int64_t node, const Vector3 &point) {
    const Vector3 off = point - mesh.point(node);
    const double beyond = view(near)[node] - reach;
    return beyond > 0 && beyond < infinity && dot(off, off) < beyond * beyond;
  };
  // A linear element lies between its nodes. If one node shows that all other nodes are outside the band, the whole element is
  // outside the band.
  const bool is_linear = element.n_nodes == element.n_corners;
  std::vector<double> xyz, weights;
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e) {
    double nearest = infinity, size = 0;
    for (std::size_t a = 0; a < element.n_nodes; ++a) {
      const std::int64_t node = mesh.nodes_of(e)[a];
      nearest = std::min(nearest, view(near)[node]);
      size = std::max(size, norm(mesh.point(node) - mesh.point(mesh.nodes_of(e)[0])));
    }
    if (!(nearest <= half_thickness + 2 * size)) continue;
    const std::int64_t *const begin = mesh.nodes_of(e), *const end = begin + element.n_nodes;
    if (is_linear && std::any_of(begin, end, [&](std::int64_t node) {
          return std::all_of(begin, end, [&](std::int64_t other) { return excludes(node, mesh.point(other)); });
        }))
      continue;
    for (std::size_t g = 0; g < points.size(); ++g) {
      Vector3 point{};
      for (std::size_t a = 0; a < element.n_nodes; ++a) point = point + functions[g].values[a] * mesh.point(begin[a]);
      if (std::any_of(begin, end, [&](std::int64_t node) { return excludes(node, point); })) continue;
      weights.push_back(points[g].weight * determinant_at(mesh, e, functions[g]));
      xyz.insert(xyz.end(), point.begin(), point.end());
    }
  }
  if (weights.empty()) return 0;
  const std::vector<double> distances =
      exact_distances(static_cast<std::int64_t>(weights.size()), xyz.data(), surface, half_thickness, n_threads);
  double integral = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) integral += weights[i] * delta_of(distances[i], half_thickness);
  return half_thickness * integral;
}

std::optional<double> closed_area_in(const riis_vtk_mesh *file, const riis_surface *surface, std::int32_t n_threads,
                                     double error) {
  SolverMesh mesh;
  try {
    mesh = solver_mesh_of(file, "", 1);
  } catch (const Refusal &) {
    return std::nullopt;
  }
  const double half_thickness = info_of(surface).half_thickness;
  double largest = 0;
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e)
    for (std::size_t a = 1; a < mesh.element->n_nodes; ++a)
      largest = std::max(largest, norm(mesh.point(mesh.nodes_of(e)[a]) - mesh.point(mesh.nodes_of(e)[0])));
  const std::vector<double> near =
      exact_distances(mesh.n_nodes, mesh.xyz(), surface, half_thickness + 2 * largest, n_threads);
  return exact_area(mesh, surface, near, half_thickness, n_threads, false, error);
}

}  // namespace riis::program
