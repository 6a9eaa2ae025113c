#include "io/tiles/earth.h"

#include "io/files/proj_pointers.h"

#include <cmath>
#include <numbers>
#include <regex>
#include <utility>

namespace oriel {

namespace {

using detail::PjPointer;

/// WGS 84.
constexpr double kSemiMajor_m = 6'378'137, kFlattening = 1 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);

/// Longitude, latitude in degrees and ellipsoidal height.
struct Geodetic {
  double longitude_deg = 0, latitude_deg = 0, height_m = 0;
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Vec3 geocentric_of(const Geodetic& g) {
  const double lon = radians(g.longitude_deg), lat = radians(g.latitude_deg);
  const double n = kSemiMajor_m / std::sqrt(1 - kEccentricity2 * std::sin(lat) * std::sin(lat));
  return {(n + g.height_m) * std::cos(lat) * std::cos(lon),
          (n + g.height_m) * std::cos(lat) * std::sin(lon),
          (n * (1 - kEccentricity2) + g.height_m) * std::sin(lat)};
}

Issue crs_issue(Severity severity, Code code, std::string sentence) {
  Issue issue;
  issue.severity = severity;
  issue.code = code;
  issue.sentence = std::move(sentence);
  return issue;
}

bool has_heights(PJ_CONTEXT* context, const PJ* crs) {
  const PJ_TYPE type = proj_get_type(crs);
  if (type == PJ_TYPE_COMPOUND_CRS || type == PJ_TYPE_GEOCENTRIC_CRS) return true;
  const PjPointer system(proj_crs_get_coordinate_system(context, crs));
  return system && proj_cs_get_axis_count(context, system.get()) == 3;
}

/// A system in which places are told in metres or feet on a plane.
bool is_projected(PJ_CONTEXT* context, const PJ* crs) {
  switch (proj_get_type(crs)) {
    case PJ_TYPE_PROJECTED_CRS:
      return true;
    case PJ_TYPE_COMPOUND_CRS: {
      const PjPointer part(proj_crs_get_sub_crs(context, crs, 0));
      return part && is_projected(context, part.get());
    }
    case PJ_TYPE_BOUND_CRS: {
      const PjPointer source(proj_get_source_crs(context, crs));
      return source && is_projected(context, source.get());
    }
    default:
      return false;
  }
}

/// From a system to longitude, latitude (and height), x before y.
PjPointer transformation(PJ_CONTEXT* context, const PJ* crs, const char* target) {
  const PjPointer to(proj_create(context, target));
  const PjPointer plain(
      to ? proj_create_crs_to_crs_from_pj(context, crs, to.get(), nullptr, nullptr) : nullptr);
  return PjPointer(plain ? proj_normalize_for_visualization(context, plain.get()) : nullptr);
}

std::optional<Geodetic> transformed(PJ* transformation, Vec3 point) {
  proj_errno_reset(transformation);
  const PJ_COORD out =
      proj_trans(transformation, PJ_FWD, proj_coord(point.x, point.y, point.z, HUGE_VAL));
  if (proj_errno(transformation) != 0 || !std::isfinite(out.xyz.x) || !std::isfinite(out.xyz.y) ||
      !std::isfinite(out.xyz.z))
    return std::nullopt;
  return Geodetic{out.xyz.x, out.xyz.y, out.xyz.z};
}

/// The operation that was used last only supposes that heights or datums are the same.
bool is_supposed(PJ* transformation) {
  const PjPointer used(proj_trans_get_last_used_operation(transformation));
  return used && proj_coordoperation_has_ballpark_transformation(nullptr, used.get()) == 1;
}

}  // namespace

struct Earth::Proj {
  detail::PjContextPointer context;
  PjPointer transformation;
  bool keeps_heights = false;  ///< they are taken for ellipsoidal ones

  [[nodiscard]] std::optional<Geodetic> geodetic(Vec3 point) const {
    auto place = transformed(transformation.get(), point);
    if (place && keeps_heights) place->height_m = point.z;
    return place;
  }
};

std::string short_name_of_crs(const std::string& crs) {
  static const std::regex url("https?://www\\.opengis\\.net/def/crs/([A-Za-z]+)/[^/]*/([0-9]+)/?");
  static const std::regex urn("urn:(?:x-)?ogc:def:crs:([A-Za-z]+):[^:]*:([0-9]+)");
  std::smatch found;
  if (std::regex_match(crs, found, url) || std::regex_match(crs, found, urn))
    return found[1].str() + ":" + found[2].str();
  return crs;
}

Checked<Earth> Earth::of(const std::string& crs, Vec3 sample) {
  auto proj = std::make_shared<Proj>();
  proj->context.reset(proj_context_create());
  PJ_CONTEXT* context = proj->context.get();
  proj_context_set_enable_network(context, 0);
  proj_log_level(context, PJ_LOG_NONE);
  const std::string name = short_name_of_crs(crs);
  const auto refuse = [&](const std::string& why) -> Checked<Earth> {
    return {std::nullopt, {crs_issue(Severity::error, Code::E160, "'" + name + "' " + why)}};
  };
  const PjPointer known(proj_create(context, name.c_str()));
  if (!known || proj_is_crs(known.get()) == 0)
    return refuse("is no coordinate reference system that PROJ knows");
  if (!is_projected(context, known.get()))
    return refuse("is not a projected system: coordinates must be lengths, not degrees");
  std::vector<Issue> issues;
  proj->keeps_heights = !has_heights(context, known.get());
  std::string why = "says nothing of heights";
  if (!proj->keeps_heights) {
    proj->transformation = transformation(context, known.get(), "EPSG:4979");
    const bool is_placed = proj->transformation && proj->geodetic(sample);
    if (!is_placed || is_supposed(proj->transformation.get())) {
      proj->keeps_heights = true;
      why = "has heights for which PROJ has no grid";
    }
  }
  if (proj->keeps_heights) {
    const PjPointer part(proj_get_type(known.get()) == PJ_TYPE_COMPOUND_CRS
                             ? proj_crs_get_sub_crs(context, known.get(), 0)
                             : proj_clone(context, known.get()));
    proj->transformation = transformation(context, part.get(), "EPSG:4326");
    issues.push_back(crs_issue(Severity::warning, Code::E162,
                               "'" + name + "' " + why + ": they are taken as ellipsoidal"));
  }
  if (!proj->transformation || !proj->geodetic(sample))
    return refuse("has no place on the earth for the coordinates of the buildings");
  return {Earth(std::move(proj)), std::move(issues)};
}

std::optional<Vec3> Earth::geocentric(Vec3 point) const {
  const auto place = proj_->geodetic(point);
  if (!place) return std::nullopt;
  return geocentric_of(*place);
}

std::optional<Placement> Earth::frame_at(Vec3 point) const {
  const auto place = proj_->geodetic(point);
  if (!place) return std::nullopt;
  const double lon = radians(place->longitude_deg), lat = radians(place->latitude_deg);
  Placement frame;
  frame.columns = {
      Vec3{-std::sin(lon), std::cos(lon), 0},
      Vec3{-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)},
      Vec3{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)}};
  frame.origin = geocentric_of(*place);
  return frame;
}

}  // namespace oriel
