! SPDX-License-Identifier: Apache-2.0
! c_twin.h for the Fortran tests.
module c_twin
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t, c_ptr
  use riis_c
  implicit none
  private
  public :: twin_surface, twin_walk, twin_leaks, twin_motion, twin_laws, twin_numbers, twin_run, twin_end, &
    twin_auto, twin_far_distance

  type, bind(c) :: twin_surface
    type(riis_surface_info) :: info
    type(riis_triangles) :: triangles
  end type twin_surface

  type, bind(c) :: twin_walk
    type(riis_csr) :: csr
    type(riis_mark_stats) :: stats
  end type twin_walk

  type, bind(c) :: twin_leaks
    type(riis_leak_list) :: list
    type(c_ptr) :: label
    integer(c_int64_t) :: n_regions
    type(riis_passage) :: passage
  end type twin_leaks

  type, bind(c) :: twin_motion
    type(twin_surface) :: surface
    type(riis_direction) :: direction
    type(riis_mark_list) :: marked, within_limit
    type(c_ptr) :: coefficient, momentum
    real(c_double) :: force(30)
    type(riis_band_sums) :: sums
    type(twin_surface) :: framed
  end type twin_motion

  type, bind(c) :: twin_laws
    real(c_double) :: by_table(2), by_times(2)
    type(riis_opening_switch_state) :: by_switch
    type(riis_opening_angle_state) :: by_angle
  end type twin_laws

  type, bind(c) :: twin_numbers
    integer(c_int64_t) :: n_parameters
    type(c_ptr) :: parameters
    type(twin_surface) :: aortic, mitral, opening, patches
    type(riis_closest) :: closest
    type(riis_closest_arrays) :: all
    type(riis_mark_list) :: marked, within_limit
    type(c_ptr) :: dense_mark, dense_distance, dense_triangle_id, dense_leaflet_id
    type(riis_mark_stats) :: stats
    type(twin_walk) :: cells, faces, grid
    type(riis_mark_stats) :: paper
    type(twin_leaks) :: leaks
    type(riis_crossing_list) :: crossings
    type(twin_motion) :: motion
    type(twin_laws) :: laws
  end type twin_numbers

  interface
    function twin_run(per_side, xyz, numbers) result(status) bind(c, name='twin_run')
      import :: c_int64_t, c_ptr, riis_status, twin_numbers
      implicit none
      integer(c_int64_t), value :: per_side
      type(c_ptr), value :: xyz
      type(twin_numbers), intent(out) :: numbers
      integer(riis_status) :: status
    end function twin_run

    subroutine twin_end() bind(c, name='twin_end')
    end subroutine twin_end

    function twin_auto() result(value) bind(c, name='twin_auto')
      import :: c_double
      implicit none
      real(c_double) :: value
    end function twin_auto

    function twin_far_distance() result(value) bind(c, name='twin_far_distance')
      import :: c_double
      implicit none
      real(c_double) :: value
    end function twin_far_distance
  end interface
end module c_twin
