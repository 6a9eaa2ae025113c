#include "cli/batch/work_place.h"
#include "cli/commands/commands.h"
#include "cli/commands/labelling.h"
#include "cli/commands/targets.h"
#include "cli/output/accounts.h"
#include "cli/series/building_drawer.h"
#include "cli/series/series.h"
#include "generalise/generalise.h"

#include <algorithm>
#include <map>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// What --edge-min may be: from the file's own millimetres to the size of a storey.
constexpr double kLeastEdge_m = 0.001, kMostEdge_m = 10;

struct Arguments : LabelArguments {
  TargetArguments target;
  std::vector<std::string> series;
  std::string at;
  std::string explain;
  std::string metrics;
};

class Generaliser {
 public:
  Generaliser(const Arguments& arguments, const Targets& targets, const RuleBase& rules, Run& run)
      : arguments_(arguments),
        targets_(targets),
        run_(run),
        outputs_(arguments, rules),
        accounts_(arguments.explain, arguments.metrics),
        drawer_(arguments, targets, rules, outputs_, accounts_) {}

  ExitCode go() {
    Run::Visitor visitor;
    visitor.begin = [&](std::size_t input) {
      if (input == 0 && arguments_.repeat > 1) removed_.clear();
      accounts_.begin(!run_.is_last_run());
      outputs_.begin(input, !run_.is_last_run());
    };
    visitor.make = [&](std::size_t input, const Document& document,
                       const std::vector<OnLine>& lines,
                       Timings& timings) { return redraw_record(input, document, lines, timings); };
    visitor.take = [&](const Document& document, const Product& product) {
      outputs_.take(document, product);
      accounts_.take(product);
    };
    visitor.places = [&] {
      PartPlaces places = outputs_.places();
      accounts_.add_places(places);
      return places;
    };
    const bool is_json = arguments_.explain.ends_with(".jsonl");
    visitor.recipe = fmt::format("generalise {} explain={} json={} metrics={} {}",
                                 targets_.recipe(), !arguments_.explain.empty(), is_json,
                                 accounts_.has_metrics(), outputs_.recipe());
    visitor.end = [&](std::size_t) {
      run_.timings().measure(Stage::write, [&] { outputs_.end(); });
    };
    visitor.reopen = [&] {
      accounts_.begin(false);
      outputs_.reopen();
    };
    visitor.commit = [&] {
      outputs_.commit();
      accounts_.commit();
    };
    visitor.is_streaming = outputs_.is_streaming();
    visitor.counts = &removed_;
    const ExitCode code = run_.go(visitor);
    if (!run_.was_done())
      run_.tell_summary("generalised to " + targets_.text(), removed_, " left out");
    return code;
  }

 private:
  Product redraw_record(std::size_t input, const Document& document,
                        const std::vector<OnLine>& lines, Timings& timings) const {
    Product product;
    std::vector<LabelledBuilding> labelled;
    WriteOptions options;
    std::vector<DrawnBuilding> drawn;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      now_at_building(i);
      if (!lines[i].is_done()) continue;
      if (lines[i].is_open) {
        product.issues.push_back(building_issue(Severity::error, Code::G404,
                                                document.buildings[i].id,
                                                "is open: there is no solid to redraw"));
        continue;
      }
      drawn.push_back(
          timings.measure(Stage::generalise, [&] { return drawer_.draw(document, i, lines[i]); }));
    }
    for (DrawnBuilding& one : drawn) {
      now_at_building(one.building);
      const OnLine& line = lines[one.building];
      timings.measure(Stage::write, [&] { drawer_.keep_valid(document, line, one); });
      std::optional<OnLine> mended;
      if (one.is_excused() || one.is_given_up())
        mended = drawer_.mend(document, line, one, timings);
      outputs_.make_features(document.buildings[one.building], mended ? *mended : line, product);
      tell(std::move(one.told), product);
      add(std::move(one.all), labelled, options, product);
    }
    now_at_building(kNoBuilding);
    timings.measure(Stage::write, [&] {
      outputs_.make_buildings(input, document, std::move(labelled), options, product);
    });
    return product;
  }

  static void tell(Product told, Product& product) {
    for (std::size_t part = 0; part < told.bytes.size(); ++part)
      product.bytes[part] += told.bytes[part];
    product.issues.insert(product.issues.end(), told.issues.begin(), told.issues.end());
  }

  /// Of several levels of detail the first says what is gone from the building; an installation
  /// leaves the file if no level has it.
  void add(std::vector<Redrawn> all, std::vector<LabelledBuilding>& labelled, WriteOptions& options,
           Product& product) const {
    for (std::size_t i = 0; i < all.size(); ++i) {
      Redrawn& redrawn = all[i];
      for (const std::string& id : redrawn.removed_ids)
        if (std::ranges::none_of(all, [&](const Redrawn& other) { return has(other, id); }))
          options.removed.push_back(id);
      if (i == 0)
        for (const auto& [label, count] : redrawn.removed) product.counts[label] += count;
      else
        redrawn.labelled.attributes.clear();
    }
    for (Redrawn& redrawn : all) labelled.push_back(std::move(redrawn.labelled));
  }
  static bool has(const Redrawn& redrawn, const std::string& id) {
    const auto& list = redrawn.labelled.installations;
    return std::ranges::find(list, id, &Installation::id) != list.end();
  }

  const Arguments& arguments_;
  const Targets& targets_;
  Run& run_;
  LabelOutputs outputs_;
  Accounts accounts_;
  BuildingDrawer drawer_;
  std::map<std::string, int> removed_;  ///< features that are gone, by label
};

/// Ascending; none stands twice.
std::vector<double> scales_of(const std::vector<std::string>& texts) {
  std::vector<double> scales;
  for (const std::string& text : texts) scales.push_back(denominator_of(text, "--series"));
  std::ranges::sort(scales);
  const auto twin = std::ranges::adjacent_find(scales);
  if (twin != scales.end())
    refuse_usage("--series", Code::E125, fmt::format("the scale 1:{} stands twice", *twin));
  return scales;
}

/// The profile of a series; nothing if it cannot be used, which is told.
std::optional<ExitCode> make_series(const Arguments& arguments, const RuleBase& rules,
                                    Report& report) {
  if (arguments.series.empty()) return std::nullopt;
  if (!arguments.explain.empty() || !arguments.metrics.empty())
    refuse_usage("--series", Code::G414,
                 "goes without --explain and --metrics, which are of one scale");
  const std::vector<double> scales = scales_of(arguments.series);
  if (arguments.target.profile.empty())
    return write_series(arguments, scales, nullptr, rules, report);
  const auto profile = load_profile_file(arguments.target.profile);
  report.tell(profile.issues);
  if (!profile.value) return ExitCode::rules;
  report.tell(check_profile(*profile.value, rules));
  return write_series(arguments, scales, &*profile.value, rules, report);
}

/// With --at the option --from names a series, else the format of the inputs.
void check_source(const Arguments& arguments) {
  if (!arguments.at.empty()) {
    if (!arguments.inputs.empty())
      throw CLI::ValidationError("--at", "has no input but the series that --from names");
    if (arguments.from.empty())
      throw CLI::ValidationError("--at", "--from says the NAME of the series");
    return;
  }
  if (arguments.inputs.empty()) throw CLI::RequiredError("input");
  const std::string wrong = input_formats()(arguments.from);
  if (!arguments.from.empty() && !wrong.empty()) throw CLI::ValidationError("--from", wrong);
}

ExitCode work(Arguments& arguments) {
  arguments.only_names_surfaces = true;
  if (arguments.out.empty()) {
    if (!arguments.is_piped_stream() || !arguments.series.empty())
      throw CLI::RequiredError("--output");
    arguments.out = "-";
  }
  Report report(arguments.is_verbose);
  check_source(arguments);
  if (!arguments.at.empty())
    return write_level_at(arguments.from, denominator_of(arguments.at, "--at"), arguments.out,
                          report);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  if (const auto code = make_series(arguments, *rules, report)) return *code;
  const auto targets = targets_of(arguments.target, *rules, report);
  if (!targets) return ExitCode::rules;
  if (std::ranges::any_of(targets->profiles, &Profile::names_classes))
    arguments.stl_solids = StlSolids::by_class;
  Run run(arguments, &*rules, report);
  Generaliser generaliser(arguments, *targets, *rules, run);
  return generaliser.go();
}

}  // namespace

void add_generalise(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("generalise",
                                         "Redraw buildings for a target scale or level of detail: "
                                         "a closed solid with what it can show");
  add_label_arguments(*command, *arguments);
  command->get_option("input")->required(false);
  CLI::Option* from = command->get_option("--from");
  from->get_validator(0)->active(false);
  from->description(from->get_description() + "; with --at the NAME of a series");
  CLI::Option_group* target = command->add_option_group("Target");
  const CLI::Option* scale =
      target->add_option("--scale", arguments->target.scale, "Target scale, such as 1:2000");
  target
      ->add_option("--to-lod", arguments->target.lods,
                   "Levels of detail to make, such as 2.0,1.2; they share a file")
      ->allow_extra_args(false)
      ->delimiter(',');
  target
      ->add_option("--series", arguments->series,
                   "Scales such as 1:500,1:2000: a file for each, NAME.1-2000.city.json, and the "
                   "log of all operations, NAME.oplog.jsonl; -o is NAME")
      ->allow_extra_args(false)
      ->delimiter(',');
  target->add_option("--at", arguments->at,
                     "The level at this scale, of the series --from NAME, without any input");
  target->require_option(0, 1);
  command->add_option("--explain", arguments->explain,
                      "File for what became of each feature, by which rule, and what was refused "
                      "and why: text, or JSON lines if it ends in .jsonl");
  command->add_option(
      "--metrics", arguments->metrics,
      "File for figures before and after, a JSON line for each building and target");
  command->add_option(
      "--profile", arguments->target.profile,
      "What to do with features that the pack has no entry for: NAME[:LEVEL] or a "
      "file (--to-lod: lod; --scale: they stay); without a target its level is made");
  command
      ->add_option("--edge-min", arguments->target.edge_min_m,
                   "The least length of an edge and a gap that the profile asks for, in m")
      ->check(CLI::Range(kLeastEdge_m, kMostEdge_m));
  command->footer(
      "Example:\n  oriel generalise house.city.json --scale 1:20000 -o house-1-20000.city.json");
  command->callback([arguments, &action, target, scale] {
    if (target->count_all() == 0 && arguments->target.profile.empty())
      throw CLI::RequiredError("[--scale,--to-lod,--series,--at]");
    arguments->target.has_scale = scale->count() > 0;
    action = [arguments] { return work(*arguments); };
  });
}

}  // namespace oriel::cli
