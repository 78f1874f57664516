// SPDX-License-Identifier: Apache-2.0
// Makes a mesh of the aortic root of ./run demo for a flow solver. The root has a tube at the outlet, and names for the inlet,
// the outlet and the wall. This command makes a mesh in metres with edges of 1.6 mm: gmsh -3 -nt 1 -setnumber Mesh.ScalingFactor
// 0.01 -setnumber size 0.16 -format msh22 -o root.msh root.geo
DefineConstant[ size = 0.16 ]; // length of the edges in centimetres
tube_length = 1;
Include "../demo/aortic_root.geo";

top = root_z + sinus_height + aorta_length;
outlet[] = Surface In BoundingBox {-3, -3, top - 0.01, 3, 3, top + 0.01};
downstream[] = Extrude {0, 0, tube_length} { Surface{outlet[0]}; };
root[] = BooleanUnion { Volume{1}; Delete; }{ Volume{downstream[1]}; Delete; };
bottom = root_z - outflow_length;
top = top + tube_length;
inlet[] = Surface In BoundingBox {-3, -3, bottom - 0.01, 3, 3, bottom + 0.01};
outlet[] = Surface In BoundingBox {-3, -3, top - 0.01, 3, 3, top + 0.01};
wall[] = Surface{:};
wall[] -= inlet[];
wall[] -= outlet[];
Physical Surface("inlet") = inlet[];
Physical Surface("outlet") = outlet[];
Physical Surface("wall") = wall[];
Physical Volume("blood") = root[];
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.Binary = 0;
