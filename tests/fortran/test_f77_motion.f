C     SPDX-License-Identifier: Apache-2.0
C     Tests laws of opening, keyframes and surfaces from arrays, as a
C     Fortran 77 code calls them. Compares them with closed forms.
      PROGRAM TF77M
      CALL TABLE
      CALL TIMES
      CALL SWITCH
      CALL ANGLE
      CALL FRAMES
      CALL ARRAYS
      CALL CLOSE
      CALL FIXED
      CALL WARPS
      PRINT *, 'motion by external subroutines'
      END

C     Checks that two numbers are equal.
      SUBROUTINE NEAR(A, B, TEXT)
      DOUBLE PRECISION A, B
      CHARACTER*(*) TEXT
      IF (ABS(A - B) .GT. 1D-12) CALL FAILED(TEXT)
      END

C     If the landmarks of a warp shift, the vertices shift with them.
C     The velocity is the shift divided by the step.
      SUBROUTINE WARPS
      INCLUDE 'riisf.h'
      INTEGER MAXV
      PARAMETER (MAXV = 40000)
      INTEGER*8 VALVE(2), SURF, WARP
      INTEGER STAT, N, M, I, C, K
      DOUBLE PRECISION XYZ(3,8), TO(3,8), AXIS(3), ZERO(3), SHIFT(3)
      DOUBLE PRECISION A(3,MAXV), B(3,MAXV), V(3,MAXV), DT
      SAVE A, B, V
      DATA AXIS /0D0, 0D0, 1D0/, ZERO /0D0, 0D0, 0D0/
      DATA SHIFT /0.02D0, -0.01D0, 0.03D0/, DT /0.25D0/
      SURF = 0
      WARP = 0
      DO 20 I = 1, 8
        XYZ(1,I) = 1.3D0 * MOD(I, 2)
        XYZ(2,I) = 1.3D0 * MOD(I / 2, 2)
        XYZ(3,I) = -1.2D0 * MOD(I / 4, 2)
        DO 10 C = 1, 3
          TO(C,I) = XYZ(C,I)
   10   CONTINUE
   20 CONTINUE
      CALL RIISF_WARP_CREATE(2, XYZ, 0D0, 1D0, AXIS, 0D0, ZERO, WARP,
     &  STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_points is 2')
      CALL RIISF_WARP_CREATE(8, XYZ, 0D0, 1D0, AXIS, 0D0, ZERO, WARP,
     &  STAT)
      CALL OK(STAT)
      CALL RIISF_WARP_SET_TARGETS(WARP, 7, XYZ, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_points is 7')
      DO 30 I = 1, 2
        VALVE(I) = 0
        CALL VALVEOF('trileaflet', VALVE(I))
        CALL SETONE(VALVE(I), 'opening', 0.4D0)
        CALL RIISF_VALVE_SET_WARP(VALVE(I), WARP, 0_8, STAT)
        CALL OK(STAT)
   30 CONTINUE
      CALL RIISF_VALVE_SET_WARP(VALVE(1), 0_8, WARP, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'closed')
      CALL HERE(VALVE(1), 0.1D0, SURF)
      CALL RIISF_SURFACE_VERTICES(SURF, MAXV, N, A, STAT)
      CALL OK(STAT)
      DO 60 K = 1, 2
        DO 50 I = 1, 8
          DO 40 C = 1, 3
            TO(C,I) = TO(C,I) + SHIFT(C)
   40     CONTINUE
   50   CONTINUE
        CALL RIISF_WARP_SET_TARGETS(WARP, 8, TO, STAT)
        CALL OK(STAT)
        CALL RIISF_VALVE_SET_WARP(VALVE(3 - K), WARP, 0_8, STAT)
        CALL OK(STAT)
        CALL RIISF_SURFACE_UPDATE_MOVING(SURF, VALVE(3 - K), VALVE(K),
     &    DT, STAT)
        CALL OK(STAT)
   60 CONTINUE
      CALL RIISF_SURFACE_VERTICES(SURF, MAXV, M, B, STAT)
      CALL OK(STAT)
      IF (M .NE. N) CALL FAILED('vertices of a shifted valve')
      CALL RIISF_SURFACE_VERTEX_VELOCITIES(SURF, MAXV, M, V, STAT)
      CALL OK(STAT)
      DO 80 I = 1, N
        DO 70 C = 1, 3
          IF (ABS(B(C,I) - A(C,I) - 2D0 * SHIFT(C)) .GT. 1D-11)
     &      CALL FAILED('a shifted vertex')
          IF (ABS(V(C,I) - SHIFT(C) / DT) .GT. 1D-10)
     &      CALL FAILED('its velocity')
   70   CONTINUE
   80 CONTINUE
      CALL RIISF_SURFACE_DESTROY(SURF)
      CALL RIISF_VALVE_DESTROY(VALVE(1))
      CALL RIISF_VALVE_DESTROY(VALVE(2))
      CALL RIISF_WARP_DESTROY(WARP)
      IF (WARP .NE. 0) CALL FAILED('a warp is left')
      END

      SUBROUTINE TABLE
      INCLUDE 'riisf.h'
      DOUBLE PRECISION T(3), O(3), OPEN, RATE
      INTEGER STAT
      DATA T /0D0, 0.25D0, 1D0/, O /0.2D0, 1D0, 0.2D0/
      CALL RIISF_OPENING_FROM_TABLE(3, T, O, 1D0,
     &  RIIS_INTERPOLATION_LINEAR, 2.125D0, OPEN, RATE, STAT)
      CALL OK(STAT)
      CALL NEAR(OPEN, 0.6D0, 'an opening by keys')
      CALL NEAR(RATE, 3.2D0, 'its rate')
      CALL RIISF_OPENING_FROM_TABLE(3, T, O, 0D0,
     &  RIIS_INTERPOLATION_CUBIC, 9D0, OPEN, RATE, STAT)
      CALL OK(STAT)
      CALL NEAR(OPEN, 0.2D0, 'behind the last key')
      CALL RIISF_OPENING_FROM_TABLE(3, T, O, 0.5D0, 0, 0D0, OPEN, RATE,
     &  STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'key 2 is 1, beyond the')
      CALL RIISF_OPENING_FROM_TABLE(3, O, T, 0D0, 0, 0D0, OPEN, RATE,
     &  STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'table.time of key 2')
      CALL RIISF_OPENING_FROM_TABLE(0, T, O, 0D0, 0, 0D0, OPEN, RATE,
     &  STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'table.n_keys is 0')
      END

      SUBROUTINE TIMES
      INCLUDE 'riisf.h'
      DOUBLE PRECISION OPEN, RATE
      INTEGER STAT
      CALL RIISF_OPENING_FROM_TIMES(0.45D0, 0.05D0, 0.9D0, 0.1D0,
     &  0.1D0, 0.9D0, 1D0, 3.475D0, OPEN, RATE, STAT)
      CALL OK(STAT)
      CALL NEAR(OPEN, 0.5D0, 'half open')
      IF (ABS(RATE - 0.8D0 * 1.875D0 / 0.05D0) .GT. 1D-9)
     &  CALL FAILED('the rate of a ramp')
      CALL RIISF_OPENING_FROM_TIMES(0.45D0, 0.05D0, 0.47D0, 0.1D0,
     &  0D0, 1D0, 0D0, 0D0, OPEN, RATE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'closing_start is 0.47')
      CALL NEAR(OPEN, 0.5D0, 'a refused call writes nothing')
      END

C     A switch gives the same states without a restart and after a
C     restart from a file.
      SUBROUTINE SWITCH
      INCLUDE 'riisf.h'
      DOUBLE PRECISION S(7), ALL(7), T
      INTEGER STAT, PHASE, ALLPHA, I
      CALL RIISF_OPENING_SWITCH_INIT(S, PHASE, STAT)
      CALL OK(STAT)
      IF (PHASE .NE. RIIS_PHASE_CLOSING .OR. ABS(S(2)) .GT. 0D0)
     &  CALL FAILED('closed at first')
      CALL RIISF_OPENING_SWITCH_INIT(ALL, ALLPHA, STAT)
      DO 10 I = 1, 200
        T = 0.002D0 * I
        CALL RIISF_OPENING_SWITCH_ADVANCE(0.04D0, 0.08D0, 0D0, 0D0,
     &    0.003D0, 0.02D0, T, SIN(2D1 * T), COS(21D0 * T), ALL, ALLPHA,
     &    STAT)
        CALL OK(STAT)
   10 CONTINUE
      DO 20 I = 1, 200
        T = 0.002D0 * I
        CALL RIISF_OPENING_SWITCH_ADVANCE(0.04D0, 0.08D0, 0D0, 0D0,
     &    0.003D0, 0.02D0, T, SIN(2D1 * T), COS(21D0 * T), S, PHASE,
     &    STAT)
        CALL OK(STAT)
        IF (I .EQ. 15) THEN
          IF (PHASE .NE. RIIS_PHASE_OPENING .OR. S(2) .LT. 0.1D0 .OR.
     &      S(2) .GT. 0.9D0) CALL FAILED('opening')
          OPEN (UNIT=11, STATUS='SCRATCH', FORM='UNFORMATTED')
          WRITE (11) S, PHASE
          CALL RIISF_OPENING_SWITCH_INIT(S, PHASE, STAT)
          REWIND (11)
          READ (11) S, PHASE
          CLOSE (11)
        END IF
   20 CONTINUE
      DO 30 I = 1, 7
        IF (ABS(S(I) - ALL(I)) .GT. 0D0) CALL FAILED('a restart')
   30 CONTINUE
      IF (PHASE .NE. ALLPHA) CALL FAILED('the phase after a restart')
      CALL RIISF_OPENING_SWITCH_ADVANCE(0.04D0, 0.08D0, 0D0, 0D0,
     &  -1D0, 0D0, 1D0, 0D0, 0D0, S, PHASE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'filter_time is -1')
      PHASE = 5
      CALL RIISF_OPENING_SWITCH_ADVANCE(0.04D0, 0.08D0, 0D0, 0D0,
     &  0D0, 0D0, 1D0, 0D0, 0D0, S, PHASE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'before.phase is 5')
      PHASE = ALLPHA
      CALL RIISF_OPENING_SWITCH_ADVANCE(0.04D0, 0.08D0, 0D0, 0D0,
     &  0D0, 0D0, 0.1D0, 0D0, 0D0, S, PHASE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'time is 0.1')
      CALL NEAR(S(1), 0.4D0, 'refused calls write nothing')
      END

C     Without a drive, friction stops the leaflet.
      SUBROUTINE ANGLE
      INCLUDE 'riisf.h'
      DOUBLE PRECISION S(7), WAY
      INTEGER STAT, I
      CALL RIISF_OPENING_ANGLE_INIT(S, STAT)
      CALL OK(STAT)
      S(4) = 10D0
      S(5) = 400D0
      DO 10 I = 1, 100
        CALL RIISF_OPENING_ANGLE_ADVANCE(5500D0, 2D0, 50D0, 7D0, 5D0,
     &    70D0, 0.001D0 * I, 0D0, 0D0, S, STAT)
        CALL OK(STAT)
   10 CONTINUE
      WAY = 8D0 * (1D0 - EXP(-5D0))
      IF (ABS(S(4) - 10D0 - WAY) .GT. 1D-5 .OR.
     &  ABS(S(5) - 400D0 * EXP(-5D0)) .GT. 1D-5) CALL FAILED('an angle')
      CALL NEAR(S(2), (S(4) - 5D0) / 65D0, 'its opening')
      CALL NEAR(S(3), S(5) / 65D0, 'its rate')
      CALL RIISF_OPENING_ANGLE_ADVANCE(5500D0, 2D0, 50D0, 7D0, 5D0,
     &  4D0, 1D0, 0D0, 0D0, S, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'law.angle_max is 4')
      CALL RIISF_OPENING_ANGLE_ADVANCE(5500D0, 2D0, 50D0, 7D0, 5D0,
     &  70D0, 1D6, 1D0, 0D0, S, STAT)
      CALL WANT(STAT, RIIS_LIMIT_EXCEEDED, 'time is 999999.9')
      CALL NEAR(S(1), 0.1D0, 'refused calls write nothing')
      END

C     A square moves between z = 0 and z = 0.3. The marked nodes above
C     the square show its height and its speed.
      SUBROUTINE FRAMES
      INCLUDE 'riisf.h'
      INTEGER*8 KEYS, KEYS2, SURF, OTHER, BIG, IDSL(3,2)
      DOUBLE PRECISION XYZ(3,4,3), T(3), AXIS(3), ZERO(3)
      INTEGER STAT, IDS(3,2), I, J, NLEAF, LEAF
      DOUBLE PRECISION AREA, EDGE
      DATA KEYS, KEYS2, SURF /3*0/, AXIS /0D0, 0D0, 1D0/, ZERO /3*0D0/
      DATA T /0D0, 0.25D0, 1D0/, IDS /1, 2, 3, 1, 3, 4/
      CALL CORNER(XYZ, 0D0)
      CALL CORNER(XYZ(1,1,2), 0.3D0)
      CALL CORNER(XYZ(1,1,3), 0D0)
      CALL RIISF_KEYFRAMES_CREATE(4, 3, T, XYZ, 1D0,
     &  RIIS_INTERPOLATION_LINEAR, 3, 2, IDS, 1, KEYS, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_FROM_KEYFRAMES(KEYS, 0.125D0, 0D0, 0.5D0,
     &  0.05D0, 2D0, AXIS, 0D0, ZERO, SURF, STAT)
      CALL OK(STAT)
      CALL ABOVE(SURF, 0.3D0, 2.4D0)
      CALL RIISF_SURFACE_UPDATE_KEYFRAMES(SURF, KEYS, 0.25D0, 0.25D0,
     &  STAT)
      CALL OK(STAT)
      CALL ABOVE(SURF, 0.6D0, 2.4D0)
C     An offset of the band does not change the distances.
      OTHER = 0
      CALL RIISF_SURFACE_OFFSET_KEYFRAMES(KEYS, 0.25D0, 0.25D0, 0.5D0,
     &  0.05D0, 2D0, AXIS, 0D0, ZERO, 0.5D0, OTHER, STAT)
      CALL OK(STAT)
      CALL ABOVE(OTHER, 0.6D0, 2.4D0)
      CALL RIISF_SURFACE_DESTROY(OTHER)
      CALL RIISF_SURFACE_UPDATE_KEYFRAMES(SURF, KEYS, 7.625D0, 0.375D0,
     &  STAT)
      CALL OK(STAT)
      CALL ABOVE(SURF, 0.3D0, -0.8D0)
      DO 20 J = 1, 2
        DO 10 I = 1, 3
          IDSL(I,J) = IDS(I,J) - 1
   10   CONTINUE
   20 CONTINUE
      BIG = 4
      CALL RIISF_KEYFRAMES_CREATE_64(BIG, 3, T, XYZ, 0D0,
     &  RIIS_INTERPOLATION_LINEAR, 3, BIG / 2, IDSL, 0, KEYS2, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_UPDATE_KEYFRAMES(SURF, KEYS2, 0.125D0, 0D0,
     &  STAT)
      CALL OK(STAT)
      CALL ABOVE(SURF, 0.3D0, 2.4D0)
      CALL RIISF_KEYFRAMES_DESTROY(KEYS2)
      CALL RIISF_KEYFRAMES_DESTROY(KEYS2)
      IF (KEYS2 .NE. 0) CALL FAILED('destroyed keyframes')
      CALL RIISF_KEYFRAMES_CREATE(4, 3, T, XYZ, 0.5D0, 0, 3, 2, IDS, 1,
     &  KEYS2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'frames.time of key 2')
      CALL RIISF_KEYFRAMES_CREATE(3, 3, T, XYZ, 0D0, 0, 3, 2, IDS, 1,
     &  KEYS2, STAT)
      CALL WANT(STAT, RIIS_INVALID_SURFACE, 'corner 2 of face 1 is 4')
      IF (KEYS2 .NE. 0) CALL FAILED('refused keyframes')
      CALL RIISF_SURFACE_UPDATE_KEYFRAMES(SURF, KEYS2, 0D0, 0D0, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'keyframes is NULL')
      CALL RIISF_SURFACE_FROM_KEYFRAMES(KEYS, 1D31, 0D0, 0.5D0, 0.05D0,
     &  2D0, AXIS, 0D0, ZERO, KEYS2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'time is 1e+31')
      CALL RIISF_SURFACE_N_LEAFLETS(SURF, NLEAF, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_LEAFLET(SURF, 1, LEAF, AREA, EDGE, STAT)
      CALL OK(STAT)
      IF (NLEAF .NE. 1 .OR. LEAF .NE. 0 .OR. EDGE .NE. 0D0 .OR.
     &  .NOT. AREA .GT. 0D0) CALL FAILED('a leaflet')
      CALL RIISF_SURFACE_LEAFLET(SURF, 2, LEAF, AREA, EDGE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'leaflet is 1')
      CALL RIISF_KEYFRAMES_DESTROY(KEYS)
      CALL RIISF_SURFACE_DESTROY(SURF)
      END

      SUBROUTINE ARRAYS
      INCLUDE 'riisf.h'
      INTEGER*8 SURF, SURF2, OTHER, BIG, QUADL(4,1)
      DOUBLE PRECISION XYZ(3,4), X(4), Y(4), Z(4), V(3,4), ZERO(4)
      DOUBLE PRECISION AXIS(3)
      INTEGER STAT, QUAD(4,1), FLAT(3,1), I
      INTEGER*1 HELD(4)
      DATA SURF, SURF2 /2*0/, AXIS /0D0, 0D0, 1D0/, ZERO /4*0D0/
      DATA QUAD /0, 1, 2, 3/, FLAT /1, 2, 2/, HELD /4*1/
      CALL CORNER(XYZ, 0.1D0)
      BIG = 4
      DO 10 I = 1, 4
        X(I) = XYZ(1,I)
        Y(I) = XYZ(2,I)
        Z(I) = 0.2D0
        V(1,I) = 0D0
        V(2,I) = 0D0
        V(3,I) = 1.5D0
        QUADL(I,1) = I
   10 CONTINUE
      CALL RIISF_SURFACE_FROM_ARRAYS(4, X, Y, Z, 1, 4, 1, QUAD, 0,
     &  0.5D0, 0.05D0, 2D0, AXIS, 0D0, ZERO, SURF, STAT)
      CALL OK(STAT)
      OTHER = 0
      CALL RIISF_SURFACE_OFFSET_ARRAYS(4, X, Y, Z, 1, 4, 1, QUAD, 0,
     &  0.5D0, 0.05D0, 2D0, AXIS, 0D0, ZERO, 1D0, OTHER, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'options.offset is 1')
      CALL RIISF_SURFACE_OFFSET_ARRAYS_64(BIG, XYZ(1,1), XYZ(2,1),
     &  XYZ(3,1), BIG - 1, 4, BIG / 4, QUADL, 1, 0.5D0, 0.05D0, 2D0,
     &  AXIS, 0D0, ZERO, 0.5D0, OTHER, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_DESTROY(OTHER)
      CALL RIISF_SURFACE_UPDATE_ARRAYS(SURF, 4, X, Y, Z, 1, ZERO, ZERO,
     &  ZERO, 1, 4, 1, QUAD, 0, STAT)
      CALL OK(STAT)
      CALL ABOVE(SURF, 0.4D0, 0D0)
      CALL RIISF_SURFACE_UPDATE_ARRAYS_64(SURF, BIG, XYZ(1,1), XYZ(2,1),
     &  XYZ(3,1), BIG - 1, V(1,1), V(2,1), V(3,1), BIG - 1, 4, BIG / 4,
     &  QUADL, 1, STAT)
      CALL OK(STAT)
      CALL ABOVE(SURF, 0.2D0, 3D0)
      CALL RIISF_SURFACE_FROM_ARRAYS_64(BIG, XYZ(1,1), XYZ(2,1),
     &  XYZ(3,1), BIG - 1, 4, BIG / 4, QUADL, 1, 0.5D0, 0.05D0, 2D0,
     &  AXIS, 0D0, ZERO, SURF2, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_UPDATE_ARRAYS(SURF2, 4, XYZ(1,1), XYZ(2,1),
     &  XYZ(3,1), 3, ZERO, ZERO, V, 1, 4, 1, QUAD, 2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'index_base is 2')
      CALL RIISF_SURFACE_DESTROY(SURF2)
C     The skirt has four strips around the square. The library chooses
C     the attached vertices, or uses those of the caller.
      DO 20 I = -1, 1, 2
        HELD(1) = INT(I, 1)
        CALL RIISF_SURFACE_WITH_SKIRT(4, X, Y, Z, 1, 4, 1, QUAD, 0,
     &    HELD, 0.2D0, 0.5D0, 0.05D0, 2D0, AXIS, 0D0, ZERO, SURF2, STAT)
        CALL OK(STAT)
        CALL RIISF_SURFACE_DESTROY(SURF2)
   20 CONTINUE
      CALL RIISF_SURFACE_WITH_SKIRT_64(BIG, X, Y, Z, BIG / 4, 4,
     &  BIG / 4, QUADL, 1, HELD, -1D0, 0.5D0, 0.05D0, 2D0, AXIS, 0D0,
     &  ZERO, SURF2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'skirt_length is -1')
      CALL RIISF_SURFACE_FROM_ARRAYS(4, X, Y, Z, 1, 3, 1, FLAT, 1,
     &  0.5D0, 0.05D0, 2D0, AXIS, 0D0, ZERO, SURF2, STAT)
      CALL WANT(STAT, RIIS_INVALID_SURFACE, 'zero area')
      CALL RIISF_SURFACE_FROM_ARRAYS(4, X, Y, Z, 1, 4, 1, QUAD, 1,
     &  0.5D0, 0.05D0, 2D0, AXIS, 0D0, ZERO, SURF2, STAT)
      CALL WANT(STAT, RIIS_INVALID_SURFACE, 'corner 0 of face 0 is 0')
      CALL RIISF_SURFACE_FROM_ARRAYS(4, X, Y, Z, 1, 4, 1, QUAD, 0,
     &  0.5D0, 0.05D0, -2D0, AXIS, 0D0, ZERO, SURF2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'options.scale is -2')
      CALL RIISF_SURFACE_UPDATE_ARRAYS(SURF, 4, X, Y, Z, 1, ZERO, ZERO,
     &  ZERO, 0, 4, 1, QUAD, 0, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'velocity_stride is 0')
      IF (SURF2 .NE. 0) CALL FAILED('a refused surface')
      CALL RIISF_SURFACE_DESTROY(SURF)
      END

C     Tests a surface's vertices, velocities and closest points. The
C     surface is a square at z = 0.1 that rises with the speed 1.5.
      SUBROUTINE CLOSE
      INCLUDE 'riisf.h'
      INTEGER NP
      PARAMETER (NP = 5)
      INTEGER*8 SURF, VALVE, BIG, NL, TRI(NP), NUML(2)
      DOUBLE PRECISION XYZ(3,4), V(3,4), GOT(3,4), P(3,NP), D(NP)
      DOUBLE PRECISION Q(3,NP), NORMAL(3,NP), AXIS(3), ZERO(3)
      INTEGER STAT, QUAD(4,1), N, I, LEAF(NP), SIDE(NP), NUM(2)
      DATA SURF, VALVE /2*0/, AXIS /0D0, 0D0, 1D0/, ZERO /3*0D0/
      DATA QUAD /1, 2, 3, 4/, NUM /2, 4/, V /2*0D0, 1.5D0, 2*0D0, 1.5D0,
     &  2*0D0, 1.5D0, 2*0D0, 1.5D0/
      CALL CORNER(XYZ, 0.1D0)
      DO 10 I = 1, NP
        P(1,I) = 0.25D0
        P(2,I) = -0.125D0
        P(3,I) = 0.5D0 * I - 1.5D0
   10 CONTINUE
      BIG = 4
      CALL RIISF_SURFACE_FROM_ARRAYS(4, XYZ(1,1), XYZ(2,1), XYZ(3,1), 3,
     &  4, 1, QUAD, 1, 0.5D0, 0.05D0, 1D0, AXIS, 0D0, ZERO, SURF, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_VERTICES(SURF, 4, N, GOT, STAT)
      CALL OK(STAT)
      CALL SAME12(N, GOT, XYZ)
      N = 0
      CALL RIISF_SURFACE_VERTICES(SURF, 3, N, GOT, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'length is 3; vertices: 4')
      IF (N .NE. 4) CALL FAILED('how long the array has to be')
      CALL RIISF_SURFACE_VERTEX_VELOCITIES(SURF, 4, N, GOT, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'has no velocities')
      CALL RIISF_SURFACE_UPDATE_ARRAYS(SURF, 4, XYZ(1,1), XYZ(2,1),
     &  XYZ(3,1), 3, V(1,1), V(2,1), V(3,1), 3, 4, 1, QUAD, 1, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_VERTEX_VELOCITIES(SURF, 4, N, GOT, STAT)
      CALL OK(STAT)
      CALL SAME12(N, GOT, V)
      CALL RIISF_SURFACE_VERTEX_VELOCITIES_64(SURF, BIG, NL, GOT, STAT)
      CALL OK(STAT)
      CALL SAME12(INT(NL), GOT, V)
      CALL RIISF_SURFACE_VERTICES_64(SURF, BIG, NL, GOT, STAT)
      CALL OK(STAT)
      CALL SAME12(INT(NL), GOT, XYZ)
      CALL RIISF_SURFACE_VERTICES_64(VALVE, BIG, NL, GOT, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'surface is NULL')

      BIG = NP
      NUML(1) = 3
      NUML(2) = 5
      CALL NOTHING(NP, D, Q, NORMAL, TRI, LEAF, SIDE)
      CALL RIISF_CLOSEST_POINTS(SURF, NP, P(1,1), P(2,1), P(3,1), 3,
     &  HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL OK(STAT)
      CALL BESIDE(NP, P, D, Q, NORMAL, TRI, LEAF, SIDE, 1, NP, 1)
      CALL NOTHING(NP, D, Q, NORMAL, TRI, LEAF, SIDE)
      CALL RIISF_CLOSEST_POINTS_64(SURF, BIG, P(1,1), P(2,1), P(3,1),
     &  3_8, HUGE(1D0), 2, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL OK(STAT)
      CALL BESIDE(NP, P, D, Q, NORMAL, TRI, LEAF, SIDE, 1, NP, 1)
      CALL NOTHING(NP, D, Q, NORMAL, TRI, LEAF, SIDE)
      CALL RIISF_CLOSEST_POINTS_LISTED(SURF, NP, P(1,1), P(2,1), P(3,1),
     &  3, 2, NUM, HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL OK(STAT)
      CALL BESIDE(NP, P, D, Q, NORMAL, TRI, LEAF, SIDE, 2, 4, 2)
      CALL NOTHING(NP, D, Q, NORMAL, TRI, LEAF, SIDE)
      CALL RIISF_CLOSEST_POINTS_LISTED_64(SURF, BIG, P(1,1), P(2,1),
     &  P(3,1), 3_8, 2_8, NUML, HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF,
     &  SIDE, STAT)
      CALL OK(STAT)
      CALL BESIDE(NP, P, D, Q, NORMAL, TRI, LEAF, SIDE, 3, 5, 2)
      CALL NOTHING(NP, D, Q, NORMAL, TRI, LEAF, SIDE)
      CALL RIISF_CLOSEST_POINTS_LISTED(SURF, NP, P(1,1), P(2,1), P(3,1),
     &  3, 0, NUM, HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL OK(STAT)
      NUM(2) = 2
      CALL RIISF_CLOSEST_POINTS_LISTED(SURF, NP, P(1,1), P(2,1), P(3,1),
     &  3, 2, NUM, HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'entry 1 is 1')
      NUM(1) = 0
      CALL RIISF_CLOSEST_POINTS_LISTED(SURF, NP, P(1,1), P(2,1), P(3,1),
     &  3, 2, NUM, HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'entry 0 is -1')
      CALL RIISF_CLOSEST_POINTS_LISTED(SURF, NP, P(1,1), P(2,1), P(3,1),
     &  3, -1, NUM, HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_point_ids is -1')
      CALL RIISF_CLOSEST_POINTS(SURF, NP, P(1,1), P(2,1), P(3,1), 3,
     &  -2D0, 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'distance_limit is -2')
      DO 20 I = 1, NP
        IF (ABS(D(I) + 7D0) .GT. 0D0 .OR. SIDE(I) .NE. -7)
     &    CALL FAILED('a refused call or an empty list writes nothing')
   20 CONTINUE
      CALL RIISF_CLOSEST_POINTS(SURF, NP, P(1,1), P(2,1), P(3,1), 3,
     &  0.5D0, 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL OK(STAT)
      IF (D(1) .LT. RIIS_FAR_DISTANCE .OR. TRI(1) .NE. -1 .OR. D(3) .GT.
     &  0.2D0) CALL FAILED('a limit')

C     A surface with distances by sampling has no sides.
      CALL VALVEOF('aortic', VALVE)
      CALL RIISF_SURFACE_MEASURE(SURF, VALVE, 0.12D0, 0.05D0, 1D0, AXIS,
     &  0D0, ZERO, RIIS_MEASURE_SAMPLING, 0.1D0, STAT)
      CALL OK(STAT)
      CALL RIISF_CLOSEST_POINTS(SURF, NP, P(1,1), P(2,1), P(3,1), 3,
     &  HUGE(1D0), 1, D, Q, NORMAL, TRI, LEAF, SIDE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'arrays.side is given')
      CALL RIISF_VALVE_DESTROY(VALVE)
      CALL RIISF_SURFACE_DESTROY(SURF)
      END

C     A fixed triangulation keeps its number of vertices at every
C     opening, and an adapted triangulation does not.
      SUBROUTINE FIXED
      INCLUDE 'riisf.h'
      INTEGER*8 SURF, VALVE
      DOUBLE PRECISION AXIS(3), ZERO(3), XYZ(3,20000)
      INTEGER STAT, N(2), K, J
      SAVE XYZ
      DATA SURF, VALVE /2*0/, AXIS /0D0, 0D0, 1D0/, ZERO /3*0D0/
      CALL VALVEOF('mitral', VALVE)
      CALL HERE(VALVE, RIIS_AUTO, SURF)
      DO 20 K = RIIS_TRIANGULATION_ADAPTED, RIIS_TRIANGULATION_FIXED
        DO 10 J = 1, 2
          CALL SETONE(VALVE, 'opening', 0.3D0 * J)
          IF (J .EQ. 1) CALL RIISF_SURFACE_TRIANGULATE(SURF, VALVE,
     &      RIIS_AUTO, 0.05D0, 1D0, AXIS, 0D0, ZERO, K, STAT)
          IF (J .EQ. 2) CALL RIISF_SURFACE_UPDATE(SURF, VALVE, STAT)
          CALL OK(STAT)
          CALL RIISF_SURFACE_VERTICES(SURF, 20000, N(J), XYZ, STAT)
          CALL OK(STAT)
   10   CONTINUE
        IF (K .EQ. RIIS_TRIANGULATION_FIXED .NEQV. N(1) .EQ. N(2))
     &    CALL FAILED('fixed triangles')
   20 CONTINUE
      CALL SETONE(VALVE, 'surface_angle', 3D0)
      CALL RIISF_SURFACE_UPDATE(SURF, VALVE, STAT)
      CALL WANT(STAT, RIIS_INVALID_PARAMETER, 'surface_angle')
      CALL RIISF_SURFACE_TRIANGULATE(SURF, VALVE, RIIS_AUTO, 0.05D0,
     &  1D0, AXIS, 0D0, ZERO, 7, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'triangulation is 7')
      CALL RIISF_SURFACE_DESTROY(SURF)
      CALL RIISF_VALVE_DESTROY(VALVE)
      END

      SUBROUTINE SAME12(N, A, B)
      INTEGER N, I
      DOUBLE PRECISION A(12), B(12)
      IF (N .NE. 4) CALL FAILED('four vertices')
      DO 10 I = 1, 12
        CALL NEAR(A(I), B(I), 'what the surface consists of')
   10 CONTINUE
      END

C     Fills the arrays with a value that marks entries as not written.
      SUBROUTINE NOTHING(N, D, Q, NORMAL, TRI, LEAF, SIDE)
      INTEGER N, LEAF(N), SIDE(N), I, C
      INTEGER*8 TRI(N)
      DOUBLE PRECISION D(N), Q(3,N), NORMAL(3,N)
      DO 20 I = 1, N
        D(I) = -7D0
        TRI(I) = -7
        LEAF(I) = -7
        SIDE(I) = -7
        DO 10 C = 1, 3
          Q(C,I) = -7D0
          NORMAL(C,I) = -7D0
   10   CONTINUE
   20 CONTINUE
      END

C     Checks that only the points first, first + by, ... last have
C     results.
      SUBROUTINE BESIDE(N, P, D, Q, NORMAL, TRI, LEAF, SIDE, FIRST,
     &  LAST, BY)
      INTEGER N, LEAF(N), SIDE(N), FIRST, LAST, BY, I
      INTEGER*8 TRI(N)
      DOUBLE PRECISION P(3,N), D(N), Q(3,N), NORMAL(3,N)
      DO 10 I = 1, N
        IF (I .GE. FIRST .AND. I .LE. LAST .AND.
     &    MOD(I - FIRST, BY) .EQ. 0) THEN
          CALL NEAR(D(I), ABS(P(3,I) - 0.1D0), 'a distance')
          CALL NEAR(Q(1,I), P(1,I), 'x of a closest point')
          CALL NEAR(Q(2,I), P(2,I), 'y of a closest point')
          CALL NEAR(Q(3,I), 0.1D0, 'z of a closest point')
          CALL NEAR(NORMAL(3,I), 1D0, 'a normal')
          IF (TRI(I) .NE. 0 .OR. LEAF(I) .NE. 0)
     &      CALL FAILED('a triangle')
          IF (SIDE(I) .NE. NINT(SIGN(1D0, P(3,I) - 0.1D0)))
     &      CALL FAILED('a side')
        ELSE
          IF (TRI(I) .NE. -7 .OR. LEAF(I) .NE. -7 .OR. SIDE(I) .NE. -7)
     &      CALL FAILED('ids of another point')
          CALL NEAR(D(I), -7D0, 'another point')
          CALL NEAR(Q(3,I), -7D0, 'another point')
          CALL NEAR(NORMAL(1,I), -7D0, 'another point')
        END IF
   10 CONTINUE
      END

C     Gives the corners of a square from -1 to 1 at a height.
      SUBROUTINE CORNER(XYZ, HEIGHT)
      DOUBLE PRECISION XYZ(3,4), HEIGHT, SQUARE(2,4)
      INTEGER I
      DATA SQUARE /-1D0, -1D0, 1D0, -1D0, 1D0, 1D0, -1D0, 1D0/
      DO 10 I = 1, 4
        XYZ(1,I) = SQUARE(1,I)
        XYZ(2,I) = SQUARE(2,I)
        XYZ(3,I) = HEIGHT
   10 CONTINUE
      END

C     Checks the surface's height over the z axis and its upward speed,
C     by a node at z = 0.1 and a node at z = 0.7.
      SUBROUTINE ABOVE(SURF, HEIGHT, SPEED)
      INCLUDE 'riisf.h'
      INTEGER*8 SURF, MESH, RES
      DOUBLE PRECISION HEIGHT, SPEED, XYZ(3,2), DIST(2), V(3,2)
      INTEGER STAT, N, NODE(2), I
      SAVE XYZ
      MESH = 0
      RES = 0
      DO 10 I = 1, 2
        XYZ(1,I) = 0.3D0
        XYZ(2,I) = 0.2D0
        XYZ(3,I) = 0.6D0 * I - 0.5D0
   10 CONTINUE
      CALL RIISF_MESH_CREATE(2, XYZ(1,1), XYZ(2,1), XYZ(3,1), 3, MESH,
     &  STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_WITH_FIELDS(SURF, MESH, 1D0, RIIS_SEARCH_AUTO, 1,
     &  RIIS_FIELD_VELOCITY, RES, STAT)
      CALL OK(STAT)
      CALL RIISF_WITHIN_LIMIT(RES, 2, N, NODE, DIST, STAT)
      CALL OK(STAT)
      CALL RIISF_WITHIN_LIMIT_REALS(RES, RIIS_FIELD_VELOCITY, 2, N, V,
     &  STAT)
      CALL OK(STAT)
      IF (N .NE. 2) CALL FAILED('both nodes')
      DO 20 I = 1, 2
        CALL NEAR(DIST(I), ABS(XYZ(3,I) - HEIGHT), 'the height')
        CALL NEAR(V(1,I), 0D0, 'no speed to a side')
        CALL NEAR(V(3,I), SPEED, 'the speed')
   20 CONTINUE
      CALL RIISF_MARKS_DESTROY(RES)
      CALL RIISF_MESH_DESTROY(MESH)
      END
