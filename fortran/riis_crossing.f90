! SPDX-License-Identifier: Apache-2.0
!> Crossings: riis_find_crossings of riis.h, as a part of module riis.
module riis_crossing
  use, intrinsic :: iso_c_binding, only: c_double, c_sizeof
  use riis_c, c_find_crossings => riis_find_crossings
  use riis_support
  use riis_surfaces, only: riis_surface
  implicit none
  private
  public :: riis_find_crossings

  !> Finds every pair of a surface's triangles that go through each other.
  interface riis_find_crossings
    module procedure find_crossings
  end interface riis_find_crossings

contains

  !> Finds every pair of the surface's triangles that go through each other. A pair's depth is its penetration depth: the length
  !! of the shortest translation of one triangle after which both only touch. Triangles that touch or lie in one plane have depth
  !! 0. Triangles of one leaflet that share a vertex are no pair. %crossing_pairs of the surface gives the pairs. Errors:
  !! RIIS_INVALID_ARGUMENT naming depth or n_threads; the pairs are then as they were.
  subroutine find_crossings(surface, crossings, depth, n_threads, status)
    class(riis_surface), intent(inout) :: surface           !< Created; its pairs are replaced, all else stays.
    type(riis_crossings), intent(inout) :: crossings        !< The summary; left alone on an error.
    real(c_double), intent(in), optional :: depth           !< Half thicknesses, 0 to 1: a pair at most so deep touches. Default
                                                            !! 1e-6.
    class(*), intent(in), optional :: n_threads             !< integer, 1 to 1024. Default 0: 1 per 4096 triangles, at most 1 a
                                                            !! processor.
    integer(riis_status), intent(out), optional :: status   !< RIIS_OK or the error. Without it an error stops the program.
    type(riis_crossing_options) :: options
    integer(riis_status) :: code
    code = check_created(surface%c_handle(), 'the surface')
    if (code == RIIS_OK) code = riis_crossing_options_init(options, c_sizeof(options))
    if (present(depth)) options%depth = depth
    call get_integer(n_threads, 'n_threads', options%n_threads, code)
    if (code == RIIS_OK) code = c_find_crossings(surface%c_handle(), options, crossings, c_sizeof(crossings))
    call finish(code, status)
  end subroutine find_crossings
end module riis_crossing
