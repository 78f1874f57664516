/* SPDX-License-Identifier: Apache-2.0
 *
 * The outside of a mesh in pictures has the same faces that VTK's own filter finds. All faces point outwards. */
#include <stdint.h>

#include "expect.h"
#include "scratch.h"
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

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
