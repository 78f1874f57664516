/* SPDX-License-Identifier: Apache-2.0
 * Tests riis_find_first_passage. The opening that the call finds is compared with riis_find_passage at many openings. The opening
 * is also compared with a slit of known width. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "random_meshes.h"
#include "shapes.h"

#include "flood_fill.h"

static riis_first_passage_options first_options(void) {
  riis_first_passage_options options;
  CHECK_OK(riis_first_passage_options_init(&options, sizeof options));
  return options;
}

typedef struct two_ends {
  int64_t from, to;
} two_ends;

static riis_passage_ends ends_of(const two_ends *e) {
  riis_passage_ends ends;
  CHECK_OK(riis_passage_ends_init(&ends, sizeof ends));
  ends.n_from = ends.n_to = 1;
  ends.from = &e->from, ends.to = &e->to;
  return ends;
}

static riis_first_passage first_of(const riis_valve *valve, const riis_mesh *mesh, const two_ends *e,
                                   const riis_first_passage_options *options) {
  const riis_passage_ends ends = ends_of(e);
  riis_first_passage first;
  memset(&first, 0x5a, sizeof first);
  CHECK_OK(riis_find_first_passage(valve, mesh, &ends, options, &first, sizeof first));
  assert_true(first.seconds >= 0);
  return first;
}

static riis_passage passage_at(riis_valve *valve, double opening, const riis_mesh *mesh, const two_ends *e,
                               const riis_surface_options *options) {
  riis_passage passage;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  riis_surface *surface = new_surface(valve, options);
  CHECK_OK(find_passage_between(surface, mesh, NULL, 1, &e->from, 1, &e->to, &passage, sizeof passage));
  free_one_owned(surface);
  return passage;
}

/* The valve fills a tube, so each path through the tube leads through the valve. */
TEST(valves_first_open_where_a_ladder_says) {
  static const char *const kinds[4] = {"trileaflet", "bileaflet", "mitral", "coapting"};
  for (int trial = 0; trial < trials_of(24); ++trial) {
    const int owned_before = n_owned(), kind = trial % 4;
    riis_valve *valve = new_valve(kinds[kind]);
    const double radius = kind % 3 == 0 ? 1.2 : kind == 1 ? 1.05 : 1.6;
    const test_mesh nodes = tube(radius, -2.4, 3, random_between(&rng, 0.1, 0.14));
    riis_mesh *mesh = mesh_from(&nodes);
    const two_ends e = {node_at(&nodes, 0, 0, -2.4), node_at(&nodes, 0, 0, 3)};
    riis_surface_options surface = surface_options();
    surface.half_thickness = random_between(&rng, 0.12, 0.2);
    surface.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    riis_first_passage_options options = first_options();
    options.surface = &surface;
    options.tolerance = 1.0 / 64;
    const riis_first_passage first = first_of(valve, mesh, &e, &options);
    double expected = -1, closed = -1;
    const riis_passage at_0 = passage_at(valve, 0, mesh, &e, &surface);
    if (at_0.state != RIIS_PASSAGE_OPEN)
      for (int i = 1; i <= 8 && expected < 0; ++i)
        if (passage_at(valve, i / 8.0, mesh, &e, &surface).state == RIIS_PASSAGE_OPEN)
          expected = i / 8.0, closed = (i - 1) / 8.0;
    while (expected - closed > 1.0 / 64) {
      const double middle = 0.5 * (expected + closed);
      if (passage_at(valve, middle, mesh, &e, &surface).state == RIIS_PASSAGE_OPEN)
        expected = middle;
      else
        closed = middle;
    }
    printf("%s, half thickness %.3f: state %d, opening %.4f, %d openings\n", kinds[kind], surface.half_thickness,
           first.state, first.opening, first.n_openings);
    if (at_0.state == RIIS_PASSAGE_OPEN) {
      assert_int_equal(first.state, RIIS_FIRST_PASSAGE_ALWAYS);
      assert_true(first.opening == 0 && first.closed_opening == 0 && first.n_openings == 1);
    } else if (expected < 0) {
      assert_int_equal(first.state, RIIS_FIRST_PASSAGE_NEVER);
      assert_true(first.opening == 1 && first.closed_opening == 1 && first.n_openings == 9);
    } else {
      assert_int_equal(first.state, RIIS_FIRST_PASSAGE_FOUND);
      CHECK_NEAR(first.opening, expected, 0);
      CHECK_NEAR(first.closed_opening, closed, 0);
      CHECK_AT_MOST(first.opening - first.closed_opening, options.tolerance);
    }
    const riis_passage there = passage_at(valve, first.opening, mesh, &e, &surface);
    assert_int_equal(there.node_id, first.node_id);
    CHECK_NEAR(first.distance, there.distance, 1e-12);
    assert_memory_equal(first.point, there.point, sizeof there.point);
    free_owned_after(owned_before);
  }
}

/* Two plates slide apart along x. The slit between the plates is 2 * opening wide. A path through the slit exists if the nodes in
 * its middle are farther than the half thickness from both plates. */
TEST(slits_open_at_their_width) {
  const double wide = 3;
  shape closed = {0}, open = {0};
  for (int is_open = 0; is_open < 2; ++is_open) {
    shape *to = is_open ? &open : &closed;
    for (int side = 0; side < 2; ++side) {
      const double inner = (side ? 1 : -1) * (double)is_open, outer = (side ? wide : -wide) + inner;
      const int32_t first = (int32_t)to->n_curves;
      add_line(to, inner, -wide, 0, outer, -wide, 0);
      add_line(to, inner, wide, 0, outer, wide, 0);
      add_line(to, inner, -wide, 0, inner, wide, 0);
      add_line(to, outer, -wide, 0, outer, wide, 0);
      add_patch(to, first, first + 1, first + 2, first + 3);
    }
  }
  riis_valve *valve = valve_from(&closed), *opened = valve_from(&open);
  const test_mesh nodes = tube(0.5, -1, 1, 0.1);
  riis_mesh *mesh = mesh_from(&nodes);
  const two_ends e = {node_at(&nodes, 0, 0, -1), node_at(&nodes, 0, 0, 1)};
  const riis_passage_ends ends = ends_of(&e);
  riis_first_passage first;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "valve has only one state|riis_valve_set_open_state",
                riis_find_first_passage(valve, mesh, &ends, NULL, &first, sizeof first));
  /* A valve with only one state is refused, even if this state is its open one. */
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "valve has only one state",
                riis_find_first_passage(opened, mesh, &ends, NULL, &first, sizeof first));
  CHECK_OK(riis_valve_set_open_state(valve, opened));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5)); /* the call must ignore the valve's own opening */
  for (int trial = 0; trial < trials_of(24); ++trial) {
    riis_surface_options surface = surface_options();
    surface.half_thickness = random_between(&rng, 0.1, 0.45);
    riis_first_passage_options options = first_options();
    options.surface = &surface;
    options.tolerance = trial % 2 ? 1e-5 : 1e-3;
    const riis_first_passage found = first_of(valve, mesh, &e, &options);
    assert_int_equal(found.state, RIIS_FIRST_PASSAGE_FOUND);
    CHECK_NEAR(found.opening, surface.half_thickness, options.tolerance);
    CHECK_NEAR(found.closed_opening, surface.half_thickness, options.tolerance);
    assert_true(found.closed_opening <= surface.half_thickness && found.opening >= surface.half_thickness);
    CHECK_NEAR(found.distance, found.opening, 1e-12);
    CHECK_NEAR(found.point[0], 0, 1e-12);
    CHECK_NEAR(found.point[2], 0, 1e-12);
  }
  /* With a half thickness above 1 the slit never opens. If one node is masked, no path of the mesh remains. */
  riis_surface_options surface = surface_options();
  surface.half_thickness = 0.9;
  riis_first_passage_options options = first_options();
  options.surface = &surface;
  surface.translation[2] = -0.05; /* the ends are 0.95 and 1.05 away; the wide slit stays within the tube */
  surface.scale = 0.85;
  const riis_first_passage never = first_of(valve, mesh, &e, &options);
  assert_int_equal(never.state, RIIS_FIRST_PASSAGE_NEVER);
  uint8_t *mask = own(malloc((size_t)nodes.n));
  for (int64_t i = 0; i < nodes.n; ++i) mask[i] = fabs(nodes.xyz[3 * i + 2] - 0.5) > 0.01;
  riis_mark_options marking = mark_options();
  marking.node_mask = mask;
  options.surface = NULL;
  options.marking = &marking;
  const riis_first_passage none = first_of(valve, mesh, &e, &options);
  assert_int_equal(none.state, RIIS_FIRST_PASSAGE_NONE);
  assert_int_equal(none.node_id, -1);
  assert_int_equal(none.n_openings, 1);
}

TEST(wrong_calls_are_refused) {
  riis_valve *valve = new_valve("trileaflet");
  const test_mesh nodes = tube(1.2, -2, 2.5, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  two_ends e = {node_at(&nodes, 0, 0, -2), node_at(&nodes, 0, 0, 2.5)};
  riis_passage_ends ends = ends_of(&e);
  riis_first_passage_options options = first_options();
  riis_first_passage first;
  const int64_t size = sizeof first;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_find_first_passage(NULL, mesh, &ends, NULL, &first, size));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh is NULL", riis_find_first_passage(valve, NULL, &ends, NULL, &first, size));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "ends is NULL", riis_find_first_passage(valve, mesh, NULL, NULL, &first, size));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "first is NULL", riis_find_first_passage(valve, mesh, &ends, NULL, NULL, size));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "first is 8", riis_find_first_passage(valve, mesh, &ends, NULL, &first, 8));
  options.tolerance = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.tolerance is 0",
                riis_find_first_passage(valve, mesh, &ends, &options, &first, size));
  options = first_options();
  options.struct_size = 4;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is 4",
                riis_find_first_passage(valve, mesh, &ends, &options, &first, size));
  riis_surface_options surface = surface_options();
  surface.half_thickness = -3;
  options = first_options();
  options.surface = &surface;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.surface|half_thickness is -3",
                riis_find_first_passage(valve, mesh, &ends, &options, &first, size));
  riis_mark_options marking = mark_options();
  marking.n_threads = -1;
  options.surface = NULL;
  options.marking = &marking;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_threads is -1",
                riis_find_first_passage(valve, mesh, &ends, &options, &first, size));
  riis_marks *marks = new_result();
  CHECK_OK(riis_mark_nodes(new_surface(valve, NULL), mesh, NULL, marks));
  e.from = marked_list(marks).node_id[0];
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "at the opening 0|ends.from[0] is node|in the band",
                riis_find_first_passage(valve, mesh, &ends, NULL, &first, size));
  ends.n_to = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "ends.n_to is 0",
                riis_find_first_passage(valve, mesh, &ends, NULL, &first, size));
  CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh has no adjacency",
                riis_find_first_passage(valve, mesh, &ends, NULL, &first, size));
}

int main(void) {
  rng = random_start("test_first_passage");
  return run_cases(NULL, NULL);
}
