#include "experiments/report/report.h"

#include "experiments/report/forms.h"
#include "experiments/report/tables.h"
#include "kernel/base/sha256.h"

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

using report::ReportSection;

std::string manifest_of(const ExperimentResults& results, const std::vector<ReportFile>& files) {
  using Json = nlohmann::ordered_json;
  Json manifest{
      {"schema", "oriel-manifest/1"}, {"name", results.name}, {"program", results.program}};
  manifest["options"] = Json::object();
  for (const auto& [name, value] : results.options) manifest["options"][name] = value;
  manifest["inputs"] = Json::array();
  for (const ExperimentInput& input : results.inputs)
    manifest["inputs"].push_back(
        {{"kind", input.kind}, {"path", input.path}, {"sha256", input.sha256}});
  manifest["files"] = Json::array();
  for (const ReportFile& file : files)
    manifest["files"].push_back(
        {{"path", file.path}, {"sha256", sha256(file.text)}, {"bytes", file.text.size()}});
  return manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::vector<ReportFile> report_files(const ExperimentResults& results) {
  std::vector<ReportSection> sections;
  for (report::RunGroup& group : report::groups_of(results.rows)) {
    ReportSection section{std::move(group), {}, {}};
    section.tables = tables_of(section.group);
    section.charts = charts_of(section.group);
    sections.push_back(std::move(section));
  }
  std::vector<ReportFile> files;
  files.push_back({"results.csv", report::csv_of(results.rows)});
  files.push_back({"report.md", markdown_of(results, sections)});
  files.push_back({"report.html", html_of(results, sections)});
  files.push_back({"tables.tex", latex_of(results, sections)});
  for (const ReportSection& section : sections)
    for (const report::Chart& chart : section.charts)
      files.push_back({"figures/" + chart.name + ".svg", svg_of(chart)});
  for (const ChangedBuildings& changed : results.changed)
    for (const ReportBuilding& one : changed.buildings)
      if (!one.svg.empty()) files.push_back({"figures/" + one.name + ".svg", one.svg});
  files.push_back({"manifest.json", manifest_of(results, files)});
  return files;
}

}  // namespace oriel
