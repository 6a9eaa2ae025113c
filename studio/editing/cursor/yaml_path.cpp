#include "studio/editing/cursor/yaml_path.h"

#include <algorithm>
#include <array>
#include <optional>

namespace oriel::rules {

namespace {

void visit_below(const YamlNode& node, YamlPath& path, const YamlVisitor& visit) {
  visit(node, path, false);
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    path.push_back({"", static_cast<int>(i)});
    visit_below(node.items[i], path, visit);
    path.pop_back();
  }
  for (const YamlEntry& entry : node.entries) {
    path.push_back({entry.key.text});
    visit(entry.key, path, true);
    visit_below(entry.value, path, visit);
    path.pop_back();
  }
}

/// A path as a pattern matches it: `rules.#.require` ends in one, `*` is any key, `#` any item.
struct PlacePattern {
  std::string_view pattern{};
  YamlPlace place;
};

constexpr std::array kKeyPlaces = {
    PlacePattern{"params.*", YamlPlace::new_param},
    PlacePattern{"classes.*", YamlPlace::new_class},
    PlacePattern{"macros.*", YamlPlace::new_macro},
    PlacePattern{"relations.*", YamlPlace::new_relation},
    PlacePattern{"groups.*", YamlPlace::new_group},
    PlacePattern{"emit.*", YamlPlace::class_name},
    PlacePattern{"rules.#.score.#.*", YamlPlace::condition},
    PlacePattern{"fixtures.*.defaults.*", YamlPlace::attribute_name},
    PlacePattern{"fixtures.*.features.*.*", YamlPlace::attribute_name},
    PlacePattern{"tests.#.expect.counts.*", YamlPlace::label},
    PlacePattern{"tests.#.expect.groups.*", YamlPlace::group_name},
    PlacePattern{"tests.#.because.*", YamlPlace::rule_name},
    PlacePattern{"tests.#.given.*", YamlPlace::fixture_name},
    PlacePattern{"tests.#.property.perturb.*", YamlPlace::attribute_name},
};

constexpr std::array kValuePlaces = {
    PlacePattern{"extends", YamlPlace::pack_name},
    PlacePattern{"tests_for", YamlPlace::pack_name},
    PlacePattern{"params.*.value", YamlPlace::constant},
    PlacePattern{"params.*.range", YamlPlace::constant},
    PlacePattern{"hosts.*", YamlPlace::constant},
    PlacePattern{"classes.*.is", YamlPlace::class_name},
    PlacePattern{"classes.*.typical.*", YamlPlace::constant},
    PlacePattern{"relations.*.within", YamlPlace::relation},
    PlacePattern{"relations.*.where", YamlPlace::pair_condition},
    PlacePattern{"macros.*", YamlPlace::macro_body},
    PlacePattern{"rules.#.id", YamlPlace::new_rule},
    PlacePattern{"rules.#.label", YamlPlace::class_name},
    PlacePattern{"rules.#.require", YamlPlace::condition},
    PlacePattern{"rules.#.require.#", YamlPlace::condition},
    PlacePattern{"rules.#.unless", YamlPlace::condition},
    PlacePattern{"rules.#.unless.#", YamlPlace::condition},
    PlacePattern{"rules.#.score.#", YamlPlace::condition},
    PlacePattern{"rules.#.score.#.*.rise", YamlPlace::constant},
    PlacePattern{"rules.#.score.#.*.fall", YamlPlace::constant},
    PlacePattern{"decide.min_score", YamlPlace::constant},
    PlacePattern{"decide.ambiguous_below", YamlPlace::constant},
    PlacePattern{"decide.evidence", YamlPlace::constant},
    PlacePattern{"decide.company", YamlPlace::relation},
    PlacePattern{"decide.company.#", YamlPlace::relation},
    PlacePattern{"groups.*.of", YamlPlace::class_name},
    PlacePattern{"groups.*.by", YamlPlace::relation},
    PlacePattern{"surfaces.#.id", YamlPlace::new_entry},
    PlacePattern{"surfaces.#.when", YamlPlace::surface_condition},
    PlacePattern{"surfaces.#.when.#", YamlPlace::surface_condition},
    PlacePattern{"generalise.#.id", YamlPlace::new_entry},
    PlacePattern{"generalise.#.for", YamlPlace::target},
    PlacePattern{"generalise.#.when", YamlPlace::map_condition},
    PlacePattern{"generalise.#.do.*.*", YamlPlace::map_constant},
    PlacePattern{"generalise.#.with.by", YamlPlace::relation},
    PlacePattern{"generalise.#.with.of", YamlPlace::class_name},
    PlacePattern{"fixtures.*.defaults.*", YamlPlace::constant},
    PlacePattern{"fixtures.*.features.*.*", YamlPlace::constant},
    PlacePattern{"tests.#.given", YamlPlace::fixture_name},
    PlacePattern{"tests.#.given.*.*", YamlPlace::constant},
    PlacePattern{"tests.#.expect.*", YamlPlace::label},
    PlacePattern{"tests.#.because.*", YamlPlace::outcome},
};

std::string pattern_of(const YamlStep& step) { return step.is_key() ? step.key : "#"; }

/// The part of the pattern up to the next point, which is taken from it.
std::string_view take_part(std::string_view& pattern) {
  const std::size_t dot = pattern.find('.');
  const std::string_view part = pattern.substr(0, dot);
  pattern.remove_prefix(dot == std::string_view::npos ? pattern.size() : dot + 1);
  return part;
}

bool matches(const YamlPath& path, std::string_view pattern) {
  for (const YamlStep& step : path) {
    if (pattern.empty()) return false;
    const std::string_view part = take_part(pattern);
    const bool is_same = part == "*" ? step.is_key() : part == pattern_of(step);
    if (!is_same) return false;
  }
  return pattern.empty();
}

template <std::size_t size>
YamlPlace first_match(const std::array<PlacePattern, size>& patterns, const YamlPath& path) {
  const auto found = std::ranges::find_if(
      patterns, [&](const PlacePattern& pattern) { return matches(path, pattern.pattern); });
  return found == patterns.end() ? YamlPlace::other : found->place;
}

}  // namespace

void visit_yaml(const YamlNode& root, const YamlVisitor& visit) {
  YamlPath path;
  visit_below(root, path, visit);
}

YamlPlace place_of(const YamlPath& path, bool is_key) {
  return is_key ? first_match(kKeyPlaces, path) : first_match(kValuePlaces, path);
}

bool is_expression(YamlPlace place) { return place >= YamlPlace::condition; }

}  // namespace oriel::rules
