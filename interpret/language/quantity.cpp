#include "interpret/language/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr std::array<UnitWord, 7> kUnits = {{{"m", {1, 0}, 1},
                                             {"cm", {1, 0}, 0.01},
                                             {"mm", {1, 0}, 0.001},
                                             {"m2", {2, 0}, 1},
                                             {"m3", {3, 0}, 1},
                                             {"deg", {0, 1}, 1},
                                             {"%", {0, 0}, 0.01}}};

constexpr int kLeastDecimals = 2;
constexpr int kMostDecimals = 6;

std::string with_unit(const std::string& number, Dimension dimension) {
  const std::string unit = unit_of(dimension);
  return unit.empty() ? number : number + " " + unit;
}

bool is_small_whole(double value) { return value == std::round(value) && std::abs(value) < 1e15; }

}  // namespace

std::optional<UnitWord> unit_word(std::string_view name) {
  const auto* found = std::ranges::find(kUnits, name, &UnitWord::name);
  if (found == kUnits.end()) return std::nullopt;
  return *found;
}

const std::vector<std::string>& unit_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const UnitWord& unit : kUnits) list.emplace_back(unit.name);
    list.emplace_back("mm@map");
    return list;
  }();
  return names;
}

Dimension dimension_of(Unit unit) {
  switch (unit) {
    case Unit::metre:
      return {1, 0};
    case Unit::square_metre:
      return {2, 0};
    case Unit::cubic_metre:
      return {3, 0};
    case Unit::degree:
      return {0, 1};
    default:
      return {};
  }
}

std::string unit_of(Dimension dimension) {
  const auto power = [](const char* base, int exponent) {
    if (exponent == 0) return std::string();
    return exponent == 1 ? std::string(base) : fmt::format("{}{}", base, exponent);
  };
  return power("m", dimension.metre) + power("deg", dimension.degree);
}

std::string describe(Dimension dimension) {
  if (dimension.is_plain()) return "a plain number";
  if (dimension == Dimension{1, 0}) return "a length";
  if (dimension == Dimension{2, 0}) return "an area";
  if (dimension == Dimension{3, 0}) return "a volume";
  if (dimension == Dimension{0, 1}) return "an angle";
  return "a number in " + unit_of(dimension);
}

std::string write(double value, Dimension dimension) { return write(value, dimension, value); }

std::string write(double value, Dimension dimension, double other) {
  if (dimension.is_plain() && is_small_whole(value) && is_small_whole(other))
    return fmt::format("{:.0f}", value);
  int decimals = kLeastDecimals;
  const auto looks_equal = [&] {
    return fmt::format("{:.{}f}", value, decimals) == fmt::format("{:.{}f}", other, decimals);
  };
  while (value != other && decimals < kMostDecimals && looks_equal()) ++decimals;
  if (looks_equal()) decimals = kLeastDecimals;  // they differ by rounding only
  return with_unit(fmt::format("{:.{}f}", value, decimals), dimension);
}

}  // namespace oriel::rules
