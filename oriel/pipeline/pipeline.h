#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/model/building.h"
#include "oriel/label.h"
#include "oriel/result.h"

#include <chrono>

namespace oriel {

/// Calls `work()`, reports its time to the observer, if there is one, and returns what it returns.
template <class Work>
auto measure(const StageObserver& observer, Stage stage, Work work) {
  class Stopwatch {
   public:
    Stopwatch(const StageObserver& observer, Stage stage) : observer_(observer), stage_(stage) {}
    ~Stopwatch() {
      const std::chrono::duration<double, std::milli> took = Clock::now() - start_;
      if (observer_) observer_(stage_, took.count());
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    const StageObserver& observer_;
    Stage stage_;
    Clock::time_point start_ = Clock::now();
  };
  const Stopwatch watch(observer, stage);
  return work();
}

/// solid_of() with the tolerances given.
PipelineResult run_to_solid(const Building& building, const Tolerances& tolerances,
                            const RepairOptions& repair, const StageObserver& observer);

/// The rest of the pipeline, for a building that has come to its solid, or to none: its features,
/// and with `rules` their labels and its surfaces. `tolerances` are those of the solid.
PipelineResult run_from_solid(PipelineResult solid, const Building& building, const RuleBase* rules,
                              const Tolerances& tolerances, const LabelOptions& options);

/// All of it, with tolerances fitted to noise. `rules` may be null.
PipelineResult run_pipeline(const Building& building, const RuleBase* rules,
                            const LabelOptions& options);

/// Fills result.surfaces, whether the building came to the end or not. A fault of ours is E901.
void describe_all_surfaces(const Building& building, const Tolerances& tolerances,
                           const StageObserver& observer, PipelineResult& result);

/// Fills result.surfaces as far as its surfaces cannot be named without, and names them.
void name_surfaces(const Building& building, const Tolerances& tolerances, const RuleBase& rules,
                   const StageObserver& observer, PipelineResult& result);

/// E901.
Issue own_fault(const Building& building, const std::exception& fault);

}  // namespace oriel
