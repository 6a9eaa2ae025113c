#include "interpret/compile/counts.h"
#include "interpret/compile/name_lookup.h"
#include "interpret/language/parser.h"
#include "interpret/language/quantity.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Names that say something else in a pack already.
const std::vector<std::string>& taken_names() {
  static const std::vector<std::string> names = {"wall",    "roof", "ground",
                                                 "unknown", "any",  "group"};
  return names;
}

bool is_version(std::string_view text) {
  int parts = 0;
  while (true) {
    const std::size_t dot = text.find('.');
    const std::string_view part = text.substr(0, dot);
    const bool is_number = !part.empty() && part.size() <= 6 &&
                           part.find_first_not_of("0123456789") == std::string_view::npos;
    if (!is_number) return false;
    ++parts;
    if (dot == std::string_view::npos) return parts == 3;
    text.remove_prefix(dot + 1);
  }
}

/// The range of a param. What is in another unit than its value is said once, of the one that has
/// none.
std::optional<FixedRange> read_range_of(Param& param, const YamlNode& value, const YamlNode& node,
                                        Loader& loader) {
  if (!param.dimension.is_plain() || !is_without_unit(value.text))
    return read_range(node, param.dimension, loader);
  const auto range = read_range(node, {}, loader);
  if (!range || range->dimension.is_plain()) return range;
  loader.findings.error(
      Code::R231, value.span,
      fmt::format("the range of '{}' is {} and its value has no unit: write {} {}", param.name,
                  describe(range->dimension), value.text, unit_of(range->dimension)));
  param.dimension = range->dimension;
  return std::nullopt;
}

std::optional<Param> read_param(const YamlEntry& entry, Loader& loader) {
  if (!expect_name(entry.key, "a param", loader.findings)) return std::nullopt;
  YamlSection section(entry.value, "the param '" + entry.key.text + "'",
                      pack_grammar().keys("param"), loader.findings);
  const YamlNode* value_node = section.require("value");
  if (value_node == nullptr) return std::nullopt;
  Param param;
  param.name = entry.key.text;
  param.span = entry.key.span;
  param.value_span = value_node->span;
  if (const YamlNode* why = section.find("why"))
    param.why = read_text(*why, "'why'", loader.findings).value_or("");
  const auto value = read_quantity(*value_node, {}, loader);
  if (!value) return std::nullopt;
  param.value = value->value;
  param.dimension = value->dimension;
  const YamlNode* range_node = section.find("range");
  if (range_node == nullptr) return param;
  const auto range = read_range_of(param, *value_node, *range_node, loader);
  if (!range) return param;
  param.range = {range->low, range->high};
  if (param.value < range->low || param.value > range->high)
    loader.findings.error(Code::R212, value_node->span, "the value is outside its range");
  return param;
}

/// The node of a range that has no end, without the points after its low one; else nothing.
std::optional<YamlNode> without_end(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::scalar || !node.text.ends_with("..")) return std::nullopt;
  YamlNode low = node;
  low.text.resize(low.text.find_last_not_of(". ") + 1);
  low.span.end -= node.text.size() - low.text.size();
  return low;
}

struct LimitRange {
  FixedValue low;
  /// Missing: no end.
  std::optional<FixedValue> high;
};

/// `lo .. hi` or `lo ..`; what stands there is checked, and nothing is given if it is wrong.
std::optional<LimitRange> read_counts(const YamlNode& node, Loader& loader) {
  if (const auto low = without_end(node)) {
    const auto value = read_quantity(*low, Dimension{}, loader);
    return value ? std::optional(LimitRange{*value, {}}) : std::nullopt;
  }
  const auto range = read_range(node, Dimension{}, loader);
  if (!range) return std::nullopt;
  return LimitRange{{range->low, {}, range->low_expr},
                    FixedValue{range->high, {}, range->high_expr}};
}

/// What is wrong with a key was said by the section.
void read_typical(const YamlNode& node, Class& c, Loader& loader) {
  const auto& keys = pack_grammar().keys("typical");
  const YamlSection section(node, "'typical'", keys, loader.findings);
  for (const YamlEntry& entry : node.entries) {
    if (!contains(keys, entry.key.text)) continue;
    const auto counts = read_counts(entry.value, loader);
    if (!counts) continue;
    const auto [low, high] = *counts;
    if (!is_count(low.value) || (high && !is_count(high->value))) {
      loader.findings.error(Code::R212, entry.value.span,
                            "a count is a whole number, 0 or more, at most 1000000");
      continue;
    }
    const std::string per = entry.key.text.substr(std::string_view("per ").size());
    c.typical.push_back({per, low.expr, high ? high->expr : kNoExpr, entry.key.span});
  }
}

void read_class_body(const YamlNode& node, Class& c, Loader& loader) {
  if (node.kind == YamlNode::Kind::null) return;
  YamlSection section(node, "the class '" + c.name + "'", pack_grammar().keys("class"),
                      loader.findings);
  if (const YamlNode* parent = section.find("is"))
    c.parent = read_class(*parent, "the class after 'is'", loader);
  if (const YamlNode* flag = section.find("abstract"))
    c.is_abstract = read_flag(*flag, "'abstract'", loader.findings).value_or(false);
  if (const YamlNode* typical = section.find("typical")) read_typical(*typical, c, loader);
}

/// Deeper trees say nothing more, and would make the checks of a pack from a stranger slow.
constexpr std::size_t kDeepestClassTree = 16;

/// The classes above `id`, nearest first: no more than the deepest tree has.
std::vector<ClassId> ancestors_of(const std::vector<Class>& classes, ClassId id) {
  std::vector<ClassId> ancestors;
  ClassId above = classes[static_cast<std::size_t>(id)].parent;
  while (above != kNoClass && ancestors.size() <= kDeepestClassTree) {
    ancestors.push_back(above);
    above = classes[static_cast<std::size_t>(above)].parent;
  }
  return ancestors;
}

/// A class that is its own ancestor (R244) or has too many (R213) gets no parent.
void check_tree(Loader& loader) {
  auto& classes = loader.pack.classes;
  for (ClassId id = 0; id < static_cast<ClassId>(classes.size()); ++id) {
    Class& c = classes[static_cast<std::size_t>(id)];
    const auto ancestors = ancestors_of(classes, id);
    const bool is_circle = std::ranges::find(ancestors, id) != ancestors.end();
    if (!is_circle && ancestors.size() < kDeepestClassTree) continue;
    if (is_circle)
      loader.findings.error(Code::R244, c.span,
                            fmt::format("the class '{}' is its own ancestor", c.name));
    else
      loader.findings.error(Code::R213, c.span, "a class tree is no deeper than 16 levels");
    c.parent = kNoClass;
  }
}

constexpr int kMostMembers = 1'000'000;

/// Relations that the cuts make, not a measure that a pack could take differently.
bool is_of_cuts(std::string_view name) { return name == "contains" || name == "inside"; }

/// Relations of the pack that stand at `self` or below it have no number yet: `within` cannot lead
/// to them, and says so in place of "unknown". True if it does.
bool leads_below(const YamlNode& within, const YamlNode& all, const YamlEntry& self,
                 Loader& loader) {
  std::string name = within.text;
  std::ranges::replace(name, ' ', '_');
  const auto is_named = [&](const YamlEntry& entry) { return entry.key.text == name; };
  if (within.kind != YamlNode::Kind::scalar || relation_number(loader.pack, name) >= 0 ||
      contains(loader.names.broken_relations, name) || std::ranges::none_of(all.entries, is_named))
    return false;
  loader.findings.error(
      Code::R207, within.span,
      fmt::format(
          "the relation '{}' {}: 'within' names one that is built in or declared above", name,
          name == self.key.text ? "uses itself" : "is declared below '" + self.key.text + "'"));
  return true;
}

void read_relation(const YamlEntry& entry, const YamlNode& all, Loader& loader) {
  const std::string& name = entry.key.text;
  const std::size_t errors = loader.findings.error_count();
  expect_name(entry.key, "a relation", loader.findings);
  if (is_of_cuts(name))
    loader.findings.error(Code::R216, entry.key.span,
                          "a relation cannot be called '" + name +
                              "': it says what was cut into what, and is built in");
  RelationDefinition relation;
  relation.name = name;
  relation.span = entry.key.span;
  YamlSection section(entry.value, "the relation '" + name + "'", pack_grammar().keys("relation"),
                      loader.findings);
  const YamlNode* within = section.require("within");
  if (within != nullptr && !leads_below(*within, all, entry, loader))
    relation.within = read_relation(*within, "'within'", loader);
  loader.names.used_relations.insert(relation.within);
  if (const YamlNode* where = section.require("where")) {
    const auto span = expression_span(*where, loader.findings);
    const auto syntax = span ? parse_expression(*span, loader.findings) : std::nullopt;
    if (syntax) relation.where = loader.checker.pair_condition(*syntax);
  }
  if (loader.findings.error_count() > errors || relation.within < 0)
    loader.names.broken_relations.push_back(name);
  else
    loader.pack.relations.push_back(std::move(relation));
}

int read_size(const YamlNode& node, Loader& loader) {
  const auto size = read_integer(node, "'at_least'", loader.findings);
  if (size && *size >= 1 && *size <= kMostMembers) return *size;
  if (size) loader.findings.error(Code::R212, node.span, "'at_least' lies in 1 .. 1000000");
  return 2;
}

void read_group(const YamlEntry& entry, Loader& loader) {
  expect_name(entry.key, "a group", loader.findings);
  GroupKind kind;
  kind.name = entry.key.text;
  kind.span = entry.key.span;
  YamlSection section(entry.value, "the group '" + kind.name + "'", pack_grammar().keys("group"),
                      loader.findings);
  if (const YamlNode* of = section.require("of"))
    kind.of = read_class(*of, "the class after 'of'", loader);
  if (const YamlNode* by = section.require("by")) {
    kind.by = read_relation(*by, "'by'", loader);
    loader.names.used_relations.insert(kind.by);
  }
  if (const YamlNode* size = section.find("at_least")) kind.at_least = read_size(*size, loader);
  loader.pack.groups.push_back(std::move(kind));
}

/// True if the section is a map. If not, what it would have named is not missed elsewhere.
bool expect_named(const YamlNode& node, const std::string& section, Loader& loader) {
  if (expect_map(node, "'" + section + "'", loader.findings)) return true;
  loader.names.unread.insert(section);
  return false;
}

}  // namespace

bool expect_name(const YamlNode& node, const std::string& what, Findings& findings) {
  const std::string& name = node.text;
  const char* problem = nullptr;
  if (!is_identifier(name))
    problem = "a name is a small letter, then small letters, digits and _";
  else if (contains(reserved_words(), name))
    problem = "this is a word of the language";
  else if (contains(taken_names(), name))
    problem = "this name has a meaning of its own";
  if (problem == nullptr) return true;
  findings.error(Code::R216, node.span, what + " cannot be called '" + name + "': " + problem);
  return false;
}

void read_header(const YamlNode& node, Loader& loader) {
  YamlSection section(node, "'pack'", pack_grammar().keys("header"), loader.findings);
  if (const YamlNode* name = section.require("name"))
    if (read_text(*name, "a pack's name", loader.findings) &&
        expect_name(*name, "a pack", loader.findings))
      loader.pack.name = name->text;
  const YamlNode* version = section.require("version");
  if (version == nullptr || !read_text(*version, "a pack's version", loader.findings)) return;
  if (!is_version(version->text))
    loader.findings.error(Code::R212, version->span,
                          "a version is three numbers such as 1.0.0, not '" + version->text + "'");
  loader.pack.version = version->text;
}

void read_params(const YamlNode& node, Loader& loader) {
  if (!expect_named(node, "params", loader)) return;
  std::vector<Param> params;
  for (const YamlEntry& entry : node.entries) {
    if (auto param = read_param(entry, loader))
      params.push_back(std::move(*param));
    else
      loader.names.broken_params.push_back(entry.key.text);
  }
  loader.pack.params = std::move(params);
  loader.names.is_param_used.assign(loader.pack.params.size(), false);
}

void read_classes(const YamlNode& node, Loader& loader) {
  if (!expect_named(node, "classes", loader)) return;
  auto& classes = loader.pack.classes;
  for (const YamlEntry& entry : node.entries) {
    // A badly named class is kept, so that what refers to it is not reported besides.
    expect_name(entry.key, "a class", loader.findings);
    Class c;
    c.name = entry.key.text;
    c.span = entry.key.span;
    classes.push_back(std::move(c));
  }
  for (std::size_t i = 0; i < node.entries.size(); ++i)
    read_class_body(node.entries[i].value, classes[i], loader);
  check_tree(loader);
}

void read_macros(const YamlNode& node, Loader& loader) {
  if (!expect_named(node, "macros", loader)) return;
  for (const YamlEntry& entry : node.entries) {
    const bool is_named = expect_name(entry.key, "a macro", loader.findings);
    if (is_named && find_attribute(entry.key.text))
      loader.findings.error(
          Code::R216, entry.key.span,
          "a macro cannot be called '" + entry.key.text + "': there is an attribute of this name");
    if (entry.key.text == kScaleName)
      loader.findings.error(Code::R216, entry.key.span,
                            "a macro cannot be called 'scale': it is the target scale's N");
    const auto where = expression_span(entry.value, loader.findings);
    auto body = where ? parse_expression(*where, loader.findings) : std::nullopt;
    if (is_named && body)
      loader.names.macros.push_back({entry.key.text, std::move(*body), entry.key.span});
    else
      loader.names.broken_macros.push_back(entry.key.text);
  }
}

int read_relation(const YamlNode& node, const std::string& what, Loader& loader) {
  const auto text = read_text(node, what, loader.findings);
  if (!text) return -1;
  std::string name = *text;
  std::ranges::replace(name, ' ', '_');
  const int number = relation_number(loader.pack, name);
  if (number < 0)
    NameLookup(loader.pack, loader.names, loader.findings).report_relation(name, node.span);
  return number;
}

/// A relation narrows one that is built in or stands above it, so that there are no circles.
void read_relations(const YamlNode& node, Loader& loader) {
  if (!expect_named(node, "relations", loader)) return;
  for (const YamlEntry& entry : node.entries) read_relation(entry, node, loader);
}

void read_groups(const YamlNode& node, Loader& loader) {
  if (!expect_named(node, "groups", loader)) return;
  for (const YamlEntry& entry : node.entries) read_group(entry, loader);
}

}  // namespace oriel::rules
