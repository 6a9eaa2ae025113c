#include "io/picture/furniture.h"

#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

constexpr double kText_px = 14, kLine_px = 24, kPatch_px = 14, kGap_px = 8, kBetween_px = 22;
/// A scale bar is at most this share of its panel.
constexpr double kBar = 0.3;

struct LegendEntry {
  std::string name, text;
};

/// Parts, the most frequent first, then surfaces.
std::vector<LegendEntry> entries_of(const SeenClasses& classes) {
  std::vector<std::pair<std::string, std::size_t>> order(classes.begin(), classes.end());
  std::ranges::stable_sort(order, [](const auto& p, const auto& q) {
    const bool p_is_part = is_label_of_part(p.first), q_is_part = is_label_of_part(q.first);
    return p_is_part != q_is_part ? p_is_part : p.second > q.second;
  });
  std::vector<LegendEntry> entries;
  for (const auto& [name, count] : order) {
    std::string word = name.empty() ? "unlabelled" : printable(name);
    std::ranges::replace(word, '_', ' ');
    if (word.starts_with("outer")) word.insert(5, " ");
    const bool has_number = count > 0 && is_label_of_part(name);
    entries.push_back({name, has_number ? fmt::format("{} {}", word, count) : word});
  }
  return entries;
}

/// Where each entry stands, from the left upper corner.
std::vector<PicturePoint> places_of(const std::vector<LegendEntry>& entries, double width_px) {
  std::vector<PicturePoint> places;
  PicturePoint next;
  for (const LegendEntry& entry : entries) {
    const double width =
        kPatch_px + kGap_px + kLetter * kText_px * static_cast<double>(entry.text.size());
    if (next.x > 0 && next.x + width > width_px) next = {0, next.y + kLine_px};
    places.push_back(next);
    next.x += width + kBetween_px;
  }
  return places;
}

}  // namespace

PictureTheme theme_of(bool is_dark) {
  if (is_dark) return {{0x1d, 0x20, 0x24}, {0xe8, 0xe6, 0xe1}, {0x8b, 0x8f, 0x96}};
  return {{0xff, 0xff, 0xff}, {0x22, 0x22, 0x22}, {0x77, 0x77, 0x77}};
}

double legend_height_px(const SeenClasses& classes, double width_px) {
  const auto places = places_of(entries_of(classes), width_px);
  return places.empty() ? 0 : places.back().y + kLine_px;
}

PictureGroup legend(const SeenClasses& classes, const PictureBox& within,
                    const PictureTheme& theme) {
  PictureGroup group{.id = "legend"};
  const auto entries = entries_of(classes);
  const auto places = places_of(entries, within.width);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double x = within.left + places[i].x, y = within.top + places[i].y;
    const double far = x + kPatch_px, low = y + kPatch_px;
    group.shapes.push_back({.rings = {{{x, y}, {far, y}, {far, low}, {x, low}}},
                            .fill = colour_of_label(entries[i].name),
                            .line = theme.line});
    group.texts.push_back({.at = {far + kGap_px, low - 2},
                           .text = entries[i].text,
                           .size_px = kText_px,
                           .colour = theme.ink});
  }
  return group;
}

PictureGroup scale_bar(const Placing& placing, const PictureTheme& theme) {
  const double most_m = kBar * placing.box.width / placing.pixels_per_m;
  const double power = std::pow(10, std::floor(std::log10(most_m)));
  const double length_m = (most_m >= 5 * power ? 5 : most_m >= 2 * power ? 2 : 1) * power;
  const double x = placing.box.left + 12, y = placing.box.top + placing.box.height - 8;
  const double far = x + length_m * placing.pixels_per_m;
  PictureGroup group{.id = "scale-bar"};
  group.shapes.push_back(
      {.rings = {{{x, y - 4}, {far, y - 4}, {far, y}, {x, y}}}, .fill = theme.ink});
  group.texts.push_back({.at = {x, y - 9},
                         .text = fmt::format("{:g} m", length_m),
                         .size_px = kText_px,
                         .colour = theme.ink});
  return group;
}

}  // namespace oriel::detail
