#include "io/tiles/earth.h"

#include <cmath>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// The tower of the Old Church in Delft, in UTM zone 31 north.
constexpr Vec3 kDelft{594'180, 5'762'930, 40};

TEST_SUITE("io") {
  TEST_CASE("a system is known by its code, by OGC's URL and by its URN") {
    CHECK(short_name_of_crs("https://www.opengis.net/def/crs/EPSG/0/7415") == "EPSG:7415");
    CHECK(short_name_of_crs("http://www.opengis.net/def/crs/EPSG/0/7415") == "EPSG:7415");
    CHECK(short_name_of_crs("urn:ogc:def:crs:EPSG::25832") == "EPSG:25832");
    CHECK(short_name_of_crs("EPSG:25832") == "EPSG:25832");
  }

  TEST_CASE("east, north and up are the axes of a frame on the earth") {
    const auto earth = Earth::of("EPSG:32631", kDelft);
    REQUIRE(earth.value);
    const auto frame = earth.value->frame_at(kDelft);
    REQUIRE(frame);
    CHECK(length(frame->origin) == doctest::Approx(6'364'900).epsilon(1e-4));
    const Vec3 up = normalised(frame->origin);
    CHECK(dot(up, frame->columns[2]) > 0.9999);
    CHECK(length(cross(frame->columns[0], frame->columns[1]) - frame->columns[2]) < 1e-12);
    const auto higher = earth.value->geocentric(kDelft + Vec3{0, 0, 10});
    REQUIRE(higher);
    CHECK(dot(*higher - frame->origin, frame->columns[2]) == doctest::Approx(10));
    const auto east = earth.value->geocentric(kDelft + Vec3{10, 0, 0});
    CHECK(dot(*east - frame->origin, frame->columns[0]) == doctest::Approx(10).epsilon(0.002));
  }

  TEST_CASE("a system without heights is a warning") {
    const auto earth = Earth::of("EPSG:32631", kDelft);
    CHECK(earth.value);
    REQUIRE(earth.issues.size() == 1);
    CHECK(earth.issues[0].code == Code::E162);
    CHECK(earth.issues[0].severity == Severity::warning);
  }

  TEST_CASE("heights whose grid is not installed are taken as ellipsoidal, with a warning") {
    const Vec3 dutch{84'500, 447'600, 40};
    const auto earth = Earth::of("EPSG:7415", dutch);
    REQUIRE(earth.value);
    const double radius = length(*earth.value->geocentric(dutch));
    const auto plain = Earth::of("EPSG:28992", dutch);
    const double above = radius - length(*plain.value->geocentric(dutch));
    // With the grid they are 43 m higher there.
    CHECK(std::abs(above) == doctest::Approx(earth.issues.empty() ? 43.5 : 0).epsilon(0.05));
  }

  TEST_CASE("what is no projected system is refused") {
    for (const char* name : {"EPSG:1", "Delft", "EPSG:4326", "EPSG:4978", ""}) {
      const auto earth = Earth::of(name, kDelft);
      CHECK_FALSE(earth.value);
      REQUIRE(earth.issues.size() == 1);
      CHECK(earth.issues[0].code == Code::E160);
    }
  }
}

}  // namespace
}  // namespace oriel
