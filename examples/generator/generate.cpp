#include "examples/generator/generate.h"

#include "examples/generator/city/city_house.h"
#include "examples/generator/english/english_house.h"
#include "examples/generator/facade/facade_layout.h"
#include "examples/generator/geometry/triangulate.h"
#include "examples/generator/house/additions.h"
#include "examples/generator/house/plan.h"
#include "examples/generator/house/roof_layout.h"
#include "examples/generator/output/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace oriel::generator {
namespace {

/// Faces of the exact body are planar; a micrometre is what the check itself may round. Once
/// corners are turned (and rounded) or shaken it is not asked.
constexpr Um kFlatness = 1;
/// Houses of one run stand in rows of this length.
constexpr int kHousesInRow = 200;

void check(const Body& body, std::optional<Um> flatness, const Options& options, int index) {
  const std::vector<std::string> faults = find_faults(body, flatness);
  if (faults.empty()) return;
  throw std::logic_error("house " + std::to_string(index) + " of seed " +
                         std::to_string(options.seed) + " is no valid solid: " + faults.front());
}

Body build(const Options& options, int index) {
  Random random(options.seed, static_cast<std::uint64_t>(index));
  if (options.style == Style::english) return build_english_house(options, random);
  const Plan plan = draw_plan(options, random);
  Draft draft;
  House house = build_house(draft, plan.massing);
  Random places(options.seed ^ 0xadd, static_cast<std::uint64_t>(index));
  std::vector<int> without_room =
      place_additions(draft, house, options.additions, plan.massing.wall_height, places);
  lay_out_roof(draft, house, plan, random);
  lay_out_facades(draft, house, plan, random);
  Body body = draft.close();
  body.roof = name_of(plan.massing.roof);
  body.storeys = plan.storeys;
  body.without_room = std::move(without_room);
  return body;
}

void rotate(Body& body, double angle_deg) {
  const double angle_rad = angle_deg * std::numbers::pi / 180;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  for (Point& p : body.vertices) {
    const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
    p.x = std::llround(c * x - s * y);
    p.y = std::llround(s * x + c * y);
  }
}

void shake(Body& body, Um noise, Random& random) {
  for (Point& p : body.vertices) {
    p.x += random.between(-noise, noise, 1);
    p.y += random.between(-noise, noise, 1);
    p.z += random.between(-noise, noise, 1);
  }
}

/// Room for one house with all that sticks out of it.
Um lot_size(const Options& options) {
  const Um widest = std::max(options.width.high, options.depth.high);
  const Um by_windows = Um{options.windows} * 200'000;
  return std::max(widest, by_windows) * 2 + 20'000'000;
}

}  // namespace

Body generate(const Options& options, int index) {
  CityHouse house;
  const bool is_in_city = options.style == Style::city;
  if (is_in_city) {
    Random random(options.seed, static_cast<std::uint64_t>(index));
    house = build_city_house(options, index, random);
  }
  Body body = is_in_city ? std::move(house.body) : build(options, index);
  check(body, kFlatness, options, index);
  if (is_in_city) put_in_place(house, body);
  Random random(~options.seed, static_cast<std::uint64_t>(index));
  // An exact body is cut while it is exact: rounded corners that were in line would make slivers. A
  // shaken one is cut last: triangles that are shaken would fold over each other.
  const bool is_exact = options.noise == 0;
  if (options.triangulate && is_exact) body = triangulated(body, random);
  if (options.rotate_deg != 0) rotate(body, options.rotate_deg);
  if (options.noise > 0) shake(body, options.noise, random);
  if (options.triangulate && !is_exact) body = triangulated(body, random);
  const Um lot = is_in_city ? 0 : lot_size(options);
  const Point place{index % kHousesInRow * lot, index / kHousesInRow * lot, 0};
  for (Point& p : body.vertices) p = p + place;
  const bool has_moved = options.triangulate || options.rotate_deg != 0 || options.noise > 0;
  if (has_moved) check(body, std::nullopt, options, index);
  return body;
}

}  // namespace oriel::generator
