! SPDX-License-Identifier: Apache-2.0
! error_stop CASE: makes a mistake, to which module riis responds with an error stop. check_error_stop.sh runs this program.
program error_stop
  use, intrinsic :: iso_c_binding, only: c_double
  use riis
  implicit none
  type :: model ! a type that contains handles
    integer :: number = 0
    type(riis_valve) :: valve
  end type model
  type(riis_valve) :: valve, other_valve
  type(riis_surface) :: surface, other_surface
  type(riis_keyframes) :: keyframes, other_keyframes
  type(riis_mesh) :: mesh, other_mesh
  type(riis_adjacency) :: adjacency, other_adjacency
  type(riis_marks) :: result, other_result
  type(model) :: one, other
  real(c_double) :: xyz(3, 1)
  character(len=20) :: what

  xyz = 0
  call valve%create('aortic')
  call surface%create(valve)
  call mesh%create(xyz)
  call adjacency%create_from_grid(1, 1, 1)
  call riis_mark_nodes(surface, mesh, result)
  call get_command_argument(1, what)
  select case (what)
  case ('none')
  case ('library')
    call valve%set('leaflet_angle', 1d3)
  case ('layer')
    call mesh%create(xyz)
  case ('function')
    print '(i0)', other_result%n_marked()
  case ('valve')
    other_valve = valve
  case ('surface')
    other_surface = surface
  case ('keyframes')
    call keyframes%create([0d0], reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, 0d0, 1d0, 0d0], [3, 3, 1]), reshape([1, 2, 3], [3, 1]))
    other_keyframes = keyframes
  case ('law')
    call riis_opening_from_times(riis_opening_times(0d0, -1d0, 1d0, 1d0), 0d0, xyz(1, 1))
  case ('mesh')
    other_mesh = mesh
  case ('adjacency')
    other_adjacency = adjacency
  case ('result')
    other_result = result
  case ('component')
    call one%valve%create('mitral')
    other = one
  case ('overwrite')
    valve = other_valve
  case default
    error stop 'no such case'
  end select
  print '(a)', 'went on'
  call result%destroy()
  call adjacency%destroy()
  call mesh%destroy()
  call surface%destroy()
  call valve%destroy()
end program error_stop
