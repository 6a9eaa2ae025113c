#include "kernel/segment/instances/congruence.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// Meetings of planes that are moved alike differ by no more than rounding.
bool is_same(Vec3 difference) {
  constexpr double kSame_m = 1e-9;  // tolerance of doubles, planes are compared exactly
  return dot(difference, difference) <= kSame_m * kSame_m;
}

/// The lowest corner of a body's box.
Vec3 corner_of(const Boundary& body) {
  Vec3 least{Box::kInfinity, Box::kInfinity, Box::kInfinity};
  for (int e = 0; e < body.half_edge_count(); ++e)
    if (body.is_alive_edge(e)) {
      const Vec3 p = body.at(e);
      least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
    }
  return least;
}

int count_facets(const Boundary& body) {
  int count = 0;
  for (int f = 0; f < body.facet_count(); ++f) count += body.is_alive(f) ? 1 : 0;
  return count;
}

class Matcher {
 public:
  Matcher(const Boundary& model, const Boundary& other, Side ground)
      : model_(model),
        other_(other),
        planes_(model.world().planes),
        ground_plane_(ground >> 1),
        edge_of_(at(model.half_edge_count()), -1) {}

  std::optional<Congruence> run() {
    if (count_facets(model_) != count_facets(other_)) return std::nullopt;
    find_shift();
    how_.points.reserve(edge_of_.size());
    for (int f = 0; f < model_.facet_count(); ++f)
      if (model_.is_alive(f) && !match_facet(f)) return std::nullopt;
    if (!do_twins_match()) return std::nullopt;
    if (!make_unique(how_.points) || !make_unique(how_.planes) || !make_unique(how_.sources) ||
        !make_unique(how_.marks))
      return std::nullopt;
    return std::move(how_);
  }

 private:
  void find_shift() {
    const double grid_m = model_.world().points.grid_m();
    const Vec3 difference = corner_of(other_) - corner_of(model_);
    how_.shift = {std::llround(difference.x / grid_m), std::llround(difference.y / grid_m),
                  std::llround(difference.z / grid_m)};
    how_.shift_m = {static_cast<double>(how_.shift[0]) * grid_m,
                    static_cast<double>(how_.shift[1]) * grid_m,
                    static_cast<double>(how_.shift[2]) * grid_m};
  }

  bool match_facet(int f) {
    const auto side = moved(model_.facet(f).side);
    if (!side) return false;
    how_.planes.emplace_back(model_.facet(f).side >> 1, *side >> 1);
    // Bodies that were cut off alike are mostly numbered alike.
    if (f < other_.facet_count() && other_.facet(f).side == *side && match(f, f)) return true;
    return std::ranges::any_of(other_.facets_on(*side), [&](int g) { return match(f, g); });
  }

  /// The side that lies where `side` comes to lie.
  [[nodiscard]] std::optional<Side> moved(Side side) const {
    const Plane& plane = planes_.plane(side >> 1);
    std::int64_t offset = plane.offset;
    for (std::size_t i = 0; i < 3; ++i) offset += plane.coefficients[i] * how_.shift[i];
    if (offset == plane.offset) return side;
    const auto& in_class = planes_.normal_class(planes_.class_of(side >> 1)).planes;
    const auto found = std::ranges::lower_bound(in_class, offset, {},
                                                [&](int p) { return planes_.plane(p).offset; });
    if (found == in_class.end() || planes_.plane(*found).offset != offset) return std::nullopt;
    if ((*found == ground_plane_) || (side >> 1 == ground_plane_)) return std::nullopt;
    return 2 * *found + (side & 1);
  }

  bool match(int f, int g) {
    const auto &one = model_.facet(f), &two = other_.facet(g);
    if (one.loops.size() != two.loops.size() || one.sources.size() != two.sources.size() ||
        one.marks.size() != two.marks.size())
      return false;
    const std::size_t points = how_.points.size();
    for (const int l : one.loops)
      if (std::ranges::none_of(two.loops, [&](int m) { return match_loop(l, m); })) {
        how_.points.resize(points);
        return false;
      }
    if (!match_marks(one.marks, two.marks)) return false;
    for (std::size_t i = 0; i < one.sources.size(); ++i)
      how_.sources.emplace_back(one.sources[i], two.sources[i]);
    return true;
  }

  bool match_marks(const std::vector<CapMark>& one, const std::vector<CapMark>& two) {
    return std::ranges::all_of(one, [&](const CapMark& mark) {
      const auto same = std::ranges::find_if(
          two, [&](const CapMark& m) { return is_same(m.point - mark.point - how_.shift_m); });
      if (same == two.end()) return false;
      how_.marks.emplace_back(mark.feature.value, same->feature.value);
      return true;
    });
  }

  bool match_loop(int l, int m) {
    const int first_of_model = model_.loop(l).first, first = other_.loop(m).first;
    int start = first;
    do {
      if (match_from(first_of_model, start)) return true;
      start = other_.next(start);
    } while (start != first);
    return false;
  }

  bool match_from(int e, int d) {
    const int first_e = e, first_d = d;
    const std::size_t points = how_.points.size();
    do {
      if (!is_same(other_.at(d) - model_.at(e) - how_.shift_m)) {
        how_.points.resize(points);
        return false;
      }
      edge_of_[at(e)] = d;
      how_.points.emplace_back(model_.origin(e), other_.origin(d));
      e = model_.next(e);
      d = other_.next(d);
    } while (e != first_e && d != first_d);
    return e == first_e && d == first_d;
  }

  [[nodiscard]] bool do_twins_match() const {
    for (int e = 0; e < model_.half_edge_count(); ++e)
      if (model_.is_alive_edge(e) && other_.twin(edge_of_[at(e)]) != edge_of_[at(model_.twin(e))])
        return false;
    return true;
  }

  /// Sorts a map; false if it maps a number to two.
  static bool make_unique(NumberMap& map) {
    std::ranges::sort(map);
    map.erase(std::unique(map.begin(), map.end()), map.end());
    return std::ranges::adjacent_find(map, {}, &std::pair<int, int>::first) == map.end();
  }

  const Boundary& model_;
  const Boundary& other_;
  const PlaneTable& planes_;
  int ground_plane_;
  std::vector<int> edge_of_;  ///< by half-edge of the model
  Congruence how_;
};

}  // namespace

std::optional<Congruence> find_congruence(const Boundary& model, const Boundary& other,
                                          Side ground) {
  return Matcher(model, other, ground).run();
}

}  // namespace oriel::detail
