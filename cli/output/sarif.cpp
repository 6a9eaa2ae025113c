#include "cli/output/sarif.h"

#include "model/version.h"
#include "oriel/rules.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

/// Findings without a code of their own.
constexpr const char* kNoCode = "oriel";

std::string id_of(Code code) { return code == Code::none ? kNoCode : to_string(code); }

/// What SARIF calls a severity: the same words.
std::string level_of(Severity severity) { return to_string(severity); }

ordered_json rule_of(Code code) {
  ordered_json rule{{"id", id_of(code)}};
  if (code == Code::none) {
    rule["shortDescription"]["text"] = "A finding without a code";
    return rule;
  }
  const std::string meaning(meaning_of(code));
  rule["shortDescription"]["text"] = meaning;
  const std::string help(page_of(code).empty() ? meaning : page_of(code));
  rule["help"] = {{"text", help}, {"markdown", help}};
  rule["helpUri"] = fmt::format("{}/{}#{}", ORIEL_DOCS_URL, document_of(code), anchor_of(code));
  return rule;
}

/// A path as a URI reference: relative to where the command runs, or file://.
std::string uri_of(const std::string& path) {
  std::string uri = std::filesystem::path(path).is_absolute() ? "file://" : "";
  for (const char c : path) {
    const auto u = static_cast<unsigned char>(c);
    const bool is_plain =
        std::isalnum(u) != 0 || std::string_view("-._~/").find(c) != std::string_view::npos;
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", u);
  }
  return uri;
}

ordered_json location_of(const Issue& issue) {
  ordered_json location = ordered_json::object();
  const Place& place = issue.place;
  if (!place.file.empty()) {
    ordered_json& physical = location["physicalLocation"];
    physical["artifactLocation"]["uri"] = uri_of(place.file);
    if (place.line > 0) {
      physical["region"]["startLine"] = place.line;
      if (place.column > 0) physical["region"]["startColumn"] = place.column;
      const std::string line = issue.excerpt.substr(0, issue.excerpt.find('\n'));
      if (!line.empty()) physical["region"]["snippet"]["text"] = line;
    }
  }
  if (!place.building.empty()) {
    const std::string name =
        place.feature.empty() ? place.building : place.building + "/" + place.feature;
    location["logicalLocations"].push_back({{"fullyQualifiedName", name}, {"kind", "element"}});
  }
  return location;
}

}  // namespace

std::string SarifLog::text() const {
  std::map<std::string, Code> codes;
  for (const Issue& issue : issues_) codes.emplace(id_of(issue.code), issue.code);
  ordered_json rules = ordered_json::array(), results = ordered_json::array();
  for (const auto& [id, code] : codes) rules.push_back(rule_of(code));
  for (const Issue& issue : issues_) {
    const std::string id = id_of(issue.code);
    ordered_json result{{"ruleId", id},
                        {"ruleIndex", std::distance(codes.begin(), codes.find(id))},
                        {"level", level_of(issue.severity)},
                        {"message", {{"text", issue.sentence}}}};
    ordered_json location = location_of(issue);
    if (!location.empty()) result["locations"].push_back(std::move(location));
    results.push_back(std::move(result));
  }
  const ordered_json driver{
      {"name", "oriel"}, {"semanticVersion", std::string(kVersion)}, {"rules", std::move(rules)}};
  ordered_json run;
  run["tool"]["driver"] = driver;
  run["columnKind"] = "unicodeCodePoints";  // as in Place; without it they would be UTF-16 units
  run["results"] = std::move(results);
  ordered_json log;
  log["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  log["version"] = "2.1.0";
  log["runs"].push_back(std::move(run));
  return log.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace oriel::cli
