/* SPDX-License-Identifier: Apache-2.0
 *
 * The log warns of leaflets that go through each other, once for each shape that the user chose. The test compares the warnings
 * with the pairs of riis_find_crossings. Without a log function, the library does not search, which the number of allocations
 * shows. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"

/* These functions replace operator new for the process, because symbols of an executable come before those of libraries. With a
 * sanitizer the functions are not replaced, because the sanitizer's allocator must be the only one. */
static int64_t n_allocations;
#ifndef IS_SANITIZED
void *new_one(size_t size) __asm__("_Znwm");
void *new_one(size_t size) {
  void *p = malloc(size ? size : 1);
  if (!p) abort(); /* C cannot throw, so this aborts */
  __atomic_fetch_add(&n_allocations, 1, __ATOMIC_RELAXED);
  return p;
}
#endif

typedef struct heard {
  int n;
  char last[512];
} heard;
static heard warnings;

static void listen(void *user_data, int32_t level, const char *message) {
  heard *to = user_data;
  if (level != RIIS_LOG_WARNING) return;
  ++to->n;
  snprintf(to->last, sizeof to->last, "%s", message);
}

static int start_listening(void **state) {
  (void)state;
  memset(&warnings, 0, sizeof warnings);
  riis_set_log(listen, &warnings);
  return 0;
}

static int stop_listening(void **state) {
  riis_set_log(NULL, NULL);
  return free_owned(state);
}

static void set(riis_valve *valve, const char *name, double value) {
  CHECK_OK(riis_valve_set_scalar(valve, name, value));
}

static void update(riis_surface *surface, const riis_valve *valve) {
  CHECK_OK(riis_surface_update(surface, valve, NULL));
}

/* Checks that the numbers of the last warning are those of riis_find_crossings. */
static void expect_pairs_of(riis_surface *surface) {
  riis_crossing_list found;
  char part[64];
  CHECK_OK(find_crossings_in(surface, NULL, &found));
  assert_true(found.n_pairs > 0);
  snprintf(part, sizeof part, ": %lld pair", (long long)found.n_pairs);
  if (!strstr(warnings.last, part)) fail_msg("'%s' has no '%s'", warnings.last, part);
  snprintf(part, sizeof part, "up to %.3g deep", found.deepest_depth);
  if (!strstr(warnings.last, part)) fail_msg("'%s' has no '%s'", warnings.last, part);
}

TEST_WITH(a_shape_is_named_once, start_listening, stop_listening) {
  riis_valve *valve = new_valve("trileaflet");
  set(valve, "bending_height", 0.55);
  riis_surface *surface = new_surface(valve, NULL);
  assert_int_equal(warnings.n, 1);
  assert_ptr_equal(strstr(warnings.last, "leaflets 0 and 2 go through each other at opening 0: "), warnings.last);
  expect_pairs_of(surface);
  for (int i = 0; i < 100; ++i) {
    set(valve, "opening", i % 10 / 10.0);
    set(valve, "bending_height", 0.55);
    if (i % 2 == 0)
      update(surface, valve);
    else
      CHECK_OK(riis_surface_update_moving(surface, valve, valve, 0.1, NULL, NULL));
  }
  assert_int_equal(warnings.n, 1);
  /* The shape changes, and then changes back. A copy of the valve has the same shape. */
  set(valve, "opening", 0);
  set(valve, "bending_height", 0.56);
  update(surface, valve);
  assert_int_equal(warnings.n, 2);
  expect_pairs_of(surface);
  set(valve, "bending_height", 0.55);
  riis_valve *copy = NULL;
  CHECK_OK(riis_valve_copy(valve, &copy));
  own(copy);
  update(surface, copy);
  assert_int_equal(warnings.n, 2);
  /* A new surface has not searched for crossings yet, so it warns again. */
  new_surface(valve, NULL);
  assert_int_equal(warnings.n, 3);
}

/* The valve is open at first and closes later. The library searches each new range of the opening until it finds a crossing. */
TEST_WITH(a_valve_that_begins_open_is_named, start_listening, stop_listening) {
  riis_valve *valve = new_valve("trileaflet");
  set(valve, "bending_height", 0.55);
  set(valve, "opening", 1);
  riis_surface *surface = new_surface(valve, NULL);
  assert_int_equal(warnings.n, 0);
  for (int i = 10; i >= 0; --i) {
    set(valve, "opening", i / 10.0);
    update(surface, valve);
  }
  assert_int_equal(warnings.n, 1);
}

static const char *const kinds[] = {"aortic", "trileaflet", "mitral", "bileaflet", "coapting"};

/* Leaflets of default shapes and of other healthy shapes do not cross at any opening. Closed mitral leaflets touch. The fixed
 * triangles of such leaflets cross by less than the depth that counts as a crossing. */
TEST_WITH(sound_shapes_are_not_named, start_listening, stop_listening) {
  for (int kind = 0; kind < 5; ++kind)
    for (int32_t triangulation = 0; triangulation < 2; ++triangulation) {
      riis_surface_options options = surface_options();
      options.triangulation = triangulation;
      riis_valve *valve = new_valve(kinds[kind]);
      set(valve, "opening", 0);
      riis_surface *surface = new_surface(valve, &options);
      for (int i = 1; i <= 10; ++i) set(valve, "opening", i / 10.0), update(surface, valve);
    }
  riis_surface_options fixed = surface_options();
  fixed.triangulation = RIIS_TRIANGULATION_FIXED;
  riis_valve *valve = new_valve("mitral");
  set(valve, "opening", 0);
  set(valve, "anterior_length", 2.2);
  riis_surface *surface = new_surface(valve, &fixed);
  riis_crossing_list found;
  CHECK_OK(find_crossings_in(surface, NULL, &found));
  assert_true(found.n_pairs > 0);
  /* A bileaflet valve's hinges reach into its housing. */
  valve = new_valve("bileaflet");
  set(valve, "ring_height", 0.5);
  set(valve, "opening", 0.5);
  surface = new_surface(valve, NULL);
  CHECK_OK(find_crossings_in(surface, NULL, &found));
  assert_true(found.n_pairs > 0 && found.deepest_leaflet_id[1] == RIIS_LEAFLET_HOUSING);
  assert_int_equal(warnings.n, 0);
}

/* One unit square lies at z = 0. An upright square at y = 0.5 cuts through the first square. The squares are one leaflet or two
 * leaflets. */
TEST_WITH(patches_are_a_shape_of_the_user, start_listening, stop_listening) {
  for (int32_t second = 0; second < 2; ++second) {
    const double control[] = {0,  0,  0, 1,  0,  0, 0,   1,  0,  1,  1,   0,  0,   0,   0,  0,
                              1,  0,  1, 0,  0,  1, 1,   0,  .5, 0,  -.4, .5, 1,   -.4, .5, 0,
                              .6, .5, 1, .6, .5, 0, -.4, .5, 0,  .6, .5,  1,  -.4, .5,  1,  .6};
    const int32_t degree[] = {1, 1, 1, 1, 1, 1, 1, 1}, curve_id[] = {0, 1, 2, 3, 4, 5, 6, 7},
                  leaflet_id[] = {0, second};
    riis_patches patches;
    riis_valve *valve = NULL;
    CHECK_OK(riis_patches_init(&patches, sizeof patches));
    patches.n_curves = 8;
    patches.degree = degree;
    patches.control = control;
    patches.n_patches = 2;
    patches.curve_id = curve_id;
    patches.leaflet_id = leaflet_id;
    CHECK_OK(riis_valve_create_from_patches(&patches, &valve));
    own(valve);
    new_surface(valve, NULL);
    assert_int_equal(warnings.n, second + 1);
    assert_non_null(
        strstr(warnings.last, second ? "leaflets 0 and 1 go through each other" : "leaflet 0 goes through"));
  }
}

/* The open state belongs to the shape. */
TEST_WITH(an_open_state_makes_another_shape, start_listening, stop_listening) {
  riis_valve *valve = new_valve("trileaflet"), *open = new_valve("trileaflet");
  set(valve, "bending_height", 0.55);
  riis_surface *surface = new_surface(valve, NULL);
  assert_int_equal(warnings.n, 1);
  set(open, "bending_height", 0.55);
  CHECK_OK(riis_valve_set_open_state(valve, open));
  update(surface, valve);
  assert_int_equal(warnings.n, 2);
}

/* Counts the allocations of ten updates to different shapes. The surface has allocated all its memory before. */
static int64_t allocations_of_updates(double height) {
  riis_valve *valve = new_valve("trileaflet");
  riis_surface *surface = new_surface(valve, NULL);
  int64_t before = 0;
  for (int i = 0; i < 20; ++i) {
    if (i == 10) before = n_allocations;
    if (height > 0) set(valve, "bending_height", height - 1e-9 * i);
    update(surface, valve);
  }
  return n_allocations - before;
}

TEST_WITH(nobody_searches_in_silence, start_listening, stop_listening) {
  riis_set_log(NULL, NULL);
  const int64_t of_default = allocations_of_updates(0), in_silence = allocations_of_updates(0.55);
  riis_set_log(listen, &warnings);
  const int64_t of_default_heard = allocations_of_updates(0);
  assert_int_equal(warnings.n, 0);
  const int64_t heard_all = allocations_of_updates(0.55);
  assert_int_equal(warnings.n, 20);
  print_message("allocations of 10 updates: default %lld, another shape in silence %lld, heard %lld\n",
                (long long)of_default, (long long)in_silence, (long long)heard_all);
  assert_true(of_default_heard == of_default && in_silence <= of_default);
#ifndef IS_SANITIZED
  assert_true(heard_all > in_silence + 10);
#endif
  /* A log function that is set later gets the warning about an earlier shape. */
  riis_set_log(NULL, NULL);
  riis_valve *valve = new_valve("trileaflet");
  set(valve, "bending_height", 0.55);
  riis_surface *surface = new_surface(valve, NULL);
  update(surface, valve);
  riis_set_log(listen, &warnings);
  update(surface, valve);
  assert_int_equal(warnings.n, 21);
}

int main(void) { return run_cases(NULL, NULL); }
