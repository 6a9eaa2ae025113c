#include "examples/cuts/svg.h"

#include "examples/cuts/outlines.h"
#include "examples/cuts/shot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace oriel::cuts {
namespace {

constexpr int kColumns = 4, kText = 56, kMargin = 8;
/// Samples by which a line may be smoothed: somewhat more than their steps.
constexpr double kTolerance = 1.5;

using Colour = std::array<double, 3>;
constexpr Colour kRest{246, 240, 228}, kProtrusion{250, 146, 66}, kHole{104, 178, 240};

std::string colour_of(const Surface& surface, const Camera& eye, bool is_hole) {
  const Vec3 light = normalised(-0.45 * eye.right + 0.5 * eye.towards + 0.75 * eye.up);
  const double shade = 0.72 + 0.28 * std::max(0.0, dot(surface.normal, light));
  const Colour& base = !surface.is_part ? kRest : is_hole ? kHole : kProtrusion;
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(shade * base[0]),
                     std::lround(shade * base[1]), std::lround(shade * base[2]));
}

std::string path_of(const std::vector<Outline>& outlines) {
  std::string path;
  for (const Outline& outline : outlines) {
    Corner last = outline.front();
    path += fmt::format("M{} {}", last.first, last.second);
    for (std::size_t i = 1; i < outline.size(); ++i) {
      path += fmt::format("l{} {}", outline[i].first - last.first, outline[i].second - last.second);
      last = outline[i];
    }
    path += 'z';
  }
  return path;
}

std::string paths_of(const Image& image, const Camera& eye, bool is_hole) {
  std::string out = fmt::format("<g transform=\"scale({})\" class=\"p\">\n", 1.0 / kFiner);
  const auto lines = outlines(image, kTolerance);
  for (std::size_t label = 1; label < lines.size(); ++label)
    if (!lines[label].empty())
      out += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n",
                         colour_of(image.surfaces[label - 1], eye, is_hole), path_of(lines[label]));
  return out + "</g>\n";
}

std::string picture_of(const Shot& shot, bool is_hole) {
  std::string out = paths_of(shot.image, shot.eye, is_hole);
  if (!shot.loupe) return out;
  out += fmt::format(
      "<g transform=\"translate({0},0)\">\n<rect width=\"{1}\" height=\"{1}\" class=\"l\"/>\n",
      kPictureWidth - kLoupe, kLoupe);
  return out + paths_of(*shot.loupe, shot.eye, is_hole) + "</g>\n";
}

/// "+x = 4.00" along an axis, else "(0, -0.6, 0.8) = 4.80".
std::string text_of(const Plane& plane) {
  const std::array<double, 3> n{plane.normal.x, plane.normal.y, plane.normal.z};
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(n[i]) > 1 - 1e-9)
      return fmt::format("{}{} = {:.2f}", n[i] > 0 ? '+' : '-', "xyz"[i],
                         n[i] * plane.offset_m + 0.0);
  return fmt::format("({:.2g}, {:.2g}, {:.2g}) = {:.2f}", n[0] + 0.0, n[1] + 0.0, n[2] + 0.0,
                     plane.offset_m);
}

/// Two to a line.
std::array<std::string, 2> planes_of(const Segmentation& s, const CsgNode& node) {
  std::array<std::string, 2> out;
  for (std::size_t i = 0; i < node.planes.size(); ++i)
    out.at(i / 2) += (i % 2 == 0 ? "" : "; ") + text_of(s.planes[node.planes[i].index()]);
  return out;
}

/// The lines under a panel.
std::array<std::string, 4> caption_of(const Segmentation& s, const Step& step, int number,
                                      const Shot& shot) {
  const CsgNode& node = s.nodes[step.node.index()];
  const std::string body = step.from < 0  ? "the building"
                           : step.is_part ? fmt::format("a part of {}", step.from + 1)
                                          : fmt::format("the rest of {}", step.from + 1);
  if (node.kind == CsgNode::Kind::leaf)
    return {fmt::format("{}. {}", number, body),
            fmt::format("a leaf: {}", to_string(s.cells[node.cell.index()].flag)), "", ""};
  const std::string what = fmt::format("{} {}{}", node.parts.size(),
                                       node.kind == CsgNode::Kind::subtract ? "hole" : "protrusion",
                                       node.parts.size() == 1 ? "" : "s");
  const double v = node.quality.value_or(0), value = node.value.value_or(v);
  const auto planes = planes_of(s, node);
  return {fmt::format("{}. {}, from {}", number, body, shot.side),
          fmt::format("{}, k = {}, v = {:.4f}", what, node.planes.size(), v) +
              (std::abs(value - v) > 1e-9 ? fmt::format(", value {:.4f}", value) : ""),
          planes[0], planes[1]};
}

std::string panel(const Segmentation& s, const Step& step, int number, double scale) {
  const std::vector<Piece> pieces = pieces_of(s, step.node);
  const Shot shot = best_shot(s, pieces, step.is_in_part ? scale_of(s, pieces) : scale);
  const bool is_hole = s.nodes[step.node.index()].kind == CsgNode::Kind::subtract;
  const int x = (number - 1) % kColumns * (kPictureWidth + kMargin) + kMargin;
  const int y = (number - 1) / kColumns * (kPictureHeight + kText + kMargin) + kMargin;
  std::string out = fmt::format("<g transform=\"translate({},{})\">\n", x, y);
  out += picture_of(shot, is_hole);
  const auto caption = caption_of(s, step, number, shot);
  for (std::size_t i = 0; i < caption.size(); ++i)
    if (!caption[i].empty())
      out += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", kPictureWidth / 2,
                         kPictureHeight + 12 + 13 * i, i == 0 ? " class=\"b\"" : "", caption[i]);
  return out + "</g>\n";
}

}  // namespace

std::string draw_cuts(const Segmentation& segmentation) {
  const std::vector<Step> steps = steps_of(segmentation);
  const int rows = (static_cast<int>(steps.size()) + kColumns - 1) / kColumns;
  const int width = kColumns * (kPictureWidth + kMargin) + kMargin;
  const int height = rows * (kPictureHeight + kText + kMargin) + kMargin;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">\n<style>.p{{stroke:#444;stroke-width:2.4;stroke-linejoin:round;fill-rule:evenodd}}"
      "text{{font:10.5px sans-serif;text-anchor:middle}}.b{{font-weight:bold}}"
      ".l{{fill:#fff;stroke:#999}}</style>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      width, height);
  const double scale = scale_of(segmentation, pieces_of(segmentation, segmentation.root));
  for (std::size_t i = 0; i < steps.size(); ++i)
    out += panel(segmentation, steps[i], static_cast<int>(i) + 1, scale);
  return out + "</svg>\n";
}

}  // namespace oriel::cuts
