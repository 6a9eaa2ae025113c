#include "kernel/solidify/soup/soup_builder.h"

#include "kernel/base/index.h"

#include <algorithm>

namespace oriel::detail {

SoupBuilder::SoupBuilder(const Soup& like) : place_(like.points.size(), -1) {
  soup_.grid_m = like.grid_m;
  soup_.points = like.points;
}

void SoupBuilder::begin_polygon(const SoupPolygon& said) {
  close_polygon();
  soup_.polygons.push_back(said);
  is_begun_ = true;
}

void SoupBuilder::add_ring(std::span<const int> ring) {
  for (const int v : ring) {
    const int place = place_[at(v)];
    if (place >= 0) {
      const auto loop = std::span<const int>(path_).subspan(at(place));
      if (loop.size() >= 3) append(loop);
      for (const int w : loop) place_[at(w)] = -1;
      path_.resize(at(place));
    }
    place_[at(v)] = static_cast<int>(path_.size());
    path_.push_back(v);
  }
  if (path_.size() >= 3) append(path_);
  for (const int v : path_) place_[at(v)] = -1;
  path_.clear();
}

void SoupBuilder::add_polygon(const Soup& from, int polygon, bool is_turned) {
  begin_polygon(from.polygons[at(polygon)]);
  for (const int r : from.rings_of(polygon)) {
    append(from.ring(r));
    if (is_turned)
      std::reverse(soup_.corners.begin() + soup_.first_corner[at(soup_.ring_count() - 1)] + 1,
                   soup_.corners.end());
  }
}

Soup SoupBuilder::finish() {
  close_polygon();
  return std::move(soup_);
}

void SoupBuilder::close_polygon() {
  if (!is_begun_) return;
  is_begun_ = false;
  if (soup_.ring_count() == soup_.first_ring.back())
    soup_.polygons.pop_back();
  else
    soup_.first_ring.push_back(soup_.ring_count());
}

void SoupBuilder::append(std::span<const int> simple_ring) {
  const auto begin =
      soup_.corners.insert(soup_.corners.end(), simple_ring.begin(), simple_ring.end());
  std::rotate(begin, std::min_element(begin, soup_.corners.end()), soup_.corners.end());
  soup_.first_corner.push_back(static_cast<int>(soup_.corners.size()));
}

}  // namespace oriel::detail
