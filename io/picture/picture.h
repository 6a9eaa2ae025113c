#pragma once

#include "kernel/base/issue.h"
#include "kernel/mesh/mesh.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Pictures of labelled buildings, without a browser (docs/command.md#pictures).
namespace oriel {

enum class PictureFormat { png, svg, pdf };

/// How a picture looks at what it shows; always in parallel projection.
enum class PictureView {
  oblique,  ///< from an azimuth and an elevation
  plan,     ///< from straight above, north up
  facade    ///< level, straight at the facade of one side
};

/// Why a part is marked: by lines of a colour that the legend explains.
enum class PictureMark : std::uint8_t {
  changed,    ///< it is not what it was
  right,      ///< it has the label that it should have
  wrong,      ///< it has a label that it should not have
  missed,     ///< it lacks the label that it should have
  explained,  ///< it is what the picture is about
  host,       ///< that lies in it or stands on it
  related     ///< that is related to it
};

/// Limits of PictureOptions::width_px and height_px.
inline constexpr int kLeastPicture_px = 16, kMostPicture_px = 16'384;

struct PictureOptions {
  PictureView view = PictureView::oblique;
  /// Where the viewer stands, clockwise from north. With PictureView::facade the side whose largest
  /// facade is looked at, which may be up to 45 degrees off.
  double azimuth_deg = 150;
  /// Of the viewer above the ground, -90 to 90. Of an oblique view only.
  double elevation_deg = 25;
  int width_px = 1200;
  int height_px = 900;
  /// The panels of a row; 0: as many as make the panels squarest.
  int columns = 0;
  /// How many panels a page of a PDF has; 0: one page has all, as other formats always do.
  std::size_t panels_of_page = 0;
  bool is_dark = false;
  bool is_transparent = false;
  bool has_legend = true;
  bool has_scale_bar = false;
  /// Draws each panel that has a map scale once more in its corner, as large as on the map, for a
  /// screen or printer of so many dots an inch, where that is at most half as large; 0: does not.
  double map_dpi = 0;
};

/// What one panel of a picture shows.
struct PicturePanel {
  /// In metres; features with the ids and labels that are shown.
  MeshSource mesh{};
  /// Stands below the panel, line by line; empty: nothing.
  std::string caption{};
  /// Panels of one number are seen from one place at one scale, that of the largest; -1: each by
  /// itself.
  int frame = -1;
  /// The denominator of the scale that it is drawn for; 0: none.
  double map_scale = 0;
  /// By building and id.
  std::map<std::pair<std::string, std::string>, PictureMark> marks{};
  /// What is not marked is pale.
  bool fades_others = false;
  /// Its faces are some of a closed body's: from behind they are not seen, as those of a closed
  /// mesh never are.
  bool hides_backs = false;
};

/// Draws panels side by side. Returns the bytes of the picture, the same whatever the machine, but
/// for the shapes of letters. Faces have the colour of their label, or of their surface (wall,
/// roof, ground), shaded by their slope; hidden parts are not drawn. In SVG each part is a group
/// with its id and label.
///
/// Without a value: E163 if the buildings of a panel, or of the panels of a frame, lie so far apart
/// that none would be seen, E170 if no face looks to the side of a facade that was asked for, E171
/// if this build has no pictures, or, for PNG and PDF, Cairo is not installed.
Checked<std::string> picture(const std::vector<PicturePanel>& panels, PictureFormat format,
                             const PictureOptions& options = {});

}  // namespace oriel
