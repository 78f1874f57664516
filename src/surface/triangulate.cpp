// SPDX-License-Identifier: Apache-2.0
#include "surface/triangulate.hpp"

#include "api/errors.hpp"
#include "geometry/coons.hpp"

namespace riis {
namespace {

// How the allowed error is shared out; docs/theory.md, "Tolerance". A point of a Coons patch inherits the errors of a u
// and of a v curve, each at most 3/4 of its flatness, and of merged grid lines; then the quad's own is added: 2 * 3/4 *
// 0.36 + 0.06 + 0.40 = 1.
constexpr double curve_share = 0.36, merge_share = 0.06, quad_share = 0.40;

// Halvings of a quad's sides until its flatness, which falls by exactly 4 each time, is small enough.
int subdivision_level(double kappa, double max_kappa) {
  int level = 0;
  for (; kappa > max_kappa; kappa *= 0.25) ++level;
  return level;
}

[[noreturn]] void fail_too_many() {
  fail(RIIS_LIMIT_EXCEEDED,
       "the surface needs more than %lld triangles: tolerance * half_thickness is too small for it",
       static_cast<long long>(max_triangles));
}

class Builder {
 public:
  Builder(double max_kappa, const Placement &placement, bool flip_normals)
      : max_kappa_(max_kappa), placement_(placement), flip_normals_(flip_normals) {}

  void add_patch(const QuadGrid &grid, const Patch &patch) {
    const std::size_t n_u = grid.u.size(), n_v = grid.v.size();
    const std::int64_t first = n_vertices();
    for (std::size_t j = 0; j < n_v; ++j)
      for (std::size_t i = 0; i < n_u; ++i) add_vertex(grid.point(i, j), grid.u[i], grid.v[j]);
    const auto grid_vertex = [&](std::size_t i, std::size_t j) {
      return first + static_cast<std::int64_t>(j * n_u + i);
    };
    for (std::size_t j = 0; j + 1 < n_v; ++j) {
      for (std::size_t i = 0; i + 1 < n_u; ++i) {
        const int level = subdivision_level(
            quad_flatness(grid.point(i, j), grid.point(i + 1, j), grid.point(i + 1, j + 1), grid.point(i, j + 1)),
            max_kappa_);
        if (level == 0)
          add_quad({grid_vertex(i, j), grid_vertex(i + 1, j), grid_vertex(i + 1, j + 1), grid_vertex(i, j + 1)}, patch);
        else
          add_subdivided_quad(grid, i, j, level, patch);
      }
    }
  }

  TriangleSet take() {
    set_.triangle_id.resize(set_.leaflet_id.size());
    for (std::size_t i = 0; i < set_.triangle_id.size(); ++i) set_.triangle_id[i] = static_cast<std::int64_t>(i);
    return std::move(set_);
  }

 private:
  std::int64_t n_vertices() const { return static_cast<std::int64_t>(set_.n_vertices()); }

  std::int64_t add_vertex(Vec3 p, double u, double v) {
    const Vec3 placed = place(placement_, p);
    set_.xyz.insert(set_.xyz.end(), {placed.x, placed.y, placed.z});
    set_.uv.insert(set_.uv.end(), {u, v});
    return n_vertices() - 1;
  }

  // Recursive halving of a bilinear quad ends in equal parts, since all parts of a level have the same flatness: made
  // in one go.
  void add_subdivided_quad(const QuadGrid &grid, std::size_t i, std::size_t j, int level, const Patch &patch) {
    if (level > 12) fail_too_many();
    const int n = 1 << level;
    const std::int64_t first = n_vertices();
    for (int row = 0; row <= n; ++row) {
      for (int column = 0; column <= n; ++column) {
        const double s = static_cast<double>(column) / n, t = static_cast<double>(row) / n;
        // Along an edge this is the mix of its two ends, whichever quad asks: neighbours agree to the last bit.
        const Vec3 p = mix(mix(grid.point(i, j), grid.point(i + 1, j), s),
                           mix(grid.point(i, j + 1), grid.point(i + 1, j + 1), s), t);
        add_vertex(p, (1 - s) * grid.u[i] + s * grid.u[i + 1], (1 - t) * grid.v[j] + t * grid.v[j + 1]);
      }
    }
    const auto vertex = [&](int column, int row) { return first + row * (n + 1) + column; };
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        add_quad({vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1), vertex(column, row + 1)},
                 patch);
  }

  void add_quad(const std::array<std::int64_t, 4> &corner, const Patch &patch) {
    if (static_cast<std::int64_t>(set_.leaflet_id.size()) + 2 > max_triangles) fail_too_many();
    add_triangle(corner[0], corner[1], corner[2], patch);
    add_triangle(corner[0], corner[2], corner[3], patch);
  }

  void add_triangle(std::int64_t a, std::int64_t b, std::int64_t c, const Patch &patch) {
    if (has_zero_area(set_.vertex(a), set_.vertex(b), set_.vertex(c))) {
      ++set_.n_zero_area;
      return;
    }
    if (patch.flip != flip_normals_) std::swap(b, c);
    set_.vertex_id.insert(set_.vertex_id.end(), {a, b, c});
    set_.leaflet_id.push_back(patch.leaflet_id);
    set_.patch_id.push_back(patch.patch_id);
  }

  double max_kappa_;
  const Placement &placement_;
  bool flip_normals_;
  TriangleSet set_;
};

}  // namespace

double quad_flatness(Vec3 p00, Vec3 p10, Vec3 p11, Vec3 p01) { return 0.25 * length((p00 - p10) + (p11 - p01)); }

TriangleSet triangulate(const PatchSet &set, double max_error, const Placement &placement, bool flip_normals) {
  std::vector<Polyline> polylines;
  polylines.reserve(set.curves.size());
  for (const Bezier &curve : set.curves) polylines.push_back(make_polyline(flatten(curve, curve_share * max_error)));

  Builder builder(quad_share * max_error, placement, flip_normals);
  for (const Patch &patch : set.patches) {
    const PatchSides sides{&polylines[patch.side_v0], &polylines[patch.side_v1], &polylines[patch.side_u0],
                           &polylines[patch.side_u1]};
    const auto grid_size = [](const Polyline &a, const Polyline &b) {
      return static_cast<double>(a.t.size() + b.t.size());
    };
    if (grid_size(*sides.side_v0, *sides.side_v1) * grid_size(*sides.side_u0, *sides.side_u1) >
        static_cast<double>(max_triangles))
      fail_too_many();
    builder.add_patch(make_quad_grid(sides, merge_share * max_error), patch);
  }
  return builder.take();
}

}  // namespace riis
