#include "studio/server/supervisor.h"

#include "kernel/base/log.h"
#include "studio/server/shared_work.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <exception>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

using SteadyClock = std::chrono::steady_clock;

/// So many workers that end so quickly one after the other, and nothing to blame: the next would
/// end, too.
constexpr std::size_t kMostFaults = 5;
constexpr auto kShortWhile = std::chrono::seconds(60);
/// What a worker has to end after it was asked; then it is killed.
constexpr auto kPatience = std::chrono::seconds(3);
constexpr std::array kAskedBy{SIGINT, SIGTERM, SIGHUP};

std::string how_it_ended(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  const char* name = ::sigabbrev_np(signal);
  return fmt::format("signal {} (SIG{})", signal, name != nullptr ? name : "?");
}

/// Signals that this process waits for, and no handler gets; as before when it is over.
class BlockedSignals {
 public:
  BlockedSignals() {
    ::sigemptyset(&waited_for_);
    for (const int signal : kAskedBy) ::sigaddset(&waited_for_, signal);
    ::sigaddset(&waited_for_, SIGCHLD);
    ::sigprocmask(SIG_BLOCK, &waited_for_, &before_);
  }
  ~BlockedSignals() { restore(); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

  void restore() const { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }

  /// The next of them; 0 after `most`, if that is given.
  [[nodiscard]] int wait(std::chrono::seconds most = {}) const {
    const timespec time{most.count(), 0};
    while (true) {
      const int signal = most.count() == 0 ? ::sigwaitinfo(&waited_for_, nullptr)
                                           : ::sigtimedwait(&waited_for_, nullptr, &time);
      if (signal > 0) return signal;
      if (errno == EAGAIN) return 0;
    }
  }

 private:
  sigset_t waited_for_{}, before_{};
};

/// Ctrl-C goes to the whole group of processes: the parent asks the worker to end.
[[noreturn]] void be_studio_worker(const StudioWork& work, SharedWork& log,
                                   bool is_careful) noexcept {
  for (const int signal : {SIGINT, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
  log.mark_faults();
  try {
    work(log, is_careful);
  } catch (const std::exception& fault) {
    oriel::log("studio").write(LogLevel::error, fault.what());
    ::_exit(EXIT_FAILURE);
  }
  ::_exit(EXIT_SUCCESS);
}

/// A worker that was started, and ends with this.
class StudioWorker {
 public:
  StudioWorker(const StudioWork& work, SharedWork& log, bool is_careful,
               const BlockedSignals& signals) {
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "no worker");
    if (process_ > 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(EXIT_SUCCESS);
    signals.restore();
    be_studio_worker(work, log, is_careful);
  }
  ~StudioWorker() {
    if (!is_running_) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  StudioWorker(const StudioWorker&) = delete;
  StudioWorker& operator=(const StudioWorker&) = delete;

  /// True if it has ended; `status` is then what waitpid() says.
  bool has_ended(int& status) {
    if (is_running_ && ::waitpid(process_, &status, WNOHANG) == process_) is_running_ = false;
    return !is_running_;
  }

  void ask_to_end(const BlockedSignals& signals) {
    ::kill(process_, SIGTERM);
    const auto until = SteadyClock::now() + kPatience;
    for (int status = 0; !has_ended(status) && SteadyClock::now() < until;)
      if (signals.wait(std::chrono::seconds(1)) == 0) continue;
  }

 private:
  pid_t process_ = 0;
  bool is_running_ = true;
};

/// Whom to blame, and whether to go on.
class WorkerFaults {
 public:
  explicit WorkerFaults(SharedWork& work) : work_(&work) {}

  [[nodiscard]] bool is_careful() const { return is_careful_; }

  /// A worker has ended, though nobody asked it to. False if there is no use in another one.
  bool note(int status) {
    const std::string how = how_it_ended(status);
    const auto suspects = work_->take_suspects();
    const bool is_found = suspects.size() == 1 || (is_careful_ && !suspects.empty());
    if (is_found) {
      for (const WatchedItem& item : suspects) blame(item, how);
      is_careful_ = false;
      return true;
    }
    is_careful_ = !suspects.empty();
    say(fmt::format("the worker was ended by {} and is started again", how));
    return !are_too_many();
  }

 private:
  static void say(const std::string& text) { oriel::log("studio").write(LogLevel::warning, text); }

  void blame(const WatchedItem& item, const std::string& how) {
    const char* kind = item.kind == WorkLog::Kind::file ? "file" : "building";
    say(fmt::format("the worker was ended by {} at {} {} and is started again without it", how,
                    kind, item.number + 1));
    work_->pass_over(item, "its worker was ended by " + how);
  }

  bool are_too_many() {
    times_.push_back(SteadyClock::now());
    if (times_.size() > kMostFaults) times_.pop_front();
    return times_.size() == kMostFaults && times_.back() - times_.front() < kShortWhile;
  }

  SharedWork* work_;
  bool is_careful_ = false;
  std::deque<SteadyClock::time_point> times_;
};

}  // namespace

Ending supervise(const StudioWork& work) {
  const BlockedSignals signals;
  SharedWork log;
  WorkerFaults faults(log);
  while (true) {
    StudioWorker worker(work, log, faults.is_careful(), signals);
    int status = 0;
    while (!worker.has_ended(status)) {
      if (signals.wait() == SIGCHLD) continue;
      worker.ask_to_end(signals);
      return Ending::asked;
    }
    if (!faults.note(status)) return Ending::hopeless;
  }
}

}  // namespace oriel::studio
