! SPDX-License-Identifier: Apache-2.0
!> The source in the band of a valve that moves (README.md, "The source in the band").
!!
!! Where K is large, a face has the velocity of the leaflet, and no pressure changes it. So cells between such faces and walls
!! have the divergence of u_surface. The source allows it; without one the pressure grows until the faces give way.
module flow_source
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  private
  public :: find_source

contains

  !> Gives every cell its source S [1/s]. A set of cells is joined through faces that are neither held nor closed. The sets at
  !! both ends of the vessel are outside of the band, and have none. In any other set the source is even, and it is the flow
  !! that the held faces bring out of the set.
  pure subroutine find_source(cell, ends, stride, h, closed, face, held, u, without_net, S)
    integer, intent(in) :: cell(:)                ! the numbers of all fluid cells
    integer, intent(in) :: ends(:)                ! those at both ends
    integer, intent(in) :: stride(3)              ! face (m, c) is between the cells m - stride(c) and m
    real(dp), intent(in) :: h                     ! [m] side of a cell
    logical, intent(in) :: closed(:, :)           ! (:, 3): walls
    integer, intent(in) :: face(:, :)             ! (2, n_faces): number m and direction c of every other face
    logical, intent(in) :: held(:)                ! (n_faces): where K is large
    real(dp), intent(in) :: u(:)                  ! [m/s] (n_faces): the component of u_surface, where held
    logical, intent(in) :: without_net            ! gives the cells around the band the opposite of all sources
    real(dp), intent(out) :: S(:)                 ! [1/s], 0 for numbers that are no cell
    logical, allocatable :: joins(:, :), gathered(:), touched(:)
    integer, allocatable :: members(:), around(:)
    integer :: c, f, m, n, side
    allocate (gathered(size(S)), touched(size(S)), members(size(cell)))
    S = 0
    joins = .not. closed
    touched = .false.
    do f = 1, size(face, 2)                       ! first, what a cell's own held faces bring out of it
      if (.not. held(f)) cycle
      m = face(1, f)
      c = face(2, f)
      joins(m, c) = .false.
      touched([m - stride(c), m]) = .true.
      S(m - stride(c)) = S(m - stride(c)) + u(f) / h
      S(m) = S(m) - u(f) / h
    end do

    gathered = .true.                             ! beyond the ends there is nothing to gather
    gathered(cell) = .false.
    n = size(ends)
    members(:n) = ends
    gathered(ends) = .true.
    call gather(joins, stride, gathered, members, n)
    S(members(:n)) = 0
    around = pack(members(:n), touched(members(:n)))
    do f = 1, size(face, 2)
      if (.not. held(f)) cycle
      do side = 0, 1
        m = face(1, f) - side * stride(face(2, f))
        if (gathered(m)) cycle
        n = 1
        members(1) = m
        gathered(m) = .true.
        call gather(joins, stride, gathered, members, n)
        S(members(:n)) = sum(S(members(:n))) / n  ! faces within the set count for both of their sides, so not at all
      end do
    end do
    if (without_net) S(around) = -sum(S(cell)) / max(1, size(around))
  end subroutine find_source

  ! Adds all cells that are joined with the first n members.
  pure subroutine gather(joins, stride, gathered, members, n)
    logical, intent(in) :: joins(:, :)
    integer, intent(in) :: stride(3)
    logical, intent(inout) :: gathered(:)
    integer, intent(inout) :: members(:), n
    integer :: c, i, next, side
    i = 0
    do while (i < n)
      i = i + 1
      do c = 1, 3
        do side = 0, 1
          next = members(i) + (2 * side - 1) * stride(c)
          if (gathered(next)) cycle
          if (.not. joins(max(members(i), next), c)) cycle ! the number of a face is that of its upper cell
          n = n + 1
          members(n) = next
          gathered(next) = .true.
        end do
      end do
    end do
  end subroutine gather
end module flow_source
