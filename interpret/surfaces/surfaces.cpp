#include "interpret/surfaces/surfaces.h"

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/pack/names.h"
#include "interpret/surfaces/surface_rules.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::ExprId;
using rules::HostKind;
using rules::Pack;
using rules::SurfaceRule;
using rules::SurfaceRules;
using rules::Truth;

/// A part of the condition of a rule: all of them must hold.
struct SurfaceConjunct {
  ExprId id = rules::kNoExpr;
  /// What it reads is all measured.
  bool is_final = true;
};

/// Finds for rows of a table the first rule that holds.
class SurfaceDecider {
 public:
  /// `more`: what is measured later; null: nothing.
  SurfaceDecider(const RuleBase& base, const SurfaceTable& table,
                 const MoreAttributes* more = nullptr);

  /// For each of the rows, in their order, the number of the rule, or -1.
  [[nodiscard]] std::vector<int> decide(std::span<const int> rows);
  /// Those of the rows for which a value that is not measured may matter. The rules before those
  /// that read it do not hold for them and are not asked again.
  [[nodiscard]] const std::vector<int>& undecided() const { return undecided_; }
  /// More is measured than when the rows were decided.
  void look_again();

 private:
  void add_conjuncts(ExprId id, std::vector<SurfaceConjunct>& conjuncts) const;
  [[nodiscard]] bool reads_pending(ExprId id) const;
  [[nodiscard]] int decide(int row);
  [[nodiscard]] Truth all_hold(const std::vector<SurfaceConjunct>& conjuncts, int row);

  const SurfaceRules& surfaces_;
  const MoreAttributes* more_;
  rules::EvaluationContext context_;
  rules::Evaluator evaluator_;
  /// By rule.
  std::vector<std::vector<SurfaceConjunct>> conjuncts_;
  std::size_t first_rule_ = 0, first_doubtful_ = 0;
  std::vector<int> undecided_;
};

SurfaceDecider::SurfaceDecider(const RuleBase& base, const SurfaceTable& table,
                               const MoreAttributes* more)
    : surfaces_(*base.pack().surfaces),
      more_(more),
      context_(surfaces_.pack, base.values(), table),
      evaluator_(surfaces_.pack, context_),
      conjuncts_(surfaces_.rules.size()) {
  for (std::size_t r = 0; r < conjuncts_.size(); ++r)
    for (const ExprId id : surfaces_.rules[r].when) add_conjuncts(id, conjuncts_[r]);
}

void SurfaceDecider::add_conjuncts(ExprId id, std::vector<SurfaceConjunct>& conjuncts) const {
  const rules::Expr& expr = surfaces_.pack.code[static_cast<std::size_t>(id)];
  if (expr.op == rules::Op::all_of)
    for (const ExprId part : expr.args) add_conjuncts(part, conjuncts);
  else
    conjuncts.push_back({id, !reads_pending(id)});
}

bool SurfaceDecider::reads_pending(ExprId id) const {
  if (more_ == nullptr) return false;
  const rules::Expr& expr = surfaces_.pack.code[static_cast<std::size_t>(id)];
  if (expr.op == rules::Op::attribute || expr.op == rules::Op::flag)
    return more_->is_pending(kSurfaceAttributes[static_cast<std::size_t>(expr.index)]);
  return std::ranges::any_of(expr.args, [&](ExprId arg) { return reads_pending(arg); });
}

void SurfaceDecider::look_again() {
  first_rule_ = first_doubtful_;
  for (auto& of_rule : conjuncts_)
    for (SurfaceConjunct& conjunct : of_rule) conjunct.is_final = !reads_pending(conjunct.id);
}

std::vector<int> SurfaceDecider::decide(std::span<const int> rows) {
  undecided_.clear();
  first_doubtful_ = conjuncts_.size();
  std::vector<int> deciding;
  deciding.reserve(rows.size());
  for (const int row : rows) deciding.push_back(decide(row));
  return deciding;
}

int SurfaceDecider::decide(int row) {
  int deciding = -1;
  bool is_doubtful = false;
  for (std::size_t r = first_rule_; r < conjuncts_.size() && deciding < 0; ++r) {
    const Truth holds = all_hold(conjuncts_[r], row);
    if (holds == Truth::yes) deciding = static_cast<int>(r);
    if (holds != Truth::unknown) continue;
    is_doubtful = true;
    first_doubtful_ = std::min(first_doubtful_, r);
  }
  if (is_doubtful) undecided_.push_back(row);
  return deciding;
}

/// What is unknown for good does not hold.
Truth SurfaceDecider::all_hold(const std::vector<SurfaceConjunct>& conjuncts, int row) {
  const rules::FeatureRows rows = rules::rows_of(row);
  Truth least = Truth::yes;
  for (const SurfaceConjunct& conjunct : conjuncts) {
    const Truth answer = evaluator_.truth(conjunct.id, rows);
    if (answer == Truth::no || (conjunct.is_final && answer == Truth::unknown)) return Truth::no;
    least = std::min(least, answer);
  }
  return least;
}

/// What faces that look up are on a part of that label, or null if nothing is said.
const std::string* top_of(const Pack& pack, const std::string& label) {
  for (rules::ClassId id = rules::index_of(pack.classes, label); id != rules::kNoClass;
       id = pack.classes[static_cast<std::size_t>(id)].parent)
    if (const auto& emission = pack.classes[static_cast<std::size_t>(id)].emission)
      return &emission->top;
  return nullptr;
}

std::string top_by_default(const RuleBase& base, const SurfaceTable& table, std::size_t row) {
  if (const std::string* top = top_of(base.pack(), table.text(row, SurfaceAttribute::part)))
    return *top;
  const auto host = table.number(row, SurfaceAttribute::host_inclination);
  const bool is_in_wall = host && base.values().kind_of_facet(*host) == HostKind::wall;
  return is_in_wall && table.text(row, SurfaceAttribute::sense) == "hole" ? "OuterFloorSurface"
                                                                          : "RoofSurface";
}

std::string type_by_default(const RuleBase& base, const SurfaceTable& table, std::size_t row) {
  const auto inclination = table.number(row, SurfaceAttribute::inclination);
  if (!inclination) return "WallSurface";
  switch (base.values().kind_of_facet(*inclination)) {
    case HostKind::roof:
      return top_by_default(base, table, row);
    case HostKind::ground:
      return table.number(row, SurfaceAttribute::base_height).value_or(0) <=
                     base.values().ground_reach_m
                 ? "GroundSurface"
                 : "OuterCeilingSurface";
    default:
      return "WallSurface";
  }
}

std::vector<int> all_rows(const SurfaceTable& table) {
  std::vector<int> rows(table.rows());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// By row; of rows that are not asked for -1. The order of the three-valued logic sees to it that
/// what is decided while values are missing stays so when they are filled in.
std::vector<int> decide_with_more(const RuleBase& base, const SurfaceTable& table,
                                  std::span<const int> rows, MoreAttributes& more) {
  SurfaceDecider decider(base, table, &more);
  std::vector<int> deciding(table.rows(), -1);
  std::vector<int> open(rows.begin(), rows.end());
  for (;;) {
    const auto found = decider.decide(open);
    for (std::size_t i = 0; i < open.size(); ++i)
      deciding[static_cast<std::size_t>(open[i])] = found[i];
    open = decider.undecided();
    if (open.empty()) break;
    more.measure(open);
    decider.look_again();
  }
  return deciding;
}

std::string shown(const AttributeInfo& attribute, double value) {
  if (attribute.unit == Unit::yes_no) return value != 0 ? "yes" : "no";
  const std::string_view suffix = suffix_of(attribute.unit);
  return fmt::format("{:.2f}{}{}", value, suffix.empty() ? "" : " ", suffix);
}

std::string attribute_lines(const SurfaceTable& table, std::size_t row) {
  std::string text;
  for (const SurfaceAttribute attribute : kSurfaceAttributes) {
    const AttributeInfo& info = info_of(attribute);
    std::string value = "?";
    if (info.unit == Unit::text) {
      if (const auto& word = table.text(row, attribute); !word.empty()) value = word;
    } else if (const auto number = table.number(row, attribute)) {
      value = shown(info, *number);
    }
    text += fmt::format("  {:<17} {:>12}   {}\n", info.name, value, info.meaning);
  }
  return text;
}

/// The place of an expression as messages show it.
std::string place_of(const Pack& pack, rules::SourceSpan span) {
  const Place place = pack.source.place(span.begin);
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

std::string rule_lines(const SurfaceRules& surfaces, rules::Evaluator& evaluator, std::size_t row,
                       int last) {
  const rules::FeatureRows rows = rules::rows_of(static_cast<int>(row));
  std::string text;
  for (std::size_t r = 0; r < surfaces.rules.size(); ++r) {
    const SurfaceRule& rule = surfaces.rules[r];
    text += fmt::format("  {} -> {}\n", rule.id, rule.type);
    for (const rules::ExprId id : rule.when) {
      const Truth truth = evaluator.truth(id, rows);
      const char* outcome = truth == Truth::yes  ? "holds"
                            : truth == Truth::no ? "fails"
                                                 : "unknown";
      const rules::SourceSpan span = surfaces.pack.code[static_cast<std::size_t>(id)].span;
      text += fmt::format("    {:<8} {}   {}\n", outcome, surfaces.pack.source.text_of(span),
                          place_of(surfaces.pack, span));
    }
    if (static_cast<int>(r) == last) break;
  }
  return text;
}

/// By `deciding`, the rule that decided.
SurfaceVerdict verdict_of(const RuleBase& base, const SurfaceTable& table, std::size_t row,
                          int deciding) {
  if (deciding < 0) return {type_by_default(base, table, row), ""};
  const SurfaceRule& rule = base.pack().surfaces->rules[static_cast<std::size_t>(deciding)];
  return {rule.type, rule.id};
}

/// The same row by row.
std::vector<SurfaceVerdict> verdicts_of(const RuleBase& base, const SurfaceTable& table,
                                        const std::vector<int>& deciding) {
  std::vector<SurfaceVerdict> verdicts;
  verdicts.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row)
    verdicts.push_back(verdict_of(base, table, row, deciding[row]));
  return verdicts;
}

std::vector<int> decide_all(const RuleBase& base, const SurfaceTable& table) {
  if (base.pack().surfaces) return SurfaceDecider(base, table).decide(all_rows(table));
  return std::vector<int>(table.rows(), -1);
}

std::vector<std::string> explanations_of(const RuleBase& base, const SurfaceTable& table,
                                         std::span<const int> rows) {
  const Pack& pack = base.pack();
  const auto deciding = decide_all(base, table);
  std::optional<rules::EvaluationContext> context;
  std::optional<rules::Evaluator> evaluator;
  if (pack.surfaces)
    evaluator.emplace(pack.surfaces->pack,
                      context.emplace(pack.surfaces->pack, base.values(), table));
  std::vector<std::string> texts;
  texts.reserve(rows.size());
  for (const int r : rows) {
    const auto row = static_cast<std::size_t>(r);
    const SurfaceVerdict verdict = verdict_of(base, table, row, deciding[row]);
    texts.push_back(
        fmt::format("{} by {}\n", verdict.type, verdict.rule.empty() ? "hosts" : verdict.rule) +
        attribute_lines(table, row));
    if (evaluator) texts.back() += rule_lines(*pack.surfaces, *evaluator, row, deciding[row]);
  }
  return texts;
}

std::string reason_of(const Pack& pack, const SurfaceTable& table, std::size_t row,
                      const SurfaceVerdict& verdict, const SurfaceRule* rule) {
  if (rule == nullptr) {
    const auto inclination = table.number(row, SurfaceAttribute::inclination);
    return fmt::format("{} by hosts: inclination = {}", verdict.type,
                       inclination ? fmt::format("{:.2f} deg", *inclination) : "?");
  }
  std::string text = fmt::format("{} by {}", verdict.type, verdict.rule);
  const char* separator = ": ";
  for (const rules::ExprId id : rule->when) {
    const rules::SourceSpan span = pack.surfaces->pack.code[static_cast<std::size_t>(id)].span;
    text += separator;
    text += pack.surfaces->pack.source.text_of(span);
    separator = "; ";
  }
  return text;
}

}  // namespace

SurfaceTable with_parts(SurfaceTable table, const Building& building,
                        const Segmentation& segmentation, const Interpretation& interpretation,
                        const RuleBase& base) {
  const auto rows = all_rows(table);
  return with_parts(std::move(table), building, polygon_owners(segmentation, building),
                    interpretation, base, rows);
}

SurfaceTable with_parts(SurfaceTable table, const Building& building, const PolygonOwners& owners,
                        const Interpretation& interpretation, const RuleBase& base,
                        std::span<const int> rows) {
  if (interpretation.verdicts.empty()) return table;
  std::vector<bool> is_emitted;
  for (const Verdict& verdict : interpretation.verdicts)
    is_emitted.push_back(top_of(base.pack(), verdict.label) != nullptr);
  for (const int r : rows) {
    const auto row = static_cast<std::size_t>(r);
    const std::string* part = nullptr;
    for (const int f : owners[static_cast<std::size_t>(building.polygons[row].source)]) {
      const std::string& label = interpretation.verdicts[static_cast<std::size_t>(f)].label;
      const bool is_written = is_emitted[static_cast<std::size_t>(f)];
      if (!label.empty() && (part == nullptr || is_written)) part = &label;
      if (is_written) break;
    }
    if (part != nullptr) table.set(row, SurfaceAttribute::part, *part);
  }
  return table;
}

std::vector<int> rows_to_name(const Building& building, const PolygonOwners& owners,
                              const Interpretation& interpretation, const RuleBase& base) {
  std::vector<rules::Role> roles;
  for (const Verdict& verdict : interpretation.verdicts)
    roles.push_back(rules::role_of(base.pack(), verdict.label));
  std::vector<int> rows;
  for (std::size_t row = 0; row < building.polygons.size(); ++row) {
    const auto features = owners[static_cast<std::size_t>(building.polygons[row].source)];
    const auto written = std::ranges::find_if(
        features, [&](int f) { return roles[static_cast<std::size_t>(f)].emission != nullptr; });
    if (written == features.end() || !roles[static_cast<std::size_t>(*written)].is_opening())
      rows.push_back(static_cast<int>(row));
  }
  return rows;
}

std::vector<SurfaceVerdict> interpret_surfaces(const RuleBase& base, const SurfaceTable& table,
                                               std::span<const int> rows, MoreAttributes& more) {
  std::vector<int> deciding(table.rows(), -1);
  if (base.pack().surfaces) deciding = decide_with_more(base, table, rows, more);
  std::vector<SurfaceVerdict> verdicts(table.rows());
  for (const int r : rows) {
    const auto row = static_cast<std::size_t>(r);
    verdicts[row] = verdict_of(base, table, row, deciding[row]);
  }
  return verdicts;
}

std::vector<SurfaceVerdict> interpret_surfaces(const RuleBase& base, const SurfaceTable& table) {
  return verdicts_of(base, table, decide_all(base, table));
}

std::vector<std::string> explain_surfaces(const RuleBase& base, const SurfaceTable& table) {
  return explanations_of(base, table, all_rows(table));
}

std::string explain_surface(const RuleBase& base, const SurfaceTable& table, std::size_t row) {
  return explanations_of(base, table, std::array{static_cast<int>(row)}).front();
}

std::vector<std::string> surface_reasons(const RuleBase& base, const SurfaceTable& table,
                                         const std::vector<SurfaceVerdict>& verdicts) {
  const Pack& pack = base.pack();
  std::vector<std::string> reasons;
  reasons.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const SurfaceRule* rule = nullptr;
    if (!verdicts[row].rule.empty())
      rule = &*std::ranges::find(pack.surfaces->rules, verdicts[row].rule, &SurfaceRule::id);
    reasons.push_back(reason_of(pack, table, row, verdicts[row], rule));
  }
  return reasons;
}

}  // namespace oriel
