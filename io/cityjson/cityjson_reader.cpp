#include "io/cityjson/cityjson_reader.h"

#include "io/cityjson/added_transform.h"
#include "io/cityjson/cityjson_geometry.h"
#include "io/cityjson/cityjson_objects.h"
#include "io/cityjson/id_set.h"
#include "io/cityjson/stream_header.h"
#include "io/json/dom.h"
#include "io/json/json_check.h"
#include "io/json/plain_parser.h"
#include "io/json/raw_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::detail {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::optional<Vec3> as_vector(const std::optional<dom::element>& element) {
  const auto array = as_array(element);
  if (!array) return std::nullopt;
  std::array<double, 3> numbers{};
  std::size_t count = 0;
  for (const dom::element value : *array) {
    const auto number = as_number(value);
    if (!number || count == 3) return std::nullopt;
    numbers[count++] = *number;
  }
  if (count != 3) return std::nullopt;
  return Vec3{numbers[0], numbers[1], numbers[2]};
}

/// Checks the members that say what kind of file this is.
std::optional<Fault> check_type(dom::object root, std::string_view expected) {
  const auto type = member(root, "type");
  if (as_string(type) != expected)
    return Fault{Code::E107,
                 type ? fmt::format("is JSON, but not {}: its 'type' is {}", expected,
                                    type->is_string() ? in_quotes(*as_string(type))
                                                      : std::string(found_kind(type)))
                      : fmt::format("is JSON, but not {0}: it has no 'type'; expected the type {0}",
                                    expected)};
  if (expected != "CityJSON") return std::nullopt;
  const auto version = member(root, "version");
  const std::string_view text = as_string(version).value_or(std::string_view());
  if (text == "1.0" || text == "1.1" || text == "2.0") return std::nullopt;
  return Fault{
      Code::E108,
      fmt::format("CityJSON version {}; expected \"1.0\", \"1.1\" or \"2.0\" (cjio upgrade "
                  "brings older files up to date)",
                  text.empty() ? std::string(found_kind(version)) : in_quotes(text))};
}

std::optional<Fault> read_transform(dom::object root, Transform& transform) {
  const auto element = member(root, "transform");
  if (!element)
    return Fault{Code::E201, fmt::format("has no 'transform', which {}",
                                         as_string(member(root, "version")) == "1.0"
                                             ? "a CityJSONSeq requires"
                                             : "CityJSON 1.1 and 2.0 require")};
  const auto object = as_object(element);
  const auto scale = object ? as_vector(member(*object, "scale")) : std::nullopt;
  const auto translate = object ? as_vector(member(*object, "translate")) : std::nullopt;
  if (!scale || !translate)
    return Fault{Code::E202, "'transform' must hold 'scale' and 'translate', three numbers each"};
  if (!(scale->x > 0 && scale->y > 0 && scale->z > 0))
    return Fault{Code::E202, "'scale' of 'transform' must be three numbers above 0"};
  transform = {*scale, *translate};
  return std::nullopt;
}

/// True for a file that may do without a transform, and does.
bool lacks_transform(dom::object root, const TextName& name) {
  const bool is_file = name.line == 0;
  return is_file && as_string(member(root, "type")) == "CityJSON" &&
         as_string(member(root, "version")) == "1.0" && !member(root, "transform");
}

/// The file's vertices; NaN for one that is not three whole numbers.
std::vector<Vec3> read_vertices(dom::array array) {
  std::vector<Vec3> vertices;
  vertices.reserve(array.size());
  for (const dom::element element : array) {
    const Vec3 v = as_vector(element).value_or(Vec3{kNaN, kNaN, kNaN});
    const bool is_whole =
        v.x == std::floor(v.x) && v.y == std::floor(v.y) && v.z == std::floor(v.z);
    vertices.push_back(is_whole ? v : Vec3{kNaN, kNaN, kNaN});
  }
  return vertices;
}

std::string read_crs(dom::object root) {
  const auto metadata = as_object(member(root, "metadata"));
  const auto crs = metadata ? as_string(member(*metadata, "referenceSystem")) : std::nullopt;
  return std::string(crs.value_or(std::string_view()));
}

/// What it says to the lines that follow, but the transform and the facts.
SequenceHeader read_header(dom::object root) {
  const auto version = as_string(member(root, "version"));
  return {{}, read_crs(root), std::string(version.value_or(std::string_view())), {}};
}

std::string facts_of(const std::string& text) {
  return stream_header_facts(std::string_view(text).substr(text.find_first_not_of(" \t\r\n")));
}

/// Where the members of "CityObjects" stand in a text, in their order; in a text that is no JSON
/// some places.
std::vector<TextRange> object_ranges(std::string_view text) {
  std::vector<TextRange> ranges;
  const auto note = [&](std::string_view, std::size_t at) {
    ranges.push_back({at, end_of_value(text, at)});
    return ranges.back().end;
  };
  const std::size_t start = skip_space(text, 0);
  if (start == text.size() || text[start] != '{') return ranges;
  for_each_member(text, start, [&](std::string_view key, std::size_t at) {
    const bool has_objects = at < text.size() && text[at] == '{' && decoded(key) == "CityObjects";
    return has_objects ? for_each_member(text, at, note) : end_of_value(text, at);
  });
  return ranges;
}

/// The members that hold the model.
struct Model {
  dom::object objects;
  /// As GeometryReader wants them: of `plain`, or `own`.
  const std::vector<Vec3>* vertices = nullptr;
  std::vector<Vec3> own;
};

/// `plain` is given if the root is that of PlainArrays::rest.
std::optional<Fault> read_model(dom::object root, const PlainArrays* plain, Model& model) {
  const auto objects = member(root, "CityObjects");
  const auto vertices = member(root, "vertices");
  for (const auto& [name, element] : {std::pair("CityObjects", objects), {"vertices", vertices}})
    if (!element) return Fault{Code::E201, fmt::format("has no '{}'", name)};
  if (!objects->is_object())
    return Fault{Code::E202,
                 fmt::format("'CityObjects' is {}; expected an object", found_kind(objects))};
  if (!vertices->is_array())
    return Fault{Code::E202,
                 fmt::format("'vertices' is {}; expected an array", found_kind(vertices))};
  model.objects = *as_object(objects);
  if (plain == nullptr) model.own = read_vertices(*as_array(vertices));
  model.vertices = plain != nullptr ? &plain->vertices(number_of_array(*vertices)) : &model.own;
  return std::nullopt;
}

/// Polygons by their corners, whichever way round.
using PolygonCorners = std::set<std::vector<int>>;

std::vector<int> sorted_corners(const Polygon& polygon) {
  std::vector<int> corners;
  for (const auto& ring : polygon.rings) corners.insert(corners.end(), ring.begin(), ring.end());
  std::ranges::sort(corners);
  return corners;
}

/// Adds the corners of the polygons from `first` on; true if one of them was not there yet.
bool add_corners(const Building& building, std::size_t first, PolygonCorners& corners) {
  bool is_new = false;
  for (std::size_t i = first; i < building.polygons.size(); ++i)
    is_new = corners.insert(sorted_corners(building.polygons[i])).second || is_new;
  return is_new;
}

/// Takes the polygons from `first` on away again; they use no vertex that others do not use.
void drop_polygons(Building& building, std::size_t first) {
  building.polygons.resize(first);
  std::erase_if(building.repeats, [&](const RepeatedVertex& repeat) {
    return static_cast<std::size_t>(repeat.polygon) >= first;
  });
}

/// Names what an entry has at the level of the geometry that is read besides that (E215).
std::optional<Fault> unused_geometries(const ObjectEntry& entry, const GeometryEntry& read) {
  const auto name = [](const GeometryEntry& geometry) {
    return fmt::format("geometry {} ({})", geometry.number, geometry.kind.name);
  };
  std::vector<std::string> unused;
  for (const GeometryEntry& geometry : entry.geometries)
    if (geometry.lod == read.lod && geometry.number != read.number)
      unused.push_back(name(geometry));
  if (unused.empty()) return std::nullopt;
  return Fault{Code::E215,
               fmt::format("has {} geometries at lod {}: {} is used, not {}", unused.size() + 1,
                           read.lod, name(read), fmt::join(unused, ", "))};
}

/// Those that stand on the entry `host`.
std::span<const InstallationEntry> installations_on(const std::vector<InstallationEntry>& all,
                                                    std::size_t host) {
  return std::ranges::equal_range(all, host, {}, &InstallationEntry::host);
}

/// Adds the polygons of what stands on an entry to `building`, which was read last. One
/// with a fault is left out, with a warning, and so is one whose polygons the building has all.
/// `geometry_of(entry, geometry)` gives what `geometries` is to read.
template <class GeometryOf>
std::vector<GeometryPlace> join_installations(std::span<const InstallationEntry> installations,
                                              const GeometryOf& geometry_of,
                                              GeometryReader& geometries, Building& building,
                                              std::vector<Fault>& warnings) {
  std::vector<GeometryPlace> places;
  PolygonCorners corners;
  for (const auto& [object, _] : installations) {
    const auto warn = [&](Fault fault) {
      fault.sentence = fmt::format("installation {}: {}", in_quotes(object.id), fault.sentence);
      warnings.push_back(std::move(fault));
    };
    if (object.fault) warn(*object.fault);
    const GeometryEntry* geometry = object.fault ? nullptr : geometry_at(object, building.lod);
    if (geometry == nullptr) continue;
    const std::size_t first = building.polygons.size();
    const std::size_t first_vertex = building.vertices.size();
    if (corners.empty()) add_corners(building, 0, corners);
    if (auto fault = geometries.add(geometry_of(object, *geometry), geometry->kind, building)) {
      warn(std::move(*fault));
      continue;
    }
    if (!add_corners(building, first, corners)) {
      drop_polygons(building, first);
      continue;
    }
    for (const Fault& warning : geometries.warnings()) warn(warning);
    if (auto unused = unused_geometries(object, *geometry)) warn(std::move(*unused));
    building.installations.push_back({std::string(object.id), first, first_vertex});
    places.push_back({object.number, geometry->number});
  }
  return places;
}

/// `chosen` may be null.
std::vector<const GeometryEntry*> geometries_to_read(const ObjectEntry& entry,
                                                     const GeometryEntry* chosen,
                                                     ReadGeometries which) {
  std::vector<const GeometryEntry*> taken;
  if (which == ReadGeometries::one && chosen != nullptr) taken.push_back(chosen);
  if (which == ReadGeometries::one || entry.fault) return taken;
  for (const GeometryEntry& geometry : entry.geometries)
    if (which == ReadGeometries::all || (chosen != nullptr && geometry.lod == chosen->lod))
      taken.push_back(&geometry);
  return taken;
}

/// A building whose geometry left.
Building emptied_building(const ObjectEntry& entry, const Transform& transform,
                          const std::string& crs) {
  Building building;
  building.id = entry.id;
  building.lod = *entry.emptied_lod;
  building.frame.crs = crs;
  building.frame.origin_m = transform.translate;
  return building;
}

/// The type of a CityObject; empty if there is none.
std::string type_of(dom::element member) {
  const auto object = as_object(member);
  const auto type = object ? as_string(detail::member(*object, "type")) : std::nullopt;
  return std::string(type.value_or(std::string_view()));
}

/// A geometry that was read while its object was listed.
struct GeometryRead {
  Building building;
  std::optional<Fault> fault;
  std::vector<Fault> warnings;
};

}  // namespace

struct CityJsonReader::State {
  ReadOptions options;
  SequenceHeader header;
  std::string refused;
  IdSet ids;               ///< of the features so far
  bool is_astray = false;  ///< the last header was not that of the stream
  std::vector<UnreadObject> unread;

  /// Of a line the text, of a file all but the members of "CityObjects": each is parsed by itself.
  PlainParser root_parser;
  std::vector<TextRange> objects;  ///< those of a file
  PlainParser object_parser;
  std::optional<std::size_t> parsed;  ///< which of them it has parsed
  dom::element object;                ///< this one
  std::vector<dom::element> members;  ///< those of a line

  std::optional<Fault> check_feature(dom::object root, const SequenceHeader& of);
  std::optional<Fault> check_header(const std::string& text, const SequenceHeader& of);
  simdjson::error_code parse_object(const std::string& text, std::size_t number);
  void forget();
  std::optional<Issue> parse(const std::string& text, const TextName& name, dom::object& root);
  std::optional<Issue> parse_objects(const std::string& text, const TextName& name,
                                     std::size_t first = 0);
  std::optional<Issue> read_buildings(const Model& model, const std::string& text,
                                      const TextName& name, Document& document,
                                      CityJsonSource& source, std::vector<Issue>& issues);
};

CityJsonReader::CityJsonReader(ReadOptions options) : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
}

CityJsonReader::~CityJsonReader() = default;

const std::string& CityJsonReader::refused() const { return state_->refused; }

const SequenceHeader& CityJsonReader::header() const { return state_->header; }

std::vector<UnreadObject> CityJsonReader::take_unread() {
  return std::exchange(state_->unread, {});
}

namespace {

Issue json_error(const std::string& text, const TextName& name, simdjson::error_code error) {
  if (auto issue = find_json_error(name, text)) return std::move(*issue);
  return error_in(name,
                  {Code::E104, fmt::format("not valid JSON: {}", simdjson::error_message(error))});
}

}  // namespace

std::optional<Issue> CityJsonReader::State::parse(const std::string& text, const TextName& name,
                                                  dom::object& root) {
  members.clear();
  parsed.reset();
  if (name.line == 0) objects = object_ranges(text);
  dom::element element;
  auto error = root_parser.parse(text, text.capacity() - text.size(), element, objects);
  if (error == simdjson::SUCCESS) error = element.get(root);
  if (error == simdjson::SUCCESS) return std::nullopt;
  return json_error(text, name, error);
}

/// Of a whole file nothing comes after it.
void CityJsonReader::State::forget() {
  root_parser = {};
  object_parser = {};
  objects = std::vector<TextRange>();
}

/// Puts the CityObject of that number into `object`.
simdjson::error_code CityJsonReader::State::parse_object(const std::string& text,
                                                         std::size_t number) {
  if (parsed == number) return simdjson::SUCCESS;
  if (number < members.size()) {
    object = members[number];
    return simdjson::SUCCESS;
  }
  const auto [begin, end] = objects[number];
  parsed = number;
  // It stands two levels deep.
  return object_parser.parse(std::string_view(text).substr(begin, end - begin),
                             text.capacity() - end, object, {}, PlainParser::kDepth - 2);
}

/// Says what is wrong if one of the members from `first` on is no JSON.
std::optional<Issue> CityJsonReader::State::parse_objects(const std::string& text,
                                                          const TextName& name, std::size_t first) {
  for (std::size_t i = first; i < objects.size(); ++i)
    if (const auto error = parse_object(text, i); error != simdjson::SUCCESS)
      return json_error(text, name, error);
  return std::nullopt;
}

std::optional<Issue> CityJsonReader::State::read_buildings(const Model& model,
                                                           const std::string& text,
                                                           const TextName& name, Document& document,
                                                           CityJsonSource& source,
                                                           std::vector<Issue>& issues) {
  const bool is_one = options.geometries == ReadGeometries::one;
  GeometryReader geometries(*model.vertices, source.transform);
  const auto geometry_of = [&](const ObjectEntry& of, const GeometryEntry& geometry) {
    parse_object(text, of.number);
    if (!parsed) {
      geometries.use(root_parser.arrays(), text);
    } else {
      const auto [begin, end] = objects[of.number];
      geometries.use(object_parser.arrays(), std::string_view(text).substr(begin, end - begin));
    }
    return *as_object(as_array(member(*as_object(object), "geometry"))->at(geometry.number));
  };
  const auto read_now = [&](const ObjectEntry& of, const GeometryEntry& geometry) {
    GeometryRead read;
    read.building.id = of.id;
    read.building.lod = geometry.lod;
    read.building.frame.crs = header.crs;
    read.fault = geometries.read(geometry_of(of, geometry), geometry.kind, read.building);
    read.warnings = geometries.warnings();
    return read;
  };
  ObjectList list(header.version == "1.0", is_one ? ListedObjects::buildings : ListedObjects::all);
  // By entry and number: what is probably chosen is read while its object is there.
  std::vector<std::map<std::size_t, GeometryRead>> ahead;
  std::size_t number = 0;
  for (const dom::key_value_pair field : model.objects) {
    if (name.line > 0) members.push_back(field.value);
    if (const auto error = parse_object(text, number); error != simdjson::SUCCESS)
      return json_error(text, name, error);
    if (const PlainArrays* plain = object_parser.arrays())
      for (std::size_t i = 0; i < plain->size(); ++i)
        source.arrays.push_back({objects[number].begin + plain->place(i).begin,
                                 objects[number].begin + plain->place(i).end});
    if (name.line > 0 && document.feature_type.empty() && field.key == document.feature_id)
      document.feature_type = type_of(object);
    if (list.add(number++, field.key, object)) {
      const ObjectEntry& entry = list.entries().back();
      auto& reads = ahead.emplace_back();
      if (!parsed) continue;
      for (const GeometryEntry* geometry :
           geometries_to_read(entry, probable_geometry(entry, options.lod), options.geometries))
        reads.emplace(geometry->number, read_now(entry, *geometry));
    }
  }
  if (auto issue = parse_objects(text, name, number)) return issue;
  const std::vector<ObjectEntry>& entries = list.entries();
  const std::vector<std::size_t> families = families_of(entries);
  const std::vector<GeometryChoice> choices = choose_geometries(entries, families, options.lod);
  const std::vector<InstallationEntry> installations = list.take_installations();
  document.buildings.reserve(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const ObjectEntry& entry = entries[i];
    if (options.keeps_emptied && entry.emptied_lod) {
      document.buildings.push_back(emptied_building(entry, source.transform, header.crs));
      source.places.push_back({entry.number, kNoGeometry});
      source.joined.emplace_back();
      document.families.push_back(families[i]);
      continue;
    }
    const auto report = [&](Severity severity, const Fault& fault) {
      issues.push_back(finding_of(name, severity, entry.id, fault));
    };
    if (entry.has_instances)
      report(Severity::note, {Code::E206, "geometry templates (GeometryInstance) are not read"});
    if (!is_one && entry.has_instances && entry.geometries.empty())
      unread.push_back({std::string(entry.id), "GeometryInstance"});
    const auto standing = installations_on(installations, i);
    const std::vector<const GeometryEntry*> taken =
        geometries_to_read(entry, choices[i].geometry, options.geometries);
    if (choices[i].finding && taken.empty()) report(choices[i].severity, *choices[i].finding);
    const auto keep_beside = [&](const ObjectEntry& of, std::optional<Severity> severity) {
      for (const GeometryEntry& geometry : of.geometries) {
        if (geometry.lod != taken[0]->lod || &geometry == taken[0]) continue;
        GeometryRead rest = read_now(of, geometry);
        if (!rest.fault) source.beside.emplace(entry.id, std::move(rest.building));
        if (rest.fault && severity) report(*severity, *rest.fault);
      }
    };
    if (is_one && !taken.empty()) {
      if (const auto unused = unused_geometries(entry, *taken[0]))
        report(Severity::warning, *unused);
      keep_beside(entry, Severity::warning);
      // Where installations are joined their faults are named then.
      const auto of_installations =
          options.joins_installations ? std::nullopt : std::optional(Severity::warning);
      for (const InstallationEntry& installation : standing)
        keep_beside(installation.object, of_installations);
    }
    for (const GeometryEntry* geometry : taken) {
      const auto found = ahead[i].find(geometry->number);
      const bool is_read = found != ahead[i].end() && standing.empty();
      GeometryRead read = is_read ? std::move(found->second) : read_now(entry, *geometry);
      if (read.fault) {
        report(Severity::error, *read.fault);
        continue;
      }
      source.joined.emplace_back();
      if (options.joins_installations)
        source.joined.back() =
            join_installations(standing, geometry_of, geometries, read.building, read.warnings);
      for (const Fault& warning : read.warnings) report(Severity::warning, warning);
      document.buildings.push_back(std::move(read.building));
      source.places.push_back({entry.number, geometry->number});
      document.families.push_back(entry.is_building ? families[i] : kNoFamily);
    }
    ahead[i].clear();
  }
  if (entries.empty() && name.line == 0) {
    issues.push_back(error_in(name, {Code::E209, "has no Building and no BuildingPart"}));
    issues.back().severity = Severity::warning;
  }
  return std::nullopt;
}

/// A header among the features: nothing is wrong with the one that the stream has.
std::optional<Fault> CityJsonReader::State::check_header(const std::string& text,
                                                         const SequenceHeader& of) {
  const std::string facts = facts_of(text);
  is_astray = facts != of.facts;
  if (!is_astray) return std::nullopt;
  return Fault{Code::E116, fmt::format("is a header with {}; the header of the stream has {}",
                                       facts, of.facts)};
}

std::optional<Fault> CityJsonReader::State::check_feature(dom::object root,
                                                          const SequenceHeader& of) {
  if (is_astray) return Fault{Code::E116, "follows a header that differs from that of the stream"};
  const auto version = member(root, "version");
  if (version && as_string(version) != of.version)
    return Fault{Code::E108, fmt::format("its 'version' is {}; the header says \"{}\"",
                                         version->is_string() ? in_quotes(*as_string(version))
                                                              : std::string(found_kind(version)),
                                         of.version)};
  const auto id = as_string(member(root, "id"));
  if (id && !ids.insert(*id))
    return Fault{Code::E207, "an earlier line of the stream has this id; that one is read"};
  return std::nullopt;
}

Checked<Document> CityJsonReader::read(std::string text, const TextName& name,
                                       const std::optional<SequenceHeader>& header) {
  Checked<Document> result;
  std::string id;  // of a feature
  const auto give_up = [&](Issue issue) {
    result.issues = {std::move(issue)};
    state_->refused = std::move(text);
    return std::move(result);
  };
  // What is no JSON is nothing else.
  const auto refuse = [&](const Fault& fault) {
    if (auto broken = state_->parse_objects(text, name)) return give_up(std::move(*broken));
    Issue issue = error_in(name, fault);
    if (issue.place.building.empty() && !id.empty()) issue.place.building = id;
    return give_up(std::move(issue));
  };
  dom::object root;
  auto issue = state_->parse(text, name, root);
  if (!issue && lacks_transform(root, name)) {
    add_transform(text);
    issue = state_->parse(text, name, root);
  }
  if (issue) return give_up(std::move(*issue));
  if (header && as_string(member(root, "type")) == "CityJSON") {
    if (const auto fault = state_->check_header(text, *header)) return refuse(*fault);
    return result;
  }
  if (const auto fault = check_type(root, header ? "CityJSONFeature" : "CityJSON"))
    return refuse(*fault);
  if (header) {
    id = as_string(member(root, "id")).value_or(std::string_view());
    if (const auto fault = state_->check_feature(root, *header)) return refuse(*fault);
  }
  state_->header = header ? *header : read_header(root);
  if (!header && name.line > 0) state_->header.facts = facts_of(text);
  if (!header)
    if (const auto fault = read_transform(root, state_->header.transform)) return refuse(*fault);
  Model model;
  const PlainArrays* plain = state_->root_parser.arrays();
  if (const auto fault = read_model(root, plain, model)) return refuse(*fault);

  auto source = std::make_shared<CityJsonSource>();
  source->transform = state_->header.transform;
  source->is_feature = header.has_value();
  Document document;
  document.name = name.line > 0 ? fmt::format("{}:{}", name.file, name.line) : name.file;
  document.format = name.line > 0 ? Format::cityjson_seq : Format::cityjson;
  if (header) {
    document.feature_id = id;
    document.feature_type.clear();
  }
  if ((issue = state_->read_buildings(model, text, name, document, *source, result.issues)))
    return give_up(std::move(*issue));
  for (std::size_t i = 0; plain != nullptr && i < plain->size(); ++i)
    source->arrays.push_back(plain->place(i));
  std::ranges::sort(source->arrays, {}, &TextRange::begin);
  if (name.line == 0) state_->forget();
  source->text = std::move(text);
  document.source = std::move(source);
  result.value = std::move(document);
  return result;
}

}  // namespace oriel::detail
