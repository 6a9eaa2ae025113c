#include "io/cityjson/lod_name.h"

#include <doctest/doctest.h>

namespace oriel::detail {
namespace {

TEST_SUITE("io") {
  TEST_CASE("a level of detail has one name as a string and as a number") {
    for (const std::string name : {"0", "2", "2.0", "2.2", "3.3"}) {
      CAPTURE(name);
      CHECK(lod_name(name) == name);
      CHECK(lod_name('"' + name + '"') == name);
    }
    CHECK(lod_name("2.20") == "2.2");
    CHECK(lod_name("null").empty());
    CHECK(lod_name("").empty());
  }

  TEST_CASE("a level of detail is written as its neighbour is") {
    CHECK(lod_text("1.2", "2.2") == "1.2");
    CHECK(lod_text("1.2", "\"2.2\"") == "\"1.2\"");
    CHECK(lod_text("1.2", "") == "\"1.2\"");
    CHECK(lod_text("fine", "2.2") == "\"fine\"");
  }
}

}  // namespace
}  // namespace oriel::detail
