// SPDX-License-Identifier: Apache-2.0
// The adapted triangulation: grids as coarse as the state of the valve allows.
#include <algorithm>
#include <numeric>
#include <utility>

#include "parallel/range.hpp"
#include "surface/grids.hpp"
#include "surface/pieces.hpp"
#include "surface/triangle_groups.hpp"
#include "surface/triangulate.hpp"

namespace riis {
namespace {

// Groups the triangles of a piece by the piece's quads.
class QuadGroups {
 public:
  QuadGroups(const QuadGrid &grid, const Vector<std::int32_t> &first_of_quad, const TriangleSet &set)
      : grid_(grid), first_of_quad_(first_of_quad), set_(set) {}

  Grouping make() {
    const Quads all{0, grid_.u.size() - 1, 0, grid_.v.size() - 1};
    const std::int64_t n = n_triangles(all);
    made_.order.reserve(static_cast<std::size_t>(n));
    constexpr std::int64_t fewest_in_group = triangles_per_group / 2;  // in most groups
    made_.end.reserve(static_cast<std::size_t>(n / fewest_in_group + 1));
    group(all, n);
    return std::move(made_);
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

  // Cuts a block of quads across its longer side until its n triangles fit in a group.
  void group(const Quads &quads, std::int64_t n) {
    const std::size_t i0 = quads.i0, i1 = quads.i1, j0 = quads.j0, j1 = quads.j1;
    if (n == 0) return;
    if (n <= triangles_per_group) {
      for (std::size_t j = j0; j < j1; ++j) {
        const Range row = triangles_of_row(quads, j);
        for (std::int64_t t = row.begin; t < row.end; ++t) made_.order.push_back(static_cast<std::int32_t>(t));
      }
      made_.end.push_back(static_cast<std::int32_t>(made_.order.size()));
      return;
    }
    if (i1 - i0 == 1 && j1 - j0 == 1) {
      const Range row = triangles_of_row(quads, j0);
      group_by_place(set_, static_cast<std::int32_t>(row.begin), static_cast<std::int32_t>(row.end), made_);
      return;
    }
    const std::size_t i = (i0 + i1) / 2, j = (j0 + j1) / 2;
    const bool along_u = j1 - j0 == 1 || (i1 - i0 > 1 && distance(grid_.point(i0, j), grid_.point(i1, j)) >
                                                             distance(grid_.point(i, j0), grid_.point(i, j1)));
    const auto before = [&](std::size_t cut) { return along_u ? Quads{i0, cut, j0, j1} : Quads{i0, i1, j0, cut}; };
    // Near the middle, both parts are compact. There the cut takes the place at which both parts may need the fewest groups.
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
  Grouping made_;
};

// Joins the groups of all pieces, after the pieces' triangles were moved together.
void join(const Vector<Piece> &pieces, const Vector<Grouping> &groups, Grouping &joined) {
  const auto append = [](const Vector<std::int32_t> &numbers, std::int64_t difference, Vector<std::int32_t> &to) {
    const auto first = to.insert(to.end(), numbers.begin(), numbers.end());
    std::for_each(first, to.end(), [difference](std::int32_t &n) { n += static_cast<std::int32_t>(difference); });
  };
  std::size_t n_grouped = 0, n_groups = 0;
  for (const Grouping &of_piece : groups) {
    n_grouped += of_piece.order.size();
    n_groups += of_piece.end.size();
  }
  joined.order.reserve(n_grouped);
  joined.end.reserve(n_groups);
  std::int64_t n = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    append(groups[i].end, view(joined.order).size(), joined.end);
    append(groups[i].order, n - pieces[i].first_triangle, joined.order);
    n += pieces[i].n_triangles;
  }
}

// Makes the triangles of these grids. Returns the patches that miss triangles.
Vector<std::size_t> make_triangles(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids,
                                   TriangleSet &triangles) {
  Pieces pieces(set, how, grids, triangles);
  Vector<Grouping> groups(pieces.all().size());
  Vector<std::size_t> vanished = pieces.make_triangles([&](std::int64_t i, const Vector<std::int32_t> &first_of_quad) {
    const QuadGrid &grid = grids[view(pieces.all())[i].patch].grid;
    view(groups)[i] = QuadGroups(grid, first_of_quad, triangles).make();
  });
  if (!vanished.empty()) return vanished;
  join(pieces.all(), groups, triangles.grouping);
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
