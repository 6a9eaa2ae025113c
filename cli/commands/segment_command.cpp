#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/column_choice.h"
#include "cli/output/paper_table.h"
#include "cli/output/safe_cells.h"
#include "cli/terminal/table.h"
#include "io/files/output_file.h"
#include "io/records/stage_json.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/explain.h"
#include "oriel/paper_count.h"
#include "oriel/segment.h"
#include "oriel/write.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

struct SegmentArguments : RunOptions {
  bool is_json = false;
  bool has_faces = false;
  bool has_tree = false;
  TreeForm tree_form = TreeForm::flat;
  bool counts_as_paper = false;
  std::string out = "-";
  std::string features;
  std::vector<std::string> columns;
  /// The pack whose columns "rules" are; empty: the default one.
  std::string rules;
  bool has_safe_cells = false;
};

/// The features of a building for a reader at a terminal.
std::string segment_listing(const Building& building, const PipelineResult& line) {
  const Segmentation& segmentation = *line.segmentation;
  const FeatureTable& table_of = line.description.table;
  std::vector<std::vector<std::string>> rows{{"feature", "sense", "planes", "value", "volume m3",
                                              "a m", "b m", "c m", "base height m", "name"}};
  const std::vector<std::string> names = names_of_features(line);
  const auto number = [&](FeatureId id, Attribute attribute) {
    const auto value = table_of.number(id, attribute);
    return value ? fmt::format("{:.3f}", *value) : std::string("-");
  };
  for (int i = 0; i < std::ssize(segmentation.features); ++i) {
    const FeatureId id{i};
    const Feature& feature = segmentation.features[id.index()];
    rows.push_back({table_of.id(id), to_string(feature.sense),
                    fmt::format("{}", feature.planes.size()), number(id, Attribute::value),
                    number(id, Attribute::volume), number(id, Attribute::a),
                    number(id, Attribute::b), number(id, Attribute::c),
                    number(id, Attribute::base_height), names[id.index()]});
  }
  const SegmentationStats& stats = segmentation.stats;
  return fmt::format(
      "{}: {}, {}, {}, {}\n{}\n", printable(building.id),
      counted(line.solid->planes.size(), "plane"), counted(segmentation.features.size(), "feature"),
      counted(stats.leaves, "leaf", "leaves"), counted(stats.inner, "inner node"), table(rows));
}

using nlohmann::ordered_json;

ordered_json json_of(const TreeFigures& figures) {
  return {{"leaves", figures.leaves},
          {"inner", figures.inner},
          {"depth", figures.depth},
          {"weighted_path", figures.weighted_path}};
}

ordered_json json_of(const BalanceProof& proof) {
  return {{"holds", proof.holds()},
          {"same_cells", proof.has_same_cells},
          {"volume_before_m3", proof.before_m3},
          {"volume_after_m3", proof.after_m3},
          {"points", proof.points},
          {"differing", proof.differing}};
}

std::string text_of(const TreeFigures& figures) {
  return fmt::format("{}, {} inner, depth {}, weighted path {:.3f}",
                     counted(figures.leaves, "leaf", "leaves"), figures.inner, figures.depth,
                     figures.weighted_path);
}

std::string text_of(const BalanceProof& proof) {
  return fmt::format("{}: {:.6f} m3, {}", proof.holds() ? "the same body" : "DIFFERS",
                     proof.after_m3,
                     counted_of(proof.points - proof.differing, proof.points, "point"));
}

/// What --tree writes of a building: its CSG tree as it was cut, balanced and with touching parts
/// merged, each with its figures, and whether all are one body. A line of text, or of JSON
/// (docs/formats.md).
std::string tree_report(const std::string& building, const TreeComparison& trees,
                        const SegmentArguments& arguments) {
  if (!arguments.is_json)
    return fmt::format("{}:\n  as cut    {}\n  balanced  {}; {}\n  merged    {}; {}\n",
                       printable(building), text_of(trees.cut), text_of(trees.balanced),
                       text_of(trees.balanced_proof), text_of(trees.merged),
                       text_of(trees.merged_proof));
  ordered_json out{
      {"id", building}, {"cut", json_of(trees.cut)}, {"balanced", json_of(trees.balanced)}};
  out["balanced"]["proof"] = json_of(trees.balanced_proof);
  out["merged"] = json_of(trees.merged);
  out["merged"]["proof"] = json_of(trees.merged_proof);
  out["merges"] = ordered_json::array();
  for (const LeafMerge& merge : trees.tree.merges) {
    ordered_json planes = ordered_json::array();
    for (const PlaneId id : merge.planes) planes.push_back(id.value);
    out["merges"].push_back({{"first", merge.first.value},
                             {"second", merge.second.value},
                             {"contact", merge.contact.value},
                             {"planes", std::move(planes)},
                             {"volume_m3", merge.volume_m3}});
  }
  std::string text = out.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  text.pop_back();
  append_tree(text, trees.tree.nodes, trees.tree.root, arguments.tree_form);
  return text + "}\n";
}

/// Writes JSON or a listing, and the records of features, each if asked for.
class Segmenter final : public VisitingCommand {
 public:
  Segmenter(const SegmentArguments& arguments, RecordColumns columns, BatchRunner& runner)
      : arguments_(arguments), columns_(std::move(columns)), runner_(runner) {}

  void name_files(NamedFiles& files) const override {
    if (has_text()) files.add_output("-o", arguments_.out);
    files.add_output("--features", arguments_.features);
  }
  void begin(std::size_t /*input*/) override {
    if (!runner_.is_last_run()) return;
    if (!text_ && has_text()) text_ = std::make_unique<OutputFile>(arguments_.out);
    if (!features_ && !arguments_.features.empty())
      features_ = std::make_unique<FeatureRecordWriter>(arguments_.features, columns_);
  }
  void visit(const Document& document, std::vector<PipelineResult>& results) override {
    runner_.timings().measure(Stage::write, [&] {
      for (std::size_t i = 0; i < results.size(); ++i)
        if (results[i].is_done()) add(document.buildings[i], results[i]);
    });
  }
  void end(std::size_t /*input*/) override { has_ended_ = true; }
  void commit() override {
    if (text_ && has_ended_) text_->commit();
    if (features_ && has_ended_) features_->commit();
  }

 private:
  [[nodiscard]] bool has_text() const {
    return arguments_.is_json || arguments_.features.empty() || arguments_.out != "-";
  }

  /// In runs for the clock nothing is kept.
  void add(const Building& building, const PipelineResult& line) {
    const FeatureTable& table = line.description.table;
    std::optional<CellComplex> complex;
    if (arguments_.has_faces) {
      complex = cell_complex(line, arguments_.budget);
      if (!complex)
        warn_of_budget(building, "finding faces", "its faces and contacts are left out");
    }
    const std::string text =
        arguments_.has_tree          ? tree_text(building, line)
        : arguments_.counts_as_paper ? paper_text(building, line)
        : arguments_.is_json
            ? segmentation_json(building, *line.segmentation, table, complex ? &*complex : nullptr,
                                arguments_.tree_form)
            : segment_listing(building, line);
    if (text_) text_->append(text);
    if (!features_) return;
    const RecordFormat format = *record_format_of(arguments_.features);
    const std::string records =
        FeatureRecordWriter::text(format, feature_records(building, line), columns_);
    const bool is_safe = arguments_.has_safe_cells && format == RecordFormat::csv;
    features_->append(is_safe ? with_safe_cells(records) : records);
  }

  void warn_of_budget(const Building& building, const std::string& stage,
                      const std::string& outcome, std::int64_t budgets = 1) const {
    runner_.warn(used_up(building.id, budgets * arguments_.budget, stage, outcome));
  }

  /// Of an open building nothing: it has no tree, and `what` says so.
  [[nodiscard]] bool is_open(const Building& building, const PipelineResult& line,
                             const std::string& what) const {
    if (line.is_open())
      runner_.set_aside(building_issue(Severity::error, Code::E302, building.id,
                                       what + ": its polygons do not form a closed solid "
                                              "(--close any, or oriel repair, may make one)"));
    return line.is_open();
  }

  [[nodiscard]] std::string paper_text(const Building& building, const PipelineResult& line) const {
    if (is_open(building, line, "has no planes to count")) return {};
    const PaperCount count = count_as_paper(building, line, arguments_.label_options());
    if (std::ranges::any_of(count.counted, [](const auto& row) { return row.count.is_used_up; }))
      warn_of_budget(building, "counting as the paper does",
                     "some counts are of what was done until then", kCountingBudgets);
    return arguments_.is_json ? paper_json(building.id, count) : paper_table(building.id, count);
  }

  [[nodiscard]] std::string tree_text(const Building& building, const PipelineResult& line) const {
    if (is_open(building, line, "has no tree")) return {};
    const TreeComparison trees = compare_trees(line, arguments_.budget);
    if (trees.is_used_up)
      warn_of_budget(building, "proving the tree", "only some of the points were compared");
    if (trees.is_same_body()) return tree_report(building.id, trees, arguments_);
    runner_.set_aside(building_issue(Severity::error, Code::E901, building.id,
                                     "a fault of oriel's own: its balanced tree is another body"));
    return {};
  }

  const SegmentArguments& arguments_;
  RecordColumns columns_;
  BatchRunner& runner_;
  std::unique_ptr<OutputFile> text_;
  std::unique_ptr<FeatureRecordWriter> features_;
  bool has_ended_ = false;  ///< an input did
};

ExitCode work(SegmentArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  arguments.seeks_features = true;
  arguments.gives_only_features =
      !arguments.is_json && !arguments.has_tree && !arguments.counts_as_paper;
  if ((!arguments.columns.empty() || !arguments.rules.empty()) && arguments.features.empty())
    throw CLI::ValidationError(arguments.columns.empty() ? "--rules" : "--columns",
                               "needs --features, the table that has them");
  const auto rules =
      load_rules({arguments.rules.empty() ? "residential" : arguments.rules, {}}, report);
  if (!rules) return ExitCode::rules;
  const RecordColumns columns = chosen_columns(arguments.columns, *rules);
  BatchRunner runner(arguments, nullptr, report);
  Segmenter command(arguments, columns, runner);
  const ExitCode code = runner.run(command);
  if (!arguments.columns.empty())
    if (const auto lacking = lacks_columns(arguments.features, columns, *rules))
      report.add(*lacking);
  runner.report_summary("segmented", {});
  return code;
}

}  // namespace

void add_segment(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<SegmentArguments>();
  CLI::App* command = app.add_subcommand(
      "segment", "Find the parts of buildings: features, cells and the CSG tree");
  add_line_arguments(*command, *arguments, true);
  CLI::Option* json =
      command->add_flag("--json", arguments->is_json,
                        "Write one JSON object per line and building instead of a table");
  CLI::Option* faces =
      command
          ->add_flag("--faces", arguments->has_faces,
                     "With --json: also the faces between cells, and which cells touch")
          ->needs(json);
  command
      ->add_flag_callback(
          "--nested-tree", [arguments] { arguments->tree_form = TreeForm::nested; },
          "With --json: the tree as objects within objects, the form before this release; the next "
          "release drops it")
      ->needs(json);
  CLI::Option* tree = command->add_flag(
      "--tree", arguments->has_tree,
      "Instead of the parts: the CSG tree as cut, balanced, and with touching parts merged; its "
      "depth and weighted path; the proof that it is still the same body");
  command
      ->add_flag("--count-as-paper", arguments->counts_as_paper,
                 "Instead of the parts: how many planes, and sets of planes, the paper's algorithm "
                 "tests, with and without each of its heuristics, beside oriel")
      ->excludes(tree)
      ->excludes(faces);
  command->add_option("-o,--output", arguments->out, "Where to write (default: stdout)");
  add_features_argument(*command, arguments->features);
  add_columns_argument(*command, arguments->columns);
  command->add_option("--rules", arguments->rules,
                      "With --columns: the rule pack that will read the table (residential)");
  add_safe_cells_argument(*command, arguments->has_safe_cells);
  command->footer(
      "Example:\n  oriel segment house.city.json --json | jq .stats\n  oriel segment "
      "tile.city.jsonl --lod 2.2 --features parts.csv");
  arguments->joins_installations = true;
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
