#include "kernel/segment/complex/vertex_pool.h"

#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

namespace oriel {

namespace {

/// Buckets are wider than the reach by this, so that most searches end in one.
constexpr double kBucket = 16;

}  // namespace

VertexPool::VertexPool(std::vector<Vertex> vertices, double reach_m) : reach_m_(reach_m) {
  append(vertices);
}

void VertexPool::append(std::span<const Vertex> vertices) {
  const std::size_t count = vertices_.size() + vertices.size();
  if (count > last_in_slot_.size()) widen(count);
  represented_by_.reserve(count);
  before_.reserve(count);
  for (const Vertex& vertex : vertices) {
    const auto earlier = find(vertex.point);
    const int v = static_cast<int>(vertices_.size());
    vertices_.push_back(vertex);
    represented_by_.push_back(earlier.value_or(v));
    before_.push_back(-1);
    if (!earlier) enter(v);
  }
}

std::size_t VertexPool::slot_of(const Bucket& bucket) const {
  std::uint64_t hash = 0;
  for (const std::int64_t number : bucket)
    hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15U + (hash >> 29U);
  return static_cast<std::size_t>(hash >> 32U) & (last_in_slot_.size() - 1);
}

void VertexPool::enter(int vertex) {
  int& last = last_in_slot_[slot_of(bucket_of(at(vertex)))];
  before_[static_cast<std::size_t>(vertex)] = std::exchange(last, vertex);
}

void VertexPool::widen(std::size_t vertices) {
  last_in_slot_.assign(std::bit_ceil(2 * vertices + 1), -1);
  for (int v = 0; v < std::ssize(vertices_); ++v)
    if (v >= std::ssize(represented_by_) || represented_by(v) == v) enter(v);
}

VertexPool::Bucket VertexPool::bucket_of(Vec3 point) const {
  const double width = kBucket * reach_m_;
  return {std::llround(std::floor(point.x / width)), std::llround(std::floor(point.y / width)),
          std::llround(std::floor(point.z / width))};
}

std::optional<int> VertexPool::find(Vec3 point) const {
  const Vec3 reach{reach_m_, reach_m_, reach_m_};
  const Bucket low = bucket_of(point - reach), high = bucket_of(point + reach);
  std::optional<int> nearest;
  double distance = reach_m_;
  const auto look_at = [&](int v) {
    const double gap = length(at(v) - point);
    if (gap > distance || (nearest && gap == distance && v > *nearest)) return;
    nearest = v;
    distance = gap;
  };
  for (std::int64_t x = low[0]; x <= high[0]; ++x)
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
      for (std::int64_t z = low[2]; z <= high[2]; ++z)
        for (int v = last_in_slot_[slot_of({x, y, z})]; v >= 0;
             v = before_[static_cast<std::size_t>(v)])
          look_at(v);
  return nearest;
}

int VertexPool::add(Vec3 point) {
  const int v = static_cast<int>(vertices_.size());
  if (vertices_.size() >= last_in_slot_.size()) widen(vertices_.size() + 1);
  vertices_.push_back({point, false});
  before_.push_back(-1);
  enter(v);
  return v;
}

}  // namespace oriel
