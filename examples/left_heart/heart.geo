// SPDX-License-Identifier: Apache-2.0
// The blood of a left heart, in mm: half an ellipsoid below the base z = 0, with two tubes above it. The aortic tube is a
// cylinder.
// The mitral tube has the outline of the mitral valve's annulus, as riis draws it (docs/theory/mitral.md).
//
//   gmsh -3 -setnumber fine 2.2 -setnumber coarse 4.5 -format msh22 heart.geo
SetFactory("OpenCASCADE");
DefineConstant[ fine = 2.2, coarse = 4.5 ]; // edges near the valves, and at the apex
ventricle_radius = 28;
ventricle_length = 73;
unit = 8;            // mm per cm of the mitral valve's table
mitral_y = -14;      // the middle of the annulus
aortic_y = 15;
aortic_radius = 1.25 * 9.2; // 9.2 mm per cm of the coapting valve's root_radius
mitral_top = 26;
aortic_top = 34;
overlap = 1;         // so far the tubes reach into the ventricle before they are united

Sphere(1) = {0, 0, 0, 1, -Pi / 2, 0};
Dilate {{0, 0, 0}, {ventricle_radius, ventricle_radius, ventricle_length}} { Volume{1}; }
Cylinder(2) = {0, aortic_y, -overlap, 0, 0, aortic_top + overlap, aortic_radius};

// The mitral annulus: three cubic Bezier curves on each side of its plane of symmetry, from the posterior point to the
// anterior one.
AP_diameter = 3 * unit;
ALPM_diameter = 4 * unit;
ALPM_position_ratio = 0.55;
IT_distance = 2.5 * unit;
indent_depth = 0.5 * unit;
round = 0.55;
side = ALPM_diameter / 2;
widest = AP_diameter * (ALPM_position_ratio - 0.5);
near = round * (ALPM_position_ratio * AP_diameter + side) / 2;
far = round * ((1 - ALPM_position_ratio) * AP_diameter + indent_depth / 2);
ax[] = {0, near, side, side, side, 3 * IT_distance / 4, IT_distance / 2, IT_distance / 4, IT_distance / 4, 0};
ay[] = {-AP_diameter / 2, -AP_diameter / 2, widest - far, widest, widest + far, (AP_diameter + indent_depth) / 2,
        (AP_diameter + indent_depth) / 2, (AP_diameter + indent_depth) / 2, AP_diameter / 2, AP_diameter / 2};
For i In {0 : 9}
  p = newp;
  Point(p) = {ax[i], ay[i] + mitral_y, -overlap};
  right[] += p;
  If (i > 0 && i < 9) // the ends lie in the plane of symmetry, and both sides share them
    p = newp;
    Point(p) = {-ax[i], ay[i] + mitral_y, -overlap};
  EndIf
  left[] += p;
EndFor
For i In {0 : 6 : 3}
  c = newl;
  Bezier(c) = {right[i], right[i + 1], right[i + 2], right[i + 3]};
  rights[] += c;
  c = newl;
  Bezier(c) = {left[i], left[i + 1], left[i + 2], left[i + 3]};
  lefts[] += c;
EndFor
outline = newll;
Curve Loop(outline) = {rights[0], rights[1], rights[2], -lefts[2], -lefts[1], -lefts[0]};
floor = news;
Plane Surface(floor) = {outline};
tube[] = Extrude {0, 0, mitral_top + overlap} { Surface{floor}; };
blood[] = BooleanUnion { Volume{1}; Delete; }{ Volume{2}; Volume{tube[1]}; Delete; };

e = 0.01;
inlet[] = Surface In BoundingBox {-40, -40, mitral_top - e, 40, 40, mitral_top + e};
outlet[] = Surface In BoundingBox {-40, -40, aortic_top - e, 40, 40, aortic_top + e};
wall[] = Boundary { Volume{blood[]}; };
wall[] -= inlet[];
wall[] -= outlet[];
Physical Surface("inlet") = inlet[];
Physical Surface("outlet") = outlet[];
Physical Surface("wall") = wall[];
Physical Volume("blood") = blood[];

// Fine cells above z = -20.
Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * (1 + Tanh((-20 - z) / 5)) / 2", fine, coarse - fine);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
Mesh.ScalingFactor = 0.001; // OpenFOAM has metres
