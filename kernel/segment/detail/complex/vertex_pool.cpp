#include "kernel/segment/detail/complex/vertex_pool.h"

#include <cmath>
#include <utility>

namespace oriel::detail {

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
  return {std::llround(point.x / reach_m_), std::llround(point.y / reach_m_),
          std::llround(point.z / reach_m_)};
}

std::optional<int> VertexPool::find(Vec3 point) const {
  const Bucket middle = bucket_of(point);
  std::optional<int> nearest;
  double distance = reach_m_;
  for (int around = 0; around < 27; ++around) {
    const auto bucket = buckets_.find(
        {middle[0] + around % 3 - 1, middle[1] + around / 3 % 3 - 1, middle[2] + around / 9 - 1});
    if (bucket == buckets_.end()) continue;
    for (const int v : bucket->second) {
      const double gap = length(at(v) - point);
      if (gap > distance || (nearest && gap == distance && v > *nearest)) continue;
      nearest = v;
      distance = gap;
    }
  }
  return nearest;
}

int VertexPool::add(Vec3 point) {
  const int v = static_cast<int>(vertices_.size());
  vertices_.push_back({point, false});
  buckets_[bucket_of(point)].push_back(v);
  return v;
}

}  // namespace oriel::detail
