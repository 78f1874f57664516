// SPDX-License-Identifier: Apache-2.0
// bileaflet.geo and trileaflet.geo include this file at their end. It puts the leaflet into the mesh, names the surfaces, and
// sets the lengths of the edges. It reads fluid(), leaf(), the options, and two lists. z_range() has the heights of both ends.
// plane_boxes() has one box of six numbers around each plane of symmetry.
tolerance = 2e-3; // gmsh's boxes of curved surfaces are a little too wide
DefineConstant[ solid = 0 ];
If (solid == 0)
  leaf() = BooleanIntersection { Surface{leaf()}; Delete; }{ Volume{fluid()}; };
EndIf
If (fitted)
  parts() = BooleanFragments { Volume{fluid()}; Delete; }{ Surface{leaf()}; Delete; };
  fluid() = Volume{:};
EndIf

planes() = {};
For i In {0:#plane_boxes() / 6 - 1}
  b() = plane_boxes({6 * i : 6 * i + 5});
  planes() += Surface In BoundingBox {b(0) - tolerance, b(1) - tolerance, b(2) - 1, b(3) + tolerance, b(4) + tolerance, b(5) + 1};
EndFor
inlet() = Surface In BoundingBox {-9, -9, z_range(0) - tolerance, 9, 9, z_range(0) + tolerance};
outlet() = Surface In BoundingBox {-9, -9, z_range(1) - tolerance, 9, 9, z_range(1) + tolerance};
wall() = Abs(CombinedBoundary { Volume{fluid()}; });
wall() -= {planes(), inlet(), outlet()};
If (fitted)
  leaf() = Surface{:};
  leaf() -= {wall(), planes(), inlet(), outlet()};
EndIf
Printf("surfaces: leaflet %g, wall %g, planes %g, volumes %g", #leaf(), #wall(), #planes(), #fluid());

Physical Volume("blood") = fluid();
Physical Surface("inlet") = inlet();
Physical Surface("outlet") = outlet();
Physical Surface("wall") = wall();
Physical Surface("planes") = planes();
If (fitted)
  Physical Surface("leaflet") = leaf();
EndIf

Field[1] = Distance;
Field[1].FacesList = {leaf()};
Field[1].NNodesByEdge = 120;
Field[2] = Threshold;
Field[2].IField = 1;
Field[2].LcMin = size;
Field[2].LcMax = far;
Field[2].DistMin = band;
Field[2].DistMax = band + (far - size) / 0.25;
Background Field = 2;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthFromCurvature = 0;
Mesh.CharacteristicLengthMax = far;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
