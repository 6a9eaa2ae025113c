#include "generalise/tasks.h"

#include "generalise/operators/operators.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

class TaskMaker {
 public:
  TaskMaker(const Plan& plan, const Segmentation& segmentation)
      : plan_(plan), segmentation_(segmentation) {}

  std::vector<PlanTask> run() {
    std::map<GroupKey, std::vector<Step>> groups;
    for (const Step& step : plan_.steps) {
      if (step.operation == "omit") continue;
      if (is_for_groups(step) && !feature(step).planes.empty())
        groups[key_of(step)].push_back(step);
      else
        tasks_.push_back({step.operation, {step}});
    }
    for (auto& [key, members] : groups)
      if (members[0].group.empty() && !takes_some(members[0]))
        add_rows(std::move(members));
      else
        add_row({members[0].operation, std::move(members)});
    std::ranges::sort(tasks_, {}, [this](const PlanTask& task) {
      const auto first = std::ranges::min(task.steps, {}, &Step::feature).feature;
      const bool draws_outlines = std::ranges::any_of(
          task.steps, [&](const Step& step) { return feature(step).sense == Sense::imprint; });
      // What is flush is drawn after all that stands on its facet.
      const OperatorTurn turn =
          draws_outlines ? OperatorTurn::outlines : operator_named(task.operation).turn;
      return std::pair{turn, first};
    });
    return std::move(tasks_);
  }

 private:
  /// Rule, wall plane and group.
  using GroupKey =
      std::tuple<std::string, std::array<std::int64_t, 3>, std::int64_t, PlaneId, std::string>;
  /// Parts of a wall have planes of their own where they were cut apart: a facade is one place.
  [[nodiscard]] GroupKey key_of(const Step& step) const {
    const PlaneId plane = feature(step).planes[0];
    const Plane& its = segmentation_.planes[plane.index()];
    if (takes_some(step)) return {step.rule, its.coefficients, its.offset, {}, {}};
    return {step.rule, {}, 0, plane, step.group};
  }
  [[nodiscard]] const Feature& feature(const Step& step) const {
    return segmentation_.features[step.feature.index()];
  }
  [[nodiscard]] const Box& box(const Step& step) const { return feature(step).box; }

  /// Features on one wall whose heights overlap by half of the lower one's are a row.
  void add_rows(std::vector<Step> members) {
    std::ranges::sort(members, {}, [&](const Step& step) {
      return std::pair{box(step).min.z, step.feature};
    });
    std::vector<PlanTask> rows;
    for (Step& step : members) {
      const Box& mine = box(step);
      const auto found = std::ranges::find_if(rows, [&](const PlanTask& row) {
        const Box& its = box(row.steps[0]);
        const double common = std::min(mine.max.z, its.max.z) - std::max(mine.min.z, its.min.z);
        return common >= 0.5 * std::min(mine.max.z - mine.min.z, its.max.z - its.min.z);
      });
      if (found == rows.end())
        rows.push_back({step.operation, {std::move(step)}});
      else
        found->steps.push_back(std::move(step));
    }
    for (PlanTask& row : rows) add_row(std::move(row));
  }

  void add_row(PlanTask row) {
    const Vec3 normal = segmentation_.planes[feature(row.steps[0]).planes[0].index()].normal;
    const Vec3 along = cross({0, 0, 1}, normal);
    std::ranges::sort(row.steps, {}, [&](const Step& step) {
      return std::pair{dot(along, box(step).min + box(step).max), step.feature};
    });
    tasks_.push_back(std::move(row));
  }

  const Plan& plan_;
  const Segmentation& segmentation_;
  std::vector<PlanTask> tasks_;
};

}  // namespace

bool is_for_groups(const Step& step) {
  return operator_named(step.operation).scope != OperatorScope::feature && !becomes_block(step);
}
bool takes_some(const Step& step) {
  return operator_named(step.operation).scope == OperatorScope::wall;
}

std::vector<PlanTask> tasks_of(const Plan& plan, const Segmentation& segmentation) {
  return TaskMaker(plan, segmentation).run();
}

}  // namespace oriel::detail
