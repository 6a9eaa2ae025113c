#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::string city(int count) {
  std::vector<std::string> ids;
  for (int i = 0; i < count; ++i) ids.push_back(fmt::format("cube-{}", i));
  return cube_lines(ids);
}

/// `text` with one in a hundred lines cut off, from the 50th on.
std::string with_broken_lines(const std::string& text) {
  std::string broken;
  std::size_t number = 0;
  for (std::size_t from = 0; from < text.size(); ++number) {
    const std::size_t to = text.find('\n', from) + 1;
    broken += number % 100 == 50 ? text.substr(from, 40) + "\n" : text.substr(from, to - from);
    from = to;
  }
  return broken;
}

std::vector<std::string> label(const Folder& folder, const std::string& input) {
  return {"label", input, "-o", folder / "out.city.jsonl", "--status", folder / "s", "--resume"};
}

/// Labels until there is something in the output, and is killed.
void kill_at_work(const std::vector<std::string>& arguments, const Folder& folder) {
  const Outcome outcome =
      run(arguments, {.signal = SIGKILL, .watched = folder.path(), .watched_name = "s.journal"});
  REQUIRE(outcome.exit == 128 + SIGKILL);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("of a city with one broken record in a hundred all others are labelled") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", with_broken_lines(city(1000)));
    const Outcome outcome =
        run({"label", input, "-o", folder / "out.city.jsonl", "--status", folder / "s", "-j", "2"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("990 of 1000 buildings labelled"));
    const json status = json::parse(bytes_of(folder / "s.status.json"));
    CHECK(status["records"] ==
          json{{"read", 1001}, {"passed_on", 991}, {"refused", 10}, {"not_selected", 0}});
    CHECK(status["quarantined_records"] == 10);
    CHECK(status["quarantined_by_code"] == json{{"E105", 10}});
    const json& out = status["outputs"][folder / "out.city.jsonl"];
    CHECK(out["lines"] == 991);
    CHECK(out["bytes"] == bytes_of(folder / "out.city.jsonl").size());
    CHECK(status["outputs"][folder / "s.quarantine.jsonl"]["lines"] == 10);
    CHECK(status["input_sha256"][input].get<std::string>().size() == 64);
    CHECK(status["program_sha256"].get<std::string>().size() == 64);
  }

  TEST_CASE("the hashes of a status are those of the files") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", city(3));
    run({"label", input, "-o", folder / "out.city.jsonl", "--status", folder / "a"});
    run({"cat", folder / "out.city.jsonl", "-o", folder / "again.city.jsonl", "--status",
         folder / "b"});
    const json a = json::parse(bytes_of(folder / "a.status.json")),
               b = json::parse(bytes_of(folder / "b.status.json"));
    const std::string out = folder / "out.city.jsonl";
    CHECK(a["outputs"][out]["sha256"] == b["input_sha256"][out]);
    CHECK(a["outputs"][out] == b["outputs"][folder / "again.city.jsonl"]);
  }

  TEST_CASE("a run that was killed goes on and its files are those of a whole run") {
    const Folder folder, whole;
    const std::string input = folder.write("in.city.jsonl", with_broken_lines(city(3000)));
    auto arguments = label(folder, input);
    kill_at_work(arguments, folder);
    CHECK(!std::filesystem::exists(folder / "out.city.jsonl"));
    const Outcome again = run(arguments);
    CHECK(again.exit == 3);
    CHECK(run(label(whole, input)).exit == 3);
    CHECK(bytes_of(folder / "out.city.jsonl") == bytes_of(whole / "out.city.jsonl"));
    CHECK(bytes_of(folder / "s.quarantine.jsonl") == bytes_of(whole / "s.quarantine.jsonl"));
    CHECK(folder.names() == std::vector<std::string>{"in.city.jsonl", "out.city.jsonl",
                                                     "s.quarantine.jsonl", "s.status.json"});
  }

  TEST_CASE("a run with a status goes on though it was not told so when it began") {
    const Folder folder, whole;
    const std::string input = folder.write("in.city.jsonl", with_broken_lines(city(3000)));
    const auto resumed = label(folder, input);
    auto begun = resumed;
    begun.pop_back();
    const auto is_begun = [&] {
      return bytes_of(folder / "s.journal").find("\"records\":2") != std::string::npos;
    };
    for (int i = 0; i == 0 || (i < 50 && !is_begun()); ++i) {
      std::filesystem::remove(folder / "s.journal");
      kill_at_work(begun, folder);
    }
    REQUIRE(is_begun());
    CHECK(folder.names() == std::vector<std::string>{"in.city.jsonl", "out.city.jsonl.partial",
                                                     "s.journal", "s.quarantine.jsonl.partial"});
    const Outcome again = run(resumed);
    CHECK(again.exit == 3);
    CHECK(again.says("resumes after"));
    CHECK(run(label(whole, input)).says("there is nothing to resume from"));
    CHECK(bytes_of(folder / "out.city.jsonl") == bytes_of(whole / "out.city.jsonl"));
    CHECK(bytes_of(folder / "s.quarantine.jsonl") == bytes_of(whole / "s.quarantine.jsonl"));
    CHECK(folder.names() == std::vector<std::string>{"in.city.jsonl", "out.city.jsonl",
                                                     "s.quarantine.jsonl", "s.status.json"});
    // Without --resume all is done anew, also beside what another run has left.
    folder.write("out.city.jsonl.tmp-4194304-0", "{");
    kill_at_work(begun, folder);
    CHECK(run(begun).exit == 3);
    CHECK(folder.names() == std::vector<std::string>{"in.city.jsonl", "out.city.jsonl",
                                                     "s.quarantine.jsonl", "s.status.json"});
    CHECK(bytes_of(folder / "out.city.jsonl") == bytes_of(whole / "out.city.jsonl"));
  }

  TEST_CASE("the exit code of a run that is over is not any number in its status") {
    const Folder folder;
    const auto arguments = label(folder, folder.write("in.city.jsonl", city(5)));
    CHECK(run(arguments).exit == 0);
    const std::string status = bytes_of(folder / "s.status.json");
    for (const char* code : {"77", "3", "-1", "\"0\"", "1e300"}) {
      CAPTURE(std::string(code));
      folder.write("s.status.json",
                   replaced(status, "\"exit_code\": 0", std::string("\"exit_code\": ") + code));
      const Outcome again = run(arguments);
      CHECK(again.exit == 0);
      CHECK(again.says("5 of 5 buildings labelled"));
    }
    CHECK(run(arguments).says("there is nothing left to do"));
  }

  TEST_CASE("a run does not write what another one is writing") {
    const Folder folder;
    auto arguments = label(folder, folder.write("in.city.jsonl", city(5)));
    arguments.pop_back();
    for (const auto& [name, shown] : {std::pair("s.journal", "s.journal"),
                                      std::pair("out.city.jsonl.partial", "out.city.jsonl")}) {
      CAPTURE(std::string(name));
      const std::string path = folder.write(name, "of another");
      const int other = ::open(path.c_str(), O_RDWR);
      REQUIRE(::flock(other, LOCK_EX) == 0);
      const Outcome refused = run(arguments);
      CHECK(refused.exit == 6);
      CHECK(refused.says(std::string(shown) +
                         ": E601 cannot be written: another process is writing it"));
      CHECK(bytes_of(path) == "of another");
      ::close(other);
      CHECK(run(arguments).exit == 0);
    }
  }

  TEST_CASE("a run that is over is not run again unless an input or output has changed") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", city(5));
    const auto arguments = label(folder, input);
    CHECK(run(arguments).says("5 of 5 buildings labelled"));
    CHECK(run(arguments).says("there is nothing left to do: the run was complete"));
    folder.write("out.city.jsonl", "changed");
    CHECK(run(arguments).says("5 of 5 buildings labelled"));
    folder.write("in.city.jsonl", city(6));
    CHECK(run(arguments).says("6 of 6 buildings labelled"));
  }

  TEST_CASE("a run that is over is run again with other corrections") {
    const Folder folder;
    const std::string correction =
        R"({"building": "cube-1", "feature": "none", "class": "door", "by": "ada", "why": "seen"})";
    auto arguments = label(folder, folder.write("in.city.jsonl", city(5)));
    arguments.insert(arguments.end(),
                     {"--corrections", folder.write("c.jsonl", correction + "\n")});
    CHECK(run(arguments).says("5 of 5 buildings labelled"));
    CHECK(run(arguments).says("there is nothing left to do: the run was complete"));
    folder.write("c.jsonl", replaced(correction, "cube-1", "cube-2") + "\n");
    CHECK(run(arguments).says("5 of 5 buildings labelled"));
  }

  TEST_CASE("a run that was killed while its files came to their places loses nothing") {
    const std::string text = with_broken_lines(city(120));
    const auto label_in = [&](const Folder& folder) {
      auto arguments = label(folder, folder.write("in.city.jsonl", text));
      arguments.insert(arguments.end(), {"--features", folder / "parts.csv"});
      return arguments;
    };
    const Folder whole;
    CHECK(run(label_in(whole)).exit == 3);
    // At each of them something else is in its place already.
    for (const char* name : {"out.city.jsonl", "parts.csv", "s.quarantine.jsonl"})
      for (int i = 0; i < 5; ++i) {
        CAPTURE(name);
        const Folder folder;
        const auto arguments = label_in(folder);
        run(arguments, {.signal = SIGKILL, .watched = folder.path(), .watched_name = name});
        CHECK(run(arguments).exit == 3);
        CHECK(folder.names() == whole.names());
        for (const char* file : {"out.city.jsonl", "parts.csv"})
          CHECK(bytes_of(folder / file) == bytes_of(whole / file));
        CHECK(json::parse(bytes_of(folder / "s.status.json"))["quarantined_records"] == 1);
        CHECK(bytes_of(folder / "s.quarantine.jsonl").size() > 100);
      }
  }

  TEST_CASE("a run does not go on with another command or another input") {
    const Folder folder;
    const std::string text = city(3000), input = folder.write("in.city.jsonl", text);
    auto arguments = label(folder, input);
    // Until the header and at least one feature were done by then.
    const auto is_begun = [&] {
      return bytes_of(folder / "s.journal").find("\"records\":2") != std::string::npos;
    };
    for (int i = 0; i == 0 || (i < 50 && !is_begun()); ++i) {
      std::filesystem::remove(folder / "s.journal");
      kill_at_work(arguments, folder);
    }
    REQUIRE(is_begun());
    auto other = arguments;
    other.insert(other.end(), {"--weld", "0.002"});
    const Outcome refused = run(other);
    CHECK(refused.exit == 5);
    CHECK(refused.says("s.journal: E117 belongs to another command"));
    folder.write("in.city.jsonl", replaced(text, "4000", "4001"));
    const Outcome changed = run(arguments);
    CHECK(changed.exit == 5);
    CHECK(changed.says("E117 does not begin as it did"));
    std::filesystem::remove(folder / "s.journal");
    CHECK(run(arguments).exit == 0);
  }

  TEST_CASE("a journal with what oriel does not write is refused and named") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", city(3));
    for (const char* journal :
         {"{\"state\":5}\n", "{\"state\":{}}\n", "{\"done\":{\"x\":1}}\n", "{\"read\":[7]}\n",
          "{\"done\":{\"x\":{\"bytes\":1e300,\"lines\":1,\"sha256\":\"\"}}}\n",
          "{\"state\":{\"command\":[],\"input\":-1}}\n"}) {
      CAPTURE(std::string(journal));
      folder.write("s.journal", journal);
      const Outcome refused = run(label(folder, input));
      CHECK(refused.exit == 5);
      CHECK(refused.says("s.journal: E117 is damaged"));
    }
    folder.write("s.status.json", "{\"command_sha256\":5}");
    std::filesystem::remove(folder / "s.journal");
    CHECK(run(label(folder, input)).exit == 0);
  }

  TEST_CASE("records whose source is the same are taken from an earlier run") {
    const Folder folder, whole;
    const std::string text = with_broken_lines(city(120));
    // One is changed, one is gone, one is new, and the order is another.
    std::string changed = replaced(text, "cube-7\"", "cube-seven\"");
    changed = replaced(changed, "cube-7\"", "cube-seven\"");
    const std::size_t gone = changed.find('\n', 9000) + 1;
    changed.erase(gone, changed.find('\n', gone) + 1 - gone);
    const std::string head = changed.substr(0, changed.find('\n') + 1),
                      extra = replaced(replaced(city(1), "cube-0\"", "new\""), "cube-0\"", "new\"");
    changed = head + extra.substr(extra.find('\n') + 1) + changed.substr(head.size());
    const auto label = [&](const Folder& to, const std::string& lines,
                           const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"label",      to.write("in.city.jsonl", lines),
                                         "-o",         to / "out.city.jsonl",
                                         "--features", to / "parts.csv",
                                         "--status",   to / "s"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return run(arguments);
    };
    const std::vector<std::string> reuse{"--reuse", folder / "s.status.json"};
    const Outcome first = label(folder, text, reuse);
    CHECK(first.exit == 3);
    CHECK(first.says("E124"));
    CHECK(first.says("took 0 records"));
    CHECK(label(whole, changed, {}).exit == 3);
    for (const std::vector<std::string>& how :
         {std::vector<std::string>{}, {"-j2"}, {"--isolate"}}) {
      auto more = reuse;
      more.insert(more.end(), how.begin(), how.end());
      const Outcome again = label(folder, changed, more);
      CHECK(again.exit == 3);
      CHECK(!again.says("E124"));
      CHECK(again.says(how.empty() ? "took 117 records" : "took 119 records"));
      for (const char* name : {"out.city.jsonl", "parts.csv"})
        CHECK(bytes_of(folder / name) == bytes_of(whole / name));
      const json a = json::parse(bytes_of(folder / "s.status.json")),
                 b = json::parse(bytes_of(whole / "s.status.json"));
      for (const char* name : {"records", "buildings", "set_aside", "features"})
        CHECK(a[name] == b[name]);
    }
    // Of other options, or an output that is not what it was, nothing is taken.
    CHECK(label(folder, changed, {reuse[0], reuse[1], "--value-rel", "0.02"}).says("took 0 "));
    CHECK(label(folder, changed, reuse).says("E124"));
    CHECK(label(folder, changed, reuse).says("took 119 records"));
    folder.write("parts.csv", "changed");
    CHECK(label(folder, changed, reuse).says("has changed since"));
    CHECK(bytes_of(folder / "parts.csv") == bytes_of(whole / "parts.csv"));
  }

  TEST_CASE("taking from an earlier run needs a status and outputs of lines") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", city(2)), out = folder / "o.city.jsonl";
    CHECK(run({"label", input, "-o", out, "--reuse", "s.status.json"}).exit == 2);
    CHECK(run({"label", input, "-o", out, "--features", folder / "f.json", "--status", folder / "s",
               "--reuse", folder / "s.status.json"})
              .exit == 2);
    CHECK(
        run({"label", input, "--status", folder / "s", "--reuse", folder / "s.status.json"}).exit ==
        2);
  }

  TEST_CASE("resuming needs a status and outputs that are files") {
    const std::string input = sample("hip");
    CHECK(run({"label", input, "--resume"}).exit == 2);
    const Folder folder;
    CHECK(run({"label", input, "--resume", "--status", folder / "s"}).exit == 2);
    CHECK(run({"label", input, "--resume", "--status", folder / "s", "-o", "-"}).exit == 2);
  }
}
