// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <utility>

#include "module.hpp"

namespace riis_python {
namespace {

void create(Mesh *self, nb::handle xyz, nb::handle y, nb::handle z) {
  Points points = points_of(xyz, y, z);
  new (self) Mesh();
  try {
    call_library(
        [&] { return riis_mesh_create(points.n, points.x, points.y, points.z, points.stride, &self->handle); });
    self->points = std::move(points);
  } catch (...) {
    self->~Mesh();
    throw;
  }
}

void drop_adjacency(Mesh &mesh) {
  mesh.rows.clear();
  mesh.adjacency = nb::object();
}

// A call without arguments says that the coordinates have changed in place.
void update(Mesh &self, nb::handle xyz, nb::handle y, nb::handle z) {
  const Writing writing(self.usage, "mesh");
  const bool in_place = xyz.is_none() && y.is_none() && z.is_none();
  if (in_place && self.is_grid) refuse_value("xyz", "must be given, because the mesh is a grid: see update_grid");
  Points given = in_place ? Points{} : points_of(xyz, y, z);
  const Points &points = in_place ? self.points : given;
  const bool is_other_size = points.n != self.points.n;
  self.places = Mesh::new_places();
  self.judged_nodes = nb::object();
  call_to_write(self.usage,
                [&] { return riis_mesh_update(self.handle, points.n, points.x, points.y, points.z, points.stride); });
  if (!in_place) self.points = std::move(given);
  self.is_grid = false;
  if (is_other_size) drop_adjacency(self);
}

// Calls the library with a grid. The numbers of the grid's nodes are those of an array (len(x), len(y), len(z)), unless the
// caller gives strides.
void take_grid(Mesh &mesh, nb::handle x, nb::handle y, nb::handle z, nb::handle first, nb::handle stride,
               nb::handle n_nodes) {
  riis_grid grid;
  call_shortly(riis_grid_init(&grid, sizeof grid));
  Points axes;
  for (const auto &[axis, name] : {std::pair(x, "x"), std::pair(y, "y"), std::pair(z, "z")}) {
    axes.arrays.push_back(Array::of<double>(axis, name));
    axes.arrays.back().expect({-1});
  }
  grid.ni = axes.arrays[0].size(0), grid.nj = axes.arrays[1].size(0), grid.nk = axes.arrays[2].size(0);
  grid.x = axes.arrays[0].data<void>(), grid.y = axes.arrays[1].data<void>(), grid.z = axes.arrays[2].data<void>();
  grid.first = integer(first, "first");
  grid.n_nodes = integer(n_nodes, "n_nodes");
  if (stride.is_none()) {
    // The library refuses larger products by their factors.
    constexpr std::int64_t most = std::int64_t{1} << 40;
    const bool is_small = grid.nk < most && grid.nj < most / std::max<std::int64_t>(grid.nk, 1);
    grid.stride[0] = is_small ? grid.nj * grid.nk : most;
    grid.stride[1] = grid.nk;
    grid.stride[2] = 1;
  } else {
    const Array given = Array::of<std::int64_t>(stride, "stride");
    given.expect({3});
    std::copy_n(given.data<std::int64_t>(), 3, grid.stride);
  }
  std::int64_t last = grid.first;
  if (mesh.handle)
    call_to_write(mesh.usage, [&] { return riis_mesh_update_grid(mesh.handle, &grid); });
  else
    call_library([&] { return riis_mesh_create_grid(&grid, &mesh.handle); });
  const std::int64_t extents[3] = {grid.ni, grid.nj, grid.nk};
  for (int axis = 0; axis < 3; ++axis)
    if (extents[axis] > 1) last += (extents[axis] - 1) * grid.stride[axis];
  axes.n = grid.n_nodes ? grid.n_nodes : last + 1;
  mesh.points = std::move(axes);
  mesh.is_grid = true;
}

Mesh *create_grid(nb::handle x, nb::handle y, nb::handle z, nb::handle first, nb::handle stride, nb::handle n_nodes) {
  auto made = std::make_unique<Mesh>();
  take_grid(*made, x, y, z, first, stride, n_nodes);
  return made.release();
}

void update_grid(Mesh &self, nb::handle x, nb::handle y, nb::handle z, nb::handle first, nb::handle stride,
                 nb::handle n_nodes) {
  const Writing writing(self.usage, "mesh");
  self.places = Mesh::new_places();
  self.judged_nodes = nb::object();
  take_grid(self, x, y, z, first, stride, n_nodes);
  drop_adjacency(self);
}

void prepare(Mesh &self, nb::handle n_threads) {
  const Writing writing(self.usage, "mesh");
  const std::int32_t n = thread_count(n_threads);
  call_to_write(self.usage, [&] { return riis_mesh_prepare(self.handle, n); });
}

riis_csr empty_rows() {
  riis_csr csr;
  call_shortly(riis_csr_init(&csr, sizeof csr));
  return csr;
}

void set_adjacency(Mesh &self, nb::handle adjacency, nb::handle offsets_, nb::handle columns_, nb::handle n_all,
                   nb::handle index_base) {
  const Writing writing(self.usage, "mesh");
  nb::object offsets = nb::borrow(offsets_), columns = nb::borrow(columns_);
  if (!adjacency.is_none() && (!offsets.is_none() || !columns.is_none()))
    refuse_value("adjacency", "cannot be combined with offsets and columns");
  riis_csr csr = empty_rows();
  std::vector<Array> rows;
  nb::object kept;
  if (nb::isinstance<Adjacency>(adjacency)) {
    Adjacency &made = object<Adjacency>(adjacency, "adjacency");
    const Reading reading(made.usage, "adjacency");
    call_shortly(riis_adjacency_get_csr(made.handle, &csr, sizeof csr));
    kept = made.share();
  } else {
    if (!adjacency.is_none()) {
      if (!nb::hasattr(adjacency, "indptr") || !nb::hasattr(adjacency, "indices"))
        refuse_type("adjacency", "must be a riis.Adjacency, or sparse rows with indptr and indices, not ",
                    name_of_type(adjacency));
      offsets = adjacency.attr("indptr");
      columns = adjacency.attr("indices");
    }
    if (offsets.is_none() != columns.is_none())
      refuse_value("offsets", "and columns must both be given; one of them is None");
    if (!offsets.is_none()) {
      rows.push_back(Array::of_integers(offsets, "offsets"));
      rows.push_back(Array::of_integers(columns, "columns"));
      rows[0].expect({self.points.n + 1});
      rows[1].expect({-1});
      csr.n_rows = self.points.n;
      csr.n_all = integer(n_all, "n_all");
      csr.offsets = rows[0].data<void>();
      csr.columns = rows[1].data<void>();
      csr.offset_bits = rows[0].bits();
      csr.column_bits = rows[1].bits();
      csr.index_base = integer32(index_base, "index_base");
      const auto last = self.points.n;
      const std::int64_t end =
          csr.offset_bits == 64 ? rows[0].data<std::int64_t>()[last] : rows[0].data<std::int32_t>()[last];
      if (end - csr.index_base > rows[1].size(0))
        refuse_value("offsets", "end at ", end, "; columns has ", rows[1].size(0), " entries");
    }
  }
  const bool is_taken_away = !kept.is_valid() && rows.empty();
  call_to_write(self.usage, [&] { return riis_mesh_set_adjacency(self.handle, is_taken_away ? nullptr : &csr); });
  self.rows = std::move(rows);
  self.adjacency = std::move(kept);
}

// Makes an adjacency. make(&handle) calls the library.
template <class Make>
Adjacency *new_adjacency(const Make &make) {
  auto made = std::make_unique<Adjacency>();
  call_library([&] { return make(&made->handle); });
  return made.release();
}

Adjacency *from_cells(nb::handle nodes, nb::handle n_nodes, nb::handle offsets_, nb::handle index_base,
                      nb::handle n_threads) {
  riis_mesh_cells cells;
  call_shortly(riis_mesh_cells_init(&cells, sizeof cells));
  const Array ids = Array::of_integers(nodes, "cells");
  cells.n_nodes = integer(n_nodes, "n_nodes");
  cells.node_ids = ids.data<void>();
  cells.id_bits = ids.bits();
  cells.index_base = integer32(index_base, "index_base");
  cells.n_threads = thread_count(n_threads);
  std::optional<Array> offsets;
  if (offsets_.is_none()) {
    if (ids.n_dimensions() == 1)
      refuse_value("cells", "its shape is (", ids.size(0),
                   ",); without offsets it must be (n, 4, 5, 6 or 8). A mesh of PyVista has such arrays in "
                   "grid.cells_dict, such as grid.cells_dict[10] for tetrahedra. Or pass grid.cell_connectivity with "
                   "offsets=grid.offset");
    ids.expect({-1, -1});
    cells.n_cells = ids.size(0);
    cells.nodes_per_cell = static_cast<std::int32_t>(ids.size(1));
    if (ids.size(1) < 4 || ids.size(1) == 7 || ids.size(1) > 8)
      refuse_value("cells", "has ", ids.size(1), " nodes per cell; it must be 4, 5, 6 or 8");
  } else {
    ids.expect({-1});
    offsets.emplace(cells.id_bits == 64 ? Array::of<std::int64_t>(offsets_, "offsets")
                                        : Array::of<std::int32_t>(offsets_, "offsets"));
    offsets->expect({-1});
    if (offsets->size(0) < 1) refuse_value("offsets", "is empty; it must have one entry more than there are cells");
    cells.n_cells = offsets->size(0) - 1;
    cells.offsets = offsets->data<void>();
    const auto entry = [&](std::int64_t i) {
      return cells.id_bits == 64 ? offsets->data<std::int64_t>()[i] : std::int64_t{offsets->data<std::int32_t>()[i]};
    };
    const std::int64_t n_ids = entry(cells.n_cells) - entry(0);
    if (n_ids > ids.size(0)) refuse_value("offsets", "span ", n_ids, " nodes; cells has ", ids.size(0));
  }
  return new_adjacency([&](riis_adjacency **made) { return riis_adjacency_create_from_cells(&cells, made); });
}

Adjacency *from_faces(nb::handle owner_, nb::handle neighbor_, nb::handle n_cells, nb::handle index_base,
                      nb::handle n_threads) {
  riis_mesh_faces faces;
  call_shortly(riis_mesh_faces_init(&faces, sizeof faces));
  const Array owner = Array::of_integers(owner_, "owner");
  owner.expect({-1});
  const Array neighbor = owner.bits() == 64 ? Array::of<std::int64_t>(neighbor_, "neighbor")
                                            : Array::of<std::int32_t>(neighbor_, "neighbor");
  neighbor.expect({owner.size(0)});
  faces.n_cells = integer(n_cells, "n_cells");
  faces.n_faces = owner.size(0);
  faces.owner = owner.data<void>();
  faces.neighbor = neighbor.data<void>();
  faces.id_bits = owner.bits();
  faces.index_base = integer32(index_base, "index_base");
  faces.n_threads = thread_count(n_threads);
  return new_adjacency([&](riis_adjacency **made) { return riis_adjacency_create_from_faces(&faces, made); });
}

Adjacency *from_grid(nb::handle ni_, nb::handle nj_, nb::handle nk_, nb::handle n_threads) {
  const std::int64_t ni = integer(ni_, "ni"), nj = integer(nj_, "nj"), nk = integer(nk_, "nk");
  const std::int32_t n = thread_count(n_threads);
  return new_adjacency([&](riis_adjacency **made) { return riis_adjacency_create_from_grid(ni, nj, nk, n, made); });
}

riis_csr rows_of(Adjacency &adjacency) {
  const Reading reading(adjacency.usage, "adjacency");
  riis_csr csr = empty_rows();
  call_shortly(riis_adjacency_get_csr(adjacency.handle, &csr, sizeof csr));
  return csr;
}

template <class T>
std::size_t last_offset(const void *offsets, std::int64_t n_rows) {
  return offsets ? static_cast<std::size_t>(static_cast<const T *>(offsets)[n_rows]) : 0;
}

nb::object offsets(nb::handle self) {
  Adjacency &adjacency = object<Adjacency>(self, "adjacency");
  const riis_csr csr = rows_of(adjacency);
  return view_of(static_cast<const std::int64_t *>(csr.offsets), {static_cast<std::size_t>(csr.n_rows) + 1},
                 adjacency.share());
}

nb::object columns(nb::handle self) {
  Adjacency &adjacency = object<Adjacency>(self, "adjacency");
  const riis_csr csr = rows_of(adjacency);
  const std::size_t n = last_offset<std::int64_t>(csr.offsets, csr.n_rows);
  if (csr.column_bits == 32) return view_of(static_cast<const std::int32_t *>(csr.columns), {n}, adjacency.share());
  return view_of(static_cast<const std::int64_t *>(csr.columns), {n}, adjacency.share());
}

// Returns the caller's array, or a new array from the caller's three arrays.
nb::object coordinates(Mesh &mesh) {
  const Reading reading(mesh.usage, "mesh");
  const std::vector<Array> &arrays = mesh.points.arrays;
  if (mesh.is_grid) refuse_value("mesh", "a grid stores no coordinates of nodes; axes are its axes");
  if (arrays.size() == 1) return arrays[0].object();
  nb::list columns;
  for (const Array &array : arrays) columns.append(array.object());
  return nb::module_::import_("numpy").attr("stack")(columns, nb::arg("axis") = 1);
}

// Returns the axes of a grid.
nb::object axes_of(Mesh &mesh) {
  const Reading reading(mesh.usage, "mesh");
  if (!mesh.is_grid) refuse_value("mesh", "is no grid, so it has no axes");
  const std::vector<Array> &axes = mesh.points.arrays;
  return nb::make_tuple(axes[0].object(), axes[1].object(), axes[2].object());
}

std::string description(const Mesh &mesh) {
  if (mesh.usage.is_closed) return "<riis.Mesh, closed>";
  if (mesh.is_grid) {
    const std::vector<Array> &axes = mesh.points.arrays;
    return text_of("<riis.Mesh, grid of ", axes[0].size(0), " x ", axes[1].size(0), " x ", axes[2].size(0), " nodes>");
  }
  return text_of("<riis.Mesh, ", mesh.points.n, " nodes>");
}

#define RIIS_COORDINATES "numpy.typing.NDArray[numpy.float64]"
#define RIIS_IDS "numpy.typing.NDArray[numpy.integer]"

void add_adjacency(nb::module_ &module) {
  nb::class_<Adjacency> adjacency(module, "Adjacency",
                                  R"(Neighbours of nodes, as compressed sparse rows that the library owns.

from_cells, from_faces and from_grid make one. Columns ascend without repetition, and the rows are symmetric.)");
  adjacency
      .def_static("from_cells", &from_cells, nb::arg("cells").none(), nb::arg("n_nodes").none(), nb::kw_only(),
                  nb::arg("offsets").none() = nb::none(), nb::arg("index_base").none() = 0,
                  nb::arg("n_threads").none() = 0,
                  nb::sig("def from_cells(cells: " RIIS_IDS ", n_nodes: int, *, offsets: " RIIS_IDS
                          " | None = None, index_base: int = 0, n_threads: int = 0) -> Adjacency"),
                  R"(Makes an adjacency from cells. Nodes that an edge of a cell joins are neighbours.

cells    (n_cells, 4, 5, 6 or 8) int32 or int64: tetrahedra, pyramids, prisms or hexahedra in the order of VTK; or, with
         offsets, (n,): the nodes of all cells, one cell after the other
n_nodes  the mesh's number of nodes
offsets  (n_cells + 1,) of the same type as cells: where each cell begins in cells, and where the last cell ends)")
      .def_static(
          "from_faces", &from_faces, nb::arg("owner").none(), nb::arg("neighbor").none(), nb::arg("n_cells").none(),
          nb::kw_only(), nb::arg("index_base").none() = 0, nb::arg("n_threads").none() = 0,
          nb::sig("def from_faces(owner: " RIIS_IDS ", neighbor: " RIIS_IDS
                  ", n_cells: int, *, index_base: int = 0, n_threads: int = 0) -> Adjacency"),
          R"(Makes an adjacency from faces, for codes that mark cell centres. Cells that share a face are neighbours.

owner, neighbor  (n_faces,) int32 or int64, both of one type: the cells that a face joins; neighbor is index_base - 1 at
                 the boundary)")
      .def_static("from_grid", &from_grid, nb::arg("ni").none(), nb::arg("nj").none(), nb::arg("nk").none(),
                  nb::kw_only(), nb::arg("n_threads").none() = 0,
                  nb::sig("def from_grid(ni: int, nj: int, nk: int, *, n_threads: int = 0) -> Adjacency"),
                  "Makes the adjacency of a structured grid. Node (i, j, k) has the number i + ni (j + nj k).")
      .def_prop_ro("offsets", attribute(&offsets), nb::sig("def offsets(self) -> numpy.typing.NDArray[numpy.int64]"),
                   "(n_rows + 1,): where each row begins in columns, and where the last row ends. A view.")
      .def_prop_ro("columns", attribute(&columns), nb::sig("def columns(self) -> " RIIS_IDS),
                   "The neighbours, one row after the other: int32 for fewer than 2**31 nodes, else int64. A view.")
      .def("__len__", [](Adjacency &self) { return static_cast<std::size_t>(rows_of(self).n_rows); })
      .def("__repr__", [](Adjacency &self) {
        return self.usage.is_closed ? std::string("<riis.Adjacency, closed>")
                                    : text_of("<riis.Adjacency, ", rows_of(self).n_rows, " rows>");
      });
  refuse_pickle(adjacency, "keep its offsets and columns, which Mesh.set_adjacency takes");
  add_closing(adjacency);
}

}  // namespace

std::int64_t Mesh::new_places() {
  static std::int64_t n = 0;  // accessed only under the interpreter's lock
  return ++n;
}

void Mesh::close(const char *name) {
  Handle::close(name);
  points = Points{};
  judged_nodes = nb::object();
  drop_adjacency(*this);
}

void add_mesh(nb::module_ &module) {
  add_adjacency(module);
  nb::class_<Mesh> mesh(module, "Mesh", R"(The nodes that are marked. Their coordinates are borrowed, not copied.

xyz is (n, 3) float64 of any forward strides, in C or Fortran order, mesh units; or x, y and z are (n,) float64 with
equal strides. The mesh keeps the arrays alive. Call update() after every change of the coordinates.)");
  mesh.def("__init__", &create, nb::arg("xyz").none(), nb::arg("y").none() = nb::none(),
           nb::arg("z").none() = nb::none(),
           nb::sig("def __init__(self, xyz: " RIIS_COORDINATES ", y: " RIIS_COORDINATES
                   " | None = None, z: " RIIS_COORDINATES " | None = None) -> None"))
      .def("update", &update, nb::arg("xyz").none() = nb::none(), nb::arg("y").none() = nb::none(),
           nb::arg("z").none() = nb::none(),
           nb::sig("def update(self, xyz: " RIIS_COORDINATES " | None = None, y: " RIIS_COORDINATES
                   " | None = None, z: " RIIS_COORDINATES " | None = None) -> None"),
           R"(Tells the mesh that coordinates changed, in place (no argument) or to other arrays, and checks them.

The adjacency stays if the number of nodes stays.)")
      .def_static("grid", &create_grid, nb::arg("x").none(), nb::arg("y").none(), nb::arg("z").none(), nb::kw_only(),
                  nb::arg("first").none() = 0, nb::arg("stride").none() = nb::none(), nb::arg("n_nodes").none() = 0,
                  nb::sig("def grid(x: " RIIS_COORDINATES ", y: " RIIS_COORDINATES ", z: " RIIS_COORDINATES
                          ", *, first: int = 0, stride: " RIIS_IDS " | None = None, n_nodes: int = 0) -> Mesh"),
                  R"(Makes a mesh from the axes of a rectilinear grid, and stores nothing for each node.

Node (i, j, k) is at x[i], y[j], z[k], and has the number first + i stride[0] + j stride[1] + k stride[2]. By default the
numbers are those of an array K with K.shape = (len(x), len(y), len(z)) in C order. The edges join neighbours along the axes.

x, y, z  (n,) float64, strictly ascending; copied
stride   (3,) int64. None: C order
n_nodes  the length of the caller's arrays, which may have a halo. 0: the least length)")
      .def("update_grid", &update_grid, nb::arg("x").none(), nb::arg("y").none(), nb::arg("z").none(), nb::kw_only(),
           nb::arg("first").none() = 0, nb::arg("stride").none() = nb::none(), nb::arg("n_nodes").none() = 0,
           nb::sig("def update_grid(self, x: " RIIS_COORDINATES ", y: " RIIS_COORDINATES ", z: " RIIS_COORDINATES
                   ", *, first: int = 0, stride: " RIIS_IDS " | None = None, n_nodes: int = 0) -> None"),
           "Gives the mesh other axes, as in grid. A mesh may change between a grid and coordinates of nodes.")
      .def_prop_ro("axes", attribute(&axes_of),
                   nb::sig("def axes(self) -> tuple[" RIIS_COORDINATES ", " RIIS_COORDINATES ", " RIIS_COORDINATES "]"),
                   "x, y and z of a grid: the caller's arrays.")
      .def("prepare", &prepare, nb::arg("n_threads").none() = 0,
           nb::sig("def prepare(self, n_threads: int = 0) -> None"),
           "Makes the clusters of search='clusters' now, not in the second marking. They take 41 bytes per node.")
      .def(
          "set_adjacency", &set_adjacency, nb::arg("adjacency").none() = nb::none(), nb::kw_only(),
          nb::arg("offsets").none() = nb::none(), nb::arg("columns").none() = nb::none(), nb::arg("n_all").none() = 0,
          nb::arg("index_base").none() = 0,
          nb::sig("def set_adjacency(self, adjacency: typing.Any = None, *, offsets: " RIIS_IDS
                  " | None = None, columns: " RIIS_IDS " | None = None, n_all: int = 0, index_base: int = 0) -> None"),
          R"(Gives the mesh the neighbours of its nodes, which are borrowed and kept alive. Without arguments, removes them.

adjacency         an Adjacency, or scipy's sparse rows (indptr, indices)
offsets, columns  (n_nodes + 1,) and (n,), int32 or int64: the same rows as arrays, which must not change while in use
n_all             n_nodes plus the number of ghost nodes, which columns may name. 0: n_nodes
index_base        the first number in offsets and columns, 0 or 1)")
      .def_prop_ro("xyz", attribute(&coordinates), nb::sig("def xyz(self) -> " RIIS_COORDINATES),
                   "(n, 3): the coordinates. This is the caller's array, or a new array if the caller gave three.")
      .def_prop_ro("n_nodes", attribute(+[](Mesh &self) {
                     self.usage.check("mesh");
                     return self.points.n;
                   }),
                   nb::sig("def n_nodes(self) -> int"), "The number of nodes.")
      .def_prop_ro("_places", [](const Mesh &self) { return self.places; })
      .def_prop_ro("_has_edges",
                   [](const Mesh &self) { return self.is_grid || self.adjacency.is_valid() || !self.rows.empty(); })
      .def_prop_rw(
          "_judged_nodes",
          [](const Mesh &self) { return self.judged_nodes.is_valid() ? self.judged_nodes : nb::none(); },
          [](Mesh &self, const nb::object &nodes) { self.judged_nodes = nodes; })
      .def("__len__",
           [](Mesh &self) {
             self.usage.check("mesh");
             return static_cast<std::size_t>(self.points.n);
           })
      .def("__repr__", &description);
  refuse_pickle(mesh, "keep mesh.xyz, and make the mesh from it");
  add_closing(mesh);
}

}  // namespace riis_python
