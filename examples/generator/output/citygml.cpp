#include "examples/generator/output/citygml.h"

#include "examples/generator/output/json.h"
#include "examples/generator/output/semantics.h"
#include "kernel/base/index.h"

#include <numeric>
#include <vector>

namespace oriel::generator {
namespace {

/// The text grows as JSON does.
using Xml = Json;

/// Writes one building. Elements of the two versions differ in prefix, name and order.
class Writer {
 public:
  Writer(const Building& building, Content content, CityGml version)
      : building_(building),
        body_(building.body),
        content_(content),
        is_v3_(version == CityGml::v3) {
    all_.resize(body_.polygons.size());
    std::iota(all_.begin(), all_.end(), 0);
  }

  std::string member() {
    append_format(xml_, "<cityObjectMember>\n<bldg:Building gml:id=\"{}\">\n", building_.id);
    if (content_ == Content::stripped) {
      append_solid();
    } else if (is_v3_) {
      append_boundaries();
      append_solid();
      append_height();
      append_format(xml_, "<bldg:roofType>{}</bldg:roofType>\n", body_.roof);
      append_storeys();
      append_installations();
    } else {
      append_format(xml_, "<bldg:roofType>{}</bldg:roofType>\n", body_.roof);
      append_height();
      append_storeys();
      append_installations();
      append_boundaries();
      append_solid();
    }
    append_text(xml_, "</bldg:Building>\n</cityObjectMember>\n");
    return fmt::to_string(xml_);
  }

 private:
  [[nodiscard]] std::string_view geometry_prefix() const { return is_v3_ ? "" : "bldg:"; }
  [[nodiscard]] std::string_view surface_prefix() const { return is_v3_ ? "con:" : "bldg:"; }

  void append_height() {
    const Extent extent = extent_of(body_.vertices);
    append_text(xml_, is_v3_ ? "<con:height><con:Height><con:value uom=\"m\">"
                             : "<bldg:measuredHeight uom=\"m\">");
    append_metres(xml_, extent.high.z - extent.low.z);
    append_text(xml_,
                is_v3_ ? "</con:value></con:Height></con:height>\n" : "</bldg:measuredHeight>\n");
  }

  void append_storeys() {
    append_format(xml_, "<bldg:storeysAboveGround>{}</bldg:storeysAboveGround>\n", body_.storeys);
  }

  void append_ring(const std::vector<int>& ring) {
    append_text(xml_, "<gml:LinearRing><gml:posList srsDimension=\"3\">");
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Point p = body_.vertices[at(ring[i % ring.size()])] + building_.origin;
      if (i > 0) xml_.push_back(' ');
      append_metres(xml_, p.x);
      xml_.push_back(' ');
      append_metres(xml_, p.y);
      xml_.push_back(' ');
      append_metres(xml_, p.z);
    }
    append_text(xml_, "</gml:posList></gml:LinearRing>");
  }

  void append_polygon(int polygon) {
    append_format(xml_, "<gml:surfaceMember><gml:Polygon gml:id=\"{}_p{}\">", building_.id,
                  polygon);
    const auto& rings = body_.polygons[at(polygon)].rings;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      append_text(xml_, r == 0 ? "<gml:exterior>" : "<gml:interior>");
      append_ring(rings[r]);
      append_text(xml_, r == 0 ? "</gml:exterior>" : "</gml:interior>");
    }
    append_text(xml_, "</gml:Polygon></gml:surfaceMember>\n");
  }

  void append_link(int polygon) {
    append_format(xml_, "<gml:surfaceMember xlink:href=\"#{}_p{}\"/>\n", building_.id, polygon);
  }

  void append_solid() {
    const std::string_view shell = is_v3_ ? "gml:Shell" : "gml:CompositeSurface";
    append_format(xml_, "<{}lod3Solid><gml:Solid><gml:exterior><{}>\n", geometry_prefix(), shell);
    for (const int polygon : all_)
      content_ == Content::labelled ? append_link(polygon) : append_polygon(polygon);
    append_format(xml_, "</{}></gml:exterior></gml:Solid></{}lod3Solid>\n", shell,
                  geometry_prefix());
  }

  void append_boundaries() {
    surfaces_ = surfaces_of(body_, all_);
    polygons_of_.resize(surfaces_.surfaces.size());
    for (const int polygon : all_)
      polygons_of_[at(surfaces_.of_polygon[at(polygon)])].push_back(polygon);
    const std::string_view property = is_v3_ ? "boundary" : "bldg:boundedBy";
    for (std::size_t s = 0; s < surfaces_.surfaces.size(); ++s) {
      const SemanticSurface& surface = surfaces_.surfaces[s];
      const bool is_opening = surface.type == "Window" || surface.type == "Door";
      if (is_opening && surface.parent >= 0) continue;
      append_format(xml_, "<{}>", property);
      // An opening stands in a surface, if need be in one without polygons.
      if (is_opening) {
        append_format(xml_, "<{}WallSurface>\n", surface_prefix());
        append_opening(s);
        append_format(xml_, "</{}WallSurface>", surface_prefix());
      } else {
        append_surface(s, surface.type);
      }
      append_format(xml_, "</{}>\n", property);
    }
  }

  void append_surface(std::size_t s, std::string_view type) {
    append_format(xml_, "<{}{} gml:id=\"{}_s{}\">\n", surface_prefix(), type, building_.id, s);
    append_labels(s);
    append_format(xml_, "<{}lod3MultiSurface><gml:MultiSurface>\n", geometry_prefix());
    for (const int polygon : polygons_of_[s]) append_polygon(polygon);
    append_format(xml_, "</gml:MultiSurface></{}lod3MultiSurface>\n", geometry_prefix());
    for (const int child : surfaces_.surfaces[s].children) append_opening(at(child));
    append_format(xml_, "</{}{}>", surface_prefix(), type);
  }

  void append_opening(std::size_t s) {
    const std::string property = is_v3_ ? "con:fillingSurface" : "bldg:opening";
    const std::string type(surfaces_.surfaces[s].type);
    append_format(xml_, "<{}>", property);
    append_surface(s, is_v3_ ? type + "Surface" : type);
    append_format(xml_, "</{}>\n", property);
  }

  void append_labels(std::size_t s) {
    const Object& object = body_.objects[at(surfaces_.surfaces[s].object)];
    append_generic("oriel_id", building_.id + "_" + object.name);
    append_generic("oriel_label", object.label());
    append_generic("oriel_subclass", object.subclass);
  }

  void append_generic(std::string_view name, std::string_view value) {
    if (is_v3_)
      append_format(xml_,
                    "<genericAttribute><gen:StringAttribute><gen:name>{}</gen:name><gen:value>{}"
                    "</gen:value></gen:StringAttribute></genericAttribute>\n",
                    name, value);
    else
      append_format(xml_,
                    "<gen:stringAttribute name=\"{}\"><gen:value>{}</gen:value>"
                    "</gen:stringAttribute>\n",
                    name, value);
  }

  void append_installations() {
    const std::vector<std::vector<int>> polygons = polygons_by_object(body_);
    const std::string_view property =
        is_v3_ ? "bldg:buildingInstallation" : "bldg:outerBuildingInstallation";
    for (std::size_t i = 0; i < body_.objects.size(); ++i) {
      const Object& object = body_.objects[i];
      if (is_surface(object.kind) || is_opening(object.kind)) continue;
      append_format(xml_, "<{}><bldg:BuildingInstallation gml:id=\"{}_{}\">\n", property,
                    building_.id, object.name);
      append_generic("oriel_label", object.label());
      append_generic("oriel_subclass", object.subclass);
      if (is_v3_) append_links(polygons[i], "lod3MultiSurface");
      append_format(xml_, "<bldg:class>1000</bldg:class>\n<bldg:function>{}</bldg:function>\n",
                    function_code(object.kind));
      if (!is_v3_) append_links(polygons[i], "bldg:lod3Geometry");
      append_format(xml_, "</bldg:BuildingInstallation></{}>\n", property);
    }
  }

  void append_links(const std::vector<int>& polygons, std::string_view property) {
    append_format(xml_, "<{}><gml:MultiSurface>\n", property);
    for (const int polygon : polygons) append_link(polygon);
    append_format(xml_, "</gml:MultiSurface></{}>\n", property);
  }

  const Building& building_;
  const Body& body_;
  Content content_;
  bool is_v3_;
  std::vector<int> all_;
  Surfaces surfaces_;
  std::vector<std::vector<int>> polygons_of_;
  Xml xml_;
};

}  // namespace

std::string citygml_head(CityGml version) {
  const bool is_v3 = version == CityGml::v3;
  const std::string_view number = is_v3 ? "3.0" : "2.0";
  Xml xml;
  append_format(xml,
                "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                "<CityModel xmlns=\"http://www.opengis.net/citygml/{0}\" "
                "xmlns:bldg=\"http://www.opengis.net/citygml/building/{0}\" "
                "xmlns:gen=\"http://www.opengis.net/citygml/generics/{0}\" "
                "xmlns:gml=\"http://www.opengis.net/gml{1}\" "
                "xmlns:xlink=\"http://www.w3.org/1999/xlink\"",
                number, is_v3 ? "/3.2" : "");
  if (is_v3) append_text(xml, " xmlns:con=\"http://www.opengis.net/citygml/construction/3.0\"");
  append_text(xml, ">\n");
  return fmt::to_string(xml);
}

std::string citygml_member(const Building& building, Content content, CityGml version) {
  return Writer(building, content, version).member();
}

std::string citygml_foot() { return "</CityModel>\n"; }

std::string citygml(const Building& building, Content content, CityGml version) {
  return citygml_head(version) + citygml_member(building, content, version) + citygml_foot();
}

}  // namespace oriel::generator
