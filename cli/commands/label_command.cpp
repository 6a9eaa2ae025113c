#include "cli/batch/work_place.h"
#include "cli/commands/commands.h"
#include "cli/commands/labelling.h"
#include "cli/pipeline/written_proof.h"
#include "generalise/generalise.h"
#include "interpret/score/surface_score.h"

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments : LabelArguments {
  std::string existing = "fill";
  bool is_json = false;
  bool is_repaired = false;

  [[nodiscard]] WriteOptions write_options() const {
    WriteOptions options;
    if (existing == "keep") options.existing = ExistingSemantics::keep;
    if (existing == "replace") options.existing = ExistingSemantics::replace;
    return options;
  }
};

/// The labelled features of a building for a reader at a terminal.
std::string listing(const Building& building, const OnLine& line) {
  const FeatureTable& of = line.description.table;
  std::vector<std::vector<std::string>> rows{
      {"feature", "label", "score", "margin", "rule", "a m", "b m", "base height m"}};
  const auto number = [&](FeatureId id, const char* name) {
    const auto value = of.number(id, name);
    return value ? fmt::format("{:.2f}", *value) : std::string("-");
  };
  for (const Verdict& verdict : line.interpretation.verdicts) {
    if (verdict.label.empty()) continue;
    rows.push_back({of.id(verdict.feature), verdict.label, fmt::format("{:.2f}", verdict.score),
                    fmt::format("{:.2f}", verdict.margin), verdict.rule,
                    number(verdict.feature, "a"), number(verdict.feature, "b"),
                    number(verdict.feature, "base_height")});
  }
  return fmt::format("{}: {} of {} features have a label\n{}\n", building.id, rows.size() - 1,
                     line.interpretation.verdicts.size(), table(rows));
}

/// --repaired: the labels on the facets of the building's solid. Without one that is valid they
/// stay on the polygons as they came, and the building counts as set aside.
LabelledBuilding on_solid(const Document& document, const Building& building, const OnLine& line,
                          LabelledBuilding labelled, const Tolerances& tolerances,
                          std::vector<Issue>& issues) {
  if (line.is_open) {
    issues.push_back(building_issue(Severity::error, Code::G404, building.id,
                                    "is open: its polygons are labelled as they came"));
    return labelled;
  }
  Generalised whole{*line.solid, {}};
  whole.is_drawn_anew = true;
  LabelledBuilding drawn = redraw(building, labelled, *line.segmentation, line.description.table,
                                  line.interpretation, std::move(whole), tolerances)
                               .labelled;
  const WrittenProof proof = prove_written(document, building, *drawn.geometry);
  if (proof.fault) {
    issues.push_back(*proof.fault);
    return labelled;
  }
  drawn.digits = proof.digits;
  return drawn;
}

/// OBJ has groups and materials, which are no semantics.
bool has_semantics(Format format) {
  return format == Format::cityjson || format == Format::cityjson_seq || format == Format::citygml;
}

/// Says where the input's semantics and the rules disagree; nothing is written.
ExitCode audit(const Arguments& arguments) {
  if (!arguments.out.empty() || !arguments.features.empty())
    throw CLI::ValidationError("--existing",
                               "audit changes nothing: it goes without -o and --features");
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  Run run(arguments, &*rules, report);
  SurfaceScore score;
  Run::Visitor visitor;
  visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
    if (!run.is_last_run() || !has_semantics(document.format)) return;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].has_surfaces())
        compare_surfaces(document.buildings[i], annotated(document.buildings[i], lines[i], *rules),
                         lines[i].surfaces, OpeningPolicy::compare, score);
  };
  const ExitCode code = run.go(visitor);
  const std::string text =
      arguments.is_json ? to_json(score, true) + "\n" : differences_text(score) + to_text(score);
  std::fputs(text.c_str(), stdout);
  run.tell_summary("audited", {});
  return graver(code, score.differences.empty() ? ExitCode::clean : ExitCode::set_aside);
}

Product made_of(std::size_t input, const Document& document, const std::vector<OnLine>& lines,
                const Arguments& arguments, const LabelOutputs& outputs) {
  Product product;
  std::vector<LabelledBuilding> labelled;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    now_at_building(i);
    const Building& building = document.buildings[i];
    if (outputs.has_buildings() && lines[i].has_surfaces()) {
      labelled.push_back(outputs.annotated(building, lines[i]));
      if (arguments.is_repaired && lines[i].is_done())
        labelled.back() = on_solid(document, building, lines[i], std::move(labelled.back()),
                                   lines[i].tolerances, product.issues);
    }
    if (!lines[i].is_done()) continue;
    outputs.make_features(building, lines[i], product);
    if (!outputs.has_any()) product[Part::listing] += listing(building, lines[i]);
  }
  now_at_building(kNoBuilding);
  outputs.make_buildings(input, document, std::move(labelled), arguments.write_options(), product);
  return product;
}

ExitCode work(Arguments& arguments) {
  if (arguments.existing == "audit") return audit(arguments);
  if (arguments.is_piped_stream() && arguments.out.empty() && arguments.features.empty())
    arguments.out = "-";
  if (arguments.is_repaired) arguments.crossings = "cut";
  arguments.only_names_surfaces = true;
  arguments.only_labels_features = !arguments.out.empty() && arguments.features.empty() &&
                                   !arguments.has_reasons && !arguments.is_repaired;
  if (arguments.is_json) throw CLI::ValidationError("--json", "goes with --existing audit only");
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  Run run(arguments, &*rules, report);
  LabelOutputs outputs(arguments, *rules);
  Run::Visitor visitor;
  visitor.begin = [&](std::size_t input) { outputs.begin(input, !run.is_last_run()); };
  visitor.make = [&](std::size_t input, const Document& document, const std::vector<OnLine>& lines,
                     Timings& timings) {
    return timings.measure(Stage::write,
                           [&] { return made_of(input, document, lines, arguments, outputs); });
  };
  visitor.take = [&](const Document& document, Product product) {
    if (!run.is_last_run()) product[Part::listing].clear();
    outputs.take(document, product);
  };
  visitor.places = [&] { return outputs.places(); };
  visitor.recipe = fmt::format("label existing={} repaired={} {}", arguments.existing,
                               arguments.is_repaired, outputs.recipe());
  visitor.end = [&](std::size_t) { run.timings().measure(Stage::write, [&] { outputs.end(); }); };
  visitor.reopen = [&] { outputs.reopen(); };
  visitor.commit = [&] { outputs.commit(); };
  visitor.is_streaming = outputs.is_streaming();
  const ExitCode code = run.go(visitor);
  if (!run.was_done()) run.tell_summary("labelled", run.labels());
  return code;
}

}  // namespace

void add_label(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "label", "Name the parts of buildings by rules and write the buildings with their labels");
  add_label_arguments(*command, *arguments);
  command
      ->add_option(
          "--existing", arguments->existing,
          "Semantics that are there: fill what has none, keep them untouched, replace them, "
          "or audit: only say where the rules disagree")
      ->check(CLI::IsMember({"fill", "keep", "replace", "audit"}))
      ->capture_default_str();
  command->add_flag("--ignore-semantics", arguments->ignores_semantics,
                    "Do not look at what the input calls its polygons");
  command->add_flag("--repaired", arguments->is_repaired,
                    "Write the valid solid of each building, as repair does, with its labels");
  command->add_flag("--explain", arguments->has_reasons,
                    "Write the reason of every label and surface into the file, as oriel_why");
  command->add_flag("--json", arguments->is_json, "With --existing audit: as JSON");
  command->footer(
      "Without -o and --features the labels are listed; a stream from stdin goes to stdout. "
      "Polygons are written as they came, unless --repaired.\n"
      "Example:\n  oriel label house.city.json -o labelled.city.json\n"
      "  oriel label city/*.city.json -o labelled/ --features parts.csv --rules my_rules.yaml");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
