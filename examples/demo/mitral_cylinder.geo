// SPDX-License-Identifier: Apache-2.0
// A cylinder that the default mitral valve fits, closed, open and in between: from 0.3 cm below its open leaflets to 0.3 cm above its
// closed annulus, in centimetres, about 100,000 nodes. For gmsh: gmsh -3 -format vtk -o mitral_cylinder.vtk mitral_cylinder.geo
SetFactory("OpenCASCADE");
h = 0.0745;
Cylinder(1) = {0, 0.3, -1.35, 0, 0, 3.45, 2.4};
Physical Volume("fluid") = {1};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Algorithm3D = 10; // HXT: several times faster than the default here
Mesh.Binary = 1;
