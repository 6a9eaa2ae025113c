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
#include <span>
#include <string_view>

#include <fmt/format.h>

namespace oriel {

namespace {

using namespace detail;

/// Buildings that are farther apart cannot be seen in one picture: a town is.
constexpr double kMostApart_m = 20'000;
constexpr double kMargin_px = 12, kCaption_px = 26, kCaptionText_px = 14, kCaptionLine_px = 18;

/// A panel in its place, with what can be seen of it.
struct PlacedPanel {
  const PicturePanel* panel = nullptr;
  PictureBox box;  ///< all that it has, of which the drawing may have a part only
  Placing placing{};
  std::vector<PictureFace> faces{};
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
std::vector<std::size_t> firsts_of_frames(std::span<const PicturePanel> panels) {
  std::map<int, std::size_t> first_of;
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < panels.size(); ++i)
    firsts.push_back(panels[i].frame < 0 ? i
                                         : first_of.try_emplace(panels[i].frame, i).first->second);
  return firsts;
}

/// Measures what the frame of each panel shows, by the frame's first panel.
std::vector<Box> boxes_of_frames(std::span<const PicturePanel> panels,
                                 const std::vector<std::size_t>& firsts) {
  std::vector<Box> boxes(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i)
    for (const Vec3 point : panels[i].mesh.points) boxes[firsts[i]].grow(point);
  return boxes;
}

std::optional<PictureMark> mark_of(const PicturePanel& panel, int feature) {
  if (feature < 0) return std::nullopt;
  const MeshFeature& of = panel.mesh.features[at(feature)];
  const auto found = panel.marks.find({of.building, of.id});
  if (found == panel.marks.end()) return std::nullopt;
  return found->second;
}

/// Pale, but not gone.
Colour faded(const Colour& colour, const Colour& ground) {
  constexpr double kKept = 0.3;
  Colour out{};
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<std::uint8_t>(
        std::lround(kKept * colour[i] + (1 - kKept) * static_cast<double>(ground[i])));
  return out;
}

void mark(PlacedPanel& placed, const PictureOptions& options) {
  if (placed.panel->marks.empty()) return;
  for (PictureFace& face : placed.faces) {
    const auto mark = mark_of(*placed.panel, face.feature);
    if (mark)
      face.mark = colour_of_mark(*mark);
    else if (placed.panel->fades_others)
      face.shaded = faded(face.shaded, theme_of(options.is_dark).ground);
  }
}

/// What is in all panels. Features are counted if each is in one panel only, seen or not; marks
/// always, once each.
LegendContents contents_of(std::span<const PicturePanel> panels) {
  const bool counts =
      std::ranges::all_of(panels, [](const PicturePanel& panel) { return panel.frame < 0; });
  LegendContents contents;
  std::set<std::pair<std::string, std::string>> marked;
  for (const PicturePanel& panel : panels) {
    for (const auto& [name, mark] : panel.marks)
      contents.marks[mark] += marked.insert(name).second ? 1 : 0;
    std::set<int> features;
    for (const MeshPolygon& polygon : panel.mesh.polygons) features.insert(polygon.feature);
    for (const int feature : features)
      contents.classes[feature < 0 ? std::string() : panel.mesh.features[at(feature)].label] +=
          counts ? 1 : 0;
  }
  return contents;
}

/// The parts of a panel that are seen.
void append_parts(const PlacedPanel& placed, std::vector<PictureGroup>& groups) {
  const auto visible = visible_rings(placed.faces);
  std::map<int, PictureGroup> parts;
  for (std::size_t f = 0; f < placed.faces.size(); ++f) {
    if (visible[f].empty()) continue;
    const PictureFace& face = placed.faces[f];
    PictureGroup& part = parts[face.feature];
    part.shapes.push_back({.rings = visible[f],
                           .fill = face.shaded,
                           .line = face.mark.value_or(kLineColour),
                           .line_px = face.mark ? 2.0 : 0.6});
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

/// Breaks a caption between words where a line would be longer than its panel is wide.
std::vector<std::string> lines_of(std::string_view caption, double width_px) {
  const auto letters =
      static_cast<std::size_t>(std::max(1.0, width_px / kCaptionText_px / kLetter));
  std::vector<std::string> lines;
  while (!caption.empty()) {
    std::size_t end = std::min(caption.find('\n'), caption.size());
    if (end > letters)
      if (const std::size_t space = caption.rfind(' ', letters);
          space != std::string_view::npos && space > 0)
        end = space;
    lines.push_back(printable(caption.substr(0, end)));
    caption.remove_prefix(std::min(end + 1, caption.size()));
  }
  return lines;
}

/// Measures what the longest caption takes below a panel of that width.
double caption_height_px(std::span<const PicturePanel> panels, double width_px) {
  std::size_t most = 0;
  for (const PicturePanel& panel : panels)
    most = std::max(most, lines_of(panel.caption, width_px).size());
  return most == 0 ? 0 : kCaption_px + static_cast<double>(most - 1) * kCaptionLine_px;
}

/// Writes a caption below its panel; a long word in small letters.
PictureGroup caption(const PlacedPanel& placed, const PictureTheme& theme) {
  const PictureBox& box = placed.box;
  PictureGroup group;
  double y = box.top + box.height + kCaptionText_px + 4;
  for (const std::string& text : lines_of(placed.panel->caption, box.width)) {
    const double fitting_px = box.width / (kLetter * static_cast<double>(text.size()));
    group.texts.push_back({.at = {box.left + box.width / 2, y},
                           .text = text,
                           .size_px = std::min(kCaptionText_px, fitting_px),
                           .anchor = TextAnchor::middle,
                           .colour = theme.ink});
    y += kCaptionLine_px;
  }
  return group;
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
  PlacedPanel inset{
      .panel = placed.panel, .box = placed.box, .placing = placed.placing, .is_inset = true};
  inset.placing.pixels_per_m = dpi / kInch_m / placed.panel->map_scale;
  const auto [width_m, height_m] = placed.placing.size_m;
  inset.placing.box = {placed.placing.box.left, placed.placing.box.top,
                       width_m * inset.placing.pixels_per_m + kRoom_px,
                       height_m * inset.placing.pixels_per_m + kRoom_px};
  if (2 * inset.placing.pixels_per_m > placed.placing.pixels_per_m) return std::nullopt;
  return inset;
}

/// Moves panels to the right of what will stand in their corners, where that would lie over one of
/// them.
void make_room_for_insets(std::vector<PlacedPanel>& placed, const std::vector<Camera>& cameras,
                          double dpi) {
  double room_px = 0;
  bool is_needed = false;
  for (const PlacedPanel& panel : placed) {
    if (panel.panel->map_scale <= 0) continue;
    const auto inset = inset_of(panel, dpi);
    if (!inset) continue;
    const Placing& placing = panel.placing;
    const double beside_px = (placing.box.width - placing.size_m[0] * placing.pixels_per_m) / 2;
    is_needed = is_needed || inset->placing.box.width > beside_px;
    room_px = std::max(room_px, inset->placing.box.width);
  }
  if (!is_needed) return;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    PictureBox box = placed[i].placing.box;
    box.left += room_px;
    box.width = std::max(1.0, box.width - room_px);
    placed[i].placing =
        placing_in(placed[i].panel->mesh, cameras[i], box, placed[i].placing.origin);
  }
  share_frames(placed);
}

/// The panels in their places; none where a facade that was asked for is not there.
Checked<std::vector<PlacedPanel>> placed_panels(std::span<const PicturePanel> panels,
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
                      .box = boxes[i],
                      .placing = placing_in(panels[i].mesh, *camera, boxes[i], origin)});
  }
  share_frames(placed);
  if (options.map_dpi > 0) make_room_for_insets(placed, cameras, options.map_dpi);
  for (std::size_t i = 0; i < panels.size() && options.map_dpi > 0; ++i)
    if (panels[i].map_scale > 0)
      if (auto inset = inset_of(placed[i], options.map_dpi)) {
        inset->placing.box.left = boxes[i].left;
        placed.push_back(std::move(*inset));
        cameras.push_back(cameras[i]);
      }
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].faces = faces_of(placed[i].panel->mesh, cameras[i], placed[i].placing,
                               placed[i].panel->hides_backs);
    mark(placed[i], options);
  }
  return {std::move(placed), {}};
}

Raster blank(const PictureOptions& options, Colour ground) {
  Raster raster{options.width_px, options.height_px, {}};
  const std::uint8_t opacity = options.is_transparent ? 0 : 255;
  raster.pixels.assign(at(raster.width) * at(raster.height),
                       {ground[0], ground[1], ground[2], opacity});
  return raster;
}

/// A page: its groups, and for PNG what lies below them.
struct PicturePage {
  PictureDrawing drawing;
  Raster raster{};
};

Checked<PicturePage> page_of(std::span<const PicturePanel> panels, PictureFormat format,
                             const PictureOptions& options) {
  const PictureTheme theme = theme_of(options.is_dark);
  const LegendContents contents = options.has_legend ? contents_of(panels) : LegendContents{};
  PictureBox within{kMargin_px, kMargin_px, std::max(1.0, options.width_px - 2 * kMargin_px),
                    std::max(1.0, options.height_px - 2 * kMargin_px)};
  const double legend_px = std::min(legend_height_px(contents, within.width), within.height / 2);
  within.height -= legend_px;
  // Panels are as large on the last page as on those before.
  const std::size_t room = std::max(panels.size(), options.panels_of_page);
  const double width_px = within.width / static_cast<double>(columns_for(room, options));
  const auto boxes = boxes_for(room, within, options, caption_height_px(panels, width_px));
  auto placed = placed_panels(panels, boxes, options);
  if (!placed.value) return {std::nullopt, std::move(placed.issues)};

  PicturePage page{.drawing = {.width_px = options.width_px, .height_px = options.height_px}};
  if (!options.is_transparent) page.drawing.ground = theme.ground;
  if (format == PictureFormat::png) page.raster = blank(options, theme.ground);
  for (const PlacedPanel& panel : *placed.value) {
    if (format == PictureFormat::png)
      draw_faces(panel.faces, panel.placing.box, page.raster);
    else
      append_parts(panel, page.drawing.groups);
    if (panel.is_inset) continue;
    if (!panel.panel->caption.empty()) page.drawing.groups.push_back(caption(panel, theme));
    if (options.has_scale_bar) page.drawing.groups.push_back(scale_bar(panel.placing, theme));
  }
  if (legend_px > 0)
    page.drawing.groups.push_back(legend(
        contents, {within.left, within.top + within.height + 4, within.width, legend_px}, theme));
  return {std::move(page), {}};
}

}  // namespace

Checked<std::string> picture(const std::vector<PicturePanel>& panels, PictureFormat format,
                             const PictureOptions& options) {
  if (format != PictureFormat::svg && !has_cairo())
    return {std::nullopt,
            {picture_issue(Code::E171,
                           "pictures as PNG and PDF take Cairo, which is not installed "
                           "(libcairo2); SVG does without")}};
  const bool has_pages = format == PictureFormat::pdf && options.panels_of_page > 0;
  const std::size_t of_page =
      std::max<std::size_t>(1, has_pages ? options.panels_of_page : panels.size());
  PictureOptions of_each = options;
  of_each.panels_of_page = has_pages ? of_page : 0;
  std::vector<PictureDrawing> pages;
  for (std::size_t from = 0; from == 0 || from < panels.size(); from += of_page) {
    const auto some = std::span(panels).subspan(from, std::min(of_page, panels.size() - from));
    auto page = page_of(some, format, of_each);
    if (!page.value) return {std::nullopt, std::move(page.issues)};
    if (format == PictureFormat::png) return {png_of(page.value->drawing, page.value->raster), {}};
    pages.push_back(std::move(page.value->drawing));
  }
  return {format == PictureFormat::svg ? svg_of(pages.front()) : pdf_of(pages), {}};
}

}  // namespace oriel
