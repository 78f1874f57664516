! SPDX-License-Identifier: Apache-2.0
! test_cans SUBJECT
! Tests the user files of examples/cans with stand-ins for CaNS. Marks and K of the three grids are compared with a loop over all
! triangles. The drop of a closed plate is tested with each way to compute the pressure. The memory of riis is also measured.
program test_cans
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: error_unit, int64
  use mod_types
  use mod_param
  use mod_bound
  use mod_correc
  use mod_fillps
  use mod_solver
  use mod_riis_valve
  use riis
  use brute
  implicit none
  real(rp), parameter :: eps = 0.125_rp, pi = acos(-1._rp) ! 1.5 cells
  character(len=16) :: subject
  integer :: failed = 0
  call get_command_argument(1, subject)
  select case (subject)
  case ('marks')
    call test_marks("'plate', place = 0.9, 0.5, 0.5, angle = 110", .false.)
  case ('opening')
    call test_marks("'trileaflet', place = 1.2, 0.5, 0.5, opens_at = 0, opens_in = 0.04", .true.)
  case ('predictor')
    call test_drop('jump = F', 0.02_rp, 0.2_rp)
  case ('jump')
    call test_drop('jump = T', 0.98_rp, 1.02_rp)
  case ('sweeps')
    call test_drop('jump = T, sweeps = 3', 0.98_rp, 1.02_rp)
  case ('gradients')
    call test_drop('jump = F, cg = 20', 0.98_rp, 1.02_rp)
  case ('memory')
    call test_memory
  case default
    error stop 'unknown subject'
  end select
  if (failed > 0) error stop 'failed'
  print '(2a)', trim(subject), ': fine'

contains

  subroutine check(holds, text)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: text
    if (holds) return
    failed = failed + 1
    if (failed < 10) write (error_unit, '(a)') text
  end subroutine check

  subroutine write_input(valve, pressure)
    character(len=*), intent(in) :: valve, pressure
    integer :: unit
    open (newunit=unit, file='riis.nml', action='write', status='replace')
    write (unit, '(3a, es22.15, a)') '&valve kind = ', valve, ', R = 2000., half_thickness = ', eps, ' /'
    write (unit, '(3a)') '&pressure ', pressure, ' /'
    close (unit)
  end subroutine write_input

  ! The rank has the cells from 3 on in x. Other ranks lie below and above in x. The grid is stretched in z.
  subroutine test_marks(valve, moves)
    character(len=*), intent(in) :: valve
    logical, intent(in) :: moves
    integer, parameter :: n(3) = [19, 12, 12], lo(3) = [3, 1, 1]
    real(rp) :: zc(0:13), zf(0:13), x(0:20, 0:13, 0:13), y(0:20, 0:13, 0:13), z(0:20, 0:13, 0:13), distance(0:20, 0:13, 0:13), K
    logical :: wanted(0:20, 0:13, 0:13)
    type(riis_mark_list) :: lists(3)
    integer(int64), parameter :: m = size(x, kind=int64)
    integer :: c, i, j, l, at, found
    is_bound(:, 1) = .false.
    call write_input(valve, 'jump = F')
    zf = [(l + 0.02_rp * sin(0.7_rp * l), l=0, 13)] / 12
    zc(1:) = (zf(1:) + zf(:12)) / 2
    zc(0) = 2 * zf(0) - zc(1)
    call riis_valve_start(n, lo, zc, zf)
    call riis_valve_mark(0.015_rp, 0.001_rp)
    call riis_valve_lists(lists)
    found = 0
    do c = 1, 3
      do i = 0, 20
        x(i, :, :) = (i + 2 - merge(0._rp, 0.5_rp, c == 1)) / 12
      end do
      do j = 0, 13
        y(:, j, :) = (j - merge(0._rp, 0.5_rp, c == 2)) / 12
      end do
      do l = 0, 13
        z(:, :, l) = merge(zf(l), zc(l), c == 3)
      end do
      call brute_distances(surface%c_handle(), m, x, y, z, 1_int64, 2 * eps, distance)
      ! Counts the faces of this rank, and the faces of the rank below that its cells use. Faces on walls do not count.
      wanted = .false.
      wanted(merge(0, 1, c == 1):19, 1:merge(11, 12, c == 2), 1:merge(11, 12, c == 3)) = .true.
      wanted = wanted .and. distance <= eps
      call check(lists(c)%n_nodes == count(wanted), 'another number of faces is marked')
      do at = 1, int(lists(c)%n_nodes)
        l = int(lists(c)%node_id(at) / (21 * 14))
        j = int(mod(lists(c)%node_id(at) / 21, 14_int64))
        i = int(mod(lists(c)%node_id(at), 21_int64))
        call check(wanted(i, j, l), 'a face is marked that is not near the surface')
        call check(abs(lists(c)%distance(at) - distance(i, j, l)) < 1e-12_rp, 'a distance differs')
        K = 2000 / eps * (1 + cos(pi * distance(i, j, l) / eps)) / (2 * eps)
        call check(abs(lists(c)%K(at) - K) < 1e-9_rp * 2000 / eps**2, 'K differs')
        call check(abs(norm2(lists(c)%normal(:, at)) - 1) < 1e-12_rp, 'a normal is not of length 1')
      end do
      call check((size(lists(c)%K_u_surface) > 0) .eqv. moves, 'K u_surface is there without a motion, or lacks')
      found = found + count(wanted)
    end do
    call check(found > 500, 'too few faces are near the surface')
  end subroutine test_marks

  ! A flow of speed 1 meets a closed plate that leans by 20 degrees. After the first step, the drop over (R/eps) u cos 20 must lie
  ! in the range. The flow must have no divergence.
  subroutine test_drop(pressure, least, most)
    character(len=*), intent(in) :: pressure
    real(rp), intent(in) :: least, most
    real(rp), parameter :: dt = 1e-3_rp, substeps(3) = [8._rp, 2._rp, 5._rp] / 15
    real(rp), dimension(0:ng(1)+1, 0:ng(2)+1, 0:ng(3)+1) :: u, v, w, p, pp
    real(rp) :: inverse(0:ng(3)+1), lengths(0:ng(3)+1), zc(0:ng(3)+1), zf(0:ng(3)+1), one(1), drop
    type(c_ptr) :: plans(2, 2)
    character(len=80) :: text
    integer :: substep, i
    call write_input("'plate', place = 1., 0.5, 0.5, angle = 110", pressure)
    lengths = dl(3)
    inverse = dli(3)
    zf = [(i, i=0, ng(3) + 1)] * dl(3)
    zc = zf - dl(3) / 2
    one = 1
    plans = c_null_ptr
    call riis_valve_setup(ng, [1, 1, 1], zc, zf, lengths, lengths, inverse, inverse, plans, 1._rp, reshape(one, [1, 1]), one, &
      one, one)
    u = 1
    v = 0
    w = 0
    p = 0
    do substep = 1, 3
      associate (a => substeps(substep) * dt)
        call correc(ng, dli, inverse, a, p, u, v, w)
        call riis_valve_apply(dt, dt, a, u, v, w, p, pp)
        call bounduvw(cbcvel, ng, bcvel, nb, is_bound, dl, lengths, lengths, u, v, w, .false., -1)
        call fillps(ng, dli, inverse, 1 / a, u, v, w, pp)
        call solver(ng, ng, plans, 1._rp, reshape(one, [1, 1]), one, one, one, cbcpre, ['c', 'c', 'c'], pp)
        call boundp(cbcpre, ng, bcpre, nb, is_bound, dl, lengths, pp)
        call correc(ng, dli, inverse, a, pp, u, v, w)
        call bounduvw(cbcvel, ng, bcvel, nb, is_bound, dl, lengths, lengths, u, v, w, .true., 1)
        p = p + pp
      end associate
    end do
    call riis_valve_report(1, dt, u, p)
    drop = (sum(p(2, 1:12, 1:12)) - sum(p(23, 1:12, 1:12))) / 144 / (2000 / eps * cos(pi / 9))
    write (text, '(a, f7.4)') 'the drop is ', drop
    print '(a)', trim(text)
    call check(drop > least .and. drop < most, trim(text))
    call fillps(ng, dli, inverse, 1._rp, u, v, w, pp)
    call check(maxval(abs(pp)) < 1e-9_rp, 'the flow has a divergence')
  end subroutine test_drop

  ! riis may keep 20 MB plus a number of bytes per listed face: 100 without fields, or 170 with K and four fields. There are 300^3
  ! cells.
  subroutine test_memory
    integer, parameter :: n = 300
    real(rp) :: centres(n), faces(n), corners(3, 4)
    type(riis_surface) :: plate
    type(riis_mesh) :: mesh(3)
    type(riis_marks) :: marks(3)
    integer(int64) :: before, listed, kept
    integer :: c, i, case
    character(len=120) :: text
    centres = [(i - 0.5_rp, i=1, n)] / n
    faces = [(i, i=1, n)] / real(n, rp)
    corners = reshape([0.5_rp, -1._rp, -1._rp, 0.6_rp, 2._rp, -1._rp, 0.6_rp, 2._rp, 2._rp, 0.5_rp, -1._rp, 2._rp], [3, 4])
    call plate%create_from_arrays(corners, reshape([1, 2, 3, 4], [4, 1]), half_thickness=1.5_rp / n)
    before = resident()
    if (before < 0) stop 77
    call mesh(1)%create_grid(faces, centres, centres, halo=1)
    call mesh(2)%create_grid(centres, faces, centres, halo=1)
    call mesh(3)%create_grid(centres, centres, faces, halo=1)
    do case = 1, 2
      listed = 0
      do c = 1, 3
        if (case == 1) call riis_mark_nodes(plate, mesh(c), marks(c), n_threads=1)
        if (case == 2) call riis_mark_nodes(plate, mesh(c), marks(c), n_threads=1, R=1._rp, &
          fields=RIIS_FIELD_POINT + RIIS_FIELD_NORMAL + RIIS_FIELD_SIDE + RIIS_FIELD_RIM)
        listed = listed + marks(c)%n_marked()
      end do
      kept = resident() - before
      write (text, '(i0, a, i0, a, i0)') listed, ' faces are listed, riis keeps ', kept, ' bytes of the limit ', &
        merge(100, 170, case == 1) * listed + 20 * 10_int64**6
      print '(a)', trim(text)
      call check(listed > 700000, trim(text))
      call check(kept <= merge(100, 170, case == 1) * listed + 20 * 10_int64**6, trim(text))
    end do
  end subroutine test_memory

  ! Returns the resident memory of this process in bytes, or -1 if the system does not tell.
  function resident() result(bytes)
    integer(int64) :: bytes
    character(len=80) :: line
    integer :: unit, status
    bytes = -1
    open (newunit=unit, file='/proc/self/status', action='read', status='old', iostat=status)
    do while (status == 0)
      read (unit, '(a)', iostat=status) line
      if (status == 0 .and. line(1:6) == 'VmRSS:') then
        read (line(7:index(line, 'kB') - 1), *) bytes
        bytes = 1024 * bytes
        exit
      end if
    end do
    close (unit)
  end function resident
end program test_cans
