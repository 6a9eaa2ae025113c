#include "io/files/format.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("io") {
  TEST_CASE("the format comes from the last extensions of a name") {
    CHECK(format_of("a/b.city.json") == Format::cityjson);
    CHECK(format_of("b.JSON") == Format::cityjson);
    CHECK(format_of("b.city.jsonl") == Format::cityjson_seq);
    CHECK(format_of("b.jsonl") == Format::cityjson_seq);
    CHECK(format_of("b.obj") == Format::obj);
    CHECK(format_of("b.off") == Format::off);
    CHECK(format_of("b.ply") == Format::ply);
    CHECK(format_of("b.stl") == Format::stl);
    CHECK(format_of("b.gml") == Format::citygml);
    CHECK(format_of("b.citygml") == Format::citygml);
    CHECK(format_of("b.XML") == Format::citygml);
    CHECK(format_of("b.gpkg") == Format::gpkg);
    CHECK_FALSE(format_of("b.ifc"));
    CHECK_FALSE(format_of("-"));
  }

  TEST_CASE("every format reads back from its name") {
    for (const Format format :
         {Format::cityjson, Format::cityjson_seq, Format::citygml, Format::citygml2,
          Format::citygml3, Format::gpkg, Format::obj, Format::off, Format::ply, Format::stl})
      CHECK(parse_format(to_string(format)) == format);
    CHECK_FALSE(parse_format("CityJSON "));
  }
}

}  // namespace
}  // namespace oriel
