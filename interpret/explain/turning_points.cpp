#include "interpret/explain/turning_points.h"

#include "interpret/evaluate/evaluator.h"
#include "interpret/params/depends_on.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

namespace oriel::rules {

namespace {

/// Below this share of the values at its ends a difference is a straight line of the param.
constexpr double kStraight = 1e-9;
/// So often a range is halved until its ends are neighbours.
constexpr int kHalvings = 60;

/// Goes through all that the rules ask and keeps what depends on the param.
class TurnFinder {
 public:
  TurnFinder(Pack& pack, std::size_t param) : pack_(pack), param_(param) {}

  std::vector<Turn> run() {
    for (const Rule& rule : pack_.rules) {
      for (const ExprId id : rule.require) visit(id);
      for (const ExprId id : rule.unless) visit(id);
      for (const ScoreTerm& term : rule.score) visit(term);
    }
    for (const RelationDefinition& relation : pack_.relations) {
      relations_[0] = root_of(relation.within);
      visit(relation.where);
    }
    for (const ExprId id : {pack_.decide.min_score, pack_.decide.evidence.most})
      is_gradual_ = is_gradual_ || depends_on(pack_, id, param_, true);
    return std::move(turns_);
  }

  [[nodiscard]] bool is_gradual() const { return is_gradual_; }

 private:
  [[nodiscard]] Expr at(ExprId id) const { return pack_.code[static_cast<std::size_t>(id)]; }

  /// The built-in relation that it narrows in the end: which pairs it leaves may change.
  [[nodiscard]] int root_of(int relation) const {
    const auto built_in = static_cast<int>(relation_schema().size());
    while (relation >= built_in)
      relation = pack_.relations[static_cast<std::size_t>(relation - built_in)].within;
    return relation;
  }

  void add(ExprId left, ExprId right) {
    if (depends_on(pack_, left, param_, false) || depends_on(pack_, right, param_, false))
      turns_.push_back({left, right, relations_});
  }

  ExprId make(Op op, std::vector<ExprId> args) {
    Expr expr{.op = op, .args = std::move(args)};
    for (const ExprId arg : expr.args) expr.levels |= at(arg).levels;
    pack_.code.push_back(std::move(expr));
    return static_cast<ExprId>(pack_.code.size()) - 1;
  }

  void visit(const ScoreTerm& term) {
    visit(term.value);
    const bool is_number = at(term.value).type == Type::number;
    is_gradual_ = is_gradual_ || (is_number && depends_on(pack_, term.value, param_, true));
    for (const auto& ramp : {term.rise, term.fall}) {
      if (!ramp) continue;
      for (const ExprId end : {ramp->from, ramp->to}) {
        is_gradual_ = is_gradual_ || depends_on(pack_, end, param_, true);
        add(term.value, end);
      }
    }
  }

  void visit(ExprId id) {
    if (id == kNoExpr || !(depends_on(pack_, id, param_, true) || is_facet(id))) return;
    const Expr expr = at(id);
    switch (expr.op) {
      case Op::less:
      case Op::less_equal:
      case Op::greater:
      case Op::greater_equal:
      case Op::equal:
      case Op::not_equal:
      case Op::in_range:
      case Op::in_list:
        for (std::size_t i = 1; i < expr.args.size(); ++i) add(expr.args[0], expr.args[i]);
        break;
      case Op::similar:
        visit_similarity(expr);
        break;
      case Op::facet_is:
        visit_facet(expr);
        break;
      default:
        break;
    }
    for (const ExprId arg : expr.args) visit(arg);
    if (is_quantifier(expr.op))
      relations_[static_cast<std::size_t>(expr.level)] = root_of(expr.index);
    for (const ExprId part : {expr.filter, expr.join, expr.value}) visit(part);
  }

  /// Whether tests of facets stand in it; what they ask for is not among its expressions.
  [[nodiscard]] bool is_facet(ExprId id) const {
    if (id == kNoExpr) return false;
    const Expr& expr = pack_.code[static_cast<std::size_t>(id)];
    if (expr.op == Op::facet_is) return true;
    const auto is = [&](ExprId part) { return is_facet(part); };
    return std::ranges::any_of(expr.args, is) || is(expr.filter) || is(expr.join) || is(expr.value);
  }

  /// |x - y| = t max(|x|, |y|).
  void visit_similarity(const Expr& expr) {
    const auto [x, y, t] = std::tuple(expr.args[0], expr.args[1], expr.args[2]);
    const ExprId larger = make(Op::maximum, {make(Op::absolute, {x}), make(Op::absolute, {y})});
    add(make(Op::absolute, {make(Op::subtract, {x, y})}), make(Op::multiply, {t, larger}));
  }

  /// The inclination of the host's facet and the ends of walls, roofs and grounds: walls go first.
  void visit_facet(const Expr& expr) {
    Expr inclination{.op = Op::attribute,
                     .index = static_cast<int>(column_of(Attribute::host_inclination)),
                     .level = expr.level,
                     .levels = expr.levels};
    pack_.code.push_back(inclination);
    const auto id = static_cast<ExprId>(pack_.code.size()) - 1;
    for (const HostRange& range : {pack_.hosts.wall, pack_.hosts.roof, pack_.hosts.ground})
      for (const ExprId end : {range.low, range.high})
        if (end != kNoExpr) add(id, end);
  }

  Pack& pack_;
  std::size_t param_;
  std::vector<Turn> turns_;
  std::array<int, kMostLevels> relations_{};
  bool is_gradual_ = false;
};

/// Features that a turn is asked of, one for each level that it speaks of.
struct AskedFeatures {
  FeatureRows rows;
  bool is_own = false;
};

std::vector<AskedFeatures> features_of(const Pack& pack, const Turn& turn,
                                       const EvaluationContext& context, int row) {
  const unsigned levels = pack.code[static_cast<std::size_t>(turn.left)].levels |
                          pack.code[static_cast<std::size_t>(turn.right)].levels;
  if (levels == 0) return {{rows_of(-1), true}};
  const int level = std::countr_zero(levels);
  const Links& links =
      context.relations[static_cast<std::size_t>(turn.relations[oriel::at(level)])];
  std::vector<AskedFeatures> asked;
  for (const int self : context.row_numbers) {
    AskedFeatures features{rows_of(self, level), level == 0 && self == row};
    if (std::has_single_bit(levels)) {
      asked.push_back(features);
      continue;
    }
    for (const int other : links.others_of(self)) {
      features.rows[oriel::at(level + 1)] = other;
      asked.push_back(features);
    }
  }
  return asked;
}

/// How far the sides of one turn are apart at values of the param.
class Differences {
 public:
  Differences(const Pack& pack, EvaluationContext& context, std::size_t param)
      : pack_(pack),
        value_(context.values.params[param]),
        param_(param),
        evaluator_(pack_, context) {}

  void add_to(TurningPoints& points, const Turn& turn, std::span<const AskedFeatures> asked) {
    const auto [low, high] = *pack_.params[param_].range;
    const double said = value_;
    const auto at_low = differences(turn, asked, low);
    const auto at_high = differences(turn, asked, high);
    const auto at_said = differences(turn, asked, said);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      auto& values = asked[i].is_own ? points.own : points.others;
      const auto root = [&](const Bracket& bracket) {
        if (const auto value = root_of(turn, asked[i].rows, bracket)) values.push_back(*value);
      };
      root({low, at_low[i], said, at_said[i]});
      root({said, at_said[i], high, at_high[i]});
    }
    set(said);
  }

 private:
  struct Bracket {
    double x, dx, y, dy;
  };

  void set(double value) {
    value_ = value;
    evaluator_.forget();
  }

  double difference(const Turn& turn, const FeatureRows& rows) {
    return evaluator_.number(turn.left, rows) - evaluator_.number(turn.right, rows);
  }

  double difference(const Turn& turn, const FeatureRows& rows, double value) {
    set(value);
    return difference(turn, rows);
  }

  std::vector<double> differences(const Turn& turn, std::span<const AskedFeatures> asked,
                                  double value) {
    set(value);
    std::vector<double> all;
    for (const AskedFeatures& features : asked) all.push_back(difference(turn, features.rows));
    return all;
  }

  /// Where the difference is 0 between the ends of the bracket: exactly where a side is the param
  /// itself, else as a straight line goes, else by halving.
  std::optional<double> root_of(const Turn& turn, const FeatureRows& rows, Bracket s) {
    if (s.x == s.y || std::isnan(s.dx) || std::isnan(s.dy) || s.dx == s.dy) return std::nullopt;
    if ((s.dx < 0) == (s.dy < 0) && s.dx != 0 && s.dy != 0) return std::nullopt;
    const Expr& left = pack_.code[static_cast<std::size_t>(turn.left)];
    const Expr& right = pack_.code[static_cast<std::size_t>(turn.right)];
    if (right.op == Op::parameter || left.op == Op::parameter) {
      const bool is_left = left.op == Op::parameter;
      if (!depends_on(pack_, is_left ? turn.right : turn.left, param_, true))
        return evaluator_.number(is_left ? turn.right : turn.left, rows);
    }
    const double line = s.x + (s.y - s.x) * (s.dx / (s.dx - s.dy));
    const double off = difference(turn, rows, line);
    if (std::abs(off) <= kStraight * std::max(std::abs(s.dx), std::abs(s.dy))) return line;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (s.x + s.y) / 2;
      const bool is_like_first = (difference(turn, rows, middle) < 0) == (s.dx < 0);
      (is_like_first ? s.x : s.y) = middle;
    }
    return s.y;
  }

  const Pack& pack_;
  /// That of the param.
  double& value_;
  std::size_t param_;
  Evaluator evaluator_;
};

void tidy(std::vector<double>& values, std::pair<double, double> range) {
  std::erase_if(values, [&](double v) { return !(v >= range.first && v <= range.second); });
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

ParamTurns find_turns(Pack& pack, std::size_t param) {
  TurnFinder finder(pack, param);
  ParamTurns found;
  found.turns = finder.run();
  found.is_gradual = finder.is_gradual();
  return found;
}

TurningPoints turning_points(const Pack& pack, EvaluationContext& context, std::size_t param,
                             const ParamTurns& turns, int row) {
  TurningPoints points;
  Differences differences(pack, context, param);
  for (const Turn& turn : turns.turns)
    differences.add_to(points, turn, features_of(pack, turn, context, row));
  tidy(points.own, *pack.params[param].range);
  tidy(points.others, *pack.params[param].range);
  return points;
}

}  // namespace oriel::rules
