#include "cli/output/change_report.h"

#include "kernel/base/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

/// Ids of OBJ and records may be any bytes.
constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;

}  // namespace

void ChangeReport::name_files(NamedFiles& files) const {
  files.add_output("--explain", explain_);
  files.add_output("--metrics", metrics_);
}

void ChangeReport::begin(bool is_rehearsal) {
  if (is_rehearsal) return;
  if (!changes_file_ && !explain_.empty()) changes_file_ = std::make_unique<OutputFile>(explain_);
  if (!metrics_file_ && !metrics_.empty()) metrics_file_ = std::make_unique<OutputFile>(metrics_);
}

std::string ChangeReport::text(const std::string& building, const std::string& target,
                               const std::vector<FeatureOutcome>& outcomes) const {
  std::string all;
  if (explain_.empty()) return all;
  const bool is_json = explain_.ends_with(".jsonl");
  for (const FeatureOutcome& one : outcomes) {
    if (is_json) {
      nlohmann::ordered_json line = nlohmann::ordered_json::object();
      line["building"] = building;
      line["target"] = target;
      line["feature"] = one.feature;
      line["label"] = one.label;
      line["outcome"] = one.outcome;
      line["operation"] = one.operation;
      line["rule"] = one.rule;
      line["code"] = to_string(one.code);
      line["reason"] = one.reason;
      all += line.dump(-1, ' ', false, kReplace) + "\n";
      continue;
    }
    std::string text = fmt::format("{} {} {} {}: {}", target, building, one.feature,
                                   one.label.empty() ? "unknown" : one.label, one.outcome);
    if (!one.operation.empty()) text += fmt::format(", {} by {}", one.operation, one.rule);
    if (!one.reason.empty()) text += fmt::format(" ({} {})", to_string(one.code), one.reason);
    all += printable(text) + '\n';
  }
  return all;
}

std::string ChangeReport::text(const std::string& building, const std::string& target,
                               const TargetFigures& figures) const {
  if (metrics_.empty()) return {};
  nlohmann::ordered_json line = nlohmann::ordered_json::object();
  line["building"] = building;
  line["target"] = target;
  line["least_edge_m"] = figures.least_edge_m;
  const auto both = [&](const char* name, auto value) {
    line[fmt::format("{}_before", name)] = value(figures.before);
    line[fmt::format("{}_after", name)] = value(figures.after);
  };
  both("facets", [](const SolidFigures& f) { return f.facets; });
  both("normals", [](const SolidFigures& f) { return f.normals; });
  both("short_edges", [](const SolidFigures& f) { return f.short_edges; });
  both("volume_m3", [](const SolidFigures& f) { return f.volume_m3; });
  both("footprint_m2", [](const SolidFigures& f) { return f.footprint_m2; });
  line["hausdorff_m"] = figures.hausdorff_m;
  return line.dump(-1, ' ', false, kReplace) + "\n";
}

void ChangeReport::take(const Product& product) {
  if (changes_file_) changes_file_->append(product[OutputPart::changes]);
  if (metrics_file_) metrics_file_->append(product[OutputPart::metrics]);
}

void ChangeReport::add_places(PartPlaces& places) const {
  if (changes_file_)
    places[static_cast<std::size_t>(OutputPart::changes)] = {explain_, changes_file_->size()};
  if (metrics_file_)
    places[static_cast<std::size_t>(OutputPart::metrics)] = {metrics_, metrics_file_->size()};
}

void ChangeReport::commit() const {
  if (changes_file_) changes_file_->commit();
  if (metrics_file_) metrics_file_->commit();
}

}  // namespace oriel::cli
