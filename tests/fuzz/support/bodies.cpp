#include "tests/fuzz/support/bodies.h"

#include "examples/generator/generate.h"
#include "tests/fuzz/support/mutations.h"
#include "tests/support/changed.h"
#include "tests/support/generated_house.h"
#include "tests/support/houses.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace oriel::fuzz {

namespace {

constexpr int kMostChanges = 12;

/// Larger bodies take longer than a fuzzer likes.
constexpr int kMostCorners = 12;

double grid_step(ByteSource& bytes, int most) { return 0.25 * bytes.below(4 * most + 1); }

Building boxes(ByteSource& bytes) {
  test::BoxBody body;
  body.add({0, 0, 0}, {8, 6, 5});
  for (int i = bytes.below(5); i > 0; --i) {
    const bool is_added = bytes.flag();
    Vec3 min{grid_step(bytes, 10) - 1, grid_step(bytes, 8) - 1, grid_step(bytes, 6)};
    const Vec3 size{0.25 + grid_step(bytes, 3), 0.25 + grid_step(bytes, 3),
                    0.25 + grid_step(bytes, 3)};
    is_added ? body.add(min, min + size) : body.remove(min, min + size);
  }
  return body.build();
}

Building named_body(ByteSource& bytes) {
  return test::bodies()[bytes.below(test::bodies().size())].make();
}

/// Upright walls over an outline, bottom and top.
Building prism_over(const std::vector<Vec3>& outline, double height_m) {
  std::vector<std::vector<Vec3>> polygons(2);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 p = outline[i], q = outline[(i + 1) % outline.size()], up{0, 0, height_m};
    polygons.push_back({p, q, q + up, p + up});
    polygons[0].insert(polygons[0].begin(), p);
    polygons[1].push_back(p + up);
  }
  return test::building_of(polygons);
}

Building prism(ByteSource& bytes) {
  const double height_m = 1 + grid_step(bytes, 8);
  if (bytes.flag())
    return prism_over({{0, 0, 0}, {8, 0, 0}, {8, 4, 0}, {4, 4, 0}, {4, 9, 0}, {0, 9, 0}}, height_m);
  std::vector<Vec3> outline;
  const int corners = 3 + bytes.below(kMostCorners - 2);
  for (int i = 0; i < corners; ++i) {
    const double radius_m = 2 + grid_step(bytes, 4), angle = 2 * std::numbers::pi * i / corners;
    outline.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle), 0});
  }
  return prism_over(outline, height_m);
}

Building house(ByteSource& bytes) {
  generator::Options options;
  options.seed = static_cast<std::uint64_t>(1 + bytes.below(16));
  options.storeys = {1, 2};
  options.windows = 1 + bytes.below(4);
  options.flush = bytes.flag() ? 0.5 : 0;
  options.triangulate = bytes.below(4) == 1;
  return test::generated_building(generator::generate(options, bytes.below(4)));
}

Building nested(ByteSource& bytes) {
  const double wall_m = 0.25 + grid_step(bytes, 1);
  test::BoxBody body;
  body.add({0, 0, 0}, {8, 8, 8})
      .remove({wall_m, wall_m, wall_m}, {8 - wall_m, 8 - wall_m, 8 - wall_m});
  if (bytes.flag()) body.add({3, 3, 3}, {5, 5, 5});
  if (bytes.flag()) body.remove({3.5, 3.5, 3.5}, {4.5, 4.5, 4.5});
  if (bytes.flag()) body.add({10, 0, 0}, {12, 8, 3});
  return body.build();
}

}  // namespace

void put_on_grid(Building& building) {
  for (Vec3& p : building.vertices)
    p = {std::round(p.x / kUnit_m) * kUnit_m, std::round(p.y / kUnit_m) * kUnit_m,
         std::round(p.z / kUnit_m) * kUnit_m};
}

Building as_read(Building building) {
  for (std::size_t i = 0; i < building.polygons.size(); ++i)
    building.polygons[i].source = static_cast<int>(i);
  building.id = "a";
  building.frame = {};
  return test::framed(std::move(building));
}

Body valid_body(ByteSource& bytes) {
  Building (*const makers[])(ByteSource&) = {boxes, named_body, prism, house, nested};
  Body body;
  body.building = makers[bytes.below(std::size(makers))](bytes);
  const std::vector<Vec3> exact = body.building.vertices;
  put_on_grid(body.building);
  // Slopes that are off the grid are no planes on it: then facets only nearly are one.
  body.is_valid = body.building.vertices == exact;
  body.building = as_read(std::move(body.building));
  return body;
}

Body changed_body(ByteSource& bytes) {
  Body body = valid_body(bytes);
  for (int i = 0; i < kMostChanges && !bytes.is_empty(); ++i) {
    mutate(body.building, bytes);
    body.is_valid = false;
  }
  put_on_grid(body.building);
  body.building = as_read(std::move(body.building));
  return body;
}

}  // namespace oriel::fuzz
