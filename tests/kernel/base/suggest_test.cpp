#include "kernel/base/text/suggest.h"

#include <doctest/doctest.h>

using namespace oriel;

TEST_SUITE("interpret") {
  TEST_CASE("the nearest name is suggested and nothing that is far") {
    const std::vector<std::string> names = {"height", "base_height", "width", "a", "b"};
    CHECK(nearest("heigth", names) == "height");
    CHECK(nearest("hight", names) == "height");
    CHECK(nearest("baseheight", names) == "base_height");
    CHECK(nearest("wdith", names) == "width");
    CHECK(nearest("colour", names).empty());
    CHECK(nearest("x", names).empty());
    CHECK(nearest("height", names).empty());
    CHECK(did_you_mean("widht", names) == "; did you mean 'width'?");
    CHECK(did_you_mean("colour", names).empty());
    CHECK(did_you_mean("height_of", names) ==
          "; did you mean 'height'? 'height' is the feature's own height and 'base_height' that of "
          "its foot over the ground");
    CHECK(did_you_mean("height_of", {"width"}).empty());
    CHECK(nearest(std::string(1000, 'a'), names).empty());
  }
}
