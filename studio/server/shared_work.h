#pragma once

#include "studio/session/work_log.h"

#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace oriel::studio {

/// A file or a building.
struct WatchedItem {
  WorkLog::Kind kind = WorkLog::Kind::building;
  std::size_t number = 0;

  auto operator<=>(const WatchedItem&) const = default;
};

/// What a worker is at, in memory that it shares with its supervisor, which reads it when the
/// worker is gone.
class SharedWork final : public WorkLog {
 public:
  /// Throws std::system_error if the system gives no such memory.
  SharedWork();
  ~SharedWork() override;

  void begin(Kind kind, std::size_t number) override;
  void end() override;
  [[nodiscard]] std::string why_passed_over(Kind kind, std::size_t number) const override;

  /// In a worker, once: a signal that a fault raises (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT)
  /// says which thread it was before it ends the process. One worker of a process has this.
  void mark_faults();

  /// In the supervisor, when the worker is gone: the item of the thread that had the fault; if no
  /// thread said so (it was killed), those that were at work, sorted. All is forgotten then.
  [[nodiscard]] std::vector<WatchedItem> take_suspects();
  /// In the supervisor: the workers to come pass over it.
  void pass_over(const WatchedItem& item, const std::string& why);

 private:
  struct Shared;

  Shared* shared_ = nullptr;
  std::map<WatchedItem, std::string> passed_over_;
};

}  // namespace oriel::studio
