/* SPDX-License-Identifier: Apache-2.0
 * Tests the forces at the vertices of a surface, and the loads at nodes of tissue. Forces at vertices are compared with a plain
 * loop over the nodes, and with the sums by leaflet. Loads are compared with a solution of the six equations in extended
 * precision. The force on a closed valve must be that of its pressure drop, for all kinds of valves with an attachment. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"
#include "shapes.h"

#include "flow_cases.h"

/* The sum of many small forces, and their moment about a point. */
typedef struct {
  double force[3], moment[3];
} wrench;
static void add_force(wrench *to, const double *force, const double *point, const double *about) {
  double arm[3], moment[3];
  for (int c = 0; c < 3; ++c) arm[c] = point[c] - about[c];
  cross(arm, force, moment);
  for (int c = 0; c < 3; ++c) to->force[c] += force[c], to->moment[c] += moment[c];
}

/* --- Forces at vertices ---------------------------------------------------------------------------------------------- */

static void check_vertices(int kind, int32_t triangulation, int trial) {
  case_of_flow f = random_case(kind, triangulation, between(0.05, 0.08));
  riis_resistance resistance = resistance_of(pow(10, between(-3, 3)));
  if (trial % 2) resistance.rim = RIIS_RIM_CUT;
  const riis_triangles t = triangles_of(f.surface);
  const riis_flow_arrays flow = flow_of(f.nodes.n, f.velocity, f.weight);
  const size_t n = (size_t)t.n_vertices;
  double *got = own(malloc(6 * n * sizeof *got)), *expected = got + 3 * n, size = 0;
  for (size_t i = 0; i < 3 * n; ++i)
    got[i] = expected[i] = between(-1, 1); /* the call must add its forces to these values */
  wrench before[max_leaflets] = {{{0}, {0}}}, after[max_leaflets] = {{{0}, {0}}};
  const double about[3] = {between(-2, 2), between(-2, 2), between(-2, 2)};
  int32_t *leaflet_of = own(calloc(n, sizeof *leaflet_of));
  for (int64_t i = 0; i < 3 * t.n_triangles; ++i) leaflet_of[t.vertex_id[i]] = t.leaflet_id[i / 3];
  for (size_t i = 0; i < n; ++i) add_force(before + leaflet_of[i], got + 3 * i, t.xyz + 3 * i, about);

  const riis_mark_list list = within_list(f.marks);
  int64_t at = 0;
  for (int64_t i = 0; i < list.n_nodes; ++i) {
    const double d = list.distance[i], eps = 0.1;
    if (!(d < eps) || (resistance.rim == RIIS_RIM_CUT && list.rim[i])) continue;
    const double k = resistance.R / eps * (1 + cos(pi * d / eps)) / (2 * eps);
    while (t.triangle_id[at] < list.triangle_id[i]) ++at; /* ids of triangles without area are missing */
    while (t.triangle_id[at] > list.triangle_id[i]) --at;
    const int64_t node = list.node_id[i], *corner = t.vertex_id + 3 * at;
    for (int c = 0; c < 3; ++c) {
      const double force = f.weight[node] * k * (f.velocity[3 * node + c] - list.velocity[3 * i + c]);
      size += fabs(force);
      for (int m = 0; m < 3; ++m) expected[3 * corner[m] + c] += list.barycentric[3 * i + m] * force;
    }
  }
  CHECK_OK(riis_marks_add_vertex_reaction(f.marks, f.surface, &resistance, &flow, t.n_vertices, got));
  for (size_t i = 0; i < 3 * n; ++i) CHECK_NEAR(got[i], expected[i], 1e-12 * (1 + size));

  /* The forces on a leaflet's vertices add up to the leaflet's force and moment. The triangles here share no vertices. */
  riis_reaction reaction;
  double force[3 * max_leaflets] = {0}, moment[3 * max_leaflets] = {0};
  CHECK_OK(riis_reaction_init(&reaction, sizeof reaction));
  memcpy(reaction.about, about, sizeof about);
  reaction.n_leaflets = f.n_leaflets, reaction.leaflet_force = force, reaction.leaflet_moment = moment;
  CHECK_OK(riis_marks_add_reaction(f.marks, &resistance, &flow, &reaction));
  for (size_t i = 0; i < n; ++i) add_force(after + leaflet_of[i], got + 3 * i, t.xyz + 3 * i, about);
  for (int64_t leaflet = 0; leaflet < f.n_leaflets; ++leaflet)
    for (int c = 0; c < 3; ++c) {
      const double tolerance = 1e-12 * (1 + size) * (double)n;
      CHECK_NEAR(after[leaflet].force[c] - before[leaflet].force[c], force[3 * leaflet + c], tolerance);
      CHECK_NEAR(after[leaflet].moment[c] - before[leaflet].moment[c], moment[3 * leaflet + c], 10 * tolerance);
    }

  /* Two ranks share the nodes. The bits of the sums do not depend on the number of threads. */
  double *weight = own(malloc((size_t)f.nodes.n * sizeof *weight)), *shared = own(calloc(6 * n, sizeof *shared));
  for (int rank = 0; rank < 2; ++rank) {
    for (int64_t i = 0; i < f.nodes.n; ++i) weight[i] = i % 2 == rank ? f.weight[i] : 0;
    const riis_flow_arrays of_rank = flow_of(f.nodes.n, f.velocity, weight);
    riis_marks *marks = marks_of(f.surface, f.nodes.n, f.nodes.xyz, 1 + rank);
    CHECK_OK(riis_marks_add_vertex_reaction(marks, f.surface, &resistance, &of_rank, t.n_vertices, shared));
    CHECK_OK(riis_marks_add_vertex_reaction(f.marks, f.surface, &resistance, &of_rank, t.n_vertices, shared + 3 * n));
  }
  assert_memory_equal(shared, shared + 3 * n, 3 * n * sizeof *shared);
  memset(shared, 0, 3 * n * sizeof *shared);
  CHECK_OK(riis_marks_add_vertex_reaction(f.marks, f.surface, &resistance, &flow, t.n_vertices, shared));
  for (size_t i = 0; i < 3 * n; ++i) CHECK_NEAR(shared[i], shared[3 * n + i], 1e-12 * (1 + size));
}

TEST(vertices_get_the_forces_of_their_triangles) {
  for (int kind = 0; kind < n_kinds; kind += trial_step())
    for (int32_t how = RIIS_TRIANGULATION_ADAPTED; how <= RIIS_TRIANGULATION_FIXED; ++how) {
      if (kind == 6 && how == RIIS_TRIANGULATION_FIXED) continue;
      const int owned_before = n_owned();
      check_vertices(kind, how, kind + how);
      free_owned_after(owned_before);
    }
}

/* A surface from arrays skips a triangle without area. Triangles after the skipped one have ids that differ from their
 * positions. */
TEST(skipped_triangles_take_no_force) {
  static const double xyz[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 0}};
  static const int32_t ids[3][3] = {{0, 3, 4}, {0, 1, 2}, {1, 3, 2}};
  riis_surface_arrays arrays = triangle_arrays(5, xyz[0], 3, ids[0]);
  riis_surface_options options = surface_options();
  options.half_thickness = 0.1, options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_surface *surface = surface_from(&arrays, &options);
  static const double node[3] = {0.8, 0.7, 0.05}, velocity[3] = {0, 0, 2}, weight = 0.5;
  riis_mark_options how = mark_options();
  how.fields = RIIS_FIELD_BARYCENTRIC;
  riis_marks *marks = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh_of(1, node), &how, marks));
  const riis_resistance resistance = resistance_of(3);
  const riis_flow_arrays flow = flow_of(1, velocity, &weight);
  double force[5][3] = {{0}};
  CHECK_OK(riis_marks_add_vertex_reaction(marks, surface, &resistance, &flow, 5, force[0]));
  const double whole = weight * 2 * 3 / 0.1 * (1 + cos(pi / 2)) / 0.2, shares[5] = {0, 0.3, 0.2, 0.5, 0};
  for (int i = 0; i < 5; ++i) CHECK_NEAR(force[i][2], shares[i] * whole, 1e-12 * whole);
}

/* --- Loads of tissue against the six equations ----------------------------------------------------------------------- */

static riis_loads loads_of(double radius, int64_t n_edges, const double *edges, const int32_t *edge_leaflet,
                           int64_t n_leaflets, const double *force, const double *moment) {
  riis_loads loads;
  CHECK_OK(riis_loads_init(&loads, sizeof loads));
  loads.radius = radius;
  loads.n_edges = n_edges, loads.edges = edges, loads.edge_leaflet_id = edge_leaflet;
  loads.n_leaflets = n_leaflets, loads.leaflet_force = force, loads.leaflet_moment = moment;
  return loads;
}

/* Solves a x = b by elimination with pivots. */
static void solve_six(long double a[6][7], long double *x) {
  for (int k = 0; k < 6; ++k) {
    int pivot = k;
    for (int i = k + 1; i < 6; ++i)
      if (fabsl(a[i][k]) > fabsl(a[pivot][k])) pivot = i;
    for (int j = k; j < 7; ++j) {
      const long double kept = a[k][j];
      a[k][j] = a[pivot][j], a[pivot][j] = kept;
    }
    for (int i = 0; i < 6; ++i) {
      const long double factor = i == k ? 0 : a[i][k] / a[k][k];
      for (int j = k; j < 7; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  for (int k = 0; k < 6; ++k) x[k] = a[k][6] / a[k][k];
}

/* Adds the loads of a leaflet to `expected`. Each node looks at all edges, in a plain loop. */
static void add_expected(const riis_loads *loads, int64_t n, const double *nodes, const double *weight, int32_t leaflet,
                         long double *expected) {
  long double *w = own(calloc((size_t)n, sizeof *w)), a[6][7] = {{0}}, x[6];
  int has_own = 0;
  for (int64_t k = 0; k < loads->n_edges; ++k)
    has_own |= loads->edge_leaflet_id && loads->edge_leaflet_id[k] == leaflet;
  for (int64_t i = 0; i < n; ++i) {
    long double least = INFINITY;
    for (int64_t k = 0; k < loads->n_edges; ++k) {
      if (has_own && loads->edge_leaflet_id[k] != leaflet) continue;
      least = fminl(least, edge_distance_sq((const double(*)[3])(loads->edges + 6 * k), nodes + 3 * i));
    }
    const long double d = sqrtl(least) / loads->radius;
    if (d < 1) w[i] = (weight ? weight[i] : 1) * (1 + cosl(3.141592653589793238462643L * d)) / 2;
    /* A column of the matrix holds the force and the moment of w (a + b x r), where a or b is a unit vector. */
    long double r[3];
    for (int c = 0; c < 3; ++c) r[c] = (long double)nodes[3 * i + c] - loads->about[c];
    for (int column = 0; column < 6; ++column) {
      long double f[3] = {0};
      const int e = column % 3, next = (e + 1) % 3, last = (e + 2) % 3;
      if (column < 3)
        f[e] = w[i];
      else
        f[next] = -w[i] * r[last], f[last] = w[i] * r[next];
      for (int c = 0; c < 3; ++c) {
        a[c][column] += f[c];
        a[3 + c][column] += r[(c + 1) % 3] * f[(c + 2) % 3] - r[(c + 2) % 3] * f[(c + 1) % 3];
      }
    }
  }
  for (int c = 0; c < 3; ++c)
    a[c][6] = loads->leaflet_force[3 * leaflet + c], a[3 + c][6] = loads->leaflet_moment[3 * leaflet + c];
  solve_six(a, x);
  for (int64_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3, last = (c + 2) % 3;
      const long double turned = x[3 + next] * ((long double)nodes[3 * i + last] - loads->about[last]) -
                                 x[3 + last] * ((long double)nodes[3 * i + next] - loads->about[next]);
      expected[3 * i + c] += w[i] * (x[c] + turned);
    }
  free_one_owned(w);
}

/* Gives the edges that hold the leaflets of a surface. The edges are the attachment, or two rows of open edges as a caller would
 * give them. */
static int64_t edges_of(const riis_surface *surface, int kind, double **edges, int32_t **leaflet) {
  riis_attachment held = {0};
  if (kind != 6) CHECK_OK(riis_surface_get_attachment(surface, &held, sizeof held));
  if (held.n_edges > 0) {
    *edges = own(malloc((size_t)held.n_edges * 6 * sizeof **edges));
    *leaflet = own(malloc((size_t)held.n_edges * sizeof **leaflet));
    memcpy(*edges, held.edges, (size_t)held.n_edges * 6 * sizeof **edges);
    memcpy(*leaflet, held.leaflet_id, (size_t)held.n_edges * sizeof **leaflet);
    return held.n_edges;
  }
  const riis_triangles t = triangles_of(surface);
  *edges = own(malloc((size_t)t.n_triangles * 6 * sizeof **edges));
  *leaflet = own(malloc((size_t)t.n_triangles * sizeof **leaflet));
  for (int64_t i = 0; i < t.n_triangles; ++i) {
    for (int k = 0; k < 6; ++k) (*edges)[6 * i + k] = t.xyz[3 * t.vertex_id[3 * i + k / 3] + k % 3];
    (*leaflet)[i] = t.leaflet_id[i];
  }
  return t.n_triangles;
}

static void check_loads(int kind, int trial) {
  riis_surface *surface = moving_surface(kind, kind == 6 ? RIIS_TRIANGULATION_ADAPTED : trial % 2);
  double *edges;
  int32_t *edge_leaflet;
  const int64_t n_edges = edges_of(surface, kind, &edges, &edge_leaflet);
  const int64_t n_leaflets =
      info_of(surface).largest_leaflet_id + 2; /* only another leaflet's edge holds the last leaflet, as for a skirt */
  enum { n = 2000 };
  double *nodes = own(malloc(8 * n * sizeof *nodes)), *weight = nodes + 3 * n, *got = nodes + 4 * n;
  const double radius = between(0.1, 0.4);
  for (int64_t i = 0; i < n; ++i) { /* half of the nodes are too far away, or nearly so */
    const double *at = edges + 6 * any_of(n_edges), along = between(0, 1);
    for (int c = 0; c < 3; ++c)
      nodes[3 * i + c] = (1 - along) * at[c] + along * at[3 + c] + between(-1, 1) * radius * (i % 2 ? 1 : 3);
    weight[i] = i % 7 == 0 ? 0 : between(0, 1);
  }
  double force[3 * (max_leaflets + 1)], moment[3 * (max_leaflets + 1)];
  for (int i = 0; i < 3 * n_leaflets; ++i) force[i] = between(-5, 5), moment[i] = between(-5, 5);
  if (trial % 3 == 0) memset(force + 3, 0, 3 * sizeof *force), memset(moment + 3, 0, 3 * sizeof *moment);
  riis_loads loads = loads_of(radius, n_edges, edges, trial % 4 == 3 ? NULL : edge_leaflet, n_leaflets, force, moment);
  for (int c = 0; c < 3; ++c) loads.about[c] = between(-3, 3);
  const double *weights = trial % 5 == 4 ? NULL : weight;
  const riis_points points = points_at(n, nodes);

  double *sums = own(calloc(22 * (size_t)n_leaflets, sizeof *sums)), *again = sums + 11 * n_leaflets;
  CHECK_OK(riis_loads_add_sums(&loads, &points, weights, sums));
  memset(got, 0, 3 * n * sizeof *got);
  CHECK_OK(riis_loads_add_forces(&loads, &points, weights, sums, got));
  long double *expected = own(calloc(3 * n, sizeof *expected));
  for (int32_t leaflet = 0; leaflet < n_leaflets; ++leaflet) add_expected(&loads, n, nodes, weights, leaflet, expected);
  double size = 0;
  for (int i = 0; i < 3 * n; ++i) size = fmax(size, fabs(got[i]));
  for (int i = 0; i < 3 * n; ++i) CHECK_NEAR(got[i], (double)expected[i], 1e-10 * size);

  /* The sum and the moment of the loads are those of all leaflets. The power of the loads in a rigid motion is also that of all
   * leaflets. */
  wrench whole = {{0}, {0}}, of_leaflets = {{0}, {0}};
  const double v[3] = {between(-1, 1), between(-1, 1), between(-1, 1)}, spin[3] = {between(-1, 1), between(-1, 1), 1};
  double power = 0, all = 0, expected_power = 0;
  for (int64_t i = 0; i < n; ++i) {
    double arm[3], turned[3];
    for (int c = 0; c < 3; ++c) arm[c] = nodes[3 * i + c] - loads.about[c], all += fabs(got[3 * i + c]);
    cross(spin, arm, turned);
    for (int c = 0; c < 3; ++c) power += got[3 * i + c] * (v[c] + turned[c]);
    add_force(&whole, got + 3 * i, nodes + 3 * i, loads.about);
  }
  for (int i = 0; i < 3 * n_leaflets; ++i) of_leaflets.force[i % 3] += force[i], of_leaflets.moment[i % 3] += moment[i];
  for (int c = 0; c < 3; ++c) {
    CHECK_NEAR(whole.force[c], of_leaflets.force[c], 1e-12 * all);
    CHECK_NEAR(whole.moment[c], of_leaflets.moment[c], 1e-11 * all);
    expected_power += of_leaflets.force[c] * v[c] + of_leaflets.moment[c] * spin[c];
  }
  CHECK_NEAR(power, expected_power, 1e-11 * all);

  /* The bits of the loads do not depend on the number of threads. The nodes may have another stride. */
  memset(again, 0, 11 * (size_t)n_leaflets * sizeof *again);
  loads.n_threads = 3;
  double *wide = own(calloc(15 * n, sizeof *wide)), *other = wide + 12 * n;
  for (int i = 0; i < n; ++i) memcpy(wide + 4 * i, nodes + 3 * i, 3 * sizeof *wide);
  riis_points far_apart = points_at(n, wide);
  far_apart.stride = 4;
  CHECK_OK(riis_loads_add_sums(&loads, &far_apart, weights, again));
  assert_memory_equal(sums, again, 11 * (size_t)n_leaflets * sizeof *sums);
  CHECK_OK(riis_loads_add_forces(&loads, &far_apart, weights, again, other));
  assert_memory_equal(got, other, 3 * n * sizeof *got);

  /* Three ranks share the nodes. The last rank has no nodes. Each rank gives the weight 0 to the nodes of other ranks. */
  memset(again, 0, 11 * (size_t)n_leaflets * sizeof *again);
  memset(other, 0, 3 * n * sizeof *other);
  double *of_rank = own(malloc(n * sizeof *of_rank));
  const riis_points none = points_at(0, NULL);
  for (int pass = 0; pass < 2; ++pass)
    for (int rank = 0; rank < 3; ++rank) {
      for (int i = 0; i < n; ++i) of_rank[i] = (i / 3) % 2 == rank ? (weights ? weights[i] : 1) : 0;
      const riis_points *mine = rank == 2 ? &none : &points;
      if (pass == 0)
        CHECK_OK(riis_loads_add_sums(&loads, mine, rank == 2 ? NULL : of_rank, again));
      else
        CHECK_OK(riis_loads_add_forces(&loads, mine, rank == 2 ? NULL : of_rank, again, rank == 2 ? NULL : other));
    }
  for (int i = 0; i < 3 * n; ++i) CHECK_NEAR(other[i], got[i], 1e-12 * size);
}

TEST(loads_solve_the_six_equations) {
  for (int kind = 0; kind < n_kinds; kind += trial_step())
    for (int trial = 0; trial < trials_of(18); ++trial) {
      const int owned_before = n_owned();
      check_loads(kind, trial + kind);
      free_owned_after(owned_before);
    }
}

/* The loads for nodes in single precision are those for nodes at the rounded places. Far from the origin, the loads lose only as
 * many digits as the nodes. */
TEST(loads_do_not_depend_on_the_origin) {
  enum { n = 400 };
  static const double edges[2][2][3] = {{{0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {1, 1, 0.5}}};
  const double force[3] = {1, -2, 3}, moment[3] = {0.5, 0.25, -1};
  double nodes[3 * n], moved[3 * n], far_edges[12], got[3 * n] = {0}, far_got[3 * n] = {0}, sums[11] = {0},
                                                            far_sums[11] = {0};
  float single[3 * n];
  for (int i = 0; i < 3 * n; ++i) {
    single[i] = (float)between(-0.5, 1.5); /* the places have 24 bits, so the sums below are exact */
    nodes[i] = single[i], moved[i] = nodes[i] + 4096;
  }
  for (int i = 0; i < 12; ++i) far_edges[i] = edges[i / 6][i / 3 % 2][i % 3] + 4096;
  riis_loads loads = loads_of(0.5, 2, edges[0][0], NULL, 1, force, moment);
  riis_points points = points_at(n, nodes);
  points.x = single, points.y = single + 1, points.z = single + 2, points.real_bits = 32;
  CHECK_OK(riis_loads_add_sums(&loads, &points, NULL, sums));
  CHECK_OK(riis_loads_add_forces(&loads, &points, NULL, sums, got));
  points = points_at(n, moved);
  loads.edges = far_edges;
  for (int c = 0; c < 3; ++c) loads.about[c] = 4096;
  CHECK_OK(riis_loads_add_sums(&loads, &points, NULL, far_sums));
  CHECK_OK(riis_loads_add_forces(&loads, &points, NULL, far_sums, far_got));
  for (int i = 0; i < 3 * n; ++i) CHECK_NEAR(far_got[i], got[i], 1e-11);
}

/* A mirrored load gives mirrored forces at the nodes that the mirror exchanges. */
TEST(mirrored_loads_are_mirrored) {
  enum { n = 300 };
  static const double edges[3][2][3] = {{{-1, 0.2, 0}, {-1, 1, 0}}, {{-1, 0, 0}, {1, 0, 0}}, {{1, 0.2, 0}, {1, 1, 0}}};
  const double force[6] = {3, 1, 2, -3, 1, 2}, moment[6] = {1, 2, 3, 1, -2, -3}; /* a moment is an axial vector */
  double nodes[3 * n], sums[22] = {0}, got[2][3 * n] = {{0}};
  for (int i = 0; i < n; i += 2) {
    const double x = between(0, 1.3), y = between(-0.3, 1.3), z = between(-0.3, 0.3);
    const double pair[6] = {x, y, z, -x, y, z};
    memcpy(nodes + 3 * i, pair, sizeof pair);
  }
  riis_loads loads = loads_of(0.4, 3, edges[0][0], NULL, 2, force, moment);
  const riis_points points = points_at(n, nodes);
  CHECK_OK(riis_loads_add_sums(&loads, &points, NULL, sums));
  for (int side = 0; side < 2; ++side) {
    double only[12] = {0};
    memcpy(only + 3 * side, force + 3 * side, 3 * sizeof *force);
    memcpy(only + 6 + 3 * side, moment + 3 * side, 3 * sizeof *moment);
    loads.leaflet_force = only, loads.leaflet_moment = only + 6;
    CHECK_OK(riis_loads_add_forces(&loads, &points, NULL, sums, got[side]));
  }
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) CHECK_NEAR(got[1][3 * (i ^ 1) + c], (c == 0 ? -1 : 1) * got[0][3 * i + c], 1e-12);
}

/* --- A closed valve under pressure ----------------------------------------------------------------------------------- */

/* The pressure falls by `drop` across the band along the distance, and K u = -grad p. The force must be `drop` times the vector
 * area of the surface. The forces at the vertices and the forces at the tissue must add up to this force. */
static void check_closed(const char *kind, double limit) {
  const double eps = 0.06, r = 1e3, drop = 1.2e4;
  riis_surface_options options = surface_options();
  options.half_thickness = eps, options.tolerance = 0.02;
  options.rotation_angle = 35, options.rotation_axis[0] = 0.4;
  riis_surface *surface = surface_of_kind(kind, &options);
  test_mesh nodes = lattice_around(surface, eps / 2, 1.5 * eps);
  riis_mark_options how = mark_options();
  how.fields = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_RIM | RIIS_FIELD_SIDE;
  riis_marks *marks = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh_of(nodes.n, nodes.xyz), &how, marks));
  const size_t n = (size_t)nodes.n;
  double *velocity = own(calloc(4 * n, sizeof *velocity)), *weight = velocity + 3 * n, volume = 1;
  for (int c = 0; c < 3; ++c) { /* the lattice's spacing is the least difference of its coordinates */
    double least = INFINITY;
    for (int64_t i = 1; i < nodes.n; ++i) {
      const double step = nodes.xyz[3 * i + c] - nodes.xyz[c];
      if (step > 1e-9) least = fmin(least, step);
    }
    volume *= least;
  }
  for (size_t i = 0; i < n; ++i) weight[i] = volume;
  const riis_mark_list list = within_list(marks);
  for (int64_t i = 0; i < list.n_nodes; ++i)
    for (int c = 0; c < 3; ++c) {
      const double away = nodes.xyz[3 * list.node_id[i] + c] - list.point[3 * i + c];
      const double down = list.distance[i] > 1e-6 ? list.side[i] * away / list.distance[i] : list.normal[3 * i + c];
      velocity[3 * list.node_id[i] + c] = drop * eps / r * down;
    }
  riis_resistance resistance = resistance_of(r);
  resistance.rim = RIIS_RIM_CUT;
  const riis_flow_arrays flow = flow_of(nodes.n, velocity, weight);
  const riis_triangles t = triangles_of(surface);
  wrench expected = {{0}, {0}}, at_vertices = {{0}, {0}}, at_tissue = {{0}, {0}};
  const double origin[3] = {0, 0, 0};
  for (int64_t i = 0; i < t.n_triangles; ++i) {
    double side[2][3], force[3], middle[3];
    const double *corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = t.xyz + 3 * t.vertex_id[3 * i + k];
    for (int c = 0; c < 3; ++c) {
      side[0][c] = corner[1][c] - corner[0][c], side[1][c] = corner[2][c] - corner[0][c];
      middle[c] = (corner[0][c] + corner[1][c] + corner[2][c]) / 3;
    }
    cross(side[0], side[1], force);
    for (int c = 0; c < 3; ++c) force[c] *= drop / 2;
    add_force(&expected, force, middle, origin);
  }
  double *on_vertices = own(calloc(3 * (size_t)t.n_vertices, sizeof *on_vertices));
  CHECK_OK(riis_marks_add_vertex_reaction(marks, surface, &resistance, &flow, t.n_vertices, on_vertices));
  for (int64_t i = 0; i < t.n_vertices; ++i) add_force(&at_vertices, on_vertices + 3 * i, t.xyz + 3 * i, origin);

  double force[12] = {0}, moment[12] = {0}, sums[44] = {0};
  riis_reaction reaction;
  CHECK_OK(riis_reaction_init(&reaction, sizeof reaction));
  const int64_t n_leaflets = info_of(surface).largest_leaflet_id + 1;
  reaction.n_leaflets = n_leaflets, reaction.leaflet_force = force, reaction.leaflet_moment = moment;
  CHECK_OK(riis_marks_add_reaction(marks, &resistance, &flow, &reaction));
  riis_attachment held;
  CHECK_OK(riis_surface_get_attachment(surface, &held, sizeof held));
  enum { around = 8 };
  double *tissue = own(malloc(6 * (size_t)held.n_edges * around * sizeof *tissue));
  const int64_t n_tissue = held.n_edges * around;
  double *loads_there = tissue + 3 * n_tissue;
  memset(loads_there, 0, 3 * (size_t)n_tissue * sizeof *loads_there);
  for (int64_t i = 0; i < 3 * n_tissue; ++i)
    tissue[i] = held.edges[6 * (i / (3 * around)) + i % 3] + between(-0.1, 0.1);
  const riis_points points = points_at(n_tissue, tissue);
  const riis_loads loads = loads_of(0.2, held.n_edges, held.edges, held.leaflet_id, n_leaflets, force, moment);
  CHECK_OK(riis_loads_add_sums(&loads, &points, NULL, sums));
  CHECK_OK(riis_loads_add_forces(&loads, &points, NULL, sums, loads_there));
  for (int64_t i = 0; i < n_tissue; ++i) add_force(&at_tissue, loads_there + 3 * i, tissue + 3 * i, origin);

  const double size = length_of(expected.force);
  double error[2] = {0, 0};
  for (int c = 0; c < 3; ++c) {
    error[0] += pow((at_vertices.force[c] - expected.force[c]) / size, 2);
    error[1] += pow((at_tissue.force[c] - expected.force[c]) / size, 2);
    CHECK_NEAR(at_tissue.force[c], at_vertices.force[c], 1e-9 * size);
    CHECK_NEAR(at_tissue.moment[c], at_vertices.moment[c], 1e-8 * size);
  }
  printf("%s: the force differs from drop times area by %.2g %% at vertices, %.2g %% at tissue\n", kind,
         100 * sqrt(error[0]), 100 * sqrt(error[1]));
  CHECK_AT_MOST(sqrt(error[0]), limit);
  CHECK_AT_MOST(sqrt(error[1]), limit);
}

TEST(closed_valves_bear_their_drop) {
  static const char *const closed[] = {"aortic", "trileaflet", "mitral", "coapting"};
  for (int i = 0; i < 4; i += trial_step()) {
    const int owned_before = n_owned();
    check_closed(closed[i], 0.02);
    free_owned_after(owned_before);
  }
}

/* --- Refusals -------------------------------------------------------------------------------------------------------- */

TEST(refused_vertex_forces) {
  case_of_flow f = random_case(1, RIIS_TRIANGULATION_ADAPTED, 0.09);
  const riis_resistance resistance = resistance_of(1);
  const riis_flow_arrays flow = flow_of(f.nodes.n, f.velocity, f.weight);
  const int64_t n = triangles_of(f.surface).n_vertices;
  double *got = own(calloc(3 * (size_t)n, sizeof *got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks is NULL",
                riis_marks_add_vertex_reaction(NULL, f.surface, &resistance, &flow, n, got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL",
                riis_marks_add_vertex_reaction(f.marks, NULL, &resistance, &flow, n, got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "resistance is NULL",
                riis_marks_add_vertex_reaction(f.marks, f.surface, NULL, &flow, n, got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "flow is NULL",
                riis_marks_add_vertex_reaction(f.marks, f.surface, &resistance, NULL, n, got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "vertex_force is NULL",
                riis_marks_add_vertex_reaction(f.marks, f.surface, &resistance, &flow, n, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_vertices is 7; the surface has ",
                riis_marks_add_vertex_reaction(f.marks, f.surface, &resistance, &flow, 7, got));
  riis_marks *bare = new_result();
  CHECK_OK(riis_mark_nodes(f.surface, mesh_from(&f.nodes), NULL, bare));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "riis_marks_add_vertex_reaction needs RIIS_FIELD_BARYCENTRIC",
                riis_marks_add_vertex_reaction(bare, f.surface, &resistance, &flow, n, got));
  riis_surface *other = surface_of_kind("bileaflet", NULL);
  CHECK_REFUSED(
      RIIS_INVALID_ARGUMENT, "the closest triangle of node |which the surface lacks: mark the nodes again",
      riis_marks_add_vertex_reaction(f.marks, other, &resistance, &flow, triangles_of(other).n_vertices, got));
  for (int64_t i = 0; i < 3 * n; ++i) assert_true(got[i] == 0);
}

TEST(refused_loads) {
  double edges[2][2][3] = {{{0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {1, 1, 0}}};
  int32_t edge_leaflet[2] = {0, 1};
  double force[6] = {0, 0, 1, 0, 0, 1}, moment[6] = {0}, sums[22] = {0}, got[15] = {0};
  double nodes[5][3] = {{0, 0.1, 0}, {0.5, 0.1, 0.1}, {1, 0.1, 0}, {1.1, 0.5, 0.1}, {0.9, 1, 0}},
         weight[5] = {1, 1, 1, 1, 1};
  const riis_loads good = loads_of(0.3, 2, edges[0][0], edge_leaflet, 2, force, moment);
  const riis_points points = points_at(5, nodes[0]);
  riis_points bad_points = points;
  riis_loads bad = good;
  CHECK_OK(riis_loads_add_sums(&good, &points, weight, sums));
  CHECK_OK(riis_loads_add_forces(&good, &points, weight, sums, got));
  memset(got, 0, sizeof got);
#define BOTH_REFUSE(loads, points, weight, status, parts)                                  \
  do {                                                                                     \
    double other_sums[22] = {0};                                                           \
    CHECK_REFUSED(status, parts, riis_loads_add_sums(loads, points, weight, other_sums));  \
    CHECK_REFUSED(status, parts, riis_loads_add_forces(loads, points, weight, sums, got)); \
    for (int i = 0; i < 22; ++i) assert_true(other_sums[i] == 0);                          \
  } while (0)
#define CHANGED_IS_REFUSED(change, parts)                             \
  do {                                                                \
    bad = good;                                                       \
    bad.change;                                                       \
    BOTH_REFUSE(&bad, &points, weight, RIIS_INVALID_ARGUMENT, parts); \
  } while (0)
  CHANGED_IS_REFUSED(radius = NAN, "loads.radius is nan; it must be from 1e-50 to 1e+50");
  CHANGED_IS_REFUSED(radius = 0, "loads.radius is 0;");
  CHANGED_IS_REFUSED(about[1] = INFINITY, "loads.about[1] is inf;");
  CHANGED_IS_REFUSED(n_leaflets = 0, "loads.n_leaflets is 0; it must be from 1 to 2^31");
  CHANGED_IS_REFUSED(n_edges = 0, "loads.n_edges is 0;|a surface without an attachment needs edges of the caller");
  CHANGED_IS_REFUSED(n_edges = (int64_t)1 << 41, "loads.n_edges is 2199023255552;");
  CHANGED_IS_REFUSED(edges = NULL, "loads.edges is NULL");
  CHANGED_IS_REFUSED(n_threads = -1, "loads.n_threads is -1;");
  CHANGED_IS_REFUSED(reserved = 1, "loads.reserved is 1;");
  bad = good;
  bad.struct_size = 88;
  BOTH_REFUSE(&bad, &points, weight, RIIS_INVALID_STRUCT_SIZE, "struct size of loads");
  BOTH_REFUSE(NULL, &points, weight, RIIS_INVALID_ARGUMENT, "loads is NULL");
  BOTH_REFUSE(&good, NULL, weight, RIIS_INVALID_ARGUMENT, "nodes is NULL");
  edges[1][1][2] = NAN;
  BOTH_REFUSE(&good, &points, weight, RIIS_INVALID_ARGUMENT, "loads.edges: z of the second point of edge 1 is nan;");
  edges[1][1][2] = 0, edge_leaflet[1] = -1;
  BOTH_REFUSE(&good, &points, weight, RIIS_INVALID_ARGUMENT, "loads.edge_leaflet_id of edge 1 is -1;");
  edge_leaflet[1] = 1, weight[3] = -2;
  BOTH_REFUSE(&good, &points, weight, RIIS_INVALID_ARGUMENT, "weight of node 3 is -2; it must be from 0 to 1e+60");
  weight[3] = 1;
  bad_points.n_points = -1;
  BOTH_REFUSE(&good, &bad_points, weight, RIIS_INVALID_ARGUMENT, "nodes.n_points is -1;");
  bad_points = points, bad_points.real_bits = 16;
  BOTH_REFUSE(&good, &bad_points, weight, RIIS_INVALID_ARGUMENT, "nodes.real_bits is 16");
  bad_points = points, bad_points.x = NULL;
  BOTH_REFUSE(&good, &bad_points, weight, RIIS_INVALID_ARGUMENT, "nodes.x is NULL");
  nodes[2][1] = INFINITY;
  BOTH_REFUSE(&good, &points, weight, RIIS_INVALID_ARGUMENT, "y of node 2 is inf");
  nodes[2][1] = 0.1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "loads is NULL", riis_loads_init(NULL, sizeof good));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "sums is NULL", riis_loads_add_sums(&good, &points, weight, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "sums is NULL", riis_loads_add_forces(&good, &points, weight, NULL, got));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "node_force is NULL", riis_loads_add_forces(&good, &points, weight, sums, NULL));

#define FORCES_ARE_REFUSED(parts) \
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, parts, riis_loads_add_forces(&good, &points, weight, sums, got))
  bad = good, bad.leaflet_force = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "loads.leaflet_force is NULL",
                riis_loads_add_forces(&bad, &points, weight, sums, got));
  bad = good, bad.leaflet_moment = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "loads.leaflet_moment is NULL",
                riis_loads_add_forces(&bad, &points, weight, sums, got));
  force[4] = NAN;
  FORCES_ARE_REFUSED("loads.leaflet_force: y of leaflet 1 is nan;");
  force[4] = 0, moment[2] = INFINITY;
  FORCES_ARE_REFUSED("loads.leaflet_moment: z of leaflet 0 is inf;");
  moment[2] = 0;
  const double kept = sums[14];
  sums[14] = NAN;
  FORCES_ARE_REFUSED("sums: entry 3 of leaflet 1 is nan; it must come from riis_loads_add_sums");
  sums[14] = kept;

  /* Leaflet 1 has two nodes, then none, but the force on a leaflet needs three nodes. */
  weight[2] = 0;
  memset(sums, 0, sizeof sums);
  CHECK_OK(riis_loads_add_sums(&good, &points, weight, sums));
  FORCES_ARE_REFUSED(
      "tissue has 2 nodes within the radius 0.3 of the edges that hold leaflet |give a larger loads.radius");
  bad = good, bad.radius = 1e-3;
  memset(sums, 0, sizeof sums);
  CHECK_OK(riis_loads_add_sums(&bad, &points, weight, sums));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "tissue has 0 nodes within the radius 0.001 of the edges that hold leaflet 0",
                riis_loads_add_forces(&bad, &points, weight, sums, got));

  /* Nodes that lie nearly on a line are refused. A slightly wider cloud is accepted. */
  for (int i = 0; i < 5; ++i) weight[i] = 1, nodes[i][0] = 0.25 * i, nodes[i][1] = i % 2 ? 1e-3 : 0, nodes[i][2] = 0;
  bad = good, bad.edge_leaflet_id = NULL;
  for (int width = 0; width < 2; ++width) {
    for (int i = 0; i < 5; ++i) nodes[i][1] *= 1 + 9 * width;
    memset(sums, 0, sizeof sums);
    CHECK_OK(riis_loads_add_sums(&bad, &points, weight, sums));
    if (width == 0)
      CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                    "the 5 nodes of tissue within the radius 0.3 |lie nearly on a line:|more rows of nodes",
                    riis_loads_add_forces(&bad, &points, weight, sums, got));
    else
      CHECK_OK(riis_loads_add_forces(&bad, &points, weight, sums, got));
    if (width == 0)
      for (int i = 0; i < 15; ++i) assert_true(got[i] == 0);
  }
  /* A leaflet without force and moment needs no nodes. */
  memset(force, 0, sizeof force);
  memset(sums, 0, sizeof sums), memset(got, 0, sizeof got);
  CHECK_OK(riis_loads_add_forces(&good, &points, weight, sums, got));
  for (int i = 0; i < 15; ++i) assert_true(got[i] == 0);
}

int main(void) {
  rng = random_start("test_loads");
  return run_cases(NULL, NULL);
}
