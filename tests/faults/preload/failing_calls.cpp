// A library to be loaded before all others (LD_PRELOAD) that makes calls of the system fail, so
// that tests see what a command does then. From main() to its end it counts the calls of each
// function.
//
//   ORIEL_FAULT=FUNCTION:N:HOW    the N-th call of FUNCTION fails; N+ : that and all later ones
//   ORIEL_FAULT_COUNTS=FILE       at the end of main FILE gets a line "FUNCTION CALLS" for each
//                                 function, and "at N" for each call of `malloc` that was the first
//                                 from its place in the program
//
// FUNCTION is one of kNames, where `malloc` stands for all that gives memory, `operator new` too.
// HOW is the name of an error (EIO, ENOSPC, EINTR ...), or `short`: a read or write takes half of
// what it was asked for. A program that does not end in time is ended by SIGALRM.

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

enum Function {
  f_malloc,
  f_open,
  f_read,
  f_write,
  f_close,
  f_fsync,
  f_rename,
  f_mkdir,
  f_fork,
  f_poll,
  f_wait,
  f_count
};
constexpr std::array<const char*, f_count> kNames{
    "malloc", "open", "read", "write", "close", "fsync", "rename", "mkdir", "fork", "poll", "wait"};
constexpr unsigned kMostSeconds = 60;

struct Plan {
  int function = -1;
  long at = 0;
  bool is_lasting = false;
  bool is_short = false;
  int error = 0;
};

bool is_counting = false;
Plan plan;
std::array<std::atomic<long>, f_count> calls{};

/// Places that asked for memory, by the address that a call returns to, and their first calls.
struct Place {
  std::atomic<std::uintptr_t> address{0};
  long first_call = 0;
};
constexpr std::size_t kPlaces = 1 << 16;
std::array<Place, kPlaces> places;
bool is_keeping_places = false;

void note_place(const void* caller, long call) {
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  for (std::size_t i = (address >> 1U) * 0x9E3779B97F4A7C15U >> 48U;; i = (i + 1) % kPlaces) {
    std::uintptr_t found = 0;
    if (places[i].address.compare_exchange_strong(found, address)) {
      places[i].first_call = call;
      return;
    }
    if (found == address) return;
  }
}

int error_named(const char* name) {
  constexpr std::array<std::pair<const char*, int>, 7> kErrors{{{"EIO", EIO},
                                                                {"ENOSPC", ENOSPC},
                                                                {"EINTR", EINTR},
                                                                {"EMFILE", EMFILE},
                                                                {"EACCES", EACCES},
                                                                {"EAGAIN", EAGAIN},
                                                                {"ENOMEM", ENOMEM}}};
  for (const auto& [known, error] : kErrors)
    if (std::strcmp(known, name) == 0) return error;
  return 0;
}

/// Ends the program where the test asks for what there is not.
void read_plan() {
  const char* text = std::getenv("ORIEL_FAULT");
  is_keeping_places = std::getenv("ORIEL_FAULT_COUNTS") != nullptr;
  if (text == nullptr) return;
  for (int f = 0; f < f_count; ++f) {
    const std::size_t length = std::strlen(kNames[static_cast<std::size_t>(f)]);
    if (std::strncmp(text, kNames[static_cast<std::size_t>(f)], length) == 0 &&
        text[length] == ':') {
      plan.function = f;
      text += length + 1;
      break;
    }
  }
  char* rest = nullptr;
  plan.at = std::strtol(text, &rest, 10);
  plan.is_lasting = *rest == '+';
  if (plan.is_lasting) ++rest;
  if (*rest == ':') ++rest;
  plan.is_short = std::strcmp(rest, "short") == 0;
  plan.error = error_named(rest);
  if (plan.function < 0 || plan.at < 1 || (plan.error == 0 && !plan.is_short)) ::_exit(125);
}

/// Counts a call; true if it is to fail, with errno set.
bool fails(Function function, const void* caller = nullptr) {
  if (!is_counting) return false;
  const long call = ++calls[function];
  if (caller != nullptr && is_keeping_places) note_place(caller, call);
  if (plan.function != function) return false;
  if (call != plan.at && !(plan.is_lasting && call > plan.at)) return false;
  errno = plan.error;
  return true;
}

using Main = int (*)(int, char**, char**);

/// The functions that are replaced here. All are looked up before the first is called: dlsym asks
/// for memory itself, and does not bear to be called again by what gives it.
struct Real {
  void* (*malloc)(std::size_t) = nullptr;
  void* (*calloc)(std::size_t, std::size_t) = nullptr;
  void* (*realloc)(void*, std::size_t) = nullptr;
  void* (*memalign)(std::size_t, std::size_t) = nullptr;
  int (*open)(const char*, int, ...) = nullptr;
  FILE* (*fopen64)(const char*, const char*) = nullptr;
  ssize_t (*read)(int, void*, std::size_t) = nullptr;
  ssize_t (*pread)(int, void*, std::size_t, off_t) = nullptr;
  ssize_t (*write)(int, const void*, std::size_t) = nullptr;
  ssize_t (*writev)(int, const iovec*, int) = nullptr;
  int (*close)(int) = nullptr;
  int (*fclose)(FILE*) = nullptr;
  int (*rename)(const char*, const char*) = nullptr;
  int (*mkdir)(const char*, mode_t) = nullptr;
  pid_t (*fork)() = nullptr;
  int (*poll)(pollfd*, nfds_t, int) = nullptr;
  pid_t (*waitpid)(pid_t, int*, int) = nullptr;
  int (*start_main)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*) = nullptr;
  bool is_known = false;
};

template <class Call>
void find(Call& call, const char* name) {
  call = reinterpret_cast<Call>(::dlsym(RTLD_NEXT, name));
}

const Real& real() {
  static Real all;
  if (all.is_known) return all;
  all.is_known = true;
  find(all.malloc, "malloc");
  find(all.calloc, "calloc");
  find(all.realloc, "realloc");
  find(all.memalign, "memalign");
  find(all.open, "open");
  find(all.fopen64, "fopen64");
  find(all.read, "read");
  find(all.pread, "pread");
  find(all.write, "write");
  find(all.writev, "writev");
  find(all.close, "close");
  find(all.fclose, "fclose");
  find(all.rename, "rename");
  find(all.mkdir, "mkdir");
  find(all.fork, "fork");
  find(all.poll, "poll");
  find(all.waitpid, "waitpid");
  find(all.start_main, "__libc_start_main");
  return all;
}

void write_counts(const char* path) {
  const int file = static_cast<int>(::syscall(SYS_open, path, O_WRONLY | O_CREAT | O_TRUNC, 0666));
  std::array<char, 64> line{};
  const auto put = [&](int length) { ::syscall(SYS_write, file, line.data(), length); };
  for (std::size_t f = 0; f < f_count; ++f)
    put(std::snprintf(line.data(), line.size(), "%s %ld\n", kNames[f], calls[f].load()));
  for (const Place& place : places)
    if (place.first_call > 0)
      put(std::snprintf(line.data(), line.size(), "at %ld\n", place.first_call));
  ::syscall(SYS_close, file);
}

Main real_main = nullptr;

/// What goes before main and after it is the loader's and the libraries' own.
int counted_main(int argc, char** argv, char** environment) {
  ::alarm(kMostSeconds);
  read_plan();
  is_counting = true;
  const int code = real_main(argc, argv, environment);
  is_counting = false;
  if (const char* path = std::getenv("ORIEL_FAULT_COUNTS")) write_counts(path);
  return code;
}

void* allocated(std::size_t size, const void* caller) {
  const auto next = real().malloc;
  return fails(f_malloc, caller) ? nullptr : next(size);
}

void* allocated(std::size_t size, std::size_t alignment, const void* caller) {
  const auto next = real().memalign;
  return fails(f_malloc, caller) ? nullptr : next(alignment, size);
}

void* or_throw(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

ssize_t half_of(std::size_t size) { return static_cast<ssize_t>(size < 2 ? size : size / 2); }

}  // namespace

#define CALLER __builtin_return_address(0)

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
  real_main = main;
  return real().start_main(counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}

void* malloc(std::size_t size) noexcept { return allocated(size, CALLER); }

void* calloc(std::size_t count, std::size_t size) noexcept {
  const auto next = real().calloc;
  return fails(f_malloc, CALLER) ? nullptr : next(count, size);
}

void* realloc(void* old, std::size_t size) noexcept {
  const auto next = real().realloc;
  return fails(f_malloc, CALLER) ? nullptr : next(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return allocated(size, alignment, CALLER);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return allocated(size, alignment, CALLER);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  *memory = allocated(size, alignment, CALLER);
  return *memory == nullptr ? ENOMEM : 0;
}

int open(const char* path, int flags, ...) {
  const auto next = real().open;
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return fails(f_open) ? -1 : next(path, flags, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  const auto next = real().fopen64;
  return fails(f_open) ? nullptr : next(path, mode);
}

ssize_t read(int file, void* bytes, std::size_t size) {
  const auto next = real().read;
  if (!fails(f_read)) return next(file, bytes, size);
  return plan.is_short ? next(file, bytes, static_cast<std::size_t>(half_of(size))) : -1;
}

ssize_t pread(int file, void* bytes, std::size_t size, off_t at) {
  const auto next = real().pread;
  if (!fails(f_read)) return next(file, bytes, size, at);
  return plan.is_short ? next(file, bytes, static_cast<std::size_t>(half_of(size)), at) : -1;
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  const auto next = real().write;
  if (!fails(f_write)) return next(file, bytes, size);
  return plan.is_short ? next(file, bytes, static_cast<std::size_t>(half_of(size))) : -1;
}

ssize_t writev(int file, const iovec* pieces, int count) {
  const auto next = real().writev;
  if (!fails(f_write)) return next(file, pieces, count);
  return plan.is_short ? next(file, pieces, 1) : -1;
}

int close(int file) {
  const auto next = real().close;
  const bool is_failing = fails(f_close);
  const int reason = errno, result = next(file);  // Linux closes it all the same
  if (!is_failing) return result;
  errno = reason;
  return -1;
}

int fclose(FILE* file) {
  const auto next = real().fclose;
  const bool is_failing = fails(f_close);
  const int reason = errno, result = next(file);
  if (!is_failing) return result;
  errno = reason;
  return EOF;
}

/// The disk itself has no say: tests run often.
int fsync(int /*file*/) { return fails(f_fsync) ? -1 : 0; }

int rename(const char* from, const char* to) noexcept {
  const auto next = real().rename;
  return fails(f_rename) ? -1 : next(from, to);
}

int mkdir(const char* path, mode_t mode) noexcept {
  const auto next = real().mkdir;
  return fails(f_mkdir) ? -1 : next(path, mode);
}

pid_t fork() noexcept {
  const auto next = real().fork;
  return fails(f_fork) ? -1 : next();
}

int poll(pollfd* files, nfds_t count, int milliseconds) {
  const auto next = real().poll;
  return fails(f_poll) ? -1 : next(files, count, milliseconds);
}

pid_t waitpid(pid_t process, int* status, int options) {
  const auto next = real().waitpid;
  return fails(f_wait) ? -1 : next(process, status, options);
}

}  // extern "C"

void* operator new(std::size_t size) { return or_throw(allocated(size, CALLER)); }
void* operator new[](std::size_t size) { return or_throw(allocated(size, CALLER)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocated(size, CALLER);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocated(size, CALLER);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return or_throw(allocated(size, static_cast<std::size_t>(alignment), CALLER));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return or_throw(allocated(size, static_cast<std::size_t>(alignment), CALLER));
}
