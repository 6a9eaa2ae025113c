#include "tests/support/citygml_samples.h"

#include <fmt/format.h>

namespace oriel::test {

std::string CityGmlFile::text() const {
  const std::string gml = version == "3.0" ? "gml/3.2" : "gml";
  const auto space = [&](const std::string& prefix, const std::string& path) {
    return fmt::format(" xmlns:{}=\"http://www.opengis.net/citygml/{}{}\"", prefix, path, version);
  };
  return fmt::format(
      "{}<c:CityModel{}{}{}{} xmlns:gml=\"http://www.opengis.net/{}\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n{}{}</c:CityModel>\n",
      declaration, space("c", ""), space("bldg", "building/"), space("con", "construction/"),
      space("gen", "generics/"), gml, head, members);
}

std::string element(const std::string& name, const std::string& content,
                    const std::string& attributes) {
  return fmt::format("<{0}{1}{2}>{3}</{0}>\n", name, attributes.empty() ? "" : " ", attributes,
                     content);
}

std::string building(const std::string& id, const std::string& content) {
  const std::string attribute = id.empty() ? "" : fmt::format("gml:id=\"{}\"", id);
  return element("c:cityObjectMember", element("bldg:Building", content, attribute));
}

std::string ring(const std::string& positions) {
  return element("gml:LinearRing", element("gml:posList", positions));
}

std::string polygon(const std::string& id, const std::string& positions, const std::string& hole) {
  std::string rings = element("gml:exterior", ring(positions));
  if (!hole.empty()) rings += element("gml:interior", ring(hole));
  return element("gml:Polygon", rings, id.empty() ? "" : fmt::format("gml:id=\"{}\"", id));
}

std::string surface_member(const std::string& surface) {
  return element("gml:surfaceMember", surface);
}

std::string link_to(const std::string& id) {
  return fmt::format("<gml:surfaceMember xlink:href=\"#{}\"/>\n", id);
}

std::string multi_surface(const std::string& members) {
  return element("gml:MultiSurface", members);
}

std::string solid(const std::string& members) {
  return element("gml:Solid", element("gml:exterior", element("gml:CompositeSurface", members)));
}

const std::vector<std::string>& box_faces() {
  static const std::vector<std::string> faces{
      "1000.5 2000.25 10 1000.5 2003.25 10 1004.5 2003.25 10 1004.5 2000.25 10 1000.5 2000.25 10",
      "1000.5 2000.25 12 1004.5 2000.25 12 1004.5 2003.25 12 1000.5 2003.25 12 1000.5 2000.25 12",
      "1000.5 2000.25 10 1004.5 2000.25 10 1004.5 2000.25 12 1000.5 2000.25 12 1000.5 2000.25 10",
      "1004.5 2000.25 10 1004.5 2003.25 10 1004.5 2003.25 12 1004.5 2000.25 12 1004.5 2000.25 10",
      "1004.5 2003.25 10 1000.5 2003.25 10 1000.5 2003.25 12 1004.5 2003.25 12 1004.5 2003.25 10",
      "1000.5 2003.25 10 1000.5 2000.25 10 1000.5 2000.25 12 1000.5 2003.25 12 1000.5 2003.25 10"};
  return faces;
}

std::string box_solid(const std::string& prefix) {
  std::string members;
  for (std::size_t i = 0; i < box_faces().size(); ++i)
    members += surface_member(polygon(fmt::format("{}{}", prefix, i), box_faces()[i]));
  return solid(members);
}

std::string box_by_links(const std::string& version, const std::string& prefix) {
  const bool is_v3 = version == "3.0";
  const std::string space = is_v3 ? "con:" : "bldg:";
  const std::string core = is_v3 ? "c:" : "bldg:";
  const std::vector<std::string> types{"GroundSurface", "RoofSurface", "WallSurface",
                                       "WallSurface",   "WallSurface", "WallSurface"};
  std::string content, links;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string id = fmt::format("{}{}", prefix, i);
    content += element(is_v3 ? "c:boundary" : "bldg:boundedBy",
                       element(space + types[i],
                               element(core + "lod2MultiSurface",
                                       multi_surface(surface_member(polygon(id, box_faces()[i])))),
                               fmt::format("gml:id=\"{}s\"", id)));
    links += link_to(id);
  }
  return content + element(core + "lod2Solid", solid(links));
}

namespace {

/// Writes one file.
class Converter {
 public:
  Converter(std::string version, char lod) : version_(std::move(version)), lod_(lod) {}

  std::string file(const std::vector<Building>& buildings) {
    std::string members;
    for (const Building& building : buildings) {
      ++number_;
      members += test::building(building.id, content_of(building));
    }
    return CityGmlFile{version_, members}.text();
  }

 private:
  [[nodiscard]] bool is_v3() const { return version_ == "3.0"; }

  [[nodiscard]] std::string lod_property(const std::string& kind, const std::string& inside) const {
    return element(fmt::format("{}lod{}{}", is_v3() ? "c:" : "bldg:", lod_, kind), inside);
  }

  static std::string positions(const Building& building, const std::vector<int>& ring) {
    std::string text;
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Vec3 p = building.vertices[static_cast<std::size_t>(ring[i % ring.size()])] +
                     building.frame.origin_m;
      text += fmt::format("{} {} {} ", p.x, p.y, p.z);
    }
    return text;
  }

  std::string polygon_text(const Building& building, const Polygon& polygon) const {
    std::string rings = element("gml:exterior", ring(positions(building, polygon.rings[0])));
    for (std::size_t r = 1; r < polygon.rings.size(); ++r)
      rings += element("gml:interior", ring(positions(building, polygon.rings[r])));
    return element("gml:Polygon", rings, fmt::format("gml:id=\"{}\"", id_of(polygon)));
  }

  [[nodiscard]] std::string id_of(const Polygon& polygon) const {
    return fmt::format("b{}p{}", number_, polygon.source);
  }

  std::string boundary(const Polygon& polygon, const std::string& text) const {
    const std::string space = is_v3() ? "con:" : "bldg:";
    const std::string surface = lod_property("MultiSurface", multi_surface(surface_member(text)));
    const bool is_opening = polygon.hint == "Window" || polygon.hint == "Door";
    std::string inside = surface;
    if (is_opening) {
      const std::string name = fmt::format("{}{}{}", space, polygon.hint, is_v3() ? "Surface" : "");
      inside = element(is_v3() ? "con:fillingSurface" : "bldg:opening", element(name, surface));
    }
    return element(
        is_v3() ? "c:boundary" : "bldg:boundedBy",
        element(fmt::format("{}{}", space, is_opening ? "WallSurface" : polygon.hint), inside));
  }

  std::string content_of(const Building& building) const {
    std::string boundaries, members, geometry;
    for (const Polygon& polygon : building.polygons) {
      const std::string text = polygon_text(building, polygon);
      if (polygon.hint.empty()) {
        members += surface_member(text);
      } else {
        boundaries += boundary(polygon, text);
        members += link_to(id_of(polygon));
      }
    }
    geometry = building.is_solid ? lod_property("Solid", solid(members))
                                 : lod_property("MultiSurface", multi_surface(members));
    return boundaries + geometry;
  }

  std::string version_;
  char lod_;
  int number_ = 0;
};

}  // namespace

std::string citygml_of(const std::vector<Building>& buildings, const std::string& version,
                       char lod) {
  return Converter(version, lod).file(buildings);
}

}  // namespace oriel::test
