// SPDX-License-Identifier: Apache-2.0
// A round duct along z, as wide as the housing of the bileaflet valve, in metres. Edges have this size where the valve rotates.
SetFactory("OpenCASCADE");
DefineConstant[ size = 1.5e-3 ];
Cylinder(1) = {0, 0, -0.02, 0, 0, 0.06, 0.011};
Physical Volume("blood", 1) = {1};
Physical Surface("wall", 3) = {1};
Physical Surface("outlet", 2) = {2};
Physical Surface("inlet", 1) = {3};
Field[1] = Box;
Field[1].VIn = size;
Field[1].VOut = 2 * size;
Field[1].XMin = -1; Field[1].XMax = 1; Field[1].YMin = -1; Field[1].YMax = 1;
Field[1].ZMin = -0.005; Field[1].ZMax = 0.013; Field[1].Thickness = 0.01;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
