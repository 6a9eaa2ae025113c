#pragma once

#include "kernel/solidify/crossings/faces.h"

namespace oriel::detail {

/// Adds the faces that a polygon encloses once its rings, which may cross each other, and the edges
/// on it are cut where they meet: each as often as the rings wind round it, turned round where they
/// wind clockwise. So what is added has the boundary that the rings have, whatever they do: the
/// part of a hole that reaches beyond its outer ring is a face that looks the other way. True if
/// that is anything else than the rings as they are. They are added as they are if the faces' area
/// differs from the rings' by more than `slack` (grid units squared), as something did not meet.
/// The builder is like `soup`.
bool add_signed_faces(const Soup& soup, const PolygonShape& shape, const CutPolygon& cut,
                      double slack, SoupBuilder& builder);

}  // namespace oriel::detail
