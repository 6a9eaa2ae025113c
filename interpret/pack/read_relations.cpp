#include "interpret/language/parser.h"
#include "interpret/language/suggest.h"
#include "interpret/pack/loader.h"
#include "interpret/yaml/section.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr int kMostMembers = 1'000'000;

/// Relations that the cuts make, not a measure that a pack could take differently.
bool is_of_cuts(std::string_view name) { return name == "contains" || name == "inside"; }

void read_relation(const YamlEntry& entry, Loader& loader) {
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
  YamlSection section(entry.value, "a relation", {"within", "where"}, loader.findings);
  if (const YamlNode* within = section.require("within"))
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
  YamlSection section(entry.value, "a group", {"of", "by", "at_least"}, loader.findings);
  if (const YamlNode* of = section.require("of"))
    kind.of = read_class(*of, "the class after 'of'", loader);
  if (const YamlNode* by = section.require("by")) {
    kind.by = read_relation(*by, "'by'", loader);
    loader.names.used_relations.insert(kind.by);
  }
  if (const YamlNode* size = section.find("at_least")) kind.at_least = read_size(*size, loader);
  loader.pack.groups.push_back(std::move(kind));
}

}  // namespace

int read_relation(const YamlNode& node, const std::string& what, Loader& loader) {
  const auto text = read_text(node, what, loader.findings);
  if (!text) return -1;
  std::string name = *text;
  std::ranges::replace(name, ' ', '_');
  const int number = relation_number(loader.pack, name);
  const bool is_broken =
      std::ranges::find(loader.names.broken_relations, name) != loader.names.broken_relations.end();
  if (number >= 0 || is_broken) return number;
  loader.findings.error(Code::R207, node.span,
                        fmt::format("unknown relation '{}'{}", *text,
                                    did_you_mean(name, relation_names(loader.pack))));
  return -1;
}

/// A relation narrows one that is built in or stands above it, so that there are no circles.
void read_relations(const YamlNode& node, Loader& loader) {
  if (!expect_map(node, "'relations'", loader.findings)) return;
  for (const YamlEntry& entry : node.entries) read_relation(entry, loader);
}

void read_groups(const YamlNode& node, Loader& loader) {
  if (!expect_map(node, "'groups'", loader.findings)) return;
  for (const YamlEntry& entry : node.entries) read_group(entry, loader);
}

}  // namespace oriel::rules
