// SPDX-License-Identifier: Apache-2.0
#include "riis_vtk/surface/surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolygon.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include "common/array_view.hpp"
#include "common/sets.hpp"

namespace riis::vtk {
namespace {

void add_triangle(std::vector<std::int64_t> &triangles, const vtkIdList *ids, vtkIdType a, vtkIdType b, vtkIdType c) {
  auto *list = const_cast<vtkIdList *>(ids);
  triangles.insert(triangles.end(), {list->GetId(a), list->GetId(b), list->GetId(c)});
}

void cut_strip(const vtkIdList *ids, std::vector<std::int64_t> &triangles) {
  // In a strip, the corners of every second triangle run in the opposite direction.
  for (vtkIdType i = 0; i + 2 < const_cast<vtkIdList *>(ids)->GetNumberOfIds(); ++i) {
    add_triangle(triangles, ids, i, i % 2 == 0 ? i + 1 : i + 2, i % 2 == 0 ? i + 2 : i + 1);
  }
}

void cut_polygon(const std::string &path, vtkPointSet *data, vtkIdType cell_id, vtkIdList *ids,
                 std::vector<std::int64_t> &triangles) {
  vtkNew<vtkPolygon> polygon;
  polygon->Initialize(static_cast<int>(ids->GetNumberOfIds()), ids->GetPointer(0), data->GetPoints());
  vtkNew<vtkIdList> corners;
  const bool cut = polygon->Triangulate(corners) != 0;
  if (!cut || corners->GetNumberOfIds() != 3 * (ids->GetNumberOfIds() - 2)) {
    fail_file(path, "cell ", cell_id, " is a polygon that cannot be cut into triangles");
  }
  for (vtkIdType i = 0; i < corners->GetNumberOfIds(); i += 3) {
    add_triangle(triangles, ids, corners->GetId(i), corners->GetId(i + 1), corners->GetId(i + 2));
  }
}

// Returns the normal of a triangle. The normal's length is twice the triangle's area.
std::array<double, 3> area_of(vtkPointSet *data, const vtkIdList *ids, vtkIdType a, vtkIdType b, vtkIdType c) {
  auto *list = const_cast<vtkIdList *>(ids);
  double p[3], q[3], r[3], area[3];
  data->GetPoint(list->GetId(a), p);
  data->GetPoint(list->GetId(b), q);
  data->GetPoint(list->GetId(c), r);
  vtkMath::Subtract(q, p, q);
  vtkMath::Subtract(r, p, r);
  vtkMath::Cross(q, r, area);
  return {area[0], area[1], area[2]};
}

// Returns whether a diagonal of a quad makes two triangles that face the same way. The diagonal begins at corner i.
bool is_inner_diagonal(vtkPointSet *data, const vtkIdList *ids, vtkIdType i) {
  const std::array<double, 3> one = area_of(data, ids, i, i + 1, i + 2);
  const std::array<double, 3> other = area_of(data, ids, i, i + 2, (i + 3) % 4);
  return vtkMath::Dot(one.data(), other.data()) > 0;
}

// A quad is cut by the diagonal from its first to its third corner, here and in the core. If only the other diagonal lies inside
// the quad, the list of corners is rotated by one.
void put_inner_diagonal_first(vtkPointSet *data, vtkIdList *ids) {
  if (!is_inner_diagonal(data, ids, 0) && is_inner_diagonal(data, ids, 1)) {
    std::rotate(ids->begin(), ids->begin() + 1, ids->end());
  }
}

// For a Lagrange cell of order 1 or 2, which dolfinx writes, returns the usual type with the same nodes.
int without_lagrange(int vtk_type, vtkIdType n_nodes) {
  if (vtk_type == VTK_LAGRANGE_TRIANGLE)
    return n_nodes == 3 ? VTK_TRIANGLE : n_nodes == 6 ? VTK_QUADRATIC_TRIANGLE : vtk_type;
  if (vtk_type == VTK_LAGRANGE_QUADRILATERAL)
    return n_nodes == 4 ? VTK_QUAD : n_nodes == 9 ? VTK_BIQUADRATIC_QUAD : vtk_type;
  return vtk_type;
}

// The triangles of a quadratic face, given by positions in VTK's list of the face's nodes. All nodes of the triangles are nodes
// of the face.
const std::vector<std::array<vtkIdType, 3>> *triangles_of_quadratic(int vtk_type) {
  using Triangles = std::vector<std::array<vtkIdType, 3>>;
  static const std::map<int, Triangles> triangles = {
      {VTK_QUADRATIC_TRIANGLE, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}},
      {VTK_BIQUADRATIC_TRIANGLE, {{0, 3, 6}, {3, 1, 6}, {1, 4, 6}, {4, 2, 6}, {2, 5, 6}, {5, 0, 6}}},
      {VTK_QUADRATIC_QUAD, {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 6}, {4, 6, 7}}},
      {VTK_BIQUADRATIC_QUAD, {{0, 4, 8}, {0, 8, 7}, {4, 1, 5}, {4, 5, 8}, {8, 5, 2}, {8, 2, 6}, {7, 8, 6}, {7, 6, 3}}}};
  const auto found = triangles.find(vtk_type);
  return found == triangles.end() ? nullptr : &found->second;
}

// VTK 9.1 names some types of Lagrange and Bezier cells wrongly.
std::string class_of(int vtk_type) {
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(vtk_type);
  return cell->GetRepresentativeCell()->GetClassName();
}

// Appends the triangles of a cell.
void cut_cell(const std::string &path, vtkPointSet *data, vtkIdType cell_id, vtkIdList *ids,
              std::vector<std::int64_t> &triangles) {
  const vtkIdType n = ids->GetNumberOfIds();
  const int type = without_lagrange(data->GetCellType(cell_id), n);
  if (type == VTK_TRIANGLE_STRIP && n >= 3) {
    cut_strip(ids, triangles);
  } else if (type == VTK_TRIANGLE || (type == VTK_POLYGON && n == 3)) {
    add_triangle(triangles, ids, 0, 1, 2);
  } else if (type == VTK_QUAD || (type == VTK_POLYGON && n == 4)) {
    put_inner_diagonal_first(data, ids);
    add_triangle(triangles, ids, 0, 1, 2);
    add_triangle(triangles, ids, 0, 2, 3);
  } else if (type == VTK_POLYGON && n > 4) {
    cut_polygon(path, data, cell_id, ids, triangles);
  } else if (const auto *const parts = triangles_of_quadratic(type)) {
    for (const auto &[a, b, c] : *parts) add_triangle(triangles, ids, a, b, c);
  } else {
    fail_file(path, "cell ", cell_id, " is a ", class_of(type), " with ", n,
              " points; a surface has triangles, quads, polygons and triangle strips");
  }
}

bool holds_quads_only(vtkPointSet *data) {
  for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
    if (data->GetCellType(cell_id) != VTK_QUAD) return false;
  }
  return true;
}

// Returns a leaflet id for each cell. If the array is missing, returns no ids, or fails if the array is required.
std::vector<std::int32_t> leaflets_of_cells(const std::string &path, vtkPointSet *data, const LeafletArray &wanted) {
  const std::string name = "cell array " + wanted.name;
  vtkAbstractArray *abstract = data->GetCellData()->GetAbstractArray(wanted.name.c_str());
  if (!abstract && wanted.is_required) fail_file(path, "has no ", name, list_of_arrays(data->GetCellData()));
  if (!abstract && data->GetCellData()->GetAbstractArray(attached_array))
    fail_file(path, attached_array, " is an array of cells; it must be a point array, with one number for each point");
  if (!abstract) return {};
  vtkDataArray *array = vtkDataArray::SafeDownCast(abstract);
  if (!array || array->GetNumberOfComponents() != 1) fail_file(path, name, " must hold one number for each cell");
  if (array->GetNumberOfTuples() != data->GetNumberOfCells()) {
    fail_file(path, name, " has ", array->GetNumberOfTuples(), " values for ", data->GetNumberOfCells(), " cells");
  }
  std::vector<std::int32_t> leaflets;
  for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
    const double value = array->GetTuple1(cell_id);
    if (!(value >= 0 && value <= std::numeric_limits<std::int32_t>::max()) || value != std::floor(value)) {
      fail_file(path, name, ": cell ", cell_id, " has ", std::to_string(value),
                ", not a whole number from 0 to 2147483647");
    }
    leaflets.push_back(static_cast<std::int32_t>(value));
  }
  return leaflets;
}

// Returns whether each point is attached. If the array is missing, returns nothing.
std::vector<std::uint8_t> attached_points(const std::string &path, vtkPointSet *data) {
  const std::string name = std::string("point array ") + attached_array;
  vtkAbstractArray *abstract = data->GetPointData()->GetAbstractArray(attached_array);
  if (!abstract) return {};
  vtkDataArray *array = vtkDataArray::SafeDownCast(abstract);
  if (!array || array->GetNumberOfComponents() != 1) fail_file(path, name, " must hold one number for each point");
  if (array->GetNumberOfTuples() != data->GetNumberOfPoints())
    fail_file(path, name, " has ", array->GetNumberOfTuples(), " values for ", data->GetNumberOfPoints(), " points");
  std::vector<std::uint8_t> attached;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    const double value = array->GetTuple1(i);
    if (std::isnan(value)) fail_file(path, name, " is nan at point ", i);
    attached.push_back(value != 0 ? 1 : 0);
  }
  return attached;
}

template <class Array, class Value>
vtkSmartPointer<Array> array_of(const char *name, const Value *values, int n_components, int64_t n_tuples) {
  const auto array = named_array<Array>(name, n_tuples, n_components);
  std::copy_n(values, n_components * n_tuples, array->GetPointer(0));
  return array;
}

void add_vertices(const riis_triangles &of, vtkPolyData *data) {
  const int64_t n = of.n_vertices;
  vtkNew<vtkPoints> points;
  points->SetData(array_of<vtkDoubleArray>("Points", of.xyz, 3, n));
  data->SetPoints(points);
  if (of.uv) data->GetPointData()->AddArray(array_of<vtkDoubleArray>(uv_array, of.uv, 2, n));
  if (of.velocity) data->GetPointData()->AddArray(array_of<vtkDoubleArray>(velocity_array, of.velocity, 3, n));
}

void add_triangles(const riis_triangles &of, vtkPolyData *data) {
  const auto &[n_vertices, xyz, uv, velocity, n, vertex_id, triangle_id, leaflet_id, patch_id] = of;
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(n, 3 * n);
  for (int64_t i = 0; i < n; ++i) {
    const vtkIdType corners[3] = {vertex_id[3 * i], vertex_id[3 * i + 1], vertex_id[3 * i + 2]};
    triangles->InsertNextCell(3, corners);
  }
  data->SetPolys(triangles);
  data->GetCellData()->AddArray(array_of<vtkTypeInt32Array>(leaflet_array, leaflet_id, 1, n));
  data->GetCellData()->AddArray(array_of<vtkTypeInt32Array>(patch_array, patch_id, 1, n));
  data->GetCellData()->AddArray(array_of<vtkTypeInt64Array>(triangle_array, triangle_id, 1, n));
}

// Marks the attached vertices. Also marks other vertices at the same places. The attachment then survives in programs that merge
// points or remove unused points.
void add_attachment(const riis_surface *surface, const riis_triangles &of, vtkPolyData *data) {
  riis_attachment attachment{};
  if (riis_surface_get_attachment(surface, &attachment, sizeof attachment) != RIIS_OK || attachment.n_edges == 0)
    return;
  const std::vector<std::int64_t> places = equal_places(of.n_vertices, of.xyz);
  std::vector<unsigned char> is_attached(places.size(), 0);
  for (int64_t i = 0; i < 2 * attachment.n_edges; ++i) view(is_attached)[view(places)[attachment.vertex_id[i]]] = 1;
  const auto array = named_array<vtkUnsignedCharArray>(attached_array, of.n_vertices);
  for (int64_t i = 0; i < of.n_vertices; ++i) array->SetValue(i, view(is_attached)[view(places)[i]]);
  data->GetPointData()->AddArray(array);
}

// Cuts quads as the core does, from the first corner to the third.
void cut_quads(Faces &faces) {
  if (faces.corners_per_face != 4) return;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> leaflets;
  for (std::size_t face = 0; 4 * face < faces.vertex_ids.size(); ++face) {
    const std::int64_t *const quad = &faces.vertex_ids[4 * face];
    ids.insert(ids.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
    if (!faces.leaflet_id.empty()) leaflets.insert(leaflets.end(), 2, faces.leaflet_id[face]);
  }
  faces.vertex_ids = std::move(ids);
  faces.leaflet_id = std::move(leaflets);
  faces.corners_per_face = 3;
}

}  // namespace

vtkSmartPointer<vtkPolyData> polydata_of(const riis_surface *surface) {
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  riis_triangles triangles{};
  check_core(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  add_vertices(triangles, data);
  add_triangles(triangles, data);
  add_attachment(surface, triangles, data);
  return data;
}

std::vector<double> coordinates_of(vtkPointSet *data) {
  const vtkIdType n = data->GetNumberOfPoints();
  std::vector<double> xyz(static_cast<std::size_t>(3 * n));
  for (vtkIdType i = 0; i < n; ++i) data->GetPoint(i, xyz.data() + 3 * i);
  return xyz;
}

Faces faces_of(const std::string &path, vtkPointSet *data, const LeafletArray &wanted) {
  if (data->GetNumberOfCells() == 0) fail_file(path, "holds no faces");
  const std::vector<std::int32_t> leaflets = leaflets_of_cells(path, data, wanted);
  Faces faces;
  faces.xyz = coordinates_of(data);
  faces.attached = attached_points(path, data);
  faces.corners_per_face = holds_quads_only(data) ? 4 : 3;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell_id = 0; cell_id < data->GetNumberOfCells(); ++cell_id) {
    data->GetCellPoints(cell_id, ids);
    if (faces.corners_per_face == 4) {
      put_inner_diagonal_first(data, ids);
      faces.vertex_ids.insert(faces.vertex_ids.end(), ids->begin(), ids->end());
    } else {
      cut_cell(path, data, cell_id, ids, faces.vertex_ids);
    }
    const std::size_t n_faces = faces.vertex_ids.size() / static_cast<std::size_t>(faces.corners_per_face);
    if (!leaflets.empty()) faces.leaflet_id.resize(n_faces, leaflets[static_cast<std::size_t>(cell_id)]);
  }
  return faces;
}

void append_faces(Faces &faces, const Faces &other) {
  Faces joined = faces, added = other;
  if (joined.corners_per_face != added.corners_per_face) {
    cut_quads(joined);
    cut_quads(added);
  }
  const auto n_corners = static_cast<std::size_t>(joined.corners_per_face);
  if (joined.n_joined == 1) joined.leaflet_id.assign(joined.vertex_ids.size() / n_corners, 0);
  const auto n_vertices = static_cast<std::int64_t>(joined.xyz.size() / 3);
  for (const std::int64_t id : added.vertex_ids) joined.vertex_ids.push_back(n_vertices + id);
  joined.xyz.insert(joined.xyz.end(), added.xyz.begin(), added.xyz.end());
  if (joined.attached.empty() || added.attached.empty())
    joined.attached.clear();
  else
    // A loop inserts the values, because gcc 14 wrongly warns of an insert if files are compiled in a batch.
    for (const auto is_attached : added.attached) joined.attached.push_back(is_attached);
  joined.leaflet_id.resize(joined.vertex_ids.size() / n_corners, joined.n_joined++);
  faces = std::move(joined);
}

std::vector<std::int64_t> places_of(const Faces &faces) {
  return equal_places(view(faces.xyz).size() / 3, faces.xyz.data());
}

std::vector<std::int32_t> pieces_of(const Faces &faces) {
  const std::vector<std::int64_t> places = places_of(faces);
  const std::int64_t n_corners = faces.corners_per_face, n_faces = view(faces.vertex_ids).size() / n_corners;
  const auto place = [&](std::int64_t corner) { return view(places)[view(faces.vertex_ids)[corner]]; };
  DisjointSets sets(view(places).size());
  for (std::int64_t face = 0; face < n_faces; ++face)
    for (std::int64_t k = 1; k < n_corners; ++k) sets.unite(place(n_corners * face), place(n_corners * face + k));
  std::vector<std::int32_t> piece_of_set(places.size(), -1), pieces;
  std::int32_t n_pieces = 0;
  for (std::int64_t face = 0; face < n_faces; ++face) {
    std::int32_t &piece = view(piece_of_set)[sets.root(place(n_corners * face))];
    if (piece < 0) piece = n_pieces++;
    pieces.push_back(piece);
  }
  return pieces;
}

void give_arrays(const Faces &faces, riis_surface_arrays *arrays, std::int64_t struct_size) {
  riis_surface_arrays whole;
  check_core(riis_surface_arrays_init(&whole, sizeof whole));
  const double *const xyz = faces.xyz.data();
  whole.n_vertices = static_cast<int64_t>(faces.xyz.size() / 3);
  whole.x = xyz;
  whole.y = xyz + 1;
  whole.z = xyz + 2;
  whole.stride = 3;
  whole.n_faces = static_cast<int64_t>(faces.vertex_ids.size()) / faces.corners_per_face;
  whole.vertex_ids = faces.vertex_ids.data();
  whole.id_bits = 64;
  whole.corners_per_face = faces.corners_per_face;
  whole.leaflet_id = faces.leaflet_id.empty() ? nullptr : faces.leaflet_id.data();
  whole.attached = faces.attached.empty() ? nullptr : faces.attached.data();
  // The struct of an older caller ends before the newest fields.
  check_core(riis_surface_arrays_init(arrays, struct_size));
  whole.struct_size = struct_size;
  std::memcpy(arrays, &whole, static_cast<std::size_t>(struct_size));
}

}  // namespace riis::vtk
