#include "kernel/geometry/boxes.h"

#include "kernel/geometry/box_tree.h"

#include <random>
#include <set>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

constexpr Box kCube{{0, 0, 0}, {2, 2, 2}};

std::vector<Box> random_boxes(std::size_t count) {
  std::mt19937 numbers(7);
  std::uniform_int_distribution<int> place(0, 20), side(0, 4);
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
    for (int corner = 0; corner < 2; ++corner)
      box.grow(Vec3{static_cast<double>(place(numbers) + side(numbers)) / 2,
                    static_cast<double>(place(numbers)), static_cast<double>(side(numbers))});
  return boxes;
}

TEST_SUITE("kernel/geometry") {
  TEST_CASE("a box holds its faces and what is nearer than the margin") {
    CHECK(contains(kCube, {2, 1, 0}));
    CHECK_FALSE(contains(kCube, {2.1, 1, 1}));
    CHECK(contains(kCube, {2.1, 1, 1}, 0.2));
  }

  TEST_CASE("the intersection of boxes that touch has no volume and of boxes apart is empty") {
    CHECK(volume_m3(intersection(kCube, {{2, 0, 0}, {3, 2, 2}})) == 0);
    CHECK(intersection(kCube, {{3, 0, 0}, {4, 2, 2}}).is_empty());
    CHECK(volume_m3(intersection(kCube, {{1, 1, 1}, {5, 5, 5}})) == 1);
  }

  TEST_CASE("boxes are as far apart as their nearest corners and touching ones not at all") {
    const Box box{{0, 0, 0}, {1, 1, 1}};
    CHECK(distance_m(box, {{1, 0, 0}, {2, 1, 1}}) == 0);
    CHECK(distance_m(box, {{0.2, 0.2, 3}, {0.4, 5, 4}}) == 2);
    CHECK(distance_m(box, {{4, 5, 1}, {9, 9, 9}}) == 5);
    CHECK(distance_m({{4, 5, 1}, {9, 9, 9}}, box) == 5);
    CHECK(distance_m({{-3, 0.5, -4}, {-3, 0.5, -4}}, box) == 5);
  }

  TEST_CASE("the overlap ratio is one for the same box and none for boxes apart") {
    CHECK(intersection_over_union(kCube, kCube) == 1);
    CHECK(intersection_over_union(kCube, {{3, 3, 3}, {4, 4, 4}}) == 0);
    CHECK(intersection_over_union(kCube, {{1, 0, 0}, {3, 2, 2}}) == doctest::Approx(1.0 / 3));
    CHECK(intersection_over_union({}, {}) == 0);
  }

  TEST_CASE("a tree finds the boxes that overlap and no others") {
    for (const std::size_t count : {0U, 1U, 2U, 3U, 50U, 333U}) {
      const std::vector<Box> boxes = random_boxes(count);
      const BoxTree tree(boxes);
      for (const Box& box : random_boxes(40)) {
        std::set<int> found, expected;
        tree.for_each_overlap(box, [&](int i) { CHECK(found.insert(i).second); });
        for (std::size_t i = 0; i < count; ++i)
          if (overlap(box, boxes[i])) expected.insert(static_cast<int>(i));
        CHECK(found == expected);
      }
    }
  }
}

}  // namespace
}  // namespace oriel
