#include "tests/studio/server/raw_request.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using nlohmann::json;
using oriel::test::answer_to;
using oriel::test::body_in;
using oriel::test::status_in;

namespace {

namespace fs = std::filesystem;

const std::string kHouse = ORIEL_SOURCE_DIR "/examples/samples/house.stripped.city.json";

/// A folder that goes with the test.
class StudioFolder {
 public:
  StudioFolder() {
    std::string name = (fs::temp_directory_path() / "oriel-studio-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~StudioFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  StudioFolder(const StudioFolder&) = delete;
  StudioFolder& operator=(const StudioFolder&) = delete;

  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// `oriel studio` as somebody starts it, with what it prints in files of the folder.
class StudioCommand {
 public:
  explicit StudioCommand(const StudioFolder& folder, const std::string& name,
                         const std::vector<std::string>& words)
      : out_(folder / (name + ".out")), err_(folder / (name + ".err")) {
    std::vector<std::string> line{ORIEL_COMMAND, "studio", "--no-browser", "-j", "1"};
    line.insert(line.end(), words.begin(), words.end());
    std::vector<char*> arguments;
    for (std::string& word : line) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    const int how = O_WRONLY | O_CREAT | O_TRUNC;
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_.c_str(), how, 0600);
    ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err_.c_str(), how, 0600);
    REQUIRE(::posix_spawn(&process_, ORIEL_COMMAND, &files, nullptr, arguments.data(), environ) ==
            0);
    ::posix_spawn_file_actions_destroy(&files);
    read_address();
  }
  ~StudioCommand() {
    if (is_running_) ::kill(process_, SIGKILL);
    if (is_running_) ::waitpid(process_, nullptr, 0);
  }
  StudioCommand(const StudioCommand&) = delete;
  StudioCommand& operator=(const StudioCommand&) = delete;

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::string says() const { return text_of(err_); }

  /// The answer to a verb, with its status. A request that a dying worker took is made again, as
  /// the page does.
  [[nodiscard]] std::pair<int, json> ask(const std::string& verb, const json& body) const {
    const std::string text = body.dump();
    const std::string request = fmt::format(
        "POST /api/{} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX-Oriel-Token: {}\r\n"
        "Content-Type: application/json\r\nContent-Length: {}\r\n\r\n{}",
        verb, port_, token_, text.size(), text);
    std::string answer;
    for (int i = 0; i < 50 && answer.empty(); ++i) answer = answer_to(port_, request);
    return {status_in(answer), json::parse(body_in(answer), nullptr, false)};
  }

  [[nodiscard]] pid_t worker() const {
    std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", process_));
    pid_t child = 0;
    children >> child;
    return child;
  }

  /// The exit code after a signal; 128 + a signal that ended it.
  int end_by(int signal) {
    ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    is_running_ = false;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  static std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void read_address() {
    for (int i = 0; i < 1000 && token_.empty(); ++i) {
      const std::string text = text_of(out_);
      const std::string begin = "http://127.0.0.1:", middle = "/?token=";
      if (text.starts_with(begin) && text.ends_with('\n')) {
        const std::size_t at = text.find(middle);
        REQUIRE(at != std::string::npos);
        port_ = std::atoi(text.c_str() + begin.size());
        token_ = text.substr(at + middle.size());
        token_.pop_back();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    REQUIRE_FALSE(token_.empty());
  }

  std::string out_, err_, token_;
  pid_t process_ = 0;
  int port_ = 0;
  bool is_running_ = true;
};

}  // namespace

TEST_SUITE("studio/server") {
  TEST_CASE("oriel studio prints its address and answers until Ctrl-C") {
    const StudioFolder folder;
    StudioCommand studio(folder, "studio", {kHouse});
    CHECK(status_in(answer_to(studio.port(), "GET / HTTP/1.1\r\nHost: x\r\n\r\n")) == 403);
    CHECK(studio.ask("state", json::object()).first == 200);
    CHECK(studio.ask("nothing", json::object()).first == 404);
    CHECK(studio.ask("state", json::array()).first == 400);
    CHECK(studio.ask("__proto__", json::object()).first == 404);
    const pid_t worker = studio.worker();
    CHECK(worker > 0);
    CHECK(studio.end_by(SIGINT) == 0);
    CHECK(::kill(worker, 0) != 0);
    CHECK(studio.says().find("[warning] studio: refused: method=GET path=/ status=403\n") !=
          std::string::npos);
  }

  TEST_CASE("a studio whose worker was killed goes on with another one") {
    const StudioFolder folder;
    StudioCommand studio(folder, "studio", {kHouse});
    CHECK(studio.ask("state", json::object()).first == 200);
    const pid_t worker = studio.worker();
    ::kill(worker, SIGKILL);
    CHECK(studio.ask("state", json::object()).first == 200);
    CHECK(studio.worker() != worker);
    CHECK(studio.says().find("signal 9 (SIGKILL)") != std::string::npos);
    CHECK(studio.end_by(SIGTERM) == 0);
  }

  TEST_CASE("of two studios on one pack neither overwrites what the other saved") {
    const StudioFolder folder;
    const std::string pack = folder / "pack.yaml",
                      text =
                          "schema: oriel/1\npack: {name: mine, version: 1.0.0}\n"
                          "classes: {window: {}}\n";
    std::ofstream(pack) << text;
    StudioCommand one(folder, "one", {kHouse, "--rules", pack}),
        two(folder, "two", {kHouse, "--rules", pack});
    const std::string hash = one.ask("state", json::object()).second["pack"]["hash"];
    CHECK(two.ask("state", json::object()).second["pack"]["hash"] == hash);
    CHECK(one.ask("save", {{"text", text + "# one\n"}, {"hash", hash}}).first == 200);
    const json disk = two.ask("disk", json::object()).second;
    CHECK(disk["is_changed"] == true);
    const auto [status, refusal] = two.ask("save", {{"text", text + "# two\n"}, {"hash", hash}});
    CHECK(status == 409);
    CHECK(refusal["disk_text"] == text + "# one\n");
    CHECK(two.ask("save", {{"text", text + "# two\n"}, {"hash", refusal["disk_hash"]}}).first ==
          200);
    CHECK(one.ask("disk", json::object()).second["is_changed"] == true);
  }

  TEST_CASE("a page saves only in the folders that its studio was given") {
    const StudioFolder folder, other;
    fs::copy_file(kHouse, folder / "house.city.json");
    StudioCommand studio(folder, "studio", {folder / "house.city.json"});
    const json body{{"text", "a"}, {"hash", ""}};
    for (const std::string& path : {other / "pack.yaml", folder / "../pack.yaml",
                                    std::string("/etc/pack.yaml"), std::string("/dev/null")}) {
      CAPTURE(path);
      json more = body;
      more["path"] = path;
      more["force"] = true;
      CHECK(studio.ask("save", more).first >= 400);
      CHECK_FALSE(fs::exists(other / "pack.yaml"));
    }
    json good = body;
    good["path"] = folder / "pack.yaml";
    CHECK(studio.ask("save", good).first == 200);
    CHECK(fs::exists(folder / "pack.yaml"));
  }

  TEST_CASE("a program without its HTTP module does all but the studio") {
    const StudioFolder folder;
    fs::create_directory(folder / "bin");
    fs::copy_file(ORIEL_COMMAND, folder / "bin/oriel");
    const auto status_of = [&](const std::string& words) {
      const std::string line =
          fmt::format("'{}' {} >'{}' 2>&1", folder / "bin/oriel", words, folder / "said");
      return WEXITSTATUS(std::system(line.c_str()));
    };
    CHECK(status_of("--version") == 0);
    CHECK(status_of(fmt::format("studio --no-browser '{}'", kHouse)) == 5);
    std::ifstream said(folder / "said");
    const std::string text{std::istreambuf_iterator<char>(said), {}};
    CHECK(text.find(
              "oriel/studio/oriel-http.so: E101 the part of oriel that serves its studio cannot be "
              "loaded: there is no such file; install oriel again") != std::string::npos);
    CHECK(text.find("http://") == std::string::npos);
  }
}
