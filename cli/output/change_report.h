#pragma once

#include "cli/batch/outcome.h"
#include "cli/output/named_files.h"
#include "io/files/output_file.h"
#include "oriel/generalise.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace oriel::cli {

/// What --explain and --metrics of generalise write; each file appears when all inputs are done.
class ChangeReport {
 public:
  /// Empty names: not asked for. --explain writes JSON lines to a name that ends in .jsonl, else
  /// text.
  ChangeReport(std::string explain, std::string metrics)
      : explain_(std::move(explain)), metrics_(std::move(metrics)) {}

  [[nodiscard]] bool has_metrics() const { return !metrics_.empty(); }
  [[nodiscard]] bool has_any() const { return !explain_.empty() || !metrics_.empty(); }
  void name_files(NamedFiles& files) const;
  /// An input begins. What follows is kept unless it is a rehearsal.
  void begin(bool is_rehearsal);
  /// What is written of a building. Several threads may call them; empty if it is not asked for.
  [[nodiscard]] std::string text(const std::string& building, const std::string& target,
                                 const std::vector<FeatureOutcome>& outcomes) const;
  [[nodiscard]] std::string text(const std::string& building, const std::string& target,
                                 const TargetFigures& figures) const;
  void take(const Product& product);
  /// Adds its outputs and what is in them so far.
  void add_places(PartPlaces& places) const;
  void commit() const;

 private:
  std::string explain_, metrics_;
  std::unique_ptr<OutputFile> changes_file_, metrics_file_;
};

}  // namespace oriel::cli
