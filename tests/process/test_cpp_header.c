/* SPDX-License-Identifier: Apache-2.0
 * Tests the handles, exceptions, structs and spans of riis.hpp through C wrappers. The build with a sanitizer finds leaks of
 * memory. */
#include <riis/riis.h>

#include "test_support.h"

#include "cpp_header.h"
#include "handles.h"
#include "searches.h"

/* The example of ten lines in the header's comment gives the same marks as C. */
TEST(marks_are_those_of_c) {
  riis_valve *valve = new_valve("mitral");
  riis_surface_options options = surface_options();
  options.half_thickness = 0.15;
  riis_surface *surface = new_surface(valve, &options);
  double xyz[3 * 4096];
  for (int i = 0; i < 4096; ++i)
    for (int c = 0; c < 3; ++c) xyz[3 * i + c] = -2 + 0.25 * (i >> 4 * c & 15);
  riis_marks *marks = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh_of(4096, xyz), NULL, marks));
  const riis_mark_list list = marked_list(marks);
  int64_t node_id[4096];
  assert_true(list.n_nodes > 100);
  assert_int_equal(cpp_mark(4096, xyz, 0.15, node_id), list.n_nodes);
  assert_memory_equal(node_id, list.node_id, (size_t)list.n_nodes * sizeof *node_id);
}

TEST(refusals_are_exceptions) {
  char text[256];
  assert_int_equal(cpp_refusal("pulmonary", text, sizeof text), RIIS_INVALID_PARAMETER);
  assert_non_null(strstr(text, "'pulmonary' is not a kind of valve"));
  assert_int_equal(cpp_refusal("aortic", text, sizeof text), RIIS_OK);
}

TEST(handles_own_and_move) { assert_string_equal(cpp_wrong_with_handles(), ""); }

TEST(defaults_are_those_of_c) { assert_string_equal(cpp_wrong_with_defaults(), ""); }

TEST(spans_are_arrays) { assert_string_equal(cpp_wrong_with_spans(), ""); }

int main(void) { return run_cases(NULL, NULL); }
