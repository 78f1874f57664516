/* SPDX-License-Identifier: Apache-2.0
 * Studies valves that patients have. Valves of random sizes do not cross, and closed valves are sealed. Symmetric sizes give
 * symmetric valves. Velocities are those of the vertices. RIIS_TEST_LONG=1 makes 300 sets for each row of the random study. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "cusp_checks.h"
#include "studied_valves.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

/* --- Random valves ----------------------------------------------------------------------------------------------------- */

/* Returns whether leaflets cross at one of some openings. */
static int crosses(riis_valve *valve, riis_crossings *crossings) {
  static const double openings[] = {0, 0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 1};
  const int n = is_long_test() ? 21 : (int)(sizeof openings / sizeof *openings);
  riis_surface_options options = surface_options();
  options.tolerance = 0.02;
  for (int i = 0; i < n; ++i) {
    riis_crossing_list list;
    riis_surface *surface = surface_at(valve, is_long_test() ? i / 20.0 : openings[i], &options);
    CHECK_OK(riis_find_crossings(surface, NULL, crossings));
    CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
    free_one_owned(surface);
    if (list.n_pairs == 0) continue;
    printf("  leaflets %d and %d cross at the opening %.4g, %.2g deep, at %.3f %.3f %.3f:", list.deepest_leaflet_id[0],
           list.deepest_leaflet_id[1], get(valve, "opening"), list.deepest_depth, list.deepest_point[0],
           list.deepest_point[1], list.deepest_point[2]);
    print_values(valve);
    return 1;
  }
  return 0;
}

/* The bound on the number of bad sets is a share of all n sets. For few sets, the bound is wider by three standard deviations,
 * because chance may exceed the share. */
static double at_most(double share, int n) {
  return n * share + (is_long_test() ? 0 : 3 * sqrt(n * share * (1 - share)));
}

typedef struct tally {
  int accepted, refused, crossing;
} tally;

/* Makes n valves for a row of the study. A row is a kind with its sectors. */
static void study_row(const studied *of, double spread, sickness has, int n, riis_crossings *crossings, tally *count) {
  const tally before = *count;
  while (count->accepted - before.accepted < n && count->refused - before.refused <= 2 * n + 10) {
    const int owned_before = n_owned();
    riis_valve *valve = random_valve(&rng, of, spread, has);
    *(valve ? &count->accepted : &count->refused) += 1;
    if (valve) count->crossing += crosses(valve, crossings);
    free_owned_after(owned_before);
  }
  printf("%s %s, sizes +-%.0f %%, %s: %d of %d sets cross, %d refused\n", of->kind, of->settings, 100 * spread,
         names_of_sicknesses[has], count->crossing - before.crossing, count->accepted - before.accepted,
         count->refused - before.refused);
}

/* Returns how often too many sets cross or are refused. With many sets, each row has its own share. With few sets, all rows have
 * one common share. */
static int broken_bounds(double spread, const double *most_crossing, const double *most_refused) {
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  int broken = 0;
  for (sickness has = healthy; has < n_sicknesses; ++has) {
    tally count = {0, 0, 0};
    for (int row = 0; row < n_studied; ++row) {
      const studied *of = &all_studied[row];
      /* Leaflets around a saddle do not fuse. Kinds with cusps have two rows, so two spreads give at least 20 sets of each
       * kind. */
      if ((has != fused || of->has_cusps) && (n_studied * (int)has + row) % trial_step() == 0)
        study_row(of, spread, has, trials(of->has_cusps ? 2 : 5, 300), crossings, &count);
      if (!is_long_test() && row + 1 < n_studied) continue;
      const int too_many_cross = count.crossing > at_most(most_crossing[has], count.accepted);
      const int too_many_refused = count.refused > at_most(most_refused[has], count.accepted + count.refused);
      if (too_many_cross || too_many_refused)
        printf("too many: %d of %d cross, %d refused\n", count.crossing, count.accepted, count.refused);
      broken += too_many_cross + too_many_refused;
      count = (tally){0, 0, 0};
    }
  }
  return broken;
}

TEST(random_valves_do_not_cross) {
  /* Bumps of random places and widths fold an eighth of the bicuspid valves, even if all other sizes are nearly usual. */
  static const double none_crosses[n_sicknesses] = {0, 0, 0}, few_cross[n_sicknesses] = {0.01, 0.01, 0.02},
                      few_refused[n_sicknesses] = {0.1, 0.1, 0.35}, some_refused[n_sicknesses] = {0.35, 0.35, 0.35};
  assert_int_equal(broken_bounds(0.1, none_crosses, few_refused), 0);
  assert_int_equal(broken_bounds(0.2, few_cross, some_refused), 0);
}

/* --- Sealing ----------------------------------------------------------------------------------------------------------- */

/* Returns whether a closed valve leaks. Cusps stand in a tube, and other leaflets inside their annulus. */
static int leaks_when(riis_valve *valve, const studied *of, double opening, double half_thickness) {
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  if (of->has_cusps) return leaks_through(valve, get(valve, "root_radius"), -0.8, half_thickness);
  uint8_t is_wall[n_across * n_across];
  riis_surface_options options = surface_options();
  riis_attachment annulus;
  options.half_thickness = half_thickness;
  riis_surface *surface = new_surface(valve, &options);
  CHECK_OK(riis_surface_get_attachment(surface, &annulus, sizeof annulus));
  for (int i = 0; i < n_across * n_across; ++i)
    is_wall[i] = !is_inside(&annulus, grid_place(i % n_across, half_width), grid_place(i / n_across, half_width));
  const int leaks = leaks_between(surface, is_wall, half_width, -2.2);
  free_one_owned(surface);
  return leaks;
}

TEST(closed_valves_are_sealed) {
  for (int row = 0; row < n_studied; row += trial_step()) {
    const studied *of = &all_studied[row];
    riis_valve *valve = valve_of(of->kind, of->settings);
    for (int k = 0; k < 2; ++k)
      if (leaks_when(valve, of, 0, k ? 0.05 : 0.1)) fail_msg("%s %s leaks", of->kind, of->settings);
    assert_true(leaks_when(valve, of, 0.3, 0.05));
    if (!of->has_cusps) continue;
    /* The wall is farther out than the attachment, so only a skirt reaches the wall. */
    const double wall = 1.15 * get(valve, "root_radius");
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    assert_true(leaks_through(valve, wall, -0.8, 0.05));
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.3));
    for (int k = 0; k < 2; ++k) assert_false(leaks_through(valve, wall, -0.8, k ? 0.05 : 0.1));
  }
}

/* The fill finds exactly the gaps that are wider than the band. */
TEST(fills_find_gaps) {
  const studied cusps = {"coapting", 3, 1, "gap=0.25"};
  riis_valve *apart = valve_of(cusps.kind, cusps.settings);
  assert_true(leaks_when(apart, &cusps, 0, 0.05));
  assert_false(leaks_when(apart, &cusps, 0, 0.15));
  for (int row = 0; row < n_studied; row += trial_step()) {
    riis_valve *valve = valve_of(all_studied[row].kind, all_studied[row].settings);
    for (int k = 0; k < all_studied[row].n_leaflets; ++k) {
      set_bump(valve, k, "leaflet", k);
      set_bump(valve, k, "closed", 0.4);
    }
    assert_true(leaks_when(valve, &all_studied[row], 0, 0.05));
  }
}

/* --- Symmetry ---------------------------------------------------------------------------------------------------------- */

/* Makes the same valve with its leaflets in another order: leaflet `shift` becomes leaflet 0. A mirror image also reverses the
 * order of the leaflets and the direction of each free edge. */
static riis_valve *reordered(const riis_valve *valve, int n_leaflets, int shift, int is_mirrored) {
  riis_valve *made = NULL;
  int64_t n;
  CHECK_OK(riis_valve_copy(valve, &made));
  own(made);
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  for (int64_t id = 0; id < n; ++id) {
    riis_parameter parameter;
    CHECK_OK(riis_valve_get_parameter(valve, id, &parameter, sizeof parameter));
    const char *name = parameter.name, *dot = strchr(name, '.');
    if (parameter.n_values != 1) continue;
    double value = get(valve, name);
    if (strcmp(name, "meeting_shift") == 0 && shift) CHECK_OK(riis_valve_set_scalar(made, name, -value));
    if (!dot) continue;
    const int is_bump = strncmp(name, "bump_", 5) == 0;
    const int is_commissure = strncmp(is_bump ? dot + 1 : name, "commissure", 10) == 0;
    int number = is_bump ? (int)value : atoi(strchr(name, '_') + 1);
    if (number >= 0)
      number =
          (is_mirrored ? (is_commissure ? 2 * n_leaflets - 1 : n_leaflets) - number : number + n_leaflets - shift) %
          n_leaflets;
    if (!is_bump)
      set_numbered(made, is_commissure ? "commissure_" : "cusp_", number, dot, value);
    else {
      if (strcmp(dot, ".leaflet") == 0 || is_commissure) value = number;
      if (strcmp(dot, ".u") == 0 && is_mirrored) value = 1 - value;
      CHECK_OK(riis_valve_set_scalar(made, name, value));
    }
  }
  return made;
}

/* Returns the angle from the middle of cusp 0 to the middle of cusp `to`. */
static double angle_of(const riis_valve *valve, int n_leaflets, int to) {
  double sector[max_leaflets], sum = 0, angle = 0;
  for (int k = 0; k < n_leaflets; ++k) {
    char name[32];
    snprintf(name, sizeof name, "cusp_%d.sector", k);
    sum += sector[k] = get(valve, name);
  }
  for (int k = 0; k < to; ++k) angle += (sector[k] + sector[k + 1]) / 2;
  return 360 * angle / sum;
}

/* Returns how far the vertices of one surface are from the other surface. First, x and y of the vertices are multiplied by
 * `side`. */
static double farthest(const riis_surface *from, const double *side, const riis_surface *to) {
  const riis_triangles all = triangles_of(from);
  double most = 0;
  for (int64_t i = 0; i < all.n_vertices; i += 5) {
    const double *p = all.xyz + 3 * i;
    most = fmax(most, closest_to(to, side[0] * p[0], side[1] * p[1], p[2]).distance);
  }
  return most;
}

TEST(reordered_leaflets_make_the_same_valve) {
  double worst = 0;
  for (int trial = 0; trial < trials(6 * n_studied, 30 * n_studied); ++trial) {
    const int owned_before = n_owned(), is_mirrored = trial / n_studied % 2;
    const studied *of = &all_studied[trial % n_studied];
    /* The leaflets around a saddle differ. Each leaflet of a mitral valve equals its mirror image. */
    riis_valve *valve = of->has_cusps ? random_valve(&rng, of, 0.1, (sickness)(trial / n_studied / 2 % n_sicknesses))
                        : of->n_leaflets == 2 && is_mirrored ? valve_of(of->kind, of->settings)
                                                             : NULL;
    if (!valve) continue;
    if (!of->has_cusps) add_bumps(&rng, valve, of);
    const int shift = is_mirrored ? 0 : 1 + (int)between(0, of->n_leaflets - 1);
    riis_valve *other = reordered(valve, of->n_leaflets, shift, is_mirrored);
    riis_surface_options turned = surface_options();
    turned.rotation_angle = shift ? -angle_of(valve, of->n_leaflets, shift) : 0;
    /* Cusp 0 equals its mirror image about the x axis. Leaflets around a saddle equal their mirror images about the y axis. */
    const double opening = between(0, 1), other_side = is_mirrored ? -1 : 1;
    const double side[2] = {of->has_cusps ? 1 : other_side, of->has_cusps ? other_side : 1};
    riis_surface *a = surface_at(valve, opening, &turned), *b = surface_at(other, opening, NULL);
    const double off = fmax(farthest(a, side, b), farthest(b, side, a));
    if (off > 1e-9) {
      printf("%s, shift %d, mirrored %d: off by %.3g:", of->kind, shift, is_mirrored, off);
      print_values(valve);
    }
    worst = fmax(worst, off);
    free_owned_after(owned_before);
  }
  printf("reordered valves differ by %.2g cm\n", worst);
  CHECK_AT_MOST(worst, 1e-9);
}

/* Only the ratio of the sectors matters. A size that is not set follows from others. */
TEST(equal_values_make_equal_valves) {
  for (int row = 0; row < n_studied; row += trial_step()) {
    const studied *of = &all_studied[row];
    if (!of->has_cusps) continue;
    riis_valve *valve = valve_of(of->kind, of->settings), *other = valve_of(of->kind, of->settings);
    for (int k = 0; k < of->n_leaflets; ++k) {
      char name[32];
      snprintf(name, sizeof name, "cusp_%d.sector", k);
      CHECK_OK(riis_valve_set_scalar(other, name, 0.75 * get(valve, name)));
      CHECK_NEAR(get(other, name), 0.75 * get(valve, name), 0);
    }
    assert_true(is_same_content(surface_at(valve, 0.4, NULL), surface_at(other, 0.4, NULL)));
    CHECK_OK(riis_valve_set_scalar(valve, "effective_height", 0.95));
    for (int k = 0; k < of->n_leaflets; ++k) set_numbered(other, "cusp_", k, ".effective_height", 0.95);
    assert_true(is_same_content(surface_at(valve, 0.4, NULL), surface_at(other, 0.4, NULL)));
    set_numbered(other, "cusp_", 1, ".effective_height", 0.85);
    assert_false(is_same_content(surface_at(valve, 0.4, NULL), surface_at(other, 0.4, NULL)));
    for (int k = 0; k < of->n_leaflets; ++k) {
      char name[64];
      snprintf(name, sizeof name, "cusp_%d.effective_height", k);
      CHECK_OK(riis_valve_unset(other, name));
    }
    CHECK_OK(riis_valve_unset(valve, "effective_height"));
    assert_true(is_same_content(surface_at(valve, 0.4, NULL), surface_at(other, 0.4, NULL)));
  }
}

/* --- Motion and warps -------------------------------------------------------------------------------------------------- */

/* With fixed triangles, velocities are differences of the vertices' places, up to the rounding of these places. A restart at
 * another opening has the same bits. */
TEST(velocities_are_differences) {
  riis_surface_options fixed = surface_options();
  fixed.triangulation = RIIS_TRIANGULATION_FIXED;
  const double step = 0.2, dt = 0.02;
  for (int row = 0; row < n_studied; row += trial_step()) {
    const int owned_before = n_owned();
    const studied *of = &all_studied[row];
    riis_valve *valve = valve_of(of->kind, of->settings), *before = NULL;
    set_all(valve, "bump_0.leaflet=1 bump_0.u=0.4 bump_0.closed=0.2 bump_0.open=0.6");
    riis_surface *moving = surface_at(valve, 0, &fixed);
    const int64_t n = 3 * triangles_of(moving).n_vertices;
    double farthest_moved = 0, off = 0, bound = 0, *earlier = own(malloc((size_t)n * sizeof *earlier));
    for (int i = 1; i <= 3; ++i) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", i / 3.0 - step));
      CHECK_OK(riis_surface_update(moving, valve, NULL));
      memcpy(earlier, triangles_of(moving).xyz, (size_t)n * sizeof *earlier);
      CHECK_OK(riis_valve_copy(valve, &before));
      own(before);
      CHECK_OK(riis_valve_set_scalar(valve, "opening", i / 3.0));
      CHECK_OK(riis_surface_update_moving(moving, valve, before, dt, NULL, NULL));
      const double *now = triangles_of(moving).xyz, *velocity = velocity_of(moving);
      for (int64_t k = 0; k < n; ++k) {
        farthest_moved = fmax(farthest_moved, fabs(dt * velocity[k]));
        off = fmax(off, fabs(dt * velocity[k] - (now[k] - earlier[k])));
      }
      bound = fmax(bound, 2 * info_of(moving).error_bound);
    }
    assert_true(is_same_content(moving, new_surface(valve, &fixed)));
    printf("%s %s: in a step of 1/5 vertices move by up to %.3f, velocities miss it by up to %.2g\n", of->kind,
           of->settings, farthest_moved, off);
    assert_true(farthest_moved > 10 * bound);
    CHECK_AT_MOST(off, bound);
    free_owned_after(owned_before);
  }
}

TEST(a_warp_to_the_same_places_changes_nothing) {
  enum { n = 25 };
  static const double here[2] = {1, 1};
  for (int row = 0; row < n_studied; row += trial_step()) {
    riis_valve *valve = valve_of(all_studied[row].kind, all_studied[row].settings);
    riis_surface *plain = surface_at(valve, 0.3, NULL);
    const riis_triangles all = triangles_of(plain);
    double places[3 * n];
    for (int i = 0; i < 3 * n; ++i)
      places[i] = all.xyz[3 * (all.n_vertices * (i / 3) / n) + i % 3] + between(-0.05, 0.05);
    const riis_points points = points_at(n, places);
    riis_warp *warp = NULL;
    CHECK_OK(riis_warp_create(&points, NULL, &warp));
    own(warp);
    CHECK_OK(riis_warp_set_targets(warp, &points));
    CHECK_OK(riis_valve_set_warp(valve, warp, warp));
    riis_surface *warped = new_surface(valve, NULL);
    const double allowed = info_of(plain).error_bound + info_of(warped).error_bound + 1e-9;
    CHECK_AT_MOST(farthest(plain, here, warped), allowed);
    CHECK_AT_MOST(farthest(warped, here, plain), allowed);
  }
}

int main(void) {
  rng = random_start("test_valve_studies");
  return run_cases(NULL, NULL);
}
