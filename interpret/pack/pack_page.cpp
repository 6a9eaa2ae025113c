#include "interpret/pack/pack_page.h"

#include "interpret/evaluate/pack_values.h"
#include "interpret/language/condition_words.h"
#include "interpret/language/parser.h"
#include "interpret/pack/names.h"
#include "interpret/plan/operators.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

std::string scalar_at(const YamlNode& map, std::string_view key) {
  const YamlNode* value = find_value(map, key);
  return value == nullptr ? "" : value->text;
}

/// A text as a cell of a table: no bar ends it early.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

/// "Party walls: 10 %" of `party-walls-pct: 10`.
std::string limit_in_words(std::string_view key, std::string_view value) {
  const std::size_t unit = key.rfind('-');
  std::string name = capitalised(std::string(key.substr(0, unit)));
  std::ranges::replace(name, '-', ' ');
  return fmt::format("{}: {} {}", name, value, key.substr(unit + 1) == "pct" ? "%" : "m");
}

/// "1:1000 to 1:4999", "1:2500 and smaller".
std::string scales_in_words(std::string_view scale) {
  const std::size_t dots = scale.find("..");
  const auto trimmed = [](std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    return text;
  };
  const std::string_view from = trimmed(scale.substr(0, dots));
  const std::string_view to = trimmed(scale.substr(std::min(dots + 2, scale.size())));
  return to.empty() ? fmt::format("{} and smaller", from) : fmt::format("{} to {}", from, to);
}

class PackPageWriter {
 public:
  PackPageWriter(const YamlNode& tree, const Pack& pack, Findings& findings)
      : tree_(&tree),
        pack_(&pack),
        findings_(&findings),
        words_(findings.source(), values_of_params(tree)) {}

  std::string write() {
    write_head();
    write_classes();
    write_params();
    write_macros();
    write_relations();
    write_rules();
    write_decisions();
    write_groups();
    write_surfaces();
    write_generalise();
    write_settings();
    return std::move(page_);
  }

 private:
  static std::map<std::string, std::string> values_of_params(const YamlNode& tree) {
    std::map<std::string, std::string> values;
    if (const YamlNode* params = find_value(tree, "params"))
      for (const YamlEntry& param : params->entries)
        values[param.key.text] = scalar_at(param.value, "value");
    return values;
  }

  template <class... Parts>
  void line(fmt::format_string<Parts...> format, Parts&&... parts) {
    page_ += fmt::format(format, std::forward<Parts>(parts)...) + "\n";
  }

  /// The section of the pack, with a heading, if it is there and not empty.
  const YamlNode* section(std::string_view key, std::string_view title) {
    const YamlNode* node = find_value(*tree_, key);
    if (node == nullptr || (node->items.empty() && node->entries.empty())) return nullptr;
    line("\n## {}\n", title);
    return node;
  }

  [[nodiscard]] std::string condition(const YamlNode& node) const {
    const auto syntax = parse_expression(node.span, *findings_);
    return syntax ? words_.condition(*syntax) : node.text;
  }

  [[nodiscard]] std::string value(const YamlNode& node) const {
    const auto syntax = parse_expression(node.span, *findings_);
    return syntax ? words_.value(*syntax) : node.text;
  }

  /// One condition, or all of a list joined by `word`.
  [[nodiscard]] std::string conditions(const YamlNode& node, const char* word) const {
    if (node.kind != YamlNode::Kind::sequence) return condition(node);
    std::string text;
    for (const YamlNode& item : node.items)
      text += (text.empty() ? "" : fmt::format(", {} ", word)) + condition(item);
    return text;
  }

  void list_conditions(const YamlNode& node) {
    if (node.kind != YamlNode::Kind::sequence) return line("- {}", condition(node));
    for (const YamlNode& item : node.items) line("- {}", condition(item));
  }

  void write_head();
  void write_classes();
  [[nodiscard]] std::string written_as(const Class& c) const;
  void write_params();
  void write_macros();
  void write_relations();
  void write_rules();
  void write_rule(const YamlNode& rule);
  void write_score(const YamlNode& score);
  [[nodiscard]] std::string term(const YamlNode& node) const;
  [[nodiscard]] std::string what_is_evidence() const;
  void write_decisions();
  void write_groups();
  void write_surfaces();
  void write_generalise();
  std::string operation(const YamlNode& node);
  static std::string along(const YamlNode& entry);
  void write_settings();

  const YamlNode* tree_;
  const Pack* pack_;
  Findings* findings_;
  ConditionWords words_;
  std::string page_;
  /// The operators that the pack asks for, with what they do.
  std::map<std::string, std::string> operations_;
};

void PackPageWriter::write_head() {
  line("# {} {}\n", pack_->name, pack_->version);
  const auto labels = std::ranges::count(pack_->classes, false, &Class::is_abstract);
  line("A rule pack with {} for {}.", counted(pack_->rules.size(), "rule"),
       counted(labels, "label"));
  const auto files = pack_->source.files();
  if (files.size() < 2) return;
  std::string beneath;
  for (std::size_t i = 1; i < files.size(); ++i)
    beneath += fmt::format("{}`{}`", i > 1 ? ", " : "", files[i]);
  line("It extends {}; what follows is all of them together.", beneath);
}

/// "`Window`", "`BuildingInstallation` (sig3d 1030, top `OuterFloorSurface`)", or nothing.
std::string PackPageWriter::written_as(const Class& c) const {
  if (!c.emission) return "";
  std::string codes;
  const auto add = [&](std::string_view what, std::string_view code) {
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", what, code);
  };
  const bool has_class = !c.emission->class_code.empty();
  if (has_class && c.emission->class_code != Emission::kUsualClass)
    add("class", c.emission->class_code);
  for (const auto& [list, code] : c.emission->function) add(list, code);
  if (c.emission->top != Emission::kUsualTop) add("top", fmt::format("`{}`", c.emission->top));
  return codes.empty() ? fmt::format("`{}`", c.emission->type)
                       : fmt::format("`{}` ({})", c.emission->type, codes);
}

void PackPageWriter::write_classes() {
  if (section("classes", "Classes") == nullptr) return;
  line(
      "A feature gets at most one label. It may be of several shapes; no label comes of a shape by "
      "itself.\n");
  line("| class | | a kind of | usual numbers | written as |");
  line("|---|---|---|---|---|");
  const PackValues values(*pack_);
  for (const Class& c : pack_->classes) {
    std::string numbers;
    for (const Typical& typical : c.typical) {
      const auto [low, high] = values.count_of(*pack_, typical);
      numbers += fmt::format("{}{} {} per {}", numbers.empty() ? "" : ", ", low,
                             high == CountRange::kNoEnd ? "or more" : fmt::format("to {}", high),
                             typical.per);
    }
    const std::string parent =
        c.parent == kNoClass
            ? ""
            : fmt::format("`{}`", pack_->classes[static_cast<std::size_t>(c.parent)].name);
    line("| `{}` | {} | {} | {} | {} |", c.name, c.is_abstract ? "shape" : "label", parent, numbers,
         written_as(c));
  }
}

void PackPageWriter::write_params() {
  const YamlNode* params = section("params", "Params");
  if (params == nullptr) return;
  line("| param | value | unit | range | reason |");
  line("|---|---|---|---|---|");
  for (const YamlEntry& entry : params->entries) {
    const int index = index_of(pack_->params, entry.key.text);
    const Dimension dimension = pack_->params[static_cast<std::size_t>(index)].dimension;
    const std::string unit = dimension.is_plain() ? "none" : unit_of(dimension);
    line("| `{}` | {} | {} | {} | {} |", entry.key.text, scalar_at(entry.value, "value"), unit,
         scalar_at(entry.value, "range"), cell(scalar_at(entry.value, "why")));
  }
}

void PackPageWriter::write_macros() {
  const YamlNode* macros = section("macros", "Macros");
  if (macros == nullptr) return;
  line("Names that stand for a condition or a value in what follows.\n");
  for (const YamlEntry& entry : macros->entries)
    if (const auto syntax = parse_expression(entry.value.span, *findings_))
      line("- **{}**: {}", entry.key.text, words_.macro(*syntax));
}

void PackPageWriter::write_relations() {
  const YamlNode* relations = section("relations", "Relations");
  if (relations == nullptr) return;
  for (const YamlEntry& entry : relations->entries) {
    const YamlNode& where = *find_value(entry.value, "where");
    const auto syntax = parse_expression(where.span, *findings_);
    line("- **{}**: pairs of `{}` for which {}", entry.key.text, scalar_at(entry.value, "within"),
         syntax ? words_.pair_condition(*syntax) : where.text);
  }
}

void PackPageWriter::write_rules() {
  const YamlNode* rules = section("rules", "Rules");
  if (rules == nullptr) return;
  for (const YamlNode& rule : rules->items) {
    if (&rule != rules->items.data()) page_ += '\n';
    write_rule(rule);
  }
}

void PackPageWriter::write_rule(const YamlNode& rule) {
  line("### {}\n", scalar_at(rule, "id"));
  const YamlNode& require = *find_value(rule, "require");
  const bool is_one = require.kind != YamlNode::Kind::sequence || require.items.size() == 1;
  line("A feature is {} if {}:\n", with_article(scalar_at(rule, "label"), "**"),
       is_one ? "this holds" : "all of this holds");
  list_conditions(require);
  const YamlNode* unless = find_value(rule, "unless");
  if (unless != nullptr && (unless->kind != YamlNode::Kind::sequence || !unless->items.empty())) {
    line("\nunless one of these holds:\n");
    list_conditions(*unless);
  }
  const std::string priority = scalar_at(rule, "priority");
  if (!priority.empty()) line("\nPriority {}: the highest that holds decides.", priority);
  if (const YamlNode* score = find_value(rule, "score")) write_score(*score);
}

void PackPageWriter::write_score(const YamlNode& score) {
  if (score.items.empty()) return;
  line("\nIts score is the mean of\n");
  for (const YamlNode& item : score.items) line("- {}", term(item));
}

/// "`width`: 0 up to 0.3 m, 1 from 0.6 m, counted 2 times".
std::string PackPageWriter::term(const YamlNode& node) const {
  if (node.kind == YamlNode::Kind::scalar) return fmt::format("1 if {}, else 0", condition(node));
  const YamlEntry& entry = node.entries.front();
  std::string text;
  const auto add_ramp = [&](const char* key, const char* format_low, const char* format_high) {
    const YamlNode* ramp = find_value(entry.value, key);
    const auto range = ramp == nullptr ? std::nullopt : parse_range(ramp->span, *findings_);
    if (!range) return;
    text += fmt::format("{}{} {}, {} {}", text.empty() ? "" : "; ", format_low,
                        words_.value(range->low), format_high, words_.value(range->high));
  };
  add_ramp("rise", "0 up to", "1 from");
  add_ramp("fall", "1 up to", "0 from");
  const std::string judged = text.empty() ? fmt::format("1 if {}, else 0", condition(entry.key))
                                          : fmt::format("{}: {}", value(entry.key), text);
  const std::string weight = scalar_at(entry.value, "weight");
  return weight.empty() ? judged : fmt::format("{} (weight {})", judged, weight);
}

/// "The labels of others (`alike`) and usual numbers".
std::string PackPageWriter::what_is_evidence() const {
  const auto names = relation_names(*pack_);
  std::string company;
  for (const int relation : pack_->decide.evidence.company)
    company += fmt::format("{}`{}`", company.empty() ? "" : ", ",
                           names[static_cast<std::size_t>(relation)]);
  return company.empty() ? "Usual numbers"
                         : fmt::format("The labels of others ({}) and usual numbers", company);
}

void PackPageWriter::write_decisions() {
  const YamlNode* decide = section("decide", "Decisions");
  if (decide != nullptr) {
    const auto value_at = [&](std::string_view key) {
      const YamlNode* node = find_value(*decide, key);
      return node == nullptr ? "" : value(*node);
    };
    const std::string least = value_at("min_score");
    const std::string close = value_at("ambiguous_below");
    const std::string evidence = value_at("evidence");
    line("- A label needs a score of at least {}; what gets none is unknown.",
         least.empty() ? "0" : least);
    if (!close.empty()) line("- A lead of less than {} over another label is reported.", close);
    if (!evidence.empty())
      line("- {} move a close score by at most {}.", what_is_evidence(), evidence);
  }
  if (pack_->rounds > 0)
    line("{}- The pack is run up to {} times; scores read the labels of the time before.",
         decide == nullptr ? "\n## Decisions\n\n" : "", pack_->rounds);
}

void PackPageWriter::write_groups() {
  const YamlNode* groups = section("groups", "Groups");
  if (groups == nullptr) return;
  for (const YamlEntry& entry : groups->entries) {
    const std::string least = scalar_at(entry.value, "at_least");
    line("- **{}**: at least {} features of class `{}` that hang together by `{}`", entry.key.text,
         least.empty() ? "2" : least, scalar_at(entry.value, "of"), scalar_at(entry.value, "by"));
  }
}

void PackPageWriter::write_surfaces() {
  const YamlNode* surfaces = section("surfaces", "Surfaces");
  if (surfaces == nullptr) return;
  line("The first that holds decides what a polygon is.\n");
  for (const YamlNode& item : surfaces->items)
    line("- **{}**: `{}` if {}", scalar_at(item, "id"), scalar_at(item, "type"),
         conditions(*find_value(item, "when"), "and"));
}

/// "`enlarge` to 0.5 mm on the map, anchor sill".
std::string PackPageWriter::operation(const YamlNode& node) {
  const bool is_alone = node.kind == YamlNode::Kind::scalar;
  const std::string& name = is_alone ? node.text : node.entries.front().key.text;
  const auto& table = operator_table();
  const auto kind = std::ranges::find(table, name, &OperatorKind::name);
  operations_.emplace(name, kind->meaning);
  std::string text = fmt::format("`{}`", name);
  if (is_alone) return text;
  for (const YamlEntry& argument : node.entries.front().value.entries) {
    const auto known =
        std::ranges::find(kind->arguments, argument.key.text, &OperatorArgument::name);
    const bool is_first = &argument == node.entries.front().value.entries.data();
    text += fmt::format("{} {} {}", is_first ? "" : ",", argument.key.text,
                        known->kind == "word" ? argument.value.text : value(argument.value));
  }
  return text;
}

/// ", together with what `decor` leads to and has no label".
std::string PackPageWriter::along(const YamlNode& entry) {
  const YamlNode* with = find_value(entry, "with");
  if (with == nullptr) return {};
  const std::string of = scalar_at(*with, "of");
  const std::string as = scalar_at(*with, "as");
  return fmt::format(", together with what `{}` leads to and {}{}", scalar_at(*with, "by"),
                     of.empty() ? "has no label" : "is " + with_article(of),
                     as == "moves"   ? ", which moves with it"
                     : as == "grows" ? ", which grows with it"
                                     : "");
}

void PackPageWriter::write_generalise() {
  const YamlNode* entries = section("generalise", "Generalisation");
  if (entries == nullptr) return;
  line("For each feature the first entry that fits decides.\n");
  for (const YamlNode& entry : entries->items) {
    const std::string target = scalar_at(entry, "for");
    constexpr std::string_view kGroup = "group ";
    const std::string what = target == "any" ? "any feature"
                             : target.starts_with(kGroup)
                                 ? fmt::format("each `{}`", target.substr(kGroup.size()))
                                 : with_article(target);
    const YamlNode* when = find_value(entry, "when");
    line("- **{}** ({}): {}{}: {}", scalar_at(entry, "id"),
         scales_in_words(scalar_at(entry, "scale")), what,
         when == nullptr ? "" : " if " + condition(*when),
         operation(*find_value(entry, "do")) + along(entry));
  }
  page_ += '\n';
  for (const auto& [name, meaning] : operations_) line("`{}` {}.  ", name, meaning);
}

void PackPageWriter::write_settings() {
  const PackValues hosts(*pack_);
  line("\n## Facets\n");
  line("A facet is by its inclination (0 deg looks up, 90 deg is a wall, 180 deg looks down):\n");
  for (const auto& [name, range] :
       {std::pair("a wall", hosts.wall), {"a roof", hosts.roof}, {"ground", hosts.ground}})
    line("- {} from {:g} deg to {:g} deg", name, range.low_deg, range.high_deg);
  line("\nWhat looks down is ground up to {:g} m over the lowest point of the building.",
       hosts.ground_reach_m);
  const YamlNode* invariants = section("invariants", "Invariants");
  if (invariants == nullptr) return;
  line("No operation changes more than this.\n");
  for (const YamlEntry& entry : invariants->entries)
    line("- {}", limit_in_words(entry.key.text, entry.value.text));
}

}  // namespace

std::string pack_page(const YamlNode& tree, const Pack& pack, Findings& findings) {
  return PackPageWriter(tree, pack, findings).write();
}

}  // namespace oriel::rules
