#pragma once

#include "cli/batch/batch_command.h"
#include "cli/batch/run_options.h"
#include "oriel/rules.h"

#include <memory>

namespace oriel::cli {

/// Works on records: runs their buildings down the pipeline and, for a command that produces, makes
/// the product. Changes nothing but the item at hand, so several threads or processes may call it.
class RecordWorker {
 public:
  /// `rules` may be null: then nothing is interpreted. `producer` may be null: then buildings stay
  /// in WorkItem::results.
  RecordWorker(const RunOptions& options, const RuleBase* rules, const ProducingCommand* producer)
      : options_(options), rules_(rules), producer_(producer) {}

  /// Fills the outcome of an item that needs work.
  void work_on(WorkItem& item) const;
  /// The record is not asked for: nothing of it is written.
  [[nodiscard]] bool is_passed_over(const WorkItem& item) const;
  /// What was found in buildings that are not asked for is not reported.
  void drop_unselected(WorkItem& item) const;

 private:
  [[nodiscard]] PipelineResult result_of(const Building& building, Timings& timings) const;
  [[nodiscard]] BuildingOutcome outcome_of(const PipelineResult& result) const;
  [[nodiscard]] PipelineResult result_of(WorkItem& item, std::size_t building) const;
  [[nodiscard]] std::unique_ptr<ProductMaker> maker_of(WorkItem& item) const;
  void set_all_aside(WorkItem& item, Issue why) const;

  const RunOptions& options_;
  const RuleBase* rules_;
  const ProducingCommand* producer_;
};

}  // namespace oriel::cli
