#include "interpret/params/find_fault.h"

#include "interpret/compile/counts.h"
#include "interpret/evaluate/arithmetic.h"
#include "interpret/language/findings.h"
#include "interpret/params/depends_on.h"
#include "interpret/surfaces/surface_rules.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Looks for what the loader refuses, in the loader's words.
class FaultFinder {
 public:
  FaultFinder(const Pack& pack, const PackValues& values) : pack_(pack), values_(values) {}

  /// Of conditions alone.
  std::optional<RefusedValue> run_conditions() {
    for (const Expr& expr : pack_.code)
      if (expr.op == Op::in_range) check_order(expr.args[1], expr.args[2]);
    return std::move(found_);
  }

  std::optional<RefusedValue> run() {
    check_hosts();
    check_decide();
    check_typical();
    if (!found_) found_ = run_conditions();
    for (const Rule& rule : pack_.rules)
      for (const ScoreTerm& term : rule.score) check(term);
    return std::move(found_);
  }

 private:
  [[nodiscard]] SourceSpan span_of(ExprId id) const { return pack_.code[at(id)].span; }
  [[nodiscard]] std::string_view text_of(ExprId id) const {
    return pack_.source.text_of(span_of(id));
  }

  [[nodiscard]] std::optional<double> value_of(ExprId id) const {
    return fold(pack_, id, values_.params);
  }

  /// What is found first stays. It depends on `ids`, and stands where the first of them is.
  void report(std::span<const ExprId> ids, std::string sentence) {
    if (found_ || ids.empty()) return;
    RefusedValue& found = found_.emplace();
    found.span = span_of(ids.front());
    found.sentence = std::move(sentence);
    for (std::size_t param = 0; param < pack_.params.size(); ++param)
      if (std::ranges::any_of(ids, [&](ExprId id) { return depends_on(pack_, id, param, true); }))
        found.params.push_back(param);
  }

  /// False, and reported, if it has no value.
  bool has_value(ExprId id) {
    if (id == kNoExpr) return true;
    const auto value = value_of(id);
    if (!value || std::isfinite(*value)) return true;
    report(std::vector{id}, fmt::format("'{}' has no value", text_of(id)));
    return false;
  }

  void check_order(ExprId low, ExprId high) {
    const auto from = value_of(low), to = value_of(high);
    if (from && to && *from > *to)
      report(std::vector{low, high},
             fmt::format("'{} .. {}' is an empty range: its low end is above its high end",
                         text_of(low), text_of(high)));
  }

  void check(const Ramp& ramp) {
    if (has_value(ramp.from) && has_value(ramp.to)) check_order(ramp.from, ramp.to);
  }

  void check(const ScoreTerm& term) {
    if (term.rise) check(*term.rise);
    if (term.fall) check(*term.fall);
    if (!term.rise || !term.fall) return;
    const auto top = value_of(term.rise->to), drop = value_of(term.fall->from);
    if (top && drop && *top > *drop)
      report(std::vector{term.rise->to, term.fall->from},
             fmt::format("the fall from '{}' begins before the rise to '{}' has ended",
                         text_of(term.fall->from), text_of(term.rise->to)));
  }

  void check_hosts() {
    const Hosts& hosts = pack_.hosts;
    std::vector<ExprId> all;
    for (const HostRange& range : {hosts.wall, hosts.roof, hosts.ground}) {
      if (range.low == kNoExpr) continue;
      all.push_back(range.low);
      all.push_back(range.high);
      check({range.low, range.high});
      if (value_of(range.low) < 0 || value_of(range.high) > 180)
        report(std::vector{range.low, range.high}, "an inclination lies in 0 deg .. 180 deg");
    }
    if (values_.has_overlapping_hosts()) report(all, "wall, roof and ground overlap");
    has_value(hosts.ground_reach);
  }

  void check_share(ExprId id) {
    if (id != kNoExpr && has_value(id) && !(value_of(id) >= 0 && value_of(id) <= 1))
      report(std::vector{id}, fmt::format("'{}' lies in 0 .. 1", text_of(id)));
  }

  void check_decide() {
    const Decide& decide = pack_.decide;
    for (const ExprId id : {decide.min_score, decide.ambiguous_below, decide.evidence.most})
      check_share(id);
    if (!decide.evidence.is_written() || 2 * values_.evidence <= values_.ambiguous_below) return;
    std::vector<ExprId> ids{decide.evidence.most};
    if (decide.ambiguous_below != kNoExpr) ids.push_back(decide.ambiguous_below);
    report(ids, "'evidence' is at most half of 'ambiguous_below': it decides what is close only");
  }

  void check_typical() {
    std::vector<ExprId> all;
    for (const Class& c : pack_.classes)
      for (const Typical& typical : c.typical)
        for (const ExprId id : {typical.low, typical.high}) {
          if (id == kNoExpr) continue;
          all.push_back(id);
          if (!is_count(value_of(id).value_or(0)))
            report(std::vector{id},
                   fmt::format("'{}' is a count: a whole number, 0 or more, at most 1000000",
                               text_of(id)));
          else if (id == typical.high)
            check_order(typical.low, typical.high);
        }
    if (found_ || all.empty()) return;
    Findings findings(pack_.source);
    check_counts(pack_, values_, findings);
    if (!findings.has_errors()) return;
    const auto issues = findings.issues();
    report(all, std::ranges::find(issues, Severity::error, &Issue::severity)->sentence);
  }

  const Pack& pack_;
  const PackValues& values_;
  std::optional<RefusedValue> found_;
};

}  // namespace

std::optional<RefusedValue> find_fault(const Pack& pack, const PackValues& values) {
  if (auto fault = FaultFinder(pack, values).run()) return fault;
  if (!pack.surfaces) return std::nullopt;
  return FaultFinder(pack.surfaces->pack, values).run_conditions();
}

}  // namespace oriel::rules
