#include "io/citygml/citygml_reader.h"

#include "io/citygml/citygml_objects.h"
#include "io/citygml/citygml_stream.h"
#include "io/citygml/citygml_text.h"
#include "io/citygml/gml_geometry.h"
#include "io/citygml/xml_node.h"
#include "io/cityjson/cityjson_reader.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// The first srsName in `node`.
std::string_view srs_name_in(const XmlNode& node) {
  if (const std::string_view name = node.attribute("srsName"); !name.empty()) return name;
  for (const XmlNode& child : node.children)
    if (const std::string_view name = srs_name_in(child); !name.empty()) return name;
  return {};
}

/// E213 if the building is so small that its coordinates must be degrees.
std::optional<Fault> find_degrees(const GmlVertices& vertices, Vec3 origin) {
  constexpr double kSmallest = 0.01;
  Box box;
  for (const auto& [x, y, z] : vertices.positions())
    box.grow(origin + kCityGmlScale * Vec3{static_cast<double>(x), static_cast<double>(y),
                                           static_cast<double>(z)});
  if (box.is_empty()) return std::nullopt;
  const Vec3 size = box.max - box.min;
  const bool is_on_globe = std::max(std::abs(box.min.x), std::abs(box.max.x)) <= 180 &&
                           std::max(std::abs(box.min.y), std::abs(box.max.y)) <= 180;
  if (!is_on_globe || size.x > kSmallest || size.y > kSmallest) return std::nullopt;
  return Fault{Code::E213,
               "the building is less than 1 cm wide: its coordinates look like degrees; "
               "expected metres"};
}

/// True if it or a part of it has a geometry of its own at some level of detail.
bool has_geometry(const CityGmlBuilding& building) {
  return std::ranges::any_of(building.objects, [](const CityGmlObject& object) {
    return (object.type == "Building" || object.type == "BuildingPart") &&
           !object.geometries.empty();
  });
}

}  // namespace

struct CityGmlReader::State {
  State(Input& input, TextName called, const ReadOptions& options)
      : name(std::move(called)),
        notes_unread(options.geometries != ReadGeometries::one),
        stream(input, name, notes_unread),
        cityjson(options) {}

  Checked<Document> read_header();
  Checked<Document> read_member(const XmlNode& member);
  std::string id_for(const XmlNode& member);
  std::optional<Fault> claim_ids(const CityGmlBuilding& building);
  Issue issue_at(const XmlNode& node, Severity severity, const std::string& building,
                 Fault fault) const;

  TextName name;
  bool notes_unread;
  CityGmlStream stream;
  CityJsonReader cityjson;
  /// Buildings that have nothing but implicit geometry.
  std::vector<UnreadObject> instances;
  std::optional<SequenceHeader> header;
  /// The building that was read to make the header.
  std::optional<XmlNode> first;
  /// The ids of all objects so far: the one thing that grows with the file.
  std::unordered_set<std::string> ids;
  std::size_t members = 0;
  bool is_done = false;
};

CityGmlReader::CityGmlReader(Input& input, TextName name, const ReadOptions& options)
    : state_(std::make_unique<State>(input, std::move(name), options)) {}

CityGmlReader::~CityGmlReader() = default;

std::optional<Checked<Document>> CityGmlReader::next() {
  if (state_->is_done) return std::nullopt;
  if (!state_->header) return state_->read_header();
  std::optional<XmlNode> member = std::move(state_->first);
  state_->first.reset();
  if (!member) member = state_->stream.next();
  if (member) return state_->read_member(*member);
  state_->is_done = true;
  if (!state_->stream.issue()) return std::nullopt;
  return Checked<Document>{std::nullopt, {*state_->stream.issue()}};
}

std::vector<UnreadObject> CityGmlReader::take_unread() {
  std::vector<UnreadObject> unread = state_->stream.take_unread();
  std::ranges::move(std::exchange(state_->instances, {}), std::back_inserter(unread));
  return unread;
}

Checked<Document> CityGmlReader::State::read_header() {
  first = stream.next();
  if (!first && stream.issue()) {
    is_done = true;
    return {std::nullopt, {*stream.issue()}};
  }
  header.emplace();
  std::string crs = stream.srs_name();
  if (first) {
    header->transform.translate = first_position(*first);
    if (crs.empty()) crs = srs_name_in(*first);
  }
  header->transform.scale = {kCityGmlScale, kCityGmlScale, kCityGmlScale};
  header->crs = reference_system_of(crs);
  auto source = std::make_shared<CityJsonSource>();
  source->text = citygml_header_text(*header);
  source->transform = header->transform;
  source->is_feature = true;
  Checked<Document> result;
  result.value = Document{name.file, Format::citygml, {}, std::move(source)};
  if (!first) {
    result.issues.push_back(error_in(name, {Code::E209, "has no Building"}));
    result.issues.back().severity = Severity::warning;
  }
  return result;
}

Issue CityGmlReader::State::issue_at(const XmlNode& node, Severity severity,
                                     const std::string& building, Fault fault) const {
  Issue issue = finding_of(name, severity, building, std::move(fault));
  issue.place.line = node.line;
  issue.place.column = node.column;
  return issue;
}

/// The building's gml:id, or a name by its number if it has none.
std::string CityGmlReader::State::id_for(const XmlNode& member) {
  if (!member.id().empty()) return object_id(member);
  std::string id = fmt::format("building_{}", members);
  while (ids.contains(id)) id += '_';
  return id;
}

/// Keeps the ids of all objects of a building, unless one stands in the file already.
std::optional<Fault> CityGmlReader::State::claim_ids(const CityGmlBuilding& building) {
  std::unordered_set<std::string> own;
  for (const CityGmlObject& object : building.objects)
    if (ids.contains(object.id) || !own.insert(object.id).second)
      return Fault{
          Code::E207,
          fmt::format(
              "the gml:id {} occurs twice in the file; the building with the first one is read",
              in_quotes(object.id))};
  ids.merge(own);
  return std::nullopt;
}

Checked<Document> CityGmlReader::State::read_member(const XmlNode& member) {
  ++members;
  const std::string id = id_for(member);
  XmlLinks links(member);
  GmlVertices vertices(header->transform.translate);
  GmlReader reader(links, vertices);
  std::optional<NodeFault> fault;
  std::optional<CityGmlBuilding> building = read_objects(member, id, links, reader, fault);
  if (building) {
    auto found = claim_ids(*building);
    if (!found) found = find_degrees(vertices, header->transform.translate);
    if (found) fault = {std::move(*found), &member};
  }
  Checked<Document> result;
  if (fault) {
    result.value = Document{fmt::format("{}:{}", name.file, member.line), Format::citygml, {}, {}};
    result.issues.push_back(issue_at(*fault->node, Severity::error, id, std::move(fault->fault)));
    return result;
  }
  result =
      cityjson.read(citygml_feature_text(*building, vertices), {name.file, member.line}, header);
  if (result.value) result.value->format = Format::citygml;
  if (notes_unread && building->implicit != nullptr && !has_geometry(*building))
    instances.push_back({id, "ImplicitGeometry"});
  const auto tell = [&](const XmlNode* node, Severity severity, Fault what) {
    if (node != nullptr) result.issues.push_back(issue_at(*node, severity, id, std::move(what)));
  };
  tell(links.duplicate(), Severity::warning,
       {Code::E207, "a gml:id occurs twice in the building; nothing links to it"});
  tell(reader.open_ring(), Severity::warning,
       {Code::E314,
        "a ring does not end where it began; it is read as if it did (val3dity 103 "
        "RING_NOT_CLOSED)"});
  tell(building->implicit, Severity::note, {Code::E206, "implicit geometries are not read"});
  return result;
}

}  // namespace oriel::detail
