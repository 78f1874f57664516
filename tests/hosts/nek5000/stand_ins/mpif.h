! SPDX-License-Identifier: Apache-2.0
! Stands in for mpif.h.
      integer mpi_comm_world
      parameter (mpi_comm_world=0)
