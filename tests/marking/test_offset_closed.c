/* SPDX-License-Identifier: Apache-2.0
 * Closed valves hold blood back even if their band has an offset. Flood fills look for a way through random grids of tetrahedra
 * along nodes where K is 0. If the rim is cut, K is 0 beyond the rim although the nodes there are marked. RIIS_TEST_LONG=1 tries
 * 15 grids of each kind. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "random_meshes.h"

#include "flood_fill.h"

static const double offsets[] = {0, 0.5, 0.75}, shares[] = {1, 1.5, 1.9};

/* A closed valve in a tube about the z axis. Lengths are in centimetres. */
typedef struct closed_valve {
  const char *kind;
  double skirt, half_thickness, radius, from, to;
} closed_valve;

/* Makes the nodes of a grid of cubes in the tube. Each cube is cut into six tetrahedra. The grid is turned and shifted at random.
 * The cubes' diagonals, which are the longest edges, have the given length. */
static test_mesh turned_tetrahedra(const closed_valve *valve, double longest_edge) {
  static const int along[7][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const double side = longest_edge / sqrt(3), middle = (valve->from + valve->to) / 2,
               reach = hypot(valve->radius, valve->to - middle);
  double q[4], shift[3], square = 0;
  for (int k = 0; k < 4; ++k) q[k] = random_between(&rng, -1, 1), square += q[k] * q[k];
  for (int k = 0; k < 4; ++k) q[k] /= sqrt(square);
  for (int c = 0; c < 3; ++c) shift[c] = random_between(&rng, 0, side);
  const double turn[3][3] = {
      {1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2])},
      {2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] - q[0] * q[1])},
      {2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2])}};
  const int64_t n = 3 + (int64_t)(2 * reach / side), n_all = n * n * n, step[3] = {1, n, n * n};
  int64_t *number = own(malloc((size_t)n_all * sizeof *number)), n_pairs = 0;
  test_mesh mesh = {.n = 0};
  mesh.xyz = own(malloc((size_t)n_all * 3 * sizeof *mesh.xyz));
  for (int64_t i = 0; i < n_all; ++i) {
    double *at = mesh.xyz + 3 * mesh.n, grid[3];
    for (int c = 0; c < 3; ++c) grid[c] = side * (double)(i / step[c] % n) - reach - shift[c];
    for (int c = 0; c < 3; ++c) at[c] = turn[c][0] * grid[0] + turn[c][1] * grid[1] + turn[c][2] * grid[2];
    at[2] += middle;
    const int is_inside = hypot(at[0], at[1]) < valve->radius && at[2] > valve->from && at[2] < valve->to;
    number[i] = is_inside ? mesh.n++ : -1;
  }
  int64_t *pairs = own(malloc((size_t)(14 * mesh.n + 1) * sizeof *pairs));
  for (int64_t i = 0; i < n_all; ++i)
    for (int k = 0; k < 7 && number[i] >= 0; ++k) {
      int64_t other = i;
      int fits = 1;
      for (int c = 0; c < 3; ++c) other += along[k][c] * step[c], fits = fits && i / step[c] % n + along[k][c] < n;
      if (!fits || number[other] < 0) continue;
      pairs[2 * n_pairs] = number[i], pairs[2 * n_pairs++ + 1] = number[other];
    }
  set_rows(&mesh, n_pairs, pairs);
  return mesh;
}

/* Returns whether a flood over nodes where K is 0 passes the band. */
static int leaks_through(const riis_surface *surface, const test_mesh *grid, int32_t rim, int64_t from, int64_t to) {
  riis_marks *marks = new_result();
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1, resistance.rim = rim;
  riis_mark_options asked = mark_options();
  asked.fields = RIIS_FIELD_RIM;
  asked.resistance = &resistance;
  CHECK_OK(riis_mark_nodes(surface, mesh_from(grid), &asked, marks));
  const riis_mark_list list = marked_list(marks);
  uint8_t *is_open = own(malloc((size_t)grid->n));
  int64_t *label = own(malloc((size_t)grid->n * sizeof *label));
  memset(is_open, 1, (size_t)grid->n);
  for (int64_t i = 0; i < list.n_nodes; ++i) is_open[list.node_id[i]] = !(list.K[i] > 0);
  assert_true(is_open[from] && is_open[to]);
  flood_fill(grid, is_open, label);
  return label[from] == label[to];
}

static riis_surface *closed_surface(const closed_valve *at, double offset) {
  riis_valve *valve = new_valve(at->kind);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
  if (at->skirt > 0) CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", at->skirt));
  riis_surface_options options = surface_options();
  options.half_thickness = at->half_thickness, options.offset = offset;
  return new_surface(valve, &options);
}

/* Counts the grids that leak with each offset. */
static void count_leaks(const closed_valve *valve, int n_grids, int32_t rim, int *n_leaking) {
  int n_opened = 0;
  for (int k = 0; k < 3; ++k) n_leaking[k] = 0;
  for (int trial = 0; trial < n_grids; ++trial) {
    const int n_before = n_owned();
    const test_mesh grid = turned_tetrahedra(valve, shares[trial % 3] * valve->half_thickness);
    const int64_t from = node_at(&grid, 0, 0, valve->from), to = node_at(&grid, 0, 0, valve->to);
    int leaks[3];
    for (int k = 0; k < 3; ++k) {
      const riis_surface *surface = closed_surface(valve, offsets[k]);
      leaks[k] = leaks_through(surface, &grid, rim, from, to);
      n_leaking[k] += leaks[k];
      /* If the rim is not cut, the library's passage must agree with the flood. */
      if (rim == RIIS_RIM_CUT) continue;
      riis_passage passage;
      CHECK_OK(find_passage_between(surface, mesh_from(&grid), NULL, 1, &from, 1, &to, &passage, sizeof passage));
      assert_int_equal(passage.state, leaks[k] ? RIIS_PASSAGE_OPEN : RIIS_PASSAGE_CLOSED);
    }
    const int is_opened = !leaks[0] && (leaks[1] || leaks[2]);
    if (is_opened && rim == RIIS_RIM_ROUND)
      fail_msg("%s, skirt %g, radius %g, edges of %g half thicknesses: leaks with the offset 0.5: %d, 0.75: %d",
               valve->kind, valve->skirt, valve->radius, shares[trial % 3], leaks[1], leaks[2]);
    n_opened += is_opened;
    free_owned_after(n_before);
  }
  printf(
      "%-10s skirt %.1f, radius %.2f, rim %d: of %d grids leak %d, %d, %d with the offsets 0, 0.5, 0.75; opened %d\n",
      valve->kind, valve->skirt, valve->radius, rim, n_grids, n_leaking[0], n_leaking[1], n_leaking[2], n_opened);
}

TEST(valves_with_a_skirt_do_not_leak) {
  static const closed_valve valves[] = {{"trileaflet", 0.4, 0.1, 1.3, -1.7, 0.5},
                                        {"coapting", 0.4, 0.1, 1.3, -0.5, 2.2},
                                        {"mitral", 0.7, 0.14, 1.9, -1, 3}};
  const int n_grids = trials_of(15);
  for (int i = 0; i < 3; ++i)
    for (int32_t rim = RIIS_RIM_ROUND; rim <= RIIS_RIM_CUT; ++rim) {
      int n_leaking[3];
      count_leaks(valves + i, n_grids, rim, n_leaking);
      for (int k = 0; k < 3; ++k) assert_int_equal(n_leaking[k], 0);
    }
}

/* Without a skirt, blood passes between the rim and a wall farther out, with every offset. With a round rim, an offset does not
 * make the band leak more. A cut rim lets blood pass, because an offset moves its end along the normals, and so away from the
 * wall. */
TEST(round_rims_without_a_skirt_leak_only_where_they_leak_without_an_offset) {
  closed_valve valves[] = {{"trileaflet", 0, 0.1, 0, -1.7, 0.5}, {"coapting", 0, 0.1, 0, -0.5, 2.2}};
  const int n_grids = trials_of(15);
  for (int i = 0; i < 2; ++i)
    for (int32_t rim = RIIS_RIM_ROUND; rim <= RIIS_RIM_CUT; ++rim) {
      int n_leaking[3];
      valves[i].radius = random_between(&rng, 1.2, 1.27); /* the attachment is 1.25 from the axis */
      count_leaks(valves + i, n_grids, rim, n_leaking);
    }
}

int main(void) {
  rng = random_start("test_offset_closed");
  return run_cases(NULL, NULL);
}
