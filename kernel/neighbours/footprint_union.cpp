#include "kernel/neighbours/footprint_union.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/segment/complex/arrangement.h"
#include "kernel/segment/complex/refine.h"
#include "kernel/segment/complex/vertex_pool.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace oriel::detail {

namespace {

constexpr Vec3 kZenith{0, 0, 1};

/// The border between what some area covers and what none does.
class UnionTracer {
 public:
  UnionTracer(std::span<const PlanArea> areas, double reach_m, Work& work) : pool_({}, reach_m) {
    std::vector<Chord> chords;
    int label = 0;
    for (const PlanArea& area : areas) {
      for (const Outline& outline : area) add_chords(outline, label, chords);
      ++label;
    }
    const PlaneAxes axes(kZenith);
    edges_ = refine(std::move(chords), axes, pool_, work);
    plan_.emplace(edges_, axes, pool_);
    const auto labels = plan_->labels();
    is_covered_.resize(labels.size());
    for (std::size_t r = 0; r < labels.size(); ++r) is_covered_[r] = labels[r].empty() ? 0 : 1;
  }

  std::vector<PlanArea> run() {
    DisjointSets pieces(plan_->region_count());
    for (std::size_t h = 0; h < plan_->half_edge_count(); ++h)
      if (!is_border(h) && covered(h))
        pieces.unite(static_cast<int>(plan_->region(h)),
                     static_cast<int>(plan_->region(Arrangement::twin(h))));
    std::map<int, PlanArea> found;
    std::vector<char> is_traced(plan_->half_edge_count(), 0);
    for (std::size_t start = 0; start < is_traced.size(); ++start) {
      if (is_traced[start] != 0 || !is_border(start) || !covered(start)) continue;
      Outline outline = trace(start, is_traced);
      if (std::abs(signed_area(outline, kZenith)) < pool_.reach_m() * perimeter(outline)) continue;
      found[pieces.find(static_cast<int>(plan_->region(start)))].push_back(std::move(outline));
    }
    return sorted(std::move(found));
  }

 private:
  void add_chords(const Outline& outline, int label, std::vector<Chord>& chords) {
    std::vector<int> ring;
    for (const Vec3 p : outline) ring.push_back(pool_.find_or_add({p.x, p.y, 0}));
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (const int to = ring[(i + 1) % ring.size()]; to != ring[i])
        chords.push_back({ring[i], to, label, 1});
  }

  [[nodiscard]] bool covered(std::size_t h) const { return is_covered_[plan_->region(h)] != 0; }
  [[nodiscard]] bool is_border(std::size_t h) const {
    return covered(h) != covered(Arrangement::twin(h));
  }

  Outline trace(std::size_t start, std::vector<char>& is_traced) const {
    Outline outline;
    const auto is_its = [&](std::size_t h) { return is_border(h); };
    for (const std::size_t h : border_from(*plan_, start, is_its, is_traced))
      outline.push_back(pool_.at(plan_->origin(h)));
    start_at_least(outline);
    return outline;
  }

  /// Areas without an outer outline are left out.
  static std::vector<PlanArea> sorted(std::map<int, PlanArea> found) {
    std::vector<PlanArea> out;
    for (auto& [piece, area] : found) {
      const auto size = [](const Outline& outline) { return signed_area(outline, kZenith); };
      std::ranges::sort(area, [&](const Outline& p, const Outline& q) {
        const double of_p = size(p), of_q = size(q);
        return of_p != of_q ? of_p > of_q : is_lesser(p[0], q[0]);
      });
      if (!area.empty() && size(area[0]) > 0) out.push_back(std::move(area));
    }
    std::ranges::sort(out, [](const PlanArea& p, const PlanArea& q) {
      const double of_p = signed_area(p[0], kZenith), of_q = signed_area(q[0], kZenith);
      return of_p != of_q ? of_p > of_q : is_lesser(p[0][0], q[0][0]);
    });
    return out;
  }

  VertexPool pool_;
  std::vector<PlanarEdge> edges_;
  std::optional<Arrangement> plan_;
  std::vector<char> is_covered_;
};

/// The strip between an edge and one that runs against it; nothing if they do not face each other.
std::optional<Outline> strip_between(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double gap_m, double lean) {
  const double long_m = length(b - a);
  if (!(long_m > 0) || !(length(d - c) > 0)) return std::nullopt;
  const Vec3 along = (1 / long_m) * (b - a), against = (1 / length(d - c)) * (d - c);
  if (dot(along, against) >= 0 || std::abs(cross(along, against).z) > lean) return std::nullopt;
  const Vec3 out{along.y, -along.x, 0};  // the interior is to the left
  const double begin_m = std::max(0.0, dot(d - a, along));
  const double end_m = std::min(long_m, dot(c - a, along));
  if (!(end_m > begin_m)) return std::nullopt;
  const auto across_m = [&](double at_m) {
    const double share = (at_m - dot(d - a, along)) / (dot(c - a, along) - dot(d - a, along));
    return dot(d + share * (c - d) - a, out);
  };
  const double at_begin_m = across_m(begin_m), at_end_m = across_m(end_m);
  const double least_m = std::min(at_begin_m, at_end_m), most_m = std::max(at_begin_m, at_end_m);
  if (least_m < 0 || most_m > gap_m || !(most_m > 0) || end_m - begin_m < most_m)
    return std::nullopt;
  const auto at = [&](double along_m, double across) { return a + along_m * along + across * out; };
  return Outline{at(begin_m, 0), at(begin_m, at_begin_m), at(end_m, at_end_m), at(end_m, 0)};
}

}  // namespace

std::vector<PlanArea> united(std::span<const PlanArea> areas, double reach_m, Work& work) {
  return UnionTracer(areas, reach_m, work).run();
}

std::vector<PlanArea> gaps_between(const PlanArea& one, const PlanArea& other, double gap_m,
                                   double lean) {
  std::vector<PlanArea> out;
  for (const Outline& p : one)
    for (std::size_t i = 0; i < p.size(); ++i)
      for (const Outline& q : other)
        for (std::size_t k = 0; k < q.size(); ++k)
          if (auto strip = strip_between(p[i], p[(i + 1) % p.size()], q[k], q[(k + 1) % q.size()],
                                         gap_m, lean))
            out.push_back({std::move(*strip)});
  return out;
}

}  // namespace oriel::detail
