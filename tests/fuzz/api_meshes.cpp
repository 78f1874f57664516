// SPDX-License-Identifier: Apache-2.0
// Calls of riis_mesh_* and riis_adjacency_*.
#include <algorithm>
#include <cmath>

#include "api_state.hpp"

namespace fuzz {
namespace {

MeshSlot &slot_of(Input &in, State &state) { return state.meshes[in.slot()]; }

// Returns the positions of a few separate nodes, of a lattice, or of a cloud.
std::vector<std::array<double, 3>> places_of(Input &in) {
  std::vector<std::array<double, 3>> places;
  switch (in.below(3)) {
    case 0: {
      const int n = 1 + in.below(24);
      for (int i = 0; i < n; ++i) places.push_back({in.place(), in.place(), in.place()});
      break;
    }
    case 1: {
      const int ni = 1 + in.below(9), nj = 1 + in.below(9), nk = 1 + in.below(9);
      const double h = (1 + in.below(16)) / 16.0, x = in.sound_place(), y = in.sound_place(), z = in.sound_place();
      for (int k = 0; k < nk; ++k)
        for (int j = 0; j < nj; ++j)
          for (int i = 0; i < ni; ++i) places.push_back({x + h * i, y + h * j, z + h * k});
      break;
    }
    default: {
      const int n = 1 + 2 * in.byte();
      std::uint32_t seed = in.raw<std::uint16_t>();
      const auto next = [&seed] {
        return static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / 8388608.0 - 1.0;
      };
      const double size = 1 + in.below(4);
      for (int i = 0; i < n; ++i) places.push_back({size * next(), size * next(), size * next()});
    }
  }
  return places;
}

std::shared_ptr<Nodes> nodes_of(Input &in, const std::vector<std::array<double, 3>> &places) {
  auto nodes = std::make_shared<Nodes>();
  nodes->n = static_cast<std::int64_t>(places.size());
  nodes->stride = 1 + in.below(4);
  const bool are_together = nodes->stride >= 3;
  nodes->buffer.assign(
      static_cast<std::size_t>(are_together ? (nodes->n - 1) * nodes->stride + 3 : 3 * nodes->n * nodes->stride),
      std::nan(""));
  const std::int64_t step = are_together ? 1 : nodes->n * nodes->stride;
  double *base = nodes->buffer.data();
  nodes->x = base, nodes->y = base + step, nodes->z = base + 2 * step;
  for (std::int64_t i = 0; i < nodes->n; ++i)
    for (std::int64_t axis = 0; axis < 3; ++axis)
      base[axis * step + i * nodes->stride] = places[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)];
  return nodes;
}

// Returns the size, or sometimes an impossible size.
std::int64_t spoilt_count(Input &in, std::int64_t n) {
  static const std::int64_t wrong[] = {0, -1, INT64_MIN, INT64_MAX / 7, INT64_MAX};
  return in.one_in(24) ? in.one_of(wrong) : n;
}

std::int64_t spoilt_stride(Input &in, std::int64_t stride) {
  static const std::int64_t wrong[] = {0, -1, INT64_MIN, INT64_MAX};
  return in.one_in(24) ? in.one_of(wrong) : stride;
}

}  // namespace

void make_mesh(Input &in, State &state) {
  MeshSlot &slot = slot_of(in, state);
  const auto nodes = nodes_of(in, places_of(in));
  const std::int64_t n = spoilt_count(in, nodes->n);
  const std::int64_t stride = spoilt_stride(in, nodes->stride);
  const double *x = mostly(in, nodes->x), *y = mostly(in, nodes->y), *z = mostly(in, nodes->z);
  riis_mesh *made =
      made_by<riis_mesh>(in, [&](riis_mesh **mesh) { return riis_mesh_create(n, x, y, z, stride, mesh); });
  if (!made) return;
  riis_mesh_destroy(&slot.handle);
  nodes->n = n;            // 0 is also accepted
  nodes->stride = stride;  // any stride is allowed for a single node
  slot = {made, nodes, nullptr, true};
}

void move_mesh(Input &in, State &state) {
  MeshSlot &slot = slot_of(in, state);
  if (slot.handle && in.one_in(2)) {
    // Moves nodes in place. Some coordinates become infinite or NaN, and some moves come without an update.
    const double shift = in.sound_place();
    for (double &x : slot.nodes->buffer) x += shift;
    if (in.one_in(8)) slot.nodes->buffer[static_cast<std::size_t>(in.byte()) % slot.nodes->buffer.size()] = in.number();
    slot.was_told = false;
    if (in.one_in(4)) return;
    const Given<riis_mesh> mesh = given(in, state, State::mesh, slot.handle);
    const Nodes &nodes = *slot.nodes;
    const riis_status status =
        call(in, [&] { return riis_mesh_update(mesh.handle, nodes.n, nodes.x, nodes.y, nodes.z, nodes.stride); });
    if (!mesh.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
    slot.was_told = status == RIIS_OK;
    return;
  }
  const Given<riis_mesh> mesh = given(in, state, State::mesh, slot.handle);
  const auto nodes = nodes_of(in, places_of(in));
  const std::int64_t n = spoilt_count(in, nodes->n);
  const riis_status status = call(
      in, [&] { return riis_mesh_update(mesh.handle, n, mostly(in, nodes->x), nodes->y, nodes->z, nodes->stride); });
  if (!mesh.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) return;
  nodes->n = n;
  if (nodes->n != slot.nodes->n) slot.adjacency.reset();
  slot.nodes = nodes;
  slot.was_told = true;
}

void prepare_mesh(Input &in, State &state) {
  const MeshSlot &slot = slot_of(in, state);
  const Given<riis_mesh> mesh = given(in, state, State::mesh, slot.handle);
  const std::int32_t n_threads = in.n_threads();
  const riis_status status = call(in, [&] { return riis_mesh_prepare(mesh.handle, n_threads); });
  if (!mesh.is_right || n_threads < 0 || n_threads > 1024)
    EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  else
    EXPECT(status == RIIS_OK || (status == RIIS_INVALID_MESH && !slot.was_told), "%d: %s", status, riis_last_error());
}

void give_rows(Input &in, State &state) {
  MeshSlot &slot = slot_of(in, state);
  const Given<riis_mesh> mesh = given(in, state, State::mesh, slot.handle);
  const std::int64_t n = slot.handle ? slot.nodes->n : 1 + in.below(4);
  riis_csr csr = initialised(in, riis_csr_init);
  csr.index_base = in.mostly(in.below(2));
  const std::int64_t base = csr.index_base == 1 ? 1 : 0, n_ghosts = in.below(4);
  std::vector<std::int64_t> offsets = {base}, columns;
  const int kind = in.below(4);
  std::uint32_t seed = kind == 3 ? in.raw<std::uint16_t>() : 0u;
  for (std::int64_t i = 0; i < n; ++i) {
    if (kind <= 1) {  // cells in a chain
      if (i > 0) columns.push_back(i - 1 + base);
      if (i + 1 < n) columns.push_back(i + 1 + base);
    } else if (kind == 3) {  // arbitrary rows
      for (std::uint32_t k = (seed = seed * 1664525u + 1013904223u) >> 29; k > 0; --k)
        columns.push_back((seed = seed * 1664525u + 1013904223u) % (n + n_ghosts) + base);
    }
    offsets.push_back(base + static_cast<std::int64_t>(columns.size()));
  }
  // Offsets may be out of order. The last offset never exceeds the number of columns, because the library takes the number of
  // columns from it.
  if (in.one_in(12) && n > 1)
    offsets[1 + static_cast<std::size_t>(in.byte()) % (offsets.size() - 2)] =
        in.one_in(2) ? in.raw<std::int64_t>() : in.below(64) - 8;
  if (in.one_in(24)) offsets[0] = in.below(4) - 1;
  if (in.one_in(12) && !columns.empty())
    columns[static_cast<std::size_t>(in.byte()) % columns.size()] =
        in.one_in(2) ? in.raw<std::int64_t>() : n + n_ghosts + base;
  const bool wide_offsets = in.one_in(2), wide_columns = in.one_in(2);
  csr.offset_bits = wide_offsets ? 64 : 32;
  csr.column_bits = wide_columns ? 64 : 32;
  if (in.one_in(32)) csr.offset_bits = 16;
  if (in.one_in(32)) csr.column_bits = 0;
  csr.n_rows = in.one_in(24) ? n + in.below(5) - 2 : n;
  csr.n_all = in.one_in(24) ? in.mostly<std::int64_t>(-1) : n_ghosts || in.one_in(2) ? n + n_ghosts : 0;
  struct Rows {
    Integers offsets, columns;
  };
  const auto rows = std::make_shared<Rows>(Rows{{offsets, wide_offsets}, {columns, wide_columns}});
  csr.offsets = mostly(in, rows->offsets.data());
  csr.columns = mostly(in, rows->columns.data());
  csr.reserved = in.one_in(64) ? 1 : 0;
  const bool takes_away = in.one_in(16);
  const riis_status status =
      call(in, [&] { return riis_mesh_set_adjacency(mesh.handle, takes_away ? nullptr : &csr); });
  if (!mesh.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) return;
  slot.adjacency.reset();
  if (!takes_away) slot.adjacency = rows;
}

namespace {

void put(Input &in, State &state, riis_adjacency *made) {
  if (made) state.adjacencies[in.slot()] = std::make_shared<OwnedAdjacency>(made);
}

// Checks that columns are in ascending order without repeats, and that the rows are symmetric and have base 0.
void check_rows(const riis_csr &csr) {
  EXPECT(csr.offset_bits == 64 && csr.column_bits == 32 && csr.index_base == 0, "%d %d", csr.offset_bits,
         csr.column_bits);
  const auto *offsets = static_cast<const std::int64_t *>(csr.offsets);
  const auto *columns = static_cast<const std::int32_t *>(csr.columns);
  EXPECT(offsets[0] == 0, "%lld", static_cast<long long>(offsets[0]));
  for (std::int64_t i = 0; i < csr.n_rows; ++i)
    for (std::int64_t k = offsets[i]; k < offsets[i + 1]; ++k) {
      const std::int64_t j = columns[k];
      EXPECT(j >= 0 && j < csr.n_rows && j != i, "row %lld has %lld", static_cast<long long>(i),
             static_cast<long long>(j));
      EXPECT(k == offsets[i] || columns[k] > columns[k - 1], "row %lld", static_cast<long long>(i));
      EXPECT(std::binary_search(columns + offsets[j], columns + offsets[j + 1], static_cast<std::int32_t>(i)),
             "%lld has %lld, but not the other way", static_cast<long long>(i), static_cast<long long>(j));
    }
}

}  // namespace

void give_adjacency(Input &in, State &state) {
  MeshSlot &slot = slot_of(in, state);
  const auto adjacency = state.adjacencies[in.slot()];
  const Given<riis_adjacency> from = given(in, state, State::adjacency, adjacency ? adjacency->handle : nullptr);
  const auto csr = std::make_unique<riis_csr>();
  std::memset(static_cast<void *>(csr.get()), 0x5a, sizeof *csr);
  const std::int64_t size = in.mostly<std::int64_t>(sizeof *csr);
  riis_status status = call(in, [&] { return riis_adjacency_get_csr(from.handle, mostly(in, csr.get()), size); });
  if (!from.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(csr->n_rows == 0x5a5a5a5a5a5a5a5a, "refused rows were written");
    return;
  }
  check_rows(*csr);
  const Given<riis_mesh> mesh = given(in, state, State::mesh, slot.handle);
  status = call(in, [&] { return riis_mesh_set_adjacency(mesh.handle, csr.get()); });
  if (!mesh.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status == RIIS_OK) slot.adjacency = adjacency;
}

void make_adjacency_of_cells(Input &in, State &state) {
  riis_mesh_cells cells = initialised(in, riis_mesh_cells_init);
  static const int sizes[] = {4, 5, 6, 8};
  cells.index_base = in.mostly(in.below(2));
  const std::int64_t base = cells.index_base == 1 ? 1 : 0;
  const int n_nodes = 1 + in.below(40), n_cells = 1 + in.below(8), one_size = in.one_of(sizes);
  const bool is_mixed = in.one_in(2), is_wide = in.one_in(2);
  const std::int64_t first = in.below(2) ? base : 0;
  std::vector<std::int64_t> offsets = {first}, ids;
  for (int i = 0; i < n_cells; ++i) {
    const int size = is_mixed ? in.one_of(sizes) : one_size;
    for (int k = 0; k < size; ++k) ids.push_back(in.byte() % n_nodes + base);
    offsets.push_back(first + static_cast<std::int64_t>(ids.size()));
  }
  if (in.one_in(12) && n_cells > 1)
    offsets[1 + static_cast<std::size_t>(in.byte()) % (offsets.size() - 2)] =
        in.one_in(2) ? in.raw<std::int64_t>() : in.below(64) - 8;
  if (in.one_in(24))
    offsets[0] = in.one_in(2) ? in.raw<std::int64_t>() | 2 : -1;  // neither 0 nor 1, which could be valid
  if (in.one_in(12))
    ids[static_cast<std::size_t>(in.byte()) % ids.size()] = in.one_in(2) ? in.raw<std::int64_t>() : n_nodes + base;
  const Integers node_ids(ids, is_wide), begins(offsets, is_wide);
  cells.n_nodes = in.one_in(32) ? in.below(3) - 2 : n_nodes;
  if (in.one_in(64)) cells.n_nodes = std::int64_t{1} << (28 + in.below(35));
  cells.n_cells = in.one_in(32) ? in.below(n_cells + 2) - 2 : n_cells;
  cells.node_ids = mostly(in, node_ids.data());
  cells.offsets = is_mixed ? begins.data() : nullptr;
  cells.nodes_per_cell = is_mixed ? in.below(9) : one_size;
  if (in.one_in(32) && !is_mixed) cells.nodes_per_cell = in.below(4) - 1;
  cells.id_bits = is_wide ? 64 : 32;
  if (in.one_in(32)) cells.id_bits = 33;
  cells.n_threads = in.n_threads();
  const riis_mesh_cells *argument = mostly(in, &cells);
  put(in, state, made_by<riis_adjacency>(in, [&](riis_adjacency **made) {
        return riis_adjacency_create_from_cells(argument, made);
      }));
}

void make_adjacency_of_faces(Input &in, State &state) {
  riis_mesh_faces faces = initialised(in, riis_mesh_faces_init);
  faces.index_base = in.mostly(in.below(2));
  const std::int64_t base = faces.index_base == 1 ? 1 : 0;
  const int n_cells = 1 + in.below(40), n_faces = in.below(24), stride = 1 + in.below(3);
  const bool is_wide = in.one_in(2);
  const std::size_t length = n_faces > 0 ? static_cast<std::size_t>((n_faces - 1) * stride + 1) : 0;
  std::vector<std::int64_t> owner(length, INT32_MAX), neighbor(length, INT32_MIN);
  for (std::size_t i = 0; i < length; i += static_cast<std::size_t>(stride)) {
    owner[i] = in.byte() % n_cells + base;
    neighbor[i] = in.byte() % (n_cells + 1) + base - 1;
  }
  if (in.one_in(12) && length > 0)
    owner[static_cast<std::size_t>(in.byte()) % length] = in.one_in(2) ? in.raw<std::int64_t>() : base - 1;
  if (in.one_in(12) && length > 0)
    neighbor[static_cast<std::size_t>(in.byte()) % length] = in.one_in(2) ? in.raw<std::int64_t>() : base + n_cells;
  const Integers owners(owner, is_wide), neighbors(neighbor, is_wide);
  faces.n_cells = in.one_in(32) ? in.below(3) - 2 : n_cells;
  faces.n_faces = in.one_in(32) ? in.below(n_faces + 1) - 1 : n_faces;
  faces.owner = mostly(in, owners.data());
  faces.neighbor = mostly(in, neighbors.data());
  faces.stride = in.one_in(32) ? in.one_of<std::int64_t>({0, -1, 1025, INT64_MAX, INT64_MIN}) : stride;
  faces.id_bits = is_wide ? 64 : 32;
  if (in.one_in(32)) faces.id_bits = -64;
  faces.n_threads = in.n_threads();
  faces.reserved = in.one_in(64) ? 1 : 0;
  const riis_mesh_faces *argument = mostly(in, &faces);
  put(in, state, made_by<riis_adjacency>(in, [&](riis_adjacency **made) {
        return riis_adjacency_create_from_faces(argument, made);
      }));
}

void make_adjacency_of_grid(Input &in, State &state) {
  const auto side = [&] {
    static const std::int64_t odd[] = {0, -1, 1000, 1 << 20, std::int64_t{1} << 40, INT64_MAX, INT64_MIN};
    return in.one_in(16) ? in.one_of(odd) : 1 + in.below(9);
  };
  const std::int64_t ni = side(), nj = side(), nk = side();
  const std::int32_t n_threads = in.n_threads();
  // Larger grids that fit into memory would only waste time.
  const double n = static_cast<double>(ni) * static_cast<double>(nj) * static_cast<double>(nk);
  if (n > 1e5 && n < 1e9) return;
  put(in, state, made_by<riis_adjacency>(in, [&](riis_adjacency **made) {
        return riis_adjacency_create_from_grid(ni, nj, nk, n_threads, made);
      }));
}

}  // namespace fuzz
