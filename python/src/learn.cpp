#include "oriel/learn.h"

#include "oriel/corrections.h"
#include "oriel/rules.h"
#include "python/src/handles.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace py = pybind11;

namespace oriel::python {

namespace {

/// Shares of work on so many threads; what the first of them throws is thrown.
ForEachShare shares_on_threads(int jobs) {
  if (jobs < 2) return for_each_in_turn;
  return [jobs](std::size_t count, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr thrown;
    std::mutex mutex;
    const auto take_shares = [&] {
      for (std::size_t i = next++; i < count; i = next++) try {
          work(i);
        } catch (...) {
          next = count;
          const std::lock_guard lock(mutex);
          if (!thrown) thrown = std::current_exception();
        }
    };
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < std::min(static_cast<std::size_t>(jobs), count); ++i)
      threads.emplace_back(take_shares);
    take_shares();
    threads.clear();
    if (thrown) std::rethrow_exception(thrown);
  };
}

/// What was learnt, with what it was learnt from: questions and proposals look at it again.
struct LearntFrom {
  RuleBase rules;
  std::vector<Sample> samples;
  std::vector<SamplePart> parts;
  LearnOptions options;
  int jobs = 1;
  Learnt learnt;
  std::vector<Issue> issues;
};

using LearntPtr = std::shared_ptr<LearntFrom>;

/// Features with the boxes that truth is compared with.
std::vector<Sample> samples_in(const FeatureSet& set) {
  std::vector<Sample> samples;
  for (std::size_t b = 0; b < set.buildings->size(); ++b) {
    Sample& sample = samples.emplace_back();
    sample.features = (*set.buildings)[b];
    for (const StoredRow& row : (*set.rows)[b]) sample.boxes.push_back(row.box);
  }
  return samples;
}

/// What people say, if a file of it is named; what is wrong with it is added to `issues`.
std::optional<Corrections> corrections_in(const std::string& file, const RuleBase& rules,
                                          std::vector<Issue>& issues) {
  if (file.empty()) return std::nullopt;
  auto read = read_corrections(file);
  issues = std::move(read.issues);
  for (Issue& issue : drop_unknown_classes(*read.value, rules.labels()))
    issues.push_back(std::move(issue));
  return Corrections(*read.value);
}

Objective objective_called(const std::string& word, const std::optional<Objective::Costs>& costs,
                           const RuleBase& rules) {
  if (costs) return Objective::least_cost(*costs);
  if (word == "macro_f1") return Objective::macro_f1();
  const std::vector<std::string> labels = rules.labels();
  if (std::ranges::find(labels, word) == labels.end())
    throw py::value_error(
        fmt::format("objective is '{}'; expected macro_f1, cost or a class of the pack ({})", word,
                    fmt::join(labels, ", ")));
  return Objective::f1_of(word);
}

Objective::Costs costs_in(const std::string& path) {
  auto costs = read_costs_file(path);
  if (!costs.value) throw InputError(costs.issues.front());
  return std::move(*costs.value);
}

using LearntOrIssues = std::pair<LearntPtr, std::vector<Issue>>;

/// Samples of the files `records`, or without any of `set`. Nothing was learnt: the issues say why.
LearntOrIssues learn_from(const std::vector<std::string>& records, const FeatureSet* set,
                          const TruthSet& truth, const RuleBase& rules,
                          const std::string& corrections_file, LearnOptions options,
                          std::size_t folds, int jobs) {
  std::vector<Issue> issues;
  const auto corrections = corrections_in(corrections_file, rules, issues);
  const Corrections* said = corrections ? &*corrections : nullptr;
  auto samples = set != nullptr ? join_samples(samples_in(*set), truth.buildings, said)
                                : read_samples(records, std::span(truth.buildings), rules, said);
  std::ranges::move(samples.issues, std::back_inserter(issues));
  if (!samples.value) return {nullptr, std::move(issues)};
  auto from = std::make_shared<LearntFrom>(
      LearntFrom{rules, std::move(*samples.value), {}, std::move(options), jobs, {}, {}});
  from->parts = folds_of(from->samples.size(), folds, from->options.seed);
  auto learnt =
      learn_params(rules, from->samples, from->parts, from->options, shares_on_threads(jobs));
  std::ranges::move(learnt.issues, std::back_inserter(issues));
  if (!learnt.value) return {nullptr, std::move(issues)};
  from->learnt = std::move(*learnt.value);
  from->issues = issues;
  return {std::move(from), std::move(issues)};
}

LearnOptions learn_options(const RuleBase& rules, const std::string& objective,
                           const std::optional<Objective::Costs>& costs, double penalty,
                           int restarts, std::uint64_t seed,
                           const std::vector<std::string>& params) {
  LearnOptions options;
  options.objective = objective_called(objective, costs, rules);
  options.penalty = penalty;
  options.restarts = restarts;
  options.seed = seed;
  options.params = params;
  return options;
}

/// What load_pack_file() takes for this pack, and what a pack that extends it calls it.
struct PackSource {
  std::string path, extended;
};

PackSource source_of(const RuleBase& rules) {
  const std::filesystem::path file(rules.file());
  const auto is_it = [&](const std::string& path) {
    const auto loaded = load_pack_file(path);
    return loaded.value && loaded.value->sha256() == rules.sha256();
  };
  const std::string stem = file.stem().string();
  if (embedded_pack(stem) && is_it(stem)) return {stem, stem};
  if (std::filesystem::exists(file) && is_it(file.string()))
    return {file.string(), file.filename().string()};
  throw py::value_error(
      fmt::format("the pack is not what is in '{}': a pack that extends it cannot be written; "
                  "pack.with_params(**learnt.values) is it",
                  rules.file()));
}

std::string yaml_of(const LearntFrom& from, const std::string& name) {
  return learnt_pack(from.learnt, from.rules, name, source_of(from.rules).extended);
}

std::vector<Proposal> proposals_of(const LearntFrom& from) {
  if (from.options.objective.has_costs())
    throw py::value_error("proposals look at F1, not at costs");
  ProposeOptions options;
  options.objective = from.options.objective;
  options.penalty = from.options.penalty;
  return propose(from.rules, from.samples, from.parts, options, shares_on_threads(from.jobs))
      .value();
}

std::string yaml_of_proposals(const LearntFrom& from, const std::vector<Proposal>& proposals) {
  const auto merged = merge_pack_file(source_of(from.rules).path);
  return to_yaml(proposals, merged.value.value_or(""));
}

std::pair<double, double> pair_of(const ConfidenceInterval& interval) {
  return {interval.low, interval.high};
}

std::map<std::string, double> values_of(const std::vector<ParamValue>& changes) {
  std::map<std::string, double> values;
  for (const ParamValue& change : changes) values[change.name] = change.value;
  return values;
}

void bind_parts_of_learnt(py::module_& module) {
  py::class_<LearntParam>(module, "LearntParam", "A param that was changed.")
      .def_property_readonly("name", [](const LearntParam& p) { return p.value.name; })
      .def_property_readonly("value", [](const LearntParam& p) { return p.value.value; })
      .def_readonly("before", &LearntParam::before, "In the pack.")
      .def_readonly("gain", &LearntParam::gain,
                    "By how much the objective on all buildings falls without this change.")
      .def_property_readonly(
          "interval", [](const LearntParam& p) { return pair_of(p.interval); },
          "(low, high): where 95 % of the bootstrap samples have that.")
      .def_readonly("folds", &LearntParam::folds, "The folds in which it was changed the same way.")
      .def("__repr__", [](const LearntParam& p) {
        return fmt::format("<oriel.LearntParam {}: {} -> {}>", p.value.name, p.before,
                           p.value.value);
      });
  py::class_<KnifeEdge>(module, "KnifeEdge",
                        "A param whose value stands so close to a flip of labels that a small "
                        "change moves the objective much.")
      .def_readonly("param", &KnifeEdge::param)
      .def_readonly("unit", &KnifeEdge::unit)
      .def_readonly("value", &KnifeEdge::value)
      .def_readonly("flip", &KnifeEdge::flip, "The nearest value at which the objective has moved.")
      .def_readonly("distance_share", &KnifeEdge::distance_share,
                    "How far that is, as a share of the param's range.")
      .def_readonly("change", &KnifeEdge::change,
                    "By how much the objective changes at most within a small change.")
      .def_readonly("objects", &KnifeEdge::objects, "The objects that are found or lost there.")
      .def("__repr__", [](const KnifeEdge& edge) {
        return fmt::format("<oriel.KnifeEdge {}: {:+.4f} at {:.4f} {}>", edge.param, edge.change,
                           edge.flip, edge.unit);
      });
  py::class_<OpenQuestion>(module, "Question",
                           "A feature of which a person's answer would help most.")
      .def_readonly("building", &OpenQuestion::building)
      .def_readonly("feature", &OpenQuestion::feature, "Its id.")
      .def_readonly("label", &OpenQuestion::label, "What the pack calls it, may be empty.")
      .def_readonly("runner_up", &OpenQuestion::runner_up)
      .def_readonly("margin", &OpenQuestion::margin, "How far ahead the label is, 0 to 1.")
      .def_readonly("by_fold", &OpenQuestion::by_fold, "How many of the folds call it what.")
      .def_readonly("disagreement", &OpenQuestion::disagreement,
                    "The share of the folds that do not agree with most of them, 0 to 1.")
      .def("__repr__", [](const OpenQuestion& question) {
        return fmt::format("<oriel.Question in '{}': is {} a {}?>", question.building,
                           question.feature, question.label);
      });
  py::class_<Proposal>(module, "Proposal",
                       "A change of one rule that pays; a person decides whether it is right.")
      .def_readonly("what", &Proposal::what, "\"drop 'height <= 3 m' of ledge.overhead\".")
      .def_readonly("rule", &Proposal::rule, "The id of the rule.")
      .def_readonly("require", &Proposal::require, "Its conditions after the change.")
      .def_readonly("unless", &Proposal::unless)
      .def_readonly("gain", &Proposal::gain,
                    "The objective on all buildings with it, less that without.")
      .def_readonly("held_out_gain", &Proposal::held_out_gain,
                    "The same on held-out folds that did not choose it.")
      .def_readonly("folds", &Proposal::folds, "The folds outside which it paid.")
      .def("__repr__", [](const Proposal& proposal) {
        return fmt::format("<oriel.Proposal {}: {:+.4f}>", proposal.what, proposal.held_out_gain);
      });
}

/// A property of what was learnt.
template <class Value>
auto part_of(Value Learnt::*part) {
  return [part](const LearntFrom& from) { return from.learnt.*part; };
}

void bind_learnt(py::module_& module) {
  py::class_<LearnOptions>(module, "LearnOptions").def(py::init(&learn_options));
  py::class_<LearntFrom, LearntPtr>(module, "Learnt",
                                    "What learn() found, and how well it does on buildings that it "
                                    "was not learnt from. str() is the text that the command "
                                    "prints.")
      .def_property_readonly("objective", part_of(&Learnt::objective))
      .def_property_readonly("buildings", part_of(&Learnt::samples), "How many it is learnt from.")
      .def_property_readonly("folds", part_of(&Learnt::folds))
      .def_property_readonly("params", part_of(&Learnt::params),
                             "The params that were changed, in the order of the pack; empty: the "
                             "pack stays as it is.")
      .def_property_readonly(
          "values",
          [](const LearntFrom& from) {
            std::map<std::string, double> values;
            for (const LearntParam& param : from.learnt.params)
              values[param.value.name] = param.value.value;
            return values;
          },
          "The same as a dict, for Pack.with_params(**values).")
      .def_property_readonly("reason", part_of(&Learnt::reason),
                             "Why the pack stays as it is, or empty.")
      .def_property_readonly("before", part_of(&Learnt::before),
                             "The objective on all buildings with the pack as it is.")
      .def_property_readonly("after", part_of(&Learnt::after), "The same with what was learnt.")
      .def_property_readonly("held_out_before", part_of(&Learnt::held_out_before),
                             "The objective on held-out folds with the pack as it is.")
      .def_property_readonly("held_out_after", part_of(&Learnt::held_out_after),
                             "The same, each fold with what was learnt without it.")
      .def_property_readonly(
          "held_out_gain",
          [](const LearntFrom& from) { return pair_of(from.learnt.held_out_gain); },
          "(low, high): where 95 % of the bootstrap samples have the difference.")
      .def_property_readonly("classes_before", part_of(&Learnt::held_out_classes_before),
                             "By label a ClassScore on held-out folds.")
      .def_property_readonly("classes_after", part_of(&Learnt::held_out_classes_after))
      .def_property_readonly(
          "learnt_without",
          [](const LearntFrom& from) {
            std::vector<std::map<std::string, double>> folds;
            for (const auto& changes : from.learnt.learnt_without)
              folds.push_back(values_of(changes));
            return folds;
          },
          "By fold the values that were learnt without it.")
      .def_property_readonly("knife_edges", part_of(&Learnt::knife_edges),
                             "Of the pack with what was learnt.")
      .def_readonly("issues", &LearntFrom::issues, "What was found on the way.")
      .def_property_readonly(
          "json", [](const LearntFrom& from) { return to_json(from.learnt, from.rules); },
          "All of it as JSON, as learn --json prints.")
      .def("yaml", &yaml_of, py::arg("name") = "learnt",
           "A pack of that name that extends the other and changes what was learnt, as learn -o "
           "writes.")
      .def(
          "questions",
          [](const LearntFrom& from, std::size_t count) {
            return open_questions(from.rules, from.samples, from.learnt, count);
          },
          py::arg("count") = 10, Unlocked(),
          "The features whose right label would tell most, as learn --ask lists them.")
      .def("proposals", &proposals_of, Unlocked(),
           "Changes of rules that would pay, for a person to judge, as learn --propose finds "
           "them.")
      .def("proposals_yaml", &yaml_of_proposals, py::arg("proposals"),
           "The rules of proposals, for a pack that extends the other.")
      .def("__str__", [](const LearntFrom& from) { return to_text(from.learnt, from.rules); })
      .def("__repr__", [](const LearntFrom& from) {
        return fmt::format(
            "<oriel.Learnt: {} params changed, {} {:.3f} -> {:.3f} on held-out folds>",
            from.learnt.params.size(), from.learnt.objective, from.learnt.held_out_before,
            from.learnt.held_out_after);
      });
}

}  // namespace

void bind_learning(py::module_& module) {
  bind_parts_of_learnt(module);
  bind_learnt(module);
  module.def("learn", &learn_from, Unlocked());
  module.def("read_costs", &costs_in, Unlocked());
}

}  // namespace oriel::python
