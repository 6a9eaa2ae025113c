#include "cli/batch/isolation.h"

#include "cli/batch/batch_command.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <system_error>
#include <type_traits>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

/// A batch is over when it has so many records, or so many bytes of lines: a fork costs about as
/// much as one building, and records wait in memory.
constexpr std::size_t kMostBatchRecords = 16;
constexpr std::size_t kMostBatchBytes = 4 << 20;
/// Batches for each worker that are read, worked on or wait for those before them.
constexpr std::size_t kBatchesPerJob = 2;
constexpr std::size_t kPipeChunk = 1 << 16;

/// Where a worker is; the parent reads it when the worker is gone.
volatile std::size_t* building_at_hand = nullptr;
/// What a worker may be at one building for, unless that is lost already.
itimerval most_time{};
const WorkItem* item_at_hand = nullptr;

[[noreturn]] void give_up(const char* what) {
  throw std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

/// A message of a worker: what came of one record. Sizes of its pieces, then these: the outcome
/// (CBOR), the milliseconds of the stages, the bytes of all parts.
static_assert(std::is_trivially_copyable_v<Timings>);
struct Head {
  std::uint64_t outcome = 0;
  std::array<std::uint64_t, kParts> parts{};
};

std::string message_of(const WorkItem& item) {
  const Product& product = item.outcome.product;
  const auto outcome = nlohmann::ordered_json::to_cbor(to_json(item.outcome));
  Head head;
  head.outcome = outcome.size();
  for (std::size_t i = 0; i < kParts; ++i) head.parts[i] = product.bytes[i].size();
  std::string message(sizeof head + sizeof(Timings), '\0');
  std::memcpy(message.data(), &head, sizeof head);
  std::memcpy(message.data() + sizeof head, &item.timings, sizeof(Timings));
  message.append(outcome.begin(), outcome.end());
  for (const std::string& bytes : product.bytes) message += bytes;
  return message;
}

/// Takes a whole message from `bytes` at `at`, which moves past it; false if it is not whole.
bool take_message(const std::string& bytes, std::size_t& at, WorkItem& item) {
  Head head;
  constexpr std::size_t kFixed = sizeof head + sizeof(Timings);
  if (bytes.size() - at < kFixed) return false;
  std::memcpy(&head, bytes.data() + at, sizeof head);
  std::size_t whole = kFixed + head.outcome;
  for (const std::uint64_t part : head.parts) whole += part;
  if (bytes.size() - at < whole) return false;
  std::memcpy(&item.timings, bytes.data() + at + sizeof head, sizeof(Timings));
  const char* piece = bytes.data() + at + kFixed;
  item.outcome = outcome_of(nlohmann::ordered_json::from_cbor(piece, piece + head.outcome));
  piece += head.outcome;
  for (std::size_t i = 0; i < kParts; ++i) {
    item.outcome.product.bytes[i].assign(piece, head.parts[i]);
    piece += head.parts[i];
  }
  at += whole;
  return true;
}

bool send(int pipe, const std::string& message) {
  for (std::size_t at = 0; at < message.size();) {
    const ssize_t count = ::write(pipe, message.data() + at, message.size() - at);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) at += static_cast<std::size_t>(count);
  }
  return true;
}

itimerval once_after(double seconds) {
  const auto whole = static_cast<time_t>(seconds);
  const auto micros = static_cast<suseconds_t>((seconds - static_cast<double>(whole)) * 1e6);
  return {{}, {whole, micros}};
}

std::size_t bytes_of(const WorkItem& item) {
  const Record* record = item.record();
  return record != nullptr && record->document.value ? source_line(*record->document.value).size()
                                                     : 0;
}

}  // namespace

void now_at_building(std::size_t building) {
  if (building_at_hand == nullptr) return;
  *building_at_hand = building;
  const itimerval none{};
  const bool is_timed = building != kNoBuilding && !item_at_hand->lost.contains(building);
  ::setitimer(ITIMER_REAL, is_timed ? &most_time : &none, nullptr);
}

struct Isolation::SharedReport {
  std::size_t building = kNoBuilding;
};

struct Isolation::Batch {
  std::vector<std::unique_ptr<WorkItem>> items;
  std::size_t answered = 0;  ///< items before this one are done
  std::size_t settled = 0;
  pid_t worker = 0;
  int pipe = -1;
  SharedReport* report = nullptr;
  std::string received;

  void pass_over_workless() {
    while (answered < items.size() && !items[answered]->needs_work()) ++answered;
  }
  [[nodiscard]] bool is_answered() const { return answered == items.size(); }
  [[nodiscard]] bool is_running() const { return pipe >= 0; }
};

Isolation::Isolation(int jobs, double most_seconds, Callbacks callbacks)
    : jobs_(jobs), most_seconds_(most_seconds), callbacks_(std::move(callbacks)) {
  const auto count = static_cast<std::size_t>(jobs_);
  void* shared = ::mmap(nullptr, count * sizeof(SharedReport), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) give_up("no memory to share with workers");
  reports_ = new (shared) SharedReport[count];
  for (std::size_t i = 0; i < count; ++i) free_reports_.push_back(reports_ + i);
}

Isolation::~Isolation() {
  for (const auto& batch : batches_) {
    if (!batch->is_running()) continue;
    ::kill(batch->worker, SIGKILL);
    ::close(batch->pipe);
    ::waitpid(batch->worker, nullptr, 0);
  }
  ::munmap(reports_, static_cast<std::size_t>(jobs_) * sizeof(SharedReport));
}

void Isolation::run() {
  while (true) {
    while (fill()) {
    }
    settle_front();
    if (batches_.empty() && is_over_) return;
    if (!batches_.empty()) receive();
  }
}

/// Reads a batch and gives it to a worker; false if there is nothing to read or nobody to work.
bool Isolation::fill() {
  const auto most = kBatchesPerJob * static_cast<std::size_t>(jobs_);
  if (is_over_ || free_reports_.empty() || batches_.size() >= most) return false;
  auto batch = std::make_unique<Batch>();
  for (std::size_t bytes = 0; batch->items.size() < kMostBatchRecords && bytes < kMostBatchBytes;) {
    auto item = callbacks_.next();
    is_over_ = !item;
    if (is_over_) break;
    bytes += bytes_of(*item);
    batch->items.push_back(std::move(item));
  }
  if (batch->items.empty()) return false;
  batch->pass_over_workless();
  batches_.push_back(std::move(batch));
  if (!batches_.back()->is_answered()) start(*batches_.back());
  return !is_over_;
}

void Isolation::start(Batch& batch) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) give_up("cannot open a pipe to a worker");
  batch.report = free_reports_.back();
  free_reports_.pop_back();
  batch.report->building = kNoBuilding;
  const pid_t parent = ::getpid();
  batch.worker = ::fork();
  if (batch.worker < 0) give_up("cannot start a worker");
  if (batch.worker == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    be_worker(batch, ends[1]);
  }
  ::close(ends[1]);
  batch.pipe = ends[0];
}

/// Ctrl-C and the like are for the parent, with which its workers end. What else ends a worker does
/// so without the parent's handlers. An exception is a crash as any other.
void Isolation::be_worker(const Batch& batch, int pipe) const noexcept {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
  for (const int signal : {SIGALRM, SIGPIPE, SIGXCPU, SIGXFSZ}) std::signal(signal, SIG_DFL);
  most_time = once_after(most_seconds_);
  building_at_hand = &batch.report->building;
  for (std::size_t i = batch.answered; i < batch.items.size(); ++i) {
    WorkItem& item = *batch.items[i];
    if (!item.needs_work()) continue;
    item_at_hand = &item;
    callbacks_.work(item);
    item.outcome.product.flatten();
    if (!send(pipe, message_of(item))) break;
    now_at_building(kNoBuilding);
  }
  ::_exit(0);
}

/// Waits until some worker has something to say.
void Isolation::receive() {
  std::vector<pollfd> pipes;
  std::vector<Batch*> from;
  for (const auto& batch : batches_) {
    if (!batch->is_running()) continue;
    pipes.push_back({batch->pipe, POLLIN, 0});
    from.push_back(batch.get());
  }
  if (pipes.empty()) return;
  if (::poll(pipes.data(), pipes.size(), -1) < 0) {
    if (errno == EINTR) return;
    give_up("workers cannot be read from");
  }
  for (std::size_t i = 0; i < pipes.size(); ++i)
    if (pipes[i].revents != 0) read_from(*from[i]);
}

void Isolation::read_from(Batch& batch) {
  const std::size_t had = batch.received.size();
  batch.received.resize(had + kPipeChunk);
  const ssize_t count = ::read(batch.pipe, batch.received.data() + had, kPipeChunk);
  batch.received.resize(had + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  if (count < 0 && errno == EINTR) return;
  if (count < 0) give_up("a worker cannot be read from");
  std::size_t at = 0;
  while (!batch.is_answered() && take_message(batch.received, at, *batch.items[batch.answered])) {
    ++batch.answered;
    batch.pass_over_workless();
  }
  batch.received.erase(0, at);
  if (count == 0) end(batch);
}

/// The worker is gone. What it has not answered is for another one.
void Isolation::end(Batch& batch) {
  int status = 0;
  while (::waitpid(batch.worker, &status, 0) < 0 && errno == EINTR) {
  }
  ::close(batch.pipe);
  batch.pipe = -1;
  free_reports_.push_back(batch.report);
  if (batch.is_answered()) return;
  blame(batch, status);
  batch.received.clear();
  start(batch);
}

std::string Isolation::cause_of(int status) const {
  if (!WIFSIGNALED(status)) return fmt::format("exit code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGALRM && most_seconds_ > 0)
    return fmt::format("the clock: it took more than {} s (--most-seconds)", most_seconds_);
  const char* name = ::sigabbrev_np(signal);
  return fmt::format("signal {} (SIG{})", signal, name != nullptr ? name : "?");
}

void Isolation::blame(Batch& batch, int status) {
  WorkItem& item = *batch.items[batch.answered];
  const std::vector<Building>& buildings = item.record()->document.value->buildings;
  const std::string how = cause_of(status);
  const std::size_t at = batch.report->building;
  std::size_t from = at, to = at + 1;
  if (at >= buildings.size() || item.lost.contains(at)) from = 0, to = buildings.size();
  bool is_new = false;
  for (std::size_t i = from; i < to; ++i)
    is_new |= item.lost
                  .emplace(i, building_issue(Severity::error, Code::E123, buildings[i].id,
                                             "its worker was ended by " + how))
                  .second;
  if (!is_new)
    throw std::runtime_error(
        fmt::format("{} ended a worker by {}", item.record()->document.value->name, how));
}

void Isolation::settle_front() {
  while (!batches_.empty()) {
    Batch& batch = *batches_.front();
    for (; batch.settled < batch.answered; ++batch.settled) {
      callbacks_.settle(*batch.items[batch.settled]);
      batch.items[batch.settled].reset();
    }
    if (!batch.is_answered() || batch.is_running()) return;
    batches_.erase(batches_.begin());
  }
}

}  // namespace oriel::cli
