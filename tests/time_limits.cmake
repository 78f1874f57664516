# SPDX-License-Identifier: Apache-2.0
# The time limits of tests, in seconds. A limit ends a test that hangs, but a busy machine must not reach it. The limit is
# therefore at least ten times the test's time alone on a machine with two processors.
#   riis_test_timeout          the limit of a test that states no other
#   riis_test_timeout_saturne  the limit of example_code_saturne
#   riis_test_timeout_flow     the limit of the flow solver, which has checks, a run and a restart
#   riis_test_timeout_script   the limit of a script that runs the program or compiles many times
#   riis_test_timeout_long     the limit of tests that have to end with RIIS_TEST_LONG=1
# With sanitizers each test has at least three times its usual limit, and with the thread sanitizer six times. The emulator of
# ./run arm64 needs 7 to 20 times as long as a processor, and up to 40 times for pictures. The limits for the emulator are ten
# times as long. A script without a stated limit has CTest's limit, 1500.
set(riis_test_timeout 300) # needs at most 30
set(riis_test_timeout_saturne 800) # example_code_saturne needs at most 80
set(riis_test_timeout_flow 900) # the flow solver needs at most 80
set(riis_test_timeout_script 1200) # needs at most 120
set(riis_test_timeout_long 3600) # no sanitizer runs with this variable
set(riis_test_timeout_factor 1)
if(CMAKE_CROSSCOMPILING)
  set(riis_test_timeout_factor 10)
elseif(RIIS_SANITIZE MATCHES "thread")
  set(riis_test_timeout_factor 6)
elseif(RIIS_SANITIZE)
  set(riis_test_timeout_factor 3)
endif()
foreach(limit riis_test_timeout riis_test_timeout_saturne riis_test_timeout_flow riis_test_timeout_script riis_test_timeout_long)
  math(EXPR ${limit} "${${limit}} * ${riis_test_timeout_factor}")
endforeach()
