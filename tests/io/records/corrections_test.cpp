#include "io/records/corrections.h"

#include "tests/io/files.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::codes_of;

Checked<std::vector<Correction>> corrections_in(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_corrections(folder.write("corrections.jsonl", text));
}

TEST_SUITE("io") {
  TEST_CASE("a correction says what a feature is and who says so") {
    const auto read = corrections_in(
        R"({"building":"h","feature":"f1","class":"door","by":"ada","why":"it has a handle"})"
        "\n\n"
        R"({"building":"h","point":[1,2.5,-3],"class":"unknown"})"
        "\r\n");
    CHECK(read.issues.empty());
    REQUIRE(read.value->size() == 2);
    const Correction& first = read.value->at(0);
    CHECK(first.feature == "f1");
    CHECK(first.label == "door");
    CHECK(first.by == "ada");
    CHECK(first.why == "it has a handle");
    CHECK_FALSE(first.point);
    CHECK(first.place.line == 1);
    const Correction& second = read.value->at(1);
    CHECK(second.label.empty());
    CHECK(second.feature.empty());
    CHECK(second.point->y == 2.5);
    CHECK(second.place.line == 3);
  }

  TEST_CASE("corrections that are written are read as they were") {
    std::vector<Correction> written(3);
    written[0] = {"<img onerror=x>", "f1", {}, "door", "ada \"x\"", "two\nlines", {}};
    written[1] = {"__proto__", "", Vec3{1, 2.5, -3e5}, "", "", "", {}};
    written[2] = {"h", "f2", Vec3{0.1, 0, 0}, "window", "", "why", {}};
    const auto read = corrections_in(corrections_text(written));
    CHECK(read.issues.empty());
    REQUIRE(read.value->size() == written.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
      const Correction& p = written[i];
      const Correction& q = read.value->at(i);
      CHECK(p.building == q.building);
      CHECK(p.feature == q.feature);
      CHECK(p.point == q.point);
      CHECK(p.label == q.label);
      CHECK(p.by == q.by);
      CHECK(p.why == q.why);
    }
    CHECK(corrections_text({}).empty());
  }

  TEST_CASE("a line that is no correction is left out and named") {
    for (const char* line :
         {R"({"feature":"f","class":"door"})", R"({"building":"h","feature":"f"})",
          R"({"building":"h","class":"door"})", R"({"building":7,"feature":"f","class":"door"})",
          R"({"building":"h","feature":"f","class":""})", R"(["h"])",
          R"({"building":"h","point":[1,2],"class":"door"})",
          R"({"building":"h","point":[1,2,"3"],"class":"door"})",
          R"({"building":"h","feature":"f","class":"door","by":1})"}) {
      CAPTURE(line);
      const auto read = corrections_in(
          "{\"building\":\"h\",\"feature\":\"f\",\"class\":\"door\"}\n" + std::string(line) + "\n");
      CHECK(codes_of(read.issues) == "E152");
      CHECK(read.issues[0].place.line == 2);
      CHECK(read.value->size() == 1);
    }
    const auto sentence_of = [](const char* line) {
      return corrections_in(line).issues.at(0).sentence;
    };
    CHECK(sentence_of(R"({"building":7,"feature":"f","class":"door"})") ==
          "'building' of the correction must be a text");
    CHECK(sentence_of(R"({"building":"h","feature":"f","class":""})") ==
          "'class' of the correction is empty");
    CHECK(sentence_of(R"({"building":"h","feature":"f"})") == "the correction has no 'class'");
    CHECK(codes_of(corrections_in("{\"building\"\n").issues).starts_with("E10"));
    CHECK(corrections_in("").value->empty());
    CHECK_THROWS_AS(read_corrections("/no/such.jsonl"), InputError);
  }
}

}  // namespace
}  // namespace oriel
