#include "experiments/measured_store.h"

#include "io/files/input.h"
#include "io/files/output_file.h"
#include "kernel/base/sha256.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

using MeasuredJson = nlohmann::ordered_json;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr ExperimentPart kAllParts[] = {ExperimentPart::sweep,          ExperimentPart::ablate,
                                        ExperimentPart::compare,        ExperimentPart::stability,
                                        ExperimentPart::learning_curve, ExperimentPart::learn};

MeasuredJson number_json(double value) {
  return std::isnan(value) ? MeasuredJson() : MeasuredJson(value);
}
double number_of(const MeasuredJson& json) { return json.is_null() ? kNone : json.get<double>(); }

MeasuredJson json_of_interval(const ConfidenceInterval& interval) {
  return {number_json(interval.low), number_json(interval.high)};
}
ConfidenceInterval interval_of_json(const MeasuredJson& json) {
  return {number_of(json.at(0)), number_of(json.at(1))};
}

MeasuredJson setting_json(const RunSetting& setting) {
  return {{"name", setting.name},
          {"variable", setting.variable},
          {"value", setting.value ? MeasuredJson(*setting.value) : MeasuredJson()},
          {"unit", setting.unit},
          {"is_baseline", setting.is_baseline}};
}
RunSetting setting_from(const MeasuredJson& json) {
  RunSetting setting{json.at("name"), json.at("variable"), std::nullopt, json.at("unit"),
                     json.at("is_baseline")};
  if (!json.at("value").is_null()) setting.value = json.at("value").get<double>();
  return setting;
}

MeasuredJson row_json(const ResultRow& row) {
  MeasuredJson json{
      {"part", to_string(row.part)},
      {"set", row.set},
      {"pack", row.pack},
      {"setting", setting_json(row.setting)},
      {"label", row.label},
      {"counts",
       {row.counts.true_positives, row.counts.false_positives, row.counts.false_negatives}},
      {"ratios", {number_json(row.precision), number_json(row.recall), number_json(row.f1)}}};
  if (row.f1_interval) json["interval"] = json_of_interval(*row.f1_interval);
  if (row.difference)
    json["difference"] = {number_json(row.difference->f1),
                          json_of_interval(row.difference->interval),
                          number_json(row.difference->p)};
  return json;
}
ResultRow row_from(const MeasuredJson& json) {
  ResultRow row;
  for (const ExperimentPart part : kAllParts)
    if (json.at("part") == to_string(part)) row.part = part;
  row.set = json.at("set");
  row.pack = json.at("pack");
  row.setting = setting_from(json.at("setting"));
  row.label = json.at("label");
  const MeasuredJson &counts = json.at("counts"), &ratios = json.at("ratios");
  row.counts = {counts.at(0), counts.at(1), counts.at(2)};
  row.precision = number_of(ratios.at(0));
  row.recall = number_of(ratios.at(1));
  row.f1 = number_of(ratios.at(2));
  if (json.contains("interval")) row.f1_interval = interval_of_json(json["interval"]);
  if (json.contains("difference")) {
    const MeasuredJson& difference = json["difference"];
    row.difference =
        PairedDifference{number_of(difference.at(0)), interval_of_json(difference.at(1)),
                         number_of(difference.at(2))};
  }
  return row;
}

MeasuredJson table_json(const ReportTable& table) {
  return {{"title", table.title},
          {"caption", table.caption},
          {"header", table.header},
          {"rows", table.rows}};
}
ReportTable table_from(const MeasuredJson& json) {
  return {json.at("title"), json.at("caption"), json.at("header"), json.at("rows")};
}

MeasuredJson changed_json(const ChangedBuildings& changed) {
  MeasuredJson json{{"sentence", changed.sentence}, {"buildings", MeasuredJson::array()}};
  for (const ReportBuilding& one : changed.buildings)
    json["buildings"].push_back(MeasuredJson::array({one.name, one.title, one.caption, one.svg}));
  return json;
}
ChangedBuildings changed_from(const MeasuredJson& json) {
  ChangedBuildings changed{json.at("sentence"), {}};
  for (const MeasuredJson& one : json.at("buildings"))
    changed.buildings.push_back({one.at(0), one.at(1), one.at(2), one.at(3)});
  return changed;
}

MeasuredPart part_from(const MeasuredJson& json) {
  MeasuredPart part;
  for (const MeasuredJson& row : json.at("rows")) part.rows.push_back(row_from(row));
  for (const MeasuredJson& table : json.at("tables")) part.tables.push_back(table_from(table));
  for (const MeasuredJson& changed : json.at("changed"))
    part.changed.push_back(changed_from(changed));
  part.left_out = json.at("left_out").get<std::vector<std::string>>();
  return part;
}

}  // namespace

MeasuredStore::MeasuredStore(std::string folder) : folder_(std::move(folder)) {}

std::string MeasuredStore::path_of(const std::string& key) const {
  return folder_ + "/" + sha256(key) + ".json";
}

std::optional<MeasuredPart> MeasuredStore::find(const std::string& key) const {
  std::error_code problem;
  if (folder_.empty() || !std::filesystem::exists(path_of(key), problem)) return std::nullopt;
  const auto json = MeasuredJson::parse(Input(path_of(key)).read_all(), nullptr, false);
  try {
    return part_from(json);
  } catch (const MeasuredJson::exception&) {
    return std::nullopt;  // somebody else's, or cut off: it is measured again
  }
}

void MeasuredStore::keep(const std::string& key, const MeasuredPart& part) const {
  if (folder_.empty()) return;
  MeasuredJson json{{"rows", MeasuredJson::array()},
                    {"tables", MeasuredJson::array()},
                    {"changed", MeasuredJson::array()},
                    {"left_out", part.left_out}};
  for (const ResultRow& row : part.rows) json["rows"].push_back(row_json(row));
  for (const ReportTable& table : part.tables) json["tables"].push_back(table_json(table));
  for (const ChangedBuildings& changed : part.changed)
    json["changed"].push_back(changed_json(changed));
  std::error_code problem;
  std::filesystem::create_directories(folder_, problem);
  write_file(path_of(key),
             json.dump(-1, ' ', false, MeasuredJson::error_handler_t::replace) + "\n");
}

}  // namespace oriel
