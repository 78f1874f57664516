/* SPDX-License-Identifier: Apache-2.0
 * Tests a restart in the middle of a cycle. Two valves follow laws of opening, and a restart file holds only the states of these
 * laws. Until the end of the cycle, K and K u_surface have the bits of a run without the restart. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

enum { per_side = 16, n_nodes = per_side * per_side * per_side, n_steps = 40, n_before = 9 };
static const double dt = 0.01;

/* The content of the restart file. */
typedef struct laws {
  riis_opening_switch_state aortic;
  riis_opening_angle_state mitral;
} laws;

static laws laws_at_start(void) {
  laws state;
  CHECK_OK(riis_opening_switch_state_init(&state.aortic, sizeof state.aortic));
  CHECK_OK(riis_opening_angle_state_init(&state.mitral, sizeof state.mitral));
  return state;
}

/* In systole the aortic valve opens, and closes as the flow reverses. Then the mitral valve opens. */
static void advance(laws *state, double time) {
  riis_opening_switch by_switch;
  riis_opening_angle by_angle;
  CHECK_OK(riis_opening_switch_init(&by_switch, sizeof by_switch));
  by_switch.opening_duration = by_switch.closing_duration = 0.1;
  by_switch.filter_time = 0.005;
  CHECK_OK(riis_opening_angle_init(&by_angle, sizeof by_angle));
  by_angle.pressure_gain = 5500;
  by_angle.flow_gain = 2;
  by_angle.friction = 50;
  by_angle.vortex_gain = 3.5;
  const double wave = sin(16 * time);
  CHECK_OK(riis_opening_switch_advance(&by_switch, &state->aortic, time, 5 * wave, 300 * sin(16 * time - 0.3),
                                       &state->aortic));
  CHECK_OK(riis_opening_angle_advance(&by_angle, &state->mitral, time, 0.1 * wave, 20 * wave, &state->mitral));
}

/* A valve now and one step before. */
typedef struct moving_valve {
  riis_valve *now, *before;
  riis_surface *surface;
} moving_valve;

static moving_valve valve_at(const char *kind, double opening, double height) {
  moving_valve valve = {new_valve(kind), NULL, NULL};
  if (strcmp(kind, "aortic") == 0) {
    riis_valve *open = new_valve(kind);
    CHECK_OK(riis_valve_set_scalar(open, "leaflet_angle", 40));
    CHECK_OK(riis_valve_set_open_state(valve.now, open));
    free_one_owned(open);
  }
  CHECK_OK(riis_valve_set_scalar(valve.now, "opening", opening));
  CHECK_OK(riis_valve_copy(valve.now, &valve.before));
  own(valve.before);
  riis_surface_options options = surface_options();
  options.half_thickness = 0.2;
  options.translation[2] = height;
  valve.surface = new_surface(valve.now, &options);
  return valve;
}

static void move(const moving_valve *valve, double opening) {
  CHECK_OK(riis_valve_set_scalar(valve->now, "opening", opening));
  CHECK_OK(riis_surface_update_moving(valve->surface, valve->now, valve->before, dt, NULL, NULL));
  CHECK_OK(riis_valve_set_scalar(valve->before, "opening", opening));
}

static void add_resistance(const moving_valve *valve, const riis_mesh *mesh, riis_marks *result, double *fields) {
  riis_mark_options options = mark_options();
  options.fields = RIIS_FIELD_VELOCITY;
  CHECK_OK(riis_mark_nodes(valve->surface, mesh, &options, result));
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1e4;
  CHECK_OK(add_resistance_to(result, &resistance, n_nodes, fields, fields + n_nodes));
}

/* Runs the steps from `first` to `last`, starting from the state before. `fields` gets K and K u_surface of every step. */
static void run(laws *state, int first, int last, double *fields, const double *xyz) {
  const int n = n_owned();
  const moving_valve aortic = valve_at("aortic", state->aortic.opening, 0.8),
                     mitral = valve_at("mitral", state->mitral.opening, -0.8);
  riis_mesh *mesh = mesh_of(n_nodes, xyz);
  riis_marks *result = NULL;
  CHECK_OK(riis_marks_create(&result));
  own(result);
  for (int i = first; i <= last; ++i) {
    advance(state, i * dt);
    move(&aortic, state->aortic.opening);
    move(&mitral, state->mitral.opening);
    add_resistance(&aortic, mesh, result, fields + (size_t)i * 4 * n_nodes);
    add_resistance(&mitral, mesh, result, fields + (size_t)i * 4 * n_nodes);
  }
  free_owned_after(n);
}

static laws through_a_file(const laws *written) {
  laws read;
  FILE *file = tmpfile();
  assert_non_null(file);
  assert_int_equal(fwrite(written, sizeof *written, 1, file), 1);
  rewind(file);
  assert_int_equal(fread(&read, sizeof read, 1, file), 1);
  fclose(file);
  return read;
}

TEST(a_restart_in_mid_cycle_has_the_same_resistance_to_the_end) {
  double *xyz = own(malloc((size_t)3 * n_nodes * sizeof *xyz));
  for (int i = 0; i < n_nodes; ++i) {
    const int at[3] = {i % per_side, i / per_side % per_side, i / (per_side * per_side)};
    for (int c = 0; c < 3; ++c) xyz[3 * i + c] = (c == 2 ? -3 : -2) + (c == 2 ? 0.4 : 0.26) * at[c];
  }
  const size_t n_values = (size_t)(n_steps + 1) * 4 * n_nodes;
  double *whole = own(calloc(n_values, sizeof *whole)), *restarted = own(calloc(n_values, sizeof *restarted));

  laws at_once = laws_at_start(), state = laws_at_start();
  run(&at_once, 1, n_steps, whole, xyz);
  run(&state, 1, n_before, restarted, xyz);
  assert_true(state.aortic.opening > 0.1 && state.aortic.opening < 0.9); /* both valves are in motion */
  assert_true(state.mitral.opening > 0.1 && state.mitral.opening < 0.9);
  state = through_a_file(&state);
  run(&state, n_before + 1, n_steps, restarted, xyz);

  assert_memory_equal(&at_once, &state, sizeof state);
  for (int i = 1; i <= n_steps; ++i) {
    const double *a = whole + (size_t)i * 4 * n_nodes, *b = restarted + (size_t)i * 4 * n_nodes;
    double most = 0, fastest = 0;
    for (int k = 0; k < n_nodes; ++k) most = fmax(most, a[k]);
    for (int k = n_nodes; k < 4 * n_nodes; ++k) fastest = fmax(fastest, fabs(a[k]));
    assert_true(most > 1e5);
    if (i == n_before + 1) assert_true(fastest > 1e5); /* the compared values come from a moving valve */
    if (memcmp(a, b, (size_t)4 * n_nodes * sizeof *a) != 0) fail_msg("step %d after a restart differs", i);
  }
}

int main(void) { return run_cases(NULL, NULL); }
