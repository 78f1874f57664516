/* SPDX-License-Identifier: Apache-2.0
 * embree_cost LIBRARY OTHER_LIBRARY: compares two builds of libriis with different versions of Embree (python/embree.sh cost).
 * The program compares everything that riis does with Embree: single queries and updates. Both builds take turns in one process
 * on one thread, and their processor time counts. The distances of both builds must have the same bits. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { n_points = 60, n_rounds = 300 }; /* so few points are queried one by one, even if the surface is coarse */

/* The functions of a library that this program calls. */
#define FUNCTIONS(X)      \
  X(valve_create)         \
  X(valve_set_scalar)     \
  X(surface_options_init) \
  X(surface_create)       \
  X(surface_update)       \
  X(points_init)          \
  X(closest_options_init) \
  X(closest_arrays_init)  \
  X(closest_points)       \
  X(valve_destroy)        \
  X(surface_destroy)      \
  X(last_error)
typedef struct library {
#define MEMBER(name) __typeof__(&riis_##name) name;
  FUNCTIONS(MEMBER)
  riis_valve *valves[2];
  riis_surface *surface;
  riis_surface_options options;
  double distance[n_points];
} library;

static double xyz[3 * n_points];

static void stop(const char *message) {
  fprintf(stderr, "embree_cost: %s\n", message);
  exit(1);
}

static void check(const library *lib, riis_status status) {
  if (status != RIIS_OK) stop(lib->last_error());
}

static void load(const char *file, library *lib) {
  void *handle = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!handle) stop(dlerror());
#define LOAD(name)                                     \
  *(void **)&lib->name = dlsym(handle, "riis_" #name); \
  if (!lib->name) stop("a function is missing: riis_" #name);
  FUNCTIONS(LOAD)
}

static void make_surface(library *lib, const char *kind) {
  for (int i = 0; i < 2; ++i) {
    check(lib, lib->valve_create(kind, &lib->valves[i]));
    check(lib, lib->valve_set_scalar(lib->valves[i], "opening", 0.5 + 0.1 * i));
  }
  check(lib, lib->surface_options_init(&lib->options, sizeof lib->options));
  lib->options.n_threads = 1;
  check(lib, lib->surface_create(lib->valves[0], &lib->options, &lib->surface));
}

static void query(library *lib, double limit) {
  riis_points points;
  riis_closest_options options;
  riis_closest_arrays arrays;
  check(lib, lib->points_init(&points, sizeof points));
  points.n_points = n_points;
  points.x = xyz, points.y = xyz + 1, points.z = xyz + 2;
  points.stride = 3;
  check(lib, lib->closest_options_init(&options, sizeof options));
  options.n_threads = 1;
  options.distance_limit = limit;
  check(lib, lib->closest_arrays_init(&arrays, sizeof arrays));
  arrays.distance = lib->distance;
  check(lib, lib->closest_points(lib->surface, &points, &options, &arrays));
}

static void update(library *lib) {
  for (int i = 1; i >= 0; --i) check(lib, lib->surface_update(lib->surface, lib->valves[i], &lib->options));
}

/* Returns the processor time of a round, in microseconds for each query or update. */
static double round_of(library *lib, double limit) {
  struct timespec begin, end;
  if (limit >= 0) query(lib, limit); /* fills the caches */
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
  if (limit >= 0)
    query(lib, limit);
  else
    update(lib);
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
  const double seconds = (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
  return 1e6 * seconds / (limit >= 0 ? n_points : 2);
}

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Measures queries within a limit, or updates if the limit is negative. */
static void measure(library *libs, const char *kind, const char *name, double limit) {
  double least[2] = {INFINITY, INFINITY}, ratios[n_rounds];
  for (int round = 0; round < n_rounds; ++round) {
    double times[2];
    for (int turn = 0; turn < 2; ++turn) {
      const int k = (turn + round) % 2;
      times[k] = round_of(&libs[k], limit);
      least[k] = fmin(least[k], times[k]);
    }
    ratios[round] = times[1] / times[0];
    if (memcmp(libs[0].distance, libs[1].distance, sizeof libs[0].distance)) stop("the distances differ");
  }
  qsort(ratios, n_rounds, sizeof *ratios, compare);
  printf("%-8s %-24s %10.3f %10.3f %10.3f %10.3f\n", kind, name, least[0], least[1], least[1] / least[0],
         ratios[n_rounds / 2]);
}

int main(int argc, char **argv) {
  static library libs[2];
  if (argc != 3) stop("usage: embree_cost LIBRARY OTHER_LIBRARY");
  for (int k = 0; k < 2; ++k) load(argv[1 + k], &libs[k]);
  srand(5);
  for (int i = 0; i < 3 * n_points; ++i) xyz[i] = -1.6 + 3.2 * rand() / RAND_MAX;
  printf("%-33s %10s %10s %10s %10s\n", "least processor time, us", "first", "second", "ratio", "median");
  for (int kind = 0; kind < 2; ++kind) {
    const char *name = kind ? "mitral" : "aortic";
    for (int k = 0; k < 2; ++k) make_surface(&libs[k], name);
    measure(libs, name, "a query", INFINITY);
    measure(libs, name, "a query within 0.2 cm", 0.2);
    measure(libs, name, "an update", -1);
    for (int k = 0; k < 2; ++k) {
      libs[k].surface_destroy(&libs[k].surface);
      for (int i = 0; i < 2; ++i) libs[k].valve_destroy(&libs[k].valves[i]);
    }
  }
  return 0;
}
