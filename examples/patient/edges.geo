// SPDX-License-Identifier: Apache-2.0
// Edge lengths from valve.dat, the file that riis size-field has written. Outside its grid edges are 5 mm long. With -setnumber
// uniform LENGTH, all edges have this length instead.
DefineConstant[ uniform = 0 ];
If (uniform)
  Mesh.MeshSizeMin = uniform;
  Mesh.MeshSizeMax = uniform;
Else
  Field[1] = Structured;
  Field[1].FileName = "valve.dat";
  Field[1].TextFormat = 1;
  Field[1].SetOutsideValue = 1;
  Field[1].OutsideValue = 5;
  Background Field = 1;
  Mesh.MeshSizeFromPoints = 0;
  Mesh.MeshSizeFromCurvature = 0;
EndIf
Mesh.MeshSizeExtendFromBoundary = 0;
