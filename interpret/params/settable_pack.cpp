#include "interpret/params/settable_pack.h"

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

void refold(const Pack& pack, ExprId id, double& value) {
  if (id != kNoExpr) value = fold(pack, id).value_or(value);
}

/// The same of a count; of what is no count it stays, and a fault is found.
void refold(const Pack& pack, ExprId id, int& count) {
  const auto value = id == kNoExpr ? std::nullopt : fold(pack, id);
  if (value && is_count(*value)) count = static_cast<int>(*value);
}

/// Looks for what the loader refuses, in the loader's words.
class FaultFinder {
 public:
  explicit FaultFinder(const Pack& pack) : pack_(pack) {}

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
    const auto value = fold(pack_, id);
    if (!value || std::isfinite(*value)) return true;
    report(std::vector{id}, fmt::format("'{}' has no value", text_of(id)));
    return false;
  }

  void check_order(ExprId low, ExprId high) {
    const auto from = fold(pack_, low), to = fold(pack_, high);
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
    const auto top = fold(pack_, term.rise->to), drop = fold(pack_, term.fall->from);
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
      if (range.low_deg < 0 || range.high_deg > 180)
        report(std::vector{range.low, range.high}, "an inclination lies in 0 deg .. 180 deg");
    }
    if (is_overlapping(hosts.wall, hosts.roof) || is_overlapping(hosts.wall, hosts.ground) ||
        is_overlapping(hosts.roof, hosts.ground))
      report(all, "wall, roof and ground overlap");
    has_value(hosts.ground_reach_of);
  }

  void check_share(ExprId id, double share) {
    if (id != kNoExpr && has_value(id) && !(share >= 0 && share <= 1))
      report(std::vector{id}, fmt::format("'{}' lies in 0 .. 1", text_of(id)));
  }

  void check_decide() {
    const Decide& decide = pack_.decide;
    check_share(decide.min_score_of, decide.min_score);
    check_share(decide.ambiguous_below_of, decide.ambiguous_below);
    check_share(decide.evidence.most_of, decide.evidence.most);
    if (!decide.evidence.is_written() || 2 * decide.evidence.most <= decide.ambiguous_below) return;
    std::vector<ExprId> ids{decide.evidence.most_of};
    if (decide.ambiguous_below_of != kNoExpr) ids.push_back(decide.ambiguous_below_of);
    report(ids, "'evidence' is at most half of 'ambiguous_below': it decides what is close only");
  }

  void check_typical() {
    std::vector<ExprId> all;
    for (const Class& c : pack_.classes)
      for (const Typical& typical : c.typical)
        for (const ExprId id : {typical.low_of, typical.high_of}) {
          if (id == kNoExpr) continue;
          all.push_back(id);
          if (!is_count(fold(pack_, id).value_or(0)))
            report(std::vector{id},
                   fmt::format("'{}' is a count: a whole number, 0 or more, at most 1000000",
                               text_of(id)));
          else if (id == typical.high_of)
            check_order(typical.low_of, typical.high_of);
        }
    if (found_ || all.empty()) return;
    Findings findings(pack_.source);
    check_counts(pack_, findings);
    if (!findings.has_errors()) return;
    const auto issues = findings.issues();
    report(all, std::ranges::find(issues, Severity::error, &Issue::severity)->sentence);
  }

  const Pack& pack_;
  std::optional<RefusedValue> found_;
};

}  // namespace

SettablePack::SettablePack(const Pack& pack) : pack_(pack) {
  if (pack.surfaces == nullptr) return;
  surfaces_ = std::make_shared<SurfaceRules>(*pack.surfaces);
  pack_.surfaces = surfaces_;
}

void SettablePack::set(std::size_t param, double value) {
  pack_.params[param].value = value;
  if (surfaces_) surfaces_->pack.params[param].value = value;
  Hosts& hosts = pack_.hosts;
  for (HostRange* range : {&hosts.wall, &hosts.roof, &hosts.ground}) {
    refold(pack_, range->low, range->low_deg);
    refold(pack_, range->high, range->high_deg);
  }
  refold(pack_, hosts.ground_reach_of, hosts.ground_reach_m);
  Decide& decide = pack_.decide;
  refold(pack_, decide.min_score_of, decide.min_score);
  refold(pack_, decide.ambiguous_below_of, decide.ambiguous_below);
  refold(pack_, decide.evidence.most_of, decide.evidence.most);
  for (Class& c : pack_.classes)
    for (Typical& typical : c.typical) {
      refold(pack_, typical.low_of, typical.low);
      refold(pack_, typical.high_of, typical.high);
    }
}

std::optional<RefusedValue> SettablePack::find_fault() const {
  if (auto fault = FaultFinder(pack_).run()) return fault;
  return surfaces_ ? FaultFinder(surfaces_->pack).run_conditions() : std::nullopt;
}

}  // namespace oriel::rules
