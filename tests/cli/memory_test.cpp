#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/shared.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

/// The command with so many kilobytes of address space: its exit code, stderr in the folder.
int exit_with_memory(const Folder& folder, int kilobytes, const std::string& arguments) {
  const std::string line = fmt::format("ulimit -c 0; ulimit -v {}; '{}' {} >/dev/null 2>'{}'",
                                       kilobytes, ORIEL_COMMAND, arguments, folder / "err");
  return WEXITSTATUS(std::system(line.c_str()));  // NOLINT: a shell sets the limit
}

/// The most memory that the command had, in kilobytes; what it writes goes into the folder.
long peak_kilobytes(const Folder& folder, const char* command, const std::string& input) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl(ORIEL_COMMAND, "oriel", command, input.c_str(), "-o",
            (folder / "out.city.json").c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  REQUIRE(::wait4(child, &status, 0, &usage) == child);
  CHECK(WIFEXITED(status));
  CHECK((WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 3));  // 3: some are rejected
  return usage.ru_maxrss;
}

/// A CityJSON with each object so many times; all of them have the same vertices.
std::string with_copies(const std::string& text, int copies) {
  auto file = nlohmann::ordered_json::parse(text);
  std::string objects;
  for (const auto& [id, object] : file["CityObjects"].items()) {
    const std::string member = "\":" + object.dump();
    for (int i = 0; i < copies; ++i) objects += fmt::format(R"(,"{}_{}{})", id, i, member);
  }
  file["CityObjects"] = nullptr;
  std::string whole = file.dump();
  const std::string_view place = R"("CityObjects":null)";
  whole.replace(whole.find(place), place.size(), R"("CityObjects":{)" + objects.substr(1) + '}');
  return whole;
}

/// A building as photogrammetry gives it, as CityJSON: a rough roof of 2 `across`² triangles over
/// upright walls, of which each triangle at the eaves has a strip.
std::string rough_mesh(int across) {
  const int side = across + 1;
  std::string vertices, faces, ground;
  const auto append = [](std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ",") + item;
  };
  std::uint32_t noise = 1;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      noise = noise * 1664525 + 1013904223;  // Numerical Recipes
      const int step = (i / 7 + j / 7) % 2 * 800;
      append(vertices, fmt::format("[{},{},{}]", 250 * i, 250 * j,
                                   8000 + step + static_cast<int>(noise >> 25)));
    }
  const auto roof = [&](int i, int j) { return i * side + j; };
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j) {
      append(faces, fmt::format("[[{},{},{}]]", roof(i, j), roof(i + 1, j), roof(i + 1, j + 1)));
      append(faces, fmt::format("[[{},{},{}]]", roof(i, j), roof(i + 1, j + 1), roof(i, j + 1)));
    }
  std::vector<int> eaves;
  for (int s = 0; s < across; ++s) eaves.push_back(roof(s, 0));
  for (int s = 0; s < across; ++s) eaves.push_back(roof(across, s));
  for (int s = across; s > 0; --s) eaves.push_back(roof(s, across));
  for (int s = across; s > 0; --s) eaves.push_back(roof(0, s));
  const int below = side * side, count = static_cast<int>(eaves.size());
  for (int s = 0; s < count; ++s) {
    const int v = eaves[static_cast<std::size_t>(s)], next = (s + 1) % count;
    append(vertices, fmt::format("[{},{},0]", 250 * (v / side), 250 * (v % side)));
    append(faces, fmt::format("[[{},{},{},{}]]", eaves[static_cast<std::size_t>(next)], v,
                              below + s, below + next));
    append(ground, std::to_string(below + count - 1 - s));
  }
  append(faces, "[[" + ground + "]]");
  return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":)"
         R"([0,0,0]},"CityObjects":{"m":{"type":"Building","geometry":[{"type":"Solid","lod":"2",)"
         R"("boundaries":[[)" +
         faces + R"(]]}]}},"vertices":[)" + vertices + "]}";
}

TEST_SUITE("cli") {
  TEST_CASE("a body of many small faces takes memory by its size and by its budget") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    MESSAGE("skipped: sanitizers need more address space than there is");
#else
    const Folder folder;
    const std::string mesh = folder.write("mesh.city.json", rough_mesh(120));  // 29,281 faces
    for (const auto& [budget, kilobytes] :
         {std::pair("40000000", 600'000), {"1000000", 300'000}, {"1000", 300'000}})
      for (const char* command : {"label", "segment"}) {
        CAPTURE(budget);
        CAPTURE(command);
        const int exit = exit_with_memory(
            folder, kilobytes, fmt::format("{} '{}' --budget {}", command, mesh, budget));
        const std::string err = bytes_of(folder / "err");
        CAPTURE(err);
        CHECK((exit == 0 || exit == 3));  // 3: no feature was found
        CHECK(err.find("E502 segmenting used up the work budget") != std::string::npos);
        CHECK(err.find("E507") == std::string::npos);
      }
#endif
  }

  TEST_CASE("a large file takes memory by its size and not by what is found out about it") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    MESSAGE("skipped: sanitizers take memory of their own");
#else
    ORIEL_NEEDS_SHARED(shared);
    const std::string file = shared / "data/delfshaven/delfshaven.city.json";
    const Folder folder;
    // Copies are written before a command begins, whose memory counts from its fork on.
    const std::string large = folder.write("large.city.json", with_copies(bytes_of(file), 8));
    constexpr long kBase = 30'000;  // the program and its libraries
    CHECK(peak_kilobytes(folder, "validate", large) <
          kBase + 4 * static_cast<long>(std::filesystem::file_size(large) / 1000));
    // 853 buildings: the result of each is gone when the next is worked on.
    CHECK(peak_kilobytes(folder, "label", file) <
          peak_kilobytes(folder, "validate", file) + 20'000);
#endif
  }

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
