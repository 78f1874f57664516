// SPDX-License-Identifier: Apache-2.0
// The adapted triangulation: grids as coarse as the state of the valve allows.
#include <algorithm>
#include <numeric>
#include <utility>

#include "kernels/kernels.hpp"
#include "parallel/threads.hpp"
#include "triangulate/grids.hpp"
#include "triangulate/tiles.hpp"
#include "triangulate/triangulate.hpp"

namespace riis {
namespace {

// Groups the triangles of a tile by the tile's quads. Writes the triangles to `order`, group by group. Each triangle is in one
// group.
class QuadGroups {
 public:
  QuadGroups(const QuadGrid &grid, const Vector<std::int32_t> &first_of_quad, const TriangleSet &set,
             std::int32_t *order)
      : grid_(grid), first_of_quad_(first_of_quad), set_(set), order_(order) {}

  // Returns the end of each group. `order` begins at 0.
  Vector<std::int32_t> make() {
    const Quads all{0, grid_.u.size() - 1, 0, grid_.v.size() - 1};
    const std::int64_t n = n_triangles(all);
    constexpr std::int64_t fewest_in_group = triangles_per_group / 2;  // most groups have at least this number
    ends_.reserve(static_cast<std::size_t>(n / fewest_in_group + 1));
    group(all, n);
    return std::move(ends_);
  }

 private:
  // The quads of the grid in the columns from i0 to i1 - 1 and the rows from j0 to j1 - 1.
  struct Quads {
    std::size_t i0, i1, j0, j1;
  };

  // The quads of a row are consecutive, and so are their triangles.
  Range triangles_of_row(const Quads &quads, std::size_t j) const {
    const std::size_t n_u = grid_.u.size() - 1;
    return {first_of_quad_[j * n_u + quads.i0], first_of_quad_[j * n_u + quads.i1]};
  }
  std::int64_t n_triangles(const Quads &quads) const {
    std::int64_t n = 0;
    for (std::size_t j = quads.j0; j < quads.j1; ++j) {
      const Range row = triangles_of_row(quads, j);
      n += row.end - row.begin;
    }
    return n;
  }

  // Groups a block of quads with n triangles. The block and then its parts are cut across their longer sides, until the triangles
  // of each part fit in a group.
  void group(const Quads &quads, std::int64_t n) {
    const std::size_t i0 = quads.i0, i1 = quads.i1, j0 = quads.j0, j1 = quads.j1;
    if (n == 0) return;
    if (n <= triangles_per_group) {
      for (std::size_t j = j0; j < j1; ++j) {
        const Range row = triangles_of_row(quads, j);
        for (std::int64_t t = row.begin; t < row.end; ++t) order_[n_ordered_++] = static_cast<std::int32_t>(t);
      }
      ends_.push_back(n_ordered_);
      return;
    }
    if (i1 - i0 == 1 && j1 - j0 == 1) {
      const Range row = triangles_of_row(quads, j0);
      Grouping of_quad;
      group_by_place(set_, static_cast<std::int32_t>(row.begin), static_cast<std::int32_t>(row.end), of_quad);
      for (const std::int32_t end : of_quad.end) ends_.push_back(n_ordered_ + end);
      std::copy(of_quad.order.begin(), of_quad.order.end(), order_ + n_ordered_);
      n_ordered_ += static_cast<std::int32_t>(of_quad.order.size());
      return;
    }
    const std::size_t i = (i0 + i1) / 2, j = (j0 + j1) / 2;
    const bool along_u = j1 - j0 == 1 || (i1 - i0 > 1 && distance(grid_.point(i0, j), grid_.point(i1, j)) >
                                                             distance(grid_.point(i, j0), grid_.point(i, j1)));
    const auto before = [&](std::size_t cut) { return along_u ? Quads{i0, cut, j0, j1} : Quads{i0, i1, j0, cut}; };
    // A cut near the middle makes both parts compact. The cut is made at that place near the middle which gives the fewest
    // groups.
    constexpr std::size_t farthest = 4;
    const std::size_t middle = along_u ? i : j, size = along_u ? i1 - i0 : j1 - j0;
    const auto n_groups = [](std::int64_t n_held) { return (n_held + triangles_per_group - 1) / triangles_per_group; };
    const std::int64_t fewest_possible = n_groups(n);
    std::size_t best = middle;
    std::int64_t n_before_best = 0, fewest = n;
    for (std::size_t off = 0; off <= std::min(farthest, size / 4) && fewest > fewest_possible; ++off)
      for (const std::size_t cut : {middle - off, middle + off}) {
        const std::int64_t n_before = n_triangles(before(cut)), n_needed = n_groups(n_before) + n_groups(n - n_before);
        if (n_needed < fewest) fewest = n_needed, best = cut, n_before_best = n_before;
      }
    group(before(best), n_before_best);
    group(along_u ? Quads{best, i1, j0, j1} : Quads{i0, i1, best, j1}, n - n_before_best);
  }

  const QuadGrid &grid_;
  const Vector<std::int32_t> &first_of_quad_;
  const TriangleSet &set_;
  std::int32_t *const order_;
  std::int32_t n_ordered_ = 0;
  Vector<std::int32_t> ends_;
};

// Joins the groups of all tiles into one list. The gaps between the tiles' triangles are already closed. `ends` has the ends of
// each tile's groups.
void join(const Vector<Tile> &tiles, const Vector<Vector<std::int32_t>> &ends, Grouping &joined) {
  std::int32_t n = 0;
  joined.end.clear();
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto moved_by = static_cast<std::int32_t>(tiles[i].first_triangle - n);
    const auto from = joined.order.begin() + tiles[i].first_triangle;
    if (moved_by != 0)
      std::transform(from, from + tiles[i].n_triangles, joined.order.begin() + n,
                     [moved_by](std::int32_t triangle) { return triangle - moved_by; });
    for (const std::int32_t end : ends[i]) joined.end.push_back(n + end);
    n += static_cast<std::int32_t>(tiles[i].n_triangles);
  }
  joined.order.resize(static_cast<std::size_t>(n));
}

// Makes the triangles of these grids. Returns the patches with missing triangles.
Vector<std::size_t> make_triangles(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids,
                                   TriangleSet &triangles) {
  Tiles tiles(set, how, grids, triangles);
  Vector<Vector<std::int32_t>> ends(tiles.all().size());
  resize(triangles.grouping.order, tiles.room());
  Vector<std::size_t> vanished = tiles.make_triangles([&](std::int64_t i, const Vector<std::int32_t> &first_of_quad) {
    const Tile &tile = view(tiles.all())[i];
    view(ends)[i] = QuadGroups(grids[tile.patch].grid, first_of_quad, triangles,
                               triangles.grouping.order.data() + tile.first_triangle)
                        .make();
    const auto id = triangles.triangle_id.begin() + tile.first_triangle;
    std::iota(id, id + tile.n_triangles, tile.first_triangle);
  });
  if (!vanished.empty()) return vanished;
  join(tiles.all(), ends, triangles.grouping);
  // Closing the gaps has moved triangles together with their ids, so the triangles get new ids.
  if (triangles.n_triangles() < tiles.room())
    std::iota(triangles.triangle_id.begin(), triangles.triangle_id.end(), std::int64_t{0});
  return vanished;
}

}  // namespace

TriangleSet triangulate_adapted(const PatchSet &set, const Triangulation &asked, TriangleSet memory) {
  const Triangulation how = checked(set, asked);
  Vector<LevelledGrid> grids;
  with_finer_curves(set, "", [&](const Vector<double> &tightness) {
    grids = make_levelled_grids(set, how.max_error, tightness, how.n_threads);
    return make_triangles(set, how, grids, memory);
  });
  finish(set, std::move(grids), memory);
  return memory;
}

}  // namespace riis
