#pragma once

#include "examples/generator/english/english_plan.h"
#include "examples/generator/facade/panel.h"

#include <string_view>

namespace oriel::generator {

/// A row under construction: what its features are drawn from and built into.
struct EnglishSite {
  Draft& draft;
  const EnglishPlan& plan;
  Random& random;

  /// A length in [low, high] in steps of 1 cm.
  [[nodiscard]] Um length(Um low, Um high) const { return random.between(low, high, 10'000); }
  [[nodiscard]] bool chance(double probability) const { return random.chance(probability); }
  /// How far a pane lies behind its wall; 0 for the share of openings that are to be flush.
  [[nodiscard]] Um reveal() const { return random.chance(plan.flush) ? 0 : plan.reveal; }
};

/// What a window shall be where there is room for it.
struct EnglishWindow {
  std::string_view subclass = "Window";
  /// Before it is moved by the jitter.
  Rect rect;
  Glazing glazing = Glazing::plain;
  /// Panes side by side, of casements and of sashes with bars.
  int lights = 1;
  /// Whether it gets the row's stone sill and lintel.
  bool is_dressed = false;
  /// Length of the panel's directions u and w: 1, or √2 on the sides of a canted bay. The recess
  /// in the truth is in true metres.
  double stretch = 1;
};

/// Cuts the window into the panel inside `room`, which also holds its sill and lintel. False, and
/// nothing is built, if less than 0.3 x 0.3 m would be left of it.
bool place_window(const EnglishSite& site, Panel& panel, const Rect& room,
                  const EnglishWindow& window);

/// Fills a band of the panel with `count` windows like `window`, each in its own part of it.
void place_window_row(const EnglishSite& site, Panel& panel, const Rect& band, int count,
                      const EnglishWindow& window);

/// A rectangle of this size on v0 in the middle of the room, in whole millimetres.
Rect centred(const Rect& room, Um width, Um v0, Um height);

}  // namespace oriel::generator
