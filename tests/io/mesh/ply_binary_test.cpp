#include "tests/io/files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::codes_of;
using test::read_text;

/// The bytes of a binary PLY.
class PlyBytesOf {
 public:
  PlyBytesOf(std::string head, bool is_big_endian)
      : text_("ply\nformat binary_" + std::string(is_big_endian ? "big" : "little") +
              "_endian 1.0\n" + std::move(head) + "end_header\n"),
        is_big_endian_(is_big_endian) {}

  template <class Number>
  PlyBytesOf& add(Number number) {
    auto raw = std::bit_cast<std::array<char, sizeof number>>(number);
    if (is_big_endian_) std::ranges::reverse(raw);
    text_.append(raw.data(), raw.size());
    return *this;
  }

  /// As a list of bytes with its length, each corner a number of type Index.
  template <class Index>
  PlyBytesOf& add_face(const std::vector<int>& corners) {
    add(static_cast<std::uint8_t>(corners.size()));
    for (const int corner : corners) add(static_cast<Index>(corner));
    return *this;
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool is_big_endian_;
};

constexpr const char* kHead =
    "comment feature 7 door_1\nelement vertex 4\nproperty double x\nproperty uchar red\n"
    "property double y\nproperty float z\nelement note 1\nproperty list ushort short words\n"
    "element face 4\nproperty list uchar int vertex_indices\nproperty int16 feature\n";

/// A tetrahedron in UTM coordinates, with a colour and an element that nobody reads.
std::string tetrahedron_of_bytes(bool is_big_endian) {
  PlyBytesOf file(kHead, is_big_endian);
  const std::vector<std::array<double, 3>> points{{678114.25, 5403766.115, 414},
                                                  {678115.25, 5403766.115, 414},
                                                  {678114.25, 5403767.115, 414},
                                                  {678114.25, 5403766.115, 415.5}};
  for (const auto& p : points)
    file.add(p[0]).add(std::uint8_t{10}).add(p[1]).add(static_cast<float>(p[2]));
  file.add(std::uint16_t{2}).add(std::int16_t{-1}).add(std::int16_t{2570});  // two newlines
  const std::vector<std::vector<int>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const auto& face : faces) file.add_face<std::int32_t>(face).add(std::int16_t{7});
  return file.text();
}

TEST_SUITE("io") {
  TEST_CASE("a binary PLY of either byte order is the building that its words would be") {
    for (const bool is_big_endian : {false, true}) {
      CAPTURE(is_big_endian);
      const auto record = read_text(tetrahedron_of_bytes(is_big_endian), "house.ply");
      CHECK(record.issues.empty());
      REQUIRE(record.value);
      const Building& building = record.value->buildings.at(0);
      CHECK(building.is_solid);
      REQUIRE(building.polygons.size() == 4);
      // Points are numbered in the order of their first use.
      CHECK(building.polygons[2].rings == std::vector<std::vector<int>>{{2, 1, 3}});
      CHECK(building.polygons[3].hint == "door_1");
      CHECK(building.vertices[0].y + building.frame.origin_m.y == 5403766.115);
      CHECK(building.vertices.back().z + building.frame.origin_m.z == 415.5);
    }
  }

  TEST_CASE("numbers of every type of PLY have their values") {
    const std::string head =
        "element vertex 3\nproperty int8 x\nproperty uint16 y\nproperty int32 z\n"
        "element face 1\nproperty list uint32 uint8 vertex_index\n";
    for (const bool is_big_endian : {false, true}) {
      PlyBytesOf file(head, is_big_endian);
      file.add(std::int8_t{-3}).add(std::uint16_t{40000}).add(std::int32_t{-70000});
      file.add(std::int8_t{9}).add(std::uint16_t{40000}).add(std::int32_t{-70000});
      file.add(std::int8_t{9}).add(std::uint16_t{40300}).add(std::int32_t{-70000});
      file.add(std::uint32_t{3}).add(std::uint8_t{0}).add(std::uint8_t{1}).add(std::uint8_t{2});
      const auto record = read_text(file.text(), "a.ply");
      REQUIRE(record.value);
      const Building& building = record.value->buildings.at(0);
      Box bounds;
      for (const Vec3 vertex : building.vertices) bounds.grow(vertex + building.frame.origin_m);
      CHECK(bounds == Box{{-3, 40000, -70000}, {9, 40300, -70000}});
    }
  }

  TEST_CASE("a binary PLY that ends too soon is refused wherever it ends") {
    const std::string text = tetrahedron_of_bytes(false);
    const std::size_t start = text.find("end_header\n") + 11;
    for (std::size_t size = start; size < text.size(); ++size) {
      CAPTURE(size);
      const auto record = read_text(text.substr(0, size), "a.ply");
      CHECK_FALSE(record.value);
      CHECK(codes_of(record.issues) == "E105");
    }
  }

  TEST_CASE("what is wrong in a binary PLY is reported with its element") {
    const std::string text = tetrahedron_of_bytes(false);
    const auto longer = read_text(text + "xy", "a.ply");
    CHECK(codes_of(longer.issues) == "E110");
    CHECK(longer.issues[0].sentence.find("2 bytes follow the last element") != std::string::npos);
    const std::string head =
        "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list char float vertex_indices\n";
    const auto with_face = [&](std::int8_t length, float corner, float x = 0) {
      PlyBytesOf file(head, false);
      file.add(x).add(0.0F).add(0.0F).add(length);
      for (int i = 0; i < 3; ++i) file.add(corner);
      return read_text(file.text(), "a.ply");
    };
    CHECK(codes_of(with_face(3, 1).issues) == "E203");
    CHECK(codes_of(with_face(3, -1).issues) == "E203");
    CHECK(codes_of(with_face(3, 0.5F).issues) == "E110");
    CHECK(codes_of(with_face(3, std::bit_cast<float>(0x7FC00000U)).issues) == "E110");
    CHECK(codes_of(with_face(-3, 0).issues) == "E110");
    CHECK(codes_of(with_face(2, 0).issues) == "E311");
    const auto infinite = with_face(3, 0, std::bit_cast<float>(0x7F800000U));
    CHECK(codes_of(infinite.issues) == "E506");
    CHECK(infinite.issues[0].sentence.find("vertex 0: ") != std::string::npos);
    const auto lengths = read_text(
        "ply\nformat binary_little_endian 1.0\nelement face 1\n"
        "property list float int vertex_indices\nend_header\n",
        "a.ply");
    CHECK(codes_of(lengths.issues) == "E110");
    CHECK(lengths.issues[0].place.line == 4);
  }
}

}  // namespace
}  // namespace oriel
