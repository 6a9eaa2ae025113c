#pragma once

#include "generalise/city/city_groups.h"
#include "interpret/pack/rule_base.h"
#include "interpret/plan/profile.h"
#include "io/document.h"
#include "kernel/base/issue.h"
#include "model/scale_series.h"
#include "oriel/label.h"
#include "oriel/result.h"
#include "oriel/write.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// A building from fine to coarse, with what its levels are written with.
struct BuildingSeries {
  std::string building;
  Frame frame;
  /// The attributes that label() gives it.
  Members attributes;
  /// The ids of its installations before any operation.
  std::vector<std::string> installations;
  ScaleSeries series;
  /// No levels could be drawn of it: it stays as it was read until it becomes part of a block.
  bool is_as_read = false;
};

/// All buildings of a record from fine to coarse.
struct Series {
  std::vector<BuildingSeries> buildings;
  /// Ids of all buildings that levels could be drawn of; those that `buildings` lacks have an
  /// error, G410 or E901.
  std::vector<std::string> drawn;
  /// The grid on which all levels have their vertices: WriteOptions::finer_digits.
  int finer_digits = 0;
  /// An error says that a building was rejected: G404 it is open, G402, G410, E901.
  std::vector<Issue> issues;

  /// In the order in which they stand in the log: building by building, by ascending scale.
  [[nodiscard]] std::vector<SeriesOperation> operations() const;
};

struct SeriesOptions : LabelOptions {
  /// What to do with features that the pack has no entry for.
  std::optional<Profile> profile;
  /// Only the levels are asked for, so that one operation without a feature leads from each to the
  /// next, which is quicker.
  bool has_only_levels = false;
  /// With `neighbours` and a profile: rows and blocks at each of the scales, null where none are
  /// asked for; empty: at none (CityGroups).
  std::vector<std::shared_ptr<const CityGroups>> groups{};
};

/// The series of a record for `scales` (denominators, which ascend): every level a valid solid, the
/// building as it came too unless a warning G410 or G413 says that it is not, and the elementary
/// operations between them (docs/generalisation.md; Thiemann and Sester, paper section 5).
/// `results` are what label() said of the document's buildings, in their order, with the same rules
/// and options; those that are not is_done() are passed over. Joined installations are taken as
/// generalise() takes them.
///
/// A building that becomes part of a block (SeriesOptions::groups) has its own levels up to the
/// scale at which it does, whatever became of it in `results`; notes G421 and G423 and warnings
/// G422 and G440 say so.
///
/// Open buildings are repaired first (G420). A level never has what a finer one lost. First the
/// steps of a building that would not be valid are judged one by one, then it is drawn from a
/// repaired solid (G417); what helps neither is rejected (G410, or G413 if it was not valid when it
/// was read). Throws GeometryError for a fault of oriel's own.
Series series(const Document& document, const std::vector<PipelineResult>& results,
              const RuleBase& rules, const std::vector<double>& scales,
              const SeriesOptions& options = {});

/// The series of one building of a record, without groups: what series() has of it.
Series series(const Document& document, const Building& building, const PipelineResult& result,
              const RuleBase& rules, const std::vector<double>& scales,
              const SeriesOptions& options = {});

/// The record at 1 : scale, between 1 and the coarsest scale of the series. Throws GeometryError if
/// an operation does not fit the state before it.
OutputRecord at(const Series& series, double scale);

/// The same at several scales, which ascend.
std::vector<OutputRecord> levels(const Series& series, const std::vector<double>& scales);

/// A level made from the files of a series.
struct LevelFromFiles {
  /// False: the level and the log do not fit each other, or cannot be read, and `issues` says why.
  bool is_complete = false;
  /// The stored level from which it was made.
  double from_scale = 0;
  std::string from_file;
  std::vector<Issue> issues;
};

/// The levels and the log of the series NAME, as at() finds them. Throws InputError as at() does.
std::vector<std::string> files_of_series(const std::string& name);

/// What a check of a stored series found.
struct SeriesCheck {
  /// False: the levels and the log are not one series, and `issues` says where.
  bool holds = false;
  std::vector<double> scales;  ///< of the stored levels, ascending
  std::size_t buildings = 0;   ///< with operations
  std::size_t operations = 0;
  /// Also warnings: E133 a log without checks.
  std::vector<Issue> issues;
};

/// Proves a stored series: all checks of the log hold, each level that it names is there with the
/// hash that it names, there are no others, and of each building the operations lead from every
/// level to the next coarser one and back, facet by facet. Throws InputError as at() does, E132
/// also for a level that is gone.
SeriesCheck check_series(const std::string& name);

/// The level at 1 : scale of the series NAME, from its files NAME.1-N.city.json (of streams
/// .city.jsonl) and NAME.oplog.jsonl: the stored level that is nearest, with the operations between
/// carried out or undone. `sink` gets the text, record by record; if is_complete is false in the
/// end, what it got is not whole. Before that all checks of the log, and the level's hash in it,
/// are compared; a log without checks, of an older version, is a warning (E133). Throws InputError:
/// E101 there is no log or no level, G409 there are levels of two series, E119 the log is none,
/// E132 log or level is not what was written.
LevelFromFiles at(const std::string& name, double scale,
                  const std::function<void(std::string_view)>& sink);

}  // namespace oriel
