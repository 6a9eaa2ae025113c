#include "kernel/literal/arrangement.h"

#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace oriel::literal {

namespace {

/// How much larger than the solid the arrangement's box is on every side, in longest sides.
constexpr double kMargin = 3;
/// The box's planes are not among those of the arrangement.
constexpr int kBorder = -1;

/// A side of a region: the plane's number (kBorder and below: of the box) and its corners in order.
struct Side {
  int plane = kBorder;
  std::vector<int> loop;
};

struct SpacePiece {
  Bits front;
  std::vector<Side> sides;
};

class Arranger {
 public:
  Arranger(const Solid& solid, Work& work) : solid_(solid), grid_m_(solid.grid_m), work_(work) {}

  std::optional<PlaneArrangement> run() {
    collect_planes();
    start_with_box();
    for (int p = 0; p < std::ssize(out_.planes); ++p)
      if (!insert(p)) return {};
    write_regions();
    if (work_.is_used_up()) return {};
    write_partitions();
    write_edges();
    return std::move(out_);
  }

 private:
  void collect_planes() {
    std::set<std::pair<std::array<std::int64_t, 3>, std::int64_t>> known;
    for (const Facet& facet : solid_.facets) {
      const Plane& plane = solid_.planes[facet.plane.index()];
      auto coefficients = plane.coefficients;
      std::int64_t offset = plane.offset;
      if (coefficients < std::array<std::int64_t, 3>{}) {
        for (std::int64_t& c : coefficients) c = -c;
        offset = -offset;
      }
      if (known.emplace(coefficients, offset).second) out_.planes.push_back(plane);
    }
  }

  void start_with_box() {
    const Box box = box_of(solid_);
    const Vec3 size = box.max - box.min;
    const double margin_m = kMargin * std::max({size.x, size.y, size.z});
    const auto limit = [&](double metres) {
      const double units = std::floor(metres / grid_m_);
      const auto most = static_cast<double>(exact::kMaxCoordinate);
      return static_cast<std::int64_t>(std::clamp(units, -most, most));
    };
    const std::array<std::int64_t, 3> low{limit(box.min.x - margin_m), limit(box.min.y - margin_m),
                                          limit(box.min.z - margin_m)};
    const std::array<std::int64_t, 3> high{limit(box.max.x + margin_m), limit(box.max.y + margin_m),
                                           limit(box.max.z + margin_m)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<std::int64_t, 3> normal{};
      normal[axis] = -1;
      border_.push_back(exact::make_plane(normal, -low[axis], grid_m_));
      normal[axis] = 1;
      border_.push_back(exact::make_plane(normal, high[axis], grid_m_));
    }
    for (int corner = 0; corner < 8; ++corner) {
      exact::Rational point;
      point.x = (corner & 1) != 0 ? high[0] : low[0];
      point.y = (corner & 2) != 0 ? high[1] : low[1];
      point.z = (corner & 4) != 0 ? high[2] : low[2];
      add_point(point);
    }
    SpacePiece& piece = pieces_.emplace_back();
    piece.front = Bits(out_.planes.size());
    const std::array<std::vector<int>, 6> loops{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (int s = 0; s < 6; ++s) piece.sides.push_back({kBorder - s, loops[at(s)]});
  }

  int add_point(const exact::Rational& point) {
    points_.push_back(point);
    metres_.push_back(exact::to_metres(point, grid_m_));
    return static_cast<int>(points_.size()) - 1;
  }
  [[nodiscard]] const Plane& plane_of(int plane) const {
    return plane <= kBorder ? border_[at(kBorder - plane)] : out_.planes[at(plane)];
  }

  /// Cuts all pieces by a plane. False if the work is used up.
  bool insert(int plane) {
    side_.clear();
    work_.add(std::ssize(points_));
    for (const exact::Rational& point : points_)
      side_.push_back(static_cast<signed char>(exact::side(out_.planes[at(plane)], point)));
    crossing_.clear();
    const std::size_t count = pieces_.size();
    for (std::size_t i = 0; i < count && !work_.is_used_up(); ++i) {
      const int where = where_is(pieces_[i]);
      if (where > 0) pieces_[i].front.add(plane);
      if (where != 0) continue;
      SpacePiece front = part_of(pieces_[i], plane, 1);
      front.front.add(plane);
      pieces_[i] = part_of(pieces_[i], plane, -1);
      pieces_.push_back(std::move(front));
    }
    return !work_.is_used_up();
  }

  /// +1: in front of the plane that is inserted, -1: behind it, 0: the plane cuts it.
  int where_is(const SpacePiece& piece) {
    bool is_in_front = false, is_behind = false;
    for (const Side& side : piece.sides) {
      work_.add(static_cast<std::int64_t>(side.loop.size()));
      for (const int v : side.loop) {
        is_in_front = is_in_front || side_[at(v)] > 0;
        is_behind = is_behind || side_[at(v)] < 0;
      }
    }
    if (is_in_front && is_behind) return 0;
    return is_in_front ? 1 : -1;
  }

  /// The part of a piece on one side (+1, -1) of a plane that cuts it.
  SpacePiece part_of(const SpacePiece& piece, int plane, int sign) {
    SpacePiece part;
    part.front = piece.front;
    std::map<int, int> next;  // along the cut, round the new side
    for (const Side& side : piece.sides) {
      Side kept{side.plane, {}};
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        const int v = side.loop[i], w = side.loop[(i + 1) % side.loop.size()];
        if (side_[at(v)] * sign >= 0) kept.loop.push_back(v);
        if (side_[at(v)] * side_[at(w)] < 0)
          kept.loop.push_back(crossing(piece, side.plane, v, w, plane));
      }
      // A side that only touches the plane keeps a corner or an edge.
      if (std::ranges::none_of(kept.loop, [&](int v) { return side_[at(v)] * sign > 0; })) continue;
      for (std::size_t i = 0; i < kept.loop.size(); ++i) {
        const int v = kept.loop[i], w = kept.loop[(i + 1) % kept.loop.size()];
        if (side_[at(v)] == 0 && side_[at(w)] == 0) next[w] = v;
      }
      part.sides.push_back(std::move(kept));
    }
    Side cap{plane, {}};
    for (int v = next.begin()->first; cap.loop.size() < next.size(); v = next.at(v))
      cap.loop.push_back(v);
    part.sides.push_back(std::move(cap));
    return part;
  }

  /// The point where the edge of a side of the piece crosses the plane that is inserted.
  int crossing(const SpacePiece& piece, int side_plane, int v, int w, int plane) {
    const auto [entry, is_new] = crossing_.emplace(std::minmax(v, w), -1);
    if (!is_new) return entry->second;
    const Side* other = nullptr;
    for (const Side& side : piece.sides) {
      if (side.plane == side_plane) continue;
      for (std::size_t i = 0; i < side.loop.size(); ++i)
        if (side.loop[i] == w && side.loop[(i + 1) % side.loop.size()] == v) other = &side;
    }
    const auto point =
        exact::meet(plane_of(side_plane), plane_of(other->plane), out_.planes[at(plane)]);
    entry->second = add_point(*point);
    side_.push_back(0);
    return entry->second;
  }

  /// A mean of the corners with weights that have no pattern.
  [[nodiscard]] Vec3 point_inside(const SpacePiece& piece) const {
    constexpr double kGolden = 0.6180339887498949;
    Vec3 sum;
    double weights = 0, turn = 0;
    for (const Side& side : piece.sides)
      for (const int v : side.loop) {
        turn += kGolden;
        turn -= std::floor(turn);
        sum = sum + (1 + turn) * metres_[at(v)];
        weights += 1 + turn;
      }
    return (1 / weights) * sum;
  }

  void write_regions() {
    for (const SpacePiece& piece : pieces_) {
      SpaceRegion region;
      region.front = piece.front;
      for (const Side& side : piece.sides) {
        region.is_endless = region.is_endless || side.plane <= kBorder;
        work_.add(std::ssize(side.loop));
      }
      region.inside = point_inside(piece);
      for (const Side& side : piece.sides) {
        const Vec3 area = area_vector(metres_, side.loop);
        region.volume_m3 += dot(metres_[at(side.loop[0])] - region.inside, area) / 3;
      }
      out_.regions.push_back(std::move(region));
    }
  }

  void write_partitions() {
    std::unordered_map<Bits, int, Bits::Hash> region_of;
    for (int r = 0; r < std::ssize(pieces_); ++r) region_of.emplace(pieces_[at(r)].front, r);
    for (int r = 0; r < std::ssize(pieces_); ++r)
      for (const Side& side : pieces_[at(r)].sides) {
        if (side.plane <= kBorder || pieces_[at(r)].front.has(side.plane)) continue;
        Bits front = pieces_[at(r)].front;
        front.add(side.plane);
        out_.partitions.push_back(
            {r, region_of.at(front), side.plane, length(area_vector(metres_, side.loop))});
      }
  }

  void write_edges() {
    struct EdgeOfRegion {
      int v, w, region;
      bool operator<(const EdgeOfRegion& other) const {
        return std::tie(v, w, region) < std::tie(other.v, other.w, other.region);
      }
    };
    std::vector<EdgeOfRegion> edges;
    std::set<std::pair<int, int>> border;
    for (int r = 0; r < std::ssize(pieces_); ++r)
      for (const Side& side : pieces_[at(r)].sides)
        for (std::size_t i = 0; i < side.loop.size(); ++i) {
          const int v = side.loop[i], w = side.loop[(i + 1) % side.loop.size()];
          if (side.plane <= kBorder) border.insert(std::minmax(v, w));
          // Each edge of a region is an edge of two of its sides.
          if (v < w) edges.push_back({v, w, r});
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
      RegionsAtEdge around;
      const EdgeOfRegion first = edges[i];
      for (; i < edges.size() && edges[i].v == first.v && edges[i].w == first.w; ++i)
        around.push_back(edges[i].region);
      if (!border.contains({first.v, first.w})) out_.edges.push_back(std::move(around));
    }
  }

  const Solid& solid_;
  double grid_m_;
  Work& work_;
  PlaneArrangement out_;
  std::vector<Plane> border_;
  std::vector<SpacePiece> pieces_;
  std::vector<exact::Rational> points_;
  std::vector<Vec3> metres_;
  /// By point: its side of the plane that is inserted.
  std::vector<signed char> side_;
  /// By edge: where that plane crosses it.
  std::map<std::pair<int, int>, int> crossing_;
};

}  // namespace

std::optional<PlaneArrangement> arrange(const Solid& solid, Work& work) {
  return Arranger(solid, work).run();
}

}  // namespace oriel::literal
