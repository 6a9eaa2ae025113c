#include "interpret/learn/proposal_yaml.h"

#include "interpret/yaml/yaml_text.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace rules {

namespace {

YamlNode scalar_of(std::string text, bool is_plain) {
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.text = std::move(text);
  node.is_plain = is_plain;
  return node;
}

/// A condition needs no quotes where nothing in it means something to YAML.
bool can_be_plain(const std::string& text) {
  constexpr std::string_view kSpecial = ",[]{}#&*!|>'\"%@`:?\\\n";
  const auto is_special = [&](char c) {
    return kSpecial.find(c) != std::string_view::npos && c != '>' && c != '*';
  };
  return !text.empty() && std::ranges::none_of(text, is_special) &&
         std::string_view("<>=*-( ").find(text.front()) == std::string_view::npos;
}

/// Those that stay keep their quotes and comments.
std::vector<YamlNode> items_of(YamlNode& list, const std::vector<std::string>& texts,
                               std::size_t end) {
  std::vector<YamlNode> before = std::move(list.items);
  if (list.kind == YamlNode::Kind::scalar) before.push_back(list);
  std::vector<YamlNode> items;
  std::size_t begin = list.span.begin;
  for (const std::string& text : texts) {
    const auto known = std::ranges::find(before, text, &YamlNode::text);
    items.push_back(known == before.end() ? scalar_of(text, can_be_plain(text)) : *known);
    YamlNode& item = items.back();
    if (known == before.end()) item.span.begin = item.is_plain ? begin : end;
    begin = item.span.begin;
  }
  return items;
}

/// `end` is where the text ends that the rule was read from.
void set_list(YamlNode& rule, std::string_view key, const std::vector<std::string>& texts,
              std::size_t end) {
  YamlNode* node = find_value(rule, key);
  if (texts.empty()) {
    std::erase_if(rule.entries, [&](const YamlEntry& e) { return e.key.text == key; });
    return;
  }
  if (node == nullptr) {
    rule.entries.push_back({scalar_of(std::string(key), true), {}});
    rule.entries.back().key.span.begin = end;
    node = &rule.entries.back().value;
    node->span.begin = end;
  }
  node->items = items_of(*node, texts, end);
  node->kind = YamlNode::Kind::sequence;
  node->text.clear();
}

}  // namespace

YamlNode proposed_rule(const Proposal& proposal, const YamlNode* rule, std::size_t end) {
  YamlNode changed;
  if (rule == nullptr || proposal.drops_rule) {
    changed.kind = YamlNode::Kind::map;
    changed.entries.push_back({scalar_of("id", true), scalar_of(proposal.rule, true)});
    changed.entries.push_back({scalar_of("remove", true), scalar_of("true", true)});
    return changed;
  }
  changed = *rule;
  set_list(changed, "require", proposal.require, end);
  set_list(changed, "unless", proposal.unless, end);
  YamlNode* score = find_value(changed, "score");
  if (score == nullptr || proposal.dropped_term < 0) return changed;
  if (at(proposal.dropped_term) < score->items.size())
    score->items.erase(score->items.begin() + proposal.dropped_term);
  if (score->items.empty())
    std::erase_if(changed.entries, [](const YamlEntry& e) { return e.key.text == "score"; });
  return changed;
}

std::string rules_text(YamlNode rule, std::string_view text) {
  YamlNode top, list;
  top.kind = YamlNode::Kind::map;
  list.kind = YamlNode::Kind::sequence;
  list.items.push_back(std::move(rule));
  top.entries.push_back({scalar_of("rules", true), std::move(list)});
  return text.empty() ? to_yaml(top) : to_yaml(top, text);
}

std::optional<YamlNode> read_yaml(const std::string& text) {
  const Source source("rule", text);
  Findings findings(source);
  return parse_yaml({0, text.size()}, findings);
}

const YamlNode* rule_with_id(const YamlNode& root, const std::string& id) {
  const YamlNode* all = find_value(root, "rules");
  if (all == nullptr) return nullptr;
  for (const YamlNode& item : all->items)
    if (const YamlNode* found = find_value(item, "id"); found && found->text == id) return &item;
  return nullptr;
}

}  // namespace rules

std::string to_yaml(const std::vector<Proposal>& proposals, const std::string& merged) {
  const auto root = rules::read_yaml(merged);
  std::string text;
  for (const Proposal& proposal : proposals) {
    const rules::YamlNode* rule = root ? rules::rule_with_id(*root, proposal.rule) : nullptr;
    text += fmt::format("# {}: {:+.4f} on all buildings, {:+.4f} on held-out folds, {} of them\n",
                        proposal.what, proposal.gain, proposal.held_out_gain, proposal.folds);
    text += rules::rules_text(rules::proposed_rule(proposal, rule, 0)) + "\n";
  }
  return text;
}

}  // namespace oriel
