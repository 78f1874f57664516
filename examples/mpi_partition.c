/* SPDX-License-Identifier: Apache-2.0
 * A mesh that is partitioned over the ranks of MPI. Each rank marks the nodes that it owns, and riis does not communicate.
 * Then rank 0 compares the ranks' marks with the marking of the whole mesh. Lengths are in cm.
 *   mpirun -n 4 ./mpi_partition */
#include <mpi.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 27, plane = n * n, n_nodes = n * plane };
/* A cube of 3.25 cm around the valve, a node every 1.25 mm; in this example every rank stores all nodes. */
static double xyz[3 * n_nodes];
static double distance[n_nodes], by_ranks[n_nodes];
static int32_t offsets[n_nodes + 1], columns[6 * n_nodes];

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE); /* a plain exit would leave the other ranks waiting */
}

/* Returns the first node of a rank's part, which consists of whole planes of the grid. */
static int first_node(int rank, int n_ranks) { return n * rank / n_ranks * plane; }

/* Makes compressed sparse rows of the rank's n_rows own nodes. The neighbours in the planes before and behind belong to other
 * ranks. These ghost nodes are numbered from n_rows on, as in most solvers. Returns the number of own nodes and ghost nodes. */
static int make_rows(int first, int n_rows) {
  int n_before = first > 0 ? plane : 0, n_behind = first + n_rows < n_nodes ? plane : 0, end = 0;
  for (int i = 0; i < n_rows; ++i) {
    if (i % n > 0) columns[end++] = i - 1;
    if (i % n < n - 1) columns[end++] = i + 1;
    if (i / n % n > 0) columns[end++] = i - n;
    if (i / n % n < n - 1) columns[end++] = i + n;
    if (i >= plane) {
      columns[end++] = i - plane;
    } else if (n_before > 0) {
      columns[end++] = n_rows + i;
    }
    if (i + plane < n_rows) {
      columns[end++] = i + plane;
    } else if (n_behind > 0) {
      columns[end++] = i + plane + n_before;
    }
    offsets[i + 1] = end;
  }
  return n_rows + n_before + n_behind;
}

/* Writes the distances of the nodes, and returns how many are marked. */
static int64_t read_marks(const riis_marks *marks, int64_t n, double *distances) {
  riis_dense_arrays arrays;
  riis_mark_list marked;
  check(riis_dense_arrays_init(&arrays, sizeof arrays)); /* far_distance keeps its default, RIIS_FAR_DISTANCE */
  arrays.n_nodes = n;
  arrays.distance = distances;
  check(riis_marks_get_dense(marks, &arrays));
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));
  return marked.n_nodes;
}

int main(int argc, char **argv) {
  int rank, n_ranks;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -1.625 + 0.125 * (i % n);
    xyz[3 * i + 1] = -1.625 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -1.625 + 0.125 * (i / plane);
    distance[i] = RIIS_FAR_DISTANCE;
  }

  /* The surface is small, so every rank makes its own copy. All copies have the same bits. */
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  check(riis_valve_create("aortic", &valve));
  check(riis_surface_create(valve, NULL, &surface));
  check(riis_marks_create(&marks));

  /* If every core has a rank, each rank should use one thread. If each rank is bound to several cores, such as by mpirun --map-by
   * slot:PE=4, leave n_threads at 0. The rank then uses all of its cores. If ranks are not bound, each rank would use all cores
   * of the machine. */
  riis_mark_options options;
  check(riis_mark_options_init(&options, sizeof options));
  options.n_threads = 1;

  int first = first_node(rank, n_ranks), n_rows = first_node(rank + 1, n_ranks) - first;
  int64_t n_marked = 0;
  if (n_rows > 0) { /* a rank without nodes has nothing to mark */
    double *own = xyz + 3 * first;
    riis_csr csr;
    check(riis_mesh_create(n_rows, own, own + 1, own + 2, 3, &mesh));
    check(riis_csr_init(&csr, sizeof csr));
    csr.n_rows = n_rows;
    csr.n_all = make_rows(first, n_rows);
    csr.offsets = offsets;
    csr.columns = columns;
    check(riis_mesh_set_adjacency(mesh, &csr));
    options.search = RIIS_SEARCH_NEIGHBOR;
    check(riis_mark_nodes(surface, mesh, &options, marks));
    n_marked = read_marks(marks, n_rows, distance + first);
    riis_mesh_destroy(&mesh);
  }

  int64_t n_marked_by_ranks = 0;
  MPI_Reduce(&n_marked, &n_marked_by_ranks, 1, MPI_INT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
  MPI_Reduce(distance, by_ranks, n_nodes, MPI_DOUBLE, MPI_MIN, 0, MPI_COMM_WORLD);

  int same = 1;
  if (rank == 0) {
    options.search = RIIS_SEARCH_EXHAUSTIVE;
    check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
    check(riis_mark_nodes(surface, mesh, &options, marks));
    n_marked = read_marks(marks, n_nodes, distance);
    riis_mesh_destroy(&mesh);
    same = n_marked == n_marked_by_ranks;
    for (int i = 0; i < n_nodes; ++i) same = same && distance[i] == by_ranks[i];
    printf("%d nodes, marked: %lld\n", n_nodes, (long long)n_marked);
    printf("%d ranks, marked: %lld, %s\n", n_ranks, (long long)n_marked_by_ranks,
           same ? "the same nodes and distances" : "other nodes or distances");
  }

  riis_marks_destroy(&marks);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  MPI_Finalize();
  return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
