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
  std::string text;
  Colour colour{};
  bool is_mark = false;
};

/// Which colours people tell apart who do not see all of them: Okabe and Ito, Color Universal
/// Design, 2008; a strong red for what one is to look at.
constexpr Colour kRed{0xd0, 0x00, 0x50}, kBlue{0x00, 0x72, 0xb2}, kGreen{0x00, 0x9e, 0x73};

struct MarkStyle {
  const char* words;
  Colour colour;
};

const MarkStyle& style_of(PictureMark mark) {
  static constexpr std::array<MarkStyle, 7> kStyles = {{{"changed", kRed},
                                                        {"right", kGreen},
                                                        {"wrong", kRed},
                                                        {"missed", kBlue},
                                                        {"explained", kRed},
                                                        {"what it is part of", kBlue},
                                                        {"related", kGreen}}};
  return kStyles.at(static_cast<std::size_t>(mark));
}

/// Parts, the most frequent first, then surfaces, then marks.
std::vector<LegendEntry> entries_of(const LegendContents& contents) {
  std::vector<std::pair<std::string, std::size_t>> order(contents.classes.begin(),
                                                         contents.classes.end());
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
    entries.push_back(
        {has_number ? fmt::format("{} {}", word, count) : word, colour_of_label(name)});
  }
  for (const auto& [mark, count] : contents.marks)
    entries.push_back(
        {fmt::format("{} {}", style_of(mark).words, count), colour_of_mark(mark), true});
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

Colour colour_of_mark(PictureMark mark) { return style_of(mark).colour; }

double legend_height_px(const LegendContents& contents, double width_px) {
  const auto places = places_of(entries_of(contents), width_px);
  return places.empty() ? 0 : places.back().y + kLine_px;
}

PictureGroup legend(const LegendContents& contents, const PictureBox& within,
                    const PictureTheme& theme) {
  PictureGroup group{.id = "legend"};
  const auto entries = entries_of(contents);
  const auto places = places_of(entries, within.width);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double x = within.left + places[i].x, y = within.top + places[i].y;
    const double far = x + kPatch_px, low = y + kPatch_px;
    PictureShape patch{.rings = {{{x, y}, {far, y}, {far, low}, {x, low}}}};
    patch.line = entries[i].is_mark ? entries[i].colour : theme.line;
    if (entries[i].is_mark)
      patch.line_px = 3;
    else
      patch.fill = entries[i].colour;
    group.shapes.push_back(std::move(patch));
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
