#include "examples/generator/city/city_plan.h"

#include <algorithm>
#include <array>

namespace oriel::generator {
namespace {

/// The place of a group, with the streets around it.
constexpr Um kGroupWidth = 150'000'000, kGroupDepth = 90'000'000;
constexpr int kGroupsInRow = 40;
constexpr int kHousesInTerrace = kHousesInGroup / 2;
/// Houses on each side of a block: one at the corner, three between.
constexpr int kHousesOnSide = kHousesInGroup / 4;

/// What the houses of a group have in common.
struct Group {
  GroupKind kind = GroupKind::terrace;
  Um depth = 0;
  int storeys = 2;
  Um storey_height = 0;
  int steps = 0;
  Slope slope;
  bool is_flat = false;
  /// Their eaves differ.
  bool is_stepped = false;
};

/// Numbers of a group, or of one of its houses, that its other houses ask for, too.
Random numbers_of(const Options& options, int group, int house = -1) {
  return Random(options.seed ^ 0xc17f,
                static_cast<std::uint64_t>(group) * 64 + static_cast<std::uint64_t>(house + 1));
}

Group draw_group(const Options& options, int number) {
  Random random = numbers_of(options, number);
  Group group;
  group.kind = kind_of_group(number);
  group.depth = random.between(8000_mm, 11000_mm, 40_mm);
  group.storeys = group.kind == GroupKind::perimeter ? random.between(3, 4) : random.between(2, 3);
  group.storey_height = random.between(2850_mm, 3200_mm, 50_mm);
  group.steps = random.between(0, 3);
  group.slope.per_mille = random.between(12, 18) * 50;
  group.is_flat = random.chance(0.2);
  group.is_stepped = random.chance(0.5);
  return group;
}

/// What one house of a group differs in.
struct OwnSize {
  Um width = 0, shallower = 0, higher = 0;
};

OwnSize draw_own(const Options& options, int group, int house) {
  Random random = numbers_of(options, group, house);
  OwnSize own;
  own.width = random.between(6400_mm, 8400_mm, 40_mm);
  own.shallower = random.chance(0.4) ? random.between(200_mm, 1000_mm, 200_mm) : 0;
  own.higher = random.between(0_mm, 1200_mm, 300_mm);
  return own;
}

/// Only what fits a house between neighbours: nothing goes around it.
void keep_what_fits(Plan& plan) {
  FeatureSet kept;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    const auto feature = static_cast<Feature>(i);
    const bool goes_around = feature == Feature::plinth || feature == Feature::parapet ||
                             feature == Feature::overhang || feature == Feature::wing ||
                             feature == Feature::cornice || feature == Feature::pilaster ||
                             feature == Feature::garage || feature == Feature::shop;
    const bool is_needed = feature == Feature::window || feature == Feature::door;
    if (is_needed || (!goes_around && plan.has(feature))) kept.add(feature);
  }
  plan.features = kept;
}

/// The drawn plan with the sizes of its group.
Plan drawn(const Options& options, const Group& group, const OwnSize& own, Random& random) {
  Options asked = options;
  asked.roof = group.is_flat ? RoofKind::flat : RoofKind::gable;
  asked.storeys = {group.storeys, group.storeys};
  Plan plan = draw_plan(asked, random);
  keep_what_fits(plan);
  plan.storey_height = group.storey_height;
  plan.steps = plan.has(Feature::stairs) ? group.steps : 0;
  plan.base = group.steps * 160_mm;
  if (plan.steps == 0) plan.base = 0;
  plan.plinth = 0;
  plan.column_width = std::min(plan.column_width, 2800_mm);
  Massing& m = plan.massing;
  m.overhang = m.parapet = 0;
  m.wing.reset();
  m.slope = group.is_flat ? Slope{} : group.slope;
  m.width = own.width;
  m.depth = group.depth - own.shallower;
  m.wall_height = group.storeys * group.storey_height + group.steps * 160_mm +
                  (group.is_stepped ? own.higher : 0);
  return plan;
}

Point rotated(Point p, int quarter_turns) {
  for (int i = 0; i < quarter_turns; ++i) p = {-p.y, p.x, p.z};
  return p;
}

/// Two rows of eight, the second turned round. Walls meet at the sums of the widths before.
CitySite terraced(const Options& options, int number, int house, Random& random) {
  const Group group = draw_group(options, number);
  const int row = house / kHousesInTerrace, first = row * kHousesInTerrace;
  Um x = 0;
  for (int i = first; i < house; ++i) x += draw_own(options, number, i).width;
  CitySite site;
  site.plan = drawn(options, group, draw_own(options, number, house), random);
  site.is_blind[2] = house > first;
  site.is_blind[3] = house + 1 < first + kHousesInTerrace;
  site.has_party_chimney = house > first && !group.is_flat && site.plan.has(Feature::chimney);
  site.quarter_turns = 2 * row;
  site.place = row == 0 ? Point{x, 0, 0} : Point{68000_mm - x, 60000_mm, 0};
  return site;
}

/// Along each side of the block a corner house, then three: a side is as long as the one opposite.
CitySite around_courtyard(const Options& options, int number, int house, Random& random) {
  const Group group = draw_group(options, number);
  const int side = house / kHousesOnSide, place = house % kHousesOnSide;
  Random common = numbers_of(options, number, 60);
  const std::array<Um, 2> between{common.between(20400_mm, 24000_mm, 120_mm),
                                  common.between(20400_mm, 24000_mm, 120_mm)};
  const auto length_of = [&](int s) { return between[static_cast<std::size_t>(s % 2)]; };
  const auto middle_width = [&](int s, int j) {
    const Um third = length_of(s) / 3;
    const Um shift = draw_own(options, number, s * kHousesOnSide).width % 600'000;
    return j == 1 ? third - shift : j == 2 ? third + shift : length_of(s) - 2 * third;
  };
  OwnSize own = draw_own(options, number, house);
  Um along = 0;
  if (place > 0) {
    along = group.depth;
    for (int j = 1; j < place; ++j) along += middle_width(side, j);
    own.width = middle_width(side, place);
  } else {
    own.width = group.depth;
    own.shallower = 0;
  }
  Group of_house = group;
  if (place == 0) of_house.is_flat = true;
  CitySite site;
  site.plan = drawn(options, of_house, own, random);
  site.is_blind[2] = place > 0;
  site.is_blind[3] = true;
  site.is_blind[1] = place == 0;
  site.ends_in_corner[0] = place == kHousesOnSide - 1;
  site.ends_in_corner[1] = place == 1;
  site.has_party_chimney = place > 1 && !of_house.is_flat && site.plan.has(Feature::chimney);
  site.quarter_turns = side;
  const Um w = 2 * group.depth + between[0], d = 2 * group.depth + between[1];
  const std::array<Point, 4> corners{{{0, 0, 0}, {w, 0, 0}, {w, d, 0}, {0, d, 0}}};
  site.place = corners[static_cast<std::size_t>(side)] + rotated({along, 0, 0}, side);
  return site;
}

/// A house on a lot of its own, under whatever roof it draws.
CitySite single(const Options& options, int number, int house, Random& random) {
  const Group group = draw_group(options, number);
  const int row = house / kHousesInTerrace;
  OwnSize own = draw_own(options, number, house);
  own.width += 1600_mm;
  Group of_house = group;
  of_house.is_flat = false;
  CitySite site;
  site.plan = drawn(options, of_house, own, random);
  if (random.chance(0.4) && site.plan.massing.width >= site.plan.massing.depth)
    site.plan.massing.roof = RoofKind::hip;
  site.quarter_turns = 2 * row;
  const Um lot = 17000_mm, x = (house % kHousesInTerrace) * lot;
  site.place = row == 0 ? Point{x, 0, 0} : Point{x + 10000_mm, 60000_mm, 0};
  return site;
}

}  // namespace

GroupKind kind_of_group(int group) {
  constexpr std::array kinds{GroupKind::terrace, GroupKind::perimeter, GroupKind::detached,
                             GroupKind::perimeter};
  return kinds[static_cast<std::size_t>(group) % kinds.size()];
}

CitySite draw_site(const Options& options, int index, Random& random) {
  const int number = index / kHousesInGroup, house = index % kHousesInGroup;
  CitySite site;
  switch (kind_of_group(number)) {
    case GroupKind::terrace:
      site = terraced(options, number, house, random);
      break;
    case GroupKind::perimeter:
      site = around_courtyard(options, number, house, random);
      break;
    case GroupKind::detached:
      site = single(options, number, house, random);
      break;
  }
  const Point group_place{number % kGroupsInRow * kGroupWidth, number / kGroupsInRow * kGroupDepth,
                          0};
  site.place = site.place + group_place;
  return site;
}

}  // namespace oriel::generator
