// SPDX-License-Identifier: Apache-2.0
// The surface of a cylinder with room for the default mitral valve at any opening. The cylinder extends from 0.3 cm below the
// open leaflets to 0.3 cm above the closed annulus, in centimetres. fill.geo fills it with about 100,000 nodes. Command: gmsh -2
// -format msh2 -o SURFACE.msh mitral_cylinder.geo
SetFactory("OpenCASCADE");
h = 0.0745;
Cylinder(1) = {0, 0.3, -1.35, 0, 0, 3.45, 2.4};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Binary = 1;
