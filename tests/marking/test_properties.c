/* SPDX-License-Identifier: Apache-2.0
 * Results must not depend on the position, rotation or unit of the valve and the mesh, or on the order of nodes and triangles. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

static random_source rng;

enum { n = 8000 };
static double nodes[3 * n];

/* Computes the distances of all nodes to the surface, up to a limit. Nodes beyond the limit get 1e30. */
static void distances(const riis_surface *surface, const double *xyz, double limit, double *distance,
                      int32_t *leaflet_id) {
  const int owned_before = n_owned();
  riis_mark_options options = mark_options();
  options.distance_limit = limit;
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  CHECK_OK(dense_of(result, n, 1e30, NULL, distance, NULL, leaflet_id));
  free_owned_after(owned_before);
}

/* Checks that the distances b equal the distances a times the scale. A node near the limit may be within it in one result and
 * beyond it in the other. */
static void check_scaled(const double *a, const double *b, double scale, double limit, double tolerance) {
  int n_near = 0;
  for (int i = 0; i < n; ++i) {
    const int in_a = a[i] < 1e30, in_b = b[i] < 1e30;
    if (in_a != in_b) {
      CHECK_NEAR(in_a ? a[i] : b[i] / scale, limit, tolerance / scale);
    } else if (in_a) {
      CHECK_NEAR(a[i] * scale, b[i], tolerance);
      ++n_near;
    }
  }
  assert_true(n_near > n / 10);
}

static void make_nodes(void) {
  for (int i = 0; i < n; ++i) {
    nodes[3 * i] = random_between(&rng, -1.6, 1.6);
    nodes[3 * i + 1] = random_between(&rng, -1.6, 1.6);
    nodes[3 * i + 2] = random_between(&rng, -1.2, 0.3);
  }
}

TEST(rigid_motion_and_unit_do_not_matter) {
  static double plain[n], moved[n], moved_nodes[3 * n];
  static int32_t leaflet[n], moved_leaflet[n];
  riis_surface *surface = aortic_surface(NULL);
  distances(surface, nodes, 0.3, plain, leaflet);
  free_one_owned(surface);
  for (int trial = 0; trial < 12; ++trial) {
    riis_surface_options options = surface_options();
    options.scale = trial % 3 == 0 ? 1 : pow(10, random_between(&rng, -6, 6));
    options.rotation_angle = random_between(&rng, -400, 400);
    double axis[3], sum = 0;
    for (int c = 0; c < 3; ++c) {
      options.rotation_axis[c] = axis[c] = random_between(&rng, -1, 1);
      options.translation[c] = options.scale * random_between(&rng, -300, 300);
      sum += axis[c] * axis[c];
    }
    const double angle = options.rotation_angle * 3.14159265358979323846 / 180, s = sin(angle), k = cos(angle);
    for (int c = 0; c < 3; ++c) axis[c] /= sqrt(sum);
    for (int i = 0; i < n; ++i) { /* Rodrigues' formula: v cos + (axis x v) sin + axis (axis . v) (1 - cos) */
      const double *v = nodes + 3 * i, along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        moved_nodes[3 * i + c] =
            options.scale * (v[c] * k + (axis[d] * v[e] - axis[e] * v[d]) * s + axis[c] * along * (1 - k)) +
            options.translation[c];
      }
    }
    surface = aortic_surface(&options);
    distances(surface, moved_nodes, 0.3 * options.scale, moved, moved_leaflet);
    CHECK_NEAR(info_of(surface).area / (options.scale * options.scale), 6.98, 0.01);
    free_one_owned(surface);
    /* The coordinates are about 300, so their rounding error is 300 times as large. */
    check_scaled(plain, moved, options.scale, 0.3, 1e-12 * options.scale);
    int n_other_leaflet = 0; /* nodes where two leaflets are equally near */
    for (int i = 0; i < n; ++i) n_other_leaflet += leaflet[i] != moved_leaflet[i];
    assert_true(n_other_leaflet <= 2);
  }
}

TEST(order_of_nodes_does_not_matter) {
  static double plain[n], shuffled[n], shuffled_nodes[3 * n];
  static int order[n];
  riis_surface *surface = aortic_surface(NULL);
  distances(surface, nodes, 0.3, plain, NULL);
  for (int i = 0; i < n; ++i) order[i] = i;
  for (int i = n - 1; i > 0; --i) {
    const int j = (int)(random_bits(&rng) % (uint64_t)(i + 1)), swap = order[i];
    order[i] = order[j], order[j] = swap;
  }
  for (int i = 0; i < n; ++i) memcpy(shuffled_nodes + 3 * i, nodes + 3 * order[i], 3 * sizeof *nodes);
  distances(surface, shuffled_nodes, 0.3, shuffled, NULL);
  for (int i = 0; i < n; ++i) CHECK_SAME(shuffled[i], plain[order[i]]);
}

TEST(order_of_triangles_does_not_matter) {
  static double plain[n], shuffled[n];
  double *xyz;
  int32_t *ids;
  const int64_t n_triangles = 700;
  random_soup(&rng, n_triangles, 0.1, &xyz, &ids);
  riis_surface_arrays arrays = triangle_arrays(3 * n_triangles, xyz, n_triangles, ids);
  riis_surface *surface = surface_from(&arrays, NULL);
  distances(surface, nodes, 0.3, plain, NULL);
  for (int64_t i = n_triangles - 1; i > 0; --i) {
    const int64_t j = (int64_t)(random_bits(&rng) % (uint64_t)(i + 1));
    int32_t swap[3];
    memcpy(swap, ids + 3 * i, sizeof swap);
    memcpy(ids + 3 * i, ids + 3 * j, sizeof swap);
    memcpy(ids + 3 * j, swap, sizeof swap);
  }
  CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, NULL));
  distances(surface, nodes, 0.3, shuffled, NULL);
  for (int i = 0; i < n; ++i) CHECK_SAME(shuffled[i], plain[i]);
}

/* Each cusp of the valve equals its mirror image, so the distances are also symmetric. */
TEST(cusps_are_symmetric) {
  static double plain[n], mirrored[n], mirrored_nodes[3 * n];
  riis_surface *surface = aortic_surface(NULL);
  const double angle[3] = {0, 119.5, -121.5};
  for (int cusp = 0; cusp < 3; ++cusp) {
    const double a = angle[cusp] * 3.14159265358979323846 / 180, c2 = cos(2 * a), s2 = sin(2 * a);
    for (int i = 0; i < n; ++i) {
      const double x = nodes[3 * i], y = nodes[3 * i + 1];
      mirrored_nodes[3 * i] = c2 * x + s2 * y;
      mirrored_nodes[3 * i + 1] = s2 * x - c2 * y;
      mirrored_nodes[3 * i + 2] = nodes[3 * i + 2];
    }
    static int32_t leaflet[n], mirrored_leaflet[n];
    distances(surface, nodes, 0.3, plain, leaflet);
    distances(surface, mirrored_nodes, 0.3, mirrored, mirrored_leaflet);
    int n_compared = 0;
    for (int i = 0; i < n; ++i)
      if (leaflet[i] == cusp && mirrored_leaflet[i] == cusp) {
        CHECK_NEAR(plain[i], mirrored[i], 1e-13);
        ++n_compared;
      }
    assert_true(n_compared > 500);
  }
}

int main(void) {
  rng = random_start("test_properties");
  make_nodes();
  return run_cases(NULL, NULL);
}
