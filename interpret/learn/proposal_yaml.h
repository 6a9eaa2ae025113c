#pragma once

#include "interpret/learn/propose.h"
#include "interpret/yaml/yaml_tree.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Writes the rules of the proposals, each as a list of one that can be put under `rules:` of a
/// pack that extends the other. `merged` is merge_pack_file() of the pack.
std::string to_yaml(const std::vector<Proposal>& proposals, const std::string& merged);

namespace rules {

/// Returns the rule as a proposal has it; its id and `remove: true` if it goes. What stays keeps
/// its quotes and comments; `end` is where the text ends that `rule` was read from (null: none).
YamlNode proposed_rule(const Proposal& proposal, const YamlNode* rule, std::size_t end);

/// Writes `rules:` with that one, in canonical form; with the comments of `text` it was read from.
std::string rules_text(YamlNode rule, std::string_view text = {});

/// Parses a text; nothing if it is no YAML.
std::optional<YamlNode> read_yaml(const std::string& text);

/// Finds a rule of `rules:` by its id; null if there is none.
const YamlNode* rule_with_id(const YamlNode& root, const std::string& id);

}  // namespace rules

}  // namespace oriel
