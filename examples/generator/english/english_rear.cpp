#include "examples/generator/english/english_rear.h"

#include "examples/generator/english/back_addition.h"
#include "examples/generator/english/english_entrance.h"
#include "examples/generator/english/english_front.h"
#include "examples/generator/english/english_roof.h"
#include "examples/generator/house/extrude.h"

#include <algorithm>

// Where sizes come from: extensions of one storey reach 3 m into the garden of a row or pair:
// General Permitted Development Order 2015, schedule 2, part 1, class A.1(f). Flue terminals of
// 100 mm at least 300 mm from openings and corners: Ariston Micro Genus, fig. 2.6, after BS 5440-1.
// Windows: Everest, standard sizes; garage doors of 7 feet by 6 feet 6 inches: Door Superstore.

namespace oriel::generator {
namespace {

constexpr std::size_t kGardenWall = 1;
constexpr Um kUnderNextFloor = 250'000;
constexpr Um kOuterCorner = 250'000, kInnerCorner = 350'000;
/// Rooms of back additions are lower than those of the house.
constexpr Um kAdditionStorey = 2'450'000;
constexpr Um kFlueTerminal = 100'000, kFlueDistance = 300'000;

EnglishWindow dressed_window(const EnglishSite& site, Um width, Um v0, Um height) {
  EnglishWindow window;
  window.rect = {0, width, v0, v0 + height};
  window.glazing = site.plan.glazing;
  window.lights = width >= 1100_mm ? 2 : 1;
  window.is_dressed = true;
  return window;
}

/// An octagonal pipe out of the wall.
void place_flue_terminal(const EnglishSite& site, Panel& panel, Um u, Um v) {
  const Um size = kFlueTerminal, cut = size * 3 / 10'000 * 1'000;
  const Rect r{u, u + size, v, v + size};
  if (!panel.is_free(r, kFlueDistance)) return;
  const int object = site.draft.add_object({Class::vent,
                                            "flueTerminal",
                                            site.draft.owner(panel.facet).object,
                                            panel.installation,
                                            {},
                                            {}});
  panel.reserved.push_back(r);
  const std::vector<Uv> outline{{r.u0 + cut, r.v0}, {r.u1 - cut, r.v0}, {r.u1, r.v0 + cut},
                                {r.u1, r.v1 - cut}, {r.u1 - cut, r.v1}, {r.u0 + cut, r.v1},
                                {r.u0, r.v1 - cut}, {r.u0, r.v0 + cut}};
  extrude(site.draft, panel.frame, {outline, 0, site.length(100_mm, 180_mm)}, Matter::solid,
          {object}, {{}, panel.facet});
}

/// Glazed down to the floor and opening onto the garden; in a plain wall that is a window.
void place_garden_window(const EnglishSite& site, Panel& panel, const Rect& band) {
  EnglishWindow window;
  window.subclass = "frenchWindow";
  const Um width = std::min(site.length(1200_mm, 1800_mm), band.width());
  const Um v0 = std::max<Um>(site.plan.floor(0) - 100_mm, 20_mm);
  window.rect = centred(band, width / 2'000 * 2'000, v0, 2100_mm);
  window.glazing = Glazing::barred;
  window.lights = 2;
  place_window(site, panel, {band.u0, band.u1, v0, band.v1}, window);
}

void place_back_door(const EnglishSite& site, Panel& panel, const Rect& band) {
  const EntrancePlan& entrance = site.plan.entrance;
  const Um v0 = std::min<Um>(site.plan.floor(0), 150_mm);
  if (band.width() < entrance.leaf_width + 200_mm) return;
  if (band.v1 < v0 + entrance.leaf_height + 100_mm) return;
  add_english_door(site, panel, (band.u0 + band.u1) / 2, v0, false);
}

/// One dwelling's garden side.
class RearLayout {
 public:
  RearLayout(const EnglishSite& site, House& house, int index)
      : site_(site), plan_(site.plan), house_(house), dwelling_(dwelling_of(plan_, index)) {}

  /// The back addition of this dwelling, or of it and its neighbour together.
  void place_addition(bool is_shared);
  void place_lean_to();
  void fill_wall();

 private:
  [[nodiscard]] Panel& wall() const { return house_.walls[kGardenWall]; }
  AdditionWalls build(const BackAddition& addition);
  void fill_addition_end(Panel& end, Um eaves, int count);
  void fill_addition_side(Panel& side, Um eaves, bool is_low_side);
  void fill_lean_to_end(Panel& end, Um eaves);
  /// One opening on a storey of the back wall.
  void fill_part(Rect room, int storey);

  const EnglishSite& site_;
  const EnglishPlan& plan_;
  House& house_;
  const Dwelling dwelling_;
};

/// Builds the addition and keeps the back wall free around it.
AdditionWalls RearLayout::build(const BackAddition& addition) {
  const Um u0 = plan_.width() - addition.x1, u1 = plan_.width() - addition.x0, margin = 200_mm;
  AdditionWalls walls = add_back_addition(site_.draft, house_, addition);
  wall().reserved.push_back(
      {u0 - margin, u1 + margin, 0, addition.eaves + addition.rise() + 100_mm});
  return walls;
}

void RearLayout::place_addition(bool is_shared) {
  const Um width = plan_.frontage - plan_.yard;
  if (width < 1900_mm) return;
  BackAddition addition;
  addition.x0 = is_shared ? dwelling_.x1 - width : dwelling_.x0 + 250_mm;
  addition.x1 = is_shared ? dwelling_.x1 + width : addition.x0 + width;
  addition.length = plan_.addition_length;
  addition.roof = is_shared ? AdditionRoof::gable : AdditionRoof::to_x0;
  addition.slope = {site_.random.between(8, 12) * 50};
  const Um limit = wall().usable.v1 - 150_mm;
  const int storeys = site_.random.between(plan_.storeys() > 2 ? 2 : 1, 2);
  const Um wanted = plan_.floor(storeys) - site_.length(300_mm, 600_mm);
  addition.eaves = std::min(wanted, limit - addition.rise()) / 1'000 * 1'000;
  if (addition.eaves < 2300_mm) return;
  AdditionWalls walls = build(addition);
  fill_addition_side(walls.low_side, addition.eaves, true);
  if (is_shared) fill_addition_side(walls.high_side, addition.eaves, false);
  fill_addition_end(walls.end, addition.eaves, is_shared ? 2 : 1);
}

void RearLayout::fill_addition_end(Panel& end, Um eaves, int count) {
  const Um width = end.usable.width();
  for (int storey = 0; storey < 2; ++storey) {
    const Um v0 = plan_.floor(0) + storey * kAdditionStorey;
    const Rect room{kOuterCorner, width - kOuterCorner, v0 + 500_mm,
                    std::min(v0 + 2350_mm, eaves - 60_mm)};
    if (room.height() < 800_mm) return;
    const Um sill = std::min(v0 + 850_mm, room.v1 - 900_mm);
    place_window_row(site_, end, room, count, dressed_window(site_, 914_mm, sill, 1219_mm));
  }
}

/// Below the back door near the garden and a window near the house, above a small window of the
/// toilet and one of a bedroom.
void RearLayout::fill_addition_side(Panel& side, Um eaves, bool is_low_side) {
  const Um end = side.usable.u1, middle = end / 2'000 * 1'000, floor = plan_.floor(0);
  const Um low_top = std::min(eaves - 60_mm, floor + 2350_mm);
  // The garden is at the start of the side towards smaller x, at the end of the other one.
  Rect garden{kOuterCorner, middle - 60_mm, floor + 400_mm, low_top};
  Rect house{middle + 60_mm, end - kInnerCorner, floor + 400_mm, low_top};
  if (!is_low_side) {
    garden = {middle + 60_mm, end - kOuterCorner, floor + 400_mm, low_top};
    house = {kInnerCorner, middle - 60_mm, floor + 400_mm, low_top};
  }
  place_back_door(site_, side, garden);
  place_window_row(site_, side, house, 1, dressed_window(site_, 914_mm, floor + 1000_mm, 1050_mm));
  const Um upper = floor + kAdditionStorey, top = std::min(eaves - 60_mm, upper + 2300_mm);
  if (top - upper < 1500_mm) return;
  const Um sill = std::min(upper + 1100_mm, top - 900_mm);
  garden.v0 = house.v0 = upper + 500_mm;
  garden.v1 = house.v1 = top;
  place_window_row(site_, side, house, 1, dressed_window(site_, 488_mm, sill, 600_mm));
  place_window_row(site_, side, garden, 1, dressed_window(site_, 914_mm, sill, 1050_mm));
}

/// A kitchen extension under a roof that falls away from the house, with lights in it.
void RearLayout::place_lean_to() {
  BackAddition addition;
  const Um widest = plan_.frontage - 700_mm;
  addition.length = site_.length(2400_mm, 3000_mm);
  addition.slope = {site_.random.between(5, 8) * 50};
  addition.roof = AdditionRoof::to_garden;
  const Um width = site_.length(std::min(widest, 3200_mm), widest);
  addition.x0 = dwelling_.x0 + 350_mm + site_.length(0, widest - width);
  addition.x1 = addition.x0 + width;
  const Um highest = plan_.floor(1) + 400_mm;
  addition.eaves = std::min(plan_.floor(0) + 2200_mm, highest - addition.rise()) / 1'000 * 1'000;
  if (addition.eaves < 2150_mm) return;
  AdditionWalls walls = build(addition);
  fill_lean_to_end(walls.end, addition.eaves);
  const std::size_t plane = house_.roof.size() - 1;
  const Rect room = house_.roof[plane].usable;
  if (site_.chance(0.7)) place_rooflights(site_, house_, plane, room, site_.random.between(1, 3));
}

void RearLayout::fill_lean_to_end(Panel& end, Um eaves) {
  const Um width = end.usable.width(), split = width * 6 / 10'000 * 1'000, top = eaves - 60_mm;
  place_garden_window(site_, end, {kOuterCorner, split - 100_mm, 0, top});
  const Rect rest{split + 100_mm, width - kOuterCorner, plan_.floor(0) + 500_mm, top};
  if (rest.width() < 700_mm) return;
  place_window_row(site_, end, rest, 1,
                   dressed_window(site_, 914_mm, plan_.floor(0) + 950_mm, 1050_mm));
}

void RearLayout::fill_part(Rect room, int storey) {
  if (room.height() < 900_mm || room.width() < 700_mm) return;
  const Um floor = plan_.floor(storey);
  const bool reaches_floor = storey == 0 && wall().is_free({room.u0, room.u1, 0, room.v1}, 0);
  if (reaches_floor && room.width() >= 1400_mm && site_.chance(0.45)) {
    place_garden_window(site_, wall(), room);
  } else if (reaches_floor && site_.chance(0.3)) {
    place_back_door(site_, wall(), room);
  } else if (storey > 0 && site_.chance(0.3)) {
    place_window_row(site_, wall(), room, 1,
                     dressed_window(site_, 488_mm, floor + 1200_mm, 750_mm));
  } else {
    const Um height = plan_.kind == EnglishKind::semi ? 1200_mm : 1400_mm;
    const Um width = std::min(plan_.window_width, 1200_mm);
    place_window_row(site_, wall(), room, 1, dressed_window(site_, width, floor + 850_mm, height));
  }
}

/// Parts of the back wall of about 2 m, each with one opening a storey.
void RearLayout::fill_wall() {
  const Um u0 = plan_.width() - dwelling_.x1 + 250_mm, u1 = plan_.width() - dwelling_.x0 - 250_mm;
  for (int storey = 0; storey < plan_.storeys(); ++storey) {
    const Um v0 = plan_.floor(storey) + 600_mm;
    const Um v1 = std::min(plan_.floor(storey + 1) - kUnderNextFloor, wall().usable.v1 - 60_mm);
    for (const Rect& part : wall().free_parts({u0, u1, v0, v1}, v0, v1, 0)) {
      const int count = std::max(1, static_cast<int>(part.width() / 1900_mm));
      const Um pitch = part.width() / count / 1'000 * 1'000;
      for (int i = 0; i < count; ++i)
        fill_part({part.u0 + i * pitch + 60_mm, part.u0 + (i + 1) * pitch - 60_mm, v0, v1}, storey);
    }
  }
  if (!site_.chance(0.4)) return;
  const Um v = plan_.floor(0) + site_.length(1900_mm, 2300_mm);
  for (int attempt = 0; attempt < 4; ++attempt) {
    const std::size_t before = wall().reserved.size();
    place_flue_terminal(site_, wall(), site_.length(u0 + 100_mm, u1 - 200_mm), v);
    if (wall().reserved.size() > before) return;
  }
}

/// Windows of the stairs, a bathroom and a larder in the end wall of a pair.
void fill_semi_end(const EnglishSite& site, Panel& wall) {
  const EnglishPlan& plan = site.plan;
  const Um middle = plan.depth / 2'000 * 1'000, half_landing = plan.floor(1) - 300_mm;
  const auto place = [&](Um u, Um width, Um v0, Um height) {
    const Rect room{u - 700_mm, u + 700_mm, v0 - 200_mm,
                    std::min(v0 + height + 250_mm, wall.usable.v1 - 60_mm)};
    if (wall.is_free(room, 60_mm))
      place_window_row(site, wall, room, 1, dressed_window(site, width, v0, height));
  };
  if (site.chance(0.8)) place(middle, 630_mm, half_landing + 1000_mm, 1050_mm);
  if (site.chance(0.6)) place(middle + 2200_mm, 488_mm, plan.floor(1) + 1200_mm, 600_mm);
  if (site.chance(0.5)) place(middle - 2200_mm, 488_mm, plan.floor(0) + 1200_mm, 600_mm);
}

void place_garages(const EnglishSite& site, House& house) {
  SideGarage garage;
  garage.width = site.length(2600_mm, 2900_mm);
  garage.y0 = site.length(400_mm, 1800_mm);
  garage.y1 = garage.y0 + site.length(4900_mm, 5500_mm);
  garage.height = site.length(2450_mm, 2600_mm);
  for (const bool is_right : {false, true}) {
    garage.is_right = is_right;
    Panel front = add_side_garage(site.draft, house, garage);
    add_plain_door(site, front, centred(front.usable, 2134_mm, 0, 1981_mm), "garageDoor");
  }
}

}  // namespace

void lay_out_english_rear(const EnglishSite& site, House& house) {
  const EnglishPlan& plan = site.plan;
  for (int i = 0; i < plan.dwellings; ++i) {
    RearLayout rear(site, house, i);
    const bool is_second_of_two = i > 0 && dwelling_of(plan, i - 1).has_door_on_right;
    if (plan.yard > 0) {
      if (!is_second_of_two) rear.place_addition(dwelling_of(plan, i).has_door_on_right);
    } else if (site.chance(0.4)) {
      rear.place_lean_to();
    }
  }
  for (int i = 0; i < plan.dwellings; ++i) RearLayout(site, house, i).fill_wall();
}

void lay_out_english_ends(const EnglishSite& site, House& house) {
  const EnglishPlan& plan = site.plan;
  if (plan.has_garages) place_garages(site, house);
  if (plan.kind == EnglishKind::semi)
    for (const std::size_t side : {2U, 3U}) fill_semi_end(site, house.walls[side]);
  if (plan.kind != EnglishKind::terrace) return;
  for (Panel& gable : house.gables) {
    if (!site.chance(0.4)) continue;
    EnglishWindow window = dressed_window(site, 610_mm, gable.usable.v0 + 300_mm, 914_mm);
    window.subclass = "gableWindow";
    place_window_row(site, gable, gable.usable, 1, window);
  }
}

}  // namespace oriel::generator
