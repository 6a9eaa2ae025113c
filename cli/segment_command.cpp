#include "cli/commands.h"
#include "cli/options.h"
#include "cli/run.h"
#include "kernel/io/feature_records.h"
#include "kernel/io/output_file.h"
#include "kernel/io/segmentation_json.h"

#include <memory>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments : LineArguments {
  bool is_json = false;
  std::string out = "-";
  std::string features;
};

/// The features of a building for a reader at a terminal.
std::string listing(const Building& building, const OnLine& line) {
  const Segmentation& segmentation = *line.segmentation;
  const FeatureTable& table_of = line.description.table;
  std::vector<std::vector<std::string>> rows{
      {"feature", "sense", "planes", "value", "volume m3", "a m", "b m", "c m", "height m"}};
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
                    number(id, "height")});
  }
  const SegmentationStats& stats = segmentation.stats;
  return fmt::format("{}: {} planes, {} features, {} leaves, {} inner nodes\n{}\n", building.id,
                     line.solid->planes.size(), segmentation.features.size(), stats.leaves,
                     stats.inner, table(rows));
}

ExitCode work(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  Run run(arguments, nullptr, report);
  std::unique_ptr<OutputFile> out;
  std::unique_ptr<FeatureRecordWriter> features;
  Run::Visitor visitor;
  visitor.begin = [&](std::size_t input) {
    if (input > 0) return;
    out = std::make_unique<OutputFile>(arguments.out);
    if (!arguments.features.empty())
      features = std::make_unique<FeatureRecordWriter>(arguments.features);
  };
  visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const OnLine& line = lines[i];
      if (!line.is_done()) continue;
      const Building& building = document.buildings[i];
      run.timings().measure(Stage::write, [&] {
        if (arguments.is_json)
          out->append(segmentation_json(building, *line.segmentation, line.description.table));
        else if (!features)
          out->append(listing(building, line));
        if (features)
          features->append(feature_records(building, *line.segmentation, line.description.table,
                                           line.description.graph, nullptr));
      });
    }
  };
  const ExitCode code = run.go(visitor);
  if (out) out->commit();
  if (features) features->commit();
  run.tell_summary("segmented");
  return code;
}

}  // namespace

void add_segment(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "segment", "Find the parts of buildings: features, cells and the CSG tree");
  add_line_arguments(*command, *arguments, true);
  command->add_flag("--json", arguments->is_json,
                    "One JSON object per building and line instead of a table");
  command->add_option("-o,--output", arguments->out, "Where to write (default: stdout)");
  command->add_option("--features", arguments->features,
                      "Write one record per feature: .csv, .json or .jsonl");
  command->footer(
      "Example:\n  oriel segment house.city.json --json | jq .stats\n  oriel segment "
      "tile.city.jsonl --lod 2.2 --features parts.csv");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
