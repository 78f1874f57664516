// SPDX-License-Identifier: Apache-2.0
#include "surface/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/errors.hpp"
#include "surface/grids.hpp"
#include "surface/triangle_groups.hpp"

namespace riis {
namespace {

Quad quad_of(const QuadGrid &grid, std::size_t i, std::size_t j) {
  return {grid.point(i, j), grid.point(i + 1, j), grid.point(i + 1, j + 1), grid.point(i, j + 1)};
}

bool is_flat_enough(const Quad &quad, int level, double max_error) {
  const int n = 1 << level;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const double s0 = static_cast<double>(column) / n, s1 = static_cast<double>(column + 1) / n;
      const double t0 = static_cast<double>(row) / n, t1 = static_cast<double>(row + 1) / n;
      if (!(split_error({quad.at(s0, t0), quad.at(s1, t0), quad.at(s1, t1), quad.at(s0, t1)}) <= max_error))
        return false;
    }
  return true;
}

// Halvings of a quad's sides until its parts are close enough to their triangles. The twist of all parts falls by exactly 4 each
// time, so there is an end; no quad that the library takes on needs more than 12.
int subdivision_level(const QuadGrid &grid, std::size_t i, std::size_t j, double max_error) {
  const Quad quad = quad_of(grid, i, j);
  const double left = max_error - grid.error(i, j);
  int enough = 0;
  for (double kappa = quad_flatness(quad); kappa > left && enough < 13; kappa *= 0.25) ++enough;
  // All parts are looked at where there are few.
  constexpr int few = 5;
  for (int level = 0; level < std::min(enough, few); ++level)
    if (is_flat_enough(quad, level, left)) return level;
  return enough;
}

template <class Visit>
void for_each_quad(const QuadGrid &grid, const Visit &visit) {
  for (std::size_t j = 0; j + 1 < grid.v.size(); ++j)
    for (std::size_t i = 0; i + 1 < grid.u.size(); ++i) visit(i, j);
}

// A patch's quads with the level that each is subdivided to, in the order of for_each_quad.
struct LevelledGrid {
  QuadGrid grid;
  std::vector<int> levels;
  std::int64_t n_triangles;  // of one image, with those that turn out to have no area
  std::int64_t n_vertices;
};

LevelledGrid with_levels(QuadGrid grid, double max_error) {
  LevelledGrid made{std::move(grid), {}, 0, 0};
  made.n_vertices = static_cast<std::int64_t>(made.grid.u.size() * made.grid.v.size());
  for_each_quad(made.grid, [&](std::size_t i, std::size_t j) {
    made.levels.push_back(subdivision_level(made.grid, i, j, max_error));
    const std::int64_t n = std::int64_t{1} << made.levels.back();
    made.n_triangles += 2 * n * n;
    if (n > 1) made.n_vertices += (n + 1) * (n + 1);
  });
  return made;
}

class Builder {
 public:
  Builder(std::int64_t n_triangles, std::int64_t n_vertices, const Placement &placement, bool flip_normals)
      : placement_(placement), flip_normals_(flip_normals) {
    const auto n = static_cast<std::size_t>(n_triangles);
    set_.xyz.reserve(3 * static_cast<std::size_t>(n_vertices));
    set_.uv.reserve(2 * static_cast<std::size_t>(n_vertices));
    set_.grouping.order.reserve(n);
    set_.vertex_id.reserve(3 * n);
    set_.leaflet_id.reserve(n);
    set_.patch_id.reserve(n);
  }

  // False if more was left out, for want of area, than the triangles kept stand for.
  bool add_image(const LevelledGrid &levelled, const PatchImage &image) {
    is_whole_ = true;
    const QuadGrid &grid = levelled.grid;
    auto level_of_next = levelled.levels.begin();
    const std::size_t n_u = grid.u.size(), n_v = grid.v.size();
    const std::int64_t first = n_vertices();
    for (std::size_t j = 0; j < n_v; ++j)
      for (std::size_t i = 0; i < n_u; ++i) add_vertex(grid.point(i, j), grid.u[i], grid.v[j], image);
    const auto grid_vertex = [&](std::size_t i, std::size_t j) {
      return first + static_cast<std::int64_t>(j * n_u + i);
    };
    first_of_quad_.clear();
    for_each_quad(grid, [&](std::size_t i, std::size_t j) {
      first_of_quad_.push_back(n_triangles());
      const int level = *level_of_next++;
      if (level == 0)
        add_quad({grid_vertex(i, j), grid_vertex(i + 1, j), grid_vertex(i + 1, j + 1), grid_vertex(i, j + 1)}, image);
      else
        add_subdivided_quad(grid, i, j, level, image);
    });
    first_of_quad_.push_back(n_triangles());
    group(grid, {0, n_u - 1, 0, n_v - 1});
    return is_whole_;
  }

  TriangleSet take() {
    set_.triangle_id.resize(set_.leaflet_id.size());
    for (std::size_t i = 0; i < set_.triangle_id.size(); ++i) set_.triangle_id[i] = static_cast<std::int64_t>(i);
    return std::move(set_);
  }

 private:
  std::int64_t n_vertices() const { return static_cast<std::int64_t>(set_.n_vertices()); }
  std::int32_t n_triangles() const { return static_cast<std::int32_t>(set_.leaflet_id.size()); }

  // Quads of the grid from i0 to i1 - 1 and j0 to j1 - 1.
  struct Quads {
    std::size_t i0, i1, j0, j1;
  };

  // Halves quads along their longer side until their triangles are a group.
  void group(const QuadGrid &grid, const Quads &quads) {
    const std::size_t i0 = quads.i0, i1 = quads.i1, j0 = quads.j0, j1 = quads.j1;
    const std::size_t n_u = grid.u.size() - 1;
    // Quads of a row follow each other, and so do their triangles.
    const auto triangles_of_row = [&](std::size_t j) {
      return std::pair(first_of_quad_[j * n_u + i0], first_of_quad_[j * n_u + i1]);
    };
    std::int32_t n = 0;
    for (std::size_t j = j0; j < j1; ++j) n += triangles_of_row(j).second - triangles_of_row(j).first;
    if (n == 0) return;
    Grouping &grouping = set_.grouping;
    if (n <= triangles_per_group) {
      for (std::size_t j = j0; j < j1; ++j)
        for (std::int32_t t = triangles_of_row(j).first; t < triangles_of_row(j).second; ++t)
          grouping.order.push_back(t);
      grouping.end.push_back(static_cast<std::int32_t>(grouping.order.size()));
      return;
    }
    if (i1 - i0 == 1 && j1 - j0 == 1) {
      group_by_place(set_, triangles_of_row(j0).first, triangles_of_row(j0).second, grouping);
      return;
    }
    const std::size_t i = (i0 + i1) / 2, j = (j0 + j1) / 2;
    const bool along_u = j1 - j0 == 1 || (i1 - i0 > 1 && distance(grid.point(i0, j), grid.point(i1, j)) >
                                                             distance(grid.point(i, j0), grid.point(i, j1)));
    if (along_u) {
      group(grid, {i0, i, j0, j1});
      group(grid, {i, i1, j0, j1});
    } else {
      group(grid, {i0, i1, j0, j});
      group(grid, {i0, i1, j, j1});
    }
  }

  std::int64_t add_vertex(Vec3 p, double u, double v, const PatchImage &image) {
    const Vec3 placed = place(placement_, place(image, p));
    for (const double x : {placed.x, placed.y, placed.z}) set_.xyz.push_back(x);
    for (const double t : {u, v}) set_.uv.push_back(t);
    return n_vertices() - 1;
  }

  // Recursive halving of a bilinear quad ends in equal parts, since all parts of a level have the same flatness: made in
  // one go.
  void add_subdivided_quad(const QuadGrid &grid, std::size_t i, std::size_t j, int level, const PatchImage &image) {
    const int n = 1 << level;
    const Quad quad = quad_of(grid, i, j);
    const std::int64_t first = n_vertices();
    for (int row = 0; row <= n; ++row) {
      for (int column = 0; column <= n; ++column) {
        const double s = static_cast<double>(column) / n, t = static_cast<double>(row) / n;
        add_vertex(quad.at(s, t), (1 - s) * grid.u[i] + s * grid.u[i + 1], (1 - t) * grid.v[j] + t * grid.v[j + 1],
                   image);
      }
    }
    const auto vertex = [&](int column, int row) { return first + row * (n + 1) + column; };
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        add_quad({vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1), vertex(column, row + 1)},
                 image);
  }

  void add_quad(const std::array<std::int64_t, 4> &corner, const PatchImage &image) {
    const bool first = add_triangle(corner[0], corner[1], corner[2], image);
    const bool second = add_triangle(corner[0], corner[2], corner[3], image);
    if (!first) check_left_out(corner[1], corner[0], corner[2], second);
    if (!second) check_left_out(corner[3], corner[0], corner[2], first);
  }

  // A triangle without area is its longest edge. That is still there if it is the diagonal of a quad whose other half was kept, and
  // nothing is lost if it is a point.
  void check_left_out(std::int64_t corner, std::int64_t a, std::int64_t b, bool other_was_kept) {
    const double diagonal = distance(set_.vertex(a), set_.vertex(b));
    const double other =
        std::max(distance(set_.vertex(corner), set_.vertex(a)), distance(set_.vertex(corner), set_.vertex(b)));
    const bool is_on_diagonal = other_was_kept && other <= (1 + 1e-9) * diagonal;
    if (!is_on_diagonal && std::max(diagonal, other) > min_edge) is_whole_ = false;
  }

  bool add_triangle(std::int64_t a, std::int64_t b, std::int64_t c, const PatchImage &image) {
    if (has_zero_area(set_.vertex(a), set_.vertex(b), set_.vertex(c))) {
      ++set_.n_zero_area;
      return false;
    }
    if ((image.mirror != Mirror::none) != flip_normals_) std::swap(b, c);
    for (const std::int64_t id : {a, b, c}) set_.vertex_id.push_back(id);
    set_.leaflet_id.push_back(image.leaflet_id);
    set_.patch_id.push_back(image.patch_id);
    return true;
  }

  bool is_whole_ = true;
  std::vector<std::int32_t> first_of_quad_;  // of the image's triangles
  const Placement &placement_;
  bool flip_normals_;
  TriangleSet set_;
};

}  // namespace

double quad_flatness(const Quad &quad) { return 0.25 * length((quad.p00 - quad.p10) + (quad.p11 - quad.p01)); }

double split_error(const Quad &q) {
  const double at_equal_uv = quad_flatness(q);
  const Vec3 normal = cross(q.p11 - q.p00, q.p01 - q.p10);
  const double size = length(normal);
  const auto turns_left = [&](Vec3 a, Vec3 b, Vec3 c) { return dot(cross(b - a, c - b), normal) >= 0; };
  const bool is_graph = size > 0 && turns_left(q.p00, q.p10, q.p11) && turns_left(q.p10, q.p11, q.p01) &&
                        turns_left(q.p11, q.p01, q.p00) && turns_left(q.p01, q.p00, q.p10);
  if (!is_graph) return at_equal_uv;
  const Vec3 twist = (q.p00 - q.p10) + (q.p11 - q.p01);
  return std::min(at_equal_uv, 0.5 * std::abs(dot(twist, normal)) / size);
}

TriangleSet triangulate(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals) {
  std::vector<double> tightness(set.curves.size(), 1);
  for (int attempt = 0;; ++attempt) {
    std::vector<LevelledGrid> grids;
    std::int64_t n_triangles = 0, n_vertices = 0;
    for (QuadGrid &grid : make_grids(set, max_error, tightness)) {
      const std::size_t n_images = set.patches[grids.size()].images.size();
      grids.push_back(with_levels(std::move(grid), max_error));
      n_triangles += grids.back().n_triangles * static_cast<std::int64_t>(n_images);
      n_vertices += grids.back().n_vertices * static_cast<std::int64_t>(n_images);
      check_count(static_cast<double>(n_triangles), max_error);
    }
    Builder builder(n_triangles, n_vertices, placement, flip_normals);
    std::vector<std::size_t> vanished;
    for (std::size_t i = 0; i < grids.size(); ++i) {
      bool is_whole = true;
      for (const PatchImage &image : set.patches[i].images) is_whole = builder.add_image(grids[i], image) && is_whole;
      if (!is_whole) vanished.push_back(i);
    }
    if (vanished.empty()) return builder.take();
    // Patches thinner than the tolerance lose their area where their sides become the same chords: these have to be finer.
    constexpr int max_attempts = 12;
    if (attempt == max_attempts)
      fail(RIIS_INVALID_PARAMETER, "patch %d has no area, at least in part: a surface is no curve",
           set.patches[vanished.front()].images.front().patch_id);
    for (const std::size_t i : vanished)
      for (const Side &side : {set.patches[i].v0, set.patches[i].v1, set.patches[i].u0, set.patches[i].u1})
        tightness[side.curve] *= 0.1;
  }
}

}  // namespace riis
