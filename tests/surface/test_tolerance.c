/* SPDX-License-Identifier: Apache-2.0
 * tolerance * half thickness bounds the distance between the triangles and the smooth surface. The distance is measured with
 * independent evaluations of the smooth surface. The aortic valve is evaluated as Coons patches of its Bézier curves by exact arc
 * length. The mitral valve is evaluated by tests/support/mitral_oracle.h. */
#include "internals.h"
#include "test_support.h"

#include "handles.h"
#include "mitral_oracle.h"

static patch_set set;

/* A table of every curve's arc length: s[i] at t = i / table_size. */
enum { table_size = 4000 };
static double (*tables)[table_size + 1];

static void bernstein(const double *q, int degree, double t, double *point) {
  const double a = 1 - t;
  for (int c = 0; c < 3; ++c)
    point[c] = degree == 2
                   ? a * a * q[c] + 2 * a * t * q[3 + c] + t * t * q[6 + c]
                   : a * a * a * q[c] + 3 * a * a * t * q[3 + c] + 3 * a * t * t * q[6 + c] + t * t * t * q[9 + c];
}

static void tabulate(void) {
  tables = calloc((size_t)set.n_curves, sizeof *tables);
  for (int64_t i = 0; i < set.n_curves; ++i)
    for (int k = 1; k <= table_size; ++k) {
      double a[3], b[3];
      bernstein(set.control + 12 * i, set.degree[i], (k - 1.0) / table_size, a);
      bernstein(set.control + 12 * i, set.degree[i], (double)k / table_size, b);
      tables[i][k] = tables[i][k - 1] + hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
    }
}

/* Gives the point of curve i at a fraction of its length. */
static void at_share(int64_t i, double share, double *point) {
  const double *table = tables[i], target = share * table[table_size];
  int low = 0, high = table_size;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (table[middle] <= target)
      low = middle;
    else
      high = middle;
  }
  const double step = table[high] - table[low];
  bernstein(set.control + 12 * i, set.degree[i], (low + (step > 0 ? (target - table[low]) / step : 0)) / table_size,
            point);
}

static void aortic_point(int32_t patch_id, double u, double v, double *placed) {
  int64_t image = 0;
  while (set.patch_id[image] != patch_id) ++image;
  const int64_t *side = set.sides + 4 * set.patch[image];
  double c0[3], c1[3], d0[3], d1[3], point[3];
  at_share(side[0], u, c0);
  at_share(side[1], u, c1);
  at_share(side[2], v, d0);
  at_share(side[3], v, d1);
  const double *p00 = set.control + 12 * side[0], *p10 = p00 + 3 * set.degree[side[0]];
  const double *p01 = set.control + 12 * side[1], *p11 = p01 + 3 * set.degree[side[1]];
  for (int c = 0; c < 3; ++c)
    point[c] = (1 - v) * c0[c] + v * c1[c] + (1 - u) * d0[c] + u * d1[c] - (1 - u) * (1 - v) * p00[c] -
               u * (1 - v) * p10[c] - (1 - u) * v * p01[c] - u * v * p11[c];
  patch_image_place(&set, image, point, placed);
}

static mitral_oracle *mitral;

/* Gives a point of the smooth mitral valve. The table has the range of each patch on the annulus, from one u down to the next.
 * The patches outside the table are mirror images. */
static void mitral_point(int32_t patch_id, double u, double v, double *point) {
  double at[MITRAL_ORACLE_BREAKS];
  mitral_oracle_breaks(mitral, at);
  const double cleft = mitral_oracle_anterior_cleft(mitral);
  const double from[5] = {at[3], cleft, 0.5, at[2], at[1]}, to[5] = {at[2], at[3], cleft, at[1], 0};
  static const int part[10] = {0, 1, 2, 2, 1, 0, 3, 4, 4, 3};
  const int is_mirrored = (patch_id >= 3 && patch_id <= 5) || patch_id >= 8;
  const double of_half = from[part[patch_id]] + u * (to[part[patch_id]] - from[part[patch_id]]);
  mitral_oracle_point(mitral, is_mirrored ? 1 - of_half : of_half, v, point);
}

typedef struct smooth_valve {
  const char *name;
  int n_patches;
  void (*point)(int32_t patch_id, double u, double v, double *point);
} smooth_valve;
static const smooth_valve smooth_aortic = {"aortic", 12, aortic_point}, smooth_mitral = {"mitral", 10, mitral_point};

static double distance_between(const double *p, const double *q) {
  return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
}

/* Makes Gauss-Newton steps from a first guess of (u, v). Returns the least distance that occurs. */
static double distance_on_way(const smooth_valve *smooth, int32_t patch_id, double u, double v, const double *p) {
  double nearest = INFINITY;
  for (int step = 0; step < 4; ++step) {
    const double h = 1e-5, hu = u > 0.5 ? -h : h, hv = v > 0.5 ? -h : h;
    double s[3], su[3], sv[3], a = 0, b = 0, c = 0, e = 0, f = 0;
    smooth->point(patch_id, u, v, s);
    nearest = fmin(nearest, distance_between(s, p));
    smooth->point(patch_id, u + hu, v, su);
    smooth->point(patch_id, u, v + hv, sv);
    for (int i = 0; i < 3; ++i) {
      const double du = (su[i] - s[i]) / hu, dv = (sv[i] - s[i]) / hv, r = p[i] - s[i];
      a += du * du, b += du * dv, c += dv * dv, e += du * r, f += dv * r;
    }
    const double determinant = a * c - b * b;
    if (!(determinant > 1e-9 * a * c)) break;
    u = fmin(fmax(u + (c * e - b * f) / determinant, 0), 1);
    v = fmin(fmax(v + (a * f - b * e) / determinant, 0), 1);
  }
  return nearest;
}

/* Returns the distance of p from the patch, never below the truth. The steps can end in a wrong minimum, or leave the patch where
 * it folds. If a distance is too large, the search is repeated from start points all over the patch. */
static double distance_to_smooth(const smooth_valve *smooth, int32_t patch_id, const double *guess, const double *p,
                                 double enough) {
  double nearest = distance_on_way(smooth, patch_id, guess[0], guess[1], p);
  for (int i = 0; i <= 40 && nearest > enough; ++i)
    for (int j = 0; j <= 40; ++j) nearest = fmin(nearest, distance_on_way(smooth, patch_id, i / 40.0, j / 40.0, p));
  return nearest;
}

typedef struct {
  double to_triangles, to_smooth; /* distances as fractions of the bound */
  int64_t n_triangles;
} deviation;

static deviation measure_surface(const smooth_valve *smooth, const riis_surface *surface, double bound,
                                 random_source *rng) {
  deviation d = {0, 0, info_of(surface).n_triangles};
  /* Every smooth point is near a triangle. */
  for (int32_t patch = 0; patch < smooth->n_patches; ++patch)
    for (int k = 0; k < 400; ++k) {
      double p[3];
      smooth->point(patch, random_between(rng, 0, 1), random_between(rng, 0, 1), p);
      d.to_triangles = fmax(d.to_triangles, closest_to(surface, p[0], p[1], p[2]).distance / bound);
    }
  /* The middle and the edges of every triangle are near the smooth surface. */
  const double *xyz = triangles_of(surface).xyz;
  const double *uv = triangles_of(surface).uv;
  const int64_t *id = triangles_of(surface).vertex_id;
  const int32_t *patch_id = triangles_of(surface).patch_id;
  const int64_t every = 1 + d.n_triangles / 8000;
  for (int64_t t = 0; t < d.n_triangles; t += every) {
    static const double weights[4][3] = {{1.0 / 3, 1.0 / 3, 1.0 / 3}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}};
    for (int w = 0; w < 4; ++w) {
      double p[3] = {0, 0, 0}, at[2] = {0, 0}, s[3];
      for (int k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) p[c] += weights[w][k] * xyz[3 * id[3 * t + k] + c];
        for (int c = 0; c < 2; ++c) at[c] += weights[w][k] * uv[2 * id[3 * t + k] + c];
      }
      smooth->point(patch_id[t], at[0], at[1], s);
      if (distance_between(s, p) > d.to_smooth * bound)
        d.to_smooth = fmax(d.to_smooth, distance_to_smooth(smooth, patch_id[t], at, p, bound) / bound);
    }
  }
  CHECK_AT_MOST(info_of(surface).error_bound, bound);
  return d;
}

static deviation measure(const smooth_valve *smooth, const riis_valve *valve, double tolerance, random_source *rng) {
  riis_surface_options options = surface_options();
  options.tolerance = tolerance;
  riis_surface *surface = new_surface(valve, &options);
  const deviation d = measure_surface(smooth, surface, tolerance * 0.1, rng);
  free_one_owned(surface);
  return d;
}

static void check_at_four_tolerances(const smooth_valve *smooth, const riis_valve *valve, const char *state,
                                     random_source *rng) {
  const double tolerances[4] = {0.10, 0.05, 0.02, 0.005};
  for (int i = 0; i < 4; ++i) {
    const deviation d = measure(smooth, valve, tolerances[i], rng);
    printf("%s%s, tolerance %5.3f: %6lld triangles; smooth to triangles %.2f, triangles to smooth %.2f of the bound\n",
           smooth->name, state, tolerances[i], (long long)d.n_triangles, d.to_triangles, d.to_smooth);
    CHECK_AT_MOST(d.to_triangles, 1);
    CHECK_AT_MOST(d.to_smooth, 1);
  }
}

TEST(aortic_deviation_stays_within_the_bound) {
  random_source rng = random_start("test_tolerance");
  riis_valve *valve = new_valve("aortic");
  CHECK_OK(aortic_patches(NULL, 0, &set));
  tabulate();
  check_at_four_tolerances(&smooth_aortic, valve, "", &rng);
  free(tables);
  patch_set_free(&set);
}

TEST(mitral_deviation_stays_within_the_bound) {
  random_source rng = random_start("test_tolerance");
  mitral_parameters parameters = mitral_defaults();
  riis_valve *valve = new_valve("mitral");
  for (int i = 0; i <= 2; ++i) {
    char opening[32];
    parameters.opening = 0.5 * i;
    snprintf(opening, sizeof opening, " opening %.2f", parameters.opening);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", parameters.opening));
    mitral = mitral_oracle_create(&parameters, &parameters);
    check_at_four_tolerances(&smooth_mitral, valve, opening, &rng);
    mitral_oracle_destroy(mitral);
  }
}

/* Compares each quad with the smooth patch at equal (u, v), all over the quad. Each quad is within its bound, and some quad
 * nearly reaches its bound. Returns the largest error as a fraction of the bound. */
static double largest_share_of_bound(const smooth_valve *smooth, int n_parameters, const char *const *names,
                                     const double *values, double max_error) {
  int64_t n;
  bounded_quad *quads;
  double largest = 0;
  CHECK_OK(bounded_quads(smooth->name, n_parameters, names, values, max_error, &n, &quads));
  for (int64_t q = 0; q < n; ++q) {
    const bounded_quad *quad = quads + q;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j) {
        const double s = 0.25 * i, t = 0.25 * j;
        double exact[3], bilinear[3];
        smooth->point(quad->patch_id, quad->u[0] + s * (quad->u[1] - quad->u[0]),
                      quad->v[0] + t * (quad->v[1] - quad->v[0]), exact);
        for (int c = 0; c < 3; ++c)
          bilinear[c] = (1 - t) * ((1 - s) * quad->corners[0][c] + s * quad->corners[1][c]) +
                        t * ((1 - s) * quad->corners[3][c] + s * quad->corners[2][c]);
        const double off = distance_between(exact, bilinear);
        /* The reference for the aortic valve is accurate to 1e-7. */
        if (!(off <= quad->error + 1e-6))
          fail_msg("patch %d, u %.5f to %.5f, v %.5f to %.5f: off by %.3g, the bound is %.3g", (int)quad->patch_id,
                   quad->u[0], quad->u[1], quad->v[0], quad->v[1], off, quad->error);
        if (quad->error > 1e-4) largest = fmax(largest, off / quad->error);
      }
  }
  free(quads);
  return largest;
}

TEST(every_quad_stays_within_its_own_bound) {
  random_source rng = random_start("test_tolerance");
  const char *names[17];
  double of_mitral = 1, of_aortic;
  riis_valve *valve = new_valve("mitral");
  for (int i = 0; i < 17; ++i) {
    riis_parameter parameter;
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    names[i] = parameter.name;
  }
  for (int trial = 0; trial < trials_of(72); ++trial) {
    mitral_parameters parameters = mitral_defaults();
    double *values = &parameters.anterior_ratio;
    for (int i = 0; i < 16 && trial >= 3; ++i) values[i] *= random_between(&rng, 0.8, 1.2);
    parameters.opening = trial < 3 ? 0.5 * trial : random_between(&rng, 0, 1);
    mitral = mitral_oracle_create(&parameters, &parameters);
    const double share =
        largest_share_of_bound(&smooth_mitral, 17, names, values, pow(10, random_between(&rng, -3, -0.5)));
    of_mitral = fmin(of_mitral, share);
    mitral_oracle_destroy(mitral);
  }
  free_one_owned(valve);
  CHECK_OK(aortic_patches(NULL, 0, &set));
  tabulate();
  of_aortic = largest_share_of_bound(&smooth_aortic, 0, NULL, NULL, 0.005);
  free(tables);
  patch_set_free(&set);
  printf("quads: at most %.2f of the bound (aortic), at least in some place %.2f (mitral)\n", of_aortic, of_mitral);
  assert_true(of_aortic > 0.5 && of_mitral > 0.5);
}

/* Tests valves of many shapes. Each parameter with a single number changes alone by a third, up or down. */
TEST(so_it_does_for_other_aortic_valves) {
  random_source rng = random_start("test_tolerance");
  double worst = 0;
  int n_tried = 0;
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    riis_parameter parameter;
    int64_t n_parameters;
    riis_valve *valve = new_valve("aortic");
    CHECK_OK(riis_valve_get_n_parameters(valve, &n_parameters));
    CHECK_OK(riis_valve_get_parameter(valve, (int64_t)(random_bits(&rng) % (uint64_t)n_parameters), &parameter,
                                      sizeof parameter));
    const double value = parameter.default_values[0] * random_between(&rng, 0.67, 1.33);
    if (parameter.n_values == 1 && riis_valve_set_scalar(valve, parameter.name, value) == RIIS_OK &&
        aortic_patches(parameter.name, value, &set) == RIIS_OK) {
      tabulate();
      const double tolerance = pow(10, random_between(&rng, -2, 0));
      const deviation d = measure(&smooth_aortic, valve, tolerance, &rng);
      free(tables);
      patch_set_free(&set);
      if (d.to_triangles > 1 || d.to_smooth > 1)
        fail_msg("%s = %.17g at tolerance %.17g: %.3f and %.3f of the bound", parameter.name, value, tolerance,
                 d.to_triangles, d.to_smooth);
      worst = fmax(worst, fmax(d.to_triangles, d.to_smooth));
      ++n_tried;
    }
    free_owned_after(owned_before);
  }
  printf("%d aortic valves: at most %.2f of the bound\n", n_tried, worst);
  CHECK_MET(n_tried > trials_of(20));
}

/* Makes a valve between two states. In each state, all parameters change by up to a quarter. */
static riis_valve *random_mitral(mitral_parameters *parameters, random_source *rng) {
  riis_valve *valves[2];
  for (int k = 0; k < 2; ++k) {
    parameters[k] = mitral_defaults();
    valves[k] = new_valve("mitral");
    double *values = &parameters[k].anterior_ratio; /* all fields are doubles, in the table's order */
    for (int i = 0; i < 16; ++i) {
      riis_parameter parameter;
      CHECK_OK(riis_valve_get_parameter(valves[k], i, &parameter, sizeof parameter));
      CHECK_SAME(parameter.default_values[0], values[i]);
      values[i] *= random_between(rng, 0.75, 1.25);
      CHECK_OK(riis_valve_set_scalar(valves[k], parameter.name, values[i]));
    }
  }
  CHECK_OK(riis_valve_set_open_state(valves[0], valves[1]));
  return valves[0];
}

TEST(so_it_does_for_other_mitral_valves) {
  random_source rng = random_start("test_tolerance");
  double worst = 0;
  int n_tried = 0;
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    mitral_parameters parameters[2];
    riis_valve *valve = random_mitral(parameters, &rng);
    parameters[0].opening = random_between(&rng, 0, 1);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", parameters[0].opening));
    const double tolerance = pow(10, random_between(&rng, -2, 0));
    riis_surface *surface = NULL;
    const riis_status status = riis_surface_create(valve, NULL, &surface);
    riis_surface_destroy(&surface);
    if (status == RIIS_OK) {
      mitral = mitral_oracle_create(&parameters[0], &parameters[1]);
      const deviation d = measure(&smooth_mitral, valve, tolerance, &rng);
      mitral_oracle_destroy(mitral);
      if (d.to_triangles > 1 || d.to_smooth > 1)
        fail_msg("trial %d, opening %.17g, tolerance %.17g: %.3f and %.3f of the bound", trial, parameters[0].opening,
                 tolerance, d.to_triangles, d.to_smooth);
      worst = fmax(worst, fmax(d.to_triangles, d.to_smooth));
      ++n_tried;
    } else {
      assert_int_equal(status, RIIS_INVALID_PARAMETER); /* random values may be invalid together */
    }
    free_owned_after(owned_before);
  }
  printf("%d mitral valves: at most %.2f of the bound\n", n_tried, worst);
  CHECK_MET(n_tried > trials_of(30));
}

/* A fixed triangulation is tested at openings that played no part in its choice. */
TEST(so_does_a_fixed_triangulation) {
  random_source rng = random_start("test_tolerance");
  riis_surface_options options = surface_options();
  double worst = 0;
  int n_tried = 0, n_refused = 0;
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    mitral_parameters parameters[2];
    riis_valve *valve = random_mitral(parameters, &rng);
    options.tolerance = pow(10, random_between(&rng, -2, 0));
    riis_surface *surface = NULL;
    const riis_status status = riis_surface_create(valve, &options, &surface);
    if (status != RIIS_OK) {
      assert_int_equal(status, RIIS_INVALID_PARAMETER); /* random values may be invalid together at some opening */
      free_owned_after(owned_before);
      continue;
    }
    own(surface);
    for (int i = 0; i < 4; ++i) {
      parameters[0].opening = i == 0 ? 0 : random_between(&rng, 0, 1);
      CHECK_OK(riis_valve_set_scalar(valve, "opening", parameters[0].opening));
      if (riis_surface_update(surface, valve, NULL) != RIIS_OK) {
        CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "fixed triangulation", riis_surface_update(surface, valve, NULL));
        ++n_refused;
        continue;
      }
      mitral = mitral_oracle_create(&parameters[0], &parameters[1]);
      const deviation d = measure_surface(&smooth_mitral, surface, options.tolerance * 0.1, &rng);
      mitral_oracle_destroy(mitral);
      if (d.to_triangles > 1 || d.to_smooth > 1)
        fail_msg("trial %d, opening %.17g, tolerance %.17g: %.3f and %.3f of the bound", trial, parameters[0].opening,
                 options.tolerance, d.to_triangles, d.to_smooth);
      worst = fmax(worst, fmax(d.to_triangles, d.to_smooth));
      ++n_tried;
    }
    free_owned_after(owned_before);
  }
  printf("%d states of fixed triangulations: at most %.2f of the bound; %d refused\n", n_tried, worst, n_refused);
  CHECK_MET(n_tried > trials_of(60));
  assert_true(n_refused <= 4);
}

/* If curves deviate from their shape, the triangles may use the rest of the tolerance. The bound includes both errors. */
TEST(a_deviation_of_curves_is_part_of_the_bound) {
  static const char *const kinds[3] = {"aortic", "mitral", "bileaflet"};
  const double off = 0x1p-10;
  for (int k = 0; k < 3; ++k)
    for (int is_fixed = 0; is_fixed < 2; ++is_fixed) {
      deviating exact, made;
      CHECK_OK(triangulate_deviating(kinds[k], 0, 3 * off, is_fixed, &exact));
      CHECK_OK(triangulate_deviating(kinds[k], off, 4 * off, is_fixed, &made));
      assert_int_equal(made.n_triangles, exact.n_triangles);
      CHECK_NEAR(made.bound, exact.bound + off, 1e-15);
      CHECK_NEAR(made.bound_of_patches, exact.bound_of_patches + off, 1e-15);
      assert_true(made.is_within && exact.is_within);
      CHECK_OK(triangulate_deviating(kinds[k], off, 2 * off, is_fixed, &made));
      CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "the valve's curves are accurate to 0.0009765|more than half of tolerance",
                    triangulate_deviating(kinds[k], off, 1.99 * off, is_fixed, &made));
    }
}

int main(void) { return run_cases(NULL, NULL); }
