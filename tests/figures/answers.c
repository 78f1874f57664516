/* SPDX-License-Identifier: Apache-2.0 */
#include "answers.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "expect.h"
#include "scratch.h"

static FILE *calls, *statuses;

static void start(const char *script) {
  char command[4096], pipe[1024];
  snprintf(pipe, sizeof pipe, "%s", scratch_path("statuses"));
  assert_int_equal(mkfifo(pipe, 0600), 0);
  const int n = snprintf(command, sizeof command, "'%s' -B '%s' '%s' '%s' >'%s'", RIIS_PYTHON, RIIS_ANSWER, script,
                         scratch_path("printed"), pipe);
  assert_true(n > 0 && (size_t)n < sizeof command);
  fflush(stdout);
  assert_non_null(calls = popen(command, "w"));
  assert_non_null(statuses = fopen(pipe, "r"));
}

int answer_of(const char *script, const char *words) {
  int status = 0;
  if (!calls) start(script);
  fprintf(calls, "%s\n", words);
  fflush(calls);
  if (fscanf(statuses, "%d", &status) != 1) fail_msg("%s ended at the call %s", script, words);
  return status;
}

void end_answers(void) {
  if (!calls) return;
  pclose(calls);
  fclose(statuses);
}
