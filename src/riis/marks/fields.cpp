// SPDX-License-Identifier: Apache-2.0
#include "marks/marks.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "geometry/point_triangle.hpp"
#include "kernels/kernels.hpp"
#include "parallel/parallel_for.hpp"
#include "search/eight_points.hpp"

namespace riis {
namespace {

constexpr std::int32_t all_fields = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_SIDE |
                                    RIIS_FIELD_RIM | RIIS_FIELD_UV | RIIS_FIELD_VELOCITY | RIIS_FIELD_PATCH |
                                    RIIS_FIELD_GRADIENT;

// Calls visit(pointer to a member of NodeFields, numbers per node) for every field in `fields`.
template <class Visit>
void for_each_array(const FieldSet &fields, const Visit &visit) {
  const auto has = [&](std::int32_t field) { return (fields.bits & field) != 0; };
  if (has(RIIS_FIELD_POINT)) visit(&NodeFields::point, std::int64_t{3});
  if (has(RIIS_FIELD_NORMAL)) visit(&NodeFields::normal, std::int64_t{3});
  if (has(RIIS_FIELD_BARYCENTRIC)) visit(&NodeFields::barycentric, std::int64_t{3});
  if (has(RIIS_FIELD_VELOCITY)) visit(&NodeFields::velocity, std::int64_t{3});
  if (has(RIIS_FIELD_UV)) visit(&NodeFields::uv, std::int64_t{2});
  if (has(RIIS_FIELD_SIDE)) visit(&NodeFields::side, std::int64_t{1});
  if (has(RIIS_FIELD_RIM)) visit(&NodeFields::rim, std::int64_t{1});
  if (has(RIIS_FIELD_PATCH)) visit(&NodeFields::patch_id, std::int64_t{1});
  if (has(RIIS_FIELD_GRADIENT)) visit(&NodeFields::distance_gradient, fields.n_directions);
  if (has(field_height)) visit(&NodeFields::height, std::int64_t{1});
  if (has(field_height) && has(RIIS_FIELD_GRADIENT)) visit(&NodeFields::height_gradient, fields.n_directions);
}

// If several leaflets are equally near to a node, the node's velocity is the mean over these leaflets. The velocity of one
// leaflet is the mean over its closest points, which are called ties. The constructor takes the velocity at the closest triangle.
// The caller then adds the other ties, leaflet by leaflet.
class MeanOfLeaflets {
 public:
  MeanOfLeaflets(std::int32_t closest_leaflet, Vec3 velocity) : closest_leaflet_(closest_leaflet) {
    of_closest_.add(velocity);
  }
  void add(std::int32_t leaflet, Vec3 velocity) {
    if (leaflet == closest_leaflet_) {
      of_closest_.add(velocity);
      return;
    }
    if (leaflet != leaflet_) end_leaflet();
    leaflet_ = leaflet;
    of_leaflet_.add(velocity);
  }
  Vec3 mean() {
    end_leaflet();
    of_leaflets_.add(of_closest_.mean());
    return of_leaflets_.mean();
  }

 private:
  struct Sum {
    Vec3 sum{0, 0, 0};
    double n = 0;

    void add(Vec3 v) {
      sum = sum + v;
      ++n;
    }
    Vec3 mean() const { return {sum.x / n, sum.y / n, sum.z / n}; }
  };

  void end_leaflet() {
    if (of_leaflet_.n > 0) of_leaflets_.add(of_leaflet_.mean());
    of_leaflet_ = {};
  }

  Sum of_closest_, of_leaflet_, of_leaflets_;
  std::int32_t closest_leaflet_, leaflet_ = -1;
};

// Writes the fields of nodes whose closest points lie on triangles.
class TriangleFields {
 public:
  TriangleFields(const SearchRequest &request, std::int32_t fields, const NodeList &list, const FieldScratch &scratch,
                 NodeFields &made)
      : set_(request.surface.triangles()),
        positions_(set_),
        corners_(request.surface.scene().groups().corners.data()),
        nodes_(request.mesh.nodes()),
        simd_(kernels(request.instructions)),
        fields_(fields),
        normals_(need_normals(request.surface, fields, list.size()) ? &request.surface.pseudonormals() : nullptr),
        at_vertices_(scratch.at_vertices.data()),
        ties_(view(scratch.ties)),
        normal_rates_(view(scratch.normal_rates)),
        least_way_(1e-9 * request.surface.half_thickness()),
        list_(list),
        made_(made) {
    for (std::int64_t i = 0; has(RIIS_FIELD_GRADIENT) && i < request.surface.n_directions(); ++i)
      rates_.push_back(request.surface.rates(i).data());
  }

  void write(const Range &range) const {
    // The nodes of a list lie far apart in memory. The coordinates of later nodes are therefore fetched while earlier nodes are
    // computed.
    constexpr std::int64_t ahead = 4 * pairs_at_once;
    for (std::int64_t first = range.begin; first < range.end; first += pairs_at_once) {
      for (std::int64_t i = first + ahead; i < std::min(first + ahead + pairs_at_once, range.end); ++i)
        nodes_.prefetch(view(list_.node_id)[i]);
      write_at_once(first, std::min(first + pairs_at_once, range.end));
    }
  }

  // Replaces the velocity of each node with ties by the mean over all leaflets that are equally near. A leaflet's velocity is the
  // mean over its ties. `range` is a range of ties. The function handles the nodes whose first tie lies in this range.
  void take_means(const Range &range) const {
    const std::int64_t begin = next_node(range.begin), end = next_node(range.end);
    MeanOfLeaflets mean(-1, {0, 0, 0});
    std::int64_t i = 0;
    for (std::int64_t first = begin; first < end; first += pairs_at_once) {
      const std::int64_t n = std::min<std::int64_t>(pairs_at_once, end - first);
      VertexNumbers mixed[pairs_at_once];
      mix_at_ties(first, n, mixed);
      for (std::int64_t tie = first; tie < first + n; ++tie) {
        if (next_node(tie) == tie) {
          i = std::lower_bound(list_.node_id.begin() + i, list_.node_id.end(), ties_[tie].point) -
              list_.node_id.begin();
          mean = {view(list_.leaflet_id)[i], vector_at(made_.velocity.data() + 3 * i)};
        }
        mean.add(view(set_.leaflet_id)[ties_[tie].triangle.triangle], vector_at(mixed[tie - first].number));
        if (next_node(tie + 1) == tie + 1) put_vector(made_.velocity.data(), i, mean.mean());
      }
    }
  }

 private:
  bool has(std::int32_t field) const { return (fields_ & field) != 0; }

  // Writes the fields of at most pairs_at_once nodes. Each field has its own short loop.
  void write_at_once(std::int64_t first, std::int64_t end) const {
    const std::int64_t n = end - first;
    EightPoints eight;
    const std::int64_t *const node = list_.node_id.data() + first, *const id = list_.triangle_id.data() + first;
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
      const std::int64_t i = std::min(lane, n - 1);
      eight.set(lane, nodes_[node[i]], positions_.of(id[i]), corners_);
    }
    simd_.locate(eight.pairs, eight.on);
    const PointsOnTriangles &on = eight.on;
    const std::int64_t *const triangle = eight.triangle;
    if (has(RIIS_FIELD_POINT)) put_vectors(on.point, n, made_.point.data() + 3 * first);
    if (has(RIIS_FIELD_BARYCENTRIC)) put_vectors(on.barycentric, n, made_.barycentric.data() + 3 * first);
    if (has(RIIS_FIELD_VELOCITY | RIIS_FIELD_UV)) write_mixed(triangle, on, first, n);
    if (has(RIIS_FIELD_PATCH))
      for (std::int64_t lane = 0; lane < n; ++lane)
        view(made_.patch_id)[first + lane] = view(set_.patch_id)[triangle[lane]];
    if (has(RIIS_FIELD_GRADIENT)) write_gradients(eight, first, n);
    if (has(RIIS_FIELD_NORMAL))
      for (std::int64_t lane = 0; lane < n; ++lane)
        put_vector(made_.normal.data(), first + lane, normal(triangle[lane]));
    if (has(field_height)) write_heights(eight, first, n);
    if (has(RIIS_FIELD_SIDE | RIIS_FIELD_RIM)) {
      std::int32_t side[pairs_at_once], is_on_rim[pairs_at_once];
      eight.find_sides(*normals_, simd_, has(RIIS_FIELD_SIDE) ? side : nullptr,
                       has(RIIS_FIELD_RIM) ? is_on_rim : nullptr);
      if (has(RIIS_FIELD_RIM)) std::copy_n(is_on_rim, n, made_.rim.data() + first);
      if (has(RIIS_FIELD_SIDE)) std::copy_n(side, n, made_.side.data() + first);
    }
  }

  // Writes the derivatives of the distances in each direction: -n.V. n is the unit vector from the closest point to the node, and
  // V is the rate of the closest point.
  void write_gradients(const EightPoints &eight, std::int64_t first, std::int64_t n) const {
    const std::int64_t *vertex[pairs_at_once];
    for (std::int64_t lane = 0; lane < n; ++lane) vertex[lane] = set_.vertex_id.data() + 3 * eight.triangle[lane];
    alignas(64) double distance[pairs_at_once] = {};
    std::copy_n(list_.distance.data() + first, n, distance);
    simd_.differentiate(eight.pairs, eight.on, distance, vertex, rates_.data(), n_directions(),
                        static_cast<std::int32_t>(n), made_.distance_gradient.data() + n_directions() * first);
  }

  void write_heights(const EightPoints &eight, std::int64_t first, std::int64_t n) const {
    alignas(64) double distance[pairs_at_once] = {}, height[pairs_at_once];
    std::int32_t is_on_rim[pairs_at_once];
    std::copy_n(list_.distance.data() + first, n, distance);
    eight.find_heights(*normals_, simd_, distance, height, is_on_rim);
    std::copy_n(height, n, made_.height.data() + first);
    for (std::int64_t lane = 0; has(RIIS_FIELD_GRADIENT) && lane < n; ++lane)
      for (std::int64_t k = 0; k < n_directions(); ++k) {
        const std::int64_t at = n_directions() * (first + lane) + k;
        // At an edge or a vertex, the normal is the direction from the closest point to the node. If node and closest point are
        // so close that rounding determines this direction, the normal of the surface is used instead.
        const bool has_way = (eight.on.at_border >> lane & 1) != 0 && !is_on_rim[lane] && distance[lane] > least_way_;
        view(made_.height_gradient)[at] = has_way ? (height[lane] > 0 ? 1 : -1) * view(made_.distance_gradient)[at]
                                                  : height_rate(eight, lane, k, is_on_rim[lane] != 0);
      }
  }

  // Returns the rate of a height n.(x - p), which is n'.(x - p) - n.V. V is the rate of the closest point p, and n' is the rate
  // of the unit normal n there. Away from the rim the term with n' is 0, because n' is at right angles to x - p.
  double height_rate(const EightPoints &eight, std::int64_t lane, std::int64_t direction, bool is_on_rim) const {
    const std::int64_t triangle = eight.triangle[lane], *const id = set_.vertex_id.data() + 3 * triangle;
    const Vec3 weights = EightPoints::lane_of(eight.on.barycentric, lane);
    const double *const rates = view(rates_)[direction];
    const auto rate_of = [&](int k) { return vector_at(rates + 3 * id[k]); };
    const Vec3 rate = weights.x * rate_of(0) + weights.y * rate_of(1) + weights.z * rate_of(2);
    const Vec3 sum = normals_->at(triangle, {weights.x, weights.y, weights.z}).normal;
    const double of_point = -dot((1 / length(sum)) * sum, rate);
    if (!is_on_rim) return of_point;
    const Vec3 turn = normals_->rate_at_rim(normal_rates_[direction], set_, rates, triangle, weights);
    return of_point +
           dot(turn, EightPoints::lane_of(eight.pairs.point, lane) - EightPoints::lane_of(eight.on.point, lane));
  }

  std::int64_t n_directions() const { return view(rates_).size(); }

  // Writes the velocities and (u,v). Both fields are interpolated from the vertices by the barycentric weights.
  void write_mixed(const std::int64_t *triangle, const PointsOnTriangles &on, std::int64_t first,
                   std::int64_t n) const {
    const std::int64_t *vertex[pairs_at_once];
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) vertex[lane] = set_.vertex_id.data() + 3 * triangle[lane];
    VertexNumbers mixed[pairs_at_once];
    simd_.mix_at_vertices(at_vertices_, vertex, on, mixed);
    if (has(RIIS_FIELD_VELOCITY)) {
      double *to = made_.velocity.data() + 3 * first;
      for (std::int64_t lane = 0; lane < n; ++lane) std::copy_n(mixed[lane].number, 3, to + 3 * lane);
    }
    if (has(RIIS_FIELD_UV)) {
      double *to = made_.uv.data() + 2 * first;
      for (std::int64_t lane = 0; lane < n; ++lane) std::copy_n(mixed[lane].number + uv_in_numbers, 2, to + 2 * lane);
    }
  }

  // Returns the first position from `tie` on at which the ties of a node begin. If no further node has ties, returns the number
  // of all ties.
  std::int64_t next_node(std::int64_t tie) const {
    while (tie > 0 && tie < ties_.size() && ties_[tie].point == ties_[tie - 1].point) ++tie;
    return tie;
  }

  void mix_at_ties(std::int64_t first, std::int64_t n, VertexNumbers *mixed) const {
    EightPoints eight;
    const std::int64_t *vertex[pairs_at_once];
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
      const Tie &tie = ties_[first + std::min(lane, n - 1)];
      eight.set(lane, nodes_[tie.point], tie.triangle.triangle, corners_);
      vertex[lane] = set_.vertex_id.data() + 3 * tie.triangle.triangle;
    }
    simd_.locate(eight.pairs, eight.on);
    simd_.mix_at_vertices(at_vertices_, vertex, eight.on, mixed);
  }

  static Vec3 vector_at(const double *v) { return {v[0], v[1], v[2]}; }
  static void put_vectors(const EightPoints::Lanes &from, std::int64_t n, double *to) {
    for (std::int64_t lane = 0; lane < n; ++lane) EightPoints::put_lane(from, lane, to + 3 * lane);
  }

  Vec3 normal(std::int64_t triangle) const {
    return normals_ ? normals_->of_face(triangle) : triangle_normal(set_.corners(triangle));
  }

  const TriangleSet &set_;
  TrianglePositions positions_;
  const double *corners_;  // corners of the triangles, nine numbers for each
  const MeshNodes &nodes_;
  const Kernels &simd_;
  std::int32_t fields_;
  const Pseudonormals *normals_;  // null if no field needs them
  const VertexNumbers *at_vertices_;
  ArrayView<const Tie> ties_;
  ArrayView<const Pseudonormals::Rates> normal_rates_;
  double least_way_;  // a shorter way from the closest point has no certain direction
  const NodeList &list_;
  NodeFields &made_;
  Vector<const double *> rates_;  // the rates of the vertices, for each direction
};

// Orders ties by node, then by leaflet, then by distance.
struct TieOrder {
  const std::int32_t *leaflet_id;

  bool operator()(const Tie &a, const Tie &b) const {
    if (a.point != b.point) return a.point < b.point;
    const std::int32_t of_a = leaflet_id[a.triangle.triangle], of_b = leaflet_id[b.triangle.triangle];
    return of_a != of_b ? of_a < of_b : is_closer(a.triangle.distance_sq, a.triangle.triangle, b.triangle);
  }
};

// Copies the numbers that the fields need, so that all numbers of a vertex lie side by side. Computing the fields of a node then
// reads few places in memory.
void gather_at_vertices(const TriangleSet &set, std::int32_t fields, int n_threads, FieldScratch &scratch) {
  const bool has_velocity = fields & RIIS_FIELD_VELOCITY, has_uv = fields & RIIS_FIELD_UV;
  if (!has_velocity && !has_uv) return;
  resize(scratch.at_vertices, set.n_vertices());
  constexpr std::int64_t vertices_per_block = 4096;
  parallel_for_ranges(set.n_vertices(), vertices_per_block, n_threads, [&](const Range &range, int) {
    for (std::int64_t i = range.begin; i < range.end; ++i) {
      VertexNumbers &at = view(scratch.at_vertices)[i] = {};
      if (has_velocity) std::copy_n(set.velocity.data() + 3 * i, 3, at.number);
      if (has_uv) std::copy_n(set.uv.data() + 2 * i, 2, at.number + uv_in_numbers);
    }
  });
}

// Writes the fields of a node whose distance was measured by sampling or minimisation. To do so, computes the closest point
// again.
void write_patch_fields(const SearchRequest &request, std::int32_t fields, std::int64_t node, std::int64_t i,
                        NodeFields &made) {
  const PatchDistance &method = *request.surface.other_distance();
  const ClosestOnPatches found = method.closest(request.mesh.nodes()[node], request.distance_limit);
  const PlacedPatch &patch = view(method.patches().patches)[found.patch];
  if (fields & RIIS_FIELD_POINT) put_vector(made.point.data(), i, found.point);
  if (fields & RIIS_FIELD_NORMAL) put_vector(made.normal.data(), i, patch.normal_at(found.u, found.v));
  if (fields & RIIS_FIELD_PATCH) view(made.patch_id)[i] = patch.patch_id;
}

}  // namespace

void NodeFields::reserve(const FieldSet &fields, std::int64_t n) {
  for_each_array(fields, [&](auto member, std::int64_t per_node) { reserve_amply(this->*member, per_node * n); });
}

bool NodeFields::has_room(const FieldSet &fields, std::int64_t n) const {
  bool all = true;
  for_each_array(fields,
                 [&](auto member, std::int64_t per_node) { all = all && riis::has_room(this->*member, per_node * n); });
  return all;
}

void NodeFields::resize(const FieldSet &fields, std::int64_t n) {
  for_each_array({(all_fields | field_height) & ~fields.bits, 0},
                 [&](auto member, std::int64_t) { (this->*member).clear(); });
  // Resizes the arrays without clearing old entries, because every entry will be written.
  for_each_array(fields, [&](auto member, std::int64_t per_node) { riis::resize(this->*member, per_node * n); });
}

void FieldScratch::prepare(const SearchRequest &request, std::int32_t fields, const FoundNodes &found) {
  if (fields & (RIIS_FIELD_VELOCITY | RIIS_FIELD_UV))
    reserve_amply(at_vertices, request.surface.triangles().n_vertices());
  normal_rates.clear();
  if ((fields & field_height) && (fields & RIIS_FIELD_GRADIENT))
    for (std::int64_t i = 0; i < request.surface.n_directions(); ++i)
      normal_rates.push_back(
          request.surface.pseudonormals().rates_of(request.surface.triangles(), request.surface.rates(i).data()));
  std::int64_t n = 0;
  for (const Ties &of_thread : found.ties_by_thread) n += view(of_thread.found).size();
  ties.clear();
  reserve_amply(ties, n);
  for (const Ties &of_thread : found.ties_by_thread)
    ties.insert(ties.end(), of_thread.found.begin(), of_thread.found.end());
  const TieRule &rule = request.ties;
  std::sort(ties.begin(), ties.end(), TieOrder{rule.leaflet_id});
  const auto is_one_leaflet = [&](const Tie &a, const Tie &b) {
    return rule.leaflet_id[a.triangle.triangle] == rule.leaflet_id[b.triangle.triangle];
  };
  // Keeps the closest triangle of each leaflet. If a triangle on another patch of the leaflet is equally near, this triangle is
  // kept also. At most one triangle is kept on each patch.
  auto closest = ties.begin(), end = ties.begin();
  for (const Tie &tie : ties) {
    const bool is_first = end == ties.begin() || tie.point != closest->point || !is_one_leaflet(*closest, tie);
    const auto is_there = [&](const Tie &kept) { return rule.are_of_one_patch(kept.triangle, tie.triangle); };
    if (is_first) closest = end;
    if (is_first || (rule.is_tie(closest->triangle, tie.triangle) && std::none_of(closest, end, is_there)))
      *end++ = tie;
  }
  ties.erase(end, ties.end());
}

void check_fields(const Surface &surface, std::int32_t fields) {
  if (fields < 0 || (fields & ~all_fields) != 0)
    fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields, "; it must be a sum of RIIS_FIELD_*, at most ",
         all_fields);
  if (const PatchDistance *other = surface.other_distance()) {
    constexpr std::int32_t of_patches = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_PATCH;
    if (fields & ~of_patches)
      fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields, ", but the surface's distances are by ", other->name(),
           ", which has only the fields RIIS_FIELD_POINT, RIIS_FIELD_NORMAL and RIIS_FIELD_PATCH");
  }
  if ((fields & RIIS_FIELD_VELOCITY) && surface.triangles().velocity.empty())
    fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields,
         ", with RIIS_FIELD_VELOCITY, but the surface has no velocity: "
         "update it with riis_surface_update_moving, or give the velocity of its vertices in arrays");
  if ((fields & RIIS_FIELD_GRADIENT) && surface.n_directions() == 0)
    fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields,
         ", with RIIS_FIELD_GRADIENT, but the surface has no direction: call riis_surface_add_direction after its "
         "last update");
  if ((fields & RIIS_FIELD_UV) && surface.triangles().uv.empty())
    fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields,
         ", with RIIS_FIELD_UV, but the surface is from arrays, which have no patches");
}

bool need_normals(const Surface &surface, std::int32_t fields, std::int64_t n_nodes) {
  if (surface.other_distance()) return false;
  if (fields & (RIIS_FIELD_SIDE | RIIS_FIELD_RIM | field_height)) return true;
  // If there are fewer triangles than nodes, the normals of all triangles cost less than a normal for each node.
  return (fields & RIIS_FIELD_NORMAL) && n_nodes > surface.triangles().n_triangles();
}

TieRule ties_for(const Surface &surface, std::int32_t fields) {
  constexpr double of_leaflets = 1e-6, of_patches = 1e-9;  // in half thicknesses
  const TriangleSet &set = surface.triangles();
  const auto are_several = [](const std::vector<std::int32_t> &ids) {
    return std::any_of(ids.begin(), ids.end(), [&](std::int32_t id) { return id != ids.front(); });
  };
  if (!(fields & RIIS_FIELD_VELOCITY) || !(are_several(set.leaflet_id) || are_several(set.patch_id))) return {};
  const double half_thickness = surface.half_thickness();
  return {set.leaflet_id.data(), set.patch_id.data(), of_leaflets * half_thickness, of_patches * half_thickness};
}

void make_fields(const SearchRequest &request, std::int32_t fields, const NodeList &list, FieldScratch &scratch,
                 NodeFields &made) {
  made.resize({fields, request.surface.n_directions()}, list.size());
  if (fields == 0 || list.size() == 0) return;
  constexpr std::int64_t few_vertices = 16384;
  gather_at_vertices(request.surface.triangles(), fields,
                     request.n_threads.for_part(request.surface.triangles().n_vertices(), few_vertices), scratch);
  const TriangleFields of_triangles(request, fields, list, scratch, made);
  const bool has_triangles = !request.surface.other_distance();
  constexpr std::int64_t n_per_block = 512, few = 4096;
  const int n_threads = request.n_threads.for_part(list.size(), has_triangles ? few : 0);
  parallel_for_ranges(list.size(), n_per_block, n_threads, [&](const Range &range, int) {
    if (has_triangles) {
      of_triangles.write(range);
    } else {
      for (std::int64_t i = range.begin; i < range.end; ++i)
        write_patch_fields(request, fields, view(list.node_id)[i], i, made);
    }
  });
  constexpr std::int64_t ties_per_block = 512;
  parallel_for_ranges(view(scratch.ties).size(), ties_per_block, request.n_threads,
                      [&](const Range &range, int) { of_triangles.take_means(range); });
}

namespace {

// Copies a range to the position `at`, unless the range is already there.
template <class Array>
void copy_range(const Array &from, const Range &range, Array &to, std::int64_t at) {
  if (from.data() + range.begin != to.data() + at)
    std::copy(from.data() + range.begin, from.data() + range.end, to.data() + at);
}

}  // namespace

void copy_nodes(const NodeList &from, const Range &range, NodeList &to, std::int64_t at) {
  copy_range(from.node_id, range, to.node_id, at);
  copy_range(from.distance, range, to.distance, at);
  copy_range(from.triangle_id, range, to.triangle_id, at);
  copy_range(from.leaflet_id, range, to.leaflet_id, at);
}

void copy_fields(const FieldSet &fields, const NodeFields &from, const Range &range, NodeFields &to, std::int64_t at) {
  for_each_array(fields, [&](auto member, std::int64_t per_node) {
    copy_range(from.*member, {per_node * range.begin, per_node * range.end}, to.*member, per_node * at);
  });
}

void select_fields(const FieldSet &fields, const NodeList &all, const NodeFields &fields_of_all, const NodeList &some,
                   NodeFields &made) {
  made.resize(fields, some.size());
  std::int64_t from = 0;
  for (std::int64_t to = 0; to < some.size(); ++to, ++from) {
    while (view(all.node_id)[from] != view(some.node_id)[to]) ++from;
    copy_fields(fields, fields_of_all, {from, from + 1}, made, to);
  }
}

}  // namespace riis
