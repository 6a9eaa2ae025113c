#include "examples/generator/house/plan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel::generator {
namespace {

/// A feature's name, and the share of houses that have it where the options do not say.
struct FeatureRow {
  std::string_view name;
  double share;
};

constexpr std::array<FeatureRow, kFeatures> kFeatureRows{{
    {"window", 1},          {"door", 1},
    {"chimney", 0.7},       {"vent", 0.4},
    {"dormer", 0.45},       {"balcony", 0.45},
    {"loggia", 0.3},        {"bay", 0.3},
    {"canopy", 0.6},        {"stairs", 0.5},
    {"garage", 0.25},       {"roof_window", 0.35},
    {"gable_window", 0.5},  {"cellar_window", 0.3},
    {"french_window", 0.3}, {"shop", 0.15},
    {"strip", 0.25},        {"panes", 0.35},
    {"sill", 0.45},         {"shutter", 0.2},
    {"pilaster", 0.15},     {"cornice", 0.25},
    {"plinth", 0.3},        {"parapet", 0.5},
    {"overhang", 0.45},     {"wing", 0.25},
}};

constexpr Um kMaxOverhangDrop = 400'000;

FeatureSet draw_features(const Options& options, Random& random) {
  FeatureSet set;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    const auto feature = static_cast<Feature>(i);
    // Drawn also where the answer is given, so that options change nothing but what they name.
    const bool is_drawn = random.chance(kFeatureRows[i].share);
    if (options.features ? options.features->has(feature) : is_drawn) set.add(feature);
  }
  return set;
}

Um draw_length(const Range<Um>& range, Random& random) {
  constexpr Um step = 20_mm;
  const Um low = (range.low + step - 1) / step * step;
  return random.between(low, std::max(low, range.high), step);
}

WindowStyle draw_window(bool has_panes, Random& random) {
  WindowStyle style;
  style.width = random.between(700_mm, 1600_mm, 50_mm);
  style.height = random.between(1000_mm, 1500_mm, 50_mm);
  style.sill_height = random.between(750_mm, 950_mm, 50_mm);
  style.recess = random.between(60_mm, 240_mm, 10_mm);
  const int columns = random.between(1, 3), rows = random.between(1, 2);
  if (!has_panes) return style;
  style.columns = style.width >= 1000_mm ? std::max(2, columns) : std::min(2, columns);
  style.rows = rows;
  return style;
}

Slope draw_slope(RoofKind roof, Random& random) {
  switch (roof) {
    case RoofKind::gable:
      return {random.between(12, 20) * 50};
    case RoofKind::hip:
      return {random.between(10, 18) * 50};
    case RoofKind::shed:
      return {random.between(3, 6) * 50};
    case RoofKind::flat:
      break;
  }
  return {0};
}

/// The wing takes up to half of the front; true L-shapes, flush with a side, are the half of them.
Wing draw_wing(const Plan& plan, Random& random) {
  const Massing& m = plan.massing;
  const Um widest = std::min(m.depth, m.width / 2) / 20'000 * 20'000;
  const Um width = random.between(std::min(widest, 4000_mm), widest, 20_mm);
  Wing wing;
  wing.length = random.between(3000_mm, 6000_mm, 20_mm);
  const Um room = m.width - width;
  const int place = random.below(4);
  wing.u0 = place == 0 ? 0 : place == 1 ? room : random.between(1000_mm, room - 1000_mm, 20_mm);
  wing.u1 = wing.u0 + width;
  wing.wall_height = m.wall_height;
  if (m.roof == RoofKind::flat && plan.storeys > 1)
    wing.wall_height -= plan.storey_height * random.between(1, plan.storeys - 1);
  return wing;
}

/// The bare house's extras; those that do not go together with others are left out.
void draw_extras(Plan& plan, Random& random) {
  Massing& m = plan.massing;
  const bool may_have_wing = m.roof == RoofKind::gable || m.roof == RoofKind::flat;
  const bool has_wing = plan.has(Feature::wing) && may_have_wing && m.width >= 9000_mm;
  const Wing wing = draw_wing(plan, random);
  const Um overhang = random.between(200_mm, 600_mm, 50_mm);
  const Um parapet = random.between(300_mm, 900_mm, 50_mm);
  const Um plinth = random.between(200_mm, 500_mm, 50_mm);
  if (has_wing) {
    m.wing = wing;
    return;
  }
  if (plan.has(Feature::plinth)) plan.plinth = plinth;
  if (m.roof == RoofKind::flat && plan.has(Feature::parapet)) {
    m.parapet = parapet;
  } else if (plan.has(Feature::overhang)) {
    m.overhang = overhang;
    while (m.slope.rise(m.overhang) > kMaxOverhangDrop) m.overhang -= 50_mm;
  }
}

/// Sizes the house so that its walls have about `windows` places for windows beside a door.
void size_for(int windows, const Options& options, Plan& plan) {
  if (!options.has_storeys)
    plan.storeys = windows <= 30 ? 2 : windows <= 150 ? 4 : windows <= 700 ? 6 : 8;
  plan.column_width = 3000_mm;
  plan.density = 1;
  const int columns = std::max(2, (windows + 1 + plan.storeys) / (2 * plan.storeys));
  const int across = std::max(1, columns * 2 / 5), along = columns - across;
  const auto length = [&](int n) { return n * plan.column_width + 2 * kWallMargin + 200_mm; };
  plan.massing.width = length(along);
  plan.massing.depth = length(across);
  plan.massing.slope.per_mille = std::min(plan.massing.slope.per_mille, 500);
}

FeatureSet features_for_bench() {
  FeatureSet set;
  for (const Feature feature : {Feature::window, Feature::door, Feature::chimney}) set.add(feature);
  return set;
}

}  // namespace

std::string_view name_of(Style style) {
  switch (style) {
    case Style::english:
      return "english";
    case Style::city:
      return "city";
    case Style::continental:
      break;
  }
  return "continental";
}

std::string_view name_of(Feature feature) {
  return kFeatureRows[static_cast<std::size_t>(feature)].name;
}

std::optional<Feature> feature_named(std::string_view name) {
  for (std::size_t i = 0; i < kFeatures; ++i)
    if (kFeatureRows[i].name == name) return static_cast<Feature>(i);
  return std::nullopt;
}

Plan draw_plan(const Options& options, Random& random) {
  Plan plan;
  Massing& m = plan.massing;
  plan.features = draw_features(options, random);
  if (options.windows > 0 && !options.features) plan.features = features_for_bench();
  plan.flush = options.flush;
  plan.jitter = options.jitter;
  plan.chimney = options.chimney;
  const int drawn_roof = random.below(8);
  constexpr std::array roofs{RoofKind::gable, RoofKind::gable, RoofKind::gable, RoofKind::hip,
                             RoofKind::hip,   RoofKind::flat,  RoofKind::flat,  RoofKind::shed};
  m.roof = options.roof.value_or(roofs[static_cast<std::size_t>(drawn_roof)]);
  m.slope = draw_slope(m.roof, random);
  plan.storeys = random.between(options.storeys.low, options.storeys.high);
  m.width = draw_length(options.width, random);
  m.depth = draw_length(options.depth, random);
  if (m.width < m.depth) std::swap(m.width, m.depth);
  plan.storey_height = random.between(2850_mm, 3200_mm, 50_mm);
  plan.column_width = random.between(2500_mm, 3500_mm, 100_mm);
  plan.window = draw_window(plan.has(Feature::panes), random);
  const int steps = random.between(1, 5);
  const Um rise = random.between(150_mm, 180_mm, 10_mm);
  if (plan.has(Feature::stairs)) plan.steps = steps;
  plan.base = plan.steps * rise;
  if (options.windows > 0) size_for(options.windows, options, plan);
  m.wall_height = plan.floor(plan.storeys);
  draw_extras(plan, random);
  return plan;
}

}  // namespace oriel::generator
