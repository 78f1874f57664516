// SPDX-License-Identifier: Apache-2.0
#include "program/patient/flat_ends.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "common/sets.hpp"
#include "program/base/text.hpp"
#include "program/input/wall.hpp"
#include "program/output/report.hpp"

namespace riis::program {
namespace {

// Two vertices of open sides are joined if their distance is below this share of the wall's size. If a root is a metre away from
// the origin, its rounding errors in single precision are a sixth of this distance.
constexpr double joined_share = 1e-5;
// A piece is an island of the segmentation if its area is below this share of the largest piece's area.
constexpr double island_share = 0.01;
// A hole is flat if no point of its rim is farther from a plane than this share of the rim's width.
constexpr double flat_hole_share = 0.02;

// A triangle is thin if its height is below the share `thin_share` of the wall's size. With thin triangles, gmsh would run for
// hours. A side of a thin triangle is short if it is shorter than `short_in_heights` heights.
constexpr double thin_share = 2e-6, short_in_heights = 10;
constexpr int most_thin_rounds = 20;

constexpr const char *how_to_close = "close it, for example by the filter Close Holes of MeshLab";

// Repairs the surface of a wall in several steps.
class WallRepair {
 public:
  explicit WallRepair(const std::string &path) : path_(path) {
    read();
    join_equal_points();
    join_near_points();
    keep_one_piece();
    refuse_forks();
    turn_alike();
    repair_thin();
    close_holes();
    refuse_touching_points();
    turn_outwards();
  }
  ClosedSurface result() && { return std::move(made_); }

 private:
  [[noreturn]] void refuse(const std::string &text) const { refuse_data(path_ + ": " + text); }
  void remark(const std::string &text) { made_.remarks.push_back(path_ + ": " + text); }
  std::string at(const Vector3 &point) const { return point_text(point, made_.triangles.size()); }
  std::vector<Vector3> &points() { return made_.triangles.points; }
  std::vector<Corners> &corners() { return made_.triangles.corners; }

  void read() {
    const SurfaceFile file = read_wall(path_);
    const auto arrays = get<riis_surface_arrays>(riis_vtk_surface_get_arrays, file);
    // Surfaces from files store x, y and z in turn as doubles, and ids as integers of 64 bits.
    const auto *const xyz = static_cast<const double *>(arrays.x);
    for (std::int64_t i = 0; i < arrays.n_vertices; ++i)
      points().push_back({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
    const std::int64_t n_corners = arrays.corners_per_face;
    for (std::int64_t face = 0; face < arrays.n_faces; ++face) {
      const std::int64_t *const id = static_cast<const std::int64_t *>(arrays.vertex_ids) + n_corners * face;
      for (std::int64_t k = 2; k < n_corners; ++k) corners().push_back({id[0], id[k - 1], id[k]});
    }
    for (const Corners &triangle : corners())
      for (const std::int64_t id : triangle)
        for (const double x : view(points())[id])
          if (!std::isfinite(x)) refuse("vertex " + std::to_string(id) + " has a coordinate that is not a number");
  }

  // Renumbers the vertices. Removes triangles with two equal corners, and keeps only one of several equal triangles. Vertices
  // that belong to no triangle are removed.
  void renumber(const std::vector<std::int64_t> &number) {
    std::set<Corners> known;
    std::vector<Corners> kept;
    std::int64_t n_equal = 0;
    for (const Corners &old : corners()) {
      const Corners now{view(number)[old[0]], view(number)[old[1]], view(number)[old[2]]};
      Corners key = now;
      std::sort(key.begin(), key.end());
      if (key[0] == key[1] || key[1] == key[2]) continue;
      if (known.insert(key).second)
        kept.push_back(now);
      else
        ++n_equal;
    }
    if (n_equal > 0)
      remark(counted(n_equal, "triangle") + (n_equal == 1 ? " is" : " are") + " in the file twice, and counted once");
    corners() = std::move(kept);
    leave_out_points();
  }

  void leave_out_points() {
    std::vector<std::int64_t> number(points().size(), -1);
    std::vector<Vector3> kept;
    for (Corners &triangle : corners())
      for (std::int64_t &id : triangle) {
        std::int64_t &now = view(number)[id];
        if (now < 0) {
          now = static_cast<std::int64_t>(kept.size());
          kept.push_back(view(points())[id]);
        }
        id = now;
      }
    points() = std::move(kept);
    if (corners().empty()) refuse("the surface has no triangle with an area");
  }

  void join_equal_points() {
    const std::int64_t n = static_cast<std::int64_t>(points().size());
    std::vector<double> xyz;
    for (const Vector3 &point : points()) xyz.insert(xyz.end(), point.begin(), point.end());
    const std::vector<std::int64_t> place = equal_places(n, xyz.data());
    std::vector<std::int64_t> first(points().size(), -1), number(points().size());
    for (std::int64_t i = 0; i < n; ++i) {
      std::int64_t &of_place = view(first)[view(place)[i]];
      if (of_place < 0) of_place = i;
      view(number)[i] = of_place;
    }
    renumber(number);
  }

  // Joins vertices of open sides if only rounding separates them.
  void join_near_points() {
    std::vector<std::int64_t> open;
    for_each_edge(sorted_sides(corners()), [&](const TriangleSide *side, std::size_t n) {
      if (n == 1) open.insert(open.end(), {side->a, side->b});
    });
    std::sort(open.begin(), open.end());
    open.erase(std::unique(open.begin(), open.end()), open.end());
    std::sort(open.begin(), open.end(),
              [&](std::int64_t a, std::int64_t b) { return view(points())[a][0] < view(points())[b][0]; });
    const double near = joined_share * made_.triangles.size();
    DisjointSets joined(static_cast<std::int64_t>(points().size()));
    std::int64_t n_joined = 0;
    for (std::size_t i = 0; i < open.size(); ++i)
      for (std::size_t j = i + 1; j < open.size(); ++j) {
        const Vector3 off = view(points())[open[j]] - view(points())[open[i]];
        if (off[0] > near) break;
        if (norm(off) <= near) n_joined += joined.unite(open[i], open[j]);
      }
    if (n_joined == 0) return;
    std::vector<std::int64_t> number(points().size());
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = joined.root(static_cast<std::int64_t>(i));
    remark((n_joined == 1 ? std::string("a vertex is") : grouped(n_joined) + " vertices are") +
           " joined with a vertex less than " + shortest_of(near) + " away");
    renumber(number);
  }

  static std::string shortest_of(double x) { return printed("%.2g", x); }

  // Removes small islands. Refuses a surface with several larger pieces.
  void keep_one_piece() {
    const std::int64_t n = made_.triangles.n();
    DisjointSets sets(n);
    for_each_edge(sorted_sides(corners()), [&](const TriangleSide *side, std::size_t n_sides) {
      for (std::size_t i = 1; i < n_sides; ++i) sets.unite(side[0].triangle, side[i].triangle);
    });
    struct Piece {
      std::int64_t root = 0, n_triangles = 0;
      double area = 0;
      Box box = empty_box();
    };
    std::map<std::int64_t, Piece> by_root;
    for (std::int64_t i = 0; i < n; ++i) {
      Piece &piece = by_root[sets.root(i)];
      piece.root = sets.root(i);
      ++piece.n_triangles;
      piece.area += norm(made_.triangles.area_of(i));
      for (std::size_t k = 0; k < 3; ++k) piece.box.grow(made_.triangles.corner(i, k).data());
    }
    if (by_root.size() == 1) return;
    std::vector<Piece> pieces;
    for (const auto &[root, piece] : by_root) pieces.push_back(piece);
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece &a, const Piece &b) { return a.area > b.area; });
    const auto middle = [&](const Piece &piece) {
      Vector3 point;
      for (std::size_t k = 0; k < 3; ++k) point[k] = 0.5 * (piece.box.lower[k] + piece.box.upper[k]);
      return at(point);
    };
    const auto text_of = [&](const Piece &piece) { return grouped(piece.n_triangles) + " around " + middle(piece); };
    const Piece &largest = pieces[0], &second = pieces[1];
    if (second.area > island_share * largest.area) {
      const bool is_inside = largest.box.contains(second.box.lower) && largest.box.contains(second.box.upper);
      refuse(
          "the surface has " + std::to_string(pieces.size()) + " pieces, the two largest of " + text_of(largest) +
          " and " + text_of(second) + " triangles, but the blood has one outer surface: " +
          (is_inside
               ? "one lies within the other, like the two faces of a thick wall: export only the surface of the blood"
               : "keep one piece, for example by Islands in the Segment Editor of 3D Slicer"));
    }
    std::int64_t n_left_out = 0;
    for (std::size_t i = 1; i < pieces.size(); ++i) n_left_out += pieces[i].n_triangles;
    remark(counted(static_cast<std::int64_t>(pieces.size()) - 1, "island") + " of " + counted(n_left_out, "triangle") +
           (pieces.size() == 2 ? " is" : " are") + " left out, the largest of " + text_of(second));
    std::vector<Corners> kept;
    for (std::int64_t i = 0; i < n; ++i)
      if (sets.root(i) == largest.root) kept.push_back(view(corners())[i]);
    corners() = std::move(kept);
    leave_out_points();
  }

  // Refuses edges that belong to more than two triangles.
  void refuse_forks() const {
    std::int64_t n_forks = 0, n_most = 0;
    Vector3 place{};
    for_each_edge(sorted_sides(made_.triangles.corners), [&](const TriangleSide *side, std::size_t n) {
      if (n <= 2) return;
      if (++n_forks == 1) {
        n_most = static_cast<std::int64_t>(n);
        place = 0.5 * (view(made_.triangles.points)[side->a] + view(made_.triangles.points)[side->b]);
      }
    });
    if (n_forks == 0) return;
    refuse(counted(n_forks, "edge") + (n_forks == 1 ? " has" : " have") +
           " more than two triangles, such as the edge at " + at(place) + " with " + std::to_string(n_most) +
           ": the surface touches itself; repair it, for example by the filter Repair non Manifold Edges of MeshLab");
  }

  // Gives all triangles the orientation of the first triangle.
  void turn_alike() {
    const std::int64_t n = made_.triangles.n();
    struct Neighbour {
      std::int64_t triangle;
      bool is_turned;
    };
    std::vector<std::array<Neighbour, 3>> beyond(corners().size(), {{{-1, false}, {-1, false}, {-1, false}}});
    for_each_edge(sorted_sides(corners()), [&](const TriangleSide *side, std::size_t n_sides) {
      if (n_sides != 2) return;
      const bool is_turned = side[0].is_forward == side[1].is_forward;
      view(beyond)[side[0].triangle][side[0].k] = {side[1].triangle, is_turned};
      view(beyond)[side[1].triangle][side[1].k] = {side[0].triangle, is_turned};
    });
    std::vector<int> turned(corners().size(), -1);
    std::vector<std::int64_t> stack{0};
    view(turned)[0] = 0;
    while (!stack.empty()) {
      const std::int64_t here = stack.back();
      stack.pop_back();
      for (const Neighbour &next : view(beyond)[here]) {
        if (next.triangle < 0) continue;
        const int wanted = view(turned)[here] ^ static_cast<int>(next.is_turned);
        int &known = view(turned)[next.triangle];
        if (known < 0) {
          known = wanted;
          stack.push_back(next.triangle);
        } else if (known != wanted) {
          refuse("the surface has only one side, like a Moebius strip, for example at " +
                 at(made_.triangles.centre_of(here)) +
                 ": it does not enclose the blood; make a new surface from the segmentation");
        }
      }
    }
    is_turned_.assign(corners().size(), 0);
    for (std::int64_t i = 0; i < n; ++i) {
      view(is_turned_)[i] = static_cast<char>(view(turned)[i]);
      if (view(turned)[i] == 1) std::swap(view(corners())[i][1], view(corners())[i][2]);
    }
  }

  double height_of(const Corners &corner) const {
    const auto &all = made_.triangles.points;
    const Vector3 &a = view(all)[corner[0]], &b = view(all)[corner[1]], &c = view(all)[corner[2]];
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    return longest > 0 ? norm(cross(b - a, c - a)) / longest : 0;
  }

  // Repairs thin triangles. A repair joins the ends of a short side, or replaces the longest side by the other diagonal.
  void repair_thin() {
    least_height_ = thin_share * made_.triangles.size();
    std::int64_t n_repaired = 0;
    for (int round = 0; round < most_thin_rounds; ++round) {
      const std::int64_t n = repair_some_thin();
      n_repaired += n;
      if (n == 0) break;
    }
    if (n_repaired > 0)
      remark(counted(n_repaired, "triangle") + (n_repaired == 1 ? " has" : " have") + " hardly any height, and " +
             (n_repaired == 1 ? "is" : "are") + " repaired");
  }

  // In one round, repairs thin triangles that have no common vertex. Returns the number of repairs.
  std::int64_t repair_some_thin() {
    std::vector<std::int64_t> thin;
    for (std::int64_t i = 0; i < made_.triangles.n(); ++i)
      if (height_of(view(corners())[i]) < least_height_) thin.push_back(i);
    if (thin.empty()) return 0;
    around_.clear();
    for (const std::int64_t i : thin)
      for (const std::int64_t id : view(corners())[i]) around_[id] = {};
    std::vector<char> is_near(points().size(), 0);
    for (const auto &[id, triangles] : around_) view(is_near)[id] = 1;
    is_locked_.assign(points().size(), 0);
    for (std::int64_t i = 0; i < made_.triangles.n(); ++i)
      for (const std::int64_t id : view(corners())[i])
        if (view(is_near)[id] != 0) around_[id].push_back(i);
    std::int64_t n = 0;
    for (const std::int64_t i : thin) {
      const Corners corner = view(corners())[i];
      if (corner[0] < 0 || is_locked(corner)) continue;
      std::size_t shortest = 0, longest = 0;
      const auto length = [&](std::size_t k) {
        return norm(view(points())[corner[(k + 1) % 3]] - view(points())[corner[k]]);
      };
      for (std::size_t k = 1; k < 3; ++k) {
        if (length(k) < length(shortest)) shortest = k;
        if (length(k) > length(longest)) longest = k;
      }
      const bool is_short = length(shortest) < short_in_heights * least_height_;
      n += is_short && join_side(corner[shortest], corner[(shortest + 1) % 3]);
      if (!is_short) n += flip_side(i, longest);
    }
    std::vector<Corners> kept;
    std::vector<char> kept_turned;
    for (std::int64_t i = 0; i < made_.triangles.n(); ++i) {
      if (view(corners())[i][0] < 0) continue;
      kept.push_back(view(corners())[i]);
      kept_turned.push_back(view(is_turned_)[i]);
    }
    corners() = std::move(kept);
    is_turned_ = std::move(kept_turned);
    leave_out_points();
    return n;
  }

  bool is_locked(const Corners &corner) const {
    return std::any_of(corner.begin(), corner.end(), [&](std::int64_t id) { return view(is_locked_)[id] != 0; });
  }
  void lock(const Corners &corner) {
    for (const std::int64_t id : corner) view(is_locked_)[id] = 1;
  }

  // Returns the triangle that has a side from a to b, in this direction. Returns -1 if there is none. Vertex a or vertex b must
  // belong to a thin triangle.
  std::int64_t of_side(std::int64_t a, std::int64_t b) const {
    const auto found = around_.find(around_.count(a) > 0 ? a : b);
    for (const std::int64_t i : found->second)
      for (std::size_t k = 0; k < 3; ++k)
        if (view(made_.triangles.corners)[i][k] == a && view(made_.triangles.corners)[i][(k + 1) % 3] == b) return i;
    return -1;
  }

  // Moves the end b of a side to the side's other end a. Returns whether the surface allows the move.
  bool join_side(std::int64_t a, std::int64_t b) {
    const std::int64_t left = of_side(a, b), right = of_side(b, a);
    if (left < 0 || right < 0) return false;
    std::set<std::int64_t> beside_a, common;
    for (const std::int64_t i : around_[a])
      for (const std::int64_t id : view(corners())[i]) beside_a.insert(id);
    for (const std::int64_t i : around_[b]) {
      if (is_locked(view(corners())[i])) return false;
      for (const std::int64_t id : view(corners())[i])
        if (id != a && id != b && beside_a.count(id) > 0) common.insert(id);
    }
    constexpr std::size_t n_common = 2;  // with more, parts of the surface would touch
    if (common.size() != n_common) return false;
    for (const std::int64_t i : around_[b]) {
      lock(view(corners())[i]);
      for (std::int64_t &id : view(corners())[i])
        if (id == b) id = a;
    }
    for (const std::int64_t i : around_[a])
      if (i != left && i != right) lock(view(corners())[i]);
    view(corners())[left] = view(corners())[right] = {-1, -1, -1};
    return true;
  }

  // Replaces a side by the other diagonal of the quad that its two triangles form. Returns false if the new triangles would not
  // be higher.
  bool flip_side(std::int64_t i, std::size_t k) {
    const Corners corner = view(corners())[i];
    const std::int64_t a = corner[k], b = corner[(k + 1) % 3], c = corner[(k + 2) % 3];
    const std::int64_t beyond = of_side(b, a);
    if (beyond < 0) return false;
    const Corners other = view(corners())[beyond];
    if (is_locked(other)) return false;
    const std::int64_t d = other[0] != a && other[0] != b   ? other[0]
                           : other[1] != a && other[1] != b ? other[1]
                                                            : other[2];
    if (of_side(c, d) >= 0 || of_side(d, c) >= 0) return false;
    const Corners one{a, d, c}, two{d, b, c};
    if (std::min(height_of(one), height_of(two)) <= height_of(corner)) return false;
    view(corners())[i] = one;
    view(corners())[beyond] = two;
    lock(one);
    lock(two);
    return true;
  }

  // A closed line of sides with only one triangle. The triangles lie to the left of the line.
  using RimLoop = std::vector<std::int64_t>;

  std::vector<RimLoop> open_loops() const {
    std::multimap<std::int64_t, std::int64_t> next;
    for_each_edge(sorted_sides(made_.triangles.corners), [&](const TriangleSide *side, std::size_t n) {
      if (n != 1) return;
      next.emplace(side->is_forward ? side->a : side->b, side->is_forward ? side->b : side->a);
    });
    std::vector<RimLoop> loops;
    while (!next.empty()) {
      RimLoop loop;
      for (auto found = next.begin(); found != next.end(); found = next.find(loop.back())) {
        if (loop.empty()) loop.push_back(found->first);
        loop.push_back(found->second);
        next.erase(found);
        if (loop.back() == loop.front()) break;
      }
      loop.pop_back();
      loops.push_back(loop);
    }
    return loops;
  }

  // Closes holes whose rims are flat. Later steps decide whether the closed holes are ends. Refuses holes that are not flat.
  void close_holes() {
    std::vector<RimLoop> loops = open_loops();
    std::stable_sort(loops.begin(), loops.end(),
                     [](const RimLoop &a, const RimLoop &b) { return a.size() > b.size(); });
    for (const RimLoop &loop : loops) {
      Vector3 centre{}, area{};
      double length = 0, off = 0, width = 0;
      for_each_side(loop, [&](const Vector3 &p, const Vector3 &q) {
        centre = centre + 0.5 * norm(q - p) * (p + q);
        length += norm(q - p);
      });
      centre = 1 / length * centre;
      for_each_side(loop,
                    [&](const Vector3 &p, const Vector3 &q) { area = area + 0.5 * cross(q - centre, p - centre); });
      const Vector3 normal = unit_vector(area);
      bool is_star = true;
      for_each_side(loop, [&](const Vector3 &p, const Vector3 &q) {
        off = std::max(off, std::abs(dot(p - centre, normal)));
        width = std::max(width, 2 * norm(p - centre));
        is_star = is_star && dot(cross(q - centre, p - centre), normal) > 0;
      });
      const bool is_flat = off <= flat_hole_share * width;
      if (!is_flat || !is_star) refuse_hole(loops.size(), loop, centre, is_flat, off);
      ClosedHole hole{made_.triangles.n(), static_cast<std::int64_t>(loop.size()), centre};
      const std::int64_t middle = static_cast<std::int64_t>(points().size());
      points().push_back(centre);
      for (std::size_t i = 0; i < loop.size(); ++i) corners().push_back({loop[(i + 1) % loop.size()], loop[i], middle});
      made_.holes.push_back(hole);
    }
  }

  template <class Visit>
  void for_each_side(const RimLoop &loop, const Visit &visit) const {
    const auto &all = made_.triangles.points;
    for (std::size_t i = 0; i < loop.size(); ++i) visit(view(all)[loop[i]], view(all)[loop[(i + 1) % loop.size()]]);
  }

  [[noreturn]] void refuse_hole(std::size_t n_holes, const RimLoop &loop, const Vector3 &centre, bool is_flat,
                                double off) const {
    refuse("the surface has " +
           (n_holes == 1 ? std::string("a hole of ") : std::to_string(n_holes) + " holes, one of ") +
           counted(static_cast<std::int64_t>(loop.size()), "edge") + " at " + at(centre) +
           (is_flat ? ", whose rim is too wavy to be closed here: "
                    : ", whose rim is off its plane by " + shortest_of(off) + ": ") +
           how_to_close + "; cut an open end flat, for example by Plane Cut in the Dynamic Modeler of 3D Slicer");
  }

  // Refuses vertices at which two parts of the surface touch each other.
  void refuse_touching_points() const {
    const auto &all = made_.triangles.corners;
    DisjointSets fans(3 * made_.triangles.n());  // the corners of triangles
    const auto slot = [&](const TriangleSide &side, std::int64_t vertex) {
      const Corners &of = view(all)[side.triangle];
      return 3 * side.triangle + (of[0] == vertex ? 0 : of[1] == vertex ? 1 : 2);
    };
    for_each_edge(sorted_sides(all), [&](const TriangleSide *side, std::size_t n) {
      for (std::size_t i = 1; i < n; ++i) {
        fans.unite(slot(side[0], side->a), slot(side[i], side->a));
        fans.unite(slot(side[0], side->b), slot(side[i], side->b));
      }
    });
    std::vector<std::int64_t> fan(made_.triangles.points.size(), -1);
    std::set<std::int64_t> touching;
    for (std::int64_t i = 0; i < 3 * made_.triangles.n(); ++i) {
      const std::int64_t vertex = view(all)[i / 3][static_cast<std::size_t>(i % 3)], root = fans.root(i);
      if (view(fan)[vertex] < 0) view(fan)[vertex] = root;
      if (view(fan)[vertex] != root) touching.insert(vertex);
    }
    if (touching.empty()) return;
    refuse(
        "the surface touches itself at " +
        (touching.size() == 1 ? std::string("a vertex, ") : std::to_string(touching.size()) + " vertices, such as ") +
        at(view(made_.triangles.points)[*touching.begin()]) +
        ": smooth it a little, or repair it, for example by the filter Repair non Manifold Vertices of MeshLab");
  }

  // Turns the whole surface outwards, and reports the triangles of the file that had another orientation.
  void turn_outwards() {
    if (made_.triangles.volume() < 0) {
      for (Corners &triangle : corners()) std::swap(triangle[1], triangle[2]);
      for (char &turned : is_turned_) turned = !turned;
    }
    const std::int64_t n = std::count(is_turned_.begin(), is_turned_.end(), 1);
    const std::int64_t n_all = static_cast<std::int64_t>(is_turned_.size());
    if (n == n_all) remark("all triangles face inwards, and are turned outwards");
    if (n > 0 && n < n_all)
      remark(grouped(n) + " of " + counted(n_all, "triangle") + (n == 1 ? " faces" : " face") + " inwards, and " +
             (n == 1 ? "is" : "are") + " turned outwards");
  }

  const std::string &path_;
  ClosedSurface made_;
  double least_height_ = 0;
  std::map<std::int64_t, std::vector<std::int64_t>> around_;  // the triangles around each vertex of a thin triangle
  std::vector<char> is_locked_;                               // vertices beside a repair of this round
  std::vector<char> is_turned_;                               // of the file's triangles, without those of holes
};

}  // namespace

ClosedSurface read_closed_surface(const std::string &path) { return WallRepair(path).result(); }

std::string point_text(const Vector3 &point, double size) {
  const int n_digits = std::clamp(3 - decimal_exponent(std::max(size, 1e-300)), 0, 17);
  const std::string format = "%." + std::to_string(n_digits) + "f";
  const double step = power_of_ten(-n_digits);
  std::string text;
  for (const double x : point) {
    const double shown = std::abs(x) < 0.5 * step ? 0 : x;  // never -0.00
    text += (text.empty() ? "" : ",") + printed(format.c_str(), shown);
  }
  return text;
}

}  // namespace riis::program
