#pragma once

#include "cli/terminal/exit_code.h"
#include "oriel/result.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel::cli {

/// Says what is wrong with a text that shall name a feature; nothing: it may.
std::string names_a_feature(const std::string& text);

/// A feature that a call names by its id, its name, or the beginning of one, in one of the
/// buildings of a run.
class FeatureChoice {
 public:
  /// `text` is what `option` was given.
  FeatureChoice(std::string text, std::string option)
      : text_(std::move(text)), option_(std::move(option)) {}

  /// Looks for it in a building that is_done(). Returns the first that may be meant, if one is.
  std::optional<FeatureId> look(const PipelineResult& line);
  /// Forgets the buildings before.
  void clear();
  /// Throws CLI::ValidationError where several may be meant, or none and the run, which ended with
  /// `code`, has not said why.
  void check(ExitCode code) const;

 private:
  /// A feature that was looked at, or that may be meant.
  struct Entry {
    std::string building, id, name;
  };
  [[nodiscard]] std::string some_of(const std::vector<Entry>& features) const;
  [[noreturn]] void refuse_unknown() const;

  std::string text_, option_;
  std::vector<Entry> all_, found_;
};

}  // namespace oriel::cli
