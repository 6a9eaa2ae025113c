#include "cli/series.h"

#include "cli/run.h"
#include "cli/series_files.h"
#include "cli/targets.h"
#include "cli/written_proof.h"
#include "generalise/scale_series.h"
#include "generalise/series_levels.h"
#include "interpret/plan.h"
#include "kernel/io/operation_log.h"
#include "kernel/io/written_grid.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
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
  std::vector<SeriesLevel> levels{};
  std::unique_ptr<FiringScales> firing{};
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
      run_.set_aside(building_issue(Severity::error, "E207", one.building->id, sentence));
    if (!staged.empty()) return;
    Issue issue = building_issue(Severity::error, "E207", "", sentence);
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

  [[nodiscard]] SeriesInput input_of(const Document& document, const Staged& one) const {
    return {*one.building,
            one.labelled,
            *one.line->solid,
            *one.line->segmentation,
            one.line->description.table,
            one.line->interpretation,
            arguments_.segment_options(one.line->tolerances),
            [this, &document, &one](double scale) {
              Invariants invariants = invariants_of(profile_, scale);
              if (one.is_judged)
                invariants.judge =
                    judge_as_written(document, *one.building, *one.line->solid, true);
              return invariants;
            }};
  }

  /// Its levels, if they can be written as valid solids; else it is set aside. Where one cannot,
  /// all are drawn again with every step judged.
  void stage(const Document& document, const Building& building, const OnLine& line,
             std::vector<Staged>& staged) {
    if (line.is_open) {
      run_.set_aside(building_issue(Severity::error, "G404", building.id,
                                    "is open: there is no solid to redraw"));
      return;
    }
    Staged one{&building, &line, outputs_.annotated(building, line)};
    const auto& [table, graph] = line.description;
    const PlanAt plan_at = [&](double scale) {
      Plan asked = plan(rules_, table, graph, line.interpretation, scale);
      if (profile_ != nullptr)
        asked = plan_by_profile(std::move(asked), *profile_, rules_, *line.segmentation, table,
                                line.interpretation, scale);
      return asked;
    };
    auto levels = series_levels(input_of(document, one), scales_, plan_at);
    LevelsProof proof = prove(document, one, levels);
    if (proof.fault) {
      one.is_judged = true;
      levels = series_levels(input_of(document, one), scales_, plan_at);
      proof = prove(document, one, levels);
    }
    std::ranges::move(proof.excuses, std::back_inserter(levels.issues));
    if (proof.fault) levels.issues.push_back(std::move(*proof.fault));
    if (!keep(levels.issues)) return;
    one.levels = std::move(*levels.value);
    one.firing = std::make_unique<FiringScales>(scales_, bounds_, plan_at);
    staged.push_back(std::move(one));
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

  struct LevelsProof {
    std::optional<Issue> fault;  ///< of a level that is valid at no scale of the file
    std::vector<Issue> excuses;
  };

  /// Says of each level how fine the file has to be.
  static LevelsProof prove(const Document& document, const Staged& one,
                           Checked<std::vector<SeriesLevel>>& levels) {
    LevelsProof out;
    if (!levels.value) return out;
    for (std::size_t i = 1; i < levels.value->size(); ++i) {
      SeriesLevel& level = (*levels.value)[i];
      const SeriesLevel& before = (*levels.value)[i - 1];
      LabelledBuilding& labelled = level.redrawn.labelled;
      labelled.digits = before.redrawn.labelled.digits;
      if (level.generalised.removed == before.generalised.removed &&
          level.generalised.changed.empty())
        continue;
      WrittenProof proof =
          prove_redrawn(document, *one.building, *one.line->solid, *labelled.geometry);
      labelled.digits = std::max(labelled.digits, proof.digits);
      if (proof.excuse) out.excuses.push_back(std::move(*proof.excuse));
      if (!proof.fault) continue;
      out.fault = std::move(proof.fault);
      break;
    }
    return out;
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
      run_.set_aside(building_issue(Severity::error, "E901", one.building->id,
                                    fmt::format("a fault of oriel's own: {}", fault.what())));
      return 0;
    }
    for (const SeriesOperation& operation : series.operations) log += operation_line(operation);
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
    refuse_usage(option, "E125",
                 fmt::format("'{}' is no scale: write 1:N with N >= 1, such as 1:2000", text));
  return value;
}

ExitCode write_series(const LabelArguments& arguments, const std::vector<double>& scales,
                      const Profile* profile, const RuleBase& rules, Report& report) {
  Run run(arguments, &rules, report);
  return SeriesWriter(arguments, scales, profile, rules, run, report).go();
}

}  // namespace oriel::cli
