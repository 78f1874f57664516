// SPDX-License-Identifier: Apache-2.0
// The aortic root of ./run demo, prepared for a flow solver. The root has a tube at each end, and numbers for the inlet, the
// outlet and the wall. This command makes the mesh in metres, with edges of 1.8 mm around the valve: gmsh -3 -nt 1 -setnumber
// Mesh.ScalingFactor 0.01 -format msh22 -o root.msh root.geo
DefineConstant[ size = 0.18 ]; // length of the edges around the valve, in centimetres
tube_length = 1;
// Sections closer together than the length of an edge would leave flat tetrahedra at the wall.
spacing = size;
n_points = 48;
Include "../demo/aortic_root.geo";

bottom = root_z - outflow_length;
top = root_z + sinus_height + aorta_length;
inlet[] = Surface In BoundingBox {-3, -3, bottom - 0.01, 3, 3, bottom + 0.01};
outlet[] = Surface In BoundingBox {-3, -3, top - 0.01, 3, 3, top + 0.01};
upstream[] = Extrude {0, 0, -tube_length} { Surface{inlet[0]}; };
downstream[] = Extrude {0, 0, tube_length} { Surface{outlet[0]}; };
root[] = BooleanUnion { Volume{1}; Delete; }{ Volume{upstream[1], downstream[1]}; Delete; };
inlet[] = Surface In BoundingBox {-3, -3, bottom - tube_length - 0.01, 3, 3, bottom - tube_length + 0.01};
outlet[] = Surface In BoundingBox {-3, -3, top + tube_length - 0.01, 3, 3, top + tube_length + 0.01};
wall[] = Surface{:};
wall[] -= inlet[];
wall[] -= outlet[];
// code_saturne does not read the names of groups. Therefore code_saturne selects faces by the numbers of groups.
Physical Surface(1) = inlet[];
Physical Surface(2) = outlet[];
Physical Surface(3) = wall[];
Physical Volume(4) = root[];
// Edges have the length `size` around the valve, and twice this length in the tubes.
Field[1] = Box;
Field[1].XMin = -2; Field[1].XMax = 2; Field[1].YMin = -2; Field[1].YMax = 2; Field[1].ZMin = -1.35; Field[1].ZMax = 0.4;
Field[1].Thickness = 1; Field[1].VIn = size; Field[1].VOut = 2 * size;
Background Field = 1;
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = 2 * size;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Binary = 0;
