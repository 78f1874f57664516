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
