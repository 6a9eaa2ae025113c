#include "cli/batch/run.h"
#include "cli/commands/commands.h"
#include "cli/commands/options.h"
#include "cli/output/tree_report.h"
#include "kernel/io/files/output_file.h"
#include "kernel/io/records/feature_records.h"
#include "kernel/io/records/segmentation_json.h"
#include "kernel/segment/complex/cell_complex.h"

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments : LineArguments {
  bool is_json = false;
  bool has_faces = false;
  bool has_tree = false;
  std::string out = "-";
  std::string features;
};

/// The features of a building for a reader at a terminal.
std::string listing(const Building& building, const OnLine& line) {
  const Segmentation& segmentation = *line.segmentation;
  const FeatureTable& table_of = line.description.table;
  std::vector<std::vector<std::string>> rows{
      {"feature", "sense", "planes", "value", "volume m3", "a m", "b m", "c m", "base height m"}};
  const auto number = [&](FeatureId id, const char* name) {
    const auto value = table_of.number(id, name);
    return value ? fmt::format("{:.3f}", *value) : std::string("-");
  };
  for (int i = 0; i < std::ssize(segmentation.features); ++i) {
    const FeatureId id{i};
    const Feature& feature = segmentation.features[id.index()];
    rows.push_back({table_of.id(id), to_string(feature.sense),
                    fmt::format("{}", feature.planes.size()), number(id, "value"),
                    number(id, "volume"), number(id, "a"), number(id, "b"), number(id, "c"),
                    number(id, "base_height")});
  }
  const SegmentationStats& stats = segmentation.stats;
  return fmt::format("{}: {} planes, {} features, {} leaves, {} inner nodes\n{}\n", building.id,
                     line.solid->planes.size(), segmentation.features.size(), stats.leaves,
                     stats.inner, table(rows));
}

/// What the command writes: JSON or a listing, and the records of features, each if asked for.
class Outputs {
 public:
  Outputs(const Arguments& arguments, Run& run) : arguments_(arguments), run_(run) {}

  void open() {
    const bool has_listing = arguments_.features.empty() || arguments_.out != "-";
    if (!text_ && (arguments_.is_json || has_listing))
      text_ = std::make_unique<OutputFile>(arguments_.out);
    if (!features_ && !arguments_.features.empty())
      features_ = std::make_unique<FeatureRecordWriter>(arguments_.features);
  }

  /// Before open() nothing is kept.
  void add(const Building& building, const OnLine& line) {
    const auto& [table, graph] = line.description;
    std::optional<CellComplex> complex;
    if (arguments_.has_faces) complex = cell_complex(*line.segmentation, line.tolerances);
    const std::string text =
        arguments_.has_tree ? tree_text(building, line)
        : arguments_.is_json
            ? segmentation_json(building, *line.segmentation, table, complex ? &*complex : nullptr)
            : listing(building, line);
    if (text_) text_->append(text);
    if (features_)
      features_->append(feature_records(building, *line.segmentation, table, graph, nullptr));
  }

  /// Of an open building nothing: it has no tree.
  [[nodiscard]] std::string tree_text(const Building& building, const OnLine& line) const {
    if (line.is_open) return {};
    bool is_same = true;
    std::string text = tree_report(building.id, *line.segmentation, arguments_.is_json, is_same);
    if (is_same) return text;
    run_.set_aside(building_issue(Severity::error, Code::E901, building.id,
                                  "a fault of oriel's own: its balanced tree is another body"));
    return {};
  }

  void commit() {
    if (text_) text_->commit();
    if (features_) features_->commit();
  }

 private:
  const Arguments& arguments_;
  Run& run_;
  std::unique_ptr<OutputFile> text_;
  std::unique_ptr<FeatureRecordWriter> features_;
};

ExitCode work(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  Run run(arguments, nullptr, report);
  Outputs outputs(arguments, run);
  bool has_ended = false;  // an input did
  Run::Visitor visitor;
  visitor.begin = [&](std::size_t) {
    if (run.is_last_run()) outputs.open();
  };
  visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
    run.timings().measure(Stage::write, [&] {
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].is_done()) outputs.add(document.buildings[i], lines[i]);
    });
  };
  visitor.end = [&](std::size_t) { has_ended = true; };
  visitor.commit = [&] {
    if (has_ended) outputs.commit();
  };
  const ExitCode code = run.go(visitor);
  run.tell_summary("segmented", {});
  return code;
}

}  // namespace

void add_segment(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "segment", "Find the parts of buildings: features, cells and the CSG tree");
  add_line_arguments(*command, *arguments, true);
  CLI::Option* json = command->add_flag("--json", arguments->is_json,
                                        "One JSON object per building and line instead of a table");
  command
      ->add_flag("--faces", arguments->has_faces,
                 "With --json: the faces between cells, and which cells touch")
      ->needs(json);
  command->add_flag("--tree", arguments->has_tree,
                    "In place of the parts: the CSG tree as cut, balanced and with touching parts "
                    "merged, its depth and weighted path, and the proof that it is the same body");
  command->add_option("-o,--output", arguments->out, "Where to write (default: stdout)");
  add_features_argument(*command, arguments->features);
  command->footer(
      "Example:\n  oriel segment house.city.json --json | jq .stats\n  oriel segment "
      "tile.city.jsonl --lod 2.2 --features parts.csv");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
