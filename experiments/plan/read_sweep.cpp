#include "experiments/plan/plan_grammar.h"
#include "experiments/plan/plan_reader.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr int kUsualValues = 5;

/// With so few digits that it can be read in the name of a run, unless that is beyond its range.
double as_named(double value, double low, double high) {
  const double rounded = rounded_for_name(value);
  return rounded >= low && rounded <= high ? rounded : value;
}

/// `count` values from `low` to `high`, evenly spaced, both among them.
std::vector<double> even_values(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double share = count == 1 ? 0.5 : double(i) / (count - 1);
    values.push_back(as_named(low + (high - low) * share, low, high));
  }
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// Reads what is swept.
class SweepReader {
 public:
  SweepReader(const RuleBase& base, PlanReader& reader)
      : base_(base), reader_(reader), quantities_(&base, reader.findings) {}

  SweepPlan read(const YamlNode& node) {
    sweep_.spot = reader_.spot(node.span);
    YamlSection section(node, "'sweep'", plan_grammar().keys("sweep"), reader_.findings);
    if (!section.is_map()) return sweep_;
    if (const YamlNode* values = section.find("values"))
      values_ = read_count(*values, "'values'", 1, reader_.findings).value_or(kUsualValues);
    read_design(section);
    if (const YamlNode* params = section.require("params")) read_params(*params);
    expect_few(node);
    return sweep_;
  }

 private:
  void read_design(YamlSection& section) {
    const YamlNode* samples = section.find("samples");
    if (const YamlNode* design = section.find("design")) {
      const auto word =
          read_word(*design, "'design'", {"one_at_a_time", "grid", "random"}, reader_.findings);
      if (word == "grid") sweep_.design = SweepPlan::Design::grid;
      if (word == "random") sweep_.design = SweepPlan::Design::random;
    }
    const bool is_random = sweep_.design == SweepPlan::Design::random;
    if (is_random) samples = section.require("samples");
    if (samples == nullptr) return;
    if (!is_random)
      reader_.findings.error(Code::R212, samples->span,
                             "'samples' are drawn at random: they need 'design: random'");
    sweep_.samples = read_count(*samples, "'samples'", 1, reader_.findings).value_or(1);
  }

  /// `all`, a list of names, or a map of names and values.
  void read_params(const YamlNode& node) {
    if (node.kind == YamlNode::Kind::map) {
      for (const YamlEntry& entry : node.entries)
        if (const Param* param = find_plan_param(entry.key, base_, reader_))
          read_values(*param, entry.value);
    } else if (node.kind == YamlNode::Kind::scalar && node.text == "all") {
      for (const Param& param : base_.pack().params)
        if (param.range) add(param, param.range->first, param.range->second, {});
    } else {
      for (const YamlNode* name : texts_of(node, "'params'", reader_.findings))
        if (const Param* param = find_plan_param(*name, base_, reader_)) add_once(*param, *name);
    }
    if (sweep_.params.empty() && !reader_.findings.has_errors())
      reader_.findings.error(Code::R287, node.span, "no param is swept");
  }

  void add_once(const Param& param, const YamlNode& name) {
    const auto& all = sweep_.params;
    if (std::ranges::find(all, param.name, &SweptParam::name) == all.end())
      return add_whole(param, name);
    reader_.findings.error(Code::R240, name.span, fmt::format("'{}' is swept already", param.name));
  }

  void add_whole(const Param& param, const YamlNode& name) {
    if (param.range) return add(param, param.range->first, param.range->second, {});
    reader_.findings.error(Code::R281, name.span,
                           fmt::format("'{}' has no range in the pack: write '{}: LOW .. HIGH'",
                                       param.name, param.name));
  }

  /// `all` of its range, a range, a value or a list of values.
  void read_values(const Param& param, const YamlNode& node) {
    if (node.kind == YamlNode::Kind::scalar && node.text == "all") return add_whole(param, node);
    if (node.kind == YamlNode::Kind::scalar && node.text.find("..") != std::string::npos) {
      const auto range = quantities_.range(node, param.dimension);
      if (!range) return;
      expect_in_range(param, range->first, node.span, reader_.findings);
      if (!param.range || range->first >= param.range->first)
        expect_in_range(param, range->second, node.span, reader_.findings);
      return add(param, range->first, range->second, {});
    }
    std::vector<double> values;
    for (const YamlNode* text : texts_of(node, "'" + param.name + "'", reader_.findings)) {
      auto value = quantities_.value(*text, param.dimension);
      if (!value) continue;
      expect_in_range(param, *value, text->span, reader_.findings);
      value = param.range ? as_named(*value, param.range->first, param.range->second)
                          : rounded_for_name(*value);
      if (std::ranges::find(values, *value) != values.end())
        reader_.findings.error(Code::R240, text->span,
                               fmt::format("'{}' takes this value already", param.name));
      else
        values.push_back(*value);
    }
    if (values.empty()) return;
    if (sweep_.design == SweepPlan::Design::random)
      reader_.findings.error(Code::R212, node.span,
                             fmt::format("random values are drawn from a range: write '{}: LOW .. "
                                         "HIGH'",
                                         param.name));
    const auto [low, high] = std::ranges::minmax(values);
    add(param, low, high, std::move(values));
  }

  /// Without `values` they are evenly spaced.
  void add(const Param& param, double low, double high, std::vector<double> values) {
    if (values.empty()) values = even_values(low, high, values_);
    sweep_.params.push_back({param.name, std::move(values), low, high, unit_of(param.dimension)});
  }

  void expect_few(const YamlNode& node) {
    double runs = sweep_.design == SweepPlan::Design::grid ? 1 : sweep_.samples;
    for (const SweptParam& param : sweep_.params) {
      const auto values = static_cast<double>(param.values.size());
      if (sweep_.design == SweepPlan::Design::grid) runs *= values;
      if (sweep_.design == SweepPlan::Design::one_at_a_time) runs += values;
    }
    if (runs > double(kMostRuns))
      reader_.findings.error(
          Code::R213, node.span,
          fmt::format("a sweep has no more than {} runs, and this one has {:.6g}: name fewer "
                      "params or values, or draw them with 'design: random'",
                      kMostRuns, runs));
  }

  const RuleBase& base_;
  PlanReader& reader_;
  QuantityReader quantities_;
  SweepPlan sweep_;
  int values_ = kUsualValues;
};

}  // namespace

void read_plan_sweep(const YamlNode& node, PlanReader& reader) {
  // Without the pack its params are not known, which was said.
  if (!reader.plan.rules.base) return;
  reader.plan.sweep = SweepReader(*reader.plan.rules.base, reader).read(node);
}

}  // namespace oriel::rules
