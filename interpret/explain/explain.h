#pragma once

#include "interpret/explain/feature_relations.h"
#include "interpret/pack/rule_base.h"
#include "kernel/base/parallel.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

enum class Outcome { fails, unknown, holds };

/// One condition of a rule, judged for one feature.
struct ConditionReport {
  /// As it stands in the pack, and where.
  std::string text;
  Place place;
  Outcome outcome = Outcome::unknown;
  /// What was found, what was asked for and by how much it is missed: "base_height is 0.61 m",
  /// "must be at most 0.60 m", "misses by 0.01 m"; empty where that makes no sense.
  std::string value;
  std::string bound;
  std::string miss;
  /// Attributes of the feature that have no value.
  std::vector<std::string> missing;
  /// What `and`, `or` and `not` are made of.
  std::vector<ConditionReport> parts;
  /// Of exists, all and counts that are too low, if it was asked for: the other feature that misses
  /// least, as a share of the numbers compared, and what it does not fulfil: of the relation and
  /// of what stands after `where`. Bare names in them speak of that feature.
  std::string nearest;
  std::vector<ConditionReport> nearest_misses;
};

/// One term of a score.
struct TermReport {
  std::string text;
  Place place;
  /// 0…1; missing where the term is unknown and drops out with its weight.
  std::optional<double> judged;
  double weight = 1;
  std::string value;
  /// "rises 1.60 m .. 2.00 m, falls 2.60 m .. 3.20 m".
  std::string bound;
  std::vector<std::string> missing;
  /// As of a condition.
  std::string nearest;
  std::vector<ConditionReport> nearest_misses;
};

/// How many others are of a class, and how many are typical.
struct CountReport {
  std::string label;
  /// "storey", "facade" or "building".
  std::string per;
  int others = 0;
  int low = 0;
  /// Nothing: no most.
  std::optional<int> high;
  /// What it adds to the score or takes from it, before both are bounded.
  double shift = 0;
  Place place;
};

/// What the others of a feature say of a rule's label: `decide: evidence`.
struct EvidenceReport {
  /// What they add to the score or take from it.
  double shift = 0;
  /// The relations that are company, how many others they lead to, and the ids of those that hold
  /// the label, sorted.
  std::vector<std::string> relations;
  std::size_t company = 0;
  std::vector<std::string> holders;
  double company_shift = 0;
  std::vector<CountReport> counts;
  /// Of `evidence` in the pack.
  Place place;
};

struct RuleReport {
  std::string id;
  std::string label;
  int priority = 0;
  /// True if the label is abstract: the rule does not compete.
  bool is_predicate = false;
  Place place;
  Outcome outcome = Outcome::unknown;
  /// Where the rule holds; without evidence.
  double score = 0;
  /// Where the decision is close, of the rules between which it is.
  std::optional<EvidenceReport> evidence;
  std::vector<ConditionReport> require;
  std::vector<ConditionReport> unless;
  std::vector<TermReport> terms;

  [[nodiscard]] double total() const { return score + (evidence ? evidence->shift : 0); }
};

/// What one round of a pack with `iterate:` said of the feature, or the rules without evidence.
struct RoundReport {
  /// Empty: unknown.
  std::string label;
  double score = 0;
  double margin = 0;
  std::string rule;
};

/// The smallest change of one param, as a share of its range, that gives the feature another label.
struct Flip {
  std::string param;
  /// Of the param.
  Place place;
  /// In metres, degrees or as a share, and as text: "0.60 m", "0.61 m".
  double from = 0;
  double to = 0;
  std::string from_text;
  std::string to_text;
  /// What the feature becomes with that value, empty: unknown; with which score, by which rule.
  std::string label;
  double score = 0;
  std::string rule;
};

struct FlipSearch {
  std::optional<Flip> nearest;
  /// Params that have a range, in which they were moved, and those that have none and were not.
  std::size_t params = 0;
  std::vector<std::string> without_range;
  /// How often the building was labelled with another value.
  std::size_t tried = 0;
  /// The share of each range up to which all was tried; 1: all of it.
  double reach = 1;
  /// Somebody gave it up: nothing of it is an answer.
  bool is_given_up = false;
};

/// What keeps a rule from holding.
struct MissReport {
  /// Where the rule asks for a class that the feature is not: the rule of that class that misses
  /// least, which this condition is of; else empty.
  std::string rule;
  /// It is of `unless` and holds, or may hold.
  bool is_veto = false;
  ConditionReport condition;
};

/// The rule that comes nearest to holding, for another label of which no rule holds.
struct NearestMiss {
  /// An index into Explanation::rules.
  std::size_t rule = 0;
  /// The sum of its misses, each as a share of the numbers compared; what cannot be measured is 1.
  double gap = 0;
  std::vector<MissReport> misses;
};

/// What somebody says that a feature is, against the rules (docs/formats.md, corrections.jsonl).
struct CorrectedLabel {
  /// "unknown" for none.
  std::string label;
  /// May be empty.
  std::string by, why;
  /// File and line.
  Place place;
};

/// Why a feature has its label, or none: the whole proof, in the order of the pack.
struct Explanation {
  std::string building;
  std::string feature;
  /// For people (feature_names()); empty if it is not known, as it is to an Explainer.
  std::string name;
  Verdict verdict;
  double min_score = 0;
  /// The rule that would be first if `min_score` were 0: an index into `rules`.
  std::optional<std::size_t> best;
  std::vector<RuleReport> rules;
  /// Round by round; empty if the pack has no `iterate:`. `rules` are judged as in the last.
  std::vector<RoundReport> rounds;
  /// What the rules alone say, if evidence made another label of it.
  std::optional<RoundReport> without_evidence;
  /// Only if they were searched for. Of rules with the same gap the first.
  std::optional<NearestMiss> nearest_miss;
  /// That one and the nearest of each other label of which no rule holds: the nearest first, one
  /// for each label.
  std::vector<NearestMiss> near_misses;
  std::optional<FlipSearch> flip;
  /// Of a single feature that is explained with nearest misses; else empty.
  std::vector<RelatedFeatures> relations;
  /// Set by who knows of it: all else is what the rules say without it.
  std::optional<CorrectedLabel> corrected;
};

/// Explains features of one building: runs the pack over it again, once, then judges every
/// condition of every rule for each feature that is asked for. `interpretation` is that of the same
/// pack, table and graph; all four must outlive it.
class Explainer {
 public:
  Explainer(const RuleBase& base, const FeatureTable& table, const FeatureGraph& graph,
            const Interpretation& interpretation);
  ~Explainer();
  Explainer(Explainer&&) noexcept;
  Explainer& operator=(Explainer&&) noexcept;

  /// `feature` must be a row of the table. Without nearest misses and without a flip.
  [[nodiscard]] Explanation explain(FeatureId feature) const;

  /// With nearest misses and relations, without a flip: what takes time is to search for that.
  [[nodiscard]] Explanation explain_without_flip(FeatureId feature) const;

  /// The same with all of them.
  [[nodiscard]] Explanation explain_fully(FeatureId feature,
                                          const IsGivenUp& is_given_up = nullptr) const;

  /// Moves every param that has a range to where something turns that a rule or a relation asks
  /// of the feature, and to where something turns for others; labels the building with that value,
  /// nearest first, and takes the first that gives the feature another label. What is asked of the
  /// feature itself is tried in any case; of the others as much as comes to four million features
  /// labelled anew. Among scores that change gradually a flip is found if there is one at a quarter
  /// between two turning points. The value is rounded away from the pack's one to as few decimals
  /// as give the same label, and was labelled with. Ends at once when it is given up
  /// (FlipSearch::is_given_up).
  [[nodiscard]] FlipSearch find_flip(FeatureId feature,
                                     const IsGivenUp& is_given_up = nullptr) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same for one feature, fully.
Explanation explain(const RuleBase& base, const FeatureTable& table, const FeatureGraph& graph,
                    const Interpretation& interpretation, FeatureId feature);

/// The rules that somebody means by `name`, as indices into Explanation::rules: the one with that
/// id, else those for the class of that name, in the order of the pack.
std::vector<std::size_t> find_rules(const RuleBase& base, std::string_view name);

/// The id or the label that `name` was probably meant to be, "; did you mean 'door'?", or nothing.
std::string similar_rule(const RuleBase& base, std::string_view name);

/// One line of the proof: mark ("holds", of a rule its id), what was found, what was asked for and
/// by how much it was missed; and where that stands in the pack.
struct ExplanationRow {
  std::size_t indent = 0;
  std::array<std::string, 3> cells;
  Place place;
};

/// "f1 -> window 0.93 by window.in_wall, margin 0.93", "f2 -> unknown   no rule for a label holds".
std::string headline(const Explanation& explanation);

/// A rule: its own row, then its conditions and, if it holds, the terms of its score.
std::vector<ExplanationRow> rows_of(const RuleReport& rule);

/// What a rule misses, as a row.
ExplanationRow row_of(const MissReport& miss);

/// "no veto: lod is 2, must be 3"; of what holds without the mark.
std::string one_line(const ExplanationRow& row);

/// Rows below each other, in columns, with their places; a line end after each.
std::string table_of(const std::vector<ExplanationRow>& rows);

/// "0.29", with as many decimals, up to 6, as show it apart from `other`.
std::string score_text(double score, double other);

/// "nearest flip: sill_max 0.60 m -> 0.61 m: door 1.00 by door.ground", or that there is none.
std::string flip_line(const FlipSearch& search);

/// "file:line:column".
std::string place_text(const Place& place);

/// The reason in one line without the id: of a label its rule with what its conditions and terms
/// found; of a feature without one the best candidate, or that no rule for a label holds. Of a
/// corrected feature first who corrected it and why.
std::string reason(const Explanation& explanation);

/// "window 3 of facade south (f1) is labelled window by window.in_wall with score 0.93; no rule for
/// another label holds.", "f2 has no label: no rule for a label holds; bay.by_shape comes nearest."
std::string sentence(const Explanation& explanation);

/// "corrected to door by ada (corrections.jsonl:3): it has a handle; the rules say:" and a line
/// end; nothing of a feature that nobody corrected. The three texts below begin with it.
std::string correction_line(const Explanation& explanation);

/// For a terminal, in at most kMostSummaryLines lines and that one: the sentence, what the winner
/// found (of a feature without a label its best candidate), the runner-up, the nearest miss with
/// what it misses and the nearest flip, with file:line:column. What is left out is counted.
inline constexpr std::size_t kMostSummaryLines = 20;
std::string summary_text(const Explanation& explanation);

/// The sentence, then the rows of `rules`, which are indices into Explanation::rules.
std::string rules_text(const Explanation& explanation, const std::vector<std::size_t>& rules);

/// For a terminal, all of it: the verdict, then every rule with its conditions and, if it holds,
/// the terms of its score, a line each, with file:line:column.
std::string to_text(const Explanation& explanation);

/// The same as one JSON object on one line (docs/rules.md).
std::string to_json(const Explanation& explanation);

/// Those of the features of a building as one JSON object on one line.
std::string to_json(const std::string& building, const std::vector<Explanation>& features);

}  // namespace oriel
