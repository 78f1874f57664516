/* SPDX-License-Identifier: Apache-2.0
 * tolerance * half thickness bounds the distance between the triangles and the smooth surface, measured on an
 * independent dense evaluation of the smooth one: Coons patches of the Bézier curves by exact arc length. */
#include "internals.h"
#include "test_support.h"

#include "handles.h"

static patch_set set;

/* Arc length of every curve tabulated: s[i] at t = i / table_size. */
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

/* The point of curve i at a share of its length. */
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

static void smooth_point(int64_t image, double u, double v, double *placed) {
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

typedef struct {
  double to_triangles, to_smooth; /* over the bound */
  int64_t n_triangles;
} deviation;

static deviation measure(const riis_valve *valve, double tolerance, random_source *rng) {
  riis_surface_options options = surface_options();
  options.tolerance = tolerance;
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create(valve, &options, &surface));
  deviation d = {0, 0, info_of(surface).n_triangles};
  const double bound = tolerance * 0.1;
  /* Every smooth point is near a triangle ... */
  for (int64_t image = 0; image < set.n_images; ++image)
    for (int k = 0; k < 400; ++k) {
      double p[3];
      smooth_point(image, random_between(rng, 0, 1), random_between(rng, 0, 1), p);
      d.to_triangles = fmax(d.to_triangles, closest_to(surface, p[0], p[1], p[2]).distance / bound);
    }
  /* ... and every triangle's middle is near the smooth surface: at most as far as the smooth point of its own (u,v). */
  const double *xyz, *uv;
  const int64_t *id;
  const int32_t *patch_id;
  CHECK_OK(riis_surface_vertices(surface, NULL, &xyz));
  CHECK_OK(riis_surface_vertex_parameters(surface, NULL, &uv));
  CHECK_OK(riis_surface_triangles(surface, NULL, &id, NULL, NULL, &patch_id));
  for (int64_t t = 0; t < d.n_triangles; ++t) {
    double middle[3] = {0, 0, 0}, at[2] = {0, 0}, p[3];
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) middle[c] += xyz[3 * id[3 * t + k] + c] / 3;
      for (int c = 0; c < 2; ++c) at[c] += uv[2 * id[3 * t + k] + c] / 3;
    }
    int64_t image = 0;
    while (set.patch_id[image] != patch_id[t]) ++image;
    smooth_point(image, at[0], at[1], p);
    d.to_smooth = fmax(d.to_smooth, hypot(hypot(p[0] - middle[0], p[1] - middle[1]), p[2] - middle[2]) / bound);
  }
  riis_surface_destroy(&surface);
  return d;
}

static void deviation_stays_within_the_bound(void **state) {
  (void)state;
  random_source rng = random_start("test_tolerance");
  const double tolerances[4] = {0.10, 0.05, 0.02, 0.005};
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create("aortic", &valve));
  CHECK_OK(aortic_patches(NULL, 0, &set));
  tabulate();
  for (int i = 0; i < 4; ++i) {
    const deviation d = measure(valve, tolerances[i], &rng);
    printf("tolerance %5.3f: %6lld triangles; smooth to triangles %.2f, triangles to smooth %.2f of the bound\n",
           tolerances[i], (long long)d.n_triangles, d.to_triangles, d.to_smooth);
    CHECK_AT_MOST(d.to_triangles, 1);
    CHECK_AT_MOST(d.to_smooth, 1);
  }
  free(tables);
  patch_set_free(&set);
  riis_valve_destroy(&valve);
}

/* One parameter at a time, a third up or down, of all that have one value: valves of many shapes. */
static void so_it_does_for_other_valves(void **state) {
  (void)state;
  random_source rng = random_start("test_tolerance");
  double worst = 0;
  int n_tried = 0;
  for (int trial = 0; trial < 60; ++trial) {
    riis_valve *valve = NULL;
    riis_parameter parameter;
    int64_t n_parameters;
    CHECK_OK(riis_valve_create("aortic", &valve));
    CHECK_OK(riis_valve_n_parameters(valve, &n_parameters));
    CHECK_OK(riis_valve_parameter(valve, (int64_t)(random_bits(&rng) % (uint64_t)n_parameters), &parameter,
                                  sizeof parameter));
    const double value = parameter.default_values[0] * random_between(&rng, 0.67, 1.33);
    if (parameter.n_values == 1 && riis_valve_set_scalar(valve, parameter.name, value) == RIIS_OK &&
        aortic_patches(parameter.name, value, &set) == RIIS_OK) {
      tabulate();
      const double tolerance = pow(10, random_between(&rng, -2, 0));
      const deviation d = measure(valve, tolerance, &rng);
      free(tables);
      patch_set_free(&set);
      if (d.to_triangles > 1 || d.to_smooth > 1)
        fail_msg("%s = %.17g at tolerance %.17g: %.3f and %.3f of the bound", parameter.name, value, tolerance,
                 d.to_triangles, d.to_smooth);
      worst = fmax(worst, fmax(d.to_triangles, d.to_smooth));
      ++n_tried;
    }
    riis_valve_destroy(&valve);
  }
  printf("%d valves: at most %.2f of the bound\n", n_tried, worst);
  assert_true(n_tried > 20);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(deviation_stays_within_the_bound),
      cmocka_unit_test(so_it_does_for_other_valves),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
