#include "kernel/solidify/planes/known_planes.h"

#include <set>

#include <doctest/doctest.h>

namespace oriel::detail {
namespace {

TEST_SUITE("kernel/solidify") {
  TEST_CASE("every offset of every normal has a place of its own that is found again") {
    constexpr int kNormals = 30, kOffsets = 20;
    KnownPlanes planes(0.001, kNormals * kOffsets);
    std::set<int> places;
    const auto normal_of = [](int i) { return IntegerNormal{100, i, 7 * i}; };
    for (int i = 0; i < kNormals; ++i) {
      const int number = planes.add_class(normal_of(i));
      for (std::int64_t offset = 0; offset < kOffsets; ++offset)
        CHECK(places.insert(planes.number_of(number, offset)).second);
    }
    for (int i = 0; i < kNormals; ++i)
      for (std::int64_t offset = 0; offset < kOffsets; ++offset) {
        const int place = planes.exact_place(normal_of(i), offset);
        CHECK(place == planes.number_of(i, offset));
        CHECK(planes.class_at(place).normal == normal_of(i));
        CHECK(planes.places().at(static_cast<std::size_t>(place)).offset == offset);
      }
    CHECK(places.size() == planes.places().size());
    CHECK(planes.exact_place(normal_of(0), kOffsets) == -1);
    CHECK(planes.exact_place(normal_of(kNormals), 0) == -1);
  }

  TEST_CASE("of classes with one normal polygons take the place of the first") {
    KnownPlanes planes(0.001, 10);
    const IntegerNormal up{0, 0, 1};
    const int first = planes.add_class(up), second = planes.add_class(up);
    const int later = planes.number_of(second, 5);
    CHECK(planes.exact_place(up, 5) == later);
    const int place = planes.number_of(first, 5);
    CHECK(planes.exact_place(up, 5) == place);
    CHECK(place != later);
  }
}

}  // namespace
}  // namespace oriel::detail
