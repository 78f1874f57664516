// SPDX-License-Identifier: Apache-2.0
// The surface of a tube that the default mitral valve fills. The cross section of the tube is the plan view of the annulus, which
// is the same at every opening. The tube extends from 0.35 cm below the open leaflets to 0.4 cm above the closed annulus, in
// centimetres. fill.geo fills it with about 100,000 nodes. Command: gmsh -2 -format msh2 -o SURFACE.msh mitral_tube.geo
SetFactory("OpenCASCADE");
h = 0.064;
bottom = -1.4;
top = 2.2;
// Parameters of the valve, with the same names. The parameters define the curves of docs/theory/mitral.md.
AP_diameter = 3;
ALPM_diameter = 4;
ALPM_position_ratio = 0.55;
IT_distance = 2.5;
indent_depth = 0.5;

// Control points of half the annulus, from its posterior to its anterior point. The other half is its mirror image.
along = 0.55 * (ALPM_position_ratio * AP_diameter + 0.5 * ALPM_diameter) / 2;
back = 0.55 * ((1 - ALPM_position_ratio) * AP_diameter + 0.5 * indent_depth);
widest = AP_diameter * (ALPM_position_ratio - 0.5);
x[] = {0, along, ALPM_diameter / 2, ALPM_diameter / 2, ALPM_diameter / 2, 3 * IT_distance / 4, IT_distance / 2, IT_distance / 4,
       IT_distance / 4, 0};
y[] = {-AP_diameter / 2, -AP_diameter / 2, widest - back, widest, widest + back, (AP_diameter + indent_depth) / 2,
       (AP_diameter + indent_depth) / 2, (AP_diameter + indent_depth) / 2, AP_diameter / 2, AP_diameter / 2};
For i In {0 : 9}
  p = newp;
  Point(p) = {x[i], y[i], bottom};
  right[] += p;
  If (i > 0 && i < 9)
    p = newp;
    Point(p) = {-x[i], y[i], bottom};
  EndIf
  left[] += p;
EndFor
For i In {0 : 6 : 3}
  Bezier(1 + i) = {right[i], right[i + 1], right[i + 2], right[i + 3]};
  Bezier(2 + i) = {left[i], left[i + 1], left[i + 2], left[i + 3]};
EndFor
Curve Loop(1) = {1, 4, 7, -8, -5, -2};
Plane Surface(1) = {1};
Extrude {0, 0, top - bottom} { Surface{1}; }
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Binary = 1;
