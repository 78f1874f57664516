/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests `riis export uris`. The test reads the files as svMultiPhysics does, and compares their vertices with the library's at
 * the openings of the frames. The test also marks nodes by the solver's rule. */
/* clang-format off: test_support.h checks statuses if riis.h comes before it */
#include <riis/riis.h>
#include <riis/riis_vtk.h>

#include "calls.h"
#include "test_support.h"
/* clang-format on */

#include "program.h"
#include "scratch.h"
#include "uris_files.h"

/* ---- The surface by the library's C interface ---- */

/* A placement of the surface in two forms: as arguments of riis, and as options of riis_surface_create that place it in cm. The
 * export is in g and cm. If the mesh's unit is known, the value 12500 of R on the command line is in kg/(m s). */
typedef struct {
  const char *words[6];
  double scale, half_thickness, turn[4], shift[3], R;
} place;

static const place places[] = {
    {{NULL}, 1, 0.1, {0, 0, 1, 0}, {0, 0, 0}, 12500},
    {{"--unit", "m", "--rotate", "1,2,-1,70", "--translate", "0.02,-0.03,0.01"},
     1,
     0.1,
     {1, 2, -1, 70},
     {2, -3, 1},
     125000},
    {{"--unit", "mm", "--rotate", "0,1,0,180", "--half-thickness", "1.2"}, 1, 0.12, {0, 1, 0, 180}, {0, 0, 0}, 125000}};
enum { n_places = sizeof places / sizeof places[0] };

static riis_surface *surface_at(const place *where, riis_valve *valve) {
  riis_surface_options options;
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_options_init(&options, sizeof options));
  options.scale = where->scale;
  options.half_thickness = where->half_thickness;
  memcpy(options.rotation_axis, where->turn, sizeof options.rotation_axis);
  options.rotation_angle = where->turn[3];
  memcpy(options.translation, where->shift, sizeof options.translation);
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  CHECK_OK(riis_surface_create(valve, &options, &surface));
  return surface;
}

/* Returns the corners (3, 3, n) of all triangles of a leaflet, in the order of triangles. The caller frees them. */
static double *corners_of(const riis_surface *surface, int leaflet, int *n_found) {
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *vertex = triangles_of(surface).vertex_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  double *corners = calloc(9 * (size_t)n, sizeof *corners);
  *n_found = 0;
  for (int64_t i = 0; i < n; ++i) {
    if (leaflet_id[i] != leaflet) continue;
    for (int k = 0; k < 9; ++k) corners[9 * *n_found + k] = xyz[3 * vertex[3 * i + k / 3] + k % 3];
    ++*n_found;
  }
  return corners;
}

/* Compares a frame with the library's triangles. The last n_more triangles serve only to enlarge the solver's box. */
static void check_frame(const uris_face *face, const double *frame, const riis_surface *surface, int leaflet,
                        int n_more, double scale) {
  int n = 0;
  double *corners = corners_of(surface, leaflet, &n);
  assert_int_equal(face->n_triangles, n + n_more);
  for (int i = 0; i < 9 * n; ++i) CHECK_NEAR(frame[3 * face->corner[i / 3] + i % 3], corners[i], 1e-11 * scale);
  free(corners);
}

/* Returns the ramp of fifth degree from 0 to 1 (docs/theory/marks.md). */
static double ramp(double s) { return s * s * s * (10 + s * (-15 + 6 * s)); }

/* ---- Tests of the files ---- */

#define EXPORT(folder, ...)                                                         \
  do {                                                                              \
    RUN_FINE("export", scratch_path(folder), "--resistance", "12500", __VA_ARGS__); \
    exported = uris_read(program_out);                                              \
  } while (0)
#define RAMPS "--time-step", "0.004", "--opening-seconds", "0.02", "--closing-seconds", "0.01"

static uris_valve exported;

static void check_positions(const place *where, riis_valve *valve) {
  enum { n_open = 6, n_close = 4 }; /* one frame every 0.01 s, which is 2.5 steps, and a last frame at the end */
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
  riis_surface *surface = surface_at(where, valve);
  for (int k = 0; k < n_open + n_close; ++k) {
    const double s = k < n_open ? k / 5.0 : fmin((k - n_open) / 2.5, 1);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", k < n_open ? ramp(s) : 1 - ramp(s)));
    CHECK_OK(riis_surface_update(surface, valve, NULL));
    for (int f = 0; f < exported.n_leaflets; ++f) {
      const uris_face *face = &exported.face[f];
      assert_int_equal(face->n_open, n_open);
      assert_int_equal(face->n_close, n_close);
      check_frame(face, k < n_open ? uris_frame(face, face->open, k) : uris_frame(face, face->close, k - n_open),
                  surface, f, 0, where->scale);
    }
  }
  riis_surface_destroy(&surface);
  CHECK_NEAR(exported.thickness, where->half_thickness, 1e-15);
  CHECK_NEAR(exported.closed_thickness, where->half_thickness, 1e-15);
  CHECK_SAME(exported.resistance, where->R);
}

/* Rodrigues' formula. */
static void turned(const double turn[4], const double from[3], double to[3]) {
  const double length = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
  const double a = turn[3] * 3.14159265358979323846 / 180, c = cos(a), s = sin(a);
  const double n[3] = {turn[0] / length, turn[1] / length, turn[2] / length};
  const double dot = n[0] * from[0] + n[1] * from[1] + n[2] * from[2];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    to[k] = c * from[k] + s * (n[i] * from[j] - n[j] * from[i]) + (1 - c) * dot * n[k];
  }
}

/* Blood flows along z, and in the mitral valve against z. The tolerance is 5 degrees, because the closed annulus is
 * saddle-shaped. */
static void check_normal(const char *kind, const place *where) {
  const double along[3] = {0, 0, strcmp(kind, "mitral") == 0 ? -1 : 1};
  double flow[3], dot = 0, length = 0;
  turned(where->turn, along, flow);
  for (int k = 0; k < 3; ++k) dot += flow[k] * exported.normal[k], length += exported.normal[k] * exported.normal[k];
  CHECK_NEAR(length, 1, 1e-12);
  const int is_symmetric =
      strcmp(kind, "trileaflet") == 0 || strcmp(kind, "coapting") == 0 || strcmp(kind, "bileaflet") == 0;
  assert_true(dot > (is_symmetric ? 1 - 1e-12 : cos(5 * 3.14159265358979323846 / 180)));
}

static const struct {
  const char *kind, *face[3], *set;
  int n_leaflets;
} kinds[] = {{"aortic", {"right", "left", "non_coronary"}, "root_radius=1.4", 3},
             {"trileaflet", {"right", "left", "non_coronary"}, "leaflet_height=1.15", 3},
             {"coapting", {"right", "left", "non_coronary"}, "effective_height=0.95", 3},
             {"bicuspid", {"cusp_0", "cusp_1"}, "root_radius=1.35", 2},
             {"mitral", {"anterior", "posterior"}, "anterior_length=2.2", 2},
             {"bileaflet", {"positive", "negative", "housing"}, "ring_height=0.6", 3}};
enum { n_kinds = sizeof kinds / sizeof kinds[0] };

TEST(test_positions) {
  for (int i = 0; i < n_kinds; ++i) {
    riis_valve *valve = NULL;
    char name[32];
    CHECK_OK(riis_valve_create(kinds[i].kind, &valve));
    snprintf(name, sizeof name, "%s", kinds[i].set);
    char *equals = strchr(name, '=');
    *equals = 0;
    CHECK_OK(riis_valve_set_scalar(valve, name, strtod(equals + 1, NULL)));
    for (int k = 0; k < n_places; ++k) {
      if (k != i % n_places && !is_long_test()) continue;
      const char *const *w = places[k].words;
      char folder[64];
      snprintf(folder, sizeof folder, "%s_%d", kinds[i].kind, k);
      EXPORT(folder, RAMPS, "--valve", kinds[i].kind, "--set", kinds[i].set, w[0], w[1], w[2], w[3], w[4], w[5]);
      assert_int_equal(exported.n_leaflets, kinds[i].n_leaflets);
      assert_int_equal(exported.n_faces, kinds[i].n_leaflets + 1);
      for (int f = 0; f < exported.n_leaflets; ++f) assert_string_equal(exported.face[f].name, kinds[i].face[f]);
      check_positions(&places[k], valve);
      /* The valve's name is that of the folder. */
      assert_non_null(strstr(exported.name, folder));
      check_normal(kinds[i].kind, &places[k]);
      uris_free(&exported);
    }
    riis_valve_destroy(&valve);
  }
}

/* The ring is an additional face beside the leaflets, or is left out. */
TEST(test_ring) {
  EXPORT("ring_face", RAMPS, "--valve", "bileaflet", "--set", "ring_height=0.6");
  assert_string_equal(exported.face[2].name, "housing");
  const int n = exported.face[2].n_triangles;
  /* Normals point away from the axis. */
  uris_state ring = uris_state_of(&exported, 3, 1, 0);
  for (int i = ring.n - n; i < ring.n; ++i)
    assert_true(ring.middle[3 * i] * ring.normal[3 * i] + ring.middle[3 * i + 1] * ring.normal[3 * i + 1] > 0);
  uris_state_free(&ring);
  uris_free(&exported);
  EXPORT("ring_none", RAMPS, "--valve", "bileaflet", "--set", "ring_height=0.6", "--ring", "none");
  assert_int_equal(exported.n_leaflets, 2);
  assert_false(scratch_exists("ring_none/housing.vtu"));
  uris_free(&exported);
}

/* VTK reads the nodes of the first frame from the .vtu, in their order. */
TEST(test_vtk) {
  EXPORT("by_vtk", RAMPS, "--valve", "mitral");
  const uris_face *face = &exported.face[1];
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays;
  CHECK_OK(riis_vtk_surface_read(scratch_path("by_vtk/posterior.vtu"), NULL, &file));
  CHECK_OK(riis_surface_arrays_init(&arrays, sizeof arrays));
  CHECK_OK(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
  assert_int_equal(arrays.n_vertices, face->n_nodes);
  assert_int_equal(arrays.n_faces, face->n_triangles);
  const double *x = arrays.x, *y = arrays.y, *z = arrays.z;
  for (int i = 0; i < face->n_nodes; ++i) {
    CHECK_SAME(x[i * arrays.stride], face->xyz[3 * i]);
    CHECK_SAME(y[i * arrays.stride], face->open[3 * i + 1]);
    CHECK_SAME(z[i * arrays.stride], face->open[3 * i + 2]);
  }
  riis_vtk_surface_destroy(&file);
  uris_free(&exported);
}

/* The solver computes the velocity of a node from two frames, and gets the velocity of the library's vertex. Nodes of the mitral
 * valve also slide along their leaflet with the joints of the annulus. */
TEST(test_velocity) {
  riis_valve *valve = NULL, *before = NULL;
  EXPORT("velocity", RAMPS, "--valve", "trileaflet");
  CHECK_OK(riis_valve_create("trileaflet", &valve));
  CHECK_OK(riis_valve_copy(valve, &before));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", ramp(0.4)));
  CHECK_OK(riis_valve_set_scalar(before, "opening", ramp(0.2)));
  riis_surface *surface = surface_at(&places[0], valve);
  CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.004, NULL, NULL));
  const double *velocity = triangles_of(surface).velocity;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *vertex = triangles_of(surface).vertex_id;
  const int32_t *leaflet = triangles_of(surface).leaflet_id;
  int next[3] = {0, 0, 0};
  double fastest = 0, largest_difference = 0;
  for (int64_t i = 0; i < n; ++i) {
    const uris_face *face = &exported.face[leaflet[i]];
    const int *corner = face->corner + 3 * next[leaflet[i]]++;
    for (int k = 0; k < 9; ++k) {
      const int at = 3 * corner[k / 3] + k % 3;
      const double by_library = velocity[3 * vertex[3 * i + k / 3] + k % 3];
      const double by_frames = (uris_frame(face, face->open, 2)[at] - uris_frame(face, face->open, 1)[at]) / 0.004;
      largest_difference = fmax(largest_difference, fabs(by_frames - by_library));
      fastest = fmax(fastest, fabs(by_library));
    }
  }
  printf("speeds up to %.3g, by frames up to %.3g off\n", fastest, largest_difference);
  CHECK_AT_MOST(largest_difference, 0.01 * fastest);
  assert_true(fastest > 10);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  riis_valve_destroy(&before);
  uris_free(&exported);
}

/* ---- Refined triangles ---- */

static double distance_of(const double *a, const double *b) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static double area_of(const uris_face *face, const double *xyz) {
  double area = 0;
  for (int i = 0; i < face->n_triangles; ++i) {
    const double *p[3];
    for (int c = 0; c < 3; ++c) p[c] = xyz + 3 * face->corner[3 * i + c];
    const double a = distance_of(p[0], p[1]), b = distance_of(p[1], p[2]), c = distance_of(p[2], p[0]);
    const double s = (a + b + c) / 2;
    area += sqrt(fmax(0, s * (s - a) * (s - b) * (s - c)));
  }
  return area;
}

static double longest_edge_of(const uris_face *face, const double *xyz) {
  double longest = 0;
  for (int i = 0; i < 3 * face->n_triangles; ++i)
    longest = fmax(longest, distance_of(xyz + 3 * face->corner[i], xyz + 3 * face->corner[i / 3 * 3 + (i + 1) % 3]));
  return longest;
}

/* The leaflet's outline consists of the edges that belong to only one triangle. After the export has halved edges, each edge
 * inside the leaflet must still belong to two triangles. */
static double outline_of(const uris_face *face, const double *xyz) {
  double outline = 0;
  for (int i = 0; i < 3 * face->n_triangles; ++i) {
    const int a = face->corner[i], b = face->corner[i / 3 * 3 + (i + 1) % 3];
    int n = 0;
    for (int j = 0; j < 3 * face->n_triangles; ++j) {
      const int c = face->corner[j], d = face->corner[j / 3 * 3 + (j + 1) % 3];
      n += (a == c && b == d) || (a == d && b == c);
    }
    if (n == 1) outline += distance_of(xyz + 3 * a, xyz + 3 * b);
  }
  return outline;
}

/* No frame has an edge that is too long. The leaflets keep their area and outline, and every old node remains. */
TEST(test_largest_edge) {
  const char *const valves[] = {"mitral", "bileaflet"};
  for (int v = 0; v < 2; ++v) {
    char coarse_folder[32], fine_folder[32];
    snprintf(coarse_folder, sizeof coarse_folder, "coarse_%d", v);
    snprintf(fine_folder, sizeof fine_folder, "fine_%d", v);
    EXPORT(coarse_folder, RAMPS, "--valve", valves[v]);
    assert_non_null(strstr(program_out, "for errors below 1 %, export with largest-edge 0.015 -->\n"));
    uris_valve coarse = exported;
    int n_more = 0;
    EXPORT(fine_folder, RAMPS, "--valve", valves[v], "--largest-edge", "0.18");
    for (int f = 0; f < exported.n_leaflets; ++f) {
      const uris_face *fine = &exported.face[f], *was = &coarse.face[f];
      n_more += fine->n_triangles - was->n_triangles;
      for (int k = 0; k < fine->n_open; ++k) {
        const double *xyz = uris_frame(fine, fine->open, k), *before = uris_frame(was, was->open, k);
        CHECK_AT_MOST(longest_edge_of(fine, xyz), 0.18);
        CHECK_NEAR(area_of(fine, xyz), area_of(was, before), 1e-8);
        for (int i = 0; i < 3 * was->n_nodes; ++i) CHECK_SAME(xyz[i], before[i]);
      }
      CHECK_NEAR(outline_of(fine, fine->xyz), outline_of(was, was->xyz), 1e-9);
    }
    assert_true(n_more > 0);
    uris_free(&coarse);
    uris_free(&exported);
  }
}

/* ---- The solver's marks ---- */

typedef struct {
  int n_marked, n_lost, n_more, n_right_side, n_sides;
  double delta, delta_lost, largest_excess;
} rule_marks;

static double delta(double d, double eps) {
  return d < eps ? (1 + cos(3.14159265358979323846 * d / eps)) / (2 * eps) : 0;
}

/* Marks a grid round the closed valve by the solver's rule, and by the library. */
static rule_marks marks_of_closed(const char *kind) {
  const double eps = exported.thickness, step = 1.1 * eps;
  riis_valve *valve = NULL;
  rule_marks found;
  memset(&found, 0, sizeof found);
  CHECK_OK(riis_valve_create(kind, &valve));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
  riis_surface *surface = surface_at(&places[0], valve);
  riis_surface_info info;
  CHECK_OK(riis_surface_get_info(surface, &info, sizeof info));
  uris_state state = uris_state_of(&exported, exported.n_faces, 1, exported.face[0].n_close - 1);
  double p[3];
  for (p[0] = info.lower[0] - eps; p[0] < info.upper[0] + eps; p[0] += step)
    for (p[1] = info.lower[1] - eps; p[1] < info.upper[1] + eps; p[1] += step)
      for (p[2] = info.lower[2] - eps; p[2] < info.upper[2] + eps; p[2] += step) {
        riis_closest closest;
        CHECK_OK(riis_closest_point(surface, p, &closest, sizeof closest));
        if (closest.distance > 3 * eps) continue;
        double d = INFINITY;
        const int nearest = uris_nearest(&state, p, &d);
        found.n_marked += closest.distance <= eps;
        found.n_lost += closest.distance <= eps && d > eps;
        found.n_more += closest.distance > eps && d <= eps;
        found.delta += delta(closest.distance, eps);
        found.delta_lost += delta(closest.distance, eps) - delta(d, eps);
        if (closest.distance <= eps) found.largest_excess = fmax(found.largest_excess, d - closest.distance);
        /* The middles of the triangles lie on the surface, so no middle is nearer to a point than the surface. */
        assert_true(d >= closest.distance - 1e-12);
        if (closest.distance < 0.3 * eps || closest.distance > eps || closest.side == 0) continue;
        ++found.n_sides;
        found.n_right_side += uris_sign(&exported, &state, nearest, 1, p) == (closest.side > 0 ? 1 : -1);
      }
  uris_state_free(&state);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return found;
}

TEST(test_marking_rule) {
  const char *const valves[] = {"trileaflet", "mitral"};
  for (int v = 0; v < 2; ++v) {
    char folder[32];
    snprintf(folder, sizeof folder, "marks_%d", v);
    EXPORT(folder, RAMPS, "--valve", valves[v]);
    const rule_marks coarse = marks_of_closed(valves[v]);
    uris_free(&exported);
    snprintf(folder, sizeof folder, "fine_marks_%d", v);
    run_program("export", scratch_path(folder), "--resistance", "12500", RAMPS, "--valve", valves[v], "--largest-edge",
                "0.05", NULL);
    assert_int_equal(program_exit_code, 0);
    /* The files of the mitral valve are large, so the program announces them. */
    if (v == 1) assert_ptr_equal(strstr(program_err, "riis: writing "), program_err);
    exported = uris_read(program_out);
    const rule_marks fine = marks_of_closed(valves[v]);
    uris_free(&exported);
    printf("%s: of %d nodes %d are lost, with edges up to 0.05 %d; delta is too small by %.3g %%, then %.3g %%\n",
           valves[v], coarse.n_marked, coarse.n_lost, fine.n_lost, 100 * coarse.delta_lost / coarse.delta,
           100 * fine.delta_lost / fine.delta);
    assert_true(coarse.n_marked > 500);
    assert_int_equal(coarse.n_more + fine.n_more, 0);
    /* The solver marks most of these nodes, on their side of the closed valve. With smaller triangles, the solver marks nearly
     * all of these nodes. */
    assert_true(coarse.n_lost > 0 && coarse.n_lost < 0.3 * coarse.n_marked);
    assert_true(fine.largest_excess < 0.05 && fine.largest_excess < coarse.largest_excess);
    assert_true(fine.n_lost < 0.02 * fine.n_marked && fine.n_lost < coarse.n_lost);
    assert_true(fine.delta_lost < 0.05 * fine.delta && fine.delta_lost < 0.25 * coarse.delta_lost);
    assert_true(coarse.n_right_side > 0.9 * coarse.n_sides);
  }
}

/* A grid of points round a valve with a ring. Each point has the solver's K over R, and the K over R of the whole surface. */
enum { ring_n = 32 };
typedef struct {
  int n_more; /* points with more K than the whole surface gives, so they count twice */
  double of_solver, of_whole;
  int is_sealed; /* 1 if every way through the ring along the grid passes a point with K */
} ring_sums;

/* Spreads from the points below the valve, through points without K inside the radius. Returns whether the valve stops this
 * spread, so that no point above the valve is reached. */
static int is_sealed_within(const unsigned char *is_free) {
  static int stack[ring_n * ring_n * ring_n];
  static unsigned char seen[ring_n * ring_n * ring_n];
  const int step[] = {1, -1, ring_n, -ring_n, ring_n * ring_n, -ring_n * ring_n};
  int n = 0;
  memset(seen, 0, sizeof seen);
  for (int i = 0; i < ring_n * ring_n; ++i)
    if (is_free[i]) seen[i] = 1, stack[n++] = i;
  assert_true(n > 100);
  while (n > 0) {
    const int at = stack[--n];
    if (at >= (ring_n - 1) * ring_n * ring_n) return 0;
    for (int k = 0; k < 6; ++k) {
      const int next = at + step[k];
      if (next < 0 || !is_free[next] || seen[next]) continue;
      seen[next] = 1;
      stack[n++] = next;
    }
  }
  return 1;
}

static ring_sums sums_with_ring(const riis_surface *whole, int is_closed) {
  static unsigned char is_free[ring_n * ring_n * ring_n];
  const double eps = exported.thickness, radius = 1.1, side = 3.2, step = side / (ring_n - 1);
  ring_sums sums = {0, 0, 0, 0};
  uris_state state = uris_state_of(&exported, exported.n_faces, is_closed,
                                   is_closed ? exported.face[0].n_close - 1 : exported.face[0].n_open - 1);
  for (int i = 0; i < ring_n * ring_n * ring_n; ++i) {
    const double p[3] = {step * (i % ring_n) - side / 2, step * (i / ring_n % ring_n) - side / 2,
                         step * (i / ring_n / ring_n) - side / 2};
    riis_closest closest;
    double distance = 0;
    CHECK_OK(riis_closest_point(whole, p, &closest, sizeof closest));
    const double exact = delta(closest.distance, eps);
    /* No middle of a triangle is nearer than the surface. */
    if (exact > 0) uris_nearest(&state, p, &distance);
    const double solver = exact > 0 ? delta(distance, eps) : 0;
    sums.of_whole += exact;
    sums.of_solver += solver;
    /* Coordinates of the files are rounded to 1e-14. */
    sums.n_more += solver > exact + 1e-9 / (eps * eps);
    is_free[i] = solver == 0 && hypot(p[0], p[1]) < radius;
  }
  uris_state_free(&state);
  sums.is_sealed = is_sealed_within(is_free);
  return sums;
}

/* The least distance to the leaflets and the ring counts, so K never counts twice. The closed valve seals the ring. The export
 * does not offer a scaffold, because the solver would add its K. */
TEST(test_ring_counts_once) {
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create("bileaflet", &valve));
  CHECK_OK(riis_valve_set_scalar(valve, "ring_height", 0.6));
  /* The files are large, so the program announces them. */
  run_program("export", scratch_path("once"), "--resistance", "12500", RAMPS, "--valve", "bileaflet", "--set",
              "ring_height=0.6", "--largest-edge", "0.05", NULL);
  assert_int_equal(program_exit_code, 0);
  exported = uris_read(program_out);
  for (int opening = 0; opening < 2; ++opening) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
    riis_surface *whole = surface_at(&places[0], valve);
    const ring_sums sums = sums_with_ring(whole, opening == 0);
    printf("ring, opening %d: %d points twice, K %.4f of the whole\n", opening, sums.n_more,
           sums.of_solver / sums.of_whole);
    assert_int_equal(sums.n_more, 0);
    /* Middles of triangles are farther than the surface, so the solver's K is a little smaller. */
    assert_true(sums.of_solver < sums.of_whole && sums.of_solver > 0.93 * sums.of_whole);
    assert_int_equal(sums.is_sealed, opening == 0);
    riis_surface_destroy(&whole);
  }
  uris_free(&exported);
  riis_valve_destroy(&valve);
  run_program("export", scratch_path("scaffold"), "--resistance", "12500", RAMPS, "--valve", "bileaflet", "--set",
              "ring_height=0.6", "--ring", "scaffold", NULL);
  assert_int_equal(program_exit_code, 2);
  assert_non_null(strstr(program_err, "--ring"));
  assert_non_null(strstr(program_err, "face"));
}

/* ---- The solver's box ---- */

/* A frame of the solver, with and without the face that enlarges the box. */
typedef struct {
  int is_closing, n_marked, n_marked_outside, n_of_side[2];
  uris_state all, leaflets; /* n_marked_outside: marked nodes outside the box of the leaflets alone */
} frame;

static random_source rng;

/* Checks a point that is marked or lies in a pressure band. The point must lie in the box. The point's nearest triangle by the
 * solver's rule must belong to a leaflet. */
static void look_at(frame *at, const double point[3]) {
  double expected = 0, distance = 0;
  const int leaflet = uris_nearest(&at->leaflets, point, &expected);
  if (expected > 5 * exported.thickness) return;
  assert_true(uris_is_in_box(&at->all, point));
  assert_int_equal(uris_nearest(&at->all, point, &distance), leaflet);
  CHECK_SAME(distance, expected);
  if (distance < exported.thickness) {
    ++at->n_marked;
    at->n_marked_outside += !uris_is_in_box(&at->leaflets, point);
  } else {
    ++at->n_of_side[uris_sign(&exported, &at->all, leaflet, at->is_closing, point) > 0];
  }
}

/* Checks points around a triangle's middle, along the axes and between the axes. The points go from nearly on the triangle to
 * beyond the bands. */
static void look_around(frame *at, const double middle[3]) {
  for (int towards = 0; towards < 27; ++towards)
    for (double r = 1e-12; r < 6; r *= 30) {
      const int step[3] = {towards % 3 - 1, towards / 3 % 3 - 1, towards / 9 - 1};
      double point[3];
      for (int k = 0; k < 3; ++k) point[k] = middle[k] + step[k] * r * exported.thickness;
      look_at(at, point);
    }
}

/* Returns the fraction of the marks that are outside the box of the leaflets alone. */
static double check_box_of_frame(int is_closing, int k) {
  const double eps = exported.thickness;
  frame at = {is_closing,
              0,
              0,
              {0, 0},
              uris_state_of(&exported, exported.n_faces, is_closing, k),
              uris_state_of(&exported, exported.n_leaflets, is_closing, k)};
  for (int i = 0; i < 500; ++i) {
    double point[3];
    const double reach = random_between(&rng, 0, 5) * eps,
                 *middle = at.leaflets.middle + 3 * (int)(random_bits(&rng) % (uint64_t)at.leaflets.n);
    for (int j = 0; j < 3; ++j) point[j] = middle[j] + random_between(&rng, -reach, reach);
    look_at(&at, point);
  }
  assert_true(at.n_marked > 10);
  const double outside = at.n_marked_outside / (double)at.n_marked;
  /* If no node is in a band, the solver divides 0 by 0. A closed valve then never opens, and an open valve never closes. Closing
   * needs nodes upstream of the leaflets. */
  assert_true(at.n_of_side[0] > 10 && (!is_closing || at.n_of_side[1] > 10));
  assert_int_equal(at.all.n - at.leaflets.n, 3);
  for (int i = at.leaflets.n; i < at.all.n; ++i) look_around(&at, at.all.middle + 3 * i);
  /* A box larger than the bands need would slow the solver down. */
  for (int j = 0; j < 3; ++j)
    CHECK_AT_MOST(at.all.upper[j] - at.all.lower[j], 1.5 * (at.leaflets.upper[j] - at.leaflets.lower[j]) + 10.5 * eps);
  uris_state_free(&at.all);
  uris_state_free(&at.leaflets);
  return outside;
}

/* Tests the box for all kinds of valves, along the axes and oblique, with thick and thin bands. Three special cases follow: a
 * flat prosthesis, a flat patch whose box has no thickness, and a patch that opens into a plane across another axis. */
TEST(test_box) {
  rng = random_start("test_cli_uris");
  static const char *const shapes[][8] = {
      {"--valve", "aortic"},
      {"--valve", "trileaflet"},
      {"--valve", "trileaflet", "--half-thickness", "0.25"},
      {"--valve", "mitral"},
      {"--valve", "bileaflet", "--largest-edge", "0.3"},
      {"--valve", "bileaflet", "--params", "flat.json", "--half-thickness", "0.25", "--ring", "none"},
      {"--valve", "bileaflet", "--params", "flat.json", "--half-thickness", "0.25", "--largest-edge", "0.2"},
      {"--valve", "patch.json", "--largest-edge", "0.2"}};
  static const char *const turns[] = {"0,0,1,0", "1,2,-1,70"};
  scratch_write_text("flat.json", "{\"radius\": 1.28, \"closed_angle\": 8, \"ring_height\": 0.6}");
  scratch_write_text(
      "patch.json",
      "{\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,1,0],[1,1,0]], \"c\": [[0,0,0],[0,1,0]],"
      "\"d\": [[1,0,0],[1,1,0]]}, \"patches\": [{\"v0\": \"a\", \"v1\": \"b\", \"u0\": \"c\", \"u1\": \"d\"}],"
      "\"open\": {\"curves\": {\"a\": [[0,0,0],[1,0,0]], \"b\": [[0,0,-1],[1,0,-1]], \"c\": [[0,0,0],[0,0,-1]],"
      "\"d\": [[1,0,0],[1,0,-1]]}}}");
  for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; ++i)
    for (size_t t = 0; t < sizeof turns / sizeof turns[0]; ++t) {
      if ((i + t) % 2 == 0 && !is_long_test()) continue; /* the thick flat prosthesis lies along the axes */
      char folder[32];
      snprintf(folder, sizeof folder, "box_%zu_%zu", i, t);
      const char *word[8];
      for (int k = 0; k < 8; ++k)
        word[k] = shapes[i][k] && strstr(shapes[i][k], ".json") ? scratch_path(shapes[i][k]) : shapes[i][k];
      EXPORT(folder, RAMPS, "--rotate", turns[t], "--translate", "3,-70,0.001", word[0], word[1], word[2], word[3],
             word[4], word[5], word[6], word[7]);
      for (int k = 0; k < exported.face[0].n_open; ++k) check_box_of_frame(0, k);
      double outside = 0;
      for (int k = 0; k < exported.face[0].n_close; ++k) outside = check_box_of_frame(1, k);
      print_message("%s, turned by %s: %.0f %% of the closed valve's marks are outside the box of its leaflets\n",
                    exported.name, turns[t], 100 * outside);
      if (i == 5 && t == 0) assert_true(outside > 0.3);
      uris_free(&exported);
    }
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
