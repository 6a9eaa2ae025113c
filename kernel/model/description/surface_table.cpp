#include "kernel/model/description/surface_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace oriel {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

std::size_t require_column(std::string_view name, bool is_text) {
  const auto column = surface_column_of(name);
  if (!column || (surface_schema()[*column].unit == Unit::text) != is_text)
    throw std::logic_error("no attribute '" + std::string(name) + "' of that type of surfaces");
  return *column;
}

}  // namespace

const std::vector<Attribute>& surface_schema() {
  using enum Unit;
  static const std::vector<Attribute> schema = {
      // How it lies.
      {"inclination", degree, "of its outward normal: 0 looks up, 90 is a wall, 180 looks down",
       "rules.md"},
      {"azimuth", degree, "of its outward normal, clockwise from north; missing if level",
       "rules.md"},
      {"facing", text,
       "what tells its outer side: solid (the closed shell), input (the order of its corners) or "
       "position (what lies straight above it)",
       "rules.md"},
      // Its size.
      {"area", square_metre, "without its holes", "rules.md"},
      {"a", metre, "longer side of the smallest rectangle around it in its plane", "rules.md"},
      {"b", metre, "shorter side of that rectangle", "rules.md"},
      // Its place.
      {"base_height", metre, "of its lowest point over the building's lowest point", "rules.md"},
      {"top", metre, "of its highest point over the building's lowest point", "rules.md"},
      {"below_ridge", metre, "how far its highest point stays under the building's highest point",
       "rules.md"},
      {"gap_above", metre,
       "from its middle straight up to the next surface of the building; missing under the sky",
       "rules.md"},
      {"gap_below", metre,
       "from its middle straight down to the next surface of the building; missing if there is "
       "none",
       "rules.md"},
      {"wall_up", ratio,
       "share of its outline beyond which the building rises above it; missing for steep surfaces",
       "rules.md"},
      {"wall_down", ratio,
       "share of its outline beyond which the building reaches below it; missing for steep "
       "surfaces",
       "rules.md"},
      {"synthetic", yes_no, "no polygon of the input lies in it: oriel closed a gap with it",
       "rules.md"},
      // The feature it belongs to.
      {"sense", text, "of the smallest feature it belongs to; missing if to none", "rules.md"},
      {"host_inclination", degree, "of the facet that feature lies in", "rules.md"},
      {"part", text, "the label of the smallest labelled feature it belongs to; missing if to none",
       "rules.md"},
  };
  return schema;
}

std::optional<std::size_t> surface_column_of(std::string_view name) {
  static const auto columns = [] {
    std::unordered_map<std::string_view, std::size_t> by_name;
    for (const Attribute& attribute : surface_schema())
      by_name.emplace(attribute.name, by_name.size());
    return by_name;
  }();
  const auto found = columns.find(name);
  return found == columns.end() ? std::nullopt : std::optional(found->second);
}

SurfaceTable::SurfaceTable(std::size_t rows) : rows_(rows), columns_(surface_schema().size()) {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (surface_schema()[c].unit == Unit::text)
      columns_[c].texts = WordColumn(rows);
    else
      columns_[c].numbers.resize(rows, kMissing);
  }
}

std::optional<double> SurfaceTable::number(std::size_t row, std::string_view name) const {
  const double value = columns_[require_column(name, false)].numbers[row];
  if (std::isnan(value)) return std::nullopt;
  return value;
}

const std::string& SurfaceTable::text(std::size_t row, std::string_view name) const {
  return columns_[require_column(name, true)].texts[row];
}

void SurfaceTable::set(std::size_t row, std::string_view name, double value) {
  columns_[require_column(name, false)].numbers[row] = value;
}

void SurfaceTable::set(std::size_t row, std::string_view name, std::string value) {
  columns_[require_column(name, true)].texts.set(row, std::move(value));
}

}  // namespace oriel
