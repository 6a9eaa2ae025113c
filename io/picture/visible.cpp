#include "io/picture/visible.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <polyclipping/clipper.hpp>

namespace oriel::detail {

namespace {

constexpr double kSteps = 1024;
/// Spikes that are thinner, in pixels, come of rounding.
constexpr double kThinnest_px = 0.05;

ClipperLib::Paths paths_of(const PictureFace& face) {
  ClipperLib::Paths paths;
  for (const PictureRing& ring : face.rings) {
    ClipperLib::Path& path = paths.emplace_back();
    for (const PicturePoint p : ring)
      path.emplace_back(std::llround(p.x * kSteps), std::llround(p.y * kSteps));
  }
  return paths;
}

ClipperLib::Paths combined(ClipperLib::ClipType how, const ClipperLib::Paths& subject,
                           const ClipperLib::Paths& clip) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(subject, ClipperLib::ptSubject, true);
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  ClipperLib::Paths out;
  clipper.Execute(how, out, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
  return out;
}

/// The part of the box of a face where `excess` (as PictureFace::near) is positive.
ClipperLib::Paths half_of(const PictureFace& face, const std::array<double, 3>& excess) {
  const std::array<PicturePoint, 4> corners{
      PicturePoint{face.left - 1, face.top - 1}, PicturePoint{face.right + 1, face.top - 1},
      PicturePoint{face.right + 1, face.bottom + 1}, PicturePoint{face.left - 1, face.bottom + 1}};
  const auto value = [&](PicturePoint p) { return excess[0] + excess[1] * p.x + excess[2] * p.y; };
  ClipperLib::Path path;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PicturePoint p = corners[i], q = corners[(i + 1) % corners.size()];
    const double at_p = value(p), at_q = value(q);
    if (at_p > 0) path.emplace_back(std::llround(p.x * kSteps), std::llround(p.y * kSteps));
    if ((at_p > 0) == (at_q > 0)) continue;
    const double t = at_p / (at_p - at_q);
    path.emplace_back(std::llround((p.x + t * (q.x - p.x)) * kSteps),
                      std::llround((p.y + t * (q.y - p.y)) * kSteps));
  }
  return path.size() < 3 ? ClipperLib::Paths{} : ClipperLib::Paths{path};
}

/// Of the ring's points the least and the greatest excess of `other` over `face`.
std::array<double, 2> excess_over(const ClipperLib::Paths& where, const PictureFace& face,
                                  const PictureFace& other) {
  std::array<double, 2> range{1e30, -1e30};
  for (const ClipperLib::Path& path : where)
    for (const ClipperLib::IntPoint& p : path) {
      const double x = static_cast<double>(p.X) / kSteps, y = static_cast<double>(p.Y) / kSteps;
      const double excess = other.nearness(x, y) - face.nearness(x, y);
      range[0] = std::min(range[0], excess);
      range[1] = std::max(range[1], excess);
    }
  return range;
}

bool boxes_meet(const PictureFace& p, const PictureFace& q) {
  return p.left < q.right && q.left < p.right && p.top < q.bottom && q.top < p.bottom;
}

/// Faces by the squares of the picture that their boxes meet.
class FaceGrid {
 public:
  explicit FaceGrid(std::span<const PictureFace> faces) : squares_(kSide * kSide) {
    for (const PictureFace& face : faces) {
      right_ = std::max(right_, face.right);
      bottom_ = std::max(bottom_, face.bottom);
    }
    for (std::size_t i = 0; i < faces.size(); ++i)
      for_each_square(faces[i], [&](std::size_t square) { squares_[square].push_back(i); });
  }

  /// Those that share a square with a face, ascending.
  [[nodiscard]] std::vector<std::size_t> near(const PictureFace& face) const {
    std::vector<std::size_t> found;
    for_each_square(face, [&](std::size_t square) {
      found.insert(found.end(), squares_[square].begin(), squares_[square].end());
    });
    std::ranges::sort(found);
    const auto rest = std::ranges::unique(found);
    found.erase(rest.begin(), rest.end());
    return found;
  }

 private:
  static constexpr std::size_t kSide = 128;

  static std::size_t step(double value, double most) {
    const double share = std::clamp(value / std::max(most, 1.0), 0.0, 1.0);
    return std::min(kSide - 1, static_cast<std::size_t>(share * kSide));
  }

  template <class Visit>
  void for_each_square(const PictureFace& face, Visit visit) const {
    for (std::size_t y = step(face.top, bottom_); y <= step(face.bottom, bottom_); ++y)
      for (std::size_t x = step(face.left, right_); x <= step(face.right, right_); ++x)
        visit(y * kSide + x);
  }

  double right_ = 0, bottom_ = 0;
  std::vector<std::vector<std::size_t>> squares_;
};

/// What `other` hides of `face`, of what is left of it.
ClipperLib::Paths hidden_by(const PictureFace& face, const ClipperLib::Paths& left,
                            const PictureFace& other, const ClipperLib::Paths& paths,
                            bool is_later) {
  ClipperLib::Paths common = combined(ClipperLib::ctIntersection, left, paths);
  if (common.empty()) return common;
  const auto [least, most] = excess_over(common, face, other);
  if (most <= kSameDepth_m && least >= -kSameDepth_m) {  // in one plane
    const bool is_before = other.is_part == face.is_part ? is_later : other.is_part;
    return is_before ? common : ClipperLib::Paths{};
  }
  if (most <= kSameDepth_m) return {};
  if (least >= -kSameDepth_m) return common;
  const std::array<double, 3> excess{other.near[0] - face.near[0], other.near[1] - face.near[1],
                                     other.near[2] - face.near[2]};
  return combined(ClipperLib::ctIntersection, common, half_of(face, excess));
}

}  // namespace

std::vector<std::vector<PictureRing>> visible_rings(std::span<const PictureFace> faces) {
  std::vector<ClipperLib::Paths> paths;
  for (const PictureFace& face : faces) paths.push_back(paths_of(face));
  const FaceGrid grid(faces);
  std::vector<std::vector<PictureRing>> visible(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    ClipperLib::Paths left = combined(ClipperLib::ctUnion, paths[i], {});
    for (const std::size_t j : grid.near(faces[i])) {
      if (left.empty()) break;
      if (i == j || !boxes_meet(faces[i], faces[j])) continue;
      const ClipperLib::Paths hidden = hidden_by(faces[i], left, faces[j], paths[j], j > i);
      if (!hidden.empty()) left = combined(ClipperLib::ctDifference, left, hidden);
    }
    ClipperLib::CleanPolygons(left, kThinnest_px * kSteps);
    for (const ClipperLib::Path& path : left) {
      if (path.size() < 3) continue;
      PictureRing& ring = visible[i].emplace_back();
      for (const ClipperLib::IntPoint& p : path)
        ring.push_back({static_cast<double>(p.X) / kSteps, static_cast<double>(p.Y) / kSteps});
    }
  }
  return visible;
}

double area_px(std::span<const PictureRing> rings) {
  double doubled = 0;
  for (const PictureRing& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PicturePoint p = ring[i], q = ring[(i + 1) % ring.size()];
      doubled += p.x * q.y - q.x * p.y;
    }
  return std::abs(doubled) / 2;
}

}  // namespace oriel::detail
