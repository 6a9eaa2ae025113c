#pragma once

#include "cli/terminal/exit_code.h"
#include "cli/terminal/report.h"
#include "interpret/pack/rule_base.h"
#include "interpret/score/label_diff.h"
#include "kernel/model/description/feature_graph.h"
#include "kernel/model/interpretation.h"

#include <string>
#include <vector>

namespace oriel::cli {

/// The features of buildings as files of records have them, in memory, to be interpreted as often
/// as the rules change.
class StoredFeatures {
 public:
  /// Reads the files; reports what is wrong with them. Throws InputError as read_feature_tables
  /// does.
  StoredFeatures(std::vector<std::string> files, Report& report);

  /// What reading them came to.
  [[nodiscard]] ExitCode code() const { return code_; }
  [[nodiscard]] std::size_t buildings() const { return buildings_.size(); }

  /// One for each building. Up to `jobs` are interpreted at the same time; what comes of it does
  /// not depend on that.
  [[nodiscard]] std::vector<Interpretation> interpret(const RuleBase& rules, int jobs) const;

  /// A table of how many features each label and rule has.
  [[nodiscard]] static std::string listing(const std::vector<Interpretation>& run);

  [[nodiscard]] LabelDiff compare(const std::vector<Interpretation>& before,
                                  const std::vector<Interpretation>& after,
                                  std::size_t most_examples) const;

  /// Writes the records as they were read with the verdicts of `run`.
  void write(const std::string& path, const std::vector<Interpretation>& run);

 private:
  std::vector<std::string> files_;
  Report& report_;
  ExitCode code_ = ExitCode::clean;
  std::vector<DescribedBuilding> buildings_;
};

}  // namespace oriel::cli
