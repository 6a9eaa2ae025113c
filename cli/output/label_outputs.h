#pragma once

#include "cli/batch/outcome.h"
#include "cli/batch/rules_choice.h"
#include "cli/batch/run_options.h"
#include "cli/output/column_choice.h"
#include "cli/output/named_files.h"
#include "cli/output/output_sink.h"
#include "oriel/rules.h"
#include "oriel/write.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// Arguments of the commands that label buildings and write them.
struct LabellingArguments : RunOptions, RulesChoice {
  std::string out;
  std::string to;
  std::string features;
  /// Of the features: see chosen_columns(); empty: all.
  std::vector<std::string> columns;
  /// Cells of CSV are with_safe_cells().
  bool has_safe_cells = false;
  std::string codelist = "sig3d";
  /// Every surface and installation gets its reason, oriel_why.
  bool has_reasons = false;
  /// In CityGML installations are solids of their own.
  bool closes_installations = false;
  /// What the solids of an STL are called by.
  StlSolids stl_solids = StlSolids::by_label;

  /// A GeoPackage may be written, which has the attributes of features.
  [[nodiscard]] bool writes_attributes() const;
  /// With what is written, too.
  [[nodiscard]] LabelOptions label_options(StageObserver observer = {}) const;
};

/// What those commands write: the buildings (-o) and the records of features (--features), each if
/// asked for.
class LabelOutputs {
 public:
  /// Throws CLI::ValidationError if the arguments make no sense together.
  LabelOutputs(const LabellingArguments& arguments, const RuleBase& rules);

  [[nodiscard]] bool has_buildings() const { return sink_.has_value(); }
  [[nodiscard]] bool writes_stdout() const { return sink_ && sink_->is_stdout(); }
  [[nodiscard]] bool has_any() const { return has_buildings() || !arguments_.features.empty(); }

  /// OutputSink::is_cityjson().
  [[nodiscard]] bool writes_cityjson() const { return sink_ && sink_->is_cityjson(); }

  /// OutputSink::gathers_any().
  [[nodiscard]] bool gathers_any() const { return sink_ && sink_->gathers_any(); }

  /// Adds the outputs, and the rules as an input.
  void name_files(NamedFiles& files) const;

  /// What was added is written by the next flush: nothing waits for the end of the input.
  [[nodiscard]] bool is_streaming() const;

  /// A warning E151 if the table of features lacks columns that the rules read.
  [[nodiscard]] std::optional<Issue> lacking_columns() const;

  /// What was found in the files of buildings that are in their place (OutputSink::take_issues).
  [[nodiscard]] std::vector<Issue> take_issues();

  /// Which of these labels have no type in files of buildings (report_untyped);
  /// nothing where such files name no features.
  [[nodiscard]] std::vector<Issue> untyped(const std::map<std::string, int>& labels) const;

  /// What is to be written of a building that has surfaces; without features if it was rejected.
  [[nodiscard]] LabelledBuilding annotated(const Building& building,
                                           const PipelineResult& line) const;

  /// `is_rehearsal`: what follows is not to be kept.
  void begin(std::size_t input, bool is_rehearsal);
  /// All inputs were done by an earlier run; only `commit` is to come.
  void reopen();
  /// The outputs and what is in them so far.
  [[nodiscard]] PartPlaces places() const;
  /// What a product depends on besides source, configuration and rules; empty if products are no
  /// stretches of the outputs' bytes.
  [[nodiscard]] std::string recipe() const;
  /// A record on its way into the file of buildings; null without such a file. Several threads may
  /// call this and what follows.
  [[nodiscard]] std::shared_ptr<RecordText> record(std::size_t input, const Document& document,
                                                   WriteOptions options = {}) const;
  /// Adds to `product` what the features of a building become.
  void make_features(const Building& building, const PipelineResult& line, Product& product) const;
  /// Adds the attributes of a building's features to a record, where the outputs have them.
  void add_attributes(const Building& building, const PipelineResult& line,
                      OutputRecord& output) const;
  /// Puts a product into the outputs.
  void take(const Document& document, const Product& product);
  /// An input is done: its file is put in its place.
  void end();
  /// An input could be read to its end.
  [[nodiscard]] bool has_ended() const { return has_ended_; }
  /// All inputs are done. Records are written if one of them could be read.
  void commit();

 private:
  void open_features();

  const LabellingArguments& arguments_;
  const RuleBase& rules_;
  /// Of the arguments as they are when the outputs are made.
  LabelOptions options_;
  RecordColumns columns_;
  std::optional<OutputSink> sink_;
  std::unique_ptr<FeatureRecordWriter> features_;
  bool has_ended_ = false;  ///< an input did
};

}  // namespace oriel::cli
