// SPDX-License-Identifier: Apache-2.0
// trileaflet.geo and cusps.geo include this file. It makes the tube of a sixth of the valve, and the two patches of half a cusp.
// Each patch is a smooth surface through its points. It reads tube, the tube's radius, and its ends below and above. xyz has the
// points of the lower and then of the upper patch, row by row, with n_v steps between rows and n_u steps in a row.
Cylinder(1) = {0, 0, below, 0, 0, above - below, tube, Pi / 3};
fluid() = {1};

leaf() = {};
For upper In {0:1}
  start = newp;
  first = 3 * upper * (n_v + 1) * (n_u + 1);
  For k In {0:(n_v + 1) * (n_u + 1) - 1}
    Point(start + k) = {xyz[first + 3 * k], xyz[first + 3 * k + 1], xyz[first + 3 * k + 2]};
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
