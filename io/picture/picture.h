#pragma once

#include "kernel/base/issue.h"
#include "kernel/mesh/mesh.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Pictures of labelled buildings, without a browser (docs/picture.md).
namespace oriel {

enum class PictureFormat { png, svg, pdf };

/// How a picture looks at what it shows; always in parallel projection.
enum class PictureView {
  oblique,  ///< from an azimuth and an elevation
  plan,     ///< from straight above, north up
  facade    ///< level, straight at the facade of one side
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
  bool is_dark = false;
  bool is_transparent = false;
  bool has_legend = true;
  bool has_scale_bar = false;
  /// All panels have one frame, as large as what is largest in them; else each fills its panel.
  bool shares_frame = false;
};

/// What one panel of a picture shows.
struct PicturePanel {
  /// In metres; features with the ids and labels that are shown.
  MeshSource mesh{};
  /// Stands below the panel; empty: nothing.
  std::string caption{};
  /// Ids of features that are marked, as they changed.
  std::vector<std::string> marked{};
};

/// The bytes of a picture of `panels`, which lie side by side; the same whatever the machine, but
/// for the shapes of letters. Faces have the colour of their label, or of their surface (wall,
/// roof, ground), shaded by their slope; hidden parts are not drawn. In SVG each part is a group
/// with its id and label.
///
/// Without a value: E170 if no face looks to the side of a facade that was asked for, E171 if this
/// build has no pictures, or, for PNG and PDF, Cairo is not installed.
Checked<std::string> picture(const std::vector<PicturePanel>& panels, PictureFormat format,
                             const PictureOptions& options = {});

}  // namespace oriel
