/* SPDX-License-Identifier: Apache-2.0
 * This program does not link riis. The program loads and unloads a plug-in that links riis. Threads that marked nodes for the
 * plug-in outlive it, so their code must stay in memory. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for usleep */
#endif
#include <dlfcn.h>
#include <stdint.h>
#include <unistd.h>

#include "test_support.h"

typedef int64_t mark_function(int32_t n_threads);

static const char *path; /* of the plug-in */

/* Loads the plug-in, marks nodes and unloads it. During the pause after the unloading, waiting threads can run their code. */
static int64_t mark_by_plugin(int32_t n_threads) {
  void *const plugin = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  mark_function *mark = NULL;
  if (!plugin) fail_msg("%s", dlerror());
  *(void **)&mark = dlsym(plugin, "plugin_mark");
  assert_non_null(mark);
  const int64_t n_marked = mark(n_threads);
  assert_int_equal(dlclose(plugin), 0);
  usleep(200000);
  return n_marked;
}

TEST(a_plugin_that_marked_can_be_closed) {
  const int64_t n_marked = mark_by_plugin(1);
  assert_true(n_marked > 100);
  for (int i = 0; i < 3; ++i) assert_int_equal(mark_by_plugin(2), n_marked);
  assert_int_equal(mark_by_plugin(3), n_marked);
}

int main(int argc, char **argv) {
  if (argc != 2) return 2;
  path = argv[1];
  return run_cases(NULL, NULL);
}
