/* SPDX-License-Identifier: Apache-2.0
 * Tests exact properties of coapting valves (docs/theory/coapting.md). The valves have two to four cusps, unequal cusps, fused
 * commissures and bumps. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "cusp_checks.h"

typedef struct point {
  double x[3];
} point;
typedef struct cubic {
  point q[4];
} cubic;

enum { v0, v1, u0, u1 };

static const char *const kinds[3] = {"bicuspid", "coapting", "quadricuspid"};
static int n_cusps_of(int kind) { return kind + 2; }

static void set_of(riis_valve *valve, const char *owner, int number, const char *name, double value) {
  char text[64];
  snprintf(text, sizeof text, "%s_%d.%s", owner, number, name);
  CHECK_OK(riis_valve_set_scalar(valve, text, value));
}

static riis_valve_patches patches_of(riis_valve *valve, double opening) {
  riis_valve_patches patches;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  return patches;
}

static int64_t patch_of(const riis_valve_patches *patches, int32_t patch_id) {
  int64_t patch = 0;
  while (patches->patch_id[patch] != patch_id) assert_true(++patch < patches->n_patches);
  return patch;
}

/* Returns the last span of a side, in the direction of the curve, as a cubic. The degree of a quadratic is raised to three. */
static cubic side_of(const riis_valve_patches *patches, int32_t patch_id, int side) {
  const int64_t curve = patches->curve_id[4 * patch_of(patches, patch_id) + side];
  const int64_t piece = patches->first_piece[curve + 1] - 1;
  const double *control = patches->control;
  for (int64_t i = 0; i < piece; ++i) control += 3 * (patches->degree[i] + 1);
  point q[4];
  memcpy(q, control, sizeof(point) * (size_t)(patches->degree[piece] + 1));
  if (patches->degree[piece] == 3) return (cubic){{q[0], q[1], q[2], q[3]}};
  cubic raised = {{q[0], q[0], q[2], q[2]}};
  for (int c = 0; c < 3; ++c) {
    raised.q[1].x[c] = (q[0].x[c] + 2 * q[1].x[c]) / 3;
    raised.q[2].x[c] = (2 * q[1].x[c] + q[2].x[c]) / 3;
  }
  return raised;
}

static double apart(point a, point b) { return hypot(hypot(a.x[0] - b.x[0], a.x[1] - b.x[1]), a.x[2] - b.x[2]); }

static double length_of_derivative(const cubic *curve, double t) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    double d[3];
    for (int i = 0; i < 3; ++i) d[i] = curve->q[i + 1].x[c] - curve->q[i].x[c];
    const double s = 3 * ((1 - t) * (1 - t) * d[0] + 2 * t * (1 - t) * d[1] + t * t * d[2]);
    sum += s * s;
  }
  return sqrt(sum);
}

/* The length of the free edge by the rule of docs/theory/coapting.md, "How it opens". */
static double length_by_rule(const cubic *curve) {
  static const double at[4] = {0.06943184420297371239, 0.33000947820757186760, 0.66999052179242813240,
                               0.93056815579702628761};
  static const double weight[4] = {0.17392742256872692869, 0.32607257743127307131, 0.32607257743127307131,
                                   0.17392742256872692869};
  double sum = 0;
  for (int i = 0; i < 16; ++i)
    for (int k = 0; k < 4; ++k) sum += weight[k] / 16 * length_of_derivative(curve, (i + at[k]) / 16);
  return sum;
}

/* The length of the part of a free edge that opens. */
static double free_length(const riis_valve_patches *patches, int cusp) {
  const cubic edges[2] = {side_of(patches, 4 * cusp + 1, v1), side_of(patches, 4 * cusp + 3, v1)};
  return length_by_rule(&edges[0]) + length_by_rule(&edges[1]);
}

/* Sets random sizes of the whole valve. A valve of this kind accepts nearly all such sizes. */
static void set_sizes(random_source *random, riis_valve *valve) {
  const double rc = random_between(random, 1.1, 1.4), h = rc * random_between(random, 1.35, 1.5);
  CHECK_OK(riis_valve_set_scalar(valve, "root_radius", rc * random_between(random, 0.95, 1.05)));
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_radius", rc));
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_height", h));
  CHECK_OK(riis_valve_set_scalar(valve, "coaptation_height", rc * random_between(random, 0.25, 0.32)));
  CHECK_OK(riis_valve_set_scalar(valve, "belly", random_between(random, 0.4, 0.55)));
}

/* Gives each cusp and each commissure separate sizes, within a share of the defaults. */
static void set_own_sizes(random_source *random, riis_valve *valve, int n_cusps, double share) {
  double h, h_e;
  CHECK_OK(riis_valve_get(valve, "commissure_height", 1, &h));
  CHECK_OK(riis_valve_get(valve, "effective_height", 1, &h_e));
  for (int k = 0; k < n_cusps; ++k) {
    set_of(valve, "cusp", k, "sector", 360.0 / n_cusps * random_between(random, 1 - share, 1 + share));
    set_of(valve, "cusp", k, "effective_height", h_e * random_between(random, 1 - share / 4, 1 + share / 4));
    set_of(valve, "cusp", k, "open_radius_ratio", random_between(random, 0.7, 0.9));
    set_of(valve, "commissure", k, "height", h * random_between(random, 1 - share / 4, 1 + share / 4));
  }
}

/* Returns a valve of the kind with unequal cusps that the library accepts. The commissures are fused if `fusion` is not 0. */
static riis_valve *unequal_valve(random_source *random, int kind, double fusion) {
  for (;;) {
    riis_valve *valve = new_valve(kinds[kind]);
    riis_surface *surface = NULL;
    set_sizes(random, valve);
    set_own_sizes(random, valve, n_cusps_of(kind), 0.15);
    if (fusion > 0) set_of(valve, "commissure", 0, "fusion", fusion);
    const riis_status status = riis_surface_create(valve, NULL, &surface);
    riis_surface_destroy(&surface);
    if (status == RIIS_OK) return valve;
    assert_int_equal(status, RIIS_INVALID_PARAMETER);
    free_one_owned(valve);
  }
}

/* A bump without effect gives each cusp separate patches. The separate patches lie where the images of equal cusps lie. */
TEST(equal_cusps_are_where_their_own_patches_would_be) {
  random_source random = random_start("test_unequal_cusps");
  for (int trial = 0; trial < trials_of(9); ++trial) {
    const int kind = trial % 3;
    riis_valve *images = new_valve(kinds[kind]), *own_patches = NULL;
    set_sizes(&random, images);
    if (trial % 2)
      for (int k = 0; k < n_cusps_of(kind); ++k) set_of(images, "commissure", k, "fusion", 0.25);
    CHECK_OK(riis_valve_copy(images, &own_patches));
    own(own_patches);
    set_of(own_patches, "bump", 0, "leaflet", 0);
    for (int i = 0; i <= 4; ++i) {
      const riis_valve_patches a = patches_of(images, i / 4.0), b = patches_of(own_patches, i / 4.0);
      assert_int_equal(a.n_patches, b.n_patches);
      for (int64_t patch = 0; patch < a.n_patches; ++patch)
        for (int side = v0; side <= u1; ++side) {
          const cubic p = side_of(&a, a.patch_id[patch], side), q = side_of(&b, a.patch_id[patch], side);
          for (int k = 0; k < 4; ++k) CHECK_AT_MOST(apart(p.q[k], q.q[k]), 1e-13);
        }
    }
  }
}

/* Sectors are scaled to a sum of 360 degrees. Sizes of a cusp may equal those of the valve. */
TEST(equal_sizes_by_other_names_are_the_same_valve) {
  for (int kind = 0; kind < 3; ++kind) {
    riis_valve *plain = valve_at(kinds[kind], 0.6), *other = valve_at(kinds[kind], 0.6);
    for (int k = 0; k < n_cusps_of(kind); ++k) {
      double h;
      set_of(other, "cusp", k, "sector", 77);
      CHECK_OK(riis_valve_get(plain, "effective_height", 1, &h));
      set_of(other, "cusp", k, "effective_height", h);
      CHECK_OK(riis_valve_get(plain, "commissure_height", 1, &h));
      set_of(other, "commissure", k, "height", h);
    }
    assert_true(is_same_content(new_surface(plain, NULL), new_surface(other, NULL)));
    double value;
    CHECK_OK(riis_valve_get(other, "cusp_1.sector", 1, &value));
    CHECK_SAME(value, 77);
    CHECK_OK(riis_valve_get(plain, "cusp_1.sector", 1, &value));
    CHECK_SAME(value, 360.0 / n_cusps_of(kind));
    CHECK_OK(riis_valve_set_scalar(plain, "effective_height", 0.95));
    CHECK_OK(riis_valve_get(plain, "cusp_1.effective_height", 1, &value));
    CHECK_SAME(value, 0.95);
  }
}

/* The length of cusp 0's symmetry curve, from the root to the free edge. */
static double geometric_height(riis_valve *valve) {
  const riis_valve_patches closed = patches_of(valve, 0);
  const cubic below = side_of(&closed, 0, u0), zone = side_of(&closed, 1, u0);
  return length_by_rule(&below) + length_by_rule(&zone);
}

/* In 286 patients, surgeons measured 2.38 +- 0.20 cm, from 1.5 to 3 cm (docs/theory/coapting.md). Cusps grow with the root. */
TEST(bicuspid_cusps_are_as_high_as_those_of_patients) {
  riis_valve *usual = new_valve("bicuspid"), *dilated = new_valve("bicuspid");
  CHECK_OK(riis_valve_set_scalar(usual, "annulus", 2.7));
  CHECK_OK(riis_valve_set_scalar(dilated, "annulus", 3));
  CHECK_OK(riis_valve_set_scalar(dilated, "stj", 3.3));
  printf("geometric height of bicuspid valves: %.2f cm, in a dilated root %.2f cm\n", geometric_height(usual),
         geometric_height(dilated));
  CHECK_NEAR(geometric_height(usual), 1.91, 0.005);
  CHECK_NEAR(geometric_height(dilated), 2.38, 0.2);
}

/* The free edge keeps its length, or grows by edge_stretch in proportion to the opening. */
TEST(free_edges_keep_their_length) {
  random_source random = random_start("test_unequal_cusps");
  double worst = 0;
  for (int trial = 0; trial < trials_of(18); ++trial) {
    const int owned_before = n_owned(), kind = trial % 3;
    riis_valve *valve = unequal_valve(&random, kind, trial % 2 ? 0.3 : 0);
    double stretch;
    CHECK_OK(riis_valve_get(valve, "edge_stretch", 1, &stretch));
    double at_rest[4];
    for (int i = 0; i <= 10; ++i) {
      const riis_valve_patches patches = patches_of(valve, i / 10.0);
      for (int k = 0; k < n_cusps_of(kind); ++k) {
        const double length = free_length(&patches, k);
        if (i == 0) at_rest[k] = length;
        worst = fmax(worst, fabs(length / (at_rest[k] * (1 + stretch * i / 10)) - 1));
      }
    }
    free_owned_after(owned_before);
  }
  printf("free edges keep their length to %.1e\n", worst);
  CHECK_AT_MOST(worst, 1e-12);
}

/* The sag of the open edge's inner control point by a commissure, as a share of the sag of the middle. */
static double sag_by_commissure(riis_valve *valve, int cusp) {
  const riis_valve_patches open = patches_of(valve, 1);
  const cubic edge = side_of(&open, 4 * cusp + 1, v1);
  return (edge.q[3].x[2] - edge.q[2].x[2]) / (edge.q[3].x[2] - edge.q[0].x[2]);
}

/* The lower a cusp is, the flatter its edge leaves the commissures, without a jump. The cusp does not fold, and its edge keeps
 * its length. Its neighbours stay as they are. */
TEST(cusps_near_a_fold_leave_their_commissures_flatter) {
  riis_valve *valve = new_valve("coapting");
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  CHECK_OK(riis_valve_set_scalar(valve, "edge_rise", 0));
  set_of(valve, "cusp", 1, "coaptation_height", 0.1);
  double last = 1.0 / 3;
  int n_flatter = 0;
  for (int step = 0; step <= 40; ++step) {
    set_of(valve, "cusp", 1, "effective_height", 0.54 - 0.004 * step);
    const double sag = sag_by_commissure(valve, 1);
    if (step == 0) CHECK_NEAR(sag, 1.0 / 3, 1e-12);
    CHECK_AT_MOST(sag, last + 1e-12);
    CHECK_AT_MOST(last - sag, 0.05);
    n_flatter += sag < last - 1e-3;
    last = sag;
    CHECK_NEAR(sag_by_commissure(valve, 0), 1.0 / 3, 1e-12);
  }
  printf("%d of 40 lower cusps leave their commissures flatter, the last with a sag of %.3f\n", n_flatter, last);
  CHECK_MET(n_flatter > 5 && last >= 0 && last < 0.25);
  const riis_valve_patches closed = patches_of(valve, 0);
  const double length = free_length(&closed, 1);
  for (int i = 0; i <= 10; ++i) {
    riis_crossing_list list;
    const riis_valve_patches patches = patches_of(valve, i / 10.0);
    CHECK_NEAR(free_length(&patches, 1), length, 1e-12 * length);
    CHECK_OK(riis_find_crossings(new_surface(valve, NULL), NULL, crossings));
    CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
    assert_int_equal(list.n_pairs, 0);
  }
}

static int is_same_point(const double *a, const double *b) { return memcmp(a, b, 3 * sizeof *a) == 0; }

/* The halves of a cusp have the same bits in its symmetry plane, and so have neighbouring cusps at their commissure. */
TEST(neighbours_share_their_points) {
  random_source random = random_start("test_unequal_cusps");
  for (int trial = 0; trial < trials_of(12); ++trial) {
    const int owned_before = n_owned(), kind = trial % 3, n = n_cusps_of(kind);
    riis_valve *valve = unequal_valve(&random, kind, trial % 2 ? 0.3 : 0);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", random_between(&random, 0, 1)));
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", trial % 4 < 2 ? 0 : 0.2));
    const riis_triangles all = triangles_of(new_surface(valve, NULL));
    /* The ends of the attachments at the commissures, which must be equal in both neighbours. */
    double commissures[4][3];
    int is_known[4] = {0, 0, 0, 0}, n_checked = 0;
    for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
      const int32_t patch = all.patch_id[i / 3];
      const int64_t v = all.vertex_id[i];
      const int has_end = patch >= 4 * n ? patch < 8 * n : 1;
      if (!has_end || patch % 2 == 0 || all.uv[2 * v] != 1 || all.uv[2 * v + 1] != 1) continue;
      const int cusp = patch / 4 % n, commissure = patch % 4 == 1 ? cusp : (cusp + n - 1) % n;
      const double *p = all.xyz + 3 * v;
      if (patch < 4 * n && trial % 2 && commissure == 0) continue; /* the end of a free part */
      if (is_known[commissure]) assert_true(is_same_point(commissures[commissure], p)), ++n_checked;
      memcpy(commissures[commissure], p, sizeof commissures[0]), is_known[commissure] = 1;
    }
    assert_true(n_checked >= n);
    for (int k = 0; k < n; ++k) assert_true(is_known[k]);
    /* Both halves of a cusp have the same curves in the symmetry plane. */
    const riis_valve_patches patches = patches_of(valve, 0.5);
    for (int k = 0; k < n; ++k)
      for (int part = 0; part < 2; ++part) {
        const int64_t here = patch_of(&patches, 4 * k + part), there = patch_of(&patches, 4 * k + 2 + part);
        /* In the mirrored half, u is reversed. */
        assert_int_equal(patches.curve_id[4 * here + u0], patches.curve_id[4 * there + u1]);
        const cubic a = side_of(&patches, 4 * k + part, v1), b = side_of(&patches, 4 * k + 2 + part, v1);
        assert_true(is_same_point(a.q[0].x, b.q[0].x));
      }
    free_owned_after(owned_before);
  }
}

/* Seen along the axis, the attachment is near the cylinder. docs/theory/coapting.md gives the distance for attachments of one and
 * of two spans. */
TEST(attachments_are_on_the_cylinder) {
  for (double sector = 120; sector <= 240; sector += 5) {
    riis_valve *valve = new_valve("bicuspid");
    set_of(valve, "cusp", 0, "sector", sector);
    set_of(valve, "cusp", 1, "sector", 360 - sector);
    const riis_triangles all = triangles_of(new_surface(valve, NULL));
    double worst = 0;
    for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
      const int64_t v = all.vertex_id[i];
      if (all.patch_id[i / 3] % 2 == 1 || all.uv[2 * v] != 1) continue;
      worst = fmax(worst, fabs(hypot(all.xyz[3 * v], all.xyz[3 * v + 1]) / 1.25 - 1));
    }
    printf("sectors %.0f and %.0f: the attachment is off the cylinder by %.2f %%\n", sector, 360 - sector, 100 * worst);
    CHECK_AT_MOST(worst, 0.032);
    if (sector == 240) CHECK_AT_MOST(worst, 0.004);
  }
}

/* Returns the length of half an open free edge without sag. The length is measured along chords. docs/theory/coapting.md has the
 * formulas. */
static double open_length(double ratio, double radius, double half_sector, double expansion) {
  const double s = sin(half_sector), c = cos(half_sector), w = 4 / 3.0 * tan(half_sector / 4) * radius;
  const double flat = fmin(1, fmax(0, (ratio - c) / (1 - c) / 0.7)), near = fmax(0, 1 - fabs(c - 0.5) / 0.22);
  const double k = fmax(flat, near), x = (1 + expansion) * radius * c, y = (1 + expansion) * radius * s;
  const double q[4][2] = {{ratio * radius, 0}, {ratio * radius, w}, {x + w * k * s, y - w * (k * c + 1 - k)}, {x, y}};
  double length = 0, last[2] = {q[0][0], 0};
  for (int i = 1; i <= 20000; ++i) {
    const double t = i / 20000.0, b[4] = {pow(1 - t, 3), 3 * t * pow(1 - t, 2), 3 * t * t * (1 - t), t * t * t};
    double p[2] = {0, 0};
    for (int k4 = 0; k4 < 4; ++k4)
      for (int d = 0; d < 2; ++d) p[d] += b[k4] * q[k4][d];
    length += hypot(p[0] - last[0], p[1] - last[1]);
    memcpy(last, p, sizeof last);
  }
  return length;
}

/* A wide cusp opens like a fish's mouth, until 0.97 of its edge's length is used. */
TEST(wide_cusps_open_as_far_as_their_edge_allows) {
  static const double sectors[3] = {180, 160, 220}, stretches[3] = {0, 0.1, 0.05};
  for (int trial = 0; trial < 3; ++trial) {
    riis_valve *valve = new_valve("bicuspid");
    set_of(valve, "cusp", 0, "sector", sectors[trial]);
    set_of(valve, "cusp", 1, "sector", 360 - sectors[trial]);
    CHECK_OK(riis_valve_set_scalar(valve, "edge_stretch", stretches[trial]));
    const riis_valve_patches closed = patches_of(valve, 0);
    const double length = (1 + stretches[trial]) * free_length(&closed, 0) / 2;
    double low = 0.01, high = 0.85;
    for (int i = 0; i < 40; ++i) {
      const double middle = (low + high) / 2;
      *(open_length(middle, 1.25, sectors[trial] / 2 * cusp_degree, 0.05) <= 0.97 * length ? &low : &high) = middle;
    }
    const riis_valve_patches open = patches_of(valve, 1);
    printf("sector %.0f, stretch %.2f: the ratio is %.4f\n", sectors[trial], stretches[trial], low);
    CHECK_NEAR(side_of(&open, 1, v1).q[0].x[0] / 1.25, low, 1e-6);
  }
}

/* The free part and the fused part together form the closed edge of the healthy valve. The fused part follows the present
   commissure. */
TEST(fused_parts_stay_as_in_the_closed_valve) {
  for (int kind = 0; kind < 3; ++kind) {
    const int n = n_cusps_of(kind);
    const double fusion = 0.35;
    riis_valve *healthy = new_valve(kinds[kind]), *fused = new_valve(kinds[kind]);
    set_of(fused, "commissure", 0, "fusion", fusion);
    const riis_valve_patches whole = patches_of(healthy, 0), rest = patches_of(fused, 0);
    const cubic edge = side_of(&whole, 1, v1), free_part = side_of(&rest, 1, v1), end = side_of(&rest, 4 * n + 1, v1);
    for (int c = 0; c < 3; ++c) { /* de Casteljau */
      CHECK_NEAR(free_part.q[0].x[c], edge.q[0].x[c], 1e-14);
      CHECK_NEAR(free_part.q[1].x[c], fusion * edge.q[0].x[c] + (1 - fusion) * edge.q[1].x[c], 1e-14);
      CHECK_NEAR(end.q[2].x[c], fusion * edge.q[2].x[c] + (1 - fusion) * edge.q[3].x[c], 1e-14);
      CHECK_NEAR(end.q[3].x[c], edge.q[3].x[c], 1e-14);
      CHECK_NEAR(end.q[0].x[c], free_part.q[3].x[c], 1e-14);
    }
    const cubic before[2] = {side_of(&rest, 4 * n, v1), end};
    const riis_valve_patches open = patches_of(fused, 1);
    for (int patch = 0; patch < 2; ++patch) {
      const cubic after = side_of(&open, 4 * n + patch, v1);
      for (int k = 0; k < 4; ++k)
        for (int c = 0; c < 3; ++c)
          CHECK_NEAR(after.q[k].x[c] - before[patch].q[k].x[c], after.q[3].x[c] - before[patch].q[3].x[c], 1e-14);
    }
  }
}

/* A bump changes the states of its leaflet, and leaves other leaflets unchanged. */
TEST(bumps_mix_the_two_states) {
  static const double shares[2] = {0.2, 0.6};
  for (int kind = 0; kind < 3; ++kind) {
    riis_valve *healthy = new_valve(kinds[kind]), *sick = new_valve(kinds[kind]);
    set_of(healthy, "bump", 0, "leaflet", 1);
    set_of(sick, "bump", 0, "leaflet", 1);
    set_of(sick, "bump", 0, "closed", shares[0]);
    set_of(sick, "bump", 0, "open", shares[1]);
    double x[2];
    for (int i = 0; i < 2; ++i) {
      const riis_valve_patches patches = patches_of(healthy, i);
      const cubic edge = side_of(&patches, 5, v1);
      x[i] = hypot(edge.q[0].x[0], edge.q[0].x[1]);
    }
    for (int i = 0; i < 2; ++i) {
      const riis_valve_patches patches = patches_of(sick, i);
      const cubic edge = side_of(&patches, 5, v1);
      CHECK_NEAR(hypot(edge.q[0].x[0], edge.q[0].x[1]), (1 - shares[i]) * x[0] + shares[i] * x[1], 1e-14);
      cubic of_sick[4], of_healthy[4];
      for (int k = 0; k < 4; ++k) of_sick[k] = side_of(&patches, 0, k);
      const riis_valve_patches of = patches_of(healthy, i);
      for (int k = 0; k < 4; ++k) of_healthy[k] = side_of(&of, 0, k);
      assert_memory_equal(of_sick, of_healthy, sizeof of_sick);
    }
  }
}

/* --- One of equal cusps that changes --------------------------------------------------------------------------------- */

/* Equal cusps are images of one half. Unequal cusps have separate patches in another order. */
enum { n_ids = 64, n_near = 400 };

/* For each patch, finds the first and the last vertex that a triangle uses. */
static void find_blocks(const riis_triangles *all, int64_t first[n_ids], int64_t last[n_ids]) {
  for (int id = 0; id < n_ids; ++id) first[id] = all->n_vertices, last[id] = -1;
  for (int64_t i = 0; i < 3 * all->n_triangles; ++i) {
    const int32_t id = all->patch_id[i / 3];
    assert_true(id >= 0 && id < n_ids);
    first[id] = all->vertex_id[i] < first[id] ? all->vertex_id[i] : first[id];
    last[id] = all->vertex_id[i] > last[id] ? all->vertex_id[i] : last[id];
  }
}

/* For each vertex of one surface, finds the vertex of another surface with equal patch, u and v. The result is -1 for a vertex
 * without triangles. Returns 0 if the surfaces have different vertices. */
static int match_vertices(const riis_surface *from, const riis_surface *to, int64_t *match) {
  const riis_triangles a = triangles_of(from), b = triangles_of(to);
  int64_t first_a[n_ids], last_a[n_ids], first_b[n_ids], last_b[n_ids];
  if (a.n_vertices != b.n_vertices || a.n_triangles != b.n_triangles) return 0;
  find_blocks(&a, first_a, last_a);
  find_blocks(&b, first_b, last_b);
  for (int64_t i = 0; i < a.n_vertices; ++i) match[i] = -1;
  for (int id = 0; id < n_ids; ++id) {
    if (last_a[id] - first_a[id] != last_b[id] - first_b[id]) return 0;
    for (int64_t i = first_a[id]; i <= last_a[id]; ++i) {
      match[i] = first_b[id] + (i - first_a[id]);
      for (int c = 0; c < 2; ++c)
        if (fabs(a.uv[2 * i + c] - b.uv[2 * match[i] + c]) > 1e-3) return 0;
    }
  }
  return 1;
}

/* Makes a valve with random equal cusps and a skirt. The valve is warped, and perhaps fused. */
static riis_valve *equal_valve(random_source *random, int kind) {
  riis_valve *valve = new_valve(kinds[kind]);
  set_sizes(random, valve);
  CHECK_OK(riis_valve_set_scalar(valve, "open_radius_ratio", random_between(random, 0.6, 0.8)));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", random_between(random, 0.05, 0.95)));
  if (random_bits(random) % 3 == 0)
    for (int k = 0; k < n_cusps_of(kind); ++k) set_of(valve, "commissure", k, "fusion", 0.25);
  if (random_bits(random) % 2) CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.2));
  if (random_bits(random) % 2) {
    enum { n = 8 };
    double from[3 * n], to[3 * n];
    for (int i = 0; i < 3 * n; ++i) {
      from[i] = (i / 3 >> i % 3 & 1 ? 2.0 : -2.0) + 0.1 * (i % 5);
      to[i] = from[i] + random_between(random, -0.1, 0.1);
    }
    riis_warp *warp = NULL;
    const riis_points points = points_at(n, from), targets = points_at(n, to);
    CHECK_OK(riis_warp_create(&points, NULL, &warp));
    own(warp);
    CHECK_OK(riis_warp_set_targets(warp, &targets));
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
  }
  return valve;
}

static riis_valve *copy_of(const riis_valve *valve) {
  riis_valve *made = NULL;
  CHECK_OK(riis_valve_copy(valve, &made));
  return own(made);
}

/* Returns the valve after a change of one size of one cusp or commissure, by a share of this size. */
static riis_valve *with_changed(const riis_valve *valve, const char *name, double share) {
  double value;
  riis_valve *made = copy_of(valve);
  CHECK_OK(riis_valve_get(made, name, 1, &value));
  CHECK_OK(riis_valve_set_scalar(made, name, (1 + share) * value));
  return made;
}

static void random_own_size(random_source *random, int kind, char name[40]) {
  static const char *const names[] = {"sector", "effective_height", "coaptation_height", "open_radius_ratio", "height"};
  const int k = (int)(random_bits(random) % (uint64_t)n_cusps_of(kind)), which = (int)(random_bits(random) % 5);
  snprintf(name, 40, "%s_%d.%s", which == 4 ? "commissure" : "cusp", k, names[which]);
}

/* Returns the distances and K of the nodes, and their derivatives if the surface has a direction. */
static riis_mark_list all_marks(const riis_surface *surface, const double *xyz) {
  riis_marks *marks = NULL;
  riis_resistance resistance;
  riis_mark_options options = mark_options();
  CHECK_OK(riis_marks_create(&marks));
  own(marks);
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1;
  options.resistance = &resistance;
  options.distance_limit = 10;
  riis_direction direction;
  if (riis_surface_get_direction(surface, 0, &direction, sizeof direction) == RIIS_OK)
    options.fields = RIIS_FIELD_GRADIENT;
  CHECK_OK(riis_mark_nodes(surface, mesh_of(n_near, xyz), &options, marks));
  const riis_mark_list list = within_list(marks);
  assert_int_equal(list.n_nodes, n_near);
  return list;
}

/* Three results are differences between surfaces of unequal cusps: rates of vertices, and derivatives of distances and of K. */
TEST(a_size_of_one_of_equal_cusps_has_derivatives) {
  random_source random = random_start("test_unequal_cusps");
  const double share = 1e-6;
  int n_alike = 0, n_moving = 0, n_off = 0, n_compared = 0, n_tried = 0;
  double worst = 0;
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned(), kind = trial % 3;
    riis_valve *valve = equal_valve(&random, kind);
    riis_surface_options options = surface_options();
    options.offset = trial % 2 ? random_between(&random, -0.5, 0.5) : 0;
    options.triangulation = trial / 3 % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    options.scale = random_power_of_ten(&random, -1, 1), options.half_thickness = 0.1 * options.scale;
    options.rotation_angle = 33, options.rotation_axis[1] = 0.5, options.translation[0] = 2;
    char name[40];
    random_own_size(&random, kind, name);
    double size;
    CHECK_OK(riis_valve_get(valve, name, 1, &size));
    riis_valve *after = with_changed(valve, name, share), *before = with_changed(valve, name, -share);
    riis_surface *at = NULL, *high = NULL, *low = NULL;
    const riis_status status[3] = {riis_surface_create(valve, &options, &at),
                                   riis_surface_create(after, &options, &high),
                                   riis_surface_create(before, &options, &low)};
    riis_surface *const made[3] = {at, high, low};
    for (int i = 0; i < 3; ++i) {
      if (made[i]) own(made[i]);
      assert_true(status[i] == RIIS_OK || status[i] == RIIS_INVALID_PARAMETER);
    }
    if (!at || !high || !low) {
      free_owned_after(owned_before);
      continue;
    }
    ++n_tried;
    CHECK_OK(riis_surface_add_direction(at, after, before, 2 * share * size, &options, &options));
    const riis_triangles all = triangles_of(at);
    int64_t *to_high = own(malloc((size_t)all.n_vertices * sizeof *to_high)),
            *to_low = own(malloc((size_t)all.n_vertices * sizeof *to_low));
    if (!match_vertices(at, high, to_high) || !match_vertices(at, low, to_low)) {
      free_owned_after(owned_before);
      continue;
    }
    ++n_alike;
    riis_direction direction;
    CHECK_OK(riis_surface_get_direction(at, 0, &direction, sizeof direction));
    const double *above = triangles_of(high).xyz, *below = triangles_of(low).xyz;
    double speed = 0, off = 0;
    for (int64_t i = 0; i < 3 * all.n_vertices; ++i) {
      if (to_high[i / 3] < 0) continue;
      const double slope = (above[3 * to_high[i / 3] + i % 3] - below[3 * to_low[i / 3] + i % 3]) / (2 * share * size);
      speed = fmax(speed, fabs(direction.rate[i])), off = fmax(off, fabs(slope - direction.rate[i]));
    }
    /* If a cusp already opens as far as its edge allows, a larger open_radius_ratio does not open the cusp farther. */
    if (!(speed > 1e-6)) {
      assert_true(strstr(name, "open_radius_ratio") != NULL && off <= 1e-6);
      free_owned_after(owned_before);
      continue;
    }
    ++n_moving;
    if (off > 1e-5 * speed)
      print_message("%s of %s: rates are off by %.2g of the largest\n", name, kinds[kind], off / speed);
    worst = fmax(worst, off / speed);
    double xyz[3 * n_near];
    for (int i = 0; i < n_near; ++i) {
      const double *vertex = all.xyz + 3 * (int64_t)(random_bits(&random) % (uint64_t)all.n_vertices);
      for (int c = 0; c < 3; ++c) xyz[3 * i + c] = vertex[c] + 0.15 * options.scale * random_between(&random, -1, 1);
    }
    const riis_mark_list here = all_marks(at, xyz), up = all_marks(high, xyz), down = all_marks(low, xyz);
    const double eps = options.half_thickness, by_K = 1 / (eps * eps * eps);
    for (int i = 0; i < n_near; ++i) {
      const double of_d = (up.distance[i] - down.distance[i]) / (2 * share * size);
      const double of_K = (up.K[i] - down.K[i]) / (2 * share * size);
      ++n_compared;
      n_off += !(fabs(of_d - here.distance_gradient[i]) <= 1e-4 * speed &&
                 fabs(of_K - here.K_gradient[i]) <= 1e-3 * by_K * speed);
    }
    free_owned_after(owned_before);
  }
  printf("%d of %d surfaces alike, rates off by at most %.2g, %d of %d derivatives are off\n", n_alike, n_tried, worst,
         n_off, n_compared);
  CHECK_MET(n_moving >= 3 && 3 * n_alike >= n_tried);
  CHECK_AT_MOST(worst, 1e-5);
  assert_true(n_off <= 0.02 * n_compared); /* ties, and nodes whose closest triangle changes */
}

/* A valve goes from equal to unequal cusps and back. The velocities equal those of a valve whose equal cusps have separate
 * patches. A bump without effect gives that valve its separate patches. */
TEST(equal_cusps_become_unequal_in_motion) {
  random_source random = random_start("test_unequal_cusps");
  int n_alike = 0, n_moving = 0;
  double worst = 0;
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const int owned_before = n_owned(), kind = trial % 3;
    riis_valve *equal = equal_valve(&random, kind), *of_patches = copy_of(equal);
    set_of(of_patches, "bump", 0, "leaflet", 0);
    riis_surface_options options = surface_options();
    options.triangulation = trial / 3 % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    char name[40];
    random_own_size(&random, kind, name);
    riis_valve *unequal = with_changed(equal, name, 0.02);
    riis_surface *images = new_surface(equal, &options), *patches = new_surface(of_patches, &options), *other = NULL;
    const riis_triangles all = triangles_of(images);
    int64_t *match = own(malloc((size_t)all.n_vertices * sizeof *match));
    double *xyz = own(malloc(3 * (size_t)all.n_vertices * sizeof *xyz));
    memcpy(xyz, all.xyz, 3 * (size_t)all.n_vertices * sizeof *xyz);
    if (riis_surface_create(unequal, &options, &other) != RIIS_OK || !match_vertices(images, patches, match)) {
      riis_surface_destroy(&other);
      free_owned_after(owned_before);
      continue;
    }
    own(other), ++n_alike;
    CHECK_OK(riis_surface_update_moving(images, equal, unequal, 0.01, NULL, NULL));
    CHECK_OK(riis_surface_update_moving(patches, of_patches, unequal, 0.01, NULL, NULL));
    assert_memory_equal(triangles_of(images).xyz, xyz, 3 * (size_t)all.n_vertices * sizeof *xyz);
    const double *a = velocity_of(images), *b = velocity_of(patches);
    double fastest = 0, off = 0;
    for (int64_t i = 0; i < 3 * all.n_vertices; ++i) {
      if (match[i / 3] < 0) continue;
      fastest = fmax(fastest, fabs(a[i])), off = fmax(off, fabs(a[i] - b[3 * match[i / 3] + i % 3]));
    }
    n_moving += fastest > 0.01;
    worst = fmax(worst, off);
    /* In the reverse direction, making the earlier state changes the bits only by rounding. */
    riis_surface *from_patches = new_surface(unequal, &options);
    CHECK_OK(riis_surface_update_moving(other, unequal, equal, 0.01, NULL, NULL));
    CHECK_OK(riis_surface_update_moving(from_patches, unequal, of_patches, 0.01, NULL, NULL));
    const riis_triangles there = triangles_of(other);
    for (int64_t i = 0; i < 3 * there.n_vertices; ++i)
      worst = fmax(worst, fabs(velocity_of(other)[i] - velocity_of(from_patches)[i]));
    free_owned_after(owned_before);
  }
  printf("%d of %d valves move, velocities differ by at most %.2g\n", n_moving, n_alike, worst);
  CHECK_MET(n_moving > 2);
  CHECK_AT_MOST(worst, 1e-9);
}

/* A fused commissure has patches that an unfused commissure lacks. With a little fusion, both states have the patches of a fused
 * commissure. */
TEST(fusion_of_one_state_only_is_refused) {
  riis_valve *whole = valve_at("coapting", 0.4), *fused = copy_of(whole), *nearly = copy_of(whole);
  set_of(fused, "commissure", 1, "fusion", 0.3);
  set_of(nearly, "commissure", 1, "fusion", 0.01);
  riis_surface *surface = new_surface(fused, NULL);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER,
                "valve_before has 12 patches, valve has 16: they must be two states of one valve",
                riis_surface_update_moving(surface, fused, whole, 0.01, NULL, NULL));
  CHECK_OK(riis_surface_update_moving(surface, fused, nearly, 0.01, NULL, NULL));
}

TEST(the_skirt_has_its_own_leaflet) {
  for (int kind = 0; kind < 3; ++kind) {
    riis_valve *valve = new_valve(kinds[kind]);
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.2));
    const riis_triangles all = triangles_of(new_surface(valve, NULL));
    int32_t largest = 0;
    for (int64_t t = 0; t < all.n_triangles; ++t) largest = all.leaflet_id[t] > largest ? all.leaflet_id[t] : largest;
    assert_int_equal(largest, kind == 2 ? 4 : RIIS_LEAFLET_SKIRT);
  }
}

TEST(values_that_do_not_go_together_are_refused) {
  riis_surface *surface = NULL;
#define REFUSES(kind, owner, number, name, value, text)                                      \
  do {                                                                                       \
    riis_valve *valve = new_valve(kind);                                                     \
    set_of(valve, owner, number, name, value);                                               \
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, text, riis_surface_create(valve, NULL, &surface)); \
    assert_null(surface);                                                                    \
  } while (0)
  REFUSES("bicuspid", "cusp", 0, "sector", 60,
          "cusp_1.sector is 180, which is 270 degrees of a sum of 360|from 50 to 240");
  REFUSES("quadricuspid", "cusp", 2, "sector", 40, "cusp_2.sector is 40, which is 46.4|from 50 to 240 degrees");
  REFUSES("coapting", "cusp", 2, "effective_height", 1.74, "cusp_2.effective_height is 1.74|commissure_1.height");
  REFUSES("coapting", "cusp", 1, "coaptation_height", 0.9, "cusp_1.coaptation_height is 0.9|cusp_1.effective_height");
  REFUSES("coapting", "commissure", 1, "height", 0.3, "commissure_1.height is 0.3|commissure_radius, which is 1.25");
  riis_valve *narrow = new_valve("bicuspid");
  for (int k = 0; k < 2; ++k) set_of(narrow, "commissure", k, "fusion", 0.6);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "commissure_0.fusion is 0.6|0.06 pi commissure_radius^2",
                riis_surface_create(narrow, NULL, &surface));
  riis_valve *wide = new_valve("bicuspid");
  set_of(wide, "cusp", 1, "sector", 360);
  set_of(wide, "commissure", 0, "fusion", 0.6);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the open free edge of cusp 1 is at least|too short to open so far",
                riis_surface_create(wide, NULL, &surface));
  riis_valve *low = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(low, "edge_rise", 0));
  set_of(low, "cusp", 1, "effective_height", 0.34);
  set_of(low, "cusp", 1, "coaptation_height", 0.1);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "cusp 1 would fold|cusp_1.effective_height 0.34",
                riis_surface_create(low, NULL, &surface));
  riis_valve *valve = new_valve("bicuspid"), *other = new_valve("bicuspid");
  set_of(other, "cusp", 0, "sector", 150);
  CHECK_OK(riis_valve_set_open_state(valve, other));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "in the open state: the sector of cusp 0 is|both must be equal",
                riis_surface_create(valve, NULL, &surface));
}

int main(void) { return run_cases(NULL, NULL); }
