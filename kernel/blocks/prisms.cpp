#include "kernel/blocks/prisms.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

class PrismBuilder {
 public:
  PrismBuilder(const PlanView& view, const std::vector<int>& part_of,
               const std::vector<double>& heights_m)
      : view_(view), plan_(view.arrangement()), part_of_(part_of), heights_m_(heights_m) {
    body_.resize(heights_m.size());
    std::iota(body_.begin(), body_.end(), 0);
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h) {
      const int p = part(h), q = part(Arrangement::twin(h));
      if (p == q) continue;
      auto& levels = levels_[plan_.origin(h)];
      levels.insert({height_m(p), height_m(q)});
      if (p >= 0 && q >= 0) body_[at(body_of(p))] = body_of(q);
    }
  }

  Building run() {
    add_tops_and_ground();
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h) add_wall(h);
    return std::move(out_);
  }

 private:
  [[nodiscard]] int part(std::size_t h) const { return part_of_[plan_.region(h)]; }
  [[nodiscard]] double height_m(int part) const {
    return part < 0 ? view_.ground_m() : heights_m_[at(part)];
  }
  int body_of(int part) {
    while (body_[at(part)] != part) part = body_[at(part)] = body_[at(body_[at(part)])];
    return part;
  }

  int vertex(int of_plan, double z) {
    const auto [entry, is_new] =
        vertices_.emplace(std::pair{of_plan, z}, static_cast<int>(out_.vertices.size()));
    if (is_new) {
      const Vec3 p = view_.point(of_plan);
      out_.vertices.push_back({p.x, p.y, z});
    }
    return entry->second;
  }

  void add_polygon(std::vector<std::vector<int>> rings, int body) {
    Polygon polygon;
    polygon.rings = std::move(rings);
    polygon.source = static_cast<int>(out_.polygons.size());
    polygon.body = body;
    out_.polygons.push_back(std::move(polygon));
  }

  /// Rings by area, so that the outer one stands first.
  void add_horizontal(std::vector<Loop> loops, double z, bool looks_up, int body) {
    const auto area = [&](const Loop& loop) {
      Outline outline;
      for (const int v : loop) outline.push_back(view_.point(v));
      return signed_area(outline, {0, 0, 1});
    };
    std::ranges::stable_sort(loops, std::ranges::greater{}, area);
    std::vector<std::vector<int>> rings;
    for (const Loop& loop : loops) {
      std::vector<int>& ring = rings.emplace_back();
      for (const int v : loop) ring.push_back(vertex(v, z));
      if (!looks_up) std::ranges::reverse(ring);
    }
    add_polygon(std::move(rings), body);
  }

  /// The outlines of all pieces that `group` joins: connected regions of one group are one piece.
  template <class Group>
  std::vector<std::vector<Loop>> pieces(Group group) {
    std::vector<std::size_t> piece(part_of_.size());
    std::iota(piece.begin(), piece.end(), std::size_t{0});
    const auto find = [&](std::size_t r) {
      while (piece[r] != r) r = piece[r] = piece[piece[r]];
      return r;
    };
    const auto is_border = [&](std::size_t h) {
      return group(part(h)) != group(part(Arrangement::twin(h)));
    };
    for (std::size_t h = 0; h < plan_.half_edge_count(); ++h)
      if (!is_border(h)) piece[find(plan_.region(h))] = find(plan_.region(Arrangement::twin(h)));
    std::map<std::size_t, std::vector<Loop>> loops;
    std::vector<char> is_traced(plan_.half_edge_count(), 0);
    for (std::size_t start = 0; start < is_traced.size(); ++start) {
      if (is_traced[start] != 0 || !is_border(start) || part(start) < 0) continue;
      Loop loop;
      for (std::size_t h = start; is_traced[h] == 0;) {
        is_traced[h] = 1;
        loop.push_back(plan_.origin(h));
        for (h = plan_.next(h); !is_border(h);) h = plan_.next(Arrangement::twin(h));
      }
      part_at_[find(plan_.region(start))] = part(start);
      loops[find(plan_.region(start))].push_back(std::move(loop));
    }
    std::vector<std::vector<Loop>> all;
    owners_.clear();
    for (auto& [root, of_piece] : loops) {
      all.push_back(std::move(of_piece));
      owners_.push_back(part_at_[root]);
    }
    return all;
  }

  void add_tops_and_ground() {
    const auto tops = pieces([](int p) { return p; });
    for (std::size_t i = 0; i < tops.size(); ++i)
      add_horizontal(tops[i], height_m(owners_[i]), true, body_of(owners_[i]));
    const auto grounds = pieces([](int p) { return p < 0 ? 0 : 1; });
    for (std::size_t i = 0; i < grounds.size(); ++i)
      add_horizontal(grounds[i], view_.ground_m(), false, body_of(owners_[i]));
  }

  /// The wall to the left of which the higher block stands.
  void add_wall(std::size_t h) {
    const int p = part(h), q = part(Arrangement::twin(h));
    const double high = height_m(p), low = height_m(q);
    if (p == q || high <= low) return;
    const int a = plan_.origin(h), b = plan_.origin(Arrangement::twin(h));
    std::vector<int> ring{vertex(a, low), vertex(b, low)};
    const auto climb = [&](int v, std::vector<int>& to) {
      for (const double z : levels_[v])
        if (z > low && z < high) to.push_back(vertex(v, z));
    };
    climb(b, ring);
    ring.push_back(vertex(b, high));
    ring.push_back(vertex(a, high));
    std::vector<int> down;
    climb(a, down);
    ring.insert(ring.end(), down.rbegin(), down.rend());
    add_polygon({std::move(ring)}, body_of(p));
  }

  const PlanView& view_;
  const Arrangement& plan_;
  const std::vector<int>& part_of_;
  const std::vector<double>& heights_m_;
  std::vector<int> body_;                   ///< by part: union-find of connected ones
  std::map<int, std::set<double>> levels_;  ///< by vertex of the plan: the heights that meet there
  std::map<std::pair<int, double>, int> vertices_;
  std::map<std::size_t, int> part_at_;
  std::vector<int> owners_;  ///< a part of each of the pieces
  Building out_;
};

}  // namespace

Building prisms(const PlanView& view, const std::vector<int>& part_of,
                const std::vector<double>& heights_m) {
  return PrismBuilder(view, part_of, heights_m).run();
}

}  // namespace oriel::detail
