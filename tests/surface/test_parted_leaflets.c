/* SPDX-License-Identifier: Apache-2.0
 * Tests orifices of surfaces from arrays whose leaflets do not touch at the commissures. A valve and arrays of its triangles must
 * have equal orifices. After the leaflets shrink, a raster counts the projected opening inside the earlier outline. */
#include <riis/riis.h>

#include "test_support.h"

#include "farthest_outline.h"
#include "handles.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

static riis_orifice orifice_of(const riis_surface *surface) {
  riis_orifice orifice;
  CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  return orifice;
}

/* Arrays of triangles, which a test changes. */
typedef struct soup {
  int64_t n_vertices, n_triangles;
  double *xyz;
  int32_t *ids, *leaflet;
} soup;

/* Copies the triangles of a surface. Vertices that two leaflets share are doubled, so that the leaflets can move apart. */
static soup copy_of(const riis_surface *surface) {
  const riis_triangles all = triangles_of(surface);
  enum { n_leaflets = 4 };
  soup made = {n_leaflets * all.n_vertices, all.n_triangles, NULL, NULL, NULL};
  made.xyz = own(malloc((size_t)made.n_vertices * 3 * sizeof *made.xyz));
  made.ids = own(malloc((size_t)made.n_triangles * 3 * sizeof *made.ids));
  made.leaflet = own(malloc((size_t)made.n_triangles * sizeof *made.leaflet));
  for (int k = 0; k < n_leaflets; ++k)
    memcpy(made.xyz + 3 * k * all.n_vertices, all.xyz, (size_t)all.n_vertices * 3 * sizeof *made.xyz);
  for (int64_t i = 0; i < made.n_triangles; ++i) {
    made.leaflet[i] = all.leaflet_id[i];
    for (int k = 0; k < 3; ++k)
      made.ids[3 * i + k] = (int32_t)(all.vertex_id[3 * i + k] + all.leaflet_id[i] * all.n_vertices);
  }
  return made;
}

/* Moves each leaflet's vertices towards its centroid, by a share of the distance. */
static void shrink(soup *of, double share) {
  for (int32_t leaflet = 0; leaflet < 4; ++leaflet) {
    double whole = 0, centroid[3] = {0, 0, 0};
    for (int64_t i = 0; i < of->n_triangles; ++i) {
      if (of->leaflet[i] != leaflet) continue;
      const double *a = of->xyz + 3 * of->ids[3 * i], *b = of->xyz + 3 * of->ids[3 * i + 1],
                   *c = of->xyz + 3 * of->ids[3 * i + 2];
      double ab[3], ac[3];
      for (int k = 0; k < 3; ++k) ab[k] = b[k] - a[k], ac[k] = c[k] - a[k];
      const double area =
          hypot(hypot(ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2]), ab[0] * ac[1] - ab[1] * ac[0]);
      whole += area;
      for (int k = 0; k < 3; ++k) centroid[k] += area * (a[k] + b[k] + c[k]) / 3;
    }
    for (int64_t i = 0; i < of->n_vertices / 4 && whole > 0; ++i) {
      double *p = of->xyz + 3 * (leaflet * (of->n_vertices / 4) + i);
      for (int k = 0; k < 3; ++k) p[k] += share * (centroid[k] / whole - p[k]);
    }
  }
}

/* Reverses a part of the triangles: none, all, those of one leaflet, or about half. */
enum { n_turnings = 4 };
static void turn_over(soup *of, int turning) {
  for (int64_t i = 0; i < of->n_triangles; ++i) {
    const int is_turned =
        turning == 1 || (turning == 2 && of->leaflet[i] == 1) || (turning == 3 && between(0, 1) < 0.5);
    if (!is_turned) continue;
    const int32_t second = of->ids[3 * i + 1];
    of->ids[3 * i + 1] = of->ids[3 * i + 2], of->ids[3 * i + 2] = second;
  }
}

static riis_surface *surface_of_soup(const soup *from, int has_leaflets, const riis_surface_options *options) {
  riis_surface_arrays arrays = triangle_arrays(from->n_vertices, from->xyz, from->n_triangles, from->ids);
  if (has_leaflets) arrays.leaflet_id = from->leaflet;
  return surface_from(&arrays, options);
}

/* ---- The raster ---- */

enum { n_side = 600 };

/* Returns the area inside the outline that no triangle covers. The area is counted by the centres of square cells. */
static double open_area(const soup *of, const frame *seen, const outline *inside) {
  char *is_covered = calloc((size_t)n_side * n_side, 1);
  const double cell = 2 * inside->reach / n_side;
  for (int64_t i = 0; i < of->n_triangles; ++i) {
    double p[3][2], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int k = 0; k < 3; ++k) {
      seen_from(seen, of->xyz + 3 * of->ids[3 * i + k], p[k]);
      for (int d = 0; d < 2; ++d) {
        p[k][d] = (p[k][d] - inside->middle[d]) / cell + 0.5 * n_side - 0.5;
        low[d] = fmin(low[d], p[k][d]), high[d] = fmax(high[d], p[k][d]);
      }
    }
    for (int x = (int)fmax(0, ceil(low[0])); x <= fmin(n_side - 1, high[0]); ++x)
      for (int y = (int)fmax(0, ceil(low[1])); y <= fmin(n_side - 1, high[1]); ++y) {
        int n_left = 0, n_right = 0;
        for (int k = 0; k < 3; ++k) {
          const double *a = p[k], *b = p[(k + 1) % 3];
          const double side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
          n_left += side >= 0, n_right += side <= 0;
        }
        if (n_left == 3 || n_right == 3) is_covered[x * n_side + y] = 1;
      }
  }
  int64_t n_open = 0;
  for (int i = 0; i < n_side * n_side; ++i) {
    const double x = (i / n_side + 0.5 - 0.5 * n_side) * cell, y = (i % n_side + 0.5 - 0.5 * n_side) * cell;
    n_open += !is_covered[i] && is_inside(inside, x, y);
  }
  free(is_covered);
  return (double)n_open * cell * cell;
}

/* ---- Tests ---- */

enum { n_kinds = 8, n_openings = 9, n_shares = 4 };
static const char *const kinds[n_kinds] = {"aortic",   "mitral",       "trileaflet", "coapting",
                                           "bicuspid", "quadricuspid", "tricuspid",  "mitral_coapting"};

static riis_valve *valve_at(int kind, double opening) {
  riis_valve *valve = new_valve(kinds[kind]);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return valve;
}

static void check_sample(int kind, int opening, int share, int how) {
  static const double shares[n_shares] = {0, 0.002, 0.01, 0.03};
  const int owned_before = n_owned();
  /* If single triangles are reversed, edges inside leaflets stay open, and the axis is less exact. The free edges of the open
   * coapting valve reach as far out as its attachment. The axis of reversed triangles would then turn away. The attachment of
   * parted leaflets is a line only if the leaflets have one winding, and the kinds from bicuspid on need this line. */
  const int may_turn_some = kind < 4 || share == 0;
  const int turning = kind == 3 && opening + 1 == n_openings ? how % n_turnings % 3
                      : may_turn_some                        ? how % n_turnings
                                                             : how % 2;
  const double most = orifice_of(new_surface(valve_at(kind, 1), NULL)).area;
  riis_surface_options options = surface_options(), placed = surface_options();
  options.triangulation = how % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
  const riis_surface *valve = new_surface(valve_at(kind, (double)opening / (n_openings - 1)), &options);
  const riis_orifice of_valve = orifice_of(valve);
  soup triangles = copy_of(valve);
  const frame seen = frame_of(of_valve.axis);
  const riis_triangles all = triangles_of(valve);
  const outline before = outline_of(all.xyz, all.n_triangles, all.vertex_id, &seen);
  CHECK_NEAR(of_valve.area, open_area(&triangles, &seen, &before), 0.01 * most);
  shrink(&triangles, shares[share]);
  turn_over(&triangles, turning);
  const double s = placed.scale = pow(10, between(-2, 2));
  for (int c = 0; c < 3; ++c)
    placed.rotation_axis[c] = between(-1, 1) + (c == 0 ? 2 : 0), placed.translation[c] = s * between(-3, 3);
  placed.rotation_angle = between(-180, 180);
  const riis_orifice found = orifice_of(surface_of_soup(&triangles, how / n_turnings % 2 == 0 || share == 0, &placed));
  const double area = found.area / (s * s);
  printf("%s at %d/8, shrunk by %g, turned %d: %.4f, the valve's %.4f\n", kinds[kind], opening, shares[share], turning,
         area, of_valve.area);
  assert_int_equal(found.outline, RIIS_OUTLINE_BOUNDARY);
  if (share == 0) CHECK_NEAR(area, of_valve.area, 0.005 * most);
  CHECK_NEAR(area, open_area(&triangles, &seen, &before), 0.04 * most);
  free_owned_after(owned_before);
}

TEST(leaflets_that_do_not_touch_have_an_orifice) {
  const int n_all = n_kinds * n_openings * n_shares;
  if (!is_long_test()) {
    for (int trial = 0; trial < trials_of(60); ++trial)
      check_sample(trial % n_kinds, (int)between(0, n_openings), trial / n_kinds % n_shares, (int)between(0, 8));
    return;
  }
  for (int i = 0; i < 2 * n_all; ++i)
    check_sample(i % n_kinds, i / n_kinds % n_openings, i / (n_kinds * n_openings) % n_shares, (int)between(0, 8));
}

/* A file with rigid leaflets does not have the disc of the housing. */
TEST(rigid_leaflets_lack_their_disc) {
  riis_valve *valve = new_valve("bileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  const riis_surface *open = new_surface(valve, NULL);
  assert_int_equal(orifice_of(open).outline, RIIS_OUTLINE_DISC);
  const soup leaflets = copy_of(open);
  assert_int_equal(orifice_of(surface_of_soup(&leaflets, 1, NULL)).outline, RIIS_OUTLINE_BOUNDARY);
}

/* Makes a tube around the z axis, from -length / 2 to length / 2. The winding of each triangle is random. */
static riis_surface *tube_of(double radius, double length, const riis_surface_options *placed) {
  enum { n_round = 512 };
  const double pi = 3.14159265358979323846;
  double *xyz = own(malloc(6 * n_round * sizeof *xyz));
  int32_t *ids = own(malloc(6 * n_round * sizeof *ids));
  for (int i = 0; i < 2 * n_round; ++i) {
    xyz[3 * i] = radius * cos(2 * pi * (i / 2) / n_round), xyz[3 * i + 1] = radius * sin(2 * pi * (i / 2) / n_round);
    xyz[3 * i + 2] = (i % 2 - 0.5) * length;
    const int32_t corner[3] = {i, (i + 1) % (2 * n_round), (i + 2) % (2 * n_round)};
    const int is_turned = between(0, 1) < 0.5;
    for (int k = 0; k < 3; ++k) ids[3 * i + k] = corner[is_turned && k ? 3 - k : k];
  }
  const riis_surface_arrays arrays = triangle_arrays(2 * n_round, xyz, 2 * n_round, ids);
  return surface_from(&arrays, placed);
}

/* A file of rigid leaflets lacks the housing's disc. A ring or a tube of the housing's radius stands for this disc. */
TEST(a_wall_bounds_the_orifice_of_rigid_leaflets) {
  riis_valve *valve = new_valve("bileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  const double most = orifice_of(new_surface(valve, NULL)).area;
  for (int opening = 0; opening < n_openings; ++opening) {
    const int owned_before = n_owned();
    CHECK_OK(riis_valve_set_scalar(valve, "opening", (double)opening / (n_openings - 1)));
    const riis_surface *of_valve = new_surface(valve, NULL);
    const riis_orifice expected = orifice_of(of_valve);
    const soup leaflets = copy_of(of_valve);
    riis_surface_options placed = surface_options();
    const double s = placed.scale = pow(10, between(-2, 2));
    for (int c = 0; c < 3; ++c)
      placed.rotation_axis[c] = between(-1, 1) + (c == 0 ? 2 : 0), placed.translation[c] = s * between(-3, 3);
    placed.rotation_angle = between(-180, 180);
    const riis_surface *file = surface_of_soup(&leaflets, 1, &placed);
    const double length = expected.radius * pow(10, between(-1, 1));
    const riis_surface *wall = tube_of(expected.radius, length, &placed);
    riis_orifice found, of_closed;
    CHECK_OK(riis_surface_get_orifice_in_wall(file, wall, NULL, &found, sizeof found));
    printf("bileaflet at %d/8 in a tube of length %.3f: %.4f, the valve's %.4f\n", opening, length,
           found.area / (s * s), expected.area);
    assert_int_equal(found.outline, RIIS_OUTLINE_WALL);
    CHECK_NEAR(found.area / (s * s), expected.area, 0.005 * most);
    CHECK_NEAR(found.outline_area / (s * s), expected.outline_area, 1e-3 * expected.outline_area);
    /* The axis of view points to the side of the valve's z axis. */
    placed.half_thickness = 0.1 * s;
    CHECK_OK(riis_surface_get_orifice_in_wall(new_surface(valve, &placed), wall, NULL, &of_closed, sizeof of_closed));
    CHECK_NEAR(of_closed.area, found.area, 0.005 * most * s * s);
    const riis_orifice of_placed = orifice_of(new_surface(valve, &placed));
    for (int c = 0; c < 3; ++c) CHECK_NEAR(of_closed.axis[c], of_placed.axis[c], 1e-6);
    free_owned_after(owned_before);
  }
}

TEST(a_wall_without_an_outline_is_refused) {
  riis_valve *valve = new_valve("bileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "ring_height", 0.4));
  const riis_surface *surface = new_surface(valve, NULL);
  const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int32_t ids[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2};
  const riis_surface_arrays closed = triangle_arrays(4, xyz, 4, ids);
  riis_orifice orifice;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "wall has no outline: its open edges do not surround a centre",
                riis_surface_get_orifice_in_wall(surface, surface_from(&closed, NULL), NULL, &orifice, sizeof orifice));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "wall is NULL",
                riis_surface_get_orifice_in_wall(surface, NULL, NULL, &orifice, sizeof orifice));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL",
                riis_surface_get_orifice_in_wall(NULL, surface, NULL, &orifice, sizeof orifice));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "orifice is 8",
                riis_surface_get_orifice_in_wall(surface, surface, NULL, &orifice, 8));
}

int main(void) {
  rng = random_start("test_parted_leaflets");
  return run_cases(NULL, NULL);
}
