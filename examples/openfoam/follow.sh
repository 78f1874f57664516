# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# The cases of ./run openfoam whose mesh moves, and those of the angle law. openfoam.sh sources this file.

# The mesh swings about an axis while it moves along a line, or it moves steadily.
of_swing='{ swing { solidBodyMotionFunction oscillatingRotatingMotion; origin (0 0 0.003); amplitude (25 0 0); omega 200; }
  along { solidBodyMotionFunction oscillatingLinearMotion; amplitude (0.001 0.002 0.003); omega 300; } }'
of_steady='{ along { solidBodyMotionFunction linearMotion; velocity (0.1 0.2 0.3); } }'

# of_box NAME: makes a closed box of cubes in which a valve opens from 0.3. Eight steps, of which all are written. The ball
# upstream lies at the end of the box. A ball that does not follow would lie outside a mesh that has moved.
of_box() {
  of_moving "$1" hexahedra-28 "$(of_band 28)" "${2:-riisSource}" 0.3 && of_closed "$1" &&
    of_set "$1" system/fvOptions aorticValve/writeLeaflets yes &&
    of_set "$1" system/controlDict endTime 0.008 writeInterval 1 &&
    cp "$openfoam_here/case/system/valveTable" "$of_cases/$1/system" &&
    of_set "$1" system/valveTable valve/upstream '{ centre (0 0 -0.016); radius 0.0012; }'
}

# of_moves NAME MOTION: lets the mesh of a closed box move as a rigid body.
of_moves() {
  cat >"$of_cases/$1/constant/dynamicMeshDict" <<END
FoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolver solidBody;
solidBodyMotionFunction multiMotion;
multiMotionCoeffs $2
END
  of_set "$1" 0/U boundaryField '{ ".*" { type movingWallVelocity; value uniform (0 0 0); } }' &&
    of_set "$1" system/fvSolution PIMPLE/correctPhi no
}

# of_follows NAME ENTRY: the placement follows the points of an entry, such as 'patch wall;'.
of_follows() {
  of_set "$1" system/fvOptions aorticValve/placement "{ scale 0.01; follow { $2 } }"
}

# of_warps NAME: gives the valve a warp whose landmarks follow the wall. At rest the warp is the identity.
of_warps() {
  foamDictionary "$of_cases/$1/system/fvOptions" -entry aorticValve/warp -add "{ sources ((0.0115 0 -0.006) (0 0.0115 -0.004)
    (-0.0115 0 -0.006) (0 -0.0115 -0.004) (0.008 0.008 0.004) (-0.008 -0.008 0.004)); follow { patch wall; } }" >/dev/null
}

# of_zone NAME: makes a zone of the faces of the wall below the valve.
of_zone() {
  cat >"$of_cases/$1/system/topoSetDict" <<'END'
FoamFile { version 2.0; format ascii; class dictionary; object topoSetDict; }
actions
(
    { name low; type faceSet; action new; source boxToFace; box (-1 -1 -0.012) (1 1 -0.008); }
    { name low; type faceZoneSet; action new; source setToFaceZone; faceSet low; }
);
END
  of_logged "$1" topoSet topoSet -case "$of_cases/$1"
}

# of_deforms NAME: deforms the mesh. The points of the inlet swing, and the points of the outlet do not move. Some landmarks of
# the valve follow the wall: the nadirs, and a point near each attachment. The landmarks are in a file, because foamDictionary
# would keep only six digits.
of_deforms() {
  local folder=$of_cases/$1 name
  of_moving "$1" hexahedra-28 "$(of_band 28)" riisSource 0.3 &&
    of_set "$1" system/fvOptions aorticValve/writeLeaflets yes &&
    of_set "$1" system/controlDict endTime 0.008 writeInterval 1 &&
    of_set "$1" 0/U boundaryField/wall '{ type movingWallVelocity; value uniform (0 0 0); }' &&
    of_set "$1" system/fvSolution PIMPLE/correctPhi no || return
  for name in cellDisplacement cellDisplacementFinal; do
    foamDictionary "$folder/system/fvSolution" -entry "solvers/$name" \
      -add '{ solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; }' >/dev/null || return
  done
  cat >"$folder/constant/dynamicMeshDict" <<'END'
FoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs ("libfvMotionSolvers.so");
motionSolver displacementLaplacian;
displacementLaplacianCoeffs { diffusivity uniform; }
END
  cat >"$folder/0/pointDisplacement" <<'END'
FoamFile { version 2.0; format ascii; class pointVectorField; object pointDisplacement; }
dimensions [0 1 0 0 0 0 0];
internalField uniform (0 0 0);
boundaryField
{
    inlet { type oscillatingDisplacement; amplitude (0.001 0.0005 0.003); omega 200; value uniform (0 0 0); }
    outlet { type fixedValue; value uniform (0 0 0); }
    wall { type zeroGradient; }
}
END
  cat >"$folder/system/warp" <<'END'
warp
{
    sources
    (
        (0.0125 0 -0.012) (-0.00625 0.010825317547 -0.012) (-0.00625 -0.010825317547 -0.012)
        (0.01060091 0.00742283 -0.006) (-0.011728814348 0.0054692423632 -0.006) (0.001127904348 -0.012892072363 -0.006)
    );
    follow { patch wall; }
}
END
  sed -i 's/^ *rho .*/&\n    #include "warp"/' "$folder/system/fvOptions"
}

openfoam_follow() {
  local ranks what
  of_box follow-rest && of_run follow-rest 1 || return
  for ranks in 1 2; do
    of_box "follow-patch-$ranks" && of_moves "follow-patch-$ranks" "$of_swing" &&
      of_follows "follow-patch-$ranks" 'patch wall;' && of_run "follow-patch-$ranks" "$ranks" &&
      of_box "follow-warp-$ranks" && of_moves "follow-warp-$ranks" "$of_swing" && of_warps "follow-warp-$ranks" &&
      of_run "follow-warp-$ranks" "$ranks" || return
  done
  of_box follow-zone && of_moves follow-zone "$of_swing" && of_zone follow-zone && of_follows follow-zone 'faceZone low;' &&
    of_run follow-zone 2 &&
    of_box follow-points && of_moves follow-points "$of_swing" && of_follows follow-points 'points (5 12000 700 90);' &&
    of_run follow-points 2 &&
    of_box follow-steady && of_moves follow-steady "$of_steady" && of_follows follow-steady 'patch wall;' &&
    of_set follow-steady 0/U internalField 'uniform (0.1 0.2 0.3)' && of_run follow-steady 1 &&
    of_deforms follow-deform && of_run follow-deform 2 || return
  # The restarts begin in the middle of the swing.
  for what in patch warp; do
    of_copy "follow-$what-2" "follow-$what-restart" && of_go_on "follow-$what-restart" 0.004 0.008 || return
  done
}

# Runs a valve by the angle law until it is open, and restarts it while it opens. The gains are those of Korakianitis and Shi
# for the aortic valve, in SI units. The gain of the pressure is halved, so that the valve opens in some steps.
openfoam_angle() {
  of_case angle && of_set angle system/controlDict endTime 0.03 deltaT 1e-3 writeInterval 1 &&
    of_set angle 0/p boundaryField/inlet/p0 'table ((0 0) (0.006 0.5) (1 0.5))' &&
    of_set angle system/fvOptions aorticValve/opening '{ law angle; pressureGain 20; flowGain 2e6; friction 50; vortexGain 7e6;
      angleMin 5; angleMax 75; upstream { centre (0 0 -0.015); radius 0.003; } downstream { centre (0 0 0.012); radius 0.003; }
      flowPatch outlet; }' && of_run angle 2 &&
    of_copy angle angle-restart && of_go_on angle-restart 0.015 0.02
}

# of_bad_follow TEXT NAME ENTRY WORDS: checks that a placement that follows ENTRY is refused with the words.
of_bad_follow() { of_bad "$2" && of_follows "$2" "$3" && of_refused "$1" "$2" "$4"; }

# of_bad_warp TEXT NAME ENTRIES WORDS: checks that a warp with five landmarks and ENTRIES is refused with the words.
of_bad_warp() {
  local five='(0.011 0 0) (0 0.011 0) (-0.011 0 0) (0 -0.011 0) (0 0 0.006)'
  of_bad "$2" &&
    foamDictionary "$of_cases/$2/system/fvOptions" -entry aorticValve/warp -add "{ sources ($five); $3 }" >/dev/null &&
    of_refused "$1" "$2" "$4"
}

# of_bad_angle TEXT NAME ENTRIES WORDS: checks that an angle law with ENTRIES is refused with the words.
of_bad_angle() {
  of_bad "$2" &&
    of_set "$2" system/fvOptions aorticValve/opening "{ law angle; flowGain 2e6; friction 50; vortexGain 7e6; $3
      upstream { centre (0 0 -0.015); radius 0.003; } downstream { centre (0 0 0.012); radius 0.003; } flowPatch outlet; }" &&
    of_refused "$1" "$2" "$4"
}

openfoam_follow_refusals() {
  local line='(0.01 0 0) (0 0 0) (-0.01 0 0)'
  of_bad_follow "an unknown patch to follow" bad-patch 'patch ring;' "patch is 'ring', and the mesh has no such patch" &&
    of_bad_follow "an unknown zone to follow" bad-zone 'faceZone ring;' "faceZone is 'ring', and the mesh has no such zone" &&
    of_bad_follow "an unknown point to follow" bad-label 'points (1 2 99999999);' \
      'points has 99999999, and the mesh has no such point' &&
    of_bad_follow "a point to follow twice" bad-twice 'points (1 2 2 3);' 'points has 2 twice' &&
    of_bad_follow "two points to follow" bad-two 'points (1 2);' \
      'the valve follows 2 points, and needs at least 3 that do not lie on a line' &&
    of_bad_follow "a patch and points to follow" bad-both 'patch wall; points (1 2 3);' \
      'follow has 2 of the keys patch, faceZone and points, and needs one' &&
    of_bad_follow "nothing to follow" bad-nothing '' 'follow has 0 of the keys patch, faceZone and points, and needs one' &&
    of_bad_follow "an unknown key of follow" bad-key 'pointZone ring;' "unknown key 'pointZone'" &&
    of_bad_warp "an unknown key of the warp" warp-key 'target (1 2 3);' "unknown key 'target'" &&
    of_bad_warp "landmarks without targets" warp-targets "targets ($line);" \
      'targets.n_points is 3, but the warp has 5 landmarks' &&
    of_bad_warp "landmarks on a line" warp-line "sources ($line);" 'sources: all 3 landmarks lie on a line' &&
    of_bad_warp "a negative noise" warp-noise 'noise -1;' 'RIIS_INVALID_ARGUMENT: options.noise is -1' &&
    of_bad_warp "fewer points than landmarks" warp-points 'follow { points (1 2 3); }' \
      'points has 3 points, and the warp has 5 landmarks' &&
    of_bad_warp "a warp that turns the valve over" warp-folds \
      'targets ((0.011 0 0) (0 0.011 0) (-0.011 0 0) (0 -0.011 0) (0 0 -0.006));' 'the warp folds near landmark 0' &&
    of_bad warp-placement && of_follows warp-placement 'patch wall;' && of_warps warp-placement &&
    of_refused "a warp and a placement that follow" warp-placement \
      'the warp of valve aorticValve follows the mesh, and its placement does too' &&
    of_bad warp-rigid && of_warps warp-rigid && of_set warp-rigid system/fvOptions aorticValve/valve '{ kind bileaflet; }' &&
    of_refused "a warp of a bileaflet valve" warp-rigid 'RIIS_INVALID_PARAMETER: the bileaflet valve cannot be warped' &&
    of_bad_angle "an angle law without a gain" angle-gain '' "Entry 'pressureGain' not found in dictionary" &&
    of_bad_angle "an angle above 90 degrees" angle-most 'pressureGain 40; angleMax 100;' \
      'RIIS_INVALID_ARGUMENT: law.angle_max is 100' &&
    of_bad_angle "an unknown key of the angle law" angle-key 'pressureGain 40; filterSeconds 1;' "unknown key 'filterSeconds'"
}
