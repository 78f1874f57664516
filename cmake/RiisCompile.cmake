# SPDX-License-Identifier: Apache-2.0
# How riis itself is compiled; nothing of this reaches those who link it.
add_library(riis_compile INTERFACE)
target_compile_options(riis_compile INTERFACE
  $<$<COMPILE_LANGUAGE:C,CXX>:-Wall -Wextra -Wshadow -Wconversion>
  # Results are promised bit for bit: no contraction to fused multiply-add and none of fast-math, whatever the user's flags.
  $<$<COMPILE_LANGUAGE:C,CXX>:-ffp-contract=off -fno-fast-math>
  $<$<COMPILE_LANGUAGE:Fortran>:-Wall -Wextra -Wimplicit-interface>)
if(RIIS_WARNINGS_AS_ERRORS)
  target_compile_options(riis_compile INTERFACE -Werror)
endif()
if(RIIS_SANITIZE)
  # -fno-sanitize-recover: an undefined operation fails the test it happens in.
  target_compile_options(riis_compile INTERFACE -fsanitize=${RIIS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  target_link_options(riis_compile INTERFACE -fsanitize=${RIIS_SANITIZE})
endif()
