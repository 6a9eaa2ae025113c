#include "studio/editing/proposal_text.h"

#include "interpret/pack/read/read_pack.h"
#include "interpret/yaml/yaml_tree.h"
#include "kernel/base/index.h"
#include "studio/editing/edited_pack.h"
#include "studio/editing/layers.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::ExprId;
using rules::Pack;
using rules::proposed_rule;
using rules::read_yaml;
using rules::rule_with_id;
using rules::rules_text;
using rules::YamlNode;

constexpr std::string_view kRulesLine = "rules:\n";

/// What a rule asks, as texts.
struct RuleTexts {
  std::vector<std::string> require, unless;
  std::size_t terms = 0;
  friend bool operator==(const RuleTexts&, const RuleTexts&) = default;
};

std::optional<RuleTexts> texts_of_rule(const Pack& pack, const std::string& id) {
  const auto rule = std::ranges::find(pack.rules, id, &rules::Rule::id);
  if (rule == pack.rules.end()) return std::nullopt;
  const auto texts = [&](const std::vector<ExprId>& ids) {
    std::vector<std::string> all;
    for (const ExprId condition : ids)
      all.emplace_back(pack.source.text_of(pack.code[at(condition)].span));
    return all;
  };
  return RuleTexts{texts(rule->require), texts(rule->unless), rule->score.size()};
}

/// The lines of an item of a list that stands in lines of its own.
struct ItemLines {
  std::size_t begin = 0, end = 0;
  /// Of its hyphen.
  std::size_t indent = 0;
};

/// Nothing if it shares a line with something else. Comments and empty lines after it are not its
/// own.
std::optional<ItemLines> lines_of(const std::string& text, const YamlNode& item) {
  if (item.entries.empty()) return std::nullopt;
  const std::size_t first = item.entries[0].key.span.begin;
  const std::size_t begin = first == 0 ? 0 : text.rfind('\n', first - 1) + 1;
  const std::size_t hyphen = text.find_first_not_of(' ', begin);
  // In brackets or in lines, and with or without quotes.
  if (text[hyphen] != '-' || text.find_first_not_of(" {\"'", hyphen + 1) != first)
    return std::nullopt;
  ItemLines lines{begin, 0, hyphen - begin};
  for (std::size_t line = begin; line < text.size();) {
    const std::size_t next = std::min(text.find('\n', line), text.size() - 1) + 1;
    const std::size_t start = text.find_first_not_of(" \r\t", line);
    const bool is_empty = start == std::string::npos || text[start] == '\n' || text[start] == '#';
    if (!is_empty && line > begin && start - line <= lines.indent) break;
    if (!is_empty) lines.end = next;
    line = next;
  }
  return lines;
}

std::string indented(std::string_view text, std::size_t indent) {
  constexpr std::size_t kCanonical = 2;
  std::string out;
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t next = std::min(text.find('\n', line), text.size() - 1) + 1;
    std::string_view content = text.substr(line, next - line);
    if (content != "\n") {
      content.remove_prefix(std::min(content.find_first_not_of(' '), kCanonical));
      out.append(indent, ' ');
    }
    out += content;
    line = next;
  }
  return out;
}

/// Changes the rule where it stands. One that a pack beneath states, too, does not go by leaving it
/// out.
ProposalText changed_in_place(const std::string& text, const YamlNode& rule,
                              const Proposal& proposal, bool is_beneath) {
  const auto lines = lines_of(text, rule);
  if (!lines) return {"", "", "the rule shares a line with others: give it lines of its own"};
  const std::string slice =
      std::string(kRulesLine) + text.substr(lines->begin, lines->end - lines->begin);
  const auto root = read_yaml(slice);
  const YamlNode* own = root ? rule_with_id(*root, proposal.rule) : nullptr;
  if (own == nullptr) return {"", "", "the rule cannot be read alone"};
  ProposalText made;
  const YamlNode changed = proposed_rule(proposal, own, slice.size());
  made.yaml = rules_text(changed);
  made.text = text;
  const std::string anew =
      proposal.drops_rule && !is_beneath
          ? ""
          : indented(std::string_view(rules_text(changed, slice)).substr(kRulesLine.size()),
                     lines->indent);
  made.text.replace(lines->begin, lines->end - lines->begin, anew);
  return made;
}

/// States the rule in a text that has it from a pack beneath.
ProposalText stated_anew(const std::string& text, const YamlNode& tree, const YamlNode& rule,
                         const Proposal& proposal) {
  ProposalText made;
  made.yaml = rules_text(proposed_rule(proposal, &rule, 0));
  made.text = text;
  if (!made.text.empty() && !made.text.ends_with('\n')) made.text += '\n';
  const YamlNode* all = rules::find_value(tree, "rules");
  if (all == nullptr || all->kind == YamlNode::Kind::null) {
    if (all != nullptr) return {made.yaml, "", "`rules:` is there and empty: take it out"};
    made.text += made.yaml;
    return made;
  }
  const auto lines = all->items.empty() ? std::nullopt : lines_of(made.text, all->items.back());
  if (!lines) return {made.yaml, "", "the rules share a line: give each lines of its own"};
  made.text.insert(lines->end,
                   indented(std::string_view(made.yaml).substr(kRulesLine.size()), lines->indent));
  return made;
}

/// What became of the rule is what was proposed, and the text can be loaded.
std::string fault_of(const ProposalText& made, const std::string& file, const RuleTexts& before,
                     const Proposal& proposal) {
  const EditedPack pack(made.text, file);
  for (const TextFinding& finding : pack.findings())
    if (finding.severity == Severity::error) return finding.sentence;
  const auto rules = pack.rules();
  if (!rules) return "the text is no pack";
  const auto after = texts_of_rule(rules->pack(), proposal.rule);
  if (proposal.drops_rule) return after ? "the rule is still there without it" : "";
  const std::size_t terms = before.terms - (proposal.dropped_term >= 0 ? 1 : 0);
  const RuleTexts promised{proposal.require, proposal.unless, terms};
  return after == promised ? "" : "the change cannot be written as it was measured";
}

}  // namespace

ProposalText text_with_proposal(const RuleBase& rules, const std::string& text,
                                const std::string& file, const Proposal& proposal) {
  const auto before = texts_of_rule(rules.pack(), proposal.rule);
  const EditedPack edited(text, file);
  const auto now = edited.rules();
  if (!before || !now) return {"", "", "the pack has errors: mend them first"};
  if (texts_of_rule(now->pack(), proposal.rule) != before)
    return {"", "", "the rule was changed since this was proposed: learn again"};
  const rules::PackLayers layers(edited.text(), file, rules::finder_for(file));
  const rules::DeclaredName* declared = layers.find(rules::WordSort::rule, proposal.rule);
  if (declared == nullptr) return {"", "", "the rule is not found"};
  const bool is_beneath = std::ranges::any_of(layers.names(), [&](const auto& other) {
    return other.sort == declared->sort && other.name == declared->name &&
           other.layer != &layers.top();
  });
  ProposalText made =
      declared->layer == &layers.top()
          ? changed_in_place(edited.text(), *declared->value, proposal, is_beneath)
          : stated_anew(edited.text(), layers.top().tree, *declared->value, proposal);
  if (!made.why_not.empty()) return made;
  made.why_not = fault_of(made, file, *before, proposal);
  if (!made.why_not.empty()) made.text.clear();
  return made;
}

}  // namespace oriel
