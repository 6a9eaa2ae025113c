#include "interpret/testing/fixture.h"

#include "interpret/language/quantity.h"
#include "interpret/testing/test_grammar.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr int kMostRepeated = 10'000;

/// What `host: wall` is as an inclination.
std::optional<double> inclination_of(std::string_view kind) {
  if (kind == "wall") return 90;
  if (kind == "roof") return 30;
  return kind == "ground" ? std::optional<double>(180) : std::nullopt;
}

const std::vector<std::string>& own_keys() {
  static const std::vector<std::string> keys = {"facade", "host", "x"};
  return keys;
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys = own_keys();
  for (const AttributeInfo& attribute : feature_schema()) keys.push_back(attribute.name);
  for (const RelationKind& relation : relation_schema()) keys.push_back(relation.name);
  return keys;
}

void read_host(const YamlNode& node, FixtureFeature& feature, Loader& loader) {
  const auto host = read_text(node, "'host'", loader.findings);
  if (!host) return;
  if (const auto inclination = inclination_of(*host))
    feature.numbers[Attribute::host_inclination] = *inclination;
  else
    feature.host = *host;
}

void read_attribute(const YamlNode& node, Attribute attribute, FixtureFeature& feature,
                    Loader& loader) {
  const AttributeInfo& info = info_of(attribute);
  if (node.kind == YamlNode::Kind::scalar && node.text == "missing") {
    feature.numbers.erase(attribute);
    feature.texts.erase(attribute);
    return;
  }
  if (info.unit == Unit::text) {
    const auto text = read_text(node, "'" + info.name + "'", loader.findings);
    if (text) feature.texts[attribute] = *text;
  } else if (info.unit == Unit::yes_no) {
    const auto flag = read_flag(node, "'" + info.name + "'", loader.findings);
    if (flag) feature.numbers[attribute] = *flag ? 1 : 0;
  } else if (const auto value = read_quantity(node, dimension_of(info.unit), loader)) {
    feature.numbers[attribute] = value->value;
  }
}

void read_related(const std::string& relation, const YamlNode& node, FixtureFeature& feature,
                  Loader& loader) {
  const auto add = [&](const YamlNode& item) {
    if (const auto name = read_text(item, "a related feature", loader.findings))
      feature.related.emplace_back(relation, *name);
  };
  if (node.kind == YamlNode::Kind::sequence)
    std::ranges::for_each(node.items, add);
  else
    add(node);
}

void set_value(const YamlNode& key, std::string_view name, const YamlNode& value,
               FixtureFeature& feature, Loader& loader) {
  if (name == "facade") {
    feature.facade = read_text(value, "'facade'", loader.findings).value_or("");
  } else if (name == "host") {
    read_host(value, feature, loader);
  } else if (name == "x") {
    if (const auto x = read_quantity(value, Dimension{1, 0}, loader)) feature.x = x->value;
  } else if (const auto attribute = find_attribute(name)) {
    read_attribute(value, *attribute, feature, loader);
  } else if (index_of(relation_schema(), name) >= 0) {
    read_related(std::string(name), value, feature, loader);
  } else {
    loader.findings.error(
        Code::R204, key.span,
        fmt::format("unknown attribute or relation '{}'{}", name, did_you_mean(name, all_keys())));
  }
}

void read_values(const YamlNode& node, FixtureFeature& feature, Loader& loader) {
  if (!expect_map(node, "a feature", loader.findings)) return;
  for (const YamlEntry& entry : node.entries)
    if (entry.key.text != "repeat")
      set_value(entry.key, entry.key.text, entry.value, feature, loader);
}

int read_times(const YamlNode* node, Loader& loader) {
  if (node == nullptr) return 1;
  const auto times = read_integer(*node, "a number of features", loader.findings);
  if (times && *times >= 1 && *times <= 100) return *times;
  if (times) loader.findings.error(Code::R212, node->span, "it lies in 1 .. 100");
  return 1;
}

double read_step(const YamlNode* node, Loader& loader) {
  const auto step = node == nullptr ? std::nullopt : read_quantity(*node, Dimension{1, 0}, loader);
  return step ? step->value : 0;
}

/// A grid of copies: w.1, w.2 … along the rows, from the lowest.
void repeat(const YamlNode& node, const FixtureFeature& feature, Fixture& fixture, Loader& loader) {
  YamlSection section(node, "'repeat'", test_grammar().keys("repeat"), loader.findings);
  const int columns = read_times(section.find("columns"), loader);
  const int rows = read_times(section.find("rows"), loader);
  const double dx = read_step(section.find("dx"), loader);
  const double dz = read_step(section.find("dz"), loader);
  for (int i = 0; i < columns * rows; ++i) {
    FixtureFeature copy = feature;
    const int row = i / columns;
    copy.name = fmt::format("{}.{}", feature.name, i + 1);
    copy.x = feature.x.value_or(0) + dx * (i % columns);
    for (const Attribute level : {Attribute::base_height, Attribute::top})
      if (const auto z = copy.numbers.find(level); z != copy.numbers.end()) z->second += dz * row;
    copy.numbers[Attribute::storey] += row;
    fixture.push_back(std::move(copy));
  }
}

/// Adds pairs to relations; names of features become rows.
class Relating {
 public:
  explicit Relating(const Fixture& fixture) : fixture_(&fixture) {}

  FeatureGraph run() {
    for (std::size_t i = 0; i < fixture_->size(); ++i) {
      relate_host(i);
      relate_written(i);
      for (std::size_t j = 0; j < i; ++j) relate_placed(i, j);
    }
    FeatureGraph graph;
    for (auto& [relation, pairs] : pairs_) graph.set(relation, std::move(pairs));
    return graph;
  }

 private:
  [[nodiscard]] const FixtureFeature& at(std::size_t i) const { return (*fixture_)[i]; }
  [[nodiscard]] std::optional<double> number(std::size_t i, Attribute attribute) const {
    const auto found = at(i).numbers.find(attribute);
    return found == at(i).numbers.end() ? std::nullopt : std::optional(found->second);
  }
  void add(const std::string& relation, std::size_t self, std::size_t other) {
    pairs_[relation].emplace_back(FeatureId{static_cast<int>(self)},
                                  FeatureId{static_cast<int>(other)});
  }
  void add_both(const std::string& relation, std::size_t i, std::size_t j) {
    add(relation, i, j);
    add(relation, j, i);
  }
  [[nodiscard]] std::size_t find(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(*fixture_, name, &FixtureFeature::name) -
                                    fixture_->begin());
  }

  /// A host contains what it hosts and what that hosts; all that is inside it.
  void relate_host(std::size_t i) {
    std::size_t host = find(at(i).host);
    if (at(i).host.empty() || host == fixture_->size()) return;
    add("host", i, host);
    for (std::size_t steps = 0; host < fixture_->size() && steps < fixture_->size(); ++steps) {
      add("contains", host, i);
      add("inside", i, host);
      host = at(host).host.empty() ? fixture_->size() : find(at(host).host);
    }
  }

  void relate_written(std::size_t i) {
    for (const auto& [relation, pattern] : at(i).related)
      for (std::size_t j = 0; j < fixture_->size(); ++j) {
        if (i == j || !is_match(pattern, at(j).name)) continue;
        add(relation, i, j);
        const std::string back = inverse_of(relation);
        if (!back.empty()) add(back, j, i);
      }
  }

  /// What the other feature is to this one; empty if that has no name.
  static std::string inverse_of(const std::string& relation) {
    if (relation == "host" || relation == "above") return {};
    if (relation == "contains") return "inside";
    return relation == "inside" ? "contains" : relation;
  }

  void relate_placed(std::size_t i, std::size_t j) {
    if (at(i).facade.empty() || at(i).facade != at(j).facade) return;
    add_both("same_facade", i, j);
    if (number(i, Attribute::storey) &&
        number(i, Attribute::storey) == number(j, Attribute::storey))
      add_both("same_storey", i, j);
    const auto wide = gap(i, j, Attribute::width);
    const auto high = gap(i, j, Attribute::height);
    if (wide && high && *high < 0 && *wide <= 1) add_both("beside", i, j);
    if (wide && high && *wide < 0 && *high >= 0 && *high <= 1) {
      const bool is_higher =
          *number(i, Attribute::base_height) > *number(j, Attribute::base_height);
      is_higher ? add("above", j, i) : add("above", i, j);
    }
    if (is_alike(i, j)) add_both("alike", i, j);
  }

  /// The gap between their extents along the facade or upwards; below 0 where these overlap.
  [[nodiscard]] std::optional<double> gap(std::size_t i, std::size_t j, Attribute size) const {
    const auto middle = [&](std::size_t k) -> std::optional<double> {
      const auto extent = number(k, size);
      const auto bottom = number(k, Attribute::base_height);
      if (size == Attribute::width) return at(k).x;
      return extent && bottom ? std::optional(*bottom + *extent / 2) : std::nullopt;
    };
    const auto p = number(i, size), q = number(j, size);
    const auto m = middle(i), n = middle(j);
    if (!p || !q || !m || !n) return std::nullopt;
    return std::abs(*m - *n) - (*p + *q) / 2;
  }

  [[nodiscard]] bool is_alike(std::size_t i, std::size_t j) const {
    const auto sense = [&](std::size_t k) { return at(k).texts.find(Attribute::sense); };
    if (sense(i) == at(i).texts.end() || sense(j) == at(j).texts.end()) return false;
    const auto is_near = [&](Attribute size) {
      const auto p = number(i, size), q = number(j, size);
      return p && q && std::abs(*p - *q) <= 0.1 * std::max(*p, *q);
    };
    if (sense(i)->second != sense(j)->second || !is_near(Attribute::a) || !is_near(Attribute::b))
      return false;
    if (!at(i).x || !at(j).x || !number(i, Attribute::base_height) ||
        !number(j, Attribute::base_height))
      return false;
    return std::hypot(*at(i).x - *at(j).x,
                      *number(i, Attribute::base_height) - *number(j, Attribute::base_height)) <= 6;
  }

  const Fixture* fixture_;
  std::map<std::string, std::vector<FeatureGraph::Pair>> pairs_;
};

void check_hosts(const Fixture& fixture, const YamlNode& node, Loader& loader) {
  for (const FixtureFeature& feature : fixture)
    if (!feature.host.empty() &&
        std::ranges::find(fixture, feature.host, &FixtureFeature::name) == fixture.end())
      loader.findings.error(Code::R212, node.span,
                            fmt::format("the host '{}' of '{}' is wall, roof, ground or a feature "
                                        "of the fixture",
                                        feature.host, feature.name));
}

}  // namespace

bool is_match(std::string_view pattern, std::string_view name) {
  if (!pattern.ends_with('*')) return pattern == name;
  pattern.remove_suffix(1);
  return name.starts_with(pattern);
}

Fixture read_fixture(const YamlNode& node, Loader& loader) {
  Fixture fixture;
  YamlSection section(node, "a fixture", test_grammar().keys("fixture"), loader.findings);
  const YamlNode* features = section.require("features");
  if (features == nullptr || !expect_map(*features, "'features'", loader.findings)) return fixture;
  FixtureFeature defaults;
  if (const YamlNode* values = section.find("defaults")) read_values(*values, defaults, loader);
  for (const YamlEntry& entry : features->entries) {
    FixtureFeature feature = defaults;
    feature.name = entry.key.text;
    read_values(entry.value, feature, loader);
    const YamlNode* grid = nullptr;
    for (const YamlEntry& value : entry.value.entries)
      if (value.key.text == "repeat") grid = &value.value;
    if (grid == nullptr)
      fixture.push_back(std::move(feature));
    else
      repeat(*grid, feature, fixture, loader);
    if (fixture.size() > kMostRepeated) break;
  }
  if (fixture.size() > kMostRepeated)
    loader.findings.error(Code::R213, node.span, "a fixture has no more than 10000 features");
  check_hosts(fixture, node, loader);
  return fixture;
}

void override_features(const YamlNode& node, Fixture& fixture, Loader& loader) {
  if (!expect_map(node, "values of features", loader.findings)) return;
  for (const YamlEntry& entry : node.entries) {
    const std::string& key = entry.key.text;
    const std::size_t dot = std::min(key.rfind('.'), key.size());
    const std::string pattern = key.substr(0, dot);
    bool has_match = false;
    for (FixtureFeature& feature : fixture) {
      if (!is_match(pattern, feature.name)) continue;
      has_match = true;
      set_value(entry.key, std::string_view(key).substr(std::min(dot + 1, key.size())), entry.value,
                feature, loader);
    }
    if (!has_match)
      loader.findings.error(Code::R212, entry.key.span,
                            fmt::format("no feature of the fixture is called '{}'", pattern));
  }
}

DescribedBuilding make_building(const std::string& name, const Fixture& fixture) {
  FeatureTable table(name, fixture.size());
  for (std::size_t row = 0; row < fixture.size(); ++row) {
    const FeatureId id{static_cast<int>(row)};
    const FixtureFeature& feature = fixture[row];
    table.set_id(id, feature.name);
    for (const auto& [attribute, value] : feature.numbers) table.set(id, attribute, value);
    for (const auto& [attribute, value] : feature.texts) table.set(id, attribute, value);
    if (feature.x && !feature.numbers.contains(Attribute::along))
      table.set(id, Attribute::along, *feature.x);
    const auto base = feature.numbers.find(Attribute::base_height);
    const auto extent = feature.numbers.find(Attribute::height);
    const bool is_known = base != feature.numbers.end() && extent != feature.numbers.end();
    if (is_known && !feature.numbers.contains(Attribute::top))
      table.set(id, Attribute::top, base->second + extent->second);
  }
  return {std::move(table), Relating(fixture).run()};
}

}  // namespace oriel::rules
