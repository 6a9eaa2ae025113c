#include "examples/generator/facade/facade_layout.h"

#include "examples/generator/facade/facade.h"
#include "examples/generator/facade/openings.h"
#include "examples/generator/house/plinth.h"

#include <algorithm>

namespace oriel::generator {
namespace {

/// Share of the places beyond a house's first where another bay, balcony or loggia is tried.
constexpr double kMore = 0.35;

/// Bays, balconies and loggias: one of each that the plan asks for, then some more.
class Rooms {
 public:
  Rooms(const Plan& plan, Random& random) : plan_(plan), random_(random) {}

  void place_on(Facade& wall) {
    try_to(Feature::bay, [&] { return wall.place_bay(); });
    try_to(Feature::balcony, [&] { return wall.place_balconies(); });
    try_to(Feature::loggia, [&] { return wall.place_loggias(); });
  }

 private:
  template <class Place>
  void try_to(Feature feature, const Place& place) {
    if (!plan_.has(feature)) return;
    if (placed_.has(feature) && !random_.chance(kMore)) return;
    if (place()) placed_.add(feature);
  }

  const Plan& plan_;
  Random& random_;
  FeatureSet placed_;
};

void place_gable_window(Draft& draft, Panel& gable, const Plan& plan, Random& random) {
  const Rect& room = gable.usable;
  const Um width = std::min(plan.window.width, room.width()) / 20'000 * 20'000;
  const Um v0 = room.v0 + 300_mm, height = std::min(plan.window.height, room.v1 - v0);
  const Um recess = random.chance(plan.flush) ? 0 : plan.window.recess;
  if (width < 500_mm || height < 500_mm) return;
  const Um u0 = room.middle() - width / 2, distance = 100_mm;
  const Rect rect{u0, u0 + width, v0, v0 + height};
  if (gable.is_free(rect, distance))
    add_opening(draft, gable, {Class::window, "gableWindow", rect, recess});
}

}  // namespace

void lay_out_facades(Draft& draft, House& house, const Plan& plan, Random& random) {
  bool has_entrance = !plan.has(Feature::door), has_garage = !plan.has(Feature::garage);
  Rooms rooms(plan, random);
  for (Panel& panel : house.walls) {
    Facade wall(draft, panel, plan, random);
    if (panel.is_front && !has_entrance) has_entrance = wall.place_entrance();
    if (!has_garage) has_garage = wall.place_garage();
    const Um length_per_try = 9000_mm;
    for (Um length = 0; length < panel.usable.width(); length += length_per_try)
      rooms.place_on(wall);
    if (plan.has(Feature::strip)) wall.place_strip();
    if (plan.has(Feature::window)) wall.place_windows();
    if (plan.has(Feature::pilaster)) wall.place_pilasters();
    if (plan.has(Feature::cornice)) wall.place_cornices();
  }
  if (plan.has(Feature::gable_window))
    for (Panel& gable : house.gables) place_gable_window(draft, gable, plan, random);
  if (plan.plinth > 0) add_plinth(draft, house, plan.plinth, 60_mm);
}

}  // namespace oriel::generator
