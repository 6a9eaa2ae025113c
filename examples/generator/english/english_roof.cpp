#include "examples/generator/english/english_roof.h"

#include "examples/generator/english/english_front.h"
#include "examples/generator/english/party_wall.h"
#include "examples/generator/facade/openings.h"

#include <algorithm>
#include <array>
#include <cmath>

// Where sizes come from: roof windows after Velux's size chart; dormers at least 0.2 m behind the
// eaves: General Permitted Development Order 2015, schedule 2, part 1, class B.2(b); vent pipes
// that end 0.9 m over openings within 3 m: NHBC Standards 8.1.6 after Approved Document H1.

namespace oriel::generator {
namespace {

constexpr std::size_t kStreet = 0;
constexpr Um kRoofDistance = 150'000;
/// A party wall of one brick.
constexpr Um kPartyWall = 225'000;
constexpr Um kPipeWidth = 110'000;

/// Fills the main roof of a row.
class EnglishRoof {
 public:
  EnglishRoof(const EnglishSite& site, EnglishShell& shell)
      : site_(site), plan_(site.plan), shell_(shell), house_(shell.house) {}

  void place_party_wall(int line);
  void place_dwelling(int index);
  void place_flat_roof();

 private:
  /// The plane that falls towards the garden.
  [[nodiscard]] std::size_t garden() const { return plan_.roof == RoofKind::hip ? 2 : 1; }
  [[nodiscard]] bool is_free(const Rect& plan, Um distance = kRoofDistance) const {
    return is_roof_free(house_, plan, distance);
  }
  [[nodiscard]] bool has_stack(int line) const;
  /// A strip of this width over the party wall; at the row's ends flush with the gable.
  [[nodiscard]] Rect strip(int line, Um width) const;
  /// The dwelling's part of a plane, in (u, v), free of its party walls and hips.
  [[nodiscard]] Rect share(const RoofPlane& plane, const Dwelling& dwelling) const;
  void place_box_dormer(const Dwelling& dwelling);
  void place_gabled_dormer(const Dwelling& dwelling);
  void add_filled_dormer(RoofPlane& plane, const Dormer& dormer);
  void place_pipe(const Dwelling& dwelling);

  const EnglishSite& site_;
  const EnglishPlan& plan_;
  EnglishShell& shell_;
  House& house_;
};

/// Between dwellings always, at the ends of a row of gables as drawn.
bool EnglishRoof::has_stack(int line) const {
  if (line > 0 && line < plan_.dwellings) return true;
  return plan_.roof == RoofKind::gable && plan_.overhang == 0 && site_.chance(0.6);
}

Rect EnglishRoof::strip(int line, Um width) const {
  const Um x = line * plan_.frontage;
  const Um u0 = line == 0 ? 0 : line == plan_.dwellings ? x - width : x - width / 2'000 * 1'000;
  return {u0, u0 + width, 0, plan_.depth};
}

void EnglishRoof::place_party_wall(int line) {
  const Point ridge = house_.ridge.front();
  Upstand upstand;
  if (has_stack(line)) {
    Stack stack;
    stack.plan = strip(line, plan_.stack.width);
    stack.plan.v0 = ridge.y - plan_.stack.length / 2'000 * 1'000;
    stack.plan.v1 = stack.plan.v0 + plan_.stack.length;
    stack.top = ridge.z + plan_.stack.over_ridge;
    stack.columns = plan_.stack.columns;
    stack.rows = plan_.stack.rows;
    stack.pot = plan_.stack.pot;
    upstand.stack = add_stack(site_.draft, house_, stack);
    upstand.stack_y0 = stack.plan.v0;
    upstand.stack_y1 = stack.plan.v1;
  }
  if (plan_.upstand == 0) return;
  const Rect wall = strip(line, kPartyWall);
  upstand.x0 = wall.u0;
  upstand.x1 = wall.u1;
  upstand.height = plan_.upstand;
  upstand.front = shell_.parapet;
  if (line == 0) upstand.west = house_.walls[2].facet;
  if (line == plan_.dwellings) upstand.east = house_.walls[3].facet;
  add_upstand(site_.draft, house_, upstand);
}

Rect EnglishRoof::share(const RoofPlane& plane, const Dwelling& dwelling) const {
  const Rect all = to_plane(plane, {dwelling.x0, dwelling.x1, 0, plan_.depth});
  const Um margin = std::max(plan_.stack.width / 2, kPartyWall) + 300_mm;
  return {std::max(all.u0 + margin, plane.usable.u0), std::min(all.u1 - margin, plane.usable.u1),
          plan_.overhang + 250_mm, plane.usable.v1};
}

/// One or two windows that leave little of the dormer's front.
void EnglishRoof::add_filled_dormer(RoofPlane& plane, const Dormer& dormer) {
  if (!is_free(to_plan(plane, {dormer.u0, dormer.u1, dormer.v0, dormer.v1}))) return;
  Panel front = add_dormer(site_.draft, plane, dormer);
  const Rect& all = front.usable;
  const int count = all.width() >= 2600_mm ? 2 : 1;
  const Um width = std::min((all.width() - 200_mm) / count - 200_mm, 1500_mm) / 1'000 * 1'000;
  const Um height = std::min(all.height() - 100_mm, 1219_mm);
  EnglishWindow window;
  window.glazing = plan_.glazing;
  window.lights = 2;
  window.rect = {0, width, all.v1 - 80_mm - height, all.v1 - 80_mm};
  place_window_row(site_, front, all.grown(-20_mm), count, window);
}

/// The flat-roofed dormer of a converted loft, nearly as wide as the house.
void EnglishRoof::place_box_dormer(const Dwelling& dwelling) {
  RoofPlane& plane = house_.roof[garden()];
  const Rect room = share(plane, dwelling);
  if (room.width() < 2000_mm || plane.slope.per_mille < 600) return;
  Dormer dormer;
  const Um width = std::min(room.width(), site_.length(2000_mm, 4200_mm)) / 20'000 * 20'000;
  dormer.u0 = room.u0;
  dormer.u1 = room.u0 + width;
  dormer.v0 = room.v0 + site_.length(0, 300_mm);
  dormer.slope = {site_.random.between(0, 1) * 50};
  const Um height = site_.length(1500_mm, 2200_mm);
  const Um run = height / (plane.slope.per_mille - dormer.slope.per_mille) / 10 * 10'000;
  dormer.v1 = std::min(dormer.v0 + run, room.v1);
  if (plane.slope.rise(dormer.v1 - dormer.v0) >= 1200_mm) add_filled_dormer(plane, dormer);
}

/// A small dormer of an attic, on the street side.
void EnglishRoof::place_gabled_dormer(const Dwelling& dwelling) {
  RoofPlane& plane = house_.roof[kStreet];
  const Rect room = share(plane, dwelling);
  const Um width = site_.length(1200_mm, 1700_mm) / 20'000 * 20'000;
  if (room.width() < width || plane.slope.per_mille < 500) return;
  const auto run = [&](Um rise) { return rise / plane.slope.per_mille / 10 * 10'000; };
  Dormer dormer;
  dormer.u0 = room.u0 + (room.width() - width) / 20'000 * 10'000;
  dormer.u1 = dormer.u0 + width;
  dormer.v0 = room.v0 + site_.length(200_mm, 600_mm);
  dormer.eaves = dormer.v0 + run(site_.length(1100_mm, 1400_mm));
  dormer.v1 = dormer.eaves + run(width / 2 * site_.random.between(6, 9) / 10);
  if (dormer.v1 <= room.v1) add_filled_dormer(plane, dormer);
}

void EnglishRoof::place_pipe(const Dwelling& dwelling) {
  const RoofPlane& plane = house_.roof[garden()];
  const Rect room = share(plane, dwelling);
  if (room.width() < 600_mm) return;
  const Um u0 = site_.length(room.u0, room.u1 - kPipeWidth);
  const Um v0 = site_.length(room.v0, room.v1 - 400_mm);
  const Rect place = to_plan(plane, {u0, u0 + kPipeWidth, v0, v0 + kPipeWidth});
  if (!is_free(place)) return;
  const Um foot = plane.frame.origin.z + plane.slope.rise(v0 + kPipeWidth);
  add_vent(site_.draft, house_, place, foot + site_.length(450_mm, 900_mm), true);
}

void EnglishRoof::place_dwelling(int index) {
  const Dwelling dwelling = dwelling_of(plan_, index);
  const bool has_attic = plan_.kind == EnglishKind::town || plan_.kind == EnglishKind::flats;
  if (site_.chance(has_attic ? 0.5 : 0.15)) place_gabled_dormer(dwelling);
  if (site_.chance(0.35)) place_box_dormer(dwelling);
  for (const std::size_t plane : {kStreet, garden()}) {
    if (!site_.chance(0.35)) continue;
    Rect room = share(house_.roof[plane], dwelling);
    room.v0 += 500_mm;
    place_rooflights(site_, house_, plane, room, site_.random.between(1, 3));
  }
  if (site_.chance(0.55)) place_pipe(dwelling);
}

/// Stacks, vents and pipes behind the parapet of flats.
void EnglishRoof::place_flat_roof() {
  const Rect room = house_.roof[0].usable;
  const Um z = house_.roof[0].frame.origin.z;
  const auto draw_place = [&](Um width, Um length) {
    const Um x = site_.length(room.u0, room.u1 - width);
    const Um y = site_.length(room.v0, room.v1 - length);
    return Rect{x, x + width, y, y + length};
  };
  const int stacks = site_.random.between(2, 4), vents = site_.random.between(1, 4);
  for (int i = 0; i < stacks; ++i) {
    const Rect place = draw_place(plan_.stack.width, plan_.stack.length);
    if (!is_free(place, 800_mm)) continue;
    add_stack(site_.draft, house_,
              {place, z + plan_.parapet + plan_.stack.over_ridge, plan_.stack.columns,
               plan_.stack.rows, plan_.stack.pot});
  }
  for (int i = 0; i < vents; ++i) {
    const bool is_pipe = site_.chance(0.5);
    const Um width = is_pipe ? kPipeWidth : site_.length(300_mm, 600_mm);
    const Rect place = draw_place(width, width);
    if (is_free(place, 500_mm))
      add_vent(site_.draft, house_, place, z + site_.length(400_mm, 900_mm), is_pipe);
  }
}

}  // namespace

void place_rooflights(const EnglishSite& site, House& house, std::size_t plane, const Rect& room,
                      int count) {
  struct Size {
    Um width, height;
  };
  constexpr std::array<Size, 5> sizes{{{550_mm, 780_mm},
                                       {550_mm, 980_mm},
                                       {780_mm, 980_mm},
                                       {780_mm, 1180_mm},
                                       {1140_mm, 1180_mm}}};
  const Size size = sizes[static_cast<std::size_t>(site.random.below(5))];
  RoofPlane& target = house.roof[plane];
  // Sizes are along the slope, rectangles seen from above.
  const double cosine = 1 / std::hypot(1.0, target.slope.per_mille / 1000.0);
  const Um height = std::llround(static_cast<double>(size.height) * cosine / 1000) * 1000;
  const Um drop = site.chance(site.plan.flush) ? 0 : site.length(30_mm, 60_mm);
  const Um pitch = room.width() / count / 1'000 * 1'000;
  if (room.height() < height || pitch < size.width + kRoofDistance) return;
  const Um v0 = site.length(room.v0, room.v1 - height);
  for (int i = 0; i < count; ++i) {
    const Um u0 = room.u0 + i * pitch + (pitch - size.width) / 2'000 * 1'000;
    const Rect rect{u0, u0 + size.width, v0, v0 + height};
    if (is_roof_free(house, to_plan(target, rect), kRoofDistance))
      add_roof_window(site.draft, target, rect, drop);
  }
}

void lay_out_english_roof(const EnglishSite& site, EnglishShell& shell) {
  EnglishRoof roof(site, shell);
  if (site.plan.roof == RoofKind::flat) {
    roof.place_flat_roof();
    return;
  }
  for (int line = 0; line <= site.plan.dwellings; ++line) roof.place_party_wall(line);
  for (int i = 0; i < site.plan.dwellings; ++i) roof.place_dwelling(i);
}

}  // namespace oriel::generator
