#pragma once

#include "model/solid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace oriel {

/// The vertices of a cell complex. Points nearer than `reach_m` are one vertex, so that what
/// differs by rounding is the same.
class VertexPool {
 public:
  /// Vertices keep their indices; one near an earlier one is represented by it.
  VertexPool(std::vector<Vertex> vertices, double reach_m);

  [[nodiscard]] double reach_m() const { return reach_m_; }
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  [[nodiscard]] Vec3 at(int vertex) const {
    return vertices_[static_cast<std::size_t>(vertex)].point;
  }
  /// The vertex that stands for this one of the constructor's.
  [[nodiscard]] int represented_by(int vertex) const {
    return represented_by_[static_cast<std::size_t>(vertex)];
  }

  /// The vertex nearest to a point, if one is within reach.
  [[nodiscard]] std::optional<int> find(Vec3 point) const;
  /// A new vertex, whatever is near.
  int add(Vec3 point);
  int find_or_add(Vec3 point) {
    const auto found = find(point);
    return found ? *found : add(point);
  }

  std::vector<Vertex> take() { return std::move(vertices_); }

 private:
  using Bucket = std::array<std::int64_t, 3>;
  struct BucketHash {
    std::size_t operator()(const Bucket& bucket) const;
  };
  [[nodiscard]] Bucket bucket_of(Vec3 point) const;

  std::vector<Vertex> vertices_;
  std::vector<int> represented_by_;
  double reach_m_;
  /// Cubes in space, with the vertices in them that stand for themselves.
  std::unordered_map<Bucket, std::vector<int>, BucketHash> buckets_;
};

}  // namespace oriel
