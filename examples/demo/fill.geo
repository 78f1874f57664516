// SPDX-License-Identifier: Apache-2.0
// Fills a closed surface mesh, which gmsh has read before this file, with tetrahedra of the same size:
// gmsh -3 -nt 1 -format vtk -o CYLINDER.vtk SURFACE.msh fill.geo
// From a file, gmsh puts the nodes into memory one after the other. HXT takes them in the order of their addresses: nodes that
// gmsh has just made itself come in an order that depends on the environment's size, and give another mesh in each shell.
Surface Loop(1) = Surface{:};
Volume(1) = {1};
Physical Volume("fluid") = {1};
Mesh.Algorithm3D = 10; // HXT: several times faster than the default here
Mesh.Binary = 1;
