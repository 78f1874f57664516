// SPDX-License-Identifier: Apache-2.0
#include "triangulate/tiles.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "kernels/kernels.hpp"
#include "triangulate/grids.hpp"
#include "valve/rims.hpp"

namespace riis {
namespace {

// Returns the seam of an image, or null if the image has no seam.
const Seam *seam_of(const PatchSet &set, std::size_t patch, std::size_t image) {
  for (const Seam &seam : set.seams)
    if (seam.patch == patch && seam.image == image) return &seam;
  return nullptr;
}

// Returns the displacements of the vertices, in the order of vertices_of.
Vector<Vec3> displacements_of(const MovedPatch &moved, const LevelledGrid &levelled) {
  const PatchDisplacement moves(moved, levelled);
  const QuadGrid &grid = levelled.grid;
  Vector<Vec3> made;
  made.reserve(static_cast<std::size_t>(levelled.n_vertices));
  for (std::size_t j = 0; j < grid.v.size(); ++j)
    for (std::size_t i = 0; i < grid.u.size(); ++i) made.push_back(moves.at_lines(i, j));
  auto level_of_next = levelled.levels.begin();
  for_each_quad(grid, [&](std::size_t i, std::size_t j) {
    const int level = *level_of_next++;
    if (level == 0) return;
    for (int row = 0; row <= 1 << level; ++row)
      for (int column = 0; column <= 1 << level; ++column) made.push_back(moves.without_jumps(i, j, column, row));
  });
  return made;
}

PatchVertices vertices_of(const LevelledGrid &levelled) {
  const QuadGrid &grid = levelled.grid;
  const auto n = static_cast<std::size_t>(levelled.n_vertices);
  PatchVertices made;
  made.points.reserve(n);
  made.uv.reserve(2 * n);
  const auto add_uv = [&](double u, double v) {
    made.uv.push_back(u);
    made.uv.push_back(v);
  };
  made.points = grid.points;
  for (const double v : grid.v)
    for (const double u : grid.u) add_uv(u, v);
  auto level_of_next = levelled.levels.begin();
  for_each_quad(grid, [&](std::size_t i, std::size_t j) {
    const int level = *level_of_next++;
    if (level == 0) return;
    // All parts of a bilinear quad are equally flat at a level of subdivision. Recursive halving would therefore end in equal
    // parts, so this loop makes them directly.
    const int n_parts = 1 << level;
    const double step = 1.0 / n_parts;  // a power of two
    const Quad quad = quad_of(grid, i, j);
    const double u0 = grid.u[i], u1 = grid.u[i + 1], v0 = grid.v[j], v1 = grid.v[j + 1];
    for (int row = 0; row <= n_parts; ++row)
      for (int column = 0; column <= n_parts; ++column) {
        const double s = column * step, t = row * step;
        made.points.push_back(quad.at(s, t));
        add_uv((1 - s) * u0 + s * u1, (1 - t) * v0 + t * v1);
      }
  });
  return made;
}

PlacedBy placed_by(const PatchImage &image, const Placement &placement) {
  PlacedBy by{};
  const auto put = [](Vec3 column, double *to) { to[0] = column.x, to[1] = column.y, to[2] = column.z; };
  const auto put_columns = [&](const Rotation &from, double(*to)[4]) {
    put({from.row_x.x, from.row_y.x, from.row_z.x}, to[0]);
    put({from.row_x.y, from.row_y.y, from.row_z.y}, to[1]);
    put({from.row_x.z, from.row_y.z, from.row_z.z}, to[2]);
  };
  put_columns(image.rotation, by.of_image);
  // A mirror image negates a coordinate of each point. Here a column of the matrix is negated instead, which gives products with
  // the same bits.
  if (image.mirror != Mirror::none)
    for (double &x : by.of_image[image.mirror == Mirror::in_x ? 0 : 1]) x = -x;
  put(image.translation, by.offset_of_image);
  put_columns(placement.rotation, by.rotation);
  put(placement.translation, by.translation);
  by.scale = placement.scale;
  return by;
}

AxisLine placed(const AxisLine &axis, const PatchImage &image, const Placement &placement) {
  return {place(placement, place(image, axis.centre)), placement.rotation * place(turn_of(image), axis.direction)};
}

// Makes the triangles of a tile whose vertices are placed.
class TileTriangles {
 public:
  TileTriangles(Tile &tile, const LevelledGrid &levelled, bool flip_normals, TriangleSet &set)
      : tile_(tile), levelled_(levelled), flip_normals_(flip_normals), set_(set) {}

  // Returns the position of each quad's first triangle. The last entry is the end of the last quad's triangles.
  Vector<std::int32_t> add() {
    const QuadGrid &grid = levelled_.grid;
    auto level_of_next = levelled_.levels.begin();
    const auto n_u = static_cast<std::int64_t>(grid.u.size()), n_v = static_cast<std::int64_t>(grid.v.size());
    std::int64_t next_subdivided = tile_.first_vertex + n_u * n_v;
    Vector<std::int32_t> first_of_quad;
    first_of_quad.reserve(levelled_.levels.size() + 1);
    for_each_quad(grid, [&](std::size_t i, std::size_t j) {
      first_of_quad.push_back(static_cast<std::int32_t>(next_triangle()));
      const int level = *level_of_next++;
      if (level == 0) {
        const std::int64_t first =
            tile_.first_vertex + static_cast<std::int64_t>(j) * n_u + static_cast<std::int64_t>(i);
        add_quad({first, first + 1, first + n_u + 1, first + n_u});
      } else {
        add_quads(next_subdivided, level);
        const std::int64_t n = (std::int64_t{1} << level) + 1;
        next_subdivided += n * n;
      }
    });
    first_of_quad.push_back(static_cast<std::int32_t>(next_triangle()));
    return first_of_quad;
  }

 private:
  std::int64_t next_triangle() const { return tile_.first_triangle + tile_.n_triangles; }

  // Adds the smaller quads of a quad whose sides are halved `level` times. The vertices of the smaller quads begin with `first`.
  void add_quads(std::int64_t first, int level) {
    const int n = 1 << level;
    const auto vertex = [&](int column, int row) { return first + row * (n + 1) + column; };
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        add_quad({vertex(column, row), vertex(column + 1, row), vertex(column + 1, row + 1), vertex(column, row + 1)});
  }

  void add_quad(const std::array<std::int64_t, 4> &corner) {
    const bool first = add_triangle(corner[0], corner[1], corner[2]);
    const bool second = add_triangle(corner[0], corner[2], corner[3]);
    if (!first) leave_out({corner[1], corner[0], corner[2], second});
    if (!second) leave_out({corner[3], corner[0], corner[2], first});
  }

  void leave_out(const LeftOut &triangle) {
    if (is_missed(set_, triangle)) tile_.is_whole = false;
    tile_.left_out.push_back(triangle);
  }

  bool add_triangle(std::int64_t a, std::int64_t b, std::int64_t c) {
    const std::int64_t id_here = next_id_++;
    if (has_zero_area(set_.vertex(a), set_.vertex(b), set_.vertex(c))) return false;
    if (points_upstream(*tile_.image) != flip_normals_) std::swap(b, c);
    const std::int64_t at = next_triangle();
    std::int64_t *id = set_.vertex_id.data() + 3 * at;
    id[0] = a, id[1] = b, id[2] = c;
    view(set_.leaflet_id)[at] = tile_.image->leaflet_id;
    view(set_.patch_id)[at] = tile_.image->patch_id;
    view(set_.triangle_id)[at] = id_here;
    ++tile_.n_triangles;
    return true;
  }

  Tile &tile_;
  const LevelledGrid &levelled_;
  bool flip_normals_;
  TriangleSet &set_;
  std::int64_t next_id_ = tile_.first_id;
};

// Returns the patches of which a triangle is missed (is_missed).
Vector<std::size_t> vanished_patches(const Vector<Tile> &tiles) {
  Vector<std::size_t> vanished;
  for (const Tile &tile : tiles)
    if (!tile.is_whole && (vanished.empty() || vanished.back() != tile.patch)) vanished.push_back(tile.patch);
  return vanished;
}

// Makes room for n triangles. The arrays may keep old contents, because the tiles overwrite them.
void resize_triangles(std::int64_t n, TriangleSet &triangles) {
  resize(triangles.vertex_id, 3 * n);
  resize(triangles.leaflet_id, n);
  resize(triangles.patch_id, n);
  resize(triangles.triangle_id, n);
}

// Moves the triangles of all tiles so that no gaps remain. A tile may have fewer triangles than the room reserved for it.
void close_gaps(const Vector<Tile> &tiles, TriangleSet &triangles) {
  std::int64_t n = 0;
  for (const Tile &tile : tiles) {
    const auto move_down = [&](auto &numbers, std::int64_t per_triangle) {
      if (n == tile.first_triangle) return;
      const auto from = numbers.begin() + per_triangle * tile.first_triangle;
      std::copy(from, from + per_triangle * tile.n_triangles, numbers.begin() + per_triangle * n);
    };
    move_down(triangles.vertex_id, 3);
    move_down(triangles.leaflet_id, 1);
    move_down(triangles.patch_id, 1);
    move_down(triangles.triangle_id, 1);
    triangles.n_zero_area += view(tile.left_out).size();
    n += tile.n_triangles;
  }
  resize_triangles(n, triangles);
}

}  // namespace

bool is_missed(const TriangleSet &set, const LeftOut &triangle) {
  // A triangle without area is either a point or a segment, namely its longest edge. A triangle that is a point can be dropped
  // without loss. A triangle that is a segment can be dropped if it only repeats the diagonal of a quad whose other half was
  // kept.
  const Vec3 corner = set.vertex(triangle.corner), a = set.vertex(triangle.a), b = set.vertex(triangle.b);
  const double diagonal = distance(a, b), other = std::max(distance(corner, a), distance(corner, b));
  const bool is_on_diagonal = triangle.other_was_kept && other <= (1 + 1e-9) * diagonal;
  return !is_on_diagonal && std::max(diagonal, other) > min_edge;
}

Tiles::Tiles(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids, TriangleSet &triangles)
    : set_(set), how_(how), grids_(grids), triangles_(triangles) {
  if (how.earlier && !have_same_build(set, how.earlier->patches_before))
    own_ = OwnPatches{with_own_patches(set, set), with_own_patches(how.earlier->patches_before, set)};
  std::int64_t n_ids = 0;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const auto &images = set.patches[i].images;
    for (std::size_t k = 0; k < images.size(); ++k) {
      const Seam *seam = seam_of(set, i, k);
      const PatchImage *twin = seam ? &set.patches[seam->patch_of_twin()].images[seam->twin] : nullptr;
      tiles_.push_back({i, &images[k], twin, seam, n_vertices_, room_, n_ids});
      // At a seam, two equal vertices of a triangle may be placed by different images. They then differ by rounding, so the
      // triangle may have an area and needs room.
      room_ += grids[i].n_triangles - (seam ? 0 : grids[i].n_collapsed);
      n_ids += grids[i].n_triangles;
      n_vertices_ += grids[i].n_vertices;
      check_count(static_cast<double>(n_ids), how.max_error);
    }
  }
}

double Tiles::error_bound() const {
  double bound = 0;
  for (const LevelledGrid &grid : grids_) bound = std::max(bound, grid.error_bound);
  return (bound + set_.deviation) * how_.placement.scale;
}

void Tiles::make_patch_vertices() {
  resize(triangles_.xyz, 3 * n_vertices_);
  resize(triangles_.uv, 2 * n_vertices_);
  resize(triangles_.velocity, how_.earlier ? 3 * n_vertices_ : 0);
  triangles_.patches.clear();
  for (const Tile &tile : tiles_) {
    const Patch &patch = set_.patches[tile.patch];
    triangles_.patches.push_back({tile.image->patch_id, tile.image->leaflet_id, tile.first_vertex, patch.attached,
                                  placed(patch.axis, *tile.image, how_.placement)});
  }
  of_patches_.resize(grids_.size());
  parallel_for(view(grids_).size(), how_.n_threads, [&](std::int64_t i, int) {
    view(of_patches_)[i] = vertices_of(view(grids_)[i]);
    if (how_.earlier && !own_)
      view(of_patches_)[i].displacements =
          displacements_of({set_, how_.earlier->patches_before, static_cast<std::size_t>(i)}, view(grids_)[i]);
  });
}

void Tiles::place_vertices_of(const Tile &tile) {
  const PatchVertices &of_patch = of_patches_[tile.patch];
  const auto points = view(of_patch.points);
  const auto uv = view(of_patch.uv);
  double *const xyz = triangles_.xyz.data() + 3 * tile.first_vertex;
  kernels(best_instruction_set())
      .place_points(placed_by(*tile.image, how_.placement), &of_patch.points.front().x, points.size(), xyz);
  std::copy(of_patch.uv.begin(), of_patch.uv.end(), triangles_.uv.begin() + 2 * tile.first_vertex);
  if (tile.seam)
    for (std::int64_t i = 0; i < points.size(); ++i)
      if (tile.seam->has(uv[2 * i], uv[2 * i + 1]))
        put_vector(xyz, i, place(how_.placement, place(*tile.twin, points[i])));
  if (!how_.earlier) return;
  double *const velocity = triangles_.velocity.data() + 3 * tile.first_vertex;
  if (own_) {
    const auto number = static_cast<std::size_t>(&tile - tiles_.data());
    LevelledGrid levelled = grids_[tile.patch];
    for (Vec3 &p : levelled.grid.points) p = place(*tile.image, p);
    const Vector<Vec3> displacements = displacements_of({own_->now, own_->before, number}, levelled);
    const PatchImage &in_place = own_->now.patches[number].images.front();
    const ImageVelocity own_velocity(in_place, in_place, how_.placement, *how_.earlier);
    for (std::int64_t i = 0; i < points.size(); ++i)
      put_vector(velocity, i, own_velocity.velocity(place(*tile.image, points[i]), view(displacements)[i]));
    return;
  }
  const std::ptrdiff_t image = tile.image - set_.patches[tile.patch].images.data();
  const PatchImage &before = how_.earlier->patches_before.patches[tile.patch].images[static_cast<std::size_t>(image)];
  const ImageVelocity image_velocity(*tile.image, before, how_.placement, *how_.earlier);
  for (std::int64_t i = 0; i < points.size(); ++i)
    put_vector(velocity, i, image_velocity.velocity(points[i], view(of_patch.displacements)[i]));
}

void Tiles::make_room_for_triangles() {
  triangles_.connectivity = 0;
  triangles_.n_zero_area = 0;
  resize_triangles(room_, triangles_);
}

Vector<std::int32_t> Tiles::add_triangles_of(Tile &tile) {
  return TileTriangles(tile, grids_[tile.patch], how_.flip_normals, triangles_).add();
}

Vector<std::size_t> Tiles::complete_triangles() {
  Vector<std::size_t> vanished = vanished_patches(tiles_);
  if (!vanished.empty()) return vanished;
  close_gaps(tiles_, triangles_);
  triangles_.error_bound = error_bound();
  return vanished;
}

Triangulation checked(const PatchSet &set, const Triangulation &asked) {
  Triangulation how = asked;
  how.max_error = error_left(set, asked.max_error);
  if (how.earlier) check_same_ids(set, how.earlier->patches_before);
  return how;
}

void finish(const PatchSet &set, Vector<LevelledGrid> grids, TriangleSet &triangles) {
  triangles.rim_sides = rim_sides(set);
  triangles.grids = std::move(grids);
}

void fail_for_vanished(const PatchSet &set, std::size_t patch, const char *where) {
  fail(RIIS_INVALID_PARAMETER, "patch ", set.patches[patch].images.front().patch_id, " has no area", where,
       ", at least in part: a surface must not shrink to a curve");
}

}  // namespace riis
