// SPDX-License-Identifier: Apache-2.0
#include "surface/triangulate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "parallel/parallel_for.hpp"
#include "surface/grids.hpp"
#include "surface/rims.hpp"
#include "surface/triangle_groups.hpp"

namespace riis {
namespace {

// An image of a patch, with its own vertices and triangles in a set. The thread that builds the image writes no others.
struct Piece {
  const LevelledGrid *levelled;
  const PatchImage *image;
  const PatchImage *twin;  // null without a seam
  const Seam *seam;
  std::int64_t first_vertex, first_triangle;
  std::int64_t n_triangles = 0;  // without triangles that turned out to have no area; there may be room for more
  std::int64_t n_zero_area = 0;
  Vector<LeftOut> left_out{};
  bool is_whole = true;  // false if the triangles kept do not stand for all triangles left out for lack of area
  Grouping grouping{};
};

// A triangle without area is its longest edge. The edge is still there if it is the diagonal of a quad whose other half was kept.
// Nothing is lost if the triangle is a point.
bool is_missed(const TriangleSet &set, const LeftOut &triangle) {
  const Vec3 corner = set.vertex(triangle.corner), a = set.vertex(triangle.a), b = set.vertex(triangle.b);
  const double diagonal = distance(a, b), other = std::max(distance(corner, a), distance(corner, b));
  const bool is_on_diagonal = triangle.other_was_kept && other <= (1 + 1e-9) * diagonal;
  return !is_on_diagonal && std::max(diagonal, other) > min_edge;
}

// Returns false if one of these triangles may have no area (has_zero_area), or may have none after its corners move by up to an
// eighth of `shift`.
bool have_area(const double *vertices, const std::vector<std::int64_t> &vertex_id, const Range &triangles,
               double shift) {
  const Kernels &simd = kernels(best_instruction_set());
  for (std::int64_t i = triangles.begin; i < triangles.end; i += pairs_at_once) {
    const auto n = static_cast<std::int32_t>(std::min<std::int64_t>(pairs_at_once, triangles.end - i));
    if (!simd.have_area(vertices, vertex_id.data() + 3 * i, n, shift)) return false;
  }
  return true;
}

// Returns whether no triangle has zero area.
bool have_area(const TriangleSet &set) {
  constexpr std::int64_t n_at_once = 128;
  for (std::int64_t i = 0, n = set.n_triangles(); i < n; i += n_at_once) {
    const Range few{i, std::min(n, i + n_at_once)};
    if (have_area(set.xyz.data(), set.vertex_id, few, 0)) continue;
    for (std::int64_t k = few.begin; k < few.end; ++k) {
      const auto [a, b, c] = set.corners(k);
      if (has_zero_area(a, b, c)) return false;
    }
  }
  return true;
}

// Bounds how far a corner of an image of a patch is from its place in an image that is exactly congruent to the others.
double rounding_of_places(const QuadGrid &grid, const Patch &patch, const Placement &placement) {
  double largest = 0, farthest = 0;
  for (const Vec3 &p : grid.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (const PatchImage &image : patch.images) farthest = std::max(farthest, length(image.translation));
  // Each coordinate is right to 16 units of rounding of the numbers that it is the sum of.
  return 0x1p-48 * (placement.scale * (2 * largest + farthest) + length(placement.translation));
}

// The vertices of a patch before any image is placed: those of the grid, then those of subdivided quads.
struct PatchVertices {
  // `moved` is null without an earlier state.
  PatchVertices(const LevelledGrid &levelled, const MovedPatch *moved) {
    const QuadGrid &grid = levelled.grid;
    const auto n = static_cast<std::size_t>(levelled.n_vertices);
    std::optional<PatchMotion> motion;
    if (moved) motion.emplace(*moved, levelled);
    points.reserve(n);
    uv.reserve(2 * n);
    displacements.reserve(motion ? n : 0);
    points = grid.points;
    for (std::size_t j = 0; j < grid.v.size(); ++j)
      for (std::size_t i = 0; i < grid.u.size(); ++i) {
        add(grid.u[i], grid.v[j]);
        if (motion) displacements.push_back(motion->at_lines(i, j));
      }
    auto level_of_next = levelled.levels.begin();
    for_each_quad(grid, [&](std::size_t i, std::size_t j) {
      const int level = *level_of_next++;
      if (level == 0) return;
      // All parts of a bilinear quad at one level have the same flatness. So recursive halving would end in equal parts, and they
      // are made in one go.
      const int n_parts = 1 << level;
      const double step = 1.0 / n_parts;  // a power of two
      const Quad quad = quad_of(grid, i, j);
      const double u0 = grid.u[i], u1 = grid.u[i + 1], v0 = grid.v[j], v1 = grid.v[j + 1];
      for (int row = 0; row <= n_parts; ++row)
        for (int column = 0; column <= n_parts; ++column) {
          const double s = column * step, t = row * step;
          points.push_back(quad.at(s, t));
          if (motion) displacements.push_back(motion->without_jumps(i, j, column, row));
          add((1 - s) * u0 + s * u1, (1 - t) * v0 + t * v1);
        }
    });
  }

  Vector<Vec3> points;
  Vector<double> uv;
  Vector<Vec3> displacements;  // since an earlier state; empty without one

 private:
  void add(double u, double v) {
    uv.push_back(u);
    uv.push_back(v);
  }
};

PlacedBy placed_by(const PatchImage &image, const Placement &placement) {
  PlacedBy by{};
  const auto put = [](Vec3 column, double *to) { to[0] = column.x, to[1] = column.y, to[2] = column.z; };
  const auto put_columns = [&](const Rotation &from, double(*to)[4]) {
    put({from.row_x.x, from.row_y.x, from.row_z.x}, to[0]);
    put({from.row_x.y, from.row_y.y, from.row_z.y}, to[1]);
    put({from.row_x.z, from.row_y.z, from.row_z.z}, to[2]);
  };
  put_columns(image.rotation, by.of_image);
  // The product with a mirrored coordinate is that with a mirrored column, to the last bit.
  if (image.mirror != Mirror::none)
    for (double &x : by.of_image[image.mirror == Mirror::in_x ? 0 : 1]) x = -x;
  put(image.translation, by.offset_of_image);
  put_columns(placement.rotation, by.rotation);
  put(placement.translation, by.translation);
  by.scale = placement.scale;
  return by;
}

class PieceBuilder {
 public:
  // The motion is that of the piece's image, or null.
  PieceBuilder(Piece &piece, const Triangulation &how, const ImageMotion *motion, TriangleSet &set)
      : piece_(piece), grid_(piece.levelled->grid), how_(how), motion_(motion), set_(set) {}

  void place_vertices(const PatchVertices &of_patch) {
    const Vector<Vec3> &points = of_patch.points;
    const Vector<double> &uv = of_patch.uv;
    double *const xyz = set_.xyz.data() + 3 * piece_.first_vertex;
    kernels(best_instruction_set())
        .place_points(placed_by(*piece_.image, how_.placement), &points.front().x, view(points).size(), xyz);
    std::copy(uv.begin(), uv.end(), set_.uv.begin() + 2 * piece_.first_vertex);
    if (piece_.seam)
      for (std::int64_t i = 0; i < view(points).size(); ++i)
        if (piece_.seam->has(view(uv)[2 * i], view(uv)[2 * i + 1]))
          put_vector(xyz, i, place(how_.placement, place(*piece_.twin, view(points)[i])));
    if (motion_)
      for (std::int64_t i = 0; i < view(points).size(); ++i)
        put_vector(set_.velocity.data() + 3 * piece_.first_vertex, i,
                   motion_->velocity(view(points)[i], view(of_patch.displacements)[i]));
  }

  // The vertices have been placed.
  void add_triangles() {
    auto level_of_next = piece_.levelled->levels.begin();
    const auto n_u = static_cast<std::int64_t>(grid_.u.size()), n_v = static_cast<std::int64_t>(grid_.v.size());
    std::int64_t next_subdivided = piece_.first_vertex + n_u * n_v;
    first_of_quad_.reserve(piece_.levelled->levels.size() + 1);
    for_each_quad(grid_, [&](std::size_t i, std::size_t j) {
      first_of_quad_.push_back(next_triangle());
      const int level = *level_of_next++;
      if (level == 0) {
        const std::int64_t first =
            piece_.first_vertex + static_cast<std::int64_t>(j) * n_u + static_cast<std::int64_t>(i);
        add_quad({first, first + 1, first + n_u + 1, first + n_u});
      } else {
        add_quads(next_subdivided, level);
        const std::int64_t n = (std::int64_t{1} << level) + 1;
        next_subdivided += n * n;
      }
    });
    first_of_quad_.push_back(next_triangle());
    // A plan has its own groups.
    if (!how_.plan) group({0, grid_.u.size() - 1, 0, grid_.v.size() - 1});
  }

 private:
  std::int32_t next_triangle() const { return static_cast<std::int32_t>(piece_.first_triangle + piece_.n_triangles); }

  // The quads of the grid from i0 to i1 - 1 and from j0 to j1 - 1.
  struct Quads {
    std::size_t i0, i1, j0, j1;
  };

  // Halves quads along their longer side until their triangles fit in a group.
  void group(const Quads &quads) {
    const std::size_t i0 = quads.i0, i1 = quads.i1, j0 = quads.j0, j1 = quads.j1;
    const std::size_t n_u = grid_.u.size() - 1;
    // Quads of a row follow each other, and so do their triangles.
    const auto triangles_of_row = [&](std::size_t j) {
      return std::pair(first_of_quad_[j * n_u + i0], first_of_quad_[j * n_u + i1]);
    };
    std::int32_t n = 0;
    for (std::size_t j = j0; j < j1; ++j) n += triangles_of_row(j).second - triangles_of_row(j).first;
    if (n == 0) return;
    Grouping &grouping = piece_.grouping;
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
    const bool along_u = j1 - j0 == 1 || (i1 - i0 > 1 && distance(grid_.point(i0, j), grid_.point(i1, j)) >
                                                             distance(grid_.point(i, j0), grid_.point(i, j1)));
    if (along_u) {
      group({i0, i, j0, j1});
      group({i, i1, j0, j1});
    } else {
      group({i0, i1, j0, j});
      group({i0, i1, j, j1});
    }
  }

  // Adds the quads of a quad that is subdivided to a level, whose vertices begin with `first`.
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
    if (is_missed(set_, triangle)) piece_.is_whole = false;
    if (how_.plan) piece_.left_out.push_back(triangle);
  }

  bool add_triangle(std::int64_t a, std::int64_t b, std::int64_t c) {
    if (has_zero_area(set_.vertex(a), set_.vertex(b), set_.vertex(c))) {
      ++piece_.n_zero_area;
      return false;
    }
    if ((piece_.image->mirror != Mirror::none) != how_.flip_normals) std::swap(b, c);
    const std::int64_t at = next_triangle();
    std::int64_t *id = set_.vertex_id.data() + 3 * at;
    id[0] = a, id[1] = b, id[2] = c;
    view(set_.leaflet_id)[at] = piece_.image->leaflet_id;
    view(set_.patch_id)[at] = piece_.image->patch_id;
    view(set_.triangle_id)[at] = piece_.first_triangle + piece_.n_triangles + piece_.n_zero_area;
    ++piece_.n_triangles;
    return true;
  }

  Piece &piece_;
  const QuadGrid &grid_;
  const Triangulation &how_;
  const ImageMotion *motion_;
  TriangleSet &set_;
  Vector<std::int32_t> first_of_quad_;
};

// Makes room for all pieces. The old contents may stay: the pieces write everything.
void make_room(std::int64_t n_vertices, std::int64_t n_triangles, bool has_velocities, TriangleSet &set) {
  resize(set.xyz, 3 * n_vertices);
  resize(set.uv, 2 * n_vertices);
  resize(set.velocity, has_velocities ? 3 * n_vertices : 0);
  resize(set.vertex_id, 3 * n_triangles);
  resize(set.leaflet_id, n_triangles);
  resize(set.patch_id, n_triangles);
  resize(set.triangle_id, n_triangles);
  set.n_zero_area = 0;
}

// Moves the triangles of all pieces together. Pieces may have fewer triangles than there was room for.
void close_gaps(const Vector<Piece> &pieces, bool has_planned_ids, TriangleSet &set) {
  set.grouping.order.clear();
  set.grouping.end.clear();
  std::int64_t n = 0;
  for (const Piece &piece : pieces) {
    const auto move_down = [&](auto &numbers, std::int64_t per_triangle) {
      if (n == piece.first_triangle) return;
      const auto from = numbers.begin() + per_triangle * piece.first_triangle;
      std::copy(from, from + per_triangle * piece.n_triangles, numbers.begin() + per_triangle * n);
    };
    move_down(set.vertex_id, 3);
    move_down(set.leaflet_id, 1);
    move_down(set.patch_id, 1);
    move_down(set.triangle_id, 1);
    const auto n_grouped = static_cast<std::int32_t>(set.grouping.order.size());
    for (const std::int32_t triangle : piece.grouping.order)
      set.grouping.order.push_back(static_cast<std::int32_t>(triangle - piece.first_triangle + n));
    for (const std::int32_t end : piece.grouping.end) set.grouping.end.push_back(n_grouped + end);
    set.n_zero_area += piece.n_zero_area;
    n += piece.n_triangles;
  }
  resize(set.vertex_id, 3 * n);
  resize(set.leaflet_id, n);
  resize(set.patch_id, n);
  resize(set.triangle_id, n);
  if (!has_planned_ids) std::iota(set.triangle_id.begin(), set.triangle_id.end(), std::int64_t{0});
}

// The same image of the same patch in an earlier state.
const PatchImage &image_before(const Piece &piece, const Vector<LevelledGrid> &grids, const PatchSet &now,
                               const PatchSet &before) {
  const auto patch = static_cast<std::size_t>(piece.levelled - grids.data());
  const std::ptrdiff_t image = piece.image - now.patches[patch].images.data();
  return before.patches[patch].images[static_cast<std::size_t>(image)];
}

Vector<LevelledGrid> make_levelled_grids(const PatchSet &set, const Triangulation &how,
                                         const Vector<double> &tightness) {
  const bool keeps_lines = how.motion != nullptr;
  const TriangulationPlan *plan = how.plan;
  Vector<QuadGrid> grids = plan ? make_grids(set, plan->grids, plan->max_error, how.n_threads, keeps_lines)
                                : make_grids(set, how.max_error, tightness, how.n_threads, keeps_lines);
  Vector<LevelledGrid> levelled(grids.size());
  parallel_for(view(grids).size(), how.n_threads, [&](std::int64_t i, int) {
    view(levelled)[i] = with_levels(std::move(view(grids)[i]), how.max_error, plan ? &view(plan->levels)[i] : nullptr);
  });
  return levelled;
}

// Returns the patches of which triangles without area are missed.
Vector<std::size_t> vanished_patches(const Vector<Piece> &pieces, const Vector<LevelledGrid> &grids) {
  Vector<std::size_t> vanished;
  for (const Piece &piece : pieces) {
    const auto i = static_cast<std::size_t>(piece.levelled - grids.data());
    if (!piece.is_whole && (vanished.empty() || vanished.back() != i)) vanished.push_back(i);
  }
  return vanished;
}

// Returns the seam of an image, or null.
const Seam *seam_of(const PatchSet &set, std::size_t patch, std::size_t image) {
  for (const Seam &seam : set.seams)
    if (seam.patch == patch && seam.image == image) return &seam;
  return nullptr;
}

// The pieces of all images, and how much they may need.
struct Pieces {
  Vector<Piece> all;
  std::int64_t n_triangles = 0, n_vertices = 0;
};

Pieces make_pieces(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids) {
  Pieces pieces;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const auto &images = set.patches[i].images;
    for (std::size_t k = 0; k < images.size(); ++k) {
      const Seam *seam = seam_of(set, i, k);
      pieces.all.push_back(
          {&grids[i], &images[k], seam ? &images[seam->twin] : nullptr, seam, pieces.n_vertices, pieces.n_triangles});
      pieces.n_triangles += grids[i].n_triangles;
      pieces.n_vertices += grids[i].n_vertices;
      check_count(static_cast<double>(pieces.n_triangles), how.max_error);
    }
  }
  return pieces;
}

// Places the vertices of every piece, then calls work(builder, i) for the builder of piece i.
template <class Work>
void place_pieces(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids, Pieces &pieces,
                  TriangleSet &triangles, const Work &work) {
  Vector<std::optional<PatchVertices>> of_patches(grids.size());
  parallel_for(view(grids).size(), how.n_threads, [&](std::int64_t i, int) {
    std::optional<MovedPatch> moved;
    if (how.motion) moved.emplace(MovedPatch{set, how.motion->patches_before, static_cast<std::size_t>(i)});
    view(of_patches)[i].emplace(view(grids)[i], moved ? &*moved : nullptr);
  });
  parallel_for(view(pieces.all).size(), how.n_threads, [&](std::int64_t i, int) {
    Piece &piece = view(pieces.all)[i];
    std::optional<ImageMotion> image_motion;
    if (how.motion)
      image_motion.emplace(*piece.image, image_before(piece, grids, set, how.motion->patches_before), how.placement,
                           *how.motion);
    PieceBuilder builder(piece, how, image_motion ? &*image_motion : nullptr, triangles);
    builder.place_vertices(*view(of_patches)[piece.levelled - grids.data()]);
    work(builder, i);
  });
}

double error_bound_of(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids) {
  double error_bound = 0;
  for (const LevelledGrid &grid : grids) error_bound = std::max(error_bound, grid.error_bound);
  return (error_bound + set.deviation) * how.placement.scale;
}

// Returns whether two pieces are images of one patch that leave out the same triangles.
bool have_same_triangles(const Piece &a, const Piece &b) {
  const std::int64_t between = b.first_vertex - a.first_vertex;
  return a.levelled == b.levelled && std::equal(a.left_out.begin(), a.left_out.end(), b.left_out.begin(),
                                                b.left_out.end(), [&](const LeftOut &p, const LeftOut &q) {
                                                  return q.corner - p.corner == between && q.a - p.a == between;
                                                });
}

// Makes the triangles of these grids. Returns the patches of which triangles are missed; the triangles are complete if
// there are none. Writes the triangles that were left out by a plan, and those of each image, where they are wanted.
Vector<std::size_t> build(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids,
                          TriangleSet &triangles, Connectivity *made = nullptr) {
  Pieces pieces = make_pieces(set, how, grids);
  triangles.connectivity = 0;
  make_room(pieces.n_vertices, pieces.n_triangles, how.motion != nullptr, triangles);
  place_pieces(set, how, grids, pieces, triangles,
               [](PieceBuilder &builder, std::int64_t) { builder.add_triangles(); });
  Vector<std::size_t> vanished = vanished_patches(pieces.all, grids);
  if (!vanished.empty()) return vanished;
  close_gaps(pieces.all, how.plan != nullptr, triangles);
  triangles.error_bound = error_bound_of(set, how, grids);
  if (made)
    for (const Piece &piece : pieces.all) {
      made->left_out.insert(made->left_out.end(), piece.left_out.begin(), piece.left_out.end());
      const bool is_first = made->images.empty();
      made->images.push_back({(is_first ? 0 : made->images.back().end) + piece.n_triangles,
                              !is_first && have_same_triangles(*(&piece - 1), piece)});
    }
  return vanished;
}

// Gives a set the triangles of a plan, unless it still has them.
void take_connectivity(const Connectivity &from, bool flip_normals, TriangleSet &set) {
  const std::uint64_t number = 2 * from.number + (flip_normals ? 1 : 0);
  // Triangles that were moved away have left an empty set.
  if (set.connectivity == number && set.triangle_id.size() == from.triangle_id.size()) return;
  set.connectivity = 0;
  set.vertex_id = from.vertex_id;
  if (flip_normals)
    for (std::size_t i = 0; i < set.vertex_id.size(); i += 3) std::swap(set.vertex_id[i + 1], set.vertex_id[i + 2]);
  set.triangle_id = from.triangle_id;
  set.leaflet_id = from.leaflet_id;
  set.patch_id = from.patch_id;
  set.grouping = from.grouping;
  set.n_zero_area = view(from.left_out).size();
  set.connectivity = number;
}

// Places the vertices of these grids under the triangles of a plan. Returns false if other triangles have an area here than in
// the plan, or if some are missed.
bool place_by_plan(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids,
                   TriangleSet &triangles) {
  const Connectivity &planned = how.plan->connectivity;
  Pieces pieces = make_pieces(set, how, grids);
  resize(triangles.xyz, 3 * pieces.n_vertices);
  resize(triangles.uv, 2 * pieces.n_vertices);
  resize(triangles.velocity, how.motion ? 3 * pieces.n_vertices : 0);
  // Images of a patch are congruent. So the areas of one image are enough, with a margin for rounding, if the others have the same
  // triangles. An image with a seam has points of another.
  std::atomic<bool> all_have_area{true};
  place_pieces(set, how, grids, pieces, triangles, [&](PieceBuilder &, std::int64_t i) {
    const Piece &piece = view(pieces.all)[i];
    if (view(planned.images)[i].is_as_before && !piece.seam) return;
    const Range of_piece{i == 0 ? 0 : view(planned.images)[i - 1].end, view(planned.images)[i].end};
    const Patch &patch = set.patches[static_cast<std::size_t>(piece.levelled - grids.data())];
    const double rounding = rounding_of_places(piece.levelled->grid, patch, how.placement);
    if (!have_area(triangles.xyz.data(), planned.vertex_id, of_piece, 16 * rounding))
      all_have_area.store(false, std::memory_order_relaxed);
  });
  take_connectivity(planned, how.flip_normals, triangles);
  for (const LeftOut &triangle : planned.left_out)
    if (!has_zero_area(triangles.vertex(triangle.corner), triangles.vertex(triangle.a), triangles.vertex(triangle.b)) ||
        is_missed(triangles, triangle))
      return false;
  if (!all_have_area.load(std::memory_order_relaxed) && !have_area(triangles)) return false;
  triangles.error_bound = error_bound_of(set, how, grids);
  return true;
}

[[noreturn]] void fail_for_vanished(const PatchSet &set, std::size_t patch, const char *where) {
  fail(RIIS_INVALID_PARAMETER, "patch ", set.patches[patch].images.front().patch_id, " has no area", where,
       ", at least in part: a surface is no curve");
}

void make_finer(const PatchSet &set, const Vector<std::size_t> &patches, Vector<double> &tightness) {
  for (const std::size_t i : patches)
    for (const Side &side : {set.patches[i].v0, set.patches[i].v1, set.patches[i].u0, set.patches[i].u1})
      tightness[side.curve] *= 0.1;
}

// Patches thinner than the tolerance lose their area if their sides become the same chords. Their curves have to be finer.
constexpr int max_attempts = 12;

// Keeps the grids of a motion, for the bound of the velocities' errors.
void keep(Vector<LevelledGrid> grids, const Triangulation &how, TriangleSet &triangles) {
  if (how.motion)
    triangles.moved_grids = std::move(grids);
  else
    triangles.moved_grids.clear();
}

// Makes triangles by a plan. Groups by place where other triangles have an area than in the plan.
TriangleSet triangulate_by_plan(const PatchSet &set, const Triangulation &how, TriangleSet triangles) {
  check_precision(set, how.max_error);
  // Only the states that share curves are renumbered.
  std::optional<PatchSet> renumbered;
  if (!how.plan->curves.is_of(set)) renumbered = how.plan->curves.renumbered(set);
  const PatchSet &patches = renumbered ? *renumbered : set;
  Vector<LevelledGrid> grids = make_levelled_grids(patches, how, {});
  for (std::size_t i = 0; i < grids.size(); ++i)
    if (!(grids[i].error_bound <= how.max_error))
      fail(RIIS_LIMIT_EXCEEDED, "patch ", set.patches[i].images.front().patch_id,
           " of the fixed triangulation may be off by ", grids[i].error_bound, " at this opening; it must be at most ",
           how.max_error, ", which is tolerance * half_thickness before scaling");
  if (!place_by_plan(patches, how, grids, triangles)) {
    const Vector<std::size_t> vanished = build(patches, how, grids, triangles);
    if (!vanished.empty()) fail_for_vanished(set, vanished.front(), " in the fixed triangulation at this opening");
    group_by_place(triangles, 0, static_cast<std::int32_t>(triangles.n_triangles()), triangles.grouping);
  }
  triangles.rim_sides = rim_sides(set);  // shared curves are no rims
  keep(std::move(grids), how, triangles);
  return triangles;
}

}  // namespace

TriangleSet triangulate(const PatchSet &set, const Triangulation &asked, TriangleSet memory) {
  Triangulation how = asked;
  how.max_error = error_left(set, asked.max_error);
  if (how.motion) check_same_build(set, how.motion->patches_before);
  if (how.plan) return triangulate_by_plan(set, how, std::move(memory));
  Vector<double> tightness(set.curves.size(), 1);
  for (int attempt = 0;; ++attempt) {
    Vector<LevelledGrid> grids = make_levelled_grids(set, how, tightness);
    const Vector<std::size_t> vanished = build(set, how, grids, memory);
    if (vanished.empty()) {
      memory.rim_sides = rim_sides(set);
      keep(std::move(grids), how, memory);
      return memory;
    }
    if (attempt == max_attempts) fail_for_vanished(set, vanished.front(), "");
    make_finer(set, vanished, tightness);
  }
}

bool is_within(const PatchSet &state, const TriangulationPlan &plan, double asked_error) {
  const double max_error = error_left(state, asked_error);
  const Placement in_place{1, no_rotation, {0, 0, 0}};
  const Vector<LevelledGrid> grids =
      make_levelled_grids(plan.curves.renumbered(state), {max_error, in_place, false, 1, nullptr, &plan}, {});
  return std::all_of(grids.begin(), grids.end(),
                     [&](const LevelledGrid &grid) { return grid.error_bound <= max_error; });
}

namespace {

// Lifts the levels to the levels that a state needs.
void raise_levels(const PatchSet &set, double max_error, TriangulationPlan &plan) {
  const Vector<QuadGrid> grids = make_grids(set, plan.grids, max_error, 1, false);
  plan.levels.resize(grids.size());
  for (std::size_t i = 0; i < grids.size(); ++i) raise_levels(grids[i], max_error, plan.levels[i]);
}

// Returns the patches of which triangles are missed at one of the openings.
Vector<std::size_t> vanished_anywhere(const Vector<PatchSet> &states, const Triangulation &how,
                                      TriangleSet &triangles) {
  for (const PatchSet &state : states) {
    const Vector<std::size_t> vanished = build(state, how, make_levelled_grids(state, how, {}), triangles);
    if (!vanished.empty()) return vanished;
  }
  return {};
}

// No two plans have the same number, and none has 0.
std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace

TriangulationPlan plan_triangulation(const Vector<PatchSet> &given, double asked_error, int n_threads) {
  double max_error = asked_error;
  for (const PatchSet &state : given) max_error = std::min(max_error, error_left(state, asked_error));
  // The rest is for openings between these.
  constexpr double share = 0.95;
  const double planned_error = share * max_error;
  // Curves that are shared at one opening only have two numbers.
  const PatchSet &widest = *std::max_element(given.begin(), given.end(), [](const PatchSet &a, const PatchSet &b) {
    return a.curves.size() < b.curves.size();
  });
  const CurveNumbering numbering(widest);
  Vector<PatchSet> states;
  for (const PatchSet &state : given) {
    check_same_build(widest, state);
    states.push_back(numbering.renumbered(state));
  }
  const PatchSet &middle = states[states.size() / 2];
  const Placement in_place{1, no_rotation, {0, 0, 0}};
  Vector<double> tightness(middle.curves.size(), 1);
  for (int attempt = 0;; ++attempt) {
    TriangulationPlan plan{
        plan_grids(states, planned_error, planned_curve_share, tightness), numbering, planned_error, {}, {}};
    for (const PatchSet &state : states) raise_levels(state, planned_error, plan);
    const Triangulation how{max_error, in_place, false, n_threads, nullptr, &plan};
    TriangleSet triangles;
    const Vector<std::size_t> vanished = vanished_anywhere(states, how, triangles);
    if (vanished.empty()) {
      Connectivity &made = plan.connectivity;
      build(middle, how, make_levelled_grids(middle, how, {}), triangles, &made);
      group_by_place(triangles, 0, static_cast<std::int32_t>(triangles.n_triangles()), made.grouping);
      made.vertex_id = std::move(triangles.vertex_id);
      made.triangle_id = std::move(triangles.triangle_id);
      made.leaflet_id = std::move(triangles.leaflet_id);
      made.patch_id = std::move(triangles.patch_id);
      made.number = next_number();
      return plan;
    }
    if (attempt == max_attempts) fail_for_vanished(middle, vanished.front(), " at an opening");
    make_finer(middle, vanished, tightness);
  }
}

}  // namespace riis
