/* SPDX-License-Identifier: Apache-2.0
 * Tests orifices of surfaces from arrays whose leaflets do not touch at the commissures. A valve and the arrays of its triangles
 * must have one orifice. If the leaflets shrink, a raster counts the projected opening inside the outline before they shrank. */
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

/* Triangles, before and after they are changed. */
typedef struct soup {
  int64_t n_vertices, n_triangles;
  double *xyz;
  int32_t *ids, *leaflet;
} soup;

/* Copies the triangles of a surface. Vertices that two leaflets share are doubled, so that leaflets can move apart. */
static soup copy_of(const riis_surface *surface) {
  const riis_triangles all = triangles_of(surface);
  enum { n_leaflets = 3 };
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

/* Moves each leaflet's vertices towards the centroid of the leaflet, by a share of the distance. */
static void shrink(soup *of, double share) {
  for (int32_t leaflet = 0; leaflet < 3; ++leaflet) {
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
    for (int64_t i = 0; i < of->n_vertices / 3 && whole > 0; ++i) {
      double *p = of->xyz + 3 * (leaflet * (of->n_vertices / 3) + i);
      for (int k = 0; k < 3; ++k) p[k] += share * (centroid[k] / whole - p[k]);
    }
  }
}

/* Turns over a part of the triangles: none, all, those of one leaflet, or about half. */
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

/* Returns the area inside the outline that no triangle covers, by the middles of square cells. */
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

enum { n_kinds = 4, n_openings = 9, n_shares = 4 };
static const char *const kinds[n_kinds] = {"aortic", "mitral", "trileaflet", "coapting"};

static riis_valve *valve_at(int kind, double opening) {
  riis_valve *valve = new_valve(kinds[kind]);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return valve;
}

static void check_sample(int kind, int opening, int share, int how) {
  static const double shares[n_shares] = {0, 0.002, 0.01, 0.03};
  const int owned_before = n_owned();
  /* If triangles are turned over one by one, edges inside leaflets stay open, and the axis is less exact. The free edges of the
   * open coapting valve reach as far out as its attachment, so this axis would then turn away. */
  const int turning = kind == 3 && opening + 1 == n_openings ? how % n_turnings % 3 : how % n_turnings;
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
    for (int trial = 0; trial < 20; ++trial)
      check_sample(trial % n_kinds, (int)between(0, n_openings), trial / n_kinds % n_shares, (int)between(0, 8));
    return;
  }
  for (int i = 0; i < 2 * n_all; ++i)
    check_sample(i % n_kinds, i / n_kinds % n_openings, i / (n_kinds * n_openings) % n_shares, (int)between(0, 8));
}

/* A file of rigid leaflets has no disc of the housing. */
TEST(rigid_leaflets_lack_their_disc) {
  riis_valve *valve = new_valve("bileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  const riis_surface *open = new_surface(valve, NULL);
  assert_int_equal(orifice_of(open).outline, RIIS_OUTLINE_DISC);
  const soup leaflets = copy_of(open);
  assert_int_equal(orifice_of(surface_of_soup(&leaflets, 1, NULL)).outline, RIIS_OUTLINE_BOUNDARY);
}

int main(void) {
  rng = random_start("test_parted_leaflets");
  return run_cases(NULL, NULL);
}
