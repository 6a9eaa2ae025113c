#include "examples/generator/house/roof_layout.h"

#include "examples/generator/facade/openings.h"
#include "examples/generator/house/rooftop.h"

#include <algorithm>

namespace oriel::generator {
namespace {

constexpr Um kDistance = 200'000;

/// Lays out one roof.
class RoofLayout {
 public:
  RoofLayout(Draft& draft, House& house, const Plan& plan, Random& random)
      : draft_(draft), house_(house), plan_(plan), random_(random) {}

  void place_chimney();
  void place_dormers();
  void place_roof_windows();
  void place_vents();

 private:
  Um draw(Um low, Um high, Um step = 10'000) { return random_.between(low, high, step); }
  RoofPlane& draw_plane() {
    return house_
        .roof[static_cast<std::size_t>(random_.below(static_cast<int>(house_.roof.size())))];
  }
  /// A free rectangle of this size somewhere in the plane; empty (u0 = u1) if none was found.
  Rect draw_place(const RoofPlane& plane, Um width, Um height);
  bool place_ridge_chimney(Chimney chimney, Um width, Um depth);
  bool goes_on_apex(bool has_apex, bool has_ridge);
  Dormer draw_dormer(const RoofPlane& plane);
  void fill_dormer(Panel front);

  Draft& draft_;
  House& house_;
  const Plan& plan_;
  Random& random_;
};

Rect RoofLayout::draw_place(const RoofPlane& plane, Um width, Um height) {
  const Rect& room = plane.usable;
  if (room.width() < width || room.height() < height) return {};
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Um u0 = draw(room.u0, room.u1 - width), v0 = draw(room.v0, room.v1 - height);
    const Rect rect{u0, u0 + width, v0, v0 + height};
    if (is_roof_free(house_, to_plan(plane, rect), kDistance)) return rect;
  }
  return {};
}

/// Whether a chimney of the ridge goes over the ridge's end where hips meet.
bool RoofLayout::goes_on_apex(bool has_apex, bool has_ridge) {
  const bool is_drawn = has_apex && (!has_ridge || random_.chance(0.5));
  return plan_.chimney ? *plan_.chimney == ChimneyPlace::apex : is_drawn;
}

/// Across the ridge, or over one of its ends where hips meet there.
bool RoofLayout::place_ridge_chimney(Chimney chimney, Um width, Um depth) {
  if (house_.ridge.empty()) return false;
  const Point start = house_.ridge.front(), end = house_.ridge.back();
  const Um margin = plan_.massing.overhang + 800_mm;
  const Um half_width = width / 20'000 * 10'000, half_depth = depth / 20'000 * 10'000;
  const bool has_apex = plan_.massing.roof == RoofKind::hip;
  const bool has_ridge = end.x - start.x >= 2 * margin + width;
  if (!has_ridge && !has_apex) return false;
  Um x = draw(start.x + margin + half_width, end.x - margin - half_width);
  const bool is_on_apex = goes_on_apex(has_apex, has_ridge);
  if (is_on_apex ? !has_apex : !has_ridge) return false;
  if (is_on_apex) x = start.x;
  // Off the middle: a chimney rarely stands on the ridge exactly.
  const Um y = is_on_apex ? start.y : start.y + draw(-half_depth / 2, half_depth / 2);
  chimney.plan = {x - half_width, x + half_width, y - half_depth, y + half_depth};
  chimney.top = start.z + draw(500_mm, 1100_mm);
  if (!is_roof_free(house_, chimney.plan, kDistance)) return false;
  add_chimney(draft_, house_, chimney);
  return true;
}

void RoofLayout::place_chimney() {
  Chimney chimney;
  const Um depth = draw(450_mm, 700_mm);
  chimney.flues = random_.between(1, 2);
  const Um width = depth + (chimney.flues - 1) * draw(300_mm, 450_mm);
  if (random_.chance(0.3)) chimney.cap = 60_mm;
  const bool is_drawn = random_.chance(0.45);
  const bool is_on_ridge = plan_.chimney ? *plan_.chimney != ChimneyPlace::slope : is_drawn;
  if (is_on_ridge && place_ridge_chimney(chimney, width, depth)) return;
  if (is_on_ridge && plan_.chimney) return;
  const RoofPlane& plane = draw_plane();
  const Rect place = draw_place(plane, width, depth);
  if (place == Rect{}) return;
  const Um above = plane.frame.origin.z + plane.slope.rise(place.v1) + draw(600_mm, 1200_mm);
  chimney.plan = to_plan(plane, place);
  chimney.top = house_.ridge.empty() ? above : std::max(above, house_.ridge[0].z - 200_mm);
  add_chimney(draft_, house_, chimney);
}

/// A dormer that fits the plane at u0 = 0; v1 = 0 if none does.
Dormer RoofLayout::draw_dormer(const RoofPlane& plane) {
  const Um slope = plane.slope.per_mille;
  const auto run = [](Um rise, Um per_mille) { return rise / per_mille / 10 * 10'000; };
  Dormer dormer;
  dormer.u1 = draw(1300_mm, 2400_mm, 20'000);
  dormer.v0 = plane.usable.v0 + draw(100_mm, 700_mm);
  const Um height = draw(1050_mm, 1500_mm);
  const Um own_rise = dormer.u1 / 2 * random_.between(5, 9) / 10;
  dormer.slope = {random_.between(0, 5) * 50};
  if (random_.chance(0.5)) {
    dormer.eaves = dormer.v0 + run(height, slope);
    dormer.v1 = dormer.eaves + run(own_rise, slope);
  } else {
    dormer.v1 = dormer.v0 + run(height + 200_mm, slope - dormer.slope.per_mille);
  }
  if (dormer.v1 > plane.usable.v1) dormer.v1 = 0;
  return dormer;
}

/// One window, or two side by side in a wide front; little is left of the front around them.
void RoofLayout::fill_dormer(Panel front) {
  const Um side = draw(20_mm, 150_mm), above = draw(20_mm, 120_mm), gap = 120_mm;
  const Um recess = random_.chance(plan_.flush) ? 0 : std::min(plan_.window.recess, 120_mm);
  const Rect all{front.usable.u0 + side, front.usable.u1 - side, front.usable.v0 + above,
                 front.usable.v1 - above};
  const int count = all.width() >= 1600_mm ? random_.between(1, 2) : 1;
  const Um width = (all.width() - (count - 1) * gap) / count / 1'000 * 1'000;
  for (int i = 0; i < count; ++i) {
    const Um u0 = all.u0 + i * (width + gap);
    add_opening(draft_, front, {Class::window, "Window", {u0, u0 + width, all.v0, all.v1}, recess});
  }
}

void RoofLayout::place_dormers() {
  for (RoofPlane& plane : house_.roof) {
    if (plane.slope.per_mille < 500 || plane.usable.width() < 1400_mm) continue;
    Dormer shape;
    for (int attempt = 0; attempt < 8 && shape.v1 == 0; ++attempt) shape = draw_dormer(plane);
    if (shape.v1 == 0 || shape.u1 > plane.usable.width()) continue;
    const int most = std::max(1, static_cast<int>(plane.usable.width() / 3'500'000));
    const int count = random_.between(1, most);
    const Um pitch = plane.usable.width() / count / 10'000 * 10'000;
    for (int i = 0; i < count; ++i) {
      Dormer dormer = shape;
      dormer.u0 = plane.usable.u0 + i * pitch + (pitch - shape.u1) / 20'000 * 10'000;
      dormer.u1 = dormer.u0 + shape.u1;
      const Rect place{dormer.u0, dormer.u1, dormer.v0, dormer.v1};
      if (!plane.is_free(place, kDistance)) continue;
      fill_dormer(add_dormer(draft_, plane, dormer));
    }
  }
}

void RoofLayout::place_roof_windows() {
  const int count = random_.between(1, 4);
  const Um width = draw(600_mm, 1100_mm), height = draw(700_mm, 1100_mm);
  const Um drop = random_.chance(plan_.flush) ? 0 : draw(50_mm, 120_mm);
  for (int i = 0; i < count; ++i) {
    RoofPlane& plane = draw_plane();
    const Rect place = draw_place(plane, width, height);
    if (place != Rect{}) add_roof_window(draft_, plane, place, drop);
  }
}

void RoofLayout::place_vents() {
  const int count = random_.between(1, 3);
  for (int i = 0; i < count; ++i) {
    const bool is_round = random_.chance(0.5);
    const Um width = is_round ? draw(120_mm, 240_mm, 20'000) : draw(250_mm, 600_mm);
    const Um height = draw(200_mm, 450_mm);
    const RoofPlane& plane = draw_plane();
    const Rect place = draw_place(plane, width, width);
    if (place == Rect{}) continue;
    const Um top = plane.frame.origin.z + plane.slope.rise(place.v1) + height;
    add_vent(draft_, house_, to_plan(plane, place), top, is_round);
  }
}

}  // namespace

void lay_out_roof(Draft& draft, House& house, const Plan& plan, Random& random) {
  RoofLayout roof(draft, house, plan, random);
  const int chimneys = random.chance(0.3) ? 2 : 1;
  if (plan.has(Feature::chimney))
    for (int i = 0; i < chimneys; ++i) roof.place_chimney();
  if (plan.has(Feature::dormer)) roof.place_dormers();
  if (plan.has(Feature::roof_window)) roof.place_roof_windows();
  if (plan.has(Feature::vent)) roof.place_vents();
}

}  // namespace oriel::generator
