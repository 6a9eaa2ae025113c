#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <cstdlib>
#include <string>
#include <sys/wait.h>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel::test;

namespace {

/// The command with so many kilobytes of address space: its exit code, stderr in the folder.
int exit_with_memory(const Folder& folder, int kilobytes, const std::string& arguments) {
  const std::string line = fmt::format("ulimit -c 0; ulimit -v {}; '{}' {} >/dev/null 2>'{}'",
                                       kilobytes, ORIEL_COMMAND, arguments, folder / "err");
  return WEXITSTATUS(std::system(line.c_str()));  // NOLINT: a shell sets the limit
}

TEST_SUITE("cli") {
  TEST_CASE("too little memory is said and leaves nothing half done") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    MESSAGE("skipped: sanitizers need more address space than there is");
#else
    const Folder folder;
    int said = 0;
    for (int kilobytes = 20'000; kilobytes <= 120'000; kilobytes += 5'000)
      for (const char* jobs : {"1", "2"}) {
        const int exit = exit_with_memory(
            folder, kilobytes,
            fmt::format("label '{}' -j {} -o '{}'", sample("house"), jobs, folder / "o.city.json"));
        const std::string err = bytes_of(folder / "err");
        CAPTURE(kilobytes);
        CAPTURE(err);
        // 127: the system could not load the libraries, and says so itself.
        CHECK((exit == 0 || exit == 1 || exit == 127));
        CHECK_FALSE(err.empty());
        said += err.find("E507") != std::string::npos ? 1 : 0;
        if (exit != 0) CHECK(bytes_of(folder / "o.city.json").empty());
        for (const std::string& name : folder.names())
          CHECK(name.find(".tmp-") == std::string::npos);
        std::filesystem::remove(folder / "o.city.json");
      }
    CHECK(said > 0);
#endif
  }

  TEST_CASE("used-up memory does not keep back the sums so far") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    MESSAGE("skipped: sanitizers need more address space than there is");
#else
    const Folder folder;
    constexpr int kKilobytes = 110'000;
    const std::string lines = doubled_cube_lines({"a", "b", "c"});
    const std::string arguments =
        fmt::format("label '{}' -o '{}'", folder / "c.city.jsonl", folder / "o.city.jsonl");
    folder.write("c.city.jsonl", lines);
    REQUIRE(exit_with_memory(folder, kKilobytes, arguments) == 0);
    // A record that does not fit into the address space.
    folder.write("c.city.jsonl", lines + std::string(64 << 20, ' ') + "{}\n");
    CHECK(exit_with_memory(folder, kKilobytes, arguments) == 1);
    const std::string err = bytes_of(folder / "err");
    CAPTURE(err);
    CHECK(err.find("warning: E312 in 3 buildings, for example") != std::string::npos);
    CHECK(err.find("E507") != std::string::npos);
#endif
  }
}

}  // namespace
