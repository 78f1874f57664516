/* SPDX-License-Identifier: Apache-2.0
 * state_digests [THREADS [INSTRUCTIONS]] prints a digest for each of 60 states of valves, one for each of 36 placements, and one
 * of all of them. A state's digest covers triangles, marks, fields, K, velocities, derivatives, the orifice and the reaction. The
 * valves are of all kinds, with both triangulations, and with angles, warps, skirts, bumps and placements. A placement's digest
 * covers the sizes and the rotation that riis_place finds for landmarks, and the placed triangles. Equal lines of two runs mean
 * equal bits. This program uses only sums, products, quotients and roots, so it does not depend on the C library.
 *
 * state_digests cosine prints a digest of the C library's cosine. */
#include <inttypes.h>
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { n_states = 60, per_side = 12, n_nodes = per_side * per_side * per_side };

static const char *const kinds[] = {"aortic", "trileaflet", "coapting",        "bicuspid", "quadricuspid",
                                    "mitral", "tricuspid",  "mitral_coapting", "bileaflet"};
enum { n_kinds = sizeof kinds / sizeof *kinds };

static uint64_t digest;

static void add(const void *data, int64_t n_bytes) {
  const unsigned char *bytes = data;
  for (int64_t i = 0; i < n_bytes; ++i) digest = (digest ^ bytes[i]) * UINT64_C(0x100000001b3);
}
static void add_doubles(const double *values, int64_t n) { add(values, n * (int64_t)sizeof *values); }

static uint64_t random_state = 20261129;
static double between(double low, double high) {
  random_state = random_state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return low + (high - low) * ((double)(random_state >> 11) / 9007199254740992.0);
}

/* Ends the program if a call fails. */
static void check(riis_status status, const char *call) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s: %s\n", call, riis_status_name(status), riis_last_error());
  exit(1);
}
#define CHECK(call) check(call, #call)

/* Warps a valve by landmarks around it. */
static void warp(riis_valve *valve) {
  enum { n_landmarks = 14 };
  double from[3 * n_landmarks], to[3 * n_landmarks];
  for (int i = 0; i < 3 * n_landmarks; ++i) {
    from[i] = between(-1.5, 1.5);
    to[i] = 1.04 * from[i] + between(-0.01, 0.01);
  }
  riis_points sources, targets;
  CHECK(riis_points_init(&sources, sizeof sources));
  sources.n_points = n_landmarks;
  sources.x = from, sources.y = from + 1, sources.z = from + 2;
  sources.stride = 3;
  targets = sources;
  targets.x = to, targets.y = to + 1, targets.z = to + 2;
  riis_warp_options options;
  CHECK(riis_warp_options_init(&options, sizeof options));
  options.noise = 0.01;
  riis_warp *map = NULL;
  CHECK(riis_warp_create(&sources, &options, &map));
  CHECK(riis_warp_set_targets(map, &targets));
  CHECK(riis_valve_set_warp(valve, map, NULL));
  riis_warp_destroy(&map);
}

static void add_triangles(const riis_surface *surface) {
  riis_triangles triangles;
  CHECK(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  add_doubles(triangles.xyz, 3 * triangles.n_vertices);
  add(triangles.vertex_id, 3 * triangles.n_triangles * (int64_t)sizeof *triangles.vertex_id);
}

/* Puts the nodes into the box around the surface, slightly off a grid. */
static void put_nodes(const riis_surface *surface, double *xyz) {
  riis_triangles triangles;
  CHECK(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  double low[3] = {1e9, 1e9, 1e9}, high[3] = {-1e9, -1e9, -1e9};
  for (int64_t i = 0; i < 3 * triangles.n_vertices; ++i) {
    if (triangles.xyz[i] < low[i % 3]) low[i % 3] = triangles.xyz[i];
    if (triangles.xyz[i] > high[i % 3]) high[i % 3] = triangles.xyz[i];
  }
  for (int64_t i = 0; i < n_nodes; ++i) {
    const int64_t at[3] = {i % per_side, i / per_side % per_side, i / per_side / per_side};
    for (int c = 0; c < 3; ++c)
      xyz[3 * i + c] = low[c] + (high[c] - low[c]) * ((double)at[c] + between(0, 1)) / per_side;
  }
}

static void add_list(const riis_marks *marks) {
  riis_mark_list list;
  CHECK(riis_marks_get_list(marks, RIIS_LIST_WITHIN_LIMIT, &list, sizeof list));
  const int64_t n = list.n_nodes;
  add(list.node_id, n * (int64_t)sizeof *list.node_id);
  add(list.triangle_id, n * (int64_t)sizeof *list.triangle_id);
  add(list.side, n * (int64_t)sizeof *list.side);
  add(list.rim, n * (int64_t)sizeof *list.rim);
  add_doubles(list.distance, n);
  add_doubles(list.K, n);
  add_doubles(list.K_u_surface, 3 * n);
  add_doubles(list.point, 3 * n);
  add_doubles(list.normal, 3 * n);
  add_doubles(list.barycentric, 3 * n);
  add_doubles(list.velocity, 3 * n);
  add_doubles(list.distance_gradient, list.n_directions * n);
  add_doubles(list.K_gradient, list.n_directions * n);
  if (list.height) add_doubles(list.height, n);
}

static void add_reaction(const riis_marks *marks, const riis_resistance *resistance, const double *xyz) {
  static double weight[n_nodes];
  for (int64_t i = 0; i < n_nodes; ++i) weight[i] = 1 + 0.5 * xyz[3 * i];
  riis_flow_arrays flow;
  CHECK(riis_flow_arrays_init(&flow, sizeof flow));
  flow.n_nodes = n_nodes;
  for (int c = 0; c < 3; ++c) flow.velocity[c] = xyz + c;
  flow.velocity_stride = 3;
  flow.weight = weight;
  double force[3] = {0, 0, 0}, moment[3] = {0, 0, 0};
  riis_reaction reaction;
  CHECK(riis_reaction_init(&reaction, sizeof reaction));
  reaction.force = force;
  reaction.moment = moment;
  CHECK(riis_marks_add_reaction(marks, resistance, &flow, &reaction));
  add_doubles(force, 3);
  add_doubles(moment, 3);
}

static void add_state(int state, int32_t n_threads, int32_t instructions) {
  static double xyz[3 * n_nodes];
  const char *kind = kinds[state % n_kinds];
  const int lap = state / n_kinds, is_rigid = strcmp(kind, "bileaflet") == 0;
  riis_valve *now = NULL, *before = NULL;
  CHECK(riis_valve_create(kind, &now));
  if (lap % 2 == 1 && !is_rigid) CHECK(riis_valve_set_scalar(now, "skirt_length", 0.2));
  if (lap % 3 == 2 && (strcmp(kind, "tricuspid") == 0 || strcmp(kind, "bicuspid") == 0)) {
    CHECK(riis_valve_set_scalar(now, "bump_0.leaflet", 1));
    CHECK(riis_valve_set_scalar(now, "bump_0.open", 0.4));
  }
  riis_surface_options options;
  CHECK(riis_surface_options_init(&options, sizeof options));
  options.n_threads = n_threads;
  options.tolerance = 0.3;
  options.triangulation = state % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
  if (lap > 0) {
    for (int c = 0; c < 3; ++c) options.rotation_axis[c] = between(0.1, 1), options.translation[c] = between(-3, 3);
    options.rotation_angle = between(-400, 400);
  }
  if (lap == 4) options.offset = 0.5;
  riis_surface *surface = NULL;
  CHECK(riis_surface_create(now, &options, &surface));
  if (lap % 3 == 1 && !is_rigid) {
    warp(now);
    riis_surface_destroy(&surface);
    CHECK(riis_surface_create(now, &options, &surface));
  }
  CHECK(riis_valve_copy(now, &before));
  const double opening = between(0.1, 0.9);
  CHECK(riis_valve_set_scalar(now, "opening", opening));
  CHECK(riis_valve_set_scalar(before, "opening", opening - 0.01));
  CHECK(riis_surface_update_moving(surface, now, before, 1e-3, &options, NULL));
  CHECK(riis_surface_add_direction(surface, now, before, 0.01, NULL, NULL));
  add_triangles(surface);

  riis_resistance resistance;
  CHECK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1e4;
  resistance.rim = state % 4 == 3 ? RIIS_RIM_CUT : RIIS_RIM_ROUND;
  riis_orifice orifice;
  CHECK(riis_surface_get_orifice(surface, &resistance, &orifice, sizeof orifice));
  const double measured[] = {orifice.area, orifice.outline_area, orifice.perimeter, orifice.effective_area};
  add_doubles(measured, 4);

  put_nodes(surface, xyz);
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  CHECK(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  CHECK(riis_marks_create(&marks));
  riis_mark_options request;
  CHECK(riis_mark_options_init(&request, sizeof request));
  request.n_threads = n_threads;
  request.instructions = instructions;
  request.distance_limit = 0.2;
  request.resistance = &resistance;
  request.fields = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_SIDE | RIIS_FIELD_RIM |
                   RIIS_FIELD_VELOCITY | RIIS_FIELD_GRADIENT;
  CHECK(riis_mark_nodes(surface, mesh, &request, marks));
  add_list(marks);
  add_reaction(marks, &resistance, xyz);
  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&before);
  riis_valve_destroy(&now);
}

/* Makes landmarks of a patient, in the valve's frame and in centimetres. */
enum { most_landmarks = 24, n_placements = 4 * n_kinds };
typedef struct patient {
  int n;
  double xyz[3 * most_landmarks];
  int32_t role[most_landmarks], leaflet_id[2 * most_landmarks];
} patient;

static void add_landmark(patient *p, int32_t role, double x, double y, double z, int32_t leaflet, int32_t other) {
  p->xyz[3 * p->n] = x, p->xyz[3 * p->n + 1] = y, p->xyz[3 * p->n + 2] = z;
  p->role[p->n] = role;
  p->leaflet_id[2 * p->n] = leaflet, p->leaflet_id[2 * p->n + 1] = other;
  ++p->n;
}

/* Adds the nadirs of cusps, and the commissures between them. `cosine` and `sine` belong to half the angle of a cusp's sector. */
static void add_cusps(patient *p, int n_cusps, double cosine, double sine) {
  double x = 1, y = 0;
  for (int i = 0; i < 2 * n_cusps; ++i) {
    const int cusp = i / 2;
    if (i % 2 == 0)
      add_landmark(p, RIIS_LANDMARK_NADIR, 1.2 * x, 1.2 * y, 0, cusp, -1);
    else
      add_landmark(p, RIIS_LANDMARK_COMMISSURE, 1.2 * x, 1.2 * y, 1.6, cusp, (cusp + 1) % n_cusps);
    const double turned = cosine * x - sine * y;
    y = sine * x + cosine * y, x = turned;
  }
}

/* Adds twelve points of an annulus, some of which have roles. */
static void add_annulus(patient *p, const char *kind) {
  const int is_tricuspid = strcmp(kind, "tricuspid") == 0, is_rigid = strcmp(kind, "bileaflet") == 0;
  const double half_root = 0.8660254037844386, wide = is_rigid ? 1.2 : 1.9, deep = is_rigid ? 1.2 : 1.5;
  double x = 1, y = 0;
  for (int i = 0; i < 12; ++i) {
    int32_t role = RIIS_LANDMARK_ANNULUS, leaflet = -1, other = -1;
    if (is_tricuspid && i % 4 == 0) role = RIIS_LANDMARK_COMMISSURE, leaflet = 2 - i / 4, other = (leaflet + 2) % 3;
    if (!is_tricuspid && !is_rigid && i == 3) role = RIIS_LANDMARK_ANTERIOR_HORN;
    if (!is_tricuspid && !is_rigid && i == 9) role = RIIS_LANDMARK_POSTERIOR_HORN;
    add_landmark(p, role, wide * x, deep * y, is_rigid ? 0 : 0.2 * (y * y - x * x), leaflet, other);
    const double turned = half_root * x - 0.5 * y;
    y = 0.5 * x + half_root * y, x = turned;
  }
  if (is_rigid) add_landmark(p, RIIS_LANDMARK_HINGE, 0.15, 1.1, 0, -1, -1);
  if (is_rigid) add_landmark(p, RIIS_LANDMARK_HINGE, 0.15, -1.1, 0, -1, -1);
}

/* Turns and moves the landmarks, and shifts each at random by a millimetre. The flow is the turned z axis. */
static void put_into_patient(patient *p, double *flow) {
  double q[4], norm = 0;
  for (int i = 0; i < 4; ++i) q[i] = between(-1, 1), norm += q[i] * q[i];
  const double s = 2 / norm, w = q[0], x = q[1], y = q[2], z = q[3];
  const double turn[3][3] = {{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
                             {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
                             {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}};
  const double shift[3] = {between(-20, 20), between(-20, 20), between(-20, 20)};
  for (int i = 0; i < p->n; ++i) {
    double at[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = shift[k] + between(-0.1, 0.1);
      for (int j = 0; j < 3; ++j) at[k] += turn[k][j] * p->xyz[3 * i + j];
    }
    memcpy(p->xyz + 3 * i, at, sizeof at);
  }
  for (int k = 0; k < 3; ++k) flow[k] = turn[k][2];
}

static void add_placement(const char *kind, int32_t n_threads) {
  static const struct {
    const char *kind;
    int n_cusps;
    double cosine, sine;
  } cusps[] = {{"aortic", 3, 0.5, 0.8660254037844386},
               {"trileaflet", 3, 0.5, 0.8660254037844386},
               {"coapting", 3, 0.5, 0.8660254037844386},
               {"bicuspid", 2, 0, 1},
               {"quadricuspid", 4, 0.7071067811865476, 0.7071067811865476}};
  patient p = {0};
  for (size_t i = 0; i < sizeof cusps / sizeof *cusps; ++i)
    if (strcmp(kind, cusps[i].kind) == 0) add_cusps(&p, cusps[i].n_cusps, cusps[i].cosine, cusps[i].sine);
  if (p.n == 0) add_annulus(&p, kind);
  riis_landmarks landmarks;
  CHECK(riis_landmarks_init(&landmarks, sizeof landmarks));
  put_into_patient(&p, landmarks.flow);
  landmarks.n_landmarks = p.n;
  landmarks.x = p.xyz, landmarks.y = p.xyz + 1, landmarks.z = p.xyz + 2;
  landmarks.stride = 3;
  landmarks.role = p.role;
  landmarks.leaflet_id = p.leaflet_id;
  landmarks.scale = 1;
  double place[3 * most_landmarks];
  riis_placement_arrays arrays;
  CHECK(riis_placement_arrays_init(&arrays, sizeof arrays));
  arrays.place = place;
  riis_valve *valve = NULL;
  riis_placement placement;
  CHECK(riis_valve_create(kind, &valve));
  CHECK(riis_place(valve, &landmarks, "", &arrays, &placement, sizeof placement));
  add_doubles(place, 3 * p.n);
  add_doubles(placement.rotation_axis, 3);
  add_doubles(&placement.rotation_angle, 1);
  add_doubles(placement.translation, 3);
  add_doubles(&placement.rms, 1);
  int64_t n_parameters = 0;
  CHECK(riis_valve_get_n_parameters(valve, &n_parameters));
  for (int64_t i = 0; i < n_parameters; ++i) {
    riis_parameter parameter;
    double value[3] = {0, 0, 0};
    CHECK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    CHECK(riis_valve_get(valve, parameter.name, parameter.n_values, value));
    add_doubles(value, parameter.n_values);
  }
  riis_surface_options options;
  CHECK(riis_surface_options_init(&options, sizeof options));
  options.n_threads = n_threads;
  options.tolerance = 0.3;
  memcpy(options.rotation_axis, placement.rotation_axis, sizeof options.rotation_axis);
  options.rotation_angle = placement.rotation_angle;
  memcpy(options.translation, placement.translation, sizeof options.translation);
  riis_surface *surface = NULL;
  CHECK(riis_surface_create(valve, &options, &surface));
  add_triangles(surface);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

int main(int argc, char **argv) {
  const uint64_t start = UINT64_C(0xcbf29ce484222325);
  if (argc > 1 && strcmp(argv[1], "cosine") == 0) {
    digest = start;
    for (int i = 0; i < 100000; ++i) {
      const double value = cos(between(0, 3));
      add_doubles(&value, 1);
    }
    printf("%016" PRIx64 "\n", digest);
    return 0;
  }
  const int32_t n_threads = argc > 1 ? (int32_t)strtol(argv[1], NULL, 10) : 1;
  const int32_t instructions = argc > 2 ? (int32_t)strtol(argv[2], NULL, 10) : RIIS_INSTRUCTIONS_AUTO;
  uint64_t whole = start;
  for (int state = 0; state < n_states; ++state) {
    digest = start;
    add_state(state, n_threads, instructions);
    printf("%2d %-15s %016" PRIx64 "\n", state, kinds[state % n_kinds], digest);
    whole = (whole ^ digest) * UINT64_C(0x100000001b3);
  }
  for (int i = 0; i < n_placements; ++i) {
    digest = start;
    add_placement(kinds[i % n_kinds], n_threads);
    printf("%2d placed %-15s %016" PRIx64 "\n", i, kinds[i % n_kinds], digest);
    whole = (whole ^ digest) * UINT64_C(0x100000001b3);
  }
  printf("all                %016" PRIx64 "\n", whole);
  return 0;
}
