# SPDX-License-Identifier: Apache-2.0
"""The view shows a valve in a mesh, which a person can place by hand.

riis.view.model has everything but the pictures: the valves, their placement, the marks, undo, the lights for faults, and
files for the rest of the project. It needs numpy only.

riis.view.scene draws a model by PyVista, also in a notebook. riis.view.page serves it to a browser: python -m riis view MESH
(docs/view.md). riis.view.guard says who may see that page.
"""
