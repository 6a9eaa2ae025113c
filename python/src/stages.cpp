#include "oriel/explain.h"
#include "oriel/generalise.h"
#include "oriel/label.h"
#include "oriel/neighbours.h"
#include "oriel/repair.h"
#include "oriel/rules.h"
#include "oriel/segment.h"
#include "oriel/write.h"
#include "python/src/handles.h"

#include <algorithm>
#include <cmath>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

namespace py = pybind11;

namespace oriel::python {

namespace {

using PackOrIssues = std::pair<std::optional<RuleBase>, std::vector<Issue>>;

/// What repair() made of a building.
class RepairedBuilding final : public MadeItem {
 public:
  RepairedBuilding(ReadBuilding of, Repaired repaired)
      : MadeItem(std::move(of)), repaired_(std::move(repaired)) {}

  [[nodiscard]] const Repaired& repaired() const { return repaired_; }
  [[nodiscard]] const std::vector<Issue>& issues() const override { return repaired_.issues; }
  void add_to(OutputRecord& output, std::vector<Issue>& /*issues*/) const override {
    if (repaired_.solid) output.buildings.push_back(repaired_.output);
  }

 private:
  Repaired repaired_;
};

/// What generalise() made of a building.
class RedrawnBuilding final : public MadeItem {
 public:
  RedrawnBuilding(std::shared_ptr<const StageResult> labelled, StlSolids solids,
                  GeneralisedBuilding drawn)
      : MadeItem(labelled->of()),
        labelled_(std::move(labelled)),
        solids_(solids),
        drawn_(std::move(drawn)) {}

  [[nodiscard]] const GeneralisedBuilding& drawn() const { return drawn_; }
  [[nodiscard]] const std::vector<Issue>& issues() const override { return drawn_.issues; }
  [[nodiscard]] StlSolids solids() const override { return solids_; }
  [[nodiscard]] bool is_drawn() const {
    if (drawn_.leads_group || drawn_.is_gone) return drawn_.leads_group;
    return labelled_->result().is_done() && (!labelled_->result().is_open() || drawn_.repaired);
  }
  void add_to(OutputRecord& output, std::vector<Issue>& /*issues*/) const override {
    if (is_drawn() || drawn_.is_gone) add(drawn_, output);
  }
  [[nodiscard]] const PipelineResult* labelled() const override {
    return drawn_.repaired ? &*drawn_.repaired : &labelled_->result();
  }
  const RuleBase* count(std::map<std::string, int>& labels) const override {
    if (!drawn_.levels.empty() && is_drawn() && !drawn_.leads_group) {
      const PipelineResult& from = drawn_.repaired ? *drawn_.repaired : labelled_->result();
      for (const auto& [label, number] : count_labels(from.interpretation)) labels[label] += number;
      for (const auto& [label, number] : drawn_.levels[0].removed) labels[label] -= number;
    }
    return &*labelled_->rules();
  }

 private:
  std::shared_ptr<const StageResult> labelled_;
  StlSolids solids_;
  GeneralisedBuilding drawn_;
};

void check_range(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw py::value_error(
        fmt::format("{} is {}; it must be between {} and {}", name, value, low, high));
}

/// The value that goes with a word.
template <class Value>
Value meant_by(const char* name, const std::string& word,
               const std::vector<std::pair<std::string, Value>>& words) {
  std::string all;
  for (const auto& [known, value] : words) {
    if (known == word) return value;
    all += (all.empty() ? "" : ", ") + known;
  }
  throw py::value_error(fmt::format("{} is '{}'; expected one of {}", name, word, all));
}

/// The options of the command; ranges are those of its arguments.
StageOptions options_of(const std::string& order, double coplanar_deg,
                        std::optional<double> plane_offset, double weld, double value_rel,
                        const std::string& close, double close_area, const std::string& crossings,
                        std::int64_t budget, bool ignore_semantics, const std::string& codelist,
                        bool explain, bool repaired) {
  StageOptions options;
  check_range("coplanar_deg", coplanar_deg, 0, 30);
  check_range("plane_offset", plane_offset.value_or(0), 0, 1);
  check_range("weld", weld, 1e-6, 1);
  check_range("value_rel", value_rel, 0, 0.5);
  check_range("close_area", close_area, 0, HUGE_VAL);
  if (budget < 1) throw py::value_error(fmt::format("budget is {}; it must be at least 1", budget));
  options.tolerances.coplanar_deg = coplanar_deg;
  if (plane_offset) options.tolerances.plane_offset_m = *plane_offset;
  options.tolerances.weld_m = weld;
  options.tolerances.value_rel = value_rel;
  options.fits_noise = !plane_offset;
  options.repair.close = meant_by<Closing>("close", close,
                                           {{"none", Closing::none},
                                            {"planar", Closing::planar},
                                            {"ground", Closing::ground},
                                            {"any", Closing::any}});
  options.repair.cap_area_m2 = close_area;
  options.repair.crossings = meant_by<Crossings>(
      "crossings", crossings, {{"leave", Crossings::leave}, {"cut", Crossings::cut}});
  if (repaired) options.repair.crossings = Crossings::cut;
  options.order =
      meant_by<Order>("order", order, {{"natural", Order::natural}, {"paper", Order::paper}});
  options.budget = budget;
  options.ignores_semantics = ignore_semantics;
  options.codelist = codelist;
  options.has_reasons = explain;
  options.is_on_solid = repaired;
  options.has_output = false;
  return options;
}

StageOptions for_building(StageOptions options, const ReadBuilding& building) {
  options.lod = building.file()->lod;
  return options;
}

std::shared_ptr<StageResult> segment_building(const ReadBuilding& of, const StageOptions& asked) {
  const StageOptions options = for_building(asked, of);
  return std::make_shared<StageResult>(of, std::nullopt, std::nullopt, options,
                                       segment(of.building(), options));
}

void check_codelist(const RuleBase& rules, const std::string& codelist) {
  const auto known = rules.codelists();
  if (!known.empty() && std::ranges::find(known, codelist) == known.end())
    throw py::value_error(fmt::format("codelist is '{}'; the pack has codes for {}", codelist,
                                      fmt::join(known, ", ")));
}

/// All buildings of the files that are worked on, and of others; nothing that is wrong with the
/// former is told, of the others what cost buildings.
std::pair<std::shared_ptr<NeighbourSearch>, std::vector<Issue>> neighbours_in(
    const std::vector<std::shared_ptr<ReadFile>>& files,
    const std::vector<std::shared_ptr<ReadFile>>& others) {
  auto search = std::make_shared<NeighbourSearch>();
  std::vector<Issue> issues;
  for (const auto* several : {&files, &others})
    for (const auto& file : *several)
      for (const Document& record : file->records)
        for (const Building& building : record.buildings) search->add(building);
  for (const auto& file : others)
    for (Issue& issue : faults_beside(file->issues)) issues.push_back(std::move(issue));
  search->finish();
  issues.insert(issues.end(), search->issues().begin(), search->issues().end());
  return {std::move(search), std::move(issues)};
}

std::shared_ptr<StageResult> label_building(const ReadBuilding& of, const RuleBase& rules,
                                            const StageOptions& asked,
                                            const std::shared_ptr<NeighbourSearch>& neighbours) {
  check_codelist(rules, asked.codelist);
  StageOptions options = for_building(asked, of);
  options.neighbours = neighbours;
  options.measures_surfaces = false;
  std::optional<Building> alone;
  if (options.is_on_solid) alone = without_installations(of.building());
  PipelineResult result = label(alone ? *alone : of.building(), rules, options);
  return std::make_shared<StageResult>(of, std::move(alone), rules, options, std::move(result));
}

std::shared_ptr<RepairedBuilding> repair_building(const ReadBuilding& of,
                                                  const StageOptions& asked) {
  StageOptions options = for_building(asked, of);
  options.repair.keeps_caps_apart = true;
  return std::make_shared<RepairedBuilding>(of, repair(of.document(), of.building(), options));
}

[[noreturn]] void refuse_target(Code code, const std::string& sentence) {
  Issue issue;
  issue.code = code;
  issue.sentence = sentence;
  throw InputError(std::move(issue));
}

/// What is asked for, with what the profiles have to say; the profiles are NAME[:LEVEL] or files.
std::pair<Targets, std::vector<Issue>> targets_of(std::optional<double> scale,
                                                  const std::vector<std::string>& profiles,
                                                  std::optional<double> edge_min,
                                                  const RuleBase& rules, bool has_neighbours) {
  Targets targets;
  std::vector<Issue> issues;
  if (scale && !(*scale >= 1 && std::isfinite(*scale)))
    refuse_target(Code::E125, fmt::format("'1:{}' is not a scale: N of 1:N is at least 1", *scale));
  if (edge_min) check_range("edge_min", *edge_min, 0.001, 10);
  targets.scale = scale;
  for (const std::string& name : profiles) {
    auto loaded = load_profile_file(name);
    if (!loaded.value) throw InputError(loaded.issues.front());
    issues.insert(issues.end(), loaded.issues.begin(), loaded.issues.end());
    const ProfileUse use = scale ? ProfileUse::scale : ProfileUse::level;
    for (Issue& issue : check_profile(*loaded.value, rules, use, has_neighbours))
      issues.push_back(std::move(issue));
    if (edge_min) loaded.value = with_edge_min(std::move(*loaded.value), *edge_min);
    targets.profiles.push_back(std::move(*loaded.value));
  }
  return {std::move(targets), std::move(issues)};
}

/// Rows and blocks, and the search that they are of.
struct GroupsOfSearch {
  std::shared_ptr<const NeighbourSearch> search;
  CityGroups groups;
};

/// Those that the profile asks for at the scale, for what was labelled with neighbours; else null.
std::shared_ptr<GroupsOfSearch> groups_of(const StageResult& labelled, const Targets& targets) {
  const auto& search = labelled.options().neighbours;
  if (!search || !targets.scale || targets.profiles.empty() ||
      !asks_for_groups(targets.profiles[0], *targets.scale))
    return nullptr;
  return std::make_shared<GroupsOfSearch>(
      GroupsOfSearch{search, CityGroups(*search, targets.profiles[0], *targets.scale)});
}

std::shared_ptr<RedrawnBuilding> redraw_building(const std::shared_ptr<const StageResult>& labelled,
                                                 const Targets& targets,
                                                 const std::shared_ptr<GroupsOfSearch>& groups) {
  if (!labelled->rules())
    throw py::value_error("the building was segmented only; generalise() takes what label() gives");
  if (labelled->options().is_on_solid)
    throw py::value_error("labels are on a repaired solid; label without repaired=True");
  StageOptions options = labelled->options();
  if (groups && groups->search == options.neighbours)
    options.groups = std::shared_ptr<const CityGroups>(groups, &groups->groups);
  auto drawn = generalise(labelled->of().document(), labelled->of().building(), labelled->result(),
                          *labelled->rules(), targets, options);
  const bool is_by_class = std::ranges::any_of(targets.profiles, &Profile::names_classes);
  return std::make_shared<RedrawnBuilding>(
      labelled, is_by_class ? StlSolids::by_class : StlSolids::by_label, std::move(drawn));
}

const RuleBase& rules_of(const StageResult& result) {
  if (result.rules()) return *result.rules();
  throw py::value_error("the building was segmented only; explain() takes what label() gives");
}

/// The feature that `text` means.
FeatureId feature_meant(const StageResult& labelled, const std::string& text) {
  const auto found = find_features(labelled.result(), text);
  if (found.size() == 1) return found[0];
  const std::vector<std::string> names = names_of_features(labelled.result());
  std::string which;
  for (std::size_t i = 0; i < std::min<std::size_t>(5, found.size()); ++i)
    which += fmt::format("{}'{}'", which.empty() ? "" : ", ", names[found[i].index()]);
  if (found.empty())
    for (const std::string& name : nearest_names(names, text, 3))
      which += fmt::format("{}'{}'", which.empty() ? "" : ", ", name);
  throw py::key_error(found.empty() ? fmt::format("no feature starts with '{}'; there are {}", text,
                                                  which.empty() ? "none" : which)
                                    : fmt::format("{} features start with '{}': {} ...",
                                                  found.size(), text, which));
}

Explanation explain_feature(const StageResult& labelled, const std::string& text) {
  const RuleBase& rules = rules_of(labelled);
  return explain(labelled.result(), rules, feature_meant(labelled, text));
}

std::vector<Explanation> explain_all(const StageResult& labelled) {
  const RuleBase& rules = rules_of(labelled);
  return labelled.result().is_done() ? explain_features(labelled.result(), rules)
                                     : std::vector<Explanation>{};
}

using Params = std::vector<std::pair<std::string, double>>;

/// Params at other values: numbers in the units of the pack, then texts, "parapet=0.8 m".
PackOrIssues changed_pack(const RuleBase& base, const Params& numbers,
                          const std::vector<std::string>& texts) {
  std::vector<ParamValue> values;
  for (const auto& [name, value] : numbers) values.push_back({name, value});
  auto changed = with_params(base, values);
  if (changed.value && !texts.empty()) changed = with_params(*changed.value, texts);
  return {std::move(changed.value), std::move(changed.issues)};
}

py::list param_rows(const RuleBase& base) {
  py::list rows;
  for (const PackParam& param : params_of(base))
    rows.append(py::make_tuple(param.name, param.value, param.unit, param.range, param.why));
  return rows;
}

void bind_packs(py::module_& module) {
  py::class_<RuleBase>(module, "RuleBase", "A rule pack that was checked and is ready to be run.")
      .def_property_readonly("name", &RuleBase::name)
      .def_property_readonly("version", &RuleBase::version)
      .def_property_readonly("file", &RuleBase::file)
      .def_property_readonly("files", &RuleBase::files)
      .def_property_readonly("sha256", &RuleBase::sha256)
      .def_property_readonly("labels", &RuleBase::labels)
      .def_property_readonly("rule_count", &RuleBase::rule_count)
      .def_property_readonly("codelists", &RuleBase::codelists);
  module.def(
      "load_pack_file",
      [](const std::string& path) {
        auto loaded = load_pack_file(path);
        return PackOrIssues(std::move(loaded.value), std::move(loaded.issues));
      },
      Unlocked());
  module.def(
      "load_pack",
      [](std::string text, std::string file) {
        auto loaded = load_pack(std::move(text), std::move(file));
        return PackOrIssues(std::move(loaded.value), std::move(loaded.issues));
      },
      Unlocked());
  module.def("with_params", &changed_pack, Unlocked());
  module.def("param_rows", &param_rows);
  module.def("embedded_packs", &embedded_packs);
}

void bind_explanations(py::module_& module) {
  py::class_<Explanation>(module, "Explanation",
                          "Why a feature has its label, or none. str() is the summary that the "
                          "command prints.")
      .def_readonly("building", &Explanation::building)
      .def_readonly("feature", &Explanation::feature, "The feature's id.")
      .def_readonly("name", &Explanation::name)
      .def_property_readonly(
          "label", [](const Explanation& e) { return e.verdict.label.text(); },
          "The label; empty: unknown.")
      .def_property_readonly("score", [](const Explanation& e) { return e.verdict.score; })
      .def_property_readonly(
          "margin", [](const Explanation& e) { return e.verdict.margin; },
          "The score minus that of the best rule for another label.")
      .def_property_readonly(
          "rule", [](const Explanation& e) { return e.verdict.rule.text(); },
          "The id of the rule that won, or empty.")
      .def_property_readonly("runner_up",
                             [](const Explanation& e) { return e.verdict.runner_up.text(); })
      .def_property_readonly(
          "reason", [](const Explanation& e) { return reason(e); }, "The reason in one line.")
      .def_property_readonly(
          "full_text", [](const Explanation& e) { return to_text(e); },
          "All rules with all their conditions, as explain --full prints them.")
      .def_property_readonly(
          "json", [](const Explanation& e) { return to_json(e); },
          "All of it as JSON on one line (docs/rules.md).")
      .def("__str__", [](const Explanation& e) { return summary_text(e); })
      .def("__repr__",
           [](const Explanation& e) { return "<oriel.Explanation " + headline(e) + ">"; });
  module.def("explain_feature", &explain_feature, Unlocked());
  module.def("explain_features", &explain_all, Unlocked());
  module.def(
      "explanations_json",
      [](const std::string& building, const std::vector<Explanation>& features) {
        return to_json(building, features);
      },
      Unlocked());
}

std::string state_of(const StageResult& self) {
  const PipelineResult& result = self.result();
  if (!result.is_done()) return "rejected";
  int labelled = 0;
  for (const Verdict& verdict : result.interpretation.verdicts)
    labelled += verdict.label.empty() ? 0 : 1;
  const std::size_t features = result.description.table.rows();
  return self.rules() ? fmt::format("{} of {} features have a label", labelled, features)
                      : fmt::format("{} features", features);
}

void bind_results(py::module_& module) {
  py::class_<StageOptions>(module, "StageOptions").def(py::init(&options_of));
  py::class_<Targets>(module, "Targets").def("__str__", &Targets::text);
  py::class_<NeighbourSearch, std::shared_ptr<NeighbourSearch>>(module, "NeighbourSearch");
  py::class_<GroupsOfSearch, std::shared_ptr<GroupsOfSearch>>(module, "Groups");
  py::class_<StageResult, MadeItem, std::shared_ptr<StageResult>>(
      module, "Result", "All that segment() or label() found of a building.")
      .def_property_readonly(
          "has_neighbours", [](const StageResult& r) { return r.options().neighbours != nullptr; },
          "It was looked which other buildings stand beside it.")
      .def_property_readonly(
          "is_done", [](const StageResult& r) { return r.result().is_done(); },
          "It came to its features; if not, `issues` has the error.")
      .def_property_readonly(
          "is_open", [](const StageResult& r) { return r.result().is_open(); },
          "The building stayed open: it has no solid.")
      .def_property_readonly(
          "names", [](const StageResult& r) { return names_of_features(r.result()); },
          "By feature a name that a person would use: 'window 3 of facade south, storey 2'.")
      .def_property_readonly("rules", &StageResult::rules)
      .def("__repr__", [](const StageResult& r) {
        return "<oriel.Result '" + r.of().building().id + "': " + state_of(r) + ">";
      });
  py::class_<RepairedBuilding, MadeItem, std::shared_ptr<RepairedBuilding>>(
      module, "Repaired",
      "A building whose polygons were made a valid solid, or that was rejected.")
      .def_property_readonly(
          "is_solid", [](const RepairedBuilding& r) { return !!r.repaired().solid; },
          "There is a valid solid, which write() writes.")
      .def_property_readonly(
          "was_needed", [](const RepairedBuilding& r) { return r.repaired().report.was_needed; },
          "False: the polygons were a closed shell already.")
      .def_property_readonly(
          "volume_m3",
          [](const RepairedBuilding& r) {
            return r.repaired().solid ? volume_m3(*r.repaired().solid) : NAN;
          },
          "Of the solid; NaN without one.")
      .def("__repr__", [](const RepairedBuilding& r) {
        const char* state = !r.repaired().solid              ? "stays open"
                            : r.repaired().report.was_needed ? "repaired"
                                                             : "closed already";
        return "<oriel.Repaired '" + r.of().building().id + "': " + state + ">";
      });
  py::class_<RedrawnBuilding, MadeItem, std::shared_ptr<RedrawnBuilding>>(
      module, "Generalised", "A building redrawn for a scale or for levels of detail.")
      .def_property_readonly("is_drawn", &RedrawnBuilding::is_drawn,
                             "It was redrawn; if not, `issues` says why.")
      .def_property_readonly(
          "is_gone", [](const RedrawnBuilding& r) { return r.drawn().is_gone; },
          "It became part of another building and leaves the file.")
      .def_property_readonly(
          "removed",
          [](const RedrawnBuilding& r) {
            return r.drawn().levels.empty() ? std::map<std::string, int>{}
                                            : r.drawn().levels[0].removed;
          },
          "How many features of each label are gone at the first target; '': without a label.")
      .def("__repr__", [](const RedrawnBuilding& r) {
        return "<oriel.Generalised '" + r.of().building().id + "': " +
               (r.is_drawn() ? std::to_string(r.drawn().levels.size()) + " levels" : "rejected") +
               ">";
      });
}

}  // namespace

void StageResult::add_to(OutputRecord& output, std::vector<Issue>& issues) const {
  if (!rules_ || !result_.has_surfaces()) return;
  output.buildings.push_back(annotate(building(), result_, *rules_, options_));
  if (!options_.is_on_solid || !result_.is_done()) return;
  LabelledBuilding& labelled = output.buildings.back();
  auto drawn = on_solid(of().document(), building(), result_, labelled);
  issues.insert(issues.end(), drawn.issues.begin(), drawn.issues.end());
  if (drawn.value) labelled = std::move(*drawn.value);
}

const RuleBase* StageResult::count(std::map<std::string, int>& labels) const {
  for (const auto& [label, number] : count_labels(result_.interpretation)) labels[label] += number;
  return rules_ ? &*rules_ : nullptr;
}

void bind_stages(py::module_& module) {
  bind_packs(module);
  bind_explanations(module);
  bind_results(module);
  module.def("segment", &segment_building, Unlocked());
  module.def("neighbours_in", &neighbours_in, Unlocked());
  module.def("label", &label_building, Unlocked());
  module.def("groups_of", &groups_of, Unlocked());
  module.def("repair", &repair_building, Unlocked());
  module.def("targets", &targets_of, Unlocked());
  module.def("generalise", &redraw_building, Unlocked());
}

}  // namespace oriel::python
