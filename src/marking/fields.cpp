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
      : set_(request.surface.triangles()),
        nodes_(request.mesh.nodes()),
        locate_(kernels(request.instructions).locate),
        fields_(fields),
        normals_(need_normals(request.surface, fields, list.size()) ? &request.surface.pseudonormals() : nullptr),
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
    PointsOnTriangles on;
    locate_(pairs, on);
    const std::int64_t n = end - first;
    const auto has = [&](std::int32_t field) { return (fields_ & field) != 0; };
    if (has(RIIS_FIELD_POINT)) put_vectors(on.point, n, made_.point.data() + 3 * first);
    if (has(RIIS_FIELD_BARYCENTRIC)) put_vectors(on.barycentric, n, made_.barycentric.data() + 3 * first);
    if (has(RIIS_FIELD_VELOCITY)) interpolate<3>(set_.velocity, triangle, on, n, made_.velocity.data() + 3 * first);
    if (has(RIIS_FIELD_UV)) interpolate<2>(set_.uv, triangle, on, n, made_.uv.data() + 2 * first);
    for (std::int64_t lane = 0; lane < n; ++lane) {
      const std::int64_t i = first + lane, at = triangle[lane];
      if (has(RIIS_FIELD_PATCH)) view(made_.patch_id)[i] = view(set_.patch_id)[at];
      if (has(RIIS_FIELD_NORMAL)) put_vector(made_.normal.data(), i, normal(at));
      if (!has(RIIS_FIELD_SIDE | RIIS_FIELD_RIM)) continue;
      const Vec3 weights = lane_of(on.barycentric, lane);
      const std::array<double, 3> barycentric{weights.x, weights.y, weights.z};
      const auto [normal_there, is_on_rim] = normals_->at(at, barycentric);
      if (has(RIIS_FIELD_SIDE))
        view(made_.side)[i] = side_of(lane_of(pairs.point, lane) - lane_of(on.point, lane), normal_there);
      if (has(RIIS_FIELD_RIM)) view(made_.rim)[i] = is_on_rim ? 1 : 0;
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
  static void put_vectors(const double (*from)[pairs_at_once], std::int64_t n, double *to) {
    for (std::int64_t lane = 0; lane < n; ++lane) put_vector(to, lane, lane_of(from, lane));
  }

  Vec3 normal(std::int64_t triangle) const {
    return normals_ ? normals_->of_face(triangle) : triangle_normal(set_.corners(triangle));
  }

  // Interpolates a field that has n_components per vertex.
  template <int n_components>
  void interpolate(const std::vector<double> &field, const std::int64_t *triangle, const PointsOnTriangles &on,
                   std::int64_t n, double *to) const {
    for (std::int64_t lane = 0; lane < n; ++lane) {
      const std::int64_t *id = set_.vertex_id.data() + 3 * triangle[lane];
      const double *a = field.data() + n_components * id[0], *b = field.data() + n_components * id[1],
                   *c = field.data() + n_components * id[2];
      const Vec3 weights = lane_of(on.barycentric, lane);
      for (int k = 0; k < n_components; ++k)
        to[n_components * lane + k] = weights.x * a[k] + weights.y * b[k] + weights.z * c[k];
    }
  }

  const TriangleSet &set_;
  const StridedPoints &nodes_;
  void (*locate_)(const PointsAndTriangles &, PointsOnTriangles &);
  std::int32_t fields_;
  const Pseudonormals *normals_;  // null if no field needs them
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
