#include "interpret/compile/reads.h"
#include "interpret/language/parser.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/surfaces/surface_rules.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace oriel::rules {

namespace {

const std::vector<std::string>& surface_types() {
  static const std::vector<std::string> types = {"WallSurface",         "RoofSurface",
                                                 "GroundSurface",       "ClosureSurface",
                                                 "OuterCeilingSurface", "OuterFloorSurface"};
  return types;
}

/// Reads the entries of `surfaces:` into rules of their own.
class SurfaceReader {
 public:
  explicit SurfaceReader(Loader& loader)
      : findings_(loader.findings),
        rules_(std::make_shared<SurfaceRules>(loader.pack.source)),
        checker_(rules_->pack, loader.names, loader.findings) {
    rules_->pack.params = loader.pack.params;
    rules_->pack.classes = loader.pack.classes;
    checker_.speak_of_surfaces();
  }

  void read(const YamlNode& entry);
  std::shared_ptr<const SurfaceRules> rules() {
    if (!findings_.has_errors()) rules_->pack.reads = find_reads(rules_->pack);
    return rules_;
  }

 private:
  void read_id(const YamlNode& node, SurfaceRule& rule);
  void read_type(const YamlNode& node, SurfaceRule& rule);
  void read_when(const YamlNode& node, SurfaceRule& rule);

  Findings& findings_;
  std::shared_ptr<SurfaceRules> rules_;
  Checker checker_;
  std::set<std::string> ids_;
};

void SurfaceReader::read(const YamlNode& entry) {
  YamlSection section(entry, name_with_id(entry, "entry", "an entry of 'surfaces'"),
                      pack_grammar().keys("surface"), findings_);
  if (!section.is_map()) return;
  SurfaceRule rule;
  rule.span = entry.span;
  if (const YamlNode* id = section.require("id")) read_id(*id, rule);
  if (const YamlNode* type = section.require("type")) read_type(*type, rule);
  if (const YamlNode* when = section.require("when")) read_when(*when, rule);
  rules_->rules.push_back(std::move(rule));
}

void SurfaceReader::read_id(const YamlNode& node, SurfaceRule& rule) {
  const auto id = read_text(node, "an id", findings_);
  if (!id) return;
  rule.id = *id;
  if (!is_rule_id(*id))
    findings_.error(Code::R216, node.span,
                    "an entry cannot be called '" + *id +
                        "': an id is names joined by points, such as ground.low");
  else if (!ids_.insert(*id).second)
    findings_.error(Code::R240, node.span, "there is an entry '" + *id + "' already");
}

void SurfaceReader::read_type(const YamlNode& node, SurfaceRule& rule) {
  const auto type = read_text(node, "a type of surface", findings_);
  if (!type) return;
  rule.type = *type;
  const auto& types = surface_types();
  if (std::ranges::find(types, *type) == types.end())
    findings_.error(Code::R212, node.span,
                    "a type of surface is one of " + join(types) + ", not '" + *type + "'" +
                        did_you_mean(*type, types));
}

void SurfaceReader::read_when(const YamlNode& node, SurfaceRule& rule) {
  const auto read_one = [&](const YamlNode& item) {
    const auto where = expression_span(item, findings_);
    const auto syntax = where ? parse_expression(*where, findings_) : std::nullopt;
    const ExprId id = syntax ? checker_.condition(*syntax) : kNoExpr;
    if (id != kNoExpr) rule.when.push_back(id);
  };
  if (node.kind != YamlNode::Kind::sequence) return read_one(node);
  for (const YamlNode& item : node.items) read_one(item);
  if (node.items.empty())
    findings_.error(Code::R210, node.span, "an entry needs a condition under 'when'");
}

}  // namespace

void read_surfaces(const YamlNode& node, Loader& loader) {
  if (!expect_list(node, "'surfaces'", loader.findings)) return;
  SurfaceReader reader(loader);
  for (const YamlNode& entry : node.items) reader.read(entry);
  loader.pack.surfaces = reader.rules();
}

}  // namespace oriel::rules
