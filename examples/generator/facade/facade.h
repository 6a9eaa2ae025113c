#pragma once

#include "examples/generator/facade/facade_grid.h"
#include "examples/generator/house/house.h"
#include "examples/generator/house/plan.h"

#include <string_view>

namespace oriel::generator {

/// One wall of a house while features are placed on it. Each place_… draws a free cell, puts its
/// feature there if there is room, and says whether it did.
class Facade {
 public:
  /// Draft, panel, plan and random numbers must outlive this.
  Facade(Draft& draft, Panel& panel, const Plan& plan, Random& random)
      : draft_(draft), panel_(panel), plan_(plan), random_(random), grid_(panel, plan) {}

  // facade_openings.cpp
  /// The main door, with stairs if the ground floor is raised, and a canopy over it.
  bool place_entrance();
  bool place_garage();
  /// Narrow windows side by side with little wall between them.
  void place_strip();
  /// Windows of the house's style, with their sills and shutters, in the cells that are left.
  void place_windows();

  // facade_rooms.cpp
  bool place_bay();
  /// One balcony or a stack of them, with the doors (and windows) that open onto it; so for
  /// loggias.
  bool place_balconies();
  bool place_loggias();

  // facade_decor.cpp
  void place_pilasters();
  /// Bands under the upper floors, in pieces where something is in the way.
  void place_cornices();

 private:
  /// Distance between features that do not belong together.
  static constexpr Um kDistance = 100'000;
  /// What a storey keeps free under the next floor, for slabs.
  static constexpr Um kBelowFloor = 350'000;

  Um draw(Um low, Um high, Um step = 10'000) { return random_.between(low, high, step); }
  [[nodiscard]] bool has(Feature feature) const { return plan_.has(feature); }
  Um draw_recess() { return random_.chance(plan_.flush) ? 0 : plan_.window.recess; }
  /// A rectangle of this size on v0, somewhere in the middle third of the play it has.
  Rect in_middle(const Rect& room, Um width, Um v0, Um height);
  /// The rectangle moved and resized by at most the plan's jitter, inside the room.
  Rect jittered(Rect rect, const Rect& room);

  void add_door(Panel& panel, const Rect& rect, std::string_view subclass);
  void add_stairs_before(const Rect& door);
  void add_canopy_over(const Rect& door, Um limit);
  /// A door onto a balcony or loggia.
  void add_french_door(Panel& panel, const Rect& room, Um floor);
  /// A window of the house's style in the room, on a storey whose floor is given. False if it is
  /// too tight.
  bool add_window(Panel& panel, const Rect& room, Um floor, std::string_view subclass);
  void add_cellar_window(const Rect& room);
  void add_window_decor(const Rect& window, const Rect& room);
  bool add_balcony_at(const Cell& cell);
  bool add_loggia_at(const Cell& cell);

  Draft& draft_;
  Panel& panel_;
  const Plan& plan_;
  Random& random_;
  FacadeGrid grid_;
};

}  // namespace oriel::generator
