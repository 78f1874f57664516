// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_mesh_*, riis_csr_* and riis_adjacency_*: the caller's nodes and their neighbours.
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"

using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;

namespace {

const riis_grid default_grid{sizeof(riis_grid), 0,         0, 0,         nullptr, nullptr, nullptr,
                             {0, 0, 0},         {1, 1, 1}, 0, {0, 0, 0}, 0,       64,      0};
const riis_csr default_csr{sizeof(riis_csr), 0, 0, nullptr, nullptr, 32, 32, 0, 0};
const riis_mesh_cells default_cells{sizeof(riis_mesh_cells), 0, 0, nullptr, nullptr, 4, 32, 0, 0};
const riis_mesh_faces default_faces{sizeof(riis_mesh_faces), 0, 0, nullptr, nullptr, 1, 32, 0, 0, 0};

void check_n_nodes(std::int64_t n, const char *name) {
  if (n < 0) riis::fail(RIIS_INVALID_MESH, name, " is ", n, "; it must be at least 0");
  if (n > riis::max_nodes) riis::fail(RIIS_LIMIT_EXCEEDED, name, " is ", n, "; it must be at most ", riis::max_nodes);
}

// Checks the nodes and returns their box, which is empty without nodes.
riis::Bounds check_nodes(const riis::StridedPoints &nodes) {
  check_n_nodes(nodes.n, "n_nodes");
  if (nodes.n == 0) return {};
  return riis::check_points(nodes, "node", RIIS_INVALID_MESH);
}

void copy_nodes(const riis_points *given, riis::Mesh &mesh) {
  const riis_points whole = riis::completed(require(given, "nodes"), "nodes", riis::default_points);
  riis::check_bits("nodes.real_bits", whole.real_bits);
  riis::check_reserved("nodes.reserved", whole.reserved);
  check_n_nodes(whole.n_points, "nodes.n_points");
  riis::with_points(whole.n_points, {whole.x, whole.y, whole.z}, whole.stride, whole.real_bits, [&](const auto &nodes) {
    const riis::Bounds bounds =
        nodes.n == 0 ? riis::Bounds{} : riis::check_points(nodes, "node", RIIS_INVALID_MESH, "nodes.");
    mesh.copy_nodes(nodes, bounds);
  });
}

// Fails with RIIS_INVALID_MESH at the first coordinate of an axis that is unusable, or that is not above the previous one.
void check_axis(const char *name, const std::vector<double> &axis) {
  for (std::int64_t i = 0; i < riis::view(axis).size(); ++i) {
    const double x = riis::view(axis)[i];
    if (!riis::is_usable(x))
      riis::fail(RIIS_INVALID_MESH, "grid.", name, "[", i, "] is ", x, "; it must be finite and at most ",
                 riis::max_coordinate, " in magnitude");
    if (i > 0 && !(x > riis::view(axis)[i - 1]))
      riis::fail(RIIS_INVALID_MESH, "grid.", name, "[", i, "] is ", x, ", after ", riis::view(axis)[i - 1],
                 "; the axis must strictly ascend");
  }
}

std::unique_ptr<const riis::Grid> checked_grid(const riis_grid *given) {
  const riis_grid whole = riis::completed(require(given, "grid"), "grid", default_grid);
  riis::check_bits("grid.real_bits", whole.real_bits);
  riis::check_reserved("grid.reserved", whole.reserved);
  const riis::GridIndex n{whole.ni, whole.nj, whole.nk};
  const char *const names[] = {"x", "y", "z"}, *const counts[] = {"ni", "nj", "nk"};
  for (int axis = 0; axis < 3; ++axis)
    if (n[axis] < 1) riis::fail(RIIS_INVALID_MESH, "grid.", counts[axis], " is ", n[axis], "; it must be at least 1");
  std::int64_t n_numbers = whole.n_nodes;
  const riis::GridIndex stride =
      riis::checked_strides(n, whole.first, {whole.stride[0], whole.stride[1], whole.stride[2]}, n_numbers);
  const void *const arrays[] = {whole.x, whole.y, whole.z};
  riis::Grid::Axes axes;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> &made = riis::view(axes)[axis];
    riis::resize(made, n[axis]);
    const auto *const doubles = static_cast<const double *>(arrays[axis]);
    const auto *const floats = static_cast<const float *>(arrays[axis]);
    for (std::int64_t i = 0; i < n[axis]; ++i)
      riis::view(made)[i] = !doubles                ? whole.origin[axis] + static_cast<double>(i) * whole.spacing[axis]
                            : whole.real_bits == 32 ? static_cast<double>(floats[i])
                                                    : doubles[i];
    check_axis(names[axis], made);
  }
  return std::make_unique<const riis::Grid>(std::move(axes), whole.first, stride, n_numbers);
}

// Refuses an edge at a number that has no node. A grid may have such numbers, for example as padding.
void check_rows_of_grid(const riis::Adjacency &rows, const riis::MeshNodes &nodes) {
  for (std::int64_t i = 0; i < rows.n_rows; ++i)
    rows.for_each_neighbor(i, [&](std::int64_t j) {
      if (!nodes.has_node(i) || !nodes.has_node(j))
        riis::fail(RIIS_INVALID_MESH, "row ", i, " of the adjacency has the column ", j + rows.base, ", but ",
                   nodes.has_node(i) ? "this" : "the row", " is no node of the grid");
    });
}

}  // namespace

extern "C" {

riis_status riis_mesh_create(int64_t n_nodes, const double *x, const double *y, const double *z, int64_t stride,
                             riis_mesh **mesh) {
  return guarded_with_handles([&] {
    require(mesh, "mesh");
    const riis::StridedPoints nodes{n_nodes, x, y, z, stride};
    *mesh = new riis_mesh(nodes, check_nodes(nodes));
  });
}

riis_status riis_mesh_update(riis_mesh *mesh, int64_t n_nodes, const double *x, const double *y, const double *z,
                             int64_t stride) {
  return guarded_with_handles([&] {
    riis::Mesh &content = require_handle(mesh, "mesh")->mesh;
    // The nodes have moved, so their stored places are wrong even if the new coordinates are refused.
    content.forget_places();
    const riis::StridedPoints nodes{n_nodes, x, y, z, stride};
    content.borrow_nodes(nodes, check_nodes(nodes));
  });
}

riis_status riis_mesh_create_copy(const riis_points *nodes, riis_mesh **mesh) {
  return guarded_with_handles([&] {
    require(mesh, "mesh");
    auto made = std::make_unique<riis_mesh>(riis::StridedPoints{0, nullptr, nullptr, nullptr, 1}, riis::Bounds{});
    copy_nodes(nodes, made->mesh);
    *mesh = made.release();
  });
}

riis_status riis_mesh_update_copy(riis_mesh *mesh, const riis_points *nodes) {
  return guarded_with_handles([&] { copy_nodes(nodes, require_handle(mesh, "mesh")->mesh); });
}

riis_status riis_mesh_prepare(riis_mesh *mesh, int32_t n_threads) {
  return guarded_with_handles([&] {
    const riis_mesh *const as_read = mesh;  // const, so that other threads may prepare this mesh at the same time
    const riis::Mesh &content = require_handle(as_read, "mesh")->mesh;
    const int n = riis::threads_for(n_threads, "n_threads", content.nodes().n, riis::nodes_per_thread);
    if (content.nodes().grid) return;
    if (content.nodes().n > riis::max_clustered_nodes)
      riis::fail(RIIS_LIMIT_EXCEEDED, "a mesh of ", content.nodes().n,
                 " nodes is too large for clusters, which hold at most ", riis::max_clustered_nodes);
    if (content.nodes().n > 0) content.clusters(n);
  });
}

RIIS_DEFINE_INIT(riis_grid_init, riis_grid, grid, default_grid)

riis_status riis_mesh_create_grid(const riis_grid *grid, riis_mesh **mesh) {
  return guarded_with_handles([&] {
    require(mesh, "mesh");
    auto made = std::make_unique<riis_mesh>(riis::StridedPoints{0, nullptr, nullptr, nullptr, 1}, riis::Bounds{});
    made->mesh.take_grid(checked_grid(grid));
    *mesh = made.release();
  });
}

riis_status riis_mesh_update_grid(riis_mesh *mesh, const riis_grid *grid) {
  return guarded_with_handles([&] { require_handle(mesh, "mesh")->mesh.take_grid(checked_grid(grid)); });
}

void riis_mesh_destroy(riis_mesh **mesh) { riis::destroy_handle(mesh, "mesh"); }

RIIS_DEFINE_INIT(riis_csr_init, riis_csr, csr, default_csr)

riis_status riis_mesh_set_adjacency(riis_mesh *mesh, const riis_csr *csr) {
  return guarded_with_handles([&] {
    riis::Mesh &content = require_handle(mesh, "mesh")->mesh;
    if (!csr) return content.set_adjacency(std::nullopt);
    const riis::Adjacency rows = riis::checked_adjacency(riis::completed(csr, "csr", default_csr), content.nodes().n);
    if (content.nodes().grid) check_rows_of_grid(rows, content.nodes());
    content.set_adjacency(rows);
  });
}

RIIS_DEFINE_INIT(riis_mesh_cells_init, riis_mesh_cells, cells, default_cells)

riis_status riis_adjacency_create_from_cells(const riis_mesh_cells *cells, riis_adjacency **adjacency) {
  return guarded_with_handles([&] {
    require(adjacency, "adjacency");
    const riis_mesh_cells whole = riis::completed(require(cells, "cells"), "cells", default_cells);
    const int n_threads = riis::threads_for(whole.n_threads, "cells.n_threads", whole.n_cells, riis::nodes_per_thread);
    *adjacency = new riis_adjacency{{}, riis::adjacency_from_cells(whole, n_threads)};
  });
}

RIIS_DEFINE_INIT(riis_mesh_faces_init, riis_mesh_faces, faces, default_faces)

riis_status riis_adjacency_create_from_faces(const riis_mesh_faces *faces, riis_adjacency **adjacency) {
  return guarded_with_handles([&] {
    require(adjacency, "adjacency");
    const riis_mesh_faces whole = riis::completed(require(faces, "faces"), "faces", default_faces);
    const int n_threads = riis::threads_for(whole.n_threads, "faces.n_threads", whole.n_faces, riis::nodes_per_thread);
    *adjacency = new riis_adjacency{{}, riis::adjacency_from_faces(whole, n_threads)};
  });
}

riis_status riis_adjacency_create_from_grid(int64_t ni, int64_t nj, int64_t nk, int32_t n_threads,
                                            riis_adjacency **adjacency) {
  return guarded_with_handles([&] {
    require(adjacency, "adjacency");
    const int n = riis::threads_for(n_threads, "n_threads", riis::nodes_of_grid(ni, nj, nk), riis::nodes_per_thread);
    *adjacency = new riis_adjacency{{}, riis::adjacency_from_grid(ni, nj, nk, n)};
  });
}

riis_status riis_adjacency_get_csr(const riis_adjacency *adjacency, riis_csr *csr, int64_t struct_size) {
  return guarded_with_handles([&] {
    riis_csr value = require_handle(adjacency, "adjacency")->adjacency.csr();
    value.struct_size = struct_size;
    riis::write_struct(csr, struct_size, "csr", value);
  });
}

void riis_adjacency_destroy(riis_adjacency **adjacency) { riis::destroy_handle(adjacency, "adjacency"); }
}
