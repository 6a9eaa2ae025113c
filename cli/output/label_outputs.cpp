#include "cli/output/label_outputs.h"

#include "cli/output/safe_cells.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/print_out.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

bool LabellingArguments::writes_attributes() const {
  return (to.empty() ? format_of(out) : parse_format(to)) == Format::gpkg;
}

LabelOptions LabellingArguments::label_options(StageObserver observer) const {
  LabelOptions options = RunOptions::label_options(std::move(observer));
  options.codelist = codelist;
  options.has_reasons = has_reasons;
  return options;
}

LabelOutputs::LabelOutputs(const LabellingArguments& arguments, const RuleBase& rules)
    : arguments_(arguments),
      rules_(rules),
      options_(arguments.label_options()),
      columns_(chosen_columns(arguments.columns, rules)) {
  if (!arguments.columns.empty() && arguments.features.empty())
    throw CLI::ValidationError("--columns", "needs --features, the table that has them");
  const auto codelists = rules.codelists();
  if (!codelists.empty() && std::ranges::find(codelists, arguments.codelist) == codelists.end())
    throw CLI::ValidationError(
        "--codelist", fmt::format("'{}' is none of the lists that the pack has codes for: {}",
                                  arguments.codelist, fmt::join(codelists, ", ")));
  if (!arguments.out.empty())
    sink_.emplace(arguments.out, arguments.to, arguments.inputs, arguments.read_options().format,
                  arguments.stl_solids);
  if (arguments.is_isolated && sink_ && sink_->is_gathering(0))
    throw CLI::ValidationError("--isolate",
                               "needs an output that is no mesh (.obj, .off, .ply, .stl)");
  if (arguments.closes_installations && (!sink_ || !sink_->is_citygml()))
    throw CLI::ValidationError("--closed-installations",
                               "needs an output that is CityGML: -o X.gml, or --to citygml2 or "
                               "citygml3");
  if (!arguments.reuse.empty() && (recipe().empty() || writes_stdout()))
    throw CLI::ValidationError(
        "--reuse", "needs outputs that are files: -o in .city.jsonl, --features in .csv or .jsonl");
}

std::vector<Issue> LabelOutputs::take_issues() {
  return sink_ ? sink_->take_issues() : std::vector<Issue>{};
}

std::vector<Issue> LabelOutputs::untyped(const std::map<std::string, int>& labels) const {
  if (!sink_ || !sink_->names_features()) return {};
  return report_untyped(labels, rules_);
}

std::optional<Issue> LabelOutputs::lacking_columns() const {
  if (arguments_.features.empty()) return std::nullopt;
  return lacks_columns(arguments_.features, columns_, rules_);
}

LabelledBuilding LabelOutputs::annotated(const Building& building,
                                         const PipelineResult& line) const {
  return annotate(building, line, rules_, options_);
}

void LabelOutputs::name_files(NamedFiles& files) const {
  files.add_input("--rules", arguments_.rules);
  if (sink_) sink_->name_files(files, !arguments_.selection.is_all());
  files.add_output("--features", arguments_.features);
}

bool LabelOutputs::is_streaming() const { return !sink_ || sink_->is_streaming(); }

void LabelOutputs::begin(std::size_t input, bool is_rehearsal) {
  if (sink_) sink_->begin(input, is_rehearsal);
  if (!is_rehearsal) open_features();
}

void LabelOutputs::reopen() {
  open_features();
  has_ended_ = true;
}

void LabelOutputs::open_features() {
  if (!features_ && !arguments_.features.empty())
    features_ = std::make_unique<FeatureRecordWriter>(arguments_.features, columns_);
}

PartPlaces LabelOutputs::places() const {
  PartPlaces places;
  if (sink_) places[static_cast<std::size_t>(OutputPart::buildings)] = sink_->place();
  if (features_)
    places[static_cast<std::size_t>(OutputPart::features)] = {arguments_.features,
                                                              features_->size()};
  return places;
}

std::string LabelOutputs::recipe() const {
  if (!has_any() || !is_streaming() || arguments_.features.ends_with(".json")) return {};
  return fmt::format("codelist={} buildings={} features={} columns={} safe={} ignores={} closed={}",
                     arguments_.codelist, has_buildings(),
                     std::filesystem::path(arguments_.features).extension().string(),
                     fmt::join(names_of_columns(columns_), ","), arguments_.has_safe_cells,
                     arguments_.ignores_semantics, arguments_.closes_installations);
}

std::shared_ptr<RecordText> LabelOutputs::record(std::size_t input, const Document& document,
                                                 WriteOptions options) const {
  options.closes_installations = arguments_.closes_installations;
  return sink_ ? sink_->record(input, document, std::move(options)) : nullptr;
}

void LabelOutputs::make_features(const Building& building, const PipelineResult& line,
                                 Product& product) const {
  if (arguments_.features.empty()) return;
  const RecordFormat format = *record_format_of(arguments_.features);
  std::string& text = product[OutputPart::features];
  std::string more = FeatureRecordWriter::text(format, feature_records(building, line), columns_);
  if (arguments_.has_safe_cells && format == RecordFormat::csv) more = with_safe_cells(more);
  if (format == RecordFormat::json && !text.empty() && !more.empty()) text += ",\n";
  text += more;
}

void LabelOutputs::add_attributes(const Building& building, const PipelineResult& line,
                                  OutputRecord& output) const {
  if (!sink_ || !sink_->has_attributes()) return;
  auto records = feature_records(building, line);
  std::ranges::move(records, std::back_inserter(output.features));
}

void LabelOutputs::take(const Document& document, const Product& product) {
  if (sink_) sink_->take(document, product);
  if (features_) features_->append(product[OutputPart::features]);
  print_out(product[OutputPart::listing]);
}

void LabelOutputs::end() {
  has_ended_ = true;
  if (!sink_) return;
  const std::string path = sink_->end();
  if (path != "-" && arguments_.is_verbose) run_log().info("wrote {}", printable(path));
}

void LabelOutputs::commit() {
  if (features_ && has_ended_) features_->commit();
}

}  // namespace oriel::cli
