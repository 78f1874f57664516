/* SPDX-License-Identifier: Apache-2.0
 * Tests riis_find_by_area. The areas at the found openings and sizes are compared with the areas of new surfaces and with a
 * raster. Scales have a closed form. An opening over time is recovered from its areas. */
#include <riis/riis.h>

#include "test_support.h"

#include "farthest_outline.h"
#include "handles.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

enum { n_kinds = 5 };
static const char *const kinds[n_kinds] = {"aortic", "mitral", "trileaflet", "bileaflet", "coapting"};

/* Searches with coarse triangles, which suffice for a search and make it several times as fast. */
static riis_area_search area_search(void) {
  static riis_surface_options coarse;
  riis_area_search search;
  CHECK_OK(riis_area_search_init(&search, sizeof search));
  coarse = surface_options();
  coarse.tolerance = 0.2;
  search.surface = &coarse;
  return search;
}

/* Returns the area of a new surface. No update is involved. */
static double area_of(const riis_valve *valve, const riis_area_search *search) {
  riis_surface *surface = new_surface(valve, search->surface);
  riis_orifice orifice;
  CHECK_OK(riis_surface_get_orifice(surface, search->resistance, &orifice, sizeof orifice));
  free_one_owned(surface);
  return search->area == RIIS_AREA_EFFECTIVE ? orifice.effective_area : orifice.area;
}

static double area_at(riis_valve *valve, double opening, const riis_area_search *search) {
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return area_of(valve, search);
}

typedef struct solution {
  double value, reached;
  riis_area_range range;
} solution;

static solution solve(const riis_valve *valve, const char *name, double area, const riis_area_search *search) {
  solution made;
  memset(&made, 0x5a, sizeof made);
  CHECK_OK(
      riis_find_by_area(valve, name, 1, &area, search, &made.value, &made.reached, &made.range, sizeof made.range));
  return made;
}

static riis_surface_options oblique(double scale, int32_t triangulation) {
  riis_surface_options options = surface_options();
  options.scale = scale;
  options.triangulation = triangulation;
  for (int k = 0; k < 3; ++k) {
    options.rotation_axis[k] = between(-1, 1);
    options.translation[k] = scale * between(-5, 5);
  }
  options.rotation_angle = between(0, 360);
  return options;
}

static riis_resistance resistance(double half_thickness, int32_t rim) {
  riis_resistance made;
  CHECK_OK(riis_resistance_init(&made, sizeof made));
  made.half_thickness = half_thickness;
  made.rim = rim;
  return made;
}

/* The search for the area of a random opening finds an opening with this area. The found opening is at most the random
 * opening. */
TEST(openings_have_their_areas) {
  const int n_trials = is_long_test() ? 8 * 4 * n_kinds : n_kinds;
  double worst[2] = {0, 0};
  int64_t most_surfaces = 0;
  for (int trial = 0; trial < n_trials; trial += trial_step()) {
    const int kind = trial % n_kinds, is_fixed = (kind + trial / n_kinds) % 2;
    const double scale = exp(between(log(0.01), log(10)));
    const riis_surface_options options =
        oblique(scale, is_fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    const riis_resistance how = resistance(scale * between(0.02, 0.1), trial % 3 ? RIIS_RIM_CUT : RIIS_RIM_ROUND);
    riis_area_search search = area_search();
    search.surface = &options;
    search.resistance = &how;
    search.n_samples = 5;
    search.area = (trial + trial / n_kinds + trial / n_kinds / 2) % 2 ? RIIS_AREA_EFFECTIVE : RIIS_AREA_GEOMETRIC;
    riis_valve *valve = new_valve(kinds[kind]);
    const double opening = between(0.35, 1), area = area_at(valve, opening, &search);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    const solution found = solve(valve, "opening", area, &search);
    double untouched = 1;
    CHECK_OK(riis_valve_get(valve, "opening", 1, &untouched));
    assert_true(untouched == 0);
    /* The area equals that of a new surface, bit for bit. */
    const double again = area_at(valve, found.value, &search), error = fabs(again / area - 1);
    assert_true(again == found.reached);
    CHECK_AT_MOST(error, is_fixed ? 1e-6 : 1e-4);
    CHECK_AT_MOST(found.value, opening + 1e-3);
    if (error > worst[is_fixed]) worst[is_fixed] = error;
    if (found.range.n_surfaces > most_surfaces) most_surfaces = found.range.n_surfaces;
    free_one_owned(valve);
  }
  printf("worst error of an area: %.1e (adapted), %.1e (fixed); at most %d surfaces\n", worst[0], worst[1],
         (int)most_surfaces);
}

/* Counts the points of a raster that no triangle covers and that lie inside the outline. */
static double area_by_raster(const riis_surface *surface) {
  enum { n_side = 700 };
  riis_orifice orifice;
  CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  const riis_triangles all = triangles_of(surface);
  const frame seen = frame_of(orifice.axis);
  outline around = outline_of(all.xyz, all.n_triangles, all.vertex_id, &seen);
  if (orifice.outline == RIIS_OUTLINE_DISC) {
    around.middle[0] = around.middle[1] = 0, around.reach = orifice.radius;
    for (int i = 0; i < n_directions; ++i) around.distance[i] = orifice.radius;
  }
  char *covered = calloc(n_side * n_side, 1);
  const double cell = 2 * around.reach / n_side;
  for (int64_t t = 0; t < all.n_triangles; ++t) {
    double p[3][2], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int k = 0; k < 3; ++k) {
      seen_from(&seen, all.xyz + 3 * all.vertex_id[3 * t + k], p[k]);
      for (int d = 0; d < 2; ++d) {
        p[k][d] = (p[k][d] - around.middle[d] + around.reach) / cell - 0.5;
        low[d] = fmin(low[d], p[k][d]), high[d] = fmax(high[d], p[k][d]);
      }
    }
    for (int y = (int)fmax(ceil(low[1]), 0); y <= high[1] && y < n_side; ++y)
      for (int x = (int)fmax(ceil(low[0]), 0); x <= high[0] && x < n_side; ++x) {
        int n_left = 0;
        for (int k = 0; k < 3; ++k) {
          const double *a = p[k], *b = p[(k + 1) % 3];
          n_left += (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) >= 0;
        }
        if (n_left == 0 || n_left == 3) covered[y * n_side + x] = 1;
      }
  }
  int64_t n = 0;
  for (int i = 0; i < n_side * n_side; ++i) {
    const double x = (i % n_side + 0.5) * cell - around.reach, y = ((double)(i / n_side) + 0.5) * cell - around.reach;
    n += !covered[i] && is_inside(&around, x, y);
  }
  free(covered);
  return cell * cell * (double)n;
}

TEST(openings_have_the_areas_of_a_raster) {
  static const double wanted[n_kinds] = {2.5, 3, 1.8, 1.5, 2};
  for (int kind = 0; kind < n_kinds; kind += trial_step()) {
    riis_valve *valve = new_valve(kinds[kind]);
    riis_area_search search = area_search();
    search.n_samples = kind == 0 && !is_short_test() ? 33 : 5;
    const solution found = solve(valve, "opening", wanted[kind], &search);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", found.value));
    const double area = area_by_raster(new_surface(valve, search.surface));
    printf("%s: opening %.6f, %d surfaces in %.2f s, area %.4f by a raster\n", kinds[kind], found.value,
           (int)found.range.n_surfaces, found.range.seconds, area);
    CHECK_NEAR(area, wanted[kind], 0.01 * wanted[kind]);
    CHECK_NEAR(found.reached, wanted[kind], 1e-4 * wanted[kind]);
  }
}

/* Areas grow with the square of the scale. If the half thickness grows with the scale, so do effective areas. */
TEST(scales_are_roots_of_areas) {
  for (int trial = 0; trial < (is_long_test() ? 4 : 1) * n_kinds; trial += trial_step()) {
    const double scale = between(0.5, 2), factor = between(0.2, 5);
    const riis_surface_options options = oblique(scale, trial / 2 % 2);
    riis_area_search search = area_search();
    search.surface = &options;
    search.area = trial % 2;
    search.n_samples = 3;
    riis_valve *valve = new_valve(kinds[trial % n_kinds]);
    const double area = area_at(valve, between(0.4, 1), &search);
    const solution found = solve(valve, "scale", factor * factor * area, &search);
    CHECK_NEAR(found.value, scale * factor, 1e-7 * scale * factor);
    assert_int_equal(found.range.n_turns, 0);
    CHECK_NEAR(found.range.most, 1e4 * found.range.least, 1e-6 * found.range.most);
  }
  /* A fixed half thickness narrows a small valve more than a large valve. */
  riis_surface_options options = surface_options();
  options.half_thickness = 0.1;
  riis_area_search search = area_search();
  search.surface = &options;
  search.area = RIIS_AREA_EFFECTIVE;
  riis_valve *valve = new_valve("trileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  const double area = area_of(valve, &search);
  search.from = 0.5, search.to = 2, search.n_samples = 5;
  options.scale = solve(valve, "scale", 2 * area, &search).value;
  assert_true(options.scale > 1.2 && options.scale < 0.99 * sqrt(2));
  CHECK_NEAR(area_of(valve, &search), 2 * area, 2e-4 * area);
}

/* A parameter is found by each of its two names. All other parameters stay, except those that follow from the found parameter. */
TEST(sizes_have_their_areas) {
  static const struct {
    const char *kind, *name;
  } sizes[] = {{"trileaflet", "annulus"},        {"trileaflet", "root_radius"}, {"coapting", "root_radius"},
               {"mitral", "ALPM_diameter"},      {"bileaflet", "radius"},       {"bileaflet", "open_angle"},
               {"aortic", "right.leaflet_angle"}};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i += (size_t)trial_step()) {
    if (i % 2 && !is_long_test()) continue;
    riis_valve *valve = new_valve(sizes[i].kind);
    riis_area_search search = area_search();
    search.n_samples = 5;
    const double before = area_at(valve, 1, &search);
    double size;
    CHECK_OK(riis_valve_get(valve, sizes[i].name, 1, &size));
    solution found;
    const double area = before * (strcmp(sizes[i].name, "open_angle") == 0 ? 0.9 : 1.05);
    const riis_status status = riis_find_by_area(valve, sizes[i].name, 1, &area, &search, &found.value, &found.reached,
                                                 &found.range, sizeof found.range);
    if (status != RIIS_OK) printf("%s %s: %s\n", sizes[i].kind, sizes[i].name, riis_last_error());
    CHECK_OK(status);
    printf("%s: %s %g -> %g, area %.4f -> %.4f of %.4f to %.4f, %d turns, %d refused\n", sizes[i].kind, sizes[i].name,
           size, found.value, before, found.reached, found.range.least, found.range.most, (int)found.range.n_turns,
           (int)found.range.n_refused);
    CHECK_OK(riis_valve_set_scalar(valve, sizes[i].name, found.value));
    CHECK_NEAR(area_of(valve, &search), area, 1e-4 * area);
  }
}

/* The areas of a changing opening are measured at some times. The table that follows from these areas has the same openings, and
 * the same rates between its keys. */
TEST(a_cycle_is_recovered) {
  enum { most = 33 };
  const int n = is_short_test() ? 5 : most;
  riis_opening_times law;
  CHECK_OK(riis_opening_times_init(&law, sizeof law));
  law.opening_start = 0.05, law.opening_duration = 0.1, law.closing_start = 0.35, law.closing_duration = 0.15;
  law.period = 0.8;
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  riis_area_search search = area_search();
  search.surface = &options;
  search.n_samples = 9;
  for (int kind = 2; kind < (is_long_test() ? 4 : 3); ++kind) {
    riis_valve *valve = new_valve(kinds[kind]);
    double time[most], opening[most], area[most], found[most], rate;
    for (int i = 0; i < n; ++i) {
      time[i] = 0.8 * i / (n - 1);
      CHECK_OK(riis_opening_from_times(&law, time[i], &opening[i], NULL));
      area[i] = area_at(valve, opening[i], &search);
    }
    riis_area_range range;
    CHECK_OK(riis_find_by_area(valve, "opening", n, area, &search, found, NULL, &range, sizeof range));
    for (int i = 0; i < n; ++i) CHECK_NEAR(found[i], opening[i], 1e-5);
    riis_opening_table table;
    CHECK_OK(riis_opening_table_init(&table, sizeof table));
    table.n_keys = n, table.time = time, table.opening = found, table.period = 0.8;
    table.interpolation = RIIS_INTERPOLATION_CUBIC;
    for (int i = 0; i < 80 && n == most; ++i) {
      double by_law, rate_by_law;
      CHECK_OK(riis_opening_from_table(&table, 0.01 * i + 0.003, &opening[0], &rate));
      CHECK_OK(riis_opening_from_times(&law, 0.01 * i + 0.003, &by_law, &rate_by_law));
      CHECK_NEAR(opening[0], by_law, 0.02);
      CHECK_NEAR(rate, rate_by_law, 3.5);
    }
    printf("%s: %d surfaces for %d areas\n", kinds[kind], (int)range.n_surfaces, n);
  }
}

/* A valve from flat patches whose area grows and then falls. A frame has a square hole, one blade widens to the right, and
 * another blade withdraws under the frame. */
enum { n_quads = 6 };
static const double half_hole = 0.9, half_frame = 2;
static double area_of_blades(double opening) {
  return 2 * half_hole * (2 * half_hole - (0.2 + 0.6 * opening) - fmax(0, 0.5 - 1.1 * opening));
}

static riis_valve *blades_at(double opening) {
  const double h = half_hole, f = half_frame, wide = 0.2 + 0.6 * opening, back = 0.5 - 1.1 * opening;
  /* Makes a patch from its corners at (u, v) = (0, 0), (1, 0), (0, 1) and (1, 1). */
  const double quad[n_quads][4][2] = {{{-f, -f}, {f, -f}, {-h, -h}, {h, -h}},
                                      {{f, -f}, {f, f}, {h, -h}, {h, h}},
                                      {{f, f}, {-f, f}, {h, h}, {-h, h}},
                                      {{-f, f}, {-f, -f}, {-h, h}, {-h, -h}},
                                      {{-h, -h}, {-h + wide, -h}, {-h, h}, {-h + wide, h}},
                                      {{h - back, -h}, {h, -h}, {h - back, h}, {h, h}}};
  static const int ends[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
  double control[n_quads][4][2][3];
  int32_t degree[4 * n_quads], curve_id[4 * n_quads];
  for (int q = 0; q < n_quads; ++q)
    for (int side = 0; side < 4; ++side) {
      degree[4 * q + side] = 1, curve_id[4 * q + side] = 4 * q + side;
      for (int end = 0; end < 2; ++end) {
        const double *corner = quad[q][ends[side][end]];
        /* The blades lie above the frame, without touching it. */
        memcpy(control[q][side][end], (double[3]){corner[0], corner[1], q < 4 ? 0 : 0.1 * (q - 3)}, 3 * sizeof(double));
      }
    }
  riis_patches patches;
  CHECK_OK(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 4 * n_quads, patches.degree = degree, patches.control = &control[0][0][0][0];
  patches.n_patches = n_quads, patches.curve_id = curve_id;
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create_from_patches(&patches, &valve));
  return own(valve);
}

/* If several openings have the area, the call takes the least. With other values of `from` and `to`, the call finds the other
 * openings with this area. */
TEST(turns_are_told) {
  riis_valve *valve = blades_at(0);
  CHECK_OK(riis_valve_set_open_state(valve, blades_at(1)));
  const double turn = 0.5 / 1.1, area = 2.2;
  riis_area_search search = area_search();
  search.n_samples = 17;
  const solution least = solve(valve, "opening", area, &search);
  CHECK_NEAR(area_of_blades(least.value), area, 5e-3);
  CHECK_NEAR(least.value, (area / 1.8 - 1.1) / 0.5, 5e-3);
  assert_int_equal(least.range.n_turns, 1);
  CHECK_NEAR(least.range.turns[0], turn, 1e-3);
  for (int i = 1; i < 4; ++i) assert_true(isnan(least.range.turns[i]));
  CHECK_NEAR(least.range.most_at, turn, 1e-3);
  CHECK_NEAR(least.range.most, area_of_blades(turn), 5e-3);
  CHECK_NEAR(least.range.least, area_of_blades(1), 5e-3);
  assert_true(least.range.least_at == 1);
  /* The search reaches the largest area, although none of its samples has the largest area. */
  const solution largest = solve(valve, "opening", least.range.most, &search);
  CHECK_NEAR(largest.value, turn, 1e-3);
  search.from = 0.5;
  const solution other = solve(valve, "opening", area, &search);
  CHECK_NEAR(other.value, (1.6 - area / 1.8) / 0.6, 5e-3);
  assert_int_equal(other.range.n_turns, 0);
  /* If several sizes have the area, the call takes the size nearest to the present one. */
  riis_valve *mitral = new_valve("mitral");
  search = area_search();
  search.from = 120, search.to = 176, search.n_samples = 9;
  CHECK_OK(riis_valve_set_scalar(mitral, "leaflet_inward_angle", 172));
  const double both = area_at(mitral, 1, &search);
  CHECK_OK(riis_valve_set_scalar(mitral, "leaflet_inward_angle", 175));
  const solution above = solve(mitral, "leaflet_inward_angle", both, &search);
  assert_int_equal(above.range.n_turns, 1);
  CHECK_NEAR(above.value, 172, 0.1);
  CHECK_NEAR(above.reached, both, 1e-4 * both);
  if (is_short_test()) return; /* the next search takes as long as the last one */
  CHECK_OK(riis_valve_set_scalar(mitral, "leaflet_inward_angle", 125));
  const solution below = solve(mitral, "leaflet_inward_angle", both, &search);
  printf("turn of the mitral valve at %.2f; angles %.3f and %.3f\n", below.range.turns[0], below.value, above.value);
  assert_true(below.value < below.range.turns[0]);
  CHECK_NEAR(below.reached, both, 1e-4 * both);
}

/* The area 0 stands for the closed valve, even if slits remain. */
TEST(no_area_closes) {
  for (int kind = 0; kind < n_kinds; kind += trial_step()) {
    riis_area_search search = area_search();
    search.n_samples = 3;
    const solution closed = solve(new_valve(kinds[kind]), "opening", 0, &search);
    assert_true(closed.value == 0);
    assert_true(closed.reached == closed.range.least);
  }
  const double none = 0;
  riis_valve *valve = new_valve("aortic");
  double opening = 7;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "area 0 is 0, which is out of reach",
                riis_find_by_area(valve, "scale", 1, &none, NULL, &opening, NULL, NULL, 0));
  assert_true(opening == 7);
}

TEST(searches_are_refused) {
  riis_valve *valve = new_valve("trileaflet");
  riis_area_range range;
  double value = 7, reached = 7, areas[3] = {1, 2, 3};
  const int64_t size = sizeof range;
#define REFUSED(status, text, valve, name, n, search) \
  CHECK_REFUSED(status, text, riis_find_by_area(valve, name, n, areas, search, &value, &reached, &range, size))
  riis_area_search search = area_search();
  search.n_samples = 3;
  REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", NULL, "opening", 1, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "name is NULL", valve, NULL, 1, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "n_areas is -1; it must be from 0 to 1000000", valve, "opening", -1, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "n_areas is 1000001", valve, "opening", 1000001, NULL);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "areas is NULL",
                riis_find_by_area(valve, "opening", 1, NULL, &search, &value, NULL, NULL, 0));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "range is 8",
                riis_find_by_area(valve, "opening", 1, areas, &search, &value, NULL, &range, 8));
  const double bad[] = {NAN, -1, INFINITY, 1e121};
  static const char *const texts[] = {"area 1 is nan; it must be from 0 to 1e+120", "area 1 is -1;", "area 1 is inf;",
                                      "area 1 is 1e+121;"};
  for (int i = 0; i < 4; ++i) {
    areas[1] = bad[i];
    REFUSED(RIIS_INVALID_ARGUMENT, texts[i], valve, "opening", 3, NULL);
  }
  areas[1] = 9;
  REFUSED(RIIS_INVALID_ARGUMENT, "area 1 is 9, which is out of reach: from opening 0 to 1 the area goes from 0 to 3.9",
          valve, "opening", 2, &search);
  search.area = RIIS_AREA_EFFECTIVE;
  REFUSED(RIIS_INVALID_ARGUMENT, "from opening 0 to 1 the effective area goes from 0 to 3.", valve, "opening", 2,
          &search);
  search.area = 2;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.area is 2; it must be RIIS_AREA_GEOMETRIC or RIIS_AREA_EFFECTIVE", valve,
          "opening", 1, &search);
  search = area_search();
  search.n_samples = 1;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.n_samples is 1; it must be from 2 to 100001", valve, "opening", 1, &search);
  search.n_samples = 3, search.tolerance = 0;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.tolerance is 0; it must be from 1e-12 to 0.01", valve, "opening", 1, &search);
  search.tolerance = 1e-8, search.from = -0.1;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.from is -0.1; it must be from 0 to 1", valve, "opening", 1, &search);
  search.from = 0.5, search.to = 1.1;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.to is 1.1; it must be from 0 to 1", valve, "opening", 1, &search);
  search.to = 0.5;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.to is 0.5; it must be above the start of the range, 0.5", valve, "opening", 1,
          &search);
  search.from = 0;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.from is 0; it must be from 1e-12 to", valve, "scale", 1, &search);
  search.struct_size = 8;
  REFUSED(RIIS_INVALID_STRUCT_SIZE, "search is 8", valve, "opening", 1, &search);
  search = area_search();
  search.n_samples = 3;
  REFUSED(RIIS_INVALID_PARAMETER, "'root_radus' is not a parameter of the trileaflet valve; did you mean 'root_radius'",
          valve, "root_radus", 1, &search);
  REFUSED(RIIS_INVALID_PARAMETER, "parameter 'translation' has 3 values, not 1", valve, "translation", 1, &search);
  REFUSED(RIIS_INVALID_PARAMETER, "parameter 'leaflet_angle' exists for each leaflet separately: name a leaflet",
          new_valve("aortic"), "leaflet_angle", 1, &search);
  REFUSED(RIIS_INVALID_PARAMETER, "root_height does not change the area, which is ", new_valve("aortic"), "root_height",
          1, &search);
  CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.3));
  REFUSED(RIIS_INVALID_PARAMETER, "skirt_length does not change the area", valve, "skirt_length", 1, &search);
  CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0));
  REFUSED(RIIS_INVALID_ARGUMENT, "skirt_length is 0, so a range to search is needed", valve, "skirt_length", 1,
          &search);
  search.from = -1, search.to = 1;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.from is -1; it must be from 0 to", valve, "skirt_length", 1, &search);
  /* The refused valves lack an open state, lack an orifice, or have values that are invalid together. */
  search = area_search();
  search.n_samples = 3;
  REFUSED(RIIS_INVALID_PARAMETER, "valve has only one state: set its open state with riis_valve_set_open_state",
          blades_at(0), "opening", 1, &search);
  CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", 20));
  REFUSED(RIIS_INVALID_PARAMETER, "at opening 0: leaflet_height is 20", valve, "opening", 1, &search);
  CHECK_OK(riis_valve_unset(valve, "leaflet_height"));
  /* Bad options of the surface and of the resistance are refused as other calls refuse them. */
  riis_surface_options options = surface_options();
  options.scale = 0;
  search.surface = &options;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.surface: options.scale is 0", valve, "opening", 1, &search);
  REFUSED(RIIS_INVALID_ARGUMENT, "search.surface.scale is 0", valve, "scale", 1, &search);
  riis_resistance how = resistance(-2, RIIS_RIM_CUT);
  search.surface = NULL, search.resistance = &how;
  REFUSED(RIIS_INVALID_ARGUMENT, "search.resistance.half_thickness is -2", valve, "opening", 1, &search);
  assert_true(value == 7 && reached == 7);
#undef REFUSED
}

/* The search skips values with which no valve can be made. */
TEST(impossible_sizes_are_left_out) {
  riis_valve *valve = new_valve("trileaflet");
  const riis_area_search usual = area_search();
  riis_area_search search = area_search();
  const double area = 1.02 * area_at(valve, 1, &usual);
  search.from = 0.01, search.to = 20;
  const solution found = solve(valve, "root_radius", area, &search);
  printf("%d of %d radii refused, found %g\n", (int)found.range.n_refused, search.n_samples, found.value);
  assert_true(found.range.n_refused > 5);
  CHECK_OK(riis_valve_set_scalar(valve, "root_radius", found.value));
  CHECK_NEAR(area_of(valve, &usual), area, 1e-4 * area);
}

/* Without areas, the call gives the range of areas. Every result is optional. */
TEST(ranges_need_no_areas) {
  riis_valve *valve = new_valve("bileaflet");
  riis_area_search search = area_search();
  search.n_samples = 5;
  riis_area_range range;
  CHECK_OK(riis_find_by_area(valve, "opening", 0, NULL, &search, NULL, NULL, &range, sizeof range));
  assert_true(range.from == 0 && range.to == 1 && range.least_at == 0 && range.most_at == 1);
  assert_true(range.most == area_at(valve, 1, &search) && range.least == area_at(valve, 0, &search));
  assert_int_equal(range.n_surfaces, 5);
  assert_true(range.seconds > 0);
  const double area = 1;
  CHECK_OK(riis_find_by_area(valve, "opening", 1, &area, &search, NULL, NULL, NULL, 0));
}

int main(void) {
  rng = random_start("test_by_area");
  return run_cases(NULL, NULL);
}
