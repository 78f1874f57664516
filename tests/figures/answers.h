/* SPDX-License-Identifier: Apache-2.0
 * Calls a Python script many times in one process (answer.py), which imports the script's modules once. */
#ifndef RIIS_TEST_ANSWERS_H
#define RIIS_TEST_ANSWERS_H

/* Calls the script with words, which are split as by a shell. Returns the exit status. The printed text is in
 * scratch_path("printed"). All calls of a test must name one script. */
int answer_of(const char *script, const char *words);

/* Ends the process, if there is one. */
void end_answers(void);

#endif
