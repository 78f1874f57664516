# SPDX-License-Identifier: Apache-2.0
"""gui.py: what ./run paraview shows in ParaView's window. At the end it writes the file READY to RIIS_PARAVIEW_OUT."""

import os

from paraview import simple as pv

FOLDER = os.environ["RIIS_PARAVIEW_OUT"]
pv.LoadPlugin(os.environ["RIIS_PARAVIEW_PLUGIN"], remote=False, ns=vars(pv))
mesh = pv.XMLUnstructuredGridReader(FileName=[os.path.join(FOLDER, "draw.vtu")])
valve = pv.HeartValve(Kind="mitral", Motion="heartbeat by four times")
marked = pv.MarkByValve(Mesh=mesh, Valve=valve)
view = pv.GetActiveViewOrCreate("RenderView")
band = pv.Threshold(Input=marked, Scalars=["POINTS", "riis_marked"])
band.LowerThreshold = band.UpperThreshold = 1
shown = pv.Show(band, view)
pv.ColorBy(shown, ("POINTS", "riis_leaflet"))
pv.Show(valve, view)
pv.Hide(mesh, view)
scene = pv.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = 0.14
pv.SetActiveSource(valve)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [5, -7, 6], [0, 0, -0.4], [0, 0, 1]
pv.Render(view)
with open(os.path.join(FOLDER, "READY"), "w", encoding="ascii") as file:
    file.write("ready\n")
