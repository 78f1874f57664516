// SPDX-License-Identifier: Apache-2.0
#include "program/svmultiphysics/uris_solver.hpp"

#include <algorithm>
#include <cmath>

namespace riis::program {
namespace {

using Coordinates = std::array<double, 3>;

enum class Shape { tetrahedron, wedge, hexahedron };

// ---- Shape functions ----

struct Value {
  double value;
  Coordinates slope;
};

Value product(const Value &a, const Value &b) {
  Value c{a.value * b.value, {}};
  for (std::size_t k = 0; k < 3; ++k) c.slope[k] = a.slope[k] * b.value + a.value * b.slope[k];
  return c;
}

// The four barycentric coordinates of a tetrahedron. The last node is the origin of the reference element, as in the solver.
std::array<Value, 4> tetrahedron_coordinates(const Coordinates &at) {
  return {{{at[0], {1, 0, 0}}, {at[1], {0, 1, 0}}, {at[2], {0, 0, 1}}, {1 - at[0] - at[1] - at[2], {-1, -1, -1}}}};
}

// The two corners beside each middle node of a quadratic tetrahedron.
constexpr std::size_t edges_of_tetrahedron[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

Value tetrahedron_shape(std::size_t n_nodes, std::size_t node, const Coordinates &at) {
  const std::array<Value, 4> of = tetrahedron_coordinates(at);
  if (n_nodes == 4) return of[node];
  if (node < 4) {
    const double l = of[node].value;
    Value corner{l * (2 * l - 1), of[node].slope};
    for (double &slope : corner.slope) slope *= 4 * l - 1;
    return corner;
  }
  Value middle = product(of[edges_of_tetrahedron[node - 4][0]], of[edges_of_tetrahedron[node - 4][1]]);
  middle.value *= 4;
  for (double &slope : middle.slope) slope *= 4;
  return middle;
}

Value wedge_shape(std::size_t node, const Coordinates &at) {
  const Value in_triangle[3] = {{at[0], {1, 0, 0}}, {at[1], {0, 1, 0}}, {1 - at[0] - at[1], {-1, -1, 0}}};
  const double sign = node < 3 ? -1 : 1;
  return product(in_triangle[node % 3], {(1 + sign * at[2]) / 2, {0, 0, sign / 2}});
}

Value linear(double place, double x, std::size_t k) {
  Value v{1 + place * x, {}};
  v.slope[k] = place;
  return v;
}

Value quadratic(double place, double x, std::size_t k) {
  Value v{place == 0 ? 1 - x * x : x * (x + place) / 2, {}};
  v.slope[k] = place == 0 ? -2 * x : x + place / 2;
  return v;
}

Value hexahedron_shape(std::size_t n_nodes, const Coordinates &node, const Coordinates &at) {
  Value v{1, {}};
  if (n_nodes == 27) {
    for (std::size_t k = 0; k < 3; ++k) v = product(v, quadratic(node[k], at[k], k));
    return v;
  }
  // In a hexahedron with 20 nodes, the shape function of a middle node has the factor (1 - x^2) along the node's edge. The shape
  // function of a corner has one more factor than the other functions.
  bool is_middle = false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (node[k] != 0) {
      v = product(v, linear(node[k], at[k], k));
      continue;
    }
    is_middle = true;
    Value along{1 - at[k] * at[k], {}};
    along.slope[k] = -2 * at[k];
    v = product(v, along);
  }
  if (n_nodes == 20 && !is_middle) v = product(v, {node[0] * at[0] + node[1] * at[1] + node[2] * at[2] - 2, node});
  const double share = is_middle ? 0.25 : 0.125;
  v.value *= share;
  for (double &slope : v.slope) slope *= share;
  return v;
}

ShapeFunctions shapes_at(Shape shape, const std::vector<Coordinates> &nodes, const Coordinates &at) {
  ShapeFunctions functions;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const Value v = shape == Shape::tetrahedron ? tetrahedron_shape(nodes.size(), a, at)
                    : shape == Shape::wedge     ? wedge_shape(a, at)
                                                : hexahedron_shape(nodes.size(), nodes[a], at);
    functions.values.push_back(v.value);
    functions.slopes.push_back(v.slope);
  }
  return functions;
}

// ---- Nodes ----

std::vector<Coordinates> tetrahedron_nodes(std::size_t n) {
  std::vector<Coordinates> nodes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  if (n == 4) return nodes;
  for (const auto &edge : edges_of_tetrahedron) {
    const Coordinates a = nodes[edge[0]], b = nodes[edge[1]];
    nodes.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
  }
  return nodes;
}

std::vector<Coordinates> wedge_nodes() { return {{1, 0, -1}, {0, 1, -1}, {0, 0, -1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 1}}; }

std::vector<Coordinates> hexahedron_nodes(std::size_t n) {
  std::vector<Coordinates> nodes = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},  // corners
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1},   //
                                    {0, -1, -1},  {1, 0, -1},  {0, 1, -1}, {-1, 0, -1},  // middles of edges below
                                    {0, -1, 1},   {1, 0, 1},   {0, 1, 1},  {-1, 0, 1},   // above
                                    {-1, -1, 0},  {1, -1, 0},  {1, 1, 0},  {-1, 1, 0},   // upright
                                    {-1, 0, 0},   {1, 0, 0},   {0, -1, 0}, {0, 1, 0},    // middles of faces
                                    {0, 0, -1},   {0, 0, 1},   {0, 0, 0}};
  nodes.resize(n);
  return nodes;
}

// ---- Points of integration ----

// Returns the solver's four or fifteen points of integration in a tetrahedron.
std::vector<ReferencePoint> tetrahedron_gauss(std::size_t n_nodes) {
  if (n_nodes == 4) {
    const double t = (5 - std::sqrt(5.0)) / 20, s = 1 - 3 * t, w = 1.0 / 24;
    return {{{s, t, t}, w}, {{t, s, t}, w}, {{t, t, s}, w}, {{t, t, t}, w}};
  }
  std::vector<ReferencePoint> points = {{{0.25, 0.25, 0.25}, 0.030283678097089}};
  const auto add_four = [&points](double s, double t, double w) {
    points.push_back({{t, s, s}, w});
    points.push_back({{s, t, s}, w});
    points.push_back({{s, s, t}, w});
    points.push_back({{s, s, s}, w});
  };
  add_four(1.0 / 3, 0, 0.006026785714286);
  add_four(1.0 / 11, 8.0 / 11, 0.011645249086029);
  const double s = 0.066550153573664, t = 0.433449846426336, w = 0.010949141561386;
  for (const Coordinates &at : {Coordinates{s, s, t}, {s, t, s}, {s, t, t}, {t, t, s}, {t, s, t}, {t, s, s}})
    points.push_back({at, w});
  return points;
}

std::vector<ReferencePoint> wedge_gauss() {
  std::vector<ReferencePoint> points;
  const double s = 2.0 / 3, t = 1.0 / 6, w = 1.0 / 6;
  for (const double z : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)})
    for (const auto &[x, y] : {std::array<double, 2>{s, t}, {t, s}, {t, t}}) points.push_back({{x, y, z}, w});
  return points;
}

struct LinePoint {
  double at, weight;  // between -1 and 1
};

std::vector<LinePoint> line_gauss(int n) {
  if (n == 2) return {{-1 / std::sqrt(3.0), 1}, {1 / std::sqrt(3.0), 1}};
  if (n == 3) return {{-std::sqrt(0.6), 5.0 / 9}, {0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}};
  const double r = std::sqrt(1.2), a = std::sqrt((3 - 2 * r) / 7), b = std::sqrt((3 + 2 * r) / 7);
  const double v = (18 + std::sqrt(30.0)) / 36, w = (18 - std::sqrt(30.0)) / 36;
  return {{-b, w}, {-a, v}, {a, v}, {b, w}};
}

std::vector<ReferencePoint> hexahedron_gauss(int n_along) {
  std::vector<ReferencePoint> points;
  const std::vector<LinePoint> line = line_gauss(n_along);
  for (const LinePoint &z : line)
    for (const LinePoint &y : line)
      for (const LinePoint &x : line) points.push_back({{x.at, y.at, z.at}, x.weight * y.weight * z.weight});
  return points;
}

// Returns points of integration in a cube, a tetrahedron or a wedge. The points of a tetrahedron or a wedge are those of a cube
// whose sides are collapsed.
std::vector<ReferencePoint> fine_points(Shape shape) {
  std::vector<ReferencePoint> points = hexahedron_gauss(4);
  if (shape == Shape::hexahedron) return points;
  for (auto &[at, weight] : points) {
    const double a = (1 + at[0]) / 2, b = (1 + at[1]) / 2, c = (1 + at[2]) / 2;
    if (shape == Shape::wedge) {
      at = {a, (1 - a) * b, at[2]};
      weight *= (1 - a) / 4;
    } else {
      at = {a, (1 - a) * b, (1 - a) * (1 - b) * c};
      weight *= (1 - a) * (1 - a) * (1 - b) / 8;
    }
  }
  return points;
}

SolverElement element_of(const char *name, std::uint8_t vtk_type, Shape shape, std::vector<Coordinates> nodes,
                         std::vector<ReferencePoint> gauss) {
  SolverElement element{};
  element.name = name;
  element.vtk_type = vtk_type;
  element.n_nodes = nodes.size();
  element.n_corners = shape == Shape::tetrahedron ? 4 : shape == Shape::wedge ? 6 : 8;
  element.node_places = std::move(nodes);
  element.gauss = std::move(gauss);
  for (const ReferencePoint &point : element.gauss)
    element.at_gauss.push_back(shapes_at(shape, element.node_places, point.at));
  // The solver evaluates the gradients of a wedge only at the first Gauss point. In a linear tetrahedron, the gradients are the
  // same everywhere.
  if (shape == Shape::wedge)
    for (ShapeFunctions &functions : element.at_gauss) functions.slopes = element.at_gauss[0].slopes;
  element.fine = fine_points(shape);
  for (const ReferencePoint &point : element.fine)
    element.at_fine.push_back(shapes_at(shape, element.node_places, point.at));
  return element;
}

}  // namespace

const SolverElement *solver_element_of(std::uint8_t vtk_type) {
  static const std::vector<SolverElement> elements = {
      element_of("tet4", 10, Shape::tetrahedron, tetrahedron_nodes(4), tetrahedron_gauss(4)),
      element_of("wedge6", 13, Shape::wedge, wedge_nodes(), wedge_gauss()),
      element_of("hex8", 12, Shape::hexahedron, hexahedron_nodes(8), hexahedron_gauss(2)),
      element_of("tet10", 24, Shape::tetrahedron, tetrahedron_nodes(10), tetrahedron_gauss(10)),
      element_of("hex20", 25, Shape::hexahedron, hexahedron_nodes(20), hexahedron_gauss(3)),
      element_of("hex27", 29, Shape::hexahedron, hexahedron_nodes(27), hexahedron_gauss(3))};
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [vtk_type](const SolverElement &element) { return element.vtk_type == vtk_type; });
  return found == elements.end() ? nullptr : &*found;
}

const char *solver_element_names() { return "tet4, wedge6, hex8, tet10, hex20 and hex27"; }

}  // namespace riis::program
