#pragma once

#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/solid.h"

#include <span>
#include <vector>

namespace oriel {

/// The rings of an input polygon as outlines, the outer one first, on a grid of `grid_m`
/// (exact::on_grid): the solid's, so that they meet its facets, and so that the format a building
/// was read from leaves no trace in what is measured on them.
std::vector<Outline> outlines_of(const Building& building, const Polygon& polygon, double grid_m);

/// The same as they are in the file, on no grid.
std::vector<Outline> outlines_of(const Building& building, const Polygon& polygon);

/// The points of loops, as of a facet.
std::vector<Outline> outlines_of(std::span<const Vertex> vertices, const std::vector<Loop>& loops);

/// A half-space: what lies behind a plane.
struct HalfSpaceM {
  Vec3 normal;
  double offset_m = 0;
};

/// The area of the part of a facet that lies behind all `limits`; the facet may have any shape.
double area_within(std::span<const Vertex> vertices, const Facet& facet, Vec3 normal,
                   const std::vector<HalfSpaceM>& limits);

}  // namespace oriel
