/* SPDX-License-Identifier: Apache-2.0
 * Tests skirts of random patients. Landmarks with noise lie on a root whose cusps differ. These landmarks place and warp a valve,
 * and its skirt leads to the wall of the root. RIIS_TEST_LONG=1 takes 100 patients at 11 openings instead of 4 patients at 3
 * openings. One additional patient is the same in every run. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "skirt_checks.h"

static random_source rng;
static double between(double low, double high) { return random_between(&rng, low, high); }
static double normal(void) { return sqrt(-2 * log(1 - between(0, 1))) * cos(2 * acos(-1) * between(0, 1)); }

/* A root in centimetres, with the flow along z. Angles are in degrees. Cusp i lies between the commissures i - 1 and i. */
typedef struct root {
  double angle[3], top[3], nadir[3]; /* of the commissures, and heights */
  double half_axis[2], direction;    /* the annulus is an ellipse */
  double junction_radius, junction_height;
  double gap; /* between the attachment and the wall */
  double turn[3][3], shift[3];
} root;

enum { n_attachment = 18, n_landmarks = 6 + n_attachment, n_round = 132, n_high = 60 };

static double radians(double degrees) { return degrees * acos(-1) / 180; }

/* From this state of the generator, random numbers make an aortic patient with a special plane along the axis. The plane passes
 * through the ends of two cusps, and one cusp's attachment leans across it. Skirts on both sides of the plane would cross. */
static const uint64_t state_of_leaning_patient = 3451592321834770229u;

static root random_root(int is_wide) {
  root made;
  double sector[3], sum = 0, axis[3], size = 0;
  for (int i = 0; i < 3; ++i) sector[i] = 120 + between(-18, 18), sum += sector[i];
  for (int i = 0; i < 3; ++i) sector[i] *= 360 / sum;
  const double height = between(1.55, 1.8), radius = between(1.15, 1.35), ratio = between(1, 1.25);
  made.angle[0] = 0.5 * sector[0], made.angle[1] = made.angle[0] + sector[1], made.angle[2] = 360 - made.angle[0];
  for (int i = 0; i < 3; ++i) made.top[i] = height + between(-0.15, 0.15), made.nadir[i] = between(-0.08, 0.08);
  made.half_axis[0] = radius * sqrt(ratio), made.half_axis[1] = radius / sqrt(ratio), made.direction = between(0, 180);
  made.junction_radius = radius * between(1, 1.12), made.junction_height = height + between(0.3, 0.5);
  made.gap = is_wide ? between(0.15, 0.3) : between(-0.05, 0.1);
  for (int c = 0; c < 3; ++c) axis[c] = normal(), size += axis[c] * axis[c], made.shift[c] = between(-100, 100);
  for (int c = 0; c < 3; ++c) axis[c] /= sqrt(size);
  const double angle = between(-3, 3), s = sin(angle), v = 1 - cos(angle);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int k = 3 - i - j;
      const double across = i == j ? 0 : ((j - i + 3) % 3 == 1 ? -s : s) * axis[k];
      made.turn[i][j] = (i == j ? cos(angle) : 0) + v * axis[i] * axis[j] + across;
    }
  return made;
}

static double smooth_step(double x) {
  x = fmin(fmax(x, 0), 1);
  return x * x * (3 - 2 * x);
}

static double radius_at(const root *of, double degrees, double z) {
  const double angle = radians(degrees - of->direction), a = of->half_axis[0], b = of->half_axis[1];
  const double up = smooth_step(z / of->junction_height);
  return (1 - up) * a * b / hypot(b * cos(angle), a * sin(angle)) + up * of->junction_radius;
}

/* Writes a point in millimetres. */
static void put(const root *of, double degrees, double r, double z, double *at) {
  const double p[3] = {r * cos(radians(degrees)), r * sin(radians(degrees)), z};
  for (int c = 0; c < 3; ++c)
    at[c] = 10 * (of->turn[c][0] * p[0] + of->turn[c][1] * p[1] + of->turn[c][2] * p[2]) + of->shift[c];
}

/* The point of a cusp's attachment at a place from -1 to 1. The commissures are at -1 and 1. */
static void on_attachment(const root *of, int cusp, double place, double *at) {
  const double first = of->angle[(cusp + 2) % 3] - (cusp == 0 ? 360 : 0), last = of->angle[cusp];
  const double degrees = first + 0.5 * (place + 1) * (last - first);
  const double top = of->top[place > 0 ? cusp : (cusp + 2) % 3];
  const double z = of->nadir[cusp] + (top - of->nadir[cusp]) * (1 - pow(1 - place * place, 0.6));
  put(of, degrees, radius_at(of, degrees, z), z, at);
}

typedef struct marks {
  double xyz[n_landmarks][3];
  int32_t role[n_landmarks], leaflet_id[n_landmarks][2];
} marks;

static marks random_marks(const root *of, double noise) {
  marks made;
  static const double places[3] = {0.45, 0.75, 0.93};
  int n = 0;
  for (int cusp = 0; cusp < 3; ++cusp) {
    const double tops[2] = {0, 1};
    for (int k = 0; k < 2; ++k, ++n) {
      on_attachment(of, cusp, tops[k], made.xyz[n]);
      made.role[n] = k == 0 ? RIIS_LANDMARK_NADIR : RIIS_LANDMARK_COMMISSURE;
      made.leaflet_id[n][0] = cusp, made.leaflet_id[n][1] = k == 0 ? -1 : (cusp + 1) % 3;
    }
    for (int k = 0; k < 6; ++k, ++n) {
      on_attachment(of, cusp, k % 2 ? places[k / 2] : -places[k / 2], made.xyz[n]);
      made.role[n] = RIIS_LANDMARK_ATTACHMENT;
      made.leaflet_id[n][0] = cusp, made.leaflet_id[n][1] = -1;
    }
  }
  assert_int_equal(n, n_landmarks);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) made.xyz[i][c] += noise * normal();
  return made;
}

/* The wall has waves like a wall from a segmentation. */
static riis_surface *wall_of(const root *of, double margin) {
  static double xyz[n_round * n_high][3];
  static int32_t ids[2 * n_round * (n_high - 1)][3];
  const double phase[2] = {between(0, 360), between(0, 360)};
  int64_t n = 0;
  for (int j = 0; j < n_high; ++j)
    for (int i = 0; i < n_round; ++i) {
      const double degrees = 360.0 * i / n_round, z = -1.4 + 4.4 * j / (n_high - 1);
      const double waves =
          0.01 * (sin(radians(5 * degrees + phase[0])) + sin(radians(3 * degrees + 100 * z + phase[1])));
      put(of, degrees, radius_at(of, degrees, z) + waves + of->gap + margin, z, xyz[j * n_round + i]);
      if (j + 1 == n_high) continue;
      const int32_t a = j * n_round + i, b = j * n_round + (i + 1) % n_round;
      const int32_t two[2][3] = {{a, b, b + n_round}, {a, b + n_round, a + n_round}};
      memcpy(ids[n], two, sizeof two), n += 2;
    }
  const riis_surface_arrays arrays = triangle_arrays(n_round * n_high, xyz[0], n, ids[0]);
  return surface_from(&arrays, NULL);
}

/* Warps a valve from its own landmarks to targets. The noise determines the smoothing. */
static void warp_valve(riis_valve *valve, int64_t n, const double *from, const double *to, double noise,
                       const riis_surface_options *placement) {
  riis_warp_options options;
  CHECK_OK(riis_warp_options_init(&options, sizeof options));
  options.noise = noise;
  options.placement = placement;
  const riis_points sources = points_at(n, from), targets = points_at(n, to);
  riis_warp *warp = NULL;
  CHECK_OK(riis_warp_create(&sources, &options, &warp));
  own(warp);
  CHECK_OK(riis_warp_set_targets(warp, &targets));
  CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
}

static riis_surface_options place_by(riis_valve *valve, const marks *of, double noise) {
  riis_landmarks landmarks;
  CHECK_OK(riis_landmarks_init(&landmarks, sizeof landmarks));
  landmarks.n_landmarks = n_landmarks, landmarks.stride = 3;
  landmarks.x = of->xyz[0], landmarks.y = of->xyz[0] + 1, landmarks.z = of->xyz[0] + 2;
  landmarks.role = of->role, landmarks.leaflet_id = of->leaflet_id[0];
  landmarks.scale = 10, landmarks.noise = noise;
  double places[n_landmarks][3];
  riis_placement_arrays arrays;
  CHECK_OK(riis_placement_arrays_init(&arrays, sizeof arrays));
  arrays.place = places[0];
  riis_placement placement;
  CHECK_OK(riis_place(valve, &landmarks, "", &arrays, &placement, sizeof placement));
  riis_surface_options options = surface_options();
  options.scale = placement.scale, options.rotation_angle = placement.rotation_angle;
  memcpy(options.rotation_axis, placement.rotation_axis, sizeof options.rotation_axis);
  memcpy(options.translation, placement.translation, sizeof options.translation);
  warp_valve(valve, n_landmarks, places[0], of->xyz[0], noise, &options);
  return options;
}

/* A mitral annulus in a round wall. Noise alone changes its shape. */
static riis_surface *mitral_patient(riis_valve *valve, riis_surface_options *options, int is_wide, double noise) {
  options->scale = 10;
  for (int c = 0; c < 3; ++c) options->translation[c] = between(-100, 100);
  riis_attachment held;
  CHECK_OK(riis_surface_get_attachment(new_surface(valve, options), &held, sizeof held));
  double from[16][3], to[16][3], largest = 0;
  for (int i = 0; i < 16; ++i) {
    memcpy(from[i], held.edges + 6 * (i * held.n_edges / 16), sizeof from[i]);
    for (int c = 0; c < 3; ++c) to[i][c] = from[i][c] + noise * normal();
  }
  root round = random_root(is_wide);
  for (int64_t i = 0; i < held.n_edges; ++i)
    largest = fmax(largest, 0.1 * hypot(held.edges[6 * i] - options->translation[0],
                                        held.edges[6 * i + 1] - options->translation[1]));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) round.turn[i][k] = i == k;
  memcpy(round.shift, options->translation, sizeof round.shift);
  round.half_axis[0] = round.half_axis[1] = round.junction_radius = largest;
  riis_surface *wall = wall_of(&round, 0);
  warp_valve(valve, 16, from[0], to[0], noise, options);
  return wall;
}

TEST(skirts_of_patients_reach_the_wall) {
  static const char *const kinds[4] = {"coapting", "trileaflet", "aortic", "mitral"};
  const int n_trials = trials(4, 100);
  int n_states = 0, n_with_leaflets = 0, n_folded = 0;
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  own(crossings);
  double worst_reach = 0;
  for (int trial = 0; trial <= n_trials; ++trial) {
    const int is_leaning = trial == n_trials;
    const int owned_before = n_owned(), kind = is_leaning ? 2 : trial % 4, is_wide = is_leaning || trial / 4 % 2 == 0;
    if (is_leaning) rng.state = state_of_leaning_patient;
    const double noise = 0.3;
    riis_valve *valve = new_valve(kinds[kind]);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    riis_surface_options options = surface_options();
    const riis_surface *wall;
    if (kind == 3) {
      wall = mitral_patient(valve, &options, is_wide, noise);
    } else {
      const root of = random_root(is_wide);
      const marks landmarks = random_marks(&of, noise);
      options = place_by(valve, &landmarks, noise);
      wall = wall_of(&of, 0);
    }
    riis_valve *bare = NULL;
    CHECK_OK(riis_valve_copy(valve, &bare));
    own(bare);
    riis_gap gap;
    CHECK_OK(riis_surface_get_gap(new_surface(bare, &options), wall, NULL, &gap, sizeof gap));
    CHECK_OK(riis_valve_set_skirt_to_wall(valve, wall, 25, &options));
    for (int i = 0; i <= 10; i += is_long_test() ? 1 : is_short_test() ? 10 : 5)
      for (int is_fixed = 0; is_fixed < 2; ++is_fixed) {
        if (!is_long_test() && is_fixed != (trial + i) % 2) continue;
        const int owned_in_trial = n_owned();
        options.triangulation = is_fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
        CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.1 * i));
        CHECK_OK(riis_valve_set_scalar(bare, "opening", 0.1 * i));
        /* A warp by noisy landmarks may fold at an opening. The call is then refused, and makes no skirt. */
        riis_surface *surface = NULL;
        if (riis_surface_create(valve, &options, &surface) != RIIS_OK) {
          if (!strstr(riis_last_error(), "warp")) fail_msg("patient %d: %s", trial, riis_last_error());
          ++n_folded;
          free_owned_after(owned_in_trial);
          continue;
        }
        own(surface);
        const pair_counts counts = crossings_of(surface, crossings);
        n_with_leaflets += counts.of_leaflets > 0;
        ++n_states;
        if (counts.of_skirt + counts.of_own > 0)
          fail_msg("patient %d, %s, opening %g, %s: %d pairs with the skirt cross, and %d without", trial, kinds[kind],
                   0.1 * i, is_fixed ? "fixed" : "adapted", (int)(counts.of_skirt + counts.of_own),
                   (int)counts.of_leaflets);
        if (!is_fixed) {
          riis_orifice with, without;
          CHECK_OK(riis_surface_get_orifice(surface, NULL, &with, sizeof with));
          CHECK_OK(riis_surface_get_orifice(new_surface(bare, &options), NULL, &without, sizeof without));
          assert_memory_equal(&with, &without, sizeof with);
        }
        if (i == 0 && gap.least > 0.2) {
          const riis_triangles all = triangles_of(surface);
          double worst = 0;
          for (int64_t t = 0; t < all.n_triangles; ++t)
            for (int k = 0; k < 3 && all.leaflet_id[t] == RIIS_LEAFLET_SKIRT; ++k) {
              const int64_t id = all.vertex_id[3 * t + k];
              const double *p = all.xyz + 3 * id;
              if (all.uv[2 * id + 1] == 0) worst = fmax(worst, closest_to(wall, p[0], p[1], p[2]).distance);
            }
          const double allowed = info_of(surface).error_bound + 0.05 * gap.most;
          printf("patient %d, %s: gap %.2f to %.2f mm, the skirt ends within %.3f of the wall\n", trial, kinds[kind],
                 gap.least, gap.most, worst);
          CHECK_AT_MOST(worst, allowed);
          worst_reach = fmax(worst_reach, worst);
        }
        free_owned_after(owned_in_trial);
      }
    free_owned_after(owned_before);
  }
  printf(
      "no skirt crosses in %d states; leaflets touch or cross in %d of them; %d other states are refused, because the "
      "warp folds\n",
      n_states, n_with_leaflets, n_folded);
  assert_true(n_states > 5 * n_folded);
  assert_true(worst_reach > 0);
}

static int start(void **state) {
  (void)state;
  rng = random_start("test_skirt_patients");
  return 0;
}

int main(void) { return run_cases(start, NULL); }
