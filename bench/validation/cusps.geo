// SPDX-License-Identifier: Apache-2.0
// Makes a mesh of a sixth of a valve with three equal cusps, half a cusp, in a straight tube. Lengths are in centimetres. The
// points of validation_points stand before this text. The planes at 0 and 60 degrees are planes of symmetry. The tube is narrower
// than the attachment, so its wall cuts the cusp. The options are the options of bileaflet.geo.
SetFactory("OpenCASCADE");
DefineConstant[ fitted = 1 ];
DefineConstant[ size = 0.05 ];
DefineConstant[ band = 0.1 ];
DefineConstant[ far = 0.13 ];

tube = 1.24; below = -1; above = 3.35;
Include "patches.geo";
Include "fluid.geo";
