#pragma once

#include "cli/batch/outcome.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace oriel::cli {

/// Works on records in forked processes, so that a hard crash costs one building. A worker gets a
/// batch of records, which it has in its memory from the start, and sends back what came of each.
/// If a signal ends it, the building that it was at is lost (E123), and another worker resumes with
/// that record. This process has one thread only and works on nothing itself: it reads, and takes
/// what comes in the order of the inputs.
class Isolation {
 public:
  struct Callbacks {
    /// The next item, or null after the last.
    std::function<std::unique_ptr<WorkItem>()> next;
    /// Fills the outcome of an item; runs in a worker.
    std::function<void(WorkItem&)> work;
    /// An item is done, in its order.
    std::function<void(WorkItem&)> settle;
  };

  /// Up to `jobs` workers at the same time. A worker that is at one building for longer than
  /// `most_seconds`, if that is more than 0, ends by SIGALRM.
  Isolation(int jobs, double most_seconds, Callbacks callbacks);
  ~Isolation();
  Isolation(const Isolation&) = delete;
  Isolation& operator=(const Isolation&) = delete;

  /// All items. Throws std::runtime_error if the system gives no process or pipe, or if a record
  /// ends its worker though all its buildings are lost already.
  void run();

 private:
  struct Batch;
  struct SharedReport;

  bool fill();
  void start(Batch& batch);
  void receive();
  void read_from(Batch& batch);
  void end(Batch& batch);
  void blame(Batch& batch, int status);
  void settle_front();
  [[noreturn]] void be_worker(const Batch& batch, int pipe) const noexcept;

  [[nodiscard]] std::string cause_of(int status) const;

  int jobs_;
  double most_seconds_;
  Callbacks callbacks_;
  std::vector<std::unique_ptr<Batch>> batches_;  ///< in the order of their records
  std::vector<SharedReport*> free_reports_;
  SharedReport* reports_ = nullptr;  ///< shared with the workers, one for each
  bool is_over_ = false;             ///< nothing more comes
};

}  // namespace oriel::cli
