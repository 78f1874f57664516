/* SPDX-License-Identifier: Apache-2.0
 * Places mitral valves at annuli that differ from the valve's curves: ellipses, D shapes, saddles and annuli with an indent. Each
 * annulus has 8 to 24 points with noise, and any of the other landmarks. The placed valve must be as deep as the annulus, or the
 * landmarks must be refused. Makes 20 annuli, and 200 with RIIS_TEST_LONG=1. */
#include <riis/riis.h>

#include <stdbool.h>

#include "test_support.h"

#include "handles.h"

static random_source rng;
static double between(double low, double high) { return random_between(&rng, low, high); }
static double radians(double degrees) { return degrees * acos(-1.0) / 180; }
static double normal(void) { return sqrt(-2 * log(1 - between(0, 1))) * cos(radians(360 * between(0, 1))); }

/* The sizes of an annulus, in millimetres. The annulus is widest at y = 0. */
typedef struct shape {
  double front, back, half_width;
  double saddle, tilt; /* by saddle +- tilt, the horns are nearer to the atrium than the sides */
  double indent;       /* of the front */
  double power;        /* the exponent of the front: 2 for an ellipse, about 4 for a D */
} shape;

/* The point at an angle in degrees, counted from the side at x > 0. The anterior horn is at 90 degrees. */
static void point_at(const shape *s, double degrees, double p[3]) {
  const double x = cos(radians(degrees)), y = sin(radians(degrees)), power = y > 0 ? s->power : 2;
  const double sum = pow(fabs(x) / s->half_width, power) + pow(fabs(y) / (y > 0 ? s->front : s->back), power),
               r = pow(sum, -1 / power);
  const double from_horn = remainder(degrees - 90, 360) / 20;
  p[0] = r * x;
  p[1] = r * y - s->indent * exp(-from_horn * from_horn);
  p[2] = s->saddle * y * y + s->tilt * y;
}

static shape random_shape(void) {
  const double grown = between(0.8, 1.2);
  shape s = {grown * between(13, 16.5),
             grown * between(14, 18),
             grown * between(17.5, 21),
             grown * between(0, 7),
             grown * between(-1.5, 1.5),
             0,
             2};
  switch ((int)between(0, 4)) {
    case 1:
      s.power = between(2, 2.5);
      break;
    case 2:
      s.power = between(2.5, 4);
      break;
    case 3:
      s.power = between(2, 3), s.indent = grown * between(1, 4);
      break;
    default:
      break;
  }
  return s;
}

enum { most = 32 };
typedef struct marked {
  int n;
  double xyz[most][3];
  int32_t role[most];
} marked;

static void mark(marked *m, const shape *s, int32_t role, double degrees, double noise) {
  m->role[m->n] = role;
  point_at(s, degrees, m->xyz[m->n]);
  for (int k = 0; k < 3; ++k) m->xyz[m->n][k] += noise * normal();
  ++m->n;
}

/* Makes unevenly spaced points of the annulus in either direction, and the anterior horn. */
static marked marked_annulus(const shape *s, int n, double noise) {
  marked m = {0, {{0}}, {0}};
  const double phase = between(0, 1), unevenness = between(0, 0.4), turn = between(-1, 1) < 0 ? -360 : 360;
  for (int i = 0; i < n; ++i)
    mark(&m, s, RIIS_LANDMARK_ANNULUS, turn * (i + phase + unevenness * between(-0.5, 0.5)) / n, noise);
  mark(&m, s, RIIS_LANDMARK_ANTERIOR_HORN, 90, noise);
  return m;
}

static riis_status place(riis_valve *valve, const marked *m, riis_placement *placement) {
  riis_landmarks landmarks;
  CHECK_OK(riis_landmarks_init(&landmarks, sizeof landmarks));
  landmarks.n_landmarks = m->n;
  landmarks.x = m->xyz[0], landmarks.y = m->xyz[0] + 1, landmarks.z = m->xyz[0] + 2;
  landmarks.stride = 3;
  landmarks.role = m->role;
  landmarks.scale = 10;
  landmarks.flow[2] = -1;
  return riis_place(valve, &landmarks, "", NULL, placement, sizeof *placement);
}

static double depth_of(const riis_valve *valve) {
  double depth;
  CHECK_OK(riis_valve_get(valve, "AP_diameter", 1, &depth));
  return 10 * depth;
}

static double true_depth(const shape *s) {
  double anterior[3], posterior[3];
  point_at(s, 90, anterior), point_at(s, 270, posterior);
  return anterior[1] - posterior[1];
}

/* The angle in degrees between the placed valve's axis and z, by Rodrigues' formula. */
static double lean_of(const riis_placement *at) {
  const double z = at->rotation_axis[2], cosine = cos(radians(at->rotation_angle));
  return acos(fmin(1, cosine + (1 - cosine) * z * z)) * 180 / acos(-1.0);
}

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

TEST(annuli_are_fitted_or_refused) {
  /* For the annuli of the following seeds, a fit with a single start ends at a wrong inclination. */
  static const uint64_t with_two_minima[] = {8067555987785431393u, 5133953779223791632u, 940912489951417561u};
  enum { n_known = sizeof with_two_minima / sizeof *with_two_minima, most_trials = 200 + n_known };
  const int n = is_long_test() ? most_trials : 20 + n_known;
  static double errors[most_trials], leans[most_trials];
  int n_accepted = 0, n_behind = 0;
  for (int trial = 0; trial < n; ++trial) {
    if (trial >= n - n_known) rng.state = with_two_minima[n - 1 - trial];
    const unsigned long long seed = rng.state;
    const shape s = random_shape();
    marked m = marked_annulus(&s, (int)between(8, 25), 0.3);
    const double trigones = between(26, 44), aside = between(-4, 4), commissures = between(-12, 12);
    const uint64_t names = random_bits(&rng);
    if (names & 1) mark(&m, &s, RIIS_LANDMARK_POSTERIOR_HORN, 270, 0.3);
    if (names & 2) mark(&m, &s, RIIS_LANDMARK_TRIGONE, 90 - trigones + aside, 0.3);
    if (names & 4) mark(&m, &s, RIIS_LANDMARK_TRIGONE, 90 + trigones + aside, 0.3);
    if (names & 8) mark(&m, &s, RIIS_LANDMARK_POSTEROMEDIAL, commissures, 0.3);
    if (names & 16) mark(&m, &s, RIIS_LANDMARK_ANTEROLATERAL, 180 - commissures, 0.3);
    riis_valve *valve = new_valve("mitral");
    riis_placement placement;
    const riis_status status = place(valve, &m, &placement);
    if (status == RIIS_OK) {
      const double error = fabs(depth_of(valve) - true_depth(&s)), lean = lean_of(&placement);
      if (!(error <= 2 && lean <= 30))
        fail_msg("RIIS_TEST_SEED=%llu: depth %.2f for %.2f mm, axis off by %.1f degrees", seed, depth_of(valve),
                 true_depth(&s), lean);
      n_behind += placement.n_as_annulus > 0;
      errors[n_accepted] = error, leans[n_accepted++] = lean;
    } else {
      print_message("seed %llu: %s\n", seed, riis_last_error());
      assert_int_equal(status, RIIS_INVALID_ARGUMENT);
    }
    free_owned_after(0);
  }
  qsort(errors, (size_t)n_accepted, sizeof *errors, compare), qsort(leans, (size_t)n_accepted, sizeof *leans, compare);
  if (n_accepted < 0.9 * n) fail_msg("only %d of %d annuli are accepted", n_accepted, n);
  print_message(
      "%d of %d annuli accepted, %d with trigones behind the horn; depth off by %.2f mm in the median, %.2f in 9 "
      "of 10, %.2f at most; axis by %.1f, %.1f, %.1f degrees\n",
      n_accepted, n, n_behind, errors[n_accepted / 2], errors[9 * n_accepted / 10], errors[n_accepted - 1],
      leans[n_accepted / 2], leans[9 * n_accepted / 10], leans[n_accepted - 1]);
}

/* On an ellipse, wide trigones lie behind the horn. Next to an indent, trigones lie in front of the horn. */
TEST(trigones_behind_the_horn_are_counted) {
  for (int is_indented = 0; is_indented < 2; ++is_indented) {
    const shape s = {14.5, 16.2, 19, 5.5, 1.2, is_indented ? 4 : 0, is_indented ? 3 : 2};
    for (int n_trigones = 0; n_trigones <= 2; ++n_trigones) {
      marked m = marked_annulus(&s, 16, 0);
      for (int i = 0; i < n_trigones; ++i) mark(&m, &s, RIIS_LANDMARK_TRIGONE, i ? 132 : 48, 0);
      riis_valve *valve = new_valve("mitral");
      riis_placement placement;
      CHECK_OK(place(valve, &m, &placement));
      assert_int_equal(placement.n_as_annulus, is_indented ? 0 : n_trigones);
      CHECK_NEAR(depth_of(valve), true_depth(&s), 1);
    }
  }
}

TEST(contradictions_are_refused) {
  const shape s = {14.5, 16.2, 19, 5.5, 1.2, 0, 3};
  const marked good = marked_annulus(&s, 16, 0);
#define REFUSED(words, ...)                                                    \
  do {                                                                         \
    marked m = good;                                                           \
    __VA_ARGS__;                                                               \
    riis_valve *valve = new_valve("mitral");                                   \
    riis_placement placement;                                                  \
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, words, place(valve, &m, &placement)); \
  } while (0)
  REFUSED("landmark 17 (posterior_horn) is |behind landmark 16 (anterior_horn)|must be on the posterior side",
          mark(&m, &s, RIIS_LANDMARK_POSTERIOR_HORN, 100, 0));
  /* The anterior horn is given at the posterior point, which is wrong. */
  REFUSED("landmark 17 (trigone) is |must be on the anterior side|anterior horn is in the wrong place",
          (--m.n, mark(&m, &s, RIIS_LANDMARK_ANTERIOR_HORN, 270, 0), mark(&m, &s, RIIS_LANDMARK_TRIGONE, 50, 0)));
  REFUSED("AP_diameter of the fitted valve is |but the horns are |apart, seen along the annulus' normal|worst residual",
          (mark(&m, &s, RIIS_LANDMARK_POSTERIOR_HORN, 270, 0), m.xyz[17][1] += 9));
  /* One horn lies far above the annulus, or one horn lies far above and the other horn far below the annulus. The largest
   * residual is then near the horn. */
  REFUSED(
      "the axis of the fitted valve is at |degrees to the annulus' normal; it must be at most 20; the horns' heights "
      "make the valve lean: landmark 16 (anterior_horn) is |above and landmark |the annulus' sides|misplaced horn",
      m.xyz[16][2] += 25);
  REFUSED(
      "the horns' heights make the valve lean: landmark 16 (anterior_horn) is |above and landmark 17 (posterior_horn) "
      "is "
      "|below",
      (m.xyz[16][2] += 18, mark(&m, &s, RIIS_LANDMARK_POSTERIOR_HORN, 270, 0), m.xyz[17][2] -= 18));
  /* All points but the horns are far from the annulus. */
  REFUSED("must be at most |the worst residual is ", (m.xyz[1][2] += 20, m.xyz[2][2] += 20, m.xyz[3][2] += 20));
#undef REFUSED
}

int main(void) {
  rng = random_start("test_annuli");
  return run_cases(NULL, NULL);
}
