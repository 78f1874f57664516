// SPDX-License-Identifier: Apache-2.0
// The surface of a cylinder with room for the default aortic valve. The cylinder extends from 0.4 cm below the root of the valve
// to 0.6 cm above its free edges, in centimetres. fill.geo fills it with about 100,000 nodes. Command: gmsh -2 -format msh2 -o
// SURFACE.msh aortic_cylinder.geo
SetFactory("OpenCASCADE");
h = 0.048;
Cylinder(1) = {0, 0, -1.4, 0, 0, 2.0, 1.6};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Binary = 1;
