# SPDX-License-Identifier: Apache-2.0
# svMultiPhysics requests all of VTK, and Debian's VTK then requests Qt and more. These are the modules of VTK that the solver
# uses.
find_package(VTK CONFIG COMPONENTS CommonCore CommonDataModel FiltersGeometry IOXML)
