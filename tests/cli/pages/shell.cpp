#include "tests/cli/pages/shell.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace oriel::test {

namespace fs = std::filesystem;

namespace {

/// Stands before what a command prints, and before its exit code. Nothing prints them: oriel
/// escapes control characters.
constexpr char kBegin = '\x1e';
constexpr char kEnd = '\x1f';

/// The seconds that all commands of a page may take: on a busy machine, under sanitizers.
constexpr int kMostSecondsOfPage = 1200;

const fs::path kSources = ORIEL_SOURCE_DIR;

/// Each command sees as $? how the one before ended.
std::string script_of(const std::vector<std::string>& commands) {
  std::string script = "status=0\n";
  for (const std::string& command : commands)
    script += "printf '\\036'; (exit $status)\neval " + quoted(command) +
              "\nstatus=$?; printf '\\037%d\\n' $status\n";
  return script;
}

std::string output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell");
  std::string output;
  std::array<char, 65536> block{};
  for (std::size_t n = 0; (n = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
    output.append(block.data(), n);
  ::pclose(pipe);
  return output;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + quoted(name) + " >/dev/null 2>&1").c_str()) == 0;
}

Checkout::Checkout() {
  fs::create_directories(path() / "tests");
  fs::create_directories(folder_.path() / "bin");
  for (const char* part : {"examples", "rules", "tests/data", "README.md"})
    fs::copy(kSources / part, path() / part, fs::copy_options::recursive);
  if (fs::exists(kSources / "../shared"))
    fs::create_directory_symlink(kSources / "../shared", folder_.path() / "shared");
  for (const fs::path program : {ORIEL_COMMAND, ORIEL_GENERATE_COMMAND, ORIEL_CUTS_COMMAND})
    fs::create_symlink(program, folder_.path() / "bin" / program.filename());
}

std::vector<Shown> Checkout::run(const std::vector<std::string>& commands) const {
  const std::string script = folder_.write("page.sh", script_of(commands));
  // Lines of stdout must not wait in a buffer while stderr goes past them.
  const std::string output = output_of(
      "cd " + quoted(path()) + " && PATH=" + quoted(folder_ / "bin") +
      ":$PATH LC_ALL=C.UTF-8 ASAN_OPTIONS=$ASAN_OPTIONS:verify_asan_link_order=0 timeout " +
      std::to_string(kMostSecondsOfPage) + " stdbuf -oL bash " + quoted(script) +
      " </dev/null 2>&1");
  std::vector<Shown> shown(commands.size());
  std::size_t at = 0;
  for (Shown& command : shown) {
    const std::size_t begin = output.find(kBegin, at), end = output.find(kEnd, begin);
    if (end == std::string::npos) break;
    command.lines = lines_of(output.substr(begin + 1, end - begin - 1));
    command.exit = std::atoi(output.c_str() + end + 1);
    at = output.find('\n', end);
  }
  return shown;
}

}  // namespace oriel::test
