#include "examples/cuts/shot.h"

#include <algorithm>
#include <utility>

namespace oriel::cuts {
namespace {

constexpr double kElevation = 24;
/// Share of the picture that a body fills, of the loupe that the parts fill, and of the picture's
/// height below which parts need a loupe.
constexpr double kFilled = 0.94, kFilledLoupe = 0.6, kSmall = 0.14;

struct Side {
  double azimuth_deg;
  const char* name;
};
constexpr std::array<Side, 4> kSides{
    {{32, "front right"}, {-32, "front left"}, {148, "back right"}, {-148, "back left"}}};

Window window_on(const Box& box, double scale) {
  return {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, scale};
}

Shot shoot(const Segmentation& s, const std::vector<Piece>& pieces, const Side& side,
           double scale) {
  Shot shot{side.name, camera(side.azimuth_deg, kElevation), {}, {}};
  shot.image = view(s, pieces, shot.eye, window_on(extent_of(s, pieces, shot.eye), scale),
                    kPictureWidth * kFiner, kPictureHeight * kFiner);
  return shot;
}

long part_samples(const Image& image) {
  return std::ranges::count_if(image.labels, [&](int label) {
    return label > 0 && image.surfaces[static_cast<std::size_t>(label) - 1].is_part;
  });
}

std::optional<Image> loupe_of(const Segmentation& s, const std::vector<Piece>& pieces,
                              const Camera& eye, double scale) {
  std::vector<Piece> parts;
  std::ranges::copy_if(pieces, std::back_inserter(parts), &Piece::is_part);
  if (parts.empty()) return std::nullopt;
  const Box box = extent_of(s, parts, eye);
  const double size = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  if (size * scale > kSmall * kPictureHeight * kFiner) return std::nullopt;
  constexpr int samples = kLoupe * kFiner;
  return view(s, pieces, eye, window_on(box, kFilledLoupe * samples / size), samples, samples);
}

}  // namespace

double scale_of(const Segmentation& segmentation, const std::vector<Piece>& pieces) {
  double scale = 1e9;
  for (const Side& side : kSides) {
    const Box box = extent_of(segmentation, pieces, camera(side.azimuth_deg, kElevation));
    scale = std::min({scale, kFilled * kPictureWidth * kFiner / (box.max.x - box.min.x),
                      kFilled * kPictureHeight * kFiner / (box.max.y - box.min.y)});
  }
  return scale;
}

Shot best_shot(const Segmentation& segmentation, const std::vector<Piece>& pieces, double scale) {
  Shot best = shoot(segmentation, pieces, kSides[0], scale);
  long most = part_samples(best.image);
  for (std::size_t i = 1; i < kSides.size(); ++i) {
    Shot shot = shoot(segmentation, pieces, kSides[i], scale);
    const long samples = part_samples(shot.image);
    if (samples <= most * 5 / 4) continue;
    most = samples;
    best = std::move(shot);
  }
  best.loupe = loupe_of(segmentation, pieces, best.eye, scale);
  return best;
}

}  // namespace oriel::cuts
