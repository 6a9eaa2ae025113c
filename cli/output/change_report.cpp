#include "cli/output/change_report.h"

#include "kernel/base/text/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

/// Ids of OBJ and records may be any bytes.
constexpr auto kReplace = nlohmann::ordered_json::error_handler_t::replace;

using nlohmann::ordered_json;

/// A length, or null.
ordered_json json_of(std::optional<double> value) {
  return value ? ordered_json(*value) : ordered_json();
}

/// The ratio of two numbers; null without a denominator.
ordered_json share(double part, double whole) {
  return whole > 0 ? ordered_json(part / whole) : ordered_json();
}

/// `NAME_before` and `NAME_after`.
template <class Value>
void add_both(const TargetFigures& figures, const std::string& name, Value value,
              ordered_json& line) {
  line[name + "_before"] = value(figures.quality_before);
  line[name + "_after"] = value(figures.quality_after);
}

void add_legibility(const TargetFigures& figures, ordered_json& line) {
  const auto add = [&](const char* name, auto member) {
    add_both(
        figures, std::string("smallest_") + name + "_m",
        [&](const DrawingQuality& of) { return json_of(of.legibility.*member); }, line);
    if (figures.map_scale > 0) {
      const auto after = figures.quality_after.legibility.*member;
      line[fmt::format("smallest_{}_map_mm", name)] =
          json_of(after ? std::optional(*after * 1000 / figures.map_scale) : std::nullopt);
    }
  };
  const auto count = [&](const char* name, auto number) {
    add_both(
        figures, name, [&](const DrawingQuality& of) { return of.legibility.*number; }, line);
  };
  add("edge", &Legibility::smallest_edge_m);
  add("gap", &Legibility::smallest_gap_m);
  count("gaps_below", &Legibility::narrow_gaps);
  add("opening_gap", &Legibility::smallest_opening_gap_m);
  count("opening_gaps_below", &Legibility::narrow_opening_gaps);
  add("width", &Legibility::smallest_width_m);
  count("widths_below", &Legibility::narrow_features);
}

void add_facades(const TargetFigures& figures, ordered_json& line) {
  const FacadeQuality& before = figures.quality_before.facades;
  const FacadeQuality& after = figures.quality_after.facades;
  const auto add = [&](const char* name, auto member) {
    add_both(
        figures, name, [&](const DrawingQuality& of) { return of.facades.*member; }, line);
  };
  add("openings", &FacadeQuality::openings);
  add("openings_m2", &FacadeQuality::openings_m2);
  line["openings_kept"] = share(after.openings, before.openings);
  line["openings_area_kept"] = share(after.openings_m2, before.openings_m2);
  add("rows", &FacadeQuality::rows);
  add("aligned_rows", &FacadeQuality::aligned_rows);
  add("long_rows", &FacadeQuality::long_rows);
  add("even_rows", &FacadeQuality::even_rows);
  add("symmetry", &FacadeQuality::symmetry);
}

void add_found_again(const TargetFigures& figures, ordered_json& line) {
  int drawn = 0, found = 0;
  ordered_json by_label = ordered_json::object();
  for (const auto& [label, count] : figures.found_again) {
    drawn += count.drawn;
    found += count.found;
    by_label[label] = {{"drawn", count.drawn}, {"found", count.found}};
  }
  line["labels_found_again"] = share(found, drawn);
  line["labels"] = std::move(by_label);
}

nlohmann::ordered_json needs_json(const std::vector<Need>& needs) {
  auto list = nlohmann::ordered_json::array();
  for (const Need& need : needs) {
    const std::string unit = need.what == "gap" || need.what == "to" ? "_m" : "";
    list.push_back({{"what", need.what}, {"less" + unit, need.less}, {"then" + unit, need.then}});
  }
  return list;
}

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
      line["id"] = one.feature;
      line["label"] = one.label;
      line["outcome"] = one.outcome;
      line["operation"] = one.operation;
      line["rule"] = one.rule;
      line["code"] = to_string(one.code);
      line["reason"] = one.reason;
      if (!one.needs.empty()) line["needs"] = needs_json(one.needs);
      if (!one.beside.empty()) line["beside"] = one.beside;
      all += line.dump(-1, ' ', false, kReplace) + "\n";
      continue;
    }
    const bool is_reason = one.reason.starts_with(one.outcome);  // "went along with ID"
    std::string text = fmt::format("{} {} {} {}: {}", target, building, one.feature,
                                   one.label.empty() ? "unknown" : one.label,
                                   is_reason ? one.reason : one.outcome);
    if (!one.operation.empty()) text += fmt::format(", {} by {}", one.operation, one.rule);
    if (one.code != Code::none && is_reason)
      text += fmt::format(" ({})", to_string(one.code));
    else if (one.code != Code::none)
      text += fmt::format(" ({} {})", to_string(one.code), one.reason);
    else if (!one.reason.empty() && !is_reason)
      text += fmt::format(" ({})", one.reason);
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
  add_legibility(figures, line);
  add_facades(figures, line);
  add_found_again(figures, line);
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
