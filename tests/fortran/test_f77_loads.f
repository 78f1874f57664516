C     SPDX-License-Identifier: Apache-2.0
C     Tests the external subroutines for forces at vertices and at nodes
C     of tissue as a Fortran 77 code calls them. The sums must be the
C     force of the whole valve.
      PROGRAM TF77L
      IMPLICIT NONE
      INCLUDE 'riisf.h'
      INTEGER M, NN, MV, ME, MT
      PARAMETER (M = 21, NN = M**3, MV = 20000, ME = 400, MT = 8 * ME)
      INTEGER*8 VALVE, SURF, MESH, RES, BIG, NL
      DATA VALVE, SURF, MESH, RES /4*0/
      DOUBLE PRECISION XYZ(3,NN), VEL(3,NN), W(NN), V(3,MV), F(3,MV)
      DOUBLE PRECISION F2(3,MV), AXIS(3), ZERO(3), ABOUT(3), FW(3)
      DOUBLE PRECISION MW(3), FL(3,3), ML(3,3), E(3,2,ME), T(3,MT)
      DOUBLE PRECISION TW(MT), SUMS(11,3), SUMS2(11,3), A(3,MT)
      DOUBLE PRECISION A2(3,MT), SUM, ALL
      INTEGER ID(ME), STAT, I, J, K, L, N, NE, NT
      COMMON /BIGONE/ XYZ, VEL, W, V, F, F2, E, T, TW, A, A2, ID
      DATA AXIS /0D0, 0D0, 1D0/, ZERO /3*0D0/, ABOUT /1D0, 2D0, 3D0/
      DATA FW, MW, FL, ML /24*0D0/, SUMS, SUMS2 /66*0D0/

      L = 0
      DO 30 K = 0, M - 1
        DO 20 J = 0, M - 1
          DO 10 I = 0, M - 1
            L = L + 1
            XYZ(1,L) = -1.4D0 + 0.14D0 * I
            XYZ(2,L) = -1.4D0 + 0.14D0 * J
            XYZ(3,L) = -1.4D0 + 0.14D0 * K
            VEL(1,L) = COS(XYZ(2,L))
            VEL(2,L) = XYZ(3,L)
            VEL(3,L) = 2D0
            W(L) = 1D0 + XYZ(1,L)**2
   10     CONTINUE
   20   CONTINUE
   30 CONTINUE
      CALL RIISF_VALVE_CREATE('trileaflet', VALVE, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_CREATE(VALVE, 0.3D0, 0.05D0, 1D0, AXIS, 0D0,
     &  ZERO, SURF, STAT)
      CALL OK(STAT)
      CALL RIISF_MESH_CREATE(NN, XYZ(1,1), XYZ(2,1), XYZ(3,1), 3, MESH,
     &  STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_WITH_FIELDS(SURF, MESH, RIIS_AUTO,
     &  RIIS_SEARCH_AUTO, 0, RIIS_FIELD_POINT + RIIS_FIELD_BARYCENTRIC,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_ADD_LEAFLET_REACTION(RES, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, ABOUT, 3, FW, MW, FL, ML, STAT)
      CALL OK(STAT)

C     The vertices of the surface.
      CALL RIISF_SURFACE_VERTICES(SURF, MV, N, V, STAT)
      CALL OK(STAT)
      DO 50 I = 1, N
        DO 40 J = 1, 3
          F(J,I) = 0D0
          F2(J,I) = 0D0
   40   CONTINUE
   50 CONTINUE
      CALL RIISF_ADD_VERTEX_REACTION(RES, SURF, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, 7, F, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_vertices is 7; the')
      CALL RIISF_ADD_VERTEX_REACTION(RES, SURF, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VEL, W, N, F, STAT)
      CALL OK(STAT)
      BIG = NN
      NL = N
      CALL RIISF_ADD_VERTEX_REACTION_64(RES, SURF, 3D0, RIIS_AUTO,
     &  RIIS_RIM_ROUND, BIG, VEL, W, NL, F2, STAT)
      CALL OK(STAT)
      DO 70 J = 1, 3
        SUM = -FW(J)
        ALL = 0D0
        DO 60 I = 1, N
          SUM = SUM + F(J,I)
          ALL = ALL + ABS(F(J,I))
          IF (ABS(F2(J,I) - F(J,I)) .GT. 0D0)
     &      CALL FAILED('the same forces at vertices')
   60   CONTINUE
        IF (ABS(SUM) .GT. 1D-11 * ALL .OR. .NOT. ALL .GT. 1D0)
     &    CALL FAILED('the force at vertices')
   70 CONTINUE

C     Eight nodes of tissue beside each edge of the attachment.
      CALL RIISF_SURFACE_ATTACHMENT(SURF, ME, NE, E, ID, STAT)
      CALL OK(STAT)
      NT = 8 * NE
      DO 90 I = 1, NT
        DO 80 J = 1, 3
          T(J,I) = E(J,1,1 + (I - 1) / 8) + 0.15D0 * COS(2D0 * J * I)
          A(J,I) = 0D0
          A2(J,I) = 0D0
   80   CONTINUE
        TW(I) = 1D0 + MOD(I, 3)
   90 CONTINUE
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
      BIG = NT
      NL = NE
      CALL RIISF_LOADS_SUMS_64(0.3D0, NL, E, ID, BIG, T, TW, INT(3, 8),
     &  SUMS2, STAT)
      CALL OK(STAT)
      CALL RIISF_LOADS_FORCES_64(0.3D0, NL, E, ID, BIG, T, TW,
     &  INT(3, 8), ABOUT, FL, ML, SUMS2, A2, STAT)
      CALL OK(STAT)
      IF (SUMS2(1,1) .LE. SUMS(1,1)) CALL FAILED('all edges hold it')
      DO 110 J = 1, 3
        SUM = -2D0 * FW(J)
        ALL = 0D0
        DO 100 I = 1, NT
          SUM = SUM + A(J,I) + A2(J,I)
          ALL = ALL + ABS(A(J,I)) + ABS(A2(J,I))
  100   CONTINUE
        IF (ABS(SUM) .GT. 1D-11 * ALL) CALL FAILED('the force there')
  110 CONTINUE
      CALL RIISF_MARKS_DESTROY(RES)
      CALL RIISF_MESH_DESTROY(MESH)
      CALL RIISF_SURFACE_DESTROY(SURF)
      CALL RIISF_VALVE_DESTROY(VALVE)
      PRINT *, 'all loads agree'
      END
