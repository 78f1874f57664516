! SPDX-License-Identifier: Apache-2.0
! Generated from fortran/templates/riis_f77_adjacency.fypp by fortran/expand_templates.sh: edit that template, not this file.
!> The external subroutines for adjacencies. The conventions are those of riis_f77.f90.

!> Gives the mesh its adjacency as compressed sparse rows, which are borrowed. If index_base is 1, the neighbours of node i are
!! columns(offsets(i)) to columns(offsets(i + 1) - 1). Errors: RIIS_INVALID_ARGUMENT for an argument out of range,
!! RIIS_INVALID_MESH naming the row, counted from 0, and its value. The mesh then keeps its earlier rows.
subroutine riisf_mesh_set_adjacency(mesh, n_rows, offsets, columns, index_base, n_all, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_csr, riis_status, RIIS_OK, riis_csr_init, riis_mesh_set_adjacency
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int32), intent(in) :: n_rows                    !< The mesh's number of nodes.
  integer(int32), intent(in) :: offsets(*)                !< (n_rows + 1), ascending from index_base.
  integer(int32), intent(in) :: columns(*)                !< (offsets(n_rows + 1) - index_base), from index_base.
  integer(int32), intent(in) :: index_base                !< 0 or 1.
  integer(int32), intent(in) :: n_all                     !< n_rows plus the ghost nodes that columns may name; 0: n_rows.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_csr) :: csr
  status = riis_csr_init(csr, c_sizeof(csr))
  if (status /= RIIS_OK) return
  csr%n_rows = n_rows
  csr%n_all = n_all
  csr%offsets = location_of(offsets)
  csr%columns = location_of(columns)
  csr%offset_bits = storage_size(offsets)
  csr%column_bits = storage_size(columns)
  csr%index_base = index_base
  status = riis_mesh_set_adjacency(c_handle_of(mesh), csr)
end subroutine riisf_mesh_set_adjacency

!> Does the same.
subroutine riisf_mesh_set_adjacency_64(mesh, n_rows, offsets, columns, index_base, n_all, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_csr, riis_status, RIIS_OK, riis_csr_init, riis_mesh_set_adjacency
  use riis_support, only: c_handle_of, location_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int64), intent(in) :: n_rows                    !< The mesh's number of nodes.
  integer(int64), intent(in) :: offsets(*)                !< (n_rows + 1), ascending from index_base.
  integer(int64), intent(in) :: columns(*)                !< (offsets(n_rows + 1) - index_base), from index_base.
  integer(int32), intent(in) :: index_base                !< 0 or 1.
  integer(int64), intent(in) :: n_all                     !< n_rows plus the ghost nodes that columns may name; 0: n_rows.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_csr) :: csr
  status = riis_csr_init(csr, c_sizeof(csr))
  if (status /= RIIS_OK) return
  csr%n_rows = n_rows
  csr%n_all = n_all
  csr%offsets = location_of(offsets)
  csr%columns = location_of(columns)
  csr%offset_bits = storage_size(offsets)
  csr%column_bits = storage_size(columns)
  csr%index_base = index_base
  status = riis_mesh_set_adjacency(c_handle_of(mesh), csr)
end subroutine riisf_mesh_set_adjacency_64

!> Gives the mesh the rows of an adjacency that the library made. The adjacency must live until the mesh is destroyed or gets
!! another adjacency.
subroutine riisf_mesh_use_adjacency(mesh, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_sizeof
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_csr, riis_status, RIIS_OK, riis_adjacency_get_csr, riis_mesh_set_adjacency
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(int64), intent(in) :: adjacency                 !< Must be created. Destroy it after the mesh.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_csr) :: csr
  status = riis_adjacency_get_csr(c_handle_of(adjacency), csr, c_sizeof(csr))
  if (status == RIIS_OK) status = riis_mesh_set_adjacency(c_handle_of(mesh), csr)
end subroutine riisf_mesh_use_adjacency

!> Removes the mesh's adjacency. Its rows are not borrowed any more.
subroutine riisf_mesh_clear_adjacency(mesh, status)
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_status, riis_mesh_set_adjacency
  use riis_support, only: c_handle_of
  implicit none
  integer(int64), intent(in) :: mesh                      !< Must be created.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  status = riis_mesh_set_adjacency(c_handle_of(mesh))
end subroutine riisf_mesh_clear_adjacency

!> Makes an adjacency from cells that all have the same number of nodes, in VTK's order. Two nodes are neighbours if an edge of a
!! cell joins them. Errors: RIIS_INVALID_ARGUMENT for an argument out of range, RIIS_INVALID_MESH naming the cell, counted from 0,
!! and its value.
subroutine riisf_adjacency_from_cells(n_nodes, nodes_per_cell, n_cells, cells, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mesh_cells, riis_status, RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
  integer(int32), intent(in) :: nodes_per_cell            !< 4 tetrahedron, 5 pyramid, 6 prism, 8 hexahedron.
  integer(int32), intent(in) :: n_cells                   !< >= 1.
  integer(int32), intent(in) :: cells(*)                  !< CELLS(nodes_per_cell, n_cells).
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first node's number.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: the_cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
  if (status /= RIIS_OK) return
  the_cells%n_nodes = n_nodes
  the_cells%n_cells = n_cells
  the_cells%node_ids = location_of(cells)
  the_cells%nodes_per_cell = nodes_per_cell
  the_cells%id_bits = storage_size(cells)
  the_cells%index_base = index_base
  the_cells%n_threads = n_threads
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(the_cells, c_handle)
  if (status == RIIS_OK) adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_cells

!> Does the same.
subroutine riisf_adjacency_from_cells_64(n_nodes, nodes_per_cell, n_cells, cells, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mesh_cells, riis_status, RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
  integer(int32), intent(in) :: nodes_per_cell            !< 4 tetrahedron, 5 pyramid, 6 prism, 8 hexahedron.
  integer(int64), intent(in) :: n_cells                   !< >= 1.
  integer(int64), intent(in) :: cells(*)                  !< CELLS(nodes_per_cell, n_cells).
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first node's number.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: the_cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
  if (status /= RIIS_OK) return
  the_cells%n_nodes = n_nodes
  the_cells%n_cells = n_cells
  the_cells%node_ids = location_of(cells)
  the_cells%nodes_per_cell = nodes_per_cell
  the_cells%id_bits = storage_size(cells)
  the_cells%index_base = index_base
  the_cells%n_threads = n_threads
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(the_cells, c_handle)
  if (status == RIIS_OK) adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_cells_64

!> Makes an adjacency from cells of several shapes. If offsets begins with 1, the nodes of cell i are node_ids(offsets(i)) to
!! node_ids(offsets(i + 1) - 1).
subroutine riisf_adjacency_from_mixed(n_nodes, n_cells, node_ids, offsets, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mesh_cells, riis_status, RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int32), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
  integer(int32), intent(in) :: n_cells                   !< >= 1.
  integer(int32), intent(in) :: node_ids(*)               !< The nodes of all cells, one cell after the other.
  integer(int32), intent(in) :: offsets(*)                !< (n_cells + 1), ascending from 0 or from index_base.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first node's number.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: the_cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
  if (status /= RIIS_OK) return
  the_cells%n_nodes = n_nodes
  the_cells%n_cells = n_cells
  the_cells%node_ids = location_of(node_ids)
  the_cells%offsets = location_of(offsets)
  the_cells%id_bits = storage_size(node_ids)
  the_cells%index_base = index_base
  the_cells%n_threads = n_threads
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(the_cells, c_handle)
  if (status == RIIS_OK) adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_mixed

!> Does the same.
subroutine riisf_adjacency_from_mixed_64(n_nodes, n_cells, node_ids, offsets, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mesh_cells, riis_status, RIIS_OK, riis_adjacency_create_from_cells, riis_mesh_cells_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int64), intent(in) :: n_nodes                   !< The mesh's number of nodes, >= 1.
  integer(int64), intent(in) :: n_cells                   !< >= 1.
  integer(int64), intent(in) :: node_ids(*)               !< The nodes of all cells, one cell after the other.
  integer(int64), intent(in) :: offsets(*)                !< (n_cells + 1), ascending from 0 or from index_base.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first node's number.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_cells) :: the_cells
  type(c_ptr) :: c_handle
  status = riis_mesh_cells_init(the_cells, c_sizeof(the_cells))
  if (status /= RIIS_OK) return
  the_cells%n_nodes = n_nodes
  the_cells%n_cells = n_cells
  the_cells%node_ids = location_of(node_ids)
  the_cells%offsets = location_of(offsets)
  the_cells%id_bits = storage_size(node_ids)
  the_cells%index_base = index_base
  the_cells%n_threads = n_threads
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_cells(the_cells, c_handle)
  if (status == RIIS_OK) adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_mixed_64

!> Makes an adjacency from faces, for codes that mark cell centres. Two cells are neighbours if they have a common face. The
!! errors are those of riisf_adjacency_from_cells.
subroutine riisf_adjacency_from_faces(n_cells, n_faces, face_cells, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mesh_faces, riis_status, RIIS_OK, riis_adjacency_create_from_faces, riis_mesh_faces_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int32), intent(in) :: n_cells                   !< >= 1.
  integer(int32), intent(in) :: n_faces                   !< >= 0.
  integer(int32), intent(in) :: face_cells(*)             !< FACE_CELLS(2, n_faces); the second is index_base - 1 at the
                                                          !! boundary.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first cell's number.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_faces) :: faces
  type(c_ptr) :: c_handle
  status = riis_mesh_faces_init(faces, c_sizeof(faces))
  if (status /= RIIS_OK) return
  faces%n_cells = n_cells
  faces%n_faces = n_faces
  if (n_faces > 0) then
    faces%owner = location_of(face_cells(1))
    faces%neighbor = location_of(face_cells(2))
  end if
  faces%stride = 2
  faces%id_bits = storage_size(face_cells)
  faces%index_base = index_base
  faces%n_threads = n_threads
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_faces(faces, c_handle)
  if (status == RIIS_OK) adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_faces

!> Does the same.
subroutine riisf_adjacency_from_faces_64(n_cells, n_faces, face_cells, index_base, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_mesh_faces, riis_status, RIIS_OK, riis_adjacency_create_from_faces, riis_mesh_faces_init
  use riis_support, only: handle_of, location_of
  implicit none
  integer(int64), intent(in) :: n_cells                   !< >= 1.
  integer(int64), intent(in) :: n_faces                   !< >= 0.
  integer(int64), intent(in) :: face_cells(*)             !< FACE_CELLS(2, n_faces); the second is index_base - 1 at the
                                                          !! boundary.
  integer(int32), intent(in) :: index_base                !< 0 or 1: the first cell's number.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(riis_mesh_faces) :: faces
  type(c_ptr) :: c_handle
  status = riis_mesh_faces_init(faces, c_sizeof(faces))
  if (status /= RIIS_OK) return
  faces%n_cells = n_cells
  faces%n_faces = n_faces
  if (n_faces > 0) then
    faces%owner = location_of(face_cells(1))
    faces%neighbor = location_of(face_cells(2))
  end if
  faces%stride = 2
  faces%id_bits = storage_size(face_cells)
  faces%index_base = index_base
  faces%n_threads = n_threads
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_faces(faces, c_handle)
  if (status == RIIS_OK) adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_faces_64

!> Makes the adjacency of a structured grid, XYZ(3, ni, nj, nk). Neighbours differ by 1 in one of i, j, k.
subroutine riisf_adjacency_from_grid(ni, nj, nk, n_threads, adjacency, status)
  use, intrinsic :: iso_c_binding, only: c_null_ptr, c_ptr
  use, intrinsic :: iso_fortran_env, only: int32, int64
  use riis_c, only: riis_status, RIIS_OK, riis_adjacency_create_from_grid
  use riis_support, only: handle_of
  implicit none
  integer(int32), intent(in) :: ni                        !< >= 1.
  integer(int32), intent(in) :: nj                        !< >= 1.
  integer(int32), intent(in) :: nk                        !< >= 1.
  integer(int32), intent(in) :: n_threads                 !< 1 to 1024; 0: as many as there is work for.
  integer(int64), intent(inout) :: adjacency              !< Written on success.
  integer(riis_status), intent(out) :: status             !< RIIS_OK or the error.
  type(c_ptr) :: c_handle
  c_handle = c_null_ptr
  status = riis_adjacency_create_from_grid(int(ni, int64), int(nj, int64), int(nk, int64), n_threads, c_handle)
  if (status == RIIS_OK) adjacency = handle_of(c_handle)
end subroutine riisf_adjacency_from_grid

!> Destroys the adjacency and sets its handle to 0. Nothing happens to a handle that is 0.
subroutine riisf_adjacency_destroy(handle)
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: int64
  use riis_c, only: riis_adjacency_destroy
  use riis_support, only: c_handle_of, handle_of
  implicit none
  integer(int64), intent(inout) :: handle                 !< May be 0.
  type(c_ptr) :: c_handle
  c_handle = c_handle_of(handle)
  call riis_adjacency_destroy(c_handle)
  handle = handle_of(c_handle)
end subroutine riisf_adjacency_destroy
