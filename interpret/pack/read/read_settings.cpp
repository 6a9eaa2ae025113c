#include "interpret/evaluate/pack_values.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// What has not settled by then goes round in circles.
constexpr int kMostRounds = 8;

const std::vector<std::string>& emitted_types() {
  static const std::vector<std::string> types = {"Window", "Door", "BuildingInstallation"};
  return types;
}

const std::vector<std::string>& top_types() {
  static const std::vector<std::string> types = {"RoofSurface", "OuterFloorSurface"};
  return types;
}

std::optional<std::string> read_choice(const YamlNode& node, const std::string& what,
                                       const std::vector<std::string>& choices,
                                       Findings& findings) {
  auto text = read_text(node, what, findings);
  if (!text || std::ranges::find(choices, *text) != choices.end()) return text;
  findings.error(Code::R212, node.span,
                 what + " is one of " + join(choices) + ", not '" + *text + "'" +
                     did_you_mean(*text, choices));
  return std::nullopt;
}

/// A code of a code list. Bare digits would be a number to other readers, and 0100 is not 100.
std::optional<std::string> read_code(const YamlNode& node, Findings& findings) {
  auto code = read_text(node, "a code", findings);
  if (!code || !node.is_plain || code->find_first_not_of("0123456789.") != std::string::npos)
    return code;
  findings.error(Code::R211, node.span, "a code is a text: write \"" + *code + "\"");
  return std::nullopt;
}

std::optional<Emission> read_emission(const YamlNode& node, Loader& loader) {
  YamlSection section(node, "an emitted object", pack_grammar().keys("emission"), loader.findings);
  const YamlNode* type_node = section.require("type");
  if (type_node == nullptr) return std::nullopt;
  Emission emission;
  emission.class_code = Emission::kUsualClass;
  const auto type = read_choice(*type_node, "an emitted type", emitted_types(), loader.findings);
  if (!type) return std::nullopt;
  emission.type = *type;
  if (const YamlNode* code = section.find("class"))
    emission.class_code = read_code(*code, loader.findings).value_or("");
  if (const YamlNode* top = section.find("top"))
    emission.top = read_choice(*top, "'top'", top_types(), loader.findings).value_or("");
  const YamlNode* function = section.find("function");
  if (function == nullptr || !expect_map(*function, "'function'", loader.findings)) return emission;
  for (const YamlEntry& entry : function->entries)
    if (auto code = read_code(entry.value, loader.findings))
      emission.function[entry.key.text] = *code;
  return emission;
}

void read_facet_range(const YamlNode* node, HostRange& range, Loader& loader) {
  if (node == nullptr) return;
  const auto read = read_range(*node, Dimension{0, 1}, loader);
  if (!read) return;
  range = {read->low_expr, read->high_expr};
  if (read->low < 0 || read->high > 180)
    loader.findings.error(Code::R212, node->span, "an inclination lies in 0 deg .. 180 deg");
}

ExprId read_share(const YamlNode* node, const std::string& what, Loader& loader) {
  const auto value = node == nullptr ? std::nullopt : read_quantity(*node, Dimension{}, loader);
  if (!value) return kNoExpr;
  if (value->value < 0 || value->value > 1)
    loader.findings.error(Code::R212, node->span, what + " lies in 0 .. 1");
  return value->expr;
}

/// A relation by its name alone, or a list of them.
std::vector<int> read_company(const YamlNode& node, Loader& loader) {
  std::vector<int> relations;
  const auto read = [&](const YamlNode& name) {
    const int relation = read_relation(name, "a relation", loader);
    if (relation < 0) return;
    relations.push_back(relation);
  };
  if (node.kind == YamlNode::Kind::sequence)
    for (const YamlNode& item : node.items) read(item);
  else
    read(node);
  return relations;
}

void read_evidence(const YamlSection& section, Loader& loader) {
  EvidenceSettings& evidence = loader.pack.decide.evidence;
  const YamlNode* most = section.find("evidence");
  evidence.most = read_share(most, "'evidence'", loader);
  const YamlNode* company = section.find("company");
  if (company != nullptr) evidence.company = read_company(*company, loader);
  if (evidence.is_written()) {
    evidence.span = most->span;
    if (company == nullptr) evidence.company = {relation_number(loader.pack, "alike")};
    if (const PackValues said(loader.pack); 2 * said.evidence > said.ambiguous_below)
      loader.findings.error(
          Code::R212, most->span,
          "'evidence' is at most half of 'ambiguous_below': it decides what is close only");
  } else if (most == nullptr && company != nullptr &&
             loader.pack.source.is_in_first(company->span.begin)) {
    loader.findings.warning(Code::R257, company->span,
                            "'company' says nothing: 'evidence' says how much it may add");
  }
}

}  // namespace

void read_hosts(const YamlNode& node, Loader& loader) {
  YamlSection section(node, "'hosts'", pack_grammar().keys("hosts"), loader.findings);
  Hosts& hosts = loader.pack.hosts;
  read_facet_range(section.find("wall"), hosts.wall, loader);
  read_facet_range(section.find("roof"), hosts.roof, loader);
  read_facet_range(section.find("ground"), hosts.ground, loader);
  if (PackValues(loader.pack).has_overlapping_hosts())
    loader.findings.error(Code::R212, node.span, "wall, roof and ground overlap");
  const YamlNode* reach = section.find("ground_reach");
  if (reach == nullptr) return;
  if (const auto value = read_quantity(*reach, Dimension{1, 0}, loader))
    hosts.ground_reach = value->expr;
}

void read_decide(const YamlNode& node, Loader& loader) {
  YamlSection section(node, "'decide'", pack_grammar().keys("decide"), loader.findings);
  Decide& decide = loader.pack.decide;
  decide.min_score = read_share(section.find("min_score"), "'min_score'", loader);
  decide.ambiguous_below = read_share(section.find("ambiguous_below"), "'ambiguous_below'", loader);
  read_evidence(section, loader);
  if (const YamlNode* otherwise = section.find("otherwise"))
    read_choice(*otherwise, "'otherwise'", {"unknown"}, loader.findings);
}

void read_iterate(const YamlNode& node, Loader& loader) {
  YamlSection section(node, "'iterate'", pack_grammar().keys("iterate"), loader.findings);
  const YamlNode* rounds = section.require("rounds");
  if (rounds == nullptr) return;
  const auto count = read_integer(*rounds, "'rounds'", loader.findings);
  if (count && (*count < 2 || *count > kMostRounds))
    loader.findings.error(Code::R212, rounds->span, "'rounds' lies in 2 .. 8");
  loader.pack.rounds = count.value_or(0);
}

void read_emit(const YamlNode& node, Loader& loader) {
  if (!expect_map(node, "'emit'", loader.findings)) return;
  for (const YamlEntry& entry : node.entries) {
    auto emission = read_emission(entry.value, loader);
    const ClassId id = read_class(entry.key, "a class", loader);
    if (id != kNoClass)
      loader.pack.classes[static_cast<std::size_t>(id)].emission = std::move(emission);
  }
}

Limits read_limits(const YamlNode& node, Findings& findings) {
  Limits limits;
  const std::vector<std::pair<std::string, std::optional<double>*>> all{
      {"footprint-pct", &limits.footprint_pct},
      {"volume-pct", &limits.volume_pct},
      {"overhang-pct", &limits.overhang_pct},
      {"party-walls-pct", &limits.party_walls_pct},
      {"top-m", &limits.top_m},
      {"ridge-m", &limits.ridge_m},
      {"eaves-m", &limits.eaves_m}};
  const YamlSection section(node, "'invariants'", pack_grammar().keys("invariants"), findings);
  for (const auto& [key, into] : all) {
    const YamlNode* value = section.is_map() ? section.find(key) : nullptr;
    if (value == nullptr) continue;
    *into = read_number(*value, fmt::format("'{}'", key), findings);
    if (*into && !(**into > 0))
      findings.error(Code::R211, value->span, fmt::format("'{}' is more than 0", key));
  }
  return limits;
}

void read_invariants(const YamlNode& node, Loader& loader) {
  loader.pack.limits = read_limits(node, loader.findings);
}

}  // namespace oriel::rules
