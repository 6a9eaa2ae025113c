#include "examples/cuts/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace oriel::cuts {
namespace {

/// Points of a ray that are nearer to each other, in metres, are one.
constexpr double kTogether = 1e-5;
/// Facets that are seen so much from the side, as a cosine, are not seen.
constexpr double kEdgeOn = 1e-3;

/// A facet of a piece in samples; depth grows towards the viewer and is a + b x + c y.
struct Projected {
  std::vector<std::vector<std::pair<double, double>>> loops;
  double a = 0, b = 0, c = 0;
  double top = 0, bottom = 0;
  /// What entering the facet adds to the sum of signs on a ray that leaves the viewer.
  int step = 0;
  bool is_part = false;
  Vec3 normal;
  double offset_m = 0;
};

struct Crossing {
  double depth = 0;
  const Projected* facet = nullptr;
};

class Scene {
 public:
  Scene(const Segmentation& s, const Camera& camera, const Window& window, int width, int height)
      : s_(s), camera_(camera), window_(window) {
    image_.width = width;
    image_.height = height;
    image_.labels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  }

  void add(const Piece& piece) {
    for (const Facet& facet : s_.cells[piece.cell.index()].facets) add(facet, piece);
  }

  Image draw() {
    for (int y = 0; y < image_.height; ++y) draw_row(y);
    return std::move(image_);
  }

 private:
  std::pair<double, double> to_samples(Vec3 p) const {
    return {(dot(p, camera_.right) - window_.x) * window_.scale + image_.width / 2.0,
            (window_.y - dot(p, camera_.up)) * window_.scale + image_.height / 2.0};
  }

  void add(const Facet& facet, const Piece& piece) {
    const Plane& plane = s_.planes[facet.plane.index()];
    const double facing = dot(plane.normal, camera_.towards);
    if (std::abs(facing) < kEdgeOn) return;
    Projected out;
    out.step = facing > 0 ? piece.sign : -piece.sign;
    out.is_part = piece.is_part;
    out.normal = facing > 0 ? plane.normal : -plane.normal;
    out.offset_m = facing > 0 ? plane.offset_m : -plane.offset_m;
    out.top = image_.height;
    for (const Loop& loop : facet.loops) {
      auto& ring = out.loops.emplace_back();
      for (const int v : loop) {
        ring.push_back(to_samples(s_.vertices[static_cast<std::size_t>(v)].point));
        out.top = std::min(out.top, ring.back().second);
        out.bottom = std::max(out.bottom, ring.back().second);
      }
    }
    // A point of the plane is depth · towards + its place in the projection.
    const double u = dot(plane.normal, camera_.right), v = dot(plane.normal, camera_.up);
    out.b = -u / facing / window_.scale;
    out.c = v / facing / window_.scale;
    out.a = (plane.offset_m - u * window_.x - v * window_.y) / facing - out.b * image_.width / 2.0 -
            out.c * image_.height / 2.0;
    facets_.push_back(std::move(out));
  }

  void draw_row(int row) {
    const double y = row + 0.5;
    std::vector<std::vector<Crossing>> rays(static_cast<std::size_t>(image_.width));
    for (const Projected& facet : facets_)
      if (facet.top <= y && y < facet.bottom) cross_row(facet, y, rays);
    for (int x = 0; x < image_.width; ++x)
      image_.labels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
                    static_cast<std::size_t>(x)] = seen(rays[static_cast<std::size_t>(x)]);
  }

  void cross_row(const Projected& facet, double y, std::vector<std::vector<Crossing>>& rays) const {
    std::vector<double> ends;
    for (const auto& loop : facet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        auto p = loop[i], q = loop[(i + 1) % loop.size()];
        if ((p.second <= y) == (q.second <= y)) continue;
        if (q < p) std::swap(p, q);  // the same from both sides of an edge
        ends.push_back(p.first + (y - p.second) / (q.second - p.second) * (q.first - p.first));
      }
    std::ranges::sort(ends);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      const int first = std::max(0, static_cast<int>(std::ceil(ends[i] - 0.5)));
      const int last = std::min(image_.width, static_cast<int>(std::ceil(ends[i + 1] - 0.5)));
      for (int x = first; x < last; ++x)
        rays[static_cast<std::size_t>(x)].push_back(
            {facet.a + facet.b * (x + 0.5) + facet.c * y, &facet});
    }
  }

  /// The label of what a ray meets first.
  int seen(std::vector<Crossing>& ray) {
    std::ranges::sort(ray, std::greater{}, &Crossing::depth);
    int sum = 0, parts = 0;
    for (std::size_t i = 0; i < ray.size();) {
      const int sum_before = sum, parts_before = parts;
      const double depth = ray[i].depth;
      const Projected* entered = nullptr;
      for (; i < ray.size() && ray[i].depth > depth - kTogether; ++i) {
        const Projected& facet = *ray[i].facet;
        sum += facet.step;
        if (facet.is_part) parts += facet.step;
        if (facet.step > 0 && (entered == nullptr || facet.is_part)) entered = &facet;
      }
      if (sum_before <= 0 && sum > 0 && entered != nullptr)
        return label_of(*entered, parts > 0 || parts_before < 0);
    }
    return 0;
  }

  int label_of(const Projected& facet, bool is_part) {
    const auto key = [](double value) { return std::llround(value * 1e3); };
    const std::array<long long, 5> plane{key(facet.normal.x), key(facet.normal.y),
                                         key(facet.normal.z), key(facet.offset_m), is_part};
    const auto [at, is_new] = numbers_.try_emplace(plane, std::ssize(image_.surfaces) + 1);
    if (is_new) image_.surfaces.push_back({facet.normal, facet.offset_m, is_part});
    return static_cast<int>(at->second);
  }

  const Segmentation& s_;
  const Camera& camera_;
  const Window& window_;
  std::vector<Projected> facets_;
  std::map<std::array<long long, 5>, std::ptrdiff_t> numbers_;
  Image image_;
};

}  // namespace

Camera camera(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * std::numbers::pi / 180, e = elevation_deg * std::numbers::pi / 180;
  const double ca = std::cos(a), sa = std::sin(a), ce = std::cos(e), se = std::sin(e);
  return {{ca, sa, 0}, {-sa * se, ca * se, ce}, {sa * ce, -ca * ce, se}};
}

Box extent_of(const Segmentation& segmentation, const std::vector<Piece>& pieces,
              const Camera& camera) {
  Box box;
  for (const Piece& piece : pieces)
    for (const Facet& facet : segmentation.cells[piece.cell.index()].facets)
      for (const int v : facet.loops.front()) {
        const Vec3 p = segmentation.vertices[static_cast<std::size_t>(v)].point;
        box.grow(Vec3{dot(p, camera.right), dot(p, camera.up), 0});
      }
  return box;
}

Image view(const Segmentation& segmentation, const std::vector<Piece>& pieces, const Camera& camera,
           const Window& window, int width, int height) {
  Scene scene(segmentation, camera, window, width, height);
  for (const Piece& piece : pieces) scene.add(piece);
  return scene.draw();
}

}  // namespace oriel::cuts
