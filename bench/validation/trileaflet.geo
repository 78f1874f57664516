// SPDX-License-Identifier: Apache-2.0
// Makes a mesh of a sixth of the open trileaflet valve, half a cusp, in a straight tube. Lengths are in centimetres. The planes
// at 0 and 60 degrees are planes of symmetry. The tube is narrower than the attachment, so its wall cuts the cusp. The options
// are the options of bileaflet.geo.
SetFactory("OpenCASCADE");
DefineConstant[ fitted = 1 ];
DefineConstant[ size = 0.05 ];
DefineConstant[ band = 0.1 ];
DefineConstant[ far = 0.13 ];
DefineConstant[ opening = 1 ];

tube = 1.22; below = -2.2; above = 1.6;

// docs/theory/trileaflet.md and docs/theory/aortic.md define these curves. The parameters have their defaults. edge_x, edge_y,
// bend_x and bend_y are the control points of the free edge and of the bending curve. They are blended between the closed state
// and the open state.
R = 1.25; height = 1.2; share = 0.5; ratio = 0.8; expansion = 0.1;
edge_x[] = {0, 0, 0, 0}; edge_y[] = {0, 0, 0, 0}; bend_x[] = {0, 0, 0, 0}; bend_y[] = {0, 0, 0, 0};
For state In {0:1}
  weight = state ? opening : 1 - opening;
  For curve In {0:1}
    // The profile of a curve runs from the radius `in` at the symmetry plane to the radius `out` at `angle`.
    part = curve ? 1 : share;
    in = state ? R + part * (ratio * R - R) : (curve ? 0 : 0.4);
    out = (1 + state * part * expansion) * (curve ? 1.25 : 1.275);
    angle = (curve ? 60 : 35) * Pi / 180;
    power = state ? 2 : (curve ? 1 : 1.8);
    tangent = (state || curve) ? out * Sin(angle) / 3 : 0.25;
    slope = (out * Cos(angle) - in) / (out * Sin(angle));
    x[] = {in, in + (power > 1 ? 0 : tangent * slope), out * Cos(angle) - tangent * power * slope, out * Cos(angle)};
    y[] = {0, tangent, out * Sin(angle) - tangent, out * Sin(angle)};
    For k In {0:3}
      If (curve)
        edge_x[k] += weight * x[k];
        edge_y[k] += weight * y[k];
      Else
        bend_x[k] += weight * x[k];
        bend_y[k] += weight * y[k];
      EndIf
    EndFor
  EndFor
EndFor
bend_z = share * height;

// The inner control points of two Bezier curves follow: one of the quadratic sinus curve, two of the cubic symmetry curve.
sinus_x = (bend_x[3] - (1 - share)^2 * R - share^2 * edge_x[3]) / (2 * share * (1 - share));
sinus_y = (bend_y[3] - share^2 * edge_y[3]) / (2 * share * (1 - share));
sinus_z = (bend_z - share^2 * height) / (2 * share * (1 - share));
first_x = (R + bend_x[0]) / 2 - 0.22 * (R - bend_x[0]);
first_z = bend_z / 2 - 0.35 * bend_z;
second_x = (bend_x[0] - (1 - share)^3 * R - 3 * share * (1 - share)^2 * first_x - share^3 * edge_x[0]);
second_x = second_x / (3 * share^2 * (1 - share));
second_z = (bend_z - 3 * share * (1 - share)^2 * first_z - share^3 * height) / (3 * share^2 * (1 - share));

// The points of both patches have equal steps of u and v. A point of the Coons patch lies beside the straight line between sinus
// curve and symmetry curve. The variables `bow` hold the difference.
n_u = 8; n_v = 8;
xyz[] = {};
For upper In {0:1}
  For i In {0:n_v}
    // The lower patch begins a little above the root, because its corner at the root lies outside the tube.
    v = upper ? i / n_v : 0.03 + 0.97 * i / n_v;
    t = share * (upper + v);
    sym_x = (1 - t)^3 * R + 3 * t * (1 - t)^2 * first_x + 3 * t^2 * (1 - t) * second_x + t^3 * edge_x[0];
    sym_z = 3 * t * (1 - t)^2 * first_z + 3 * t^2 * (1 - t) * second_z + t^3 * height;
    sin_x = (1 - t)^2 * R + 2 * t * (1 - t) * sinus_x + t^2 * edge_x[3];
    sin_y = 2 * t * (1 - t) * sinus_y + t^2 * edge_y[3];
    sin_z = 2 * t * (1 - t) * sinus_z + t^2 * height;
    For j In {0:n_u}
      u = j / n_u;
      bow_x = 0; bow_y = 0;
      For k In {0:3}
        factor = (1 - u)^(3 - k) * u^k * (k % 3 ? 3 : 1) - (k == 0 ? 1 - u : 0) - (k == 3 ? u : 0);
        bow_x += factor * ((upper ? 1 - v : v) * bend_x[k] + (upper ? v : 0) * edge_x[k]);
        bow_y += factor * ((upper ? 1 - v : v) * bend_y[k] + (upper ? v : 0) * edge_y[k]);
      EndFor
      xyz[] += {(1 - u) * sym_x + u * sin_x + bow_x, u * sin_y + bow_y, (1 - u) * sym_z + u * sin_z - height};
    EndFor
  EndFor
EndFor

Include "patches.geo";
Include "fluid.geo";
