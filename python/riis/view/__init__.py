# SPDX-License-Identifier: Apache-2.0
"""The view shows a valve in a mesh, which a person can place by hand.

riis.view.model contains everything except the pictures: the valves, their placement, the marks, undo, the lights for faults, and
files for other programs. This module needs only numpy.

riis.view.scene draws a model by PyVista, also in a notebook. riis.view.page serves the model to a browser: python -m riis view
MESH (docs/view.md). riis.view.guard decides who may see this page.
"""
