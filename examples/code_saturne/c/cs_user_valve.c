/* SPDX-License-Identifier: Apache-2.0
 * Puts a heart valve into code_saturne 6.0, by head losses, in C. The momentum equation gets the source -K (u - u_surface).
 * K / rho is a head loss, which code_saturne's pressure equation takes into account. K u_surface is an explicit source term.
 * */
#include "cs_defs.h"
#include "cs_headers.h"
#include "record.h"
#include "settings.h"

#include <math.h>
#include <riis/riis.h>
#include <string.h>

BEGIN_C_DECLS

/* The objects of riis are made in the first time step. */
static riis_valve *valve, *valve_before;
static riis_surface *surface;
static riis_mesh *mesh;
static riis_marks *marks;
static riis_mark_options mark_options;
static riis_resistance resistance;
static riis_opening_switch law;
static riis_opening_switch_state state; /* state.opening is the opening of the last time step */
static double *coefficient;             /* (n_cells), K in kg/(m3 s) */
static double *momentum;                /* (3, n_cells), K u_surface in N/m3 */
static double mesh_lower[3], mesh_upper[3];

/* Stops the run with the library's message and the time step. */
static void check(riis_status status) {
  if (status != RIIS_OK)
    bft_error(__FILE__, __LINE__, 0, "riis: time step %d: %s: %s", cs_glob_time_step->nt_cur, riis_status_name(status),
              riis_last_error());
}

/* ---- The checkpoint: the state of the law, and the parameters of its valve. ---- */

enum { n_state = 8, most_parameters = 64 };

/* Copies all values of the valve's parameters, one after the other, and returns their number. "opening" is left out. */
static int get_parameters(double values[most_parameters]) {
  int64_t n_parameters = 0;
  int n = 0;
  check(riis_valve_get_n_parameters(valve, &n_parameters));
  for (int64_t i = 0; i < n_parameters; ++i) {
    riis_parameter parameter;
    check(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    if (strcmp(parameter.name, "opening") == 0) continue;
    if (n + parameter.n_values > most_parameters)
      bft_error(__FILE__, __LINE__, 0, "riis: the valve has too many parameters");
    check(riis_valve_get(valve, parameter.name, parameter.n_values, values + n));
    n += (int)parameter.n_values;
  }
  return n;
}

static void write_checkpoint(void) {
  double parameters[most_parameters];
  const int n = get_parameters(parameters);
  const double values[n_state] = {state.time, state.opening,   state.rate, state.progress, state.pressure_difference,
                                  state.flow, state.turn_time, state.phase};
  cs_restart_t *file = cs_restart_create("riis", NULL, CS_RESTART_MODE_WRITE);
  cs_restart_write_section(file, "parameters", CS_MESH_LOCATION_NONE, n, CS_TYPE_cs_real_t, parameters);
  cs_restart_write_section(file, "law", CS_MESH_LOCATION_NONE, n_state, CS_TYPE_cs_real_t, values);
  cs_restart_destroy(&file);
}

static void read_checkpoint(void) {
  double parameters[most_parameters], stored[most_parameters], values[n_state];
  const int n = get_parameters(parameters), step = cs_glob_time_step->nt_cur;
  cs_restart_t *file = cs_restart_create("riis", NULL, CS_RESTART_MODE_READ);
  if (cs_restart_read_section(file, "parameters", CS_MESH_LOCATION_NONE, n, CS_TYPE_cs_real_t, stored) !=
      CS_RESTART_SUCCESS)
    bft_error(__FILE__, __LINE__, 0, "riis: time step %d: the checkpoint is of another kind of valve, or of none",
              step);
  for (int i = 0; i < n; ++i)
    if (stored[i] != parameters[i])
      bft_error(__FILE__, __LINE__, 0,
                "riis: time step %d: the checkpoint is of another valve: value %d of its parameters is %g, not %g",
                step, i, stored[i], parameters[i]);
  if (cs_restart_read_section(file, "law", CS_MESH_LOCATION_NONE, n_state, CS_TYPE_cs_real_t, values) !=
      CS_RESTART_SUCCESS)
    bft_error(__FILE__, __LINE__, 0, "riis: time step %d: the checkpoint has no state of the valve's law", step);
  cs_restart_destroy(&file);
  state.time = values[0];
  state.opening = values[1];
  state.rate = values[2];
  state.progress = values[3];
  state.pressure_difference = values[4];
  state.flow = values[5];
  state.turn_time = values[6];
  state.phase = (int32_t)values[7];
}

/* ---- The valve. ---- */

static void create_valve(void) {
  const cs_mesh_t *m = cs_glob_mesh;
  const cs_real_t *centre = cs_glob_mesh_quantities->cell_cen;
  check(riis_opening_switch_init(&law, sizeof law));
  law.opening_duration = 0.04;
  law.closing_duration = 0.04;
  law.filter_time = 0.002;
  law.dwell_time = 0.02;
  check(riis_opening_switch_state_init(&state, sizeof state));
  if (setting("VALVE_OPENING") >= 0) state.opening = setting("VALVE_OPENING");
  check(riis_valve_create(valve_kind(), &valve));
  if (cs_restart_present()) read_checkpoint();
  check(riis_valve_set_scalar(valve, "opening", state.opening));
  check(riis_valve_copy(valve, &valve_before));

  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01; /* the valve is in centimetres, the mesh in metres */
  options.half_thickness = setting("VALVE_HALF_THICKNESS");
  options.translation[2] = setting("VALVE_Z");
  options.n_threads = 1; /* each processor has a rank of its own */
  check(riis_surface_create(valve, &options, &surface));
  /* A rank without cells makes the same calls. */
  check(riis_mesh_create(m->n_cells, centre, centre + 1, centre + 2, 3, &mesh));
  check(riis_mesh_prepare(mesh, 1));
  check(riis_marks_create(&marks));
  check(riis_mark_options_init(&mark_options, sizeof mark_options));
  mark_options.n_threads = 1;
  mark_options.fields = RIIS_FIELD_VELOCITY;
  check(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = setting("VALVE_RESISTANCE");
  BFT_MALLOC(coefficient, m->n_cells, double);
  BFT_MALLOC(momentum, 3 * m->n_cells, double);
  memset(coefficient, 0, sizeof(double) * (size_t)m->n_cells);
  memset(momentum, 0, 3 * sizeof(double) * (size_t)m->n_cells);

  for (int k = 0; k < 3; ++k) {
    mesh_lower[k] = HUGE_VAL;
    mesh_upper[k] = -HUGE_VAL;
  }
  for (cs_lnum_t i = 0; i < m->n_vertices; ++i)
    for (int k = 0; k < 3; ++k) {
      mesh_lower[k] = CS_MIN(mesh_lower[k], m->vtx_coord[3 * i + k]);
      mesh_upper[k] = CS_MAX(mesh_upper[k], m->vtx_coord[3 * i + k]);
    }
  cs_parall_min(3, CS_DOUBLE, mesh_lower);
  cs_parall_max(3, CS_DOUBLE, mesh_upper);
}

/* Advances the law by the pressures and the flow of the last time step, as means over slabs of the tubes. */
static void advance_law(void) {
  const cs_mesh_quantities_t *q = cs_glob_mesh_quantities;
  const cs_real_3_t *u = (const cs_real_3_t *)CS_F_(vel)->val;
  /* The volume of a slab, and the integrals of pressure and velocity over it. */
  double upstream[3] = {0}, downstream[2] = {0};
  for (cs_lnum_t c = 0; c < cs_glob_mesh->n_cells; ++c) {
    const double z = q->cell_cen[3 * c + 2], v = q->cell_vol[c], p = CS_F_(p)->val[c];
    if (z > -0.022 && z < -0.018) {
      upstream[0] += v;
      upstream[1] += v * p;
      upstream[2] += v * u[c][2];
    } else if (z > 0.010 && z < 0.014) {
      downstream[0] += v;
      downstream[1] += v * p;
    }
  }
  cs_parall_sum(3, CS_DOUBLE, upstream);
  cs_parall_sum(2, CS_DOUBLE, downstream);
  const double drop = upstream[1] / upstream[0] - downstream[1] / downstream[0];
  const double flow = upstream[2] / 0.004; /* the slab's length in metres */
  /* The time is not t_cur, because after a restart code_saturne's own sum of its time steps differs in its last bits. */
  const double time = cs_glob_time_step->nt_cur * cs_glob_time_step->dt_ref;
  check(riis_opening_switch_advance(&law, &state, time, drop, flow, &state));
}

/* Refuses a valve that has left the mesh. No cell would then be marked, and the flow would pass as if there were no valve. The
 * attachment of an open valve is up to a half thickness outside the wall. */
static void check_place(void) {
  riis_surface_info info;
  check(riis_surface_get_info(surface, &info, sizeof info));
  for (int k = 0; k < 3; ++k)
    if (info.lower[k] < mesh_lower[k] - info.half_thickness || info.upper[k] > mesh_upper[k] + info.half_thickness)
      bft_error(__FILE__, __LINE__, 0,
                "riis: time step %d: the valve leaves the mesh: its %c is from %g to %g m, the mesh's from %g to %g m",
                cs_glob_time_step->nt_cur, "xyz"[k], info.lower[k], info.upper[k], mesh_lower[k], mesh_upper[k]);
}

/* Computes K and K u_surface of this time step. */
static void advance_valve(void) {
  const double start = record_clock();
  if (valve == NULL) create_valve();
  if (setting("VALVE_OPENING") < 0) advance_law();
  check(riis_valve_set_scalar(valve, "opening", state.opening));
  check(riis_surface_update_moving(surface, valve, valve_before, cs_glob_time_step->dt_ref, NULL, NULL));
  check(riis_valve_set_scalar(valve_before, "opening", state.opening));
  check_place();

  riis_mark_list marked; /* the cells that were marked in the last time step */
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));
  for (int64_t i = 0; i < marked.n_nodes; ++i) {
    coefficient[marked.node_id[i]] = 0;
    for (int k = 0; k < 3; ++k) momentum[3 * marked.node_id[i] + k] = 0;
  }
  check(riis_mark_nodes(surface, mesh, &mark_options, marks));
  riis_resistance_arrays arrays;
  check(riis_resistance_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = cs_glob_mesh->n_cells;
  arrays.K = coefficient;
  for (int k = 0; k < 3 && setting("VALVE_VELOCITY") > 0; ++k) arrays.K_u_surface[k] = momentum + k;
  arrays.K_u_surface_stride = 3;
  check(riis_marks_add_resistance(marks, &resistance, &arrays));
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));
  record_valve(marked.n_nodes, marked.node_id, coefficient, state.opening, record_clock() - start);
}

/* ---- The hooks of code_saturne. ---- */

/* Head losses need a zone. The zone contains all cells, because the valve moves. */
void cs_user_zones(void) {
  if (setting("VALVE_PRESENT") > 0) cs_volume_zone_define("valve", "all[]", CS_VOLUME_ZONE_HEAD_LOSS);
}

/* Called once per time step, before the boundary conditions and the momentum equation. */
void cs_user_head_losses(const cs_zone_t *zone, cs_real_t cku[][6]) {
  if (strcmp(zone->name, "valve") != 0) return;
  advance_valve();
  const double density = cs_glob_fluid_properties->ro0;
  for (cs_lnum_t i = 0; i < zone->n_elts; ++i) {
    const cs_lnum_t c = zone->elt_ids != NULL ? zone->elt_ids[i] : i;
    /* Sets the components xx, yy and zz of the head loss. The force is -rho cku u. */
    for (int k = 0; k < 3; ++k) cku[i][k] = coefficient[c] / density;
    for (int k = 3; k < 6; ++k) cku[i][k] = 0;
  }
}

/* Called for each variable. */
void cs_user_source_terms(cs_domain_t *domain, int f_id, cs_real_t *st_exp, cs_real_t *st_imp) {
  CS_UNUSED(domain);
  CS_UNUSED(st_imp);
  if (f_id != CS_F_(vel)->id || valve == NULL) return;
  riis_mark_list marked;
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));
  for (int64_t i = 0; i < marked.n_nodes; ++i) {
    const int64_t cell = marked.node_id[i];
    for (int k = 0; k < 3; ++k)
      st_exp[3 * cell + k] += momentum[3 * cell + k] * cs_glob_mesh_quantities->cell_vol[cell]; /* in N */
  }
}

/* Called at the end of each time step, before code_saturne writes its checkpoint. */
void cs_user_extra_operations(cs_domain_t *domain) {
  if (valve != NULL && cs_restart_checkpoint_required(domain->time_step)) write_checkpoint();
  record_step();
}

END_C_DECLS
