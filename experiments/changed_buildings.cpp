#include "experiments/changed_buildings.h"

#include "experiments/results/result_rows.h"
#include "interpret/labelling/interpret.h"
#include "io/reader.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/slug.h"
#include "oriel/label.h"
#include "oriel/picture.h"
#include "oriel/write.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

using BuildingsById = std::map<std::string, Building>;

/// "2 window to unknown, 1 unknown to door": the most frequent first.
std::string sums_of(const std::map<std::string, std::pair<std::string, std::string>>& changes) {
  const auto named = [](const std::string& label) { return label.empty() ? "unknown" : label; };
  std::map<std::string, int> counts;
  for (const auto& [id, labels] : changes)
    ++counts[named(labels.first) + " to " + named(labels.second)];
  std::vector<std::pair<int, std::string>> sums;
  for (const auto& [what, count] : counts) sums.emplace_back(-count, what);
  std::ranges::sort(sums);
  std::vector<std::string> texts;
  for (const auto& [count, what] : sums) texts.push_back(fmt::format("{} {}", -count, what));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// The buildings of the files that have these ids, at a level of detail.
BuildingsById buildings_in(const std::vector<HashedFile>& files, const std::string& lod,
                           const std::vector<std::string>& ids) {
  BuildingsById found;
  ReadOptions options;
  if (!lod.empty()) options.lod = lod;
  for (const HashedFile& file : files) {
    if (found.size() == ids.size()) break;
    Reader reader(file.path, options);
    while (auto record = reader.next())
      if (record->value)
        for (Building& building : record->value->buildings)
          if (std::ranges::find(ids, building.id) != ids.end())
            found.try_emplace(building.id, std::move(building));
  }
  return found;
}

}  // namespace

ChangedLabels::ChangedLabels(const SampleSet& set, const PartContext& context)
    : set_(set),
      context_(context),
      own_options_(pipeline_options(context.plan.options, set.plan->ignores_semantics)),
      before_(labels_of(context.rules, set.samples)),
      changes_(set.samples.size()) {
  for (std::size_t i = 0; i < changes_.size(); ++i)
    changes_[i].building = set.samples[i].features.table.building();
}

std::vector<ChangedLabels::Labels> ChangedLabels::labels_of(const RuleBase& rules,
                                                            std::span<const Sample> samples) const {
  std::vector<Labels> labels(samples.size());
  context_.for_each(samples.size(), [&](std::size_t i) {
    const DescribedBuilding& building = samples[i].features;
    for (const Verdict& verdict : interpret(rules, building.table, building.graph).verdicts)
      if (!verdict.label.empty())
        labels[i].emplace(building.table.id(verdict.feature), verdict.label);
  });
  return labels;
}

void ChangedLabels::add(const std::string& run, const RuleBase& rules,
                        const PipelineOptions& options, std::span<const Sample> samples) {
  const std::vector<Labels> after = labels_of(rules, samples);
  for (std::size_t i = 0; i < before_.size(); ++i) {
    Changes changes;
    for (const auto& [id, label] : before_[i])
      if (const auto now = after[i].find(id); now == after[i].end() || now->second != label)
        changes[id] = {label, now == after[i].end() ? "" : now->second};
    for (const auto& [id, label] : after[i])
      if (!before_[i].contains(id)) changes[id] = {"", label};
    if (changes.size() > changes_[i].labels.size()) {
      changes_[i].run = runs_.size();
      changes_[i].labels = std::move(changes);
    }
  }
  runs_.push_back({run, rules, options});
}

Checked<std::string> ChangedLabels::picture_of(
    const RelabelledBuilding& change, const std::map<std::string, BuildingsById>& by_lod) const {
  std::vector<PicturePanel> panels;
  const auto add_panel = [&](const std::string& name, const RuleBase& rules,
                             const PipelineOptions& how) {
    LabelOptions options;
    static_cast<PipelineOptions&>(options) = how;
    options.neighbours = set_.neighbours;
    PicturePanel& panel = panels.emplace_back();
    panel.caption = name;
    panel.frame = 0;
    for (const auto& [id, labels] : change.labels)
      panel.marks[{change.building, id}] = PictureMark::changed;
    const auto& buildings = by_lod.at(how.lod);
    const auto found = buildings.find(change.building);
    if (found != buildings.end())  // else it is not there at this level of detail
      append_building(panel.mesh, found->second, label(found->second, rules, options).output);
  };
  const ComparedRun& run = runs_[change.run];
  add_panel(kBaselineName, context_.rules, own_options_);
  add_panel(run.name, run.rules, run.options);
  PictureOptions options;
  options.width_px = 1100;
  options.height_px = 520;
  options.columns = 2;
  return picture(panels, PictureFormat::svg, options);
}

ChangedBuildings ChangedLabels::draw() const {
  std::vector<RelabelledBuilding> most = changes_;
  std::erase_if(most, [](const RelabelledBuilding& change) { return change.labels.empty(); });
  const std::size_t all = most.size();
  std::ranges::stable_sort(most, [](const RelabelledBuilding& p, const RelabelledBuilding& q) {
    return p.labels.size() > q.labels.size();
  });
  most.resize(std::min(all, kMostChangedPictures));
  ChangedBuildings drawn;
  drawn.sentence =
      fmt::format("{} of {} {} labels that differ from the baseline in some run of the comparison",
                  counted_of(all, changes_.size(), "building"), set_.plan->name,
                  agreeing_of(all, changes_.size(), "has", "have"));
  if (all > 0 && set_.files.models.empty())
    drawn.sentence += "; the set has features without models, so that none is drawn";
  else if (all > most.size())
    drawn.sentence += fmt::format("; the {} with the most are drawn, {} not", most.size(),
                                  counted(all - most.size(), "is", "are"));
  drawn.sentence += ".";
  if (all == 0 || set_.files.models.empty()) return drawn;
  std::vector<std::string> ids;
  for (const RelabelledBuilding& change : most) ids.push_back(change.building);
  std::map<std::string, BuildingsById> by_lod;
  const auto read_at = [&](const std::string& lod) {
    if (!by_lod.contains(lod)) by_lod[lod] = buildings_in(set_.files.models, lod, ids);
  };
  read_at(own_options_.lod);
  for (const RelabelledBuilding& change : most) read_at(runs_[change.run].options.lod);
  std::vector<Checked<std::string>> pictures(most.size());
  context_.for_each(most.size(), [&](std::size_t i) { pictures[i] = picture_of(most[i], by_lod); });
  for (std::size_t i = 0; i < most.size(); ++i) {
    if (!pictures[i].value && pictures[i].issues.front().code == Code::E171) {
      drawn.sentence += " None is drawn: E171 " + pictures[i].issues.front().sentence + ".";
      return drawn;
    }
    const RelabelledBuilding& change = most[i];
    ReportBuilding& one = drawn.buildings.emplace_back();
    one.name = fmt::format("{}-{}", slug_of("changed-" + set_.plan->name), i + 1);
    one.title = fmt::format("{} in {}", change.building, runs_[change.run].name);
    one.caption = fmt::format("{} changed: {}.", counted(change.labels.size(), "label"),
                              sums_of(change.labels));
    if (pictures[i].value)
      one.svg = std::move(*pictures[i].value);
    else
      one.caption += " It is not drawn: " + pictures[i].issues.front().sentence + ".";
  }
  return drawn;
}

}  // namespace oriel
