#pragma once

#include "interpret/pack/rule_base.h"
#include "interpret/params/with_params.h"
#include "kernel/base/issue.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// Where something stands in an experiment's file, to point at it when something is found later.
struct PlanSpot {
  Place place;
  std::string excerpt;

  [[nodiscard]] Issue issue(Severity severity, Code code, std::string sentence) const;
};

/// Files by a pattern such as `city/*.truth.json`, relative to the experiment's file.
struct FilePattern {
  /// As it is written.
  std::string text;
  PlanSpot spot;
};

/// How the buildings of a set are parted: learnt on some, measured on the others.
struct SplitPlan {
  enum class Kind { none, folds, leave_one_out, held_out };
  Kind kind = Kind::none;
  /// Of `folds`, at least 2.
  int folds = 0;
  /// Of `held_out`: ids of the buildings that nothing is learnt from.
  std::vector<std::string> held_out;
  PlanSpot spot;
};

/// Buildings and what is known to be there.
struct SetPlan {
  std::string name;
  /// One of these may be empty. Where there are both, stored features are taken as those of the
  /// models.
  std::vector<FilePattern> models, features;
  std::vector<FilePattern> truth;
  /// What the models call their polygons is not looked at, as if they were stripped.
  bool ignores_semantics = true;
  SplitPlan split;
  PlanSpot spot;
};

/// How buildings become features, as far as the file says it; missing: as the command has it
/// (oriel/options.h).
struct SegmentationPlan {
  std::optional<std::string> order;
  std::optional<double> coplanar_deg, plane_offset_m, weld_m, value_rel;
  std::optional<std::string> close, crossings;
  std::optional<double> close_area_m2;
  std::optional<std::int64_t> budget;
  std::optional<std::string> lod;

  [[nodiscard]] bool is_empty() const { return *this == SegmentationPlan(); }
  /// What `other` says counts where it says something.
  [[nodiscard]] SegmentationPlan with(const SegmentationPlan& other) const;
  friend bool operator==(const SegmentationPlan&, const SegmentationPlan&) = default;
};

/// A pack, and params of it that have other values.
struct RulesPlan {
  /// As the file names it.
  std::string pack;
  /// Missing only in a plan with errors, and where nothing is asked of rules.
  std::optional<RuleBase> base;
  std::vector<ParamValue> params;
  PlanSpot spot;
};

/// A param and the values that it takes.
struct SweptParam {
  std::string name;
  std::vector<double> values;
  /// From which random values are drawn.
  double low = 0, high = 0;
  /// "m", "deg", "" …
  std::string unit;
};

struct SweepPlan {
  enum class Design { one_at_a_time, grid, random };
  Design design = Design::one_at_a_time;
  std::vector<SweptParam> params;
  /// Of `random`: how many draws.
  int samples = 0;
  PlanSpot spot;
};

/// What is taken out of the pack, each on its own.
struct AblatePlan {
  bool rules = false, conditions = false, evidence = false;
  PlanSpot spot;
};

/// How the run of the experiment's own rules and options is called, with which each part compares.
inline constexpr const char* kBaselineName = "as it is";

/// What is compared with the experiment's own rules and options.
struct ComparedPlan {
  std::string name;
  /// Of this pack, or else of the experiment's with its params, of which some have other values.
  RulesPlan rules;
  SegmentationPlan options;
  PlanSpot spot;
};

/// A disturbance of the buildings.
struct DisturbancePlan {
  enum class Kind { noise, triangulation, rotation, missing_faces, options };
  Kind kind = Kind::noise;
  /// "noise = 0.02 m", "plane_offset = 0.01 m", "triangulation".
  std::string name;
  /// "noise", "plane_offset" …, its value in `unit`: m, deg, %.
  std::string variable;
  double value = 0;
  std::string unit;
  /// Of `options`.
  SegmentationPlan options;
};

struct StabilityPlan {
  std::vector<DisturbancePlan> disturbances;
  /// How often what is random is drawn; each draw is a run.
  int times = 1;
  PlanSpot spot;
};

/// What is learnt, by `learn` and by `learning_curve`.
struct LearnPlan {
  /// Params that may change; empty: all that have a range.
  std::vector<std::string> params;
  /// "macro_f1", or a label, whose F1 counts.
  std::string objective = "macro_f1";
  /// How many buildings are learnt from, ascending; of `learning_curve`.
  std::vector<int> buildings;
  /// How often these are drawn; each draw is a run.
  int times = 1;
  PlanSpot spot;
};

/// An experiment as its file has it (docs/experiments.md is the language).
struct ExperimentPlan {
  /// The file, and the SHA-256 of its text.
  std::string file;
  std::string sha256;
  std::string name;
  std::string about;
  std::uint64_t seed = 1;
  /// Samples of the bootstrap over buildings.
  int bootstrap = 1000;
  std::vector<SetPlan> sets;
  RulesPlan rules;
  SegmentationPlan options;
  std::optional<SweepPlan> sweep;
  std::optional<AblatePlan> ablate;
  std::vector<ComparedPlan> compare;
  std::optional<StabilityPlan> stability;
  std::optional<LearnPlan> learning_curve;
  std::optional<LearnPlan> learn;
  /// Models of which the paper's tests are counted.
  std::vector<FilePattern> count_as_paper;
};

/// The most runs that a sweep may have.
inline constexpr std::size_t kMostRuns = 100'000;

/// The experiment in `text`, called `file` in places. All findings come at once, each with its
/// code, place and caret; with an error among them there is no value. Packs are loaded from files
/// relative to `file`; data sets are not read.
Checked<ExperimentPlan> load_experiment(std::string text, const std::string& file);

/// The same of a file; R200 if it cannot be read.
Checked<ExperimentPlan> load_experiment_file(const std::string& path);

/// A value as it stands in the name of a run: 0.6 m is "0.6 m"; read again it is the same number.
std::string value_text(double value, const std::string& unit);

/// The number with ten digits: 7 cm, in metres 0.07 and some last bits, becomes 0.07.
double rounded_for_name(double value);

}  // namespace oriel
