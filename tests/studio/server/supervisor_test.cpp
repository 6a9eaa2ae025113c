#include "studio/server/supervisor.h"

#include "studio/server/shared_work.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel::studio;
using Kind = WorkLog::Kind;

namespace {

/// What workers say to the test, which is another process.
struct Told {
  std::atomic<int> workers{0};
  std::atomic<int> careful{0};
  std::atomic<int> buildings{0};
  std::atomic<pid_t> worker{0};
  std::atomic<bool> is_known{false};
};

class SharedTold {
 public:
  SharedTold()
      : told_(new (::mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                          -1, 0)) Told) {}
  ~SharedTold() { ::munmap(told_, sizeof(Told)); }
  SharedTold(const SharedTold&) = delete;
  SharedTold& operator=(const SharedTold&) = delete;
  Told* operator->() const { return told_; }

 private:
  Told* told_;
};

/// supervise() in a process of its own; its worker asks it to end when `work` returns. What it
/// returned, and -1 if it did not.
int ending_of(const std::function<void(WorkLog&, bool)>& work) {
  const pid_t process = ::fork();
  REQUIRE(process >= 0);
  if (process == 0) {
    std::signal(SIGTERM, SIG_DFL);  // doctest has a handler
    const Ending ending = supervise([&](WorkLog& log, bool is_careful) {
      work(log, is_careful);
      ::kill(::getppid(), SIGTERM);
      while (true) ::pause();
    });
    ::_exit(ending == Ending::asked ? 0 : 1);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// As a session does: one building after the other, those passed over not.
void work_on(WorkLog& log, int count, const std::function<void(int)>& each) {
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::size_t>(i);
    if (!log.why_passed_over(Kind::building, number).empty()) continue;
    const AtWork at_work(&log, Kind::building, number);
    each(i);
  }
}

/// Comes back from a stack without end only.
int use_up_the_stack(int depth) {
  std::array<char, 4096> room{};
  room[static_cast<std::size_t>(depth) % room.size()] = 'a';
  return depth < 0 ? 0 : use_up_the_stack(depth + 1) + room[0];
}

}  // namespace

TEST_SUITE("studio/server") {
  TEST_CASE("a studio that is asked to end ends with its worker") {
    const SharedTold told;
    CHECK(ending_of([&](WorkLog&, bool) {
            ++told->workers;
            told->worker = ::getpid();
          }) == 0);
    CHECK(told->workers == 1);
    CHECK(::kill(told->worker, 0) != 0);
  }

  TEST_CASE("a building that ends its worker is passed over and the others are not") {
    const SharedTold told;
    CHECK(ending_of([&](WorkLog& log, bool) {
            ++told->workers;
            told->buildings = 0;
            work_on(log, 5, [&](int building) {
              if (building == 1) std::raise(SIGSEGV);
              if (building == 3) std::abort();
              ++told->buildings;
            });
            told->is_known = log.why_passed_over(Kind::building, 1) ==
                                 "its worker was ended by signal 11 (SIGSEGV)" &&
                             log.why_passed_over(Kind::file, 1).empty();
          }) == 0);
    CHECK(told->workers == 3);
    CHECK(told->buildings == 3);
    CHECK(told->is_known);
  }

  TEST_CASE("a building that uses up the stack is found among those of other threads") {
    const SharedTold told;
    CHECK(ending_of([&](WorkLog& log, bool is_careful) {
            ++told->workers;
            if (is_careful) ++told->careful;
            std::vector<std::thread> threads;
            for (std::size_t i = 0; i < 4; ++i)
              threads.emplace_back([&log, &told, i] {
                if (!log.why_passed_over(Kind::building, i).empty()) return;
                const AtWork at_work(&log, Kind::building, i);
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                if (i == 2) told->buildings = use_up_the_stack(0);
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
              });
            for (std::thread& thread : threads) thread.join();
          }) == 0);
    CHECK(told->workers == 2);
    CHECK(told->careful == 0);
  }

  TEST_CASE("where a killed worker was at several buildings the next is careful") {
    const SharedTold told;
    CHECK(ending_of([&](WorkLog& log, bool is_careful) {
            ++told->workers;
            if (is_careful) {
              ++told->careful;
              work_on(log, 3, [](int building) {
                if (building == 2) ::kill(::getpid(), SIGKILL);
              });
            } else if (log.why_passed_over(Kind::building, 2).empty()) {
              std::thread([&log] {
                const AtWork one(&log, Kind::building, 0);
                const AtWork two(&log, Kind::building, 2);
                std::thread([&log] {
                  const AtWork three(&log, Kind::building, 1);
                  ::kill(::getpid(), SIGKILL);
                }).join();
              }).join();
            }
          }) == 0);
    CHECK(told->workers == 3);
    CHECK(told->careful == 1);
  }

  TEST_CASE("a worker that ends again and again without a building is given up") {
    const SharedTold told;
    CHECK(ending_of([&](WorkLog&, bool) {
            ++told->workers;
            std::abort();
          }) == 1);
    CHECK(told->workers == 5);
  }

  TEST_CASE("a thread that begins with another building in between is still at the first") {
    SharedWork work;
    {
      const AtWork file(&work, Kind::file, 7);
      { const AtWork building(&work, Kind::building, 3); }
      CHECK(work.take_suspects() == std::vector<WatchedItem>{{Kind::file, 7}});
    }
    const AtWork nobody_asks(nullptr, Kind::file, 0);
    CHECK(work.take_suspects().empty());
  }
}
