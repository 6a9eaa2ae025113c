#include "interpret/language/synonyms.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/plan/operators.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace oriel::rules {

namespace {

constexpr const char* kScaleForm = "a scale is \"1:1000 .. 1:2500\" or \"1:1000 ..\"";

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// The N of `1:N`.
std::optional<double> denominator(std::string_view text) {
  text = trimmed(text);
  if (!text.starts_with("1:")) return std::nullopt;
  text.remove_prefix(2);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
  if (!is_whole || !(value >= 1 && value <= 1e9)) return std::nullopt;
  return value;
}

void read_scale(const YamlNode& node, GeneraliseEntry& entry, Loader& loader) {
  const auto text = read_text(node, "a scale", loader.findings);
  if (!text) return;
  const std::string_view all = *text;
  const std::size_t dots = all.find("..");
  const auto from = denominator(all.substr(0, dots));
  std::optional<double> to = std::numeric_limits<double>::infinity();
  if (dots != std::string_view::npos && !trimmed(all.substr(dots + 2)).empty())
    to = denominator(all.substr(dots + 2));
  if (!from || !to || dots == std::string_view::npos) {
    const bool is_one_scale = from && dots == std::string_view::npos;
    loader.findings.error(Code::R250, node.span,
                          is_one_scale ? "a scale is a range: write \"" + *text +
                                             " ..\" for this scale and all that are smaller"
                                       : std::string(kScaleForm) + ", not '" + *text + "'");
    return;
  }
  if (*from > *to)
    loader.findings.error(Code::R250, node.span,
                          "the scale range is empty: the larger scale comes first");
  entry.scale_from = *from;
  entry.scale_to = *to;
}

/// The operator's name in `omit` or `{enlarge: {…}}`.
const YamlNode* operator_name(const YamlNode& node, Findings& findings) {
  if (node.kind == YamlNode::Kind::scalar) return &node;
  if (node.kind == YamlNode::Kind::map && node.entries.size() == 1) return &node.entries[0].key;
  findings.error(Code::R211, node.span, "'do' is an operator: 'omit', or 'name: {arguments}'");
  return nullptr;
}

/// `{to: 0.5 mm@map, anchor: sill}`.
void read_arguments(const YamlNode& node, const OperatorKind& kind, GeneraliseEntry& entry,
                    Loader& loader) {
  YamlSection section(node, "'" + kind.name + "'", names_of(kind.arguments), loader.findings);
  if (!section.is_map()) return;
  for (const OperatorArgument& argument : kind.arguments) {
    const YamlNode* value = section.find(argument.name);
    if (value == nullptr) continue;
    GeneraliseEntry::Argument& read = entry.arguments.emplace_back();
    read.name = argument.name;
    if (argument.kind == "word") {
      read.word = value->text;
      if (std::ranges::find(argument.words, read.word) == argument.words.end())
        loader.findings.error(Code::R211, value->span,
                              "'" + argument.name + "' is one of " + join(argument.words) +
                                  ", not '" + value->text + "'");
    } else {
      const Dimension dimension{argument.kind == "length" ? 1 : 0, 0};
      read.value = read_constant(*value, dimension, loader);
    }
  }
}

void read_operation(const YamlNode& node, GeneraliseEntry& entry, Loader& loader) {
  const YamlNode* name = operator_name(node, loader.findings);
  if (name == nullptr) return;
  entry.operation = name->text;
  const auto& table = operator_table();
  const auto found = std::ranges::find(table, name->text, &OperatorKind::name);
  if (found == table.end())
    loader.findings.error(Code::R251, name->span,
                          unknown_name(NameKind::operation, "operator", name->text, names_of(table),
                                       "; the operators are: " + join(names_of(table))));
  else if (node.kind == YamlNode::Kind::scalar)
    return;
  else if (!found->arguments.empty())
    read_arguments(node.entries[0].value, *found, entry, loader);
  else
    loader.findings.error(Code::R211, node.entries[0].value.span,
                          "'" + name->text + "' has no arguments: write do: " + name->text);
}

void read_target(const YamlNode& node, GeneraliseEntry& entry, Loader& loader) {
  const auto text = read_text(node, "'for'", loader.findings);
  if (!text || *text == "any") return;
  constexpr std::string_view kGroup = "group ";
  if (!text->starts_with(kGroup)) {
    entry.target = read_class(node, "'for'", loader);
    return;
  }
  const std::string name(trimmed(std::string_view(*text).substr(kGroup.size())));
  entry.group = index_of(loader.pack.groups, name);
  if (entry.group >= 0 || loader.names.unread.contains("groups")) return;
  const auto groups = names_of(loader.pack.groups);
  std::string advice = did_you_mean(name, groups);
  if (advice.empty())
    advice = groups.empty() ? "; the pack has no 'groups'" : "; the groups are: " + join(groups);
  loader.findings.error(Code::R253, node.span, "unknown group '" + name + "'" + advice);
}

Belonging read_belonging(const YamlNode& node, Loader& loader) {
  static const std::vector<std::string> kWords{"goes", "moves", "grows"};  // as in Belonging
  const auto text = read_text(node, "'as'", loader.findings);
  if (!text) return Belonging::goes;
  const auto found = std::ranges::find(kWords, *text);
  if (found != kWords.end()) return static_cast<Belonging>(found - kWords.begin());
  loader.findings.error(Code::R211, node.span,
                        "'as' is one of " + join(kWords) + ", not '" + *text + "'");
  return Belonging::goes;
}

/// `{by: decor}`, or `{by: decor, of: sill, as: grows}`.
void read_with(const YamlNode& node, GeneraliseEntry& entry, Loader& loader) {
  YamlSection section(node, "'with'", pack_grammar().keys("with"), loader.findings);
  if (!section.is_map()) return;
  if (const YamlNode* by = section.require("by")) {
    entry.with = read_relation(*by, "'by'", loader);
    loader.names.used_relations.insert(entry.with);
  }
  if (const YamlNode* of = section.find("of"))
    entry.with_of = read_class(*of, "the class after 'of'", loader);
  const YamlNode* as = section.find("as");
  if (as == nullptr) return;
  entry.with_as = read_belonging(*as, loader);
  const bool draws_nothing = entry.operation == "omit" || entry.operation == "flatten";
  if (entry.with_as != Belonging::goes && draws_nothing)
    loader.findings.error(
        Code::R211, as->span,
        "'as' says what becomes of things when the feature is drawn again, and '" +
            entry.operation + "' only takes it away: leave it out");
}

void read_entry_id(const YamlNode& node, GeneraliseEntry& entry, std::set<std::string>& ids,
                   Loader& loader) {
  const auto id = read_text(node, "an entry's id", loader.findings);
  if (!id) return;
  entry.id = *id;
  if (!is_rule_id(*id))
    loader.findings.error(Code::R216, node.span,
                          "an entry cannot be called '" + *id +
                              "': an id is names joined by points, such as small.omit");
  else if (!ids.insert(*id).second)
    loader.findings.error(Code::R240, node.span, "there is an entry '" + *id + "' already");
}

void read_entry(const YamlNode& node, std::set<std::string>& ids, Loader& loader) {
  YamlSection section(node, name_with_id(node, "entry", "an entry"), pack_grammar().keys("entry"),
                      loader.findings);
  if (!section.is_map()) return;
  GeneraliseEntry entry;
  entry.span = node.span;
  if (const YamlNode* id = section.require("id")) read_entry_id(*id, entry, ids, loader);
  if (const YamlNode* scale = section.require("scale")) read_scale(*scale, entry, loader);
  if (const YamlNode* target = section.require("for")) read_target(*target, entry, loader);
  loader.checker.speak_of_group(entry.group >= 0);
  if (const YamlNode* when = section.find("when")) entry.when = read_condition(*when, loader);
  loader.checker.speak_of_group(false);
  if (const YamlNode* operation = section.require("do")) read_operation(*operation, entry, loader);
  if (const YamlNode* with = section.find("with")) read_with(*with, entry, loader);
  loader.pack.entries.push_back(std::move(entry));
}

}  // namespace

void read_generalise(const YamlNode& node, Loader& loader) {
  if (!expect_list(node, "'generalise'", loader.findings)) return;
  loader.checker.allow_map_units(true);
  std::set<std::string> ids;
  for (const YamlNode& item : node.items) read_entry(item, ids, loader);
  loader.checker.allow_map_units(false);
}

}  // namespace oriel::rules
