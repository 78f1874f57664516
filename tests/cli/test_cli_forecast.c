/* SPDX-License-Identifier: Apache-2.0
 *
 * `riis export FOLDER MESH` forecasts what svMultiPhysics will do. The test reads the exported files as the solver does, and
 * computes each number of the forecast again. Distances come from a loop over all triangles, and shape functions from VTK.
 * Volumes of nodes have a closed form. The drop comes from a dense matrix and elimination. */
/* clang-format off: test_support.h checks statuses if riis.h comes before it */
#include <riis/riis.h>

#include "calls.h"
#include "test_support.h"
/* clang-format on */

#include <sys/stat.h>

#include "brick_meshes.h"
#include "program.h"
#include "scratch.h"
#include "uris_files.h"
#include "vtk_shim.h"

static random_source rng;

static double delta(double d, double eps) {
  return d < eps ? (1 + cos(3.14159265358979323846 * d / eps)) / (2 * eps * eps) : 0;
}

/* ---- The solver's numbers for a frame ---- */

static uris_valve exported;

typedef struct {
  double n_in_box, solver_area, n_before, volume_before, n_behind, volume_behind, leaflet_speed, node_speed;
} row;

/* Gives the signed distances of all nodes. */
static int distances_of(const mesh *of, const uris_state *state, int is_closing, double *distance) {
  int n_in_box = 0;
  for (int i = 0; i < of->n_nodes; ++i) {
    const double *p = of->xyz + 3 * i;
    distance[i] = 1e6 * exported.closed_thickness;
    if (!uris_is_in_box(state, p)) continue;
    ++n_in_box;
    const int nearest = uris_nearest(state, p, &distance[i]);
    distance[i] *= uris_sign(&exported, state, nearest, is_closing, p);
  }
  return n_in_box;
}

static double area_of(const mesh *of, const double *distance, double eps) {
  const rule points = gauss_of(of->type);
  double integral = 0;
  for (int g = 0; g < points.n; ++g) {
    double value[most_of_cell], slope[3 * most_of_cell];
    shim_shape_functions(of->type->vtk, points.point[g], value, slope);
    for (int cell = 0; cell < of->n_cells; ++cell) {
      double d = 0;
      for (int a = 0; a < of->type->n_nodes; ++a)
        d += value[a] * fabs(distance[of->node[of->type->n_nodes * cell + a]]);
      integral += points.weight[g] * of->cell_volume * delta(d, eps);
    }
  }
  return eps * integral;
}

/* Computes the velocity of a leaflet's node. */
static void velocity_of(const uris_face *face, const double *motion, int frame, int node, double v[3]) {
  for (int k = 0; k < 3; ++k)
    v[k] = (uris_frame(face, motion, frame)[3 * node + k] - uris_frame(face, motion, frame - 1)[3 * node + k]) / 0.01;
}

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* In the plane of triangle t, the velocity is the linear function that has the velocities of the corners. */
static double speed_at(const uris_face *face, const double *motion, int frame, int t, const double p[3]) {
  const int *corner = face->corner + 3 * t;
  const double *xyz = uris_frame(face, motion, frame);
  double normal[3], area[3] = {0}, v[3] = {0};
  const double *c[3];
  for (int k = 0; k < 3; ++k) c[k] = xyz + 3 * corner[k];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    normal[k] = (c[1][i] - c[0][i]) * (c[2][j] - c[0][j]) - (c[1][j] - c[0][j]) * (c[2][i] - c[0][i]);
  }
  /* The weight of a corner is the signed area between p and the opposite side. */
  for (int k = 0; k < 3; ++k) {
    const double *q = c[(k + 1) % 3], *r = c[(k + 2) % 3];
    for (int d = 0; d < 3; ++d) {
      const int i = (d + 1) % 3, j = (d + 2) % 3;
      area[k] += normal[d] * ((q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i]));
    }
  }
  for (int k = 0; k < 3; ++k) {
    double of_corner[3];
    velocity_of(face, motion, frame, corner[k], of_corner);
    for (int d = 0; d < 3; ++d) v[d] += area[k] / (area[0] + area[1] + area[2]) * of_corner[d];
  }
  return length_of(v);
}

static void add_speeds(const mesh *of, const uris_state *state, int is_closing, int frame, const double *distance,
                       row *found) {
  for (int f = 0; f < exported.n_leaflets; ++f) {
    const uris_face *face = &exported.face[f];
    for (int i = 0; i < face->n_nodes; ++i) {
      double v[3];
      velocity_of(face, is_closing ? face->close : face->open, frame, i, v);
      found->leaflet_speed = fmax(found->leaflet_speed, length_of(v));
    }
  }
  for (int i = 0; i < of->n_nodes; ++i) {
    if (fabs(distance[i]) >= exported.thickness) continue;
    double d = 0;
    int f = 0, t = uris_nearest(state, of->xyz + 3 * i, &d);
    while (t >= exported.face[f].n_triangles) t -= exported.face[f++].n_triangles;
    const uris_face *face = &exported.face[f];
    found->node_speed =
        fmax(found->node_speed, speed_at(face, is_closing ? face->close : face->open, frame, t, of->xyz + 3 * i));
  }
}

static row row_of(const mesh *of, int is_closing, int frame) {
  static double distance[most_nodes];
  const double eps = exported.thickness;
  row found;
  memset(&found, 0, sizeof found);
  uris_state state = uris_state_of(&exported, exported.n_faces, is_closing, frame);
  found.n_in_box = distances_of(of, &state, is_closing, distance);
  if (frame > 0) add_speeds(of, &state, is_closing, frame, distance, &found);
  uris_state_free(&state);
  found.solver_area = area_of(of, distance, eps);
  for (int i = 0; i < of->n_nodes; ++i) {
    const double d = distance[i];
    const int is_before = d <= -eps && (!is_closing || d >= -5 * eps), is_behind = d >= eps && d <= 5 * eps;
    found.n_before += is_before;
    found.n_behind += is_behind;
    if (is_before) found.volume_before += of->volume[i];
    if (is_behind) found.volume_behind += of->volume[i];
  }
  return found;
}

/* Reads the next line of the table. */
static const char *read_row(const char *at, char motion[8], int *frame, double number[16]) {
  assert_int_equal(sscanf(at, "%7[a-z],%d,", motion, frame), 2);
  at = strchr(strchr(at, ',') + 1, ',');
  for (int i = 0; i < 16; ++i) {
    char *rest = NULL;
    number[i] = strtod(at + 1, &rest);
    assert_true(rest != at + 1 && *rest == (i < 15 ? ',' : '\n'));
    at = rest;
  }
  return at + 1;
}

static void check_table(const mesh *of, const char *folder) {
  char path[64], motion[8];
  snprintf(path, sizeof path, "%s/forecast.csv", folder);
  char *table = scratch_read(scratch_path(path), NULL);
  const char *at = strchr(table, '\n') + 1;
  const int n_open = exported.face[0].n_open, n = n_open + exported.face[0].n_close;
  double largest_area = 0;
  for (int i = 0; i < n; ++i) {
    double number[16];
    int frame = -1;
    at = read_row(at, motion, &frame, number);
    const int is_closing = i >= n_open;
    assert_string_equal(motion, is_closing ? "close" : "open");
    assert_int_equal(frame, is_closing ? i - n_open : i);
    const row expected = row_of(of, is_closing, frame);
    assert_true(number[7] == expected.n_in_box);
    CHECK_NEAR(number[8], expected.solver_area, 1e-9 * (1 + expected.solver_area));
    assert_true(number[10] == expected.n_before && number[12] == expected.n_behind);
    CHECK_NEAR(number[11], expected.volume_before, 1e-9);
    CHECK_NEAR(number[13], expected.volume_behind, 1e-9);
    CHECK_NEAR(number[14], expected.leaflet_speed, 1e-7 * (1 + expected.leaflet_speed));
    CHECK_NEAR(number[15], expected.node_speed, 1e-6 * (1 + expected.node_speed));
    largest_area = fmax(largest_area, expected.solver_area);
  }
  assert_int_equal(*at, 0);
  assert_true(largest_area > 0);
  free(table);
}

#define RAMPS "--time-step", "0.01", "--opening-seconds", "0.02", "--closing-seconds", "0.01", "--resistance", "1e4"

static void turn(double side[3][3]) {
  /* Rotates a box's sides at random about two axes. */
  for (int axis = 0; axis < 2; ++axis) {
    const double angle = random_between(&rng, -3, 3), c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; ++i) {
      double *v = side[i];
      const double a = v[axis], b = v[2];
      v[axis] = c * a - s * b;
      v[2] = s * a + c * b;
    }
  }
}

/* Tests every kind of valve and every type of element in boxes that are turned at random. A turned box leaves gaps around the
 * valve. */
TEST(test_frames) {
  char flap[64];
  snprintf(flap, sizeof flap, "%s", scratch_path("flap.json"));
  const char *const kinds[] = {"aortic", "coapting", "mitral", "trileaflet", "bileaflet", flap};
  for (int i = 0; i < n_elements_types; ++i) {
    const element *type = &elements[i];
    const int n_side = type->n_nodes < 10 ? 7 : 4, n[3] = {n_side, n_side + 1, n_side};
    double side[3][3] = {{3.3, 0, 0}, {0.4, 3.2, 0}, {0, 0.3, 3.4}}, corner[3];
    turn(side);
    for (int k = 0; k < 3; ++k)
      corner[k] = -(side[0][k] + side[1][k] + side[2][k]) / 2 + random_between(&rng, -0.1, 0.1);
    mesh box = make_mesh(type, n, corner, side);
    write_mesh(&box, "box.vtk");
    run_program("export", scratch_path(type->name), scratch_path("box.vtk"), RAMPS, "--valve", kinds[i],
                "--half-thickness", "0.25", "--tolerance", "0.1", NULL);
    if (program_exit_code != 0) fail_msg("%s in %s: %s", kinds[i], type->name, program_err);
    exported = uris_read(program_out);
    check_table(&box, type->name);
    assert_non_null(strstr(program_out, type->name));
    /* Quadratic elements cross the border of the solver's box. */
    assert_true((strstr(program_err, "on the border of its box") != NULL) == (type->n_nodes >= 10));
    uris_free(&exported);
    free_mesh(&box);
  }
}

/* ---- The drop ---- */

/* Solves a dense system by elimination with the largest pivots. The solution replaces the right-hand side. */
static void eliminate(int n, double *a, double *b) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k; i < n; ++i)
      if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) pivot = i;
    for (int j = 0; j < n && pivot != k; ++j) {
      const double old = a[k * n + j];
      a[k * n + j] = a[pivot * n + j];
      a[pivot * n + j] = old;
    }
    const double old = b[k];
    b[k] = b[pivot];
    b[pivot] = old;
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      if (factor == 0) continue;
      for (int j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
}

typedef struct {
  double R, rho, mu, dt;
} fluid;

/* Computes a slow steady flow along z by the solver's equations. A flat plate at z = 0 fills the tube. The pressure is 1 at z =
 * -length and 0 at z = length, and there is no slip at the walls. Returns the flow times R / eps. A tetrahedron and a wedge have
 * coordinates along a triangle. The solver measures these coordinates from the triangle's last node, and VTK measures them from
 * the first node. */
static double flow_through_plate(const mesh *of, const double *distance, double width, double length, double eps,
                                 const fluid *by) {
  static int local[most_nodes];
  static double outward[3 * most_nodes];
  const int n_a = of->type->n_nodes;
  int n = 0;
  memset(local, -1, sizeof local);
  memset(outward, 0, sizeof outward);
  for (int i = 0; i < of->n_nodes; ++i)
    if (fabs(of->xyz[3 * i + 2]) < length + 1e-9) local[i] = n++;
  double *a = calloc(16 * (size_t)n * (size_t)n, sizeof *a), *b = calloc(4 * (size_t)n, sizeof *b);
  const int size = 4 * n;
  const rule points = gauss_of(of->type);
  for (int cell = 0; cell < of->n_cells; ++cell) {
    const int *node = of->node + n_a * cell;
    int is_inside = 1;
    for (int i = 0; i < n_a; ++i) is_inside = is_inside && local[node[i]] >= 0;
    if (!is_inside) continue;
    for (int g = 0; g < points.n; ++g) {
      double N[most_of_cell], slope[3 * most_of_cell], gradient[most_of_cell][3], to[3][3] = {{0}}, back[3][3], d = 0;
      shim_shape_functions(of->type->vtk, points.point[g], N, slope);
      for (int i = 0; i < n_a; ++i)
        for (int k = 0; k < 3; ++k)
          for (int c = 0; c < 3; ++c) to[k][c] += of->xyz[3 * node[i] + k] * slope[n_a * c + i];
      for (int c = 0; c < 3; ++c) {
        const double *u = to[(c + 1) % 3], *v = to[(c + 2) % 3];
        const double minor[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const double det = to[c][0] * minor[0] + to[c][1] * minor[1] + to[c][2] * minor[2];
        for (int k = 0; k < 3; ++k) back[k][c] = minor[k] / det;
      }
      double metric[3][3] = {{0}}, trace = 0, square = 0;
      for (int i = 0; i < n_a; ++i) {
        d += N[i] * fabs(distance[node[i]]);
        for (int k = 0; k < 3; ++k) {
          gradient[i][k] = slope[i] * back[0][k] + slope[n_a + i] * back[1][k] + slope[2 * n_a + i] * back[2][k];
          outward[3 * node[i] + k] += points.weight[g] * of->cell_volume * gradient[i][k];
        }
      }
      /* Converts VTK's coordinates, which are between 0 and 1, to those of the solver's reference elements. */
      double axis[3][3];
      for (int k = 0; k < 3; ++k) {
        /* The solver swaps nodes 0 and 1 of half of the tetrahedra and wedges. The swap does not change the sums below. */
        for (int c = 0; c < 3; ++c)
          axis[k][c] = of->type->vtk == 10            ? gradient[k][c]
                       : of->type->vtk == 13 && k < 2 ? gradient[k][c] + gradient[k + 3][c]
                                                      : 2 * back[k][c];
      }
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) metric[i][j] += axis[k][i] * axis[k][j];
      for (int i = 0; i < 3; ++i) {
        trace += metric[i][i];
        for (int j = 0; j < 3; ++j) square += metric[i][j] * metric[i][j];
      }
      const double K = by->R * delta(d, eps), all = K + 1e-4 * by->R / (eps * eps);
      const double tau = 1 / (by->rho * sqrt(4 / (by->dt * by->dt) + K * K + 36 * square * pow(by->mu / by->rho, 2)));
      const double div = 1 / (tau * trace), w = points.weight[g] * of->cell_volume;
      for (int i = 0; i < n_a; ++i)
        for (int j = 0; j < n_a; ++j) {
          const double *p = gradient[i], *q = gradient[j];
          const double dot = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
          const int at = 4 * local[node[i]], to_at = 4 * local[node[j]];
          for (int k = 0; k < 3; ++k) {
            a[(at + k) * size + to_at + k] += w * (all * N[i] * N[j] + by->mu * dot);
            for (int c = 0; c < 3; ++c)
              a[(at + k) * size + to_at + c] += w * (by->mu * p[c] * q[k] + div * p[k] * q[c]);
            a[(at + k) * size + to_at + 3] -= w * p[k] * N[j];
            a[(at + 3) * size + to_at + k] += w * (N[i] * q[k] + tau * all * p[k] * N[j]);
          }
          a[(at + 3) * size + to_at + 3] += w * tau * dot;
        }
    }
  }
  for (int i = 0; i < of->n_nodes; ++i) {
    const double *p = of->xyz + 3 * i;
    if (local[i] < 0) continue;
    const int is_wall = fmax(fabs(p[0]), fabs(p[1])) > width - 1e-9;
    for (int k = 0; k < 3; ++k) {
      const int at = 4 * local[i] + k;
      if (is_wall) {
        for (int j = 0; j < size; ++j) a[at * size + j] = 0;
        a[at * size + at] = 1;
      } else if (p[2] < -length + 1e-9) {
        b[at] = -outward[3 * i + k];
      }
    }
  }
  eliminate(size, a, b);
  double flow = 0;
  for (int i = 0; i < of->n_nodes; ++i)
    if (local[i] >= 0 && of->xyz[3 * i + 2] < -length + 1e-9)
      for (int k = 0; k < 3; ++k) flow -= b[4 * local[i] + k] * outward[3 * i + k];
  free(a);
  free(b);
  return flow * by->R / eps;
}

static double number_after(const char *text, const char *key) {
  const char *at = strstr(text, key);
  if (!at) fail_msg("there is no '%s' in:\n%s", key, text);
  return strtod(at + strlen(key), NULL);
}

/* A Python with SciPy computes the drop. Without such a Python, the tests of the drop are skipped. */
static void need_scipy(void) {
  if (system("\"${RIIS_PYTHON:-python3}\" -c 'import scipy.sparse.linalg' 2>/dev/null") == 0) return;
  puts("skipped: Python has no SciPy (Debian: python3-scipy)");
  skip();
}

/* A plate fills a square tube. The fluids differ in the strength of the solver's stabilisation. */
TEST(test_drop) {
  need_scipy();
  static double distance[most_nodes];
  const fluid fluids[] = {{1e4, 1.06, 0.04, 0.01}, {3e3, 3, 0.3, 0.01}};
  for (int i = 0; i < 4; ++i) {
    const element *type = &elements[i % 3];
    const fluid *by = &fluids[i / 2];
    /* The tube's area has more than three digits, and the program must print more than three. */
    const double z = 3, half = 0.9968, area = 4 * half * half;
    double side[3][3] = {{2 * half, 0, 0}, {0, 2 * half, 0}, {0, 0, 2 * z}}, corner[3] = {-half, -half, -z};
    const int n[3] = {4, 4, 13};
    const double eps = 0.55, step = 2 * z / n[2];
    mesh tube = make_mesh(type, n, corner, side);
    write_mesh(&tube, "tube.vtk");
    char folder[16], R[32], rho[32], mu[32];
    snprintf(folder, sizeof folder, "tube_%d", i);
    snprintf(R, sizeof R, "--resistance=%g", by->R);
    snprintf(rho, sizeof rho, "--density=%g", by->rho);
    snprintf(mu, sizeof mu, "--viscosity=%g", by->mu);
    run_program("export", scratch_path(folder), scratch_path("tube.vtk"), "--time-step", "0.01", "--opening-seconds",
                "0.01", "--closing-seconds", "0.01", "--valve", scratch_path("flap.json"), "--half-thickness", "0.55",
                "--largest-edge", "0.2", R, rho, mu, NULL);
    if (program_exit_code != 0) fail_msg("%s: %s", type->name, program_err);
    exported = uris_read(program_out);
    uris_state closed = uris_state_of(&exported, exported.n_faces, 1, exported.face[0].n_close - 1);
    distances_of(&tube, &closed, 1, distance);
    uris_state_free(&closed);
    /* The region consists of the elements with a node near the surface. A node is near if its distance is below 2.5 half
     * thicknesses, or below one half thickness plus two median edges. */
    const double reach = fmax(2.5 * eps, eps + 2 * number_after(program_out, "median edge "));
    double length = step / 2;
    while (length <= reach) length += step;
    const double flow = flow_through_plate(&tube, distance, half, length, eps, by);
    const double expected = area / flow, printed = number_after(program_out, "expected drop of the closed valve: ");
    printf("%s, density %g: %.4f of (R/eps) u, by elimination %.5f\n", type->name, by->rho, printed, expected);
    CHECK_NEAR(printed, expected, 2e-3 * expected);
    CHECK_NEAR(number_after(program_out, "area of the leaflets in the mesh, "), area, 3e-3);
    uris_free(&exported);
    free_mesh(&tube);
  }
}

/* ---- Refusals ---- */

static void expect_no_folder(void) { assert_false(scratch_exists("refused")); }
#define REFUSED(exit_code, text, mesh_name, ...)                                                                       \
  (RUN_REFUSED(exit_code, text, "export", scratch_path("refused"), scratch_path(mesh_name), RAMPS, "--half-thickness", \
               "0.3", "--largest-edge", "0.15", __VA_ARGS__),                                                          \
   expect_no_folder())

static void write_tube(const char *name, double from, double to) {
  double side[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, to - from}}, corner[3] = {-1, -1, from};
  const int n[3] = {4, 4, 8};
  mesh tube = make_mesh(&elements[2], n, corner, side);
  write_mesh(&tube, name);
  free_mesh(&tube);
}

TEST(test_refusals) {
  char flap[64], far[64];
  snprintf(flap, sizeof flap, "%s", scratch_path("flap.json"));
  snprintf(far, sizeof far, "%s", scratch_path("far.json"));
  write_tube("behind.vtk", -0.1, 3);
  write_tube("before.vtk", -3, 0.1);
  write_tube("short.vtk", -2, 2);
  REFUSED(1,
          "behind.vtk: svMultiPhysics would never open the valve: no node is before the closed leaflets at a distance "
          "from 0.3 to 1.5, where the solver takes the pressure",
          "behind.vtk", "--valve", flap);
  REFUSED(1, "before.vtk: svMultiPhysics would never open the valve: no node is behind the closed leaflets",
          "before.vtk", "--valve", flap);
  REFUSED(1,
          "short.vtk: svMultiPhysics would never close the valve: no node of the solver's box is before the open "
          "leaflets at a "
          "distance of 0.3 or more, where the solver takes the mean flow",
          "short.vtk", "--valve", far);
  const char *const head =
      "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n"
      "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 0.5 0.5 2\n";
  const struct {
    const char *cells, *text;
  } cases[] = {
      {"CELLS 1 6\n5 4 5 6 7 8\nCELL_TYPES 1\n14\n",
       "cell 0 has VTK's type 14, and svMultiPhysics has only tet4, wedge6, hex8, tet10, hex20 and hex27"},
      {"CELLS 2 14\n8 0 1 2 3 4 5 6 7\n4 4 5 6 8\nCELL_TYPES 2\n12\n10\n",
       "has hex8 and tet4, but svMultiPhysics takes only one type of element in a mesh"},
      {"CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n", "has no volume cells, so nothing is computed in it"},
      {"CELLS 1 9\n8 4 5 6 7 0 1 2 3\nCELL_TYPES 1\n12\n",
       "volume element 0 is inside out, and svMultiPhysics does not turn hexahedra"},
      {"CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n", "volume element 0 has no volume"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    char text[1024];
    snprintf(text, sizeof text, "%s%s", head, cases[i].cells);
    scratch_write_text("bad.vtk", text);
    REFUSED(1, cases[i].text, "bad.vtk", "--valve", flap);
  }
  REFUSED(1, "missing.vtk", "missing.vtk", "--valve", flap);
  REFUSED(2, "--density: 0 is not above 0", "short.vtk", "--valve", flap, "--density", "0");
  REFUSED(2, "--viscosity: nan is not above 0", "short.vtk", "--valve", flap, "--viscosity", "nan");
  RUN_REFUSED(2, "--density requires MESH", "export", scratch_path("refused"), RAMPS, "--density", "1");
  expect_no_folder();
}

/* Besides a thicker band, the message also advises shorter edges. In a uniform mesh, the number of nodes follows from the edge
 * length. */
TEST(test_finer_edges) {
  need_scipy();
  double side[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 4.8}}, corner[3] = {-1, -1, -2.5};
  const int n[3] = {10, 10, 24};
  mesh tube = make_mesh(&elements[2], n, corner, side);
  write_mesh(&tube, "uniform.vtk");
  const double eps = 0.35, edge = 0.2;
  run_program("export", scratch_path("finer"), scratch_path("uniform.vtk"), RAMPS, "--valve", scratch_path("flap.json"),
              "--half-thickness", "0.35", "--largest-edge", "0.07", NULL);
  assert_int_equal(program_exit_code, 0);
  const double thicker = number_after(program_err, "a drop of 0.9 needs a half thickness of ");
  assert_true(thicker > eps && thicker <= 2 * eps);
  const double shorter = number_after(program_err, ", or edges of ");
  assert_true(fabs(shorter / edge * thicker / eps - 1) < 0.01);
  assert_true(fabs(number_after(program_err, " in the band, ") * edge / shorter - 1) < 0.01);
  assert_non_null(strstr(program_err, " times as long as now, in about "));
  const double n_nodes = number_after(program_err, ", in about "), expected = tube.n_nodes * pow(thicker / eps, 3);
  /* The number has two significant digits, and commas. */
  const char *comma = strstr(strstr(program_err, ", in about ") + 11, ",");
  assert_true(fabs((comma ? n_nodes * 1000 + strtod(comma + 1, NULL) : n_nodes) / expected - 1) < 0.08);
  free_mesh(&tube);
}

/* One valve leaves a gap in its mesh, and one has a drop that is too small. Both valves are exported with a warning. */
TEST(test_warnings) {
  need_scipy();
  write_tube("coarse.vtk", -3.1, 2.9);
  run_program("export", scratch_path("thin"), scratch_path("coarse.vtk"), RAMPS, "--valve", scratch_path("flap.json"),
              "--half-thickness", "0.35", "--largest-edge", "0.1", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "in svMultiPhysics the pressure will drop by 0."));
  const char *needs = strstr(program_err, "a drop of 0.9 needs a half thickness of ");
  if (!needs) needs = strstr(program_err, "even a half thickness of 0.7 does not give a drop of 0.9");
  assert_non_null(needs);
  run_program("export", scratch_path("metres"), scratch_path("coarse.vtk"), RAMPS, "--valve", scratch_path("flap.json"),
              "--half-thickness", "0.6", "--density", "1060", "--largest-edge", "0.2", NULL);
  assert_int_equal(program_exit_code, 0);
  /* A drop above (R/eps) u is not a valid forecast, so no number is printed. */
  assert_non_null(strstr(program_err,
                         "riis: the drop across the closed valve was not found, because no drop between 0 and 1/0.95 "
                         "of (R/eps) u solves the solver's equations; the solver's stabilisation needs a density of "
                         "about 1 g/cm3\n"));
  assert_non_null(strstr(program_out, "expected drop: not found, because no drop between"));
  assert_null(strstr(program_out, "expected drop of the closed valve"));
  double side[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, corner[3] = {-1, -1, -1};
  const int n[3] = {12, 12, 12};
  mesh wide = make_mesh(&elements[2], n, corner, side);
  write_mesh(&wide, "wide.vtk");
  free_mesh(&wide);
  run_program("export", scratch_path("gap"), scratch_path("wide.vtk"), RAMPS, "--valve", scratch_path("flap.json"),
              "--half-thickness", "0.1", "--scale", "0.1", "--strict", NULL);
  assert_int_equal(program_exit_code, 4);
  assert_non_null(strstr(program_err, "the closed leaflets do not separate two sides of"));
}

/* ---- Without SciPy ---- */

static const char *write_python(const char *name, const char *text) {
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "#!/bin/sh\n%s\n", text);
  assert_int_equal(fclose(file), 0);
  assert_int_equal(chmod(path, 0700), 0);
  return path;
}

/* Exports with the given Python, or with the Python of the test. Returns the table. */
static char *exported_with(const char *python, const char *folder) {
  char *old = getenv("RIIS_PYTHON") ? strdup(getenv("RIIS_PYTHON")) : NULL;
  char table[64];
  if (python) setenv("RIIS_PYTHON", python, 1);
  run_program("export", scratch_path(folder), scratch_path("coarse.vtk"), RAMPS, "--valve", scratch_path("flap.json"),
              "--half-thickness", "0.7", "--largest-edge", "0.2", NULL);
  if (old) setenv("RIIS_PYTHON", old, 1);
  if (python && !old) unsetenv("RIIS_PYTHON");
  free(old);
  assert_int_equal(program_exit_code, 0);
  snprintf(table, sizeof table, "%s/forecast.csv", folder);
  return scratch_read(scratch_path(table), NULL);
}

/* Copies the lines of the block, but leaves out the drop and the folder's name. */
static void other_lines(char *to) {
  for (char *line = strtok(program_out, "\n"); line; line = strtok(NULL, "\n"))
    if (!strstr(line, "drop") && !strstr(line, "u is the flow") && !strstr(line, "_file_path") &&
        !strstr(line, "<Add_URIS_mesh name"))
      to += sprintf(to, "%s\n", line);
}

/* Without SciPy only the drop is missing, and the export reports this. Other faults of Python are also reported. */
TEST(test_without_scipy) {
  static char with_lines[1 << 14], without_lines[1 << 14], python[256];
  write_tube("coarse.vtk", -3.1, 2.9);
  char *const with = exported_with(NULL, "with");
  assert_true(strlen(program_out) < sizeof with_lines);
  other_lines(with_lines);
  const struct {
    const char *name, *text, *reason;
  } faults[] = {
      {"lacking", "exec python3 -I -S \"$@\"", "lacking lacks numpy"}, /* -S leaves out the folders of packages */
      {"old", "echo step 5; echo lacks scipy", "old lacks scipy"},
      {"failing", "echo step 5; echo MemoryError >&2; exit 1", "failing failed: MemoryError"},
      {"killed", "kill -9 $$", "killed failed"},
      {"odd", "echo drop 3", "odd printed 'drop 3'"},
      {NULL, NULL, "none cannot be run: No such file or directory"},
  };
  for (size_t i = 0; i < sizeof faults / sizeof faults[0]; ++i) {
    char folder[16], said[256];
    snprintf(folder, sizeof folder, "without_%zu", i);
    if (faults[i].name)
      snprintf(python, sizeof python, "%s", write_python(faults[i].name, faults[i].text));
    else
      snprintf(python, sizeof python, "%s", scratch_path("none"));
    char *const without = exported_with(python, folder);
    assert_string_equal(without, with);
    free(without);
    if (!strstr(program_out, "expected drop: not computed, because ") || !strstr(program_out, faults[i].reason))
      fail_msg("'%s' is not in:\n%s", faults[i].reason, program_out);
    snprintf(said, sizeof said, "%s; the computation needs NumPy and SciPy (Debian: python3-scipy)", faults[i].reason);
    assert_non_null(strstr(
        program_err, "the drop across the closed valve was not computed, and it is not known whether the leaflets"));
    assert_non_null(strstr(program_err, said));
    other_lines(without_lines);
    assert_string_equal(without_lines, with_lines);
  }
  free(with);
}

/* The closed flap fills the tube from -1 to 1. The flap turns about the side y = -1. A second flap jumps far away. */
static int make_files(void **state) {
  const char *const flap =
      "{\"curves\": {\"a\": [[-1,-1,0],[1,-1,0]], \"b\": [[-1,1,0],[1,1,0]], \"c\": [[-1,-1,0],[-1,1,0]],"
      "\"d\": [[1,-1,0],[1,1,0]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}],"
      "\"open\": {\"curves\": {\"a\": [[-1,-1,%s],[1,-1,%s]], \"b\": [[-1,-0.5,%s],[1,-0.5,%s]],"
      "\"c\": [[-1,-1,%s],[-1,-0.5,%s]], \"d\": [[1,-1,%s],[1,-0.5,%s]]}}}";
  const int status = scratch_setup(state);
  char text[1024];
  snprintf(text, sizeof text, flap, "0", "0", "1.8", "1.8", "0", "1.8", "0", "1.8");
  scratch_write_text("flap.json", text);
  snprintf(text, sizeof text, flap, "60", "60", "62", "62", "60", "62", "60", "62");
  scratch_write_text("far.json", text);
  rng = random_start("test_cli_forecast");
  return status;
}

int main(void) { return run_cases(make_files, scratch_teardown); }
