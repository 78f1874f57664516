/* SPDX-License-Identifier: Apache-2.0
 * Tests the atrioventricular valves: exact properties of docs/theory/atrioventricular.md, and measures that are compared with the
 * literature. Lengths and angles come from triangles, without the library's curves. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "cusp_checks.h"

enum { n_cells = 6, n_patches = 2 * n_cells };
static const char *const kinds[2] = {"mitral_coapting", "tricuspid"};
static const int n_leaflets[2] = {2, 3};
static const double openings[5] = {0, 0.25, 0.5, 0.75, 1};

/* A short test tries only the ends of the opening's range. */
static int opening_step(void) { return is_short_test() ? 4 : 1; }

static riis_surface *surface_at(riis_valve *valve, double opening, double tolerance) {
  riis_surface_options options = surface_options();
  options.tolerance = tolerance;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return new_surface(valve, &options);
}

static double distance_of(const double *p, const double *q) {
  return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
}

/* A vertex of a patch, with its u and v. */
typedef struct place {
  double u, v;
  const double *x;
} place;

static int by_place(const void *a, const void *b) {
  const place *p = a, *q = b;
  const double before = p->u != q->u ? p->u - q->u : p->v - q->v;
  return before < 0 ? -1 : before > 0;
}

/* The vertices on one side of a patch, where u or v is 0 or 1, in the order along the side. */
typedef struct side {
  int64_t n;
  place *places;
} side;

static side side_of(const riis_surface *surface, int patch, int along_u, double at) {
  const riis_triangles all = triangles_of(surface);
  unsigned char *is_taken = own(calloc((size_t)all.n_vertices, 1));
  side made = {0, own(malloc((size_t)all.n_vertices * sizeof *made.places))};
  for (int64_t t = 0; t < all.n_triangles; ++t)
    for (int k = 0; k < 3 && all.patch_id[t] == patch; ++k) {
      const int64_t id = all.vertex_id[3 * t + k];
      const double *uv = all.uv + 2 * id;
      if (is_taken[id] || uv[along_u ? 1 : 0] != at) continue;
      is_taken[id] = 1;
      made.places[made.n++] = (place){along_u ? uv[0] : 0, along_u ? 0 : uv[1], all.xyz + 3 * id};
    }
  qsort(made.places, (size_t)made.n, sizeof *made.places, by_place);
  return made;
}

static double length_of(side of) {
  double length = 0;
  for (int64_t i = 1; i < of.n; ++i) length += distance_of(of.places[i - 1].x, of.places[i].x);
  return length;
}

/* The length of the meridian down to the free edge, at the counter-clockwise end of a cell. In the patches u runs clockwise. */
static double meridian_length(const riis_surface *surface, int leaflet, int cell) {
  const int patch = n_patches * leaflet + 2 * cell;
  return length_of(side_of(surface, patch, 0, 0)) + length_of(side_of(surface, patch + 1, 0, 0));
}
static double middle_length(const riis_surface *surface, int leaflet) {
  return meridian_length(surface, leaflet, n_cells / 2 - 1);
}

/* At a commissure, neighbouring leaflets end in the same points, bit for bit. The cells of a leaflet also end in the same points
 * where they meet. */
TEST(neighbours_share_their_points) {
  for (int kind = 0; kind < 2; ++kind)
    for (int o = 0; o < 5; o += opening_step()) {
      const int owned_before = n_owned();
      riis_surface *surface = surface_at(new_valve(kinds[kind]), openings[o], 0.05);
      for (int leaflet = 0; leaflet < n_leaflets[kind]; ++leaflet)
        for (int cell = 0; cell < n_cells; ++cell)
          for (int part = 0; part < 2; ++part) {
            const int next = cell + 1 < n_cells ? n_patches * leaflet + 2 * (cell + 1)
                                                : n_patches * ((leaflet + 1) % n_leaflets[kind]);
            const side here = side_of(surface, n_patches * leaflet + 2 * cell + part, 0, 0),
                       there = side_of(surface, next + part, 0, 1);
            assert_memory_equal(here.places[0].x, there.places[0].x, 3 * sizeof(double));
            assert_memory_equal(here.places[here.n - 1].x, there.places[there.n - 1].x, 3 * sizeof(double));
          }
      free_owned_after(owned_before);
    }
}

/* The annulus stays at its place, bit for bit. The leaflets share the annulus in their given ratios. */
TEST(annulus_stays) {
  static const double shares[2][3] = {{0.41, 0.59, 0}, {0.36, 0.34, 0.3}}, width[2] = {3.6, 3.8}, depth[2] = {2.7, 3.1},
                      saddle[2] = {0.6, 0.4};
  for (int kind = 0; kind < 2; ++kind) {
    riis_surface_options options = surface_options();
    options.triangulation = RIIS_TRIANGULATION_FIXED;
    options.tolerance = 0.002;
    riis_valve *valve = new_valve(kinds[kind]);
    riis_surface *surface = new_surface(valve, &options);
    riis_attachment attachment;
    CHECK_OK(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
    const size_t size = (size_t)attachment.n_edges * 6 * sizeof(double);
    double *edges = own(malloc(size)), low[3] = {9, 9, 9}, high[3] = {-9, -9, -9}, length[3] = {0, 0, 0}, whole = 0;
    memcpy(edges, attachment.edges, size);
    for (int64_t i = 0; i < attachment.n_edges; ++i) {
      const double here = distance_of(edges + 6 * i, edges + 6 * i + 3);
      length[attachment.leaflet_id[i]] += here, whole += here;
      for (int c = 0; c < 3; ++c) low[c] = fmin(low[c], edges[6 * i + c]), high[c] = fmax(high[c], edges[6 * i + c]);
    }
    for (int leaflet = 0; leaflet < n_leaflets[kind]; ++leaflet)
      CHECK_NEAR(length[leaflet] / whole, shares[kind][leaflet], 1e-4);
    CHECK_NEAR(high[0] - low[0], width[kind], 1e-3);
    CHECK_NEAR(high[1] - low[1], depth[kind], 1e-3);
    CHECK_NEAR(high[2] - low[2], saddle[kind], 1e-3);
    printf("%s: circumference %.2f cm\n", kinds[kind], whole);
    for (int o = 1; o < 5; o += opening_step()) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", openings[o]));
      CHECK_OK(riis_surface_update(surface, valve, NULL));
      CHECK_OK(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
      assert_memory_equal(edges, attachment.edges, size);
    }
  }
}

/* Checks that both surfaces lie on one smooth valve, although their triangles may differ. */
static void check_same_shape(const riis_surface *a, const riis_surface *b) {
  const riis_triangles all = triangles_of(a);
  const double bound = info_of(a).error_bound + info_of(b).error_bound;
  for (int64_t i = 0; i < all.n_vertices; ++i) {
    const double *x = all.xyz + 3 * i;
    CHECK_AT_MOST(fabs(closest_to(b, x[0], x[1], x[2]).distance), bound);
  }
}

static void set_random_sizes(random_source *random, riis_valve *valve) {
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  for (int64_t i = 0; i < n; ++i) {
    riis_parameter parameter;
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    if (strcmp(parameter.name, "translation") == 0) break; /* the sizes come before it */
    const double value = parameter.default_values[0] * random_between(random, 0.9, 1.1);
    CHECK_OK(riis_valve_set_scalar(valve, parameter.name, fmin(value, parameter.maximum)));
  }
}

/* The length of each leaflet's middle is the length that was set, at every opening. */
TEST(middle_keeps_its_length) {
  random_source random = random_start("test_atrioventricular");
  static const char *const names[2][3] = {{"anterior_length", "posterior_length"},
                                          {"anterior_length", "septal_length", "posterior_length"}};
  for (int trial = 0; trial < trials_of(24); ++trial) {
    const int owned_before = n_owned(), kind = trial % 2;
    riis_valve *valve = new_valve(kinds[kind]);
    if (trial > 1) set_random_sizes(&random, valve);
    for (int o = 0; o < 5; o += opening_step()) {
      riis_surface *surface = surface_at(valve, openings[o], 0.002);
      for (int leaflet = 0; leaflet < n_leaflets[kind]; ++leaflet) {
        double set;
        CHECK_OK(riis_valve_get(valve, names[kind][leaflet], 1, &set));
        const double length = middle_length(surface, leaflet);
        assert_true(length <= set * (1 + 1e-12)); /* of chords */
        CHECK_NEAR(length, set, 1e-4 * set);
      }
    }
    free_owned_after(owned_before);
  }
}

/* An open leaflet is as long as the closed leaflet at each place, and not only in its middle. */
TEST(open_leaflets_have_the_closed_lengths) {
  for (int kind = 0; kind < 2; kind += trial_step()) {
    riis_surface *closed = surface_at(new_valve(kinds[kind]), 0, 0.002),
                 *open = surface_at(new_valve(kinds[kind]), 1, 0.002);
    for (int leaflet = 0; leaflet < n_leaflets[kind]; ++leaflet)
      for (int cell = 0; cell < n_cells; ++cell) {
        const double length = meridian_length(closed, leaflet, cell);
        CHECK_NEAR(meridian_length(open, leaflet, cell), length, 0.1 * length);
      }
  }
}

/* The mitral valve equals its mirror image: place (u, v) of a cell mirrors place (1 - u, v) of the cell on the other side. */
TEST(mitral_valve_is_symmetric) {
  riis_valve *valve = new_valve("mitral_coapting");
  for (int o = 0; o < 5; o += opening_step()) {
    riis_surface *surface = surface_at(valve, openings[o], 0.02);
    const double bound = 2 * info_of(surface).error_bound;
    const riis_triangles all = triangles_of(surface);
    for (int64_t i = 0; i < all.n_vertices; ++i) {
      const double *x = all.xyz + 3 * i;
      CHECK_AT_MOST(fabs(closest_to(surface, -x[0], x[1], x[2]).distance), bound);
    }
    for (int patch = 0; patch < 2 * n_patches; ++patch) {
      const int cell = patch % n_patches / 2, mirrored = patch + 2 * (n_cells - 1 - 2 * cell);
      const side here = side_of(surface, patch, 0, 0), there = side_of(surface, mirrored, 0, 1);
      const double *last = here.places[here.n - 1].x, *other = there.places[there.n - 1].x;
      CHECK_NEAR(last[0], -other[0], 1e-12);
      CHECK_NEAR(last[1], other[1], 1e-12);
      CHECK_NEAR(last[2], other[2], 1e-12);
    }
  }
}

/* Returns whether an edge of the triangle lies on the side v of its patch. */
static int lies_on(const riis_triangles *all, int64_t triangle, double v) {
  int n = 0;
  for (int k = 0; k < 3; ++k) n += all->uv[2 * all->vertex_id[3 * triangle + k] + 1] == v;
  return n >= 2;
}

/* The largest angle, in degrees, between the triangles above and below the coaptation lines. */
static double line_crease(const riis_surface *surface) {
  const riis_triangles all = triangles_of(surface);
  double largest = 0;
  for (int64_t s = 0; s < all.n_triangles; ++s) {
    if (all.patch_id[s] % 2 != 0 || !lies_on(&all, s, 1)) continue;
    for (int64_t t = 0; t < all.n_triangles; ++t) {
      if (all.patch_id[t] != all.patch_id[s] + 1 || !lies_on(&all, t, 0)) continue;
      int n_shared = 0;
      for (int k = 0; k < 9; ++k)
        n_shared += memcmp(all.xyz + 3 * all.vertex_id[3 * s + k / 3], all.xyz + 3 * all.vertex_id[3 * t + k % 3],
                           3 * sizeof(double)) == 0;
      if (n_shared < 2) continue;
      double normal[2][3];
      for (int i = 0; i < 2; ++i) {
        const int64_t *id = all.vertex_id + 3 * (i ? t : s);
        const double *p = all.xyz + 3 * id[0], *q = all.xyz + 3 * id[1], *r = all.xyz + 3 * id[2];
        for (int c = 0; c < 3; ++c) {
          const int d = (c + 1) % 3, e = (c + 2) % 3;
          normal[i][c] = (q[d] - p[d]) * (r[e] - p[e]) - (q[e] - p[e]) * (r[d] - p[d]);
        }
      }
      const double *a = normal[0], *b = normal[1];
      const double cosine =
          (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (hypot(hypot(a[0], a[1]), a[2]) * hypot(hypot(b[0], b[1]), b[2]));
      largest = fmax(largest, acos(fmin(1, cosine)) / cusp_degree);
    }
  }
  return largest;
}

/* Compares measures of default valves with the literature (docs/theory/atrioventricular.md, "Measures"). */
TEST(measures_are_those_of_the_literature) {
  static const double orifice_least[2] = {4, 4}, orifice_most[2] = {6, 6};
  for (int kind = 0; kind < 2; kind += trial_step()) {
    riis_valve *valve = new_valve(kinds[kind]);
    double edge[5][3], largest_ratio = 0, largest_crease = 0, last_area = -1;
    for (int o = 0; o < 5; o += opening_step()) {
      riis_surface *surface = surface_at(valve, openings[o], 0.005);
      double area = 0;
      for (int64_t leaflet = 0; leaflet < n_leaflets[kind]; ++leaflet) {
        riis_leaflet sizes;
        CHECK_OK(riis_surface_get_leaflet(surface, leaflet, &sizes, sizeof sizes));
        edge[o][leaflet] = sizes.free_edge, area += sizes.area;
        largest_ratio = fmax(largest_ratio, edge[o][leaflet] / edge[0][leaflet]);
      }
      riis_orifice orifice;
      CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
      const double crease = line_crease(surface);
      largest_crease = fmax(largest_crease, crease);
      printf("%s at %.2f: leaflets %.2f cm2, orifice %.2f cm2, crease at the coaptation line %.1f degrees\n",
             kinds[kind], openings[o], area, orifice.area, crease);
      assert_true(orifice.area > last_area);
      last_area = orifice.area;
      if (o == 0) CHECK_AT_MOST(orifice.area, 0.07);
    }
    assert_true(last_area >= orifice_least[kind] && last_area <= orifice_most[kind]);
    /* The area of the tissue: lengths along the meridians times the part of the annulus from which the tissue hangs. */
    riis_surface *closed = surface_at(valve, 0, 0.01);
    double tissue = 0;
    for (int patch = 0; patch < n_patches * n_leaflets[kind]; patch += 2)
      tissue += length_of(side_of(closed, patch, 1, 0)) *
                (length_of(side_of(closed, patch, 0, 0)) + length_of(side_of(closed, patch + 1, 0, 0)) +
                 length_of(side_of(closed, patch, 0, 1)) + length_of(side_of(closed, patch + 1, 0, 1))) /
                2;
    printf("%s: tissue %.1f cm2, free edges lengthen by at most %.2f\n", kinds[kind], tissue, largest_ratio);
    if (kind == 1) CHECK_NEAR(tissue, 21, 1.1);
    CHECK_AT_MOST(largest_ratio, 1.4);
    CHECK_AT_MOST(largest_crease, 10);
  }
}

/* The lowest and the highest point of the closed leaflets' edges, and the gap, have the sizes that were set. */
TEST(sizes_are_where_they_should_be) {
  static const struct {
    const char *name;
    double values[2];
  } sizes[] = {{"tenting_height", {0.2, 0.6}}, {"gap", {0.02, 0.06}}, {"commissure_length", {0.7, 0.9}}};
  for (int i = 0; i < 3; i += trial_step())
    for (int j = 0; j < 2; ++j) {
      riis_valve *valve = new_valve("mitral_coapting");
      CHECK_OK(riis_valve_set_scalar(valve, sizes[i].name, sizes[i].values[j]));
      riis_surface *surface = surface_at(valve, 0, 0.02);
      /* the middle of both coaptation lines, and a commissure */
      const side anterior = side_of(surface, 4, 0, 0), posterior = side_of(surface, n_patches + 4, 0, 0),
                 line = side_of(surface, 11, 0, 0), body = side_of(surface, 10, 0, 0);
      const double *a = anterior.places[anterior.n - 1].x, *p = posterior.places[posterior.n - 1].x;
      const double measured[3] = {-a[2], distance_of(a, p), distance_of(body.places[0].x, line.places[line.n - 1].x)};
      CHECK_NEAR(measured[i], sizes[i].values[j], 1e-12);
    }
}

/* If the annulus dilates, a leaflet becomes too short and stays back, so a gap opens. */
TEST(dilated_annulus_leaks) {
  for (int kind = 0; kind < 2; ++kind) {
    riis_valve *valve = new_valve(kinds[kind]);
    CHECK_OK(riis_valve_set_scalar(valve, kind ? "SL_diameter" : "AP_diameter", kind ? 5.0 : 3.6));
    riis_orifice orifice;
    CHECK_OK(riis_surface_get_orifice(surface_at(valve, 0, 0.05), NULL, &orifice, sizeof orifice));
    printf("%s: a dilated annulus leaves %.2f cm2 open\n", kinds[kind], orifice.area);
    assert_true(orifice.area > 0.15);
  }
}

static void set_bump(riis_valve *valve, int bump, const char *name, double value) {
  char full[40];
  snprintf(full, sizeof full, "bump_%d.%s", bump, name);
  CHECK_OK(riis_valve_set_scalar(valve, full, value));
}

static double orifice_of(riis_valve *valve, double opening) {
  riis_orifice orifice;
  CHECK_OK(riis_surface_get_orifice(surface_at(valve, opening, 0.05), NULL, &orifice, sizeof orifice));
  return orifice.area;
}

/* A clip joins both leaflets at one place. The open valve then has one orifice on each side of the clip. */
TEST(clip_makes_two_orifices) {
  riis_valve *valve = new_valve("mitral_coapting");
  const double healthy = orifice_of(valve, 1), closed = orifice_of(valve, 0);
  for (int leaflet = 0; leaflet < 2; ++leaflet) {
    set_bump(valve, leaflet, "leaflet", leaflet);
    set_bump(valve, leaflet, "open", 0);
  }
  CHECK_NEAR(orifice_of(valve, 0), closed, 1e-3);
  const double clipped = orifice_of(valve, 1);
  printf("clip: orifice %.2f of %.2f cm2\n", clipped, healthy);
  assert_true(clipped > 0.2 * healthy && clipped < 0.6 * healthy);
  /* The clipped place does not move. */
  riis_surface *surface = surface_at(valve, 1, 0.02), *before = surface_at(valve, 0, 0.02);
  for (int leaflet = 0; leaflet < 2; ++leaflet) {
    const side now = side_of(surface, n_patches * leaflet + 5, 0, 0),
               then = side_of(before, n_patches * leaflet + 5, 0, 0);
    for (int c = 0; c < 3; ++c) CHECK_NEAR(now.places[now.n - 1].x[c], then.places[then.n - 1].x[c], 1e-12);
  }
}

/* Fused commissures stay closed, so the orifice becomes a slit in the middle. A restricted leaflet opens less. */
TEST(bumps_of_commissures_and_leaflets) {
  riis_valve *valve = new_valve("mitral_coapting"), *restricted = new_valve("tricuspid");
  const double healthy = orifice_of(valve, 1), healthy_tricuspid = orifice_of(restricted, 1);
  for (int commissure = 0; commissure < 2; ++commissure) {
    set_bump(valve, commissure, "commissure", commissure);
    set_bump(valve, commissure, "open", 0);
  }
  const double fused = orifice_of(valve, 1);
  set_bump(restricted, 0, "leaflet", 1);
  set_bump(restricted, 0, "width", 10);
  set_bump(restricted, 0, "open", 0.3);
  const double less = orifice_of(restricted, 1);
  printf("fused commissures: %.2f of %.2f cm2; a restricted septal leaflet: %.2f of %.2f cm2\n", fused, healthy, less,
         healthy_tricuspid);
  assert_true(fused < 0.8 * healthy && less < 0.9 * healthy_tricuspid);
}

/* If leaflets do not close, their gap grows nearly in proportion to `closed`. */
TEST(closed_makes_a_gap) {
  double last = 0;
  for (int i = 0; i <= 5; ++i) {
    riis_valve *valve = new_valve("mitral_coapting");
    for (int leaflet = 0; leaflet < 2; ++leaflet) {
      set_bump(valve, leaflet, "leaflet", leaflet);
      set_bump(valve, leaflet, "closed", 0.1 * i);
    }
    const double gap = orifice_of(valve, 0);
    printf("closed %.1f: gap %.2f cm2\n", 0.1 * i, gap);
    assert_true(i == 0 || (gap > last + 0.1 && gap < last + 0.3));
    last = gap;
  }
}

/* In the closed valve, a lifted middle lies higher by the lift. The open valve does not change. */
TEST(lift_raises_the_closed_place) {
  riis_valve *valve = new_valve("mitral_coapting");
  riis_surface *healthy = surface_at(valve, 0, 0.02), *healthy_open = surface_at(valve, 1, 0.02);
  set_bump(valve, 0, "leaflet", RIIS_LEAFLET_POSTERIOR);
  set_bump(valve, 0, "lift", 0.4);
  riis_surface *flail = surface_at(valve, 0, 0.02);
  const side before = side_of(healthy, n_patches + 5, 0, 0), after = side_of(flail, n_patches + 5, 0, 0);
  const double *p = before.places[before.n - 1].x, *q = after.places[after.n - 1].x;
  CHECK_NEAR(q[0], p[0], 1e-12);
  CHECK_NEAR(q[1], p[1], 1e-12);
  CHECK_NEAR(q[2], p[2] + 0.4, 1e-12);
  check_same_shape(surface_at(valve, 1, 0.02), healthy_open);
}

/* The z of the first two control points of leaflet 1's closed free edge, from its first commissure. */
typedef struct start_of_edge {
  double end, next;
} start_of_edge;
static start_of_edge start_of_posterior_edge(riis_valve *valve) {
  riis_valve_patches patches;
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  int64_t patch = 0;
  while (patches.patch_id[patch] != n_patches + 1) ++patch;
  const int64_t piece = patches.first_piece[patches.curve_id[4 * patch + 1]];
  const double *control = patches.control;
  for (int64_t i = 0; i < piece; ++i) control += 3 * (patches.degree[i] + 1);
  return (start_of_edge){control[2], control[5]};
}

/* Commissures hold a leaflet: a bump lifts the place next to a commissure at most 0.4 cm higher than the commissure. This limit
 * is half of commissure_length. The first part of the edge is a third of its cubic. The difference of the part's first two
 * control points therefore counts three times. */
TEST(commissures_hold_a_lifted_leaflet) {
  static const double lifts[5] = {0.3, 0.8, -0.8, 0.3, 0.8}, raised[5] = {0, 0, 0, 0.2, 0.2},
                      expected[5] = {0.3, 0.4, -0.4, 0.3, 0.8};
  const start_of_edge healthy = start_of_posterior_edge(new_valve("mitral_coapting"));
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  for (int i = 0; i < 5; ++i) {
    riis_valve *valve = new_valve("mitral_coapting");
    set_bump(valve, 0, "leaflet", RIIS_LEAFLET_POSTERIOR);
    set_bump(valve, 0, "u", 1.0 / 6);
    set_bump(valve, 0, "lift", lifts[i]);
    set_bump(valve, 1, "commissure", 0);
    set_bump(valve, 1, "width", 0.2);
    set_bump(valve, 1, "lift", raised[i]);
    const start_of_edge lifted = start_of_posterior_edge(valve);
    /* A bump of the commissure also acts a little on the place next to it. */
    const double beside = raised[i] * pow(1 - pow(1 / 1.2, 2), 2), end = lifted.end - healthy.end;
    const double next = end + 3 * (lifted.next - lifted.end - healthy.next + healthy.end);
    CHECK_NEAR(end, raised[i], 1e-12);
    CHECK_NEAR(next, fmin(expected[i] + beside, raised[i] + 0.4), 1e-12);
    riis_crossing_list list;
    CHECK_OK(riis_find_crossings(surface_at(valve, 0, 0.02), NULL, crossings));
    CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
    assert_int_equal(list.n_pairs, 0);
  }
}

/* A valve with an open state equals the first valve when closed and the second valve when open. The annulus moves from the first
 * valve's place to the second valve's place. */
TEST(opens_to_another_valves_open_state) {
  riis_valve *valve = new_valve("tricuspid"), *plain = new_valve("tricuspid"), *other = new_valve("tricuspid");
  CHECK_OK(riis_valve_set_scalar(other, "AP_diameter", 4));
  CHECK_OK(riis_valve_set_scalar(other, "anterior_ratio", 0.38));
  CHECK_OK(riis_valve_set_open_state(valve, other));
  for (int end = 0; end < 2; ++end)
    check_same_shape(surface_at(valve, end, 0.05), surface_at(end ? other : plain, end, 0.05));
  const riis_surface *half = surface_at(valve, 0.5, 0.005);
  riis_surface_info info = info_of(half);
  CHECK_NEAR(info.upper[0] - info.lower[0], 3.9, 1e-3);
}

/* A velocity is the difference of two states on equal triangles. The fixed triangulation follows the valve. */
TEST(velocities_are_differences) {
  for (int kind = 0; kind < 2; ++kind)
    for (int fixed = 0; fixed < 2; ++fixed) {
      if (is_short_test() && fixed != kind) continue;
      riis_surface_options options = surface_options();
      options.triangulation = fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
      riis_valve *valve = new_valve(kinds[kind]), *before = new_valve(kinds[kind]);
      CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.45));
      CHECK_OK(riis_valve_set_scalar(before, "opening", 0.4));
      riis_surface *surface = new_surface(valve, &options), *earlier = new_surface(before, &options);
      CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.5, &options, NULL));
      const riis_triangles all = triangles_of(surface);
      for (int64_t i = 0; i < all.n_vertices; ++i) {
        double x[3];
        for (int c = 0; c < 3; ++c) x[c] = all.xyz[3 * i + c] - 0.5 * all.velocity[3 * i + c];
        CHECK_AT_MOST(fabs(closest_to(earlier, x[0], x[1], x[2]).distance), 2 * info_of(earlier).error_bound);
      }
    }
}

TEST(values_that_do_not_go_together_are_refused) {
  riis_surface *surface = NULL;
#define IS_REFUSED(kind, name, value, text)                                                  \
  do {                                                                                       \
    riis_valve *valve = new_valve(kind);                                                     \
    CHECK_OK(riis_valve_set_scalar(valve, name, value));                                     \
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, text, riis_surface_create(valve, NULL, &surface)); \
    assert_null(surface);                                                                    \
  } while (0)
  IS_REFUSED("tricuspid", "AP_diameter", 9, "AP_diameter is 9|from 0.5 to 2 times SL_diameter, which is 3.1");
  IS_REFUSED("tricuspid", "septal_ratio", 0.62, "the shares of the annulus leave|septal_ratio and anterior_ratio");
  IS_REFUSED("tricuspid", "anterior_length", 6, "the leaflets would meet|anterior_length|SL_diameter");
  IS_REFUSED("mitral_coapting", "posterior_length", 0.3, "the leaflets would meet|AP_diameter, which is 2.7");
  IS_REFUSED("mitral_coapting", "tenting_height", 2.6, "too short|tenting_height 2.6");
  IS_REFUSED("tricuspid", "commissure_angle", 25, "would lie above the annulus|commissure_coaptation 0.5");
  IS_REFUSED("mitral_coapting", "bump_2.leaflet", 0.5, "bump_2.leaflet is 0.5");
  riis_valve *lifted = new_valve("tricuspid");
  set_bump(lifted, 0, "leaflet", 2);
  set_bump(lifted, 0, "lift", 5);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "bumps lift the leaflet of posterior_length by |SL_diameter, which is 3.1",
                riis_surface_create(lifted, NULL, &surface));
  riis_valve *long_leaflets = new_valve("mitral_coapting"), *angle = new_valve("tricuspid");
  CHECK_OK(riis_valve_set_scalar(long_leaflets, "anterior_length", 5.35));
  CHECK_OK(riis_valve_set_scalar(long_leaflets, "posterior_length", 4.7));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "posterior_length is 4.7, of which|too long for the annulus",
                riis_surface_create(long_leaflets, NULL, &surface));
  CHECK_OK(riis_valve_set_scalar(angle, "commissure_angle", 20));
  CHECK_OK(riis_valve_set_scalar(angle, "commissure_length", 2));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "commissure_length is 2; inwards that is",
                riis_surface_create(angle, NULL, &surface));
}

int main(void) { return run_cases(NULL, NULL); }
