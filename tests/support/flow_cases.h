/* SPDX-License-Identifier: Apache-2.0
 * For tests of forces, provides moving surfaces of all kinds, the nodes around them, and a flow at these nodes. Include after
 * handles.h, sanitized.h, searches.h and shapes.h. */
#ifndef RIIS_TEST_FLOW_CASES_H
#define RIIS_TEST_FLOW_CASES_H

static random_source rng;
static const double pi = 3.14159265358979323846;

static inline double between(double low, double high) { return random_between(&rng, low, high); }
static inline int64_t any_of(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }

static inline riis_resistance resistance_of(double r) {
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = r;
  return resistance;
}

static inline void cross(const double *a, const double *b, double *c) {
  for (int i = 0; i < 3; ++i) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}
static inline double length_of(const double *a) { return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

static inline riis_flow_arrays flow_of(int64_t n, const double *velocity, const double *weight) {
  riis_flow_arrays flow;
  CHECK_OK(riis_flow_arrays_init(&flow, sizeof flow));
  flow.n_nodes = n;
  for (int c = 0; c < 3; ++c) flow.velocity[c] = velocity + c;
  flow.velocity_stride = 3;
  flow.weight = weight;
  return flow;
}

enum { max_leaflets = 8 };
enum { n_kinds = 7 };
static const char *const kinds[n_kinds] = {"aortic",   "trileaflet", "mitral", "bileaflet",
                                           "coapting", "patches",    "arrays"};

static inline riis_valve *valve_of(int kind, double opening) {
  if (kind < 5) {
    riis_valve *valve = new_valve(kinds[kind]);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
    if (kind == 3) CHECK_OK(riis_valve_set_scalar(valve, "ring_height", 0.6));
    return valve;
  }
  /* The leaflets 2 and 6 are unit squares that turn upwards as they open. */
  shape squares = {0}, up;
  add_line(&squares, 0, 0, 0, 1, 0, 0), add_line(&squares, 0, 1, 0, 1, 1, 0);
  add_line(&squares, 0, 0, 0, 0, 1, 0), add_line(&squares, 1, 0, 0, 1, 1, 0);
  add_line(&squares, 2, 0, 0, 2, 1, 0), add_line(&squares, 1, 0, 0, 2, 0, 0), add_line(&squares, 1, 1, 0, 2, 1, 0);
  add_patch(&squares, 2, 3, 0, 1), add_patch(&squares, 4, 3, 5, 6);
  squares.reversed[6] = squares.reversed[7] = 1; /* from x = 2 to x = 1 */
  squares.leaflet_id[0] = 2, squares.leaflet_id[1] = 6;
  up = squares;
  for (int64_t i = 0; i < up.n_curves; ++i)
    for (int k = 0; k <= up.degree[i]; ++k) up.control[i][k][2] = 0.5 * up.control[i][k][0];
  riis_valve *valve = valve_from(&squares);
  CHECK_OK(riis_valve_set_open_state(valve, valve_from(&up)));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return valve;
}

/* Makes a moving surface with the given kind and triangulation and a random placement. Marks the nodes around it. */
static inline riis_surface *moving_surface(int kind, int32_t triangulation) {
  riis_surface_options options = surface_options();
  options.triangulation = triangulation;
  options.rotation_angle = between(-180, 180);
  for (int c = 0; c < 3; ++c) options.rotation_axis[c] = between(0.1, 1), options.translation[c] = between(-5, 5);
  if (kind < 6) {
    riis_valve *before = valve_of(kind, between(0.2, 0.5)), *now = valve_of(kind, between(0.5, 0.9));
    riis_surface *surface = new_surface(before, &options);
    CHECK_OK(riis_surface_update_moving(surface, now, before, between(0.01, 1), NULL, NULL));
    return surface;
  }
  enum { n = 60 };
  double *xyz, *velocity = own(malloc(9 * n * sizeof *velocity));
  int32_t *ids, *leaflets = own(malloc(n * sizeof *leaflets));
  random_soup(&rng, n, 0.4, &xyz, &ids);
  for (int i = 0; i < 9 * n; ++i) velocity[i] = between(-1, 1);
  for (int i = 0; i < n; ++i) leaflets[i] = (int32_t)any_of(max_leaflets);
  riis_surface_arrays arrays = triangle_arrays(3 * n, xyz, n, ids);
  arrays.leaflet_id = leaflets;
  arrays.vx = velocity, arrays.vy = velocity + 1, arrays.vz = velocity + 2;
  arrays.velocity_stride = 3;
  return surface_from(&arrays, &options);
}

typedef struct {
  riis_surface *surface;
  test_mesh nodes;
  riis_marks *marks;
  double *velocity, *weight;
  int64_t n_leaflets;
} case_of_flow;

static inline riis_marks *marks_of(const riis_surface *surface, int64_t n, const double *xyz, int32_t n_threads) {
  riis_mark_options options = mark_options();
  options.fields = RIIS_FIELD_POINT | RIIS_FIELD_VELOCITY | RIIS_FIELD_RIM | RIIS_FIELD_BARYCENTRIC;
  options.distance_limit = 0.13;
  options.n_threads = n_threads;
  riis_marks *marks = new_result();
  riis_mesh *mesh = mesh_of(n, xyz);
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, marks));
  return marks;
}

static inline case_of_flow random_case(int kind, int32_t triangulation, double spacing) {
  case_of_flow made = {.surface = moving_surface(kind, triangulation)};
  made.nodes = lattice_around(made.surface, spacing, 0.15);
  made.marks = marks_of(made.surface, made.nodes.n, made.nodes.xyz, 1);
  made.n_leaflets = info_of(made.surface).largest_leaflet_id + 1;
  const size_t n = (size_t)made.nodes.n;
  made.velocity = own(malloc(3 * n * sizeof(double)));
  made.weight = own(malloc(n * sizeof(double)));
  for (size_t i = 0; i < 3 * n; ++i) made.velocity[i] = between(-1, 1);
  for (size_t i = 0; i < n; ++i) made.weight[i] = between(0, 1);
  return made;
}

static inline long double edge_distance_sq(const double (*edge)[3], const double *p) {
  long double along = 0, whole = 0, sum = 0;
  for (int c = 0; c < 3; ++c) {
    const long double side = (long double)edge[1][c] - edge[0][c];
    along += (p[c] - (long double)edge[0][c]) * side;
    whole += side * side;
  }
  for (int c = 0; c < 3; ++c) {
    const long double a = edge[0][c], b = edge[1][c];
    const long double away = p[c] - (along <= 0 ? a : along >= whole ? b : a + along / whole * (b - a));
    sum += away * away;
  }
  return sum;
}

#endif
