/* SPDX-License-Identifier: Apache-2.0
 * Makes valves like those of healthy and sick patients: kinds with any number and sectors of cusps, and kinds with leaflets
 * around a saddle. The sizes are given or random. The code uses the public interface alone. Include after cusp_checks.h. */
#ifndef RIIS_TEST_STUDIED_VALVES_H
#define RIIS_TEST_STUDIED_VALVES_H

enum { max_leaflets = 4 };

/* The kinds of valves, and how their leaflets share the circle. valve_of reads `settings`. */
typedef struct studied {
  const char *kind;
  int n_leaflets, has_cusps;
  const char *settings;
} studied;
static const studied all_studied[] = {
    {"bicuspid", 2, 1, ""},
    {"bicuspid", 2, 1, "cusp_0.sector=150 cusp_1.sector=210"},
    {"coapting", 3, 1, ""},
    {"coapting", 3, 1, "cusp_0.sector=130 cusp_1.sector=100 cusp_2.sector=130"},
    {"quadricuspid", 4, 1, ""},
    {"quadricuspid", 4, 1, "cusp_0.sector=100 cusp_1.sector=100 cusp_2.sector=100 cusp_3.sector=60"},
    {"tricuspid", 3, 0, ""},
    {"mitral_coapting", 2, 0, ""},
};
enum { n_studied = sizeof all_studied / sizeof *all_studied };

/* Sets the parameter whose name consists of `first`, a number and `last`. */
static inline void set_numbered(riis_valve *valve, const char *first, int number, const char *last, double value) {
  char name[64];
  snprintf(name, sizeof name, "%s%d%s", first, number, last);
  CHECK_OK(riis_valve_set_scalar(valve, name, value));
}

static inline double get(const riis_valve *valve, const char *name) {
  double value;
  CHECK_OK(riis_valve_get(valve, name, 1, &value));
  return value;
}

/* Sets parameters from text, such as "root_radius=1.3 cusp_0.sector=150". */
static inline void set_all(riis_valve *valve, const char *settings) {
  char copy[512];
  snprintf(copy, sizeof copy, "%s", settings);
  for (char *name = strtok(copy, " "); name; name = strtok(NULL, " ")) {
    char *value = strchr(name, '=');
    *value++ = 0;
    CHECK_OK(riis_valve_set_scalar(valve, name, atof(value)));
  }
}

static inline riis_valve *valve_of(const char *kind, const char *settings) {
  riis_valve *valve = new_valve(kind);
  set_all(valve, settings);
  return valve;
}

static inline riis_surface *surface_at(riis_valve *valve, double opening, const riis_surface_options *options) {
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return new_surface(valve, options);
}

/* Changes every size by a random share of the size, at most `spread`. The sizes are changed in the order of the list. If a size
 * follows another size, the change starts from the value that the rule gives. A leaflet's size may follow the valve's size, which
 * has already changed. The leaflet's size therefore changes by a smaller share. meeting_shift gets a random share as its value,
 * and so does edge_stretch if it is 0. Every size stays within its range. Returns the first status that is not RIIS_OK. */
static inline riis_status vary_sizes(random_source *random, riis_valve *valve, double spread) {
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  for (int64_t id = 0; id < n; ++id) {
    riis_parameter size;
    CHECK_OK(riis_valve_get_parameter(valve, id, &size, sizeof size));
    if (size.n_values != 1 || strncmp(size.name, "bump_", 5) == 0 || strcmp(size.name, "opening") == 0) continue;
    const double part = spread * random_between(random, -1, 1) * (strchr(size.name, '.') && *size.rule ? 0.3 : 1);
    double value = (1 + part) * get(valve, size.name);
    if (strcmp(size.name, "meeting_shift") == 0) value = part;
    if (strcmp(size.name, "edge_stretch") == 0 && value == 0) value = 0.5 * fabs(part);
    value = fmin(fmax(value, size.minimum), size.maximum);
    const riis_status status = value == 0 ? RIIS_OK : riis_valve_set_scalar(valve, size.name, value);
    if (status != RIIS_OK) return status;
  }
  return RIIS_OK;
}

static inline void set_bump(riis_valve *valve, int bump, const char *name, double value) {
  char last[32];
  snprintf(last, sizeof last, ".%s", name);
  set_numbered(valve, "bump_", bump, last, value);
}

/* The diseases that a valve can have. */
typedef enum sickness { healthy, fused, with_bumps, n_sicknesses } sickness;
static const char *const names_of_sicknesses[n_sicknesses] = {"healthy", "fused", "with bumps"};

/* Fuses about half of the commissures. */
static inline void fuse(random_source *random, riis_valve *valve, const studied *of) {
  for (int k = 0; k < of->n_leaflets; ++k)
    if (random_bits(random) % 2) set_numbered(valve, "commissure_", k, ".fusion", random_between(random, 0, 0.6));
}

/* Sets one to three bumps at random places. Each change of a bump is made or omitted at random, so many valves have only one
 * disease. */
static inline void add_bumps(random_source *random, riis_valve *valve, const studied *of) {
  for (int i = (int)(random_bits(random) % 3); i >= 0; --i) {
    const int at_commissure = random_bits(random) % 3 == 0;
    set_bump(valve, i, at_commissure ? "commissure" : "leaflet", (int)random_between(random, 0, of->n_leaflets));
    set_bump(valve, i, "u", random_between(random, 0, 1));
    set_bump(valve, i, "width", random_between(random, 0.2, 1));
    if (random_bits(random) % 2) set_bump(valve, i, "open", random_between(random, 0, 1));
    if (random_bits(random) % 2) set_bump(valve, i, "closed", random_between(random, 0, 0.5));
    if (!of->has_cusps && !at_commissure && random_bits(random) % 2)
      set_bump(valve, i, "lift", random_between(random, -0.5, 1));
  }
}

/* Makes a valve of random sizes. Returns NULL if the library refuses the sizes. */
static inline riis_valve *random_valve(random_source *random, const studied *of, double spread, sickness has) {
  riis_valve *valve = valve_of(of->kind, of->settings);
  riis_surface *surface = NULL;
  riis_status status = vary_sizes(random, valve, spread);
  if (status == RIIS_OK) {
    if (has == fused) fuse(random, valve, of);
    if (has == with_bumps) add_bumps(random, valve, of);
    status = riis_surface_create(valve, NULL, &surface);
  }
  riis_surface_destroy(&surface);
  if (status == RIIS_OK) return valve;
  if (status != RIIS_INVALID_PARAMETER) fail_msg("%s: %s", riis_status_name(status), riis_last_error());
  printf("  refused: %s\n", riis_last_error());
  free_one_owned(valve);
  return NULL;
}

/* Prints the values with which a valve was made. */
static inline void print_values(const riis_valve *valve) {
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  for (int64_t id = 0; id < n; ++id) {
    riis_parameter parameter;
    int32_t is_set;
    CHECK_OK(riis_valve_get_parameter(valve, id, &parameter, sizeof parameter));
    CHECK_OK(riis_valve_is_set(valve, parameter.name, &is_set));
    if (is_set && parameter.n_values == 1) printf(" %s=%.10g", parameter.name, get(valve, parameter.name));
  }
  printf("\n");
}

/* Returns whether a point lies inside the line of attachment, seen along the axis. */
static inline int is_inside(const riis_attachment *attachment, double x, double y) {
  int inside = 0;
  for (int64_t i = 0; i < attachment->n_edges; ++i) {
    const double *p = attachment->edges + 6 * i, *q = p + 3;
    if ((p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])) inside = !inside;
  }
  return inside;
}

enum { half_width = 2 }; /* an annulus fits between -half_width and half_width */

#endif
