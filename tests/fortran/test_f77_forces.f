C     SPDX-License-Identifier: Apache-2.0
C     Tests the external subroutines for K, for forces and for loads of
C     tissue, as a Fortran 77 code with a halo calls them. Three arrays
C     of components must give the bits of an array (3, n), and parts
C     must add up to the whole. The triangles of a surface must have the
C     areas of its leaflets.
      PROGRAM TF77F
      IMPLICIT NONE
      INCLUDE 'riisf.h'
      INTEGER M, NN
      PARAMETER (M = 21, NN = (M + 2)**3)
      INTEGER*8 VALVE, TWIN, SURF, MESH, RES
      DATA VALVE, TWIN, SURF, MESH, RES /5*0/
      DOUBLE PRECISION X(M), VX(0:M+1,0:M+1,0:M+1)
      DOUBLE PRECISION VY(0:M+1,0:M+1,0:M+1), VZ(0:M+1,0:M+1,0:M+1)
      DOUBLE PRECISION W(0:M+1,0:M+1,0:M+1)
      COMMON /FLOW/ VX, VY, VZ, W
      INTEGER I, J, K, STAT
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
      CALL VALVEOF('trileaflet', VALVE)
      CALL RIISF_VALVE_COPY(VALVE, TWIN, STAT)
      CALL OK(STAT)
      CALL SETONE(VALVE, 'opening', 0.6D0)
      CALL HERE(VALVE, 0.3D0, SURF)
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
      PRINT *, 'all forces agree'
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
C     Calls for (3, n) and for components take counts of both kinds.
      SUBROUTINE FORCES(RES, SURF, NN)
      INTEGER M, NN, ME, MV
      PARAMETER (M = 21, ME = 400, MV = 20000)
      INTEGER*8 RES, SURF, BIG, NL
      INTEGER I, J, L, N, NV, STAT, ID(ME), ID2(ME)
      DOUBLE PRECISION VX((M+2)**3), VY((M+2)**3), VZ((M+2)**3)
      DOUBLE PRECISION W((M+2)**3), VEL(3,(M+2)**3), E(3,2,ME)
      DOUBLE PRECISION E2(3,2,ME), F(3,4), WHOLE(3,5), MOM(3,5)
      DOUBLE PRECISION FL(3,3,5), ML(3,3,5), FE(3,ME,5), MOE(3,ME,5)
      DOUBLE PRECISION FV(3,MV,4), ABOUT(3), ZERO(3), S(4), ALL
      COMMON /FLOW/ VX, VY, VZ, W
      COMMON /FS/ VEL, E, E2, FE, MOE, FV, ID, ID2
      DATA ABOUT /1D0, 2D0, 3D0/, F, WHOLE, MOM /42*0D0/, ZERO /3*0D0/
      DATA FL, ML /90*0D0/
      INCLUDE 'riisf.h'
      BIG = NN
      DO 10 I = 1, NN
        VEL(1,I) = VX(I)
        VEL(2,I) = VY(I)
        VEL(3,I) = VZ(I)
   10 CONTINUE
      N = 0
      CALL RIISF_SURFACE_ATTACHMENT(SURF, 5, N, E, ID, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'length is 5; edges: ')
      IF (N .LE. 5 .OR. N .GT. ME) CALL FAILED('the number of edges')
      CALL RIISF_SURFACE_ATTACHMENT(SURF, ME, N, E, ID, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_ATTACHMENT_64(SURF, INT(ME, 8), NL, E2, ID2,
     &  STAT)
      CALL OK(STAT)
      IF (NL .NE. N) CALL FAILED('as many edges')
      CALL EQUAL(6 * N, E, 1, 1, E2, 'the same edges')
      CALL RIISF_SURFACE_VERTICES(SURF, MV, NV, FV, STAT)
      CALL OK(STAT)
      DO 40 L = 1, 5
        DO 20 I = 1, N
          CALL CLEAR(FE(1,I,L))
          CALL CLEAR(MOE(1,I,L))
          IF (ID(I) .LT. 0 .OR. ID(I) .GT. 2 .OR. ID2(I) .NE. ID(I))
     &      CALL FAILED('the leaflet of an edge')
   20   CONTINUE
        DO 30 I = 1, NV
          IF (L .LE. 4) CALL CLEAR(FV(1,I,L))
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
      CALL RIISF_ADD_REACTION_64(RES, 3D0, RIIS_AUTO, RIIS_RIM_ROUND,
     &  BIG, VEL, W, F(1,4), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_REACTION_COMPONENTS(RES, -3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, F(1,2), STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'resistance.R is -3')
      CALL ALIKE(3, F, 'the force')
      IF (ABS(F(3,1)) .LT. 1D-3) CALL FAILED('a force')

C     The moment about another point is the moment of the force more.
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
      CALL RIISF_ADD_LEAFLET_REACTION_64(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VEL, W, ABOUT, 3, WHOLE(1,4), MOM(1,4),
     &  FL(1,1,4), ML(1,1,4), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_LEAFLET_REACTION(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, ZERO, 3, WHOLE(1,5), MOM(1,5),
     &  FL(1,1,5), ML(1,1,5), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_LEAFLET_REACTION(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, ABOUT, 1, WHOLE, MOM, FL, ML, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_leaflets is 1, but')
      CALL RIISF_ADD_LEAFLET_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, ABOUT, 1, WHOLE, MOM, FL,
     &  ML, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_leaflets is 1, but')
      CALL ALIKE(3, WHOLE, 'the force with leaflets')
      CALL ALIKE(3, MOM, 'the moment')
      CALL ALIKE(9, FL, 'the force of leaflets')
      CALL ALIKE(9, ML, 'the moment of leaflets')
      CALL EQUAL(3, F, 1, 1, WHOLE, 'the same whole')
      IF (ABS(MOM(3,5) - MOM(3,1) - ABOUT(1) * F(2,1) + ABOUT(2) *
     &  F(1,1)) .GT. 1D-9 * ABS(F(3,1))) CALL FAILED('another point')

C     With the leaflet -1, each edge serves all leaflets.
      CALL RIISF_ADD_EDGE_REACTION(RES, 3D0, RIIS_AUTO, RIIS_RIM_ROUND,
     &  NN, VEL, W, N, E, ID, FE, MOE, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_EDGE_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, N, E, ID, FE(1,1,2),
     &  MOE(1,1,2), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_EDGE_REACTION_COMPONENTS_64(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VX, VY, VZ, W, NL, E, ID, FE(1,1,3),
     &  MOE(1,1,3), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_EDGE_REACTION_64(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VEL, W, NL, E, ID, FE(1,1,4),
     &  MOE(1,1,4), STAT)
      CALL OK(STAT)
      ID2(1) = -1
      CALL RIISF_ADD_EDGE_REACTION_64(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VEL, W, NL, E, ID2, FE(1,1,5),
     &  MOE(1,1,5), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_EDGE_REACTION(RES, 3D0, RIIS_AUTO, RIIS_RIM_ROUND,
     &  NN, VEL, W, 0, E, ID, FE, MOE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'reaction.n_edges is 0')
      CALL RIISF_ADD_EDGE_REACTION_COMPONENTS(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, W, 0, E, ID, FE, MOE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'reaction.n_edges is 0')
      CALL ALIKE(3 * ME, FE, 'the force at edges')
      CALL ALIKE(3 * ME, MOE, 'the moment at edges')

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
      CALL RIISF_ADD_VERTEX_REACTION_64(RES, SURF, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VEL, W, NL, FV(1,1,4), STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_VERTEX_REACTION(RES, SURF, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, 7, FV, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_vertices is 7; the')
      CALL RIISF_ADD_VERTEX_REACTION_COMPONENTS(RES, SURF, 3D0,
     &  RIIS_AUTO, RIIS_RIM_ROUND, NN, VX, VY, VZ, W, 7, FV, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_vertices is 7; the')
      CALL ALIKE(3 * MV, FV, 'the force at vertices')

C     Leaflets, edges and vertices add up to the whole.
      DO 60 J = 1, 3
        ALL = ABS(F(J,1)) + ABS(F(3,1))
        S(1) = FL(J,1,1) + FL(J,2,1) + FL(J,3,1)
        CALL ADDUP(N, FE(1,1,1), J, S(2))
        CALL ADDUP(N, FE(1,1,5), J, S(3))
        CALL ADDUP(NV, FV, J, S(4))
        DO 50 I = 1, 4
          IF (ABS(S(I) - F(J,1)) .GT. 1D-9 * ALL) CALL FAILED('parts')
   50   CONTINUE
   60 CONTINUE
      CALL LOADS(N, E, ID, F, FL, ML)
      END

C     Nodes of tissue, eight beside each edge, get the force FW.
      SUBROUTINE LOADS(NE, E, ID, FW, FL, ML)
      INTEGER ME, MT
      PARAMETER (ME = 400, MT = 8 * ME)
      INTEGER NE, ID(ME), I, J, NT, STAT
      DOUBLE PRECISION E(3,2,ME), FW(3), FL(3,3), ML(3,3), ABOUT(3)
      DOUBLE PRECISION T(3,MT), TW(MT), A(3,MT), A2(3,MT), SUMS(11,3)
      DOUBLE PRECISION SUMS2(11,3), S, S2
      COMMON /LS/ T, TW, A, A2
      DATA ABOUT /1D0, 2D0, 3D0/, SUMS, SUMS2 /66*0D0/
      INCLUDE 'riisf.h'
      NT = 8 * NE
      DO 20 I = 1, NT
        DO 10 J = 1, 3
          T(J,I) = E(J,1,1 + (I - 1) / 8) + 0.15D0 * COS(2D0 * J * I)
   10   CONTINUE
        CALL CLEAR(A(1,I))
        CALL CLEAR(A2(1,I))
        TW(I) = 1D0 + MOD(I, 3)
   20 CONTINUE
      CALL RIISF_LOADS_SUMS(0D0, NE, E, ID, NT, T, TW, 3, SUMS, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'loads.radius is 0; it')
      CALL RIISF_LOADS_FORCES(0.3D0, NE, E, ID, NT, T, TW, 3, ABOUT,
     &  FL, ML, SUMS, A, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'tissue has 0 nodes')
      CALL RIISF_LOADS_SUMS(0.3D0, NE, E, ID, NT, T, TW, 3, SUMS, STAT)
      CALL OK(STAT)
      CALL RIISF_LOADS_FORCES(0.3D0, NE, E, ID, NT, T, TW, 3, ABOUT,
     &  FL, ML, SUMS, A, STAT)
      CALL OK(STAT)
C     Each edge now holds all leaflets.
      ID(1) = -1
      CALL RIISF_LOADS_SUMS_64(0.3D0, INT(NE, 8), E, ID, INT(NT, 8), T,
     &  TW, 3_8, SUMS2, STAT)
      CALL OK(STAT)
      CALL RIISF_LOADS_FORCES_64(0.3D0, INT(NE, 8), E, ID, INT(NT, 8),
     &  T, TW, 3_8, ABOUT, FL, ML, SUMS2, A2, STAT)
      CALL OK(STAT)
      IF (SUMS2(1,1) .LE. SUMS(1,1)) CALL FAILED('all edges hold it')
      DO 30 J = 1, 3
        CALL ADDUP(NT, A, J, S)
        CALL ADDUP(NT, A2, J, S2)
        IF (ABS(S - FW(J)) + ABS(S2 - FW(J)) .GT. 1D-9 * (ABS(FW(J)) +
     &    ABS(FW(3)))) CALL FAILED('the force on tissue')
   30 CONTINUE
      END

C     Returns the sum S of the row J.
      SUBROUTINE ADDUP(N, A, J, S)
      INTEGER N, J, I
      DOUBLE PRECISION A(3,N), S
      S = 0D0
      DO 10 I = 1, N
        S = S + A(J,I)
   10 CONTINUE
      END

      SUBROUTINE CLEAR(F)
      DOUBLE PRECISION F(3)
      F(1) = 0D0
      F(2) = 0D0
      F(3) = 0D0
      END

C     Checks that four arrays are equal, to the bit.
      SUBROUTINE ALIKE(N, A, TEXT)
      INTEGER N, L
      DOUBLE PRECISION A(N,4)
      CHARACTER*(*) TEXT
      DO 10 L = 2, 4
        CALL EQUAL(N, A(1,L), 1, 1, A, TEXT)
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
