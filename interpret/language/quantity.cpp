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
/// A tenth of a millimetre: what is smaller is below what coordinates say.
constexpr int kFinestDecimals = 4;
/// Of numbers that are small themselves.
constexpr int kMostDecimals = 6;
/// A number is not shown further off than this share of it.
constexpr double kShownWithin = 0.05;

std::string decimal_text(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

std::string with_unit(const std::string& number, Dimension dimension) {
  const std::string unit = unit_of(dimension);
  return unit.empty() ? number : number + " " + unit;
}

bool looks_equal(double value, double other, int decimals) {
  return decimal_text(value, decimals) == decimal_text(other, decimals);
}

/// The least of 2 to 6 decimals that show `value` nearly; 2 if none does.
int decimals_for(double value) {
  for (int decimals = kLeastDecimals; decimals <= kMostDecimals; ++decimals) {
    const double unit = std::pow(10, decimals);
    if (std::abs(std::round(value * unit) / unit - value) <= kShownWithin * std::abs(value))
      return decimals;
  }
  return kLeastDecimals;
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

bool is_without_unit(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.+-eE ") == std::string_view::npos;
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
    return decimal_text(value, 0);
  const int enough = decimals_for(value);
  int decimals = enough;
  while (value != other && decimals < kFinestDecimals && looks_equal(value, other, decimals))
    ++decimals;
  if (looks_equal(value, other, decimals)) decimals = enough;
  return with_unit(decimal_text(value, decimals), dimension);
}

bool looks_equal(double value, double other) {
  return looks_equal(value, other, std::max(kFinestDecimals, decimals_for(value)));
}

std::string write_distance(double distance, Dimension dimension) {
  if (distance > 0 && looks_equal(distance, 0, kFinestDecimals))
    return "less than " +
           with_unit(decimal_text(std::pow(10, -kFinestDecimals), kFinestDecimals), dimension);
  return write(distance, dimension, 0);
}

std::string write_percent(double share, double other) {
  constexpr int kLeastDigits = 3, kMostDigits = 6;
  const auto text = [](double value, int count) {
    return fmt::format("{:.{}g}", value * 100, count);
  };
  int count = kLeastDigits;
  while (count < kMostDigits && share != other && text(share, count) == text(other, count)) ++count;
  if (text(share, count) == text(other, count)) count = kLeastDigits;
  return text(share, count) + " %";
}

}  // namespace oriel::rules
