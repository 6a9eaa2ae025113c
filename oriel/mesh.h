#pragma once

/// From solids to half-edge meshes and back (to_mesh, to_solid), and what is measured on meshes:
/// sizes, feature edges, normals, distances; collapse_edges for comparison.
#include "kernel/mesh/collapse.h"
#include "kernel/mesh/measures.h"
#include "kernel/mesh/mesh.h"
