/* SPDX-License-Identifier: Apache-2.0
 *
 * In pictures, the outside of a mesh has the faces that VTK's filter finds. All faces point outwards. The flat ends of a wall are
 * the ends with which the test made it. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "expect.h"
#include "scratch.h"
#include "test_support.h"
#include "vtk_shim.h"

TEST(test_box) {
  const double lower[3] = {-1, 0, 2}, upper[3] = {1, 3, 7};
  int64_t n_faces = 0, n_inwards = 0;
  for (int n = 2; n < 9; n += 3) {
    assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, n, lower, upper, 0), 1);
    assert_int_equal(shim_compare_outside(scratch_path("box.vtu"), &n_faces, &n_inwards), 0);
    assert_int_equal(n_faces, 12 * (n - 1) * (n - 1));
    assert_int_equal(n_inwards, 0);
  }
}

/* The meshes have cells of all linear types, cells of higher order, polyhedra, and tetrahedra that share most of their faces. */
TEST(test_types) {
  int64_t n_faces = 0, n_inwards = 0;
  assert_int_equal(shim_write_zoo(scratch_path("zoo.vtu")), 1);
  assert_int_equal(shim_compare_outside(scratch_path("zoo.vtu"), &n_faces, &n_inwards), 0);
  assert_true(n_faces > 100);
  double points[3 * 60];
  unsigned seed = 3;
  for (int i = 0; i < 180; ++i) {
    seed = seed * 1664525u + 1013904223u;
    points[i] = (double)(seed >> 8) / (1 << 24);
  }
  assert_int_equal(shim_write_delaunay(scratch_path("hull.vtu"), 60, points), 1);
  assert_int_equal(shim_compare_outside(scratch_path("hull.vtu"), &n_faces, &n_inwards), 0);
  assert_true(n_faces > 10);
  assert_int_equal(n_inwards, 0);
}

/* A tube of rings of vertices, with a cap of triangles at each end. */
enum { n_around = 40, n_rings = 30, n_tube = n_around * n_rings + 2, n_sides = 2 * n_around * (n_rings - 1) };
enum { n_tube_triangles = n_sides + 2 * n_around };

/* Makes a tube of any size, place and direction. `noise` moves the vertices between the ends, and the rims in the planes of the
 * ends, as a share of the radius. The second end's plane has a separate angle. If `open` is not 0, the second end has no cap.
 * Returns the number of triangles. */
static int64_t make_tube(random_source *random, double noise, int open, double *xyz, int64_t *corners) {
  const double size = random_power_of_ten(random, -3, 3), tilt = random_between(random, 0, 0.6);
  double frame[3][3], shift[3];
  for (int k = 0; k < 3; ++k) {
    shift[k] = size * random_between(random, -50, 50);
    frame[2][k] = random_between(random, -1, 1);
    frame[0][k] = random_between(random, -1, 1);
  }
  for (int i = 2; i >= 0; i -= 2) {
    double along = 0, length = 0;
    for (int k = 0; k < 3; ++k) along += i == 0 ? frame[0][k] * frame[2][k] : 0;
    for (int k = 0; k < 3; ++k) frame[i][k] -= along * (i == 0 ? frame[2][k] : 0);
    for (int k = 0; k < 3; ++k) length += frame[i][k] * frame[i][k];
    for (int k = 0; k < 3; ++k) frame[i][k] /= sqrt(length);
  }
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    frame[1][k] = frame[2][a] * frame[0][b] - frame[2][b] * frame[0][a];
  }
  for (int i = 0; i < n_tube; ++i) {
    const int ring = i / n_around, is_middle = ring == n_rings, is_last = ring == n_rings - 1 || i == n_tube - 1;
    const double angle = 2 * acos(-1.0) * i / n_around;
    const double radius = is_middle ? 0 : 1 + noise * random_between(random, -1, 1);
    double p[3] = {radius * cos(angle), radius * sin(angle), is_last ? 4 : is_middle ? 0 : 4.0 * ring / (n_rings - 1)};
    p[2] *= 1 + 0.25 * tilt * p[0]; /* the rings lean more and more, so that the wall does not cross itself */
    if (ring > 0 && !is_middle && !is_last) p[2] += 0.5 * noise * random_between(random, -1, 1);
    for (int k = 0; k < 3; ++k)
      xyz[3 * i + k] = shift[k] + size * (p[0] * frame[0][k] + p[1] * frame[1][k] + p[2] * frame[2][k]);
  }
  int64_t n = 0;
  for (int i = 0; i < n_around * (n_rings - 1); ++i) {
    const int next = i % n_around == n_around - 1 ? i + 1 - n_around : i + 1;
    const int64_t two[6] = {i, next, next + n_around, i, next + n_around, i + n_around};
    for (int k = 0; k < 6; ++k) corners[3 * n + k] = two[k];
    n += 2;
  }
  for (int end = 0; end < 2 - open; ++end)
    for (int i = 0; i < n_around; ++i, ++n) {
      const int ring = end * (n_rings - 1) * n_around;
      corners[3 * n] = n_tube - 2 + end;
      corners[3 * n + 1] = ring + i;
      corners[3 * n + 2] = ring + (i + 1) % n_around;
    }
  return n;
}

/* The library finds the ends of tubes of any size and direction. Some tubes have noise, oblique ends or one open end. */
TEST(test_ends_of_tubes) {
  static double xyz[3 * n_tube];
  static int64_t corners[3 * n_tube_triangles];
  static unsigned char is_end[n_tube_triangles];
  random_source random = random_start("flat_ends");
  const int n_trials = trials(30, 300);
  for (int trial = 0; trial < n_trials; ++trial) {
    const double noise = trial % 3 == 0 ? 0 : random_between(&random, 0, 0.03);
    const int64_t n = make_tube(&random, noise, trial % 2, xyz, corners);
    assert_int_equal(shim_flat_ends(n_tube, xyz, n, corners, is_end), 0);
    for (int64_t i = 0; i < n; ++i)
      if (is_end[i] != (i >= n_sides)) fail_msg("noise %g: triangle %d of %d", noise, (int)i, (int)n);
  }
}

/* A ball has no flat end, and a box has only flat ends. */
TEST(test_ball_and_box) {
  enum { n = 16, n_points = 6 * (n + 1) * (n + 1), n_triangles = 12 * n * n };
  static double xyz[3 * n_points];
  static int64_t corners[3 * n_triangles];
  static unsigned char is_end[n_triangles];
  for (int is_ball = 0; is_ball < 2; ++is_ball) {
    int64_t at = 0, n_made = 0;
    for (int side = 0; side < 6; ++side)
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j, ++at) {
          double p[3];
          p[side % 3] = side < 3 ? 1 : -1;
          p[(side + 1) % 3] = 2.0 * i / n - 1;
          p[(side + 2) % 3] = 2.0 * j / n - 1;
          const double length = is_ball ? sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) : 1;
          for (int k = 0; k < 3; ++k) xyz[3 * at + k] = p[k] / length;
          if (i == n || j == n) continue;
          const int64_t two[6] = {at, at + n + 1, at + n + 2, at, at + n + 2, at + 1};
          for (int k = 0; k < 6; ++k) corners[3 * n_made + k] = two[k];
          n_made += 2;
        }
    /* Vertices at one position become one vertex, as in a wall whose triangles share points. */
    for (int64_t i = 0; i < 3 * n_made; ++i)
      for (int64_t j = 0; j < corners[i]; ++j)
        if (fabs(xyz[3 * j] - xyz[3 * corners[i]]) + fabs(xyz[3 * j + 1] - xyz[3 * corners[i] + 1]) +
                fabs(xyz[3 * j + 2] - xyz[3 * corners[i] + 2]) <
            1e-9) {
          corners[i] = j;
          break;
        }
    const int are_all = shim_flat_ends(at, xyz, n_made, corners, is_end);
    assert_int_equal(are_all, !is_ball);
    for (int64_t i = 0; i < n_made; ++i) assert_int_equal(is_end[i], !is_ball);
  }
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
