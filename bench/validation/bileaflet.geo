// SPDX-License-Identifier: Apache-2.0
// Makes a mesh of a quarter of the open bileaflet valve in a tube. The tube is wider downstream of the valve. Lengths are in
// centimetres. The planes x = 0 and y = 0 are planes of symmetry. With fitted = 1 the leaflet is a surface of the mesh. Otherwise
// the mesh has edges of the same lengths, but no leaflet:
// gmsh -3 -setnumber Mesh.ScalingFactor 0.01 -setnumber fitted 1 -setnumber size 0.05 -setnumber band 0.1 -format msh22 FILE
SetFactory("OpenCASCADE");
DefineConstant[ fitted = 1 ];
DefineConstant[ size = 0.05 ];  // length of the edges in the band
DefineConstant[ band = 0.1 ];   // half thickness of the band
DefineConstant[ far = 0.13 ];   // length of the edges far from the band
DefineConstant[ opening = 1 ];
DefineConstant[ solid = 0 ];    // with fitted = 0: half the thickness of a solid leaflet with square edges, or 0

// The valve's defaults.
R = 1.1; hinge = 0.22; closed = 30 * Pi / 180; angle = (30 + 55 * opening) * Pi / 180;

// The tube upstream is as wide as the housing, which ends at z = 0.3. The tube downstream is wider.
Cylinder(1) = {0, 0, -1.3, 0, 0, 1.6, R, Pi / 2};
Cylinder(2) = {0, 0, 0.3, 0, 0, 2.4, 1.5, Pi / 2};
fluid() = BooleanUnion { Volume{1}; Delete; }{ Volume{2}; Delete; };

// The leaflet is half an ellipse about the middle of the closed leaflet. It turns about the hinge as in docs/theory/bileaflet.md.
outline = newreg;
Disk(outline) = {0, 0, 0, R / Cos(closed), R};
quarter = newreg;
Rectangle(quarter) = {0, 0, 0, 2, 2};
leaf() = BooleanIntersection { Surface{outline}; Delete; }{ Surface{quarter}; Delete; };
Rotate {{0, 1, 0}, {0, 0, 0}, -angle} { Surface{leaf()}; }
along = -hinge / Cos(closed);
Translate {along * (Cos(angle) - Cos(closed)), 0, along * Sin(angle)} { Surface{leaf()}; }

If (solid > 0)
  n() = {-Sin(angle), 0, Cos(angle)};
  leaf() = BooleanIntersection { Surface{leaf()}; Delete; }{ Volume{fluid()}; }; // lies inside the solid leaflet, for the edges
  side() = Translate {-solid * n(0), 0, -solid * n(2)} { Duplicata { Surface{leaf()}; } };
  plate() = Extrude {2 * solid * n(0), 0, 2 * solid * n(2)} { Surface{side()}; };
  fluid() = BooleanDifference { Volume{fluid()}; Delete; }{ Volume{plate(1)}; Delete; };
EndIf

z_range() = {-1.3, 2.7};
plane_boxes() = {0, -9, -9, 0, 9, 9, -9, 0, -9, 9, 0, 9};
Include "fluid.geo";
