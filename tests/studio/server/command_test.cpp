#include "tests/studio/server/raw_request.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <spawn.h>
#include <string>
#include <sys/resource.h>
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
using oriel::test::RawClient;
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
    return ask_by_text(verb, body.dump());
  }
  [[nodiscard]] std::pair<int, json> ask_by_text(const std::string& verb,
                                                 const std::string& text) const {
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

/// Raises how many descriptors this process may have, until it goes.
class MoreDescriptors {
 public:
  explicit MoreDescriptors(rlim_t count) {
    REQUIRE(::getrlimit(RLIMIT_NOFILE, &before_) == 0);
    const rlimit more{std::max(before_.rlim_cur, count), before_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_NOFILE, &more) == 0);
  }
  ~MoreDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  MoreDescriptors(const MoreDescriptors&) = delete;
  MoreDescriptors& operator=(const MoreDescriptors&) = delete;

 private:
  rlimit before_{};
};

bool is_quick(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::steady_clock::now() - begin < std::chrono::seconds(1);
}

/// An object with a member that has so many levels of lists.
std::string nested(std::size_t levels) {
  return "{\"a\":" + std::string(levels, '[') + std::string(levels, ']') + "}";
}

constexpr const char* kHead = "POST /api/state HTTP/1.1\r\nContent-Length: 9\r\n";

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

  TEST_CASE("a studio answers within a second beside forty clients that send slowly") {
    const StudioFolder folder;
    const StudioCommand studio(folder, "studio", {kHouse});
    std::vector<RawClient> clients;
    for (int i = 0; i < 40; ++i) clients.emplace_back(studio.port()).send(i % 2 == 0 ? "G" : kHead);
    CHECK(is_quick([&] { CHECK(studio.ask("state", json::object()).first == 200); }));
    for (RawClient& client : clients) client.send("E");
    CHECK(is_quick([&] { CHECK(studio.ask("state", json::object()).first == 200); }));
  }

  TEST_CASE("a studio answers within a second beside two thousand connections") {
    const MoreDescriptors room(2200);
    const StudioFolder folder;
    const StudioCommand studio(folder, "studio", {kHouse});
    std::vector<RawClient> clients;
    for (int i = 0; i < 2000; ++i) clients.emplace_back(studio.port());
    CHECK(is_quick([&] { CHECK(studio.ask("state", json::object()).first == 200); }));
  }

  TEST_CASE("a studio refuses a body of four million brackets within a second") {
    const StudioFolder folder;
    const StudioCommand studio(folder, "studio", {kHouse});
    for (const std::string& text : {std::string(4U << 20U, '['), nested(1000), nested(2000)}) {
      std::pair<int, json> answer;
      CHECK(is_quick([&] { answer = studio.ask_by_text("state", text); }));
      CHECK(answer.first == 400);
      CHECK(
          (answer.second["error"] == "the body of the request is nested deeper than 1000 levels"));
    }
    CHECK(studio.ask_by_text("state", nested(999)).first == 200);
  }
}
