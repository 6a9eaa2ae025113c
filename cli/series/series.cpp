#include "cli/series/series.h"

#include "cli/batch/run.h"
#include "cli/commands/targets.h"
#include "cli/pipeline/mended_line.h"
#include "cli/pipeline/written_proof.h"
#include "cli/series/series_files.h"
#include "generalise/series/scale_series.h"
#include "generalise/series/series_levels.h"
#include "interpret/plan/plan.h"
#include "kernel/io/levels/written_grid.h"
#include "kernel/io/records/operation_log.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <functional>
#include <iterator>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// One building with its levels, before the grid of the file is known.
struct Staged {
  const Building* building = nullptr;
  const OnLine* line = nullptr;
  LabelledBuilding labelled;
  bool is_judged = false;  ///< each step of its levels is, which takes long
  /// It is drawn from a mended solid: folded facets are parted, and each level judged by itself.
  bool is_mended = false;
  std::vector<SeriesLevel> levels{};
  std::unique_ptr<FiringScales> firing{};
  std::vector<Issue> issues{};             ///< of its levels
  std::unique_ptr<const OnLine> mended{};  ///< what `line` is, if the building was mended

  /// All levels are valid solids in the file.
  [[nodiscard]] bool is_valid() const {
    return !has_errors(issues) &&
           std::ranges::find(issues, Code::G413, &Issue::code) == issues.end();
  }
};

class SeriesWriter {
 public:
  SeriesWriter(const LabelArguments& arguments, const std::vector<double>& scales,
               const Profile* profile, const RuleBase& rules, Run& run, Report& report)
      : arguments_(arguments),
        scales_(scales),
        profile_(profile),
        rules_(rules),
        run_(run),
        report_(report),
        files_(arguments, scales),
        labels_(labels_only(arguments)),
        outputs_(labels_, rules),
        bounds_(plan_bounds(rules)) {}

  ExitCode go() {
    Run::Visitor visitor;
    visitor.begin = [&](std::size_t input) {
      files_.begin(input, !run_.is_last_run());
      outputs_.begin(input, !run_.is_last_run());
      if (input == 0) operations_ = 0;
    };
    visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
      add_record(document, lines);
    };
    visitor.end = [&](std::size_t) {
      run_.timings().measure(Stage::write, [&] {
        files_.end();
        outputs_.end();
      });
    };
    visitor.commit = [&] {
      files_.commit();
      outputs_.commit();
    };
    const ExitCode code = run_.go(visitor);
    run_.tell_summary(fmt::format("made {} levels of", scales_.size()),
                      {{"operation", operations_}}, " in the log");
    return code;
  }

 private:
  /// What the files of a series are called is no file to be written.
  static LabelArguments labels_only(LabelArguments arguments) {
    arguments.out.clear();
    return arguments;
  }

  void add_record(const Document& document, const std::vector<OnLine>& lines) {
    std::vector<Staged> staged;
    std::vector<const LabelledBuilding*> solids;
    run_.timings().measure(Stage::generalise, [&] {
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].is_done()) stage(document, document.buildings[i], lines[i], staged);
    });
    for (const Staged& one : staged)
      for (const SeriesLevel& level : one.levels) solids.push_back(&level.redrawn.labelled);
    const WrittenGrid grid(document, solids);
    std::vector<SeriesFiles::Drawn> drawn(scales_.size());
    for (SeriesFiles::Drawn& one : drawn) one.options.finer_digits = grid.finer_digits();
    std::string log;
    int operations = 0;
    run_.timings().measure(Stage::generalise, [&] {
      for (const Staged& one : staged) operations += add_building(document, one, grid, drawn, log);
    });
    run_.timings().measure(Stage::write, [&] {
      const auto twin = files_.add(document, drawn, log);
      if (twin) return set_aside_twin(staged, document, *twin);
      operations_ += operations;
      add_features(document, lines);
    });
  }

  /// Buildings that are not staged were set aside before.
  void set_aside_twin(const std::vector<Staged>& staged, const Document& document,
                      const std::string& id) {
    const std::string sentence =
        fmt::format("an earlier input has a CityObject '{}': that one is in the series", id);
    for (const Staged& one : staged)
      run_.set_aside(building_issue(Severity::error, Code::E207, one.building->id, sentence));
    if (!staged.empty()) return;
    Issue issue = building_issue(Severity::error, Code::E207, "", sentence);
    issue.place.file = document.name;
    run_.set_aside(issue);
  }

  void add_features(const Document& document, const std::vector<OnLine>& lines) {
    if (arguments_.features.empty()) return;
    Product product;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].is_done()) outputs_.make_features(document.buildings[i], lines[i], product);
    outputs_.take(document, product);
  }

  static std::function<void(LabelledBuilding&)> finishing(const Document& document,
                                                          const Staged& one) {
    return [&document, building = one.building](LabelledBuilding& labelled) {
      part_written(document, *building, labelled);
    };
  }

  static std::function<std::optional<Issue>(const Solid&)> judging(const Document& document,
                                                                   const Staged& one) {
    return [&document, building = one.building, line = one.line](const Solid& solid) {
      return prove_redrawn(document, *building, *line->solid, solid).fault;
    };
  }

  [[nodiscard]] SeriesInput input_of(const Document& document, const Staged& one) const {
    return {*one.building,
            one.labelled,
            *one.line->solid,
            *one.line->segmentation,
            one.line->description.table,
            one.line->interpretation,
            arguments_.segment_options(one.line->tolerances),
            [this, &document, &one](double scale) {
              Invariants invariants = beside_others(invariants_of(profile_, rules_, scale),
                                                    document, *one.building, *one.line->solid);
              if (one.is_judged)
                invariants.validator =
                    judge_as_written(document, *one.building, *one.line->solid, true);
              return invariants;
            },
            one.is_mended ? finishing(document, one) : nullptr,
            one.is_mended ? judging(document, one) : nullptr};
  }

  /// Its levels; set aside if one cannot be written as a valid solid, unless it came as none
  /// (G413). First its steps are judged, then it is mended, where either helps.
  void stage(const Document& document, const Building& building, const OnLine& line,
             std::vector<Staged>& staged) {
    if (line.is_open) {
      run_.set_aside(building_issue(Severity::error, Code::G404, building.id,
                                    "is open: there is no solid to redraw"));
      return;
    }
    Staged one = with_levels(document, building, line);
    if (has_errors(one.issues)) judge(document, one);
    if (!one.is_valid()) mend(document, one);
    if (!keep(one.issues)) return;
    staged.push_back(std::move(one));
  }

  [[nodiscard]] Staged with_levels(const Document& document, const Building& building,
                                   const OnLine& line, bool is_mended = false) const {
    Staged one{&building, &line, outputs_.annotated(building, line)};
    one.is_mended = is_mended;
    draw_levels(document, one);
    return one;
  }

  /// Draws them again with every step judged.
  void judge(const Document& document, Staged& one) const {
    one.is_judged = true;
    draw_levels(document, one);
  }

  /// Draws them from the mended solid, if they are valid then.
  void mend(const Document& document, Staged& one) const {
    Timings within;  // of stages that are measured already, as generalising
    auto mended = mended_line(arguments_, &rules_, document, *one.building, *one.line, within);
    if (!mended) return;
    auto line = std::make_unique<const OnLine>(std::move(*mended));
    Staged anew = with_levels(document, *one.building, *line, true);
    if (!anew.is_valid()) return;
    anew.issues.insert(anew.issues.begin(), line->issues.back());
    anew.mended = std::move(line);
    one = std::move(anew);
  }

  void draw_levels(const Document& document, Staged& one) const {
    const auto& [table, graph] = one.line->description;
    const PlanAt plan_at = [&](double scale) {
      Plan asked = plan(rules_, table, graph, one.line->interpretation, scale);
      if (profile_ != nullptr)
        asked = plan_by_profile(std::move(asked), *profile_, rules_, *one.line->segmentation, table,
                                one.line->interpretation, scale);
      return asked;
    };
    auto levels = series_levels(input_of(document, one), scales_, plan_at);
    one.issues = std::move(levels.issues);
    if (!levels.value) return;
    one.levels = std::move(*levels.value);
    prove(document, one);
    one.firing = std::make_unique<FiringScales>(scales_, bounds_, plan_at);
  }

  /// False if there is an error: the building is set aside.
  bool keep(const std::vector<Issue>& issues) {
    for (const Issue& issue : issues)
      if (issue.severity == Severity::error)
        run_.set_aside(issue);
      else
        report_.tell(issue);
    return !has_errors(issues);
  }

  /// Says of each level how fine the file has to be; what is valid at no scale of the file is an
  /// error.
  static void prove(const Document& document, Staged& one) {
    for (std::size_t i = 1; i < one.levels.size() && !has_errors(one.issues); ++i) {
      SeriesLevel& level = one.levels[i];
      const SeriesLevel& before = one.levels[i - 1];
      LabelledBuilding& labelled = level.redrawn.labelled;
      labelled.digits = before.redrawn.labelled.digits;
      const bool is_same = level.generalised.removed == before.generalised.removed &&
                           level.generalised.changed.empty();
      if (is_same && i > 1) continue;
      WrittenProof proof =
          prove_redrawn(document, *one.building, *one.line->solid, *labelled.geometry);
      labelled.digits = std::max(labelled.digits, proof.digits);
      if (proof.excuse) one.issues.push_back(std::move(*proof.excuse));
      if (proof.fault) one.issues.push_back(std::move(*proof.fault));
    }
  }

  /// Its levels and its lines of the log, or nothing of it. Returns how many operations there are.
  int add_building(const Document& document, const Staged& one, const WrittenGrid& grid,
                   std::vector<SeriesFiles::Drawn>& drawn, std::string& log) {
    const Frame& frame = one.building->frame;
    ScaleSeries series;
    try {
      series = scale_series(input_of(document, one), one.levels, *one.firing,
                            [&](Vec3 local_m) { return grid.place(local_m, frame); });
    } catch (const GeometryError& fault) {
      run_.set_aside(building_issue(Severity::error, Code::E901, one.building->id,
                                    fmt::format("a fault of oriel's own: {}", fault.what())));
      return 0;
    }
    for (SeriesOperation& operation : series.operations) {
      operation.lod = arguments_.lod;
      log += operation_line(operation);
    }
    LevelState state = series.finest;
    for (std::size_t i = 0; i < scales_.size(); ++i) {
      const double before = i == 0 ? 0 : scales_[i - 1];
      if (!move_state(state, series.operations, before, scales_[i]))
        throw GeometryError("an operation of a series does not fit the state before it");
      LabelledBuilding level = labelled_building(state, frame);
      for (const Installation& installation : one.labelled.installations)
        if (!state.installations.contains(installation.id))
          drawn[i].options.removed.push_back(installation.id);
      level.attributes.insert(level.attributes.begin(), one.labelled.attributes.begin(),
                              one.labelled.attributes.end());
      drawn[i].labelled.push_back(std::move(level));
    }
    return static_cast<int>(series.operations.size());
  }

  const LabelArguments& arguments_;
  const std::vector<double>& scales_;
  const Profile* profile_;
  const RuleBase& rules_;
  Run& run_;
  Report& report_;
  SeriesFiles files_;
  LabelArguments labels_;
  LabelOutputs outputs_;
  std::vector<double> bounds_;
  int operations_ = 0;
};

}  // namespace

double denominator_of(const std::string& text, const std::string& option) {
  std::string number;
  std::ranges::remove_copy(text, std::back_inserter(number), ' ');
  if (number.starts_with("1:")) number.erase(0, 2);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || !(value >= 1) ||
      !std::isfinite(value))
    refuse_usage(option, Code::E125,
                 fmt::format("'{}' is no scale: write 1:N with N >= 1, such as 1:2000", text));
  return value;
}

ExitCode write_series(const LabelArguments& arguments, const std::vector<double>& scales,
                      const Profile* profile, const RuleBase& rules, Report& report) {
  Run run(arguments, &rules, report);
  return SeriesWriter(arguments, scales, profile, rules, run, report).go();
}

}  // namespace oriel::cli
