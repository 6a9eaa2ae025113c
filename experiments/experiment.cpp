#include "experiments/experiment.h"

#include "experiments/feature_store.h"
#include "experiments/file_patterns.h"
#include "experiments/part_runner.h"
#include "experiments/results/results.h"
#include "experiments/sample_set.h"
#include "interpret/params/with_params.h"
#include "io/reader.h"
#include "kernel/base/parallel.h"
#include "oriel/neighbours.h"
#include "oriel/options.h"
#include "oriel/paper_count.h"
#include "oriel/segment.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// A building, and what came of it.
struct CountedBuilding {
  Building building;
  std::optional<PaperCount> count;
  std::vector<Issue> issues;
};

void count_building(CountedBuilding& counted, const PipelineOptions& options) {
  PipelineResult result = segment(counted.building, options);
  counted.issues = std::move(result.issues);
  if (result.is_done() && !result.is_open())
    counted.count = count_as_paper(counted.building, result, options);
}

Issue why_not_counted(const CountedBuilding& counted) {
  const auto why = std::ranges::find(counted.issues, Severity::error, &Issue::severity);
  const Issue known = why == counted.issues.end() ? Issue() : *why;
  return building_issue(Severity::warning, known.code, counted.building.id,
                        "is no solid, so that nothing is counted" +
                            (known.sentence.empty() ? std::string() : ": " + known.sentence));
}

ReportTable table_of_counts(CountTable rows, std::string title, std::string caption) {
  ReportTable table{std::move(title), std::move(caption), std::move(rows.front()), {}};
  table.rows.assign(std::make_move_iterator(rows.begin() + 1), std::make_move_iterator(rows.end()));
  return table;
}

void add_tables(const CountedBuilding& counted, std::vector<ReportTable>& tables) {
  const std::string& id = counted.building.id;
  tables.push_back(table_of_counts(
      first_recursion(*counted.count), fmt::format("Combinations of planes of {}", id),
      fmt::format(
          "The body has {} planes. Combinations of 1, 2, 3 and 4 of them, and how many the "
          "first recursion tests: with the heuristics of Thiemann and Sester (2004), without "
          "each of them, and without all.",
          counted.count->planes)));
  tables.push_back(table_of_counts(all_recursions(*counted.count),
                                   fmt::format("All recursions of {}", id),
                                   "What the paper's algorithm tests and evaluates until nothing "
                                   "can be cut, and what oriel does."));
}

/// Two tables for each building of the files: what count_as_paper() counts in the first recursion,
/// and in all. A building that is no solid has none: its first error is added to `issues` as a
/// warning. Throws InputError for a file that cannot be read.
std::vector<ReportTable> paper_tables(const std::vector<HashedFile>& files,
                                      const PipelineOptions& options, const ForEachShare& for_each,
                                      std::vector<Issue>& issues) {
  std::vector<CountedBuilding> all;
  for (const HashedFile& file : files) {
    ReadOptions reading;
    if (!options.lod.empty()) reading.lod = options.lod;
    Reader reader(file.path, reading);
    while (auto record = reader.next()) {
      std::ranges::copy_if(record->issues, std::back_inserter(issues),
                           [](const Issue& issue) { return issue.severity == Severity::error; });
      if (!record->value) continue;
      for (Building& building : record->value->buildings)
        all.push_back({std::move(building), {}, {}});
    }
  }
  for_each(all.size(), [&](std::size_t i) { count_building(all[i], options); });
  std::vector<ReportTable> tables;
  for (const CountedBuilding& counted : all) {
    if (counted.count)
      add_tables(counted, tables);
    else
      issues.push_back(why_not_counted(counted));
  }
  return tables;
}

void add_issues(std::vector<Issue> more, std::vector<Issue>& issues) {
  issues.insert(issues.end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

/// Stored features are what they are: another way of segmenting needs the models.
void report_features_without_models(const ExperimentPlan& plan, std::vector<Issue>& issues) {
  const auto refuse = [&](const PlanSpot& spot, const SetPlan& set) {
    issues.push_back(spot.issue(
        Severity::error, Code::R288,
        fmt::format("this segments buildings again, and the set '{}' has stored features without "
                    "their models: add 'models'",
                    set.name)));
  };
  for (const SetPlan& set : plan.sets) {
    if (!set.features.empty() && !plan.options.is_empty())
      issues.push_back(set.features.front().spot.issue(
          Severity::error, Code::R288,
          fmt::format("the 'options' of the experiment cannot change the stored features of the "
                      "set '{}': take out one of both",
                      set.name)));
    if (!set.models.empty()) continue;
    for (const ComparedPlan& compared : plan.compare)
      if (!compared.options.is_empty()) refuse(compared.spot, set);
    if (plan.stability) refuse(plan.stability->spot, set);
  }
}

std::vector<HashedFile> with_hashes(const std::vector<std::string>& paths) {
  std::vector<HashedFile> files;
  for (const std::string& path : paths) files.push_back({path, hash_of_file(path)});
  return files;
}

/// An experiment at work. A file to look at that is not there is told before any folder is made.
class ExperimentAtWork {
 public:
  ExperimentAtWork(const ExperimentPlan& plan, const ExperimentOptions& options)
      : plan_(plan),
        options_(options),
        beside_(with_hashes(options.neighbours_of)),
        features_(options.cache.empty() ? "" : options.cache + "/features", options.program),
        measured_(options.cache.empty() ? "" : options.cache + "/measured") {}

  Checked<ExperimentResults> run() {
    Checked<ExperimentResults> results;
    report_features_without_models(plan_, results.issues);
    counted_ = hashed_files(plan_.count_as_paper, plan_, results.issues);
    const auto rules = set_rules(results.issues);
    if (!has_errors(results.issues)) read_sets(results.issues);
    if (has_errors(results.issues)) return results;
    results.value.emplace(header());
    for (const ExperimentPart part : parts_of(plan_))
      for (const SampleSet& set : sets_) add_part(part, set, *rules, results);
    count(results);
    return results;
  }

 private:
  /// Nothing where nothing is asked of rules, or with an error.
  std::optional<RuleBase> set_rules(std::vector<Issue>& issues) const {
    if (!plan_.rules.base) return std::nullopt;
    auto rules = with_params(*plan_.rules.base, plan_.rules.params);
    for (const Issue& issue : rules.issues)
      issues.push_back(plan_.rules.spot.issue(issue.severity, issue.code, issue.sentence));
    return std::move(rules.value);
  }

  void count(Checked<ExperimentResults>& results) {
    if (counted_.empty()) return;
    step("counts of the paper's tests", 0, counted_.size());
    auto tables = paper_tables(counted_, pipeline_options(plan_.options, true), options_.for_each,
                               results.issues);
    if (has_errors(results.issues))
      results.value.reset();
    else
      std::ranges::move(tables, std::back_inserter(results.value->tables));
  }

  void read_sets(std::vector<Issue>& issues) {
    for (const SetPlan& plan : plan_.sets) {
      SampleSet& set = sets_.emplace_back();
      set.plan = &plan;
      std::vector<Issue> found;
      set.files = find_set_files(plan, plan_, found);
      if (!has_errors(found)) read_set(set, found);
      add_issues(std::move(found), issues);
    }
  }

  void read_set(SampleSet& set, std::vector<Issue>& issues) {
    std::vector<std::string> ids;
    if (!set.files.features.empty()) {
      ids = ids_of_set(set.files, plan_.options, issues);
      if (!has_errors(issues))
        set.buildings = measured_buildings(*set.plan, plan_, set.files, ids, issues);
      if (!has_errors(issues)) set.samples = stored_samples_of(set, issues);
      return;
    }
    if (options_.looks_at_neighbours) look_around(set, issues);
    auto features = features_of(
        set, {pipeline_options(plan_.options, set.plan->ignores_semantics), std::nullopt});
    for (KeptFeatures& file : features) {
      add_issues(std::move(file.issues), issues);
      for (const Sample& building : file.buildings)
        ids.push_back(building.features.table.building());
    }
    if (!has_errors(issues))
      set.buildings = measured_buildings(*set.plan, plan_, set.files, ids, issues);
    if (!has_errors(issues))
      set.samples = samples_of(all_of(std::move(features)), set.files.objects, set.buildings);
  }

  /// What is wrong with the models is found where they are measured.
  void look_around(SampleSet& set, std::vector<Issue>& issues) const {
    ReadOptions options;
    if (plan_.options.lod) options.lod = *plan_.options.lod;
    auto search = std::make_shared<NeighbourSearch>();
    for (const HashedFile& file : set.files.models)
      add_buildings(file.path, options, *search, [](const std::vector<Issue>&) {});
    for (const HashedFile& file : beside_)
      add_buildings(file.path, options, *search, [&](const std::vector<Issue>& found) {
        add_issues(faults_beside(found), issues);
      });
    search->finish();
    add_issues(search->issues(), issues);
    set.neighbours = std::move(search);
  }

  [[nodiscard]] std::vector<Sample> stored_samples_of(const SampleSet& set,
                                                      std::vector<Issue>& issues) const {
    std::vector<Sample> stored;
    for (const HashedFile& file : set.files.features)
      std::ranges::move(read_stored_samples(file.path, &*plan_.rules.base, issues),
                        std::back_inserter(stored));
    return samples_of(std::move(stored), set.files.objects, set.buildings);
  }

  static std::vector<Sample> all_of(std::vector<KeptFeatures> files) {
    std::vector<Sample> all;
    for (KeptFeatures& file : files) std::ranges::move(file.buildings, std::back_inserter(all));
    return all;
  }

  std::vector<KeptFeatures> features_of(const SampleSet& set, FeatureRecipe recipe) {
    recipe.neighbours = set.neighbours;
    return features_.features_of(
        set.files.models, recipe, options_.for_each, [&](std::size_t done) {
          step("features of " + set.plan->name, done, set.files.models.size());
        });
  }

  void add_part(ExperimentPart part, const SampleSet& set, const RuleBase& rules,
                Checked<ExperimentResults>& results) {
    const std::string key = key_of(part, set, rules);
    auto measured = options_.resumes ? measured_.find(key) : std::nullopt;
    if (!measured) {
      measured = run_part(part, set, context_of(part, set, rules));
      measured_.keep(key, *measured);
    }
    for (const std::string& sentence : measured->left_out)
      results.issues.push_back(spot_of(part).issue(Severity::warning, Code::R281, sentence));
    auto& value = *results.value;
    value.rows.insert(value.rows.end(), measured->rows.begin(), measured->rows.end());
    value.tables.insert(value.tables.end(), measured->tables.begin(), measured->tables.end());
    value.changed.insert(value.changed.end(), measured->changed.begin(), measured->changed.end());
  }

  [[nodiscard]] const PlanSpot& spot_of(ExperimentPart part) const {
    if (part == ExperimentPart::sweep) return plan_.sweep->spot;
    if (part == ExperimentPart::compare) return plan_.compare.front().spot;
    return plan_.rules.spot;
  }

  PartContext context_of(ExperimentPart part, const SampleSet& set, const RuleBase& rules) {
    return {plan_, rules, options_.for_each,
            [this](const SampleSet& of, const FeatureRecipe& recipe) {
              return samples_of(all_of(features_of(of, recipe)), of.files.objects, of.buildings);
            },
            [this, part, &set](std::size_t done, std::size_t all) {
              step(fmt::format("{} on {}", to_string(part), set.plan->name), done, all);
            }};
  }

  /// All that a part on a set depends on.
  [[nodiscard]] std::string key_of(ExperimentPart part, const SampleSet& set,
                                   const RuleBase& rules) const {
    std::string key =
        fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", options_.program, plan_.sha256, to_string(part),
                    set.plan->name, rules.sha256(), set.files.text());
    for (const ComparedPlan& compared : plan_.compare) key += compared.rules.base->sha256() + "\n";
    if (set.neighbours) key += set.neighbours->sha256();
    return key;
  }

  [[nodiscard]] ExperimentResults header() const {
    ExperimentResults results;
    results.name = plan_.name;
    results.about = plan_.about;
    results.program = options_.program;
    results.inputs.push_back(
        {"experiment", std::filesystem::path(plan_.file).filename().string(), plan_.sha256});
    for (const SampleSet& set : sets_) {
      add_inputs("models", set.files.models, results);
      add_inputs("features", set.files.features, results);
      add_inputs("truth", set.files.truth, results);
    }
    add_inputs("models", counted_, results);
    add_inputs("neighbours", beside_, results);
    if (plan_.rules.base)
      results.inputs.push_back({"pack", plan_.rules.pack, plan_.rules.base->sha256()});
    for (const ComparedPlan& compared : plan_.compare)
      if (std::ranges::find(results.inputs, compared.rules.pack, &ExperimentInput::path) ==
          results.inputs.end())
        results.inputs.push_back({"pack", compared.rules.pack, compared.rules.base->sha256()});
    results.options = {{"seed", fmt::format("{}", plan_.seed)},
                       {"bootstrap", fmt::format("{}", plan_.bootstrap)}};
    for (const SetPlan& set : plan_.sets)
      if (!set.models.empty())
        results.options.emplace_back(
            "segmentation of " + set.name,
            configuration(pipeline_options(plan_.options, set.ignores_semantics)));
    for (const SampleSet& set : sets_)
      if (set.neighbours)
        results.options.emplace_back("neighbours of " + set.plan->name, set.neighbours->sha256());
    for (const ParamValue& param : plan_.rules.params)
      results.options.emplace_back(param.name, fmt::format("{}", param.value));
    return results;
  }

  void add_inputs(const std::string& kind, const std::vector<HashedFile>& files,
                  ExperimentResults& results) const {
    for (const HashedFile& file : files)
      results.inputs.push_back({kind, path_in_plan(file.path, plan_.file), file.sha256});
  }

  void step(const std::string& what, std::size_t done, std::size_t all) const {
    if (options_.observer) options_.observer({what, done, all});
  }

  const ExperimentPlan& plan_;
  const ExperimentOptions& options_;
  /// Whose buildings are only looked at.
  std::vector<HashedFile> beside_;
  FeatureStore features_;
  MeasuredStore measured_;
  std::vector<SampleSet> sets_;
  /// Of which the paper's tests are counted.
  std::vector<HashedFile> counted_;
};

}  // namespace

std::vector<Issue> check_experiment(const ExperimentPlan& plan) {
  std::vector<Issue> issues;
  report_features_without_models(plan, issues);
  files_of(plan.count_as_paper, plan.file, issues);
  for (const SetPlan& set : plan.sets) {
    std::vector<Issue> found;
    const SetFiles files = find_set_files(set, plan, found);
    if (!has_errors(found)) {
      const auto ids = ids_of_set(files, plan.options, found);
      if (!has_errors(found)) measured_buildings(set, plan, files, ids, found);
    }
    add_issues(std::move(found), issues);
  }
  return issues;
}

Checked<ExperimentResults> run_experiment(const ExperimentPlan& plan,
                                          const ExperimentOptions& options) {
  return ExperimentAtWork(plan, options).run();
}

std::vector<std::string> files_of_experiment(const ExperimentPlan& plan) {
  std::vector<Issue> ignored;
  std::vector<std::string> files{plan.file};
  for (const SetPlan& set : plan.sets)
    for (const auto* patterns : {&set.models, &set.features, &set.truth})
      std::ranges::move(files_of(*patterns, plan.file, ignored), std::back_inserter(files));
  std::ranges::move(files_of(plan.count_as_paper, plan.file, ignored), std::back_inserter(files));
  return files;
}

}  // namespace oriel
