#pragma once

#include "interpret/labelling/interpret.h"
#include "interpret/pack/rule_base.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel::test {

using Value = std::variant<double, const char*>;
using Values = std::map<std::string, Value>;

/// Features made by hand: attributes by name, related by name.
class Scene {
 public:
  FeatureId add(Values values) {
    features_.push_back(std::move(values));
    return FeatureId{static_cast<int>(features_.size()) - 1};
  }
  /// The same feature with other values for some attributes.
  FeatureId add(Values values, const Values& others) {
    for (const auto& [name, value] : others) values[name] = value;
    return add(std::move(values));
  }
  void relate(const std::string& relation, FeatureId self, FeatureId other) {
    pairs_[relation].emplace_back(self, other);
  }
  /// Both ways, for relations such as `beside`.
  void relate_both(const std::string& relation, FeatureId p, FeatureId q) {
    relate(relation, p, q);
    relate(relation, q, p);
  }
  /// `host` and its inverse.
  void put_on(FeatureId host, FeatureId feature) {
    relate("host", feature, host);
    relate("contains", host, feature);
    relate("inside", feature, host);
  }

  [[nodiscard]] FeatureTable table() const {
    FeatureTable table("house", features_.size());
    for (std::size_t row = 0; row < features_.size(); ++row) {
      const FeatureId id{static_cast<int>(row)};
      table.set_id(id, fmt::format("f{}", row));
      for (const auto& [name, value] : features_[row]) set(table, id, name, value);
    }
    return table;
  }
  [[nodiscard]] FeatureGraph graph() const {
    FeatureGraph graph;
    for (const auto& [relation, pairs] : pairs_) graph.set(relation, pairs);
    return graph;
  }

  /// The same features in another order: feature k becomes feature order[k].
  [[nodiscard]] Scene reordered(const std::vector<int>& order) const {
    Scene scene;
    scene.features_.resize(features_.size());
    const auto place = [&](FeatureId id) { return order[id.index()]; };
    for (std::size_t row = 0; row < features_.size(); ++row)
      scene.features_[static_cast<std::size_t>(order[row])] = features_[row];
    for (const auto& [relation, pairs] : pairs_)
      for (const auto& [self, other] : pairs)
        scene.relate(relation, FeatureId{place(self)}, FeatureId{place(other)});
    return scene;
  }

 private:
  static void set(FeatureTable& table, FeatureId id, const std::string& name, const Value& value) {
    if (const double* number = std::get_if<double>(&value))
      table.set(id, find_attribute(name).value(), *number);
    else
      table.set(id, find_attribute(name).value(), std::string(std::get<const char*>(value)));
  }

  std::vector<Values> features_;
  std::map<std::string, std::vector<FeatureGraph::Pair>> pairs_;
};

/// Header, two classes and `body`; `body` begins on line 4.
inline std::string pack_with(const std::string& body) {
  return "schema: oriel/1\n"
         "pack: {name: t, version: 1.0.0}\n"
         "classes: {opening: {abstract: true}, window: {}, door: {}}\n" +
         body;
}

/// A pack with one rule for `window` whose conditions are those lines; the first stands on line 7
/// and begins in column 9.
inline std::string pack_requiring(const std::vector<std::string>& conditions) {
  std::string body = "rules:\n  - id: w\n    label: window\n    require:\n";
  for (const std::string& condition : conditions) body += "      - " + condition + "\n";
  return pack_with(body);
}

/// All findings of a pack called t.yaml, as they are printed.
inline std::string findings(const std::string& text) {
  std::string printed;
  for (const Issue& issue : load_pack(text, "t.yaml").issues) printed += to_string(issue) + "\n";
  return printed;
}

/// A pack that must load without any finding, but that a rule may be shadowed by another one, and a
/// label not be written.
inline RuleBase load(const std::string& text) {
  auto checked = load_pack(text, "t.yaml");
  for (const Issue& issue : checked.issues)
    if (issue.code != Code::R255 && issue.code != Code::R258) FAIL_CHECK(to_string(issue));
  REQUIRE(checked.value);
  return *checked.value;
}

/// The labels of all features, "-" for unknown.
inline std::vector<std::string> labels(const RuleBase& base, const Scene& scene) {
  std::vector<std::string> list;
  for (const Verdict& verdict : interpret(base, scene.table(), scene.graph()).verdicts)
    list.push_back(verdict.label.empty() ? "-" : verdict.label);
  return list;
}

using Labels = std::vector<std::string>;

}  // namespace oriel::test
