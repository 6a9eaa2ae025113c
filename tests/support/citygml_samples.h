#pragma once

#include "model/building.h"

#include <string>
#include <vector>

namespace oriel::test {

/// A CityGML file: `members` between the start and the end of a CityModel.
struct CityGmlFile {
  std::string version = "2.0";
  std::string members{};
  std::string declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  std::string head{};

  [[nodiscard]] std::string text() const;
};

std::string element(const std::string& name, const std::string& content,
                    const std::string& attributes = "");

/// A member that is a Building; without gml:id if `id` is empty.
std::string building(const std::string& id, const std::string& content);

/// A LinearRing with a posList.
std::string ring(const std::string& positions);

std::string polygon(const std::string& id, const std::string& positions,
                    const std::string& hole = "");

std::string surface_member(const std::string& surface);
/// A surfaceMember that links to it.
std::string link_to(const std::string& id);
std::string multi_surface(const std::string& members);
/// A Solid whose exterior has these members.
std::string solid(const std::string& members);

/// The box of BoxFile: ground, roof, south, east, north, west.
const std::vector<std::string>& box_faces();

/// The box as a solid that states its polygons, named by `prefix` and a number.
std::string box_solid(const std::string& prefix);

/// The box as boundary surfaces of level 2 and a solid that links to their polygons.
std::string box_by_links(const std::string& version, const std::string& prefix);

/// A CityGML file of buildings that were read from elsewhere, at level `lod`: a polygon with a hint
/// in a boundary surface of that type of its own, an opening below a wall without polygons, and a
/// solid (or surfaces) that links to them; polygons without a hint stand in the solid.
std::string citygml_of(const std::vector<Building>& buildings, const std::string& version,
                       char lod);

}  // namespace oriel::test
