// SPDX-License-Identifier: Apache-2.0
// Prints points of the patches of half the right cusp, for patches.geo:
//   validation_points KIND OPENING
// A row of points has a constant v. The valve has its default parameters.
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 8 };  // steps of u and of v in each patch

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "validation_points: %s\n", riis_last_error());
  exit(1);
}

// Returns, for each vertex, whether it belongs to the lower patch of the right cusp. The vertices of the bending curve, where v
// is 1, belong to both patches.
static char *vertices_below(const riis_triangles *all) {
  char *below = calloc((size_t)all->n_vertices, 1);
  if (!below) exit(1);
  for (int64_t t = 0; t < all->n_triangles; ++t)
    for (int k = 0; k < 3; ++k)
      if (all->patch_id[t] == 0) below[all->vertex_id[3 * t + k]] = 1;
  return below;
}

// Finds the point at (u, v) in the triangles of the patch, and writes it.
static void find(const riis_triangles *all, const char *below, int32_t patch, double u, double v, double *point) {
  double best = -1e300;
  for (int64_t t = 0; t < all->n_triangles; ++t) {
    if (all->patch_id[t] != patch) continue;
    const int64_t *id = all->vertex_id + 3 * t;
    double uv[3][2];
    for (int k = 0; k < 3; ++k) {
      uv[k][0] = all->uv[2 * id[k]];
      uv[k][1] = patch && below[id[k]] ? 0 : all->uv[2 * id[k] + 1];
    }
    const double area = (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
    if (area == 0) continue;
    const double b = ((u - uv[0][0]) * (uv[2][1] - uv[0][1]) - (v - uv[0][1]) * (uv[2][0] - uv[0][0])) / area;
    const double c = ((uv[1][0] - uv[0][0]) * (v - uv[0][1]) - (uv[1][1] - uv[0][1]) * (u - uv[0][0])) / area;
    const double least = fmin(fmin(b, c), 1 - b - c);
    if (least <= best) continue;
    best = least;
    for (int k = 0; k < 3; ++k)
      point[k] = (1 - b - c) * all->xyz[3 * id[0] + k] + b * all->xyz[3 * id[1] + k] + c * all->xyz[3 * id[2] + k];
  }
  if (best < -1e-9) {
    fprintf(stderr, "validation_points: patch %d has no triangle at (%g, %g)\n", (int)patch, u, v);
    exit(1);
  }
}

int main(int argc, char **argv) {
  if (argc != 3) {
    fputs("usage: validation_points KIND OPENING\n", stderr);
    return 2;
  }
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  riis_triangles all;
  check(riis_valve_create(argv[1], &valve));
  check(riis_valve_set_scalar(valve, "opening", atof(argv[2])));
  check(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 2e-3;
  check(riis_surface_create(valve, &options, &surface));
  check(riis_surface_get_triangles(surface, &all, sizeof all));
  char *below = vertices_below(&all);
  printf("n_u = %d; n_v = %d; n_patches = 2;\nxyz[] = {", n, n);
  for (int32_t patch = 0; patch < 2; ++patch)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        // The patches end in points at the root and at the end of the coaptation zone. The two end points are left out, because
        // they lie outside the tube.
        const double v = patch ? (double)i / n : 0.03 + 0.97 * i / n;
        double point[3];
        find(&all, below, patch, 0.97 * j / n, v, point);
        printf("%s%.9g, %.9g, %.9g", patch || i || j ? ",\n" : "", point[0], point[1], point[2]);
      }
  printf("};\n");
  free(below);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}
