#pragma once

#include "examples/generator/house/body.h"
#include "examples/generator/options.h"
#include "examples/generator/random.h"

namespace oriel::generator {

/// House `index` of a city: terraces whose houses share their side walls, blocks around a
/// courtyard, single houses along a street. It stands at its place, relative to the city's first
/// house.
struct CityHouse {
  Body body;
  int quarter_turns = 0;
  Point place;
};

/// The house in its own frame, before it is turned and moved.
CityHouse build_city_house(const Options& options, int index, Random& random);

/// Turns and moves a body to the house's place.
void put_in_place(const CityHouse& house, Body& body);

}  // namespace oriel::generator
