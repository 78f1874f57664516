C     SPDX-License-Identifier: Apache-2.0
C     Calls the loop over all triangles as a code in fixed form does.
      SUBROUTINE FIXED_FORM(SURF, N, XYZ, EPS, D)
      INTEGER*8 SURF
      INTEGER N
      DOUBLE PRECISION XYZ(3,N), EPS, D(N)
      CALL BRUTE_DISTANCES(SURF, N, XYZ(1,1), XYZ(2,1), XYZ(3,1), 3,
     &  EPS, D)
      END
