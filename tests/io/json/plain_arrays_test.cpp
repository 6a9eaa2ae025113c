#include "io/json/plain_arrays.h"

#include "io/reader.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rapidcheck.h>

namespace oriel::detail {
namespace {

/// All that was read of a document's buildings, and what was found.
std::string outcome_of(const std::string& text) {
  const auto record = test::read_text(text);
  std::string outcome;
  for (const Issue& issue : record.issues)
    outcome += to_string(issue.code) + " " + issue.sentence + "\n";
  if (!record.value) return outcome;
  for (const Building& building : record.value->buildings) {
    outcome += fmt::format("{} {}\n", building.id, building.repeats.size());
    for (const Vec3 v : building.vertices) outcome += fmt::format("{} {} {},", v.x, v.y, v.z);
    for (const Polygon& p : building.polygons)
      outcome += fmt::format("\n{} {} {} {} {}", p.rings, p.source, p.body, p.shell, p.hint);
  }
  return outcome;
}

/// What is read without PlainArrays: a backslash is not plain.
std::string outcome_of_parser(test::BoxFile file) {
  file.root += R"(,"note":"\\")";
  return outcome_of(file.text());
}

TEST_SUITE("io") {
  TEST_CASE("plain arrays leave their numbers in the rest of the text") {
    PlainArrays arrays;
    REQUIRE(
        arrays.read(R"({"a":[1.5],"boundaries" : [[[1,20, 3],[ 4,5,6]],[[700000007,8,9]]],)"
                    R"("vertices":[[-12345678,0,1234567890123456],[ 7 , 8,-0]],"b":"vertices"})"));
    CHECK(arrays.rest() == R"({"a":[1.5],"boundaries" : [[[0]]],"vertices":[[1]],"b":"vertices"})");
    REQUIRE(arrays.size() == 2);
    const NestedNumbers& nested = arrays.boundaries(0);
    CHECK(nested.depth == 3);
    CHECK(nested.numbers == std::vector<int>{1, 20, 3, 4, 5, 6, 700000007, 8, 9});
    CHECK(nested.ends[0] == std::vector<int>{3, 6, 9});
    CHECK(nested.ends[1] == std::vector<int>{2, 3});
    CHECK(nested.ends[2] == std::vector<int>{2});
    CHECK(arrays.vertices(1) == std::vector<Vec3>{{-12345678, 0, 1234567890123456}, {7, 8, 0}});
    CHECK(arrays.place(1).end - arrays.place(1).begin == 44);
  }

  TEST_CASE("arrays that are not plain are left to the parser") {
    PlainArrays arrays;
    for (const char* vertices : {"3",
                                 "null",
                                 "[",
                                 "[1,2,3]",
                                 "[[1,2]]",
                                 "[[1,2,3,4]]",
                                 "[[1,2,3.0]]",
                                 "[[1,2,3e1]]",
                                 "[[1,2,03]]",
                                 "[[1,2,-]]",
                                 "[[1,2,- 3]]",
                                 "[[1,2,--3]]",
                                 "[[1,2,+3]]",
                                 "[[1,2,3],]",
                                 "[[1,2,3]",
                                 "[[]]",
                                 "[[1,,3]]",
                                 "[[1,2,12345678901234567]]",
                                 "[[1,2,\"3\"]]",
                                 "[[0,0,0000000012]]",
                                 "[[1 2,3]]"}) {
      CAPTURE(vertices);
      CHECK_FALSE(arrays.read(fmt::format(R"({{"vertices":{}}})", vertices)));
    }
    for (const char* boundaries :
         {"[[1,2,3]]", "[]", "[[[]]]", "[[],[[1]]]", "[[[1]],[]]", "[[[1]],[[[2]]]]", "[[[1]],[2]]",
          "[[[-1]]]", "[[[1000000000]]]", "[[[1.0]]]", "[[[01]]]", "[[[1]]", "[[[1,]]]",
          "[[[[[[1]]]]]]"}) {
      CAPTURE(boundaries);
      CHECK_FALSE(arrays.read(fmt::format(R"({{"boundaries":{}}})", boundaries)));
    }
    CHECK_FALSE(arrays.read(R"({"vertices":[],"a":"\""})"));
    CHECK(arrays.read(R"({"vertices":[]})"));
  }

  TEST_CASE("plain arrays have the numbers that stand in the text") {
    CHECK(rc::check("any three numbers and any ring", [] {
      const auto number =
          rc::gen::inRange<std::int64_t>(-9'999'999'999'999'999, 10'000'000'000'000'000);
      const auto v = *rc::gen::container<std::vector<std::int64_t>>(3, number);
      int limit = 10;
      for (int digits = *rc::gen::inRange(1, 10); digits > 1; --digits) limit *= 10;
      const auto ring =
          *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, limit)));
      PlainArrays arrays;
      RC_ASSERT(arrays.read(fmt::format(R"({{"boundaries":[[{}]],"vertices":[{}]}})", ring, v)));
      RC_ASSERT(arrays.boundaries(0).numbers == ring);
      const Vec3 vertex{static_cast<double>(v[0]), static_cast<double>(v[1]),
                        static_cast<double>(v[2])};
      RC_ASSERT(arrays.vertices(1).at(0) == vertex);
    }));
  }

  TEST_CASE("a file reads as it would without plain arrays") {
    test::BoxFile file;
    CHECK(outcome_of(file.text()) == outcome_of_parser(file));
    file.geometry = R"(,"semantics":{"surfaces":[{"type":"WallSurface"},{"type":"GroundSurface"}],)"
                    R"("values":[[1,null,0,0,0,0]]})";
    CHECK(outcome_of(file.text()).find("Ground") != std::string::npos);
    CHECK(outcome_of(file.text()) == outcome_of_parser(file));
    for (const char* boundaries :
         {"[[[[0,3,2,1]],[[4,5,6,8]]]]", "[[[0,3,2,1]],[[4,5,6,7]]]", "[[[[[0,3,2,1]]]]]",
          "[[[[0,0,3,2,1,0]]],[[[4,5,6,7],[4,5,6,7,4]]]]", "[[[[0,3]]]]"}) {
      file.boundaries = boundaries;
      CAPTURE(boundaries);
      CHECK(outcome_of(file.text()) == outcome_of_parser(file));
    }
    file.type = "MultiSolid";
    file.boundaries = "[[[[[0,3,2]],[[0,1,5]]],[[[1,2,6]]]],[[[[2,3,7],[4,5,6]],[[4,5,6]]]]]";
    file.geometry = R"(,"semantics":{"surfaces":[{"type":"WallSurface"}],)"
                    R"("values":[[[0,null],null],[[null,0]]]})";
    CHECK(outcome_of(file.text()).find("Wall") != std::string::npos);
    CHECK(outcome_of(file.text()) == outcome_of_parser(file));
  }
}

}  // namespace
}  // namespace oriel::detail
