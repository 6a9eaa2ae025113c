#include "io/records/operation_log.h"

#include "io/files/input.h"
#include "io/json/text.h"
#include "io/objects/label_members.h"
#include "io/records/log_seal.h"

#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

using nlohmann::ordered_json;

constexpr double kMicrometres = 1e6;

ordered_json json_of(const MemberValue& value) {
  return std::visit([](const auto& known) { return ordered_json(known); }, as_written(value));
}

ordered_json json_of(const SharedLabel& label) {
  ordered_json out = ordered_json::object();
  for_each_member(*label, [&](std::string_view name, const auto& value) {
    out[std::string(name)] = json_of(MemberValue(value));
  });
  return out;
}

ordered_json json_of(const MicrometreRing& ring) {
  ordered_json out = ordered_json::array();
  for (const MicrometrePoint& p : ring) {
    ordered_json point = ordered_json::array();
    for (const std::int64_t number : p) point.push_back(static_cast<double>(number) / kMicrometres);
    out.push_back(std::move(point));
  }
  return out;
}

ordered_json json_of(const std::vector<MicrometreRing>& rings) {
  ordered_json out = ordered_json::array();
  for (const MicrometreRing& ring : rings) out.push_back(json_of(ring));
  return out;
}

ordered_json json_of(const std::vector<std::pair<MicrometreRing, LevelFacet>>& facets) {
  ordered_json out = ordered_json::array();
  for (const auto& [outer, facet] : facets) {
    ordered_json one = ordered_json::object();
    one["rings"] = ordered_json::array({json_of(outer)});
    for (const MicrometreRing& hole : facet.holes) one["rings"].push_back(json_of(hole));
    one["type"] = facet.type;
    if (facet.label != SharedLabel()) one["members"] = json_of(facet.label);
    if (!facet.installations.empty()) one["installations"] = facet.installations;
    out.push_back(std::move(one));
  }
  return out;
}

template <class Map>
ordered_json json_of_changed(const Map& changed) {
  ordered_json out = ordered_json::object();
  for (const auto& [key, value] : changed) out[key] = value ? json_of(*value) : ordered_json();
  return out;
}

ordered_json json_of(const Change& change) {
  ordered_json out = ordered_json::object();
  if (!change.removed.empty()) out["remove"] = json_of(change.removed);
  if (!change.added.empty()) out["add"] = json_of(change.added);
  for (const auto& [outer, holes] : change.holes) {
    ordered_json one{{"of", json_of(outer)}};
    if (!holes.removed.empty()) one["remove"] = json_of(holes.removed);
    if (!holes.added.empty()) one["add"] = json_of(holes.added);
    out["holes"].push_back(std::move(one));
  }
  if (!change.installations.empty()) out["installations"] = json_of_changed(change.installations);
  if (!change.attributes.empty()) out["attributes"] = json_of_changed(change.attributes);
  return out;
}

MicrometreRing ring_of(const ordered_json& json) {
  MicrometreRing ring;
  for (const ordered_json& point : json) {
    MicrometrePoint p{};
    for (std::size_t i = 0; i < p.size(); ++i)
      p[i] = std::llround(point.at(i).get<double>() * kMicrometres);
    ring.push_back(p);
  }
  if (ring.size() < 3) throw std::runtime_error("a ring has fewer than three points");
  return ring;
}

std::vector<MicrometreRing> rings_of(const ordered_json& json, const char* key) {
  std::vector<MicrometreRing> rings;
  if (const auto found = json.find(key); found != json.end())
    for (const ordered_json& ring : *found) rings.push_back(ring_of(ring));
  return rings;
}

std::vector<std::pair<MicrometreRing, LevelFacet>> facets_of(const ordered_json& json,
                                                             const char* key) {
  std::vector<std::pair<MicrometreRing, LevelFacet>> facets;
  const auto found = json.find(key);
  if (found == json.end()) return facets;
  for (const ordered_json& one : *found) {
    std::vector<MicrometreRing> rings = rings_of(one, "rings");
    if (rings.empty()) throw std::runtime_error("a facet has no rings");
    LevelFacet facet;
    facet.holes.assign(rings.begin() + 1, rings.end());
    facet.type = one.at("type").get<std::string>();
    if (one.contains("members")) facet.label = label_of(one.at("members"));
    if (one.contains("installations")) one.at("installations").get_to(facet.installations);
    facets.emplace_back(std::move(rings[0]), std::move(facet));
  }
  return facets;
}

template <class Value, class Read>
void read_changed(const ordered_json& json, const char* key,
                  std::map<std::string, std::optional<Value>>& changed, const Read& read) {
  const auto found = json.find(key);
  if (found == json.end()) return;
  for (const auto& [name, value] : found->items())
    changed[name] = value.is_null() ? std::nullopt : std::optional<Value>(read(value));
}

Change change_of(const ordered_json& json) {
  Change change;
  change.removed = facets_of(json, "remove");
  change.added = facets_of(json, "add");
  if (const auto holes = json.find("holes"); holes != json.end())
    for (const ordered_json& one : *holes)
      change.holes[ring_of(one.at("of"))] = {rings_of(one, "remove"), rings_of(one, "add")};
  read_changed(json, "installations", change.installations,
               [](const ordered_json& members) { return label_of(members); });
  read_changed(json, "attributes", change.attributes, member_value);
  return change;
}

SeriesOperation operation_of(const ordered_json& json) {
  SeriesOperation operation;
  json.at("building").get_to(operation.building);
  if (json.contains("lod")) json.at("lod").get_to(operation.lod);
  json.at("oriel_id").get_to(operation.oriel_id);
  json.at("label").get_to(operation.label);
  json.at("operation").get_to(operation.operation);
  json.at("rule").get_to(operation.rule);
  json.at("scale").get_to(operation.scale);
  if (json.contains("with")) json.at("with").get_to(operation.with);
  if (json.contains("could_not_follow"))
    json.at("could_not_follow").get_to(operation.could_not_follow);
  const ordered_json& box = json.at("aabb");
  if (!box.is_null()) {
    operation.aabb_m.min = {box.at(0), box.at(1), box.at(2)};
    operation.aabb_m.max = {box.at(3), box.at(4), box.at(5)};
  }
  operation.forward = change_of(json.at("forward"));
  operation.inverse = change_of(json.at("inverse"));
  return operation;
}

SeriesOperation operation_in(std::string_view line, const TextName& name) {
  try {
    return operation_of(ordered_json::parse(line));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    std::string sentence = "is not an operation of a series: ";
    sentence += fault.what();
    throw InputError(error_in(name, {Code::E119, std::move(sentence)}));
  }
}

}  // namespace

std::string operation_line(const SeriesOperation& operation) {
  ordered_json out = ordered_json::object();
  out["building"] = operation.building;
  if (!operation.lod.empty()) out["lod"] = operation.lod;
  out["oriel_id"] = operation.oriel_id;
  out["label"] = operation.label;
  out["operation"] = operation.operation;
  out["rule"] = operation.rule;
  out["scale"] = operation.scale;
  if (!operation.with.empty()) out["with"] = operation.with;
  if (!operation.could_not_follow.empty()) out["could_not_follow"] = operation.could_not_follow;
  const Box& box = operation.aabb_m;
  out["aabb"] = box.is_empty() ? ordered_json() : ordered_json{box.min.x, box.min.y, box.min.z,
                                                               box.max.x, box.max.y, box.max.z};
  out["forward"] = json_of(operation.forward);
  out["inverse"] = json_of(operation.inverse);
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Checked<std::vector<SeriesOperation>> read_operations(std::string_view text,
                                                      const std::string& file) {
  Checked<std::vector<SeriesOperation>> out;
  std::vector<SeriesOperation> operations;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (is_end_of_log(line)) continue;
    try {
      operations.push_back(operation_in(line, {file, number}));
    } catch (const InputError& fault) {
      out.issues.push_back(fault.issue());
      return out;
    }
  }
  out.value = std::move(operations);
  return out;
}

struct OperationReader::File {
  explicit File(const std::string& path) : name{path, 0}, input(path) {}
  TextName name;
  Input input;
  std::string line;
};

OperationReader::OperationReader(const std::string& file) : file_(std::make_unique<File>(file)) {
  read();
}

OperationReader::~OperationReader() = default;

void OperationReader::read() {
  next_.reset();
  if (!file_->input.read_line(file_->line)) return;
  ++file_->name.line;
  if (is_end_of_log(file_->line)) return;
  next_ = operation_in(file_->line, file_->name);
}

SeriesOperation OperationReader::take() {
  SeriesOperation taken = std::move(*next_);
  read();
  return taken;
}

}  // namespace oriel
