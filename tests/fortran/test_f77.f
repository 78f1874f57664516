C     SPDX-License-Identifier: Apache-2.0
C     The external subroutines, as a Fortran 77 code calls them: fixed
C     form, implicit interfaces, include file. A box of nodes around the
C     valve is marked in several ways; all have to agree.
      PROGRAM TF77
      IMPLICIT NONE
      INCLUDE 'riisf.h'
      INTEGER M, NN, NC
      PARAMETER (M = 21, NN = M**3, NC = (M - 1)**3)
      DOUBLE PRECISION XYZ(3,NN), X(NN), Y(NN), Z(NN)
      COMMON /NODES/ XYZ, X, Y, Z
      INTEGER*8 VALVE, OPENED, SURF, MESH, MESH2, RES, ADJ
      DATA VALVE, OPENED, SURF, MESH, MESH2, RES, ADJ /7*0/
      DOUBLE PRECISION AXIS(3), SHIFT(3), ZERO(3), VALUES(3)
      DATA AXIS /0D0, 0D0, 1D0/, SHIFT /5D0, 0D0, 0D0/, ZERO /3*0D0/
      INTEGER STAT, N, N2, I, J, K, L
      INTEGER*8 NL, BIG
      INTEGER NODE(NN), NODE2(NN), MARK(NN), LEAF(NN)
      INTEGER*8 NODEL(NN), TRI(NN)
      DOUBLE PRECISION DIST(NN), DIST2(NN)
      INTEGER CELLS(8,NC), OFFS(NC+1), ROWS(NN+1), COLS(6*NN)
      INTEGER*8 CELLSL(8,NC), OFFSL(NC+1), ROWSL(NN+1), COLSL(6*NN)
      INTEGER FACES(2,3*NN)
      INTEGER*8 FACESL(2,3*NN)
      COMMON /CELLSC/ CELLSL, OFFSL, ROWSL, COLSL, FACESL,
     &  CELLS, OFFS, ROWS, COLS, FACES
      INTEGER NFACES
      CHARACTER*512 TEXT
      CHARACTER*24 NAME

      L = 0
      DO 30 K = 0, M - 1
        DO 20 J = 0, M - 1
          DO 10 I = 0, M - 1
            L = L + 1
            X(L) = -1.4D0 + 0.14D0 * I
            Y(L) = -1.4D0 + 0.14D0 * J
            Z(L) = -1.4D0 + 0.14D0 * K
            XYZ(1,L) = X(L)
            XYZ(2,L) = Y(L)
            XYZ(3,L) = Z(L)
   10     CONTINUE
   20   CONTINUE
   30 CONTINUE
      CALL ROWSOF(M, ROWS, COLS, CELLS, FACES, NFACES)

C     Texts.
      CALL RIISF_VERSION(TEXT)
      IF (INDEX(TEXT, '.') .EQ. 0) CALL FAILED('the version')
      CALL RIISF_VALVE_CREATE('tricuspid', VALVE, STAT)
      CALL WANT(STAT, RIIS_INVALID_PARAMETER, 'tricuspid')
      IF (VALVE .NE. 0) CALL FAILED('a refused valve')
      CALL RIISF_STATUS_NAME(STAT, NAME)
      IF (NAME .NE. 'RIIS_INVALID_PARAMETER') CALL FAILED('its name')

C     The valve.
      CALL RIISF_VALVE_CREATE('aortic  ', VALVE, STAT)
      CALL OK(STAT)
      VALUES(1) = 21.5D0
      CALL RIISF_VALVE_SET(VALVE, 'leaflet_angle  ', 1, VALUES, STAT)
      CALL OK(STAT)
      VALUES(1) = 0D0
      CALL RIISF_VALVE_GET(VALVE, 'left.leaflet_angle', 1, VALUES, STAT)
      CALL OK(STAT)
      IF (ABS(VALUES(1) - 21.5D0) .GT. 0D0) CALL FAILED('the value')
      CALL RIISF_VALVE_SET(VALVE, 'right.rotation', 2, ZERO, STAT)
      CALL WANT(STAT, RIIS_INVALID_PARAMETER, 'right.rotation')
      CALL RIISF_VALVE_CREATE('aortic', OPENED, STAT)
      CALL OK(STAT)
      VALUES(1) = 4D1
      CALL RIISF_VALVE_SET(OPENED, 'leaflet_angle', 1, VALUES, STAT)
      CALL OK(STAT)
      CALL RIISF_VALVE_SET_OPEN_STATE(VALVE, OPENED, STAT)
      CALL OK(STAT)
      CALL RIISF_VALVE_DESTROY(OPENED)
      IF (OPENED .NE. 0) CALL FAILED('a destroyed valve')
      CALL RIISF_VALVE_DESTROY(OPENED)
      CALL RIISF_VALVE_SET_OPEN_STATE(VALVE, OPENED, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'open is NULL')

C     The surface, away and back.
      CALL RIISF_SURFACE_CREATE(VALVE, 0.12D0, 0.05D0, 1D0, AXIS, 0D0,
     &  SHIFT, SURF, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_CREATE(VALVE, 0.12D0, 7D0, 1D0, AXIS, 0D0,
     &  SHIFT, SURF, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'tolerance is 7')
      CALL RIISF_MESH_CREATE(NN, X, Y, Z, 1, MESH, STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_AUTO, 0,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_MARKED(RES, NN, N, NODE, DIST, STAT)
      CALL OK(STAT)
      IF (N .NE. 0) CALL FAILED('nothing is marked by a valve far away')
      CALL RIISF_SURFACE_PLACE(SURF, VALVE, 0.12D0, 0.05D0, 1D0, AXIS,
     &  0D0, ZERO, STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_AUTO, 2,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_MARKED(RES, NN, N, NODE, DIST, STAT)
      CALL OK(STAT)
      IF (N .LT. 100 .OR. 2 * N .GT. NN) CALL FAILED('some are marked')

C     Arrays that are too short, and those of the other kind.
      N2 = 0
      CALL RIISF_MARKED(RES, N - 1, N2, NODE2, DIST2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'length is')
      IF (N2 .NE. N) CALL FAILED('how long they have to be')
      BIG = NN
      NL = 0
      CALL RIISF_MARKED_64(RES, BIG, NL, NODEL, DIST2, STAT)
      CALL OK(STAT)
      IF (NL .NE. N) CALL FAILED('as many')
      DO 40 I = 1, N
        IF (NODEL(I) .NE. NODE(I)) CALL FAILED('the same nodes')
        IF (ABS(DIST2(I) - DIST(I)) .GT. 0D0) CALL FAILED('distances')
   40 CONTINUE

C     Dense arrays.
      CALL RIISF_DENSE_MARK(RES, NN, MARK, STAT)
      CALL OK(STAT)
      CALL RIISF_DENSE_DISTANCE(RES, NN, RIIS_FAR_DISTANCE, DIST2, STAT)
      CALL OK(STAT)
      CALL RIISF_DENSE_TRIANGLE(RES, NN, TRI, STAT)
      CALL OK(STAT)
      CALL RIISF_DENSE_LEAFLET(RES, NN, LEAF, STAT)
      CALL OK(STAT)
      J = 1
      DO 50 I = 1, NN
        IF (J .LE. N .AND. I .EQ. NODE(MIN(J, N))) THEN
          IF (MARK(I) .NE. 1 .OR. TRI(I) .LT. 0 .OR. LEAF(I) .LT. 0)
     &      CALL FAILED('a marked node')
          IF (ABS(DIST2(I) - DIST(J)) .GT. 0D0) CALL FAILED('distance')
          J = J + 1
        ELSE
          IF (MARK(I) .NE. 0 .OR. TRI(I) .NE. -1 .OR. LEAF(I) .NE. -1
     &      .OR. DIST2(I) .LT. RIIS_FAR_DISTANCE) CALL FAILED('another')
        END IF
   50 CONTINUE
      CALL RIISF_DENSE_MARK(RES, NN - 1, MARK, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_nodes')
      CALL RIISF_DENSE_DISTANCE(RES, NN, 0.1D0, DIST2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'far_distance')

C     A wider limit.
      CALL RIISF_MARK_NODES(SURF, MESH, 0.3D0, RIIS_SEARCH_EXHAUSTIVE,
     &  1, RES, STAT)
      CALL OK(STAT)
      CALL RIISF_WITHIN_LIMIT(RES, NN, N2, NODE2, DIST2, STAT)
      CALL OK(STAT)
      IF (N2 .LE. N) CALL FAILED('more within the limit')
      CALL RIISF_WITHIN_LIMIT_64(RES, BIG, NL, NODEL, DIST2, STAT)
      CALL OK(STAT)
      IF (NL .NE. N2 .OR. NODEL(1) .NE. NODE2(1)) CALL FAILED('as many')
      CALL RIISF_WITHIN_LIMIT_64(RES, BIG - NN, NL, NODEL, DIST2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'length is 0')
      CALL RIISF_WITHIN_LIMIT(RES, 5, N2, NODE2, DIST2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'length is 5')

C     Distances by sampling: nearly the same nodes, no triangles.
      CALL RIISF_SURFACE_MEASURE(SURF, VALVE, 0.12D0, 0.05D0, 1D0, AXIS,
     &  0D0, ZERO, RIIS_DISTANCE_SAMPLING, 0.1D0, STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_AUTO, 2,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_MARKED(RES, NN, N2, NODE2, DIST2, STAT)
      CALL OK(STAT)
      IF (N2 .EQ. 0 .OR. 10 * ABS(N2 - N) .GT. N) CALL FAILED('samples')
      CALL RIISF_DENSE_TRIANGLE(RES, NN, TRI, STAT)
      CALL OK(STAT)
      IF (TRI(NODE2(1)) .NE. -1) CALL FAILED('a triangle of samples')
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_CLUSTERS,
     &  2, RES, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'by sampling')
      CALL RIISF_SURFACE_MEASURE(SURF, VALVE, 0.12D0, 0.05D0, 1D0, AXIS,
     &  0D0, ZERO, RIIS_DISTANCE_MINIMIZATION, 7D0, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'distance_tolerance is 7')
      CALL RIISF_SURFACE_PLACE(SURF, VALVE, 0.12D0, 0.05D0, 1D0, AXIS,
     &  0D0, ZERO, STAT)
      CALL OK(STAT)

C     Other meshes; a node that moves in place.
      CALL RIISF_MESH_CREATE_64(BIG, XYZ(1,1), XYZ(2,1), XYZ(3,1),
     &  3_8, MESH2, STAT)
      CALL OK(STAT)
      CALL SAME(SURF, MESH2, RIIS_SEARCH_AUTO, N, NODE)
      CALL RIISF_MESH_UPDATE_64(MESH2, BIG, X, Y, Z, 1_8, STAT)
      CALL OK(STAT)
      CALL RIISF_MESH_PREPARE(MESH2, 2, STAT)
      CALL OK(STAT)
      CALL SAME(SURF, MESH2, RIIS_SEARCH_CLUSTERS, N, NODE)
      XYZ(1,1) = X(NODE(1))
      XYZ(2,1) = Y(NODE(1))
      XYZ(3,1) = Z(NODE(1))
      CALL RIISF_MESH_UPDATE(MESH2, NN, XYZ(1,1), XYZ(2,1), XYZ(3,1), 3,
     &  STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_NODES(SURF, MESH2, RIIS_AUTO, RIIS_SEARCH_AUTO, 1,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_MARKED(RES, NN, N2, NODE2, DIST2, STAT)
      CALL OK(STAT)
      IF (N2 .NE. N + 1 .OR. NODE2(1) .NE. 1) CALL FAILED('in place')
      CALL RIISF_MESH_DESTROY(MESH2)
      CALL RIISF_MESH_CREATE(0, X, Y, Z, 1, MESH2, STAT)
      CALL WANT(STAT, RIIS_INVALID_MESH, 'n_nodes is 0')

C     Rows of one's own.
      CALL RIISF_MESH_SET_ADJACENCY(MESH, NN, ROWS, COLS, 1, 0, STAT)
      CALL OK(STAT)
      CALL SAME(SURF, MESH, RIIS_SEARCH_NEIGHBOR, N, NODE)
      DO 60 I = 1, NN + 1
        ROWSL(I) = ROWS(I) - 1
   60 CONTINUE
      DO 70 I = 1, ROWS(NN + 1) - 1
        COLSL(I) = COLS(I) - 1
   70 CONTINUE
      CALL RIISF_MESH_SET_ADJACENCY_64(MESH, BIG, ROWSL, COLSL, 0, BIG,
     &  STAT)
      CALL OK(STAT)
      CALL SAME(SURF, MESH, RIIS_SEARCH_NEIGHBOR, N, NODE)
      CALL RIISF_MESH_SET_ADJACENCY(MESH, NN - 1, ROWS, COLS, 1, 0,
     &  STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'n_rows')
      CALL RIISF_MESH_CLEAR_ADJACENCY(MESH, STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_NEIGHBOR,
     &  1, RES, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'adjacency')

C     Those that the library makes.
      DO 90 I = 1, NC
        OFFS(I) = 8 * I - 7
        OFFSL(I) = OFFS(I)
        DO 80 J = 1, 8
          CELLSL(J,I) = CELLS(J,I)
   80   CONTINUE
   90 CONTINUE
      OFFS(NC + 1) = 8 * NC + 1
      OFFSL(NC + 1) = OFFS(NC + 1)
      DO 100 I = 1, NFACES
        FACESL(1,I) = FACES(1,I)
        FACESL(2,I) = FACES(2,I)
  100 CONTINUE
      CALL RIISF_ADJACENCY_FROM_CELLS(NN, 8, NC, CELLS, 1, 0, ADJ, STAT)
      CALL USE(STAT, SURF, MESH, ADJ, N, NODE)
      CALL RIISF_ADJACENCY_FROM_CELLS_64(BIG, 8, INT(NC, 8), CELLSL, 1,
     &  2, ADJ, STAT)
      CALL USE(STAT, SURF, MESH, ADJ, N, NODE)
      CALL RIISF_ADJACENCY_FROM_MIXED(NN, NC, CELLS, OFFS, 1, 1, ADJ,
     &  STAT)
      CALL USE(STAT, SURF, MESH, ADJ, N, NODE)
      CALL RIISF_ADJACENCY_FROM_MIXED_64(BIG, INT(NC, 8), CELLSL, OFFSL,
     &  1, 1, ADJ, STAT)
      CALL USE(STAT, SURF, MESH, ADJ, N, NODE)
      CALL RIISF_ADJACENCY_FROM_FACES(NN, NFACES, FACES, 1, 1, ADJ,
     &  STAT)
      CALL USE(STAT, SURF, MESH, ADJ, N, NODE)
      CALL RIISF_ADJACENCY_FROM_FACES_64(BIG, INT(NFACES, 8), FACESL, 1,
     &  1, ADJ, STAT)
      CALL USE(STAT, SURF, MESH, ADJ, N, NODE)
      CALL RIISF_ADJACENCY_FROM_GRID(M, M, M, 1, ADJ, STAT)
      CALL USE(STAT, SURF, MESH, ADJ, N, NODE)
      CALL RIISF_ADJACENCY_FROM_CELLS(NN, 3, NC, CELLS, 1, 0, ADJ, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'nodes_per_cell is 3')
      CALL RIISF_MESH_USE_ADJACENCY(MESH, ADJ, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'adjacency is NULL')

C     Leaks.
      CALL RIISF_ADJACENCY_FROM_GRID(M, M, M, 1, ADJ, STAT)
      CALL OK(STAT)
      CALL LEAKS(VALVE, MESH, ADJ)
      CALL RIISF_ADJACENCY_DESTROY(ADJ)

C     The valve moves, and all goes.
      VALUES(1) = 1D0
      CALL RIISF_VALVE_SET(VALVE, 'opening', 1, VALUES, STAT)
      CALL OK(STAT)
      CALL RIISF_SURFACE_UPDATE(SURF, VALVE, STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_AUTO, 1,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_MARKED(RES, NN, N2, NODE2, DIST2, STAT)
      CALL OK(STAT)
      IF (N2 .EQ. N .OR. N2 .LT. 100) CALL FAILED('an open valve')
      CALL RIISF_MARK_RESULT_DESTROY(RES)
      CALL RIISF_MESH_DESTROY(MESH)
      CALL RIISF_SURFACE_DESTROY(SURF)
      CALL RIISF_VALVE_DESTROY(VALVE)
      IF (RES .NE. 0 .OR. MESH .NE. 0 .OR. SURF .NE. 0) CALL
     &  FAILED('what is destroyed is 0')
      CALL RIISF_MARKED(RES, NN, N2, NODE2, DIST2, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'result is NULL')
      PRINT *, N, ' nodes marked'
      END

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

C     The search has to mark these nodes.
      SUBROUTINE SAME(SURF, MESH, SEARCH, N, NODE)
      INTEGER*8 SURF, MESH, RES
      INTEGER SEARCH, N, NODE(N), N2, I, STAT
      INTEGER NODE2(9261)
      DOUBLE PRECISION DIST2(9261)
      SAVE NODE2, DIST2
      INCLUDE 'riisf.h'
      RES = 0
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, SEARCH, 1, RES, STAT)
      CALL OK(STAT)
      CALL RIISF_MARKED(RES, 9261, N2, NODE2, DIST2, STAT)
      CALL OK(STAT)
      IF (N2 .NE. N) CALL FAILED('as many nodes')
      DO 10 I = 1, N
        IF (NODE2(I) .NE. NODE(I)) CALL FAILED('the same nodes')
   10 CONTINUE
      CALL RIISF_MARK_RESULT_DESTROY(RES)
      END

C     Marks with an adjacency, then destroys it.
      SUBROUTINE USE(STAT, SURF, MESH, ADJ, N, NODE)
      INTEGER STAT, N, NODE(N)
      INTEGER*8 SURF, MESH, ADJ
      INCLUDE 'riisf.h'
      CALL OK(STAT)
      CALL RIISF_MESH_USE_ADJACENCY(MESH, ADJ, STAT)
      CALL OK(STAT)
      CALL SAME(SURF, MESH, RIIS_SEARCH_NEIGHBOR, N, NODE)
      CALL RIISF_MESH_CLEAR_ADJACENCY(MESH, STAT)
      CALL OK(STAT)
      CALL RIISF_ADJACENCY_DESTROY(ADJ)
      IF (ADJ .NE. 0) CALL FAILED('a destroyed adjacency')
      END

C     A thin valve, and edges that cross it between unmarked nodes.
      SUBROUTINE LEAKS(VALVE, MESH, ADJ)
      INTEGER*8 VALVE, MESH, ADJ, SURF, RES, NEDGES, N3, EDGE3(2,5000)
      INTEGER STAT, N, I, EDGE(2,5000)
      DOUBLE PRECISION LONG, MIDDLE(3), CLOSED, AXIS(3), ZERO(3)
      DATA AXIS /0D0, 0D0, 1D0/, ZERO /3*0D0/
      SAVE EDGE, EDGE3
      INCLUDE 'riisf.h'
      SURF = 0
      RES = 0
      CALL RIISF_SURFACE_CREATE(VALVE, 0.02D0, 0.05D0, 1D0, AXIS, 0D0,
     &  ZERO, SURF, STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_NODES(SURF, MESH, RIIS_AUTO, RIIS_SEARCH_AUTO, 1,
     &  RES, STAT)
      CALL OK(STAT)
      CALL RIISF_FIND_LEAKS(SURF, MESH, 1, RES, NEDGES, LONG, MIDDLE,
     &  CLOSED, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'mesh has no adjacency')
      CALL RIISF_MESH_USE_ADJACENCY(MESH, ADJ, STAT)
      CALL OK(STAT)
      CALL RIISF_FIND_LEAKS(SURF, MESH, 1, RES, NEDGES, LONG, MIDDLE,
     &  CLOSED, STAT)
      CALL OK(STAT)
      IF (NEDGES .LT. 10 .OR. LONG .LT. 0.139D0 .OR. CLOSED .LE. 0.02D0
     &  .OR. ABS(MIDDLE(3)) .GT. 1.4D0) CALL FAILED('leaks')
      N = 0
      CALL RIISF_LEAKING_EDGES(RES, 5, N, EDGE, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'edges that leak: ')
      IF (N .NE. NEDGES) CALL FAILED('the number of leaks')
      CALL RIISF_LEAKING_EDGES(RES, 5000, N, EDGE, STAT)
      CALL OK(STAT)
      CALL RIISF_LEAKING_EDGES_64(RES, INT(5, 8), N3, EDGE3, STAT)
      CALL WANT(STAT, RIIS_INVALID_ARGUMENT, 'edges that leak: ')
      CALL RIISF_LEAKING_EDGES_64(RES, INT(5000, 8), N3, EDGE3, STAT)
      CALL OK(STAT)
      IF (N .NE. NEDGES .OR. N3 .NE. N) CALL FAILED('as many leaks')
      DO 10 I = 1, N
        IF (EDGE(1,I) .LT. 1 .OR. EDGE(1,I) .GE. EDGE(2,I))
     &    CALL FAILED('the nodes of an edge')
        IF (EDGE3(1,I) .NE. EDGE(1,I) .OR. EDGE3(2,I) .NE. EDGE(2,I))
     &    CALL FAILED('the same edges')
   10 CONTINUE
      CALL RIISF_MESH_CLEAR_ADJACENCY(MESH, STAT)
      CALL OK(STAT)
      CALL RIISF_MARK_RESULT_DESTROY(RES)
      CALL RIISF_SURFACE_DESTROY(SURF)
      END

C     The rows, cells and faces between neighbours of a box of M**3
C     nodes, counted from 1.
      SUBROUTINE ROWSOF(M, ROWS, COLS, CELLS, FACES, NFACES)
      INTEGER M, ROWS(*), COLS(*), CELLS(8,*), FACES(2,*), NFACES
      INTEGER I, J, K, L, N, C
      L = 0
      N = 0
      C = 0
      NFACES = 0
      DO 30 K = 1, M
        DO 20 J = 1, M
          DO 10 I = 1, M
            L = L + 1
            ROWS(L) = N + 1
            IF (K .GT. 1) CALL ADD(N, COLS, L - M * M)
            IF (J .GT. 1) CALL ADD(N, COLS, L - M)
            IF (I .GT. 1) CALL ADD(N, COLS, L - 1)
            IF (I .LT. M) CALL ADD(N, COLS, L + 1)
            IF (J .LT. M) CALL ADD(N, COLS, L + M)
            IF (K .LT. M) CALL ADD(N, COLS, L + M * M)
            IF (I .LT. M) CALL ADDFAC(NFACES, FACES, L, L + 1)
            IF (J .LT. M) CALL ADDFAC(NFACES, FACES, L, L + M)
            IF (K .LT. M) CALL ADDFAC(NFACES, FACES, L, L + M * M)
            IF (I .LT. M .AND. J .LT. M .AND. K .LT. M) THEN
              C = C + 1
              CELLS(1,C) = L
              CELLS(2,C) = L + 1
              CELLS(3,C) = L + M + 1
              CELLS(4,C) = L + M
              CELLS(5,C) = L + M * M
              CELLS(6,C) = L + M * M + 1
              CELLS(7,C) = L + M * M + M + 1
              CELLS(8,C) = L + M * M + M
            END IF
   10     CONTINUE
   20   CONTINUE
   30 CONTINUE
      ROWS(L + 1) = N + 1
      END

      SUBROUTINE ADD(N, COLS, COL)
      INTEGER N, COLS(*), COL
      N = N + 1
      COLS(N) = COL
      END

      SUBROUTINE ADDFAC(N, FACES, A, B)
      INTEGER N, FACES(2,*), A, B
      N = N + 1
      FACES(1,N) = A
      FACES(2,N) = B
      END
