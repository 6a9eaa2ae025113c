#include "cli/batch/outcome.h"

#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

ordered_json to_json(const std::vector<Issue>& issues) {
  ordered_json list = ordered_json::array();
  for (const Issue& issue : issues)
    list.push_back({static_cast<int>(issue.severity), to_string(issue.code), issue.sentence,
                    issue.place.file, issue.place.line, issue.place.column, issue.place.building,
                    issue.place.feature, issue.excerpt});
  return list;
}

std::vector<Issue> issues_of(const ordered_json& list) {
  std::vector<Issue> issues;
  for (const ordered_json& entry : list) {
    Issue issue;
    issue.severity = static_cast<Severity>(entry.at(0).get<int>());
    issue.code = code_of(entry.at(1).get<std::string>()).value_or(Code::none);
    issue.sentence = entry.at(2);
    issue.place = {entry.at(3), entry.at(4), entry.at(5), entry.at(6), entry.at(7)};
    issue.excerpt = entry.at(8);
    issues.push_back(std::move(issue));
  }
  return issues;
}

}  // namespace

void Product::flatten() {
  if (file) (*this)[OutputPart::buildings] = file->text(issues);
  file.reset();
}

ordered_json to_json(const RecordOutcome& outcome) {
  ordered_json buildings = ordered_json::array();
  for (const BuildingOutcome& building : outcome.buildings)
    buildings.push_back({{"passed_over", building.is_passed_over},
                         {"done", building.is_done},
                         {"open", building.is_open},
                         {"has_features", building.has_features},
                         {"features", building.labels},
                         {"issues", to_json(building.issues)}});
  return {{"buildings", buildings},
          {"issues", to_json(outcome.product.issues)},
          {"counts", outcome.product.counts}};
}

RecordOutcome outcome_of(const ordered_json& json) {
  RecordOutcome outcome;
  for (const ordered_json& building : json.at("buildings"))
    outcome.buildings.push_back({building.at("passed_over"), building.at("done"),
                                 building.at("open"), building.at("has_features"),
                                 building.at("features").get<std::map<std::string, int>>(),
                                 issues_of(building.at("issues"))});
  outcome.product.issues = issues_of(json.at("issues"));
  outcome.product.counts = json.at("counts").get<std::map<std::string, int>>();
  return outcome;
}

}  // namespace oriel::cli
