// SPDX-License-Identifier: Apache-2.0
#include "marking/fields.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "base/array_view.hpp"
#include "base/errors.hpp"
#include "geometry/point_triangle.hpp"
#include "kernels/kernels.hpp"
#include "parallel/parallel_for.hpp"

namespace riis {
namespace {

constexpr std::int32_t all_fields = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_SIDE |
                                    RIIS_FIELD_RIM | RIIS_FIELD_UV | RIIS_FIELD_VELOCITY | RIIS_FIELD_PATCH;

// Calls visit(pointer to the member of NodeFields, numbers per node) for every field in `fields`.
template <class Visit>
void for_each_array(std::int32_t fields, const Visit &visit) {
  const auto has = [&](std::int32_t field) { return (fields & field) != 0; };
  if (has(RIIS_FIELD_POINT)) visit(&NodeFields::point, std::int64_t{3});
  if (has(RIIS_FIELD_NORMAL)) visit(&NodeFields::normal, std::int64_t{3});
  if (has(RIIS_FIELD_BARYCENTRIC)) visit(&NodeFields::barycentric, std::int64_t{3});
  if (has(RIIS_FIELD_VELOCITY)) visit(&NodeFields::velocity, std::int64_t{3});
  if (has(RIIS_FIELD_UV)) visit(&NodeFields::uv, std::int64_t{2});
  if (has(RIIS_FIELD_SIDE)) visit(&NodeFields::side, std::int64_t{1});
  if (has(RIIS_FIELD_RIM)) visit(&NodeFields::rim, std::int64_t{1});
  if (has(RIIS_FIELD_PATCH)) visit(&NodeFields::patch_id, std::int64_t{1});
}

// Returns the position of a triangle in the set. It is the id, unless triangles of the caller's arrays were left out.
std::int64_t position_of(const TriangleSet &set, std::int64_t triangle_id) {
  const auto ids = view(set.triangle_id);
  if (triangle_id < ids.size() && ids[triangle_id] == triangle_id) return triangle_id;
  return std::lower_bound(ids.begin(), ids.end(), triangle_id) - ids.begin();
}

// Fields of nodes whose closest point lies on a triangle.
class TriangleFields {
 public:
  TriangleFields(const SearchRequest &request, std::int32_t fields, const NodeList &list, NodeFields &made)
      : surface_(request.surface),
        set_(surface_.triangles()),
        nodes_(request.mesh.nodes()),
        locate_(kernels(request.instructions).locate),
        fields_(fields),
        has_normals_(need_normals(surface_, fields, list.size())),
        list_(list),
        made_(made) {}

  void write(const Range &range) const {
    // Nodes of a list are far apart in memory: their coordinates are fetched while earlier nodes are computed.
    constexpr std::int64_t ahead = 4 * pairs_at_once;
    for (std::int64_t first = range.begin; first < range.end; first += pairs_at_once) {
      for (std::int64_t i = first + ahead; i < std::min(first + ahead + pairs_at_once, range.end); ++i)
        nodes_.prefetch(view(list_.node_id)[i]);
      write_at_once(first, std::min(first + pairs_at_once, range.end));
    }
  }

 private:
  // Writes the fields of at most pairs_at_once nodes.
  void write_at_once(std::int64_t first, std::int64_t end) const {
    PointsAndTriangles pairs;
    std::int64_t triangle[pairs_at_once];
    for (std::int64_t lane = 0; lane < pairs_at_once; ++lane) {
      const std::int64_t i = std::min(first + lane, end - 1);
      triangle[lane] = position_of(set_, view(list_.triangle_id)[i]);
      set_lane(pairs.point, lane, nodes_[view(list_.node_id)[i]]);
      const std::array<Vec3, 3> corners = set_.corners(triangle[lane]);
      for (std::size_t k = 0; k < 3; ++k) set_lane(pairs.corners + 3 * k, lane, corners[k]);
    }
    PointsOnTriangles located;
    locate_(pairs, located);
    for (std::int64_t i = first; i < end; ++i) {
      const std::int64_t lane = i - first;
      const Vec3 weights = lane_of(located.barycentric, lane);
      write(i, triangle[lane], lane_of(pairs.point, lane),
            {located.distance_sq[lane], lane_of(located.point, lane), {weights.x, weights.y, weights.z}});
    }
  }

  static void set_lane(double (*to)[pairs_at_once], std::int64_t lane, Vec3 v) {
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
  }
  static Vec3 lane_of(const double (*from)[pairs_at_once], std::int64_t lane) {
    return {from[0][lane], from[1][lane], from[2][lane]};
  }

  void write(std::int64_t i, std::int64_t triangle, Vec3 p, const PointOnTriangle &on) const {
    if (has(RIIS_FIELD_POINT)) put_vector(made_.point.data(), i, on.point);
    if (has(RIIS_FIELD_NORMAL)) put_vector(made_.normal.data(), i, normal(triangle));
    if (has(RIIS_FIELD_BARYCENTRIC))
      put_vector(made_.barycentric.data(), i, {on.barycentric[0], on.barycentric[1], on.barycentric[2]});
    if (has(RIIS_FIELD_SIDE)) view(made_.side)[i] = surface_.side(p, triangle, on);
    if (has(RIIS_FIELD_RIM)) view(made_.rim)[i] = surface_.is_on_rim(triangle, on) ? 1 : 0;
    if (has(RIIS_FIELD_PATCH)) view(made_.patch_id)[i] = view(set_.patch_id)[triangle];
    if (has(RIIS_FIELD_VELOCITY)) interpolate<3>(set_.velocity, triangle, on, made_.velocity.data() + 3 * i);
    if (has(RIIS_FIELD_UV)) interpolate<2>(set_.uv, triangle, on, made_.uv.data() + 2 * i);
  }

  bool has(std::int32_t field) const { return (fields_ & field) != 0; }

  Vec3 normal(std::int64_t triangle) const {
    return has_normals_ ? surface_.normal(triangle) : triangle_normal(set_.corners(triangle));
  }

  // Interpolates a field that has n components per vertex.
  template <int n>
  void interpolate(const std::vector<double> &field, std::int64_t triangle, const PointOnTriangle &on,
                   double *to) const {
    const std::int64_t *id = set_.vertex_id.data() + 3 * triangle;
    const double *a = field.data() + n * id[0], *b = field.data() + n * id[1], *c = field.data() + n * id[2];
    for (int k = 0; k < n; ++k)
      to[k] = on.barycentric[0] * a[k] + on.barycentric[1] * b[k] + on.barycentric[2] * c[k];
  }

  const Surface &surface_;
  const TriangleSet &set_;
  const StridedPoints &nodes_;
  void (*locate_)(const PointsAndTriangles &, PointsOnTriangles &);
  std::int32_t fields_;
  bool has_normals_;  // true if the surface has made them
  const NodeList &list_;
  NodeFields &made_;
};

// Writes the fields of a node whose distance is by sampling or minimisation. It finds the point once more.
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

void NodeFields::reserve(std::int32_t fields, std::int64_t n) {
  for_each_array(fields, [&](auto member, std::int64_t per_node) { reserve_amply(this->*member, per_node * n); });
}

void NodeFields::resize(std::int32_t fields, std::int64_t n) {
  for_each_array(all_fields & ~fields, [&](auto member, std::int64_t) { (this->*member).clear(); });
  // Old entries need not be cleared, because every entry is written.
  for_each_array(fields, [&](auto member, std::int64_t per_node) { riis::resize(this->*member, per_node * n); });
}

void check_fields(const Surface &surface, std::int32_t fields) {
  if (fields < 0 || (fields & ~all_fields) != 0)
    fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields, "; it must be a sum of RIIS_FIELD_*, at most ",
         all_fields);
  if (const PatchDistance *other = surface.other_distance()) {
    constexpr std::int32_t of_patches = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_PATCH;
    if (fields & ~of_patches)
      fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields, ", but the surface's distances are by ", other->name(),
           ", which has no fields but RIIS_FIELD_POINT, RIIS_FIELD_NORMAL and RIIS_FIELD_PATCH");
  }
  if ((fields & RIIS_FIELD_VELOCITY) && surface.triangles().velocity.empty())
    fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields,
         ", with RIIS_FIELD_VELOCITY, but the surface has no velocity: "
         "update it with riis_surface_update_moving, or give the velocity of its vertices in arrays");
  if ((fields & RIIS_FIELD_UV) && surface.triangles().uv.empty())
    fail(RIIS_INVALID_ARGUMENT, "options.fields is ", fields,
         ", with RIIS_FIELD_UV, but the surface is from arrays, which have no patches");
}

bool need_normals(const Surface &surface, std::int32_t fields, std::int64_t n_nodes) {
  if (surface.other_distance()) return false;
  if (fields & (RIIS_FIELD_SIDE | RIIS_FIELD_RIM)) return true;
  // A normal for each triangle is cheaper than one for each node if there are fewer triangles.
  return (fields & RIIS_FIELD_NORMAL) && n_nodes > surface.triangles().n_triangles();
}

void make_fields(const SearchRequest &request, std::int32_t fields, const NodeList &list, NodeFields &made) {
  made.resize(fields, list.size());
  if (fields == 0) return;
  const TriangleFields of_triangles(request, fields, list, made);
  const bool has_triangles = !request.surface.other_distance();
  constexpr std::int64_t nodes_per_block = 512;
  parallel_for_ranges(list.size(), nodes_per_block, request.n_threads, [&](const Range &range, int) {
    if (has_triangles) {
      of_triangles.write(range);
    } else {
      for (std::int64_t i = range.begin; i < range.end; ++i)
        write_patch_fields(request, fields, view(list.node_id)[i], i, made);
    }
  });
}

void select_fields(std::int32_t fields, const NodeList &all, const NodeFields &fields_of_all, const NodeList &some,
                   NodeFields &made) {
  made.resize(fields, some.size());
  std::int64_t from = 0;
  for (std::int64_t to = 0; to < some.size(); ++to, ++from) {
    while (view(all.node_id)[from] != view(some.node_id)[to]) ++from;
    for_each_array(fields, [&](auto member, std::int64_t per_node) {
      const auto *source = (fields_of_all.*member).data() + per_node * from;
      std::copy_n(source, per_node, (made.*member).data() + per_node * to);
    });
  }
}

}  // namespace riis
