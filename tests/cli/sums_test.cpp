#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

using Ids = std::vector<std::string>;

std::string doubled(const Ids& ids) { return doubled_cubes(ids).dump(); }

/// A named pipe with `text` in it that never ends.
class EndlessStream {
 public:
  EndlessStream(const std::string& path, const std::string& text) {
    REQUIRE(::mkfifo(path.c_str(), S_IRUSR | S_IWUSR) == 0);
    pipe_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    REQUIRE(::write(pipe_, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  ~EndlessStream() { ::close(pipe_); }
  EndlessStream(const EndlessStream&) = delete;
  EndlessStream& operator=(const EndlessStream&) = delete;

 private:
  int pipe_ = -1;
};

long count_of(const std::string& text, const std::string& word) {
  long count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a warning about several buildings is one line with their number and an example") {
    const Folder folder;
    const std::string city = folder.write("c.city.json", doubled({"a", "b", "c"}));
    const Outcome outcome = run({"label", city, "-o", folder / "o.city.json"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit == 0);
    CHECK(count_of(outcome.err, "E312") == 1);
    CHECK(outcome.says("warning: E312 in 3 buildings, for example " + city +
                       ": a: a ring names a vertex twice in a row"));
    CHECK(outcome.says("--verbose lists all"));
  }

  TEST_CASE("verbose and JSON list every warning") {
    const Folder folder;
    const std::string city = folder.write("c.city.json", doubled({"a", "b", "c"}));
    for (const std::string option : {"--verbose", "--log-json"})
      CHECK(count_of(run({"label", city, "-o", folder / "o.city.json", option}).err, "E312") == 3);
  }

  TEST_CASE("an output that cannot be written does not keep back the sums") {
    const Folder folder;
    const std::string city = folder.write("c.city.json", doubled({"a", "b", "c"}));
    for (const std::string jobs : {"1", "2"}) {
      const Outcome outcome = run({"label", city, "-o", "-", "--to", "cityjson", "--jobs", jobs},
                                  {.stdout_file = "/dev/full"});
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 6);
      CHECK(outcome.says("E601"));
      CHECK(count_of(outcome.err, "warning: E312 in 3 buildings, for example") == 1);
    }
  }

  TEST_CASE("a signal does not keep back the sums so far") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      const Folder folder;
      const std::string whole = folder.write("a.city.jsonl", doubled_cube_lines({"a", "b", "c"}));
      const EndlessStream endless(folder / "b.city.jsonl", cube_lines({}));
      std::filesystem::create_directory(folder / "out");
      const Outcome outcome =
          run({"label", whole, folder / "b.city.jsonl", "-o", folder / "out/"},
              {.signal = signal, .watched = folder / "out", .watched_name = "b.city.jsonl"});
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 128 + signal);
      CHECK(outcome.err == "warning: E312 in 3 buildings, for example " + whole +
                               ":2: a: a ring names a vertex twice in a row; it is read once "
                               "(val3dity 102 CONSECUTIVE_POINTS_SAME)\n");
    }
  }

  TEST_CASE("warnings about one building stay as they are") {
    const Folder folder;
    const std::string city = folder.write("c.city.json", doubled({"a"}));
    const Outcome outcome = run({"label", city, "-o", folder / "o.city.json"});
    CHECK(count_of(outcome.err, "E312") == 1);
    CHECK(!outcome.says("for example"));
    CHECK(!outcome.says("--verbose"));
  }

  TEST_CASE("of many errors of a code the first are listed and files and JSON have all") {
    const Folder folder;
    std::string lines = cube_lines({"a", "b", "c", "d", "e", "f", "g", "h"});
    for (std::size_t at = lines.find("[0,0,0]"); at != std::string::npos;
         at = lines.find("[0,0,0]", at))
      lines.replace(at, 7, "[9000000000000000,0,0]");
    const std::string stream = folder.write("c.city.jsonl", lines);
    const Outcome outcome =
        run({"label", stream, "-o", folder / "o.city.jsonl", "--status", folder / "s"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("3 more of this kind, in 8 buildings altogether"));
    const std::vector<std::string> quarantine = lines_of(bytes_of(folder / "s.quarantine.jsonl"));
    REQUIRE(quarantine.size() == 8);
    for (const std::string& record : quarantine) {
      const auto errors = nlohmann::json::parse(record)["errors"];
      REQUIRE(errors.size() == 1);
      CHECK(errors[0]["code"] == "E506");
    }
    const auto status = nlohmann::json::parse(bytes_of(folder / "s.status.json"));
    CHECK(status["quarantined_by_code"]["E506"] == 8);
    const Outcome json = run({"label", stream, "-o", folder / "o.city.jsonl", "--log-json"});
    CHECK(count_of(json.err, "\"code\":\"E506\"") == 8);
  }
}
