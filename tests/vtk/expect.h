/* SPDX-License-Identifier: Apache-2.0
 *
 * Checks the status of a refusal, and that its message is one line that names the fault. */
#ifndef RIIS_TESTS_EXPECT_H
#define RIIS_TESTS_EXPECT_H

#include <riis/riis.h>
#include <stdio.h>
#include <string.h>

#include "test_cases.h"

static inline void expect_fine(riis_status status) {
  if (status != RIIS_OK) fail_msg("%s: %s", riis_status_name(status), riis_last_error());
}

static inline void expect_refused(riis_status status, riis_status expected, const char *part_of_text) {
  const char *text = riis_last_error();
  if (status != expected) fail_msg("%s instead of %s: %s", riis_status_name(status), riis_status_name(expected), text);
  if (!strstr(text, part_of_text)) fail_msg("the text is \"%s\", without \"%s\"", text, part_of_text);
  if (strchr(text, '\n')) fail_msg("the text has more than one line: \"%s\"", text);
}

#endif
