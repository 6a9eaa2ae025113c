#pragma once

#include "interpret/pack/loader.h"
#include "interpret/testing/rule_tests.h"
#include "interpret/yaml/yaml_tree.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace oriel::rules {

/// A feature of a test, made by hand.
struct FixtureFeature {
  std::string name;
  std::map<Attribute, double> numbers;
  std::map<Attribute, std::string> texts;
  /// Features with the same one are on the same facade; empty: none.
  std::string facade;
  /// The feature that hosts it, or empty.
  std::string host;
  /// Its middle along the facade.
  std::optional<double> x;
  /// Relations that are written out: (name, pattern of the others).
  std::vector<std::pair<std::string, std::string>> related;
};

using Fixture = std::vector<FixtureFeature>;

/// The fixture in `node`: `defaults` and `features`. Findings go to `loader`, whose pack has the
/// params that values may name.
Fixture read_fixture(const YamlNode& node, Loader& loader);

/// Sets what `node` says (`d.base_height: 0.61 m`, `w.*.b: 1 m`) of the features it names.
void override_features(const YamlNode& node, Fixture& fixture, Loader& loader);

/// True if `pattern` is the name, or ends in `*` and the name begins with what stands before it.
bool is_match(std::string_view pattern, std::string_view name);

/// The table and the relations of a fixture. Besides those that are written out: `host`, `contains`
/// from hosts; `same_facade` from facades; `same_storey` from equal storeys on one facade; `alike`,
/// `beside` and `above` as describe finds them, where positions and sizes are given.
DescribedBuilding make_building(const std::string& name, const Fixture& fixture);

}  // namespace oriel::rules
