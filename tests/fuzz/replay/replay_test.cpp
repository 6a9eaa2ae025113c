#include "tests/fuzz/targets.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::fuzz {
namespace {

namespace fs = std::filesystem;

/// The files of a folder, sorted; none if there is no such folder.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs all inputs that `folder` has for each target; returns how many.
std::size_t run_all(const std::string& folder) {
  const fs::path root = fs::path(ORIEL_SOURCE_DIR) / "tests" / "fuzz" / folder;
  std::size_t count = 0;
  for (const Target& target : targets())
    for (const fs::path& path : files_in(root / target.name)) {
      CAPTURE(path.string());
      CHECK_NOTHROW(target.run(bytes_of(path)));
      ++count;
    }
  return count;
}

bool is_geometry(const Target& target) {
  const fs::path file = fs::path(ORIEL_SOURCE_DIR) / "tests" / "fuzz" / "geometry" /
                        (std::string(target.name) + ".cpp");
  return fs::exists(file);
}

/// Bytes from which a target of geometry makes a body and some changes; every fourth time so few
/// that there is often no change, as what holds of valid bodies only is asked then.
std::string random_bytes(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  constexpr std::size_t kFew = 14, kMany = 60;
  std::string bytes(2 + random() % (seed % 4 == 3 ? kFew : kMany), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % 256);
  return bytes;
}

std::uint64_t number_in(const char* variable, std::uint64_t otherwise) {
  const char* const asked = std::getenv(variable);
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : otherwise;
}

TEST_SUITE("fuzz") {
  TEST_CASE("every input of the corpora of the fuzz targets keeps the promises") {
    CHECK(run_all("corpus") > 50);
  }

  TEST_CASE("no input that once broke a promise breaks it again") { run_all("regressions"); }

  TEST_CASE("changed bodies drawn at random keep the promises of every stage") {
    const char* const only = std::getenv("ORIEL_FUZZ_ONLY");
    const std::uint64_t first = number_in("ORIEL_FUZZ_FROM", 0);
    const std::uint64_t past = first + number_in("ORIEL_FUZZ_SEEDS", 40);
    for (const Target& target : targets()) {
      if (!is_geometry(target) || (only != nullptr && target.name != only)) continue;
      for (std::uint64_t seed = first; seed < past; ++seed) {
        CAPTURE(std::string(target.name));
        CAPTURE(seed);
        CHECK_NOTHROW(target.run(random_bytes(seed)));
      }
    }
  }
}

}  // namespace
}  // namespace oriel::fuzz
