// SPDX-License-Identifier: Apache-2.0
#include "internals.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "api/handles.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "brute_force.hpp"
#include "geometry/bulge.hpp"
#include "geometry/coons.hpp"
#include "geometry/curve.hpp"
#include "marks/marks.hpp"
#include "mesh/adjacency.hpp"
#include "paper_distances/patch_distance.hpp"
#include "paper_distances/powell.hpp"
#include "parallel/parallel_for.hpp"
#include "scene/triangle_scene.hpp"
#include "seal/seal.hpp"
#include "triangulate/grids.hpp"
#include "triangulate/triangulate.hpp"
#include "valve/patches.hpp"
#include "valve/valve.hpp"

using namespace riis;

namespace {

Vec3 vec(const double *p) { return {p[0], p[1], p[2]}; }

void put(Vec3 from, double *to) {
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

Bezier curve(int degree, const double *control) {
  Bezier made{degree, {}};
  for (int i = 0; i <= degree; ++i) made.control[static_cast<std::size_t>(i)] = vec(control + 3 * i);
  return made;
}

Vector<Vec3> list(std::int64_t n, const double *points) {
  Vector<Vec3> made;
  for (std::int64_t i = 0; i < n; ++i) made.push_back(vec(points + 3 * i));
  return made;
}

template <class T>
T *room(std::size_t n) {
  return static_cast<T *>(std::malloc(std::max<std::size_t>(n, 1) * sizeof(T)));
}

// Makes a curve of n cubics, with 12 numbers each.
Curve chain(std::int64_t n_spans, const double *control) {
  Vector<Bezier> spans;
  for (std::int64_t i = 0; i < n_spans; ++i) spans.push_back(curve(3, control + 12 * i));
  return Curve(std::move(spans));
}

void give(const Flattened &made, int64_t *n_points, double **points, double **t, double **errors) {
  *n_points = static_cast<int64_t>(made.points.size());
  *points = room<double>(3 * made.points.size());
  *t = room<double>(made.t.size());
  *errors = room<double>(made.errors.size());
  for (std::size_t i = 0; i < made.points.size(); ++i) put(made.points[i], *points + 3 * i);
  std::copy(made.t.begin(), made.t.end(), *t);
  std::copy(made.errors.begin(), made.errors.end(), *errors);
}

QuadGrid grid_of(const std::int64_t *n, const double *const *points, double max_merge_shift) {
  const Polyline sides[4] = {make_polyline(list(n[0], points[0])), make_polyline(list(n[1], points[1])),
                             make_polyline(list(n[2], points[2])), make_polyline(list(n[3], points[3]))};
  return make_quad_grid({&sides[0], &sides[1], &sides[2], &sides[3]}, max_merge_shift);
}

}  // namespace

extern "C" {

void bezier_evaluate(int degree, const double *control, double t, double *point) {
  put(evaluate(curve(degree, control), t), point);
}

void bezier_derivative(int degree, const double *control, double t, double *vector) {
  put(derivative(curve(degree, control), t), vector);
}

double bezier_arc_length(int degree, const double *control, double t0, double t1) {
  return arc_length(curve(degree, control), t0, t1);
}

void bezier_split(int degree, const double *control, double t, double *left, double *right) {
  const auto [below, above] = split(curve(degree, control), t);
  for (int i = 0; i <= degree; ++i) {
    put(below.control[static_cast<std::size_t>(i)], left + 3 * i);
    put(above.control[static_cast<std::size_t>(i)], right + 3 * i);
  }
}

double bezier_flatness(int degree, const double *control) { return flatness(curve(degree, control)); }

riis_status bezier_flatten(int degree, const double *control, double max_error, int64_t *n_points, double **points,
                           double **t, double **errors) {
  return guarded([&] { give(flatten(curve(degree, control), max_error), n_points, points, t, errors); });
}

riis_status chain_flatten(int64_t n_spans, const double *control, double max_error, int64_t *n_points, double **points,
                          double **t, double **errors) {
  return guarded([&] { give(flatten(chain(n_spans, control), max_error), n_points, points, t, errors); });
}

double chain_length(int64_t n_spans, const double *control) { return chain(n_spans, control).length(); }

void chain_at(int64_t n_spans, const double *control, double share, double *point, double *tangent) {
  const Curve::PointAndTangent there = chain(n_spans, control).with_tangent(share);
  put(there.point, point);
  put(there.tangent, tangent);
}

int64_t chain_between(int64_t n_spans, const double *control, double share0, double share1, int reversed,
                      double *part) {
  const Curve whole = chain(n_spans, control), between = whole.between(share0, share1);
  const Curve made = reversed ? between.reversed() : between;
  for (std::size_t i = 0; i < made.spans().size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) put(made.spans()[i].control[k], part + 12 * i + 3 * k);
  return static_cast<int64_t>(made.spans().size());
}

void bulge_at(int64_t n_base, const double *base, int64_t n_edge, const double *edge, double factor, double u,
              double *offset) {
  put(Bulge(chain(n_base, base), chain(n_edge, edge), factor).place(u).offset, offset);
}

double bulge_linear_error(int64_t n_base, const double *base, int64_t n_edge, const double *edge, double factor,
                          double u0, double u1, double enough) {
  const Bulge bulge(chain(n_base, base), chain(n_edge, edge), factor);
  return bulge.linear_error(bulge.place(u0), bulge.place(u1), enough);
}

double polyline_make(int64_t n, const double *points, int64_t *n_kept, double *t) {
  const Polyline made = make_polyline(list(n, points));
  *n_kept = static_cast<int64_t>(made.t.size());
  std::copy(made.t.begin(), made.t.end(), t);
  return made.length;
}

void polyline_evaluate(int64_t n, const double *points, double t, double *point) {
  put(evaluate(make_polyline(list(n, points)), t), point);
}

quad_grid coons_grid(const int64_t *n, const double *const *points, double max_merge_shift) {
  const QuadGrid made = grid_of(n, points, max_merge_shift);
  quad_grid grid{static_cast<int64_t>(made.u.size()), static_cast<int64_t>(made.v.size()), room<double>(made.u.size()),
                 room<double>(made.v.size()), room<double>(3 * made.points.size())};
  std::copy(made.u.begin(), made.u.end(), grid.u);
  std::copy(made.v.begin(), made.v.end(), grid.v);
  for (std::size_t i = 0; i < made.points.size(); ++i) put(made.points[i], grid.points + 3 * i);
  return grid;
}

void coons_evaluate(const int64_t *n, const double *const *points, double u, double v, double *point) {
  put(evaluate(grid_of(n, points, 0), u, v), point);
}

void quad_grid_free(quad_grid *grid) {
  std::free(grid->u);
  std::free(grid->v);
  std::free(grid->points);
}

double quad_kappa(const double *p00, const double *p10, const double *p11, const double *p01) {
  return quad_flatness({vec(p00), vec(p10), vec(p11), vec(p01)});
}

double quad_split_error(const double *p00, const double *p10, const double *p11, const double *p01) {
  return split_error({vec(p00), vec(p10), vec(p11), vec(p01)});
}

double kernel_point_triangle(const double *p, const double *abc, double *point, double *barycentric) {
  const PointOnTriangle on = closest_point_on_triangle(vec(p), vec(abc), vec(abc + 3), vec(abc + 6));
  put(on.point, point);
  std::copy(on.barycentric.begin(), on.barycentric.end(), barycentric);
  return on.distance_sq;
}

int segment_triangle_meet(const double *a, const double *b, const double *abc) {
  return segment_meets_triangle(vec(a), vec(b), {vec(abc), vec(abc + 3), vec(abc + 6)});
}

riis_status triangulate_deviating(const char *kind, double deviation, double max_error, int is_fixed, deviating *made) {
  return guarded([&] {
    PatchSet set = Valve(find_valve_kind(kind)).make_patches();
    set.deviation = deviation;
    const Placement in_place{1, no_rotation, {0, 0, 0}};
    std::optional<TriangulationPlan> plan;
    if (is_fixed) plan = plan_triangulation({set}, max_error, 1);
    const Triangulation how{max_error, in_place, false, 1};
    const TriangleSet triangles = plan ? triangulate_fixed(set, how, *plan) : triangulate_adapted(set, how);
    *made = {triangles.n_triangles(), triangles.error_bound,
             PlacedPatches(set, max_error, in_place, false).largest_error(), !plan || is_within(set, *plan, max_error)};
  });
}

riis_status aortic_patches(const char *name, double value, patch_set *set) {
  return guarded([&] {
    Valve valve(find_valve_kind("aortic"));
    if (name) valve.set(name, 1, &value);
    const PatchSet made = valve.make_patches();
    const std::size_t n_curves = made.curves.size(), n_patches = made.patches.size();
    std::size_t n_images = 0;
    for (const Patch &patch : made.patches) n_images += patch.images.size();
    *set = {static_cast<int64_t>(n_curves), static_cast<int64_t>(n_patches), static_cast<int64_t>(n_images),
            room<int32_t>(n_curves),        room<double>(12 * n_curves),     room<int64_t>(4 * n_patches),
            room<int64_t>(n_images),        room<int32_t>(n_images),         room<int32_t>(n_images),
            room<int32_t>(n_images),        room<double>(12 * n_images)};
    for (std::size_t i = 0; i < n_curves; ++i) {
      const Bezier &only = made.curves[i].spans().front();
      set->degree[i] = only.degree;
      for (std::size_t k = 0; k < 4; ++k) put(only.control[k], set->control + 12 * i + 3 * k);
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < n_patches; ++i) {
      const Patch &patch = made.patches[i];
      const std::size_t sides[4] = {patch.v0.curve, patch.v1.curve, patch.u0.curve, patch.u1.curve};
      for (std::size_t k = 0; k < 4; ++k) set->sides[4 * i + k] = static_cast<int64_t>(sides[k]);
      for (const PatchImage &image : patch.images) {
        set->patch[at] = static_cast<int64_t>(i);
        set->leaflet_id[at] = image.leaflet_id;
        set->patch_id[at] = image.patch_id;
        set->mirrored[at] = image.mirror != Mirror::none;
        double *frame = set->frame + 12 * at++;
        put(image.rotation.row_x, frame), put(image.rotation.row_y, frame + 3), put(image.rotation.row_z, frame + 6);
        put(image.translation, frame + 9);
      }
    }
  });
}

void patch_image_place(const patch_set *set, int64_t image, const double *p, double *placed) {
  const double *frame = set->frame + 12 * image;
  const PatchImage at{set->mirrored[image] ? Mirror::in_y : Mirror::none,
                      {vec(frame), vec(frame + 3), vec(frame + 6)},
                      vec(frame + 9),
                      0,
                      0};
  put(place(at, vec(p)), placed);
}

void patch_set_free(patch_set *set) {
  for (void *memory :
       {static_cast<void *>(set->degree), static_cast<void *>(set->control), static_cast<void *>(set->sides),
        static_cast<void *>(set->patch), static_cast<void *>(set->leaflet_id), static_cast<void *>(set->patch_id),
        static_cast<void *>(set->mirrored), static_cast<void *>(set->frame)})
    std::free(memory);
}

riis_status bounded_quads(const char *kind, int n_parameters, const char *const *names, const double *values,
                          double max_error, int64_t *n_quads, bounded_quad **quads) {
  return guarded([&] {
    Valve valve(find_valve_kind(kind));
    for (int i = 0; i < n_parameters; ++i) valve.set(names[i], 1, values + i);
    const PatchSet set = valve.make_patches();
    const Vector<QuadGrid> grids = make_grids(set, max_error);
    std::vector<bounded_quad> made;
    for (std::size_t patch = 0; patch < grids.size(); ++patch) {
      const QuadGrid &grid = grids[patch];
      const PatchImage &image = set.patches[patch].images.front();
      for (std::size_t j = 0; j + 1 < grid.v.size(); ++j)
        for (std::size_t i = 0; i + 1 < grid.u.size(); ++i) {
          bounded_quad quad{
              image.patch_id, {grid.u[i], grid.u[i + 1]}, {grid.v[j], grid.v[j + 1]}, grid.error(i, j), {}};
          put(place(image, grid.point(i, j)), quad.corners[0]);
          put(place(image, grid.point(i + 1, j)), quad.corners[1]);
          put(place(image, grid.point(i + 1, j + 1)), quad.corners[2]);
          put(place(image, grid.point(i, j + 1)), quad.corners[3]);
          made.push_back(quad);
        }
    }
    *n_quads = static_cast<int64_t>(made.size());
    *quads = room<bounded_quad>(made.size());
    std::copy(made.begin(), made.end(), *quads);
  });
}

int64_t scene_differs_from_loop(int64_t n_triangles, const double *xyz, int64_t n_points, const double *points,
                                double limit) {
  TriangleSet set;
  set.xyz.assign(xyz, xyz + 9 * n_triangles);
  for (int64_t i = 0; i < 3 * n_triangles; ++i) set.vertex_id.push_back(i);
  for (int64_t i = 0; i < n_triangles; ++i) set.triangle_id.push_back(i);
  set.leaflet_id.assign(static_cast<std::size_t>(n_triangles), 0);
  TriangleScene scene;
  scene.make(set, 1);
  int64_t n_different = 0;
  for (int64_t i = 0; i < n_points; ++i) {
    const Vec3 p = vec(points + 3 * i);
    ClosestTriangle expected = closest_by_brute_force(set, p);
    if (!(std::sqrt(expected.distance_sq) <= limit)) expected = {std::numeric_limits<double>::infinity(), -1};
    for (int k = 0; k < n_instruction_sets; ++k) {
      const auto instructions = static_cast<InstructionSet>(k);
      if (!has(instructions)) continue;
      const ClosestTriangle got = scene.closest(p, limit, instructions);
      n_different += got.triangle != expected.triangle || got.distance_sq != expected.distance_sq;
    }
  }
  return n_different;
}

int64_t samples_of(const riis_surface *surface, const double **xyz) {
  const auto *samples = dynamic_cast<const SampleSet *>(content_of(surface).other_distance());
  if (!samples) return 0;
  *xyz = samples->xyz().data();
  return samples->n_samples();
}

double powell_minimum(double (*f)(double u, double v), double enough, double step, double *uv) {
  const LocalMinimum found = minimize_by_powell([&](Parameters at) { return f(at.u, at.v); }, {0.5, 0.5}, enough,
                                                [&](Parameters) { return step; });
  uv[0] = found.at.u;
  uv[1] = found.at.v;
  return found.value;
}

std::int64_t order_found_nodes(const riis_surface *surface, std::int64_t n_nodes, int n_threads, int limit_is_wider,
                               int n_lists, const std::int64_t *end, const std::int64_t *node, const double *distance,
                               const std::int64_t *triangle, std::int64_t *within_node, double *within_distance,
                               std::int64_t *within_triangle, std::int64_t *marked_node, double *marked_distance) {
  static FoundNodes found;
  found.numbers = {0, n_nodes};
  static OrderScratch scratch;
  const Surface &content = content_of(surface);
  found.prepare(n_lists);
  for (int list = 0; list < n_lists; ++list)
    for (std::int64_t i = list == 0 ? 0 : end[list - 1]; i < end[list]; ++i)
      view(found.by_thread)[list].push_back({node[i], distance[i], triangle[i]});
  const OrderScratch::Counts n = prepare_order(content, found, limit_is_wider, n_threads, scratch);
  NodeList within, marked;
  within.resize(n.n_within);
  marked.resize(n.n_marked);
  put_in_order(content, limit_is_wider, found.numbers, n_threads, scratch, within, marked);
  std::copy(within.node_id.begin(), within.node_id.end(), within_node);
  std::copy(within.distance.begin(), within.distance.end(), within_distance);
  std::copy(within.triangle_id.begin(), within.triangle_id.end(), within_triangle);
  std::copy(marked.node_id.begin(), marked.node_id.end(), marked_node);
  std::copy(marked.distance.begin(), marked.distance.end(), marked_distance);
  return limit_is_wider ? n.n_marked : -1;
}

riis_status wall_meets(const char *exception) {
  const std::string_view kind = exception;
  return guarded([&] {
    if (kind == "error") fail(RIIS_INVALID_MESH, "error ", 7);
    if (kind == "memory") throw std::bad_alloc();
    if (kind == "standard") throw std::runtime_error("boom");
    if (kind == "other") throw 42;
    if (kind == "worker")
      parallel_for(1000, 4, [](std::int64_t block, int) {
        if (block % 100 == 99) fail(RIIS_INVALID_MESH, "a worker's error");
      });
    if (kind == "workers") {
      std::atomic<bool> has_failed{false};
      parallel_for(2, 2, [&](std::int64_t block, int) {
        const auto start = std::chrono::steady_clock::now();
        // The first block waits for a short time until another block has failed. With a single thread, no other block can fail
        // during this wait.
        while (block == 0 && !has_failed && std::chrono::steady_clock::now() - start < std::chrono::milliseconds(500))
          std::this_thread::yield();
        if (block == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        has_failed = true;
        fail(RIIS_INVALID_MESH, "error of block ", static_cast<int>(block));
      });
    }
  });
}
}

struct edge_set {
  std::set<std::pair<std::int64_t, std::int64_t>> directed;
};

namespace {

wide_rows new_rows(std::int64_t n_rows, std::int64_t n_columns) {
  wide_rows rows{n_rows, static_cast<std::int64_t *>(std::calloc(static_cast<std::size_t>(n_rows + 1), 8)),
                 static_cast<std::int64_t *>(std::calloc(static_cast<std::size_t>(n_columns + 1), 8)), 64};
  if (!rows.offsets || !rows.columns) throw std::bad_alloc();
  return rows;
}

}  // namespace

void wide_rows_free(wide_rows *rows) {
  std::free(rows->offsets);
  std::free(rows->columns);
  *rows = {};
}

int wide_rows_same(const wide_rows *a, const wide_rows *b) {
  if (a->n_rows != b->n_rows) return 0;
  const auto n = static_cast<std::size_t>(a->n_rows);
  return std::memcmp(a->offsets, b->offsets, (n + 1) * 8) == 0 &&
         std::memcmp(a->columns, b->columns, static_cast<std::size_t>(a->offsets[n]) * 8) == 0;
}

edge_set *edge_set_make(void) { return new edge_set; }
void edge_set_free(edge_set **set) {
  delete *set;
  *set = nullptr;
}

void edge_set_add(edge_set *set, std::int64_t a, std::int64_t b) {
  if (a == b) return;
  set->directed.emplace(a, b);
  set->directed.emplace(b, a);
}

wide_rows edge_set_rows(const edge_set *set, std::int64_t n_nodes) {
  wide_rows rows = new_rows(n_nodes, static_cast<std::int64_t>(set->directed.size()));
  std::int64_t n = 0;
  for (const auto &edge : set->directed) {
    rows.columns[n++] = edge.second;
    ++rows.offsets[edge.first + 1];
  }
  for (std::int64_t i = 0; i < n_nodes; ++i) rows.offsets[i + 1] += rows.offsets[i];
  return rows;
}

riis_status rows_with_limits(const riis_mesh_cells *cells, int n_threads, std::int64_t n_entries, std::int64_t n_nodes,
                             wide_rows *rows) {
  return riis::guarded([&] {
    riis::NarrowLimits limits;
    if (n_entries >= 0) limits.n_entries = n_entries;
    if (n_nodes >= 0) limits.n_nodes = n_nodes;
    const riis::OwnAdjacency made = riis::adjacency_from_cells(*cells, n_threads, limits);
    const riis_csr csr = made.csr();
    const riis::IntegerArray offsets{csr.offsets, csr.offset_bits == 64}, columns{csr.columns, csr.column_bits == 64};
    *rows = new_rows(csr.n_rows, offsets[csr.n_rows]);
    rows->column_bits = csr.column_bits;
    for (std::int64_t i = 0; i <= csr.n_rows; ++i) rows->offsets[i] = offsets[i];
    for (std::int64_t k = 0; k < offsets[csr.n_rows]; ++k) rows->columns[k] = columns[k];
  });
}
