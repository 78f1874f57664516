C     SPDX-License-Identifier: Apache-2.0
C     A code in the style of Fortran 77 on the ranks of MPI. Each rank
C     has some planes of a structured grid, with its velocity in three
C     arrays. The aortic valve opens, and each rank gets K, K u_surface
C     and its share of the force on the valve. Rank 0 compares the sums
C     of all ranks with those of the whole grid. Lengths are in cm. USE
C     RIISF lets the compiler check all arguments. Without modules, omit
C     this line. The constants are in riisf.h.
C       mpifort mpi_fixed_form.f $(pkg-config --cflags --libs \
C         riis-fortran) && mpirun -n 4 ./a.out
      PROGRAM PLANES
      USE RIISF
      IMPLICIT NONE
      INCLUDE 'mpif.h'
      INCLUDE 'riisf.h'
      INTEGER N, NSUM
      PARAMETER (N = 27, NSUM = 8)
      DOUBLE PRECISION OPEN(1), DT, AXIS(3), SHIFT(3)
      DOUBLE PRECISION OWN(NSUM), ALL(NSUM), WHOLE(NSUM)
      INTEGER*8 VALVE, BEFORE, SURF
      INTEGER RANK, NRANKS, STEP, STAT, I, IERR
      LOGICAL SAME
      DATA VALVE, BEFORE, SURF /3*0/, DT /0.01D0/, OPEN /0D0/
      DATA AXIS /0D0, 0D0, 1D0/, SHIFT /3*0D0/, SAME /.TRUE./

      CALL MPI_INIT(IERR)
      CALL MPI_COMM_RANK(MPI_COMM_WORLD, RANK, IERR)
      CALL MPI_COMM_SIZE(MPI_COMM_WORLD, NRANKS, IERR)
C     The surface is small, so every rank makes its own copy. All copies
C     have the same bits.
      CALL RIISF_VALVE_CREATE('aortic', VALVE, STAT)
      CALL CHECK(STAT)
      CALL RIISF_VALVE_COPY(VALVE, BEFORE, STAT)
      CALL CHECK(STAT)
      CALL RIISF_SURFACE_CREATE(VALVE, RIIS_AUTO, 0.05D0, 1D0, AXIS,
     &  0D0, SHIFT, SURF, STAT)
      CALL CHECK(STAT)

      DO 20 STEP = 1, 3
        CALL RIISF_VALVE_SET(BEFORE, 'opening', 1, OPEN, STAT)
        CALL CHECK(STAT)
        OPEN(1) = OPEN(1) + 0.1D0
        CALL RIISF_VALVE_SET(VALVE, 'opening', 1, OPEN, STAT)
        CALL CHECK(STAT)
        CALL RIISF_SURFACE_UPDATE_MOVING(SURF, VALVE, BEFORE, DT, STAT)
        CALL CHECK(STAT)
        CALL SUMSOF(SURF, N * RANK / NRANKS + 1,
     &    N * (RANK + 1) / NRANKS, OWN)
        CALL MPI_REDUCE(OWN, ALL, NSUM, MPI_DOUBLE_PRECISION, MPI_SUM,
     &    0, MPI_COMM_WORLD, IERR)
        IF (RANK .EQ. 0) THEN
          CALL SUMSOF(SURF, 1, N, WHOLE)
          WRITE (*, '(A,I0,A,I0)') 'step ', STEP, ', marked nodes: ',
     &      NINT(WHOLE(1))
C         The order of a sum changes its last digits.
          DO 10 I = 1, NSUM
              SAME = SAME .AND. ABS(ALL(I) - WHOLE(I)) .LE.
     &        1D-12 * MAX(ABS(WHOLE(I)), ABS(WHOLE(8)))
   10     CONTINUE
        END IF
   20 CONTINUE
      IF (RANK .EQ. 0 .AND. SAME) WRITE (*, '(I0,A)') NRANKS,
     &  ' ranks: the same sums as the whole grid'
      IF (.NOT. SAME) CALL MPI_ABORT(MPI_COMM_WORLD, 1, IERR)

      CALL RIISF_SURFACE_DESTROY(SURF)
      CALL RIISF_VALVE_DESTROY(BEFORE)
      CALL RIISF_VALVE_DESTROY(VALVE)
      CALL MPI_FINALIZE(IERR)
      END

C     Marks the planes FIRST to LAST of the grid. Gives the number of
C     marked nodes, the sums of K and K u_surface, and the force.
      SUBROUTINE SUMSOF(SURF, FIRST, LAST, SUMS)
      USE RIISF
      IMPLICIT NONE
      INCLUDE 'riisf.h'
      INTEGER N, FIRST, LAST, NK, NN, NMARKD, STAT, I, J, K
      PARAMETER (N = 27)
      INTEGER NODE(N**3)
      DOUBLE PRECISION AXIS(N), DIST(N**3), SUMS(8)
      DOUBLE PRECISION VX(N,N,N), VY(N,N,N), VZ(N,N,N), VOL(N,N,N)
      DOUBLE PRECISION RK(N,N,N), RKUX(N,N,N), RKUY(N,N,N), RKUZ(N,N,N)
      INTEGER*8 SURF, MESH, MARKS
      COMMON /FIELDS/ VX, VY, VZ, VOL, RK, RKUX, RKUY, RKUZ, DIST, NODE
      SAVE MARKS
      DATA MARKS /0/
      DO 10 I = 1, 8
        SUMS(I) = 0D0
   10 CONTINUE
      NK = LAST - FIRST + 1
C     A rank without nodes has nothing to mark.
      IF (NK .EQ. 0) RETURN
      NN = N * N * NK
      DO 40 K = 1, NK
        DO 30 J = 1, N
          DO 20 I = 1, N
            VX(I,J,K) = 0D0
            VY(I,J,K) = 0D0
            VZ(I,J,K) = 10D0
            VOL(I,J,K) = 0.125D0**3
            RK(I,J,K) = 0D0
            RKUX(I,J,K) = 0D0
            RKUY(I,J,K) = 0D0
            RKUZ(I,J,K) = 0D0
   20     CONTINUE
   30   CONTINUE
   40 CONTINUE
      DO 50 I = 1, N
        AXIS(I) = -1.625D0 + 0.125D0 * (I - 1)
   50 CONTINUE

C     The mesh of a grid keeps nothing for each node. A code whose nodes
C     move calls RIISF_MESH_CREATE and RIISF_MESH_UPDATE.
      MESH = 0
      CALL RIISF_MESH_CREATE_GRID(N, N, NK, AXIS, AXIS, AXIS(FIRST), 64,
     &  1, 0, 0, 0, NN, MESH, STAT)
      CALL CHECK(STAT)
C     If every core has a rank, each rank should use one thread.
      CALL RIISF_MARK_WITH_FIELDS(SURF, MESH, RIIS_AUTO,
     &  RIIS_SEARCH_AUTO, 1, RIIS_FIELD_VELOCITY, MARKS, STAT)
      CALL CHECK(STAT)
      CALL RIISF_MARKED(MARKS, NN, NMARKD, NODE, DIST, STAT)
      CALL CHECK(STAT)
      CALL RIISF_ADD_RESISTANCE_COMPONENTS(MARKS, 1D4, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, RK, RKUX, RKUY, RKUZ, STAT)
      CALL CHECK(STAT)
C     A flow solver now makes its step, with RK * V - RKU on the left.
C     Then the force uses the new velocity.
      CALL RIISF_ADD_REACTION_COMPONENTS(MARKS, 1D4, RIIS_AUTO,
     &  RIIS_RIM_ROUND, NN, VX, VY, VZ, VOL, SUMS(6), STAT)
      CALL CHECK(STAT)
      SUMS(1) = NMARKD
      DO 80 K = 1, NK
        DO 70 J = 1, N
          DO 60 I = 1, N
            SUMS(2) = SUMS(2) + RK(I,J,K)
            SUMS(3) = SUMS(3) + RKUX(I,J,K)
            SUMS(4) = SUMS(4) + RKUY(I,J,K)
            SUMS(5) = SUMS(5) + RKUZ(I,J,K)
   60     CONTINUE
   70   CONTINUE
   80 CONTINUE
      CALL RIISF_MESH_DESTROY(MESH)
      END

C     Stops all ranks after an error.
      SUBROUTINE CHECK(STAT)
      USE RIISF
      IMPLICIT NONE
      INCLUDE 'mpif.h'
      INTEGER STAT, IERR
      CHARACTER*512 TEXT
      IF (STAT .EQ. 0) RETURN
      CALL RIISF_LAST_ERROR(TEXT)
      WRITE (*, '(A)') TEXT
      CALL MPI_ABORT(MPI_COMM_WORLD, 1, IERR)
      END
