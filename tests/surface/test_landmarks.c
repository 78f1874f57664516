/* SPDX-License-Identifier: Apache-2.0
 * Tests riis_place. Landmarks are made from known sizes by closed forms or by the oracle of the mitral valve. The landmarks are
 * then placed and disturbed at random. The fit must recover these sizes, and the noise must explain the errors. Exact landmarks
 * lie on the surface of the placed valve. Prints the table that docs/theory/landmarks.md summarises. */
#include <riis/riis.h>

#include <stdbool.h>

#include "test_support.h"

#include "handles.h"
#include "mitral_oracle.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }
static double sine(double degrees) { return sin(degrees * acos(-1.0) / 180); }
static double cosine(double degrees) { return cos(degrees * acos(-1.0) / 180); }

/* A number from the normal distribution, by Box and Muller. */
static double normal(void) { return sqrt(-2 * log(1 - between(0, 1))) * cosine(360 * between(0, 1)); }

enum { most = 64, most_parameters = 128 };

/* The landmarks are first in the valve's frame in centimetres, and later in the form that riis_place takes. */
typedef struct patient {
  int n;
  double xyz[most][3];
  int32_t role[most], leaflet_id[most][2];
  double scale, noise, flow[3];
  double rotation[3][3], shift[3]; /* rows of the rotation; the shift is in mesh units */
} patient;

typedef struct answer {
  riis_placement placement;
  double residual[most], standard_error[most_parameters], place[most][3];
  int32_t state[most_parameters];
} answer;

static void add(patient *p, int32_t role, double x, double y, double z) {
  p->role[p->n] = role;
  p->leaflet_id[p->n][0] = p->leaflet_id[p->n][1] = -1;
  p->xyz[p->n][0] = x, p->xyz[p->n][1] = y, p->xyz[p->n][2] = z;
  ++p->n;
}
static void add_around(patient *p, int32_t role, double radius, double degrees, double z) {
  add(p, role, radius * cosine(degrees), radius * sine(degrees), z);
}

static patient empty_patient(void) {
  const patient none = {0, {{0}}, {0}, {{0}}, 1, RIIS_AUTO, {0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
  return none;
}

/* Turns, scales and moves the landmarks at random. */
static void place_patient(patient *p, double scale) {
  double q[4], norm = 0;
  for (int i = 0; i < 4; ++i) q[i] = normal();
  for (int i = 0; i < 4; ++i) norm += q[i] * q[i];
  const double s = 2 / norm, w = q[0], x = q[1], y = q[2], z = q[3];
  const double turn[3][3] = {{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
                             {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)},
                             {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)}};
  memcpy(p->rotation, turn, sizeof turn);
  p->scale = scale;
  for (int k = 0; k < 3; ++k) p->shift[k] = scale * between(-20, 20);
  for (int i = 0; i < p->n; ++i) {
    double at[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = p->shift[k];
      for (int j = 0; j < 3; ++j) at[k] += scale * turn[k][j] * p->xyz[i][j];
    }
    memcpy(p->xyz[i], at, sizeof at);
  }
  for (int k = 0; k < 3; ++k) p->flow[k] *= scale;
  double flow[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) flow[k] += turn[k][j] * p->flow[j];
  memcpy(p->flow, flow, sizeof flow);
}

static void disturb(patient *p, double noise) {
  for (int i = 0; i < p->n; ++i)
    for (int k = 0; k < 3; ++k) p->xyz[i][k] += noise * normal();
}

/* Puts the landmarks into a random order. */
static void shuffle(patient *p) {
  for (int i = p->n - 1; i > 0; --i) {
    const int j = (int)(random_bits(&rng) % (uint64_t)(i + 1));
    double point[3];
    int32_t ids[2];
    memcpy(point, p->xyz[i], sizeof point), memcpy(p->xyz[i], p->xyz[j], sizeof point),
        memcpy(p->xyz[j], point, sizeof point);
    memcpy(ids, p->leaflet_id[i], sizeof ids), memcpy(p->leaflet_id[i], p->leaflet_id[j], sizeof ids);
    memcpy(p->leaflet_id[j], ids, sizeof ids);
    const int32_t role = p->role[i];
    p->role[i] = p->role[j], p->role[j] = role;
  }
}

static riis_landmarks landmarks_of(const patient *p) {
  riis_landmarks made;
  CHECK_OK(riis_landmarks_init(&made, sizeof made));
  made.n_landmarks = p->n;
  made.x = p->xyz[0], made.y = p->xyz[0] + 1, made.z = p->xyz[0] + 2;
  made.stride = 3;
  made.role = p->role;
  made.leaflet_id = p->leaflet_id[0];
  made.scale = p->scale;
  made.noise = p->noise;
  memcpy(made.flow, p->flow, sizeof made.flow);
  return made;
}

static riis_status try_to_place(riis_valve *valve, const patient *p, const char *held, answer *to) {
  const riis_landmarks landmarks = landmarks_of(p);
  memset(to, 0x5a, sizeof *to);
  riis_placement_arrays arrays;
  CHECK_OK(riis_placement_arrays_init(&arrays, sizeof arrays));
  arrays.residual = to->residual;
  arrays.standard_error = to->standard_error;
  arrays.size_state = to->state;
  arrays.place = to->place[0];
  return riis_place(valve, &landmarks, held, &arrays, &to->placement, sizeof to->placement);
}
static answer place(riis_valve *valve, const patient *p) {
  answer made;
  CHECK_OK(try_to_place(valve, p, "", &made));
  return made;
}

static double value(const riis_valve *valve, const char *name) {
  double found;
  CHECK_OK(riis_valve_get(valve, name, 1, &found));
  return found;
}
static int position(const riis_valve *valve, const char *name) {
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  for (int i = 0; i < n; ++i) {
    riis_parameter parameter;
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    if (strcmp(parameter.name, name) == 0) return i;
  }
  fail_msg("no parameter %s", name);
  return 0;
}

static riis_surface *placed_surface(const riis_valve *valve, const riis_placement *at) {
  riis_surface_options options = surface_options();
  options.scale = at->scale;
  memcpy(options.rotation_axis, at->rotation_axis, sizeof options.rotation_axis);
  options.rotation_angle = at->rotation_angle;
  memcpy(options.translation, at->translation, sizeof options.translation);
  return new_surface(valve, &options);
}

/* Checks that exact landmarks lie on the surface of the placed valve. */
static void check_on_surface(const riis_valve *valve, const patient *p, const answer *found, double tolerance) {
  const riis_surface *surface = placed_surface(valve, &found->placement);
  for (int i = 0; i < p->n; ++i) {
    riis_closest closest;
    CHECK_OK(riis_closest_point(surface, p->xyz[i], &closest, sizeof closest));
    CHECK_AT_MOST(closest.distance, tolerance * p->scale);
  }
}

static const double scales[3] = {0.01, 1, 10};

/* ---- Trileaflet ---- */

static patient trileaflet(double R, double Rc, double h) {
  patient p = empty_patient();
  for (int cusp = 0; cusp < 3; ++cusp) {
    add_around(&p, RIIS_LANDMARK_NADIR, R, 120 * cusp, 0);
    add_around(&p, RIIS_LANDMARK_COMMISSURE, Rc, 120 * cusp + 60, h);
  }
  return p;
}

TEST(test_exact_trileaflet) {
  for (int trial = 0; trial < trials_of(180); ++trial) {
    const double R = between(0.7, 1.6), Rc = between(0.7, 1.5), h = between(0.8, 2.2);
    patient p = trileaflet(R, Rc, h);
    if (trial % 3 == 0) add(&p, RIIS_LANDMARK_COAPTATION, 0, 0, between(0.2, 0.8) * h);
    const bool has_names = trial % 2 == 0;
    for (int i = 0; has_names && i < 6; ++i) {
      p.leaflet_id[i][0] = i / 2;
      if (i % 2 == 1) p.leaflet_id[i][1] = (i / 2 + 1) % 3;
    }
    place_patient(&p, scales[trial % 3]);
    shuffle(&p);
    riis_valve *valve = new_valve("trileaflet");
    const answer found = place(valve, &p);
    CHECK_NEAR(value(valve, "root_radius"), R, 1e-9);
    CHECK_NEAR(value(valve, "leaflet_radius_out"), Rc, 1e-9);
    CHECK_NEAR(value(valve, "leaflet_height"), h, 1e-9);
    CHECK_AT_MOST(found.placement.worst, 1e-9 * p.scale);
    assert_int_equal(found.placement.n_undetermined, 0);
    /* Sizes that follow others keep the proportions of the default valve, whose cusps do not cross. */
    CHECK_NEAR(value(valve, "bending_height"), 0.5 * h, 1e-9);
    CHECK_NEAR(value(valve, "bending_radius_in"), 0.32 * R, 1e-9);
    CHECK_NEAR(value(valve, "bending_radius_out"), 1.02 * (R + Rc) / 2, 1e-9);
    CHECK_NEAR(value(valve, "t0_bending"), 0.2 * R, 1e-9);
    CHECK_NEAR(value(valve, "t3_bending"), 0.2 * R, 1e-9);
    CHECK_NEAR(value(valve, "bending_angle"), 35, 0);
    assert_int_equal(found.state[position(valve, "root_radius")], RIIS_SIZE_DETERMINED);
    assert_int_equal(found.state[position(valve, "bending_height")], RIIS_SIZE_TIED);
    assert_true(isinf(found.standard_error[position(valve, "bending_height")]));
    assert_int_equal(found.state[position(valve, "xq")], RIIS_SIZE_KEPT);
    CHECK_NEAR(found.standard_error[position(valve, "xq")], 0, 0);
    /* Each radius is the mean of three distances, and the height is the difference of two means. */
    const double noise = 0.03;
    CHECK_NEAR(found.placement.noise, noise * p.scale, 1e-12 * p.scale);
    CHECK_NEAR(found.standard_error[position(valve, "root_radius")], noise / sqrt(3), 1e-6);
    CHECK_NEAR(found.standard_error[position(valve, "leaflet_height")], noise * sqrt(2.0 / 3), 1e-6);
    if (trial % 3 != 0) check_on_surface(valve, &p, &found, 0.01);
    /* Leaflet 0 is the cusp of the first nadir, or of the nadir with the name "right". */
    int first = 0;
    while (p.role[first] != RIIS_LANDMARK_NADIR || (has_names && p.leaflet_id[first][0] != 0)) ++first;
    riis_closest closest;
    double raised[3];
    const riis_surface *surface = placed_surface(valve, &found.placement);
    for (int k = 0; k < 3; ++k) raised[k] = p.xyz[first][k] + 0.05 * p.scale * p.rotation[k][2];
    CHECK_OK(riis_closest_point(surface, raised, &closest, sizeof closest));
    assert_int_equal(closest.leaflet_id, 0);
  }
}

/* A coapting valve has the same landmarks. The valve's further sizes still follow from the fitted sizes. */
TEST(test_exact_coapting) {
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const double R = between(1, 1.4), Rc = R * between(0.95, 1.05), h = 1.4 * Rc * between(0.97, 1.05);
    patient p = trileaflet(R, Rc, h);
    place_patient(&p, scales[trial % 3]);
    shuffle(&p);
    riis_valve *valve = new_valve("coapting");
    const answer found = place(valve, &p);
    CHECK_NEAR(value(valve, "root_radius"), R, 1e-9);
    CHECK_NEAR(value(valve, "commissure_radius"), Rc, 1e-9);
    CHECK_NEAR(value(valve, "commissure_height"), h, 1e-9);
    CHECK_NEAR(value(valve, "coaptation_height"), 0.3 * Rc, 1e-9);
    CHECK_NEAR(value(valve, "gap"), 0.016 * Rc, 1e-9);
    CHECK_AT_MOST(found.placement.worst, 1e-9 * p.scale);
    assert_int_equal(found.placement.n_undetermined, 0);
    assert_int_equal(found.state[position(valve, "gap")], RIIS_SIZE_TIED);
    int32_t is_set = -1;
    CHECK_OK(riis_valve_is_set(valve, "gap", &is_set));
    assert_int_equal(is_set, 0);
    check_on_surface(valve, &p, &found, 0.01);
  }
}

/* Measures the accuracy for a population of patients. Errors are in millimetres. */
typedef struct accuracy {
  double size[3], rms, worst, axis, covered;
} accuracy;

static accuracy accuracy_of(double noise, bool is_asymmetric, int n) {
  static const char *const names[3] = {"root_radius", "leaflet_radius_out", "leaflet_height"};
  static const double angles[3][3] = {{60, 160, 290}, {60, 190, 320}, {60, 190, 290}};
  accuracy sum = {{0, 0, 0}, 0, 0, 0, 0};
  for (int trial = 0; trial < n; ++trial) {
    const double truth[3] = {between(0.9, 1.5), between(0.8, 1.4), between(1.0, 2.2)};
    patient p = trileaflet(truth[0], truth[1], truth[2]);
    if (is_asymmetric) {
      /* The commissures are 100, 130 and 130 degrees apart, and the nadirs lie between them. Heights differ by 1.5 mm. */
      const double *at = angles[trial % 3];
      p.n = 0;
      for (int i = 0; i < 3; ++i) {
        const double before = i == 0 ? at[2] - 360 : at[i - 1];
        add_around(&p, RIIS_LANDMARK_NADIR, truth[0], (before + at[i]) / 2, 0);
        add_around(&p, RIIS_LANDMARK_COMMISSURE, truth[1], at[i], truth[2] + 0.15 * (i - 1));
      }
    }
    place_patient(&p, 10);
    disturb(&p, noise);
    riis_valve *valve = new_valve("trileaflet");
    const answer found = place(valve, &p);
    for (int k = 0; k < 3; ++k) {
      const double error = value(valve, names[k]) - truth[k];
      sum.size[k] += 100 * error * error / n;
      sum.covered += (fabs(error) <= 3 * found.standard_error[position(valve, names[k])]) / (3.0 * n);
    }
    sum.rms += found.placement.rms * found.placement.rms / n;
    if (found.placement.worst > sum.worst) sum.worst = found.placement.worst;
    /* The axis is the z column of the rotation, by Rodrigues' formula. */
    const double *a = found.placement.rotation_axis, s = sine(found.placement.rotation_angle),
                 c = cosine(found.placement.rotation_angle);
    const double z[3] = {s * a[1] + (1 - c) * a[0] * a[2], -s * a[0] + (1 - c) * a[1] * a[2],
                         c + (1 - c) * a[2] * a[2]};
    double along = 0;
    for (int k = 0; k < 3; ++k) along += z[k] * p.rotation[k][2];
    sum.axis += acos(fmin(1, along)) * 180 / acos(-1.0) / n;
    free_owned_after(0);
  }
  for (int k = 0; k < 3; ++k) sum.size[k] = sqrt(sum.size[k]);
  sum.rms = sqrt(sum.rms);
  return sum;
}

/* The table of measured accuracies. Each entry must be reproduced within 20 %. */
TEST(test_noisy_trileaflet) {
  const struct {
    double noise;
    bool is_asymmetric;
    double size[3], rms, axis;
  } rows[] = {{0.3, false, {0.17, 0.17, 0.25}, 0.37, 0.8},
              {1.0, false, {0.58, 0.57, 0.82}, 1.2, 2.6},
              {0.5, true, {0.28, 0.27, 0.40}, 1.4, 2.5}};
  const int n = trials(400, 4000);
  print_message("%d patients a row, errors in mm: R, Rc, h; residual rms, worst; axis in degrees; within 3 errors\n",
                n);
  for (int row = 0; row < 3; ++row) {
    const accuracy found = accuracy_of(rows[row].noise, rows[row].is_asymmetric, n);
    print_message("noise %.1f%s: %.2f %.2f %.2f; %.2f %.2f; %.2f; %.3f\n", rows[row].noise,
                  rows[row].is_asymmetric ? ", asymmetric" : "", found.size[0], found.size[1], found.size[2], found.rms,
                  found.worst, found.axis, found.covered);
    /* The tolerance is 20 %, plus three times the scatter of a root mean square of n errors. */
    const double share = 0.2 + 3 / sqrt(2.0 * n);
    for (int k = 0; k < 3; ++k) CHECK_NEAR(found.size[k], rows[row].size[k], share * rows[row].size[k]);
    CHECK_NEAR(found.rms, rows[row].rms, share * rows[row].rms);
    CHECK_NEAR(found.axis, rows[row].axis, share * rows[row].axis);
    CHECK_MET(found.covered >= 0.95);
  }
}

/* ---- Cusps with separate sectors, and commissures with heights ---- */

enum { most_cusps = 4 };
static const char *const kinds_of[most_cusps + 1] = {NULL, NULL, "bicuspid", "coapting", "quadricuspid"};

/* Sizes of a valve with two to four cusps. Commissure k lies behind cusp k. */
typedef struct cusp_sizes {
  int n;
  double R, Rc, sector[most_cusps], height[most_cusps];
} cusp_sizes;

static const char *of(const char *owner, int k, const char *name) {
  static char text[64];
  snprintf(text, sizeof text, "%s_%d.%s", owner, k, name);
  return text;
}

static void set_cusps(riis_valve *valve, const cusp_sizes *c) {
  CHECK_OK(riis_valve_set_scalar(valve, "root_radius", c->R));
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_radius", c->Rc));
  for (int k = 0; k < c->n; ++k) {
    CHECK_OK(riis_valve_set_scalar(valve, of("cusp", k, "sector"), c->sector[k]));
    CHECK_OK(riis_valve_set_scalar(valve, of("commissure", k, "height"), c->height[k]));
  }
}

/* Makes random cusps that the kind accepts. The commissure_height is the mean of the heights. */
static cusp_sizes random_cusps(int n) {
  for (;;) {
    cusp_sizes c = {n, between(1, 1.4), 0, {0}, {0}};
    double sum = 0, mean = 0;
    c.Rc = c.R * between(0.95, 1.05);
    for (int k = 0; k < n; ++k) sum += c.sector[k] = between(40, 150);
    for (int k = 0; k < n; ++k) c.sector[k] *= 360 / sum;
    for (int k = 0; k < n; ++k) mean += (c.height[k] = 1.4 * c.Rc * between(0.95, 1.1)) / n;
    riis_valve *valve = new_valve(kinds_of[n]);
    set_cusps(valve, &c);
    CHECK_OK(riis_valve_set_scalar(valve, "commissure_height", mean));
    const riis_surface_options options = surface_options();
    riis_surface *surface = NULL;
    const riis_status status = riis_surface_create(valve, &options, &surface);
    riis_surface_destroy(&surface);
    if (status == RIIS_OK) return c;
    assert_int_equal(status, RIIS_INVALID_PARAMETER);
  }
}

static cusp_sizes equal_cusps(int n, double R, double Rc, double h) {
  cusp_sizes c = {n, R, Rc, {0}, {0}};
  for (int k = 0; k < n; ++k) c.sector[k] = 360.0 / n, c.height[k] = h;
  return c;
}

/* Cusp 0 is about the x axis. With names, each landmark says which cusp it belongs to. */
static patient patient_of(const cusp_sizes *c, bool has_names) {
  patient p = empty_patient();
  double end = -0.5 * c->sector[0];
  for (int32_t k = 0; k < c->n; ++k) {
    add_around(&p, RIIS_LANDMARK_NADIR, c->R, end + 0.5 * c->sector[k], 0);
    if (has_names) p.leaflet_id[p.n - 1][0] = k;
    add_around(&p, RIIS_LANDMARK_COMMISSURE, c->Rc, end += c->sector[k], c->height[k]);
    if (has_names) p.leaflet_id[p.n - 1][0] = (k + 1) % c->n, p.leaflet_id[p.n - 1][1] = k;
  }
  return p;
}

static int32_t is_set(const riis_valve *valve, const char *name) {
  int32_t found = -1;
  CHECK_OK(riis_valve_is_set(valve, name, &found));
  return found;
}

TEST(test_exact_sectors) {
  for (int trial = 0; trial < trials_of(120); ++trial) {
    const cusp_sizes c = random_cusps(2 + trial % 3);
    patient p = patient_of(&c, true);
    riis_valve *valve = new_valve(kinds_of[c.n]);
    const double shift = c.n == 2 ? 0.02 : 0; /* two cusps may meet off the axis */
    if (c.n == 2) CHECK_OK(riis_valve_set_scalar(valve, "meeting_shift", shift));
    if (trial % 2 == 0) add(&p, RIIS_LANDMARK_COAPTATION, shift * c.Rc, 0, 0.6);
    place_patient(&p, scales[trial % 3]);
    shuffle(&p);
    const answer found = place(valve, &p);
    CHECK_AT_MOST(found.placement.worst, 1e-8 * p.scale);
    assert_int_equal(found.placement.n_undetermined, 0);
    CHECK_NEAR(value(valve, "root_radius"), c.R, 1e-8);
    CHECK_NEAR(value(valve, "commissure_radius"), c.Rc, 1e-8);
    double sum = 0, mean = 0;
    for (int k = 0; k < c.n; ++k) {
      CHECK_NEAR(value(valve, of("cusp", k, "sector")), c.sector[k], 1e-6);
      CHECK_NEAR(value(valve, of("commissure", k, "height")), c.height[k], 1e-8);
      assert_int_equal(found.state[position(valve, of("cusp", k, "sector"))], RIIS_SIZE_DETERMINED);
      assert_int_equal(found.state[position(valve, of("commissure", k, "height"))], RIIS_SIZE_DETERMINED);
      sum += value(valve, of("cusp", k, "sector")), mean += c.height[k] / c.n;
    }
    CHECK_NEAR(sum, 360, 1e-9);
    CHECK_NEAR(value(valve, "commissure_height"), mean, 1e-8);
    check_on_surface(valve, &p, &found,
                     trial % 2 == 0 ? 2 : 0.01); /* the point of coaptation may be anywhere on the axis */
  }
}

/* Landmarks of equal cusps give a valve with equal cusps: no size of a cusp or a commissure is set. */
TEST(test_equal_cusps_stay_equal) {
  int n_unequal = 0;
  const int n = trials_of(300);
  for (int trial = 0; trial < n; ++trial) {
    const double R = between(1, 1.4);
    const cusp_sizes c = equal_cusps(2 + trial % 3, R, R * between(0.95, 1.05), 1.4 * R * between(0.97, 1.05));
    const bool is_exact = trial % 4 == 0;
    patient p = patient_of(&c, trial % 2 == 0);
    place_patient(&p, 10);
    if (!is_exact) disturb(&p, 0.3);
    riis_valve *valve = new_valve(kinds_of[c.n]);
    const answer found = place(valve, &p);
    int n_set = 0;
    for (int k = 0; k < c.n; ++k)
      n_set += is_set(valve, of("cusp", k, "sector")) + is_set(valve, of("commissure", k, "height"));
    n_unequal += n_set > 0;
    if (is_exact) {
      assert_int_equal(n_set, 0);
      CHECK_NEAR(value(valve, "root_radius"), c.R, 1e-9);
      CHECK_NEAR(value(valve, "commissure_height"), c.height[0], 1e-9);
      assert_int_equal(found.state[position(valve, "cusp_0.sector")], RIIS_SIZE_KEPT);
      assert_int_equal(found.state[position(valve, "commissure_1.height")], RIIS_SIZE_TIED);
    }
    free_owned_after(0);
  }
  print_message("%d of %d noisy valves with equal cusps did not stay equal\n", n_unequal, n - n / 4);
  CHECK_AT_MOST(n_unequal, 0.06 * n + 3);
}

/* The cusps differ by much more than the noise. The standard errors explain the scatter of the fitted sizes. */
TEST(test_noisy_sectors) {
  static const cusp_sizes truth[3] = {{2, 1.35, 1.35, {150, 210}, {1.9, 1.9}},
                                      {3, 1.25, 1.3, {130, 100, 130}, {1.9, 1.6, 1.75}},
                                      {4, 1.3, 1.3, {100, 100, 100, 60}, {1.9, 1.7, 1.9, 1.7}}};
  const int n = trials(100, 2000);
  for (int row = 0; row < 3; ++row) {
    const cusp_sizes *c = &truth[row];
    double squares = 0, expected = 0, sectors = 0;
    int n_covered = 0, n_values = 0;
    for (int trial = 0; trial < n; ++trial) {
      patient p = patient_of(c, true);
      place_patient(&p, 10);
      disturb(&p, 0.3);
      riis_valve *valve = new_valve(kinds_of[c->n]);
      const answer found = place(valve, &p);
      for (int k = 0; k < c->n; ++k) {
        const double error = value(valve, of("cusp", k, "sector")) - c->sector[k];
        const double stated = found.standard_error[position(valve, of("cusp", k, "sector"))];
        n_covered += fabs(error) <= 3 * stated;
        squares += error * error / (stated * stated), sectors += error * error, expected += stated * stated;
        ++n_values;
        if (found.state[position(valve, "commissure_0.height")] != RIIS_SIZE_DETERMINED) continue;
        const double off = value(valve, of("commissure", k, "height")) - c->height[k];
        const double height_error = found.standard_error[position(valve, of("commissure", k, "height"))];
        n_covered += fabs(off) <= 3 * height_error;
        squares += off * off / (height_error * height_error);
        ++n_values;
      }
      free_owned_after(0);
    }
    print_message(
        "%s, noise 0.3 mm, %d patients: sectors off by %.2f degrees, standard error %.2f; errors are %.2f "
        "standard errors; within 3 errors %.3f\n",
        kinds_of[c->n], n, sqrt(sectors / (n * c->n)), sqrt(expected / (n * c->n)), sqrt(squares / n_values),
        (double)n_covered / n_values);
    if (is_short_test()) continue; /* these are too few patients for statistics */
    CHECK_AT_MOST(0.97 * n_values, n_covered);
    /* The standard errors use the larger of the stated noise and the residuals, so they tend to be too large. */
    CHECK_NEAR(sqrt(sectors / expected), 0.9, 0.25);
  }
}

/* Held sectors and heights keep their values, and the other cusps share the rest. */
TEST(test_held_sectors) {
  const cusp_sizes c = {3, 1.25, 1.3, {130, 100, 130}, {1.9, 1.6, 1.75}};
  patient p = patient_of(&c, true);
  place_patient(&p, 10);
  answer found;
  riis_valve *valve = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(valve, "cusp_2.sector", 126));
  CHECK_OK(try_to_place(valve, &p, "cusp_2.sector", &found));
  CHECK_NEAR(value(valve, "cusp_2.sector"), 126, 0);
  assert_int_equal(found.state[position(valve, "cusp_2.sector")], RIIS_SIZE_KEPT);
  CHECK_NEAR(value(valve, "cusp_0.sector") + value(valve, "cusp_1.sector"), 234, 1e-9);
  CHECK_AT_MOST(0.1, found.placement.worst);
  valve = new_valve("coapting");
  for (int k = 0; k < 3; ++k) CHECK_OK(riis_valve_set_scalar(valve, of("cusp", k, "sector"), 2 * c.sector[k]));
  CHECK_OK(try_to_place(valve, &p, "cusp_0.sector cusp_1.sector cusp_2.sector", &found));
  CHECK_AT_MOST(found.placement.worst, 1e-7);
  CHECK_NEAR(value(valve, "cusp_1.sector"), 200, 0);
  valve = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_height", 1.75));
  CHECK_OK(try_to_place(valve, &p, "commissure_height", &found));
  assert_int_equal(is_set(valve, "commissure_0.height"), 0);
  CHECK_NEAR(value(valve, "commissure_0.height"), 1.75, 0);
  valve = new_valve("coapting");
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_1.height", 1.6));
  CHECK_OK(try_to_place(valve, &p, "commissure_1.height", &found));
  CHECK_NEAR(value(valve, "commissure_0.height"), 1.9, 1e-8);
  CHECK_NEAR(value(valve, "commissure_height"), 1.75, 1e-8);
  /* If the unequal cusps of a template agree with the landmarks, the fit keeps them. */
  valve = new_valve("coapting");
  set_cusps(valve, &c);
  for (int k = 0; k < 3; ++k) CHECK_OK(riis_valve_set_scalar(valve, of("commissure", k, "height"), 2 * c.height[k]));
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_height", 3.5));
  CHECK_OK(try_to_place(valve, &p, "", &found));
  assert_int_equal(found.state[position(valve, "cusp_1.sector")], RIIS_SIZE_KEPT);
  CHECK_NEAR(value(valve, "commissure_1.height"), 1.6, 1e-8);
  CHECK_NEAR(value(valve, "commissure_height"), 1.75, 1e-8);
  CHECK_AT_MOST(found.placement.worst, 1e-7);
}

/* ---- Aortic ---- */

static patient aortic(double R, const double *Rc, double h, const double *angle) {
  const double at[3] = {0, angle[0] + angle[1], -angle[0] - angle[2]};
  patient p = empty_patient();
  for (int32_t cusp = 0; cusp < 3; ++cusp) {
    add_around(&p, RIIS_LANDMARK_NADIR, R, at[cusp], 0);
    p.leaflet_id[p.n - 1][0] = cusp;
    add_around(&p, RIIS_LANDMARK_COMMISSURE, Rc[cusp], at[cusp] + angle[cusp], h);
  }
  return p;
}

TEST(test_exact_aortic) {
  static const char *const cusps[3] = {"right", "left", "non_coronary"};
  for (int trial = 0; trial < trials_of(120); ++trial) {
    const double R = between(0.9, 1.6), end = between(1.0, 1.6), h = between(0.9, 1.5), Rc[3] = {end, end, end};
    double angle[3] = {between(54, 66), between(54, 66), 0};
    angle[2] = 180 - angle[0] - angle[1];
    patient p = aortic(R, Rc, h, angle);
    /* The names of two nadirs, or of one commissure, determine the names of all cusps. */
    if (trial % 4 == 1) p.leaflet_id[2][0] = -1;
    if (trial % 4 == 2) {
      for (int i = 0; i < p.n; ++i) p.leaflet_id[i][0] = -1;
      p.leaflet_id[3][0] = 2, p.leaflet_id[3][1] = 1;
    }
    place_patient(&p, scales[trial % 3]);
    shuffle(&p);
    riis_valve *valve = new_valve("aortic");
    const answer found = place(valve, &p);
    CHECK_AT_MOST(found.placement.worst, 1e-9 * p.scale);
    CHECK_NEAR(value(valve, "root_radius"), R, 1e-9);
    CHECK_NEAR(value(valve, "leaflet_height"), h, 1e-9);
    for (int cusp = 0; cusp < 3; ++cusp) {
      char name[64];
      double turn[3];
      snprintf(name, sizeof name, "%s.leaflet_angle", cusps[cusp]);
      CHECK_NEAR(value(valve, name), angle[cusp], 1e-7);
      snprintf(name, sizeof name, "%s.leaflet_radius_out", cusps[cusp]);
      CHECK_NEAR(value(valve, name), end, 1e-9);
      /* Neighbouring cusps meet at the commissures. The rotations of the cusps therefore follow from the angles. */
      snprintf(name, sizeof name, "%s.rotation", cusps[cusp]);
      CHECK_OK(riis_valve_get(valve, name, 3, turn));
      CHECK_NEAR(turn[2], cusp == 0 ? 0 : cusp == 1 ? angle[0] + angle[1] : -angle[0] - angle[2], 1e-7);
      /* A free edge does not bulge beyond the plane of its commissure. */
      snprintf(name, sizeof name, "%s.leaflet_radius_in", cusps[cusp]);
      const double x = end * cosine(angle[cusp]), in = value(valve, name);
      snprintf(name, sizeof name, "%s.leaflet_power", cusps[cusp]);
      if (x > in) CHECK_AT_MOST(value(valve, name), x / (x - in) * (1 + 1e-12));
    }
    check_on_surface(valve, &p, &found, 0.01);
  }
}

/* ---- Mitral ---- */

enum { n_sizes = 7 };
static const char *const mitral_names[n_sizes] = {"AP_diameter",          "ALPM_diameter", "ALPM_position_ratio",
                                                  "IT_distance",          "indent_depth",  "anterior_horn_height",
                                                  "posterior_horn_height"};

/* Makes landmarks of a random mitral valve. `sizes` gets the true values in centimetres. */
static patient mitral(int n, bool is_reversed, double *sizes, double *anterior_ratio) {
  mitral_parameters m = mitral_defaults();
  double *const to[n_sizes] = {&m.AP_diameter,  &m.ALPM_diameter,        &m.ALPM_position_ratio,  &m.IT_distance,
                               &m.indent_depth, &m.anterior_horn_height, &m.posterior_horn_height};
  const double grown = between(0.8, 1.2);
  for (int k = 0; k < n_sizes; ++k) *to[k] *= (k == 2 ? 1 : grown) * between(0.88, 1.12);
  for (int k = 0; k < n_sizes; ++k) sizes[k] = *to[k];
  *anterior_ratio = m.anterior_ratio = between(0.36, 0.46);
  m.opening = 0;
  mitral_oracle *oracle = mitral_oracle_create(&m, &m);
  assert_non_null(oracle);
  patient p = empty_patient();
  const double phase = between(0, 1);
  for (int i = 0; i < n; ++i) {
    double u = phase + (double)(is_reversed ? n - i : i) / n, point[3];
    u -= floor(u);
    mitral_oracle_annulus(oracle, u, point);
    add(&p, RIIS_LANDMARK_ANNULUS, point[0], point[1], point[2]);
  }
  double horn[3];
  mitral_oracle_annulus(oracle, 0.5, horn);
  add(&p, RIIS_LANDMARK_ANTERIOR_HORN, horn[0], horn[1], horn[2]);
  mitral_oracle_destroy(oracle);
  p.flow[2] = -1;
  return p;
}

static void add_commissures(patient *p, double anterior_ratio, const double *sizes) {
  mitral_parameters m = mitral_defaults();
  m.AP_diameter = sizes[0], m.ALPM_diameter = sizes[1], m.ALPM_position_ratio = sizes[2], m.IT_distance = sizes[3];
  m.indent_depth = sizes[4], m.anterior_horn_height = sizes[5], m.posterior_horn_height = sizes[6];
  m.opening = 0;
  mitral_oracle *oracle = mitral_oracle_create(&m, &m);
  double point[3];
  mitral_oracle_annulus(oracle, 0.5 - 0.5 * anterior_ratio, point);
  add(p, RIIS_LANDMARK_POSTEROMEDIAL, point[0], point[1], point[2]);
  add(p, RIIS_LANDMARK_ANTEROLATERAL, -point[0], point[1], point[2]);
  add(p, RIIS_LANDMARK_TRIGONE, 0.5 * sizes[3], 0.5 * (sizes[0] + sizes[4]), 0.75 * sizes[5]);
  mitral_oracle_annulus(oracle, 0, point);
  add(p, RIIS_LANDMARK_POSTERIOR_HORN, point[0], point[1], point[2]);
  mitral_oracle_destroy(oracle);
}

TEST(test_exact_mitral) {
  for (int trial = 0; trial < trials_of(27); ++trial) {
    double sizes[n_sizes], ratio;
    patient p = mitral(16, trial % 2 == 1, sizes, &ratio);
    const bool has_more = trial % 3 != 0;
    if (has_more) add_commissures(&p, ratio, sizes);
    if (trial % 3 == 1) memset(p.flow, 0, sizeof p.flow); /* the commissures show the atrium's side */
    place_patient(&p, scales[trial % 3]);
    /* With the default noise, some valves have a size that counts as undetermined. Exact landmarks still give the exact value of
     * an undetermined size. */
    if (trial % 2 == 0) p.noise = 0.01 * p.scale;
    riis_valve *valve = new_valve("mitral");
    const answer found = place(valve, &p);
    for (int k = 0; k < n_sizes; ++k) CHECK_NEAR(value(valve, mitral_names[k]), sizes[k], 0.005); /* 0.05 mm */
    CHECK_NEAR(value(valve, "anterior_ratio"), has_more ? ratio : 0.41, 0.001);
    assert_int_equal(found.state[position(valve, "anterior_ratio")], has_more ? RIIS_SIZE_DETERMINED : RIIS_SIZE_KEPT);
    if (p.noise > 0) assert_int_equal(found.placement.n_undetermined, 0);
    CHECK_AT_MOST(found.placement.worst, 0.001 * p.scale);
    CHECK_NEAR(value(valve, "anterior_length"), 2.12 * sizes[0] / 3, 0.01);
    assert_int_equal(found.state[position(valve, "anterior_length")], RIIS_SIZE_TIED);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    check_on_surface(valve, &p, &found, 0.01);
  }
}

/* Two landmarks may have one place: an annulus point may coincide with its neighbour or with the horn. */
TEST(test_repeated_points_of_annuli) {
  enum { n = 16, horn = n };
  for (int trial = 0; trial < trials_of(12); ++trial) {
    double sizes[n_sizes], ratio;
    patient p = mitral(n, trial % 2 == 1, sizes, &ratio);
    const bool is_exact = trial % 4 < 2;
    if (!is_exact) disturb(&p, 0.03);
    int nearest = 0;
    double least = HUGE_VAL;
    for (int i = 0; i < n; ++i) {
      double square = 0;
      for (int k = 0; k < 3; ++k) square += (p.xyz[i][k] - p.xyz[horn][k]) * (p.xyz[i][k] - p.xyz[horn][k]);
      if (square < least) least = square, nearest = i;
    }
    const int first = (nearest + 6) % n, second = (nearest + 7) % n;
    memcpy(p.xyz[nearest], p.xyz[horn], sizeof p.xyz[horn]);
    memcpy(p.xyz[second], p.xyz[first], sizeof p.xyz[first]);
    place_patient(&p, scales[trial % 3]);
    riis_valve *valve = new_valve("mitral");
    const answer found = place(valve, &p);
    for (int k = 0; k < n_sizes && is_exact; ++k) CHECK_NEAR(value(valve, mitral_names[k]), sizes[k], 0.01);
    const int earlier = first < second ? first : second, later = first < second ? second : first;
    assert_memory_equal(found.place[nearest], found.place[horn], sizeof found.place[horn]);
    assert_memory_equal(found.place[later], found.place[earlier], sizeof found.place[earlier]);
    assert_true(found.residual[nearest] == found.residual[horn] && found.residual[later] == found.residual[earlier]);
  }
}

/* Without the flow and the commissures, the horns of a saddle-shaped annulus show the atrium's side. */
TEST(test_saddle) {
  double sizes[n_sizes], ratio;
  patient p = mitral(16, true, sizes, &ratio);
  memset(p.flow, 0, sizeof p.flow);
  place_patient(&p, 10);
  riis_valve *valve = new_valve("mitral");
  place(valve, &p);
  CHECK_NEAR(value(valve, "anterior_horn_height"), sizes[5], 0.005);
  disturb(&p, 1.5);
  p.noise = 6;
  answer found;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmarks.flow is needed|horns|standard error",
                try_to_place(valve, &p, "", &found));
}

TEST(test_noisy_mitral) {
  const int n = trials(24, 400);
  for (int points = 8; points <= 16; points += 8) {
    double squares[n_sizes] = {0}, residual = 0;
    int n_undetermined = 0, n_covered = 0;
    for (int trial = 0; trial < n; ++trial) {
      double sizes[n_sizes], ratio;
      patient p = mitral(points, trial % 2 == 1, sizes, &ratio);
      place_patient(&p, 10);
      disturb(&p, 0.3);
      riis_valve *valve = new_valve("mitral");
      const answer found = place(valve, &p);
      n_undetermined += found.placement.n_undetermined > 0;
      residual += found.placement.rms * found.placement.rms / n;
      for (int k = 0; k < n_sizes; ++k) {
        const double error = value(valve, mitral_names[k]) - sizes[k];
        squares[k] += 100 * error * error / n;
        n_covered += fabs(error) <= 3 * found.standard_error[position(valve, mitral_names[k])];
      }
      free_owned_after(0);
    }
    print_message(
        "mitral, %d points, noise 0.3, %d patients: AP %.2f, ALPM %.2f, horns %.2f %.2f, IT %.2f mm; residual "
        "%.2f; %d with undetermined sizes; within 3 errors %.3f\n",
        points, n, sqrt(squares[0]), sqrt(squares[1]), sqrt(squares[5]), sqrt(squares[6]), sqrt(squares[3]),
        sqrt(residual), n_undetermined, (double)n_covered / (n_sizes * n));
    if (is_short_test()) continue; /* these are too few patients for statistics */
    CHECK_AT_MOST(0.95 * n_sizes * n, n_covered);
    if (points == 16) {
      const double most_times = 1.2 + 3 / sqrt(2.0 * n); /* the errors, 20 %, and three times their scatter */
      CHECK_AT_MOST(sqrt(squares[0]), most_times * 0.4);
      CHECK_AT_MOST(sqrt(squares[1]), most_times * 0.5);
      CHECK_AT_MOST(sqrt(squares[5]), most_times * 0.7);
      CHECK_AT_MOST(sqrt(squares[6]), most_times * 0.7);
      CHECK_NEAR(sqrt(residual), 0.33, 0.2 * 0.33);
      CHECK_AT_MOST(n_undetermined, 0.4 * n);
    } else {
      CHECK_AT_MOST(0.5 * n, n_undetermined);
    }
  }
}

/* ---- Saddles: tricuspid, mitral_coapting ---- */

/* An annulus of four cubics, and the places of the commissures on it. The flat side is at -y for a tricuspid valve. For a
 * mitral_coapting valve the flat side is at +y. */
typedef struct saddle {
  bool is_mitral;
  double width, depth, flatness, height, flat_ratio, anterior_ratio;
} saddle;

static const char *kind_of(const saddle *s) { return s->is_mitral ? "mitral_coapting" : "tricuspid"; }

/* Writes the control points, starting from the middle of the flat side. Seen from +z, the control points run
 * counter-clockwise. */
static void cubics(const saddle *s, double q[4][4][3]) {
  const double sign = s->is_mitral ? 1 : -1, a = s->width / 2, circle = 0.5523, h = s->height / 2;
  const double near = (0.5 - 0.12 * s->flatness) * s->depth, far = s->depth - near;
  const double at[5][3] = {
      {0, sign * near, h}, {-sign * a, 0, -h}, {0, -sign * far, h}, {sign * a, 0, -h}, {0, sign * near, h}};
  const double along[5][2] = {{-sign, 0}, {0, -sign}, {sign, 0}, {0, sign}, {-sign, 0}};
  const double flat = (circle + 0.3 * s->flatness) * a, round = circle * a;
  const double out[4] = {flat, circle * far, round, circle * near}, in[4] = {circle * near, round, circle * far, flat};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) {
      q[i][0][k] = at[i][k], q[i][3][k] = at[i + 1][k];
      q[i][1][k] = at[i][k] + (k < 2 ? out[i] * along[i][k] : 0);
      q[i][2][k] = at[i + 1][k] - (k < 2 ? in[i] * along[i + 1][k] : 0);
    }
}

static void on_cubic(double q[4][3], double t, double *at) {
  const double u = 1 - t;
  for (int k = 0; k < 3; ++k)
    at[k] = u * u * u * q[0][k] + 3 * u * u * t * q[1][k] + 3 * u * t * t * q[2][k] + t * t * t * q[3][k];
}
static double speed(double q[4][3], double t) {
  const double u = 1 - t;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double slope =
        3 * (u * u * (q[1][k] - q[0][k]) + 2 * u * t * (q[2][k] - q[1][k]) + t * t * (q[3][k] - q[2][k]));
    sum += slope * slope;
  }
  return sqrt(sum);
}
/* The length from 0 to t, by Gauss-Legendre quadrature with two points in each of 200 parts. */
static double length_to(double q[4][3], double t) {
  const double off = 0.5 / sqrt(3);
  double sum = 0;
  for (int i = 0; i < 200; ++i)
    sum += (speed(q, t * (i + 0.5 - off) / 200) + speed(q, t * (i + 0.5 + off) / 200)) * t / 400;
  return sum;
}

/* The point at a fraction of the whole length. */
static void at_lap(const saddle *s, double lap, double *at) {
  double q[4][4][3], whole = 0;
  cubics(s, q);
  for (int i = 0; i < 4; ++i) whole += length_to(q[i], 1);
  double left = (lap - floor(lap)) * whole;
  int i = 0;
  while (i < 3 && left > length_to(q[i], 1)) left -= length_to(q[i++], 1);
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step) *(length_to(q[i], (low + high) / 2) < left ? &low : &high) = (low + high) / 2;
  on_cubic(q[i], (low + high) / 2, at);
}

static saddle random_saddle(bool is_mitral) {
  saddle s = {is_mitral, 0, 0, between(0.3, 0.9), 0, 0, 0};
  const riis_valve *valve = new_valve(kind_of(&s));
  const double grown = between(0.85, 1.15);
  s.width = grown * between(0.93, 1.07) * value(valve, is_mitral ? "ALPM_diameter" : "AP_diameter");
  s.depth = grown * value(valve, is_mitral ? "AP_diameter" : "SL_diameter");
  s.height = grown * between(0.7, 1.3) * value(valve, "saddle_height");
  s.flat_ratio = value(valve, is_mitral ? "anterior_ratio" : "septal_ratio") + between(-0.04, 0.04);
  if (!is_mitral) s.anterior_ratio = value(valve, "anterior_ratio") + between(-0.04, 0.04);
  return s;
}

static void add_at_lap(patient *p, const saddle *s, int32_t role, double lap, int32_t leaflet) {
  double at[3];
  at_lap(s, lap, at);
  add(p, role, at[0], at[1], at[2]);
  if (leaflet >= 0) p->leaflet_id[p->n - 1][0] = leaflet, p->leaflet_id[p->n - 1][1] = (leaflet + 1) % 3;
}

/* Tricuspid leaflets are 0 anterior, 1 septal and 2 posterior. */
static patient patient_with(const saddle *s, int n_points, bool has_horns, bool has_commissures) {
  patient p = empty_patient();
  double q[4][4][3];
  cubics(s, q);
  const double phase = between(0, 1);
  for (int i = 0; i < n_points; ++i) {
    const double at = 4 * (phase + i) / n_points;
    double point[3];
    on_cubic(q[(int)at], at - floor(at), point);
    add(&p, RIIS_LANDMARK_ANNULUS, point[0], point[1], point[2]);
  }
  const double half = s->flat_ratio / 2;
  if (!s->is_mitral) {
    add_at_lap(&p, s, RIIS_LANDMARK_COMMISSURE, -half, 0);
    add_at_lap(&p, s, RIIS_LANDMARK_COMMISSURE, half, 1);
    add_at_lap(&p, s, RIIS_LANDMARK_COMMISSURE, 1 - half - s->anterior_ratio, 2);
  }
  if (has_horns) add_at_lap(&p, s, RIIS_LANDMARK_ANTERIOR_HORN, 0, -1);
  if (has_horns) add_at_lap(&p, s, RIIS_LANDMARK_POSTERIOR_HORN, 0.5, -1);
  if (has_commissures) add_at_lap(&p, s, RIIS_LANDMARK_ANTEROLATERAL, half, -1);
  if (has_commissures) add_at_lap(&p, s, RIIS_LANDMARK_POSTEROMEDIAL, -half, -1);
  p.flow[2] = -1;
  return p;
}

/* Compares the sizes of a placed valve with the true sizes. Returns the number of sizes, and writes the errors in units of the
 * standard errors. */
static int saddle_errors(const riis_valve *valve, const saddle *s, const answer *found, double *error,
                         double *in_errors) {
  const char *names[6] = {s->is_mitral ? "ALPM_diameter" : "AP_diameter",
                          s->is_mitral ? "AP_diameter" : "SL_diameter",
                          "flatness",
                          "saddle_height",
                          s->is_mitral ? "anterior_ratio" : "septal_ratio",
                          "anterior_ratio"};
  const double truth[6] = {s->width, s->depth, s->flatness, s->height, s->flat_ratio, s->anterior_ratio};
  const int n = s->is_mitral ? 5 : 6;
  for (int i = 0; i < n; ++i) {
    error[i] = value(valve, names[i]) - truth[i];
    in_errors[i] = error[i] / found->standard_error[position(valve, names[i])];
  }
  return n;
}

TEST(test_exact_saddles) {
  for (int trial = 0; trial < trials_of(40); ++trial) {
    const saddle s = random_saddle(trial % 2 == 1);
    const int has = trial / 2 % 3; /* horns and commissures, only horns, only commissures */
    const bool has_commissures = s.is_mitral && has != 1;
    patient p = patient_with(&s, 12, s.is_mitral && has != 2, has_commissures);
    if (has == 0) memset(p.flow, 0, sizeof p.flow); /* the names show the side of the atrium */
    place_patient(&p, scales[trial % 3]);
    p.noise = 0.01 * p.scale;
    riis_valve *valve = new_valve(kind_of(&s));
    const double own_length = value(valve, "posterior_length"),
                 own_depth = value(valve, s.is_mitral ? "AP_diameter" : "SL_diameter");
    const answer found = place(valve, &p);
    double error[6], in_errors[6];
    const int n = saddle_errors(valve, &s, &found, error, in_errors);
    for (int i = 0; i < n; ++i)
      if (i != 4 || !s.is_mitral || has_commissures) CHECK_NEAR(error[i], 0, 1e-6);
    CHECK_AT_MOST(found.placement.worst, 1e-6 * p.scale);
    for (int k = 0; k < 3; ++k) CHECK_NEAR(found.placement.translation[k], p.shift[k], 1e-5 * p.scale);
    /* The leaflets' lengths grow with the annulus. */
    CHECK_NEAR(value(valve, "posterior_length"), own_length * s.depth / own_depth, 1e-5);
    assert_int_equal(found.state[position(valve, "posterior_length")], RIIS_SIZE_TIED);
    check_on_surface(valve, &p, &found, 0.01);
  }
}

/* A measured length stays. Two commissures with named leaflets suffice. */
TEST(test_saddle_with_lengths) {
  saddle s = random_saddle(false);
  patient p = patient_with(&s, 12, false, false);
  place_patient(&p, 10);
  p.leaflet_id[13][0] = p.leaflet_id[13][1] = -1;
  riis_valve *valve = new_valve("tricuspid");
  CHECK_OK(riis_valve_set_scalar(valve, "anterior_length", 2.45));
  answer found;
  CHECK_OK(try_to_place(valve, &p, "anterior_length", &found));
  CHECK_NEAR(value(valve, "anterior_length"), 2.45, 0);
  assert_int_equal(found.state[position(valve, "anterior_length")], RIIS_SIZE_KEPT);
  assert_int_equal(found.state[position(valve, "septal_length")], RIIS_SIZE_TIED);
  /* The names alone show that the commissures are mirrored. */
  p.leaflet_id[12][0] = 2, p.leaflet_id[12][1] = 0, p.leaflet_id[14][0] = 0, p.leaflet_id[14][1] = 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "seen along the flow, anterior, septal and posterior|counter-clockwise|mirrored",
                try_to_place(valve, &p, "", &found));
}

TEST(test_noisy_saddles) {
  const int n = trials(60, 1000);
  for (int is_mitral = 0; is_mitral < 2; ++is_mitral) {
    double squares[6] = {0}, in_squares[6] = {0};
    int n_sizes_of = 0, n_covered = 0;
    for (int trial = 0; trial < n; ++trial) {
      const saddle s = random_saddle(is_mitral);
      patient p = patient_with(&s, 16, is_mitral, is_mitral);
      place_patient(&p, 10);
      disturb(&p, 0.3);
      riis_valve *valve = new_valve(kind_of(&s));
      const answer found = place(valve, &p);
      double error[6], in_errors[6];
      n_sizes_of = saddle_errors(valve, &s, &found, error, in_errors);
      for (int i = 0; i < n_sizes_of; ++i) {
        squares[i] += error[i] * error[i] / n, in_squares[i] += in_errors[i] * in_errors[i] / n;
        n_covered += fabs(in_errors[i]) <= 3;
      }
      free_owned_after(0);
    }
    print_message(
        "%s, 16 points, noise 0.3, %d patients: width %.2f, depth %.2f, saddle %.2f mm, flatness %.3f, "
        "ratios %.4f %.4f; in standard errors %.2f %.2f %.2f %.2f %.2f %.2f; within 3 errors %.3f\n",
        is_mitral ? "mitral_coapting" : "tricuspid", n, 10 * sqrt(squares[0]), 10 * sqrt(squares[1]),
        10 * sqrt(squares[3]), sqrt(squares[2]), sqrt(squares[4]), sqrt(squares[5]), sqrt(in_squares[0]),
        sqrt(in_squares[1]), sqrt(in_squares[2]), sqrt(in_squares[3]), sqrt(in_squares[4]), sqrt(in_squares[5]),
        (double)n_covered / (n * n_sizes_of));
    if (is_short_test()) continue; /* these are too few patients for statistics */
    CHECK_AT_MOST(0.96 * n * n_sizes_of, n_covered);
    for (int i = 0; i < n_sizes_of; ++i) CHECK_NEAR(sqrt(in_squares[i]), 0.85, 0.35);
  }
}

/* ---- Bileaflet ---- */

TEST(test_exact_bileaflet) {
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const double R = between(0.8, 1.4), offset = between(0.1, 0.4), height = between(-0.1, 0.2);
    patient p = empty_patient();
    for (int i = 0; i < 5; ++i) add_around(&p, RIIS_LANDMARK_ANNULUS, R, 72 * i + between(-20, 20), 0);
    const int n_hinges = trial % 2 == 0 ? 2 : 4;
    for (int i = 0; i < n_hinges; ++i)
      add(&p, RIIS_LANDMARK_HINGE, i < 2 ? offset : -offset, (i % 2 == 0 ? 0.9 : -0.9) * R, height);
    p.flow[2] = between(0.1, 10);
    place_patient(&p, scales[trial % 3]);
    shuffle(&p);
    riis_valve *valve = new_valve("bileaflet");
    const answer found = place(valve, &p);
    CHECK_NEAR(value(valve, "radius"), R, 1e-9);
    CHECK_NEAR(value(valve, "hinge_offset"), offset, 1e-9);
    CHECK_NEAR(value(valve, "hinge_height"), height, 1e-9);
    CHECK_AT_MOST(found.placement.worst, 1e-9 * p.scale);
    for (int k = 0; k < 3; ++k) CHECK_NEAR(found.placement.translation[k], p.shift[k], 1e-8 * p.scale);
  }
}

/* ---- Held sizes, forms of input ---- */

TEST(test_held_sizes) {
  patient p = trileaflet(1.2, 1.1, 1.5);
  place_patient(&p, 10);
  riis_valve *valve = new_valve("trileaflet");
  CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", 1.6));
  CHECK_OK(riis_valve_set_scalar(valve, "bending_height", 0.7));
  answer found;
  CHECK_OK(try_to_place(valve, &p, " leaflet_height,bending_height ", &found));
  CHECK_NEAR(value(valve, "leaflet_height"), 1.6, 0);
  CHECK_NEAR(value(valve, "bending_height"), 0.7, 0);
  CHECK_NEAR(value(valve, "root_radius"), 1.2, 1e-9);
  assert_int_equal(found.state[position(valve, "leaflet_height")], RIIS_SIZE_KEPT);
  assert_int_equal(found.state[position(valve, "bending_height")], RIIS_SIZE_KEPT);
  /* The fit divides the missing millimetre between both ends. */
  CHECK_NEAR(found.placement.rms, 0.5, 1e-6);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'leaflet_hight'|did you mean 'leaflet_height'",
                try_to_place(valve, &p, "leaflet_hight", &found));
  patient aortic_patient = p;
  for (int i = 0; i < 6; i += 2) aortic_patient.leaflet_id[i][0] = i / 2;
  riis_valve *aortic_valve = new_valve("aortic");
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'leaflet_power'|each leaflet",
                try_to_place(aortic_valve, &aortic_patient, "leaflet_power", &found));
  CHECK_OK(try_to_place(aortic_valve, &aortic_patient, "right.leaflet_power t3_leaflet", &found));
  CHECK_NEAR(value(aortic_valve, "right.leaflet_power"), 1.58, 0);
}

TEST(test_forms_of_input) {
  patient p = trileaflet(1.25, 1.3, 1.5);
  place_patient(&p, 10);
  riis_valve *one = new_valve("trileaflet"), *other = new_valve("trileaflet");
  const answer found = place(one, &p);
  float x[6], y[6], z[6];
  for (int i = 0; i < 6; ++i) x[i] = (float)p.xyz[i][0], y[i] = (float)p.xyz[i][1], z[i] = (float)p.xyz[i][2];
  riis_landmarks single = landmarks_of(&p);
  single.x = x, single.y = y, single.z = z;
  single.stride = 1;
  single.real_bits = 32;
  single.leaflet_id = NULL;
  riis_placement placement;
  CHECK_OK(riis_place(other, &single, "", NULL, &placement, sizeof placement));
  CHECK_NEAR(value(other, "root_radius"), value(one, "root_radius"), 1e-5);
  CHECK_NEAR(placement.rotation_angle, found.placement.rotation_angle, 1e-3);
  /* The test starts again from its result: with the valve's values as the template, the fit must give these sizes again. */
  const answer again = place(one, &p);
  CHECK_NEAR(value(one, "leaflet_height"), 1.5, 1e-9);
  for (int k = 0; k < 3; ++k) CHECK_NEAR(again.placement.translation[k], found.placement.translation[k], 1e-7);
}

/* ---- Refusals ---- */

static void check_place_refused(const char *kind, const patient *p, const char *parts, const char *what) {
  riis_valve *valve = new_valve(kind);
  const char *size = strcmp(kind, "bileaflet") == 0                           ? "radius"
                     : strcmp(kind, "mitral") == 0 || strstr(kind, "mitral_") ? "AP_diameter"
                     : strcmp(kind, "tricuspid") == 0                         ? "AP_diameter"
                                                                              : "root_radius";
  CHECK_OK(riis_valve_set_scalar(valve, size, 1.7));
  answer found, untouched;
  memset(&untouched, 0x5a, sizeof untouched);
  check_refused(RIIS_INVALID_ARGUMENT, try_to_place(valve, p, "", &found), parts, what);
  CHECK_NEAR(value(valve, size), 1.7, 0);
  assert_memory_equal(&found, &untouched, sizeof found);
  free_owned_after(0);
}

TEST(test_refused_cusps) {
  const patient good = trileaflet(1.2, 1.1, 1.5);
#define REFUSED(kind, parts, ...)                       \
  do {                                                  \
    patient p = good;                                   \
    __VA_ARGS__;                                        \
    check_place_refused(kind, &p, parts, #__VA_ARGS__); \
  } while (0)
  REFUSED("trileaflet", "landmark 0 (nadir) and landmark 2 (nadir) are in one place: 0.001 apart",
          (memcpy(p.xyz[2], p.xyz[0], sizeof p.xyz[0]), p.xyz[2][2] = 0.001));
  REFUSED("trileaflet", "lie along a line|collinear", for (int i = 0; i < 6; ++i) p.xyz[i][0] = i,
          p.xyz[i][1] = p.xyz[i][2] = 0);
  REFUSED("trileaflet", "landmarks.scale is 10 (millimetres)|cm|in centimetres, scale 1, this would be 1.",
          p.scale = 10);
  REFUSED("trileaflet", "landmarks.scale is 1 (centimetres)|in millimetres, scale 10, this would be 1.",
          for (int i = 0; i < 6; ++i) for (int k = 0; k < 3; ++k) p.xyz[i][k] *= 10);
  REFUSED("trileaflet", "landmarks.scale is not set|10 for landmarks in millimetres", p.scale = RIIS_AUTO);
  REFUSED("trileaflet", "landmarks.scale is 0", p.scale = 0);
  REFUSED("trileaflet", "landmarks.noise is -2", p.noise = -2);
  REFUSED("trileaflet", "z of landmark 3 is nan", p.xyz[3][2] = NAN);
  REFUSED("trileaflet", "x of landmark 5 is inf", p.xyz[5][0] = INFINITY);
  REFUSED("trileaflet", "landmarks.flow is nan", p.flow[0] = NAN);
  REFUSED("trileaflet", "landmarks.role of landmark 2 is 11|from 0 to 10", p.role[2] = 11);
  REFUSED("trileaflet", "landmark 2 (hinge) has a role that the trileaflet valve lacks|commissure, nadir",
          p.role[2] = RIIS_LANDMARK_HINGE);
  REFUSED("trileaflet", "has the commissure 2 times|needs 3", p.n = 4);
  REFUSED("trileaflet", "has the commissure 4 times|needs 3", p.role[0] = RIIS_LANDMARK_COMMISSURE);
  REFUSED("trileaflet", "landmarks.n_landmarks is 0", p.n = 0);
  REFUSED("trileaflet", "landmarks.flow is at 180 degrees|must point downstream", p.flow[2] = -3);
  REFUSED("trileaflet", "follow each other around the valve",
          (p.role[0] = RIIS_LANDMARK_COMMISSURE, p.role[1] = RIIS_LANDMARK_NADIR));
  REFUSED("trileaflet", "does not show the direction of flow", for (int i = 0; i < 6; ++i) p.xyz[i][2] = 0);
  REFUSED("trileaflet", "leaflet_id of landmark 0 (nadir) is 7", p.leaflet_id[0][0] = 7);
  REFUSED("trileaflet", "leaflet_id of landmark 0 (nadir) is 0 and 1",
          (p.leaflet_id[0][0] = 0, p.leaflet_id[0][1] = 1));
  REFUSED("trileaflet", "leaflet_id of landmark 1 (commissure) is 0 and -1", p.leaflet_id[1][0] = 0);
  REFUSED("trileaflet", "seen along the flow|clockwise|mirrored",
          for (int i = 0; i < 6; i += 2) p.leaflet_id[i][0] = (6 - i) / 2 % 3);
  REFUSED("aortic", "does not say which nadir", p.noise = 0);
  REFUSED("aortic", "mirrored", for (int i = 0; i < 6; i += 2) p.leaflet_id[i][0] = (6 - i) / 2 % 3);
  /* The landmarks are the mirror image of a patient with names. */
  REFUSED("aortic", "mirrored", for (int i = 0; i < 6; ++i) p.xyz[i][1] *= -1,
          p.leaflet_id[i][0] = i % 2 == 0 ? i / 2 : -1);
  REFUSED("aortic", "landmark 2 (nadir) says right|left cusp",
          for (int i = 0; i < 6; i += 2) p.leaflet_id[i][0] = i == 4 ? 2 : 0);
  REFUSED("aortic", "landmark 1 (commissure) says left and non_coronary|between right and left",
          (p.leaflet_id[0][0] = 0, p.leaflet_id[2][0] = 1, p.leaflet_id[4][0] = 2, p.leaflet_id[1][0] = 1,
           p.leaflet_id[1][1] = 2));
  /* All landmarks have names, and two of the names are exchanged. Landmark 2 k is the nadir of leaflet k, and 2 k + 1 the
     commissure after it. */
  patient named = good;
  for (int k = 0; k < 3; ++k)
    named.leaflet_id[2 * k][0] = named.leaflet_id[2 * k + 1][0] = k, named.leaflet_id[2 * k + 1][1] = (k + 1) % 3;
  REFUSED("aortic", "leaflet_id of landmark 0 (nadir) and that of landmark 2 (nadir) are exchanged",
          (p = named, p.leaflet_id[0][0] = 1, p.leaflet_id[2][0] = 0));
  REFUSED("trileaflet", "leaflet_id of landmark 3 (commissure) and that of landmark 5 (commissure) are exchanged",
          (p = named, p.leaflet_id[3][0] = 2, p.leaflet_id[3][1] = 0, p.leaflet_id[5][0] = 1, p.leaflet_id[5][1] = 2));
#undef REFUSED
}

TEST(test_refused_annuli) {
  double sizes[n_sizes], ratio;
  const patient good = mitral(16, false, sizes, &ratio);
#define REFUSED(parts, ...)                                 \
  do {                                                      \
    patient p = good;                                       \
    __VA_ARGS__;                                            \
    check_place_refused("mitral", &p, parts, #__VA_ARGS__); \
  } while (0)
  REFUSED(
      "the annulus crosses itself: the line from landmark|order around it", for (int k = 0; k < 3; ++k) {
        const double x = p.xyz[2][k];
        p.xyz[2][k] = p.xyz[10][k], p.xyz[10][k] = x;
      });
  REFUSED("landmark 3 (annulus) and landmark 4 (annulus) are in one place",
          (memcpy(p.xyz[4], p.xyz[3], sizeof p.xyz[3]), p.xyz[4][2] += 0.001));
  REFUSED("has the anterior_horn 0 times|needs 1", p.n = 16);
  REFUSED("landmark 16 (anterior_horn)|must be on the annulus", memset(p.xyz[16], 0, sizeof p.xyz[16]));
  REFUSED("landmarks.flow is at 90 degrees", (p.flow[2] = 0, p.flow[0] = 1));
  patient mirrored = good;
  add_commissures(&mirrored, ratio, sizes);
  mirrored.flow[2] = 1;
  check_place_refused("mitral", &mirrored, "landmarks.flow contradicts the commissures|mirrored",
                      "flow against the commissures");
#undef REFUSED
  patient ring = empty_patient();
  for (int i = 0; i < 5; ++i) add_around(&ring, RIIS_LANDMARK_ANNULUS, 1.1, 72 * i, 0);
  ring.flow[2] = 1;
  patient p = ring;
  check_place_refused("bileaflet", &p, "has the hinge 0 times|needs 2 to 4", "no hinges");
  add(&ring, RIIS_LANDMARK_HINGE, 0.2, 1, 0), add(&ring, RIIS_LANDMARK_HINGE, 0.2, -1, 0);
  p = ring, p.flow[2] = 0;
  check_place_refused("bileaflet", &p, "landmarks.flow is 0 0 0", "no flow");
  p = ring, p.xyz[5][1] = -0.95;
  check_place_refused("bileaflet", &p, "hinges are|direction", "hinges in one place");
  p = ring, p.xyz[5][1] = p.xyz[6][1] = 0, p.xyz[5][2] = 1, p.xyz[6][2] = -1;
  check_place_refused("bileaflet", &p, "hinges are at|normal", "hinges along the axis");
}

TEST(test_refused_sectors_and_saddles) {
  const cusp_sizes c = equal_cusps(4, 1.2, 1.2, 1.7), two = equal_cusps(2, 1.2, 1.2, 1.7);
#define REFUSED(kind, from, parts, ...)                 \
  do {                                                  \
    patient p = from;                                   \
    __VA_ARGS__;                                        \
    check_place_refused(kind, &p, parts, #__VA_ARGS__); \
  } while (0)
  const patient four = patient_of(&c, true), pair = patient_of(&two, true);
  REFUSED("quadricuspid", four, "has the commissure 3 times; the quadricuspid valve needs 4", p.n = 7);
  REFUSED("coapting", four, "has the commissure 4 times; the coapting valve needs 3", p.noise = 0);
  REFUSED("bicuspid", four, "has the commissure 4 times; the bicuspid valve needs 2", p.noise = 0);
  REFUSED("quadricuspid", four, "is 4; it must be 0 (cusp_0), 1 (cusp_1), 2 (cusp_2), 3 (cusp_3) or -1",
          p.leaflet_id[0][0] = 4);
  REFUSED("quadricuspid", four, "seen along the flow, cusp_0, cusp_1, cusp_2 and cusp_3|mirrored",
          for (int i = 0; i < 8; ++i) p.xyz[i][1] *= -1);
  REFUSED("bicuspid", pair, "landmark 1 (commissure) and landmark 3 (commissure) are in one place",
          memcpy(p.xyz[3], p.xyz[1], sizeof p.xyz[1]));
  REFUSED("bicuspid", pair, "landmark 0 (annulus) has a role that the bicuspid valve lacks",
          p.role[0] = RIIS_LANDMARK_ANNULUS);
  saddle s = random_saddle(false), m = random_saddle(true);
  const patient right = patient_with(&s, 12, false, false), left = patient_with(&m, 12, true, true);
  REFUSED("tricuspid", right, "has the commissure 2 times; the tricuspid valve needs 3", p.n = 14);
  REFUSED("tricuspid", right, "has the annulus 3 times; the tricuspid valve needs 4 or more",
          for (int i = 0; i < 9; ++i) p.role[i] = RIIS_LANDMARK_COMMISSURE);
  REFUSED("tricuspid", right, "does not say between which|name the leaflets of two",
          for (int i = 12; i < 15; ++i) p.leaflet_id[i][0] = p.leaflet_id[i][1] = -1);
  REFUSED("tricuspid", right, "landmarks.flow is 0 0 0: one named commissure",
          (p.leaflet_id[12][0] = p.leaflet_id[12][1] = p.leaflet_id[13][0] = p.leaflet_id[13][1] = -1, p.flow[2] = 0));
  REFUSED("tricuspid", right, "counter-clockwise|mirrored", p.flow[2] = 1);
  REFUSED("tricuspid", right, "landmark 0 (anterior_horn) has a role", p.role[0] = RIIS_LANDMARK_ANTERIOR_HORN);
  REFUSED("mitral_coapting", left, "has the anterior_horn 0 times|or both commissures", p.n = 12);
  REFUSED("mitral_coapting", left, "landmarks.flow is 0 0 0|anterior horn and both commissures",
          (p.n = 15, p.flow[2] = 0));
  REFUSED("mitral_coapting", left,
          "landmarks.flow contradicts the commissures, which show that this direction leads to the atrium",
          p.flow[2] = 1);
  REFUSED("mitral_coapting", left, "landmark 0 (trigone) has a role", p.role[0] = RIIS_LANDMARK_TRIGONE);
#undef REFUSED
  /* The commissures may leave less than 50 degrees to a cusp, which is refused. */
  patient narrow = pair;
  for (int i = 1; i < 4; i += 2) narrow.xyz[i][0] = 1.19, narrow.xyz[i][1] *= 0.13;
  answer found;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the landmarks give root_radius|cusp_0.sector|cusp_1.sector is|from 50 to 240",
                try_to_place(new_valve("bicuspid"), &narrow, "", &found));
}

TEST(test_refused_arguments) {
  const patient p = trileaflet(1.2, 1.1, 1.5);
  riis_landmarks landmarks = landmarks_of(&p);
  riis_placement placement;
  riis_valve *valve = new_valve("trileaflet"), *none = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmarks is NULL", riis_landmarks_init(NULL, sizeof landmarks));
  riis_placement_arrays arrays;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "arrays is 24", riis_placement_arrays_init(&arrays, 24));
  CHECK_OK(riis_placement_arrays_init(&arrays, sizeof arrays));
  arrays.struct_size = 0;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "arrays is 0",
                riis_place(valve, &landmarks, "", &arrays, &placement, sizeof placement));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "landmarks is 16", riis_landmarks_init(&landmarks, 16));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL",
                riis_place(none, &landmarks, "", NULL, &placement, sizeof placement));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmarks is NULL",
                riis_place(valve, NULL, "", NULL, &placement, sizeof placement));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "held is NULL",
                riis_place(valve, &landmarks, NULL, NULL, &placement, sizeof placement));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "placement is NULL",
                riis_place(valve, &landmarks, "", NULL, NULL, sizeof placement));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "placement is 8", riis_place(valve, &landmarks, "", NULL, &placement, 8));
  landmarks.role = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmarks.role is NULL",
                riis_place(valve, &landmarks, "", NULL, &placement, sizeof placement));
  landmarks = landmarks_of(&p);
  landmarks.real_bits = 16;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmarks.real_bits is 16",
                riis_place(valve, &landmarks, "", NULL, &placement, sizeof placement));
  landmarks = landmarks_of(&p);
  landmarks.reserved = 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmarks.reserved",
                riis_place(valve, &landmarks, "", NULL, &placement, sizeof placement));
  landmarks = landmarks_of(&p);
  landmarks.stride = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "stride is 0",
                riis_place(valve, &landmarks, "", NULL, &placement, sizeof placement));
  landmarks = landmarks_of(&p);
  landmarks.y = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmarks.y is NULL",
                riis_place(valve, &landmarks, "", NULL, &placement, sizeof placement));
  landmarks = landmarks_of(&p);
  const double square[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  const int32_t degree[4] = {1, 1, 1, 1}, curves[4] = {0, 1, 2, 3};
  riis_patches patches;
  riis_valve *patch_valve = NULL;
  CHECK_OK(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 4, patches.degree = degree, patches.control = square, patches.n_patches = 1,
  patches.curve_id = curves;
  CHECK_OK(riis_valve_create_from_patches(&patches, &patch_valve));
  own(patch_valve);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "patches|no landmarks",
                riis_place(patch_valve, &landmarks, "", NULL, &placement, sizeof placement));
}

int main(void) {
  rng = random_start("test_landmarks");
  return run_cases(NULL, NULL);
}
