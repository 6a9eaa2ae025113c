#pragma once

#include "cli/batch/outcome.h"
#include "cli/output/named_files.h"
#include "io/document.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace oriel::cli {

/// What BatchRunner calls of a command, by one thread at a time and in the order of the inputs,
/// unless something else is said.
class BatchCommand {
 public:
  virtual ~BatchCommand() = default;

  /// Adds the files that it reads besides the inputs and those that it writes, so that none is
  /// named twice. Before anything is read or written.
  virtual void name_files(NamedFiles& /*files*/) const {}
  /// How many features it took that are no buildings.
  [[nodiscard]] virtual std::size_t other_features() const { return 0; }
  /// Before the first record of an input.
  virtual void begin(std::size_t /*input*/) {}
  /// After the last record. Not called for an input that could not be read as a whole.
  virtual void end(std::size_t /*input*/) {}
  /// All inputs are done: outputs that are not yet in their place come there. Before the status is
  /// written.
  virtual void commit() {}
};

/// A command that looks at each record with its buildings.
class VisitingCommand : public BatchCommand {
 public:
  /// `results` are the buildings after the pipeline, in their order.
  virtual void visit(const Document& document, std::vector<PipelineResult>& results) = 0;
};

/// A visiting command that is no more than its functions.
class RecordVisitor final : public VisitingCommand {
 public:
  explicit RecordVisitor(
      std::function<void(const Document&, std::vector<PipelineResult>&)> visit,
      std::function<void()> begin = [] {})
      : visit_(std::move(visit)), begin_(std::move(begin)) {}

  void begin(std::size_t /*input*/) override { begin_(); }
  void visit(const Document& document, std::vector<PipelineResult>& results) override {
    visit_(document, results);
  }

 private:
  std::function<void(const Document&, std::vector<PipelineResult>&)> visit_;
  std::function<void()> begin_;
};

/// What one record adds to the outputs of a command, made building by building. Touches nothing
/// else.
class ProductMaker {
 public:
  virtual ~ProductMaker() = default;
  /// Building number `building` after the pipeline; each in its order. Nothing of `result` is kept
  /// but what is written.
  virtual void add(std::size_t building, PipelineResult result) = 0;
  /// All were added.
  virtual Product finish() = 0;
};

/// A command that writes record by record: what it makes of one depends on no other. So its records
/// can be made in forked processes (--isolate), be taken from an earlier run (--reuse), and a run
/// can go on where it was killed (--resume).
class ProducingCommand : public BatchCommand {
 public:
  /// For a record of input number `input`; the references outlive it. Several threads may call it.
  [[nodiscard]] virtual std::unique_ptr<ProductMaker> maker(std::size_t input,
                                                            const Document& document,
                                                            Timings& timings) const = 0;
  /// Polygons of a building are asked for after it was added: by those after it, or by `take`.
  [[nodiscard]] virtual bool needs_polygons() const { return true; }
  /// Puts a product into the outputs.
  virtual void take(const Document& document, Product product) = 0;
  /// The outputs as they are.
  [[nodiscard]] virtual PartPlaces places() const { return {}; }
  /// All that a product depends on besides source, configuration and rules.
  [[nodiscard]] virtual std::string recipe() const { return {}; }
  /// What was taken needs nothing but its outputs, so that the run can go on after any record.
  [[nodiscard]] virtual bool is_streaming() const { return false; }
  /// All that it writes goes to files, so that a run that was killed can go on.
  [[nodiscard]] virtual bool writes_files() const { return false; }
  /// All inputs were done when an earlier run was killed: outputs of all of them together, which
  /// `begin` opens otherwise, are to be opened for `commit`.
  virtual void reopen() {}
  /// Counts of what was taken; kept and restored with the run. Null: there are none.
  virtual std::map<std::string, int>* counts() { return nullptr; }
};

inline constexpr std::size_t kNoBuilding = SIZE_MAX;

/// Work begins on building number `building` of the record at hand, or on the record as a whole:
/// what is blamed if a worker of --isolate ends here. Costs nothing without it.
void now_at_building(std::size_t building);

}  // namespace oriel::cli
