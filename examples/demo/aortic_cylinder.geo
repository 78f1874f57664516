// SPDX-License-Identifier: Apache-2.0
// A cylinder that the default aortic valve fits: from 0.4 cm below its root to 0.6 cm above its free edges, in centimetres, about
// 100,000 nodes. For gmsh: gmsh -3 -format vtk -o aortic_cylinder.vtk aortic_cylinder.geo
SetFactory("OpenCASCADE");
h = 0.048;
Cylinder(1) = {0, 0, -1.4, 0, 0, 2.0, 1.6};
Physical Volume("fluid") = {1};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Algorithm3D = 10; // HXT: several times faster than the default here
Mesh.Binary = 1;
