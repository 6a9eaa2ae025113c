#include "interpret/learn/propose.h"

#include "interpret/language/quantity.h"
#include "interpret/learn/count_variants.h"
#include "interpret/learn/search/param_curve.h"
#include "interpret/learn/search/plateau.h"
#include "interpret/pack/names.h"
#include "interpret/relabelling/relabelling.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::Expr;
using rules::ExprId;
using rules::Op;
using rules::Pack;

/// A condition on one attribute, or on whether there is another by a relation.
struct Stump {
  int rule = -1;
  int column = -1;
  int relation = -1;
  /// greater_equal or less_equal; exists or none.
  Op op = Op::exists;
  double value = 0;
  /// Mistakes that it takes, less what is right and goes with them.
  int gain = 0;
  friend bool operator==(const Stump&, const Stump&) = default;
};

/// A feature that a rule decided.
struct Decided {
  std::size_t sample = 0;
  int row = -1;
  bool is_right = false;
};

/// The fewest mistakes that a rule must have to be looked at, and the stumps kept of it.
constexpr std::size_t kFewestMistakes = 2;
constexpr std::size_t kStumpsOfRule = 2;

std::string text_of_condition(const Pack& pack, ExprId id) {
  return std::string(pack.source.text_of(pack.code[at(id)].span));
}

std::vector<std::string> texts_of(const Pack& pack, const std::vector<ExprId>& ids) {
  std::vector<std::string> texts;
  for (const ExprId id : ids) texts.push_back(text_of_condition(pack, id));
  return texts;
}

std::string text_of(const Stump& stump) {
  if (stump.relation >= 0)
    return fmt::format("{}({})", stump.op == Op::exists ? "exists" : "none",
                       relation_schema()[at(stump.relation)].name);
  const AttributeInfo& attribute = feature_schema()[at(stump.column)];
  const std::string unit = rules::unit_of(rules::dimension_of(attribute.unit));
  return fmt::format("{} {} {}{}{}", attribute.name,
                     stump.op == Op::less_equal ? "<=" : ">=", stump.value, unit.empty() ? "" : " ",
                     unit);
}

/// The pack with the condition besides.
RuleBase with_condition(const RuleBase& base, const Stump& stump) {
  auto pack = std::make_shared<Pack>(base.pack());
  const auto add = [&](Expr expr) {
    pack->code.push_back(std::move(expr));
    return static_cast<ExprId>(pack->code.size()) - 1;
  };
  ExprId condition = rules::kNoExpr;
  if (stump.relation >= 0) {
    condition =
        add({.op = stump.op, .type = rules::Type::yes_no, .index = stump.relation, .levels = 1});
    pack->reads.relations[at(stump.relation)] = true;
  } else {
    const ExprId left = add({.op = Op::attribute, .index = stump.column, .levels = 1});
    const ExprId right = add({.op = Op::constant, .number = stump.value});
    condition =
        add({.op = stump.op, .type = rules::Type::yes_no, .args = {left, right}, .levels = 1});
    auto& numbers = pack->reads.numbers;
    if (std::ranges::find(numbers, at(stump.column)) == numbers.end())
      numbers.push_back(at(stump.column));
  }
  pack->rules[at(stump.rule)].require.push_back(condition);
  return {std::move(pack), base.values(), base.sha256()};
}

/// Searches the stumps of one rule.
class StumpFinder {
 public:
  StumpFinder(std::span<const Sample> samples, std::span<const Decided> decided, int rule)
      : samples_(samples), decided_(decided), rule_(rule) {}

  std::vector<Stump> run() {
    for (const Attribute attribute : kAttributes) {
      const Unit unit = info_of(attribute).unit;
      if (unit != Unit::text && unit != Unit::yes_no) search(attribute);
    }
    for (std::size_t r = 0; r < relation_schema().size(); ++r) search(static_cast<int>(r));
    std::erase_if(found_, [](const Stump& s) { return s.gain <= 0; });
    std::ranges::stable_sort(found_, {}, [](const Stump& s) { return -s.gain; });
    found_.resize(std::min(found_.size(), kStumpsOfRule));
    return std::move(found_);
  }

 private:
  /// What goes if those below, or above, a value go: right ones cost, mistakes gain.
  void search(Attribute attribute) {
    std::vector<std::pair<double, int>> values;
    for (const Decided& one : decided_) {
      const double value = samples_[one.sample].features.table.numbers(attribute)[at(one.row)];
      if (std::isnan(value)) return;  // what is not known of all is no ground to decide
      values.emplace_back(value, one.is_right ? -1 : 1);
    }
    std::ranges::sort(values);
    int below = 0;
    const int all = std::accumulate(values.begin(), values.end(), 0,
                                    [](int sum, const auto& v) { return sum + v.second; });
    Stump best{rule_, static_cast<int>(column_of(attribute)), -1, Op::greater_equal, 0, 0};
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      below += values[i].second;
      if (values[i].first == values[i + 1].first) continue;
      const double value = value_within({values[i].first, values[i + 1].first, 0}, std::nan(""));
      if (below > best.gain) {
        best.gain = below;
        best.op = Op::greater_equal;
        best.value = value;
      }
      if (all - below > best.gain) {
        best.gain = all - below;
        best.op = Op::less_equal;
        best.value = value;
      }
    }
    found_.push_back(best);
  }

  void search(int relation) {
    int with = 0, without = 0;
    const std::string& name = relation_schema()[at(relation)].name;
    for (const Decided& one : decided_) {
      const bool has_other =
          !samples_[one.sample].features.graph.others(name, FeatureId{one.row}).empty();
      (has_other ? with : without) += one.is_right ? -1 : 1;
    }
    const bool goes_with = with > without;
    found_.push_back(
        {rule_, -1, relation, goes_with ? Op::none : Op::exists, 0, goes_with ? with : without});
  }

  std::span<const Sample> samples_;
  std::span<const Decided> decided_;
  int rule_;
  std::vector<Stump> found_;
};

/// Measures changes and keeps those that pay.
class Proposer {
 public:
  Proposer(const RuleBase& rules, std::span<const Sample> samples,
           std::span<const SamplePart> parts, const ProposeOptions& options,
           const ForEachShare& for_each, const IsGivenUp& is_given_up)
      : rules_(rules),
        pack_(rules.pack()),
        samples_(samples),
        parts_(parts),
        options_(options),
        is_given_up_(for_good(is_given_up)),
        for_each_([this, &for_each](std::size_t count, const auto& work) {
          for_each(count, [&](std::size_t i) {
            if (!is_given_up_()) work(i);
          });
        }) {
    std::vector<std::string> names = rules.labels();
    labels_.add(names);
    for (const Sample& sample : samples) labels_.add(sample.truth);
  }

  std::optional<std::vector<Proposal>> run() {
    const Variant as_it_is{"as it is", {}, {}, {}};
    base_ = outcomes_of(rules_, {&as_it_is, 1}).front();
    add_drops();
    add_stumps();
    if (is_given_up_()) return std::nullopt;
    std::ranges::stable_sort(proposals_, {}, [](const Proposal& p) {
      return std::tuple(-p.held_out_gain, std::string_view(p.what));
    });
    proposals_.resize(std::min(proposals_.size(), options_.most));
    return std::move(proposals_);
  }

 private:
  using Outcomes = std::vector<LabelOutcome>;

  /// By variant and sample. Costs are not counted here.
  std::vector<Outcomes> outcomes_of(const RuleBase& rules, std::span<const Variant> variants) {
    const auto counted =
        count_variants(rules, variants, samples_, {}, for_each_, false).value.value();
    std::vector<Outcomes> all(variants.size(), Outcomes(samples_.size()));
    for (std::size_t v = 0; v < variants.size(); ++v)
      for (std::size_t s = 0; s < samples_.size(); ++s) {
        const auto counts = counted.counts(v, s);
        all[v][s].counts.assign(counts.begin(), counts.end());
      }
    return all;
  }

  [[nodiscard]] double value(const Outcomes& outcomes, std::span<const std::size_t> numbers) const {
    LabelOutcome sum;
    sum.counts.resize(labels_.size());
    for (const std::size_t number : numbers) sum.add(outcomes[number]);
    return options_.objective.value(sum.counts, 0, labels_);
  }
  [[nodiscard]] double gain(const Outcomes& outcomes, std::span<const std::size_t> numbers) const {
    return value(outcomes, numbers) - value(base_, numbers);
  }

  /// Proposed if it pays outside of half of the folds, and on these folds.
  void judge(Proposal proposal, const Outcomes& outcomes) {
    const SamplePart all = all_samples(samples_.size());
    SamplePart held;
    for (const SamplePart& part : parts_) {
      if (gain(outcomes, outside(part, all)) <= options_.penalty) continue;
      ++proposal.folds;
      held.insert(held.end(), part.begin(), part.end());
    }
    if (proposal.folds == 0 || 2 * proposal.folds < parts_.size()) return;
    proposal.held_out_gain = gain(outcomes, held);
    proposal.gain = gain(outcomes, all);
    if (proposal.held_out_gain > 0) proposals_.push_back(std::move(proposal));
  }

  void add_drops() {
    std::vector<Variant> variants = ablations(rules_);
    std::erase_if(variants, [](const Variant& variant) {
      using Kind = DroppedPart::Kind;
      const Kind kind = variant.without.front().kind;
      return kind == Kind::evidence || kind == Kind::company || kind == Kind::typical;
    });
    const auto outcomes = outcomes_of(rules_, variants);
    for (std::size_t v = 0; v < variants.size(); ++v) judge(drop_of(variants[v]), outcomes[v]);
  }

  [[nodiscard]] Proposal drop_of(const Variant& variant) const {
    using Kind = DroppedPart::Kind;
    const DroppedPart& part = variant.without.front();
    const rules::Rule& rule = pack_.rules[at(part.owner)];
    Proposal proposal;
    proposal.what = "drop" + variant.name.substr(std::string("without").size());
    proposal.rule = rule.id;
    proposal.drops_rule = part.kind == Kind::rule;
    if (proposal.drops_rule) return proposal;
    proposal.require = texts_of(pack_, rule.require);
    proposal.unless = texts_of(pack_, rule.unless);
    if (part.kind == Kind::veto) proposal.unless.erase(proposal.unless.begin() + part.item);
    if (part.kind == Kind::score_term) proposal.dropped_term = part.item;
    if (part.kind != Kind::condition) return proposal;
    std::string& text = proposal.require[at(part.item)];
    text.clear();
    if (part.part >= 0) {
      const auto& args = pack_.code[at(rule.require[at(part.item)])].args;
      for (int i = 0; i < static_cast<int>(args.size()); ++i)
        if (i != part.part)
          text += fmt::format("{}({})", text.empty() ? "" : " and ",
                              text_of_condition(pack_, args[at(i)]));
    }
    if (text.empty()) proposal.require.erase(proposal.require.begin() + part.item);
    return proposal;
  }

  /// What each rule decided, by rule.
  [[nodiscard]] std::vector<std::vector<Decided>> decided() const {
    std::vector<std::vector<Decided>> by_rule(pack_.rules.size());
    const rules::RuleUses uses(pack_);
    for (std::size_t s = 0; s < samples_.size() && !is_given_up_(); ++s) {
      const DescribedBuilding& building = samples_[s].features;
      const rules::Relabelling labelled(pack_, rules_.values(), uses, building.table,
                                        building.graph);
      std::vector<int> labels;
      for (const rules::Choice& choice : labelled.choices()) {
        const rules::ClassId id = rules::Relabelling::label_of(pack_, choice);
        labels.push_back(id == rules::kNoClass ? LabelSet::kNone
                                               : labels_.find(pack_.classes[at(id)].name));
      }
      LabelCounter counter(samples_[s], labels_, {});
      const MatchedLabels& matched = counter.match(labels);
      for (std::size_t row = 0; row < labels.size(); ++row) {
        using Fate = MatchedLabels::Fate;
        const int rule = labelled.choices()[row].rule;
        if (rule < 0 || matched.rows[row] == Fate::neutral) continue;
        by_rule[at(rule)].push_back({s, static_cast<int>(row), matched.rows[row] == Fate::hit});
      }
    }
    return by_rule;
  }

  void add_stumps() {
    std::vector<Stump> stumps;
    const auto by_rule = decided();
    for (const auto& part : parts_)
      for (std::size_t rule = 0; rule < by_rule.size(); ++rule) {
        std::vector<Decided> own;
        std::ranges::copy_if(by_rule[rule], std::back_inserter(own), [&](const Decided& one) {
          return std::ranges::find(part, one.sample) == part.end();
        });
        const auto mistakes =
            std::ranges::count_if(own, [](const Decided& one) { return !one.is_right; });
        if (static_cast<std::size_t>(mistakes) < kFewestMistakes) continue;
        for (const Stump& stump : StumpFinder(samples_, own, static_cast<int>(rule)).run()) {
          const auto is_same = [&](const Stump& s) {
            return text_of(s) == text_of(stump) && s.rule == stump.rule;
          };
          if (std::ranges::none_of(stumps, is_same)) stumps.push_back(stump);
        }
      }
    const Variant as_it_is{"as it is", {}, {}, {}};
    for (const Stump& stump : stumps) {
      if (is_given_up_()) return;
      const rules::Rule& rule = pack_.rules[at(stump.rule)];
      Proposal proposal;
      proposal.rule = rule.id;
      proposal.what = fmt::format("add '{}' to {}", text_of(stump), rule.id);
      proposal.require = texts_of(pack_, rule.require);
      proposal.require.push_back(text_of(stump));
      proposal.unless = texts_of(pack_, rule.unless);
      judge(std::move(proposal),
            outcomes_of(with_condition(rules_, stump), {&as_it_is, 1}).front());
    }
  }

  const RuleBase& rules_;
  const Pack& pack_;
  std::span<const Sample> samples_;
  std::span<const SamplePart> parts_;
  const ProposeOptions& options_;
  IsGivenUp is_given_up_;
  /// Leaves out shares that have not begun when it is given up.
  ForEachShare for_each_;
  LabelSet labels_;
  Outcomes base_;
  std::vector<Proposal> proposals_;
};

}  // namespace

std::optional<std::vector<Proposal>> propose(const RuleBase& rules, std::span<const Sample> samples,
                                             std::span<const SamplePart> parts,
                                             const ProposeOptions& options,
                                             const ForEachShare& for_each,
                                             const IsGivenUp& is_given_up) {
  return Proposer(rules, samples, parts, options, for_each, is_given_up).run();
}

}  // namespace oriel
