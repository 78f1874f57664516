C     SPDX-License-Identifier: Apache-2.0
C     Tests the external subroutines for velocities and momentum in
C     three arrays, as a Fortran 77 code with a halo has them. The bits
C     must be those that calls with arrays (3, n) give. The triangles of
C     a surface must have the areas of its leaflets.
      PROGRAM TF77A
      IMPLICIT NONE
      INCLUDE 'riisf.h'
      INTEGER M, NN
      PARAMETER (M = 21, NN = (M + 2)**3)
      INTEGER*8 VALVE, TWIN, SURF, MESH, RES
      DATA VALVE, TWIN, SURF, MESH, RES /5*0/
      DOUBLE PRECISION X(M), VX(0:M+1,0:M+1,0:M+1)
      DOUBLE PRECISION VY(0:M+1,0:M+1,0:M+1), VZ(0:M+1,0:M+1,0:M+1)
      DOUBLE PRECISION W(0:M+1,0:M+1,0:M+1), AXIS(3), ZERO(3), OPEN(1)
      COMMON /FLOW/ VX, VY, VZ, W
      INTEGER I, J, K, STAT
      DATA AXIS /0D0, 0D0, 1D0/, ZERO /3*0D0/, OPEN /0.6D0/
      DO 10 I = 1, M
        X(I) = -1.4D0 + 0.14D0 * (I - 1)
   10 CONTINUE
      DO 40 K = 0, M + 1
        DO 30 J = 0, M + 1
          DO 20 I = 0, M + 1
            VX(I,J,K) = COS(0.3D0 * J)
            VY(I,J,K) = SIN(0.7D0 * (K + I))
            VZ(I,J,K) = 2D0 + 0.1D0 * I
            W(I,J,K) = 1D0 + MOD(I + J, 3)
   20     CONTINUE
   30   CONTINUE
   40 CONTINUE
      CALL RIISF_VALVE_CREATE('trileaflet', VALVE, STAT)
      CALL OK(STAT)
      CALL RIISF_VALVE_COPY(VALVE, TWIN, STAT)
      CALL OK(STAT)
      CALL RIISF_VALVE_SET(VALVE, 'opening', 1, OPEN, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_CREATE(VALVE, 0.3D0, 0.05D0, 1D0, AXIS, 0D0,
     &  ZERO, SURF, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_UPDATE_MOVING(SURF, VALVE, TWIN, 0.1D0, STAT)
      CALL OK(STAT)
      CALL RIISF_MESH_CREATE_GRID(M, M, M, X, X, X, 64,
     &  1 + 1 + (M + 2) + (M + 2)**2, 1, M + 2, (M + 2)**2, NN, MESH,
     &  STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_WITH_FIELDS(SURF, MESH, RIIS_AUTO,
     &  RIIS_SEARCH_AUTO, 0, RIIS_FIELD_POINT + RIIS_FIELD_VELOCITY +
     &  RIIS_FIELD_BARYCENTRIC + RIIS_FIELD_RIM, RES, STAT)
      CALL OK(STAT)
      CALL MOMENT(RES, NN)
      CALL FORCES(RES, SURF, NN)
      CALL TRIANG(SURF)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_AUTO, 0,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_RESISTANCE_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, W, VX, VY, VZ, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'RIIS_FIELD_VELOCITY')
      CALL RIISF_MARKS_DESTROY(RES)
      CALL RIISF_MESH_DESTROY(MESH)
      CALL RIISF_SURFACE_DESTROY(SURF)
      CALL RIISF_VALVE_DESTROY(TWIN)
      CALL RIISF_VALVE_DESTROY(VALVE)
      PRINT *, 'all components agree'
      END

C     K and K u_surface, of both kinds of counts, in arrays with a halo.
      SUBROUTINE MOMENT(RES, NN)
      INTEGER M, NN, I, J, K, STAT
      PARAMETER (M = 21)
      INTEGER*8 RES, BIG
      DOUBLE PRECISION K1(0:M+1,0:M+1,0:M+1), KX(0:M+1,0:M+1,0:M+1)
      DOUBLE PRECISION KY(0:M+1,0:M+1,0:M+1), KZ(0:M+1,0:M+1,0:M+1)
      DOUBLE PRECISION K2(0:M+1,0:M+1,0:M+1)
      DOUBLE PRECISION KU(3,0:M+1,0:M+1,0:M+1)
      COMMON /KS/ K1, KX, KY, KZ, K2, KU
      INCLUDE 'riisf.h'
      BIG = NN
      DO 30 K = 0, M + 1
        DO 20 J = 0, M + 1
          DO 10 I = 0, M + 1
            K1(I,J,K) = 0.5D0
            K2(I,J,K) = 0.5D0
            KX(I,J,K) = 0.1D0 * I
            KY(I,J,K) = 0.1D0 * J
            KZ(I,J,K) = 0.1D0 * K
            KU(1,I,J,K) = KX(I,J,K)
            KU(2,I,J,K) = KY(I,J,K)
            KU(3,I,J,K) = KZ(I,J,K)
   10     CONTINUE
   20   CONTINUE
   30 CONTINUE
      CALL RIISF_ADD_RESISTANCE_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN - 1, K1, KX, KY, KZ, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_nodes is 12166')
      CALL RIISF_ADD_RESISTANCE_COMPONENTS(RES, 3D0, RIIS_AUTO, 7, NN,
     &  K1, KX, KY, KZ, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'rim is 7')
      CALL RIISF_ADD_RESISTANCE_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, K1, KX, KY, KZ, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_RESISTANCE_COMPONENTS_64(RES, 2D0, 0.2D0,
     &  RIIS_RIM_CUT, BIG, K1, KX, KY, KZ, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_MOVING_RESISTANCE(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, K2, KU, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_MOVING_RESISTANCE(RES, 2D0, 0.2D0, RIIS_RIM_CUT,
     &  NN, K2, KU, STAT)
      CALL OK(STAT)
      CALL EQUAL(NN, K1, 1, 1, K2, 'K')
      CALL EQUAL(NN, KX, 3, 1, KU, 'the x component of K u_surface')
      CALL EQUAL(NN, KY, 3, 2, KU, 'the y component')
      CALL EQUAL(NN, KZ, 3, 3, KU, 'the z component')
      J = 0
      DO 40 I = 1, M
        IF (ABS(KZ(I,11,8) - 0.8D0) .GT. 1D-3) J = J + 1
   40 CONTINUE
      IF (J .EQ. 0) CALL FAILED('nothing moves')
      END

C     Checks that A is the row C of B, to the bit.
      SUBROUTINE EQUAL(N, A, NC, C, B, TEXT)
      INTEGER N, NC, C, I
      DOUBLE PRECISION A(N), B(NC,N)
      CHARACTER*(*) TEXT
      DO 10 I = 1, N
        IF (ABS(A(I) - B(C,I)) .GT. 0D0) CALL FAILED(TEXT)
   10 CONTINUE
      END

C     The forces on the whole, on leaflets, at edges and at vertices.
      SUBROUTINE FORCES(RES, SURF, NN)
      INTEGER M, NN, ME, MV
      PARAMETER (M = 21, ME = 400, MV = 20000)
      INTEGER*8 RES, SURF, BIG, NL
      INTEGER I, L, N, NV, STAT, ID(ME)
      DOUBLE PRECISION VX((M+2)**3), VY((M+2)**3), VZ((M+2)**3)
      DOUBLE PRECISION W((M+2)**3), VEL(3,(M+2)**3), E(3,2,ME)
      DOUBLE PRECISION F(3,3), WHOLE(3,3), MOM(3,3), FL(3,3,3)
      DOUBLE PRECISION ML(3,3,3), FE(3,ME,3), MOE(3,ME,3), FV(3,MV,3)
      DOUBLE PRECISION ABOUT(3), ALL
      COMMON /FLOW/ VX, VY, VZ, W
      COMMON /FS/ VEL, E, FE, MOE, FV, ID
      DATA ABOUT /1D0, 2D0, 3D0/, F, WHOLE, MOM, FL, ML /81*0D0/
      INCLUDE 'riisf.h'
      BIG = NN
      DO 10 I = 1, NN
        VEL(1,I) = VX(I)
        VEL(2,I) = VY(I)
        VEL(3,I) = VZ(I)
   10 CONTINUE
      CALL RIISF_SURFACE_ATTACHMENT(SURF, ME, N, E, ID, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_VERTICES(SURF, MV, NV, FV, STAT)
      CALL OK(STAT)
      DO 40 L = 1, 3
        DO 20 I = 1, N
          CALL CLEAR(FE(1,I,L))
          CALL CLEAR(MOE(1,I,L))
   20   CONTINUE
        DO 30 I = 1, NV
          CALL CLEAR(FV(1,I,L))
   30   CONTINUE
   40 CONTINUE

      CALL RIISF_ADD_REACTION(RES, 3D0, RIIS_AUTO, RIIS_RIM_ROUND, NN,
     &  VEL, W, F, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, F(1,2), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_REACTION_COMPONENTS_64(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VX, VY, VZ, W, F(1,3), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_REACTION_COMPONENTS(RES, -3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, F(1,2), STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'resistance.R is -3')
      CALL THRICE(3, F, 'the force')

      CALL RIISF_ADD_LEAFLET_REACTION(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, ABOUT, 3, WHOLE, MOM, FL, ML, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_LEAFLET_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, ABOUT, 3, WHOLE(1,2),
     &  MOM(1,2), FL(1,1,2), ML(1,1,2), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_LEAFLET_REACTION_COMPONENTS_64(RES, 3D0,
     &  RIIS_AUTO, RIIS_RIM_ROUND, BIG, VX, VY, VZ, W, ABOUT, 3,
     &  WHOLE(1,3), MOM(1,3), FL(1,1,3), ML(1,1,3), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_LEAFLET_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, ABOUT, 1, WHOLE, MOM, FL,
     &  ML, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_leaflets is 1, but')
      CALL THRICE(3, WHOLE, 'the force with leaflets')
      CALL THRICE(3, MOM, 'the moment')
      CALL THRICE(9, FL, 'the force of leaflets')
      CALL THRICE(9, ML, 'the moment of leaflets')

      CALL RIISF_ADD_EDGE_REACTION(RES, 3D0, RIIS_AUTO, RIIS_RIM_ROUND,
     &  NN, VEL, W, N, E, ID, FE, MOE, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_EDGE_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, N, E, ID, FE(1,1,2),
     &  MOE(1,1,2), STAT)
      CALL OK(STAT)
      NL = N
      CALL RIISF_ADD_EDGE_REACTION_COMPONENTS_64(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VX, VY, VZ, W, NL, E, ID, FE(1,1,3),
     &  MOE(1,1,3), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_EDGE_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, 0, E, ID, FE, MOE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'reaction.n_edges is 0')
      CALL THRICE(3 * ME, FE, 'the force at edges')
      CALL THRICE(3 * ME, MOE, 'the moment at edges')

      CALL RIISF_ADD_VERTEX_REACTION(RES, SURF, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, NV, FV, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_VERTEX_REACTION_COMPONENTS(RES, SURF, 3D0,
     &  RIIS_AUTO, RIIS_RIM_ROUND, NN, VX, VY, VZ, W, NV, FV(1,1,2),
     &  STAT)
      CALL OK(STAT)
      NL = NV
      CALL RIISF_ADD_VERTEX_REACTION_COMPONENTS_64(RES, SURF, 3D0,
     &  RIIS_AUTO, RIIS_RIM_ROUND, BIG, VX, VY, VZ, W, NL, FV(1,1,3),
     &  STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_VERTEX_REACTION_COMPONENTS(RES, SURF, 3D0,
     &  RIIS_AUTO, RIIS_RIM_ROUND, NN, VX, VY, VZ, W, 7, FV, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_vertices is 7; the')
      CALL THRICE(3 * MV, FV, 'the force at vertices')
      ALL = -F(3,1)
      DO 50 I = 1, NV
        ALL = ALL + FV(3,I,1)
   50 CONTINUE
      IF (ABS(ALL) .GT. 1D-9 * ABS(F(3,1)) .OR. ABS(F(3,1)) .LT. 1D-3)
     &  CALL FAILED('the force at vertices is the force')
      END

      SUBROUTINE CLEAR(F)
      DOUBLE PRECISION F(3)
      F(1) = 0D0
      F(2) = 0D0
      F(3) = 0D0
      END

C     Checks that three arrays are equal, to the bit.
      SUBROUTINE THRICE(N, A, TEXT)
      INTEGER N, I
      DOUBLE PRECISION A(N,3)
      CHARACTER*(*) TEXT
      DO 10 I = 1, N
        IF (ABS(A(I,2) - A(I,1)) + ABS(A(I,3) - A(I,1)) .GT. 0D0)
     &    CALL FAILED(TEXT)
   10 CONTINUE
      END

C     The triangles have the areas of the leaflets, and queries report
C     their ids.
      SUBROUTINE TRIANG(SURF)
      INTEGER MV, MT
      PARAMETER (MV = 20000, MT = 40000)
      INTEGER*8 SURF, NL, TRI(MT), TRI2(MT), FOUND(MT)
      INTEGER I, J, L, N, NV, NEAR, STAT, V(3,MT), LEAF(MT), LEAF2(MT)
      INTEGER*8 V2(3,MT)
      INTEGER PATCH(MT), PATCH2(MT), SIDE(MT), ID
      DOUBLE PRECISION XYZ(3,MV), MID(3,MT), DIST(MT), AT(3,MT)
      DOUBLE PRECISION NORMAL(3,MT), A(3), B(3), C(3), SUM(3), AREA
      DOUBLE PRECISION EDGE
      COMMON /TS/ TRI, TRI2, FOUND, V2, XYZ, MID, DIST, AT, NORMAL, V,
     &  LEAF, LEAF2, PATCH, PATCH2, SIDE
      DATA SUM /3*0D0/
      INCLUDE 'riisf.h'
      N = 0
      CALL RIISF_SURFACE_TRIANGLES(SURF, 0, N, V, TRI, LEAF, PATCH,
     &  STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'length is 0; triangles: ')
      IF (N .LT. 100 .OR. N .GT. MT) CALL FAILED('how many triangles')
      I = N
      CALL RIISF_SURFACE_TRIANGLES(SURF, I, N, V, TRI, LEAF, PATCH,
     &  STAT)
      CALL OK(STAT)
      IF (N .NE. I) CALL FAILED('the number of triangles')
      CALL RIISF_SURFACE_TRIANGLES_64(SURF, INT(MT, 8), NL, V2, TRI2,
     &  LEAF2, PATCH2, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_VERTICES(SURF, MV, NV, XYZ, STAT)
      CALL OK(STAT)
      IF (NL .NE. N) CALL FAILED('as many triangles')
      DO 20 I = 1, N
        DO 10 J = 1, 3
          IF (V(J,I) .LT. 1 .OR. V(J,I) .GT. NV .OR. V2(J,I) .NE.
     &      V(J,I)) CALL FAILED('a corner')
          A(J) = XYZ(J,V(2,I)) - XYZ(J,V(1,I))
          B(J) = XYZ(J,V(3,I)) - XYZ(J,V(1,I))
          MID(J,I) = XYZ(J,V(1,I)) + (A(J) + B(J)) / 3D0
   10   CONTINUE
        C(1) = A(2) * B(3) - A(3) * B(2)
        C(2) = A(3) * B(1) - A(1) * B(3)
        C(3) = A(1) * B(2) - A(2) * B(1)
        L = LEAF(I) + 1
        IF (L .LT. 1 .OR. L .GT. 3 .OR. PATCH(I) / 4 .NE. LEAF(I) .OR.
     &    LEAF2(I) .NE. LEAF(I) .OR. PATCH2(I) .NE. PATCH(I) .OR.
     &    TRI2(I) .NE. TRI(I)) CALL FAILED('the ids of a triangle')
        SUM(L) = SUM(L) + SQRT(C(1)**2 + C(2)**2 + C(3)**2) / 2D0
   20 CONTINUE
      DO 30 L = 1, 3
        CALL RIISF_SURFACE_LEAFLET(SURF, L, ID, AREA, EDGE, STAT)
        CALL OK(STAT)
        IF (ID .NE. L - 1 .OR. ABS(SUM(L) - AREA) .GT. 1D-12 * AREA)
     &    CALL FAILED('the area of a leaflet')
   30 CONTINUE
      CALL RIISF_CLOSEST_POINTS(SURF, N, MID(1,1), MID(2,1), MID(3,1),
     &  3, HUGE(1D0), 0, DIST, AT, NORMAL, FOUND, LEAF2, SIDE, STAT)
      CALL OK(STAT)
      NEAR = 0
      DO 40 I = 1, N
        IF (FOUND(I) .EQ. TRI(I) .AND. DIST(I) .LT. 1D-12)
     &    NEAR = NEAR + 1
   40 CONTINUE
C     Leaflets meet at a commissure, so a query there may find another
C     leaflet.
      IF (NEAR .LT. N - N / 100) CALL FAILED('the ids of queries')
      END
