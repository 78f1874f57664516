/* Two ways to mark nodes in a code that uses OpenMP itself. The first way is one call between the code's parallel regions. The
 * call starts threads of the library. The second way is one call from each of the code's threads, for its block of the mesh.
 * These calls start no threads. Lengths are in cm. */
#include <omp.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 27, n_nodes = n * n * n, n_blocks = 4 };
static double xyz[3 * n_nodes]; /* a cube of 3.25 cm around the valve, a node every 1.25 mm */

/* Prints the last error and ends. The thread whose call failed must call it, because each thread has its own last error. */
static void check(riis_status status) {
  if (status == RIIS_OK) return;
#pragma omp critical
  {
    fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
    exit(EXIT_FAILURE);
  }
}

static int first_node(int block) { return n_nodes * block / n_blocks; }

int main(void) {
  omp_set_num_threads(3); /* the code's settings, which riis neither follows nor changes */
  omp_set_dynamic(0);
#pragma omp parallel for
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -1.625 + 0.125 * (i % n);
    xyz[3 * i + 1] = -1.625 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -1.625 + 0.125 * (i / (n * n));
  }

  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  check(riis_valve_create("aortic", &valve));
  check(riis_surface_create(valve, NULL, &surface));

  /* One call between parallel regions. Whatever OpenMP's settings are, the call uses the processors on which this thread may
   * run. For another number of threads, set n_threads in riis_mark_options. */
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_marks_create(&marks));
  check(riis_mark_nodes(surface, mesh, NULL, marks));
  riis_mark_list marked;
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));
  int kept = omp_get_max_threads() == 3 && !omp_get_dynamic();
  double farthest = 0;
#pragma omp parallel for reduction(max : farthest)
  for (int64_t i = 0; i < marked.n_nodes; ++i) {
    if (marked.distance[i] > farthest) farthest = marked.distance[i];
  }
  printf("one call, marked: %lld, the farthest at %8.6f cm\n", (long long)marked.n_nodes, farthest);
  printf("settings of OpenMP: %s\n", kept ? "as they were" : "changed");

  /* One call from each thread. All threads read one surface. Each thread has a separate mesh and separate marks. While any thread
   * marks, no thread may update the surface. Update the surface before the region, or in a single construct, because all threads
   * wait at its end. */
  riis_mark_options options;
  riis_mesh *block_mesh[n_blocks] = {NULL};
  riis_marks *block_marks[n_blocks] = {NULL};
  check(riis_mark_options_init(&options, sizeof options));
  options.n_threads = 1;
#pragma omp parallel for num_threads(n_blocks) schedule(static, 1)
  for (int i = 0; i < n_blocks; ++i) {
    double *block = xyz + 3 * first_node(i);
    check(riis_mesh_create(first_node(i + 1) - first_node(i), block, block + 1, block + 2, 3, &block_mesh[i]));
    check(riis_marks_create(&block_marks[i]));
    check(riis_mark_nodes(surface, block_mesh[i], &options, block_marks[i]));
  }

  /* The lists of the blocks, one after the other, are the list of the whole mesh. */
  int64_t n_found = 0;
  int same = 1;
  for (int i = 0; i < n_blocks; ++i) {
    riis_mark_list in_block;
    check(riis_marks_get_list(block_marks[i], RIIS_LIST_MARKED, &in_block, sizeof in_block));
    printf("block %d, marked: %lld\n", i, (long long)in_block.n_nodes);
    same = same && n_found + in_block.n_nodes <= marked.n_nodes;
    for (int64_t j = 0; same && j < in_block.n_nodes; ++j, ++n_found) {
      same = marked.node_id[n_found] == first_node(i) + in_block.node_id[j] &&
             marked.distance[n_found] == in_block.distance[j];
    }
    riis_marks_destroy(&block_marks[i]);
    riis_mesh_destroy(&block_mesh[i]);
  }
  same = same && n_found == marked.n_nodes;
  printf("blocks together: %s\n", same ? "the same nodes and distances" : "other nodes or distances");

  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return kept && same ? EXIT_SUCCESS : EXIT_FAILURE;
}
