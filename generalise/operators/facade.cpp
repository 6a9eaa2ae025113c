#include "generalise/operators/facade.h"

#include "generalise/operators/separate.h"
#include "kernel/attach/clearance.h"
#include "kernel/base/indexed_vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

constexpr double kInfinity = Box::kInfinity;

/// From and to.
using AxisRange = std::pair<double, double>;

/// The part of the line from (x0, y0) to (x1, y1) with y inside a band: its x.
std::optional<AxisRange> within(double x0, double y0, double x1, double y1, AxisRange band) {
  if (y0 > y1) {
    std::swap(x0, x1);
    std::swap(y0, y1);
  }
  if (y1 <= band.first || y0 >= band.second) return std::nullopt;
  if (y0 == y1) return std::minmax(x0, x1);
  const auto x_at = [&](double y) { return x0 + (x1 - x0) * (y - y0) / (y1 - y0); };
  return std::minmax(x_at(std::max(y0, band.first)), x_at(std::min(y1, band.second)));
}

/// How far two ranges are apart; below 0 they overlap.
double apart(AxisRange a, AxisRange b) { return std::max(a.first - b.second, b.first - a.second); }
double middle(AxisRange a) { return (a.first + a.second) / 2; }
AxisRange grown(AxisRange a, double by) { return {a.first - by, a.second + by}; }
AxisRange along(const Extents& box) { return {box.u0, box.u1}; }
AxisRange up(const Extents& box) { return {box.v0, box.v1}; }

/// How far two rectangles are apart.
double distance_of(const Extents& a, const Extents& b) {
  return std::hypot(std::max(0.0, apart(along(a), along(b))), std::max(0.0, apart(up(a), up(b))));
}

/// How far a line is from a rectangle.
double distance_of(const Extents& box, Vec3 from, Vec3 to) {
  const std::array<Vec3, 4> corners{Vec3{box.u0, box.v0, 0}, Vec3{box.u1, box.v0, 0},
                                    Vec3{box.u1, box.v1, 0}, Vec3{box.u0, box.v1, 0}};
  return nearness(corners, {from, to});
}

}  // namespace

FacadeRoom::FacadeRoom(const Solid& solid, const Segmentation& segmentation, const Host& host)
    : solid_(&solid), segmentation_(&segmentation) {
  const Facet& facet = solid.facets[host.facet.index()];
  for (const Loop& loop : facet.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      const Vec3 p = solid.vertices[at(a)].point, q = solid.vertices[at(b)].point;
      const bool is_foot = dot(q - p, host.u) > 0 && std::abs(dot(q - p, host.v)) < kOnEdge_m;
      lines_.push_back(
          {dot(p, host.u), dot(p, host.v), dot(q, host.u), dot(q, host.v), is_foot, {}, a, b});
    }
  for (const FeatureId f : ids_below<FeatureId>(segmentation.features.size())) {
    const Feature& other = segmentation.features[f.index()];
    if (other.sense == Sense::imprint && !other.source_polygons.empty() &&
        std::ranges::includes(facet.polygons, other.source_polygons))
      add_outline(extents_of(host, segmentation, other), f);
  }
}

void FacadeRoom::add_outline(const Extents& box, FeatureId imprint) {
  // Clockwise, as a hole: the facet lies to the left.
  lines_.push_back({box.u1, box.v0, box.u0, box.v0, false, imprint});
  lines_.push_back({box.u0, box.v0, box.u0, box.v1, false, imprint});
  lines_.push_back({box.u0, box.v1, box.u1, box.v1, false, imprint});
  lines_.push_back({box.u1, box.v1, box.u1, box.v0, false, imprint});
}

/// Of an edge: the smallest feature that has the facet on its other side.
FeatureId FacadeRoom::owner(const FacadeLine& line) const {
  if (line.from < 0) return line.imprint;
  const auto found = facet_with_edge(*solid_, line.to, line.from);
  FeatureId owner;
  if (!found || solid_->facets[found->index()].polygons.empty()) return owner;
  const std::vector<int>& polygons = solid_->facets[found->index()].polygons;
  std::size_t least = 0;
  for (int f = 0; f < std::ssize(segmentation_->features); ++f) {
    const auto& its = segmentation_->features[at(f)].source_polygons;
    if (!std::ranges::includes(its, polygons)) continue;
    if (owner.is_valid() && its.size() >= least) continue;
    owner = {f};
    least = its.size();
  }
  return owner;
}

std::vector<FeatureId> FacadeRoom::beside(const Extents& box, double distance_m) const {
  std::set<FeatureId> found;
  for (const FacadeLine& line : lines_) {
    const Vec3 from{line.u0, line.v0, 0}, to{line.u1, line.v1, 0};
    if (stands_on(box, line) || distance_of(box, from, to) >= distance_m) continue;
    if (const FeatureId its = owner(line); its.is_valid()) found.insert(its);
  }
  return {found.begin(), found.end()};
}

bool FacadeRoom::stands_on(const Extents& box, const FacadeLine& line) {
  return line.is_foot && std::abs(line.v0 - box.v0) < kOnEdge_m &&
         apart({line.u0, line.u1}, along(box)) < 0;
}

std::vector<int> FacadeRoom::rows_of(const std::vector<Extents>& boxes) const {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return boxes[i].v0; });
  std::vector<AxisRange> first;  // of each row
  std::vector<int> rows(boxes.size(), 0);
  for (const std::size_t i : order) {
    const bool is_on_foot = std::ranges::any_of(
        lines_, [&](const FacadeLine& line) { return stands_on(boxes[i], line); });
    const AxisRange mine = up(boxes[i]);
    const auto found = std::ranges::find_if(first, [&](AxisRange its) {
      const double common = std::min(mine.second, its.second) - std::max(mine.first, its.first);
      return !is_on_foot &&
             common >= 0.5 * std::min(mine.second - mine.first, its.second - its.first);
    });
    rows[i] = static_cast<int>(found - first.begin());
    // Nothing joins what stands on the foot.
    if (found == first.end()) first.push_back(is_on_foot ? AxisRange{kInfinity, kInfinity} : mine);
  }
  return rows;
}

/// Finds where things go: two programmes of separations, that of the rows and that along the wall.
class FacadeArranger {
 public:
  FacadeArranger(const FacadeRoom& room, const std::vector<Movable>& movables, double gap_m,
                 Apartness apartness)
      : room_(room),
        lines_(room.lines_),
        movables_(movables),
        gap_m_(gap_m),
        keeps_now_(apartness == Apartness::as_now) {
    for (const Movable& one : movables) boxes_.push_back(one.box);
  }

  FacadePlaces run() {
    FacadePlaces out;
    if ((!keeps_now_ && !solve(&FacadeArranger::rows, &FacadeArranger::shift_up, out)) ||
        !solve(&FacadeArranger::places, &FacadeArranger::shift_along, out))
      return out;
    out.places = boxes_;
    for (std::size_t i = 0; i < boxes_.size(); ++i) out.clear_m.push_back(clear_of(i));
    return out;
  }

 private:
  /// Least distances are a hair more than the gap, which is checked exactly; what is a hair nearer
  /// is not near.
  [[nodiscard]] double least() const { return gap_m_ + kNoShift_m; }
  [[nodiscard]] double near() const { return gap_m_ - kNoShift_m; }

  /// A side of what moves at which it may be as near to something fixed as it is now.
  using Yielding = std::set<std::pair<int, bool>>;

  struct Programme {
    std::vector<double> wished, weights;
    std::vector<Separation> separations{};
    std::vector<std::vector<std::size_t>> about{};        ///< the rectangles of each separation
    std::vector<const FacadeRoom::FacadeLine*> beside{};  ///< and what is fixed; or null
  };
  static void add(Programme& into, Separation one, std::vector<std::size_t> about,
                  const FacadeRoom::FacadeLine* beside = nullptr) {
    into.separations.push_back(one);
    into.about.push_back(std::move(about));
    into.beside.push_back(beside);
  }

  /// How a rectangle and a line are apart along the wall and upwards, as far as they are near in
  /// the other direction.
  struct Apart {
    std::optional<AxisRange> u, v;  ///< of the line
    double along = -kInfinity, up = kInfinity;
    [[nodiscard]] bool is_upwards() const { return v && up >= along; }
  };
  [[nodiscard]] Apart apart_of(const Extents& box, const FacadeRoom::FacadeLine& line) const {
    Apart out;
    out.u = within(line.u0, line.v0, line.u1, line.v1, grown(detail::up(box), near()));
    out.v = within(line.v0, line.u0, line.v1, line.u1, grown(detail::along(box), near()));
    if (out.u) out.along = apart(*out.u, detail::along(box));
    if (out.v) out.up = apart(*out.v, detail::up(box));
    return out;
  }
  /// The tightest bound to either side.
  struct Bounds {
    bool is_low_yielding = false, is_high_yielding = false;
    double low = -kInfinity, high = kInfinity;
    const FacadeRoom::FacadeLine* below = nullptr;
    const FacadeRoom::FacadeLine* above = nullptr;
    Bounds(const Yielding& yielding, int variable, bool keeps_now)
        : is_low_yielding(keeps_now || yielding.contains({variable, true})),
          is_high_yielding(keeps_now || yielding.contains({variable, false})) {}
    /// Between something fixed and what is `now` apart from it.
    [[nodiscard]] double distance(bool is_low, double now, double least) const {
      return is_low ? (is_low_yielding ? std::min(least, now) : least)
                    : (is_high_yielding ? std::min(least, now) : least);
    }
    void take(bool is_low, double bound, const FacadeRoom::FacadeLine& line) {
      if (is_low && bound > low) {
        low = bound;
        below = &line;
      } else if (!is_low && bound < high) {
        high = bound;
        above = &line;
      }
    }
  };
  static void add(Programme& into, int variable, const std::vector<std::size_t>& about,
                  const Bounds& bounds) {
    if (bounds.low > -kInfinity)
      add(into, {Separation::kFixed, variable, bounds.low}, about, bounds.below);
    if (bounds.high < kInfinity)
      add(into, {variable, Separation::kFixed, -bounds.high}, about, bounds.above);
  }

  /// By how much each row goes up.
  [[nodiscard]] Programme rows(const Yielding& yielding) const {
    std::vector<std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const std::size_t row = at(movables_[i].row);
      if (members.size() <= row) members.resize(row + 1);
      members[row].push_back(i);
    }
    Programme out;
    for (std::size_t row = 0; row < members.size(); ++row) {
      out.wished.push_back(0);
      out.weights.push_back(std::max(1.0, static_cast<double>(members[row].size())));
      Bounds bounds(yielding, static_cast<int>(row), keeps_now_);
      for (const std::size_t i : members[row]) bound_upwards(boxes_[i], bounds);
      add(out, static_cast<int>(row), members[row], bounds);
    }
    add_between_rows(out);
    return out;
  }

  /// A line keeps off what is on its own side: the facet lies to its left.
  void bound_upwards(const Extents& box, Bounds& bounds) const {
    for (const FacadeRoom::FacadeLine& line : lines_) {
      if (FacadeRoom::stands_on(box, line)) {
        bounds.take(true, 0, line);
        bounds.take(false, 0, line);
        continue;
      }
      const Apart its = apart_of(box, line);
      if (!its.is_upwards()) continue;
      const bool is_low = line.u1 > line.u0;
      if (line.u1 == line.u0 || is_low != (middle(*its.v) < middle(detail::up(box)))) continue;
      const double now_m = is_low ? box.v0 - its.v->second : its.v->first - box.v1;
      const double distance_m = bounds.distance(is_low, now_m, least());
      bounds.take(is_low,
                  is_low ? its.v->second + distance_m - box.v0 : its.v->first - distance_m - box.v1,
                  line);
    }
  }

  void add_between_rows(Programme& out) const {
    struct Between {
      double least = -kInfinity;
      std::vector<std::size_t> about{};
    };
    std::map<std::pair<int, int>, Between> tightest;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      for (std::size_t j = i + 1; j < boxes_.size(); ++j) {
        if (movables_[i].row == movables_[j].row) continue;
        const double du = apart(along(boxes_[i]), along(boxes_[j]));
        if (du >= near() || apart(up(boxes_[i]), up(boxes_[j])) < du) continue;
        const bool is_below = middle(up(boxes_[i])) <= middle(up(boxes_[j]));
        const auto [low, high] = is_below ? std::pair{i, j} : std::pair{j, i};
        Between& its = tightest[{movables_[low].row, movables_[high].row}];
        const double needed = least() + boxes_[low].v1 - boxes_[high].v0;
        if (needed > its.least) its = {needed, {low, high}};
      }
    for (auto& [rows, its] : tightest)
      add(out, {rows.first, rows.second, its.least}, std::move(its.about));
  }

  /// Where the middles go.
  [[nodiscard]] Programme places(const Yielding& yielding) const {
    Programme out;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      out.wished.push_back(middle(along(boxes_[i])));
      if (movables_[i].is_fixed) {
        add(out, {Separation::kFixed, static_cast<int>(i), out.wished[i]}, {i});
        add(out, {static_cast<int>(i), Separation::kFixed, -out.wished[i]}, {i});
        continue;
      }
      Bounds bounds(yielding, static_cast<int>(i), keeps_now_);
      bound_along(boxes_[i], bounds);
      add(out, static_cast<int>(i), {i}, bounds);
    }
    std::vector<std::size_t> order(boxes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return out.wished[i]; });
    for (std::size_t i = 0; i < order.size(); ++i) add_next(order, i, out);
    return out;
  }

  void bound_along(const Extents& box, Bounds& bounds) const {
    const double half = box.width() / 2;
    for (const FacadeRoom::FacadeLine& line : lines_) {
      if (FacadeRoom::stands_on(box, line)) continue;
      const Apart its = apart_of(box, line);
      if (!its.u || its.is_upwards()) continue;
      const bool is_low = line.v1 < line.v0;
      if (line.v1 == line.v0 || is_low != (middle(*its.u) < middle(detail::along(box)))) continue;
      const double now_m = is_low ? box.u0 - its.u->second : its.u->first - box.u1;
      const double distance_m = bounds.distance(is_low, now_m, least());
      bounds.take(is_low,
                  is_low ? its.u->second + distance_m + half : its.u->first - distance_m - half,
                  line);
    }
  }

  [[nodiscard]] bool are_beside(std::size_t i, std::size_t j) const {
    const double upwards = apart(up(boxes_[i]), up(boxes_[j]));
    if (upwards >= near()) return false;
    // Nothing goes up or down: what is one above the other stays so.
    return !keeps_now_ || upwards < std::max(0.0, apart(along(boxes_[i]), along(boxes_[j])));
  }
  [[nodiscard]] double least_between(std::size_t i, std::size_t j) const {
    if (!keeps_now_ || movables_[i].is_fixed || movables_[j].is_fixed) return least();
    return std::min(least(), apart(along(boxes_[i]), along(boxes_[j])));
  }

  /// What comes next beside it; what has another one between follows from that.
  void add_next(const std::vector<std::size_t>& order, std::size_t number, Programme& out) const {
    const std::size_t i = order[number];
    std::vector<std::size_t> next;
    for (std::size_t later = number + 1; later < order.size(); ++later) {
      const std::size_t j = order[later];
      if (!are_beside(i, j)) continue;
      if (std::ranges::any_of(next, [&](std::size_t k) { return are_beside(k, j); })) continue;
      next.push_back(j);
      const double least_m = least_between(i, j) + (boxes_[i].width() + boxes_[j].width()) / 2;
      add(out, {static_cast<int>(i), static_cast<int>(j), least_m}, {i, j});
    }
  }

  void shift_up(const std::vector<double>& shifts) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const double shift = shifts[at(movables_[i].row)];
      if (std::abs(shift) <= kNoShift_m) continue;
      boxes_[i].v0 += shift;
      boxes_[i].v1 += shift;
    }
  }
  void shift_along(const std::vector<double>& places) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const double shift = places[i] - middle(along(boxes_[i]));
      boxes_[i].u0 += shift;
      boxes_[i].u1 += shift;
    }
  }

  /// False if there is no room: then `out` says for what.
  bool solve(Programme (FacadeArranger::*programme_of)(const Yielding&) const,
             void (FacadeArranger::*shift)(const std::vector<double>&), FacadePlaces& out) {
    Yielding yielding;
    while (true) {
      const Programme programme = (this->*programme_of)(yielding);
      const Separated found = separate(programme.wished, programme.separations, programme.weights);
      if (found.places) {
        (this->*shift)(*found.places);
        return true;
      }
      const std::size_t before = yielding.size();
      for (const std::size_t s : found.crowded) {
        const auto [low, high, least] = programme.separations[s];
        if (low == Separation::kFixed) yielding.emplace(high, true);
        if (high == Separation::kFixed) yielding.emplace(low, false);
      }
      if (yielding.size() > before && !keeps_now_) continue;
      tell_crowded(programme, found, out);
      return false;
    }
  }

  void tell_crowded(const Programme& programme, const Separated& found, FacadePlaces& out) const {
    std::set<std::size_t> crowded;
    std::set<FeatureId> beside;
    for (const std::size_t s : found.crowded) {
      crowded.insert(programme.about[s].begin(), programme.about[s].end());
      if (programme.beside[s] == nullptr) continue;
      if (const FeatureId its = room_.owner(*programme.beside[s]); its.is_valid())
        beside.insert(its);
    }
    out.crowded.assign(crowded.begin(), crowded.end());
    out.beside.assign(beside.begin(), beside.end());
    out.lacking_m = found.lacking;
  }

  [[nodiscard]] double clear_of(std::size_t i) const {
    const Extents& box = boxes_[i];
    double clear_m = gap_m_;
    for (std::size_t j = 0; j < boxes_.size(); ++j)
      if (j != i) clear_m = std::min(clear_m, distance_of(box, boxes_[j]));
    for (const FacadeRoom::FacadeLine& line : lines_)
      if (!FacadeRoom::stands_on(box, line))
        clear_m = std::min(clear_m, distance_of(box, {line.u0, line.v0, 0}, {line.u1, line.v1, 0}));
    return clear_m >= gap_m_ ? gap_m_ : clear_m - kNoShift_m;
  }

  const FacadeRoom& room_;
  const std::vector<FacadeRoom::FacadeLine>& lines_;
  const std::vector<Movable>& movables_;
  double gap_m_;
  bool keeps_now_;
  std::vector<Extents> boxes_;
};

FacadePlaces FacadeRoom::arrange(const std::vector<Movable>& movables, double gap_m,
                                 Apartness apartness) const {
  return FacadeArranger(*this, movables, gap_m, apartness).run();
}

bool is_moved(const Extents& now, const Extents& then) {
  const double most_m = std::max({std::abs(now.u0 - then.u0), std::abs(now.u1 - then.u1),
                                  std::abs(now.v0 - then.v0), std::abs(now.v1 - then.v1)});
  return most_m > kNoShift_m;
}

Placed put_on_facade(const Solid& solid, const Segmentation& segmentation, const Host& host,
                     const Extents& where, double depth_m, double clear_m, const Feature& feature) {
  Placed placed;
  for (const double share : {1.0, 0.5, 0.25, 0.125}) {
    placed = place_like(solid, segmentation, host, where, depth_m, feature.sense, share * clear_m,
                        feature);
    if (placed.solid) break;
  }
  return placed;
}

}  // namespace oriel::detail
