#include "io/files/gzip.h"

#include "tests/support/gunzip.h"

#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("io") {
  TEST_CASE("a gzip archive gives back its bytes") {
    std::string noise;
    for (std::uint32_t i = 1, x = 7; i < 70'000; ++i, x = x * 1664525 + 1013904223)
      noise += static_cast<char>(x >> 24U);
    for (const std::string& bytes : {std::string(), std::string("a"), std::string(100'000, 'x'),
                                     std::string("\0\xFF\x1F\x8B", 4), noise})
      CHECK(test::gunzip(gzip(bytes)) == bytes);
    CHECK(gzip(std::string(100'000, 'x')).size() < 1000);
  }

  TEST_CASE("a gzip archive names no time, no file and no system") {
    const std::string archive = gzip("walls and roofs");
    CHECK(archive == gzip("walls and roofs"));
    CHECK(archive.substr(0, 4) == "\x1F\x8B\x08" + std::string(1, '\0'));  // no flags
    CHECK(archive.substr(4, 4) == std::string(4, '\0'));
    CHECK(archive.at(9) == '\xFF');
  }
}

}  // namespace
}  // namespace oriel
