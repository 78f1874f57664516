// SPDX-License-Identifier: Apache-2.0
// What is behind the public handles.
#pragma once

#include <riis/riis.h>

#include <memory>

#include "marking/mark_result.hpp"
#include "marking/mesh.hpp"
#include "surface/surface.hpp"
#include "valve/parameters.hpp"

struct riis_valve {
  riis::Valve valve;
};

struct riis_surface {
  std::unique_ptr<const riis::Surface> surface;
  riis_surface_options options;  // as completed
  double seconds_triangles, seconds_scene;
};

struct riis_mesh {
  riis::Mesh mesh;
};

struct riis_mark_result {
  riis::MarkResult result;
};
