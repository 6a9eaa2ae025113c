#pragma once

#include "model/solid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace oriel {

/// The vertices of a cell complex. Points nearer than `reach_m` are one vertex, so that what
/// differs by rounding is the same.
class VertexPool {
 public:
  /// Vertices keep their indices; one near an earlier one is represented by it.
  VertexPool(std::vector<Vertex> vertices, double reach_m);

  /// Adds vertices with the next indices, each represented as in the constructor.
  void append(std::span<const Vertex> vertices);

  [[nodiscard]] double reach_m() const { return reach_m_; }
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  [[nodiscard]] Vec3 at(int vertex) const {
    return vertices_[static_cast<std::size_t>(vertex)].point;
  }
  /// The vertex that stands for this one of the constructor's, and of those appended.
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
  /// A cube in space.
  using Bucket = std::array<std::int64_t, 3>;
  [[nodiscard]] Bucket bucket_of(Vec3 point) const;
  /// Some buckets share a slot.
  [[nodiscard]] std::size_t slot_of(const Bucket& bucket) const;
  void enter(int vertex);
  /// Makes room for so many vertices, and enters those that are there anew.
  void widen(std::size_t vertices);

  std::vector<Vertex> vertices_;
  std::vector<int> represented_by_;
  double reach_m_;
  /// By slot the last vertex in it that stands for itself, and by vertex the one before; -1: none.
  std::vector<int> last_in_slot_{-1}, before_;
};

}  // namespace oriel
