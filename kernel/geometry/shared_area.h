#pragma once

#include "kernel/geometry/planar.h"
#include "model/vec3.h"

#include <span>

namespace oriel {

/// The area that two figures of one plane share; each is given by its outlines, the outer ones all
/// one way round about the unit normal, holes the other way, and no piece of it lies on another.
double shared_area_m2(std::span<const Outline> one, std::span<const Outline> other, Vec3 normal);

/// The area of one such figure.
double figure_area_m2(std::span<const Outline> figure, Vec3 normal);

}  // namespace oriel
