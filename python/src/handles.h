#pragma once

#include "oriel/generalise.h"
#include "oriel/interpret.h"
#include "oriel/label.h"
#include "oriel/read.h"
#include "oriel/score.h"
#include "oriel/write.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

/// What Python holds: values of the front door, shared and never changed, so that threads may use
/// them while C++ works without the interpreter's lock.
namespace oriel::python {

/// Of functions that need no Python while they work.
using Unlocked = pybind11::call_guard<pybind11::gil_scoped_release>;

/// A file as it was read.
struct ReadFile {
  std::string path;
  /// ReadOptions::lod.
  std::string lod;
  std::vector<Document> records;
  std::vector<Issue> issues;
};

/// A building of a file.
class ReadBuilding {
 public:
  ReadBuilding(std::shared_ptr<const ReadFile> file, std::size_t record, std::size_t place)
      : file_(std::move(file)), record_(record), place_(place) {}

  [[nodiscard]] const std::shared_ptr<const ReadFile>& file() const { return file_; }
  /// An index into ReadFile::records.
  [[nodiscard]] std::size_t record() const { return record_; }
  [[nodiscard]] const Document& document() const { return file_->records[record_]; }
  [[nodiscard]] const Building& building() const { return document().buildings[place_]; }

 private:
  std::shared_ptr<const ReadFile> file_;
  std::size_t record_ = 0;
  std::size_t place_ = 0;
};

/// How buildings are worked on: what the command's options say.
struct StageOptions : GeneraliseOptions {
  /// `label --repaired`.
  bool is_on_solid = false;
};

/// What was made of a building and can be written.
class MadeItem {
 public:
  explicit MadeItem(ReadBuilding of) : of_(std::move(of)) {}
  virtual ~MadeItem() = default;
  MadeItem(const MadeItem&) = delete;
  MadeItem& operator=(const MadeItem&) = delete;

  [[nodiscard]] const ReadBuilding& of() const { return of_; }
  [[nodiscard]] virtual const std::vector<Issue>& issues() const = 0;
  /// Adds it to what is written of its record, and what is found then.
  virtual void add_to(OutputRecord& output, std::vector<Issue>& issues) const = 0;
  /// What was labelled, of which a GeoPackage has all attributes; null: nothing.
  [[nodiscard]] virtual const PipelineResult* labelled() const { return nullptr; }
  /// The pack by whose labels its parts are called in the output, if there is one; adds how many
  /// features have each.
  virtual const RuleBase* count(std::map<std::string, int>& /*labels*/) const { return nullptr; }
  [[nodiscard]] virtual StlSolids solids() const { return StlSolids::by_label; }

 private:
  ReadBuilding of_;
};

/// What segment() or label() said of a building.
class StageResult final : public MadeItem {
 public:
  /// `alone` is the building without joined installations, if that was labelled.
  StageResult(ReadBuilding of, std::optional<Building> alone, std::optional<RuleBase> rules,
              StageOptions options, PipelineResult result)
      : MadeItem(std::move(of)),
        alone_(std::move(alone)),
        rules_(std::move(rules)),
        options_(std::move(options)),
        result_(std::move(result)) {}

  [[nodiscard]] const Building& building() const { return alone_ ? *alone_ : of().building(); }
  [[nodiscard]] const PipelineResult& result() const { return result_; }
  /// None: it was segmented only.
  [[nodiscard]] const std::optional<RuleBase>& rules() const { return rules_; }
  [[nodiscard]] const StageOptions& options() const { return options_; }

  [[nodiscard]] const std::vector<Issue>& issues() const override { return result_.issues; }
  void add_to(OutputRecord& output, std::vector<Issue>& issues) const override;
  [[nodiscard]] const PipelineResult* labelled() const override {
    return rules_ ? &result_ : nullptr;
  }
  const RuleBase* count(std::map<std::string, int>& labels) const override;

 private:
  std::optional<Building> alone_;
  std::optional<RuleBase> rules_;
  StageOptions options_;
  PipelineResult result_;
};

/// What is known of a stored feature besides attributes and relations.
struct StoredRow {
  Box box;
  std::string parent, host;
  std::vector<int> source_polygons;
  std::string corrected_by, corrected_why;
};

/// Features of buildings, with labels or without, apart from their geometry.
struct FeatureSet {
  std::shared_ptr<const std::vector<DescribedBuilding>> buildings;
  /// By building and row.
  std::shared_ptr<const std::vector<std::vector<StoredRow>>> rows;
  /// By building; without verdicts where nothing was labelled.
  std::vector<Interpretation> labels;
  std::vector<Issue> issues;

  [[nodiscard]] std::size_t feature_count() const;
};

/// What is known to be there, of many buildings.
struct TruthSet {
  std::vector<GroundTruth> buildings;
  std::vector<Issue> issues;
};

/// The records of a building of the set, as the command writes them; with attributes and relations,
/// or only with what scoring needs.
std::vector<FeatureRecord> records_of(const FeatureSet& set, std::size_t building, bool is_whole);

void bind_issues(pybind11::module_& module);
void bind_buildings(pybind11::module_& module);
void bind_stages(pybind11::module_& module);
void bind_features(pybind11::module_& module);
void bind_score(pybind11::module_& module);
void bind_learning(pybind11::module_& module);

}  // namespace oriel::python
