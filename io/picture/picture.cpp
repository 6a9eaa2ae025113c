#include "io/picture/picture.h"

#include "io/picture/drawing.h"
#include "io/picture/furniture.h"
#include "io/picture/visible.h"
#include "kernel/base/index.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace oriel {

namespace {

using namespace detail;

/// Buildings that are farther apart cannot be seen in one picture: a town is.
constexpr double kMostApart_m = 20'000;
constexpr double kMargin_px = 12, kCaption_px = 26, kCaptionText_px = 14;

/// A panel in its place, with what can be seen of it.
struct PlacedPanel {
  const PicturePanel* panel = nullptr;
  Placing placing;
  std::vector<PictureFace> faces{};
  std::set<int> marked{};
  /// It stands in the corner of another one: without caption and bar.
  bool is_inset = false;
};

std::size_t columns_for(std::size_t panels, const PictureOptions& options) {
  panels = std::max<std::size_t>(1, panels);
  if (options.columns > 0) return std::min(panels, at(options.columns));
  // As square as the picture lets them be.
  const double wanted =
      std::sqrt(static_cast<double>(panels) * options.width_px / std::max(1, options.height_px));
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(wanted)), 1, panels);
}

std::vector<PictureBox> boxes_for(std::size_t panels, const PictureBox& within,
                                  const PictureOptions& options, double caption_px) {
  const std::size_t columns = columns_for(panels, options);
  const std::size_t rows = (panels + columns - 1) / columns;
  const double width = within.width / static_cast<double>(columns),
               height = within.height / static_cast<double>(rows);
  std::vector<PictureBox> boxes;
  for (std::size_t i = 0; i < panels; ++i)
    boxes.push_back({within.left + static_cast<double>(i % columns) * width,
                     within.top + static_cast<double>(i / columns) * height, width,
                     std::max(1.0, height - caption_px)});
  return boxes;
}

/// Gives panels of one frame the scale and the middle of the one that is largest.
void share_frames(std::vector<PlacedPanel>& panels) {
  std::map<int, Placing> largest;
  for (const PlacedPanel& panel : panels) {
    const auto [found, is_new] = largest.try_emplace(panel.panel->frame, panel.placing);
    if (!is_new && panel.placing.pixels_per_m < found->second.pixels_per_m)
      found->second = panel.placing;
  }
  for (PlacedPanel& panel : panels) {
    if (panel.panel->frame < 0) continue;
    const Placing& shared = largest.at(panel.panel->frame);
    panel.placing.pixels_per_m = shared.pixels_per_m;
    panel.placing.middle = shared.middle;
  }
}

/// Finds the first panel of the frame of each panel.
std::vector<std::size_t> firsts_of_frames(const std::vector<PicturePanel>& panels) {
  std::map<int, std::size_t> first_of;
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < panels.size(); ++i)
    firsts.push_back(panels[i].frame < 0 ? i
                                         : first_of.try_emplace(panels[i].frame, i).first->second);
  return firsts;
}

/// Measures what the frame of each panel shows, by the frame's first panel.
std::vector<Box> boxes_of_frames(const std::vector<PicturePanel>& panels,
                                 const std::vector<std::size_t>& firsts) {
  std::vector<Box> boxes(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i)
    for (const Vec3 point : panels[i].mesh.points) boxes[firsts[i]].grow(point);
  return boxes;
}

std::set<int> marked_of(const PicturePanel& panel) {
  std::set<int> marked{};
  for (std::size_t i = 0; i < panel.mesh.features.size(); ++i)
    if (std::ranges::binary_search(
            panel.marked, std::pair(panel.mesh.features[i].building, panel.mesh.features[i].id)))
      marked.insert(static_cast<int>(i));
  return marked;
}

/// The classes of all panels. Features are counted if each is in one panel only, seen or not.
SeenClasses classes_of(const std::vector<PicturePanel>& panels) {
  const bool counts =
      std::ranges::all_of(panels, [](const PicturePanel& panel) { return panel.frame < 0; });
  SeenClasses classes;
  for (const PicturePanel& panel : panels) {
    std::set<int> features;
    for (const MeshPolygon& polygon : panel.mesh.polygons) features.insert(polygon.feature);
    for (const int feature : features)
      classes[feature < 0 ? std::string() : panel.mesh.features[at(feature)].label] +=
          counts ? 1 : 0;
  }
  return classes;
}

/// The parts of a panel that are seen.
void append_parts(const PlacedPanel& placed, std::vector<PictureGroup>& groups) {
  const auto visible = visible_rings(placed.faces);
  std::map<int, PictureGroup> parts;
  for (std::size_t f = 0; f < placed.faces.size(); ++f) {
    if (visible[f].empty()) continue;
    const PictureFace& face = placed.faces[f];
    const bool is_marked = placed.marked.contains(face.feature);
    PictureGroup& part = parts[face.feature];
    part.shapes.push_back({.rings = visible[f],
                           .fill = face.shaded,
                           .line = is_marked ? kMarkColour : kLineColour,
                           .line_px = is_marked ? 2.0 : 0.6});
  }
  for (auto& [feature, part] : parts) {
    if (feature >= 0) {
      const MeshFeature& of = placed.panel->mesh.features[at(feature)];
      part.id = of.id.empty() ? std::string() : of.building + "_" + of.id;
      part.label = of.label;
    }
    groups.push_back(std::move(part));
  }
}

/// Writes a caption below its panel; a long one in small letters.
PictureGroup caption(const PlacedPanel& placed, const PictureTheme& theme) {
  const PictureBox& box = placed.placing.box;
  const std::string text = printable(placed.panel->caption);
  const double fitting_px = box.width / (kLetter * static_cast<double>(text.size()));
  return {.texts = {{.at = {box.left + box.width / 2, box.top + box.height + kCaptionText_px + 4},
                     .text = text,
                     .size_px = std::min(kCaptionText_px, fitting_px),
                     .anchor = TextAnchor::middle,
                     .colour = theme.ink}}};
}

Issue picture_issue(Code code, std::string sentence) {
  Issue issue;
  issue.code = code;
  issue.sentence = std::move(sentence);
  return issue;
}

/// The same panel in the corner of its box, as large as on the map; none where that is no smaller
/// than the panel's half.
std::optional<PlacedPanel> inset_of(const PlacedPanel& placed, double dpi) {
  constexpr double kInch_m = 0.0254, kRoom_px = 6;
  PlacedPanel inset{.panel = placed.panel, .placing = placed.placing, .is_inset = true};
  inset.placing.pixels_per_m = dpi / kInch_m / placed.panel->map_scale;
  const auto [width_m, height_m] = placed.placing.size_m;
  inset.placing.box = {placed.placing.box.left, placed.placing.box.top,
                       width_m * inset.placing.pixels_per_m + kRoom_px,
                       height_m * inset.placing.pixels_per_m + kRoom_px};
  if (2 * inset.placing.pixels_per_m > placed.placing.pixels_per_m) return std::nullopt;
  return inset;
}

/// The panels in their places; none where a facade that was asked for is not there.
Checked<std::vector<PlacedPanel>> placed_panels(const std::vector<PicturePanel>& panels,
                                                const std::vector<PictureBox>& boxes,
                                                const PictureOptions& options) {
  std::vector<PlacedPanel> placed;
  std::vector<Camera> cameras;
  const std::vector<std::size_t> firsts = firsts_of_frames(panels);
  const std::vector<Box> shown = boxes_of_frames(panels, firsts);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Box& box = shown[firsts[i]];
    const Vec3 origin = box.is_empty() ? Vec3{} : box.min, size = box.max - origin;
    if (const double apart_m = std::max(size.x, size.y); apart_m > kMostApart_m)
      return {std::nullopt,
              {picture_issue(Code::E163,
                             fmt::format("the buildings lie over {:.0f} km: in one picture none "
                                         "would be seen; --grid gives each its own panel",
                                         apart_m / 1000))}};
    const auto camera = camera_of(panels[firsts[i]].mesh, options);
    if (!camera)
      return {std::nullopt,
              {picture_issue(Code::E170, fmt::format("no wall looks within 45 degrees of {:g}, "
                                                     "clockwise from north",
                                                     options.azimuth_deg))}};
    cameras.push_back(*camera);
    placed.push_back({.panel = &panels[i],
                      .placing = placing_in(panels[i].mesh, *camera, boxes[i], origin),
                      .marked = marked_of(panels[i])});
  }
  share_frames(placed);
  for (std::size_t i = 0; i < panels.size() && options.map_dpi > 0; ++i)
    if (panels[i].map_scale > 0)
      if (auto inset = inset_of(placed[i], options.map_dpi)) {
        placed.push_back(std::move(*inset));
        cameras.push_back(cameras[i]);
      }
  for (std::size_t i = 0; i < placed.size(); ++i)
    placed[i].faces = faces_of(placed[i].panel->mesh, cameras[i], placed[i].placing);
  return {std::move(placed), {}};
}

Raster blank(const PictureOptions& options, Colour ground) {
  Raster raster{options.width_px, options.height_px, {}};
  const std::uint8_t opacity = options.is_transparent ? 0 : 255;
  raster.pixels.assign(at(raster.width) * at(raster.height),
                       {ground[0], ground[1], ground[2], opacity});
  return raster;
}

}  // namespace

Checked<std::string> picture(const std::vector<PicturePanel>& panels, PictureFormat format,
                             const PictureOptions& options) {
  if (format != PictureFormat::svg && !has_cairo())
    return {std::nullopt,
            {picture_issue(Code::E171,
                           "pictures as PNG and PDF take Cairo, which is not installed "
                           "(libcairo2); SVG does without")}};
  const PictureTheme theme = theme_of(options.is_dark);
  const SeenClasses classes = options.has_legend ? classes_of(panels) : SeenClasses{};
  PictureBox within{kMargin_px, kMargin_px, std::max(1.0, options.width_px - 2 * kMargin_px),
                    std::max(1.0, options.height_px - 2 * kMargin_px)};
  const double legend_px = std::min(legend_height_px(classes, within.width), within.height / 2);
  within.height -= legend_px;
  const bool has_captions =
      std::ranges::any_of(panels, [](const PicturePanel& panel) { return !panel.caption.empty(); });
  const auto boxes = boxes_for(panels.size(), within, options, has_captions ? kCaption_px : 0.0);
  auto placed = placed_panels(panels, boxes, options);
  if (!placed.value) return {std::nullopt, std::move(placed.issues)};

  PictureDrawing drawing{.width_px = options.width_px, .height_px = options.height_px};
  if (!options.is_transparent) drawing.ground = theme.ground;
  Raster raster;
  if (format == PictureFormat::png) raster = blank(options, theme.ground);
  for (const PlacedPanel& panel : *placed.value) {
    if (format == PictureFormat::png)
      draw_faces(panel.faces, panel.marked, panel.placing.box, raster);
    else
      append_parts(panel, drawing.groups);
    if (panel.is_inset) continue;
    if (!panel.panel->caption.empty()) drawing.groups.push_back(caption(panel, theme));
    if (options.has_scale_bar) drawing.groups.push_back(scale_bar(panel.placing, theme));
  }
  if (legend_px > 0)
    drawing.groups.push_back(legend(
        classes, {within.left, within.top + within.height + 4, within.width, legend_px}, theme));
  switch (format) {
    case PictureFormat::png:
      return {png_of(drawing, raster), {}};
    case PictureFormat::svg:
      return {svg_of(drawing), {}};
    case PictureFormat::pdf:
      return {pdf_of(drawing), {}};
  }
  return {};
}

}  // namespace oriel
