/* SPDX-License-Identifier: Apache-2.0
 * Tests whether a closed valve seals, in a mesh that is partitioned over the ranks of MPI. Each rank labels the open regions of
 * its part, and riis does not communicate. The ranks exchange the labels of the nodes that they share, until nothing changes.
 * Then rank 0 compares the labels with the whole mesh's labels. Lengths are in cm.
 *   mpirun -n 4 ./mpi_leaks */
#include <mpi.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 27, plane = n * n, n_nodes = n * plane };
/* A cube of 3.25 cm around the valve, a node every 1.25 mm; in this example every rank stores all nodes. */
static double xyz[3 * n_nodes];
static uint8_t in_tube[n_nodes];
static int64_t region[n_nodes]; /* for each node of a rank's part: the lowest node of its region, within the part */
static int64_t lowest[n_nodes]; /* for each node of a part: the lowest node of its region, within the whole mesh */
static int64_t label[n_nodes], by_ranks[n_nodes];

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE); /* a plain exit would leave the other ranks waiting */
}

/* Marks n_planes planes of the grid from node `first` on, and labels their open regions with ids that count from `first`. */
static int64_t label_part(const riis_surface *surface, riis_marks *marks, int first, int n_planes, int64_t *labels) {
  riis_mesh *mesh = NULL;
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  riis_mark_options options;
  int64_t n_regions = 0;
  double *own = xyz + 3 * first;
  check(riis_mark_options_init(&options, sizeof options));
  options.n_threads = 1; /* one thread per rank, because each core has a rank */
  options.node_mask = in_tube + first;
  check(riis_mesh_create(n_planes * plane, own, own + 1, own + 2, 3, &mesh));
  check(riis_adjacency_create_from_grid(n, n, n_planes, 1, &adjacency));
  check(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  check(riis_mesh_set_adjacency(mesh, &csr));
  check(riis_mark_nodes(surface, mesh, &options, marks));
  check(riis_label_open_regions(mesh, marks, &options, n_planes * plane, labels, &n_regions));
  riis_mesh_destroy(&mesh);
  riis_adjacency_destroy(&adjacency);
  return n_regions;
}

/* Sends the labels of one plane of the part to a rank, and receives the labels of the plane at_plane from a rank. Returns 1 if
 * the received labels show that a region reaches a lower node. */
static int exchange(int from_plane, int to_rank, int at_plane, int from_rank) {
  int64_t sent[plane], got[plane];
  int changed = 0;
  for (int i = 0; i < plane; ++i) {
    int64_t own = region[from_plane * plane + i];
    sent[i] = own < 0 ? -1 : lowest[own];
    got[i] = -1;
  }
  MPI_Sendrecv(sent, plane, MPI_INT64_T, to_rank, 0, got, plane, MPI_INT64_T, from_rank, 0, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
  for (int i = 0; i < plane; ++i) {
    int64_t own = region[at_plane * plane + i];
    if (got[i] < 0 || own < 0 || got[i] >= lowest[own]) continue;
    lowest[own] = got[i];
    changed = 1;
  }
  return changed;
}

int main(int argc, char **argv) {
  int rank, n_ranks;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (n_ranks > n) {
    if (rank == 0) fprintf(stderr, "at most %d ranks, one for each plane\n", n);
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  }
  for (int i = 0; i < n_nodes; ++i) {
    double x = xyz[3 * i] = -1.625 + 0.125 * (i % n), y = xyz[3 * i + 1] = -1.625 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -1.625 + 0.125 * (i / plane);
    in_tube[i] = x * x + y * y <= 1.2 * 1.2;
  }

  /* In this aortic valve the cusps nearly meet. The surface is small, so every rank makes its own copy, with the same bits. */
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_marks *marks = NULL;
  check(riis_valve_create("aortic", &valve));
  check(riis_valve_set_scalar(valve, "leaflet_radius_in", 0.02));
  check(riis_surface_create(valve, NULL, &surface));
  check(riis_marks_create(&marks));

  /* The part consists of whole planes and of the first plane of the next rank, whose nodes both ranks have. */
  int first_plane = n * rank / n_ranks, n_own = n * (rank + 1) / n_ranks - first_plane;
  int first = first_plane * plane, is_last = rank + 1 == n_ranks, n_planes = n_own + !is_last;
  int before = rank > 0 ? rank - 1 : MPI_PROC_NULL, behind = is_last ? MPI_PROC_NULL : rank + 1;
  label_part(surface, marks, first, n_planes, region);
  for (int i = 0; i < n_planes * plane; ++i) lowest[i] = first + i; /* local ids become global ones */

  int changed = 1;
  while (changed) {
    changed = exchange(0, before, n_planes - 1, behind);            /* sends the first plane to the rank before */
    changed = exchange(n_planes - 1, behind, 0, before) || changed; /* sends the last plane to the rank behind */
    MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  }

  for (int i = 0; i < n_nodes; ++i) label[i] = n_nodes;
  for (int i = 0; i < n_own * plane; ++i) label[first + i] = region[i] < 0 ? -1 : lowest[region[i]];
  MPI_Reduce(label, by_ranks, n_nodes, MPI_INT64_T, MPI_MIN, 0, MPI_COMM_WORLD);

  int same = 1;
  if (rank == 0) {
    int64_t n_regions = label_part(surface, marks, 0, n, label);
    for (int i = 0; i < n_nodes; ++i) same = same && label[i] == by_ranks[i];
    int inflow = n / 2 + n * (n / 2), outflow = inflow + (n - 1) * plane; /* on the axis, at the ends of the tube */
    printf("%d nodes, %lld open regions: the valve %s\n", n_nodes, (long long)n_regions,
           label[inflow] == label[outflow] ? "leaks" : "seals");
    printf("%d ranks: %s\n", n_ranks, same ? "the same labels" : "other labels");
  }

  riis_marks_destroy(&marks);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  MPI_Finalize();
  return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
