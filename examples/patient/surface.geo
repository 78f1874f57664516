// SPDX-License-Identifier: Apache-2.0
// Makes the surface root.stl anew, with triangles of the edge lengths that edges.geo gives:
// gmsh -2 -nt 1 -format msh2 -o surface.msh surface.geo edges.geo
// The wall and its flat ends meet at more than 40 degrees. Across smaller angles a triangle may cover several of the old ones.
Merge "root.stl";
ClassifySurfaces{40 * Pi / 180, 1, 1, Pi};
CreateGeometry;
