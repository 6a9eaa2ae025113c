#include "model/description/feature_names.h"

#include "kernel/base/index.h"
#include "kernel/base/text/edit_distance.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// As `hosts:` of the packs that are built in: flatter than this a facet is a roof, and steeper
/// than that it looks down.
constexpr double kSteepestRoof_deg = 75;
constexpr double kSteepestWall_deg = 105;
/// A roof that is flatter has no side.
constexpr double kFlatRoof_deg = 5;
/// Angles are compared so coarsely: what is 22.5° but for rounding lies on one side.
constexpr double kAngleStep_deg = 0.1;
/// Coordinates are given to the millimetre, and middles lie on halves of it: no difference is just
/// as large as this, so that rounding, which differs with the origin, decides nothing.
constexpr double kSamePlace_m = 0.0051;
/// Openings that are taller are not those of one storey, nor is what reaches higher than this over
/// the lowest of a storey.
constexpr double kStorey_m = 3;

constexpr std::array<const char*, 8> kSides = {"north", "northeast", "east", "southeast",
                                               "south", "southwest", "west", "northwest"};
constexpr int kNoSide = -1;
/// Where there is no side, plans are read as seen from the south.
constexpr int kSouth = 4;

double rounded_angle(double degrees) {
  return std::round(degrees / kAngleStep_deg) * kAngleStep_deg;
}

double inclination_of(const NameParts& feature) {
  return rounded_angle(feature.host_inclination_deg.value_or(0));
}

/// Of a wall or a roof slope.
int side_of(const NameParts& feature) {
  const double inclination = inclination_of(feature);
  if (!feature.azimuth_deg || inclination < kFlatRoof_deg || inclination > kSteepestWall_deg)
    return kNoSide;
  constexpr double kSector_deg = 360.0 / kSides.size();
  const double sector = rounded_angle(*feature.azimuth_deg) / kSector_deg;
  return static_cast<int>(std::floor(sector + 0.5)) % static_cast<int>(kSides.size());
}

bool is_on_wall(const NameParts& feature) {
  const double inclination = inclination_of(feature);
  return feature.host_inclination_deg && side_of(feature) != kNoSide &&
         inclination >= kSteepestRoof_deg;
}

double middle_of(double low, double high) { return (low + high) / 2; }

/// The heights between which the openings of a storey lie, and those of their middles.
struct StoreyHeights {
  double bottom = 0;
  double top = 0;
  double lowest_middle = middle_of(bottom, top);
  double highest_middle = lowest_middle;
};

/// The storeys of a building, from the lowest.
class Storeys {
 public:
  /// Of these openings.
  explicit Storeys(std::vector<StoreyHeights> openings) {
    const auto is_tall = [](const StoreyHeights& opening) {
      return opening.top - opening.bottom > kStorey_m + kSamePlace_m;
    };
    if (!std::ranges::all_of(openings, is_tall)) std::erase_if(openings, is_tall);
    std::ranges::sort(openings, {}, &StoreyHeights::lowest_middle);
    for (const StoreyHeights& opening : openings) {
      if (all_.empty() || opening.lowest_middle > reach_of(all_.back()) + kSamePlace_m) {
        all_.push_back(opening);
        continue;
      }
      all_.back().bottom = std::min(all_.back().bottom, opening.bottom);
      all_.back().top = std::max(all_.back().top, opening.top);
      all_.back().highest_middle = opening.highest_middle;
    }
  }

  /// From 1; nothing if there is none, or if it reaches from one into the other.
  [[nodiscard]] std::optional<std::size_t> of(double bottom, double top) const {
    if (all_.empty()) return std::nullopt;
    std::size_t storey = 1;
    for (std::size_t i = 0; i + 1 < all_.size(); ++i) {
      const StoreyHeights &lower = all_[i], &upper = all_[i + 1];
      if (bottom <= middle_of(lower.bottom, reach_of(lower)) + kSamePlace_m &&
          top >= middle_of(upper.bottom, reach_of(upper)) - kSamePlace_m)
        return std::nullopt;
      if (middle_of(bottom, top) > boundary_of(lower, upper)) storey = i + 2;
    }
    return storey;
  }

 private:
  static double reach_of(const StoreyHeights& storey) {
    return std::min(storey.top, storey.bottom + kStorey_m);
  }

  /// Half-way between the openings of the two, or where these overlap between their middles, so
  /// that every opening stays in the storey that it belongs to.
  static double boundary_of(const StoreyHeights& lower, const StoreyHeights& upper) {
    const double half_way = middle_of(reach_of(lower), upper.bottom) + kSamePlace_m;
    const bool parts_middles = half_way > lower.highest_middle && half_way < upper.lowest_middle;
    return parts_middles ? half_way : middle_of(lower.highest_middle, upper.lowest_middle);
  }

  std::vector<StoreyHeights> all_;
};

/// Without a feature with a label that it stands on.
std::string place_on_body(const NameParts& feature, const Storeys& storeys) {
  if (!feature.host_inclination_deg) return "the inside";
  const double inclination = inclination_of(feature);
  const int side = side_of(feature);
  if (inclination > kSteepestWall_deg) return "the underside";
  if (inclination < kFlatRoof_deg) return "the flat roof";
  if (side == kNoSide) return "the walls and roofs";  // its side is not known
  if (!is_on_wall(feature)) return fmt::format("roof slope {}", kSides[at(side)]);
  const std::string facade = fmt::format("facade {}", kSides[at(side)]);
  const auto storey = storeys.of(feature.box.min.z, feature.box.max.z);
  return storey ? fmt::format("{}, storey {}", facade, *storey) : facade;
}

/// By row the nearest feature with a label above it; -1: none. Hosts that go round in a circle,
/// which only a file of records can have, end where they come back.
std::vector<int> labelled_hosts(std::span<const NameParts> features) {
  constexpr int kNotKnown = -2, kNone = -1;
  std::vector<int> nearest(features.size(), kNotKnown);
  std::vector<std::size_t> way;
  for (std::size_t row = 0; row < features.size(); ++row) {
    way.clear();
    std::size_t here = row;
    int found = kNone;
    while (nearest[here] == kNotKnown) {
      nearest[here] = kNone;
      way.push_back(here);
      const FeatureId host = features[here].host;
      if (!host.is_valid() || host.index() >= features.size()) break;
      here = host.index();
      found = features[here].label.empty() ? nearest[here] : host.value;
      if (!features[here].label.empty()) break;
    }
    for (const std::size_t below : way) nearest[below] = std::max(found, kNone);
  }
  return nearest;
}

/// Places by a number each, from the smallest; what is nearly the same has the same number.
std::vector<int> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<int> ranks(values.size());
  int rank = 0;
  double first = values.empty() ? 0 : values[order[0]];
  for (const std::size_t i : order) {
    if (values[i] - first > kSamePlace_m) {
      ++rank;
      first = values[i];
    }
    ranks[i] = rank;
  }
  return ranks;
}

/// Rows of one place and label in the order of their numbers.
void sort_group(std::span<const NameParts> features, std::vector<std::size_t>& rows) {
  std::vector<int> sides;
  std::vector<double> across, height, behind;
  for (const std::size_t row : rows) {
    const NameParts& feature = features[row];
    const int side = side_of(feature);
    sides.push_back(side);
    const double azimuth = (side == kNoSide ? kSouth : side) * std::numbers::pi / 4;
    const Vec3 p = 0.5 * (feature.box.min + feature.box.max);
    across.push_back(-std::cos(azimuth) * p.x + std::sin(azimuth) * p.y);
    height.push_back(p.z);
    behind.push_back(-std::sin(azimuth) * p.x - std::cos(azimuth) * p.y);
  }
  const auto across_rank = ranks_of(across), height_rank = ranks_of(height),
             behind_rank = ranks_of(behind);
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) {
    const bool is_plan = sides[i] == kNoSide;
    const int second = is_plan ? behind_rank[i] : height_rank[i];
    const int third = is_plan ? height_rank[i] : behind_rank[i];
    return std::tuple(sides[i], across_rank[i], second, third, features[rows[i]].id);
  });
  std::vector<std::size_t> sorted;
  for (const std::size_t i : order) sorted.push_back(rows[i]);
  rows = std::move(sorted);
}

/// Names place by place, from the outer to the inner ones.
class NameGiver {
 public:
  explicit NameGiver(std::span<const NameParts> features)
      : features_(features),
        whole_of_(labelled_hosts(features)),
        storeys_(openings()),
        names_(features.size()) {}

  std::vector<std::string> run() {
    const std::vector<int> depths = this->depths();
    for (int depth = 0; depth < kMostPlaces; ++depth) {
      std::map<std::pair<std::string, std::string_view>, std::vector<std::size_t>> groups;
      for (std::size_t row = 0; row < features_.size(); ++row)
        if (depths[row] == depth) groups[{place_of(row), features_[row].label}].push_back(row);
      for (auto& [group, rows] : groups) number(group.first, rows);
    }
    return std::move(names_);
  }

 private:
  /// Those with a label on the facades; where nothing has a label, all.
  [[nodiscard]] std::vector<StoreyHeights> openings() const {
    const bool has_labels = std::ranges::any_of(
        features_, [](const NameParts& feature) { return !feature.label.empty(); });
    std::vector<StoreyHeights> openings;
    for (std::size_t row = 0; row < features_.size(); ++row) {
      const NameParts& feature = features_[row];
      const bool counts = !has_labels || !feature.label.empty();
      if (counts && feature.is_opening && whole_of_[row] < 0 && is_on_wall(feature))
        openings.push_back({feature.box.min.z, feature.box.max.z});
    }
    return openings;
  }

  /// How many features its place names; shortens the way to the outermost where it is too long.
  std::vector<int> depths() {
    constexpr int kNotKnown = -1, kOnTheWay = -2;
    std::vector<int> depths(features_.size(), kNotKnown);
    std::vector<std::size_t> way;
    for (std::size_t row = 0; row < features_.size(); ++row) {
      way.clear();
      for (std::size_t here = row; depths[here] == kNotKnown; here = at(whole_of_[here])) {
        depths[here] = kOnTheWay;
        way.push_back(here);
        if (whole_of_[here] >= 0 && depths[at(whole_of_[here])] == kOnTheWay) whole_of_[here] = -1;
        if (whole_of_[here] < 0) break;
      }
      std::ranges::reverse(way);
      for (const std::size_t here : way) {
        int& whole = whole_of_[here];
        if (whole >= 0 && depths[at(whole)] + 1 >= kMostPlaces) whole = whole_of_[at(whole)];
        depths[here] = whole < 0 ? 0 : depths[at(whole)] + 1;
      }
    }
    return depths;
  }

  [[nodiscard]] std::string place_of(std::size_t row) const {
    const int whole = whole_of_[row];
    return whole < 0 ? place_on_body(features_[row], storeys_) : names_[at(whole)];
  }

  void number(const std::string& place, std::vector<std::size_t>& rows) {
    sort_group(features_, rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string_view label = features_[rows[i]].label;
      names_[rows[i]] = fmt::format("{} {} of {}", label.empty() ? "part" : label, i + 1, place);
    }
  }

  std::span<const NameParts> features_;
  std::vector<int> whole_of_;
  Storeys storeys_;
  std::vector<std::string> names_;
};

/// Small letters, words with a space between.
std::string plain(std::string_view text) {
  std::string words;
  for (const char c : text) {
    const bool is_between = c == ',' || std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!is_between) words += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (is_between && !words.empty() && words.back() != ' ') words += ' ';
  }
  if (words.ends_with(' ')) words.pop_back();
  return words;
}

/// Of a plain() text.
std::string_view first_words(std::string_view text, std::ptrdiff_t count) {
  std::size_t end = 0;
  for (; count > 0 && end < text.size(); --count)
    end = std::min(text.find(' ', end + 1), text.size());
  return text.substr(0, end);
}

}  // namespace

std::vector<std::string> feature_names(std::span<const NameParts> features) {
  return NameGiver(features).run();
}

std::vector<std::string> feature_names(const Segmentation& segmentation, const FeatureTable& table,
                                       const Interpretation* interpretation) {
  std::vector<NameParts> features(table.rows());
  for (std::size_t i = 0; i < features.size(); ++i) {
    const FeatureId row{static_cast<int>(i)};
    const Feature& feature = segmentation.features[i];
    features[i] = {table.id(row),
                   {},
                   feature.host,
                   table.number(row, Attribute::host_inclination),
                   table.number(row, Attribute::azimuth),
                   table.number(row, Attribute::storey).has_value(),
                   feature.box};
  }
  if (interpretation != nullptr)
    for (const Verdict& verdict : interpretation->verdicts)
      features.at(verdict.feature.index()).label = verdict.label.text();
  return feature_names(features);
}

std::vector<std::size_t> find_names(std::span<const std::string> names, std::string_view text) {
  const std::string meant = plain(text);
  std::vector<std::size_t> begun;
  if (meant.empty()) return begun;
  for (std::size_t row = 0; row < names.size(); ++row) {
    const std::string name = plain(names[row]);
    if (name == meant) return {row};
    if (name.starts_with(meant + " ")) begun.push_back(row);
  }
  return begun;
}

std::vector<std::string> nearest_names(std::span<const std::string> names, std::string_view text,
                                       std::size_t most) {
  // A longer text is no name.
  constexpr std::size_t kLongestText = 200;
  const std::string meant = plain(text.substr(0, kLongestText));
  const std::ptrdiff_t words = 1 + std::ranges::count(meant, ' ');
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& name : names)
    ranked.emplace_back(edit_distance(meant, first_words(plain(name), words)), name);
  std::ranges::sort(ranked);
  const auto [first, last] = std::ranges::unique(ranked);
  ranked.erase(first, last);
  std::vector<std::string> nearest;
  for (std::size_t i = 0; i < std::min(most, ranked.size()); ++i)
    nearest.push_back(ranked[i].second);
  return nearest;
}

}  // namespace oriel
