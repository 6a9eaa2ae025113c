#pragma once

#include <string>

namespace oriel::test {

/// A building of 4 × 3 × 2 m at (1000, 2000, 10): a Solid whose six faces are ground, roof, south,
/// east, north, west; `geometry` are more members of its geometry, `building` of its object, `root`
/// of the file, each with its leading comma.
struct BoxFile {
  std::string geometry;
  std::string building;
  std::string objects;
  std::string root;
  std::string boundaries =
      "[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]";
  std::string vertices =
      "[[0,0,0],[4000,0,0],[4000,3000,0],[0,3000,0],[0,0,2000],[4000,0,2000],[4000,3000,2000],"
      "[0,3000,2000]]";
  std::string transform = R"({"scale":[0.001,0.001,0.001],"translate":[1000.5,2000.25,10.0]})";
  std::string type = "Solid";
  std::string lod = R"("2.2")";

  [[nodiscard]] std::string text() const {
    return R"({"type":"CityJSON","version":"2.0","transform":)" + transform +
           R"(,"CityObjects":{"house":{"type":"Building","geometry":[{"type":")" + type +
           R"(","lod":)" + lod + R"(,"boundaries":)" + boundaries + geometry + "}]" + building +
           "}" + objects + R"(},"vertices":)" + vertices + root + "}\n";
  }
};

}  // namespace oriel::test
