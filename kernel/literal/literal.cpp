#include "kernel/literal/literal.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"
#include "kernel/literal/arrangement.h"
#include "kernel/literal/body_view.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace oriel {

namespace literal {

namespace {

constexpr int kMostPlanes = 4;
/// Values and volumes that differ by no more are equal: a grid unit over a tenth of a metre, by
/// which rounded vertices may move them.
constexpr double kEqual = 1e-5;

/// Features of one test that are separated together.
struct Candidate {
  bool is_hole = false;
  int planes = 0;
  double value = 0;
  double volume_m3 = 0;
  std::vector<Bits> lumps;
};

/// A body that waits for its recursion.
struct WaitingBody {
  Bits regions;
  /// Its place among the bodies so far, and that of the body it came of.
  int parent = -1;
};

/// The regions of the arrangement that lie in a solid.
Bits regions_in(const Solid& solid, const Arrangement& arrangement, Work& work) {
  std::vector<std::vector<detail::Outline>> facets;
  std::int64_t corners = 0;
  for (const Facet& facet : solid.facets) {
    std::vector<detail::Outline>& outlines = facets.emplace_back();
    for (const Loop& loop : facet.loops) {
      detail::Outline& outline = outlines.emplace_back();
      for (const int v : loop) outline.push_back(solid.vertices[at(v)].point);
      corners += std::ssize(loop);
    }
  }
  Bits inside(arrangement.regions.size());
  for (int r = 0; r < std::ssize(arrangement.regions) && !work.is_used_up(); ++r) {
    const Region& region = arrangement.regions[at(r)];
    if (region.is_endless) continue;
    work.add(corners);
    double winding = 0;
    for (const auto& outlines : facets) winding += detail::winding_part(outlines, region.middle);
    constexpr double kHalf = 0.5;
    if (winding > kHalf) inside.add(r);
  }
  return inside;
}

/// The connected pieces of a set of regions.
class Pieces {
 public:
  explicit Pieces(const Arrangement& arrangement) : neighbours_(arrangement.regions.size()) {
    for (const Partition& p : arrangement.partitions) {
      neighbours_[at(p.behind)].push_back(p.before);
      neighbours_[at(p.before)].push_back(p.behind);
    }
  }
  [[nodiscard]] std::vector<Bits> of(Bits regions) const {
    std::vector<Bits> pieces;
    for (int start = regions.first(); start >= 0; start = regions.first()) {
      Bits& piece = pieces.emplace_back(neighbours_.size());
      std::vector<int> waiting{start};
      regions.drop(start);
      while (!waiting.empty()) {
        const int r = waiting.back();
        waiting.pop_back();
        piece.add(r);
        for (const int next : neighbours_[at(r)]) {
          if (!regions.has(next)) continue;
          regions.drop(next);
          waiting.push_back(next);
        }
      }
    }
    return pieces;
  }

 private:
  std::vector<std::vector<int>> neighbours_;
};

/// One recursion: the tests of one body.
class Recursion {
 public:
  Recursion(BodyView& body, const Heuristics& heuristics, double value_rel, Work& work)
      : body_(body), heuristics_(heuristics), value_rel_(value_rel), work_(work) {}

  /// The best of the valid features; nothing: the body is a leaf.
  std::optional<Candidate> run(LiteralStep& step) {
    step_ = &step;
    step.planes = static_cast<int>(body_.planes().size());
    const bool is_tested = !(heuristics_.convex_bodies_untested && body_.is_convex());
    for (int k = 1; k <= kMostPlanes; ++k) {
      const bool is_decided = best_.has_value() && heuristics_.fewest_planes_first;
      is_tested_ = is_tested && !is_decided;
      combine(k, 0);
      if (work_.is_used_up()) return {};
    }
    return std::move(best_);
  }

 private:
  /// Goes through all combinations of `more` planes from `first` on with those that are chosen.
  void combine(int more, int first) {
    if (work_.is_used_up()) return;
    if (more == 0) return visit();
    const int last = static_cast<int>(body_.planes().size()) - more;
    for (int split = first; split <= last; ++split) {
      chosen_.push_back(split);
      combine(more - 1, split + 1);
      chosen_.pop_back();
    }
  }

  void visit() {
    work_.add(1);
    const std::size_t k = chosen_.size() - 1;
    ++step_->combinations[k];
    if (!is_tested_ || (heuristics_.different_normals && !has_different_normals())) return;
    ++step_->tested[k];
    if (chosen_.size() == 1) {
      ++step_->protrusion_tests;
      evaluate(body_.protrusions(chosen_[0]), false);
    }
    ++step_->hole_tests;
    evaluate(body_.holes(chosen_), true);
  }

  [[nodiscard]] bool has_different_normals() const {
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (normal_of(chosen_[i]) == normal_of(chosen_[j])) return false;
    return true;
  }
  [[nodiscard]] int normal_of(int split) const { return body_.planes()[at(split)].normal_class; }

  void evaluate(std::vector<Lump> lumps, bool is_hole) {
    step_->evaluated += std::ssize(lumps);
    double old_area_m2 = 0;
    for (const int split : chosen_) old_area_m2 += body_.planes()[at(split)].old_area_m2;
    std::vector<std::pair<double, Lump*>> valid;
    for (Lump& lump : lumps) {
      const bool has_all = std::ranges::all_of(lump.new_area_m2, [](double a) { return a > 0; });
      if (!has_all || (is_hole && !lump.has_reflex_edge)) continue;
      const double value =
          std::accumulate(lump.new_area_m2.begin(), lump.new_area_m2.end(), 0.0) / old_area_m2;
      if (!heuristics_.values_below_one || value < 1 - value_rel_) valid.emplace_back(value, &lump);
    }
    if (!valid.empty()) offer(candidate_of(std::move(valid), is_hole));
  }

  Candidate candidate_of(std::vector<std::pair<double, Lump*>> valid, bool is_hole) {
    // The first of equal ones has the lowest regions.
    std::ranges::stable_sort(valid, {}, [](const auto& v) { return v.first; });
    Candidate candidate{is_hole, static_cast<int>(chosen_.size()), valid[0].first, 0, {}};
    for (const auto& [value, lump] : valid) {
      if (value > candidate.value * (1 + value_rel_) + kEqual) break;
      candidate.volume_m3 += lump->volume_m3;
      candidate.lumps.push_back(std::move(lump->regions));
      if (!heuristics_.equal_features_together) break;
    }
    return candidate;
  }

  void offer(Candidate candidate) {
    if (!best_ || is_better(candidate, *best_)) best_ = std::move(candidate);
  }

  /// Combinations come in the order of their planes, so the first of equals stays.
  static bool is_better(const Candidate& a, const Candidate& b) {
    if (std::abs(a.value - b.value) > kEqual) return a.value < b.value;
    if (a.is_hole != b.is_hole) return a.is_hole;
    return a.volume_m3 > b.volume_m3 * (1 + kEqual);
  }

  BodyView& body_;
  const Heuristics& heuristics_;
  double value_rel_;
  Work& work_;
  LiteralStep* step_ = nullptr;
  bool is_tested_ = true;
  std::vector<int> chosen_;
  std::optional<Candidate> best_;
};

/// The whole segmentation.
class Literal {
 public:
  Literal(const Heuristics& heuristics, double value_rel, std::int64_t budget)
      : heuristics_(heuristics), value_rel_(value_rel), work_(budget) {}

  LiteralCount run(const Solid& solid) {
    arrangement_ = arrange(solid, work_);
    if (arrangement_) segment(regions_in(solid, *arrangement_, work_));
    out_.is_used_up = work_.is_used_up();
    return std::move(out_);
  }

 private:
  void segment(const Bits& solid) {
    const Pieces pieces(*arrangement_);
    add_lumps(pieces.of(solid));
    while (!waiting_.empty() && !work_.is_used_up()) {
      WaitingBody body = std::move(waiting_.back());
      waiting_.pop_back();
      const int place = static_cast<int>(bodies_.size());
      const bool is_known = is_on_path(body);
      bodies_.push_back(body);
      LiteralStep& step = out_.steps.emplace_back();
      const auto cut = is_known ? std::nullopt : cut_of(body.regions, step);
      if (!cut) {
        ++out_.leaves;
        continue;
      }
      ++out_.inner;
      step.cut = cut->planes;
      step.is_hole = cut->is_hole;
      step.value = cut->value;
      step.parts = static_cast<int>(cut->lumps.size());
      add(cut->lumps, place);
      Bits rest = std::move(body.regions);
      for (const Bits& lump : cut->lumps) {
        if (cut->is_hole)
          rest |= lump;
        else
          rest -= lump;
      }
      add(pieces.of(std::move(rest)), place);
    }
  }

  /// The lumps of the solid, under a node of their own if there are several.
  void add_lumps(std::vector<Bits> lumps) {
    if (lumps.size() > 1) {
      ++out_.inner;
      LiteralStep& step = out_.steps.emplace_back();
      step.cut = 0;
      step.parts = static_cast<int>(lumps.size()) - 1;
      bodies_.emplace_back();
    }
    add(std::move(lumps), -1);
  }

  std::optional<Candidate> cut_of(const Bits& body, LiteralStep& step) {
    BodyView view(*arrangement_, body, work_);
    std::vector<Bits> cavities = view.cavities();
    if (!cavities.empty()) return Candidate{true, 0, 0, 0, std::move(cavities)};
    return Recursion(view, heuristics_, value_rel_, work_).run(step);
  }

  /// The last of them is the next to be segmented.
  void add(std::vector<Bits> bodies, int parent) {
    std::ranges::reverse(bodies);
    for (Bits& body : bodies) waiting_.push_back({std::move(body), parent});
  }

  [[nodiscard]] bool is_on_path(const WaitingBody& body) const {
    for (int i = body.parent; i >= 0; i = bodies_[at(i)].parent)
      if (bodies_[at(i)].regions == body.regions) return true;
    return false;
  }

  const Heuristics& heuristics_;
  double value_rel_;
  Work work_;
  std::optional<Arrangement> arrangement_;
  std::vector<WaitingBody> waiting_, bodies_;
  LiteralCount out_;
};

}  // namespace

}  // namespace literal

LiteralStep LiteralCount::sum() const {
  LiteralStep sum;
  for (const LiteralStep& step : steps) {
    sum.planes += step.planes;
    for (std::size_t k = 0; k < step.tested.size(); ++k) {
      sum.combinations[k] += step.combinations[k];
      sum.tested[k] += step.tested[k];
    }
    sum.protrusion_tests += step.protrusion_tests;
    sum.hole_tests += step.hole_tests;
    sum.evaluated += step.evaluated;
    sum.parts += step.parts;
  }
  return sum;
}

LiteralCount count_literally(const Solid& solid, const Heuristics& heuristics,
                             const Tolerances& tolerances, std::int64_t budget) {
  return literal::Literal(heuristics, tolerances.value_rel, budget).run(solid);
}

}  // namespace oriel
