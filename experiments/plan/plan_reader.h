#pragma once

#include "experiments/plan/experiment_plan.h"
#include "interpret/language/findings.h"
#include "interpret/language/source.h"
#include "interpret/pack/loader.h"
#include "interpret/yaml/yaml_tree.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel::rules {

/// What the readers of an experiment's sections share. As with packs (interpret/pack/loader.h)
/// every reader adds what its section says to `plan` and what is wrong with it to `findings`, and
/// goes on after an error.
struct PlanReader {
  PlanReader(ExperimentPlan& p, Findings& f) : plan(p), findings(f) {}

  ExperimentPlan& plan;
  Findings& findings;

  [[nodiscard]] PlanSpot spot(SourceSpan where) const {
    return {findings.source().place(where.begin), findings.source().excerpt(where)};
  }
};

/// Reads quantities with units whose expressions may name the params of a pack, as in packs.
class QuantityReader {
 public:
  /// Without params if `base` is null.
  QuantityReader(const RuleBase* base, Findings& findings);

  /// Of the given dimension; or nothing and an error, as of read_quantity and read_range.
  std::optional<double> value(const YamlNode& node, Dimension dimension);
  std::optional<std::pair<double, double>> range(const YamlNode& node, Dimension dimension);

 private:
  Pack scratch_;
  Loader loader_;
};

void read_plan_sets(const YamlNode& node, PlanReader& reader);
/// A pattern of files, or a list of them; none if `node` is null.
std::vector<FilePattern> read_plan_patterns(const YamlNode* node, const std::string& what,
                                            PlanReader& reader);
void read_plan_rules(const YamlNode& node, PlanReader& reader);
void read_plan_options(const YamlNode& node, SegmentationPlan& options, PlanReader& reader);
void read_plan_sweep(const YamlNode& node, PlanReader& reader);
void read_plan_ablate(const YamlNode& node, PlanReader& reader);
void read_plan_compare(const YamlNode& node, PlanReader& reader);
void read_plan_stability(const YamlNode& node, PlanReader& reader);
void read_plan_learning(const YamlNode& node, bool is_curve, PlanReader& reader);

/// What a map with keys of `options:`, and perhaps others, says of segmentation.
void read_segmentation(const YamlNode& map, SegmentationPlan& options, PlanReader& reader);
/// Sets one of them, `key`, from its value; false for another key.
bool read_segmentation_key(const std::string& key, const YamlNode& value, SegmentationPlan& options,
                           PlanReader& reader);

/// `name` of a pack: one that is built in, or a file beside the experiment's. Its findings are
/// reported as one (R200 …) at `node`; null if it cannot be used.
std::optional<RuleBase> read_plan_pack(const YamlNode& node, PlanReader& reader);
/// `params:` of a pack: a map of names and values, which lie in their ranges.
std::vector<ParamValue> read_plan_params(const YamlNode& node, const RuleBase& base,
                                         PlanReader& reader);
/// The param that `name` names; or null and R206.
const Param* find_plan_param(const YamlNode& name, const RuleBase& base, PlanReader& reader);
/// An error R281 if the param has a range and `value` is beyond it.
void expect_in_range(const Param& param, double value, SourceSpan where, Findings& findings);

/// A whole number of at least `least`; or nothing and an error.
std::optional<int> read_count(const YamlNode& node, const std::string& what, int least,
                              Findings& findings);
/// One of `words`; or nothing and R212.
std::optional<std::string> read_word(const YamlNode& node, const std::string& what,
                                     const std::vector<std::string>& words, Findings& findings);
/// A text, or a list of texts, that are not empty.
std::vector<const YamlNode*> texts_of(const YamlNode& node, const std::string& what,
                                      Findings& findings);

}  // namespace oriel::rules
