#include "cli/accounts.h"
#include "cli/commands.h"
#include "cli/labelling.h"
#include "cli/series.h"
#include "cli/targets.h"
#include "cli/work_place.h"
#include "cli/written_proof.h"
#include "generalise/fineness.h"
#include "generalise/generalise.h"
#include "generalise/to_lod.h"
#include "interpret/plan.h"
#include "kernel/compare/hausdorff.h"
#include "kernel/validate/validate.h"

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
        rules_(rules),
        run_(run),
        outputs_(arguments, rules),
        accounts_(arguments.explain, arguments.metrics) {}

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
    std::vector<Drawn> drawn;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      now_at_building(i);
      if (!lines[i].is_done()) continue;
      if (lines[i].is_open) {
        product.issues.push_back(building_issue(Severity::error, "G404", document.buildings[i].id,
                                                "is open: there is no solid to redraw"));
        continue;
      }
      outputs_.make_features(document.buildings[i], lines[i], product);
      drawn.push_back(timings.measure(
          Stage::generalise, [&] { return drawn_building(document, i, lines[i], false); }));
    }
    for (Drawn& one : drawn) {
      now_at_building(one.building);
      timings.measure(Stage::write, [&] { keep_valid(document, lines[one.building], one); });
      tell(std::move(one.told), product);
      add(std::move(one.all), labelled, options, product);
    }
    now_at_building(kNoBuilding);
    timings.measure(Stage::write, [&] {
      outputs_.make_buildings(input, document, std::move(labelled), options, product);
    });
    return product;
  }

  /// What became of a building of the record; nothing if it was set aside.
  struct Drawn {
    std::size_t building = 0;
    std::vector<Redrawn> all;
    Product told;  ///< what is to be told of it
  };
  Drawn drawn_building(const Document& document, std::size_t building, const OnLine& line,
                       bool is_thorough) const {
    Drawn drawn{building, {}, {}};
    drawn.all =
        redraw_building(document, document.buildings[building], line, is_thorough, drawn.told);
    return drawn;
  }

  /// Says how fine the file has to be for a building to be valid in it. What is valid at no scale
  /// is drawn again with each step judged; if that is valid at none either it stays as it came,
  /// levels of detail are set aside.
  void keep_valid(const Document& document, const OnLine& line, Drawn& drawn) const {
    std::optional<Issue> fault = prove(document, line, drawn);
    if (!fault) return;
    Drawn again = drawn_building(document, drawn.building, line, true);
    if (!again.all.empty() && !prove(document, line, again)) {
      drawn = std::move(again);
      return;
    }
    drawn.all.clear();
    if (targets_.has_lods()) {
      drawn.told.issues.push_back(*fault);
      return;
    }
    fault->severity = Severity::warning;
    fault->sentence += "; it stays as it came";
    drawn.told.issues.push_back(*fault);
    drawn.all.push_back(untouched(document, document.buildings[drawn.building], line, drawn.told));
  }

  /// The building without any operation.
  [[nodiscard]] Redrawn untouched(const Document& document, const Building& building,
                                  const OnLine& line, Product& told) const {
    LabelledBuilding labelled = outputs_.annotated(building, line);
    Generalised whole{*line.solid, {}};
    mend_unchanged(document, building, line, whole, told);
    if (!whole.is_drawn_anew) return {std::move(labelled), {}, {}};
    Redrawn redrawn = redraw(building, labelled, *line.segmentation, line.description.table,
                             line.interpretation, std::move(whole), line.tolerances);
    redrawn.labelled.digits = prove_written(document, building, *redrawn.labelled.geometry).digits;
    return redrawn;
  }

  /// Of each target how fine the file has to be; what is valid at no scale is the fault.
  static std::optional<Issue> prove(const Document& document, const OnLine& line, Drawn& drawn) {
    std::optional<Issue> fault;
    for (Redrawn& redrawn : drawn.all) {
      if (!redrawn.labelled.geometry) continue;
      WrittenProof proof = prove_redrawn(document, document.buildings[drawn.building], *line.solid,
                                         *redrawn.labelled.geometry);
      redrawn.labelled.digits = proof.digits;
      if (proof.fault) fault = std::move(proof.fault);
      if (proof.excuse) drawn.told.issues.push_back(std::move(*proof.excuse));
    }
    return fault;
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

  /// One for each target; none if one of them cannot be had. `is_thorough` as of Judge.
  std::vector<Redrawn> redraw_building(const Document& document, const Building& building,
                                       const OnLine& line, bool is_thorough,
                                       Product& product) const {
    std::vector<Redrawn> all;
    const LabelledBuilding labelled = outputs_.annotated(building, line);
    const std::size_t count = targets_.has_lods() ? targets_.profiles.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
      auto redrawn = redraw_for(i < targets_.profiles.size() ? &targets_.profiles[i] : nullptr,
                                document, building, labelled, line, is_thorough, product);
      if (!redrawn) return {};
      all.push_back(std::move(*redrawn));
    }
    return all;
  }

  std::optional<Redrawn> redraw_for(const Profile* profile, const Document& document,
                                    const Building& building, const LabelledBuilding& labelled,
                                    const OnLine& line, bool is_thorough, Product& product) const {
    const auto& [table, graph] = line.description;
    Plan plan;
    if (targets_.scale)
      plan = oriel::plan(rules_, table, graph, line.interpretation, *targets_.scale);
    if (profile != nullptr)
      plan = plan_by_profile(std::move(plan), *profile, rules_, *line.segmentation, table,
                             line.interpretation, targets_.scale);
    keep(plan.issues, product);
    Invariants invariants;
    if (profile != nullptr)
      invariants = {profile->footprint_pct, profile->volume_pct, profile->top_m,
                    profile->overhang_pct};
    // Blocks have edges of their own, and what asks for edges everywhere takes their owners off.
    if (profile == nullptr || (profile->form == Profile::Form::as_is && !profile->edge_min_m))
      invariants.least_edge_m = least_edge(profile);
    invariants.judge = judge_as_written(document, building, *line.solid, is_thorough);
    const auto carry_out = [&] {
      return generalise(*line.solid, *line.segmentation, table, line.interpretation, plan,
                        arguments_.segment_options(line.tolerances), invariants);
    };
    auto generalised = carry_out();
    if (profile != nullptr && profile->edge_min_m && profile->edge_owner_b_m)
      while (generalised.value &&
             add_fine_owners(*generalised.value, *line.segmentation, table, *profile->edge_min_m,
                             *profile->edge_owner_b_m, profile->title() + "/edge-min", plan))
        generalised = carry_out();
    if (!keep(generalised.issues, product) || !generalised.value) return std::nullopt;
    // Levels of detail are drawn in any case, and judged as they are drawn.
    if (!targets_.has_lods()) mend_unchanged(document, building, line, *generalised.value, product);
    const std::string target = targets_.has_lods() ? "LoD " + profile->level : targets_.text();
    if (accounts_.has_any())
      product[Part::deeds] += accounts_.text(
          building.id, target, account(plan, *generalised.value, table, line.interpretation));
    const double least_edge_m = least_edge(profile);
    // What is kept of it is not known any more once it is redrawn.
    const Generalised changes{{}, generalised.value->removed, generalised.value->refused};
    const auto keep_figures = [&](const Redrawn& redrawn) {
      const auto& solid = redrawn.labelled.geometry;
      const Solid& after = solid ? *solid : *line.solid;
      if (profile != nullptr)
        keep(fineness_issues(building, *line.solid, after, *line.segmentation, table, changes,
                             {least_edge_m, profile->edge_min_m.has_value()}),
             product);
      if (!accounts_.has_metrics()) return;
      product[Part::figures] +=
          accounts_.text(building.id, target, least_edge_m, figures_of(*line.solid, least_edge_m),
                         figures_of(after, least_edge_m), hausdorff_m(*line.solid, after));
    };
    const Tolerances& tolerances = line.tolerances;
    if (!targets_.has_lods()) {
      Redrawn redrawn = redraw(building, labelled, *line.segmentation, table, line.interpretation,
                               std::move(*generalised.value), tolerances);
      keep_figures(redrawn);
      return redrawn;
    }
    auto drawn = to_lod(building, labelled, *line.segmentation, table, line.interpretation,
                        *profile, std::move(*generalised.value), tolerances);
    if (!keep(drawn.issues, product)) return std::nullopt;
    keep_figures(*drawn.value);
    return std::move(drawn.value);
  }

  /// What nothing was done to stays as it came, unless it came as no valid solid and its solid is
  /// valid: then that is drawn.
  static void mend_unchanged(const Document& document, const Building& building, const OnLine& line,
                             Generalised& generalised, Product& product) {
    if (!generalised.removed.empty() || !generalised.changed.empty()) return;
    const auto findings = validate(building);
    if (findings.empty()) return;
    if (prove_written(document, building, *line.solid).fault) {
      if (building.is_solid)
        product.issues.push_back(
            excuse_of(building, fmt::format("{} {}", findings[0].code, findings[0].sentence)));
      return;
    }
    generalised.is_drawn_anew = true;
    product.issues.push_back(building_issue(
        Severity::note, "G419", building.id,
        fmt::format("was not valid as it was read ({}) and is drawn anew", findings[0].code)));
  }

  /// The least length that the target shows: the profile's, or its c, else 0.125 mm on the map.
  [[nodiscard]] double least_edge(const Profile* profile) const {
    if (profile != nullptr && profile->edge_min_m) return *profile->edge_min_m;
    const auto sizes = profile != nullptr ? profile->thresholds(targets_.scale) : std::nullopt;
    return sizes ? sizes->c_m : kGapOnMap_m * targets_.scale.value_or(0);
  }

  /// False if there is an error: the building is set aside.
  static bool keep(const std::vector<Issue>& issues, Product& product) {
    product.issues.insert(product.issues.end(), issues.begin(), issues.end());
    return !has_errors(issues);
  }

  const Arguments& arguments_;
  const Targets& targets_;
  const RuleBase& rules_;
  Run& run_;
  LabelOutputs outputs_;
  Accounts accounts_;
  std::map<std::string, int> removed_;  ///< features that are gone, by label
};

/// Ascending; none stands twice.
std::vector<double> scales_of(const std::vector<std::string>& texts) {
  std::vector<double> scales;
  for (const std::string& text : texts) scales.push_back(denominator_of(text, "--series"));
  std::ranges::sort(scales);
  const auto twin = std::ranges::adjacent_find(scales);
  if (twin != scales.end())
    refuse_usage("--series", "E125", fmt::format("the scale 1:{} stands twice", *twin));
  return scales;
}

/// The profile of a series; nothing if it cannot be used, which is told.
std::optional<ExitCode> make_series(const Arguments& arguments, const RuleBase& rules,
                                    Report& report) {
  if (arguments.series.empty()) return std::nullopt;
  if (!arguments.explain.empty() || !arguments.metrics.empty())
    refuse_usage("--series", "G414",
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
      ->delimiter(',');
  target
      ->add_option("--series", arguments->series,
                   "Scales such as 1:500,1:2000: a file for each, NAME.1-2000.city.json, and the "
                   "log of all operations, NAME.oplog.jsonl; -o is NAME")
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
