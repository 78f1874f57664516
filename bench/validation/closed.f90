! SPDX-License-Identifier: Apache-2.0
!> Computes rows of ./run validate with the solver of examples/flow_fortran: the drop of a plate that closes a duct, the leak of
!! the closed aortic valve, and the volume that a moving plate takes through a duct. It prints lines of words:
!!   drop   CELLS_OF_EPS DROP_OVER_R_EPS_U     plate in a duct: the mean over ten places of the plate between two faces
!!   spread CELLS_OF_EPS DIFFERENCE            the largest of these ten values minus the smallest
!!   leak   CELLS LEAK_OVER_IDEAL              aortic valve at 80 mmHg with eps = 1.5 h; the ideal leak is dp eps/R times the area
!!   moving CELLS VOLUME_OVER_AREA_STROKE      the mean of the volumes at inlet and outlet
!!   ends   CELLS DIFFERENCE_OVER_AREA_STROKE  the volume at the outlet minus the volume at the inlet
program closed
  use riis
  use flow_solver, only: dp, flow
  use flow_valve, only: leaflets, check
  use flow_root, only: in_root
  implicit none
  real(dp), parameter :: R = 1e4_dp
  integer :: i
  character(len=8) :: word
  logical :: short

  call get_command_argument(1, word)
  short = word == 'short'
  do i = 1, 3
    call closed_plate(real(i, dp))
  end do
  do i = 1, 3
    call moving_plate(8 * i / merge(2, 1, short))
  end do
  do i = 1, 3
    call leaking_valve(merge(16 + 8 * (i - 1), 24 + 12 * (i - 1), short))
  end do

contains

  pure logical function anywhere(x)
    real(dp), intent(in) :: x(3)
    anywhere = all(x > -huge(x))
  end function anywhere

  ! Puts a plate across the duct at height z. The plate moves up with the speed w.
  subroutine put_plate(fluid, z, eps, w)
    type(flow), intent(inout) :: fluid
    real(dp), intent(in) :: z, eps, w
    type(riis_surface) :: surface
    type(riis_mesh) :: faces
    type(riis_marks) :: marks
    real(dp) :: corners(3, 4), velocity(3, 4), side
    side = fluid%h * maxval(fluid%n)
    corners = reshape([-side, -side, z, 2 * side, -side, z, 2 * side, 2 * side, z, -side, 2 * side, z], [3, 4])
    velocity = 0
    velocity(3, :) = w
    call surface%create_from_arrays(corners, reshape([1, 2, 3, 4], [4, 1]), half_thickness=eps, velocity=velocity)
    call faces%create(fluid%xyz)
    call riis_mark_nodes(surface, faces, marks, fields=RIIS_FIELD_VELOCITY)
    fluid%K = 0
    fluid%K_u = 0
    call marks%add_resistance(R, fluid%K, fluid%K_u)
    call marks%destroy()
    call faces%destroy()
    call surface%destroy()
  end subroutine put_plate

  subroutine closed_plate(cells_of_eps)
    real(dp), intent(in) :: cells_of_eps
    real(dp), parameter :: h = 1e-3_dp, u = 0.1_dp
    type(flow) :: fluid
    real(dp) :: ratio(10), eps
    integer :: i
    eps = cells_of_eps * h
    do i = 1, 10
      fluid = flow()
      fluid%imposed_inlet = .true.
      call fluid%start([4, 4, 24], h, [0._dp, 0._dp, 0._dp], anywhere)
      fluid%v(fluid%face(1, :), 3) = merge(u, 0._dp, fluid%face(2, :) == 3)
      call put_plate(fluid, (12 + i / 10._dp) * h, eps, 0._dp)
      call fluid%step(1e-3_dp, u, 0._dp)
      ratio(i) = (fluid%mean_pressure(1.5_dp * h) - fluid%mean_pressure(22.5_dp * h)) / (R / eps * u)
      call fluid%equation%finish()
    end do
    print '(a, f6.2, f14.8)', 'drop', cells_of_eps, sum(ratio) / 10
    print '(a, f6.2, es14.5)', 'spread', cells_of_eps, maxval(ratio) - minval(ratio)
  end subroutine closed_plate

  ! Moves a plate by 10 mm in a duct with equal pressures at both ends. The duct is 8 mm by 8 mm by 32 mm, with n cells across.
  ! The half thickness eps is 1.5 mm.
  subroutine moving_plate(n)
    integer, intent(in) :: n
    real(dp), parameter :: dt = 1e-3_dp, w = 0.1_dp, side = 8e-3_dp
    type(flow) :: fluid
    real(dp) :: volume(2)
    integer :: i
    fluid = flow()
    call fluid%start([n, n, 4 * n], side / n, [0._dp, 0._dp, 0._dp], anywhere)
    volume = 0
    do i = 1, 100
      call put_plate(fluid, 0.01_dp + i * dt * w, 1.5e-3_dp, w)
      call fluid%step(dt, 0._dp, 0._dp)
      volume = volume + dt * [fluid%flow_in(), fluid%flow_out()]
    end do
    print '(a, i4, f14.8)', 'moving', n, sum(volume) / 2 / (side**2 * 100 * dt * w)
    print '(a, i4, es14.5)', 'ends', n, (volume(2) - volume(1)) / (side**2 * 100 * dt * w)
    call fluid%equation%finish()
  end subroutine moving_plate

  subroutine leaking_valve(cells)
    integer, intent(in) :: cells
    real(dp), parameter :: drop = 80 * 133.322_dp
    real(dp) :: eps
    type(flow), target :: fluid
    type(leaflets) :: valve
    type(riis_surface_info) :: info
    integer(riis_status) :: status
    integer :: i
    fluid = flow()
    call fluid%start([cells, cells, 6 * cells / 5], 0.033_dp / cells, [-0.0165_dp, -0.0165_dp, -0.018_dp], in_root)
    eps = 1.5_dp * fluid%h
    valve%eps = eps
    valve%R = R
    call valve%valve%create(valve%kind, status)
    call check(status)
    call valve%start(fluid, 0._dp)
    call valve%move(0._dp, 1e-3_dp, fluid)
    do i = 1, 20
      call fluid%step(fluid%time_step(1e-3_dp), 0._dp, drop)
    end do
    call valve%surface%get_info(info)
    print '(a, i4, f14.8)', 'leak', cells, -fluid%flow_out() / (drop * eps / R * info%area)
    call fluid%equation%finish()
    call valve%finish()
    deallocate (valve%marked)
  end subroutine leaking_valve
end program closed
