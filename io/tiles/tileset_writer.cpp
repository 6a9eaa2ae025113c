#include "io/tiles/tileset_writer.h"

#include "io/files/gzip.h"
#include "io/files/output_file.h"
#include "io/tiles/earth.h"
#include "io/tiles/tile_tree.h"
#include "kernel/base/text/printable.h"
#include "model/version.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {

using detail::Tile;
using detail::TileItem;
using nlohmann::ordered_json;

namespace {

/// Where a tileset stands: a frame in whose middle it is, east, north and up.
class TilesetFrame {
 public:
  /// For buildings at these places. `crs` as TilesetOptions has it. No value: E160, E163.
  static Checked<TilesetFrame> of(const std::vector<const TileEntry*>& entries,
                                  const std::string& crs);

  /// From the frame to the earth, or to the coordinates of the input.
  [[nodiscard]] const Placement& placement() const { return placement_; }
  /// From the frame of a building to this one; nothing if the earth has no such place.
  [[nodiscard]] std::optional<Placement> placement_of(const TileEntry& entry) const;

 private:
  [[nodiscard]] std::optional<Vec3> local(Vec3 point) const;

  std::optional<Earth> earth_;
  Placement placement_;
};

/// Farther from each other buildings are not of one data set.
constexpr double kMostApart_m = 1'000'000;

Issue frame_issue(Severity severity, Code code, std::string sentence) {
  Issue issue;
  issue.severity = severity;
  issue.code = code;
  issue.sentence = std::move(sentence);
  return issue;
}

/// E163 for the outermost buildings along an axis that is too long.
std::optional<Issue> too_far_apart(const std::vector<const TileEntry*>& entries) {
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    const auto [least, most] = std::ranges::minmax_element(
        entries, {}, [axis](const TileEntry* entry) { return entry->origin_m.*axis; });
    const double apart_m = (*most)->origin_m.*axis - (*least)->origin_m.*axis;
    if (apart_m <= kMostApart_m) continue;
    return frame_issue(Severity::error, Code::E163,
                       fmt::format("'{}' and '{}' lie {:.0f} km apart", printable((*least)->id),
                                   printable((*most)->id), apart_m / 1000));
  }
  return std::nullopt;
}

Vec3 middle_of(const std::vector<const TileEntry*>& entries) {
  Box box;
  for (const TileEntry* entry : entries) box.grow(entry->origin_m);
  const Vec3 middle = 0.5 * (box.min + box.max);
  return {std::floor(middle.x), std::floor(middle.y), std::floor(box.min.z)};
}

Checked<TilesetFrame> TilesetFrame::of(const std::vector<const TileEntry*>& entries,
                                       const std::string& crs) {
  if (auto issue = too_far_apart(entries)) return {std::nullopt, {std::move(*issue)}};
  const Vec3 middle = middle_of(entries);
  TilesetFrame frame;
  frame.placement_.origin = middle;
  std::set<std::string> named;
  for (const TileEntry* entry : entries) named.insert(short_name_of_crs(entry->crs));
  if (crs == kLocalFrame) return {std::move(frame), {}};
  if (crs.empty() && named.size() > 1)
    return {std::nullopt,
            {frame_issue(Severity::error, Code::E160,
                         fmt::format("the inputs name several systems, '{}' and '{}': say which "
                                     "one holds with --crs",
                                     printable(*named.begin()), printable(*named.rbegin())))}};
  const std::string name = crs.empty() ? *named.begin() : crs;
  if (name.empty())
    return {std::move(frame),
            {frame_issue(Severity::warning, Code::E161,
                         "the inputs name no coordinate reference system: the tiles stand in a "
                         "local frame; name one with --crs")}};
  auto earth = Earth::of(name, middle);
  if (!earth.value) return {std::nullopt, std::move(earth.issues)};
  frame.earth_ = std::move(earth.value);
  frame.placement_ = frame.earth_->frame_at(middle).value();
  return {std::move(frame), std::move(earth.issues)};
}

std::optional<Vec3> TilesetFrame::local(Vec3 point) const {
  const auto place = earth_->geocentric(point);
  if (!place) return std::nullopt;
  const Vec3 p = *place - placement_.origin;
  return Vec3{dot(placement_.columns[0], p), dot(placement_.columns[1], p),
              dot(placement_.columns[2], p)};
}

std::optional<Placement> TilesetFrame::placement_of(const TileEntry& entry) const {
  Placement placement;
  if (!earth_) {
    placement.origin = entry.origin_m - placement_.origin;
    return placement;
  }
  constexpr double kStep_m = 100;
  const auto origin = local(entry.origin_m);
  const std::array steps{Vec3{kStep_m, 0, 0}, Vec3{0, kStep_m, 0}, Vec3{0, 0, kStep_m}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto step = local(entry.origin_m + steps[i]);
    if (!origin || !step) return std::nullopt;
    placement.columns[i] = (1 / kStep_m) * (*step - *origin);
  }
  placement.origin = *origin;
  return placement;
}

namespace fs = std::filesystem;

/// Boxes are larger than what is in them by so much, as vertices of tiles are single numbers.
constexpr double kMargin_m = 0.001;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  Issue issue;
  issue.code = Code::E601;
  issue.sentence = "cannot be made: " + error.message();
  issue.place.file = folder.string();
  throw OutputError(std::move(issue));
}

/// The box of a box that is turned and moved.
Box placed(const Box& box, const Placement& placement) {
  Box out;
  for (int corner = 0; corner < 8; ++corner)
    out.grow(placement.placed({(corner & 1) != 0 ? box.max.x : box.min.x,
                               (corner & 2) != 0 ? box.max.y : box.min.y,
                               (corner & 4) != 0 ? box.max.z : box.min.z}));
  return out;
}

ordered_json volume_of(const Box& box) {
  const Vec3 middle = 0.5 * (box.min + box.max);
  const Vec3 half = 0.5 * (box.max - box.min) + Vec3{kMargin_m, kMargin_m, kMargin_m};
  return {{"box", {middle.x, middle.y, middle.z, half.x, 0, 0, 0, half.y, 0, 0, 0, half.z}}};
}

ordered_json matrix_of(const Placement& placement) {
  ordered_json matrix = ordered_json::array();
  for (const Vec3 column : placement.columns)
    for (const double value : {column.x, column.y, column.z, 0.0}) matrix.push_back(value);
  const Vec3 origin = placement.origin;
  for (const double value : {origin.x, origin.y, origin.z, 1.0}) matrix.push_back(value);
  return matrix;
}

/// What viewers are told of a tile.
ordered_json schema() {
  const ordered_json scale{{"description", "The content is drawn for 1 : scale"},
                           {"type", "SCALAR"},
                           {"componentType", "FLOAT64"},
                           {"required", true}};
  const ordered_json coarsest{{"description", "It would look the same up to 1 : coarsest"},
                              {"type", "SCALAR"},
                              {"componentType", "FLOAT64"},
                              {"required", true}};
  const ordered_json buildings{{"description", "How many buildings the content has"},
                               {"type", "SCALAR"},
                               {"componentType", "UINT32"},
                               {"required", true}};
  return {
      {"id", "oriel_tileset"},
      {"classes",
       {{"tile",
         {{"name", "Tile"},
          {"properties", {{"scale", scale}, {"coarsest", coarsest}, {"buildings", buildings}}}}}}}};
}

/// Writes the files of one tileset.
class TilesetWriter {
 public:
  TilesetWriter(std::string folder, const TileBuildings& buildings, const TilesetOptions& options)
      : folder_(std::move(folder)), buildings_(buildings), options_(options) {
    options_.glb.labels = buildings.labels();
    options_.glb.surfaces = buildings.surfaces();
    for (const double scale : options.scales) files_.scales.push_back({scale});
  }

  Checked<TilesetFiles> write() {
    if (!choose_buildings()) return {std::nullopt, std::move(issues_)};
    const Tile root = detail::tile_tree(items_, options_.scales.size(), options_.most_triangles);
    ordered_json tree = json_of(root);
    tree["transform"] = matrix_of(frame_.placement());
    const ordered_json tileset{
        {"asset", {{"version", "1.1"}, {"generator", std::string("oriel ") + kVersion}}},
        {"schema", schema()},
        {"geometricError", length(root.box.max - root.box.min) + root.error_m},
        {"root", tree}};
    make_folder(folder_);
    write("tileset.json", tileset.dump(1) + "\n");
    files_.buildings = items_.size();
    return {std::move(files_), std::move(issues_)};
  }

 private:
  /// Returns how many bytes the file has.
  std::uint64_t write(const std::string& uri, const std::string& content) const {
    const std::string bytes = options_.has_gzip ? gzip(content) : content;
    write_file((fs::path(folder_) / uri).string(), bytes);
    return bytes.size();
  }

  /// False: there is no tileset, and an issue says why.
  bool choose_buildings() {
    std::vector<const TileEntry*> entries;
    std::unordered_set<std::string> ids;
    for (const TileEntry& entry : buildings_.entries()) {
      if (ids.insert(entry.id).second)
        entries.push_back(&entry);
      else
        issues_.push_back(building_issue(Severity::error, Code::E207, entry.id,
                                         "an earlier building has this id: that one is shown"));
    }
    if (entries.empty()) {
      issues_.push_back(building_issue(Severity::error, Code::E134, "", "no building to show"));
      return false;
    }
    auto frame = TilesetFrame::of(entries, options_.crs);
    issues_.insert(issues_.end(), frame.issues.begin(), frame.issues.end());
    if (options_.glb.colours == GlbColours::by_material && !buildings_.has_colours())
      issues_.push_back(building_issue(
          Severity::warning, Code::E169, "",
          "no face has a material with a colour: faces are coloured by their type of surface"));
    if (!frame.value) return false;
    frame_ = std::move(*frame.value);
    for (const TileEntry* entry : entries)
      if (!place(*entry)) return false;
    return true;
  }

  bool place(const TileEntry& entry) {
    const auto placement = frame_.placement_of(entry);
    if (!placement) {
      issues_.push_back(building_issue(Severity::error, Code::E160, entry.id,
                                       "has no place on the earth in this system"));
      return false;
    }
    TileItem item{&entry, {}, {}};
    for (const TileEntry::Stored& stored : entry.meshes)
      item.boxes.push_back(placed(stored.box, *placement));
    const Box& finest = item.boxes[entry.mesh_at.at(0)];
    item.middle = 0.5 * (finest.min + finest.max);
    items_.push_back(std::move(item));
    placements_.push_back(*placement);
    return true;
  }

  /// Writes the content of a tile and of those below.
  ordered_json json_of(const Tile& tile) {
    ordered_json out{{"boundingVolume", volume_of(tile.box)},
                     {"geometricError", tile.error_m},
                     {"refine", "REPLACE"}};
    if (!tile.buildings.empty()) {
      const double scale = options_.scales[tile.level];
      out["metadata"] = {{"class", "tile"},
                         {"properties",
                          {{"scale", scale},
                           {"coarsest", options_.scales[tile.coarsest_level]},
                           {"buildings", tile.buildings.size()}}}};
      out["content"] = {{"uri", write_content(tile)}};
    }
    for (const Tile& child : tile.children) out["children"].push_back(json_of(child));
    return out;
  }

  std::string write_content(const Tile& tile) {
    const std::string place = fmt::format("tiles/1-{}", options_.scales[tile.level]);
    const std::string uri = fmt::format("{}/{}.glb", place, tile.cell);
    make_folder(fs::path(folder_) / place);
    Box box;
    for (const std::size_t b : tile.buildings)
      box.grow(items_[b].boxes[items_[b].entry->mesh_at[tile.level]]);
    const Vec3 middle = 0.5 * (box.min + box.max);
    FlatMesh mesh;
    for (const std::size_t b : tile.buildings) {
      Placement placement = placements_[b];
      placement.origin = placement.origin - middle;
      append(mesh, buildings_.mesh(items_[b].entry->stored_at(tile.level)), placement);
    }
    const std::uint64_t bytes = write(uri, write_glb(mesh, middle, options_.glb));
    TilesetFiles::OfScale& of_scale = files_.scales[tile.level];
    ++of_scale.tiles;
    of_scale.buildings += tile.buildings.size();
    of_scale.bytes += bytes;
    return uri;
  }

  std::string folder_;
  const TileBuildings& buildings_;
  TilesetOptions options_;
  TilesetFrame frame_;
  std::vector<TileItem> items_;
  std::vector<Placement> placements_;  ///< parallel to `items_`
  std::vector<Issue> issues_;
  TilesetFiles files_;
};

}  // namespace

Checked<TilesetFiles> write_tileset(const std::string& folder, const TileBuildings& buildings,
                                    const TilesetOptions& options) {
  return TilesetWriter(folder, buildings, options).write();
}

}  // namespace oriel
