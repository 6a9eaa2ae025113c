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

/// Within which values are compared (Tolerances).
struct ValueLimits {
  double value_rel = 0;
  double tie_rel = 0;
};

/// Features of one test that are separated together.
struct LiteralCandidate {
  bool is_hole = false;
  int planes = 0;
  double value = 0;
  double volume_m3 = 0;
  std::vector<LiteralLump> lumps;
};

/// The best of a recursion, with the regions of its lumps.
struct LiteralCut {
  LiteralCandidate candidate;
  std::vector<Bits> lumps;
};

/// A body that waits for its recursion.
struct LiteralBody {
  Bits regions;
  /// Its place among the bodies so far, and that of the body it came of.
  int parent = -1;
};

/// A facet as it is seen from above.
struct FacetAbove {
  Plane plane;
  Box box;
  std::vector<Outline> outlines;
  std::int64_t corners = 0;
};

/// Those that are not upright.
std::vector<FacetAbove> facets_above(const Solid& solid) {
  std::vector<FacetAbove> facets;
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    if (plane.coefficients[2] == 0) continue;
    FacetAbove& above = facets.emplace_back();
    above.plane = plane;
    for (const Loop& loop : facet.loops) {
      Outline& outline = above.outlines.emplace_back();
      for (const int v : loop) {
        outline.push_back(solid.vertices[at(v)].point);
        above.box.grow(outline.back());
      }
      above.corners += std::ssize(loop);
    }
  }
  return facets;
}

/// The regions of the arrangement that lie in a solid: those over whose inner point there is an odd
/// number of facets.
Bits regions_in(const Solid& solid, const PlaneArrangement& arrangement, Work& work) {
  const std::vector<FacetAbove> facets = facets_above(solid);
  Bits inside(arrangement.regions.size());
  for (int r = 0; r < std::ssize(arrangement.regions) && !work.is_used_up(); ++r) {
    const Vec3 p = arrangement.regions[at(r)].inside;
    if (arrangement.regions[at(r)].is_endless) continue;
    bool is_inside = false;
    for (const FacetAbove& facet : facets) {
      const Box& box = facet.box;
      if (p.x < box.min.x || p.x > box.max.x || p.y < box.min.y || p.y > box.max.y) continue;
      work.add(facet.corners);
      if (p.z > box.max.z || !contains(facet.outlines, {0, 0, 1}, p)) continue;
      const Vec3 n = facet.plane.normal;
      if ((facet.plane.offset_m - n.x * p.x - n.y * p.y) / n.z > p.z) is_inside = !is_inside;
    }
    if (is_inside) inside.add(r);
  }
  return inside;
}

/// The connected pieces of a set of regions.
class ConnectedPieces {
 public:
  explicit ConnectedPieces(const PlaneArrangement& arrangement)
      : neighbours_(arrangement.regions.size()) {
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
  Recursion(BodyView& body, const Heuristics& heuristics, ValueLimits limits, Work& work)
      : body_(body), heuristics_(heuristics), limits_(limits), work_(work) {}

  /// The best of the valid features; nothing: the body is a leaf.
  std::optional<LiteralCandidate> run(LiteralStep& step) {
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

  void evaluate(std::vector<LiteralLump> lumps, bool is_hole) {
    step_->evaluated += std::ssize(lumps);
    double old_area_m2 = 0;
    for (const int split : chosen_) old_area_m2 += body_.planes()[at(split)].old_area_m2;
    std::vector<std::pair<double, LiteralLump*>> valid;
    for (LiteralLump& lump : lumps) {
      const bool has_all = std::ranges::all_of(lump.new_area_m2, [](double a) { return a > 0; });
      if (!has_all || (is_hole && !lump.has_reflex_edge)) continue;
      const double value =
          std::accumulate(lump.new_area_m2.begin(), lump.new_area_m2.end(), 0.0) / old_area_m2;
      if (!heuristics_.values_below_one || value < 1 - limits_.value_rel)
        valid.emplace_back(value, &lump);
    }
    if (!valid.empty()) offer(candidate_of(std::move(valid), is_hole));
  }

  LiteralCandidate candidate_of(std::vector<std::pair<double, LiteralLump*>> valid, bool is_hole) {
    // The first of equal ones has the lowest regions.
    std::ranges::stable_sort(valid, {}, [](const auto& v) { return v.first; });
    LiteralCandidate candidate{is_hole, static_cast<int>(chosen_.size()), valid[0].first, 0, {}};
    const double most = candidate.value * (1 + std::max(limits_.tie_rel, limits_.value_rel));
    for (const auto& [value, lump] : valid) {
      if (value > most) break;
      candidate.volume_m3 += lump->volume_m3;
      candidate.lumps.push_back(std::move(*lump));
      if (!heuristics_.equal_features_together) break;
    }
    return candidate;
  }

  void offer(LiteralCandidate candidate) {
    if (!best_ || is_better(candidate, *best_)) best_ = std::move(candidate);
  }

  /// Combinations come in the order of their planes, so the first of equals stays.
  [[nodiscard]] bool is_better(const LiteralCandidate& a, const LiteralCandidate& b) const {
    const double tie = 1 + limits_.tie_rel;
    if (std::max(a.value, b.value) > std::min(a.value, b.value) * tie) return a.value < b.value;
    if (a.is_hole != b.is_hole) return a.is_hole;
    return a.volume_m3 > b.volume_m3 * tie;
  }

  BodyView& body_;
  const Heuristics& heuristics_;
  ValueLimits limits_;
  Work& work_;
  LiteralStep* step_ = nullptr;
  bool is_tested_ = true;
  std::vector<int> chosen_;
  std::optional<LiteralCandidate> best_;
};

/// The whole segmentation.
class Literal {
 public:
  Literal(const PlaneArrangement& arrangement, const ConnectedPieces& pieces,
          const Heuristics& heuristics, ValueLimits limits, std::int64_t budget)
      : arrangement_(arrangement),
        pieces_(pieces),
        heuristics_(heuristics),
        limits_(limits),
        work_(budget) {}

  LiteralCount run(const Bits& solid) {
    segment(solid);
    out_.is_used_up = work_.is_used_up();
    return std::move(out_);
  }

 private:
  void segment(const Bits& solid) {
    add_lumps(pieces_.of(solid));
    while (!waiting_.empty() && !work_.is_used_up()) {
      LiteralBody body = std::move(waiting_.back());
      waiting_.pop_back();
      work_.add(std::ssize(arrangement_.regions));  // its connected pieces
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
      step.cut = cut->candidate.planes;
      step.is_hole = cut->candidate.is_hole;
      step.value = cut->candidate.value;
      step.parts = static_cast<int>(cut->lumps.size());
      add(cut->lumps, place);
      Bits rest = std::move(body.regions);
      for (const Bits& lump : cut->lumps) {
        if (step.is_hole)
          rest |= lump;
        else
          rest -= lump;
      }
      add(pieces_.of(std::move(rest)), place);
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

  std::optional<LiteralCut> cut_of(const Bits& body, LiteralStep& step) {
    BodyView view(arrangement_, body, work_);
    std::optional<LiteralCandidate> best;
    if (std::vector<LiteralLump> cavities = view.cavities(); !cavities.empty())
      best = LiteralCandidate{true, 0, 0, 0, std::move(cavities)};
    else
      best = Recursion(view, heuristics_, limits_, work_).run(step);
    if (!best) return {};
    LiteralCut cut{std::move(*best), {}};
    for (const LiteralLump& lump : cut.candidate.lumps) cut.lumps.push_back(view.regions_of(lump));
    return cut;
  }

  /// The last of them is the next to be segmented.
  void add(std::vector<Bits> bodies, int parent) {
    std::ranges::reverse(bodies);
    for (Bits& body : bodies) waiting_.push_back({std::move(body), parent});
  }

  [[nodiscard]] bool is_on_path(const LiteralBody& body) {
    for (int i = body.parent; i >= 0; i = bodies_[at(i)].parent) {
      work_.add(std::ssize(body.regions.words()));
      if (bodies_[at(i)].regions == body.regions) return true;
    }
    return false;
  }

  const PlaneArrangement& arrangement_;
  const ConnectedPieces& pieces_;
  const Heuristics& heuristics_;
  ValueLimits limits_;
  Work work_;
  std::vector<LiteralBody> waiting_, bodies_;
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

std::vector<LiteralCount> count_literally(const Solid& solid,
                                          std::span<const Heuristics> heuristics,
                                          const Tolerances& tolerances, std::int64_t budget) {
  std::vector<LiteralCount> counts(heuristics.size());
  for (LiteralCount& count : counts) count.is_used_up = true;
  Work work(budget);
  const auto arrangement = literal::arrange(solid, work);
  if (!arrangement) return counts;
  const literal::Bits body = literal::regions_in(solid, *arrangement, work);
  if (work.is_used_up()) return counts;
  const literal::ConnectedPieces pieces(*arrangement);
  const literal::ValueLimits limits{tolerances.value_rel, tolerances.tie_rel(solid.grid_m)};
  for (std::size_t i = 0; i < counts.size(); ++i)
    counts[i] = literal::Literal(*arrangement, pieces, heuristics[i], limits, budget).run(body);
  return counts;
}

LiteralCount count_literally(const Solid& solid, const Heuristics& heuristics,
                             const Tolerances& tolerances, std::int64_t budget) {
  return std::move(count_literally(solid, std::span(&heuristics, 1), tolerances, budget)[0]);
}

}  // namespace oriel
