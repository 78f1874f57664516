/* SPDX-License-Identifier: Apache-2.0
 * count_markings MARKINGS [INSTRUCTIONS [WORD...]]
 * Marks one mesh repeatedly on one thread, so that the instructions of a marking can be counted. INSTRUCTIONS is one of
 * RIIS_INSTRUCTIONS_*, by default the baseline. The words `K` and `sides` request K and the sides of nodes. With the word
 * `moving`, the valve opens before each marking. Any other word is the kind of the valve. Prints the number of marked nodes, and
 * a digest of the nodes and distances. */
#include <inttypes.h>
#include <riis/riis.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { n_along = 41, n_nodes = n_along * n_along * n_along };

/* Moves each node of a grid to another place in its cell. */
static void place_nodes(double *xyz) {
  static const double from[3] = {-1.6, -1.6, -0.8};
  uint64_t state = 12345;
  for (int i = 0; i < n_nodes; ++i) {
    const int at[3] = {i % n_along, i / n_along % n_along, i / n_along / n_along};
    for (int c = 0; c < 3; ++c) {
      state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
      xyz[3 * i + c] = from[c] + 3.2 * (at[c] + (double)(state >> 40) / 16777216.0) / n_along;
    }
  }
}

static void check(riis_status status) {
  if (!status) return;
  fprintf(stderr, "%s\n", riis_last_error());
  exit(1);
}

int main(int argc, char **argv) {
  if (argc < 2) {
    fprintf(stderr, "usage: %s MARKINGS [INSTRUCTIONS [K | sides | moving | KIND]...]\n", argv[0]);
    return 2;
  }
  static double xyz[3 * n_nodes];
  place_nodes(xyz);
  riis_resistance resistance;
  riis_resistance_init(&resistance, sizeof resistance);
  resistance.R = 1e4;
  riis_mark_options options;
  riis_mark_options_init(&options, sizeof options);
  options.n_threads = 1;
  options.instructions = argc > 2 ? (int32_t)strtol(argv[2], NULL, 10) : RIIS_INSTRUCTIONS_BASELINE;
  const char *kind = "coapting";
  bool is_moving = false;
  for (int i = 3; i < argc; ++i) {
    if (strcmp(argv[i], "K") == 0)
      options.resistance = &resistance;
    else if (strcmp(argv[i], "sides") == 0)
      options.fields |= RIIS_FIELD_SIDE;
    else if (strcmp(argv[i], "moving") == 0)
      is_moving = true;
    else
      kind = argv[i];
  }
  riis_valve *valve = NULL, *valve_before = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  check(riis_valve_create(kind, &valve));
  check(riis_valve_create(kind, &valve_before));
  check(riis_valve_set_scalar(valve, "opening", 0.5));
  riis_surface_options of_surface;
  riis_surface_options_init(&of_surface, sizeof of_surface);
  of_surface.half_thickness = 0.05;
  of_surface.n_threads = 1;
  check(riis_surface_create(valve, &of_surface, &surface));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_marks_create(&marks));
  const long n_markings = strtol(argv[1], NULL, 10);
  for (long i = 1; i <= n_markings; ++i) {
    if (is_moving) {
      check(riis_valve_set_scalar(valve_before, "opening", 0.5 + 0.01 * (double)(i - 1)));
      check(riis_valve_set_scalar(valve, "opening", 0.5 + 0.01 * (double)i));
      check(riis_surface_update_moving(surface, valve, valve_before, 0.01, NULL, NULL));
    }
    check(riis_mark_nodes(surface, mesh, &options, marks));
  }
  riis_mark_list list = {0};
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &list, sizeof list));
  uint64_t digest = UINT64_C(0xcbf29ce484222325);
  for (int64_t i = 0; i < list.n_nodes; ++i) {
    uint64_t bits;
    memcpy(&bits, list.distance + i, sizeof bits);
    digest = ((digest ^ (uint64_t)list.node_id[i]) * UINT64_C(0x100000001b3) ^ bits) * UINT64_C(0x100000001b3);
  }
  printf("%" PRId64 " nodes marked, digest %016" PRIx64 "\n", list.n_nodes, digest);
  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve_before);
  riis_valve_destroy(&valve);
  return 0;
}
