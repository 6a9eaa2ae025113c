#include "cli/commands.h"
#include "cli/labelling.h"
#include "cli/report.h"
#include "interpret/score.h"
#include "interpret/surface_score.h"
#include "kernel/io/feature_records.h"
#include "kernel/io/truth.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

struct Arguments : LineArguments {
  bool is_of_surfaces = false;
  std::string rules = "residential";
  std::vector<std::string> truth;
  bool is_json = false;
};

/// The truth files that are named, those of a folder by their names.
std::vector<std::string> truth_files(const std::vector<std::string>& named) {
  std::vector<std::string> files;
  for (const std::string& path : named) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    const std::size_t before = files.size();
    for (const auto& entry : fs::directory_iterator(path))
      if (const std::string file = entry.path().string();
          file.ends_with(".truth.json") || file.ends_with(".truth.jsonl"))
        files.push_back(file);
    std::ranges::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
    if (files.size() == before) {
      Issue issue;
      issue.code = "E101";
      issue.sentence = "the folder has no *.truth.json or *.truth.jsonl";
      issue.place.file = path;
      throw InputError(std::move(issue));
    }
  }
  return files;
}

void append_predictions(std::vector<Prediction>& all, const std::vector<FeatureRecord>& records) {
  for (const FeatureRecord& r : records) {
    const auto& b = r.aabb_m;
    all.push_back({r.building, r.id, r.label, {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}});
  }
}

void append_truth(std::vector<ExpectedObject>& all, const Truth& truth) {
  for (const TruthObject& o : truth.objects)
    all.push_back({truth.building, o.id, o.label, o.subclass, o.feature_aabb.value_or(o.aabb),
                   !o.faces.empty()});
}

ExitCode score_features(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  ExitCode code = ExitCode::clean;
  std::vector<Prediction> predictions;
  std::vector<ExpectedObject> expected;
  for (const std::string& path : arguments.inputs) {
    const auto records = read_feature_records(path);
    report.tell(records.issues);
    if (has_errors(records.issues))
      code = graver(code, records.value ? ExitCode::set_aside : ExitCode::input);
    if (records.value) append_predictions(predictions, *records.value);
  }
  for (const std::string& path : truth_files(arguments.truth)) {
    const auto truths = read_truths(path);
    report.tell(truths.issues);
    if (has_errors(truths.issues)) code = graver(code, ExitCode::input);
    if (truths.value)
      for (const Truth& truth : *truths.value) append_truth(expected, truth);
  }
  const Score result = score(predictions, expected);
  constexpr std::size_t kShown = 20;
  const std::size_t shown = arguments.is_verbose ? result.misses.size() : kShown;
  std::string text = arguments.is_json ? to_json(result) + "\n" : to_text(result, shown);
  if (!arguments.is_json && shown < result.misses.size())
    text += "  (-v lists all of them, --json too)\n";
  std::fputs(text.c_str(), stdout);
  return code;
}

/// The models are labelled as if they had no semantics, and their semantics are the truth.
ExitCode score_surfaces(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  Run run(arguments, &*rules, report);
  SurfaceScore score;
  Run::Visitor visitor;
  visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].has_surfaces())
        compare_surfaces(document.buildings[i], annotated(document.buildings[i], lines[i], *rules),
                         lines[i].surfaces, OpeningPolicy::as_host, score);
  };
  const ExitCode code = run.go(visitor);
  std::fputs((arguments.is_json ? to_json(score) + "\n" : to_text(score)).c_str(), stdout);
  return code;
}

ExitCode work(const Arguments& arguments) {
  if (arguments.is_of_surfaces) return score_surfaces(arguments);
  if (arguments.truth.empty()) throw CLI::RequiredError("--truth");
  return score_features(arguments);
}

}  // namespace

void add_score(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "score", "Compare labels with the truth: precision, recall and F1 of every class");
  arguments->ignores_semantics = true;
  command
      ->add_option("records", arguments->inputs,
                   "Records of features as label --features writes them; with --surfaces models")
      ->required();
  command->add_option("--truth", arguments->truth,
                      "*.truth.json and *.truth.jsonl files, or folders of them");
  command->add_flag("--surfaces", arguments->is_of_surfaces,
                    "Name the surfaces of models as if they had no semantics, compare with those");
  command->add_option("--lod", arguments->lod, "With --surfaces: level of detail to read");
  command->add_option("--budget", arguments->budget,
                      "With --surfaces: half-edges that segmenting one building may look at");
  add_rules_argument(*command, arguments->rules);
  command->add_flag("--json", arguments->is_json, "As JSON, with all misses");
  command->add_flag("-v,--verbose", arguments->is_verbose, "List all misses, not the first 20");
  command->footer(
      "Example:\n  oriel label data/*.stripped.city.json --features parts.jsonl\n  oriel score "
      "parts.jsonl --truth data/\n  oriel score --surfaces data/*.labelled.city.json");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
