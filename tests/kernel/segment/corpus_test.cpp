#include "tests/support/corpus.h"

#include "tests/kernel/segment/invariants.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <doctest/doctest.h>

namespace oriel {
namespace {

void check_all(const test::Corpus& corpus, const test::Exactness& exactness) {
  for (const std::string& id : corpus.set_aside) MESSAGE("set aside: " << id);
  for (const Building& building : corpus.buildings)
    for (const Order order : {Order::natural, Order::paper}) {
      CAPTURE(building.id);
      CAPTURE(to_string(order));
      test::check_segmentation(test::segmented(building, order), exactness);
    }
}

constexpr test::Exactness kSurveyed{1e-9, 0.008, 40, false};

/// The solids of ingolstadt, 3dbag and the ogc house; others are told.
test::Corpus surveyed(const std::filesystem::path& shared) {
  auto files = test::files_in(shared / "data" / "ingolstadt", ".stripped.city.json");
  for (const auto& file :
       test::files_in(shared / "data" / "ogc-simple-house", ".stripped.city.json"))
    files.push_back(file);
  files.push_back((shared / "data" / "3dbag" / "tile_5910.city.jsonl").string());
  test::Corpus corpus = test::corpus_of(files);
  MESSAGE("set aside: " << corpus.set_aside.size());
  corpus.set_aside.clear();
  return corpus;
}

bool is_large(const Building& building) { return building.polygons.size() > 150; }

TEST_SUITE("kernel/segment") {
  TEST_CASE("every sample building is the sum of its cells and the value of its tree") {
    const test::Corpus corpus = test::samples();
    CHECK(corpus.buildings.size() == 8);
    CHECK(corpus.set_aside.empty());
    check_all(corpus, {1e-9, 0.008, 100});
  }

  TEST_CASE("every building of random3dcity is the sum of its cells and the value of its tree") {
    ORIEL_NEEDS_SHARED(shared);
    const test::Corpus corpus =
        test::corpus_of(test::files_in(shared / "data" / "random3dcity", ".stripped.city.json"));
    CHECK(corpus.buildings.size() >= 70);
    check_all(corpus, {1e-9, 1e-4, 100});
  }

  TEST_CASE("slow: surveyed buildings are the sum of their cells and the value of their tree") {
    ORIEL_NEEDS_SHARED(shared);
    test::Corpus corpus = surveyed(shared);
    CHECK(corpus.buildings.size() > 150);
    // The largest make up most of the time.
    std::erase_if(corpus.buildings, is_large);
    CHECK(corpus.buildings.size() > 130);
    check_all(corpus, kSurveyed);
  }

  TEST_CASE("slow: the largest surveyed buildings are the sum of their cells, too" *
            doctest::skip(std::getenv("ORIEL_SLOW") == nullptr)) {
    ORIEL_NEEDS_SHARED(shared);
    test::Corpus corpus = surveyed(shared);
    std::erase_if(corpus.buildings, [](const Building& b) { return !is_large(b); });
    CHECK(corpus.buildings.size() > 5);
    check_all(corpus, kSurveyed);
  }
}

}  // namespace
}  // namespace oriel
