#include "io/picture/raster.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>

namespace oriel::detail {

namespace {

/// Samples of a pixel, in each direction.
constexpr int kFiner = 3;
constexpr int kBand_px = 64;
/// What the lines of a band need of the next one, in samples.
constexpr int kReach = kFiner + 1;
/// Planes that differ by less have no edge: about 2.5 degrees.
constexpr double kSamePlane = 0.999;
/// A step in depth that is drawn as a line where faces are parallel.
constexpr double kStep_m = 0.02;

enum class LineKind : std::uint8_t { none, edge, silhouette, mark };

/// A line at a sample: of two the one whose kind is greater is seen.
struct SampleLine {
  LineKind kind = LineKind::none;
  Colour colour = kLineColour;

  friend auto operator<=>(const SampleLine&, const SampleLine&) = default;
};

/// Half the width of a line, in samples.
int reach_of(LineKind kind) {
  switch (kind) {
    case LineKind::none:
      return -1;
    case LineKind::edge:
      return 0;
    case LineKind::silhouette:
      return 1;
    case LineKind::mark:
      return 3;
  }
  return -1;
}

/// The samples of some rows of a raster, from `top` on.
class Band {
 public:
  Band(std::span<const PictureFace> faces, int width, int top, int rows)
      : faces_(faces), width_(width), top_(top), rows_(rows) {
    nearness_.assign(cells(), -std::numeric_limits<float>::infinity());
    face_at_.assign(cells(), -1);
    for (std::size_t f = 0; f < faces.size(); ++f) fill(static_cast<int>(f));
  }

  [[nodiscard]] int face_at(int x, int y) const {
    return x < 0 || y < top_ || x >= width_ || y >= top_ + rows_ ? -1 : face_at_[cell(x, y)];
  }

  /// What separates a sample from the one right of it or below.
  [[nodiscard]] SampleLine between(int x, int y, int other_x, int other_y) const {
    const int p = face_at(x, y), q = face_at(other_x, other_y);
    if (p == q) return {};
    if (p < 0 || q < 0) return {LineKind::silhouette};
    const PictureFace &a = faces_[at(p)], &b = faces_[at(q)];
    if (a.feature != b.feature && (a.mark || b.mark))
      return {LineKind::mark, a.mark ? *a.mark : *b.mark};
    const bool is_one_plane = dot(a.normal, b.normal) > kSamePlane &&
                              std::abs(nearness_[cell(x, y)] - nearness_[cell(other_x, other_y)]) <
                                  kStep_m + std::abs(a.near[1]) + std::abs(a.near[2]);
    if (is_one_plane && (a.feature == b.feature || (!a.is_part && !b.is_part))) return {};
    return {LineKind::edge};
  }

 private:
  [[nodiscard]] std::size_t cells() const { return at(width_) * at(rows_); }
  [[nodiscard]] std::size_t cell(int x, int y) const { return at(y - top_) * at(width_) + at(x); }

  /// Samples lie in the middles of squares, of which kFiner make a pixel's side.
  void fill(int face) {
    const PictureFace& of = faces_[at(face)];
    const int first = std::max(top_, static_cast<int>(std::ceil(of.top * kFiner - 0.5)));
    const int last =
        std::min(top_ + rows_ - 1, static_cast<int>(std::floor(of.bottom * kFiner - 0.5)));
    for (int y = first; y <= last; ++y) {
      crossings_.clear();
      for (const PictureRing& ring : of.rings) add_crossings(ring, (y + 0.5) / kFiner);
      std::ranges::sort(crossings_);
      for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2)
        fill_row(face, y, crossings_[i], crossings_[i + 1]);
    }
  }

  void add_crossings(const PictureRing& ring, double y) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PicturePoint p = ring[i], q = ring[(i + 1) % ring.size()];
      if ((p.y <= y) == (q.y <= y)) continue;
      crossings_.push_back(p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x));
    }
  }

  void fill_row(int face, int y, double from, double to) {
    const PictureFace& of = faces_[at(face)];
    const int first = std::max(0, static_cast<int>(std::ceil(from * kFiner - 0.5)));
    const int last = std::min(width_ - 1, static_cast<int>(std::ceil(to * kFiner - 0.5)) - 1);
    for (int x = first; x <= last; ++x) {
      const double nearness = of.nearness((x + 0.5) / kFiner, (y + 0.5) / kFiner);
      const std::size_t i = cell(x, y);
      if (nearness < nearness_[i] - kSameDepth_m) continue;
      // In one plane a part is seen before what it lies in.
      const bool is_as_near = nearness < nearness_[i] + kSameDepth_m;
      if (is_as_near && face_at_[i] >= 0 && faces_[at(face_at_[i])].is_part && !of.is_part)
        continue;
      nearness_[i] = static_cast<float>(nearness);
      face_at_[i] = face;
    }
  }

  std::span<const PictureFace> faces_;
  int width_, top_, rows_;
  std::vector<float> nearness_;
  std::vector<int> face_at_;
  std::vector<double> crossings_;
};

/// The lines of a band, sample by sample.
class Lines {
 public:
  Lines(const Band& band, int width, int top, int rows)
      : width_(width), top_(top), rows_(rows), lines_(at(width) * at(rows)) {
    for (int y = top - kReach; y < top + rows + kReach; ++y)
      for (int x = 0; x < width; ++x) {
        put(x, y, band.between(x, y, x + 1, y));
        put(x, y, band.between(x, y, x, y + 1));
        if (x == 0) put(0, y, band.between(-1, y, 0, y));
      }
  }

  [[nodiscard]] const SampleLine& at_sample(int x, int y) const {
    return lines_[at(y - top_) * at(width_) + at(x)];
  }

 private:
  void put(int x, int y, const SampleLine& line) {
    const int reach = reach_of(line.kind);
    for (int v = std::max(top_, y - reach); v <= std::min(top_ + rows_ - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(width_ - 1, x + reach); ++u) {
        SampleLine& there = lines_[at(v - top_) * at(width_) + at(u)];
        there = std::max(there, line);
      }
  }

  int width_, top_, rows_;
  std::vector<SampleLine> lines_;
};

/// The mean of a pixel's samples over what the raster has there.
void mix_pixel(std::span<const PictureFace> faces, const Band& band, const Lines& lines, int x,
               int y, std::array<std::uint8_t, 4>& pixel) {
  std::array<int, 3> sum{};
  int seen = 0;
  for (int v = y * kFiner; v < (y + 1) * kFiner; ++v)
    for (int u = x * kFiner; u < (x + 1) * kFiner; ++u) {
      const SampleLine& line = lines.at_sample(u, v);
      const int face = band.face_at(u, v);
      if (line.kind == LineKind::none && face < 0) continue;
      const Colour& colour = line.kind == LineKind::none ? faces[at(face)].shaded : line.colour;
      for (std::size_t i = 0; i < 3; ++i) sum[i] += colour[i];
      ++seen;
    }
  if (seen == 0) return;
  constexpr int kAll = kFiner * kFiner;
  const int under = pixel[3] * (kAll - seen);  // opacity, of 255 × kAll
  const int weight = 255 * seen + under;
  for (std::size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<std::uint8_t>((255 * sum[i] + under * pixel[i] + weight / 2) / weight);
  pixel[3] = static_cast<std::uint8_t>((weight + kAll / 2) / kAll);
}

}  // namespace

void draw_faces(std::span<const PictureFace> faces, const PictureBox& within, Raster& raster) {
  const int left = std::max(0, static_cast<int>(within.left));
  const int right = std::min(raster.width, static_cast<int>(within.left + within.width));
  const int end = std::min(raster.height, static_cast<int>(within.top + within.height));
  for (int top = std::max(0, static_cast<int>(within.top)); top < end; top += kBand_px) {
    const int rows = std::min(kBand_px, end - top);
    const Band band(faces, raster.width * kFiner, top * kFiner - kReach,
                    rows * kFiner + 2 * kReach);
    const Lines lines(band, raster.width * kFiner, top * kFiner, rows * kFiner);
    for (int y = top; y < top + rows; ++y)
      for (int x = left; x < right; ++x)
        mix_pixel(faces, band, lines, x, y, raster.pixels[at(y) * at(raster.width) + at(x)]);
  }
}

std::vector<double> seen_pixels(std::span<const PictureFace> faces, int width, int height) {
  std::vector<double> seen(faces.size());
  const Band band(faces, width * kFiner, 0, height * kFiner);
  for (int y = 0; y < height * kFiner; ++y)
    for (int x = 0; x < width * kFiner; ++x)
      if (const int face = band.face_at(x, y); face >= 0) seen[at(face)] += 1.0 / (kFiner * kFiner);
  return seen;
}

}  // namespace oriel::detail
