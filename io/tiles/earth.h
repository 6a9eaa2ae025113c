#pragma once

#include "io/gltf/flat_mesh.h"
#include "kernel/base/issue.h"
#include "model/vec3.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace oriel {

/// Places points of a coordinate reference system on the earth (WGS 84), by PROJ. No network is
/// asked: grids are used that are installed.
class Earth {
 public:
  /// `crs`: what PROJ knows by name ("EPSG:7415"), OGC's URLs and URNs of it included, projected,
  /// in any unit of length. No value and an E160 if it is none; a warning E162 if its heights are
  /// taken for ellipsoidal ones, judged at the point `sample`.
  static Checked<Earth> of(const std::string& crs, Vec3 sample);

  /// In metres from the middle of the earth (EPSG:4978); nothing where the system has no such
  /// point.
  [[nodiscard]] std::optional<Vec3> geocentric(Vec3 point) const;

  /// The frame of a point: its east, north and up are the axes.
  [[nodiscard]] std::optional<Placement> frame_at(Vec3 point) const;

 private:
  struct Proj;
  explicit Earth(std::shared_ptr<const Proj> proj) : proj_(std::move(proj)) {}
  std::shared_ptr<const Proj> proj_;
};

/// "EPSG:7415" of "https://www.opengis.net/def/crs/EPSG/0/7415" and "urn:ogc:def:crs:EPSG::7415";
/// other texts as they are.
std::string short_name_of_crs(const std::string& crs);

}  // namespace oriel
