#pragma once

#include "io/cityjson/cityjson_source.h"
#include "model/building.h"
#include "model/solid.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// A solid that goes into a file, and its frame.
struct PlacedSolid {
  const Solid* solid = nullptr;
  const Frame* frame = nullptr;
};

/// `number` × 10^-digits, rounded once: 0.001 and 1 give the double nearest to 0.0001.
double scaled_down(double number, int digits);

/// The transform with a scale finer by powers of ten.
Transform finer(const Transform& transform, int digits);

/// The integers that stand for a local point in a file, and the local point that they stand for.
std::array<std::int64_t, 3> rounded(Vec3 local, const Frame& frame, const Transform& transform);
Vec3 local_point(const std::array<std::int64_t, 3>& key, const Frame& frame,
                 const Transform& transform);

/// By how many powers of ten the scale of a file gets finer where geometries are exchanged: as few
/// as make it no coarser than 1 mm. It does not depend on the geometries, so that what becomes of
/// one is the same whatever else is in the file.
int finer_digits(const Transform& transform);

/// The vertices of a CityJSON file while geometries are exchanged.
class FileVertices {
 public:
  /// `vertices` is the text of the array that is there; every whole number in it becomes 10^digits
  /// times as large, exactly.
  FileVertices(std::string_view vertices, const Transform& transform, int digits);

  /// The file's vertex at each vertex of `solid`; vertices that are not there yet are added.
  std::vector<int> add(const PlacedSolid& solid);

  /// Marks the vertices that the CityObject `object` uses.
  void mark_used(std::string_view object);
  /// Closes the marking: numbers the vertices that are used in their old order.
  void renumber();
  /// `object` with the new numbers in all its boundaries.
  [[nodiscard]] std::string renumbered(std::string_view object) const;
  /// The array of the vertices that are used.
  [[nodiscard]] std::string text() const;

 private:
  using Key = std::array<std::int64_t, 3>;
  [[nodiscard]] std::string text_of(std::size_t number) const;
  [[nodiscard]] std::optional<Key> key_at(std::size_t number) const;
  [[nodiscard]] std::size_t slot_of(const Key& key) const;
  void enter(int number, const Key& key);

  Transform transform_;
  int digits_;
  /// The file's vertices, then those that were added.
  std::vector<std::string_view> there_;
  std::vector<Key> added_;
  /// Numbers of vertices by a hash of their integers, at a load of at most one half; -1: none.
  std::vector<int> slots_;
  std::size_t taken_ = 0;
  std::vector<bool> is_used_;
  std::vector<int> new_number_;
};

}  // namespace oriel::detail
