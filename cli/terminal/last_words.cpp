#include "cli/terminal/last_words.h"

#include "cli/terminal/exit_code.h"
#include "cli/terminal/logging.h"
#include "io/files/output_file.h"
#include "kernel/base/issue.h"

#include <atomic>
#include <cstdlib>
#include <exception>
#include <gmp.h>
#include <memory>
#include <new>
#include <string_view>
#include <unistd.h>

namespace oriel::cli {

namespace {

constexpr std::string_view kNoMemory =
    "memory is used up: the run ends here, and what it was writing is not kept";

/// The process whose temporary files there are: forked workers have only copies of its list.
pid_t main_process = 0;

/// Who exchanges it owns what it gets: a handler of signals never reads what is being freed.
std::atomic<std::string*> last_words = nullptr;

/// As much of it as stderr takes.
void say(std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t count = ::write(STDERR_FILENO, text.data(), text.size());
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// A code is so short that its text is not allocated.
void say_memory_is_used_up(bool is_json) noexcept {
  say(is_json ? R"({"level":"error","logger":"findings","code":")" : "error: ");
  say(to_string(Code::E507));
  say(is_json ? R"(","message":")" : " ");
  say(kNoMemory);
  say(is_json ? "\"}\n" : "\n");
}

/// Before main() nobody would catch anything.
void end_before_main() {
  say_memory_is_used_up(false);
  ::_exit(static_cast<int>(ExitCode::internal));
}

/// For allocators that, written in C, would abort.
void throw_without_memory() { throw std::bad_alloc(); }

/// std::terminate without an exception that is known here: a thread that could not begin, say.
void say_unknown() noexcept {
  say("error: ");
  say(to_string(Code::E901));
  say(" the run had to end at once; most likely memory is used up\n");
}

[[noreturn]] void end_uncaught() noexcept {
  say_last_words();
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    say_unknown();
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const std::exception& fault) {
    say("error: ");
    say(to_string(Code::E901));
    say(" a fault of oriel's own: ");
    say(fault.what());
    say("\n");
  } catch (...) {
    say_unknown();
  }
  if (::getpid() != main_process) std::abort();  // the parent tells by the signal
  remove_temporary_files();
  ::_exit(static_cast<int>(ExitCode::internal));
}

/// For CGAL's numbers: GMP, written in C, would abort, and no exception may pass it.
void* allocate(std::size_t bytes) {
  void* const memory = std::malloc(bytes);
  if (memory == nullptr) end_without_memory();
  return memory;
}

void* reallocate(void* old, std::size_t /*old_bytes*/, std::size_t bytes) {
  void* const memory = std::realloc(old, bytes);
  if (memory == nullptr) end_without_memory();
  return memory;
}

void release(void* memory, std::size_t /*bytes*/) { std::free(memory); }

void begin_process() { std::set_new_handler(end_before_main); }

#ifdef __ELF__
// Libraries allocate in their initialisers, which run before those of the program.
[[gnu::section(".preinit_array"), gnu::used]] void (*const kBeginProcess)() = begin_process;
#endif

}  // namespace

void begin_to_throw_without_memory() {
  main_process = ::getpid();
  std::set_terminate(end_uncaught);
  std::set_new_handler(throw_without_memory);
  mp_set_memory_functions(allocate, reallocate, release);
}

void keep_last_words(std::string lines) {
  auto kept = lines.empty() ? nullptr : std::make_unique<std::string>(std::move(lines));
  const std::unique_ptr<std::string> before(last_words.exchange(kept.release()));
}

void say_last_words() noexcept {
  if (::getpid() != main_process) return;
  if (const std::string* lines = last_words.exchange(nullptr)) say(*lines);
}

void end_without_memory() noexcept {
  say_last_words();
  say_memory_is_used_up(logs_json());
  if (::getpid() == main_process) remove_temporary_files();
  ::_exit(static_cast<int>(ExitCode::internal));
}

}  // namespace oriel::cli
