#pragma once

#include "experiments/results/results.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// What a part came to on a set.
struct MeasuredPart {
  std::vector<ResultRow> rows;
  std::vector<ReportTable> tables;
  /// Of a comparison one, of other parts none.
  std::vector<ChangedBuildings> changed{};
  /// Sentences about runs that were left out.
  std::vector<std::string> left_out;
};

/// Keeps finished measurements in a folder, each under the hash of all that it depends on, so that
/// an experiment that was ended goes on with what is missing.
class MeasuredStore {
 public:
  /// Empty: nothing is kept.
  explicit MeasuredStore(std::string folder);

  /// What was kept under that text; nothing if there is none, or it is not whole.
  [[nodiscard]] std::optional<MeasuredPart> find(const std::string& key) const;
  /// Throws OutputError E601.
  void keep(const std::string& key, const MeasuredPart& part) const;

 private:
  [[nodiscard]] std::string path_of(const std::string& key) const;

  std::string folder_;
};

}  // namespace oriel
