#include "experiments/sample_set.h"

#include "experiments/file_patterns.h"
#include "io/reader.h"
#include "io/records/feature_records.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

namespace fs = std::filesystem;
using IdsOfSet = std::set<std::string>;

void read_set_truth(const SetPlan& set, SetFiles& files, std::vector<Issue>& issues) {
  for (const HashedFile& file : files.truth)
    for (const std::string& id : add_truth(file.path, files.objects, issues))
      issues.push_back(set.spot.issue(
          Severity::error, Code::R289,
          fmt::format("the building '{}' has two truths in the set '{}'; the second is in {}", id,
                      set.name, file.path)));
}

void report_old_features(const SetPlan& set, const SetFiles& files, std::vector<Issue>& issues) {
  for (const HashedFile& features : files.features)
    for (const HashedFile& model : files.models) {
      const auto sentence = newer_model(features.path, model.path);
      if (!sentence) continue;
      issues.push_back(set.features.front().spot.issue(Severity::warning, Code::R286, *sentence));
      break;
    }
}

std::vector<std::string> without(const IdsOfSet& all, const IdsOfSet& others) {
  std::vector<std::string> rest;
  std::ranges::set_difference(all, others, std::back_inserter(rest));
  return rest;
}

/// The scored classes of the truth of some buildings.
IdsOfSet classes_in(const SetFiles& files, const std::vector<std::string>& buildings,
                    const std::vector<std::size_t>* part = nullptr) {
  const ScoreOptions options;
  IdsOfSet classes;
  const auto add_building = [&](const std::string& id) {
    for (const ExpectedObject& object : files.objects.at(id))
      if (!is_left_out(object) && !contains(options.not_scored, object.label))
        classes.insert(object.label);
  };
  if (part == nullptr)
    for (const std::string& id : buildings) add_building(id);
  else
    for (const std::size_t i : *part) add_building(buildings[i]);
  return classes;
}

/// What is wrong with a split of the buildings.
std::optional<std::string> fault_of(const SplitPlan& split,
                                    const std::vector<std::string>& buildings) {
  const auto count = static_cast<int>(buildings.size());
  if (split.kind == SplitPlan::Kind::folds && count < split.folds)
    return fmt::format("{} cannot be parted into {} folds", counted(buildings.size(), "building"),
                       split.folds);
  if (split.kind == SplitPlan::Kind::leave_one_out && count < 2)
    return "nothing is left to learn from: there is one building";
  if (split.kind != SplitPlan::Kind::held_out) return std::nullopt;
  for (const std::string& id : split.held_out)
    if (!contains(buildings, id))
      return fmt::format("the building '{}' that is held out is not in the set{}", id,
                         did_you_mean(id, buildings));
  if (IdsOfSet(split.held_out.begin(), split.held_out.end()).size() >= buildings.size())
    return "all buildings are held out: nothing is left to learn from";
  return std::nullopt;
}

/// A learning curve cannot learn from more buildings than a part leaves.
void check_curve(const SetPlan& set, const ExperimentPlan& plan, std::size_t buildings,
                 const std::vector<SamplePart>& parts, std::vector<Issue>& issues) {
  if (!plan.learning_curve || plan.learning_curve->buildings.empty()) return;
  std::size_t largest = 0;
  for (const auto& part : parts) largest = std::max(largest, part.size());
  const auto most = static_cast<std::size_t>(plan.learning_curve->buildings.back());
  if (buildings - largest >= most) return;
  issues.push_back(plan.learning_curve->spot.issue(
      Severity::error, Code::R282,
      fmt::format("{} cannot be learnt from: the split of the set '{}' leaves {}",
                  counted(most, "building"), set.name, buildings - largest)));
}

void check_split(const SetPlan& set, const ExperimentPlan& plan, const SetFiles& files,
                 const std::vector<std::string>& buildings, std::vector<Issue>& issues) {
  const bool is_learnt = plan.learn || plan.learning_curve;
  if (set.split.kind == SplitPlan::Kind::none) {
    if (is_learnt && !buildings.empty())
      issues.push_back(set.spot.issue(
          Severity::error, Code::R282,
          fmt::format("the set '{}' has no 'split': what is learnt is measured on other buildings",
                      set.name)));
    return;
  }
  if (const auto fault = fault_of(set.split, buildings)) {
    issues.push_back(set.split.spot.issue(Severity::error, Code::R282, *fault));
    return;
  }
  const auto parts = parts_of(set.split, buildings, plan.seed);
  check_curve(set, plan, buildings.size(), parts, issues);
  if (set.split.kind == SplitPlan::Kind::leave_one_out) return;
  const IdsOfSet all = classes_in(files, buildings);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (const auto lacking = without(all, classes_in(files, buildings, &parts[i]));
        !lacking.empty())
      issues.push_back(set.split.spot.issue(
          Severity::warning, Code::R285,
          fmt::format("fold {} of the set '{}' has no {}, which other folds have", i + 1, set.name,
                      join(lacking))));
}

void check_objectives(const SetPlan& set, const ExperimentPlan& plan, const SetFiles& files,
                      const std::vector<std::string>& buildings, std::vector<Issue>& issues) {
  const IdsOfSet all = classes_in(files, buildings);
  for (const auto* learn : {&plan.learn, &plan.learning_curve})
    if (*learn && (*learn)->objective != "macro_f1" && !all.contains((*learn)->objective))
      issues.push_back((*learn)->spot.issue(
          Severity::error, Code::R283,
          fmt::format("the truth of the set '{}' has no {}, whose F1 is the objective; it has {}",
                      set.name, (*learn)->objective, join({all.begin(), all.end()}))));
}

/// Errors and warnings about ids that only one side has.
void check_ids(const SetPlan& set, const SetFiles& files, const std::vector<std::string>& found,
               std::vector<Issue>& issues) {
  const auto [without_truth, without_features] = unpaired_buildings(found, files.objects);
  if (without_truth.size() == found.size()) {
    issues.push_back(set.spot.issue(
        Severity::error, Code::R284,
        fmt::format(
            "the truth of the set '{}' is of other buildings: it has {}, and the set has {}",
            set.name, files.objects.empty() ? "none" : some_of(without_features),
            found.empty() ? "none" : some_of(without_truth))));
    return;
  }
  if (!without_truth.empty())
    issues.push_back(set.spot.issue(
        Severity::warning, Code::R284,
        fmt::format("{} of the set '{}' {} left out: there is no truth of {}",
                    counted_of(without_truth.size(), found.size(), "building"), set.name,
                    agreeing_of(without_truth.size(), found.size(), "is", "are"),
                    some_of(without_truth))));
  if (without_features.empty()) return;
  issues.push_back(set.spot.issue(
      Severity::warning, Code::R284,
      files.models.empty()
          ? fmt::format("the set '{}' has no features of {}: all objects there count as missed",
                        set.name, some_of(without_features))
          : fmt::format("the set '{}' has no building {}: its truth is left out", set.name,
                        some_of(without_features))));
}

}  // namespace

std::vector<HashedFile> hashed_files(const std::vector<FilePattern>& patterns,
                                     const ExperimentPlan& plan, std::vector<Issue>& issues) {
  std::vector<HashedFile> files;
  for (const std::string& path : files_of(patterns, plan.file, issues))
    files.push_back({path, hash_of_file(path)});
  return files;
}

std::string SetFiles::text() const {
  std::string text;
  for (const auto* list : {&models, &features, &truth})
    for (const HashedFile& file : *list)
      text += fs::path(file.path).filename().string() + " " + file.sha256 + "\n";
  return text;
}

SetFiles find_set_files(const SetPlan& set, const ExperimentPlan& plan,
                        std::vector<Issue>& issues) {
  SetFiles files;
  files.models = hashed_files(set.models, plan, issues);
  files.features = hashed_files(set.features, plan, issues);
  files.truth = hashed_files(set.truth, plan, issues);
  read_set_truth(set, files, issues);
  report_old_features(set, files, issues);
  return files;
}

std::vector<std::string> ids_of_set(const SetFiles& files, const SegmentationPlan& options,
                                    std::vector<Issue>& issues) {
  std::vector<std::string> ids;
  if (!files.features.empty()) {
    for (const HashedFile& file : files.features) {
      std::string last;
      const auto found = visit_feature_records(file.path, [&](const FeatureRecord& record) {
        if (last != record.building) ids.push_back(record.building);
        last = record.building;
      });
      issues.insert(issues.end(), found.begin(), found.end());
    }
    return ids;
  }
  ReadOptions reading;
  reading.lod = options.lod;
  for (const HashedFile& file : files.models) {
    Reader reader(file.path, reading);
    while (const auto record = reader.next()) {
      std::ranges::copy_if(record->issues, std::back_inserter(issues),
                           [](const Issue& issue) { return issue.severity == Severity::error; });
      if (!record->value) continue;
      for (const Building& building : record->value->buildings) ids.push_back(building.id);
    }
  }
  return ids;
}

std::vector<std::string> measured_buildings(const SetPlan& set, const ExperimentPlan& plan,
                                            const SetFiles& files,
                                            const std::vector<std::string>& ids,
                                            std::vector<Issue>& issues) {
  IdsOfSet found;
  for (const std::string& id : ids)
    if (!found.insert(id).second)
      issues.push_back(set.spot.issue(
          Severity::error, Code::R289,
          fmt::format("the building '{}' occurs twice in the set '{}'", id, set.name)));
  check_ids(set, files, {found.begin(), found.end()}, issues);
  std::vector<std::string> buildings;
  for (const auto& [id, objects] : files.objects)
    if (found.contains(id) || files.models.empty()) buildings.push_back(id);
  if (has_errors(issues)) return buildings;
  check_objectives(set, plan, files, buildings, issues);
  check_split(set, plan, files, buildings, issues);
  return buildings;
}

std::vector<SamplePart> parts_of(const SplitPlan& split, const std::vector<std::string>& buildings,
                                 std::uint64_t seed) {
  switch (split.kind) {
    case SplitPlan::Kind::none:
      break;
    case SplitPlan::Kind::folds:
      return folds_of(buildings.size(), static_cast<std::size_t>(split.folds), seed);
    case SplitPlan::Kind::leave_one_out:
      return folds_of(buildings.size(), 0, seed);
    case SplitPlan::Kind::held_out: {
      SamplePart part = all_samples(buildings.size());
      std::erase_if(part, [&](std::size_t i) { return !contains(split.held_out, buildings[i]); });
      return {part};
    }
  }
  return {};
}

PipelineOptions pipeline_options(const SegmentationPlan& plan, bool ignores_semantics) {
  PipelineOptions options;
  options.ignores_semantics = ignores_semantics;
  options.fits_noise = !plan.plane_offset_m;
  if (plan.order) options.order = *plan.order == "paper" ? Order::paper : Order::natural;
  options.tolerances.coplanar_deg = plan.coplanar_deg.value_or(options.tolerances.coplanar_deg);
  options.tolerances.plane_offset_m =
      plan.plane_offset_m.value_or(options.tolerances.plane_offset_m);
  options.tolerances.weld_m = plan.weld_m.value_or(options.tolerances.weld_m);
  options.tolerances.value_rel = plan.value_rel.value_or(options.tolerances.value_rel);
  for (const Closing close : {Closing::none, Closing::planar, Closing::ground, Closing::any})
    if (plan.close == to_string(close)) options.repair.close = close;
  options.repair.cap_area_m2 = plan.close_area_m2.value_or(options.repair.cap_area_m2);
  if (plan.crossings)
    options.repair.crossings = *plan.crossings == "cut" ? Crossings::cut : Crossings::leave;
  options.budget = plan.budget.value_or(options.budget);
  options.lod = plan.lod.value_or("");
  return options;
}

}  // namespace oriel
