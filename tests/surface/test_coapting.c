/* SPDX-License-Identifier: Apache-2.0
 * Tests the coapting valve: its coaptation zone, the computed path of its opening, and its sizes (docs/theory/coapting.md). An
 * oracle makes the curves from the document's formulas. The oracle uses bisection and chords instead of the library's numerical
 * methods. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "cusp_checks.h"

static const double turn[3] = {0, 120, -120}, half_angle[3] = {60, 60, 60};

enum { n_sizes = 13 };
static const char *const names[n_sizes] = {"root_radius",         "commissure_radius",
                                           "commissure_height",   "effective_height",
                                           "coaptation_height",   "gap",
                                           "bottom_angle",        "belly",
                                           "edge_rise",           "attachment_width",
                                           "attachment_drop",     "open_radius_ratio",
                                           "commissure_expansion"};
enum { R, RC, H, HE, HCO, GAP, BOTTOM, BELLY, RISE, WIDTH, DROP, OPEN, EXPANSION };

typedef struct sizes {
  double of[n_sizes];
} sizes;

static sizes sizes_of(const riis_valve *valve) {
  sizes made;
  for (int i = 0; i < n_sizes; ++i) CHECK_OK(riis_valve_get(valve, names[i], 1, &made.of[i]));
  return made;
}

/* Sets random sizes. Some proportions are those of patients, and some are more extreme. */
static void set_random_sizes(random_source *random, riis_valve *valve) {
  const double r = random_between(random, 0.9, 1.5), rc = r * random_between(random, 0.8, 1.2);
  const double h = rc * random_between(random, 1.1, 1.7);
  const double set[n_sizes] = {r,
                               rc,
                               h,
                               h - rc * tan(random_between(random, 25, 45) * cusp_degree),
                               rc * random_between(random, 0.1, 0.45),
                               rc * random_between(random, 0.003, 0.03),
                               random_between(random, 5, 40),
                               random_between(random, 0.3, 0.7),
                               random_between(random, 0.1, 0.5),
                               random_between(random, 0.4, 0.8),
                               random_between(random, 0.35, 0.65),
                               random_between(random, 0.6, 0.95),
                               random_between(random, 0, 0.15)};
  for (int i = 0; i < n_sizes; ++i) CHECK_OK(riis_valve_set_scalar(valve, names[i], set[i]));
}

static int64_t n_refused;

/* Returns a valve of random sizes that the library accepts. */
static riis_valve *random_valve(random_source *random) {
  riis_surface_options options = surface_options();
  options.tolerance = 0.3;
  for (;;) {
    riis_valve *valve = new_valve("coapting");
    riis_surface *surface = NULL;
    set_random_sizes(random, valve);
    const riis_status status = riis_surface_create(valve, &options, &surface);
    riis_surface_destroy(&surface);
    if (status == RIIS_OK) return valve;
    assert_int_equal(status, RIIS_INVALID_PARAMETER);
    ++n_refused;
    free_one_owned(valve);
  }
}

/* --- The oracle -------------------------------------------------------------------------------------------------------- */

typedef struct point {
  double x[3];
} point;

static point sum(double a, point p, double b, point q) {
  point made;
  for (int c = 0; c < 3; ++c) made.x[c] = a * p.x[c] + b * q.x[c];
  return made;
}
static double length_of(point p) { return hypot(hypot(p.x[0], p.x[1]), p.x[2]); }

/* A cubic with a table of its lengths. */
enum { n_chords = 1600 };
typedef struct cubic {
  point q[4];
  double behind[n_chords + 1];
} cubic;

static point on_cubic(const point *q, double t) {
  const double s = 1 - t;
  return sum(1, sum(s * s * s, q[0], 3 * s * s * t, q[1]), 1, sum(3 * s * t * t, q[2], t * t * t, q[3]));
}

static void tabulate(cubic *curve) {
  curve->behind[0] = 0;
  for (int i = 1; i <= n_chords; ++i)
    curve->behind[i] = curve->behind[i - 1] + length_of(sum(1, on_cubic(curve->q, (double)i / n_chords), -1,
                                                            on_cubic(curve->q, (double)(i - 1) / n_chords)));
}

static point at_share(const cubic *curve, double share) {
  const double wanted = share * curve->behind[n_chords];
  int low = 0, high = n_chords;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    *(curve->behind[middle] <= wanted ? &low : &high) = middle;
  }
  const double step = curve->behind[high] - curve->behind[low];
  return on_cubic(curve->q, (low + (step > 0 ? (wanted - curve->behind[low]) / step : 0)) / n_chords);
}

static cubic cubic_of(point a, point b, point c, point d) {
  cubic made = {{a, b, c, d}, {0}};
  tabulate(&made);
  return made;
}
static cubic line_of(point a, point d) {
  return cubic_of(a, sum(2.0 / 3, a, 1.0 / 3, d), sum(1.0 / 3, a, 2.0 / 3, d), d);
}

/* Half a cusp, y >= 0. */
typedef struct half {
  cubic edge, line, below, above, attachment;
} half;

/* The length of half a free edge whose middle hangs `depth` below the commissure. */
static double edge_length(const double (*plan)[2], const double *sag, double depth) {
  point q[4];
  for (int i = 0; i < 4; ++i) q[i] = (point){{plan[i][0], plan[i][1], -depth * sag[i]}};
  double length = 0;
  point last = q[0];
  for (int i = 1; i <= 4000; ++i) {
    const point next = on_cubic(q, i / 4000.0);
    length += length_of(sum(1, next, -1, last));
    last = next;
  }
  return length;
}

static point cross_of(point p, point q) {
  return (point){
      {p.x[1] * q.x[2] - p.x[2] * q.x[1], p.x[2] * q.x[0] - p.x[0] * q.x[2], p.x[0] * q.x[1] - p.x[1] * q.x[0]}};
}
static double dot_of(point p, point q) { return p.x[0] * q.x[0] + p.x[1] * q.x[1] + p.x[2] * q.x[2]; }

/* The crease at t of the coaptation line depends on the chord's point, the free edge's point, and the end tangents. */
typedef struct crease_at {
  double t;
  point chord, edge, tangents;
} crease_at;

/* Returns the determinant of three vectors: the line's tangent, and the derivatives of both patches across the line. Also returns
 * a divisor that turns the determinant into the sine of the angle between the patches. */
static double determinant(const point *q, const crease_at *at, double *divisor) {
  const double t = at->t, s = 1 - t;
  const point on = on_cubic(q, t);
  const point along =
      sum(3, sum(s * s, sum(1, q[1], -1, q[0]), 2 * s * t, sum(1, q[2], -1, q[1])), 3 * t * t, sum(1, q[3], -1, q[2]));
  const point below = sum(1, sum(1, on, -1, at->chord), 1, at->tangents), above = sum(1, at->edge, -1, on);
  const point first = cross_of(along, below), second = cross_of(along, above);
  if (divisor) *divisor = length_of(first) * length_of(second) / length_of(along);
  return dot_of(first, above);
}

/* Moves the inner control points of the coaptation line as the document says. Derivatives are computed as differences. */
static void smooth_line(half *of, point of_symmetry, point of_attachment) {
  const double chord = length_of(sum(1, of->line.q[3], -1, of->line.q[0])), h = 1e-4 * chord;
  for (int step = 0; step < 2; ++step) {
    double m[6][7] = {{0}};
    for (int k = 1; k < 8; ++k) {
      double row[7], divisor;
      const double u = of->line.behind[k * n_chords / 8] / of->line.behind[n_chords];
      const crease_at at = {k / 8.0, sum(1 - u, of->line.q[0], u, of->line.q[3]), at_share(&of->edge, u),
                            sum(1 - u, of_symmetry, u, of_attachment)};
      row[6] = determinant(of->line.q, &at, &divisor) / divisor;
      for (int i = 0; i < 6; ++i) {
        double at_side[2];
        for (int side = 0; side < 2; ++side) {
          point q[4];
          memcpy(q, of->line.q, sizeof q);
          q[1 + i / 3].x[i % 3] += side ? h : -h;
          at_side[side] = determinant(q, &at, NULL);
        }
        row[i] = (at_side[1] - at_side[0]) / (2 * h) / divisor;
      }
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 7; ++j) m[i][j] += row[i] * row[j];
    }
    for (int i = 0; i < 6; ++i) m[i][i] += 0.03 / (chord * chord);
    for (int k = 0; k < 6; ++k)
      for (int i = 0; i < 6; ++i)
        for (int j = 6; j >= k; --j)
          if (i != k) m[i][j] -= m[i][k] / m[k][k] * m[k][j];
    for (int i = 0; i < 6; ++i) of->line.q[1 + i / 3].x[i % 3] -= m[i][6] / m[i][i];
    tabulate(&of->line);
  }
}

static half half_of(const double *closed, const double *open, double t) {
  const double c = 0.5, s = sqrt(3) / 2;
  double plan[2][4][2], sag[2][4], scalars[2][9], edge[2], top[2][3], now[9];
  for (int k = 0; k < 2; ++k) {
    const double *v = k ? open : closed, zk = v[HE] - v[HCO], a = v[BOTTOM] * cusp_degree, g = v[GAP] / 2;
    const double tangent = fmin(v[BELLY] * v[R], 0.5 * zk / sin(a));
    double shut[4][2] = {{g / s, 0}}, hang[4] = {1, 1, 1 - v[RISE], 0};
    for (int i = 1; i < 4; ++i) {
      shut[i][0] = (1 - i / 3.0) * g / s + i / 3.0 * v[RC] * c;
      shut[i][1] = i / 3.0 * v[RC] * s;
    }
    edge[k] = edge_length(shut, hang, v[H] - v[HE]);
    /* root radius, width, drop, band, lean, belly x, belly rise, start of the band */
    double of_closed[9] = {v[R], v[WIDTH] * v[R],         v[DROP] * v[H],        v[HCO] / v[HE],
                           0,    v[R] - tangent * cos(a), tangent * sin(a) / zk, 0.5,
                           0};
    double reach = v[RC] * 4 / 3 * tan(15 * cusp_degree), e = 1 + v[EXPANSION], x = v[OPEN] * v[RC];
    const cubic below = cubic_of((point){{v[R], 0, 0}}, (point){{of_closed[5], 0, tangent * sin(a)}},
                                 (point){{g / s, 0, 0.5 * zk}}, (point){{g / s, 0, zk}});
    const double share = below.behind[n_chords] / (below.behind[n_chords] + v[HCO]);
    const double of_open[9] = {v[R],
                               v[WIDTH] * v[R],
                               v[DROP] * v[H],
                               1 - share,
                               (1 - share) * (v[R] - x),
                               v[R] + (x - v[R]) * share / 3,
                               1.0 / 3,
                               1.0 / 3,
                               0};
    const double wide[4][2] = {
        {x, 0}, {x, reach}, {e * c * v[RC] + s * reach, e * s * v[RC] - c * reach}, {e * c * v[RC], e * s * v[RC]}};
    const double slack[4] = {1, 1, 1.0 / 3, 0};
    memcpy(scalars[k], k ? of_open : of_closed, sizeof of_open);
    memcpy(plan[k], k ? &wide[0][0] : &shut[0][0], sizeof wide);
    memcpy(sag[k], k ? slack : hang, sizeof slack);
    top[k][0] = (k ? e : 1) * c * v[RC], top[k][1] = (k ? e : 1) * s * v[RC], top[k][2] = v[H];
  }
  const double early = 1 - (1 - t) * (1 - t);
  for (int i = 0; i < 9; ++i) {
    const double weight = i == 5 ? early : t;
    now[i] = (1 - weight) * scalars[0][i] + weight * scalars[1][i];
  }
  double flat[4][2], down[4], low = 0, high = 100;
  for (int i = 0; i < 4; ++i) {
    for (int d = 0; d < 2; ++d) flat[i][d] = (1 - t) * plan[0][i][d] + t * plan[1][i][d];
    down[i] = (1 - early) * sag[0][i] + early * sag[1][i];
  }
  const double wanted = (1 - t) * edge[0] + t * edge[1];
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    *(edge_length(flat, down, middle) < wanted ? &low : &high) = middle;
  }
  const point C = {
      {(1 - t) * top[0][0] + t * top[1][0], (1 - t) * top[0][1] + t * top[1][1], (1 - t) * top[0][2] + t * top[1][2]}};
  point f[4];
  for (int i = 0; i < 4; ++i) f[i] = (point){{flat[i][0], flat[i][1], C.x[2] - low * down[i]}};
  half made;
  made.edge = cubic_of(f[0], f[1], f[2], C);
  const double z = f[0].x[2];
  const point K = {{f[0].x[0] + now[4], 0, (1 - now[3]) * z}}, up = sum(1, f[0], -1, K), root = {{now[0], 0, 0}};
  made.below = cubic_of(root, (point){{now[5], 0, now[6] * K.x[2]}}, sum(1, K, -now[7] * K.x[2] / up.x[2], up), K);
  made.above = line_of(K, f[0]);
  made.attachment = cubic_of(root, (point){{now[0], now[1], 0}}, sum(1, C, -now[2], (point){{0, 0, 1}}), C);
  /* K(u) + w(u) T(u) = F(u), T = K(u) - chord(u) + (1 - u) L_Y up / |up| + u L_A e_z, w = (1 - u) |up| / L_Y */
  point at[2];
  for (int i = 0; i < 2; ++i) {
    const double u = (i + 1) / 3.0, w = (1 - u) * length_of(up) / made.below.behind[n_chords];
    const point chord = sum(1 - u, K, u, C);
    const point rest = sum((1 - u) * made.below.behind[n_chords] / length_of(up), up,
                           u * made.attachment.behind[n_chords], (point){{0, 0, 1}});
    at[i] = sum(1 / (1 + w), sum(1, on_cubic(made.edge.q, u), w, chord), -w / (1 + w), rest);
  }
  made.line = cubic_of(K, sum(1, sum(-5.0 / 6, K, 3, at[0]), 1, sum(-1.5, at[1], 1.0 / 3, C)),
                       sum(1, sum(1.0 / 3, K, -1.5, at[0]), 1, sum(3, at[1], -5.0 / 6, C)), C);
  smooth_line(&made, sum(made.below.behind[n_chords] / length_of(up), up, 0, up),
              (point){{0, 0, made.attachment.behind[n_chords]}});
  return made;
}

/* The point of a patch of the half y >= 0: patch 0 is below the coaptation line, and patch 1 above it. */
static point on_patch(const half *of, int patch, double u, double v) {
  const cubic *left = patch ? &of->above : &of->below;
  const point C = of->edge.q[3], bottom = patch ? at_share(&of->line, u) : left->q[0];
  const point top = at_share(patch ? &of->edge : &of->line, u), right = patch ? C : at_share(&of->attachment, v);
  const point p00 = left->q[0], p01 = left->q[3], p10 = patch ? C : left->q[0];
  point made = sum(1, sum(1 - v, bottom, v, top), 1, sum(1 - u, at_share(left, v), u, right));
  made = sum(1, made, -1, sum((1 - u) * (1 - v), p00, u * (1 - v), p10));
  return sum(1, made, -1, sum((1 - u) * v, p01, u * v, C));
}

/* The angle between the tangent planes of both patches along the coaptation line, in degrees. Differences are of second order. If
 * the zone begins just above the root, the leaflet turns upwards within some micrometres (bend_radius). The step of the
 * differences stays far below this radius. Rounding then causes at most 1e-4 degrees. */
static double crease(const half *of, double u) {
  const double step = 1e-6;
  const point along = sum(1, on_patch(of, 0, u + step, 1), -1, on_patch(of, 0, u - step, 1));
  point across[2];
  for (int k = 0; k < 2; ++k) {
    const point at = on_patch(of, 0, u, 1), near = on_patch(of, k, u, k ? step : 1 - step);
    const point far = on_patch(of, k, u, k ? 2 * step : 1 - 2 * step);
    across[k] = sum(k ? -1 : 1, sum(1.5, at, -2, near), k ? -0.5 : 0.5, far);
  }
  double dot[2], both = 0;
  const double square = length_of(along) * length_of(along);
  for (int k = 0; k < 2; ++k) {
    dot[k] = 0;
    for (int c = 0; c < 3; ++c) dot[k] += along.x[c] * across[k].x[c];
    across[k] = sum(1, across[k], -dot[k] / square, along);
  }
  for (int c = 0; c < 3; ++c) both += across[0].x[c] * across[1].x[c];
  return acos(fmax(-1, fmin(1, both / length_of(across[0]) / length_of(across[1])))) / cusp_degree;
}

/* The radius of the upward turn at the end of the closed symmetry curve. */
static double bend_radius(const half *of) {
  const point *q = of->below.q, end = sum(1, q[3], -1, q[2]), bend = sum(1, sum(1, q[3], -2, q[2]), 1, q[1]);
  return 1.5 * pow(length_of(end), 3) / length_of(cross_of(end, bend));
}

static double largest_crease(const half *of) {
  double largest = 0;
  for (int i = 1; i < 50; ++i) largest = fmax(largest, crease(of, i / 50.0));
  return largest;
}

/* --- The shape --------------------------------------------------------------------------------------------------------- */

/* Every vertex is at the oracle's place for its label, within the error bound of the surface. */
TEST(vertices_are_where_the_formulas_say) {
  random_source random = random_start("test_coapting");
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    options.tolerance = 0.01;
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    riis_valve *valve = trial ? random_valve(&random) : new_valve("coapting"), *other = NULL;
    if (trial % 4 == 3) {
      other = random_valve(&random);
      CHECK_OK(riis_valve_set_open_state(valve, other));
    }
    const double opening = trial < 3 ? 0.5 * trial : random_between(&random, 0, 1);
    const sizes closed = sizes_of(valve), open = sizes_of(other ? other : valve);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
    riis_surface *surface = new_surface(valve, &options);
    const half expected = half_of(closed.of, open.of, opening);
    const riis_triangles all = triangles_of(surface);
    const double bound = info_of(surface).error_bound;
    double farthest = 0;
    for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
      const int64_t v = all.vertex_id[i];
      const int32_t patch = all.patch_id[i / 3], leaflet = all.leaflet_id[i / 3];
      assert_int_equal(patch / 4, leaflet);
      const double a = turn[leaflet] * cusp_degree, *p = all.xyz + 3 * v;
      const point own_frame = {
          {p[0] * cos(a) + p[1] * sin(a), (p[1] * cos(a) - p[0] * sin(a)) * (patch % 4 < 2 ? 1 : -1), p[2]}};
      const point there = on_patch(&expected, patch % 2, all.uv[2 * v], all.uv[2 * v + 1]);
      farthest = fmax(farthest, length_of(sum(1, own_frame, -1, there)));
    }
    CHECK_AT_MOST(farthest, bound + 2e-6);
    free_owned_after(owned_before);
  }
}

/* Checks the sizes that the parameters promise, and the coaptation zone near the planes between the cusps. */
TEST(closed_cusps_coapt) {
  random_source random = random_start("test_coapting");
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = trial ? random_valve(&random) : new_valve("coapting");
    const sizes v = sizes_of(valve);
    const riis_triangles all = triangles_of(new_surface(valve, NULL));
    double middle[2] = {-9, -9};
    for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
      const int64_t k = all.vertex_id[i];
      const int32_t patch = all.patch_id[i / 3];
      if (patch % 2 == 0) continue;
      const double a = (turn[patch / 4] + (patch % 4 == 1 ? 60 : -60)) * cusp_degree, *p = all.xyz + 3 * k;
      const double away = (p[0] * sin(a) - p[1] * cos(a)) * (patch % 4 == 1 ? 1 : -1);
      assert_true(away >= -1e-15 && away <= v.of[GAP] / 2 + 1e-12);
      if (all.uv[2 * k] == 0) {
        CHECK_NEAR(away, v.of[GAP] / 2, 1e-12);
        if (all.uv[2 * k + 1] == 0) middle[0] = p[2];
        if (all.uv[2 * k + 1] == 1) middle[1] = p[2];
      } else if (all.uv[2 * k] == 1) {
        CHECK_NEAR(p[2], v.of[H], 1e-14);
        CHECK_NEAR(hypot(p[0], p[1]), v.of[RC], 1e-14);
      }
    }
    CHECK_NEAR(middle[1], v.of[HE], 1e-12);
    CHECK_NEAR(middle[1] - middle[0], v.of[HCO], 1e-12);
    free_owned_after(owned_before);
  }
}

static int64_t n_pairs_of(const riis_surface *surface, riis_crossings *crossings) {
  riis_crossing_list list;
  CHECK_OK(riis_find_crossings(surface, NULL, crossings));
  CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
  return list.n_pairs;
}

/* A point near the coaptation zone must have the side of the nearer cusp. */
static int64_t wrong_sides(const riis_surface *surface, const sizes *v, random_source *random, int n) {
  const half closed = half_of(v->of, v->of, 0);
  int64_t wrong = 0;
  for (int i = 0; i < n; ++i) {
    const point p = on_patch(&closed, 1, random_between(random, 0, 0.9), random_between(random, 0.05, 0.9));
    const double normal[2] = {sqrt(3) / 2, -0.5};
    /* Points in the gap lie on the ventricle's side. Points behind the zone lie on the aorta's side. */
    const double away = p.x[0] * normal[0] + p.x[1] * normal[1];
    for (int k = 0; k < 2; ++k) {
      const double off = k ? random_between(random, 0.05, 0.5) * 0.1 : -random_between(random, 0.1, 0.9) * away;
      const riis_closest found = closest_to(surface, p.x[0] + off * normal[0], p.x[1] + off * normal[1], p.x[2]);
      wrong += found.side != (k ? 1 : -1);
    }
  }
  return wrong;
}

/* Returns the number of pairs of triangles that cross because the smooth valve crosses. A leaflet may be nearly tangent to itself
 * near the root, at a distance of about 1 micrometre. The leaflet's triangles may then cross by at most twice their error bound,
 * but finer triangles do not cross. `n_shallow` counts such crossings. */
static int64_t true_crossings(const riis_surface *surface, const riis_valve *valve, riis_crossings *crossings,
                              int64_t *n_shallow) {
  const int64_t found = n_pairs_of(surface, crossings);
  riis_crossing_list list;
  CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
  if (found == 0 || list.deepest_depth > 2 * info_of(surface).error_bound) return found;
  riis_surface_options fine = surface_options();
  fine.tolerance = 0.01;
  riis_surface *finer = new_surface(valve, &fine);
  const int64_t remain = n_pairs_of(finer, crossings);
  free_one_owned(finer);
  *n_shallow += remain == 0;
  return remain;
}

/* Returns how far the control points of a patch's side are from those of a cubic. */
static double off_side(const riis_valve_patches *patches, int32_t patch_id, int side, const cubic *expected) {
  int64_t patch = 0;
  while (patches->patch_id[patch] != patch_id) assert_true(++patch < patches->n_patches);
  const int64_t curve = patches->curve_id[4 * patch + side];
  const int is_reversed = patches->reversed[4 * patch + side];
  const double *control = patches->control;
  assert_int_equal(patches->n_pieces, patches->n_curves);
  for (int64_t i = 0; i < curve; ++i) control += 3 * (patches->degree[i] + 1);
  assert_int_equal(patches->degree[curve], 3);
  double farthest = 0;
  for (int k = 0; k < 4; ++k) {
    point got;
    memcpy(got.x, control + 3 * (is_reversed ? 3 - k : k), sizeof got.x);
    farthest = fmax(farthest, length_of(sum(1, got, -1, expected->q[k])));
  }
  return farthest;
}

/* A zone that begins just above the root has no crease either. Near the root, the leaflet turns upwards with a radius of 4
 * micrometres, as docs/theory/coapting.md says. Differences over steps longer than this radius would report the turn as a
 * crease. */
TEST(a_low_zone_turns_sharply_without_a_crease) {
  static const double low[n_sizes] = {1.3233848, 1.0696550, 1.2100624, 0.3307880, 0.2947382, 0.00658190, 39.099050,
                                      0.5418369, 0.4873270, 0.5369197, 0.4438359, 0.8011948, 0.0445718};
  for (int trial = 0; trial < 2; ++trial) {
    riis_valve *valve = new_valve("coapting");
    for (int i = 0; i < n_sizes && trial; ++i) CHECK_OK(riis_valve_set_scalar(valve, names[i], low[i]));
    const sizes v = sizes_of(valve);
    const half closed = half_of(v.of, v.of, 0);
    riis_valve_patches patches;
    CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
    CHECK_AT_MOST(off_side(&patches, 0, 1, &closed.line), 1e-7); /* smooth_line computes derivatives by differences */
    CHECK_AT_MOST(off_side(&patches, 0, 2, &closed.below), 1e-12);
    CHECK_AT_MOST(off_side(&patches, 0, 3, &closed.attachment), 1e-12);
    CHECK_AT_MOST(off_side(&patches, 1, 1, &closed.edge), 1e-12);
    const double z = v.of[HE] - v.of[HCO], a = v.of[BOTTOM] * cusp_degree;
    const double tangent = fmin(v.of[BELLY] * v.of[R], 0.5 * z / sin(a));
    const double across = v.of[R] - tangent * cos(a) - v.of[GAP] / sqrt(3);
    const double radius = bend_radius(&closed);
    printf("the zone begins at %.3f cm: crease %.5f degrees, radius %.5f cm\n", z, largest_crease(&closed), radius);
    CHECK_NEAR(radius, 0.375 * z * z / across, 1e-9 * radius);
    CHECK_NEAR(radius, trial ? 0.00037 : 0.163, trial ? 2e-5 : 1e-3);
    CHECK_AT_MOST(largest_crease(&closed), 0.01);
  }
}

/* With some sizes, the fully open leaflet is nearly tangent to itself near the root. The triangles of the default tolerance cross
 * by a fraction of a micrometre, but the valve does not. */
TEST(a_nearly_tangent_leaflet_does_not_cross) {
  static const double near[n_sizes] = {0.98866634, 0.92969360, 1.24758771, 0.44617366, 0.39553918,
                                       0.00534347, 30.093938,  0.3640963,  0.2068927,  0.4116654,
                                       0.4374171,  0.7326276,  0.0287498};
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  riis_valve *valve = new_valve("coapting");
  int64_t n_shallow = 0;
  for (int i = 0; i < n_sizes; ++i) CHECK_OK(riis_valve_set_scalar(valve, names[i], near[i]));
  for (int i = 0; i <= 10; ++i) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.1 * i));
    assert_int_equal(true_crossings(new_surface(valve, NULL), valve, crossings, &n_shallow), 0);
  }
  printf("a nearly tangent leaflet: at %lld of 11 openings only triangles cross\n", (long long)n_shallow);
}

/* Each cusp equals its mirror image, and a turn by 120 degrees maps the valve to itself. The symmetry by mirroring and the
 * symmetry by turning hold with either triangulation, even for random sizes. Cusps have the same bits at the commissures. */
TEST(cusps_are_equal) {
  random_source random = random_start("test_coapting");
  for (int trial = 0; trial < trials_of(18); ++trial) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    riis_valve *valve = trial < 2 ? new_valve("coapting") : random_valve(&random);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial % 3 * 0.5));
    riis_surface *surface = new_surface(valve, &options);
    options.rotation_angle = 120;
    riis_surface *turned = new_surface(valve, &options);
    const riis_triangles all = triangles_of(surface);
    const double *ends[6] = {0};
    for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
      const int64_t v = all.vertex_id[i];
      const double *p = all.xyz + 3 * v;
      if (i % 7 == 0) {
        CHECK_AT_MOST(closest_to(turned, p[0], p[1], p[2]).distance, 1e-14);
        CHECK_AT_MOST(closest_to(surface, p[0], -p[1], p[2]).distance, 1e-14);
      }
      if (all.uv[2 * v] == 1 && all.uv[2 * v + 1] == 1)
        for (int k = 0; k < 6; ++k) {
          if (!ends[k]) ends[k] = p;
          if (hypot(hypot(p[0] - ends[k][0], p[1] - ends[k][1]), p[2] - ends[k][2]) > 0.01) continue;
          for (int c = 0; c < 3; ++c) CHECK_SAME(p[c] + 0.0, ends[k][c] + 0.0);
          break;
        }
    }
    for (int k = 0; k < 6; ++k) assert_true(!ends[k] == (k >= 3));
    free_owned_after(owned_before);
  }
}

/* A placed valve differs only by its place: points at corresponding places have equal distances. */
TEST(placements_move_the_valve) {
  random_source random = random_start("test_coapting");
  for (int trial = 0; trial < 4; ++trial) {
    riis_surface_options options = surface_options();
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    riis_valve *valve = random_valve(&random);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", random_between(&random, 0, 1)));
    riis_surface *surface = new_surface(valve, &options);
    options.rotation_axis[0] = 0, options.rotation_axis[1] = 0, options.rotation_axis[2] = 1;
    options.rotation_angle = random_between(&random, -180, 180);
    for (int c = 0; c < 3; ++c) options.translation[c] = random_between(&random, -3, 3);
    riis_surface *placed = new_surface(valve, &options);
    const double a = options.rotation_angle * cusp_degree;
    for (int i = 0; i < 50; ++i) {
      const double x = random_between(&random, -2, 2), y = random_between(&random, -2, 2),
                   z = random_between(&random, -1, 3);
      const riis_closest here = closest_to(surface, x, y, z);
      const riis_closest there =
          closest_to(placed, x * cos(a) - y * sin(a) + options.translation[0],
                     x * sin(a) + y * cos(a) + options.translation[1], z + options.translation[2]);
      CHECK_NEAR(here.distance, there.distance, 1e-12);
    }
  }
}

/* At 11 openings, random valves do not cross, their free edges keep their length, and the coaptation line is not a crease. Cusps
 * stay in their sectors, so two cusps cannot cross. RIIS_TEST_LONG=1 takes 300 valves. */
TEST(random_valves_open_well) {
  random_source random = random_start("test_coapting");
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  const int n = trials(8, 300);
  double low = 1, high = 1, creases[2] = {0, 0}, least_opening = 9;
  int64_t n_crossing = 0, n_shallow = 0, n_wrong = 0;
  n_refused = 0;
  for (int trial = 0; trial < n; ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = trial ? random_valve(&random) : new_valve("coapting");
    const sizes v = sizes_of(valve);
    riis_surface *surface = new_surface(valve, NULL);
    double at_rest[3];
    free_edge_lengths(surface, at_rest);
    n_wrong += wrong_sides(surface, &v, &random, 50);
    int64_t n_pairs = 0;
    for (int i = 0; i <= 10; ++i) {
      double lengths[3];
      CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.1 * i));
      CHECK_OK(riis_surface_update(surface, valve, NULL));
      free_edge_lengths(surface, lengths);
      for (int cusp = 0; cusp < 3; ++cusp) {
        low = fmin(low, lengths[cusp] / at_rest[cusp]);
        high = fmax(high, lengths[cusp] / at_rest[cusp]);
      }
      const int64_t found = true_crossings(surface, valve, crossings, &n_shallow);
      if (found) printf("valve %d crosses in %lld pairs at opening %.1f\n", trial, (long long)found, 0.1 * i);
      n_pairs += found;
      CHECK_AT_MOST(reach_out_of_sectors(surface, turn, half_angle), 1e-14);
      const half shape = half_of(v.of, v.of, 0.1 * i);
      creases[i > 0] = fmax(creases[i > 0], largest_crease(&shape));
    }
    if (n_pairs)
      for (int i = 0; i < n_sizes; ++i) printf("  %s %.4f\n", names[i], v.of[i]);
    n_crossing += n_pairs > 0;
    riis_orifice orifice;
    CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
    least_opening = fmin(least_opening, orifice.area / (acos(-1) * v.of[RC] * v.of[RC]));
    free_owned_after(owned_before);
  }
  printf(
      "%d valves at 11 openings (%lld sets refused): %lld cross, %lld states whose triangles alone cross, "
      "free edge %.5f to %.5f of its length, crease %.2f degrees closed, %.2f opening, %lld wrong sides, "
      "open orifice at least %.2f pi Rc^2\n",
      n, (long long)n_refused, (long long)n_crossing, (long long)n_shallow, low, high, creases[0], creases[1],
      (long long)n_wrong, least_opening);
  assert_int_equal(n_crossing, 0);
  assert_true(n_refused < n);
  assert_true(low > 0.999 && high < 1.001);
  CHECK_AT_MOST(creases[0], 0.01); /* degrees, with the finite differences of this test */
  CHECK_AT_MOST(creases[1], 2);
  assert_int_equal(n_wrong, 0);
}

/* --- Sealing and opening ----------------------------------------------------------------------------------------------- */

/* A flood fill over a grid finds no way through closed valves with a cylindrical root. The fill finds a way through open
 * valves. */
TEST(closes_cylinders) {
  random_source random = random_start("test_coapting");
  const int n = trials(2, 20);
  for (int trial = 0; trial < n; ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = trial ? random_valve(&random) : new_valve("coapting");
    const double r = sizes_of(valve).of[R];
    CHECK_OK(riis_valve_set_scalar(valve, "commissure_radius", r));
    riis_surface *surface = NULL;
    if (riis_surface_create(valve, NULL, &surface) == RIIS_OK) {
      riis_surface_destroy(&surface);
      assert_false(leaks_through(valve, r, -0.8, 0.1));
      CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.3));
      assert_true(leaks_through(valve, r, -0.8, 0.1));
      if (trial == 0) assert_true(leaks_through(new_valve("coapting"), 1.6, -0.8, 0.1)); /* around the outside */
    }
    free_owned_after(owned_before);
  }
}

TEST(opens_by_itself) {
  double orifice = -1;
  for (int i = 0; i <= 10; ++i) {
    const double wider = orifice_area(new_surface(valve_at("coapting", i / 10.0), NULL), 1.25, 300);
    assert_true(wider > orifice);
    orifice = wider;
  }
  printf("the open orifice is %.3f, %.3f pi Rc^2\n", orifice, orifice / (acos(-1) * 1.25 * 1.25));
  assert_true(orifice >= 0.8 * acos(-1) * 1.25 * 1.25);
  /* In the closed valve, only the gap and slivers along the wall stay free. */
  CHECK_AT_MOST(orifice_area(new_surface(new_valve("coapting"), NULL), 1.25, 600), 0.07);
}

/* A smooth path has no kinks. The second difference over a small step on fixed triangles therefore stays the same for half the
 * step. */
TEST(path_is_smooth) {
  random_source random = random_start("test_coapting");
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  for (int trial = 0; trial < trials_of(9); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = trial ? random_valve(&random) : new_valve("coapting");
    riis_surface *at[5];
    for (int i = 0; i < 5; ++i) at[i] = new_surface(valve, &options);
    double largest = 0, worst = 0;
    for (int k = 1; k < 25; ++k) {
      const double step = 0.02, middle = 0.04 * k;
      for (int i = 0; i < 5; ++i) {
        CHECK_OK(riis_valve_set_scalar(valve, "opening", middle + (i - 2) * step / 2));
        CHECK_OK(riis_surface_update(at[i], valve, NULL));
      }
      const int64_t n = triangles_of(at[0]).n_vertices;
      for (int64_t j = 0; j < 3 * n; ++j) {
        double x[5];
        for (int i = 0; i < 5; ++i) x[i] = triangles_of(at[i]).xyz[j];
        const double wide = (x[0] - 2 * x[2] + x[4]) / (step * step),
                     narrow = 4 * (x[1] - 2 * x[2] + x[3]) / (step * step);
        largest = fmax(largest, fabs(wide)), worst = fmax(worst, fabs(wide - narrow));
      }
    }
    printf("the acceleration is at most %.2f, and differs by %.4f between steps\n", largest, worst);
    /* The third derivative changes the second difference a little. A kink of the velocity would instead double the second
     * difference for half the step. */
    assert_true(worst < 0.4 * largest);
    free_owned_after(owned_before);
  }
}

/* A state has the same bits after any earlier calls and with any number of threads. */
TEST(results_repeat) {
  random_source random = random_start("test_coapting");
  for (int trial = 0; trial < 4; ++trial) {
    riis_valve *valve = random_valve(&random), *before = NULL;
    CHECK_OK(riis_valve_copy(valve, &before));
    own(before);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", random_between(&random, 0, 1)));
    riis_surface_options options = surface_options();
    options.n_threads = 1;
    riis_surface *one = new_surface(valve, &options);
    options.n_threads = 3;
    riis_surface *three = new_surface(before, &options);
    CHECK_OK(riis_surface_update(three, valve, NULL));
    assert_true(is_same_content(one, three));
    CHECK_OK(riis_surface_update_moving(three, valve, before, 0.1, NULL, NULL));
    assert_true(is_same_content(one, three));
  }
}

/* If there is a second valve, the closed shape comes from the first valve, and the open shape from the second. */
TEST(opens_to_another_valves_open_state) {
  riis_valve *valve = new_valve("coapting"), *other = new_valve("coapting"), *plain = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(other, "open_radius_ratio", 0.7));
  CHECK_OK(riis_valve_set_scalar(other, "effective_height", 0.95));
  CHECK_OK(riis_valve_set_open_state(valve, other));
  assert_true(is_same_content(new_surface(valve, NULL), new_surface(plain, NULL)));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  CHECK_OK(riis_valve_set_scalar(other, "opening", 1));
  assert_true(is_same_content(new_surface(valve, NULL), new_surface(other, NULL)));
  CHECK_OK(riis_valve_set_scalar(other, "opening", 0));
  /* The length of the free edge is blended between the lengths of the two closed valves. */
  double from[3], to[3], half_way[3];
  free_edge_lengths(new_surface(plain, NULL), from);
  free_edge_lengths(new_surface(other, NULL), to);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
  free_edge_lengths(new_surface(valve, NULL), half_way);
  CHECK_NEAR(half_way[0], (from[0] + to[0]) / 2, 1e-3);
  assert_true(fabs(from[0] - to[0]) > 0.03);
}

/* The largest angle, in degrees, at which the two halves of a leaflet meet in the symmetry plane below the coaptation line. */
static double middle_crease(const half *of) {
  double largest = 0;
  for (int i = 5; i < 50; ++i) {
    const double v = i / 50.0, step = 1e-4;
    const point p = sum(1, on_patch(of, 0, step, v), -1, on_patch(of, 0, 0, v)),
                q = sum(1, on_patch(of, 0, 0, v + step), -1, on_patch(of, 0, 0, v - step));
    const double n[3] = {p.x[1] * q.x[2] - p.x[2] * q.x[1], p.x[2] * q.x[0] - p.x[0] * q.x[2],
                         p.x[0] * q.x[1] - p.x[1] * q.x[0]};
    largest = fmax(largest, 2 * atan2(fabs(n[1]), hypot(n[0], n[2])) / cusp_degree);
  }
  return largest;
}

/* Measures of valves with default sizes agree with the literature. The test prints the table for docs/theory/coapting.md. */
TEST(measures_are_those_of_the_literature) {
  riis_valve *valve = new_valve("coapting");
  const sizes v = sizes_of(valve);
  const half closed = half_of(v.of, v.of, 0), open = half_of(v.of, v.of, 1);
  riis_surface *surface = new_surface(valve, NULL);
  double edges[3];
  free_edge_lengths(surface, edges);
  const double height = closed.below.behind[n_chords] + v.of[HCO];
  double area = 0, zone = 0;
  const riis_triangles all = triangles_of(surface);
  for (int64_t t = 0; t < all.n_triangles; ++t) {
    point p[3];
    for (int k = 0; k < 3; ++k) memcpy(p[k].x, all.xyz + 3 * all.vertex_id[3 * t + k], sizeof p[k].x);
    const double a = length_of(sum(1, p[1], -1, p[0])), b = length_of(sum(1, p[2], -1, p[1])),
                 c = length_of(sum(1, p[0], -1, p[2])), s = (a + b + c) / 2;
    const double here = sqrt(fmax(0, s * (s - a) * (s - b) * (s - c))) / 3;
    area += here, zone += all.patch_id[t] % 2 ? here : 0;
  }
  printf(
      "literature: geometric height %.2f cm (2.00 +- 0.21), effective height %.2f cm (0.98 +- 0.09),\n"
      "  free edge %.2f cm, %.2f Rc (3.0 cm at Rc = 1.2 cm, 2.5 Rc), cusp %.2f cm2, of which %.2f cm2 coapt\n"
      "  open: symmetry curve %.2f cm, middle of the free edge at the height %.2f cm\n",
      height, v.of[HE], edges[0], edges[0] / v.of[RC], area, zone,
      open.below.behind[n_chords] + open.above.behind[n_chords], open.edge.q[0].x[2]);
  /* For comparison, the function blends the free edge's control points. */
  double least = 1, most = 1;
  for (int i = 0; i <= 100; ++i) {
    cubic blended;
    for (int k = 0; k < 4; ++k) blended.q[k] = sum(1 - i / 100.0, closed.edge.q[k], i / 100.0, open.edge.q[k]);
    tabulate(&blended);
    const double share = blended.behind[n_chords] / closed.edge.behind[n_chords];
    least = fmin(least, share), most = fmax(most, share);
  }
  const half half_open = half_of(v.of, v.of, 0.5);
  printf(
      "  a blend of control points would change the free edge to %.3f to %.3f of its length\n"
      "  the halves of a leaflet meet at up to %.0f, %.0f and %.0f degrees at the openings 0, 0.5 and 1\n",
      least, most, middle_crease(&closed), middle_crease(&half_open), middle_crease(&open));
  assert_true(least < 0.97); /* otherwise the path need not be computed */
  CHECK_NEAR(height, 2, 2 * 0.21);
  CHECK_NEAR(v.of[HE], 0.98, 0.09);
  CHECK_NEAR(edges[0] / v.of[RC], 2.5, 0.02 * 2.5);
}

/* --- Parameters -------------------------------------------------------------------------------------------------------- */

TEST(every_parameter_by_name) {
  static const double values[n_sizes] = {1.25, 1.25, 1.75, 1.75 - 0.6745 * 1.25, 0.375, 0.02, 20, 0.5, 0.3, 0.6,
                                         0.5,  0.85, 0.05};
  riis_valve *valve = new_valve("coapting");
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  /* Four parameters are not sizes: the translation, the opening, the length of a skirt and the edge's stretch. The parameters of
   * commissures, cusps and bumps follow. */
  assert_int_equal(n, n_sizes + 4 + 3 * 2 + 3 * 4 + 6 * 6);
  riis_surface *half_open = new_surface(valve_at("coapting", 0.5), NULL);
  for (int i = 0; i < n_sizes; ++i) {
    riis_parameter parameter;
    double value;
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    assert_string_equal(parameter.name, names[i]);
    CHECK_OK(riis_valve_get(valve, names[i], 1, &value));
    CHECK_NEAR(value, values[i], 1e-15);
    CHECK_SAME(parameter.default_values[0], value);
    riis_valve *changed = valve_at("coapting", 0.5);
    CHECK_OK(riis_valve_set_scalar(changed, names[i], value + (i == GAP ? 0.001 : 0.01)));
    assert_false(is_same_content(new_surface(changed, NULL), half_open));
  }
  /* A shift moves every vertex by the shift itself. */
  const double shift[3] = {0.1, -0.2, 0.3};
  riis_valve *moved = valve_at("coapting", 0.5);
  CHECK_OK(riis_valve_set(moved, "translation", 3, shift));
  const riis_triangles a = triangles_of(half_open), b = triangles_of(new_surface(moved, NULL));
  assert_int_equal(a.n_vertices, b.n_vertices);
  for (int64_t i = 0; i < 3 * a.n_vertices; ++i) CHECK_NEAR(b.xyz[i], a.xyz[i] + shift[i % 3], 1e-15);
}

/* Sizes that are not set follow from others, in whatever order sizes are set. The shape scales with the sizes. */
TEST(sizes_follow) {
  random_source random = random_start("test_coapting");
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const double r = random_between(&random, 0.2, 20), rc = r * random_between(&random, 0.8, 1.2);
    riis_valve *valve = new_valve("coapting");
    double value;
    CHECK_OK(riis_valve_set_scalar(valve, trial % 2 ? "annulus" : "stj", trial % 2 ? 2 * r : 2 * rc));
    CHECK_OK(riis_valve_set_scalar(valve, trial % 2 ? "stj" : "annulus", trial % 2 ? 2 * rc : 2 * r));
    const sizes v = sizes_of(valve);
    CHECK_NEAR(v.of[R], r, 1e-15 * r);
    CHECK_NEAR(v.of[RC], rc, 1e-15 * r);
    CHECK_NEAR(v.of[H], 1.4 * rc, 1e-14 * r);
    CHECK_NEAR(v.of[HE], 1.4 * rc - 0.6745 * rc, 1e-14 * r);
    CHECK_NEAR(v.of[HCO], 0.3 * rc, 1e-14 * r);
    CHECK_NEAR(v.of[GAP], 0.016 * rc, 1e-14 * r);
    CHECK_OK(riis_valve_get(valve, "stj", 1, &value));
    CHECK_NEAR(value, 2 * rc, 1e-14 * r);
    CHECK_OK(riis_valve_unset(valve, "commissure_radius"));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.4));
    riis_surface_options options = surface_options();
    options.half_thickness = 0.08 * r;
    riis_valve *plain = valve_at("coapting", 0.4);
    const riis_triangles a = triangles_of(new_surface(valve, &options)), b = triangles_of(new_surface(plain, NULL));
    assert_int_equal(a.n_vertices, b.n_vertices);
    for (int64_t i = 0; i < 3 * a.n_vertices; ++i) CHECK_NEAR(a.xyz[i], b.xyz[i] * r / 1.25, 1e-9 * r);
  }
  riis_valve *low = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(low, "commissure_height", 0.8));
  double value;
  CHECK_OK(riis_valve_get(low, "effective_height", 1, &value));
  CHECK_NEAR(value, 0.24, 1e-15);
  CHECK_OK(riis_valve_get(low, "coaptation_height", 1, &value));
  CHECK_NEAR(value, 0.6 * 0.24, 1e-15);
}

TEST(values_that_do_not_go_together_are_refused) {
  riis_surface *surface = NULL;
#define IS_REFUSED(name, value, text)                                                        \
  do {                                                                                       \
    riis_valve *valve = new_valve("coapting");                                               \
    CHECK_OK(riis_valve_set_scalar(valve, name, value));                                     \
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, text, riis_surface_create(valve, NULL, &surface)); \
    assert_null(surface);                                                                    \
  } while (0)
  IS_REFUSED("commissure_radius", 0.5, "commissure_radius is 0.5|from 0.5 to 2 times root_radius, which is 1.25");
  IS_REFUSED("commissure_height", 0.3, "commissure_height is 0.3|commissure_radius, which is 1.25");
  IS_REFUSED("effective_height", 1.74, "effective_height is 1.74|commissure_height, which is 1.75");
  IS_REFUSED("coaptation_height", 0.9, "coaptation_height is 0.9|effective_height, which is 0.906875");
  IS_REFUSED("gap", 0.001, "gap is 0.001|from 0.002 to 0.2 times commissure_radius, which is 1.25");
  riis_valve *valve = new_valve("coapting"), *trileaflet = new_valve("trileaflet");
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'bottom_angle' is 81|from 0 to 80",
                riis_valve_set_scalar(valve, "bottom_angle", 81));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'leaflet_height' is not a parameter of the coapting valve",
                riis_valve_set_scalar(valve, "leaflet_height", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the kind trileaflet, the valve of the kind coapting",
                riis_valve_set_open_state(valve, trileaflet));
  riis_valve *low = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(low, "commissure_height", 1.4));
  CHECK_OK(riis_valve_set_scalar(low, "effective_height", 0.45));
  CHECK_OK(riis_valve_set_scalar(low, "edge_rise", 0));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER,
                "a cusp would fold beside its attachment at opening|edge_rise is 0|effective_height 0.45",
                riis_surface_create(low, NULL, &surface));
  CHECK_OK(riis_valve_set_scalar(low, "effective_height", 0.15));
  CHECK_OK(riis_valve_set_scalar(low, "coaptation_height", 0.1));
  CHECK_OK(riis_valve_set_scalar(low, "commissure_height", 1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "may hang down to the height|commissure_height, effective_height",
                riis_surface_create(low, NULL, &surface));
  riis_valve *other = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(other, "effective_height", 1.5));
  CHECK_OK(riis_valve_set_scalar(other, "commissure_expansion", 0.3));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "half an open free edge is at least|half a closed one is|open_radius_ratio",
                riis_surface_create(other, NULL, &surface));
  CHECK_OK(riis_valve_set_open_state(valve, other));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "in the open state: half an open free edge",
                riis_surface_create(valve, NULL, &surface));
}

int main(void) { return run_cases(NULL, NULL); }
