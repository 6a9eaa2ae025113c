#include "tests/io/cityjson_checks.h"

#include <algorithm>
#include <map>

namespace oriel::test {

namespace {

using nlohmann::json;

class Checker {
 public:
  Checker(const json& file, const json& header) : file_(file), header_(header) {}

  std::vector<std::string> check() {
    const json& root = header_.is_null() ? file_ : header_;
    expect(root.value("type", "") == "CityJSON", "the type is CityJSON");
    expect(root.value("version", "") == "2.0" || root.value("version", "") == "1.1", "the version");
    expect(root.contains("transform") && root["transform"].value("scale", json()).size() == 3,
           "the transform");
    if (!header_.is_null()) {
      expect(file_.value("type", "") == "CityJSONFeature", "the type is CityJSONFeature");
      expect(file_["CityObjects"].contains(file_.value("id", "")), "the feature's id is there");
    }
    for (const json& vertex : file_["vertices"])
      expect(vertex.size() == 3 &&
                 std::ranges::all_of(vertex, [](const json& n) { return n.is_number_integer(); }),
             "vertices are three whole numbers");
    for (const auto& [id, object] : file_["CityObjects"].items()) check_object(id, object);
    return faults_;
  }

 private:
  void expect(bool is_so, const std::string& what) {
    if (!is_so) faults_.push_back(where_ + what);
  }

  void check_object(const std::string& id, const json& object) {
    where_ = id + ": ";
    expect(object.contains("type") && object["type"].is_string(), "an object has a type");
    check_links(id, object, "children", "parents");
    check_links(id, object, "parents", "children");
    if (object.value("type", "") == "BuildingInstallation")
      expect(object.value("parents", json()).size() == 1, "an installation has one parent");
    for (const json& geometry : object.value("geometry", json::array())) check_geometry(geometry);
  }

  void check_links(const std::string& id, const json& object, const char* links, const char* back) {
    const json ids = object.value(links, json::array());
    for (const json& other : ids) {
      expect(std::ranges::count(ids, other) == 1, "an id stands once in a list");
      if (!file_["CityObjects"].contains(other.get<std::string>())) {
        expect(false, std::string(links) + " name objects that are there");
        continue;
      }
      const json& target = file_["CityObjects"][other.get<std::string>()];
      expect(std::ranges::count(target.value(back, json::array()), json(id)) == 1,
             "parents and children mirror each other");
    }
  }

  void check_geometry(const json& geometry) {
    static const std::map<std::string, int> kDepths{
        {"MultiPoint", 1}, {"MultiLineString", 2}, {"MultiSurface", 3},  {"CompositeSurface", 3},
        {"Solid", 4},      {"MultiSolid", 5},      {"CompositeSolid", 5}};
    const std::string type = geometry.value("type", "");
    if (type == "GeometryInstance") {
      check_numbers(geometry["boundaries"], 1);
      return;
    }
    expect(kDepths.contains(type), "the geometry type is known");
    if (!kDepths.contains(type)) return;
    const int depth = kDepths.at(type);
    static const std::vector<std::string> kMembers{"type",      "lod",      "boundaries",
                                                   "semantics", "material", "texture"};
    for (const auto& [key, value] : geometry.items())
      expect(std::ranges::count(kMembers, key) == 1, "a geometry has no member " + key);
    expect(geometry.contains("lod") && geometry["lod"].is_string(), "a geometry has a lod");
    check_numbers(geometry["boundaries"], depth);
    if (geometry.contains("semantics")) check_semantics(geometry, depth - 2);
    const json materials = geometry.value("material", json::object());
    for (const auto& [theme, material] : materials.items())
      if (material.contains("values"))
        check_values(material["values"], geometry["boundaries"], depth - 2,
                     file_["appearance"]["materials"].size());
  }

  /// Boundaries: arrays nested `depth` deep with numbers of vertices in them; rings of three
  /// points.
  void check_numbers(const json& value, int depth) {
    if (depth == 0)
      return expect(value.is_number_integer() && value.get<int>() >= 0 &&
                        value.get<std::size_t>() < file_["vertices"].size(),
                    "a boundary names a vertex that is there");
    expect(value.is_array(), "boundaries are nested arrays");
    if (value.is_array())
      for (const json& element : value) check_numbers(element, depth - 1);
  }

  /// Values repeat the shape of the boundaries down to the polygons, or cut it short with null.
  void check_values(const json& values, const json& boundaries, int depth, std::size_t count) {
    if (values.is_null()) return;
    if (depth == 0)
      return expect(
          values.is_number_integer() && values.get<int>() >= 0 && values.get<std::size_t>() < count,
          "a value names a surface that is there");
    expect(values.is_array() && values.size() == boundaries.size(),
           "values have the shape of the boundaries");
    if (values.is_array() && values.size() == boundaries.size())
      for (std::size_t i = 0; i < values.size(); ++i)
        check_values(values[i], boundaries[i], depth - 1, count);
  }

  void check_semantics(const json& geometry, int depth) {
    const json& semantics = geometry["semantics"];
    const json surfaces = semantics.value("surfaces", json());
    expect(surfaces.is_array() && semantics.contains("values"),
           "semantics have surfaces and values");
    check_values(semantics.value("values", json()), geometry["boundaries"], depth, surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      expect(surfaces[i].contains("type"), "a surface has a type");
      for (const auto& [key, value] : surfaces[i].items())
        expect(!value.is_object(), "members of surfaces are flat");
      if (surfaces[i].contains("parent")) {
        const auto parent = surfaces[i]["parent"].get<std::size_t>();
        expect(
            parent < surfaces.size() && parent != i &&
                std::ranges::count(surfaces[parent].value("children", json::array()), json(i)) == 1,
            "a surface's parent lists it once");
      }
      for (const json& child : surfaces[i].value("children", json::array()))
        expect(child.get<std::size_t>() < surfaces.size() &&
                   surfaces[child.get<std::size_t>()].value("parent", json()) == json(i),
               "a surface's children name it as their parent");
    }
  }

  const json& file_;
  const json& header_;
  std::string where_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> structural_faults(const json& file, const json& header) {
  return Checker(file, header).check();
}

}  // namespace oriel::test
