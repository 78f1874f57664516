# SPDX-License-Identifier: Apache-2.0
"""Lets Debian 12's ParaView 5.11.0 load plug-ins in Python.

This ParaView imports inspect.getargspec, which Python 3.11 lacks. Python reads this file at its start if the file is in a folder
of PYTHONPATH. Later versions of ParaView do not need this file.
"""

import inspect

if not hasattr(inspect, "getargspec"):
    inspect.getargspec = inspect.getfullargspec
