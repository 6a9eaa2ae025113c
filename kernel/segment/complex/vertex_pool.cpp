#include "kernel/segment/complex/vertex_pool.h"

#include <cmath>
#include <utility>

namespace oriel {

namespace {

/// Buckets are wider than the reach by this, so that most searches end in one.
constexpr double kBucket = 16;

}  // namespace

VertexPool::VertexPool(std::vector<Vertex> vertices, double reach_m)
    : vertices_(std::move(vertices)), reach_m_(reach_m) {
  represented_by_.reserve(vertices_.size());
  for (int v = 0; v < std::ssize(vertices_); ++v) {
    const auto earlier = find(at(v));
    represented_by_.push_back(earlier.value_or(v));
    if (!earlier) buckets_[bucket_of(at(v))].push_back(v);
  }
}

std::size_t VertexPool::BucketHash::operator()(const Bucket& bucket) const {
  std::uint64_t hash = 0;
  for (const std::int64_t number : bucket)
    hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15U + (hash >> 29U);
  return hash;
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
        if (const auto bucket = buckets_.find({x, y, z}); bucket != buckets_.end())
          for (const int v : bucket->second) look_at(v);
  return nearest;
}

int VertexPool::add(Vec3 point) {
  const int v = static_cast<int>(vertices_.size());
  vertices_.push_back({point, false});
  buckets_[bucket_of(point)].push_back(v);
  return v;
}

}  // namespace oriel
