#include "examples/generator/english/english_front.h"

#include "examples/generator/english/bay_window.h"
#include "examples/generator/english/english_entrance.h"
#include "examples/generator/house/attachments.h"

#include <algorithm>

namespace oriel::generator {
namespace {

/// From the party line to the entrance, and between the entrance and the room beside it.
constexpr Um kPartyMargin = 250'000;
constexpr Um kBeside = 250'000;
/// What a storey keeps free under the next floor.
constexpr Um kUnderFloor = 250'000;

/// One dwelling of the front while it is filled.
class FrontLayout {
 public:
  FrontLayout(const EnglishSite& site, Panel& panel, const Dwelling& dwelling)
      : site_(site),
        plan_(site.plan),
        panel_(panel),
        dwelling_(dwelling),
        hall_(kPartyMargin + entrance_width(plan_) + kBeside),
        room_end_(dwelling.x1 - dwelling.x0 - 350_mm) {}

  void fill();

 private:
  /// The part between distances s0 and s1 from the party line on the door's side.
  [[nodiscard]] Rect band(Um s0, Um s1, int storey) const;
  [[nodiscard]] EnglishWindow window_of(int storey) const;
  /// Returns the height at which the bay's roof ends; 0 without a bay.
  Um place_bay();
  void place_cellar_windows();
  bool place_balcony();
  void fill_room(int storey, Um over_bay);
  void fill_over_door(int storey, Um over_entrance);

  const EnglishSite& site_;
  const EnglishPlan& plan_;
  Panel& panel_;
  const Dwelling dwelling_;
  /// Where the strip with the door ends and the one beside it starts, and where that one ends.
  Um hall_, room_end_;
};

Rect FrontLayout::band(Um s0, Um s1, int storey) const {
  const Um v0 = plan_.floor(storey) + 300_mm;
  const Um v1 = std::min(plan_.floor(storey + 1) - kUnderFloor, panel_.usable.v1 - 60_mm);
  if (dwelling_.has_door_on_right) return {dwelling_.x1 - s1, dwelling_.x1 - s0, v0, v1};
  return {dwelling_.x0 + s0, dwelling_.x0 + s1, v0, v1};
}

/// Tall windows on the main floors, lower ones above.
EnglishWindow FrontLayout::window_of(int storey) const {
  const bool is_town = plan_.kind == EnglishKind::town;
  const bool is_main = is_town ? storey <= 1 : storey == 0;
  Um height = is_main ? 1700_mm : is_town ? 1219_mm : 1524_mm, sill = is_main ? 650_mm : 750_mm;
  if (plan_.kind == EnglishKind::semi) {
    height = is_main ? 1350_mm : 1200_mm;
    sill = 850_mm;
  }
  const Um v0 = plan_.floor(storey) + sill;
  EnglishWindow window;
  window.rect = {0, plan_.window_width, v0, v0 + height};
  window.glazing = plan_.glazing;
  window.lights = plan_.window_width >= 1500_mm ? 3 : 2;
  window.is_dressed = true;
  return window;
}

Um FrontLayout::place_bay() {
  if (plan_.bay.storeys == 0) return 0;
  const int top = std::min(plan_.bay.storeys, plan_.storeys());
  const Um limit = panel_.usable.v1 - 100_mm;
  const Um eaves = std::min(plan_.floor(top) - kUnderFloor, limit);
  const Um highest = top == plan_.storeys() ? limit : plan_.floor(top) + 500_mm;
  return place_bay_window(site_, panel_, band(hall_, room_end_, 0), eaves, highest);
}

void FrontLayout::place_cellar_windows() {
  Rect low = band(hall_, room_end_, 0);
  low.v0 = 150_mm;
  low.v1 = plan_.floor(0) - 100_mm;
  EnglishWindow window;
  window.subclass = "cellarWindow";
  window.rect = {0, 800_mm, 250_mm, low.v1 - 100_mm};
  place_window_row(site_, panel_, low, 2, window);
}

/// A balcony on the first floor, of the whole house or its room, with a French window every 1.9 m.
bool FrontLayout::place_balcony() {
  const bool is_long = site_.chance(0.6);
  Rect place = band(is_long ? 200_mm : hall_, room_end_, 1);
  place.v0 = plan_.floor(1);
  if (!panel_.is_free({place.u0, place.u1, place.v0 - 200_mm, place.v1}, 60_mm)) return false;
  place_english_balcony(site_, panel_, place, site_.length(950_mm, 1100_mm));
  const Um height = std::min(site_.length(2100_mm, 2300_mm), place.height());
  const int doors = std::max(1, static_cast<int>(place.width() / 1900_mm));
  const Um pitch = place.width() / doors / 1'000 * 1'000;
  for (int i = 0; i < doors; ++i) {
    const Rect cell{place.u0 + i * pitch, place.u0 + (i + 1) * pitch, place.v0, place.v1};
    add_plain_door(site_, panel_, centred(cell, site_.length(900_mm, 1200_mm), place.v0, height),
                   "frenchWindow");
  }
  return true;
}

void FrontLayout::fill_room(int storey, Um over_bay) {
  if (over_bay > 0 && storey < plan_.bay.storeys) return;
  Rect room = band(hall_, room_end_, storey);
  room.v0 = std::max(room.v0, over_bay + 60_mm);
  const bool is_wide = room.width() >= 2 * plan_.window_width + 1000_mm;
  place_window_row(site_, panel_, room, is_wide ? 2 : 1, window_of(storey));
}

void FrontLayout::fill_over_door(int storey, Um over_entrance) {
  if (site_.chance(0.2)) return;
  Rect room = band(100_mm, hall_ - 100_mm, storey);
  room.v0 = std::max(room.v0, over_entrance + 100_mm);
  EnglishWindow window = window_of(storey);
  if (plan_.kind != EnglishKind::town) window.rect.u1 = 610_mm;
  window.lights = plan_.glazing == Glazing::barred ? 2 : 1;
  place_window_row(site_, panel_, room, 1, window);
}

void FrontLayout::fill() {
  const Rect hall = band(kPartyMargin, hall_ - kBeside, 0);
  const Rect entrance = place_entrance(site_, panel_, (hall.u0 + hall.u1) / 2, hall.v1);
  const Um over_bay = place_bay();
  if (plan_.has_cellar) place_cellar_windows();
  const bool has_balcony = plan_.has_balconies && over_bay == 0 && place_balcony();
  for (int storey = 0; storey < plan_.storeys(); ++storey) {
    if (storey == 1 && has_balcony) continue;
    fill_room(storey, over_bay);
    if (storey > 0) fill_over_door(storey, entrance.v1);
  }
}

/// Bands of stone under the first floor, and a cornice under the parapet.
void add_stone_bands(const EnglishSite& site, Panel& panel) {
  const EnglishPlan& plan = site.plan;
  const auto add = [&](std::string_view subclass, Um v0, Um v1, Um depth) {
    for (const Rect& piece : panel.free_parts({0, plan.width(), v0, v1}, v0, v1, 60_mm))
      if (piece.width() >= 600_mm) add_decor(site.draft, panel, subclass, piece, depth);
  };
  add("band", plan.floor(1) - 150_mm, plan.floor(1) - 20_mm, 40_mm);
  if (plan.parapet > 0)
    add("cornice", plan.wall_height() - 100_mm, plan.wall_height() + 150_mm, 180_mm);
}

/// The windows of one storey of a bay: one or two in front, a narrow one in each side.
void fill_bay_storey(const EnglishSite& site, BayFaces& faces, Um v0, Um v1) {
  const Um sill = site.plan.kind == EnglishKind::semi ? 750_mm : 600_mm;
  for (Panel* face : {&faces.left, &faces.front, &faces.right}) {
    const bool is_front = face == &faces.front, is_canted = faces.stretch > 1;
    const Um margin = is_front ? 150_mm : is_canted ? 110_mm : 220_mm;
    const Rect& all = face->usable;
    const Rect room{all.u0 + margin, all.u1 - margin, v0 + 400_mm, v1 - 150_mm};
    const int count = is_front && room.width() >= 1900_mm ? 2 : 1;
    EnglishWindow window;
    window.glazing = site.plan.glazing;
    const Um width = (room.width() - (count - 1) * 200_mm) / count / 1'000 * 1'000;
    window.rect = {0, width, v0 + sill, v1 - 250_mm};
    window.lights = is_front && width >= 1000_mm ? 2 : 1;
    window.stretch = is_front ? 1 : faces.stretch;
    place_window_row(site, *face, room, count, window);
  }
}

}  // namespace

Dwelling dwelling_of(const EnglishPlan& plan, int index) {
  return {index * plan.frontage, (index + 1) * plan.frontage,
          index % 2 == 0 && index + 1 < plan.dwellings};
}

Um place_bay_window(const EnglishSite& site, Panel& panel, const Rect& zone, Um eaves, Um highest) {
  const EnglishPlan& plan = site.plan;
  const Um width = std::min(plan.bay.width, zone.width()) / 2'000 * 2'000;
  if (width < 1900_mm) return 0;
  BayWindow bay;
  bay.is_canted = plan.bay.is_canted;
  bay.depth = plan.bay.depth;
  if (bay.is_canted) bay.depth = std::min(bay.depth, (width - 900_mm) / 2'000 * 1'000);
  bay.rect = centred(zone, width, 0, eaves);
  // Lead roofs are flat, slates need 25 degrees and more.
  const int slope = site.chance(0.25) ? 0 : site.random.between(10, 18) * 50;
  const Um steep = bay.depth / 1'000 * slope / 1'000 * 1'000;
  bay.rise = std::min(steep, (highest - eaves) / 1'000 * 1'000);
  if (bay.rise < 120_mm) bay.rise = 0;
  BayFaces faces = add_bay_window(site.draft, panel, bay);
  const int storeys = std::min(plan.bay.storeys, plan.storeys());
  for (int storey = 0; storey < storeys; ++storey)
    fill_bay_storey(site, faces, plan.floor(storey), std::min(plan.floor(storey + 1), eaves));
  return bay.rect.v1 + bay.rise;
}

void place_english_balcony(const EnglishSite& site, Panel& panel, const Rect& band, Um parapet) {
  Balcony balcony;
  balcony.slab = site.length(100_mm, 180_mm);
  balcony.depth = site.length(600_mm, 1100_mm);
  // Railings of iron are thin, parapets of brick half a brick.
  balcony.parapet = site.plan.kind == EnglishKind::town ? 50_mm : 103_mm;
  balcony.rect = {band.u0, band.u1, band.v0 - balcony.slab, band.v0 + parapet};
  add_balcony(site.draft, panel, balcony);
}

void lay_out_english_front(const EnglishSite& site, House& house) {
  Panel& panel = house.walls[0];
  for (int i = 0; i < site.plan.dwellings; ++i)
    FrontLayout(site, panel, dwelling_of(site.plan, i)).fill();
  if (site.plan.has_bands) add_stone_bands(site, panel);
}

}  // namespace oriel::generator
