#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::test {

/// A building as the verb `geometry` gives it (studio/session/verbs/geometry_verbs.cpp).
struct BuildingOfBytes {
  nlohmann::json head;
  std::vector<std::uint32_t> vertices, ring_ends, corner_ends, corners, owner_ends, owners;
};

/// Reads the lists one after the other.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t number(std::size_t size) {
    REQUIRE(at_ + size <= bytes_.size());
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes_[at_ + i])) << (8 * i);
    at_ += size;
    return value;
  }
  std::string text(std::size_t size) {
    at_ += size;
    return std::string(bytes_.substr(at_ - size, size));
  }
  std::vector<std::uint32_t> list(std::size_t count, bool is_short) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(number(is_short ? 2 : 4));
    at_ = (at_ + 3) / 4 * 4;
    return numbers;
  }
  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

inline std::vector<BuildingOfBytes> read_bytes(const std::string& bytes) {
  ByteReader reader(bytes);
  const std::size_t size = reader.number(4);
  CHECK(size % 4 == 0);
  const auto head = nlohmann::json::parse(reader.text(size));
  std::vector<BuildingOfBytes> buildings;
  for (const auto& entry : head["buildings"]) {
    const bool are_few = entry["are_few"];
    const std::size_t polygons = entry["polygons"];
    BuildingOfBytes building;
    building.head = entry;
    building.vertices = reader.list(3 * entry["vertices"].get<std::size_t>(), entry["is_short"]);
    building.ring_ends = reader.list(polygons, are_few);
    building.corner_ends = reader.list(entry["rings"], are_few);
    building.corners = reader.list(entry["corners"], are_few);
    building.owner_ends = reader.list(polygons, are_few);
    building.owners = reader.list(entry["owners"], are_few);
    buildings.push_back(building);
  }
  CHECK(reader.is_at_end());
  return buildings;
}

}  // namespace oriel::test
