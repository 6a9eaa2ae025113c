#include "io/records/log_seal.h"
#include "io/records/operation_log.h"
#include "io/records/stage_json.h"
#include "kernel/base/sha256.h"
#include "oriel/oriel.h"
#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/corpus.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel;
using oriel::test::bytes_of;
using oriel::test::Folder;
using oriel::test::run;

namespace fs = std::filesystem;

namespace {

const RuleBase& default_pack() {
  static const RuleBase rules = load_pack_file("residential").value.value();
  return rules;
}

/// The files below a folder that label reads and writes, sorted.
std::vector<std::string> inputs_in(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string file = entry.path().string();
    if (file.ends_with(".stripped.city.json") || file.ends_with(".city.jsonl"))
      files.push_back(file);
  }
  std::ranges::sort(files);
  return files;
}

/// Each n-th of them.
std::vector<std::string> every(std::size_t n, const std::vector<std::string>& all) {
  std::vector<std::string> some;
  for (std::size_t i = 0; i < all.size(); i += n) some.push_back(all[i]);
  return some;
}

/// What the library makes of a file, as the command would write it.
struct LibraryOutput {
  std::string labelled, features, generalised, repaired, repairs;
};

void add_labels(const Document& document, std::vector<PipelineResult>& results,
                LibraryOutput& out) {
  OutputRecord labelled;
  for (const Building& building : document.buildings) {
    results.push_back(label(building, default_pack()));
    const PipelineResult& result = results.back();
    add(result.output, labelled);
    out.features +=
        FeatureRecordWriter::text(RecordFormat::jsonl, feature_records(building, result));
  }
  out.labelled += write(document, labelled);
}

void add_generalised(const Document& document, const std::vector<PipelineResult>& results,
                     LibraryOutput& out) {
  OutputRecord coarse;
  for (std::size_t i = 0; i < results.size(); ++i)
    add(generalise(document, document.buildings[i], results[i], default_pack(), at_scale(5000)),
        coarse);
  out.generalised += write(document, coarse);
}

void add_repaired(const Document& document, LibraryOutput& out) {
  OutputRecord repaired;
  for (const Building& building : document.buildings) {
    Repaired one = repair(document, building);
    out.repairs += repair_json(building, one.solid.has_value(), one.report, one.issues);
    add(std::move(one.output), repaired);
  }
  out.repaired += write(document, repaired);
}

LibraryOutput by_library(const std::string& file) {
  LibraryOutput out;
  Reader reader(file);
  while (const auto record = reader.next()) {
    if (!record->value) continue;
    std::vector<PipelineResult> results;
    add_labels(*record->value, results, out);
    add_generalised(*record->value, results, out);
    add_repaired(*record->value, out);
  }
  return out;
}

/// Runs the command and the library over a file and compares what they write.
void compare(const std::string& file) {
  CAPTURE(file);
  const LibraryOutput expected = by_library(file);
  const Folder folder;
  const std::string out = folder / (file.ends_with(".jsonl") ? "out.city.jsonl" : "out.city.json");
  const std::string records = folder / "parts.jsonl", repairs = folder / "repairs.jsonl";
  run({"label", file, "-o", out, "--features", records});
  CHECK(bytes_of(out) == expected.labelled);
  CHECK(bytes_of(records) == expected.features);
  run({"generalise", file, "--scale", "1:5000", "-o", out});
  CHECK(bytes_of(out) == expected.generalised);
  run({"repair", file, "-o", out, "--report", repairs});
  CHECK(bytes_of(out) == expected.repaired);
  CHECK(bytes_of(repairs) == expected.repairs);
}

std::string samples() { return std::string(ORIEL_SOURCE_DIR) + "/examples/samples"; }

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("library and command write the same bytes of every sample") {
    const auto files = inputs_in(samples());
    REQUIRE(files.size() >= 8);
    for (const std::string& file : files) compare(file);
  }

  TEST_CASE("library and command write the same bytes of a building with installations") {
    const Folder folder;
    for (const bool is_closed : {false, true})
      compare(folder.write("shaft.city.json", test::cube_with_shaft(4000, is_closed).dump()));
  }

  TEST_CASE("library and command write the same bytes of surveyed installations") {
    ORIEL_NEEDS_SHARED(shared);
    for (const auto& [folder, n] : {std::pair("random3dcity", 25), {"ingolstadt", 9}}) {
      const auto files = every(static_cast<std::size_t>(n),
                               test::files_in(shared / "data" / folder, ".labelled.city.json"));
      CHECK(!files.empty());
      for (const std::string& file : files) compare(file);
    }
  }

  TEST_CASE("library and command write the same bytes of a part of the shared data") {
    ORIEL_NEEDS_SHARED(shared);
    for (const auto& [folder, n] : {std::pair("random3dcity", std::size_t{12}),
                                    {"ingolstadt", 6},
                                    {"ogc-simple-house", 1},
                                    {"houses/noisy", 40},
                                    {"houses/clean", 40}}) {
      const auto files = every(n, inputs_in(shared / "data" / folder));
      CHECK(!files.empty());
      for (const std::string& file : files) compare(file);
    }
  }

  TEST_CASE("slow: library and command write the same bytes of much of the shared data" *
            doctest::skip(std::getenv("ORIEL_SLOW") == nullptr)) {
    ORIEL_NEEDS_SHARED(shared);
    // ORIEL_SLOW=1 is one in 144 files, ORIEL_SLOW=2 all. What is in faults/ is slow or wrong on
    // purpose.
    const std::string faults = (shared / "data" / "faults").string();
    const bool is_all = std::atoi(std::getenv("ORIEL_SLOW")) > 1;
    for (const std::string& file : every(is_all ? 1 : 144, inputs_in(shared / "data")))
      if (!file.starts_with(faults)) compare(file);
    // A district of 853 buildings takes longer than the others together.
    if (is_all) compare((shared / "data/delfshaven/delfshaven.city.json").string());
  }

  TEST_CASE("library and command make the same series") {
    const std::string file = samples() + "/house.stripped.city.json";
    const Folder folder;
    run({"generalise", file, "--series", "1:500,1:2000,1:10000", "-o", folder / "house"});
    const std::vector<Document> records = read(file).value.value();
    REQUIRE(records.size() == 1);
    std::vector<PipelineResult> results;
    for (const Building& building : records[0].buildings)
      results.push_back(label(building, default_pack()));
    const std::vector<double> scales{500, 2000, 10000};
    const Series made = series(records[0], results, default_pack(), scales);
    CHECK(bytes_of(folder / "house.1-500.city.json") == write(records[0], at(made, 500)));
    CHECK(bytes_of(folder / "house.1-2000.city.json") == write(records[0], at(made, 2000)));
    CHECK(bytes_of(folder / "house.1-10000.city.json") == write(records[0], at(made, 10000)));
    std::string log;
    for (const SeriesOperation& operation : made.operations()) log += operation_line(operation);
    LogSealer sealer;
    log = sealer.sealed(log);
    std::map<std::string, std::string> hashes;
    for (const char* scale : {"500", "2000", "10000"})
      hashes[scale] = sha256(bytes_of(folder / fmt::format("house.1-{}.city.json", scale)));
    CHECK(bytes_of(folder / "house.oplog.jsonl") == log + sealer.end(hashes));
    // A level that no file has.
    run({"generalise", "--at", "1:1200", "--from", folder / "house", "-o",
         folder / "at.city.json"});
    std::string text;
    const LevelFromFiles level =
        at(folder / "house", 1200, [&](std::string_view part) { text += part; });
    CHECK(level.is_complete);
    CHECK(bytes_of(folder / "at.city.json") == text);
  }
}
