/* SPDX-License-Identifier: Apache-2.0 */
#include "virtual_display.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

void enter_virtual_display(char **argv) {
  if (getenv("RIIS_TEST_IN_XVFB")) return;
  if (system("command -v xvfb-run >/dev/null && command -v xauth >/dev/null") != 0) {
    puts("skipped: xvfb-run or xauth is missing");
    exit(77);
  }
  setenv("RIIS_TEST_IN_XVFB", "1", 1);
  execlp("xvfb-run", "xvfb-run", "-a", argv[0], (char *)NULL);
  perror("xvfb-run");
  exit(1);
}
