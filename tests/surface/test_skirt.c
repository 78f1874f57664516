/* SPDX-License-Identifier: Apache-2.0
 * Tests the skirt. The skirt's inner edge must lie on the attachment, and the outer edge must lie outwards by the skirt's length.
 * The skirt must seal a gap to a wall that is otherwise open. The leaflets, the orifice, the swept volumes and the attachment
 * must stay the same. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "moving_surfaces.h"
#include "searches.h"

#include "random_meshes.h"

#include "flood_fill.h"
#include "given_back.h"
#include "shapes.h"
#include "skirt_checks.h"

static double between(double low, double high) { return random_between(&rng, low, high); }

enum { n_skirted = 3 };
static const char *const skirted[n_skirted + 1] = {"trileaflet", "mitral", "aortic", "coapting"};

static riis_valve *skirted_valve(int kind, double length, double opening) {
  riis_valve *valve = new_valve(skirted[kind]);
  CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", length));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return valve;
}

/* Sets random sizes from a range in which no valve crosses itself. */
static void set_random_sizes(riis_valve *valve, int kind) {
  if (kind == 0) CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", between(1.3, 1.6)));
  if (kind == 1) {
    CHECK_OK(riis_valve_set_scalar(valve, "indent_depth", between(0, 0.6)));
    CHECK_OK(riis_valve_set_scalar(valve, "anterior_horn_height", between(0.2, 1)));
  }
  if (kind == 2) CHECK_OK(riis_valve_set_scalar(valve, "open_radius_ratio", between(0.75, 0.85)));
}

static riis_surface_options random_placement(int32_t triangulation) {
  riis_surface_options options = surface_options();
  options.triangulation = triangulation;
  options.scale = pow(10, between(-2, 1));
  for (int c = 0; c < 3; ++c)
    options.rotation_axis[c] = between(-1, 1) + (c == 1 ? 2 : 0),
    options.translation[c] = options.scale * between(-3, 3);
  options.rotation_angle = between(-180, 180);
  return options;
}

static riis_attachment attachment_of(const riis_surface *surface) {
  riis_attachment attachment;
  CHECK_OK(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
  return attachment;
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double length_of(const double *a) { return sqrt(dot(a, a)); }

static double distance_between(const double *a, const double *b) {
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return length_of(d);
}

static double distance_to_edge(const double *p, const double *a, const double *b) {
  double ab[3], ap[3];
  for (int c = 0; c < 3; ++c) ab[c] = b[c] - a[c], ap[c] = p[c] - a[c];
  const double size = dot(ab, ab), t = size > 0 ? fmin(fmax(dot(ab, ap) / size, 0), 1) : 0;
  double off[3];
  for (int c = 0; c < 3; ++c) off[c] = ap[c] - t * ab[c];
  return length_of(off);
}

/* The line from which skirts lead away is the axis of the valve's frame. For the mitral valve, the line is parallel to this axis,
 * through the centroid of the annulus. */
typedef struct axis_line {
  double centre[3], direction[3];
} axis_line;

static axis_line axis_of(const riis_surface *surface, int kind, const riis_surface_options *options) {
  riis_orifice orifice; /* the orifice of a bileaflet valve is seen along the z axis of its frame */
  CHECK_OK(riis_surface_get_orifice(surface_of_kind("bileaflet", options), NULL, &orifice, sizeof orifice));
  const riis_attachment held = attachment_of(surface);
  axis_line axis = {{0, 0, 0}, {orifice.axis[0], orifice.axis[1], orifice.axis[2]}};
  double whole = 0;
  for (int64_t i = 0; i < held.n_edges; ++i) {
    const double *a = held.edges + 6 * i, *b = a + 3, size = distance_between(a, b);
    whole += size;
    for (int c = 0; c < 3; ++c) axis.centre[c] += 0.5 * size * (a[c] + b[c]);
  }
  for (int c = 0; c < 3; ++c) axis.centre[c] = kind == 1 ? axis.centre[c] / whole : options->translation[c];
  return axis;
}

static void outwards_from(const axis_line *axis, const double *p, double *out) {
  double q[3];
  for (int c = 0; c < 3; ++c) q[c] = p[c] - axis->centre[c];
  const double along = dot(q, axis->direction);
  for (int c = 0; c < 3; ++c) q[c] -= along * axis->direction[c];
  const double size = length_of(q);
  for (int c = 0; c < 3; ++c) out[c] = q[c] / size;
}

/* With RIIS_TEST_LONG=1 each kind of valve has both triangulations. */
static int n_trials_of_kinds(void) { return is_long_test() ? 2 * n_skirted : n_skirted; }

/* Checks the vertices of the skirt's inner and outer edge. */
TEST(the_outer_edge_is_the_length_away) {
  for (int trial = 0; trial < n_trials_of_kinds(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_skirted, is_fixed = trial / n_skirted % 2;
    const double length = between(0.02, 0.3);
    riis_valve *valve = skirted_valve(kind, length, trial % 2 ? between(0, 1) : 0);
    set_random_sizes(valve, kind);
    riis_surface_options options = random_placement(is_fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    options.tolerance = 0.03;
    const riis_surface *surface = new_surface(valve, &options);
    const double L = options.scale * length;
    const double error = 1e-3 * L + 2 * info_of(surface).error_bound, rounding = 1e-13 * options.scale;
    const axis_line axis = axis_of(surface, kind, &options);
    const riis_triangles all = triangles_of(surface);
    const riis_attachment held = attachment_of(surface);
    double *wanted = own(malloc((size_t)held.n_edges * 6 * sizeof *wanted)); /* the attachment, moved outwards */
    for (int64_t i = 0; i < 2 * held.n_edges; ++i) {
      double out[3];
      outwards_from(&axis, held.edges + 3 * i, out);
      for (int c = 0; c < 3; ++c) wanted[3 * i + c] = held.edges[3 * i + c] + L * out[c];
    }
    int64_t n_outer = 0, n_inner = 0;
    double worst = 0;
    for (int64_t t = 0; t < all.n_triangles; ++t)
      for (int k = 0; k < 3 && all.leaflet_id[t] == RIIS_LEAFLET_SKIRT; ++k) {
        const int64_t id = all.vertex_id[3 * t + k];
        const double v = all.uv[2 * id + 1];
        if (v != 0 && v != 1) continue;
        double nearest = INFINITY;
        for (int64_t i = 0; i < held.n_edges; ++i) {
          const double *edge = (v == 0 ? wanted : held.edges) + 6 * i;
          nearest = fmin(nearest, distance_to_edge(all.xyz + 3 * id, edge, edge + 3));
        }
        if (v == 0) {
          worst = fmax(worst, nearest), ++n_outer;
        } else {
          CHECK_AT_MOST(nearest, rounding);
          ++n_inner;
        }
      }
    printf("%s %s: outer edge off by %.2g of %.2g\n", skirted[kind], is_fixed ? "fixed" : "adapted", worst, error);
    CHECK_AT_MOST(worst, error);
    assert_true(n_outer > 20 && n_inner > 20);
    /* Every vertex of the attachment is on the inner edge. */
    for (int64_t i = 0; i < 2 * held.n_edges; ++i) {
      double nearest = INFINITY;
      for (int64_t t = 0; t < all.n_triangles; ++t)
        for (int k = 0; k < 3 && all.leaflet_id[t] == RIIS_LEAFLET_SKIRT; ++k) {
          const int64_t a = all.vertex_id[3 * t + k], b = all.vertex_id[3 * t + (k + 1) % 3];
          if (all.uv[2 * a + 1] != 1 || all.uv[2 * b + 1] != 1) continue;
          nearest = fmin(nearest, distance_to_edge(held.edges + 3 * i, all.xyz + 3 * a, all.xyz + 3 * b));
        }
      CHECK_AT_MOST(nearest, rounding);
    }
    free_owned_after(owned_before);
  }
}

/* The skirt's triangles follow those of the leaflets, which do not change. */
TEST(leaflets_stay_as_they_are) {
  for (int trial = 0; trial < n_trials_of_kinds(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_skirted;
    const double opening = trial < n_skirted ? 0 : between(0, 1);
    const uint64_t seed = rng.state;
    riis_valve *without = skirted_valve(kind, 0, opening);
    set_random_sizes(without, kind);
    rng.state = seed;
    riis_valve *with = skirted_valve(kind, 0.1, opening);
    set_random_sizes(with, kind);
    const riis_surface_options options = random_placement(RIIS_TRIANGULATION_ADAPTED);
    const riis_surface *a = new_surface(without, &options), *b = new_surface(with, &options);
    const riis_triangles s = triangles_of(a), t = triangles_of(b);
    assert_true(t.n_triangles > s.n_triangles && t.n_vertices > s.n_vertices);
    assert_memory_equal(s.xyz, t.xyz, (size_t)s.n_vertices * 3 * sizeof *s.xyz);
    assert_memory_equal(s.vertex_id, t.vertex_id, (size_t)s.n_triangles * 3 * sizeof *s.vertex_id);
    assert_memory_equal(s.patch_id, t.patch_id, (size_t)s.n_triangles * sizeof *s.patch_id);
    for (int64_t i = s.n_triangles; i < t.n_triangles; ++i) assert_int_equal(t.leaflet_id[i], RIIS_LEAFLET_SKIRT);
    const riis_attachment held_a = attachment_of(a), held_b = attachment_of(b);
    assert_int_equal(held_a.n_edges, held_b.n_edges);
    assert_memory_equal(held_a.edges, held_b.edges, (size_t)held_a.n_edges * 6 * sizeof *held_a.edges);
    riis_orifice o, p;
    CHECK_OK(riis_surface_get_orifice(a, NULL, &o, sizeof o));
    CHECK_OK(riis_surface_get_orifice(b, NULL, &p, sizeof p));
    assert_memory_equal(&o, &p, sizeof o);
    for (int32_t leaflet = RIIS_ALL_LEAFLETS; leaflet < 1 && opening > 0; ++leaflet) {
      double volume_a, volume_b;
      CHECK_OK(riis_valve_get_swept_volume(without, 0, opening, NULL, leaflet, &volume_a));
      CHECK_OK(riis_valve_get_swept_volume(with, 0, opening, NULL, leaflet, &volume_b));
      assert_true(volume_a == volume_b);
    }
    free_owned_after(owned_before);
  }
}

/* Along the attachment, the edges of the leaflets and of the skirt run in opposite directions. The normals of leaflets and skirt
 * therefore point to one side. With a fixed triangulation, each mitral edge belongs to one leaflet and to the skirt, with the
 * same bits. */
TEST(the_skirt_continues_the_leaflets) {
  for (int trial = 0; trial < n_trials_of_kinds(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_skirted, is_fixed = trial / n_skirted % 2;
    riis_valve *valve = skirted_valve(kind, between(0.05, 0.2), trial % 2 ? between(0, 1) : 0);
    const riis_surface_options options =
        random_placement(is_fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    const riis_surface *surface = new_surface(valve, &options);
    const riis_triangles all = triangles_of(surface);
    const riis_attachment held = attachment_of(surface);
    for (int64_t i = 0; i < held.n_edges; ++i) {
      const double *a = held.edges + 6 * i, *b = a + 3;
      double inside[3], along[3];
      for (int c = 0; c < 3; ++c) inside[c] = 0.4137 * a[c] + 0.5863 * b[c], along[c] = b[c] - a[c];
      int n[2] = {0, 0}, n_same = 0; /* of the leaflets, then of the skirt */
      double direction[2] = {0, 0};
      for (int64_t t = 0; t < all.n_triangles; ++t)
        for (int k = 0; k < 3; ++k) {
          const double *p = all.xyz + 3 * all.vertex_id[3 * t + k],
                       *q = all.xyz + 3 * all.vertex_id[3 * t + (k + 1) % 3];
          if (distance_to_edge(inside, p, q) > 1e-13 * options.scale) continue;
          const double pq[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
          const int is_skirt = all.leaflet_id[t] == RIIS_LEAFLET_SKIRT;
          ++n[is_skirt], direction[is_skirt] = dot(pq, along);
          n_same += (memcmp(p, a, 3 * sizeof *p) == 0 && memcmp(q, b, 3 * sizeof *q) == 0) ||
                    (memcmp(p, b, 3 * sizeof *p) == 0 && memcmp(q, a, 3 * sizeof *q) == 0);
        }
      assert_true(n[0] == 1 && n[1] == 1 && direction[0] * direction[1] < 0);
      if (kind == 1 && is_fixed) assert_int_equal(n_same, 2);
    }
    free_owned_after(owned_before);
  }
}

TEST(skirts_cross_nothing) {
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  const int n_trials = trials(n_skirted, 100 * n_skirted);
  for (int trial = 0; trial < n_trials; ++trial) {
    const int kind = trial % n_skirted;
    const double length = between(0.05, 0.25);
    const uint64_t seed = rng.state;
    for (int i = 0; i <= 10; i += is_short_test() ? 5 : 1) {
      const int owned_before = n_owned();
      riis_surface_options options = surface_options();
      options.triangulation = i == 5 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
      riis_valve *valve = skirted_valve(kind, length, 0.1 * i);
      rng.state = seed;
      set_random_sizes(valve, kind);
      const riis_surface *surface = new_surface(valve, &options);
      const pair_counts counts = crossings_of(surface, crossings);
      assert_int_equal(counts.of_skirt + counts.of_own, 0);
      free_owned_after(owned_before);
    }
  }
}

/* Beside the skirt, the skirt's normals decide the side of a point. */
TEST(sides_are_right_beside_the_skirt) {
  for (int trial = 0; trial < n_trials_of_kinds(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_skirted;
    riis_surface_options options = random_placement(trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    const riis_surface *surface =
        new_surface(skirted_valve(kind, 0.15, trial < n_skirted ? 0 : between(0, 1)), &options);
    const riis_triangles all = triangles_of(surface);
    int n = 0;
    for (int64_t t = 0; t < all.n_triangles; ++t) {
      if (all.leaflet_id[t] != RIIS_LEAFLET_SKIRT) continue;
      const double *a = all.xyz + 3 * all.vertex_id[3 * t], *b = all.xyz + 3 * all.vertex_id[3 * t + 1],
                   *c = all.xyz + 3 * all.vertex_id[3 * t + 2];
      double ab[3], ac[3], normal[3], middle[3];
      for (int k = 0; k < 3; ++k) ab[k] = b[k] - a[k], ac[k] = c[k] - a[k], middle[k] = (a[k] + b[k] + c[k]) / 3;
      for (int k = 0; k < 3; ++k) normal[k] = ab[(k + 1) % 3] * ac[(k + 2) % 3] - ab[(k + 2) % 3] * ac[(k + 1) % 3];
      const double size = length_of(normal), away = between(0.1, 0.5) * (trial % 2 ? 1 : -1) * 0.02 * options.scale;
      const riis_closest found = closest_to(surface, middle[0] + away * normal[0] / size,
                                            middle[1] + away * normal[1] / size, middle[2] + away * normal[2] / size);
      if (found.leaflet_id != RIIS_LEAFLET_SKIRT) continue;
      assert_int_equal(found.side, away > 0 ? 1 : -1);
      ++n;
    }
    assert_true(n > 20);
    free_owned_after(owned_before);
  }
}

/* A wall around an axis that passes through (x, y) along z. At each angle, the wall is farther from the axis than the attachment
 * by a gap. */
enum { n_angles = 720 };
typedef struct wall_shape {
  const riis_attachment *held;
  double x, y, gap, radius[n_angles];
} wall_shape;

static double radius_of_attachment(const wall_shape *wall, double x, double y) {
  /* Finds the edge of the attachment that a ray from the axis through (x, y) meets. */
  double farthest = 0;
  for (int64_t i = 0; i < wall->held->n_edges; ++i) {
    const double *e = wall->held->edges + 6 * i;
    const double ax = e[0] - wall->x, ay = e[1] - wall->y, bx = e[3] - wall->x, by = e[4] - wall->y;
    const double side_a = x * ay - y * ax, side_b = x * by - y * bx;
    if (side_a * side_b > 0 || side_a == side_b) continue;
    const double t = side_a / (side_a - side_b), px = ax + t * (bx - ax), py = ay + t * (by - ay);
    if (px * x + py * y > 0) farthest = fmax(farthest, hypot(px, py));
  }
  return farthest;
}

static int is_inside(const wall_shape *wall, double x, double y) {
  const int i = (int)((atan2(y, x) / (2 * acos(-1)) + 0.5) * n_angles);
  return hypot(x, y) <= wall->radius[i % n_angles] + wall->gap;
}

static int leaks(const riis_surface *surface, const test_mesh *nodes) {
  riis_mesh *mesh = mesh_from(nodes);
  int64_t lowest = 0, highest = 0;
  for (int64_t i = 0; i < nodes->n; ++i) {
    if (nodes->xyz[3 * i + 2] < nodes->xyz[3 * lowest + 2]) lowest = i;
    if (nodes->xyz[3 * i + 2] > nodes->xyz[3 * highest + 2]) highest = i;
  }
  riis_passage passage;
  CHECK_OK(find_passage_between(surface, mesh, NULL, 1, &lowest, 1, &highest, &passage, sizeof passage));
  free_one_owned(mesh);
  return passage.state == RIIS_PASSAGE_OPEN;
}

/* The closed valve stands in a mesh with a gap between the attachment and the wall. A skirt as long as the gap closes the gap.
 * The aortic valve is left out, because it leaks even if the wall cuts its attachment. */
TEST(skirts_seal_gaps) {
  static const double gaps[4] = {0.05, 0.1, 0.15, 0.2};
  for (int kind = 0; kind < 4; kind += kind == 1 ? 2 : 1)
    for (int i = 0; i < 4; ++i) {
      if ((4 * kind + i) % trial_step()) continue;
      const int owned_before = n_owned();
      riis_surface_options options = surface_options();
      options.half_thickness = 0.1;
      options.triangulation = i == 3 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
      const riis_surface *bare = new_surface(skirted_valve(kind, 0, 0), &options),
                         *sealed = new_surface(skirted_valve(kind, gaps[i], 0), &options),
                         *open = new_surface(skirted_valve(kind, gaps[i], 1), &options);
      const riis_attachment held = attachment_of(bare);
      const axis_line axis = axis_of(bare, kind, &options);
      wall_shape wall = {&held, axis.centre[0], axis.centre[1], gaps[i], {0}};
      for (int k = 0; k < n_angles; ++k) {
        const double angle = 2 * acos(-1) * ((k + 0.5) / n_angles - 0.5);
        wall.radius[k] = radius_of_attachment(&wall, cos(angle), sin(angle));
      }
      const riis_surface_info info = info_of(sealed), info_open = info_of(open);
      const double spacing = between(0.09, 0.1), margin = 0.4;
      int64_t counts[3];
      double lower[3], upper[3];
      for (int c = 0; c < 3; ++c) {
        lower[c] = fmin(info.lower[c], info_open.lower[c]) - (c == 2 ? margin : 0);
        upper[c] = fmax(info.upper[c], info_open.upper[c]) + (c == 2 ? margin : 0);
        counts[c] = 1 + (int64_t)ceil((upper[c] - lower[c]) / spacing);
      }
      test_mesh nodes = lattice(counts, lower, upper);
      uint8_t *wanted = own(malloc((size_t)nodes.n));
      for (int64_t k = 0; k < nodes.n; ++k) {
        const double x = nodes.xyz[3 * k] - wall.x, y = nodes.xyz[3 * k + 1] - wall.y;
        wanted[k] = (uint8_t)is_inside(&wall, x, y);
      }
      keep(&nodes, wanted);
      const int bare_leaks = leaks(bare, &nodes);
      printf("%s, gap %.2f: %s without a skirt\n", skirted[kind], gaps[i], bare_leaks ? "leaks" : "closed");
      if (gaps[i] > 0.12) assert_true(bare_leaks); /* more than the half thickness */
      assert_false(leaks(sealed, &nodes));
      riis_surface_arrays arrays = given_back(bare, 0); /* as if the leaflets came from a file */
      arrays.skirt_length = gaps[i];
      options.triangulation = RIIS_TRIANGULATION_ADAPTED;
      assert_false(leaks(surface_from(&arrays, &options), &nodes));
      if (i == 3) assert_true(leaks(open, &nodes));
      free_owned_after(owned_before);
    }
}

/* Returns the length of a strip's longer side. All lines v of the strip are at most this long. */
static double longer_side(const riis_triangles *t, const double *xyz, int32_t patch) {
  double length[2] = {0, 0};
  for (int64_t i = 0; i < t->n_triangles; ++i)
    for (int k = 0; k < 3 && t->patch_id[i] == patch; ++k) {
      const int64_t a = t->vertex_id[3 * i + k], b = t->vertex_id[3 * i + (k + 1) % 3];
      for (int v = 0; v < 2; ++v)
        if (t->uv[2 * a + 1] == v && t->uv[2 * b + 1] == v) length[v] += distance_between(xyz + 3 * a, xyz + 3 * b);
    }
  return fmax(length[0], length[1]);
}

/* With a fixed triangulation, a vertex moves by its velocity times the step, plus a slide. Lines of mitral patches follow the
 * joints of the annulus, so the vertex's label changes. A velocity belongs to a constant label, so a velocity does not contain
 * the slide. */
TEST(skirts_move_with_the_attachment) {
  const double seconds = 0.1;
  for (int trial = 0; trial <= n_skirted; trial += trial_step()) {
    const int owned_before = n_owned();
    riis_surface_options options = random_placement(RIIS_TRIANGULATION_FIXED);
    options.tolerance = 0.005;
    riis_valve *before = skirted_valve(trial, 0.1, between(0, 0.3)), *now = skirted_valve(trial, 0.1, between(0.7, 1));
    riis_surface *surface = new_surface(before, &options);
    const kept_vertices was = vertices_of(surface);
    CHECK_OK(riis_surface_update_moving(surface, now, before, seconds, NULL, NULL));
    const riis_triangles is = triangles_of(surface);
    assert_int_equal(is.n_vertices, was.n);
    /* Both vertices lie on chords, which are within the tolerance of the smooth valve. */
    const double chords = 2 * info_of(surface).error_bound / seconds;
    double fastest = 0, worst = 0, slide = 0;
    for (int64_t t = 0; t < is.n_triangles; ++t)
      for (int k = 0; k < 3 && is.leaflet_id[t] == RIIS_LEAFLET_SKIRT; ++k) {
        const int64_t id = is.vertex_id[3 * t + k];
        double from[3] = {0, 0, 0}, wanted[3], displaced[3];
        assert_true(value_at_label(&is, was.uv, was.xyz, is.patch_id[t], is.uv + 2 * id, from));
        for (int c = 0; c < 3; ++c) {
          wanted[c] = (is.xyz[3 * id + c] - from[c]) / seconds;
          displaced[c] = (is.xyz[3 * id + c] - was.xyz[3 * id + c]) / seconds;
        }
        worst = fmax(worst, distance_between(wanted, is.velocity + 3 * id));
        fastest = fmax(fastest, length_of(wanted));
        const double slid = distance_between(displaced, is.velocity + 3 * id);
        const double shift = fabs(is.uv[2 * id] - was.uv[2 * id]);
        CHECK_AT_MOST(slid, chords + shift * longer_side(&is, was.xyz, is.patch_id[t]) / seconds);
        slide = fmax(slide, slid);
      }
    printf("%s: fastest %.3g, off by %.3g of at most %.3g, vertices slide by %.3g\n", skirted[trial], fastest, worst,
           chords, slide);
    CHECK_AT_MOST(worst, chords);
    CHECK_AT_MOST(worst, 0.001 * fastest);
    free_owned_after(owned_before);
  }
}

/* A wall: a tube with a straight axis, cut by planes at 0 and 1 along the axis. The wall's triangles have random diagonals. */
typedef struct tube_wall {
  axis_line axis; /* through the middle */
  double radius, half_length;
} tube_wall;

static void across(const double *direction, double *x, double *y) {
  const int least = fabs(direction[0]) < 0.6 ? 0 : 1;
  double unit[3] = {0, 0, 0};
  unit[least] = 1;
  const double along = dot(unit, direction);
  for (int c = 0; c < 3; ++c) x[c] = unit[c] - along * direction[c];
  const double size = length_of(x);
  for (int c = 0; c < 3; ++c) x[c] /= size;
  for (int c = 0; c < 3; ++c) y[c] = direction[(c + 1) % 3] * x[(c + 2) % 3] - direction[(c + 2) % 3] * x[(c + 1) % 3];
}

static riis_surface *wall_from(const tube_wall *tube_at) {
  enum { n_round = 600, n_along = 3 };
  static double xyz[3 * n_round * n_along];
  static int32_t ids[6 * n_round * (n_along - 1)];
  double x[3], y[3];
  across(tube_at->axis.direction, x, y);
  int64_t n = 0;
  for (int j = 0; j < n_along; ++j)
    for (int i = 0; i < n_round; ++i) {
      const double angle = 2 * acos(-1) * i / n_round, z = tube_at->half_length * (2.0 * j / (n_along - 1) - 1);
      for (int c = 0; c < 3; ++c)
        xyz[3 * (j * n_round + i) + c] = tube_at->axis.centre[c] + z * tube_at->axis.direction[c] +
                                         tube_at->radius * (cos(angle) * x[c] + sin(angle) * y[c]);
      if (j + 1 == n_along) continue;
      const int32_t a = j * n_round + i, b = j * n_round + (i + 1) % n_round, d = a + n_round, e = b + n_round;
      const int32_t two[2][6] = {{a, b, e, a, e, d}, {a, b, d, b, e, d}};
      memcpy(ids + 3 * n, two[one_in(2)], sizeof two[0]), n += 2;
    }
  const riis_surface_arrays arrays = triangle_arrays(n_round * n_along, xyz, n, ids);
  return surface_from(&arrays, NULL);
}

/* Returns the nearer of the two places where the line p + t d meets a round tube. */
static double distance_to_tube(const tube_wall *wall, const double *p, const double *d) {
  double q[3], e[3];
  const double *axis = wall->axis.direction;
  for (int c = 0; c < 3; ++c) q[c] = p[c] - wall->axis.centre[c], e[c] = d[c];
  const double along_q = dot(q, axis), along_e = dot(e, axis);
  for (int c = 0; c < 3; ++c) q[c] -= along_q * axis[c], e[c] -= along_e * axis[c];
  const double a = dot(e, e), b = dot(q, e), c = dot(q, q) - wall->radius * wall->radius;
  const double root = sqrt(b * b - a * c), first = (-b - root) / a, second = (-b + root) / a;
  return fabs(first) < fabs(second) ? first : second;
}

/* Makes a tube around a placed valve. The tube's axis is shifted and tilted relative to the valve's axis. */
static tube_wall tube_around(const riis_surface *surface, const axis_line *axis, double scale) {
  const riis_attachment held = attachment_of(surface);
  tube_wall made = {*axis, 0, 20 * scale};
  for (int c = 0; c < 3; ++c) {
    made.axis.centre[c] += between(-0.05, 0.05) * scale;
    made.axis.direction[c] += between(-0.05, 0.05);
  }
  const double size = length_of(made.axis.direction);
  for (int c = 0; c < 3; ++c) made.axis.direction[c] /= size;
  for (int64_t i = 0; i < 2 * held.n_edges; ++i) {
    double q[3];
    for (int c = 0; c < 3; ++c) q[c] = held.edges[3 * i + c] - made.axis.centre[c];
    const double along = dot(q, made.axis.direction);
    for (int c = 0; c < 3; ++c) q[c] -= along * made.axis.direction[c];
    made.radius = fmax(made.radius, length_of(q));
  }
  made.radius += 0.05 * scale;
  return made;
}

static riis_gap gap_between(const riis_surface *surface, const riis_surface *wall, double *distance) {
  riis_gap gap;
  memset(&gap, 0x5a, sizeof gap);
  CHECK_OK(riis_surface_get_gap(surface, wall, distance, &gap, sizeof gap));
  return gap;
}

/* Puts landmark n on a random vertex of the attachment. The landmark's target is at most `most` away along each axis. Returns the
 * number of new landmarks, which is 0 if the vertex is near an earlier landmark. */
static int add_landmark(const riis_attachment *held, int n, double most, double *sources, double *targets) {
  const double *p = held->edges + 3 * (int64_t)between(0, 2 * (double)held->n_edges - 0.5);
  double nearest = INFINITY;
  for (int k = 0; k < n; ++k) nearest = fmin(nearest, distance_between(p, sources + 3 * k));
  if (nearest < 0.25) return 0;
  for (int c = 0; c < 3; ++c) sources[3 * n + c] = p[c], targets[3 * n + c] = p[c] + between(-most, most);
  return 1;
}

/* Writes the control points of the valve's skirt, and returns their number. */
static int64_t skirt_points(riis_valve *valve, double *points) {
  riis_valve_patches patches;
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  int64_t n = 0;
  for (int64_t i = 0; i < patches.n_patches; ++i) {
    if (patches.leaflet_id[i] != RIIS_LEAFLET_SKIRT) continue;
    const int64_t outer = patches.curve_id[4 * i];
    int64_t first = 0, size = 0;
    for (int64_t piece = 0; piece < patches.first_piece[outer + 1]; ++piece)
      *(piece < patches.first_piece[outer] ? &first : &size) += patches.degree[piece] + 1;
    memcpy(points + 3 * n, patches.control + 3 * first, (size_t)size * 3 * sizeof *points);
    n += size;
    assert_true(n <= 1000);
  }
  return n;
}

/* Moves a warp from one time to another in n_steps steps. Returns the largest step of the skirt's points, and the time at which
 * it begins. */
static double largest_step(riis_valve *valve, riis_warp *warp, int n, const double *sources, const double *targets,
                           double from, double to, int n_steps, double *begins) {
  static double points[2][3000];
  double largest = 0;
  for (int i = 0; i <= n_steps; ++i) {
    const double time = from + (to - from) * i / n_steps;
    double at[3 * 14];
    for (int k = 0; k < 3 * n; ++k) at[k] = sources[k] + time * (targets[k] - sources[k]);
    riis_points now;
    CHECK_OK(riis_points_init(&now, sizeof now));
    now.n_points = n, now.stride = 3, now.x = at, now.y = at + 1, now.z = at + 2;
    CHECK_OK(riis_warp_set_targets(warp, &now));
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    const int64_t n_points = skirt_points(valve, points[i % 2]);
    assert_true(n_points > 100);
    for (int64_t k = 0; k < n_points && i > 0; ++k) {
      const double step = distance_between(points[0] + 3 * k, points[1] + 3 * k);
      if (step > largest) largest = step, *begins = time - (to - from) / n_steps;
    }
  }
  return largest;
}

/* A quadratic equation gives the gap to a round tube. A skirt to a round tube ends on the tube, and does not change the
 * leaflets. */
TEST(skirts_reach_walls_and_no_farther) {
  for (int trial = 0; trial < n_trials_of_kinds(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_skirted;
    riis_valve *valve = skirted_valve(kind, 0, 0);
    set_random_sizes(valve, kind);
    riis_surface_options options = random_placement(trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    const double s = options.scale;
    const riis_surface *bare = new_surface(valve, &options);
    const axis_line axis = axis_of(bare, kind, &options);
    const tube_wall round = tube_around(bare, &axis, s);
    const riis_surface *wall = wall_from(&round);
    const riis_attachment held = attachment_of(bare);
    double *distance = own(malloc((size_t)held.n_edges * 2 * sizeof *distance));
    const riis_gap gap = gap_between(bare, wall, distance);
    double least = INFINITY, most = -INFINITY, sum = 0, whole = 0;
    const double facets = 2 * round.radius * 2e-5; /* between the round tube and its facets */
    for (int64_t i = 0; i < 2 * held.n_edges; ++i) {
      const double *p = held.edges + 3 * i, *edge = held.edges + 6 * (i / 2);
      double out[3];
      outwards_from(&axis, p, out);
      const double wanted = distance_to_tube(&round, p, out), size = distance_between(edge, edge + 3);
      if (kind != 2) CHECK_NEAR(distance[i], wanted, facets);
      least = fmin(least, distance[i]), most = fmax(most, distance[i]), sum += size * distance[i], whole += size;
    }
    assert_int_equal(gap.n_ends, 2 * held.n_edges);
    assert_int_equal(gap.n_without_wall, 0);
    CHECK_NEAR(gap.least, least, 0);
    CHECK_NEAR(gap.most, most, 0);
    CHECK_NEAR(gap.mean, sum / whole, 1e-12 * s);
    assert_true(gap.least > 0.01 * s);

    CHECK_OK(riis_valve_set_skirt_to_wall(valve, wall, 2 * s, &options));
    double longest = 0;
    CHECK_OK(riis_valve_get(valve, "skirt_length", 1, &longest));
    CHECK_NEAR(longest * s, gap.most, 1e-2 * gap.most); /* at points other than the ends of edges */
    const riis_surface *reaching = new_surface(valve, &options);
    const riis_triangles all = triangles_of(reaching);
    double farthest = 0, worst = 0;
    for (int64_t t = 0; t < all.n_triangles; ++t)
      for (int k = 0; k < 3 && all.leaflet_id[t] == RIIS_LEAFLET_SKIRT; ++k) {
        const int64_t id = all.vertex_id[3 * t + k];
        const double *p = all.xyz + 3 * id;
        double q[3];
        for (int c = 0; c < 3; ++c) q[c] = p[c] - round.axis.centre[c];
        const double along = dot(q, round.axis.direction);
        for (int c = 0; c < 3; ++c) q[c] -= along * round.axis.direction[c];
        const double beyond = length_of(q) - round.radius;
        farthest = fmax(farthest, beyond);
        if (all.uv[2 * id + 1] == 0) worst = fmax(worst, fabs(beyond));
      }
    const double allowed = info_of(reaching).error_bound + 1e-3 * gap.most + facets;
    printf("%s: gap %.3g to %.3g, outer edge off the wall by %.2g of %.2g\n", skirted[kind], gap.least, gap.most, worst,
           allowed);
    CHECK_AT_MOST(worst, allowed);
    CHECK_AT_MOST(farthest, allowed);
    assert_true(all.n_triangles > triangles_of(bare).n_triangles);

    /* The skirt's lengths belong to the valve's shape. A copy of the valve has the skirt's lengths, and a fixed triangulation
     * refuses a valve whose skirt has other lengths. */
    riis_valve *copy = NULL;
    CHECK_OK(riis_valve_copy(valve, &copy));
    own(copy);
    assert_true(is_same_content(reaching, new_surface(copy, &options)));
    CHECK_OK(riis_valve_set_scalar(copy, "opening", 0.5));
    CHECK_OK(riis_surface_update((riis_surface *)(uintptr_t)reaching, copy, NULL));
    CHECK_OK(riis_valve_set_scalar(copy, "skirt_length", longest));
    if (options.triangulation == RIIS_TRIANGULATION_FIXED)
      CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the lengths of the skirt to the wall have changed",
                    riis_surface_update((riis_surface *)(uintptr_t)reaching, copy, NULL));
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0));
    assert_int_equal(triangles_of(new_surface(valve, &options)).n_triangles, triangles_of(bare).n_triangles);
    free_owned_after(owned_before);
  }
}

/* A funnel of four patches in a tilted frame, attached along a circle. */
static shape funnel(const double *centre, const double *direction, double radius) {
  enum { n = 3 };
  shape made = {0};
  double x[3], y[3], at[2][n][3], control[4][3];
  across(direction, x, y);
  const double step = 2 * acos(-1) / n, reach = 4.0 / 3 * tan(step / 4);
  for (int level = 0; level < 2; ++level)
    for (int i = 0; i < n; ++i) {
      const double r = level ? 0.4 * radius : radius;
      for (int k = 0; k < 4; ++k) {
        const double angle = step * (k < 2 ? i : i + 1), turn = k == 1 ? reach : k == 2 ? -reach : 0;
        for (int c = 0; c < 3; ++c)
          control[k][c] = centre[c] + (level ? radius : 0) * direction[c] +
                          r * ((cos(angle) - turn * sin(angle)) * x[c] + (sin(angle) + turn * cos(angle)) * y[c]);
      }
      memcpy(at[level][i], control[0], sizeof control[0]);
      add_curve(&made, 3, control);
    }
  for (int i = 0; i < n; ++i) {
    const double *a = at[0][i], *b = at[1][i];
    add_line(&made, a[0], a[1], a[2], b[0], b[1], b[2]);
  }
  for (int i = 0; i < n; ++i) {
    add_patch(&made, i, n + i, 2 * n + i, 2 * n + (i + 1) % n);
    made.leaflet_id[i] = 2 + i;
  }
  return made;
}

/* Patches in any frame get a flat ring as their skirt, because their attachment is a circle. */
TEST(patches_have_skirts_in_any_frame) {
  for (int trial = 0; trial < 4; ++trial) {
    const int owned_before = n_owned();
    const double centre[3] = {between(-5, 5), between(-5, 5), between(-5, 5)}, radius = between(0.5, 2);
    double direction[3] = {between(-1, 1), between(-1, 1), 1.2};
    const double size = length_of(direction), length = 0.2 * radius;
    for (int c = 0; c < 3; ++c) direction[c] /= size;
    const shape made = funnel(centre, direction, radius);
    riis_valve *valve = valve_from(&made);
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", length));
    riis_surface_options options = surface_options();
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    options.half_thickness = 0.05 * radius;
    const riis_surface *surface = new_surface(valve, &options);
    const riis_triangles all = triangles_of(surface);
    const double error = info_of(surface).error_bound + 1e-3 * radius;
    int n = 0;
    for (int64_t t = 0; t < all.n_triangles; ++t) {
      if (all.patch_id[t] < 3) continue;
      assert_int_equal(all.leaflet_id[t], 5);
      assert_in_range(all.patch_id[t], 3, 5);
      for (int k = 0; k < 3; ++k, ++n) {
        const double *p = all.xyz + 3 * all.vertex_id[3 * t + k];
        double q[3];
        for (int c = 0; c < 3; ++c) q[c] = p[c] - centre[c];
        const double along = dot(q, direction);
        CHECK_NEAR(along, 0, error);
        CHECK_NEAR(sqrt(dot(q, q) - along * along),
                   all.uv[2 * all.vertex_id[3 * t + k] + 1] == 1 ? radius : radius + length, error);
      }
    }
    assert_true(n > 30);
    free_owned_after(owned_before);
  }
}

TEST(wrong_skirts_are_refused) {
  riis_surface *surface = NULL;
  riis_valve *trileaflet = new_valve("trileaflet"), *bileaflet = new_valve("bileaflet");
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'skirt_length' is not a parameter of the bileaflet valve|ring_height",
                riis_valve_set_scalar(bileaflet, "skirt_length", 0.1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'skirt_length' is -0.1",
                riis_valve_set_scalar(trileaflet, "skirt_length", -0.1));
  CHECK_OK(riis_valve_set_scalar(trileaflet, "skirt_length", 1e-6));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "skirt_length is 1e-06|from 1e-04 to 10 times|attachment from its axis",
                riis_surface_create(trileaflet, NULL, &surface));
  CHECK_OK(riis_valve_set_scalar(trileaflet, "skirt_length", 20));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "skirt_length is 20", riis_surface_create(trileaflet, NULL, &surface));
  const shape square = unit_square();
  riis_valve *flat = valve_from(&square);
  CHECK_OK(riis_valve_set_scalar(flat, "skirt_length", 0.1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the attachment encloses no area", riis_surface_create(flat, NULL, &surface));

  CHECK_OK(riis_valve_set_scalar(trileaflet, "skirt_length", 0));
  const riis_surface *bare = new_surface(trileaflet, NULL);
  const tube_wall round = {{{0, 0, 0}, {0, 0, 1}}, 1.5, 5}, low = {{{0, 0, 0}, {0, 0, 1}}, 1.5, 0.5};
  const riis_surface *wall = wall_from(&round);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the bileaflet valve has no skirt|ring_height",
                riis_valve_set_skirt_to_wall(bileaflet, wall, 1, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_valve_set_skirt_to_wall(NULL, wall, 1, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "wall is NULL", riis_valve_set_skirt_to_wall(trileaflet, NULL, 1, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "longest is 0", riis_valve_set_skirt_to_wall(trileaflet, wall, 0, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "wall is not within longest, 0.1|points of the attachment",
                riis_valve_set_skirt_to_wall(trileaflet, wall, 0.1, NULL));
  riis_surface_options options = surface_options();
  options.scale = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.scale is 0",
                riis_valve_set_skirt_to_wall(trileaflet, wall, 1, &options));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the attachment encloses no area",
                riis_valve_set_skirt_to_wall((riis_valve_set_scalar(flat, "skirt_length", 0), flat), wall, 1, NULL));
  const riis_surface *short_wall = wall_from(&low);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "wall is not within longest|it is missed",
                riis_valve_set_skirt_to_wall(trileaflet, short_wall, 1, NULL));
  double length = 1;
  CHECK_OK(riis_valve_get(trileaflet, "skirt_length", 1, &length));
  CHECK_NEAR(length, 0, 0);

  riis_gap gap;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL", riis_surface_get_gap(NULL, wall, NULL, &gap, sizeof gap));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "wall is NULL", riis_surface_get_gap(bare, NULL, NULL, &gap, sizeof gap));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "gap is NULL", riis_surface_get_gap(bare, wall, NULL, NULL, sizeof gap));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "gap is 8", riis_surface_get_gap(bare, wall, NULL, &gap, 8));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface was made from arrays|its attached edges are not known",
                riis_surface_get_gap(wall, wall, NULL, &gap, sizeof gap));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface has no attachment",
                riis_surface_get_gap(surface_of_kind("bileaflet", NULL), wall, NULL, &gap, sizeof gap));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "encloses no area",
                riis_surface_get_gap(new_surface(flat, NULL), wall, NULL, &gap, sizeof gap));
  /* A wall that is too short is missed at the commissures. A wall that is too narrow is inside the attachment. */
  gap = gap_between(bare, short_wall, NULL);
  assert_true(gap.n_without_wall > 0 && gap.n_without_wall < gap.n_ends);
  const tube_wall narrow = {{{0, 0, 0}, {0, 0, 1}}, 0.9, 5};
  const riis_surface *inside = wall_from(&narrow);
  gap = gap_between(bare, inside, NULL);
  assert_true(gap.most < 0);
  CHECK_OK(riis_valve_set_skirt_to_wall(trileaflet, inside, 1, NULL));
  CHECK_OK(riis_valve_get(trileaflet, "skirt_length", 1, &length));
  CHECK_NEAR(length, 0.01 * 1.25, 0.001); /* of the attachment's mean distance from the axis */
  new_surface(trileaflet, NULL);
}

/* If a wall cuts the valve, it is nearer than the attachment in some places. The skirt is thin where the wall is nearer than the
 * attachment, and longer elsewhere. */
TEST(skirts_to_cutting_walls_cross_nothing) {
  static const char *const kinds[] = {"coapting", "trileaflet", "aortic", "mitral"};
  static const int as_kind[] = {0, 0, 2, 1}; /* the position in `skirted` of a kind with the same axis */
  const int n_trials = trials(8, 400);
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  int n_cut = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const int owned_before = n_owned();
    riis_surface_options options = random_placement(RIIS_TRIANGULATION_ADAPTED);
    riis_valve *valve = new_valve(kinds[trial % 4]);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    const riis_surface *bare = new_surface(valve, &options);
    const axis_line axis = axis_of(bare, as_kind[trial % 4], &options);
    tube_wall round = tube_around(bare, &axis, options.scale);
    round.radius -= between(0.05, 0.2) * options.scale;
    const riis_surface *wall = wall_from(&round);
    const riis_gap gap = gap_between(bare, wall, NULL);
    n_cut += gap.least < 0 && gap.most > 0;
    CHECK_OK(riis_valve_set_skirt_to_wall(valve, wall, 9 * options.scale, &options));
    for (int i = 0; i <= 10; i += is_long_test() ? 1 : 5) {
      const int owned_in_trial = n_owned();
      CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.1 * i));
      const riis_surface *surface = new_surface(valve, &options);
      const pair_counts counts = crossings_of(surface, crossings);
      if (counts.of_skirt + counts.of_own > 0)
        fail_msg("%s, opening %g: %d pairs with the skirt cross, gap %g to %g", kinds[trial % 4], 0.1 * i,
                 (int)(counts.of_skirt + counts.of_own), gap.least, gap.most);
      free_owned_after(owned_in_trial);
    }
    free_owned_after(owned_before);
  }
  printf("%d of %d walls cut the valve\n", n_cut, n_trials);
  CHECK_MET(n_cut > n_trials / 4);
}

/* The cusps of a warped aortic valve are not joined at the commissures, so their skirts end beside each other. A violent warp may
 * make the cusps go through each other, or fold a patch onto its skirt. The test does not judge the skirts of a violent warp. */
TEST(skirts_of_warped_cusps_cross_nothing) {
  const int n_trials = trials(6, 100);
  int n_states = 0, n_judged = 0, n_own = 0;
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  for (int trial = 0; trial < n_trials; ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = skirted_valve(2, 0, 0);
    const riis_attachment held = attachment_of(new_surface(valve, NULL));
    double sources[3 * 12], targets[3 * 12];
    int n = 0;
    while (n < 12) n += add_landmark(&held, n, 0.09, sources, targets);
    riis_points from, to;
    CHECK_OK(riis_points_init(&from, sizeof from));
    from.n_points = n, from.stride = 3, from.x = sources, from.y = sources + 1, from.z = sources + 2;
    to = from, to.x = targets, to.y = targets + 1, to.z = targets + 2;
    riis_warp *warp = NULL;
    CHECK_OK(riis_warp_create(&from, NULL, &warp));
    own(warp);
    /* If the warp folds, the landmarks move half as far. */
    while (riis_warp_set_targets(warp, &to) != RIIS_OK) {
      assert_non_null(strstr(riis_last_error(), "folds"));
      for (int k = 0; k < 3 * n; ++k) targets[k] = 0.5 * (sources[k] + targets[k]);
    }
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", between(0.1, 0.3)));
    for (int i = 0; i <= 10; i += is_long_test() ? 1 : 5) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.1 * i));
      riis_surface_options options = surface_options();
      options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
      const riis_surface *surface = new_surface(valve, &options);
      ++n_states;
      const pair_counts counts = crossings_of(surface, crossings);
      n_own += counts.of_own > 0;
      if (counts.of_leaflets > 0) continue;
      ++n_judged;
      if (counts.of_skirt > 0)
        fail_msg("trial %d, opening %g: %d pairs with the skirt cross", trial, 0.1 * i, (int)counts.of_skirt);
    }
    free_owned_after(owned_before);
  }
  printf("%d of %d states have cusps that do not cross; in %d a cusp lies along its own skirt\n", n_judged, n_states,
         n_own);
  CHECK_MET(n_judged > 0.9 * n_states);
}

/* The ends of two cusps move past each other, and the line between them turns. A jump of the skirt would stay as large in a 64th
 * of the step. */
TEST(skirts_move_continuously_with_a_warp) {
  const int n_trials = trials(4, 60);
  int n_turned = 0; /* by more than 45 degrees */
  for (int trial = 0; trial < n_trials; ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = skirted_valve(2, between(0.1, 0.3), between(0, 1));
    const riis_attachment held = attachment_of(new_surface(valve, NULL));
    double sources[3 * 14], targets[3 * 14];
    /* The first two landmarks are the ends of two cusps at a commissure: the highest vertices of the cusps' sides. */
    const double *top[3] = {NULL, NULL, NULL};
    const int left = one_in(2) ? 1 : 2;
    for (int64_t i = 0; i < 2 * held.n_edges; ++i) {
      const double *p = held.edges + 3 * i;
      const int32_t cusp = held.leaflet_id[i / 2], patch = held.patch_id[i / 2] % 4;
      const int32_t wanted = (cusp == 0) == (left == 1) ? 1 : 3; /* the half cusp at the commissure */
      if ((cusp == 0 || cusp == left) && patch == wanted && (!top[cusp] || p[2] > top[cusp][2])) top[cusp] = p;
    }
    int n = 0;
    for (int cusp = 0; cusp < 3; ++cusp) {
      if (cusp != 0 && cusp != left) continue;
      memcpy(sources + 3 * n, top[cusp], 3 * sizeof *sources);
      const double r = hypot(sources[3 * n], sources[3 * n + 1]),
                   by = (cusp == 0 ? 0.08 : -0.08) * (left == 1 ? 1 : -1);
      targets[3 * n] = sources[3 * n] - by * sources[3 * n + 1] / r;
      targets[3 * n + 1] = sources[3 * n + 1] + by * sources[3 * n] / r;
      targets[3 * n + 2] = sources[3 * n + 2];
      ++n;
    }
    assert_true(distance_between(sources, sources + 3) < 0.2);
    while (n < 12) n += add_landmark(&held, n, 0.02, sources, targets);
    riis_points from;
    CHECK_OK(riis_points_init(&from, sizeof from));
    from.n_points = n, from.stride = 3, from.x = sources, from.y = sources + 1, from.z = sources + 2;
    riis_warp *warp = NULL;
    CHECK_OK(riis_warp_create(&from, NULL, &warp));
    own(warp);
    /* If the warp folds, the landmarks move half as far. */
    int is_fine = 0;
    while (!is_fine) {
      is_fine = 1;
      for (int quarter = 1; quarter <= 4 && is_fine; ++quarter) {
        double at[3 * 14];
        for (int k = 0; k < 3 * n; ++k) at[k] = sources[k] + 0.25 * quarter * (targets[k] - sources[k]);
        riis_points now = from;
        now.x = at, now.y = at + 1, now.z = at + 2;
        riis_valve_patches patches;
        is_fine = riis_warp_set_targets(warp, &now) == RIIS_OK;
        if (!is_fine) continue;
        CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
        is_fine = riis_valve_get_patches(valve, &patches, sizeof patches) == RIIS_OK;
      }
      for (int k = 0; k < 3 * n && !is_fine; ++k) targets[k] = 0.5 * (sources[k] + targets[k]);
    }
    const double turned[2] = {targets[3] - targets[0], targets[4] - targets[1]};
    const double was[2] = {sources[3] - sources[0], sources[4] - sources[1]};
    n_turned += turned[0] * was[0] + turned[1] * was[1] < 0.7 * hypot(turned[0], turned[1]) * hypot(was[0], was[1]);
    const int n_steps = is_short_test() ? 5 : 50, n_parts = 64;
    double begins = 0, unused;
    const double step = largest_step(valve, warp, n, sources, targets, 0, 1, n_steps, &begins);
    const double part =
        largest_step(valve, warp, n, sources, targets, begins, begins + 1.0 / n_steps, n_parts, &unused);
    printf("the largest step is %.3g, and %.3g in its parts\n", step, part);
    CHECK_AT_MOST(part, 0.1 * step);
    free_owned_after(owned_before);
  }
  printf("%d of %d lines between ends turn by more than 45 degrees\n", n_turned, n_trials);
  CHECK_MET(n_turned > 0);
}

static int start(void **state) {
  (void)state;
  rng = random_start("test_skirt");
  return 0;
}

int main(void) { return run_cases(start, NULL); }
