// SPDX-License-Identifier: Apache-2.0
// Fills a closed surface mesh, which gmsh must have read before this file, with tetrahedra of the same size: gmsh -3 -nt 1
// -format vtk -o CYLINDER.vtk SURFACE.msh fill.geo The surface is read from a file so that the mesh can be repeated. HXT
// processes the nodes in the order of their addresses. If gmsh itself has just made the nodes, this order depends on the size of
// the shell's environment. If gmsh reads the nodes from a file, they are in memory one after the other.
Surface Loop(1) = Surface{:};
Volume(1) = {1};
Physical Volume("fluid") = {1};
// In these meshes the algorithm HXT is several times faster than gmsh's default, Delaunay. -setnumber algorithm 1 chooses
// Delaunay, which follows the edge lengths of a size field more closely.
DefineConstant[ algorithm = 10 ];
Mesh.Algorithm3D = algorithm;
Mesh.Binary = 1;
