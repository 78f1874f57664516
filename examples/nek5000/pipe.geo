// SPDX-License-Identifier: Apache-2.0
// A pipe of radius 1.25 cm about the z axis: a square of n x n elements, m rings around it, nz layers. Nek takes hexahedra of 20
// points.
DefineConstant[ n = 3, m = 2, nz = 12, z0 = -2, z1 = 4 ];
R = 1.25; a = 0.54;
Point(1) = {0, 0, z0};
For i In {0:3}
  t = Pi/4 + i*Pi/2;
  Point(2+i)  = {a*Sqrt(2)*Cos(t), a*Sqrt(2)*Sin(t), z0};
  Point(12+i) = {R*Cos(t), R*Sin(t), z0};
EndFor
For i In {0:3}
  j = (i+1)%4;
  Line(1+i) = {2+i, 2+j};
  Circle(11+i) = {12+i, 1, 12+j};
  Line(21+i) = {2+i, 12+i};
EndFor
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
For i In {0:3}
  j = (i+1)%4;
  Curve Loop(2+i) = {21+i, 11+i, -(21+j), -(1+i)}; Plane Surface(2+i) = {2+i};
EndFor
Transfinite Curve {1:4, 11:14} = n+1;
Transfinite Curve {21:24} = m+1;
Transfinite Surface {1:5}; Recombine Surface {1:5};
s[] = {}; v[] = {}; top[] = {};
For i In {1:5}
  o[] = Extrude {0, 0, z1-z0} { Surface{i}; Layers{nz}; Recombine; };
  top[] += o[0]; v[] += o[1];
  If (i > 1)
    s[] += o[3];
  EndIf
EndFor
Physical Surface("in", 1) = {1:5};
Physical Surface("out", 2) = {top[]};
Physical Surface("wall", 3) = {s[]};
Physical Volume("fluid", 4) = {v[]};
Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1; Mesh.MshFileVersion = 2.2;
