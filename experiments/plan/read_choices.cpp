#include "experiments/plan/plan_grammar.h"
#include "experiments/plan/plan_reader.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr Dimension kLengthDimension{1, 0}, kAreaDimension{2, 0}, kAngleDimension{0, 1},
    kPlainDimension{};

/// Of a value of `options:`; as the command has it.
struct OptionBounds {
  double low = 0, high = 0;
};

std::optional<double> read_bounded(const YamlNode& node, Dimension dimension, OptionBounds bounds,
                                   PlanReader& reader) {
  const auto value = QuantityReader(nullptr, reader.findings).value(node, dimension);
  if (!value || (*value >= bounds.low && *value <= bounds.high)) return value;
  reader.findings.error(
      Code::R212, node.span,
      fmt::format("'{}' lies in {} .. {}", node.of_key, value_text(bounds.low, unit_of(dimension)),
                  value_text(bounds.high, unit_of(dimension))));
  return std::nullopt;
}

}  // namespace

QuantityReader::QuantityReader(const RuleBase* base, Findings& findings)
    : scratch_(findings.source()), loader_(scratch_, findings) {
  if (base != nullptr) scratch_.params = base->pack().params;
  loader_.names.is_param_used.assign(scratch_.params.size(), false);
}

std::optional<double> QuantityReader::value(const YamlNode& node, Dimension dimension) {
  const auto read = read_quantity(node, dimension, loader_);
  return read ? std::optional(read->value) : std::nullopt;
}

std::optional<std::pair<double, double>> QuantityReader::range(const YamlNode& node,
                                                               Dimension dimension) {
  const auto read = read_range(node, dimension, loader_);
  if (!read) return std::nullopt;
  return std::pair(read->low, read->high);
}

bool read_segmentation_key(const std::string& key, const YamlNode& value, SegmentationPlan& options,
                           PlanReader& reader) {
  constexpr double kMuch = 1e6;
  const auto quantity = [&](std::optional<double>& into, Dimension dimension, OptionBounds bounds) {
    into = read_bounded(value, dimension, bounds, reader);
    return true;
  };
  const auto word = [&](std::optional<std::string>& into, const std::vector<std::string>& words) {
    into = read_word(value, "'" + key + "'", words, reader.findings);
    return true;
  };
  if (key == "order") return word(options.order, {"natural", "paper"});
  if (key == "close") return word(options.close, {"none", "planar", "ground", "any"});
  if (key == "crossings") return word(options.crossings, {"leave", "cut"});
  if (key == "coplanar") return quantity(options.coplanar_deg, kAngleDimension, {0, 30});
  if (key == "plane_offset") return quantity(options.plane_offset_m, kLengthDimension, {0, 1});
  if (key == "weld") return quantity(options.weld_m, kLengthDimension, {1e-6, 1});
  if (key == "value_rel") return quantity(options.value_rel, kPlainDimension, {0, 0.5});
  if (key == "close_area") return quantity(options.close_area_m2, kAreaDimension, {0, kMuch});
  if (key == "budget") {
    options.budget = read_count(value, "'budget'", 1, reader.findings);
    return true;
  }
  if (key != "lod") return false;
  options.lod = read_text(value, "'lod'", reader.findings);
  return true;
}

void read_segmentation(const YamlNode& map, SegmentationPlan& options, PlanReader& reader) {
  for (const YamlEntry& entry : map.entries)
    read_segmentation_key(entry.key.text, entry.value, options, reader);
}

void read_plan_options(const YamlNode& node, SegmentationPlan& options, PlanReader& reader) {
  const YamlSection section(node, "'options'", plan_grammar().keys("options"), reader.findings);
  if (section.is_map()) read_segmentation(node, options, reader);
}

std::optional<RuleBase> read_plan_pack(const YamlNode& node, PlanReader& reader) {
  const auto name = read_text(node, "a pack", reader.findings);
  if (!name) return std::nullopt;
  const auto beside = std::filesystem::path(reader.plan.file).parent_path() / *name;
  const auto loaded = load_pack_file(embedded_pack(*name) ? *name : beside.string());
  if (loaded.value) return loaded.value;
  const auto first = std::ranges::find(loaded.issues, Severity::error, &Issue::severity);
  const bool is_missing = first->code == Code::R200;
  reader.findings.error(is_missing ? Code::R200 : first->code, node.span,
                        is_missing
                            ? fmt::format("the pack '{}': {}", *name, first->sentence)
                            : fmt::format("the pack '{}' has errors ('oriel rules check' lists "
                                          "them), such as {}:{}:{}: {}",
                                          *name, first->place.file, first->place.line,
                                          first->place.column, first->sentence));
  return std::nullopt;
}

const Param* find_plan_param(const YamlNode& name, const RuleBase& base, PlanReader& reader) {
  const auto& params = base.pack().params;
  const auto found = std::ranges::find(params, name.text, &Param::name);
  if (found != params.end()) return &*found;
  reader.findings.error(Code::R206, name.span,
                        fmt::format("the pack {} has no param '{}'{}", base.name(), name.text,
                                    did_you_mean(name.text, names_of(params))));
  return nullptr;
}

void expect_in_range(const Param& param, double value, SourceSpan where, Findings& findings) {
  if (!param.range || (value >= param.range->first && value <= param.range->second)) return;
  const std::string unit = unit_of(param.dimension);
  findings.error(Code::R281, where,
                 fmt::format("'{}' lies in {} .. {} (its range in the pack), not at {}", param.name,
                             value_text(param.range->first, unit),
                             value_text(param.range->second, unit), value_text(value, unit)));
}

std::vector<ParamValue> read_plan_params(const YamlNode& node, const RuleBase& base,
                                         PlanReader& reader) {
  std::vector<ParamValue> settings;
  if (!expect_map(node, "'params'", reader.findings)) return settings;
  QuantityReader quantities(&base, reader.findings);
  for (const YamlEntry& entry : node.entries) {
    const Param* param = find_plan_param(entry.key, base, reader);
    const auto value =
        param == nullptr ? std::nullopt : quantities.value(entry.value, param->dimension);
    if (!value) continue;
    expect_in_range(*param, *value, entry.value.span, reader.findings);
    settings.push_back({param->name, *value});
  }
  return settings;
}

void read_plan_rules(const YamlNode& node, PlanReader& reader) {
  RulesPlan& rules = reader.plan.rules;
  rules.spot = reader.spot(node.span);
  if (node.kind == YamlNode::Kind::scalar) {
    rules.pack = node.text;
    rules.base = read_plan_pack(node, reader);
    return;
  }
  YamlSection section(node, "'rules'", plan_grammar().keys("rules"), reader.findings);
  const YamlNode* pack = section.is_map() ? section.require("pack") : nullptr;
  if (pack == nullptr) return;
  rules.pack = pack->text;
  rules.base = read_plan_pack(*pack, reader);
  const YamlNode* params = section.find("params");
  if (params != nullptr && rules.base)
    rules.params = read_plan_params(*params, *rules.base, reader);
}

std::optional<int> read_count(const YamlNode& node, const std::string& what, int least,
                              Findings& findings) {
  const auto count = read_integer(node, what, findings);
  if (!count || *count >= least) return count;
  findings.error(Code::R212, node.span, fmt::format("{} is at least {}", what, least));
  return std::nullopt;
}

std::optional<std::string> read_word(const YamlNode& node, const std::string& what,
                                     const std::vector<std::string>& words, Findings& findings) {
  auto text = read_text(node, what, findings);
  if (!text || contains(words, *text)) return text;
  findings.error(Code::R212, node.span,
                 fmt::format("{} is {}{}, not '{}'{}", what, words.size() > 1 ? "one of " : "",
                             join(words), *text, did_you_mean(*text, words)));
  return std::nullopt;
}

std::vector<const YamlNode*> texts_of(const YamlNode& node, const std::string& what,
                                      Findings& findings) {
  std::vector<const YamlNode*> texts;
  if (node.kind == YamlNode::Kind::sequence)
    for (const YamlNode& item : node.items) texts.push_back(&item);
  else
    texts.push_back(&node);
  std::erase_if(texts, [&](const YamlNode* text) { return !read_text(*text, what, findings); });
  if (texts.empty() && node.kind == YamlNode::Kind::sequence)
    findings.error(Code::R211, node.span, what + " names nothing");
  return texts;
}

}  // namespace oriel::rules
