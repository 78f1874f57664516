// SPDX-License-Identifier: Apache-2.0
#include "surface/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/errors.hpp"
#include "geometry/coons.hpp"

namespace riis {
namespace {

// How the allowed error is shared out; docs/theory.md, "Tolerance". A point of a Coons patch inherits the errors of a u and of
// a v curve and of merged grid lines, each bounded as below; what they leave in a quad is for its split into triangles:
// at least 1 - 2 * (curve_share + merge_share).
constexpr double curve_share = 0.38, merge_share = 0.01;

// Halvings of a quad's sides until its flatness, which falls by exactly 4 each time, is small enough. No quad that the
// library takes on needs more than 12; the loop ends there.
int subdivision_level(const QuadGrid &grid, std::size_t i, std::size_t j, double max_error) {
  double kappa = quad_flatness(grid.point(i, j), grid.point(i + 1, j), grid.point(i + 1, j + 1), grid.point(i, j + 1));
  int level = 0;
  for (; kappa > max_error - grid.error(i, j) && level < 13; kappa *= 0.25) ++level;
  return level;
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
};

LevelledGrid with_levels(QuadGrid grid, double max_error) {
  LevelledGrid made{std::move(grid), {}, 0};
  for_each_quad(made.grid, [&](std::size_t i, std::size_t j) {
    made.levels.push_back(subdivision_level(made.grid, i, j, max_error));
    made.n_triangles += std::int64_t{2} << 2 * made.levels.back();
  });
  return made;
}

void check_count(double n_triangles, double max_error) {
  if (n_triangles > static_cast<double>(max_triangles))
    fail(RIIS_LIMIT_EXCEEDED,
         "the surface needs more than %lld triangles, about %s, to be right to %s, which is tolerance * half_thickness "
         "before scaling",
         static_cast<long long>(max_triangles), Number(std::ceil(n_triangles)).text, Number(max_error).text);
}

class Builder {
 public:
  Builder(std::int64_t n_triangles, const Placement &placement, bool flip_normals)
      : placement_(placement), flip_normals_(flip_normals) {
    const auto n = static_cast<std::size_t>(n_triangles);
    set_.vertex_id.reserve(3 * n);
    set_.leaflet_id.reserve(n);
    set_.patch_id.reserve(n);
  }

  void add_image(const LevelledGrid &levelled, const PatchImage &image) {
    const QuadGrid &grid = levelled.grid;
    auto level_of_next = levelled.levels.begin();
    const std::size_t n_u = grid.u.size(), n_v = grid.v.size();
    const std::int64_t first = n_vertices();
    for (std::size_t j = 0; j < n_v; ++j)
      for (std::size_t i = 0; i < n_u; ++i) add_vertex(grid.point(i, j), grid.u[i], grid.v[j], image);
    const auto grid_vertex = [&](std::size_t i, std::size_t j) {
      return first + static_cast<std::int64_t>(j * n_u + i);
    };
    for_each_quad(grid, [&](std::size_t i, std::size_t j) {
      const int level = *level_of_next++;
      if (level == 0)
        add_quad({grid_vertex(i, j), grid_vertex(i + 1, j), grid_vertex(i + 1, j + 1), grid_vertex(i, j + 1)}, image);
      else
        add_subdivided_quad(grid, i, j, level, image);
    });
  }

  TriangleSet take() {
    set_.triangle_id.resize(set_.leaflet_id.size());
    for (std::size_t i = 0; i < set_.triangle_id.size(); ++i) set_.triangle_id[i] = static_cast<std::int64_t>(i);
    return std::move(set_);
  }

 private:
  std::int64_t n_vertices() const { return static_cast<std::int64_t>(set_.n_vertices()); }

  std::int64_t add_vertex(Vec3 p, double u, double v, const PatchImage &image) {
    const Vec3 placed = place(placement_, place(image, p));
    set_.xyz.insert(set_.xyz.end(), {placed.x, placed.y, placed.z});
    set_.uv.insert(set_.uv.end(), {u, v});
    return n_vertices() - 1;
  }

  // Recursive halving of a bilinear quad ends in equal parts, since all parts of a level have the same flatness: made in
  // one go.
  void add_subdivided_quad(const QuadGrid &grid, std::size_t i, std::size_t j, int level, const PatchImage &image) {
    const int n = 1 << level;
    const std::int64_t first = n_vertices();
    for (int row = 0; row <= n; ++row) {
      for (int column = 0; column <= n; ++column) {
        const double s = static_cast<double>(column) / n, t = static_cast<double>(row) / n;
        // Along an edge this is the mix of its two ends, whichever quad asks: neighbours agree to the last bit.
        const Vec3 p = mix(mix(grid.point(i, j), grid.point(i + 1, j), s),
                           mix(grid.point(i, j + 1), grid.point(i + 1, j + 1), s), t);
        add_vertex(p, (1 - s) * grid.u[i] + s * grid.u[i + 1], (1 - t) * grid.v[j] + t * grid.v[j + 1], image);
      }
    }
    const auto vertex = [&](int column, int row) { return first + row * (n + 1) + column; };
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        add_quad({vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1), vertex(column, row + 1)},
                 image);
  }

  void add_quad(const std::array<std::int64_t, 4> &corner, const PatchImage &image) {
    add_triangle(corner[0], corner[1], corner[2], image);
    add_triangle(corner[0], corner[2], corner[3], image);
  }

  void add_triangle(std::int64_t a, std::int64_t b, std::int64_t c, const PatchImage &image) {
    if (has_zero_area(set_.vertex(a), set_.vertex(b), set_.vertex(c))) {
      ++set_.n_zero_area;
      return;
    }
    if (image.mirrored != flip_normals_) std::swap(b, c);
    set_.vertex_id.insert(set_.vertex_id.end(), {a, b, c});
    set_.leaflet_id.push_back(image.leaflet_id);
    set_.patch_id.push_back(image.patch_id);
  }

  const Placement &placement_;
  bool flip_normals_;
  TriangleSet set_;
};

}  // namespace

double quad_flatness(Vec3 p00, Vec3 p10, Vec3 p11, Vec3 p01) { return 0.25 * length((p00 - p10) + (p11 - p01)); }

TriangleSet triangulate(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals) {
  std::vector<Polyline> polylines;
  polylines.reserve(set.curves.size());
  for (const Bezier &curve : set.curves) polylines.push_back(make_polyline(curve, curve_share * max_error));

  // All is counted before anything large is made.
  const auto sides_of = [&](const Patch &patch) {
    return PatchSides{&polylines[patch.side_v0], &polylines[patch.side_v1], &polylines[patch.side_u0],
                      &polylines[patch.side_u1]};
  };
  double n_at_least = 0;
  for (const Patch &patch : set.patches) {
    const PatchSides sides = sides_of(patch);
    const auto n_between = [](const Polyline &a, const Polyline &b) {
      return static_cast<double>(std::max<std::size_t>({a.t.size(), b.t.size(), 2}) - 1);
    };
    n_at_least += 2 * n_between(*sides.side_v0, *sides.side_v1) * n_between(*sides.side_u0, *sides.side_u1) *
                  static_cast<double>(patch.images.size());
  }
  check_count(n_at_least, max_error);
  std::vector<LevelledGrid> grids;
  grids.reserve(set.patches.size());
  std::int64_t n_triangles = 0;
  for (const Patch &patch : set.patches) {
    grids.push_back(with_levels(make_quad_grid(sides_of(patch), merge_share * max_error), max_error));
    n_triangles += grids.back().n_triangles * static_cast<std::int64_t>(patch.images.size());
  }
  check_count(static_cast<double>(n_triangles), max_error);

  Builder builder(n_triangles, placement, flip_normals);
  for (std::size_t i = 0; i < grids.size(); ++i)
    for (const PatchImage &image : set.patches[i].images) builder.add_image(grids[i], image);
  return builder.take();
}

}  // namespace riis
