! SPDX-License-Identifier: Apache-2.0
!> Computes the source in the band of a moving valve (README.md, "The source in the band").
!!
!! A face with a large K has the velocity of the leaflet, and the pressure hardly changes it. If a cell has only such faces and
!! walls, its divergence is the divergence of u_surface. The source allows this divergence. Without the source the pressure grows
!! until blood flows through the faces of the band.
module flow_source
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  private
  public :: find_source

contains

  !> Computes the source S [1/s] of every cell. Faces that are not held and not closed connect cells to sets. A set with a cell at
  !> an
  !! end of the vessel lies outside the band, and its source is 0. In every other set the source is uniform. The integral of the
  !! source equals the flow out of the set through the held faces.
  pure subroutine find_source(cell, ends, stride, h, closed, face, held, u, without_net, S)
    integer, intent(in) :: cell(:)                ! the numbers of all fluid cells
    integer, intent(in) :: ends(:)                ! the numbers of the cells at both ends
    integer, intent(in) :: stride(3)              ! face (m, c) lies between the cells m - stride(c) and m
    real(dp), intent(in) :: h                     ! [m] side of a cell
    logical, intent(in) :: closed(:, :)           ! (:, 3): walls
    integer, intent(in) :: face(:, :)             ! (2, n_faces): m and c of every face that is not closed
    logical, intent(in) :: held(:)                ! (n_faces): .true. if K is large at the face
    real(dp), intent(in) :: u(:)                  ! [m/s] (n_faces): the component of u_surface at held faces
    logical, intent(in) :: without_net            ! .true.: the cells around the band get the opposite of the net source
    real(dp), intent(out) :: S(:)                 ! [1/s], 0 for numbers without a fluid cell
    logical, allocatable :: joins(:, :), gathered(:), touched(:)
    integer, allocatable :: members(:), around(:)
    integer :: c, f, m, n, side
    allocate (gathered(size(S)), touched(size(S)), members(size(cell)))
    S = 0
    joins = .not. closed
    touched = .false.
    do f = 1, size(face, 2)                       ! first, S is the flow through each cell's own held faces
      if (.not. held(f)) cycle
      m = face(1, f)
      c = face(2, f)
      joins(m, c) = .false.
      touched([m - stride(c), m]) = .true.
      S(m - stride(c)) = S(m - stride(c)) + u(f) / h
      S(m) = S(m) - u(f) / h
    end do

    gathered = .true.                             ! places without a fluid cell belong to no set
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
        S(members(:n)) = sum(S(members(:n))) / n  ! a held face inside the set counts twice with opposite signs, so it cancels
      end do
    end do
    if (without_net) S(around) = -sum(S(cell)) / max(1, size(around))
  end subroutine find_source

  ! Adds all cells that are connected to the first n members.
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
          if (.not. joins(max(members(i), next), c)) cycle ! a face has the number of its upper cell
          n = n + 1
          members(n) = next
          gathered(next) = .true.
        end do
      end do
    end do
  end subroutine gather
end module flow_source
