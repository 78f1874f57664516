C     SPDX-License-Identifier: Apache-2.0
C     What the tests in Fortran 77 are written with.

C     A call that has to succeed.
      SUBROUTINE OK(STAT)
      INTEGER STAT
      CHARACTER*512 TEXT
      IF (STAT .EQ. 0) RETURN
      CALL RIISF_LAST_ERROR(TEXT)
      CALL FAILED(TEXT)
      END

C     A call that has to be refused, with these words.
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
