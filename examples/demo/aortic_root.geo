// SPDX-License-Identifier: Apache-2.0
// The surface of an aortic root that the trileaflet valve fills: outflow tract, three sinuses and ascending aorta, in
// centimetres. The cusps' attachment lies on the wall, and the sinuses bulge outwards above the attachment. With -setnumber paper
// 1 the file makes a root for the paper's aortic valve, and with -setnumber coapting 1 a root for the coapting valve. fill.geo
// fills it with about 100,000 nodes. Command: gmsh -2 -format msh2 -o SURFACE.msh aortic_root.geo
SetFactory("OpenCASCADE");
DefineConstant[ paper = 0, coapting = 0 ];
h = 0.05;
// Parameters of the valve, with the same names. leaflet_height is the height of the commissures. Lists have a number for each
// cusp: right, left, non-coronary.
If (paper)
  root_radius = 1.29; leaflet_height = 1.02; bending_height = 0.71;
  leaflet_radius[] = {1.365, 1.495, 1.38}; leaflet_angle[] = {61, 58.5, 60.5};
  bending_radius[] = {1.39, 1.355, 1.435}; bending_angle[] = {47.3, 43, 42.75};
  rotation[] = {0, 119.5, 238.5}; root_z = -1;
ElseIf (coapting)
  root_radius = 1.25; commissure_radius = 1.25; commissure_height = 1.75; attachment_width = 0.6; attachment_drop = 0.5;
  leaflet_height = commissure_height; rotation[] = {0, 120, 240}; root_z = 0;
Else
  root_radius = 1.25; leaflet_height = 1.2; bending_height = 0.6;
  leaflet_radius[] = {1.25, 1.25, 1.25}; leaflet_angle[] = {60, 60, 60};
  bending_radius[] = {1.275, 1.275, 1.275}; bending_angle[] = {35, 35, 35};
  rotation[] = {0, 120, 240}; root_z = -1.2;
EndIf
// The lengths of the tubes below and above the sinuses, and how far a sinus bulges beyond the attachment. At the sinotubular
// junction, above the sinuses, the root is as wide as at the commissures.
outflow_length = 0.5;
sinus_height = leaflet_height + 0.4;
sinus_depth = 0.5;
aorta_length = 0.8;

DefineConstant[ n_points = 72 ]; // number of points of a section
DefineConstant[ spacing = 0.1 ]; // distance between sections, from the root to the end of the sinuses
joint = 3;      // degrees on each side of a commissure, in which the wall changes from one cusp's radius to the next cusp's

Macro Section // makes a section at height z above the root
  // The point of the attachment at this height has the distance `radius` from the axis and the angle half_angle from the cusp's
  // middle (docs/theory/aortic.md). In these formulas, t is the parameter of the attachment.
  If (coapting)
    // The attachment is a cubic, whose height grows with t. Bisection finds t.
    low = 0; high = 1;
    For i In {1 : 40}
      t = (low + high) / 2;
      If (3 * (1 - t) * t^2 * (1 - attachment_drop) * commissure_height + t^3 * commissure_height < z)
        low = t;
      Else
        high = t;
      EndIf
    EndFor
    x = (1 - t)^3 * root_radius + 3 * (1 - t)^2 * t * root_radius + (3 * (1 - t) * t^2 + t^3) * commissure_radius / 2;
    y = 3 * (1 - t)^2 * t * attachment_width * root_radius + (3 * (1 - t) * t^2 + t^3) * commissure_radius * Sqrt(3) / 2;
    radius[] = {Hypot(x, y), Hypot(x, y), Hypot(x, y)};
    half_angle[] = {Max(Atan2(y, x) * 180 / Pi, 1e-6), Max(Atan2(y, x) * 180 / Pi, 1e-6), Max(Atan2(y, x) * 180 / Pi, 1e-6)};
  Else
    // The attachment is a parabola through the root, the end of the bending curve and the commissure.
    t = Min(1, Max(0, z / leaflet_height));
    s = bending_height / leaflet_height;
    For c In {0 : 2}
      end_x = leaflet_radius[c] * Cos(leaflet_angle[c] * Pi / 180);
      end_y = leaflet_radius[c] * Sin(leaflet_angle[c] * Pi / 180);
      bend_x = bending_radius[c] * Cos(bending_angle[c] * Pi / 180);
      bend_y = bending_radius[c] * Sin(bending_angle[c] * Pi / 180);
      middle_x = (bend_x - (1 - s)^2 * root_radius - s^2 * end_x) / (2 * s * (1 - s));
      middle_y = (bend_y - s^2 * end_y) / (2 * s * (1 - s));
      x = (1 - t)^2 * root_radius + 2 * t * (1 - t) * middle_x + t^2 * end_x;
      y = 2 * t * (1 - t) * middle_y + t^2 * end_y;
      radius[c] = Hypot(x, y);
      half_angle[c] = Max(Atan2(y, x) * 180 / Pi, 1e-6);
    EndFor
  EndIf
  bulge = sinus_depth * Sin(Pi * Min(1, Max(0, z / sinus_height))^0.65);

  points[] = {};
  For i In {0 : n_points - 1}
    angle = 360 * i / n_points;
    // The weighted mean of the cusps' radii. The bulge of the sinus is added to the mean radius. The weight of a cusp is 1 in the
    // cusp and falls to 0 towards the next cusp.
    sum = 0;
    weights = 0;
    sinus = 0;
    For c In {0 : 2}
      away = Fabs(angle - rotation[c]);
      away = Min(away, 360 - away);
      first = Min(half_angle[c], 60 - joint / 2);
      weight = Min(1, Max(0, 1 - (away - first) / (120 - 2 * first)));
      sum = sum + weight * radius[c];
      weights = weights + weight;
      sinus = sinus + bulge * half_angle[c] / 60 * (1 - Min(1, away / half_angle[c])^4)^2;
    EndFor
    r = sum / weights + sinus;
    p = newp;
    Point(p) = {r * Cos(angle * Pi / 180), r * Sin(angle * Pi / 180), root_z + z};
    points[] += p;
  EndFor
  curve = newl;
  BSpline(curve) = {points[], points[0]};
  curves[] += curve;
  section = newll;
  Curve Loop(section) = {curve};
  sections[] += section;
Return

z = -outflow_length;
Call Section;
n_sinus = Round(sinus_height / spacing);
For k In {0 : n_sinus}
  z = sinus_height * k / n_sinus;
  Call Section;
EndFor
z = sinus_height + aorta_length;
Call Section;
Ruled ThruSections(1) = sections[];
Recursive Delete { Curve{curves[]}; }
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Binary = 1;
