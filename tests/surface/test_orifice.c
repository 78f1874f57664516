/* SPDX-License-Identifier: Apache-2.0
 * Tests the sizes of leaflets, orifices and ideal leaks. Areas are compared with counts of random points seen along the axis, and
 * with lengths of lines in another direction. Perimeters are compared with differences of areas. Placed valves are compared with
 * valves that have no placement. */
#include <riis/riis.h>

#include "test_support.h"

#include "farthest_outline.h"
#include "handles.h"
#include "sanitized.h"

#include "shapes.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

static riis_resistance resistance(double half_thickness, int32_t rim) {
  riis_resistance made;
  CHECK_OK(riis_resistance_init(&made, sizeof made));
  made.half_thickness = half_thickness;
  made.rim = rim;
  return made;
}

static riis_orifice orifice_of(const riis_surface *surface, const riis_resistance *how) {
  riis_orifice orifice;
  memset(&orifice, 0x5a, sizeof orifice);
  CHECK_OK(riis_surface_get_orifice(surface, how, &orifice, sizeof orifice));
  assert_int_equal(orifice.reserved, 0);
  return orifice;
}

enum { n_kinds = 5 };
static const char *const kinds[n_kinds] = {"aortic", "mitral", "trileaflet", "bileaflet", "coapting"};
static int n_trials(void) { return trials(n_kinds, 2 * n_kinds); }

static riis_valve *valve_at(int kind, double opening) {
  riis_valve *valve = new_valve(kinds[kind]);
  if (kind == 0) CHECK_OK(riis_valve_set_scalar(valve, "leaflet_angle", between(45, 60)));
  if (kind == 1) CHECK_OK(riis_valve_set_scalar(valve, "surface_angle", between(-20, 20)));
  if (kind == 2) CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", between(1.3, 1.6)));
  if (kind == 4) CHECK_OK(riis_valve_set_scalar(valve, "effective_height", between(0.85, 1)));
  if (kind == 3 && between(0, 1) < 0.5) CHECK_OK(riis_valve_set_scalar(valve, "ring_height", 0.4));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return valve;
}

static double squared_distance_to_segment(const double *p, const double *a, const double *b) {
  const double x = b[0] - a[0], y = b[1] - a[1], size = x * x + y * y;
  double t = size > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / size : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  const double dx = p[0] - a[0] - t * x, dy = p[1] - a[1] - t * y;
  return dx * dx + dy * dy;
}

/* Returns the squared distance in the xy plane from a point to a triangle that is projected along z. */
static double squared_distance_to(const double *p, const double corner[3][2]) {
  int n_left = 0, n_right = 0;
  double nearest = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const double *a = corner[k], *b = corner[(k + 1) % 3];
    const double side = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    n_left += side >= 0, n_right += side <= 0;
    const double squared = squared_distance_to_segment(p, a, b);
    if (squared < nearest) nearest = squared;
  }
  return n_left == 3 || n_right == 3 ? 0 : nearest;
}

/* The area of the orifice is compared with the share of points that no triangle covers. For the effective area, points near a
 * triangle do not count. */
TEST(areas_are_counts_of_points) {
  enum { n_side = 121 };
  for (int trial = 0; trial < n_trials(); ++trial) {
    const int kind = trial % n_kinds;
    riis_surface_options options = surface_options();
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    riis_valve *valve = valve_at(kind, between(0.3, 1));
    /* Rays through gaps between cusps would meet nothing. */
    if (kind == 0) CHECK_OK(riis_valve_unset(valve, "leaflet_angle"));
    const riis_surface *surface = new_surface(valve, &options);
    const riis_resistance how = resistance(between(0.03, 0.2), trial % 2 ? RIIS_RIM_CUT : RIIS_RIM_ROUND);
    const riis_orifice found = orifice_of(surface, &how);
    const riis_triangles all = triangles_of(surface);
    const frame seen = frame_of(found.axis);
    outline around = outline_of(all.xyz, all.n_triangles, all.vertex_id, &seen);
    if (kind == 3) {
      around.middle[0] = around.middle[1] = 0, around.reach = found.radius;
      for (int i = 0; i < n_directions; ++i) around.distance[i] = found.radius;
    }
    assert_int_equal(found.outline, kind == 3 ? RIIS_OUTLINE_DISC : RIIS_OUTLINE_ATTACHMENT);
    const double reach = found.rim_reach * found.half_thickness;
    int n_uncovered = 0, n_far = 0, n_inside = 0;
    for (int i = 0; i < n_side * n_side; ++i) {
      const double x = (2 * (i % n_side) + 1.0) / n_side - 1, y = (2 * (i / n_side) + 1.0) / n_side - 1;
      /* The rows of points are turned, so that no straight edge is parallel to them. */
      const double p[2] = {sqrt(2) * around.reach * (0.8 * x - 0.6 * y), sqrt(2) * around.reach * (0.6 * x + 0.8 * y)};
      if (!is_inside(&around, p[0], p[1])) continue;
      double nearest = INFINITY;
      for (int64_t t = 0; t < all.n_triangles && nearest > 0; ++t) {
        double corner[3][2];
        for (int k = 0; k < 3; ++k) {
          seen_from(&seen, all.xyz + 3 * all.vertex_id[3 * t + k], corner[k]);
          for (int d = 0; d < 2; ++d) corner[k][d] -= around.middle[d];
        }
        const double squared = squared_distance_to(p, corner);
        if (squared < nearest) nearest = squared;
      }
      n_uncovered += nearest > 0, n_far += nearest > reach * reach, ++n_inside;
    }
    const double cell = 2 * pow(2 * around.reach / n_side, 2), whole = cell * n_inside;
    if (kind == 3) CHECK_NEAR(found.outline_area, acos(-1) * found.radius * found.radius, 1e-5 * whole);
    CHECK_NEAR(found.area, cell * n_uncovered, 0.01 * whole);
    CHECK_NEAR(found.effective_area, cell * n_far, 0.015 * whole);
    CHECK_AT_MOST(found.effective_area, found.area);
  }
}

typedef struct span {
  double from, to;
} span;

static int by_start(const void *a, const void *b) {
  const double from = ((const span *)a)->from, other = ((const span *)b)->from;
  return (from > other) - (from < other);
}

/* Returns the x at which the line y = 0 meets an edge, or NaN. The upper end does not belong to the edge. */
static double meets(double ax, double ay, double bx, double by) {
  return (ay >= 0) == (by >= 0) ? NAN : ax + (bx - ax) * ay / (ay - by);
}

/* Returns the area of the orifice by lines at an angle to the axes. On each line, only the parts inside the outline count that no
 * triangle covers. If the radius is 0, the outline is the attachment. */
static double area_by_turned_lines(const riis_surface *surface, double radius, const double *axis) {
  enum { n_lines = 1500 };
  const double c = cos(0.37), s = sin(0.37), reach = radius > 0 ? radius : 3, spacing = 2 * reach / n_lines;
  const frame seen = frame_of(axis);
  const riis_triangles all = triangles_of(surface);
  riis_attachment held;
  CHECK_OK(riis_surface_get_attachment(surface, &held, sizeof held));
  double *turned = malloc((size_t)all.n_vertices * 2 * sizeof *turned);
  span *spans = malloc((size_t)(all.n_triangles + held.n_edges) * sizeof *spans);
  for (int64_t i = 0; i < all.n_vertices; ++i) {
    double p[2];
    seen_from(&seen, all.xyz + 3 * i, p);
    turned[2 * i] = c * p[0] + s * p[1];
    turned[2 * i + 1] = c * p[1] - s * p[0];
  }
  double area = 0;
  for (int line = 0; line < n_lines; ++line) {
    const double y = (line + 0.5) * spacing - reach;
    int64_t n = 0;
    for (int64_t t = 0; t < all.n_triangles; ++t) {
      const double *p[3];
      for (int k = 0; k < 3; ++k) p[k] = turned + 2 * all.vertex_id[3 * t + k];
      if ((p[0][1] >= y) == (p[1][1] >= y) && (p[1][1] >= y) == (p[2][1] >= y)) continue;
      span made = {INFINITY, -INFINITY};
      for (int k = 0; k < 3; ++k) {
        const double *a = p[k], *b = p[(k + 1) % 3], x = meets(a[0], a[1] - y, b[0], b[1] - y);
        if (isnan(x)) continue;
        made.from = fmin(made.from, x), made.to = fmax(made.to, x);
      }
      spans[n++] = made;
    }
    qsort(spans, (size_t)n, sizeof *spans, by_start);
    span *inside = spans + n;
    int64_t n_inside = 0;
    if (radius > 0) {
      const double half = sqrt(radius * radius - y * y);
      inside[n_inside++] = (span){-half, half};
    } else {
      for (int64_t i = 0; i < held.n_edges; ++i) {
        double a[2], b[2];
        seen_from(&seen, held.edges + 6 * i, a);
        seen_from(&seen, held.edges + 6 * i + 3, b);
        const double x =
            meets(c * a[0] + s * a[1], c * a[1] - s * a[0] - y, c * b[0] + s * b[1], c * b[1] - s * b[0] - y);
        if (!isnan(x)) inside[n_inside++] = (span){x, 0};
      }
      qsort(inside, (size_t)n_inside, sizeof *inside, by_start);
      assert_int_equal(n_inside % 2, 0);
      for (int64_t i = 0; i < n_inside; i += 2) inside[i / 2] = (span){inside[i].from, inside[i + 1].from};
      n_inside /= 2;
    }
    for (int64_t i = 0; i < n_inside; ++i) {
      double at = inside[i].from;
      for (int64_t k = 0; k < n && spans[k].from < inside[i].to; ++k) {
        if (spans[k].from > at) area += spacing * (spans[k].from - at);
        at = fmax(at, spans[k].to);
      }
      area += spacing * fmax(0, inside[i].to - at);
    }
  }
  free(turned), free(spans);
  return area;
}

/* Orifices inside the disc or the attachment are compared with the results of turned lines. The attachment of the aortic valve is
 * not a closed line. The free edges of the coapting valve extend beyond the attachment. The orifices must also equal expected
 * numbers from polygons, which other programs made. The numbers from polygons are for valves whose axis of view follows from
 * symmetry. */
TEST(orifices_are_those_of_turned_lines) {
  static const double openings[] = {0, 0.25, 0.5, 0.75, 1};
  static const double by_polygons[n_kinds][5] = {{-1, -1, -1, -1, -1},
                                                 {0, -1, -1, -1, 6.2517},
                                                 {0, 0.918, 1.882, 2.890, 3.943},
                                                 {0.00146508, 0.632731, 1.445828, 2.393365, 3.420030},
                                                 {0.038, 1.029, 2.084, 3.199, 4.375}};
  riis_surface_options fine = surface_options();
  fine.tolerance = 0.01;
  for (int kind = 0; kind < n_kinds; kind += trial_step()) {
    riis_valve *valve = new_valve(kinds[kind]);
    for (int i = 0; i < 5; ++i) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", openings[i]));
      const riis_orifice found = orifice_of(new_surface(valve, &fine), NULL);
      if (by_polygons[kind][i] >= 0) CHECK_NEAR(found.area, by_polygons[kind][i], 1e-3 * found.area + 5e-4);
      if (i % 2 == 0 || kind == 0 || kind == 4 || (is_short_test() && i != 1 + 2 * (kind % 2))) continue;
      const riis_surface *surface = new_surface(valve, NULL);
      const riis_orifice coarse = orifice_of(surface, NULL);
      CHECK_NEAR(coarse.area, area_by_turned_lines(surface, coarse.radius, coarse.axis), 1e-3 * coarse.area);
    }
  }
}

/* Unequal cusps are seen along z. The cusps' open edges may reach beyond the attachment. */
TEST(unequal_cusps_are_seen_along_z) {
  riis_valve *valve = new_valve("bicuspid");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  for (double sector = 140; sector <= 200; sector += is_short_test() ? 90 : 30) {
    CHECK_OK(riis_valve_set_scalar(valve, "cusp_0.sector", sector));
    CHECK_OK(riis_valve_set_scalar(valve, "cusp_1.sector", 360 - sector));
    const riis_surface *surface = new_surface(valve, NULL);
    const riis_orifice found = orifice_of(surface, NULL);
    CHECK_NEAR(found.axis[2], 1, 1e-14);
    CHECK_NEAR(found.area, area_by_turned_lines(surface, found.radius, found.axis), 1e-3 * found.area);
  }
}

/* If the edge moves inwards, the area decreases by the distance times the perimeter. */
TEST(perimeters_are_derivatives_of_areas) {
  for (int trial = 0; trial < n_trials(); ++trial) {
    const riis_surface *surface = new_surface(valve_at(trial % n_kinds, between(0.5, 1)), NULL);
    const riis_resistance how = resistance(0.1, RIIS_RIM_ROUND);
    const riis_orifice found = orifice_of(surface, &how);
    const double slit = 0.1 * how.half_thickness, step = 0.9 * slit;
    const riis_resistance less = resistance((slit - step) / found.rim_reach, RIIS_RIM_ROUND),
                          more = resistance((slit + step) / found.rim_reach, RIIS_RIM_ROUND);
    const double lost = orifice_of(surface, &less).effective_area - orifice_of(surface, &more).effective_area;
    /* Takes the mean perimeter over the step. A slit that closes within the step loses both of its edges. */
    enum { n_parts = 16 };
    double mean = 0;
    for (int i = 0; i <= n_parts; ++i) {
      const riis_resistance at = resistance(10 * (slit + step * (2.0 * i / n_parts - 1)), RIIS_RIM_ROUND);
      mean += orifice_of(surface, &at).perimeter / (i == 0 || i == n_parts ? 2 * n_parts : n_parts);
    }
    printf("%s: mean perimeter %.4f, by areas %.4f\n", kinds[trial % n_kinds], mean, lost / (2 * step));
    CHECK_NEAR(mean, lost / (2 * step), 0.02 * mean);
    assert_true(found.perimeter > 4 && found.effective_area > 0);
    const double first_order = found.area - found.rim_reach * found.half_thickness * found.perimeter;
    CHECK_NEAR(found.effective_area, first_order, 0.3 * found.perimeter * found.half_thickness);
  }
}

/* A placement multiplies the areas of the orifice by the square of the scale. */
TEST(placements_keep_orifices) {
  for (int trial = 0; trial < trials(n_kinds + 2, 2 * n_kinds + 2); ++trial) {
    const riis_valve *valve = valve_at(trial % n_kinds, trial < n_kinds ? 1 : between(0.2, 1));
    riis_surface_options options = surface_options();
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    const riis_orifice own_frame = orifice_of(new_surface(valve, &options), NULL);
    const double s = options.scale = pow(10, between(-3, 3));
    for (int c = 0; c < 3; ++c)
      options.rotation_axis[c] = between(-1, 1) + (c == 1 ? 2 : 0), options.translation[c] = s * between(-3, 3);
    options.rotation_angle = between(-180, 180);
    options.flip_normals = trial % 2;
    const riis_surface *surface = new_surface(valve, &options);
    const riis_orifice found = orifice_of(surface, NULL);
    assert_int_equal(found.outline, trial % n_kinds == 3 ? RIIS_OUTLINE_DISC : RIIS_OUTLINE_ATTACHMENT);
    CHECK_NEAR(found.area, s * s * own_frame.area, 1e-6 * s * s * own_frame.outline_area);
    CHECK_NEAR(found.outline_area, s * s * own_frame.outline_area, 1e-9 * s * s * own_frame.outline_area);
    CHECK_NEAR(found.effective_area, s * s * own_frame.effective_area, 1e-6 * s * s * own_frame.outline_area);
    CHECK_NEAR(found.perimeter, s * own_frame.perimeter, 1e-3 * s * own_frame.perimeter);
    CHECK_NEAR(found.radius, s * own_frame.radius, 1e-14 * s);
    CHECK_NEAR(found.half_thickness, 0.1 * s, 1e-14 * s);
    CHECK_NEAR(hypot(hypot(found.axis[0], found.axis[1]), found.axis[2]), 1, 1e-14);
    /* Rodrigues' formula */
    const double *k = options.rotation_axis, size = hypot(hypot(k[0], k[1]), k[2]), *v = own_frame.axis;
    const double angle = options.rotation_angle * acos(-1) / 180;
    const double along = (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]) / (size * size);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      const double turned = (k[d] * v[e] - k[e] * v[d]) / size;
      CHECK_NEAR(found.axis[c], cos(angle) * v[c] + sin(angle) * turned + (1 - cos(angle)) * along * k[c], 1e-9);
    }
  }
}

static riis_leaflet leaflet_of(const riis_surface *surface, int64_t leaflet) {
  riis_leaflet made;
  memset(&made, 0x5a, sizeof made);
  CHECK_OK(riis_surface_get_leaflet(surface, leaflet, &made, sizeof made));
  assert_int_equal(made.reserved, 0);
  return made;
}

TEST(leaflets_share_the_surface) {
  for (int trial = 0; trial < n_trials(); ++trial) {
    const riis_surface *surface = new_surface(valve_at(trial % n_kinds, trial < n_kinds ? 0 : between(0, 1)), NULL);
    const riis_surface_info info = info_of(surface);
    int64_t n = -7, n_triangles = 0;
    double area = 0;
    CHECK_OK(riis_surface_get_n_leaflets(surface, &n));
    for (int64_t i = 0; i < n; ++i) {
      const riis_leaflet leaflet = leaflet_of(surface, i);
      assert_int_equal(leaflet.leaflet_id, i);
      n_triangles += leaflet.n_triangles;
      area += leaflet.area;
      assert_true(leaflet.free_edge > 0);
    }
    assert_int_equal(n_triangles, info.n_triangles);
    CHECK_NEAR(area, info.area, 1e-13 * info.area);
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "leaflet is -1", riis_surface_get_leaflet(surface, -1, NULL, 32));
    riis_leaflet none;
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, n == 2 ? "leaflet is 2|has 2" : "leaflet is 3|has 3",
                  riis_surface_get_leaflet(surface, n, &none, sizeof none));
  }
  /* In the closed trileaflet valve, the free edge of a cusp goes straight from the wall to the axis, and straight back. */
  const riis_surface *closed = surface_of_kind("trileaflet", NULL);
  for (int i = 0; i < 3; ++i) CHECK_NEAR(leaflet_of(closed, i).free_edge, 2.5, 1e-12);
  const shape square = unit_square();
  CHECK_NEAR(leaflet_of(surface_of(&square, NULL), 0).free_edge, 1, 1e-15);
}

TEST(leaks_are_ideal) {
  for (int trial = 0; trial < trials_of(30); ++trial) {
    riis_surface_options options = surface_options();
    options.half_thickness = between(0.05, 0.2);
    const riis_surface *surface = new_surface(valve_at(trial % n_kinds, 0), &options);
    riis_resistance how = resistance(trial % 2 ? RIIS_AUTO : 0.07, RIIS_RIM_ROUND);
    how.R = pow(10, between(0, 6));
    const double drop = between(-1e5, 1e5), eps = trial % 2 ? options.half_thickness : 0.07;
    const double area = leaflet_of(surface, 0).area + leaflet_of(surface, 1).area +
                        (trial % n_kinds % 2 == 0 ? leaflet_of(surface, 2).area : 0);
    double flow = 0;
    CHECK_OK(riis_surface_get_leak(surface, &how, drop, &flow));
    CHECK_NEAR(flow, drop * eps / how.R * area, 1e-14 * fabs(flow));
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "drop is nan", riis_surface_get_leak(surface, &how, NAN, &flow));
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "flow is NULL", riis_surface_get_leak(surface, &how, 1, NULL));
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance is NULL", riis_surface_get_leak(surface, NULL, 1, &flow));
    how.R = 0;
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance.R is 0|from 1e-60 to 1e+60",
                  riis_surface_get_leak(surface, &how, 1, &flow));
    how.R = NAN;
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance.R is nan", riis_surface_get_leak(surface, &how, 1, &flow));
    /* With a smaller R the flow would be infinite. Without a pressure drop the flow would be NaN. */
    how.R = 1e-61;
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance.R is 1e-61", riis_surface_get_leak(surface, &how, 0, &flow));
    how.R = 1e-60, how.half_thickness = 1e50;
    CHECK_OK(riis_surface_get_leak(surface, &how, 1e30, &flow));
    assert_true(isfinite(flow) && flow > 0);
  }
}

TEST(wrong_calls_are_refused) {
  riis_orifice orifice;
  riis_surface *surface = surface_of_kind("mitral", NULL);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL",
                riis_surface_get_orifice(NULL, NULL, &orifice, sizeof orifice));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "orifice is NULL",
                riis_surface_get_orifice(surface, NULL, NULL, sizeof orifice));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "orifice is 8", riis_surface_get_orifice(surface, NULL, &orifice, 8));
  riis_resistance how = resistance(0, RIIS_RIM_ROUND);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance.half_thickness is 0",
                riis_surface_get_orifice(surface, &how, &orifice, sizeof orifice));
  how = resistance(0.1, 2);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance.rim is 2",
                riis_surface_get_orifice(surface, &how, &orifice, sizeof orifice));
  how = resistance(0.1, RIIS_RIM_CUT);
  how.reserved = 3;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance.reserved is 3",
                riis_surface_get_orifice(surface, &how, &orifice, sizeof orifice));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_leaflets is NULL", riis_surface_get_n_leaflets(surface, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "sizes is NULL", riis_surface_get_leaflet(surface, 0, NULL, 32));

  const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t ids[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, ids);
  const riis_surface *from_arrays = surface_from(&arrays, NULL);
  CHECK_OK(riis_surface_get_orifice(from_arrays, NULL, &orifice, sizeof orifice));
  assert_int_equal(orifice.outline, RIIS_OUTLINE_BOUNDARY);
  CHECK_NEAR(orifice.outline_area, 0.5, 1e-3);
  CHECK_NEAR(orifice.area, 0, 1e-3);
  CHECK_NEAR(leaflet_of(from_arrays, 0).area, 0.5, 1e-16);
  CHECK_NEAR(leaflet_of(from_arrays, 0).free_edge, 0, 0);
  how = resistance(0.1, RIIS_RIM_ROUND);
  how.R = 5;
  double flow = 0;
  CHECK_OK(riis_surface_get_leak(from_arrays, &how, 10, &flow));
  CHECK_NEAR(flow, 0.1, 1e-16);
  CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, NULL));
  CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  assert_int_equal(orifice.outline, RIIS_OUTLINE_BOUNDARY);

  /* A single patch covers the whole inside of its outline. */
  const shape square = unit_square();
  const riis_orifice whole = orifice_of(surface_of(&square, NULL), NULL);
  assert_int_equal(whole.outline, RIIS_OUTLINE_ATTACHMENT);
  CHECK_NEAR(whole.outline_area, 1, 1e-12);
  CHECK_NEAR(whole.area + whole.perimeter + whole.effective_area + whole.radius, 0, 1e-12);
  CHECK_NEAR(fabs(whole.axis[2]), 1, 1e-14);
}

/* Two patches hang on arches in a plane through the z axis. Seen along z, the arches enclose no area. The axis therefore turns
 * until the farthest edges surround an area. */
TEST(outlines_need_not_be_seen_along_z) {
  shape wings = {0};
  for (int side = -1; side <= 1; side += 2) {
    const double arch[3][3] = {{-1, 0, 0}, {0, 0, side}, {1, 0, 0}};
    const int32_t first = (int32_t)wings.n_curves;
    add_curve(&wings, 2, arch);
    add_line(&wings, -1, side, 0, 1, side, 0);
    add_line(&wings, -1, 0, 0, -1, side, 0);
    add_line(&wings, 1, 0, 0, 1, side, 0);
    add_patch(&wings, first, first + 1, first + 2, first + 3);
  }
  const riis_orifice own_frame = orifice_of(surface_of(&wings, NULL), NULL);
  assert_int_equal(own_frame.outline, RIIS_OUTLINE_ATTACHMENT);
  for (int trial = 0; trial < trials_of(40); ++trial) {
    riis_surface_options options = surface_options();
    const double s = options.scale = pow(10, between(-3, 3));
    options.rotation_angle = between(-180, 180);
    for (int c = 0; c < 3; ++c) {
      options.rotation_axis[c] = between(-1, 1);
      options.translation[c] = options.scale * between(-10, 10);
    }
    const riis_orifice found = orifice_of(surface_of(&wings, &options), NULL);
    CHECK_NEAR(found.outline_area, s * s * own_frame.outline_area, 1e-6 * s * s * own_frame.outline_area);
    CHECK_NEAR(found.area, s * s * own_frame.area, 1e-3 * s * s * own_frame.outline_area);
  }
}

int main(void) {
  rng = random_start("test_orifice");
  return run_cases(NULL, NULL);
}
