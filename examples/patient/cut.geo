// SPDX-License-Identifier: Apache-2.0
// Draws the inside of a mesh of the patient's root, cut along the root's axis, and ends:
// xvfb-run -a gmsh -setstring picture PICTURE.png MESH.vtk cut.geo
DefineConstant[ picture = {"cut.png"} ];
// The plane a x + b y + c z + d = 0 contains the axis. Cells are drawn on the side where the sum is above 0.
General.Clip0A = 0.8779;
General.Clip0B = 0.0878;
General.Clip0C = 0.4707;
General.Clip0D = 537.6180;
Mesh.Clip = 1;
General.ClipWholeElements = 1;
// The view is along the plane's normal, with the aorta above.
General.Trackball = 1;
General.TrackballQuaternion0 = 0.7125;
General.TrackballQuaternion1 = -0.4772;
General.TrackballQuaternion2 = -0.3968;
General.TrackballQuaternion3 = 0.3274;
General.GraphicsWidth = 800;
General.GraphicsHeight = 900;
General.SmallAxes = 0;
Mesh.ColorCarousel = 0;
Mesh.Color.Tetrahedra = {175, 200, 225};
Mesh.VolumeEdges = 1;
Mesh.VolumeFaces = 1;
Mesh.SurfaceEdges = 0;
Mesh.SurfaceFaces = 0;
Print Sprintf(picture);
Exit;
