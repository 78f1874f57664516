/* SPDX-License-Identifier: Apache-2.0
 * Tests the search over clusters for a surface with an offset, where it leaves out nodes far behind the surface. The search must
 * give the list that a search of all nodes within reach gives, bit for bit. An oracle judges each node of this list.
 * RIIS_TEST_LONG=1 tries more surfaces. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "band_oracle.h"
#include "random_meshes.h"

static const char *const valve_kinds[] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet"};
enum { n_valve_kinds = 5, n_sheets = 5, most_across = 12, n_nodes = 16000 };

/* Offsets near 0 and near 1 are as likely as others. */
static double random_offset(void) {
  const double sign = one_in(2) ? 1 : -1, small = random_power_of_ten(&rng, -12, -1);
  return sign * (one_in(3) ? small : one_in(2) ? 1 - small : random_between(&rng, 0, 1));
}

/* Makes a sheet of triangles. The sheet is smooth, crumpled with sharp folds, folded onto itself, or a fan around one vertex, or
 * it has needles. */
static riis_surface *sheet(int what, const riis_surface_options *options) {
  double xyz[3 * most_across * most_across];
  int32_t ids[6 * most_across * most_across];
  const int n = (int)random_integer(2, most_across);
  const double rough = what == 0 ? 0 : what == 1 ? random_between(&rng, 0.2, 2) : random_between(&rng, 0, 0.3);
  int n_triangles = 0;
  for (int i = 0; i < n * n; ++i) {
    double *p = xyz + 3 * i;
    const double x = (i % n + random_between(&rng, -0.3, 0.3)) / n, y = (i / n + random_between(&rng, -0.3, 0.3)) / n;
    const double z = rough * random_between(&rng, -1, 1) / n;
    p[0] = x, p[1] = y, p[2] = z + 0.3 * (x * x - y * y);
    if (what == 2 && i % n > 0 && one_in(4))
      for (int c = 0; c < 3; ++c) p[c] = p[c - 3] + random_power_of_ten(&rng, -10, -2) * random_between(&rng, -1, 1);
    if (what == 3 && x > 0.5) p[0] = 1 - x, p[2] = z + 0.05;
    if (what == 4) p[0] = i == 0 ? 0 : cos(0.45 * i), p[1] = i == 0 ? 0 : sin(0.45 * i), p[2] = i == 0 ? 2 * rough : z;
  }
  for (int i = 0; what == 4 && i + 2 < n * n && i < most_across; ++i, ++n_triangles)
    ids[3 * i] = 0, ids[3 * i + 1] = i + 1, ids[3 * i + 2] = i + 2;
  for (int i = 0; what != 4 && i + n < n * n; ++i)
    if (i % n < n - 1) {
      const int32_t both[6] = {i, i + 1, i + n, i + 1, i + n + 1, i + n};
      memcpy(ids + 3 * n_triangles, both, sizeof both);
      n_triangles += 2;
    }
  const riis_surface_arrays arrays = triangle_arrays(n * n, xyz, n_triangles, ids);
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create_from_arrays(&arrays, options, &surface));
  return own(surface);
}

static riis_surface *valve_surface(const char *kind, riis_surface_options *options) {
  riis_valve *valve = new_valve(kind);
  const double opening = one_in(3) ? 0 : random_between(&rng, 0, 1);
  CHECK_OK(riis_valve_set(valve, "opening", 1, &opening));
  for (int c = 0; c < 3; ++c) options->rotation_axis[c] = random_between(&rng, 0.1, 1);
  options->rotation_angle = random_between(&rng, -180, 180);
  options->tolerance = random_between(&rng, 0.05, 0.5);
  return new_surface(valve, options);
}

static int is_anywhere(int64_t node) { return node % 2 == 0; }

/* Puts nodes around the band. One half of the nodes lies anywhere. The other half lies over random places of the surface, along
 * the triangle's normal. Some nodes of the second half are at the ends of the band, or exactly over a vertex or an edge. */
static void place_nodes(const riis_surface *surface, double eps, double offset, double *xyz) {
  const riis_surface_info info = info_of(surface);
  const riis_triangles all = triangles_of(surface);
  const double reach = 1.2 * (1 + fabs(offset)) * eps;
  for (int64_t i = 0; i < n_nodes; ++i) {
    double *p = xyz + 3 * i;
    real corner[3][3], e[2][3], normal[3];
    double weight[3], height = reach * random_between(&rng, -1, 1), sum = 0;
    band_corners(&all, random_integer(0, all.n_triangles - 1), corner);
    for (int k = 0; k < 3; ++k) sum += weight[k] = one_in(6) ? 0 : random_between(&rng, 0.01, 1);
    if (sum == 0) weight[0] = sum = 1;
    if (one_in(10)) height = one_in(2) ? (offset + 1) * eps : (offset - 1) * eps;
    for (int c = 0; c < 3; ++c) e[0][c] = corner[1][c] - corner[0][c], e[1][c] = corner[2][c] - corner[0][c];
    cross3(e[0], e[1], normal);
    const real size = sqrtl(dot3(normal, normal));
    for (int c = 0; c < 3; ++c) {
      const real at = (weight[0] * corner[0][c] + weight[1] * corner[1][c] + weight[2] * corner[2][c]) / sum;
      p[c] = is_anywhere(i) ? random_between(&rng, info.lower[c] - reach, info.upper[c] + reach)
                            : (double)(at + height * normal[c] / size);
    }
  }
}

static void check_same_list(riis_mark_list a, riis_mark_list b) {
  assert_true(same_nodes(found_in(a), found_in(b)));
  for (int64_t i = 0; i < a.n_nodes; ++i) {
    CHECK_SAME(a.height[i], b.height[i]);
    CHECK_SAME(a.K[i], b.K[i]);
  }
}

static int64_t n_in_band, n_left_out;

static void check_surface(const riis_surface *surface, const riis_surface_options *options, int is_judged) {
  const double eps = options->half_thickness, offset = options->offset;
  double *xyz = own(malloc(3 * n_nodes * sizeof *xyz));
  place_nodes(surface, eps, offset, xyz);
  riis_mesh *mesh = mesh_of(n_nodes, xyz);
  riis_marks *marks = new_result(), *by_clusters = new_result();
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1;
  riis_mark_options asked = mark_options();
  asked.resistance = &resistance;
  asked.fields = RIIS_FIELD_RIM;
  asked.search = RIIS_SEARCH_EXHAUSTIVE;
  asked.distance_limit = (1 + fabs(offset)) * eps;
  CHECK_OK(riis_mark_nodes(surface, mesh, &asked, marks));
  const riis_mark_list within = within_list(marks), marked = marked_list(marks);
  asked.distance_limit = RIIS_AUTO;
  asked.search = RIIS_SEARCH_CLUSTERS;
  for (int k = 0; k < 2; ++k) {
    asked.instructions = k == 0 ? RIIS_INSTRUCTIONS_AUTO : RIIS_INSTRUCTIONS_BASELINE;
    asked.n_threads = (int32_t)random_integer(1, 3);
    CHECK_OK(riis_mark_nodes(surface, mesh, &asked, by_clusters));
    check_same_list(marked_list(by_clusters), marked);
    check_same_list(within_list(by_clusters), marked);
  }
  n_in_band += marked.n_nodes, n_left_out += within.n_nodes - marked.n_nodes;
  if (!is_judged) return;
  const riis_triangles all = triangles_of(surface);
  int64_t at = 0;
  for (int64_t i = 0; i < within.n_nodes; ++i) {
    const int is_marked = at < marked.n_nodes && marked.node_id[at] == within.node_id[i];
    const band_place place = place_of(&all, xyz + 3 * within.node_id[i], within.triangle_id[i], within.rim[i]);
    const double middle = (double)from_middle(&place, eps, offset);
    /* Exactly over an edge, rounding decides whether the edge's or a face's normal is used. */
    if (is_anywhere(within.node_id[i]) && fabs(middle - eps) > 1e-9 * eps) assert_int_equal(is_marked, middle < eps);
    at += is_marked;
  }
}

TEST(nodes_are_left_out_beside_any_sheet) {
  const int n = trials_of(24);
  for (int trial = 0; trial < n; ++trial)
    for (int what = 0; what < n_sheets; ++what) {
      const int n_before = n_owned();
      riis_surface_options options = surface_options();
      options.half_thickness = random_power_of_ten(&rng, -2.5, 0), options.offset = random_offset();
      options.flip_normals = one_in(2);
      check_surface(sheet(what, &options), &options, trial % 4 == 0);
      free_owned_after(n_before);
    }
}

TEST(nodes_are_left_out_beside_any_valve) {
  const int n = trials_of(9);
  for (int trial = 0; trial < n; ++trial)
    for (int kind = 0; kind < n_valve_kinds; ++kind) {
      const int n_before = n_owned();
      riis_surface_options options = surface_options();
      options.half_thickness = random_between(&rng, 0.03, 0.3), options.offset = random_offset();
      options.flip_normals = one_in(2);
      riis_surface *surface = valve_surface(valve_kinds[kind], &options);
      check_surface(surface, &options, 0);
      free_owned_after(n_before);
    }
  printf("%lld nodes in bands, %lld others within reach\n", (long long)n_in_band, (long long)n_left_out);
}

int main(void) {
  rng = random_start("test_one_side");
  return run_cases(NULL, NULL);
}
