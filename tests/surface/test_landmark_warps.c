/* SPDX-License-Identifier: Apache-2.0
 * Tests how warped valves meet landmarks, and that a warp keeps the directions of the valve. At every opening, a warped curve
 * must pass through the mapped landmarks on it. The identity must leave skirts at their places. A rigid warp must turn the
 * orifice and the skirt as a placement does. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "moving_surfaces.h"
#include "searches.h"

#include "shapes.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }

enum { aortic, trileaflet, coapting, mitral, of_patches, n_kinds, most_landmarks = 120 };
static const char *const kinds[n_kinds] = {"aortic", "trileaflet", "coapting", "mitral", "patches"};

/* In ten trials, each kind occurs with both triangulations. */
static int n_trials(void) { return is_long_test() ? 60 : 10; }

static double distance(const double *p, const double *q) {
  return sqrt(pow(p[0] - q[0], 2) + pow(p[1] - q[1], 2) + pow(p[2] - q[2], 2));
}

/* Three leaflets whose sides u do not meet. The leaflets' attachment rises between its ends. */
static riis_valve *valve_of_patches(void) {
  shape states[2] = {{0}, {0}};
  for (int state = 0; state < 2; ++state) {
    shape *made = states + state;
    for (int level = 0; level < 2; ++level)
      for (int i = 0; i < 3; ++i) {
        double control[4][3];
        for (int k = 0; k < 4; ++k) {
          const double angle = 2 * acos(-1) / 3 * (i + k / 3.2), is_inner = k == 1 || k == 2;
          const double r = (level ? 0.4 + 0.3 * state : 1) * (is_inner > 0 ? 1.3 : 1 + 0.03 * i);
          control[k][0] = r * cos(angle), control[k][1] = r * sin(angle);
          control[k][2] = level ? 0.8 : is_inner * 0.3 * (1 + 0.2 * i);
        }
        add_curve(made, 3, control);
      }
    for (int i = 0; i < 3; ++i) {
      for (int end = 0; end < 2; ++end) {
        const double *a = made->control[i][3 * end], *b = made->control[3 + i][3 * end];
        add_line(made, a[0], a[1], a[2], b[0], b[1], b[2]);
      }
      add_patch(made, i, 3 + i, 6 + 2 * i, 7 + 2 * i);
      made->leaflet_id[i] = i;
    }
  }
  riis_valve *valve = valve_from(&states[0]), *open = valve_from(&states[1]);
  CHECK_OK(riis_valve_set_open_state(valve, open));
  return valve;
}

/* Changes all sizes of a valve at random, until the sizes are valid together at five openings. */
static riis_valve *random_valve(int kind) {
  riis_valve *valve = kind == of_patches ? valve_of_patches() : new_valve(kinds[kind]);
  riis_surface_options coarse = surface_options();
  int64_t n = 0;
  coarse.tolerance = 0.2;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  for (double spread = 0.1; kind != of_patches; spread *= 0.8) {
    riis_valve *tried = NULL;
    CHECK_OK(riis_valve_copy(valve, &tried));
    int is_fine = 1;
    for (int64_t i = 0; i < n && is_fine; ++i) {
      riis_parameter parameter;
      double values[3];
      CHECK_OK(riis_valve_get_parameter(tried, i, &parameter, sizeof parameter));
      if (strcmp(parameter.name, "opening") == 0) continue;
      CHECK_OK(riis_valve_get(tried, parameter.name, parameter.n_values, values));
      for (int k = 0; k < parameter.n_values; ++k) values[k] *= 1 + between(-spread, spread);
      is_fine = riis_valve_set(tried, parameter.name, parameter.n_values, values) == RIIS_OK;
    }
    for (int k = 0; k <= 4 && is_fine; ++k) {
      riis_surface *surface = NULL;
      CHECK_OK(riis_valve_set_scalar(tried, "opening", 0.25 * k));
      is_fine = riis_surface_create(tried, &coarse, &surface) == RIIS_OK;
      riis_surface_destroy(&surface);
    }
    if (is_fine) return own(tried);
    riis_valve_destroy(&tried);
  }
  return valve;
}

static riis_surface_options random_placement(int32_t triangulation) {
  riis_surface_options options = surface_options();
  options.triangulation = triangulation;
  options.scale = random_power_of_ten(&rng, -1, 1);
  options.half_thickness = 0.1 * options.scale;
  options.rotation_angle = between(-180, 180);
  for (int c = 0; c < 3; ++c)
    options.rotation_axis[c] = between(-1, 1) + (c == 2 ? 1.5 : 0),
    options.translation[c] = options.scale * between(-3, 3);
  return options;
}

/* Places a point as riis_surface_options says, by Rodrigues' formula. If `is_vector` is not 0, p is a vector, and the translation
 * is left out. */
static void place(const riis_surface_options *by, int is_vector, const double *p, double *placed) {
  const double *a = by->rotation_axis, size = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  const double angle = by->rotation_angle * acos(-1) / 180, c = cos(angle), s = sin(angle);
  const double k[3] = {a[0] / size, a[1] / size, a[2] / size}, along = k[0] * p[0] + k[1] * p[1] + k[2] * p[2];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    placed[i] = by->scale * (c * p[i] + s * (k[j] * p[l] - k[l] * p[j]) + (1 - c) * k[i] * along) +
                (is_vector ? 0 : by->translation[i]);
  }
}

static riis_warp *warp_of(int64_t n, const double *from, const double *to, const riis_surface_options *placement) {
  riis_warp_options options;
  riis_warp *warp = NULL;
  const riis_points sources = points_at(n, from), targets = points_at(n, to);
  CHECK_OK(riis_warp_options_init(&options, sizeof options));
  options.placement = placement;
  CHECK_OK(riis_warp_create(&sources, &options, &warp));
  own(warp);
  return riis_warp_set_targets(warp, &targets) == RIIS_OK ? warp : NULL;
}

static double distance_to(const riis_surface *surface, const double *p) {
  riis_closest closest;
  CHECK_OK(riis_closest_point(surface, p, &closest, sizeof closest));
  return closest.distance;
}

/* --- Landmarks on curves ---------------------------------------------------------------------------------------------- */

/* A point on a side of a patch, with its span and the parameter on this span. */
typedef struct on_side {
  int64_t patch;
  int side, piece;
  double t;
} on_side;

/* Returns the point's place at an opening, before a warp. */
static void point_on(riis_valve *valve, const on_side *at, double *point) {
  riis_valve_patches patches;
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  const int64_t piece = patches.first_piece[patches.curve_id[4 * at->patch + at->side]] + at->piece;
  const double *control = patches.control;
  for (int64_t i = 0; i < piece; ++i) control += 3 * (patches.degree[i] + 1);
  evaluate(control, patches.degree[piece], at->t, point);
}

/* Landmarks lie at random on curves of the closed valve, and move at random. At each opening, the warped valve must pass through
 * the mapped points of the curves. The arcs of mitral leaflets are left out, because a warped valve makes new arcs. */
TEST(warped_curves_pass_through_mapped_landmarks) {
  double worst = 0;
  int n_warps = 0;
  for (int trial = 0; trial < n_trials(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_kinds;
    riis_valve *valve = random_valve(kind);
    riis_surface_options options =
        random_placement(trial / n_kinds % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    riis_valve_patches patches;
    const int n = 10 + (int)between(0, 60);
    on_side at[most_landmarks];
    double from[3 * most_landmarks], to[3 * most_landmarks];
    for (int i = 0; i < n;) {
      CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
      at[i] = (on_side){(int64_t)between(0, (double)patches.n_patches), (int)between(0, kind == mitral ? 2 : 4), 0,
                        between(0, 1)};
      const int64_t *first = patches.first_piece + patches.curve_id[4 * at[i].patch + at[i].side];
      at[i].piece = (int)between(0, (double)(first[1] - first[0]));
      double p[3];
      point_on(valve, at + i, p);
      place(&options, 0, p, from + 3 * i);
      int is_new = 1;
      for (int k = 0; k < i; ++k) is_new = is_new && distance(from + 3 * i, from + 3 * k) > 0.03 * options.scale;
      i += is_new;
    }
    riis_warp *warp = NULL;
    for (double size = 0.05; !warp; size *= 0.5) {
      for (int k = 0; k < 3 * n; ++k) to[k] = from[k] + options.scale * size * between(-1, 1);
      warp = warp_of(n, from, to, &options);
    }
    riis_valve *warped = NULL;
    CHECK_OK(riis_valve_copy(valve, &warped));
    own(warped);
    CHECK_OK(riis_valve_set_warp(warped, warp, NULL));
    options.tolerance = 0.01;
    for (int step = 0; step < (is_long_test() ? 3 : 2); ++step) {
      const double opening = step == 0 ? 0 : between(0, 1);
      CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
      CHECK_OK(riis_valve_set_scalar(warped, "opening", opening));
      riis_surface *surface = NULL;
      if (riis_surface_create(warped, &options, &surface) != RIIS_OK) { /* a wild warp may turn a part over */
        assert_non_null(strstr(riis_last_error(), "the warp "));
        break;
      }
      own(surface);
      ++n_warps;
      for (int i = 0; i < n; ++i) {
        double p[3], placed[3], mapped[3];
        point_on(valve, at + i, p);
        place(&options, 0, p, placed);
        const riis_points point = points_at(1, placed);
        CHECK_OK(riis_warp_map(warp, &point, mapped));
        if (step == 0) CHECK_AT_MOST(distance(mapped, to + 3 * i), 1e-9 * options.scale);
        worst = fmax(worst, distance_to(surface, mapped) / options.scale);
      }
    }
    free_owned_after(owned_before);
  }
  printf("mapped landmarks are at most %g mm from the warped valve, in %d states\n", 10 * worst, n_warps);
  CHECK_AT_MOST(worst, 0.002);
  CHECK_MET(n_warps > 0);
}

/* --- Patients --------------------------------------------------------------------------------------------------------- */

typedef struct patient {
  int n;
  double xyz[3 * most_landmarks]; /* millimetres */
  int32_t role[most_landmarks], leaflet_id[2 * most_landmarks];
} patient;

static void add_landmark(patient *to, const double *p, double noise, int32_t role, int first, int second) {
  for (int c = 0; c < 3; ++c) to->xyz[3 * to->n + c] = p[c] + noise * between(-1.7, 1.7);
  to->role[to->n] = role;
  to->leaflet_id[2 * to->n] = first, to->leaflet_id[2 * to->n + 1] = second;
  ++to->n;
}

/* An annulus like a D, with a saddle and a kidney's bay. */
static patient random_annulus(int n, double noise) {
  patient made = {0};
  const double wide = between(15, 21), deep = wide * between(0.75, 0.9), saddle = between(1, 4), bay = between(0, 2);
  const double phase = between(-1, 1);
  for (int i = 0; i < n; ++i) {
    const double a = 2 * acos(-1) * (i + (i > 0) * between(-0.2, 0.2)) / n, r = 1 + 0.02 * cos(3 * a + phase);
    const double p[3] = {wide * sin(a) * r, deep * cos(a) * r - bay * cos(a) * cos(a), saddle * cos(2 * a)};
    add_landmark(&made, p, noise, i == 0 ? RIIS_LANDMARK_ANTERIOR_HORN : RIIS_LANDMARK_ANNULUS, -1, -1);
  }
  return made;
}

/* Three unequal cusps, with their nadirs, their commissures and m further points on each attachment. A smooth map neither makes
 * nor removes a bend. Warped attachments therefore bend at the nadirs like those of their kind: not at all, or like a V. */
static patient random_root(int kind, int m, double noise) {
  patient made = {0};
  double end[4], rise[4], radius[3], low[3];
  const double half_turn = acos(-1);
  for (int k = 0; k < 3; ++k) {
    end[k + 1] = half_turn / 180 * (120 * k + 60 + between(-6, 6)), rise[k + 1] = between(14, 18);
    radius[k] = between(11, 13), low[k] = between(-1, 1);
  }
  end[0] = end[3] - 2 * half_turn, rise[0] = rise[3];
  for (int k = 0; k < 3; ++k) {
    for (int j = 1; j <= m + 1; ++j) {
      const double s = j > m ? 1 : -1 + 2 * (j - 0.5 + between(-0.15, 0.15)) / m, steep = kind == coapting ? 0 : 0.4,
                   e = steep * fabs(s) + (1 - steep) * s * s;
      const double angle = 0.5 * ((1 - s) * end[k] + (1 + s) * end[k + 1]);
      const double r = (1 - e) * radius[k] + e * 12.5 + sin(half_turn * fabs(s));
      const double p[3] = {r * cos(angle), r * sin(angle), (1 - e) * low[k] + e * rise[k + (s > 0)]};
      if (j > m)
        add_landmark(&made, p, noise, RIIS_LANDMARK_COMMISSURE, k, (k + 1) % 3);
      else
        add_landmark(&made, p, noise, RIIS_LANDMARK_ATTACHMENT, k, -1);
    }
    const double middle = 0.5 * (end[k] + end[k + 1]),
                 p[3] = {radius[k] * cos(middle), radius[k] * sin(middle), low[k]};
    add_landmark(&made, p, noise, RIIS_LANDMARK_NADIR, k, -1);
  }
  return made;
}

/* Fits the sizes and the placement of a valve, and warps it to all landmarks exactly. Returns NULL if the warp folds. */
static riis_valve *warped_to(const patient *at, int kind, riis_surface_options *options) {
  riis_landmarks landmarks;
  riis_placement_arrays arrays;
  riis_placement placement;
  double places[3 * most_landmarks];
  riis_valve *valve = new_valve(kinds[kind]);
  CHECK_OK(riis_landmarks_init(&landmarks, sizeof landmarks));
  CHECK_OK(riis_placement_arrays_init(&arrays, sizeof arrays));
  landmarks.n_landmarks = at->n, landmarks.scale = 10, landmarks.stride = 3;
  landmarks.x = at->xyz, landmarks.y = at->xyz + 1, landmarks.z = at->xyz + 2;
  landmarks.role = at->role, landmarks.leaflet_id = at->leaflet_id;
  if (kind == mitral) landmarks.flow[2] = -1;
  arrays.place = places;
  CHECK_OK(riis_place(valve, &landmarks, "", &arrays, &placement, sizeof placement));
  *options = surface_options();
  options->scale = placement.scale, options->half_thickness = 1;
  options->rotation_angle = placement.rotation_angle;
  memcpy(options->rotation_axis, placement.rotation_axis, sizeof placement.rotation_axis);
  memcpy(options->translation, placement.translation, sizeof placement.translation);
  riis_warp *warp = warp_of(at->n, places, at->xyz, options);
  if (!warp) return NULL;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
  CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
  return valve;
}

TEST(valves_meet_the_landmarks_of_patients) {
  for (int kind = aortic; kind <= mitral; kind += trial_step())
    for (int n = 8; n <= (is_short_test() ? 8 : 24); n += is_long_test() ? 4 : 16) {
      double worst = 0;
      int n_warped = 0;
      const int n_patients = is_long_test() ? 12 : 1;
      for (int trial = 0; trial < n_patients; ++trial) {
        const int owned_before = n_owned();
        const double noise = trial % 2 && n <= 12 ? 0.1 : 0; /* noise of dense landmarks would fold the valve */
        const patient at = kind == mitral ? random_annulus(n, noise) : random_root(kind, n, noise);
        riis_surface_options options, fine;
        riis_valve *valve = warped_to(&at, kind, &options);
        riis_surface *surface = NULL;
        fine = options, fine.tolerance = is_short_test() ? 0.01 : 0.002;
        if (valve && riis_surface_create(valve, &fine, &surface) == RIIS_OK) {
          own(surface);
          ++n_warped;
          /* The commissures of an aortic valve lie between the ends of neighbouring cusps. */
          for (int i = 0; i < at.n; ++i)
            if (kind != aortic || at.role[i] != RIIS_LANDMARK_COMMISSURE)
              worst = fmax(worst, distance_to(surface, at.xyz + 3 * i));
        }
        free_owned_after(owned_before);
      }
      printf("%s, %d points: %d of %d valves are warped, landmarks are at most %.4f mm away\n", kinds[kind], n,
             n_warped, n_patients, worst);
      CHECK_AT_MOST(worst, 0.02);
      assert_int_equal(n_warped, n_patients);
    }
}

/* --- Directions of the valve ------------------------------------------------------------------------------------------ */

/* The landmarks lie around the valve, and not on its curves. */
static int64_t landmarks_around(double *xyz) {
  enum { n = 14 };
  for (int i = 0; i < n; ++i) {
    const double angle = 2.4 * i, r = between(1.6, 2), z = -1 + 2.5 * i / n;
    xyz[3 * i] = r * cos(angle), xyz[3 * i + 1] = r * sin(angle), xyz[3 * i + 2] = z;
  }
  return n;
}

static riis_attachment attachment_of(const riis_surface *surface) {
  riis_attachment attachment;
  CHECK_OK(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
  return attachment;
}

TEST(an_identity_moves_no_skirt) {
  double worst = 0, worst_near = 0;
  for (int trial = 0; trial < n_trials(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_kinds;
    riis_valve *valve = random_valve(kind), *warped = NULL;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", between(0, 1)));
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", between(0.1, 0.4)));
    CHECK_OK(riis_valve_copy(valve, &warped));
    own(warped);
    double from[3 * most_landmarks], near[3 * most_landmarks];
    const int64_t n = landmarks_around(from);
    const riis_surface_options options = random_placement(RIIS_TRIANGULATION_ADAPTED);
    const riis_surface *plain = new_surface(valve, &options);
    CHECK_OK(riis_valve_set_warp(warped, warp_of(n, from, from, NULL), NULL));
    const riis_surface *same = new_surface(warped, &options);
    const riis_triangles a = triangles_of(plain), b = triangles_of(same);
    assert_int_equal(a.n_vertices, b.n_vertices);
    for (int64_t i = 0; i < a.n_vertices; ++i)
      worst = fmax(worst, distance(a.xyz + 3 * i, b.xyz + 3 * i) / options.scale);
    /* A warp that is nearly the identity moves a skirt only little. */
    for (int64_t i = 0; i < 3 * n; ++i) near[i] = from[i] + between(-1e-5, 1e-5);
    CHECK_OK(riis_valve_set_warp(warped, warp_of(n, from, near, NULL), NULL));
    const riis_triangles c = triangles_of(new_surface(warped, &options));
    if (c.n_vertices == a.n_vertices)
      for (int64_t i = 0; i < a.n_vertices; ++i)
        worst_near = fmax(worst_near, distance(a.xyz + 3 * i, c.xyz + 3 * i) / options.scale);
    free_owned_after(owned_before);
  }
  printf("an identity moves vertices by %g, a warp of 1e-5 by %g\n", worst, worst_near);
  CHECK_AT_MOST(worst, 1e-7);
  CHECK_AT_MOST(worst_near, 2e-3);
}

/* A warp that turns, shifts and scales does what a placement does. In every other trial the landmarks lie on the attachment. */
TEST(a_rigid_warp_turns_orifice_and_skirt) {
  double worst_area = 0, worst_axis = 0;
  for (int trial = 0; trial < n_trials(); trial += trial_step()) {
    const int owned_before = n_owned(), kind = trial % n_kinds;
    riis_valve *valve = random_valve(kind);
    riis_surface_options placed =
        random_placement(trial / n_kinds % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    riis_surface_options in_place = surface_options();
    in_place.triangulation = placed.triangulation;
    in_place.half_thickness = placed.half_thickness;
    placed.tolerance = in_place.tolerance = 0.02;
    double from[3 * most_landmarks], to[3 * most_landmarks];
    int64_t n = landmarks_around(from);
    if (trial % 2) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
      const riis_attachment held = attachment_of(new_surface(valve, NULL));
      n = 0;
      for (int64_t i = 0; i < held.n_edges; i += 1 + held.n_edges / 30) {
        int is_new = 1;
        for (int64_t k = 0; k < n; ++k) is_new = is_new && distance(from + 3 * k, held.edges + 6 * i) > 0.05;
        if (is_new) memcpy(from + 3 * n++, held.edges + 6 * i, 3 * sizeof *from);
      }
    }
    for (int64_t i = 0; i < n; ++i) place(&placed, 0, from + 3 * i, to + 3 * i);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", between(0.2, 1)));
    const double skirt = between(0.1, 0.4);
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", skirt));
    const riis_surface *expected = new_surface(valve, &placed);
    CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", skirt * placed.scale)); /* a warp does not scale its length */
    CHECK_OK(riis_valve_set_warp(valve, warp_of(n, from, to, NULL), NULL));
    const riis_surface *got = new_surface(valve, &in_place);
    const double allowed = info_of(got).error_bound + info_of(expected).error_bound + 1e-6 * placed.scale;
    const riis_triangles a = triangles_of(got), b = triangles_of(expected);
    for (int64_t i = 0; i < a.n_vertices; i += 5) CHECK_AT_MOST(distance_to(expected, a.xyz + 3 * i), allowed);
    for (int64_t i = 0; i < b.n_vertices; i += 5) CHECK_AT_MOST(distance_to(got, b.xyz + 3 * i), allowed);
    riis_orifice orifice[2];
    CHECK_OK(riis_surface_get_orifice(expected, NULL, orifice, sizeof *orifice));
    CHECK_OK(riis_surface_get_orifice(got, NULL, orifice + 1, sizeof *orifice));
    assert_int_equal(orifice[0].outline, orifice[1].outline);
    worst_area = fmax(worst_area, fabs(orifice[0].area - orifice[1].area) / (1e-9 + orifice[0].outline_area));
    worst_axis = fmax(worst_axis, distance(orifice[0].axis, orifice[1].axis));
    free_owned_after(owned_before);
  }
  printf("a rigid warp changes orifices by %g of the outline, and their axes by %g\n", worst_area, worst_axis);
  CHECK_AT_MOST(worst_area, 0.005);
  CHECK_AT_MOST(worst_axis, 2e-3); /* the axis follows from the triangles, which differ */
}

int main(void) {
  rng = random_start("test_landmark_warps");
  return run_cases(NULL, NULL);
}
