// SPDX-License-Identifier: Apache-2.0
// Makes a mesh of a sixth of the open trileaflet valve, half a cusp, in a straight tube. Lengths are in centimetres. The planes
// at 0 and 60 degrees are planes of symmetry. The tube is narrower than the attachment, so its wall cuts the cusp. The options
// are the options of bileaflet.geo, but only opening 1 is allowed.
SetFactory("OpenCASCADE");
DefineConstant[ fitted = 1 ];
DefineConstant[ size = 0.05 ];
DefineConstant[ band = 0.1 ];
DefineConstant[ far = 0.13 ];
DefineConstant[ opening = 1 ];
If (opening != 1)
  Error("trileaflet.geo: the opening is %g; it must be 1", opening);
  Abort;
EndIf

tube = 1.22; below = -2.2; above = 1.6;
Cylinder(1) = {0, 0, below, 0, 0, above - below, tube, Pi / 3};
fluid() = {1};

// docs/theory/trileaflet.md defines these curves. Here they have opening 1 and the default parameters.
R = 1.25; height = 1.2; share = 0.5; ratio = 0.8; expansion = 0.1;
edge_in = ratio * R; edge_out = (1 + expansion) * 1.25; edge_angle = Pi / 3;
bend_in = R + share * (edge_in - R); bend_out = (1 + share * expansion) * 1.275; bend_angle = 35 * Pi / 180;
edge_x = edge_out * Cos(edge_angle); edge_y = edge_out * Sin(edge_angle);
bend_x = bend_out * Cos(bend_angle); bend_y = bend_out * Sin(bend_angle); bend_z = share * height;
// The inner control points of two Bezier curves follow: one of the quadratic sinus curve, two of the cubic symmetry curve.
sinus_x = (bend_x - (1 - share)^2 * R - share^2 * edge_x) / (2 * share * (1 - share));
sinus_y = (bend_y - share^2 * edge_y) / (2 * share * (1 - share));
sinus_z = (bend_z - share^2 * height) / (2 * share * (1 - share));
first_x = (R + bend_in) / 2 - 0.22 * (R - bend_in);
first_z = bend_z / 2 - 0.35 * bend_z;
second_x = (bend_in - (1 - share)^3 * R - 3 * share * (1 - share)^2 * first_x - share^3 * edge_in) / (3 * share^2 * (1 - share));
second_z = (bend_z - 3 * share * (1 - share)^2 * first_z - share^3 * height) / (3 * share^2 * (1 - share));

// Each of the two patches is a smooth surface through points at equal steps of u and v. The free edge and the bending curve are
// parabolas in which y is proportional to u. So a point of the Coons patch differs only in x from the point on the straight line
// between sinus curve and symmetry curve. The variable `bow` holds this difference.
n_u = 8; n_v = 8;
leaf() = {};
For upper In {0:1}
  start = newp;
  For i In {0:n_v}
    // The lower patch begins a little above the root, because its corner at the root lies outside the tube.
    v = upper ? i / n_v : 0.03 + 0.97 * i / n_v;
    t = share * (upper + v);
    sym_x = (1 - t)^3 * R + 3 * t * (1 - t)^2 * first_x + 3 * t^2 * (1 - t) * second_x + t^3 * edge_in;
    sym_z = 3 * t * (1 - t)^2 * first_z + 3 * t^2 * (1 - t) * second_z + t^3 * height;
    sin_x = (1 - t)^2 * R + 2 * t * (1 - t) * sinus_x + t^2 * edge_x;
    sin_y = 2 * t * (1 - t) * sinus_y + t^2 * edge_y;
    sin_z = 2 * t * (1 - t) * sinus_z + t^2 * height;
    bow = (1 - v) * (upper ? bend_in - bend_x : 0) + v * (upper ? edge_in - edge_x : bend_in - bend_x);
    For j In {0:n_u}
      u = j / n_u;
      x = (1 - u) * sym_x + u * sin_x + bow * (u - u^2);
      Point(start + i * (n_u + 1) + j) = {x, u * sin_y, (1 - u) * sym_z + u * sin_z - height};
    EndFor
  EndFor
  lower[] = {}; higher[] = {}; middle[] = {}; outer[] = {}; inside[] = {};
  For j In {0:n_u}
    lower[] += start + j;
    higher[] += start + n_v * (n_u + 1) + j;
  EndFor
  For i In {0:n_v}
    middle[] += start + i * (n_u + 1);
    outer[] += start + i * (n_u + 1) + n_u;
  EndFor
  For i In {1:n_v - 1}
    For j In {1:n_u - 1}
      inside[] += start + i * (n_u + 1) + j;
    EndFor
  EndFor
  line = newl;
  If (upper)
    Spline(line + 1) = outer[];
    Spline(line + 2) = higher[];
    Spline(line + 3) = middle[];
    shared_0 = shared;
    Curve Loop(line + 4) = {shared_0, line + 1, -(line + 2), -(line + 3)};
  Else
    Spline(line) = lower[];
    Spline(line + 1) = outer[];
    Spline(line + 2) = higher[];
    Spline(line + 3) = middle[];
    shared = line + 2;
    Curve Loop(line + 4) = {line, line + 1, -(line + 2), -(line + 3)};
  EndIf
  patch = news;
  Surface(patch) = {line + 4} Using Point { inside[] };
  leaf() += patch;
EndFor

z_range() = {below, above};
plane_boxes() = {0, 0, below, tube * Cos(Pi / 3), tube * Sin(Pi / 3), above, 0, 0, below, tube, 0, above};
Include "fluid.geo";
