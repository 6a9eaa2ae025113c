#pragma once

#include <cstddef>
#include <string>

namespace oriel::studio {

/// Hears what a session works on, so that what ended its process is known afterwards. Functions may
/// be called from any thread.
class WorkLog {
 public:
  /// What is worked on: a whole file while it is read, or a building while it is segmented,
  /// labelled, redrawn.
  enum class Kind { file, building };

  WorkLog() = default;
  virtual ~WorkLog() = default;
  WorkLog(const WorkLog&) = delete;
  WorkLog& operator=(const WorkLog&) = delete;

  /// This thread works on the file or building of that number (in the order of the files) until
  /// end(). Use AtWork.
  virtual void begin(Kind kind, std::size_t number) = 0;
  virtual void end() = 0;
  /// Empty, or why it must be passed over: "its worker was ended by signal 11 (SIGSEGV)", for an
  /// error E123 of the building.
  [[nodiscard]] virtual std::string why_passed_over(Kind kind, std::size_t number) const = 0;
};

/// Work on a file or building, from its beginning to its end. `log` may be null.
class AtWork {
 public:
  AtWork(WorkLog* log, WorkLog::Kind kind, std::size_t number) : log_(log) {
    if (log_ != nullptr) log_->begin(kind, number);
  }
  ~AtWork() {
    if (log_ != nullptr) log_->end();
  }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

 private:
  WorkLog* log_;
};

}  // namespace oriel::studio
