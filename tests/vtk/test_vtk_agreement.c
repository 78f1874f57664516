/* SPDX-License-Identifier: Apache-2.0
 *
 * Compares closest distances of random points with the results of VTK's searches on the same triangles. VTK's searches are a
 * separate implementation in double precision. RIIS_TEST_SEED repeats a run. */
#include <math.h>
#include <riis/riis.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "calls.h"
#include "expect.h"
#include "vtk_shim.h"

enum { n_points = 4000 };

static uint64_t random_state;

static double random_unit(void) {
  random_state = random_state * 6364136223846793005u + 1442695040888963407u;
  return (double)(random_state >> 11) / 9007199254740992.0;
}

static riis_surface *make_surface(double scale, double shift) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.scale = scale;
  options.rotation_axis[0] = 1;
  options.rotation_angle = 33;
  options.translation[1] = shift;
  expect_fine(riis_surface_create(valve, &options, &surface));
  riis_valve_destroy(&valve);
  return surface;
}

/* Puts half of the points into the box around the surface, and half into a box ten times as large. */
static void scatter(const riis_surface *surface, double *points) {
  riis_surface_info info;
  expect_fine(riis_surface_get_info(surface, &info, sizeof info));
  for (int i = 0; i < n_points; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double middle = 0.5 * (info.lower[k] + info.upper[k]);
      const double reach = (i % 2 ? 10 : 1) * 0.5 * (info.upper[k] - info.lower[k]);
      points[3 * i + k] = middle + reach * (2 * random_unit() - 1);
    }
  }
}

static void compare(double scale, double shift, int method, const char *name) {
  static double points[3 * n_points], distances[n_points], by_vtk[n_points];
  riis_surface *surface = make_surface(scale, shift);
  scatter(surface, points);
  riis_closest_arrays arrays;
  expect_fine(riis_closest_arrays_init(&arrays, sizeof arrays));
  arrays.distance = distances;
  expect_fine(closest_points_of(surface, n_points, points, points + 1, points + 2, 3, NULL, &arrays));
  const int64_t n_vertices = triangles_of(surface).n_vertices;
  const double *vertices = triangles_of(surface).xyz;
  const int64_t n_triangles = triangles_of(surface).n_triangles;
  const int64_t *corners = triangles_of(surface).vertex_id;
  shim_distances(method, n_vertices, vertices, n_triangles, corners, n_points, points, by_vtk);
  /* The tolerance is relative to the size of the coordinates, because this size limits the resolution of doubles. */
  const double size = fabs(shift) + 20 * scale;
  double worst = 0;
  for (int i = 0; i < n_points; ++i) {
    const double difference = fabs(distances[i] - by_vtk[i]) / size;
    if (!(difference <= 1e-10)) {
      fail_msg("%s, point %d (%.17g %.17g %.17g): %.17g, VTK %.17g", name, i, points[3 * i], points[3 * i + 1],
               points[3 * i + 2], distances[i], by_vtk[i]);
    }
    if (difference > worst) worst = difference;
  }
  print_message("%s, scale %g, shift %g: %d distances differ by at most %.1e of the coordinates\n", name, scale, shift,
                n_points, worst);
  riis_surface_destroy(&surface);
}

TEST(test_static_locator) {
  compare(1, 0, SHIM_STATIC_LOCATOR, "vtkStaticCellLocator");
  compare(0.01, 0.3, SHIM_STATIC_LOCATOR, "vtkStaticCellLocator");
}

TEST(test_cell_locator) {
  compare(1, 0, SHIM_CELL_LOCATOR, "vtkCellLocator");
  compare(10, -50, SHIM_CELL_LOCATOR, "vtkCellLocator");
}

TEST(test_implicit_distance) { compare(1, 0, SHIM_IMPLICIT_DISTANCE, "vtkImplicitPolyDataDistance"); }

int main(void) {
  const char *seed = getenv("RIIS_TEST_SEED");
  random_state = seed ? strtoull(seed, NULL, 10) : 20260721;
  print_message("RIIS_TEST_SEED=%llu\n", (unsigned long long)random_state);
  return run_cases(NULL, NULL);
}
