// SPDX-License-Identifier: Apache-2.0
#include "program/uris_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "common/array_view.hpp"

namespace riis::program {
namespace {

// Three velocities and a pressure.
constexpr std::size_t n_unknowns = 4;
using Unknowns = std::array<double, n_unknowns>;
using Block = std::array<double, n_unknowns * n_unknowns>;  // row by row

// ---- The region near the valve ----

struct Region {
  std::vector<std::int64_t> elements;
  std::vector<std::int64_t> nodes;     // by number in the region
  std::vector<std::int64_t> position;  // by node of the mesh: its number in the region, or -1
  std::vector<char> is_wall;           // by number in the region
  std::vector<char> is_before;         // whether the node is on the cut before the valve, where the pressure is 1
};

// A face of an element, by the sorted numbers of its first corners, which are enough to tell faces apart.
struct Face {
  std::array<std::int64_t, 3> key;
  std::int64_t element;
  std::size_t number;
  bool is_inside;  // whether the element belongs to the region
};

// Groups nodes that are joined, by a forest in which each node points towards the root of its group.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

void add_node(Region &region, std::int64_t node) {
  if (view(region.position)[node] >= 0) return;
  view(region.position)[node] = view(region.nodes).size();
  region.nodes.push_back(node);
}

std::vector<Face> faces_near(const SolverMesh &mesh, const Region &region, const std::vector<char> &is_inside) {
  std::vector<Face> faces;
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e) {
    for (std::size_t f = 0; f < mesh.element->faces.size(); ++f) {
      // A triangle has no fourth corner, and the last number sorts behind the others.
      constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
      std::array<std::int64_t, 4> corners{none, none, none, none};
      std::size_t n = 0;
      bool is_near = true;
      for (const std::size_t a : mesh.element->faces[f]) {
        if (a >= mesh.element->n_corners) continue;
        corners[n] = mesh.nodes_of(e)[a];
        is_near = is_near && view(region.position)[corners[n++]] >= 0;
      }
      if (!is_near) continue;
      std::sort(corners.begin(), corners.end());
      faces.push_back({{corners[0], corners[1], corners[2]}, e, f, is_inside[at(e)] != 0});
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face &a, const Face &b) { return a.key < b.key; });
  return faces;
}

// Finds the walls, and the two sides of the region's cut through the mesh. Returns whether there are two sides.
bool find_sides(const SolverMesh &mesh, const SolverDistances &sides, const std::vector<char> &is_inside,
                Region &region) {
  const std::vector<Face> faces = faces_near(mesh, region, is_inside);
  Groups groups(region.nodes.size());
  std::vector<char> is_cut(region.nodes.size(), 0);
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i, n_inside = 0, inside = i;
    for (; end < faces.size() && faces[end].key == faces[i].key; ++end) {
      if (!faces[end].is_inside) continue;
      ++n_inside;
      inside = end;
    }
    if (n_inside == 1) {
      const Face &face = faces[inside];
      const bool is_wall = end == i + 1;
      std::int64_t first = -1;
      for (const std::size_t a : mesh.element->faces[face.number]) {
        const std::int64_t node = view(region.position)[mesh.nodes_of(face.element)[a]];
        view(is_wall ? region.is_wall : is_cut)[node] = 1;
        if (is_wall) continue;
        if (first >= 0) groups.join(at(first), at(node));
        first = node;
      }
    }
    i = end;
  }
  // Each connected piece of the cut is on the side on which most of its nodes are.
  std::vector<std::int64_t> balance(region.nodes.size(), 0), size(region.nodes.size(), 0);
  for (std::size_t i = 0; i < region.nodes.size(); ++i) {
    if (!is_cut[i]) continue;
    balance[groups.root(i)] += view(sides.to_leaflets)[region.nodes[i]] < 0 ? 1 : -1;
    ++size[groups.root(i)];
  }
  bool has_before = false, has_behind = false;
  for (std::size_t i = 0; i < region.nodes.size(); ++i) {
    if (size[i] == 0) continue;
    // A piece with many nodes on each side leads around the valve.
    if (2 * std::abs(balance[i]) < size[i]) return false;
    (balance[i] > 0 ? has_before : has_behind) = true;
  }
  for (std::size_t i = 0; i < region.nodes.size(); ++i)
    region.is_before[i] = is_cut[i] != 0 && !region.is_wall[i] && balance[groups.root(i)] > 0;
  return has_before && has_behind;
}

// Numbers the nodes by layers from the cut before the valve. The incomplete factors are better in this order.
void order_by_layers(const SolverMesh &mesh, Region &region) {
  std::vector<std::vector<std::int64_t>> elements_of(region.nodes.size());
  for (const std::int64_t e : region.elements)
    for (std::size_t a = 0; a < mesh.element->n_nodes; ++a)
      elements_of[at(view(region.position)[mesh.nodes_of(e)[a]])].push_back(e);
  std::vector<char> is_seen(region.nodes.size(), 0);
  std::vector<std::int64_t> order;
  const auto see = [&](std::int64_t i) {
    if (!is_seen[at(i)]) order.push_back(i);
    is_seen[at(i)] = 1;
  };
  for (std::int64_t i = 0; i < view(region.nodes).size(); ++i)
    if (view(region.is_before)[i]) see(i);
  for (std::int64_t next = 0, begin = 0; next < view(region.nodes).size(); ++next) {
    if (next == view(order).size())  // another piece of the region
      while (is_seen[at(begin)]) ++begin;
    if (next == view(order).size()) see(begin);
    for (const std::int64_t e : elements_of[at(view(order)[next])])
      for (std::size_t a = 0; a < mesh.element->n_nodes; ++a) see(view(region.position)[mesh.nodes_of(e)[a]]);
  }
  const Region old = region;
  for (std::int64_t i = 0; i < view(order).size(); ++i) {
    const std::int64_t from = view(order)[i];
    view(region.nodes)[i] = view(old.nodes)[from];
    view(region.is_wall)[i] = view(old.is_wall)[from];
    view(region.is_before)[i] = view(old.is_before)[from];
    view(region.position)[view(region.nodes)[i]] = i;
  }
}

// ---- A matrix of blocks, by rows ----

struct Matrix {
  std::vector<std::int64_t> begin, column, diagonal;  // the columns of a row ascend
  std::vector<Block> block;

  std::int64_t n() const { return view(begin).size() - 1; }
  Block &at_place(std::int64_t row, std::int64_t col) {
    const auto first = column.begin() + view(begin)[row], last = column.begin() + view(begin)[row + 1];
    return view(block)[std::lower_bound(first, last, col) - column.begin()];
  }
};

Matrix empty_matrix(const SolverMesh &mesh, const Region &region) {
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
  for (const std::int64_t e : region.elements)
    for (std::size_t a = 0; a < mesh.element->n_nodes; ++a)
      for (std::size_t b = 0; b < mesh.element->n_nodes; ++b)
        pairs.emplace_back(view(region.position)[mesh.nodes_of(e)[a]], view(region.position)[mesh.nodes_of(e)[b]]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Matrix matrix;
  matrix.begin.assign(region.nodes.size() + 1, 0);
  matrix.diagonal.assign(region.nodes.size(), 0);
  for (const auto &[row, column] : pairs) {
    ++view(matrix.begin)[row + 1];
    if (row == column) view(matrix.diagonal)[row] = view(matrix.column).size();
    matrix.column.push_back(column);
  }
  std::partial_sum(matrix.begin.begin(), matrix.begin.end(), matrix.begin.begin());
  matrix.block.assign(pairs.size(), Block{});
  return matrix;
}

// Subtracts the product of two blocks.
void subtract_product(const Block &a, const Block &b, Block &from) {
  for (std::size_t i = 0; i < n_unknowns; ++i)
    for (std::size_t k = 0; k < n_unknowns; ++k)
      for (std::size_t j = 0; j < n_unknowns; ++j)
        from[n_unknowns * i + j] -= a[n_unknowns * i + k] * b[n_unknowns * k + j];
}

Block product(const Block &a, const Block &b) {
  Block c{};
  subtract_product(a, b, c);
  for (double &x : c) x = -x;
  return c;
}

void subtract_product(const Block &a, const double *x, double *from) {
  for (std::size_t i = 0; i < n_unknowns; ++i)
    for (std::size_t j = 0; j < n_unknowns; ++j) from[i] -= a[n_unknowns * i + j] * x[j];
}

// Inverts a block by elimination with the largest pivots.
Block inverse(Block a) {
  Block b{};
  for (std::size_t i = 0; i < n_unknowns; ++i) b[n_unknowns * i + i] = 1;
  for (std::size_t k = 0; k < n_unknowns; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n_unknowns; ++i)
      if (std::abs(a[n_unknowns * i + k]) > std::abs(a[n_unknowns * pivot + k])) pivot = i;
    for (std::size_t j = 0; j < n_unknowns; ++j) {
      std::swap(a[n_unknowns * k + j], a[n_unknowns * pivot + j]);
      std::swap(b[n_unknowns * k + j], b[n_unknowns * pivot + j]);
    }
    const double factor = 1 / a[n_unknowns * k + k];
    for (std::size_t j = 0; j < n_unknowns; ++j) {
      a[n_unknowns * k + j] *= factor;
      b[n_unknowns * k + j] *= factor;
    }
    for (std::size_t i = 0; i < n_unknowns; ++i) {
      if (i == k) continue;
      const double off = a[n_unknowns * i + k];
      for (std::size_t j = 0; j < n_unknowns; ++j) {
        a[n_unknowns * i + j] -= off * a[n_unknowns * k + j];
        b[n_unknowns * i + j] -= off * b[n_unknowns * k + j];
      }
    }
  }
  return b;
}

// Incomplete factors without fill-in. The blocks on the diagonal are inverted.
void factorize(Matrix &m) {
  std::vector<std::int64_t> place(m.diagonal.size(), -1);
  for (std::int64_t i = 0; i < m.n(); ++i) {
    const std::int64_t begin = view(m.begin)[i], end = view(m.begin)[i + 1];
    for (std::int64_t p = begin; p < end; ++p) view(place)[view(m.column)[p]] = p;
    for (std::int64_t p = begin; p < view(m.diagonal)[i]; ++p) {
      const std::int64_t k = view(m.column)[p];
      view(m.block)[p] = product(view(m.block)[p], view(m.block)[view(m.diagonal)[k]]);
      for (std::int64_t q = view(m.diagonal)[k] + 1; q < view(m.begin)[k + 1]; ++q) {
        const std::int64_t to = view(place)[view(m.column)[q]];
        if (to >= 0) subtract_product(view(m.block)[p], view(m.block)[q], view(m.block)[to]);
      }
    }
    view(m.block)[view(m.diagonal)[i]] = inverse(view(m.block)[view(m.diagonal)[i]]);
    for (std::int64_t p = begin; p < end; ++p) view(place)[view(m.column)[p]] = -1;
  }
}

using Vector = std::vector<double>;
constexpr auto width = static_cast<std::int64_t>(n_unknowns);

// Solves with the incomplete factors, in place.
void apply_factors(const Matrix &m, Vector &x) {
  for (std::int64_t i = 0; i < m.n(); ++i)
    for (std::int64_t p = view(m.begin)[i]; p < view(m.diagonal)[i]; ++p)
      subtract_product(view(m.block)[p], &view(x)[width * view(m.column)[p]], &view(x)[width * i]);
  for (std::int64_t i = m.n() - 1; i >= 0; --i) {
    for (std::int64_t p = view(m.diagonal)[i] + 1; p < view(m.begin)[i + 1]; ++p)
      subtract_product(view(m.block)[p], &view(x)[width * view(m.column)[p]], &view(x)[width * i]);
    Unknowns y{};
    subtract_product(view(m.block)[view(m.diagonal)[i]], &view(x)[width * i], y.data());
    for (std::int64_t k = 0; k < width; ++k) view(x)[width * i + k] = -view(y)[k];
  }
}

Vector residual(const Matrix &m, const Vector &right, const Vector &x) {
  Vector r = right;
  for (std::int64_t i = 0; i < m.n(); ++i)
    for (std::int64_t p = view(m.begin)[i]; p < view(m.begin)[i + 1]; ++p)
      subtract_product(view(m.block)[p], &view(x)[width * view(m.column)[p]], &view(r)[width * i]);
  return r;
}

double product(const Vector &a, const Vector &b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

struct Solved {
  Vector x;
  bool is_solved = false;
  std::int64_t n_iterations = 0;
};

// GMRES with restarts, and with incomplete factors from the left.
Solved solve(const Matrix &m, const Vector &right, const Matrix &factors) {
  constexpr std::int64_t n_restart = 80, most = 640;
  constexpr double tolerance = 1e-8;
  Solved solved{Vector(right.size(), 0.0)};
  const auto preconditioned = [&factors](Vector v) {
    apply_factors(factors, v);
    return v;
  };
  const Vector none(right.size(), 0.0), first = preconditioned(right);
  const double wanted = tolerance * std::sqrt(product(first, first));
  while (solved.n_iterations < most) {
    std::vector<Vector> basis = {preconditioned(residual(m, right, solved.x))};
    const double start = std::sqrt(product(basis[0], basis[0]));
    solved.is_solved = start <= 2 * wanted;
    if (solved.is_solved || !std::isfinite(start)) break;
    for (double &x : basis[0]) x /= start;
    std::vector<Vector> columns;  // of the triangular matrix
    Vector cosines, sines, rotated = {start};
    while (view(columns).size() < n_restart && std::abs(rotated.back()) > wanted) {
      Vector next = residual(m, none, basis.back());
      for (double &x : next) x = -x;
      next = preconditioned(std::move(next));
      Vector column;
      for (const Vector &old : basis) {
        column.push_back(product(next, old));
        for (std::size_t i = 0; i < next.size(); ++i) next[i] -= column.back() * old[i];
      }
      const double length = std::sqrt(product(next, next));
      for (std::size_t k = 0; k < cosines.size(); ++k) {
        const double a = column[k], b = column[k + 1];
        column[k] = cosines[k] * a + sines[k] * b;
        column[k + 1] = cosines[k] * b - sines[k] * a;
      }
      const double radius = std::hypot(column.back(), length);
      cosines.push_back(column.back() / radius);
      sines.push_back(length / radius);
      column.back() = radius;
      rotated.push_back(-sines.back() * rotated.back());
      rotated[rotated.size() - 2] *= cosines.back();
      columns.push_back(std::move(column));
      ++solved.n_iterations;
      if (!(length > 0)) break;
      for (double &x : next) x /= length;
      basis.push_back(std::move(next));
    }
    Vector weights(columns.size());
    for (std::size_t k = columns.size(); k-- > 0;) {
      double sum = rotated[k];
      for (std::size_t j = k + 1; j < columns.size(); ++j) sum -= columns[j][k] * weights[j];
      weights[k] = sum / columns[k][k];
    }
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (std::size_t i = 0; i < solved.x.size(); ++i) solved.x[i] += weights[k] * basis[k][i];
  }
  return solved;
}

// ---- The solver's equations ----

// The share of R / eps^2 that resists the flow everywhere. This share replaces the inertia: otherwise the equations outside the
// band would have almost no velocity terms. It adds a thousandth to the drop. The matrix of the incomplete factors has a larger
// share, because the factors may otherwise be nearly singular. If the first of these shares is too small, the next one is tried.
constexpr double share_everywhere = 1e-4, shares_in_factors[] = {2e-3, 2e-2, 0.2};
// The constant of the solver's stabilisation.
constexpr double viscous_constant = 36;

struct Equations {
  Matrix matrix;
  Vector right;
  std::vector<std::array<double, 3>>
      outward;  // the integral of a shape function over the cut, times the outward normal
};

void add_element(const SolverMesh &mesh, const Region &region, std::int64_t e, const SolverDistances &distances,
                 double half_thickness, const SolverFluid &fluid, double share, Equations &equations) {
  const SolverElement &element = *mesh.element;
  const std::size_t n = element.n_nodes;
  // The unit of velocity is the one that a drop of 1 gives across the resistance R / eps. All terms then have about the same
  // size.
  const double unit = fluid.resistance / half_thickness, mu = fluid.viscosity / unit;
  std::vector<Block> blocks(n * n, Block{});
  ElementMap map;
  for (std::size_t g = 0; g < element.gauss.size(); ++g) {
    if (g == 0 || !element.has_one_gradient) map_element(mesh, e, element.at_gauss[g], map);
    const double w = element.gauss[g].weight * map.determinant;
    const std::vector<double> &N = element.at_gauss[g].values;
    const double K = fluid.resistance * solver_delta(mesh, e, element.at_gauss[g], distances, half_thickness);
    const double nu = fluid.viscosity / fluid.density;
    double metric_square = 0;
    for (const auto &row : map.metric)
      for (const double x : row) metric_square += x * x;
    const double tau = 1 / (fluid.density * std::sqrt(4 / (fluid.time_step * fluid.time_step) + K * K +
                                                      viscous_constant * nu * nu * metric_square));
    const double tau_div = 1 / (tau * map.metric_trace) / unit;
    const double resistance = (K + share * fluid.resistance / (half_thickness * half_thickness)) / unit;
    for (std::size_t a = 0; a < n; ++a) {
      const std::array<double, 3> &da = map.gradients[a];
      std::array<double, 3> &outward = view(equations.outward)[view(region.position)[mesh.nodes_of(e)[a]]];
      for (std::size_t k = 0; k < 3; ++k) outward[k] += w * da[k];
      for (std::size_t b = 0; b < n; ++b) {
        const std::array<double, 3> &db = map.gradients[b];
        Block &block = blocks[n * a + b];
        const double gradients = da[0] * db[0] + da[1] * db[1] + da[2] * db[2];
        for (std::size_t i = 0; i < 3; ++i) {
          block[n_unknowns * i + i] += w * (mu * gradients + resistance * N[a] * N[b]);
          for (std::size_t k = 0; k < 3; ++k)
            block[n_unknowns * i + k] += w * (mu * da[k] * db[i] + tau_div * da[i] * db[k]);
          block[n_unknowns * i + 3] -= w * da[i] * N[b];
          block[n_unknowns * 3 + i] += w * (N[a] * db[i] + tau * unit * da[i] * resistance * N[b]);
        }
        block[n_unknowns * 3 + 3] += w * tau * unit * gradients;
      }
    }
  }
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      Block &to = equations.matrix.at_place(view(region.position)[mesh.nodes_of(e)[a]],
                                            view(region.position)[mesh.nodes_of(e)[b]]);
      for (std::size_t k = 0; k < to.size(); ++k) to[k] += blocks[n * a + b][k];
    }
}

Equations equations_of(const SolverMesh &mesh, const Region &region, const SolverDistances &distances,
                       double half_thickness, const SolverFluid &fluid, double share) {
  Equations equations{empty_matrix(mesh, region), Vector(n_unknowns * region.nodes.size(), 0.0), {}};
  equations.outward.assign(region.nodes.size(), {});
  for (const std::int64_t e : region.elements)
    add_element(mesh, region, e, distances, half_thickness, fluid, share, equations);
  Matrix &m = equations.matrix;
  for (std::int64_t i = 0; i < m.n(); ++i) {
    if (!view(region.is_wall)[i]) {
      // The pressure outside the region is 1 before the valve and 0 behind it.
      if (view(region.is_before)[i])
        for (std::int64_t k = 0; k < 3; ++k) view(equations.right)[width * i + k] = -view(equations.outward)[i][at(k)];
      continue;
    }
    for (std::int64_t p = view(m.begin)[i]; p < view(m.begin)[i + 1]; ++p)
      std::fill(view(m.block)[p].begin(), view(m.block)[p].begin() + 12, 0.0);
    for (std::size_t k = 0; k < 3; ++k) view(m.block)[view(m.diagonal)[i]][n_unknowns * k + k] = 1;
  }
  return equations;
}

}  // namespace

ClosedDrop closed_drop(const SolverMesh &mesh, const SolverDistances &distances, const SolverDistances &sides,
                       const std::vector<double> &near, double reach, double half_thickness, const SolverFluid &fluid) {
  ClosedDrop drop;
  Region region;
  region.position.assign(at(mesh.n_nodes), -1);
  std::vector<char> is_inside(at(mesh.n_elements()), 0);
  for (std::int64_t e = 0; e < mesh.n_elements(); ++e) {
    const std::int64_t *const nodes = mesh.nodes_of(e);
    if (std::none_of(nodes, nodes + mesh.element->n_nodes, [&](std::int64_t i) { return view(near)[i] <= reach; }))
      continue;
    is_inside[at(e)] = 1;
    region.elements.push_back(e);
    for (std::size_t a = 0; a < mesh.element->n_nodes; ++a) add_node(region, nodes[a]);
  }
  region.is_wall.assign(region.nodes.size(), 0);
  region.is_before.assign(region.nodes.size(), 0);
  drop.n_nodes = view(region.nodes).size();
  drop.is_separated = drop.n_nodes > 0 && find_sides(mesh, sides, is_inside, region);
  if (!drop.is_separated) return drop;
  order_by_layers(mesh, region);
  const Equations equations = equations_of(mesh, region, distances, half_thickness, fluid, share_everywhere);
  Solved solved;
  for (const double share : shares_in_factors) {
    Matrix factors = equations_of(mesh, region, distances, half_thickness, fluid, share).matrix;
    factorize(factors);
    solved = solve(equations.matrix, equations.right, factors);
    drop.n_iterations += solved.n_iterations;
    if (solved.is_solved) break;
  }
  drop.is_solved = solved.is_solved;
  for (std::int64_t i = 0; i < drop.n_nodes; ++i)
    if (view(region.is_before)[i])
      for (std::int64_t k = 0; k < 3; ++k)
        drop.flow -= view(solved.x)[width * i + k] * view(equations.outward)[i][at(k)];
  return drop;
}

}  // namespace riis::program
