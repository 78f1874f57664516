// SPDX-License-Identifier: Apache-2.0
// Finds the edges of cells of higher order from the positions of their nodes in VTK's unit cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "../support/cell_edges.h"
#include "vtk_shim.h"

namespace {

using Place = std::array<double, 3>;
using Edges = std::set<std::pair<int, int>>;

struct Kind {
  int type, n_nodes, n_corners,
      order;  // 0 if no complete lattice exists, because nodes are only in the middles of sides, and perhaps of faces
};
constexpr Kind kinds[] = {{VTK_QUADRATIC_TETRA, 10, 4, 0},         {VTK_QUADRATIC_HEXAHEDRON, 20, 8, 0},
                          {VTK_QUADRATIC_WEDGE, 15, 6, 0},         {VTK_QUADRATIC_PYRAMID, 13, 5, 0},
                          {VTK_QUADRATIC_LINEAR_WEDGE, 12, 6, 0},  {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24, 8, 0},
                          {VTK_TRIQUADRATIC_HEXAHEDRON, 27, 8, 2}, {VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18, 6, 2},
                          {VTK_LAGRANGE_TETRAHEDRON, 4, 4, 1},     {VTK_LAGRANGE_TETRAHEDRON, 10, 4, 2},
                          {VTK_LAGRANGE_TETRAHEDRON, 35, 4, 4},    {VTK_BEZIER_TETRAHEDRON, 20, 4, 3},
                          {VTK_LAGRANGE_HEXAHEDRON, 8, 8, 1},      {VTK_LAGRANGE_HEXAHEDRON, 27, 8, 2},
                          {VTK_LAGRANGE_HEXAHEDRON, 64, 8, 3},     {VTK_BEZIER_HEXAHEDRON, 27, 8, 2},
                          {VTK_LAGRANGE_WEDGE, 6, 6, 1},           {VTK_LAGRANGE_WEDGE, 18, 6, 2},
                          {VTK_LAGRANGE_WEDGE, 40, 6, 3},          {VTK_BEZIER_WEDGE, 18, 6, 2}};

const Kind *kind_of(int type, int n_nodes) {
  for (const Kind &kind : kinds)
    if (kind.type == type && kind.n_nodes == n_nodes) return &kind;
  return nullptr;
}

// Joins nodes that are one step of the lattice apart. In a tetrahedron or a triangle, a step may go along any side of the cell.
bool is_step(int n_corners, int order, const Place &a, const Place &b) {
  int d[3];
  for (std::size_t c = 0; c < 3; ++c) d[c] = static_cast<int>(std::lround(order * (a[c] - b[c])));
  const int size = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
  const int sum = d[0] + d[1] + d[2];
  if (size == 1) return true;
  if (n_corners == 4) return size == 2 && sum == 0 && std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) == 1;
  return n_corners == 6 && d[2] == 0 && std::abs(d[0]) == 1 && d[0] == -d[1];
}

int node_at(const std::vector<Place> &places, const Place &wanted) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place &p = places[i];
    if (std::abs(p[0] - wanted[0]) + std::abs(p[1] - wanted[1]) + std::abs(p[2] - wanted[2]) < 1e-9)
      return static_cast<int>(i);
  }
  return -1;
}

// Joins each corner to the middles of its sides. In each corner of a face, two sides meet, and the function also joins the
// middles of these sides. If the face has a node in its middle, joins each side's middle to this node instead.
Edges edges_by_middles(int n_corners, const std::vector<Place> &places) {
  const auto place = [&](int i) { return places[static_cast<std::size_t>(i)]; };
  const auto middle = [&](int a, int b) {
    const Place p = place(a), q = place(b);
    return node_at(places, {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
  };
  const auto opposite = [&](int corner, int a, int b) {  // returns the fourth corner of a parallelogram
    const Place o = place(corner), p = place(a), q = place(b);
    return node_at(places, {p[0] + q[0] - o[0], p[1] + q[1] - o[1], p[2] + q[2] - o[2]});
  };
  Edges edges;
  const auto add = [&](int a, int b) { edges.insert({std::min(a, b), std::max(a, b)}); };
  for (int c = 0; c < n_corners; ++c)
    for (int a = 0; a < n_corners; ++a) {
      if (!on_an_edge(n_corners, c, a)) continue;
      const int m = middle(c, a);
      m < 0 ? add(c, a) : add(c, m);
      for (int b = 0; b < a; ++b) {
        if (!on_an_edge(n_corners, c, b)) continue;
        const int d = opposite(c, a, b), n = middle(c, b);
        const bool is_quad = d >= 0 && d < n_corners, is_triangle = on_an_edge(n_corners, a, b) != 0;
        if (!is_quad && !is_triangle) continue;  // a and b are opposite corners of the base, and c is a pyramid's apex
        const int centre = is_quad ? middle(a, b) : -1;
        if (m >= 0 && n >= 0 && centre < 0) add(m, n);
        if (m >= 0 && n >= 0 && centre >= 0) add(m, centre), add(n, centre);
        // If only two opposite sides of the quad have a node in the middle, joins these two nodes.
        if (is_quad && m >= 0 && n < 0) add(m, middle(b, d));
        if (is_quad && m < 0 && n >= 0) add(n, middle(a, d));
      }
    }
  return edges;
}

Edges edges_in(vtkCell *cell, const Kind &kind) {
  const double *coordinates = cell->GetParametricCoords();
  std::vector<Place> places;
  for (int i = 0; i < kind.n_nodes; ++i) {
    const double *p = coordinates + 3 * i;
    // VTK's unit pyramid is a cube whose upper face shrinks to a point.
    const double width = kind.n_corners == 5 ? 1 - p[2] : 1;
    places.push_back({width * p[0], width * p[1], p[2]});
  }
  if (kind.order == 0) return edges_by_middles(kind.n_corners, places);
  Edges edges;
  for (int i = 0; i < kind.n_nodes; ++i)
    for (int k = 0; k < i; ++k)
      if (is_step(kind.n_corners, kind.order, places[static_cast<std::size_t>(i)], places[static_cast<std::size_t>(k)]))
        edges.insert({k, i});
  return edges;
}

}  // namespace

extern "C" {

int shim_write_curved(const char *path, int n_nodes, uint32_t seed) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  std::mt19937 random(seed);
  std::vector<vtkIdType> nodes(static_cast<std::size_t>(n_nodes));
  std::iota(nodes.begin(), nodes.end(), 0);
  for (int i = 0; i < n_nodes; ++i) points->InsertNextPoint(i % 5, i / 5 % 5, i / 25);
  grid->SetPoints(points);
  for (int round = 0; round < 2; ++round)
    for (const Kind &kind : kinds) {
      std::shuffle(nodes.begin(), nodes.end(), random);
      grid->InsertNextCell(kind.type, kind.n_nodes, nodes.data());
    }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path);
  writer->SetInputData(grid);
  return writer->Write();
}

int64_t shim_read_curved_edges(const char *path, int64_t *edges) {
  const std::string name = path;
  if (name.size() < 4 || name.substr(name.size() - 4) != ".vtu") return 0;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path);
  reader->Update();
  vtkUnstructuredGrid *grid = reader->GetOutput();
  int64_t n = 0;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    grid->GetCell(i, cell);
    const Kind *kind = kind_of(grid->GetCellType(i), static_cast<int>(cell->GetNumberOfPoints()));
    if (!kind) continue;
    for (const auto &[a, b] : edges_in(cell, *kind)) {
      if (edges) edges[2 * n] = cell->GetPointId(a), edges[2 * n + 1] = cell->GetPointId(b);
      ++n;
    }
  }
  return n;
}

}  // extern "C"
