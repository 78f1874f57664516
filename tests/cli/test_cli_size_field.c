/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests `riis size-field`. The grid is read again, and its edge lengths are compared with closest points of separate surfaces. */
/* clang-format off: test_support.h checks statuses if riis.h came before */
#include <riis/riis.h>

#include "calls.h"
#include "test_support.h"
/* clang-format on */

#include "program.h"
#include "scratch.h"

/* ---- The grid ---- */

static struct {
  double origin[3], spacing[3];
  int n[3];
  double *length; /* z runs fastest */
} grid;

static void read_grid(void) {
  char *text = scratch_read(scratch_path("field.dat"), NULL), *at = text;
  for (int k = 0; k < 3; ++k) grid.origin[k] = strtod(at, &at);
  for (int k = 0; k < 3; ++k) grid.spacing[k] = strtod(at, &at);
  for (int k = 0; k < 3; ++k) grid.n[k] = (int)strtol(at, &at, 10);
  const int n = grid.n[0] * grid.n[1] * grid.n[2];
  assert_in_range(n, 1, 5000000);
  free(grid.length);
  grid.length = calloc((size_t)n, sizeof *grid.length);
  for (int i = 0; i < n; ++i) {
    char *end = NULL;
    grid.length[i] = strtod(at, &end);
    assert_ptr_not_equal(at, end);
    at = end;
  }
  assert_string_equal(at, "\n");
  free(text);
}

#define RUN_FIELD(...)                                              \
  do {                                                              \
    RUN_FINE("size-field", scratch_path("field.dat"), __VA_ARGS__); \
    read_grid();                                                    \
  } while (0)

/* ---- Surfaces by C ---- */

enum { most_surfaces = 8 };
static struct {
  int n;
  riis_surface *surface[most_surfaces];
} states;

static void add_states(const char *kind, int n_openings, const double *openings, const riis_surface_options *how) {
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create(kind, &valve));
  for (int i = 0; i < n_openings; ++i) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", openings[i]));
    CHECK_OK(riis_surface_create(valve, how, &states.surface[states.n++]));
  }
  riis_valve_destroy(&valve);
}

static void drop_states(void) {
  while (states.n > 0) riis_surface_destroy(&states.surface[--states.n]);
}

static double least_distance(const double *point) {
  double least = INFINITY;
  for (int i = 0; i < states.n; ++i) {
    riis_closest closest;
    CHECK_OK(riis_closest_point(states.surface[i], point, &closest, sizeof closest));
    least = fmin(least, closest.distance);
  }
  return least;
}

/* These numbers decide the edge lengths, as the help of `riis size-field` describes. */
typedef struct {
  double half_thickness, band, growth, largest;
} edges;

static double length_at(double distance, edges want) {
  return fmin(want.largest, want.band + want.growth * fmax(0, distance - want.half_thickness));
}

/* On the sides of the grid, the edge lengths must have their largest value. The edge lengths must be largest on the sides of the
   grid. */
static void check_grid(edges want) {
  random_source random = random_start("size_field");
  int n_in_band = 0, n_growing = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    int at[3];
    double point[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = (int)(random_bits(&random) % (uint64_t)grid.n[k]);
      point[k] = grid.origin[k] + grid.spacing[k] * at[k];
    }
    const double length = grid.length[(at[0] * grid.n[1] + at[1]) * grid.n[2] + at[2]];
    const double distance = least_distance(point), expected = length_at(distance, want);
    CHECK_NEAR(length, expected, 1e-4 * expected); /* the file has five digits */
    n_in_band += distance <= want.half_thickness;
    n_growing += expected > want.band && expected < want.largest;
  }
  assert_true(n_in_band > 10 && n_growing > 100);
  for (int i = 0; i < grid.n[0]; ++i)
    for (int j = 0; j < grid.n[1]; ++j)
      for (int k = 0; k < grid.n[2]; ++k)
        if (i == 0 || j == 0 || k == 0 || i == grid.n[0] - 1 || j == grid.n[1] - 1 || k == grid.n[2] - 1)
          assert_true(grid.length[(i * grid.n[1] + j) * grid.n[2] + k] >= 0.9999 * want.largest);
}

TEST(valves_at_all_openings) {
  const char *const kinds[] = {"aortic", "mitral", "trileaflet", "bileaflet"};
  const double openings[] = {0, 0.5, 1};
  for (int i = 0; i < 4; ++i) {
    RUN_FIELD("--valve", kinds[i], "--count", "3", "--largest-edge", "0.25", "--growth", "0.5", "--spacing", "0.08");
    assert_non_null(strstr(program_out, "Field[1] = Structured;"));
    assert_non_null(strstr(program_out, "3 states, openings from 0 to 1"));
    add_states(kinds[i], 3, openings, NULL);
    check_grid((edges){0.1, 0.095, 0.5, 0.25});
    drop_states();
  }
}

TEST(placed_valve_at_one_opening) {
  RUN_FIELD("--valve", "trileaflet", "--opening", "0.25", "--unit", "mm", "--rotate", "1,2,3,40", "--translate",
            "10,-20,30", "--half-thickness", "1.5", "--band-edge", "0.5");
  riis_surface_options how;
  CHECK_OK(riis_surface_options_init(&how, sizeof how));
  how.scale = 10;
  how.half_thickness = 1.5;
  for (int k = 0; k < 3; ++k) how.rotation_axis[k] = k + 1;
  how.rotation_angle = 40;
  how.translation[0] = 10, how.translation[1] = -20, how.translation[2] = 30;
  const double opening = 0.25;
  add_states("trileaflet", 1, &opening, &how);
  check_grid((edges){1.5, 0.75, 0.3, 6});
  drop_states();
}

/* A case without a mesh has a mitral valve that rests half open and an aortic valve that opens. */
TEST(case_of_two_valves) {
  const char text[] =
      "{\"half_thickness\": 0.1, \"times\": [0, 1, 2], \"valves\": ["
      "{\"name\": \"m\", \"valve\": \"mitral\", \"opening\": 0.5, \"translate\": [4, 0, 0]},"
      "{\"name\": \"a\", \"valve\": \"trileaflet\","
      " \"opening\": {\"times\": [0, 2], \"openings\": [0, 1]}}]}";
  scratch_write("case.json", text, strlen(text));
  RUN_FIELD("--case", scratch_path("case.json"), "--largest-edge", "0.25", "--growth", "0.5", "--spacing", "0.08");
  riis_surface_options how;
  CHECK_OK(riis_surface_options_init(&how, sizeof how));
  const double half = 0.5, openings[] = {0, 0.5, 1};
  add_states("trileaflet", 3, openings, &how);
  how.translation[0] = 4;
  add_states("mitral", 1, &half, &how);
  check_grid((edges){0.1, 0.095, 0.5, 0.25});
  drop_states();
}

/* ---- An offset ---- */

/* With the offset 0.75, an edge beside a rim can leak if it is longer than 2 sqrt(1 - 0.75^2) = 1.32 half thicknesses. The rim of
 * a plate is its outline. */
TEST(an_offset_beside_the_rim_of_a_plate) {
  const char text[] = "v -1 -0.5 0\nv 1 -0.5 0\nv 1 0.5 0\nv -1 0.5 0\nf 1 2 3\nf 1 3 4\n";
  scratch_write("plate.obj", text, strlen(text));
  RUN_FIELD("--surface", scratch_path("plate.obj"), "--half-thickness", "0.1", "--offset", "-0.75", "--largest-edge",
            "0.25", "--growth", "0.5", "--spacing", "0.06");
  assert_non_null(strstr(program_out, "edges     0.095 within the reach of the band, 0.175, and 0.0628 beside rims"));
  const double beside_rims = 0.095 * sqrt(1 - 0.75 * 0.75);
  int n_beside_rims = 0, n_at_middle = 0;
  for (int i = 0; i < grid.n[0]; ++i)
    for (int j = 0; j < grid.n[1]; ++j)
      for (int k = 0; k < grid.n[2]; ++k) {
        const double x = fabs(grid.origin[0] + grid.spacing[0] * i) - 1,
                     y = fabs(grid.origin[1] + grid.spacing[1] * j) - 0.5;
        const double z = grid.origin[2] + grid.spacing[2] * k, out = hypot(fmax(0, x), fmax(0, y));
        const double from_rim = hypot(out > 0 ? out : fmax(x, y), z);
        const double expected = fmin(length_at(hypot(out, z), (edges){0.175, 0.095, 0.5, 0.25}),
                                     length_at(from_rim, (edges){0.175, beside_rims, 0.5, 0.25}));
        CHECK_NEAR(grid.length[(i * grid.n[1] + j) * grid.n[2] + k], expected, 1e-3); /* the strip is 5e-4 wide */
        n_beside_rims += expected == beside_rims;
        n_at_middle += expected == 0.095;
      }
  assert_true(n_beside_rims > 500 && n_at_middle > 100);
}

/* If a node's closest point is on the rim of a valve, the node gets the length beside rims. The library reports which points are
 * on the rim. */
TEST(an_offset_beside_the_rims_of_valves) {
  const char *const kinds[] = {"aortic", "mitral", "coapting", "bileaflet"};
  const double openings[] = {0, 0.5, 1};
  for (int i = 0; i < 4; ++i) {
    RUN_FIELD("--valve", kinds[i], "--count", "3", "--offset", "0.5", "--largest-edge", "0.25", "--growth", "0.5",
              "--spacing", "0.08");
    add_states(kinds[i], 3, openings, NULL);
    const int64_t n = (int64_t)grid.n[0] * grid.n[1] * grid.n[2];
    double *xyz = calloc(3 * (size_t)n, sizeof *xyz);
    for (int64_t node = 0; node < n; ++node) {
      const int64_t at[3] = {node / grid.n[2] / grid.n[1], node / grid.n[2] % grid.n[1], node % grid.n[2]};
      for (int k = 0; k < 3; ++k) xyz[3 * node + k] = grid.origin[k] + grid.spacing[k] * (double)at[k];
    }
    riis_mesh *mesh = NULL;
    riis_marks *marks = NULL;
    CHECK_OK(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &mesh));
    CHECK_OK(riis_marks_create(&marks));
    riis_mark_options how;
    CHECK_OK(riis_mark_options_init(&how, sizeof how));
    how.distance_limit = 0.15;
    how.fields = RIIS_FIELD_RIM;
    int n_beside_rims = 0, n_others = 0;
    for (int state = 0; state < states.n; ++state) {
      riis_mark_list near;
      CHECK_OK(riis_mark_nodes(states.surface[state], mesh, &how, marks));
      CHECK_OK(riis_marks_get_list(marks, RIIS_LIST_WITHIN_LIMIT, &near, sizeof near));
      for (int64_t k = 0; k < near.n_nodes; ++k) {
        const double length = grid.length[near.node_id[k]], beside_rims = 0.095 * sqrt(0.75);
        assert_true(length >= 0.9999 * beside_rims && length <= 1.0001 * 0.095);
        if (near.rim[k]) CHECK_NEAR(length, beside_rims, 1e-4);
        n_beside_rims += near.rim[k];
        n_others += length > 0.094;
      }
    }
    assert_true(n_beside_rims > 100 && n_others > 100);
    riis_marks_destroy(&marks);
    riis_mesh_destroy(&mesh);
    free(xyz);
    drop_states();
  }
}

TEST(refusals) {
  RUN_REFUSED(2, "OUT is required", "size-field");
  RUN_REFUSED(2, "--growth: 0 is not above 0", "size-field", "-", "--growth", "0");
  RUN_REFUSED(2, "--growth: nan is not above 0", "size-field", "-", "--growth", "nan");
  RUN_REFUSED(2, "--band-edge: -1 is not above 0", "size-field", "-", "--band-edge", "-1");
  RUN_REFUSED(2, "--largest-edge: 0.05 is below the edge length in the band, 0.095", "size-field", "-",
              "--largest-edge", "0.05");
  RUN_REFUSED(2, "--spacing: the grid would have ", "size-field", "-", "--spacing", "1e-4");
  /* A half thickness in another unit is refused before the states are collected, which would take minutes. */
  RUN_REFUSED(2, "the spacing is half of the half thickness, and the largest side is 2", "size-field", "-", "--valve",
              "trileaflet", "--unit", "mm", "--half-thickness", "0.001");
  assert_null(strstr(program_err, "collecting"));
  RUN_REFUSED(2, "--spacing: inf is not above 0 and finite", "size-field", "-", "--spacing", "inf");
  RUN_REFUSED(2, "--count: 1 is not from 2 to 100001", "size-field", "-", "--count", "1");
  RUN_REFUSED(2, "--count has no effect, because the command uses only one opening", "size-field", "-", "--opening",
              "0.5", "--count", "3");
  RUN_REFUSED(2, "--times needs --cycle", "size-field", "-", "--times", "0:1:0.5");
  RUN_REFUSED(1, "no such folder", "size-field", scratch_path("no such folder/field.dat"));
}

int main(void) {
  const int n_failed = run_cases(scratch_setup, scratch_teardown);
  free(grid.length);
  return n_failed;
}
