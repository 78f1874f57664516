C     SPDX-License-Identifier: Apache-2.0
C     Checks that the tests in Fortran 77 share.

C     Ends the test if the call failed.
      SUBROUTINE OK(STAT)
      INTEGER STAT
      CHARACTER*512 TEXT
      IF (STAT .EQ. 0) RETURN
      CALL RIISF_LAST_ERROR(TEXT)
      CALL FAILED(TEXT)
      END

C     Checks that the call was refused with this status, and that the
C     message contains these words. Otherwise ends the test.
      SUBROUTINE WANT(STAT, WANTED, WORDS)
      INTEGER STAT, WANTED
      CHARACTER*(*) WORDS
      CHARACTER*512 TEXT
      CALL RIISF_LAST_ERROR(TEXT)
      IF (STAT .NE. WANTED .OR. INDEX(TEXT, WORDS) .EQ. 0) CALL
     &  FAILED('wanted: ' // WORDS // '; got: ' // TEXT)
      END

      SUBROUTINE FAILED(TEXT)
      CHARACTER*(*) TEXT
      PRINT *, 'failed: ', TEXT
      STOP 1
      END

C     Makes a valve, or ends the test.
      SUBROUTINE VALVEOF(KIND, VALVE)
      CHARACTER*(*) KIND
      INTEGER*8 VALVE
      INTEGER STAT
      CALL RIISF_VALVE_CREATE(KIND, VALVE, STAT)
      CALL OK(STAT)
      END

C     Sets a parameter that has one value.
      SUBROUTINE SETONE(VALVE, NAME, VALUE)
      CHARACTER*(*) NAME
      INTEGER*8 VALVE
      INTEGER STAT
      DOUBLE PRECISION VALUE, VALUES(1)
      VALUES(1) = VALUE
      CALL RIISF_VALVE_SET(VALVE, NAME, 1, VALUES, STAT)
      CALL OK(STAT)
      END

C     Makes the surface of a valve in the valve's own frame.
      SUBROUTINE HERE(VALVE, HALF, SURF)
      INTEGER*8 VALVE, SURF
      INTEGER STAT
      DOUBLE PRECISION HALF, AXIS(3), ZERO(3)
      DATA AXIS /0D0, 0D0, 1D0/, ZERO /3*0D0/
      CALL RIISF_SURFACE_CREATE(VALVE, HALF, 0.05D0, 1D0, AXIS, 0D0,
     &  ZERO, SURF, STAT)
      CALL OK(STAT)
      END

C     Marks nodes, and lists the marked ones.
      SUBROUTINE MARKED(SURF, MESH, SEARCH, RES, LENGTH, N, NODE, DIST)
      INCLUDE 'riisf.h'
      INTEGER*8 SURF, MESH, RES
      INTEGER SEARCH, LENGTH, N, NODE(LENGTH), STAT
      DOUBLE PRECISION DIST(LENGTH)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, SEARCH, 2, RES, STAT)
      CALL OK(STAT)
      CALL RIISF_MARKED(RES, LENGTH, N, NODE, DIST, STAT)
      CALL OK(STAT)
      END
