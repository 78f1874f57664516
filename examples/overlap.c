/* SPDX-License-Identifier: Apache-2.0
 * Marks the next time step on a second thread while the solver is busy with this one. A solver on a GPU works in this way. The
 * main thread only waits for the GPU meanwhile. Afterwards it uploads a short list: nodes, K and K u_surface.
 *
 * The opening of the next step must be known before the present step is solved. Laws over time, tables and times of opening, know
 * it. riis_opening_switch_advance and riis_opening_angle_advance need the pressures of the previous step, so they know it only
 * after the solve. With these laws there are two ways: mark after the solve, without overlap, or use the pressures of one step
 * earlier. The valve then responds one step later.
 *
 * Usage: overlap [nodes on a side] [sweeps of the solver in a step] [steps]. With arguments it prints times. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double dt = 0.01, R = 1e4; /* [s], [kg/(m s)] */

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error()); /* by the thread whose call failed */
  exit(EXIT_FAILURE);
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void *memory(size_t n_bytes) {
  void *bytes = calloc(1, n_bytes);
  if (bytes) return bytes;
  fprintf(stderr, "no memory\n");
  exit(EXIT_FAILURE);
}

/* ---- The valve ---- */

/* There are two surfaces and two sets of marks. While the solver reads the list of one set, the other thread makes the list of
 * the other set. */
typedef struct {
  riis_surface *surface;
  riis_marks *marks;
  riis_mark_list list; /* until the next marking with these marks */
  int step;
} marking;

/* Everything that the second thread uses. The main thread accesses it only while no marking runs. */
typedef struct {
  riis_valve *valve, *before;
  riis_mesh *mesh;
  riis_mark_options options;
  riis_opening_times times;
  marking of_step[2]; /* of even and of odd steps */
} valve_side;

static double opening_at(const valve_side *side, int step) {
  double opening;
  check(riis_opening_from_times(&side->times, side->times.opening_start + step * dt, &opening, NULL));
  return opening;
}

static void mark_step(valve_side *side, int step) {
  marking *next = &side->of_step[step % 2];
  next->step = step;
  check(riis_valve_set_scalar(side->before, "opening", opening_at(side, step - 1)));
  check(riis_valve_set_scalar(side->valve, "opening", opening_at(side, step)));
  check(riis_surface_update_moving(next->surface, side->valve, side->before, dt, NULL, NULL));
  check(riis_mark_nodes(next->surface, side->mesh, &side->options, next->marks));
  check(riis_marks_get_list(next->marks, RIIS_LIST_MARKED, &next->list, sizeof next->list));
}

typedef struct {
  valve_side *side;
  int step;
} task;

static void *run_task(void *given) {
  const task *todo = given;
  mark_step(todo->side, todo->step);
  return NULL;
}

static void make_side(valve_side *side, riis_mesh *mesh, const riis_resistance *model) {
  memset(side, 0, sizeof *side);
  side->mesh = mesh;
  check(riis_valve_create("mitral", &side->valve));
  check(riis_valve_copy(side->valve, &side->before));
  check(riis_mark_options_init(&side->options, sizeof side->options));
  side->options.resistance = model; /* the list then has K and K u_surface */
  side->options.n_threads = 1;      /* the solver has the other cores */
  check(riis_opening_times_init(&side->times, sizeof side->times));
  side->times.opening_start = 0.45;
  side->times.opening_duration = 0.05;
  side->times.closing_start = 0.55;
  side->times.closing_duration = 0.05;
  side->times.period = 0.2;
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01; /* centimetres to metres */
  options.half_thickness = 1e-3;
  for (int i = 0; i < 2; ++i) {
    check(riis_surface_create(side->valve, &options, &side->of_step[i].surface));
    check(riis_marks_create(&side->of_step[i].marks));
  }
}

static void free_side(valve_side *side) {
  for (int i = 0; i < 2; ++i) {
    riis_marks_destroy(&side->of_step[i].marks);
    riis_surface_destroy(&side->of_step[i].surface);
  }
  riis_valve_destroy(&side->before);
  riis_valve_destroy(&side->valve);
}

/* ---- The solver, which stands for a GPU: a velocity that diffuses and that the valve resists ---- */

typedef struct {
  int n;
  double *K, *K_u_surface, *u, *old; /* (n^3): the arrays on the GPU, with one component of the velocity */
  int64_t *node_id, n_listed;        /* the nodes of the last upload */
} solver;

/* First sets the nodes of the last list to 0, then uploads a list, 40 bytes for each node. A GPU does both in one kernel. */
static void upload(solver *flow, const riis_mark_list *list) {
  for (int64_t i = 0; i < flow->n_listed; ++i) flow->K[flow->node_id[i]] = flow->K_u_surface[flow->node_id[i]] = 0;
  for (int64_t i = 0; i < list->n_nodes; ++i) {
    flow->K[list->node_id[i]] = list->K[i];
    flow->K_u_surface[list->node_id[i]] = list->K_u_surface[3 * i + 2];
    flow->node_id[i] = list->node_id[i];
  }
  flow->n_listed = list->n_nodes;
}

static void solve(solver *flow, int n_sweeps) {
  const int n = flow->n;
  const int64_t up = (int64_t)n * n;
  for (int sweep = 0; sweep < n_sweeps; ++sweep) {
    double *from = flow->u;
    flow->u = flow->old;
    flow->old = from;
    for (int64_t k = 1; k < n - 1; ++k)
      for (int64_t j = 1; j < n - 1; ++j)
        for (int64_t i = k * up + j * n + 1; i < k * up + j * n + n - 1; ++i) {
          const double around = from[i - 1] + from[i + 1] + from[i - n] + from[i + n] + from[i - up] + from[i + up];
          flow->u[i] = (1e6 * around / 6 + flow->K_u_surface[i] + 1e6) / (1e6 + flow->K[i]);
        }
  }
}

static solver make_solver(int n) {
  const size_t n_nodes = (size_t)n * (size_t)n * (size_t)n, size = n_nodes * sizeof(double);
  const solver made = {n, memory(size), memory(size), memory(size), memory(size), memory(n_nodes * sizeof(int64_t)), 0};
  return made;
}

static void free_solver(solver *flow) {
  free(flow->K);
  free(flow->K_u_surface);
  free(flow->u);
  free(flow->old);
  free(flow->node_id);
}

/* ---- Two loops over the steps ---- */

typedef struct {
  double all, solving, waiting, uploading;
} clocks;

/* Marks and solves in turn. */
static clocks run_in_turn(solver *flow, valve_side *side, int n_sweeps, int n_steps) {
  clocks of = {0, 0, 0, 0};
  const double begin = seconds();
  for (int step = 1; step <= n_steps; ++step) {
    const double start = seconds();
    mark_step(side, step);
    const double marked = seconds();
    upload(flow, &side->of_step[step % 2].list);
    const double uploaded = seconds();
    solve(flow, n_sweeps);
    of.waiting += marked - start;
    of.uploading += uploaded - marked;
    of.solving += seconds() - uploaded;
  }
  of.all = seconds() - begin;
  return of;
}

/* Marks step + 1 while the solver solves step. */
static clocks run_overlapped(solver *flow, valve_side *side, int n_sweeps, int n_steps) {
  clocks of = {0, 0, 0, 0};
  const double begin = seconds();
  mark_step(side, 1);
  of.waiting = seconds() - begin; /* nothing hides the first marking */
  for (int step = 1; step <= n_steps; ++step) {
    pthread_t thread;
    task next = {side, step + 1};
    const double start = seconds();
    upload(flow, &side->of_step[step % 2].list);
    const double uploaded = seconds();
    const int is_threaded = step < n_steps && pthread_create(&thread, NULL, run_task, &next) == 0;
    solve(flow, n_sweeps);
    const double solved = seconds();
    if (is_threaded)
      pthread_join(thread, NULL);
    else if (step < n_steps)
      run_task(&next); /* no thread could start, so the main thread marks */
    of.uploading += uploaded - start;
    of.solving += solved - uploaded;
    of.waiting += seconds() - solved;
  }
  of.all = seconds() - begin;
  return of;
}

static void print_clocks(const char *name, const clocks *of, int n_steps) {
  printf("%-11s ms a step: all %.3f, solving %.3f, waiting for marks %.3f, uploading %.3f\n", name,
         1e3 * of->all / n_steps, 1e3 * of->solving / n_steps, 1e3 * of->waiting / n_steps,
         1e3 * of->uploading / n_steps);
}

int main(int argc, char **argv) {
  const int n = argc > 1 ? atoi(argv[1]) : 37, n_sweeps = argc > 2 ? atoi(argv[2]) : 4;
  const int n_steps = argc > 3 ? atoi(argv[3]) : 4;
  if (n < 3 || n > 400 || n_sweeps < 1 || n_steps < 1) {
    fprintf(stderr, "usage: overlap [3 to 400 nodes on a side] [sweeps] [steps]\n");
    return EXIT_FAILURE;
  }
  const int64_t n_nodes = (int64_t)n * n * n;
  double *xyz = memory(3 * (size_t)n_nodes * sizeof *xyz); /* [m] a cube of 4.5 cm around the valve */
  for (int64_t i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -0.0225 + 0.045 / (n - 1) * (double)(i % n);
    xyz[3 * i + 1] = -0.0225 + 0.045 / (n - 1) * (double)(i / n % n);
    xyz[3 * i + 2] = -0.02 + 0.045 / (n - 1) * (double)(i / n / n);
  }
  riis_mesh *mesh = NULL;
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  riis_resistance model;
  check(riis_resistance_init(&model, sizeof model));
  model.R = R;

  solver in_turn = make_solver(n), overlapped = make_solver(n);
  valve_side side;
  make_side(&side, mesh, &model);
  const clocks first = run_in_turn(&in_turn, &side, n_sweeps, n_steps);
  free_side(&side);
  make_side(&side, mesh, &model);
  const clocks second = run_overlapped(&overlapped, &side, n_sweeps, n_steps);
  for (int i = 1; i >= 0; --i) {
    const marking *last = &side.of_step[(n_steps - i + 2) % 2];
    if (last->step == n_steps - i && last->step > 0)
      printf("step %d, opening %5.3f: %lld nodes uploaded\n", last->step, opening_at(&side, last->step),
             (long long)last->list.n_nodes);
  }
  const int is_same = memcmp(in_turn.u, overlapped.u, (size_t)n_nodes * sizeof *xyz) == 0;
  printf("velocities with overlap: %s\n", is_same ? "the same to the last bit" : "others");
  if (argc > 1) {
    print_clocks("in turn", &first, n_steps);
    print_clocks("overlapped", &second, n_steps);
  }
  free_side(&side);
  free_solver(&in_turn);
  free_solver(&overlapped);
  riis_mesh_destroy(&mesh);
  free(xyz);
  return is_same ? EXIT_SUCCESS : EXIT_FAILURE;
}
