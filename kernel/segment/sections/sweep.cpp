#include "kernel/segment/sections/sweep.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// c0 + c1 h + c2 h².
struct Quadratic {
  double c0 = 0, c1 = 0, c2 = 0;
  void add(double sign, const Quadratic& q) {
    c0 += sign * q.c0;
    c1 += sign * q.c1;
    c2 += sign * q.c2;
  }
  [[nodiscard]] double at(double h) const { return c0 + h * (c1 + h * c2); }
};

class Sweeper {
 public:
  Sweeper(const Boundary& body, int normal_class)
      : body_(body),
        planes_(body.world().planes),
        axis_(planes_.normal_class(normal_class).normal),
        ranks_(body.world().points.ranks(normal_class)),
        crossings_(at(body.half_edge_count())),
        ends_(at(body.facet_count())) {
    collect_events();
  }

  std::vector<PassedPlane> run(const std::vector<int>& planes) {
    std::vector<PassedPlane> passed(planes.size());
    std::size_t added = 0, removed = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const int rank = planes_.rank_of(planes[i]);
      const double height = planes_.plane(planes[i]).offset_m;
      // What happens between the planes, then what happens on this one.
      if (!pass(rank - 1, added, removed)) break;
      const std::optional<double> behind = area_at(height);
      const std::size_t first_removed = removed, before = active_.size();
      if (!pass(rank, added, removed)) break;
      const bool has_strict = before > removed - first_removed;
      if (!has_strict) continue;
      passed[i].behind_m2 = behind;
      passed[i].in_front_m2 = area_at(height);
    }
    return passed;
  }

 private:
  /// An edge as the half-edge that leads down, and its part in the contour.
  struct Crossing {
    Vec3 base, slope;   ///< it is at base + h · slope
    int next = -1;      ///< the crossing at the other end of the chord in its facet
    int place = -1;     ///< in active_; -1: not in the contour
    int old_next = -1;  ///< before the event at hand
    Quadratic area;     ///< its share in the area of the section
  };
  /// An end of a chord in a facet.
  struct End {
    int crossing;
    bool leads_down;  ///< the facet's own half-edge leads down here: the chord begins
  };
  struct Event {
    int rank, edge;
  };

  void collect_events() {
    for (int one = 0; one < body_.half_edge_count(); ++one) {
      if (!body_.is_alive_edge(one)) continue;
      const int other = body_.twin(one);
      const int high = ranks_[at(body_.origin(one))], low = ranks_[at(body_.origin(other))];
      if (low >= high) continue;
      starts_.push_back({low, one});
      stops_.push_back({high, one});
    }
    const auto order = [](const Event& p, const Event& q) {
      return std::pair(p.rank, p.edge) < std::pair(q.rank, q.edge);
    };
    std::ranges::sort(starts_, order);
    std::ranges::sort(stops_, order);
  }

  /// Lets the plane move over all vertices up to `rank`, those of one rank at a time. False if the
  /// contour is lost.
  bool pass(int rank, std::size_t& added, std::size_t& removed) {
    while (true) {
      const int next_start = added < starts_.size() ? starts_[added].rank : rank + 1;
      const int next_stop = removed < stops_.size() ? stops_[removed].rank : rank + 1;
      const int now = std::min(next_start, next_stop);
      if (now > rank) return true;
      const std::size_t from_added = added, from_removed = removed;
      while (added < starts_.size() && starts_[added].rank == now) ++added;
      while (removed < stops_.size() && stops_[removed].rank == now) ++removed;
      if (!happen(std::span(starts_).subspan(from_added, added - from_added),
                  std::span(stops_).subspan(from_removed, removed - from_removed)))
        return false;
    }
  }

  bool happen(std::span<const Event> starts, std::span<const Event> stops) {
    facets_.clear();
    changed_.clear();
    seen_.start(body_.facet_count());
    for (const Event& event : stops) leave(event.edge);
    for (const Event& event : starts)
      if (!enter(event.edge)) return false;
    for (const int f : facets_)
      if (!relink(f)) return false;
    if (!goes_on_alone(starts, stops)) count_loops();
    return true;
  }

  void touch(int facet) {
    if (seen_.insert(facet)) facets_.push_back(facet);
  }

  void leave(int e) {
    Crossing& crossing = crossings_[at(e)];
    for (const int f : {body_.facet_of(e), body_.facet_of(body_.twin(e))}) {
      auto& ends = ends_[at(f)];
      ends.erase(std::ranges::find(ends, e, &End::crossing));
      touch(f);
    }
    area_.add(-1, crossing.area);
    crossings_[at(active_.back())].place = crossing.place;
    active_[at(crossing.place)] = active_.back();
    active_.pop_back();
    crossing.place = -1;
  }

  bool enter(int e) {
    const int f = body_.facet_of(e), g = body_.facet_of(body_.twin(e));
    if (f == g) return false;
    const Vec3 high = body_.at(e), low = body_.at(body_.twin(e));
    const double height = dot(axis_, low), rise = dot(axis_, high) - height;
    // So flat an edge crosses planes where doubles do not tell.
    constexpr double kFlat_m = 1e-4;
    if (rise < kFlat_m) return false;
    Crossing& crossing = crossings_[at(e)];
    crossing = {};
    crossing.slope = (1 / rise) * (high - low);
    crossing.base = low - height * crossing.slope;
    if (!add_area(crossing, f, -1) || !add_area(crossing, g, 1)) return false;
    area_.add(1, crossing.area);
    crossing.place = static_cast<int>(active_.size());
    active_.push_back(e);
    insert(f, {e, true}, height);
    insert(g, {e, false}, height);
    return true;
  }

  /// A chord from p to q in a facet with normal m and offset d, at height h, bounds the area
  /// (d - h axis·m) (l·q - l·p) / 2 l², where l = axis × m: a sum of what its ends give.
  bool add_area(Crossing& crossing, int facet, double sign) {
    const Side side = body_.facet(facet).side;
    const Vec3 normal = planes_.normal(side), line = cross(axis_, normal);
    const double square = dot(line, line);
    constexpr double kSteep = 1e-6;  // of its sine's square; flatter facets meet planes badly
    if (square < kSteep) return false;
    const double d = planes_.offset_m(side), m = dot(axis_, normal);
    const double u = dot(line, crossing.base), v = dot(line, crossing.slope);
    crossing.area.add(sign / (2 * square), {d * u, d * v - m * u, -m * v});
    return true;
  }

  /// Puts an end in its place on the line in which the facet meets the plane: where edges leave one
  /// point, by where they are just above it.
  void insert(int facet, const End& end, double height) {
    const Vec3 line = cross(axis_, planes_.normal(body_.facet(facet).side));
    const auto place = [&](const End& e) {
      const Crossing& c = crossings_[at(e.crossing)];
      return std::tuple(dot(line, c.base + height * c.slope), dot(line, c.slope), e.leads_down);
    };
    auto& ends = ends_[at(facet)];
    ends.insert(std::ranges::upper_bound(ends, place(end), {}, place), end);
    touch(facet);
  }

  bool relink(int facet) {
    const auto& ends = ends_[at(facet)];
    if (ends.size() % 2 != 0) return false;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      if (!ends[i].leads_down || ends[i + 1].leads_down) return false;
      Crossing& crossing = crossings_[at(ends[i].crossing)];
      if (crossing.next == ends[i + 1].crossing) continue;
      if (crossing.next >= 0) changed_.push_back(ends[i].crossing);
      crossing.old_next = crossing.next;
      crossing.next = ends[i + 1].crossing;
    }
    return true;
  }

  /// One stretch of one loop was replaced by another one, and nothing else has happened: as many
  /// loops as before.
  [[nodiscard]] bool goes_on_alone(std::span<const Event> starts,
                                   std::span<const Event> stops) const {
    if (changed_.size() != 1) return changed_.empty() && starts.empty() && stops.empty();
    const Crossing& before = crossings_[at(changed_[0])];
    std::size_t left = 0, come = 0;
    int old_end = before.old_next, new_end = before.next;
    for (; left <= stops.size() && crossings_[at(old_end)].place < 0; ++left)
      old_end = crossings_[at(old_end)].next;
    for (; come <= starts.size() && is_new(new_end, starts); ++come)
      new_end = crossings_[at(new_end)].next;
    return old_end == new_end && left == stops.size() && come == starts.size();
  }

  static bool is_new(int e, std::span<const Event> starts) {
    return std::ranges::binary_search(starts, e, {}, &Event::edge);
  }

  void count_loops() {
    loops_ = 0;
    counted_.start(body_.half_edge_count());
    for (const int start : active_) {
      if (!counted_.insert(start)) continue;
      ++loops_;
      for (int e = crossings_[at(start)].next; e != start; e = crossings_[at(e)].next)
        if (!counted_.insert(e)) {
          loops_ = kLost;
          return;
        }
    }
  }

  [[nodiscard]] std::optional<double> area_at(double height) const {
    const double area = area_.at(height);
    if (loops_ != 1 || active_.empty() || area <= 0) return std::nullopt;
    return area;
  }

  static constexpr int kLost = 1 << 20;  // more loops than one, to be counted again

  const Boundary& body_;
  const PlaneTable& planes_;
  Vec3 axis_;
  std::span<const int> ranks_;
  std::vector<Event> starts_, stops_;  ///< edges by their lower and their upper end
  std::vector<Crossing> crossings_;    ///< by half-edge
  std::vector<Few<End, 4>> ends_;      ///< by facet, sorted along its line
  std::vector<int> active_;            ///< the contour's edges
  Quadratic area_;                     ///< of the section, by height
  int loops_ = 0;

  // The event at hand.
  std::vector<int> facets_, changed_;
  StampSet seen_, counted_;
};

}  // namespace

std::vector<PassedPlane> sweep(const Boundary& body, int normal_class,
                               const std::vector<int>& planes) {
  return Sweeper(body, normal_class).run(planes);
}

}  // namespace oriel::detail
