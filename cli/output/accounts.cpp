#include "cli/output/accounts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

void Accounts::begin(bool is_rehearsal) {
  if (is_rehearsal) return;
  if (!deeds_ && !explain_.empty()) deeds_ = std::make_unique<OutputFile>(explain_);
  if (!figures_ && !metrics_.empty()) figures_ = std::make_unique<OutputFile>(metrics_);
}

std::string Accounts::text(const std::string& building, const std::string& target,
                           const std::vector<Deed>& deeds) const {
  std::string all;
  if (explain_.empty()) return all;
  const bool is_json = explain_.ends_with(".jsonl");
  for (const Deed& deed : deeds) {
    if (is_json) {
      nlohmann::ordered_json line;
      line["building"] = building;
      line["target"] = target;
      line["feature"] = deed.feature;
      line["label"] = deed.label;
      line["outcome"] = deed.outcome;
      line["operation"] = deed.operation;
      line["rule"] = deed.rule;
      line["code"] = to_string(deed.code);
      line["reason"] = deed.reason;
      all += line.dump() + "\n";
      continue;
    }
    std::string text = fmt::format("{} {} {} {}: {}", target, building, deed.feature,
                                   deed.label.empty() ? "unknown" : deed.label, deed.outcome);
    if (!deed.operation.empty()) text += fmt::format(", {} by {}", deed.operation, deed.rule);
    if (!deed.reason.empty()) text += fmt::format(" ({} {})", to_string(deed.code), deed.reason);
    all += text + '\n';
  }
  return all;
}

std::string Accounts::text(const std::string& building, const std::string& target,
                           double least_edge_m, const SolidFigures& before,
                           const SolidFigures& after, double hausdorff_m) const {
  if (metrics_.empty()) return {};
  nlohmann::ordered_json line;
  line["building"] = building;
  line["target"] = target;
  line["least_edge_m"] = least_edge_m;
  const auto both = [&](const char* name, auto value) {
    line[fmt::format("{}_before", name)] = value(before);
    line[fmt::format("{}_after", name)] = value(after);
  };
  both("facets", [](const SolidFigures& f) { return f.facets; });
  both("normals", [](const SolidFigures& f) { return f.normals; });
  both("short_edges", [](const SolidFigures& f) { return f.short_edges; });
  both("volume_m3", [](const SolidFigures& f) { return f.volume_m3; });
  both("footprint_m2", [](const SolidFigures& f) { return f.footprint_m2; });
  line["hausdorff_m"] = hausdorff_m;
  return line.dump() + "\n";
}

void Accounts::take(const Product& product) {
  if (deeds_) deeds_->append(product[Part::deeds]);
  if (figures_) figures_->append(product[Part::figures]);
}

void Accounts::add_places(PartPlaces& places) const {
  if (deeds_) places[static_cast<std::size_t>(Part::deeds)] = {explain_, deeds_->size()};
  if (figures_) places[static_cast<std::size_t>(Part::figures)] = {metrics_, figures_->size()};
}

void Accounts::commit() const {
  if (deeds_) deeds_->commit();
  if (figures_) figures_->commit();
}

}  // namespace oriel::cli
