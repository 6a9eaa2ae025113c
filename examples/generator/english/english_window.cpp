#include "examples/generator/english/english_window.h"

#include "examples/generator/house/attachments.h"
#include "examples/generator/house/extrude.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace oriel::generator {
namespace {

/// The lower sash slides behind the upper one: the thickness of a sash of 1 3/4 inches.
constexpr Um kSashStep = 45'000;
/// Width of stiles, rails, mullions and transoms around panes, and how far panes lie behind them.
constexpr Um kStile = 60'000;
constexpr Um kGlassDepth = 20'000;
/// Sills stick out and reach past the window by a quarter of a brick, lintels by a tenth and half
/// of one.
constexpr Um kSillDepth = 55'000, kSillHorn = 55'000;
constexpr Um kLintelDepth = 20'000, kLintelBearing = 110'000;
constexpr Um kSmallest = 300'000;

Um whole_mm(double length) { return std::llround(length / 1000) * 1000; }

/// Windows lose their division where there is no room for it.
Glazing glazing_of(const EnglishWindow& window) {
  const bool is_small = window.rect.width() < 450_mm || window.rect.height() < 700_mm;
  return is_small ? Glazing::plain : window.glazing;
}

/// Cuts one window; its members are the facets and depths that the steps share.
class WindowCutter {
 public:
  WindowCutter(Draft& draft, Panel& panel, const EnglishWindow& window, Um reveal)
      : draft_(draft),
        panel_(panel),
        window_(window),
        glazing_(glazing_of(window)),
        reveal_(in_frame(reveal)) {}

  void cut();

 private:
  /// A depth along the panel's w, whose steps may be longer than a metre is.
  [[nodiscard]] Um in_frame(Um depth) const {
    return whole_mm(static_cast<double>(depth) / window_.stretch);
  }
  [[nodiscard]] Um half_height() const {
    return whole_mm(static_cast<double>(window_.rect.height()) / 2);
  }
  [[nodiscard]] Um depth_behind_leaf() const;
  void sink_sash();
  void sink_lights(Um split);

  Draft& draft_;
  Panel& panel_;
  const EnglishWindow& window_;
  Glazing glazing_;
  Um reveal_;
  FacetId leaf_{};
  BlockFacets niche_;
};

/// Windows that are flush are one pane.
Um WindowCutter::depth_behind_leaf() const {
  if (glazing_ == Glazing::plain || reveal_ == 0) return 0;
  return in_frame(glazing_ == Glazing::sash ? kSashStep : kGlassDepth);
}

void WindowCutter::cut() {
  const Rect& r = window_.rect;
  const double depth = static_cast<double>(reveal_ + depth_behind_leaf());
  const int object = draft_.add_object({Class::window,
                                        std::string(window_.subclass),
                                        draft_.owner(panel_.facet).object,
                                        panel_.installation,
                                        std::llround(depth * window_.stretch),
                                        {}});
  leaf_ = draft_.add_facet({object});
  panel_.reserved.push_back(r);
  if (reveal_ == 0) {
    draft_.add_ring(panel_.facet, reversed(rectangle(panel_.frame, r, 0)));
    draft_.add_ring(leaf_, rectangle(panel_.frame, r, 0));
    return;
  }
  niche_ = carve_block(
      draft_, panel_.frame, {r.u0, r.u1, r.v0, r.v1, -reveal_, 0}, {object, true},
      {.bottom = r.v0 == 0 ? panel_.ground : kNewFacet, .back = leaf_, .front = panel_.facet});
  if (glazing_ == Glazing::sash) sink_sash();
  if (glazing_ == Glazing::barred) sink_lights(half_height());
  if (glazing_ == Glazing::casement) sink_lights(whole_mm(static_cast<double>(r.height()) * 0.68));
}

/// The lower half of the window lies further back.
void WindowCutter::sink_sash() {
  const Rect& r = window_.rect;
  carve_block(
      draft_, panel_.frame,
      {r.u0, r.u1, r.v0, r.v0 + half_height(), -reveal_ - depth_behind_leaf(), -reveal_},
      draft_.owner(leaf_),
      {.left = niche_.left, .right = niche_.right, .bottom = niche_.bottom, .front = leaf_});
}

/// Panes behind the frame, `lights` side by side, below and above a bar at this height.
void WindowCutter::sink_lights(Um split) {
  struct Row {
    Um v0, v1;
  };
  const Rect& r = window_.rect;
  const Um stile = in_frame(kStile), lights = window_.lights;
  const Um width = (r.width() - (lights + 1) * stile) / lights / 1000 * 1000;
  for (const Row& row : {Row{r.v0 + kStile, r.v0 + split - kStile / 2},
                         Row{r.v0 + split + kStile / 2, r.v1 - kStile}})
    for (Um light = 0; light < lights; ++light) {
      const Um u0 = r.u0 + stile + light * (width + stile);
      carve_block(draft_, panel_.frame,
                  {u0, u0 + width, row.v0, row.v1, -reveal_ - depth_behind_leaf(), -reveal_},
                  draft_.owner(leaf_), {.front = leaf_});
    }
}

/// The part of the room that its sill and lintel leave to the window.
Rect room_inside(const EnglishPlan& plan, const Rect& room, const EnglishWindow& window) {
  if (!window.is_dressed) return room;
  const Um side = plan.lintel > 0 ? kLintelBearing : plan.sill > 0 ? kSillHorn : 0;
  return {room.u0 + side, room.u1 - side, room.v0 + plan.sill, room.v1 - plan.lintel};
}

/// The window's rectangle inside the room, moved and then resized by up to the plan's jitter.
Rect placed_in(const EnglishSite& site, const EnglishWindow& window, const Rect& room) {
  Rect rect = window.rect;
  const Um width = std::min(rect.width(), room.width());
  const Um height = std::min(rect.height(), room.height());
  const Um u0 = std::clamp(rect.u0, room.u0, room.u1 - width);
  const Um v0 = std::clamp(rect.v0, room.v0, room.v1 - height);
  rect = {u0, u0 + width, v0, v0 + height};
  if (site.plan.jitter == 0) return rect;
  const Um up = site.plan.jitter, across = whole_mm(static_cast<double>(up) / window.stretch);
  const auto shift = [&](Um most) { return site.random.between(-most, most, 1'000); };
  const Um du = shift(across), dv = shift(up);
  rect = rect.moved(du, dv);
  rect.u0 = std::clamp(rect.u0 + shift(across), room.u0, room.u1 - kSmallest);
  rect.u1 = std::clamp(rect.u1 + shift(across), rect.u0 + kSmallest, room.u1);
  rect.v0 = std::clamp(rect.v0 + shift(up), room.v0, room.v1 - kSmallest);
  rect.v1 = std::clamp(rect.v1 + shift(up), rect.v0 + kSmallest, room.v1);
  return rect;
}

void dress(const EnglishSite& site, Panel& panel, const Rect& r) {
  const EnglishPlan& plan = site.plan;
  if (plan.sill > 0)
    add_decor(site.draft, panel, "sill",
              {r.u0 - kSillHorn, r.u1 + kSillHorn, r.v0 - plan.sill, r.v0}, kSillDepth);
  if (plan.lintel > 0)
    add_decor(site.draft, panel, "lintel",
              {r.u0 - kLintelBearing, r.u1 + kLintelBearing, r.v1, r.v1 + plan.lintel},
              kLintelDepth);
}

}  // namespace

Rect centred(const Rect& room, Um width, Um v0, Um height) {
  const Um u0 = (room.u0 + room.u1 - width) / 2'000 * 1'000;
  return {u0, u0 + width, v0, v0 + height};
}

bool place_window(const EnglishSite& site, Panel& panel, const Rect& room,
                  const EnglishWindow& window) {
  const Rect inside = room_inside(site.plan, room, window);
  if (inside.width() < kSmallest || inside.height() < kSmallest) return false;
  EnglishWindow placed = window;
  placed.rect = placed_in(site, window, inside);
  if (placed.rect.width() < kSmallest || placed.rect.height() < kSmallest) return false;
  WindowCutter(site.draft, panel, placed, site.reveal()).cut();
  if (window.is_dressed) dress(site, panel, placed.rect);
  return true;
}

void place_window_row(const EnglishSite& site, Panel& panel, const Rect& band, int count,
                      const EnglishWindow& window) {
  const Um gap = 100_mm;
  const Um width = (band.width() - (count - 1) * gap) / count / 1'000 * 1'000;
  for (int i = 0; i < count; ++i) {
    const Um u0 = band.u0 + i * (width + gap);
    const Rect room{u0, u0 + width, band.v0, band.v1};
    EnglishWindow placed = window;
    placed.rect = centred(room, window.rect.width(), window.rect.v0, window.rect.height());
    place_window(site, panel, room, placed);
  }
}

}  // namespace oriel::generator
