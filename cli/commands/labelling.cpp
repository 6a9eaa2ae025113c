#include "cli/commands/labelling.h"

#include "cli/terminal/logging.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

void add_label_arguments(CLI::App& command, LabelArguments& a) {
  add_line_arguments(command, a, true);
  add_rules_argument(command, a.rules);
  command.add_option("-o,--output", a.out,
                     "File, - for stdout, or a folder (with a / at its end) for several inputs");
  command.add_option("--to", a.to, "Format to write (default: by the name of the output)")
      ->check(CLI::IsMember({"cityjson", "cityjsonseq", "obj", "off", "ply", "stl"}));
  add_features_argument(command, a.features);
  add_resume_argument(command, a);
  add_reuse_argument(command, a);
  add_isolate_argument(command, a);
  command
      .add_option("--codelist", a.codelist,
                  "Code list of installations that the pack has codes for")
      ->capture_default_str();
}

std::optional<RuleBase> load_rules(const std::string& pack, Report& report) {
  auto loaded = load_pack_file(pack);
  report.add(loaded.issues);
  return loaded.value;
}

LabelOptions LabelArguments::label_options(StageObserver observer) const {
  LabelOptions options = RunOptions::label_options(std::move(observer));
  options.codelist = codelist;
  options.has_reasons = has_reasons;
  return options;
}

LabelOutputs::LabelOutputs(const LabelArguments& arguments, const RuleBase& rules)
    : arguments_(arguments), rules_(rules), options_(arguments.label_options()) {
  const auto codelists = rules.codelists();
  if (!codelists.empty() && std::ranges::find(codelists, arguments.codelist) == codelists.end())
    throw CLI::ValidationError(
        "--codelist", fmt::format("the pack has codes for {}", fmt::join(codelists, ", ")));
  if (!arguments.out.empty())
    sink_.emplace(arguments.out, arguments.to, arguments.inputs, arguments.read_options().format,
                  arguments.stl_solids);
  if (arguments.is_isolated && sink_ && sink_->is_gathering(0))
    throw CLI::ValidationError("--isolate", "needs an output that is CityJSON or CityJSONSeq");
  if (!arguments.reuse.empty() && (recipe().empty() || (sink_ && sink_->is_stdout())))
    throw CLI::ValidationError(
        "--reuse", "needs outputs that are files: -o in .city.jsonl, --features in .csv or .jsonl");
  if (arguments.is_resumable && (!has_any() || (sink_ && sink_->is_stdout())))
    throw CLI::ValidationError("--resume", "needs outputs that are files: -o, --features");
}

LabelledBuilding LabelOutputs::annotated(const Building& building,
                                         const PipelineResult& line) const {
  return annotate(building, line, rules_, options_);
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
    features_ = std::make_unique<FeatureRecordWriter>(arguments_.features);
}

PartPlaces LabelOutputs::places() const {
  PartPlaces places;
  if (sink_) places[static_cast<std::size_t>(Part::buildings)] = sink_->place();
  if (features_)
    places[static_cast<std::size_t>(Part::features)] = {arguments_.features, features_->size()};
  return places;
}

std::string LabelOutputs::recipe() const {
  if (!has_any() || !is_streaming() || arguments_.features.ends_with(".json")) return {};
  return fmt::format("codelist={} buildings={} features={} ignores={}", arguments_.codelist,
                     has_buildings(),
                     std::filesystem::path(arguments_.features).extension().string(),
                     arguments_.ignores_semantics);
}

void LabelOutputs::make_buildings(std::size_t input, const Document& document,
                                  std::vector<LabelledBuilding> labelled,
                                  const WriteOptions& options, Product& product) const {
  if (!sink_) return;
  product[Part::buildings] = sink_->text(input, document, labelled, options);
  if (sink_->is_gathering(input)) product.labelled = std::move(labelled);
}

void LabelOutputs::make_features(const Building& building, const PipelineResult& line,
                                 Product& product) const {
  if (arguments_.features.empty()) return;
  const RecordFormat format = *record_format_of(arguments_.features);
  std::string& text = product[Part::features];
  const std::string more = FeatureRecordWriter::text(format, feature_records(building, line));
  if (format == RecordFormat::json && !text.empty() && !more.empty()) text += ",\n";
  text += more;
}

void LabelOutputs::take(const Document& document, const Product& product) {
  if (sink_) sink_->take(document, product.labelled, product[Part::buildings]);
  if (features_) features_->append(product[Part::features]);
  std::fputs(product[Part::listing].c_str(), stdout);
}

void LabelOutputs::end() {
  has_ended_ = true;
  if (!sink_) return;
  const std::string path = sink_->end();
  if (path != "-" && arguments_.is_verbose) run_log().info("wrote {}", path);
}

void LabelOutputs::commit() {
  if (features_ && has_ended_) features_->commit();
}

}  // namespace oriel::cli
