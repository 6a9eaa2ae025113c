#include "tests/cli/command.h"

#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

using Words = std::vector<std::string>;

/// The sample as a stream whose header has that scale, its vertices rounded to it.
std::string rounded_stream(const Folder& folder, const std::string& name, double scale_m) {
  const std::string path = folder / (name + ".city.jsonl");
  REQUIRE(run({"cat", sample(name), "-o", path}).exit == 0);
  std::string text;
  double fine_m = 0;
  for (const std::string& line : lines_of(bytes_of(path))) {
    json record = json::parse(line);
    if (record.contains("transform")) {
      fine_m = record["transform"]["scale"][0];
      record["transform"]["scale"] = {scale_m, scale_m, scale_m};
    }
    for (json& vertex : record["vertices"])
      for (json& number : vertex) number = std::llround(number.get<double>() * fine_m / scale_m);
    text += record.dump() + "\n";
  }
  return folder.write("rounded-" + name + ".city.jsonl", text);
}

json geometry_of(const std::string& path, const std::string& id) {
  return json::parse(lines_of(bytes_of(path)).at(1))["CityObjects"][id]["geometry"];
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("what is written into a stream with a coarse scale is valid on it or as it was") {
    int solids = 0, rejected = 0;
    for (const double scale_m : {0.002, 0.01, 0.05})
      for (const std::string name : {"house", "block", "hip"})
        for (const Words& command :
             std::vector<Words>{{"repair"}, {"generalise", "--to-lod", "2.0,1.3,1.0"}}) {
          CAPTURE(scale_m);
          CAPTURE(name);
          CAPTURE(command[0]);
          const Folder folder;
          const std::string input = rounded_stream(folder, name, scale_m);
          const std::string out = folder / "out.city.jsonl";
          Words arguments = command;
          arguments.insert(arguments.end(), {input, "-o", out});
          const Outcome outcome = run(arguments);
          CAPTURE(outcome.err);
          CHECK(lines_of(bytes_of(out)).at(0) == lines_of(bytes_of(input)).at(0));
          if (outcome.exit == 0) {
            ++solids;
            CHECK(run({"validate", out, "--lod", "all"}).exit == 0);
          } else {
            ++rejected;
            CHECK(outcome.exit == 3);
            CHECK(geometry_of(out, name) == geometry_of(input, name));
          }
        }
    CHECK(solids > rejected);
    CHECK(rejected > 0);
  }
}
