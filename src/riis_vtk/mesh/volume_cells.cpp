// SPDX-License-Identifier: Apache-2.0
// The edges of all types of cells, the list of volume cells, and the list of their edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkGenericCell.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderTetra.h>
#include <vtkHigherOrderWedge.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include "common/array_view.hpp"
#include "riis_vtk/mesh/mesh.hpp"

namespace riis::vtk {
namespace {

bool is_linear_volume(int type) {
  return type == VTK_TETRA || type == VTK_PYRAMID || type == VTK_WEDGE || type == VTK_HEXAHEDRON || type == VTK_VOXEL;
}

Edge edge_between(vtkIdType a, vtkIdType b) { return {std::min(a, b), std::max(a, b)}; }

// Sorts edges. Removes repeated edges, and edges from a node to itself.
void sort_edges(std::vector<Edge> &edges) {
  edges.erase(std::remove_if(edges.begin(), edges.end(), [](const Edge &edge) { return edge[0] == edge[1]; }),
              edges.end());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

// Adds the edges of a face. A side of higher order has a node in its middle. The face may also have a node in its middle, which
// is then the last node of the face.
void add_face(vtkCell *face, std::vector<Edge> &edges) {
  std::vector<vtkIdType> middles;
  const int n_sides = face->GetNumberOfEdges();
  for (int i = 0; i < n_sides; ++i) {
    vtkIdList *side = face->GetEdge(i)->GetPointIds();
    const vtkIdType a = side->GetId(0), b = side->GetId(1);
    if (side->GetNumberOfIds() == 2) {
      edges.push_back(edge_between(a, b));
    } else {
      const vtkIdType middle = side->GetId(2);
      edges.insert(edges.end(), {edge_between(a, middle), edge_between(middle, b)});
      middles.push_back(middle);
    }
  }
  const int last = static_cast<int>(face->GetNumberOfPoints()) - 1;
  if (last == n_sides + view(middles).size()) {
    // The node in the middle of a quad has edges to the nodes in the middles of the four sides. The node in the middle of a
    // triangle also has edges to the three corners.
    for (int i = n_sides == 3 ? 0 : n_sides; i < last; ++i)
      edges.push_back(edge_between(face->GetPointId(i), face->GetPointId(last)));
  } else if (!middles.empty()) {
    for (std::size_t i = 0; i < middles.size(); ++i)
      edges.push_back(edge_between(middles[i], middles[(i + 1) % middles.size()]));
  }
}

// Adds the edges that lie inside a cell, not on its faces.
void add_inner_edges(int type, std::vector<Edge> &edges) {
  const auto add_star = [&](vtkIdType centre, vtkIdType first) {
    for (vtkIdType i = first; i < centre; ++i) edges.push_back(edge_between(i, centre));
  };
  if (type == VTK_TRIQUADRATIC_HEXAHEDRON) add_star(26, 20);
  if (type == VTK_TRIQUADRATIC_PYRAMID) add_star(18, 13);
  // The nodes in the middles of the wedge's quads form a triangle at half height.
  if (type == VTK_BIQUADRATIC_QUADRATIC_WEDGE) edges.insert(edges.end(), {{15, 16}, {16, 17}, {15, 17}});
}

// Lists the nodes of a face. The corners come first, in their order round the face. VTK lists the corners of a voxel's face row
// by row.
CellShape::Face listed_face(vtkCell *face) {
  CellShape::Face made{{face->GetPointIds()->begin(), face->GetPointIds()->end()}, face->GetNumberOfEdges()};
  if (face->GetCellType() == VTK_PIXEL) {
    std::swap(made.nodes[2], made.nodes[3]);
    std::rotate(made.nodes.begin(), std::min_element(made.nodes.begin(), made.nodes.end()), made.nodes.end());
  }
  return made;
}

CellShape shape_from_vtk(int type) {
  CellShape shape;
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  if (!cell) return shape;
  shape.dimension = cell->GetCellDimension();
  if (shape.dimension < 2 || type >= VTK_HIGHER_ORDER_EDGE || cell->RequiresExplicitFaceRepresentation() ||
      type == VTK_CONVEX_POINT_SET)
    return shape;
  for (vtkIdType i = 0; i < cell->GetNumberOfPoints(); ++i) cell->GetPointIds()->SetId(i, i);
  if (shape.dimension == 2) add_face(cell, shape.edges);
  for (int i = 0; i < cell->GetNumberOfFaces(); ++i) {
    add_face(cell->GetFace(i), shape.edges);
    shape.faces.push_back(listed_face(cell->GetFace(i)));
  }
  add_inner_edges(type, shape.edges);
  sort_edges(shape.edges);
  return shape;
}

// Each of the next functions adds the edges between neighbouring nodes of a lattice.
using Orders = std::array<int, 4>;  // the orders along three axes, then the number of nodes, as in VTK

void add_tetrahedron_lattice(int order, std::vector<Edge> &edges) {
  // A small tetrahedron is given by four whole numbers, whose sum is order - 1. If 1 is added to one of the numbers, the four
  // numbers are the barycentric coordinates of a corner.
  for (vtkIdType i = 0; i < order; ++i)
    for (vtkIdType j = 0; i + j < order; ++j)
      for (vtkIdType k = 0; i + j + k < order; ++k) {
        std::array<vtkIdType, 4> corners;
        for (int corner = 0; corner < 4; ++corner) {
          vtkIdType place[4] = {i, j, k, order - 1 - i - j - k};
          ++place[corner];
          view(corners)[corner] = vtkHigherOrderTetra::Index(place, order);
        }
        for (std::size_t a = 0; a < 4; ++a)
          for (std::size_t b = 0; b < a; ++b) edges.push_back(edge_between(corners[a], corners[b]));
      }
}

void add_hexahedron_lattice(const Orders &orders, std::vector<Edge> &edges) {
  const auto node = [&](int i, int j, int k) -> vtkIdType {
    return vtkHigherOrderHexahedron::PointIndexFromIJK(i, j, k, orders.data());
  };
  for (int i = 0; i <= orders[0]; ++i)
    for (int j = 0; j <= orders[1]; ++j)
      for (int k = 0; k <= orders[2]; ++k) {
        if (i < orders[0]) edges.push_back(edge_between(node(i, j, k), node(i + 1, j, k)));
        if (j < orders[1]) edges.push_back(edge_between(node(i, j, k), node(i, j + 1, k)));
        if (k < orders[2]) edges.push_back(edge_between(node(i, j, k), node(i, j, k + 1)));
      }
}

void add_wedge_lattice(const Orders &orders, std::vector<Edge> &edges) {
  const auto node = [&](int i, int j, int k) -> vtkIdType {
    return vtkHigherOrderWedge::PointIndexFromIJK(i, j, k, orders.data());
  };
  for (int k = 0; k <= orders[2]; ++k)
    for (int i = 0; i <= orders[0]; ++i)
      for (int j = 0; i + j <= orders[0]; ++j) {
        if (k < orders[2]) edges.push_back(edge_between(node(i, j, k), node(i, j, k + 1)));
        if (i + j == orders[0]) continue;
        const vtkIdType a = node(i, j, k), b = node(i + 1, j, k), c = node(i, j + 1, k);
        edges.insert(edges.end(), {edge_between(a, b), edge_between(b, c), edge_between(a, c)});
      }
}

// Returns the number of nodes of a lattice. The number is a double, because the order of a cell may be arbitrarily large.
double n_lattice_nodes(int type, const Orders &orders) {
  const double n[3] = {orders[0] + 1.0, orders[1] + 1.0, orders[2] + 1.0};
  if (type == VTK_LAGRANGE_TETRAHEDRON || type == VTK_BEZIER_TETRAHEDRON) return n[0] * (n[0] + 1) * (n[0] + 2) / 6;
  if (type == VTK_LAGRANGE_WEDGE || type == VTK_BEZIER_WEDGE) return n[0] * (n[0] + 1) / 2 * n[2];
  return n[0] * n[1] * n[2];
}

bool is_lattice(int type) {
  return type == VTK_LAGRANGE_TETRAHEDRON || type == VTK_BEZIER_TETRAHEDRON || type == VTK_LAGRANGE_HEXAHEDRON ||
         type == VTK_BEZIER_HEXAHEDRON || type == VTK_LAGRANGE_WEDGE || type == VTK_BEZIER_WEDGE;
}

std::vector<Edge> lattice_edges(int type, const Orders &orders) {
  std::vector<Edge> edges;
  if (type == VTK_LAGRANGE_TETRAHEDRON || type == VTK_BEZIER_TETRAHEDRON)
    add_tetrahedron_lattice(orders[0], edges);
  else if (type == VTK_LAGRANGE_WEDGE || type == VTK_BEZIER_WEDGE)
    add_wedge_lattice(orders, edges);
  else
    add_hexahedron_lattice(orders, edges);
  sort_edges(edges);
  return edges;
}

// Finds the orders of a cell from its number of nodes, n_nodes. The cell has the orders in the file (`given`), or equal orders
// along all axes. If n_nodes fits neither of these orders, the nodes form no lattice, and the function returns false.
bool find_orders(int type, vtkIdType n_nodes, const double *given, Orders &orders) {
  orders[3] = static_cast<int>(n_nodes);
  const auto fit = [&] {
    return std::min({orders[0], orders[1], orders[2]}) >= 1 &&
           n_lattice_nodes(type, orders) == static_cast<double>(n_nodes);
  };
  if (given) {
    for (std::size_t i = 0; i < 3; ++i) orders[i] = given[i] >= 1 && given[i] <= 1000 ? static_cast<int>(given[i]) : 0;
    if (fit()) return true;
  }
  for (int order = 1; order <= 1000; ++order) {
    std::fill_n(orders.begin(), 3, order);
    if (fit()) return true;
    if (n_lattice_nodes(type, orders) > static_cast<double>(n_nodes)) break;
  }
  return false;
}

// The edges of cells of all types. A cell with straight sides has its sides as edges. The nodes of a cell of higher order divide
// the cell into linear cells. The edges of these linear cells count as the edges of the cell. If a face has no node in its
// middle, edges join the middles of neighbouring sides.
class CellEdges {
 public:
  explicit CellEdges(vtkUnstructuredGrid *grid) : grid_(grid), degrees_(grid->GetCellData()->GetHigherOrderDegrees()) {
    if (degrees_ && degrees_->GetNumberOfComponents() != 3) degrees_ = nullptr;
  }

  // Returns whether the cell is a volume. A cell that is no volume is on the boundary of volumes, or belongs to no volume.
  bool is_volume(vtkIdType cell) const { return shape_of(grid_->GetCellType(cell)).dimension == 3; }

  // Calls `visit` with the two nodes of each edge of a face or a volume. Returns false if the edges are not known.
  template <class Visit>
  bool for_each(vtkIdType cell, const Visit &visit) {
    const vtkIdType *ids = nullptr;
    const std::vector<Edge> &edges = pairs_of(cell, ids);
    for (const auto &[a, b] : edges) visit(ids ? ids[a] : a, ids ? ids[b] : b);
    return !edges.empty();
  }

 private:
  // Returns the edges of a cell, each once, as pairs of positions in the list of nodes `ids`. If `ids` is NULL, the pairs contain
  // nodes.
  const std::vector<Edge> &pairs_of(vtkIdType cell, const vtkIdType *&ids) {
    const int type = grid_->GetCellType(cell);
    if (type == VTK_POLYHEDRON) {
      list_polyhedron(cell);
      return edges_;
    }
    vtkIdType n = 0;
    grid_->GetCells()->GetCellAtId(cell, n, ids);
    return is_lattice(type) ? lattice_of(type, cell, n) : shape_of(type).edges;
  }

  // Lists the edges of a polyhedron. The stream of a polyhedron's faces begins with the number of faces. After this number, each
  // face follows with its size and its nodes.
  void list_polyhedron(vtkIdType cell) {
    edges_.clear();
    grid_->GetFaceStream(cell, faces_);
    vtkIdType at = 0;
    for (vtkIdType n_left = faces_->GetId(at++); n_left > 0; --n_left) {
      const vtkIdType n = faces_->GetId(at++);
      for (vtkIdType k = 0; k < n; ++k)
        edges_.push_back(edge_between(faces_->GetId(at + k), faces_->GetId(at + (k + 1) % n)));
      at += n;
    }
    sort_edges(edges_);
  }

  const std::vector<Edge> &lattice_of(int type, vtkIdType cell, vtkIdType n_nodes) {
    static const std::vector<Edge> none;
    double degrees[3];
    if (degrees_) degrees_->GetTuple(cell, degrees);
    Orders orders;
    if (!find_orders(type, n_nodes, degrees_ ? degrees : nullptr, orders)) return none;
    std::vector<Edge> &edges = lattices_[{type, orders[0], orders[1], orders[2]}];
    if (edges.empty()) edges = lattice_edges(type, orders);
    return edges;
  }

  vtkUnstructuredGrid *grid_;
  vtkDataArray *degrees_;  // the orders of cells of higher order; may be NULL
  vtkNew<vtkIdList> faces_;
  std::vector<Edge> edges_;                                   // edges of a polyhedron
  std::map<std::array<int, 4>, std::vector<Edge>> lattices_;  // edges of lattices, by the type and the three orders
};

double distance_between(vtkUnstructuredGrid *grid, vtkIdType a, vtkIdType b) {
  double p[3], q[3];
  grid->GetPoint(a, p);
  grid->GetPoint(b, q);
  return std::sqrt(vtkMath::Distance2BetweenPoints(p, q));
}

// Lists the edges of volumes for which the function is_wanted(a, b) returns true.
template <class IsWanted>
VolumeEdges edges_where(vtkUnstructuredGrid *grid, const IsWanted &is_wanted) {
  VolumeEdges made;
  CellEdges edges(grid);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    if (!edges.is_volume(cell)) continue;
    made.n_cells_left_out += !edges.for_each(cell, [&](vtkIdType a, vtkIdType b) {
      if (is_wanted(a, b)) made.node_ids.insert(made.node_ids.end(), {a, b});
    });
  }
  return made;
}

}  // namespace

const CellShape &shape_of(int type) {
  static const std::array<CellShape, 256> shapes = [] {
    std::array<CellShape, 256> made;
    for (int i = 0; i < 256; ++i) view(made)[i] = shape_from_vtk(i);
    return made;
  }();
  return view(shapes)[type];
}

bool LongEdges::has(const double *a, const double *b) const {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  if (x * x + y * y + z * z < least_square) return false;
  for (int i = 0; i < 3; ++i)
    if (std::max(a[i], b[i]) < lower[i] || std::min(a[i], b[i]) > upper[i]) return false;
  return true;
}

double median_of(std::vector<double> lengths) {
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

VolumeCounts count_volumes(vtkUnstructuredGrid *grid, vtkUnsignedCharArray *ghosts) {
  VolumeCounts counts;
  CellEdges edges(grid);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    const bool is_ghost = ghosts && (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0;
    if (is_ghost || !edges.is_volume(cell)) continue;
    ++counts.n_volumes;
    if (is_linear_volume(grid->GetCellType(cell)))
      ++counts.n_linear;
    else
      counts.n_unknown += !edges.for_each(cell, [](vtkIdType, vtkIdType) {});
  }
  return counts;
}

VolumeCells volume_cells_of(vtkUnstructuredGrid *grid) {
  VolumeCells cells;
  const vtkIdType n_cells = grid->GetNumberOfCells();
  std::size_t n_volumes = 0, n_corners = 0;
  for (vtkIdType cell_id = 0; cell_id < n_cells; ++cell_id) {
    if (!is_linear_volume(grid->GetCellType(cell_id))) continue;
    ++n_volumes;
    n_corners += static_cast<std::size_t>(grid->GetCells()->GetCellSize(cell_id));
  }
  cells.offsets.reserve(n_volumes + 1);
  cells.node_ids.reserve(n_corners);
  for (vtkIdType cell_id = 0; cell_id < n_cells; ++cell_id) {
    const int type = grid->GetCellType(cell_id);
    if (!is_linear_volume(type)) continue;
    vtkIdType n = 0;
    const vtkIdType *ids = nullptr;
    grid->GetCells()->GetCellAtId(cell_id, n, ids);
    if (type == VTK_VOXEL) {
      // The nodes of a voxel are ordered along x, then y, then z. The corners of a hexahedron run round its base first, and then
      // round its top.
      cells.node_ids.insert(cells.node_ids.end(), {ids[0], ids[1], ids[3], ids[2], ids[4], ids[5], ids[7], ids[6]});
    } else {
      cells.node_ids.insert(cells.node_ids.end(), ids, ids + n);
    }
    cells.offsets.push_back(static_cast<std::int64_t>(cells.node_ids.size()));
  }
  return cells;
}

VolumeEdges volume_edges_of(vtkUnstructuredGrid *grid) {
  return edges_where(grid, [](vtkIdType, vtkIdType) { return true; });
}

VolumeEdges long_edges_of(vtkUnstructuredGrid *grid, const double *xyz, const LongEdges &wanted) {
  return edges_where(grid, [&](vtkIdType a, vtkIdType b) { return wanted.has(xyz + 3 * a, xyz + 3 * b); });
}

double median_edge_of(vtkUnstructuredGrid *grid) {
  const vtkIdType n_cells = grid->GetNumberOfCells(), n_asked = std::min<vtkIdType>(n_cells, most_measured);
  CellEdges edges(grid);
  std::vector<double> lengths;
  for (vtkIdType i = 0; i < n_asked; ++i) {
    const vtkIdType cell_id = n_cells / n_asked * i + n_cells % n_asked * i / n_asked;
    edges.for_each(cell_id, [&](vtkIdType a, vtkIdType b) {
      const double length = distance_between(grid, a, b);
      if (length > 0 && std::isfinite(length)) lengths.push_back(length);
    });
  }
  return median_of(std::move(lengths));
}

}  // namespace riis::vtk
