#include "kernel/solidify/missing/rim_pieces.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// Looking at all runs of a rim that is not plane takes up to the cube of its edges.
constexpr std::size_t kLongestRim = 128;
/// What speaks for a run is asked of all edges.
constexpr std::size_t kMostEdges = 20000;

/// 1° is what surveyed walls show between neighbours in one plane.
constexpr double kSamePlane_rad = std::numbers::pi / 180;

/// A run of edges of a rim: `count` from number `start` on, round the end.
struct Run {
  std::size_t start = 0, count = 0;
  Vec3 area;
  /// The polygons have planes that are parallel to its own, and to what lies beyond its chord.
  bool is_known = false;
  double support = 0, chord = 0;

  /// How much speaks for it.
  [[nodiscard]] auto rank() const { return std::tuple(is_known, support, count, -chord); }
};

/// Three runs around a lost corner.
struct LostCorner {
  std::array<Run, 3> runs;
  Vec3 place;
  bool is_known = false;
  double support = 0;

  [[nodiscard]] auto rank() const { return std::tuple(is_known, support); }
};

class RimCutter {
 public:
  RimCutter(Soup& soup, std::span<const PolygonShape> shapes, std::vector<HoleRim> rims,
            double reach, Work& work)
      : soup_(soup), shapes_(shapes), rims_(std::move(rims)), reach_(reach), work_(work) {
    for (const HoleRim& rim : rims_) all_.insert(all_.end(), rim.begin(), rim.end());
  }

  std::optional<std::vector<PlanePiece>> run() {
    if (all_.size() > kMostEdges) return std::nullopt;
    for (HoleRim& rim : rims_) {
      while (rim.size() >= 3) {
        if (const Vec3 area = area_of(rim, 0, rim.size()); is_plane(rim, 0, rim.size(), area)) {
          pieces_.push_back({std::move(rim), area});
          break;
        }
        if (rim.size() > kLongestRim || work_.is_used_up()) return std::nullopt;
        const Run best = best_run(rim);
        if (const auto corner = best_corner(rim);
            corner && corner->rank() > std::tuple(best.is_known, best.support)) {
          take_corner(rim, *corner);
          break;
        }
        if (best.count == 0) return std::nullopt;
        take(rim, best);
      }
    }
    return std::move(pieces_);
  }

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  /// Of a run closed by its chord.
  [[nodiscard]] Vec3 area_of(const HoleRim& rim, std::size_t start, std::size_t count) const {
    const Vec3 base = place(rim[start].from);
    Vec3 sum;
    work_.add(static_cast<std::int64_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const HoleEdge& edge = rim[(start + i) % rim.size()];
      sum = sum + 0.5 * cross(place(edge.from) - base, place(edge.to) - base);
    }
    return sum;
  }

  /// How far the points of a run lie along its normal, on average.
  [[nodiscard]] double level_of(const HoleRim& rim, std::size_t start, std::size_t count,
                                Vec3 normal) const {
    double sum = dot(normal, place(rim[start].from));
    for (std::size_t i = 0; i < count; ++i)
      sum += dot(normal, place(rim[(start + i) % rim.size()].to));
    return sum / static_cast<double>(count + 1);
  }

  [[nodiscard]] bool is_plane(const HoleRim& rim, std::size_t start, std::size_t count,
                              Vec3 area) const {
    const Vec3 normal = normalised(area);
    const double level = level_of(rim, start, count, normal);
    if (std::abs(dot(normal, place(rim[start].from)) - level) > reach_) return false;
    for (std::size_t i = 0; i < count; ++i)
      if (std::abs(dot(normal, place(rim[(start + i) % rim.size()].to)) - level) > reach_)
        return false;
    return true;
  }

  /// A polygon beyond one of its edges lies in its plane and looks the other way.
  [[nodiscard]] bool folds_back(const HoleRim& rim, const Run& run) const {
    const Vec3 normal = normalised(run.area);
    for (std::size_t i = 0; i < run.count; ++i) {
      const int polygon = rim[(run.start + i) % rim.size()].polygon;
      if (polygon >= 0 && dot(normal, shapes_[at(polygon)].unit) < -std::cos(kSamePlane_rad))
        return true;
    }
    return false;
  }

  /// The length of all edges of holes in a plane.
  [[nodiscard]] double support_of(Vec3 normal, double level) const {
    const auto is_near = [&](int v) { return std::abs(dot(normal, place(v)) - level) <= reach_; };
    double sum = 0;
    work_.add(std::ssize(all_));
    for (const HoleEdge& edge : all_)
      if (is_near(edge.from) && is_near(edge.to)) sum += length(place(edge.to) - place(edge.from));
    return sum;
  }

  /// The area of a run tells its normal only as far as its points are certain.
  [[nodiscard]] double uncertainty_of(Vec3 area, double longest) const {
    return std::max(kSamePlane_rad, uncertainty_rad(length(area) / longest, reach_));
  }

  /// A polygon is parallel.
  [[nodiscard]] bool is_known(Vec3 normal, double uncertainty) const {
    work_.add(std::ssize(shapes_));
    const double cosine = std::cos(std::min(uncertainty, std::numbers::pi / 4));
    return std::ranges::any_of(shapes_, [&](const PolygonShape& shape) {
      return std::abs(dot(shape.unit, normal)) >= cosine;
    });
  }

  /// What speaks for the plane of a run.
  void judge_plane(const HoleRim& rim, Run& run) const {
    const Vec3 normal = normalised(run.area);
    run.support = support_of(normal, level_of(rim, run.start, run.count, normal));
    run.is_known = is_known(normal, uncertainty_of(run.area, reach_along(rim, run)));
  }

  /// The longest way from the start of a run to one of its points.
  [[nodiscard]] double reach_along(const HoleRim& rim, const Run& run) const {
    double longest = 0;
    for (std::size_t i = 0; i < run.count; ++i)
      longest = std::max(longest, length(place(rim[(run.start + i) % rim.size()].to) -
                                         place(rim[run.start].from)));
    return longest;
  }

  /// The edges before and after it lie in its plane, too.
  [[nodiscard]] bool is_part(const HoleRim& rim, const Run& run) const {
    const Vec3 normal = normalised(run.area);
    const double level = level_of(rim, run.start, run.count, normal);
    const int before = rim[(run.start + rim.size() - 1) % rim.size()].from;
    const int after = rim[(run.start + run.count) % rim.size()].to;
    return std::abs(dot(normal, place(before)) - level) <= reach_ ||
           std::abs(dot(normal, place(after)) - level) <= reach_;
  }

  /// What lies beyond the chord of a run speaks against it where it is less: the plane of the chord
  /// and of the edge next to it, at either end.
  void judge_beyond(const HoleRim& rim, Run& run) const {
    const HoleEdge& before = rim[(run.start + rim.size() - 1) % rim.size()];
    const HoleEdge& after = rim[(run.start + run.count) % rim.size()];
    const Vec3 from = place(before.to), to = place(after.from);
    std::tuple<bool, double> best{false, 0};
    for (const Vec3 way : {place(before.from) - from, place(after.to) - to}) {
      const Vec3 area = 0.5 * cross(to - from, way), normal = normalised(area);
      const double longest = std::max(length(to - from), length(way));
      if (2 * length(area) <= std::sin(kSamePlane_rad) * length(to - from) * length(way)) continue;
      best = std::max(best, std::tuple(is_known(normal, uncertainty_of(area, longest)),
                                       support_of(normal, dot(normal, from))));
    }
    std::tie(run.is_known, run.support) = std::min(best, std::tuple(run.is_known, run.support));
  }

  [[nodiscard]] Run longest_from(const HoleRim& rim, std::size_t start) const {
    Run longest;
    for (std::size_t count = 2; count < rim.size(); ++count) {
      const Vec3 area = area_of(rim, start, count);
      const Vec3 chord = place(rim[(start + count - 1) % rim.size()].to) - place(rim[start].from);
      // All on one line, so far: no plane of its own.
      if (length(area) <= reach_ * length(chord)) continue;
      if (!is_plane(rim, start, count, area)) {
        if (longest.count > 0) break;
        continue;
      }
      longest = {start, count, area};
      longest.chord = length(chord);
    }
    return longest;
  }

  [[nodiscard]] Run best_run(const HoleRim& rim) const {
    Run best;
    for (std::size_t start = 0; start < rim.size() && !work_.is_used_up(); ++start) {
      Run run = longest_from(rim, start);
      if (run.count == 0 || run.chord == 0 || is_part(rim, run) || folds_back(rim, run)) continue;
      judge_plane(rim, run);
      judge_beyond(rim, run);
      if (best.count == 0 || run.rank() > best.rank()) best = run;
    }
    return best;
  }

  /// Three runs one after the other that make up the rim; false if there are none.
  bool find_runs(const HoleRim& rim, std::size_t first, std::array<Run, 3>& runs) const {
    std::size_t count = 0;
    for (Run& run : runs) {
      run = longest_from(rim, (first + count) % rim.size());
      count += run.count;
      if (run.count == 0 || count > rim.size() || folds_back(rim, run)) return false;
    }
    return count == rim.size();
  }

  [[nodiscard]] std::optional<LostCorner> best_corner(const HoleRim& rim) const {
    std::optional<LostCorner> best;
    for (std::size_t first = 0; first < rim.size() && !work_.is_used_up(); ++first) {
      LostCorner corner;
      if (!find_runs(rim, first, corner.runs)) continue;
      const auto place = corner_of(rim, corner.runs);
      if (!place) continue;
      corner.place = *place;
      corner.is_known = true;
      corner.support = Box::kInfinity;
      for (Run& run : corner.runs) {
        judge_plane(rim, run);
        corner.is_known = corner.is_known && run.is_known;
        corner.support = std::min(corner.support, run.support);
      }
      if (!best || corner.rank() > best->rank()) best = corner;
    }
    return best;
  }

  /// Makes three pieces of a rim that goes round a lost corner.
  void take_corner(const HoleRim& rim, const LostCorner& corner) {
    const int point = static_cast<int>(soup_.points.size());
    soup_.points.push_back(exact::round_to_grid(corner.place, 1));
    for (const Run& run : corner.runs) add_corner_piece(rim, run, point);
  }

  /// Where the planes of the runs meet, if nothing of the rim is there.
  [[nodiscard]] std::optional<Vec3> corner_of(const HoleRim& rim,
                                              const std::array<Run, 3>& runs) const {
    std::array<Vec3, 3> normals;
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i) normals[i] = normalised(runs[i].area);
    const double volume = dot(normals[0], cross(normals[1], normals[2]));
    if (std::abs(volume) < std::sin(kSamePlane_rad)) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
      sum = sum + level_of(rim, runs[i].start, runs[i].count, normals[i]) *
                      cross(normals[(i + 1) % 3], normals[(i + 2) % 3]);
    const Vec3 corner = 1 / volume * sum;
    for (const HoleEdge& edge : rim)
      if (length(place(edge.from) - corner) <= reach_) return std::nullopt;
    return corner;
  }

  void add_corner_piece(const HoleRim& rim, const Run& run, int corner) {
    PlanePiece piece;
    for (std::size_t i = 0; i < run.count; ++i)
      piece.rim.push_back(rim[(run.start + i) % rim.size()]);
    const int from = piece.rim.front().from, to = piece.rim.back().to;
    const int beside = piece.rim.front().beside;
    piece.rim.push_back({to, corner, -1, beside});
    piece.rim.push_back({corner, from, -1, beside});
    piece.area = area_of(piece.rim, 0, piece.rim.size());
    pieces_.push_back(std::move(piece));
  }

  /// Makes a piece of a run; its chord stays in the rim.
  void take(HoleRim& rim, const Run& run) {
    std::ranges::rotate(rim, rim.begin() + static_cast<std::ptrdiff_t>(run.start));
    const auto end = rim.begin() + static_cast<std::ptrdiff_t>(run.count);
    PlanePiece piece{HoleRim(rim.begin(), end), run.area};
    const int from = rim.front().from, to = std::prev(end)->to, beside = rim.front().beside;
    piece.rim.push_back({to, from, -1, beside});
    pieces_.push_back(std::move(piece));
    rim.erase(rim.begin() + 1, end);
    rim.front() = {from, to, -1, beside};
  }

  Soup& soup_;
  std::span<const PolygonShape> shapes_;
  std::vector<HoleRim> rims_;
  double reach_;
  Work& work_;
  HoleRim all_;
  std::vector<PlanePiece> pieces_;
};

}  // namespace

std::optional<std::vector<PlanePiece>> cut_into_plane_pieces(Soup& soup,
                                                             std::span<const PolygonShape> shapes,
                                                             std::vector<HoleRim> rims,
                                                             double reach, Work& work) {
  return RimCutter(soup, shapes, std::move(rims), reach, work).run();
}

}  // namespace oriel::detail
