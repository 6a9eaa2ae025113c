#include "examples/generator/addition.h"
#include "examples/generator/command.h"
#include "examples/generator/output/check.h"
#include "examples/generator/output/truth.h"
#include "kernel/base/code.h"
#include "tests/examples/generator/crossings.h"
#include "tests/examples/generator/measured_bodies.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::generator {
namespace {

/// One of each kind of thing and surface, and two that share a roof.
constexpr std::array kKinds{"solar_panel panel on roof size 1.7x1x0.06",
                            "solar_panel panel on roof size 1.7x1x0.06",
                            "skylight block on roof size 0.8x0.8x0.3",
                            "window hole on roof size 0.6x0.8x0.1",
                            "window hole on wall size 1x1",
                            "niche hole on wall size 1x1.2x1.2",
                            "sign block on wall size 1.2x0.4x0.2",
                            "box block on wall size 0.8x0.8x1.5",
                            "plate panel on gable size 0.4x0.4",
                            "shut hole on wall size 1x1x0"};

Options with_additions(const std::vector<std::string>& texts) {
  Options options;
  for (const std::string& text : texts) options.additions.push_back(read_addition(text));
  return options;
}

/// A gabled house of 9 x 7 m without features of its own.
Options bare_house(const std::vector<std::string>& texts) {
  Options options = with_additions(texts);
  options.roof = RoofKind::gable;
  options.storeys = {1, 1};
  options.width = {9'000'000, 9'000'000};
  options.depth = {7'000'000, 7'000'000};
  options.features.emplace();
  return options;
}

/// The box of the first object of that class; empty if there is none.
Extent box_of(const Body& body, std::string_view label) {
  const std::vector<Extent> boxes = boxes_of(body);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (body.objects[i].label() == label) return boxes[i];
  return {};
}

struct AdditionRun {
  int code = 0;
  std::string out, err;
};

AdditionRun run_adding(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "oriel-generate");
  std::ostringstream out, err;
  const int code = run_command(static_cast<int>(arguments.size()), arguments.data(), out, err);
  return {code, out.str(), err.str()};
}

TEST_SUITE("examples/generator") {
  TEST_CASE("what is added stands where it was asked for with its sizes") {
    const Options options = bare_house({"sign block on front at 1,2 size 1.5x0.5x0.1",
                                        "niche hole on right at 3,1 size 0.8x0.6x0.2",
                                        "plate panel on back at 4,0 size 1x1"});
    const Body body = generate(options, 0);
    const Extent sign = box_of(body, "sign"), niche = box_of(body, "niche"),
                 plate = box_of(body, "plate");
    CHECK(sign.low == Point{1'000'000, -100'000, 2'000'000});
    CHECK(sign.high == Point{2'500'000, 0, 2'500'000});
    CHECK(niche.low == Point{8'800'000, 3'000'000, 1'000'000});
    CHECK(niche.high == Point{9'000'000, 3'800'000, 1'600'000});
    CHECK(plate.low == Point{4'000'000, 7'000'000, 0});
    CHECK(plate.high == Point{5'000'000, 7'050'000, 1'000'000});
  }

  TEST_CASE("a panel on a roof is parallel to it and a block upright") {
    for (const char* shape : {"panel", "hole", "block"}) {
      CAPTURE(shape);
      const std::string text = std::string("thing ") + shape + " on roof2 at 2,1.5 size 1.7x1x0.06";
      const Body body = generate(bare_house({text}), 0);
      int along_the_roof = 0, level = 0;
      Vec3 normal_of_roof;
      for (const Polygon& polygon : body.polygons)
        if (body.objects[static_cast<std::size_t>(polygon.owner.object)].name == "roof_2")
          normal_of_roof = normalised(doubled_area(body, polygon));
      for (const Polygon& polygon : body.polygons) {
        const Object& object = body.objects[static_cast<std::size_t>(polygon.owner.object)];
        if (object.label() != "thing") continue;
        const Vec3 doubled = doubled_area(body, polygon);
        const bool is_parallel = dot(normalised(doubled), normal_of_roof) > 1 - 1e-9;
        if (is_parallel) CHECK(length(doubled) / 2 == doctest::Approx(1.7).epsilon(2e-3));
        along_the_roof += is_parallel ? 1 : 0;
        level += normalised(doubled).z > 1 - 1e-9 ? 1 : 0;
      }
      CHECK(along_the_roof == (std::string(shape) == "block" ? 0 : 1));
      CHECK(level == (std::string(shape) == "block" ? 1 : 0));
    }
  }

  TEST_CASE("every house has a thing of every kind that was asked for") {
    for (const char* text : kKinds) {
      const std::string kind(text);
      CAPTURE(kind);
      Options options = with_additions({kind});
      int placed = 0;
      for (int i = 0; i < 20; ++i) {
        const Body body = generate(options, i);
        placed += static_cast<int>(std::ranges::count_if(body.objects, [&](const Object& o) {
          return kind.starts_with(std::string(o.label()) + " ");
        }));
      }
      CHECK(placed > 0);
    }
  }

  // tests/kernel/validate judges such houses, too: there what touches counts.
  TEST_CASE("every house with additions is a closed solid that does not cross itself") {
    Options options = with_additions({kKinds.begin(), kKinds.end()});
    for (int i = 0; i < 150; ++i) {
      CAPTURE(i);
      options.jitter = i % 2 == 0 ? 200_mm : 0;
      options.triangulate = i % 5 == 0;
      const Body body = generate(options, i);
      CHECK(find_faults(body, options.triangulate ? std::nullopt : std::optional<Um>(1)).empty());
      if (options.triangulate) CHECK(test::count_crossings(body) == 0);
    }
  }

  TEST_CASE("the truth and the labelled file have the class that was given") {
    Options options = bare_house({"solar_panel panel on roof at 2,1 size 1.7x1"});
    const Building building{"house", generate(options, 0), {}};
    const auto truth = nlohmann::json::parse(truth_json(building));
    std::set<std::string> ids;
    for (const auto& object : truth["objects"])
      if (object["class"] == "solar_panel") ids.insert(object["id"]);
    CHECK(ids == std::set<std::string>{"house_solar_panel_1"});
    const AdditionRun labelled =
        run_adding({"-o", "-", "--labelled", "--features", "door", "--roof", "gable", "--add",
                    "solar_panel panel on roof size 1.7x1"});
    CHECK(labelled.code == 0);
    CHECK(labelled.out.find("\"oriel_label\":\"solar_panel\"") != std::string::npos);
  }

  TEST_CASE("classes of the vocabulary are added as what they are") {
    const Body body = generate(bare_house({"window hole on front at 2,1 size 1.2x1.4x0.15",
                                           "window hole on roof1 at 2,1 size 0.6x0.8x0.1",
                                           "chimney block on roof2 at 3,1 size 0.6x0.6x1.5"}),
                               0);
    std::vector<std::string> found;
    for (const Object& object : body.objects)
      if (!is_surface(object.kind)) found.push_back(object.name + " " + object.subclass);
    CHECK(found ==
          std::vector<std::string>{"window_1 Window", "window_2 roofWindow", "chimney_1 chimney"});
    const auto window = std::ranges::find(body.objects, "window_1", &Object::name);
    REQUIRE(window != body.objects.end());
    CHECK(window->recess == 150'000);
  }

  TEST_CASE("wrong additions have a code and say what is wrong") {
    struct Case {
      const char* text;
      const char* code;
      const char* message;
    };
    const std::vector<Case> cases{
        {"", "E140", "a class is missing"},
        {"solar panel panel on roof size 1x1", "E140", "'panel' where 'on' must stand"},
        {"Solar panel on roof size 1x1", "E140", "'Solar' is not the name of a class"},
        {"solar slab on roof size 1x1", "E140", "'slab' is not block, hole or panel"},
        {"solar panel on roof", "E140", "its size is missing"},
        {"solar panel on cellar size 1x1", "E140", "there is no surface 'cellar'"},
        {"solar panel on front2 size 1x1", "E140", "there is no surface 'front2'"},
        {"solar panel on roof0 size 1x1", "E140", "counted from 1"},
        {"solar panel on roof size 1", "E140", "'1' is not a size"},
        {"solar panel on roof size 1xwide", "E140", "'wide' is not a number of metres"},
        {"solar panel on roof size 60x1", "E140", "must be within 0.02 .. 50 m"},
        {"solar panel on roof size 1x1x2", "E140", "its depth of 2 m"},
        {"solar panel on roof size 1x1 size 1x1", "E140", "may stand once"},
        {"solar panel on roof at 1 size 1x1", "E140", "'1' is not a position"},
        {"window panel on front size 1x1", "E140", "a window is a hole"},
        {"wall panel on front size 1x1", "E140", "is a surface of the bare house"},
        {"solar panel on roof9 size 1x1", "E141", "the roof has 2 planes"},
        {"solar panel on roof at 2,99 size 1x1", "E141", "X may be 0.50 .. 7.50 m there and Y 0."},
        {"niche hole on front at 0.5,0.5 size 1x1x1", "E141", "X may be 1.90 .. 6.10 m there"},
        {"solar panel on front at 0,0 size 12x1", "E141", "the surface takes at most 8.40 x "},
    };
    for (const Case& wrong : cases) {
      const AdditionRun result =
          run_adding({"-o", "-", "--roof", "gable", "--width", "9", "--depth", "7", "--features",
                      "door", "--add", wrong.text});
      INFO(result.err);
      CHECK(result.code == 2);
      CHECK(result.err.find(std::string("--add: ") + wrong.code + " '") != std::string::npos);
      CHECK(result.err.find(wrong.message) != std::string::npos);
      CHECK(code_of(wrong.code));
    }
    const AdditionRun twice = run_adding({"-o", "-", "--roof", "gable", "--width", "9", "--depth",
                                          "7", "--add", "a panel on roof at 2,1 size 1x1", "--add",
                                          "b panel on roof at 2.5,1 size 1x1"});
    CHECK(twice.code == 2);
    CHECK(twice.err.find("E141 'b panel on roof at 2.5,1 size 1x1' does not fit: something else "
                         "stands there") != std::string::npos);
    CHECK(run_adding({"-o", "-", "--style", "english", "--add", "a panel on roof size 1x1"}).code ==
          2);
  }

  TEST_CASE("a position without room is named with its house where there are several") {
    const AdditionRun one =
        run_adding({"-o", "-", "--roof", "flat", "--add", "a panel on roof2 size 1x1"});
    CHECK(one.code == 2);
    CHECK(one.err.ends_with("does not fit: the roof has 1 plane\n"));
    const AdditionRun several = run_adding({"-o", "-", "--count", "40", "--features", "door",
                                            "--add", "a panel on front at 10,1 size 1x1"});
    CHECK(several.code == 2);
    CHECK(several.err.find(" m (house-0000") != std::string::npos);
  }

  TEST_CASE("things that find no room are counted and none at all ends with 3") {
    const AdditionRun some = run_adding(
        {"-o", "-", "--count", "40", "--roof", "gable", "--add", "big panel on roof size 11x1.5"});
    CHECK(some.code == 0);
    CHECK(some.err.find("warning: E141 ") != std::string::npos);
    CHECK(some.err.find(" of 40 houses have no room for 'big panel on roof size 11x1.5'") !=
          std::string::npos);
    const AdditionRun none =
        run_adding({"-o", "-", "--roof", "flat", "--add", "a panel on gable size 1x1"});
    CHECK(none.code == 3);
    CHECK(none.err.find("1 of 1 house has no room") != std::string::npos);
    CHECK_FALSE(none.out.empty());
  }
}

}  // namespace
}  // namespace oriel::generator
