#include "studio/server/shared_work.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <new>
#include <set>
#include <sys/mman.h>
#include <system_error>

namespace oriel::studio {

namespace {

/// Threads that are at work at the same time; those beyond are not seen.
constexpr std::size_t kSlots = 256;
/// A stack for handlers, for threads that have used up theirs.
constexpr std::size_t kHandlerStack = 16U << 10U;
constexpr std::size_t kNoSlot = kSlots;

/// An item in one word, so that it is never half written; 0: none.
std::uint64_t word_of(WorkLog::Kind kind, std::size_t number) {
  return (static_cast<std::uint64_t>(number) << 2U) | (kind == WorkLog::Kind::file ? 2U : 1U);
}

WatchedItem item_of(std::uint64_t word) {
  return {(word & 3U) == 2U ? WorkLog::Kind::file : WorkLog::Kind::building,
          static_cast<std::size_t>(word >> 2U)};
}

/// The slot of this thread, while it is at work, and what it was at before: a thread that waits for
/// others may begin with another building in between.
thread_local std::size_t slot_at_hand = kNoSlot;
thread_local std::vector<std::uint64_t> words_before;

/// Gives a thread a second stack, as long as it lives.
class HandlerStack {
 public:
  HandlerStack() {
    const stack_t stack{memory_.data(), 0, memory_.size()};
    ::sigaltstack(&stack, nullptr);
  }
  ~HandlerStack() {
    const stack_t none{nullptr, SS_DISABLE, 0};
    ::sigaltstack(&none, nullptr);
  }
  HandlerStack(const HandlerStack&) = delete;
  HandlerStack& operator=(const HandlerStack&) = delete;

 private:
  std::vector<char> memory_ = std::vector<char>(kHandlerStack);
};

}  // namespace

struct SharedWork::Shared {
  std::array<std::atomic<std::uint64_t>, kSlots> words{};
  std::array<std::atomic<bool>, kSlots> is_taken{};
  std::atomic<std::uint64_t> guilty{0};
};

namespace {

/// What the handler writes to; it can be given nothing.
std::atomic<std::atomic<std::uint64_t>*> place_of_guilt{nullptr};
std::atomic<std::atomic<std::uint64_t>*> first_word{nullptr};

extern "C" void mark_guilt(int signal) {
  std::atomic<std::uint64_t>* guilty = place_of_guilt;
  if (guilty != nullptr && slot_at_hand != kNoSlot) {
    std::uint64_t nobody = 0;
    guilty->compare_exchange_strong(nobody, first_word.load()[slot_at_hand].load());
  }
  // The handler was reset when it was called.
  std::raise(signal);
}

}  // namespace

SharedWork::SharedWork() {
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  void* memory =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category());
  shared_ = new (memory) Shared;
}

SharedWork::~SharedWork() { ::munmap(shared_, sizeof(Shared)); }

void SharedWork::begin(Kind kind, std::size_t number) {
  if (slot_at_hand == kNoSlot) {
    for (std::size_t i = 0; i < kSlots && slot_at_hand == kNoSlot; ++i)
      if (!shared_->is_taken[i].exchange(true)) slot_at_hand = i;
    static thread_local const HandlerStack stack;
  }
  const bool is_seen = slot_at_hand != kNoSlot;
  words_before.push_back(is_seen ? shared_->words[slot_at_hand].load() : 0);
  if (is_seen) shared_->words[slot_at_hand] = word_of(kind, number);
}

void SharedWork::end() {
  const std::uint64_t before = words_before.back();
  words_before.pop_back();
  if (slot_at_hand == kNoSlot) return;
  shared_->words[slot_at_hand] = before;
  if (!words_before.empty()) return;
  shared_->is_taken[slot_at_hand] = false;
  slot_at_hand = kNoSlot;
}

std::string SharedWork::why_passed_over(Kind kind, std::size_t number) const {
  const auto found = passed_over_.find({kind, number});
  return found == passed_over_.end() ? std::string() : found->second;
}

void SharedWork::mark_faults() {
  first_word = shared_->words.data();
  place_of_guilt = &shared_->guilty;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction action {};
    action.sa_handler = mark_guilt;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_ONSTACK | SA_NODEFER);
    ::sigaction(signal, &action, nullptr);
  }
}

std::vector<WatchedItem> SharedWork::take_suspects() {
  std::set<WatchedItem> at_work;
  for (std::size_t i = 0; i < kSlots; ++i) {
    if (const std::uint64_t word = shared_->words[i].exchange(0); word != 0)
      at_work.insert(item_of(word));
    shared_->is_taken[i] = false;
  }
  if (const std::uint64_t word = shared_->guilty.exchange(0); word != 0) return {item_of(word)};
  return {at_work.begin(), at_work.end()};
}

void SharedWork::pass_over(const WatchedItem& item, const std::string& why) {
  passed_over_.emplace(item, why);
}

}  // namespace oriel::studio
