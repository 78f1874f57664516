// SPDX-License-Identifier: Apache-2.0
// The fixed triangulation: a plan of grids and triangles for many openings, and the plan's triangles at one opening.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "kernels/kernels.hpp"
#include "parallel/parallel_for.hpp"
#include "triangulate/grids.hpp"
#include "triangulate/tiles.hpp"
#include "triangulate/triangulate.hpp"

namespace riis {
namespace {

// Returns true if all these triangles surely have an area (has_zero_area), even after their corners move by up to an eighth of
// `shift`.
bool have_area(const double *vertices, const std::vector<std::int64_t> &vertex_id, const Range &triangles,
               double shift) {
  const Kernels &simd = kernels(best_instruction_set());
  for (std::int64_t i = triangles.begin; i < triangles.end; i += pairs_at_once) {
    const auto n = static_cast<std::int32_t>(std::min<std::int64_t>(pairs_at_once, triangles.end - i));
    if (!simd.have_area(vertices, vertex_id.data() + 3 * i, n, shift)) return false;
  }
  return true;
}

// Returns whether all triangles of a set have an area.
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

// Bounds how far rounding moves a corner of an image. Except for rounding, the images of a patch are congruent.
double rounding_of_corners(const QuadGrid &grid, const Patch &patch, const Placement &placement) {
  double largest = 0, farthest = 0;
  for (const Vec3 &p : grid.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (const PatchImage &image : patch.images) farthest = std::max(farthest, length(image.translation));
  // Each coordinate is a sum. The error of each sum is at most 16 units of rounding of its terms.
  return 0x1p-48 * (placement.scale * (2 * largest + farthest) + length(placement.translation));
}

Vector<LevelledGrid> make_levelled_grids(const PatchSet &set, const Triangulation &how, const TriangulationPlan &plan) {
  Vector<QuadGrid> grids = make_grids(set, plan.grids, plan.max_error, how.n_threads, true);
  Vector<LevelledGrid> levelled(grids.size());
  parallel_for(view(grids).size(), how.n_threads, [&](std::int64_t i, int) {
    view(levelled)[i] = with_planned_levels(std::move(view(grids)[i]), how.max_error, view(plan.levels)[i]);
  });
  return levelled;
}

Vector<std::size_t> make_triangles(Tiles &tiles) {
  return tiles.make_triangles([](std::int64_t, const Vector<std::int32_t> &) {});
}

// Gives a set the triangles of a plan if the set lacks them.
void take_connectivity(const Connectivity &from, bool flip_normals, TriangleSet &set) {
  const std::uint64_t number = 2 * from.number + (flip_normals ? 1 : 0);
  // The plan's number alone is not enough: a set whose triangles were given away still has the plan's number.
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

// Places the vertices of these grids, and gives them the triangles of a plan. Returns false if triangles are missing, or if the
// triangles with an area are not the same as in the plan.
bool take_planned_triangles(const PatchSet &set, const Triangulation &how, const Vector<LevelledGrid> &grids,
                            const Connectivity &planned, TriangleSet &triangles) {
  Tiles tiles(set, how, grids, triangles);
  // The images of a patch are congruent. Where all images have the same triangles, only one image's areas are checked, with a
  // margin for rounding. An image with a seam is checked by itself, because it takes points from another image.
  std::atomic<bool> all_have_area{true};
  tiles.place_vertices([&](std::int64_t i) {
    const Tile &tile = view(tiles.all())[i];
    if (view(planned.images)[i].is_as_before && !tile.seam) return;
    const Range of_tile{i == 0 ? 0 : view(planned.images)[i - 1].end, view(planned.images)[i].end};
    const double rounding = rounding_of_corners(grids[tile.patch].grid, set.patches[tile.patch], how.placement);
    if (!have_area(triangles.xyz.data(), planned.vertex_id, of_tile, 16 * rounding))
      all_have_area.store(false, std::memory_order_relaxed);
  });
  take_connectivity(planned, how.flip_normals, triangles);
  for (const LeftOut &triangle : planned.left_out)
    if (!has_zero_area(triangles.vertex(triangle.corner), triangles.vertex(triangle.a), triangles.vertex(triangle.b)) ||
        is_missed(triangles, triangle))
      return false;
  if (!all_have_area.load(std::memory_order_relaxed) && !have_area(triangles)) return false;
  triangles.error_bound = tiles.error_bound();
  return true;
}

}  // namespace

TriangleSet triangulate_fixed(const PatchSet &set, const Triangulation &asked, const TriangulationPlan &plan,
                              TriangleSet memory) {
  const Triangulation how = checked(set, asked);
  check_precision(set, how.max_error);
  // In one state, patches may share curves that are separate in other states. The curves of such a state are renumbered as in the
  // plan.
  std::optional<PatchSet> renumbered;
  if (!plan.curves.is_of(set)) renumbered = plan.curves.renumbered(set);
  const PatchSet &patches = renumbered ? *renumbered : set;
  Vector<LevelledGrid> grids = make_levelled_grids(patches, how, plan);
  for (std::size_t i = 0; i < grids.size(); ++i)
    if (!(grids[i].error_bound <= how.max_error))
      fail(RIIS_LIMIT_EXCEEDED, "patch ", set.patches[i].images.front().patch_id,
           " of the fixed triangulation may be off by ", grids[i].error_bound, " at this opening; it must be at most ",
           how.max_error, ", which is tolerance * half_thickness before scaling");
  if (!take_planned_triangles(patches, how, grids, plan.connectivity, memory)) {
    // At this opening, the triangles with an area are not the same as in the plan. The plan's groups do not fit these triangles,
    // so they get new groups.
    Tiles tiles(patches, how, grids, memory);
    const Vector<std::size_t> vanished = make_triangles(tiles);
    if (!vanished.empty()) fail_for_vanished(set, vanished.front(), " in the fixed triangulation at this opening");
    group_all_by_place(memory, memory.grouping);
  }
  finish(set, std::move(grids), memory);  // `set`, not `patches`: a curve that two patches of `set` share is no rim
  return memory;
}

bool is_within(const PatchSet &state, const TriangulationPlan &plan, double asked_error) {
  const double max_error = error_left(state, asked_error);
  const Placement in_place{1, no_rotation, {0, 0, 0}};
  const Vector<LevelledGrid> grids =
      make_levelled_grids(plan.curves.renumbered(state), {max_error, in_place, false, 1}, plan);
  return std::all_of(grids.begin(), grids.end(),
                     [&](const LevelledGrid &grid) { return grid.error_bound <= max_error; });
}

namespace {

// Raises the plan's levels to the levels that a state needs.
void raise_levels(const PatchSet &set, double max_error, TriangulationPlan &plan) {
  const Vector<QuadGrid> grids = make_grids(set, plan.grids, max_error, 1, false);
  plan.levels.resize(grids.size());
  for (std::size_t i = 0; i < grids.size(); ++i) raise_levels(grids[i], max_error, plan.levels[i]);
}

// Halves the columns of a patch of arcs where this gives fewer triangles, because the narrower quads need fewer halvings. Returns
// whether the columns of any patch were halved. After the halving, the levels of the plan must be found again.
bool halve_columns(const PatchSet &set, TriangulationPlan &plan) {
  bool are_any = false;
  for (std::size_t i = 0; i < set.patches.size(); ++i) {
    PatchPlan &of_patch = plan.grids.patches[i];
    if (!of_patch.has_arcs || set.patches[i].skirt_of_arcs != no_patch) continue;
    const std::size_t n = of_patch.u.size() - 1, n_rows = plan.grids.n_rows;
    PatchPlan halved = of_patch;
    halved.u.clear(), halved.n_parts.clear();
    for (std::size_t k = 0; k < n; ++k) {
      double n_quads = 0;
      for (std::size_t j = 0; j < n_rows; ++j) n_quads += std::ldexp(1.0, 2 * plan.levels[i][j * n + k]);
      halved.u.push_back(of_patch.u[k]);
      halved.n_parts.push_back(of_patch.n_parts[k]);
      if (!(n_quads > 2 * static_cast<double>(n_rows))) continue;
      halved.n_parts.back() = (of_patch.n_parts[k] + 1) / 2;
      halved.u.push_back(0.5 * (of_patch.u[k] + of_patch.u[k + 1]));
      halved.n_parts.push_back(halved.n_parts.back());
    }
    halved.u.push_back(1);
    if (halved.u.size() == of_patch.u.size()) continue;
    are_any = true;
    // A skirt has the same lines as its patch.
    for (std::size_t k = 0; k < set.patches.size(); ++k)
      if (k == i || set.patches[k].skirt_of_arcs == i) plan.grids.patches[k] = halved;
  }
  return are_any;
}

// Returns the patches with missing triangles at one of the openings.
Vector<std::size_t> vanished_anywhere(const Vector<PatchSet> &states, const Triangulation &how,
                                      const TriangulationPlan &plan, TriangleSet &triangles) {
  for (const PatchSet &state : states) {
    const Vector<LevelledGrid> grids = make_levelled_grids(state, how, plan);
    Tiles tiles(state, how, grids, triangles);
    Vector<std::size_t> vanished = make_triangles(tiles);
    if (!vanished.empty()) return vanished;
  }
  return {};
}

// Returns a number for a plan, never 0. No two plans get the same number.
std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

// Returns whether two tiles are images of one patch and leave out the same triangles.
bool have_same_triangles(const Tile &a, const Tile &b) {
  const std::int64_t between = b.first_vertex - a.first_vertex;
  return a.patch == b.patch && std::equal(a.left_out.begin(), a.left_out.end(), b.left_out.begin(), b.left_out.end(),
                                          [&](const LeftOut &p, const LeftOut &q) {
                                            return q.corner - p.corner == between && q.a - p.a == between;
                                          });
}

// Makes the triangles of a plan at one of the plan's openings. At this opening no triangle may be missing.
Connectivity make_connectivity(const PatchSet &state, const Triangulation &how, const TriangulationPlan &plan,
                               TriangleSet triangles) {
  const Vector<LevelledGrid> grids = make_levelled_grids(state, how, plan);
  Tiles tiles(state, how, grids, triangles);
  make_triangles(tiles);
  Connectivity made;
  for (const Tile &tile : tiles.all()) {
    made.left_out.insert(made.left_out.end(), tile.left_out.begin(), tile.left_out.end());
    const bool is_first = made.images.empty();
    made.images.push_back({(is_first ? 0 : made.images.back().end) + tile.n_triangles,
                           !is_first && have_same_triangles(*(&tile - 1), tile)});
  }
  group_all_by_place(triangles, made.grouping);
  made.vertex_id = std::move(triangles.vertex_id);
  made.triangle_id = std::move(triangles.triangle_id);
  made.leaflet_id = std::move(triangles.leaflet_id);
  made.patch_id = std::move(triangles.patch_id);
  made.number = next_number();
  return made;
}

}  // namespace

TriangulationPlan plan_triangulation(const Vector<PatchSet> &given, double asked_error, int n_threads) {
  double max_error = asked_error;
  for (const PatchSet &state : given) max_error = std::min(max_error, error_left(state, asked_error));
  // The plan uses less than the whole allowed error. The rest is kept for openings between the given openings.
  constexpr double share = 0.95;
  const double planned_error = share * max_error;
  // A curve that patches share at only one opening is two curves at other openings. The state with the most curves therefore
  // gives the numbering.
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
  const Triangulation how{max_error, in_place, false, n_threads};
  TriangulationPlan plan{{}, numbering, planned_error, {}, {}};
  TriangleSet triangles;
  with_finer_curves(middle, " at an opening", [&](const Vector<double> &tightness) {
    plan.grids = plan_grids(states, planned_error, planned_curve_share, tightness);
    constexpr int most_rounds = 3;
    for (int round = 0;; ++round) {
      plan.levels.clear();
      for (const PatchSet &state : states) raise_levels(state, planned_error, plan);
      if (round == most_rounds || !halve_columns(states.front(), plan)) break;
    }
    return vanished_anywhere(states, how, plan, triangles);
  });
  plan.connectivity = make_connectivity(middle, how, plan, std::move(triangles));
  return plan;
}

}  // namespace riis
