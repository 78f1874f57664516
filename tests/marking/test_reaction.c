/* SPDX-License-Identifier: Apache-2.0
 * Tests the forces and moments of the flow. Plates are compared with closed forms, and surfaces of all kinds with plain loops
 * that search all edges. The leaflets of a symmetric valve are compared after a turn. The sums over leaflets, edges and ranks
 * must add up to the sums over the whole surface. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"
#include "shapes.h"

#include "flow_cases.h"

/* A right-handed frame of three unit vectors, and the place of its origin. */
typedef struct {
  double axis[3][3], origin[3];
} frame;

static frame random_frame(void) {
  frame made;
  double size;
  do {
    for (int c = 0; c < 3; ++c) made.axis[0][c] = between(-1, 1), made.axis[1][c] = between(-1, 1);
    cross(made.axis[0], made.axis[1], made.axis[2]);
    size = length_of(made.axis[2]);
  } while (size < 0.1);
  for (int c = 0; c < 3; ++c) made.axis[2][c] /= size, made.origin[c] = between(-3, 3);
  size = length_of(made.axis[0]);
  for (int c = 0; c < 3; ++c) made.axis[0][c] /= size;
  cross(made.axis[2], made.axis[0], made.axis[1]);
  return made;
}
static void turn(const frame *f, double a, double b, double c, double *to) {
  for (int i = 0; i < 3; ++i) to[i] = a * f->axis[0][i] + b * f->axis[1][i] + c * f->axis[2][i];
}
static void place(const frame *f, double a, double b, double c, double *to) {
  turn(f, a, b, c, to);
  for (int i = 0; i < 3; ++i) to[i] += f->origin[i];
}

/* All sums of a reaction. */
enum { max_edges = 400, n_sums = 6 * (1 + max_leaflets + max_edges) };
typedef union {
  struct {
    double force[3], moment[3], leaflet_force[3 * max_leaflets], leaflet_moment[3 * max_leaflets];
    double edge_force[3 * max_edges], edge_moment[3 * max_edges];
  };
  double all[n_sums];
} sums;

static riis_reaction reaction_to(sums *to, const double *about, int64_t n_leaflets, int64_t n_edges,
                                 const double *edges) {
  riis_reaction reaction;
  CHECK_OK(riis_reaction_init(&reaction, sizeof reaction));
  memcpy(reaction.about, about, sizeof reaction.about);
  reaction.force = to->force, reaction.moment = to->moment;
  reaction.n_leaflets = n_leaflets;
  reaction.leaflet_force = to->leaflet_force, reaction.leaflet_moment = to->leaflet_moment;
  reaction.n_edges = n_edges;
  reaction.edges = edges;
  if (n_edges > 0) reaction.edge_force = to->edge_force, reaction.edge_moment = to->edge_moment;
  return reaction;
}

/* --- Plates ---------------------------------------------------------------------------------------------------------- */

/* A plate 0 <= a <= 2, 0 <= b <= 1 in a frame. The plate has the leaflet 0 for a < 1 and the leaflet 3 for a > 1. Nodes are the
 * centres of cells with the side h. Each side of the plate has n_layers layers of nodes. The sum of h K over the layers is
 * therefore exactly R / eps. The sum over the cells of a layer integrates a linear function exactly. */
enum { n_layers = 5, n_long = 32, n_wide = 16 };
static const double plate_length = 2, plate_width = 1, plate_h = 1.0 / 16, plate_eps = 5.0 / 16;

typedef struct {
  frame frame;
  riis_surface *surface;
  int64_t n;
  double *xyz, *velocity, *weight;
  riis_marks *marks;
} plate;

/* Makes a plate that turns about the hinge a = 0. The angular velocity is `spin` times the frame's second axis. The flow has the
 * velocity `along` in the frame. */
static plate new_plate(double spin, const double *along) {
  plate made = {.frame = random_frame(), .n = 2 * n_layers * n_long * n_wide};
  double vertices[6][3], velocities[6][3];
  static const int32_t quads[8] = {0, 1, 4, 3, 1, 2, 5, 4}, leaflets[2] = {0, 3};
  for (int i = 0; i < 6; ++i) {
    const double a = i % 3, b = i / 3;
    place(&made.frame, a, b, 0, vertices[i]);
    turn(&made.frame, 0, 0, -spin * a, velocities[i]); /* (0 spin 0) x (a b 0) */
  }
  riis_surface_arrays arrays = triangle_arrays(6, vertices[0], 2, quads);
  arrays.corners_per_face = 4;
  arrays.leaflet_id = leaflets;
  arrays.vx = velocities[0], arrays.vy = velocities[0] + 1, arrays.vz = velocities[0] + 2;
  arrays.velocity_stride = 3;
  riis_surface_options options = surface_options();
  options.half_thickness = plate_eps;
  made.surface = surface_from(&arrays, &options);
  made.xyz = own(malloc((size_t)made.n * 7 * sizeof *made.xyz));
  made.velocity = made.xyz + 3 * made.n, made.weight = made.xyz + 6 * made.n;
  for (int64_t i = 0; i < made.n; ++i) {
    const int64_t layer = i / (n_long * n_wide);
    place(&made.frame, ((double)(i % n_long) + 0.5) * plate_h, ((double)(i / n_long % n_wide) + 0.5) * plate_h,
          ((double)(layer - n_layers) + 0.5) * plate_h, made.xyz + 3 * i);
    turn(&made.frame, along[0], along[1], along[2], made.velocity + 3 * i);
    made.weight[i] = plate_h * plate_h * plate_h;
  }
  made.marks = new_result();
  riis_mark_options how = mark_options();
  how.fields = RIIS_FIELD_POINT | RIIS_FIELD_VELOCITY;
  CHECK_OK(riis_mark_nodes(made.surface, mesh_of(made.n, made.xyz), &how, made.marks));
  return made;
}

/* In a flow u the force on the plate is (R / eps) u A, and it acts at the plate's centre. The formula also holds for a leaflet or
 * for a strip along an edge, with the area of this part. */
TEST(a_closed_plate_takes_the_drop) {
  for (int trial = 0; trial < trials_of(18); ++trial) {
    const double u[3] = {between(-1, 1), between(-1, 1), between(-2, 2)}, r = pow(10, between(-2, 4));
    const plate p = new_plate(0, u);
    const double about[3] = {between(-9, 9), between(-9, 9), between(-9, 9)};
    const riis_resistance resistance = resistance_of(r);
    const riis_flow_arrays flow = flow_of(p.n, p.velocity, p.weight);
    sums got = {.all = {0}};
    /* Each edge across the plate at a = (k + 1/2) / 4 gets the force of a strip of the width 1/4. */
    double edges[8][2][3];
    for (int k = 0; k < 8; ++k)
      for (int end = 0; end < 2; ++end) place(&p.frame, 0.25 * (k + 0.5), end, 0, edges[k][end]);
    const riis_reaction reaction = reaction_to(&got, about, 4, 8, edges[0][0]);
    CHECK_OK(riis_marks_add_reaction(p.marks, &resistance, &flow, &reaction));
    const double speed = length_of(u), drop = r / plate_eps * speed, area = plate_length * plate_width;
    double direction[3];
    turn(&p.frame, u[0] / speed, u[1] / speed, u[2] / speed, direction);
    const struct {
      const double *force, *moment;
      double area, a; /* the area of the strip, and the coordinate a of its middle */
    } parts[3] = {{got.force, got.moment, area, 1},
                  {got.leaflet_force, got.leaflet_moment, area / 2, 0.5},
                  {got.leaflet_force + 9, got.leaflet_moment + 9, area / 2, 1.5}};
    const double tolerance = 1e-12 * drop * area;
    for (int k = 0; k < 3; ++k) {
      double middle[3], moment[3], arm[3], force[3];
      place(&p.frame, parts[k].a, 0.5, 0, middle);
      for (int c = 0; c < 3; ++c) force[c] = drop * parts[k].area * direction[c], arm[c] = middle[c] - about[c];
      cross(arm, force, moment);
      for (int c = 0; c < 3; ++c) {
        CHECK_NEAR(parts[k].force[c], force[c], tolerance);
        CHECK_NEAR(parts[k].moment[c], moment[c], 30 * tolerance);
      }
    }
    for (int c = 3; c < 9; ++c) assert_true(got.leaflet_force[c] == 0 && got.leaflet_moment[c] == 0);
    for (int k = 0; k < 8; ++k)
      for (int c = 0; c < 3; ++c) {
        CHECK_NEAR(got.edge_force[3 * k + c], drop * area / 8 * direction[c], tolerance);
        CHECK_NEAR(got.edge_moment[3 * k + c], 0, tolerance);
      }
  }
}

/* A plate of width w and length a turns about its hinge in a fluid at rest. In the frame, the force is (R / eps) spin w a^2 / 2.
 * The moment about the hinge is (R / eps) spin w a^3 / 3, against the spin. The sum over cells is the integral of a^2, multiplied
 * by 1 - (h / 2a)^2. The power of the forces at the nodes must be the moment times the spin. */
TEST(a_hinged_plate_has_its_moment) {
  for (int trial = 0; trial < trials_of(18); ++trial) {
    static const double rest[3] = {0, 0, 0};
    const double spin = between(-5, 5), r = pow(10, between(-2, 4));
    const plate p = new_plate(spin, rest);
    const riis_resistance resistance = resistance_of(r);
    const riis_flow_arrays flow = flow_of(p.n, p.velocity, p.weight);
    sums got = {.all = {0}};
    /* The edges are the quarters of the hinge, and each gets the force of a strip along a. The moment of a strip about its edge's
     * middle is parallel to the hinge. */
    double hinge[4][2][3];
    for (int k = 0; k < 4; ++k)
      for (int end = 0; end < 2; ++end) place(&p.frame, 0, 0.25 * (k + end), 0, hinge[k][end]);
    const riis_reaction reaction = reaction_to(&got, p.frame.origin, 4, 4, hinge[0][0]);
    CHECK_OK(riis_marks_add_reaction(p.marks, &resistance, &flow, &reaction));
    const double each = r / plate_eps * spin * plate_width, a = plate_length;
    const double force = each * a * a / 2, cells = 1 - pow(plate_h / (2 * a), 2), moment = each * a * a * a / 3 * cells;
    const double tolerance = 1e-12 * fabs(moment) + 1e-300;
    double expected_force[3], expected[3], part[3];
    turn(&p.frame, 0, 0, force, expected_force);
    turn(&p.frame, 0.5 * plate_width * force, -moment, 0, expected); /* the force acts at b = 1/2 */
    turn(&p.frame, 0, -moment / 4, 0, part);
    for (int c = 0; c < 3; ++c) {
      CHECK_NEAR(got.force[c], expected_force[c], tolerance);
      CHECK_NEAR(got.moment[c], expected[c], 10 * tolerance);
      for (int k = 0; k < 4; ++k) {
        CHECK_NEAR(got.edge_force[3 * k + c], expected_force[c] / 4, tolerance);
        CHECK_NEAR(got.edge_moment[3 * k + c], part[c], 10 * tolerance);
      }
    }
    const riis_mark_list list = within_list(p.marks);
    riis_resistance_arrays arrays;
    double *k = own(calloc((size_t)p.n * 4, sizeof *k)), power = 0, turning = 0;
    CHECK_OK(riis_resistance_arrays_init(&arrays, sizeof arrays));
    CHECK_OK(add_resistance_to(p.marks, &resistance, p.n, k, NULL));
    for (int64_t i = 0; i < list.n_nodes; ++i)
      for (int c = 0; c < 3; ++c)
        power -= p.weight[list.node_id[i]] * k[list.node_id[i]] * pow(list.velocity[3 * i + c], 2);
    for (int c = 0; c < 3; ++c) turning += spin * p.frame.axis[1][c] * got.moment[c];
    CHECK_NEAR(turning, power, 1e-11 * fabs(power));
  }
}

/* If two edges are equally far from a node, the first edge gets the node's whole force. */
TEST(the_first_of_equally_near_edges_gets_the_share) {
  static const double u[3] = {0, 0, 1}, about[3] = {0, 0, 0};
  const plate p = new_plate(0, u);
  const riis_resistance resistance = resistance_of(1);
  const riis_flow_arrays flow = flow_of(p.n, p.velocity, p.weight);
  /* One edge occurs fifty times among edges that are far away. */
  double edges[50][2][3];
  for (int k = 0; k < 50; ++k)
    for (int end = 0; end < 2; ++end)
      place(&p.frame, k % 5 == 3 ? 0 : 100 + k, k % 5 == 3 ? end : end + k, 0, edges[k][end]);
  sums got = {.all = {0}};
  const riis_reaction reaction = reaction_to(&got, about, 4, 50, edges[0][0]);
  CHECK_OK(riis_marks_add_reaction(p.marks, &resistance, &flow, &reaction));
  for (int k = 0; k < 50; ++k)
    for (int c = 0; c < 3; ++c) CHECK_SAME(got.edge_force[3 * k + c] + 0.0, k == 3 ? got.force[c] + 0.0 : 0.0);
}

/* --- Any surface, any nodes ------------------------------------------------------------------------------------------ */

/* Makes random edges near the surface. Some edges have no length, some occur twice, and some form chains with common ends. */
static int64_t random_edges(const riis_surface *surface, double (*edges)[2][3]) {
  const riis_triangles triangles = triangles_of(surface);
  const int64_t n = 1 + any_of(random_bits(&rng) % 2 ? 20 : max_edges);
  for (int64_t k = 0; k < n; ++k) {
    const int64_t like = k > 0 ? any_of(k) : 0;
    const int how = k == 0 ? 4 : (int)any_of(5);
    for (int end = 0; end < 2; ++end)
      for (int c = 0; c < 3; ++c)
        edges[k][end][c] = triangles.xyz[3 * any_of(triangles.n_vertices) + c] + between(-0.2, 0.2);
    if (how == 0) memcpy(edges[k], edges[like], sizeof *edges);
    if (how == 1) memcpy(edges[k][1], edges[k][0], sizeof **edges);
    if (how == 2) memcpy(edges[k][0], edges[like][1], sizeof **edges);
  }
  return n;
}

/* Finds the nearest edge by a loop over all edges. Returns -1 if the distances are too close for double precision to decide. */
static int64_t nearest_edge(int64_t n, const double (*edges)[2][3], const int32_t *leaflet_of, int32_t leaflet,
                            const double *p) {
  int64_t nearest = -1;
  long double least = INFINITY, next = INFINITY;
  for (int64_t k = 0; k < n; ++k) {
    if (leaflet_of && leaflet_of[k] != leaflet) continue;
    const long double here = edge_distance_sq(edges[k], p);
    if (here == least) continue; /* if two edges are equally near, the result is the first */
    if (here < least)
      next = least, least = here, nearest = k;
    else if (here < next)
      next = here;
  }
  return next - least > 1e-12L * (1 + least) ? nearest : -1;
}

typedef struct {
  long double force[3], moment[3], size, arm;
} exact;
static void add_exact(exact *to, const double *force, const double *point, const double *about) {
  double arm[3], moment[3];
  for (int c = 0; c < 3; ++c) arm[c] = point[c] - about[c];
  cross(arm, force, moment);
  for (int c = 0; c < 3; ++c)
    to->force[c] += force[c], to->moment[c] += moment[c], to->size += fabs(force[c]),
        to->arm += fabs(force[c]) * (1 + length_of(arm) + length_of(point));
}
static void check_exact(const exact *expected, const double *force, const double *moment, const double *before_force,
                        const double *before_moment) {
  for (int c = 0; c < 3; ++c) {
    CHECK_NEAR(force[c], (double)expected->force[c] + before_force[c], 1e-13 * (1 + (double)expected->size));
    CHECK_NEAR(moment[c], (double)expected->moment[c] + before_moment[c], 1e-13 * (1 + (double)expected->arm));
  }
}

/* Computes the middle of an edge. */
static void middle_of(const double (*edge)[3], double *middle) {
  for (int c = 0; c < 3; ++c) middle[c] = 0.5 * (edge[0][c] + edge[1][c]);
}

static void check_case(int kind, int32_t triangulation, int trial) {
  case_of_flow f = random_case(kind, triangulation, between(0.05, 0.08));
  riis_resistance resistance = resistance_of(pow(10, between(-3, 3)));
  if (trial % 2) resistance.rim = RIIS_RIM_CUT;
  if (trial % 3 == 1) resistance.half_thickness = between(0.06, 0.13);
  const double eps = resistance.half_thickness == RIIS_AUTO ? 0.1 : resistance.half_thickness;
  double edges[max_edges][2][3];
  int32_t edge_leaflet[max_edges];
  int64_t n_edges = random_edges(f.surface, edges);
  const int by_leaflet = trial % 2;
  for (int64_t k = 0; by_leaflet && k < n_edges; ++k) edge_leaflet[k] = (int32_t)any_of(f.n_leaflets);
  for (int32_t leaflet = 0; by_leaflet && leaflet < f.n_leaflets; ++leaflet) { /* each leaflet has an edge */
    if (n_edges == max_edges) --n_edges;
    memmove(edges + 1, edges, (size_t)n_edges * sizeof *edges);
    memmove(edge_leaflet + 1, edge_leaflet, (size_t)n_edges++ * sizeof *edge_leaflet);
    edge_leaflet[0] = leaflet;
  }
  const double about[3] = {between(-2, 2), between(-2, 2), between(-2, 2)};
  const riis_mark_list list = within_list(f.marks);
  exact *expected = own(calloc(1 + max_leaflets + max_edges, sizeof *expected));
  exact *const of_leaflet = expected + 1, *const of_edge = of_leaflet + max_leaflets;
  int64_t n_unclear = 0, n_resisting = 0;
  for (int64_t i = 0; i < list.n_nodes; ++i) {
    const double d = list.distance[i];
    const double k = d < eps ? resistance.R / eps * (1 + cos(pi * d / eps)) / (2 * eps) : 0;
    if (k == 0 || (resistance.rim == RIIS_RIM_CUT && list.rim[i])) continue;
    const int64_t node = list.node_id[i];
    const double *point = list.point + 3 * i;
    const int64_t edge = nearest_edge(n_edges, edges, by_leaflet ? edge_leaflet : NULL, list.leaflet_id[i], point);
    ++n_resisting;
    if (edge < 0) {
      ++n_unclear;
      f.weight[node] = 0;
      continue;
    }
    double force[3], middle[3];
    for (int c = 0; c < 3; ++c) force[c] = f.weight[node] * k * (f.velocity[3 * node + c] - list.velocity[3 * i + c]);
    middle_of(edges[edge], middle);
    add_exact(expected, force, point, about);
    add_exact(of_leaflet + list.leaflet_id[i], force, point, about);
    add_exact(of_edge + edge, force, point, middle);
  }
  assert_true(n_resisting > 200 && n_unclear * 20 < n_resisting);
  const riis_flow_arrays flow = flow_of(f.nodes.n, f.velocity, f.weight);
  sums *before = own(malloc(3 * sizeof *before)), *got = before + 1, *other = before + 2;
  for (int i = 0; i < n_sums; ++i) before->all[i] = between(-1, 1); /* the call must add its sums to these values */
  *got = *before;
  riis_reaction reaction = reaction_to(got, about, f.n_leaflets, n_edges, edges[0][0]);
  if (by_leaflet) reaction.edge_leaflet_id = edge_leaflet;
  CHECK_OK(riis_marks_add_reaction(f.marks, &resistance, &flow, &reaction));
  check_exact(expected, got->force, got->moment, before->force, before->moment);
  for (int64_t i = 0; i < max_leaflets; ++i)
    check_exact(of_leaflet + i, got->leaflet_force + 3 * i, got->leaflet_moment + 3 * i, before->leaflet_force + 3 * i,
                before->leaflet_moment + 3 * i);
  for (int64_t i = 0; i < max_edges; ++i)
    check_exact(of_edge + i, got->edge_force + 3 * i, got->edge_moment + 3 * i, before->edge_force + 3 * i,
                before->edge_moment + 3 * i);

  /* The bits of the sums must not depend on the number of threads, or on other sums in the same call. */
  memset(got, 0, sizeof *got);
  CHECK_OK(riis_marks_add_reaction(f.marks, &resistance, &flow, &reaction));
  static const int32_t threads[3] = {2, 3, 8};
  for (int i = 0; i < 3; ++i) {
    memset(other, 0, sizeof *other);
    riis_reaction again = reaction_to(other, about, f.n_leaflets, n_edges, edges[0][0]);
    if (by_leaflet) again.edge_leaflet_id = edge_leaflet;
    riis_marks *marks = i < 2 ? marks_of(f.surface, f.nodes.n, f.nodes.xyz, threads[i]) : f.marks;
    if (i < 2) {
      CHECK_OK(riis_marks_add_reaction(marks, &resistance, &flow, &again));
    } else {
      double **const wanted[6] = {&again.force,          &again.moment,     &again.leaflet_force,
                                  &again.leaflet_moment, &again.edge_force, &again.edge_moment};
      for (int k = 0; k < 6; ++k) {
        riis_reaction alone = again;
        double **const of_alone[6] = {&alone.force,          &alone.moment,     &alone.leaflet_force,
                                      &alone.leaflet_moment, &alone.edge_force, &alone.edge_moment};
        for (int m = 0; m < 6; ++m)
          if (m != k) *of_alone[m] = NULL;
        assert_true(*of_alone[k] == *wanted[k]);
        CHECK_OK(riis_marks_add_reaction(f.marks, &resistance, &flow, &alone));
      }
    }
    assert_memory_equal(got, other, sizeof *got);
  }

  /* The sums of all leaflets must add up to the sum of the whole surface, and so must the sums of all edges. The sums of a
   * leaflet's edges must add up to the sum of this leaflet. The error is at most 1e-12 of the sum of magnitudes. */
  const double tolerance = 1e-12 * (double)expected->size, of_moments = 1e-12 * (double)expected->arm;
  for (int c = 0; c < 3; ++c) {
    double force = 0, moment = 0, edge_force = 0, edge_moment = 0, of_first = 0;
    for (int64_t i = 0; i < f.n_leaflets; ++i)
      force += got->leaflet_force[3 * i + c], moment += got->leaflet_moment[3 * i + c];
    for (int64_t i = 0; i < n_edges; ++i) {
      double middle[3], turned[3];
      middle_of(edges[i], middle);
      for (int k = 0; k < 3; ++k) middle[k] -= about[k];
      cross(middle, got->edge_force + 3 * i, turned);
      edge_force += got->edge_force[3 * i + c];
      edge_moment += got->edge_moment[3 * i + c] + turned[c];
      if (by_leaflet && edge_leaflet[i] == f.n_leaflets - 1) of_first += got->edge_force[3 * i + c];
    }
    CHECK_NEAR(force, got->force[c], tolerance);
    CHECK_NEAR(moment, got->moment[c], of_moments);
    CHECK_NEAR(edge_force, got->force[c], tolerance);
    CHECK_NEAR(edge_moment, got->moment[c], of_moments);
    if (by_leaflet) CHECK_NEAR(of_first, got->leaflet_force[3 * (f.n_leaflets - 1) + c], tolerance);
  }

  /* Three ranks share the nodes, and their sums are added. Each rank gives the weight 0 to the nodes of the other ranks. */
  double *weight = own(malloc((size_t)f.nodes.n * sizeof *weight));
  uint8_t *rank = own(malloc((size_t)f.nodes.n));
  for (int64_t i = 0; i < f.nodes.n; ++i) rank[i] = (uint8_t)any_of(3);
  memset(other, 0, sizeof *other);
  for (int r = 0; r < 3; ++r) {
    for (int64_t i = 0; i < f.nodes.n; ++i) weight[i] = rank[i] == r ? f.weight[i] : 0;
    const riis_flow_arrays of_rank = flow_of(f.nodes.n, f.velocity, weight);
    riis_reaction again = reaction_to(other, about, f.n_leaflets, n_edges, edges[0][0]);
    if (by_leaflet) again.edge_leaflet_id = edge_leaflet;
    CHECK_OK(riis_marks_add_reaction(f.marks, &resistance, &of_rank, &again));
  }
  for (int i = 0; i < n_sums; ++i) CHECK_NEAR(other->all[i], got->all[i], of_moments);
}

TEST(sums_are_those_of_plain_loops) {
  for (int kind = 0; kind < n_kinds; kind += trial_step())
    for (int32_t how = RIIS_TRIANGULATION_ADAPTED; how <= RIIS_TRIANGULATION_FIXED; ++how)
      for (int trial = 0; trial < trials_of(9); ++trial) {
        if (kind == 6 && how == RIIS_TRIANGULATION_FIXED) continue;
        const int owned_before = n_owned();
        check_case(kind, how, trial + kind);
        free_owned_after(owned_before);
      }
}

/* --- Symmetric valves ------------------------------------------------------------------------------------------------ */

/* A symmetric valve stands in a flow along its axis. A turn about the axis maps the force and the moment on one leaflet to those
 * on the next leaflet. The axis is oblique to the rows of nodes. Two closed leaflets touch along a line. A node that is nearest
 * to this line belongs to the leaflet with the lower id. The choice between the two leaflets changes the forces by up to 2.5
 * percent. */
TEST(leaflets_of_symmetric_valves_share_alike) {
  const struct {
    const char *kind;
    int n_leaflets;
    double opening, tolerance;
  } valves[] = {{"trileaflet", 3, 0, 0.04},
                {"trileaflet", 3, 0.6, 0.003},
                {"coapting", 3, 0, 0.04},
                {"bileaflet", 2, 0, 0.03},
                {"bileaflet", 2, 0.5, 0.0005}};
  for (int i = 0; i < (int)(sizeof valves / sizeof *valves); i += trial_step())
    for (int32_t how = RIIS_TRIANGULATION_ADAPTED; how <= RIIS_TRIANGULATION_FIXED; ++how) {
      const int owned_before = n_owned();
      riis_surface_options options = surface_options();
      options.triangulation = how;
      options.rotation_angle = between(20, 70);
      for (int c = 0; c < 3; ++c) options.rotation_axis[c] = between(0.2, 1), options.translation[c] = between(-2, 2);
      riis_valve *valve = new_valve(valves[i].kind);
      CHECK_OK(riis_valve_set_scalar(valve, "opening", valves[i].opening));
      riis_surface *surface = new_surface(valve, &options);
      /* Rodrigues' formula gives the placed axis. */
      double axis[3], turned[3];
      const double size = length_of(options.rotation_axis), angle = options.rotation_angle * pi / 180;
      for (int c = 0; c < 3; ++c) axis[c] = options.rotation_axis[c] / size;
      const double z[3] = {0, 0, 1}, along = axis[2];
      cross(axis, z, turned);
      for (int c = 0; c < 3; ++c)
        turned[c] = cos(angle) * z[c] + sin(angle) * turned[c] + (1 - cos(angle)) * along * axis[c];
      test_mesh nodes = lattice_around(surface, 0.03, 0.12);
      riis_mark_options how_marked = mark_options();
      how_marked.fields = RIIS_FIELD_POINT;
      riis_marks *marks = new_result();
      CHECK_OK(riis_mark_nodes(surface, mesh_from(&nodes), &how_marked, marks));
      double *velocity = own(malloc((size_t)nodes.n * 4 * sizeof *velocity)), *weight = velocity + 3 * nodes.n;
      /* The flow also has a swirl, so that all components of the forces differ from 0. */
      for (int64_t k = 0; k < nodes.n; ++k) {
        double arm[3], swirl[3];
        for (int c = 0; c < 3; ++c) arm[c] = nodes.xyz[3 * k + c] - options.translation[c];
        cross(turned, arm, swirl);
        for (int c = 0; c < 3; ++c) velocity[3 * k + c] = turned[c] + 0.3 * swirl[c];
        weight[k] = 1;
      }
      const riis_resistance resistance = resistance_of(1);
      const riis_flow_arrays flow = flow_of(nodes.n, velocity, weight);
      sums got = {.all = {0}};
      const riis_reaction reaction = reaction_to(&got, options.translation, valves[i].n_leaflets, 0, NULL);
      CHECK_OK(riis_marks_add_reaction(marks, &resistance, &flow, &reaction));
      const double step = 2 * pi / valves[i].n_leaflets;
      double worst = 0;
      for (int leaflet = 1; leaflet < valves[i].n_leaflets; ++leaflet)
        for (int which = 0; which < 2; ++which) {
          const double *first = which ? got.leaflet_moment : got.leaflet_force, *here = first + 3 * leaflet;
          double side[3], up = 0;
          cross(turned, first, side);
          for (int c = 0; c < 3; ++c) up += turned[c] * first[c];
          for (int c = 0; c < 3; ++c) {
            const double copy = cos(leaflet * step) * first[c] + sin(leaflet * step) * side[c] +
                                (1 - cos(leaflet * step)) * up * turned[c];
            worst = fmax(worst, fabs(here[c] - copy) / length_of(first));
          }
        }
      printf("%s at %g: leaflets differ by %.2g of their force and moment\n", valves[i].kind, valves[i].opening, worst);
      CHECK_AT_MOST(worst, valves[i].tolerance);
      free_owned_after(owned_before);
    }
}

/* --- Refusals -------------------------------------------------------------------------------------------------------- */

TEST(refusals_leave_the_sums) {
  case_of_flow f = random_case(1, RIIS_TRIANGULATION_ADAPTED, 0.09);
  const riis_resistance resistance = resistance_of(1);
  const riis_flow_arrays flow = flow_of(f.nodes.n, f.velocity, f.weight);
  double edges[3][2][3] = {{{0}}};
  int32_t edge_leaflet[3] = {0, 1, 2};
  const double about[3] = {0, 0, 0};
  sums got, before;
  memset(&got, 0x41, sizeof got);
  before = got;
  const riis_reaction good = reaction_to(&got, about, 3, 3, edges[0][0]);
  riis_reaction bad;
#define REFUSED_BY(marks, status, parts)                                                    \
  do {                                                                                      \
    CHECK_REFUSED(status, parts, riis_marks_add_reaction(marks, &resistance, &flow, &bad)); \
    assert_memory_equal(&got, &before, sizeof got);                                         \
  } while (0)
#define CHANGED_IS_REFUSED(change, parts)              \
  do {                                                 \
    bad = good;                                        \
    bad.change;                                        \
    REFUSED_BY(f.marks, RIIS_INVALID_ARGUMENT, parts); \
  } while (0)
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "reaction is NULL", riis_marks_add_reaction(f.marks, &resistance, &flow, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "reaction is NULL", riis_reaction_init(NULL, sizeof bad));
  CHANGED_IS_REFUSED(about[0] = NAN, "reaction.about[0] is nan;");
  CHANGED_IS_REFUSED(about[2] = -1.1e60, "reaction.about[2] is -1.1e+60;|magnitude at most 1e+60");
  CHANGED_IS_REFUSED(n_leaflets = 2, "reaction.n_leaflets is 2,|the leaflet id 2;");
  CHANGED_IS_REFUSED(n_leaflets = 0, "reaction.n_leaflets is 0,");
  CHANGED_IS_REFUSED(n_leaflets = -1, "reaction.n_leaflets is -1;");
  CHANGED_IS_REFUSED(n_edges = 0, "reaction.n_edges is 0;|at least 1");
  CHANGED_IS_REFUSED(n_edges = -4, "reaction.n_edges is -4;");
  CHANGED_IS_REFUSED(n_edges = (int64_t)1 << 41, "reaction.n_edges is 2199023255552;|2^40");
  CHANGED_IS_REFUSED(edges = NULL, "reaction.edges is NULL");
  edges[1][0][2] = NAN;
  CHANGED_IS_REFUSED(struct_size += 0, "reaction.edges: z of the first point of edge 1 is nan;");
  edges[1][0][2] = 0, edges[2][1][0] = -1.5e60;
  CHANGED_IS_REFUSED(struct_size += 0, "reaction.edges: x of the second point of edge 2 is -1.5e+60;");
  edges[2][1][0] = 0;
  edge_leaflet[1] = -2;
  CHANGED_IS_REFUSED(edge_leaflet_id = edge_leaflet, "reaction.edge_leaflet_id of edge 1 is -2;");
  edge_leaflet[1] = 7;
  CHANGED_IS_REFUSED(edge_leaflet_id = edge_leaflet, "reaction.edge_leaflet_id has no edge of leaflet 1,");
  static const int64_t sizes[] = {0, 104, 120, -112};
  for (int i = 0; i < 4; ++i) {
    bad = good;
    bad.struct_size = sizes[i];
    REFUSED_BY(f.marks, RIIS_INVALID_STRUCT_SIZE, "struct size of reaction");
    CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "struct size of reaction", riis_reaction_init(&bad, sizes[i]));
  }
  CHECK_OK(riis_reaction_init(&bad, sizeof bad));
  REFUSED_BY(f.marks, RIIS_INVALID_ARGUMENT, "reaction has no array to add to");

  /* The forces on the whole surface and on leaflets do not need RIIS_FIELD_POINT. */
  riis_marks *bare = new_result();
  CHECK_OK(riis_mark_nodes(f.surface, mesh_from(&f.nodes), NULL, bare));
  bad = good;
  REFUSED_BY(bare, RIIS_INVALID_ARGUMENT, "needs RIIS_FIELD_POINT|options.fields = 0");
  bad.edge_force = bad.edge_moment = bad.moment = NULL;
  REFUSED_BY(bare, RIIS_INVALID_ARGUMENT, "needs RIIS_FIELD_POINT");
  bad.leaflet_moment = NULL, bad.moment = got.moment;
  REFUSED_BY(bare, RIIS_INVALID_ARGUMENT, "needs RIIS_FIELD_POINT");
  bad.moment = NULL, bad.n_edges = 0, bad.edges = NULL;
  CHECK_OK(riis_marks_add_reaction(bare, &resistance, &flow, &bad));

  /* A rank whose nodes are all far from the surface must also refuse wrong input. */
  const double far_away[3] = {1e3, 1e3, 1e3};
  riis_marks *empty_handed = marks_of(f.surface, 1, far_away, 1);
  const riis_flow_arrays of_one = flow_of(1, f.velocity, f.weight);
  bad = good;
  bad.n_leaflets = 2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "reaction.n_leaflets is 2,|the leaflet id 2;",
                riis_marks_add_reaction(empty_handed, &resistance, &of_one, &bad));
  got = before;
  CHECK_OK(riis_marks_add_reaction(empty_handed, &resistance, &of_one, &good));
  assert_memory_equal(&got, &before, sizeof got);
}

int main(void) {
  rng = random_start("test_reaction");
  return run_cases(NULL, NULL);
}
