#include "examples/generator/english/back_addition.h"

#include "examples/generator/house/extrude.h"

#include <algorithm>
#include <string>
#include <utility>

namespace oriel::generator {
namespace {

constexpr Point kEast{1, 0, 0}, kNorth{0, 1, 0}, kUp{0, 0, 1};
constexpr std::size_t kBackWall = 1, kWestWall = 2, kEastWall = 3;

FacetId add_surface(Draft& draft, Class kind, std::string_view subclass) {
  return draft.add_facet({draft.add_object({kind, std::string(subclass), -1, -1, {}, {}})});
}
FacetId add_wall_surface(Draft& draft) { return add_surface(draft, Class::wall, "WallSurface"); }
FacetId add_roof_surface(Draft& draft) { return add_surface(draft, Class::roof, "RoofSurface"); }

/// A rectangular plane that keeps things 0.4 m from its edges.
RoofPlane roof_plane(FacetId facet, const Frame& frame, Slope slope, Um length, Um run) {
  const Um margin = 400_mm;
  return {facet,
          frame,
          slope,
          {{0, 0}, {length, 0}, {length, run}, {0, run}},
          {margin, length - margin, margin, run - margin},
          {}};
}

/// Builds one addition; its members are the facets that the steps share.
class AdditionBuilder {
 public:
  AdditionBuilder(Draft& draft, House& house, const BackAddition& addition)
      : draft_(draft),
        house_(house),
        a_(addition),
        y0_(house.walls[kBackWall].frame.origin.y),
        y1_(y0_ + addition.length),
        low_(add_wall_surface(draft)),
        high_(add_wall_surface(draft)),
        end_(add_wall_surface(draft)) {}

  AdditionWalls build() {
    if (a_.roof == AdditionRoof::gable) build_gabled();
    if (a_.roof == AdditionRoof::to_x0) build_mono_pitched();
    if (a_.roof == AdditionRoof::to_garden) build_lean_to();
    return {panel(low_, {{a_.x0, y1_, 0}, -kNorth, kUp, -kEast}, a_.length),
            panel(high_, {{a_.x1, y0_, 0}, kNorth, kUp, kEast}, a_.length),
            panel(end_, {{a_.x1, y1_, 0}, -kEast, kUp, kNorth}, a_.x1 - a_.x0)};
  }

 private:
  [[nodiscard]] FacetId back() const { return house_.walls[kBackWall].facet; }
  [[nodiscard]] Panel panel(FacetId facet, const Frame& frame, Um length) const {
    return {facet, frame, house_.ground, {0, length, 0, a_.eaves}, {}, -1, false};
  }
  /// The outline is in (z, x) and is drawn out towards the garden.
  void draw_out(const std::vector<Uv>& outline, std::vector<FacetId> walls) {
    extrude(draft_, Frame{}.turned().turned(), {outline, y0_, y1_}, Matter::solid,
            draft_.owner(low_), {std::move(walls), back(), end_});
  }
  void add_plane(FacetId facet, const Frame& frame, Um length, Um run) {
    house_.roof.push_back(roof_plane(facet, frame, a_.slope, length, run));
  }
  void build_gabled();
  void build_mono_pitched();
  void build_lean_to();

  Draft& draft_;
  House& house_;
  const BackAddition& a_;
  Um y0_, y1_;
  FacetId low_, high_, end_;
};

void AdditionBuilder::build_gabled() {
  const Um half = (a_.x1 - a_.x0) / 2, peak = a_.eaves + a_.rise();
  const FacetId west = add_roof_surface(draft_), east = add_roof_surface(draft_);
  draw_out({{0, a_.x0}, {a_.eaves, a_.x0}, {peak, a_.x0 + half}, {a_.eaves, a_.x1}, {0, a_.x1}},
           {low_, west, east, high_, house_.ground});
  add_plane(west, {{a_.x0, y1_, a_.eaves}, -kNorth, kEast, kUp}, a_.length, half);
  add_plane(east, {{a_.x1, y0_, a_.eaves}, kNorth, -kEast, kUp}, a_.length, half);
}

void AdditionBuilder::build_mono_pitched() {
  const FacetId roof = add_roof_surface(draft_);
  draw_out({{0, a_.x0}, {a_.eaves, a_.x0}, {a_.eaves + a_.rise(), a_.x1}, {0, a_.x1}},
           {low_, roof, high_, house_.ground});
  add_plane(roof, {{a_.x0, y1_, a_.eaves}, -kNorth, kEast, kUp}, a_.length, a_.x1 - a_.x0);
}

void AdditionBuilder::build_lean_to() {
  const FacetId roof = add_roof_surface(draft_);
  extrude(draft_, Frame{}.turned(),
          {{{y0_, 0}, {y1_, 0}, {y1_, a_.eaves}, {y0_, a_.eaves + a_.rise()}}, a_.x0, a_.x1},
          Matter::solid, draft_.owner(low_), {{house_.ground, end_, roof, back()}, low_, high_});
  add_plane(roof, {{a_.x1, y1_, a_.eaves}, -kEast, -kNorth, kUp}, a_.x1 - a_.x0, a_.length);
}

}  // namespace

Um BackAddition::rise() const {
  if (roof == AdditionRoof::gable) return slope.rise((x1 - x0) / 2);
  return slope.rise(roof == AdditionRoof::to_garden ? length : x1 - x0);
}

AdditionWalls add_back_addition(Draft& draft, House& house, const BackAddition& addition) {
  return AdditionBuilder(draft, house, addition).build();
}

Panel add_side_garage(Draft& draft, House& house, const SideGarage& garage) {
  const FacetId front = add_wall_surface(draft), side = add_wall_surface(draft);
  const FacetId back = add_wall_surface(draft), roof = add_roof_surface(draft);
  Panel& wall = house.walls[garage.is_right ? kEastWall : kWestWall];
  const Um x0 = wall.frame.origin.x - (garage.is_right ? 0 : garage.width);
  add_block(draft, {}, {x0, x0 + garage.width, garage.y0, garage.y1, 0, garage.height},
            draft.owner(roof),
            {garage.is_right ? wall.facet : side, garage.is_right ? side : wall.facet, front, back,
             house.ground, roof});
  const Um a = wall.frame.coordinates_of({0, garage.y0, 0}).x;
  const Um b = wall.frame.coordinates_of({0, garage.y1, 0}).x;
  wall.reserved.push_back({std::min(a, b), std::max(a, b), 0, garage.height});
  return {front,        {{x0, garage.y0, 0}, kEast, kUp, -kNorth},
          house.ground, {150_mm, garage.width - 150_mm, 0, garage.height - 150_mm},
          {},           -1,
          true};
}

}  // namespace oriel::generator
