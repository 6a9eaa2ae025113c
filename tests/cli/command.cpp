#include "tests/cli/command.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <pty.h>
#include <sstream>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace oriel::test {

namespace fs = std::filesystem;

namespace {

/// A file without a name.
int scratch(const std::string& bytes = "") {
  std::FILE* file = std::tmpfile();
  if (file == nullptr) throw std::runtime_error("no temporary file");
  const int descriptor = ::dup(::fileno(file));
  std::fclose(file);
  if (::write(descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("a temporary file cannot be written");
  ::lseek(descriptor, 0, SEEK_SET);
  return descriptor;
}

std::string content(int descriptor) {
  ::lseek(descriptor, 0, SEEK_SET);
  std::string bytes;
  std::array<char, 65536> block{};
  for (ssize_t n = 0; (n = ::read(descriptor, block.data(), block.size())) > 0;)
    bytes.append(block.data(), static_cast<std::size_t>(n));
  return bytes;
}

int stdout_of(const Surroundings& around) {
  if (!around.stdout_file.empty()) return ::open(around.stdout_file.c_str(), O_WRONLY);
  if (!around.has_broken_pipe) return scratch();
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  ::close(ends[0]);
  return ends[1];
}

bool has_file(const fs::path& folder, const std::string& part) {
  return std::ranges::any_of(fs::directory_iterator(folder), [&](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name.find(part) != std::string::npos && !name.ends_with(".new") &&
           !name.ends_with(".partial") &&
           (!name.ends_with(".journal") || bytes_of(entry.path()).size() > 0);
  });
}

/// It may have ended; somebody else will wait for it.
bool has_ended(pid_t child) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == child;
}

void send_signal(pid_t child, const Surroundings& around) {
  for (int i = 0; i < 30000 && !has_file(around.watched, around.watched_name); ++i) {
    if (has_ended(child)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(child, around.signal);
}

void send_signal_to_worker(pid_t child, int signal) {
  const std::string name = std::to_string(child);
  const fs::path list = fs::path("/proc") / name / "task" / name / "children";
  for (int i = 0; i < 30000; ++i) {
    pid_t worker = 0;
    if (std::ifstream(list) >> worker) {
      ::kill(worker, signal);
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

[[noreturn]] void become_oriel(const std::vector<std::string>& arguments,
                               const Surroundings& around) {
  std::vector<char*> argv;
  std::string command = ORIEL_COMMAND;
  argv.push_back(command.data());
  std::vector<std::string> copies = arguments;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  // Whoever runs the tests may ignore signals (nohup, a job in the background).
  for (const int signal : {SIGHUP, SIGINT, SIGPIPE, SIGTERM}) std::signal(signal, SIG_DFL);
  if (around.file_limit > 0) {
    const rlimit limit{around.file_limit, around.file_limit};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (around.memory_limit > 0) {
    const rlimit limit{around.memory_limit, around.memory_limit};
    ::setrlimit(RLIMIT_AS, &limit);
  }
  if (around.cpu_limit_s > 0) {
    const rlimit limit{around.cpu_limit_s, around.cpu_limit_s};
    ::setrlimit(RLIMIT_CPU, &limit);
  }
  if (!around.folder.empty() && ::chdir(around.folder.c_str()) != 0) std::_Exit(127);
  std::vector<std::string> environment = around.environment;
  for (std::string& variable : environment) ::putenv(variable.data());
  ::execv(command.c_str(), argv.data());
  std::_Exit(127);
}

}  // namespace

Outcome run(const std::vector<std::string>& arguments, const Surroundings& around) {
  const int in = scratch(around.in), err = scratch();
  const int out = stdout_of(around);
  int terminal = -1, terminal_end = -1;
  const bool has_terminal = around.has_terminal || around.has_terminal_out;
  if (has_terminal && ::openpty(&terminal, &terminal_end, nullptr, nullptr, nullptr) != 0)
    throw std::runtime_error("no terminal");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    ::dup2(in, STDIN_FILENO);
    ::dup2(around.has_terminal_out ? terminal_end : out, STDOUT_FILENO);
    ::dup2(around.has_terminal ? terminal_end : err, STDERR_FILENO);
    become_oriel(arguments, around);
  }
  if (around.signal != 0) send_signal(child, around);
  if (around.worker_signal != 0) send_signal_to_worker(child, around.worker_signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  Outcome outcome;
  outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (around.stdout_file.empty() && !around.has_broken_pipe) outcome.out = content(out);
  outcome.err = content(err);
  if (has_terminal) {
    ::close(terminal_end);
    (around.has_terminal_out ? outcome.out : outcome.err) = content(terminal);
    ::close(terminal);
  }
  for (const int descriptor : {in, out, err}) ::close(descriptor);
  return outcome;
}

Folder::Folder() {
  std::string name = fs::temp_directory_path() / "oriel-test-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

std::string Folder::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(path_ / name, std::ios::binary) << bytes;
  return path_ / name;
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

std::string bytes_of(const fs::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string sample(const std::string& name) {
  return std::string(ORIEL_SOURCE_DIR) + "/examples/samples/" + name + ".stripped.city.json";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("'" + from + "' is not in the text");
  return text.replace(at, from.size(), to);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace oriel::test
