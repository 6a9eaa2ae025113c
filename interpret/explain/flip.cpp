#include "interpret/explain/flip.h"

#include "interpret/explain/turning_points.h"
#include "interpret/language/quantity.h"
#include "interpret/params/find_fault.h"
#include "interpret/relabelling/relabelling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Features that are labelled anew for turning points of other features.
constexpr std::size_t kMostRelabelled = 4'000'000;
/// Where scores change gradually, the way between two turning points is parted in so many.
constexpr int kPieces = 4;
/// A flip among them is then known to this share of the range.
constexpr double kSharp = 1e-9;
/// Values are stated with so many decimals.
constexpr int kFewestDecimals = 2, kAllDecimals = 6;

/// A piece of a param's range on one side of the pack's value.
struct Piece {
  std::size_t param = 0;
  /// The end that is nearer to the pack's value, and the other one.
  double inner = 0, outer = 0;
  /// What is labelled with: the outer end if it is a turning point, else what lies between.
  double tried = 0;
  /// How far the flip is at least, as a share of the range.
  double share = 0;
  bool is_between = false;
  bool is_gradual = false;
  bool is_own = false;
};

class FlipFinder {
 public:
  FlipFinder(const Pack& pack, const PackValues& values, const FeatureTable& table,
             const FeatureGraph& graph, int row, const IsGivenUp& is_given_up)
      : pack_(pack),
        values_(values),
        uses_(pack_),
        affected_(pack_.params.size()),
        relabelling_(pack_, values, uses_, table, graph),
        rows_(table.rows()),
        row_(row),
        is_given_up_(is_given_up) {}

  FlipSearch run() {
    search();
    if (search_.is_given_up) search_.nearest.reset();
    return std::move(search_);
  }

 private:
  struct Found {
    Piece piece;
    double value = 0;
    double share = std::numeric_limits<double>::infinity();
    Choice choice;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  bool gives_up() {
    search_.is_given_up = search_.is_given_up || (is_given_up_ && is_given_up_());
    return search_.is_given_up;
  }

  void search() {
    std::vector<Piece> pieces;
    for (std::size_t param = 0; param < pack_.params.size() && !search_.is_given_up; ++param)
      cut(param, pieces);
    std::ranges::sort(pieces, {}, [](const Piece& p) {
      return std::tuple(p.share, p.is_between, p.param, p.tried);
    });
    if (search_.is_given_up || search_.params == 0) return;
    said_ = label_of(relabelling_.choices()[at(row_)]);
    for (const Piece& piece : pieces)
      if (piece.is_own) look_at(piece);
    search_others(pieces);
    if (found_) search_.nearest = report();
  }

  [[nodiscard]] ClassId label_of(const std::optional<Choice>& choice) const {
    return choice && choice->rule >= 0 ? pack_.rules[at(choice->rule)].label : kNoClass;
  }
  [[nodiscard]] double share_of(std::size_t param, double value) const {
    const auto [low, high] = *pack_.params[param].range;
    return std::abs(value - values_.params[param]) / (high - low);
  }

  /// Cuts the range of a param at its turning points.
  void cut(std::size_t number, std::vector<Piece>& pieces) {
    const Param& param = pack_.params[number];
    if (!param.range) {
      search_.without_range.push_back(param.name);
      return;
    }
    if (gives_up()) return;
    ++search_.params;
    if (param.range->first == param.range->second) return;
    const ParamTurns turns = find_turns(pack_, number);
    const bool is_gradual = turns.is_gradual;
    const TurningPoints points = turning_points(pack_, relabelling_.context(), number, turns, row_);
    const double said = values_.params[number];
    for (const double end : {param.range->first, param.range->second}) {
      Bounds bounds;
      bounds.add(said, is_gradual);
      for (const double value : points.own) bounds.add(value, true);
      for (const double value : points.others) bounds.add(value, is_gradual);
      bounds.add(end, is_gradual);
      const bool is_any = is_gradual || !points.own.empty() || !points.others.empty();
      if (is_any) cut(number, bounds.towards(said, end), is_gradual, pieces);
    }
  }

  struct Bound {
    double value;
    bool is_own;
  };
  struct Bounds {
    std::vector<Bound> all;
    void add(double value, bool is_own) { all.push_back({value, is_own}); }
    /// From the pack's value to an end of the range, each once.
    [[nodiscard]] std::vector<Bound> towards(double from, double end) const {
      std::vector<Bound> way;
      for (const Bound& bound : all)
        if (bound.value >= std::min(from, end) && bound.value <= std::max(from, end))
          way.push_back(bound);
      std::ranges::sort(way, {}, [&](const Bound& b) { return std::abs(b.value - from); });
      std::vector<Bound> once;
      for (const Bound& bound : way) {
        if (once.empty() || once.back().value != bound.value) once.push_back(bound);
        once.back().is_own = once.back().is_own || bound.is_own;
      }
      return once;
    }
  };

  void cut(std::size_t param, const std::vector<Bound>& bounds, bool is_gradual,
           std::vector<Piece>& pieces) const {
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
      const auto [inner, is_inner_own] = bounds[i];
      const auto [outer, is_outer_own] = bounds[i + 1];
      double begin = inner;
      const int parts = is_gradual ? kPieces : 2;
      for (int k = 1; k < parts; ++k) {
        const double middle = inner + (outer - inner) * k / parts;
        pieces.push_back(
            {param, begin, outer, middle, share_of(param, begin), true, is_gradual, is_inner_own});
        begin = is_gradual ? middle : inner;
      }
      const double from = is_gradual ? begin : outer;
      pieces.push_back(
          {param, from, outer, outer, share_of(param, from), false, is_gradual, is_outer_own});
    }
  }

  /// Nothing if the pack is not sound with that value, or if the search was given up.
  std::optional<Choice> choice_at(std::size_t param, double value) {
    if (gives_up()) return std::nullopt;
    ++search_.tried;
    PackValues values = values_;
    values.set(pack_, param, value);
    if (find_fault(pack_, values)) return std::nullopt;
    auto& affected = affected_[param];
    if (!affected) affected = uses_.affected_by({&param, 1});
    return relabelling_.choices(pack_, values, *affected)[at(row_)];
  }
  /// True if the pack is sound with that value and the label is another one.
  bool is_flip(std::size_t param, double value, std::optional<Choice>& choice) {
    choice = choice_at(param, value);
    return choice && label_of(choice) != said_;
  }

  void look_at(const Piece& piece) {
    if (found_ && piece.share >= found_->share) return;
    std::optional<Choice> choice;
    if (!is_flip(piece.param, piece.tried, choice)) return;
    Found found{piece, piece.tried, piece.share, *choice};
    if (piece.is_gradual) sharpen(found);
    if (!found_ || found.share < found_->share) found_ = found;
  }

  /// Halves the way from where the label stays to where it does not.
  void sharpen(Found& found) {
    double stays = found.piece.inner;
    while (share_of(found.piece.param, stays) + kSharp < share_of(found.piece.param, found.value)) {
      const double middle = (stays + found.value) / 2;
      std::optional<Choice> choice;
      if (is_flip(found.piece.param, middle, choice)) {
        found.value = middle;
        found.choice = *choice;
      } else {
        stays = middle;
      }
    }
    found.piece.inner = found.value;
    found.piece.is_between = false;
    found.share = share_of(found.piece.param, found.value);
  }

  void search_others(const std::vector<Piece>& pieces) {
    const std::size_t most = kMostRelabelled / std::max<std::size_t>(1, rows_);
    std::size_t tries = 0;
    for (const Piece& piece : pieces) {
      if (piece.is_own) continue;
      if (search_.is_given_up || (found_ && piece.share >= found_->share)) return;
      if (tries++ == most) {
        search_.reach = piece.share;
        return;
      }
      look_at(piece);
    }
  }

  /// As few decimals as give the same label, away from the pack's value.
  void round(Found& found, std::string& text) {
    const Param& param = pack_.params[found.piece.param];
    const double edge = found.piece.is_between ? found.piece.inner : found.value;
    const double sign = found.value < values_.params[found.piece.param] ? -1 : 1;
    const std::string unit = unit_of(param.dimension);
    const std::string space = unit.empty() ? "" : " ";
    double tens = std::pow(10, kFewestDecimals);
    for (int decimals = kFewestDecimals; decimals <= kAllDecimals; ++decimals, tens *= 10) {
      double steps = std::ceil(sign * edge * tens);
      if (found.piece.is_between && sign * steps / tens == edge) ++steps;
      const double value = sign * steps / tens;
      if (value < param.range->first || value > param.range->second) continue;
      std::optional<Choice> choice;
      if (!is_flip(found.piece.param, value, choice) || label_of(choice) != label_of(found.choice))
        continue;
      found.value = value;
      found.choice = *choice;
      text = fmt::format("{:.{}f}{}{}", value, decimals, space, unit);
      return;
    }
    text = fmt::format("{}{}{}", found.value, space, unit);
  }

  Flip report() {
    Flip flip;
    round(*found_, flip.to_text);
    const Param& param = pack_.params[found_->piece.param];
    flip.param = param.name;
    flip.place = pack_.source.place(param.span.begin);
    flip.from = values_.params[found_->piece.param];
    flip.to = found_->value;
    flip.from_text = write(flip.from, param.dimension);
    if (found_->choice.rule < 0) return flip;
    const Rule& rule = pack_.rules[at(found_->choice.rule)];
    flip.label = pack_.classes[at(rule.label)].name;
    flip.score = found_->choice.score;
    flip.rule = rule.id;
    return flip;
  }

  /// With the expressions that turning points need.
  Pack pack_;
  const PackValues& values_;
  RuleUses uses_;
  /// By param, as soon as it was asked.
  std::vector<std::optional<RuleUses::Affected>> affected_;
  Relabelling relabelling_;
  std::size_t rows_;
  int row_;
  const IsGivenUp& is_given_up_;
  ClassId said_ = kNoClass;
  std::optional<Found> found_;
  FlipSearch search_;
};

}  // namespace

FlipSearch find_flip(const Pack& pack, const PackValues& values, const FeatureTable& table,
                     const FeatureGraph& graph, FeatureId feature, const IsGivenUp& is_given_up) {
  return FlipFinder(pack, values, table, graph, feature.value, is_given_up).run();
}

}  // namespace oriel::rules
