/* SPDX-License-Identifier: Apache-2.0
 * Tests surfaces from keyframes. Positions and velocities are compared with closed forms. Further cases test periods and
 * refusals. */
#include <riis/riis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "test_support.h"

#include "handles.h"

static random_source rng;

enum { n_vertices = 4, n_faces = 2, most_keys = 5 };
static const int32_t ids[3 * n_faces] = {0, 1, 2, 0, 2, 3};

static riis_surface_arrays square(void) {
  riis_surface_arrays faces;
  CHECK_OK(riis_surface_arrays_init(&faces, sizeof faces));
  faces.n_vertices = n_vertices;
  faces.n_faces = n_faces;
  faces.vertex_ids = ids;
  return faces;
}

/* A square that moves up and down. At key k, the square's height is height[k]. */
typedef struct swing {
  double time[most_keys], xyz[3 * n_vertices * most_keys];
  riis_keyframe_arrays frames;
} swing;

static void make_swing(swing *s, int64_t n_keys, const double *time, const double *height) {
  static const double corner[n_vertices][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK_OK(riis_keyframe_arrays_init(&s->frames, sizeof s->frames));
  for (int64_t k = 0; k < n_keys; ++k) {
    s->time[k] = time[k];
    for (int v = 0; v < n_vertices; ++v) {
      double *to = s->xyz + 3 * (n_vertices * k + v);
      to[0] = corner[v][0];
      to[1] = corner[v][1];
      to[2] = height[k];
    }
  }
  s->frames.n_keys = n_keys;
  s->frames.n_vertices = n_vertices;
  s->frames.time = s->time;
  s->frames.xyz = s->xyz;
}

static riis_keyframes *keyframes_of(const swing *s) {
  const riis_surface_arrays faces = square();
  riis_keyframes *keyframes = NULL;
  CHECK_OK(riis_keyframes_create(&faces, &s->frames, &keyframes));
  return keyframes;
}

static void check_height(const riis_surface *surface, double height, double speed) {
  int64_t n = triangles_of(surface).n_vertices;
  const double *xyz = triangles_of(surface).xyz;
  n = triangles_of(surface).n_vertices;
  const double *velocity = triangles_of(surface).velocity;
  assert_int_equal(n, n_vertices);
  for (int64_t i = 0; i < n; ++i) {
    CHECK_NEAR(xyz[3 * i + 2], height, 1e-13);
    CHECK_NEAR(velocity[3 * i], 0, 0);
    CHECK_NEAR(velocity[3 * i + 2], speed, 1e-12);
  }
}

TEST(linear_frames_have_right_hand_and_mean_velocities) {
  const double time[] = {0, 1, 3}, height[] = {0, 2, 1};
  swing s;
  make_swing(&s, 3, time, height);
  riis_keyframes *keyframes = keyframes_of(&s);
  memset(s.xyz, 0, sizeof s.xyz); /* the arrays were copied, so they may change */
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create_from_keyframes(keyframes, 0.25, 0, NULL, &surface));
  check_height(surface, 0.5, 2);
  CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, 1, 0, NULL));
  check_height(surface, 2, -0.5);
  CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, 2, 2 - 0.5, NULL)); /* the step crosses a key */
  check_height(surface, 1.5, 0.5 / 1.5);
  CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, 0.5, 0.5 - 2, NULL)); /* time goes backwards */
  check_height(surface, 1, (1 - 1.5) / (0.5 - 2));
  CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, 9, 0, NULL));
  check_height(surface, 1, 0);
  CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, -1, 0, NULL));
  check_height(surface, 0, 0);
  riis_surface_destroy(&surface);
  riis_keyframes_destroy(&keyframes);
  assert_null(keyframes);
}

/* At a key, the velocity is that of the interval after the key, in every period. The key's time plus the periods is a rounded
 * sum. */
TEST(frames_have_the_velocity_after_them_in_every_period) {
  const double time[] = {-0.08, 0.15, 0.24, 0.42, 0.65}, height[] = {0, 2, 1, 3, 0.5};
  swing s;
  make_swing(&s, 5, time, height);
  s.frames.period = 0.83;
  riis_keyframes *keyframes = keyframes_of(&s);
  riis_surface *surface = NULL;
  CHECK_OK(riis_surface_create_from_keyframes(keyframes, 0, 0, NULL, &surface));
  for (int i = -2; i <= 1000; ++i)
    for (int key = 0; key < 5; ++key) {
      const double t = time[key] + 0.83 * i;
      const double width = key == 4 ? time[0] + 0.83 - time[4] : time[key + 1] - time[key];
      CHECK_OK(riis_surface_update_from_keyframes(surface, keyframes, t, 0, NULL));
      check_height(surface, height[key], (height[(key + 1) % 5] - height[key]) / width);
    }
  riis_surface_destroy(&surface);
  riis_keyframes_destroy(&keyframes);
}

TEST(frames_repeat_and_are_placed) {
  const double time[] = {0, 0.25, 0.5, 1}, height[] = {0, 0.1, 0.3, 0};
  for (int32_t interpolation = 0; interpolation <= 1; ++interpolation) {
    swing s;
    make_swing(&s, 4, time, height);
    s.frames.period = 1;
    s.frames.interpolation = interpolation;
    riis_keyframes *keyframes = keyframes_of(&s);
    riis_surface *a = NULL, *b = NULL;
    riis_surface_options options = surface_options();
    options.scale = 2;
    options.translation[2] = 5;
    CHECK_OK(riis_surface_create_from_keyframes(keyframes, 0, 0, NULL, &a));
    CHECK_OK(riis_surface_create_from_keyframes(keyframes, 0, 0, &options, &b));
    for (int i = 0; i < 100; ++i) {
      const double t = random_between(&rng, 0, 1);
      CHECK_OK(riis_surface_update_from_keyframes(a, keyframes, t, 0, NULL));
      const double *xyz = triangles_of(a).xyz;
      const double *velocity = triangles_of(a).velocity;
      CHECK_OK(riis_surface_update_from_keyframes(b, keyframes, t - 3, 0, NULL));
      check_height(b, 5 + 2 * xyz[2], 2 * velocity[2]);
      if (interpolation == RIIS_INTERPOLATION_LINEAR) {
        CHECK_NEAR(xyz[2], t < 0.25 ? 0.4 * t : t < 0.5 ? 0.1 + 0.8 * (t - 0.25) : 0.6 * (1 - t), 1e-14);
        continue;
      }
      /* With cubic interpolation, the velocity is the derivative of the cubic. */
      const double h = 1e-6, rate = velocity[2];
      CHECK_OK(riis_surface_update_from_keyframes(a, keyframes, t + h, t + h - (t - h), NULL));
      velocity = triangles_of(a).velocity;
      CHECK_NEAR(velocity[2], rate, 1e-4);
    }
    riis_surface_destroy(&a);
    riis_surface_destroy(&b);
    riis_keyframes_destroy(&keyframes);
  }
}

TEST(bad_frames_are_refused) {
  const double time[] = {0, 1, 2}, height[] = {0, 2, 1};
  const riis_surface_arrays faces = square();
  riis_keyframes *keyframes = NULL;
  swing s;
#define REFUSED(status, parts) CHECK_REFUSED(status, parts, riis_keyframes_create(&faces, &s.frames, &keyframes))
  make_swing(&s, 3, time, height);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays is NULL", riis_keyframes_create(NULL, &s.frames, &keyframes));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "frames", riis_keyframes_create(&faces, NULL, &keyframes));
  s.time[1] = 3;
  REFUSED(RIIS_INVALID_ARGUMENT, "frames.time of key 2 is 2");
  make_swing(&s, 3, time, height);
  s.frames.n_vertices = 5;
  REFUSED(RIIS_INVALID_ARGUMENT, "frames.n_vertices is 5|4");
  make_swing(&s, 3, time, height);
  s.frames.period = 1;
  REFUSED(RIIS_INVALID_ARGUMENT, "frames.time of key 2 is 2|period of 1");
  s.frames.period = 2;
  REFUSED(RIIS_INVALID_SURFACE, "vertex 0 in the last frame|z 1");
  make_swing(&s, 3, time, height);
  s.xyz[3 * n_vertices + 4] = NAN;
  REFUSED(RIIS_INVALID_SURFACE, "y of vertex 1 in frame 1 is nan");
  make_swing(&s, 3, time, height);
  s.frames.interpolation = 7;
  REFUSED(RIIS_INVALID_ARGUMENT, "frames.interpolation is 7");
  make_swing(&s, 3, time, height);
  s.frames.xyz = NULL;
  REFUSED(RIIS_INVALID_ARGUMENT, "frames.xyz");
  assert_null(keyframes);
  make_swing(&s, 3, time, height);
  keyframes = keyframes_of(&s);
  riis_surface *surface = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "time is nan",
                riis_surface_create_from_keyframes(keyframes, NAN, 0, NULL, &surface));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "dt is -inf|from 1e-30 to 1e+30",
                riis_surface_create_from_keyframes(keyframes, 0, 0 - INFINITY, NULL, &surface));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "keyframes", riis_surface_create_from_keyframes(NULL, 0, 0, NULL, &surface));
  assert_null(surface);
  riis_keyframes_destroy(&keyframes);
}

int main(void) {
  rng = random_start("test_keyframes");
  return run_cases(NULL, NULL);
}
