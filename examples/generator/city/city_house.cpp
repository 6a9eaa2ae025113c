#include "examples/generator/city/city_house.h"

#include "examples/generator/city/city_plan.h"
#include "examples/generator/facade/facade_layout.h"
#include "examples/generator/house/draft.h"
#include "examples/generator/house/house.h"
#include "examples/generator/house/roof_layout.h"
#include "examples/generator/house/rooftop.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace oriel::generator {
namespace {

/// What stands before the back walls keeps clear of the courtyard's corners.
void keep_out_of_corners(const CitySite& site, Panel& back) {
  if (site.ends_in_corner[0]) back.usable.u0 = kCornerMargin;
  if (site.ends_in_corner[1]) back.usable.u1 -= kCornerMargin - kWallMargin;
}

/// Walls with a neighbour, and the gables over them, are not laid out.
void drop_blind_walls(const CitySite& site, House& house) {
  std::vector<FacetId> blind;
  for (std::size_t i = 0; i < 4; ++i)
    if (site.is_blind[i]) blind.push_back(house.walls[i].facet);
  const auto is_blind = [&](const Panel& panel) {
    return std::ranges::find(blind, panel.facet) != blind.end();
  };
  std::erase_if(house.walls, is_blind);
  std::erase_if(house.gables, is_blind);
}

/// A stack of two flues over the ridge, its outer side in the plane of the left wall.
void add_party_chimney(Draft& draft, House& house, Random& random) {
  const Point ridge = house.ridge.front();
  const Um depth = random.between(900_mm, 1200_mm, 20_mm),
           width = random.between(440_mm, 560_mm, 20_mm);
  Chimney chimney;
  chimney.plan = {0, width, ridge.y - depth / 2, ridge.y + depth / 2};
  chimney.top = ridge.z + random.between(500_mm, 900_mm, 20_mm);
  add_chimney(draft, house, chimney);
}

}  // namespace

CityHouse build_city_house(const Options& options, int index, Random& random) {
  CitySite site = draw_site(options, index, random);
  Draft draft;
  House house = build_house(draft, site.plan.massing);
  keep_out_of_corners(site, house.walls[static_cast<std::size_t>(Side::back)]);
  drop_blind_walls(site, house);
  if (site.has_party_chimney) add_party_chimney(draft, house, random);
  lay_out_roof(draft, house, site.plan, random);
  lay_out_facades(draft, house, site.plan, random);
  CityHouse made;
  made.body = draft.close();
  made.body.roof = name_of(site.plan.massing.roof);
  made.body.storeys = site.plan.storeys;
  made.quarter_turns = site.quarter_turns;
  made.place = site.place;
  return made;
}

void put_in_place(const CityHouse& house, Body& body) {
  for (Point& p : body.vertices) {
    for (int i = 0; i < house.quarter_turns; ++i) p = {-p.y, p.x, p.z};
    p = p + house.place;
  }
}

}  // namespace oriel::generator
