# SPDX-License-Identifier: Apache-2.0
# svMultiPhysics asks for all of VTK, and Debian's VTK then asks for Qt and more. These are the modules that it uses.
find_package(VTK CONFIG COMPONENTS CommonCore CommonDataModel FiltersGeometry IOXML)
