# SPDX-License-Identifier: Apache-2.0
# The time limits of tests, in seconds. A limit ends a test that hangs, but a busy machine must not reach it. So it is at least
# ten times the test's time alone on a machine with two processors.
#   riis_test_timeout          the limit of a test that states no other
#   riis_test_timeout_saturne  the limit of example_code_saturne
#   riis_test_timeout_flow     the limit of the flow solver, which has checks, a run and a restart
# With sanitizers each test has at least three times its usual limit, and with the thread sanitizer six times.
# A test that is a script and states no limit has CTest's limit, 1500.
set(riis_test_timeout 300) # needs at most 30
set(riis_test_timeout_saturne 800) # example_code_saturne needs at most 80
set(riis_test_timeout_flow 900) # the flow solver needs at most 80
set(riis_test_timeout_factor 1)
if(RIIS_SANITIZE MATCHES "thread")
  set(riis_test_timeout_factor 6)
elseif(RIIS_SANITIZE)
  set(riis_test_timeout_factor 3)
endif()
math(EXPR riis_test_timeout "${riis_test_timeout} * ${riis_test_timeout_factor}")
