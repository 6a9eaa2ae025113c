#include "interpret/plan/plan.h"
#include "tests/interpret/support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace oriel;
using namespace oriel::test;

namespace {

RuleBase residential() {
  auto checked = load_pack_file("residential");
  for (const Issue& issue : checked.issues) FAIL_CHECK(to_string(issue));
  REQUIRE(checked.value);
  return *checked.value;
}

/// What the kernel says of a recess of that size in a wall.
Values recess(double width, double height, double base_height, double depth = 0.12) {
  return {{"sense", "hole"},
          {"natural", 1.0},
          {"width", width},
          {"height", height},
          {"depth", depth},
          {"a", std::max(width, height)},
          {"b", std::min(width, height)},
          {"c", depth},
          {"base_height", base_height},
          {"top", base_height + height},
          {"volume", width * height * depth},
          {"along", 5.0},
          {"inclination", 90.0},
          {"host_inclination", 90.0},
          {"split_order", base_height == 0 ? 2.0 : 1.0}};
}

/// A block that sticks out of a wall.
Values block(double width, double height, double depth, double base_height) {
  Values values = recess(width, height, base_height, depth);
  values["sense"] = "protrusion";
  return values;
}

/// A block that stands on a roof of 40 degrees; `height` counts from the lower edge of its foot.
Values on_roof(double width, double deep, double height, double base_height = 7) {
  Values values = block(width, height, height * std::cos(40 * std::numbers::pi / 180), base_height);
  double sizes[] = {width, deep, height};
  std::ranges::sort(sizes);
  values["c"] = sizes[0];
  values["b"] = sizes[1];
  values["a"] = sizes[2];
  values["inclination"] = 40.0;
  values["host_inclination"] = 40.0;
  return values;
}

std::string label_of(const Scene& scene, FeatureId feature) {
  return labels(residential(), scene)[feature.index()];
}

std::string label_alone(const Values& values) {
  Scene scene;
  return label_of(scene, scene.add(values));
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("the embedded pack loads without any finding") {
    const RuleBase base = residential();
    CHECK(base.name() == "residential");
    CHECK(base.labels() == std::vector<std::string>{"window", "door", "chimney", "vent", "dormer",
                                                    "balcony", "canopy", "loggia", "bay",
                                                    "stairs"});
    CHECK(base.codelists() == std::vector<std::string>{"plateau", "sig3d"});
    CHECK(embedded_packs() ==
          std::vector<std::string>{"cartographic", "residential", "surfaces-only"});
    CHECK(load_pack_file("surfaces-only").issues.empty());
  }

  TEST_CASE("recesses in walls are windows") {
    CHECK(label_alone(recess(1.1, 1.4, 0.95)) == "window");
    CHECK(label_alone(recess(0.6, 0.6, 4.2)) == "window");
    CHECK(label_alone(recess(3.0, 1.5, 3.9)) == "window");
    CHECK(label_alone(recess(0.7, 0.4, 0.3)) == "window");
    CHECK(label_alone(recess(2.2, 1.75, 0.45)) == "window");
    CHECK(label_alone(recess(1.2, 2.1, 2.85)) == "window");
    Values flush = recess(1.1, 1.4, 0.95, 0);
    flush["sense"] = "imprint";
    CHECK(label_alone(flush) == "window");
  }

  TEST_CASE("what lies in an opening is part of it and what lies in a wide recess is not") {
    for (const double width : {1.4, 5.4, 5.8}) {
      CAPTURE(width);
      Scene scene;
      const FeatureId around = scene.add(recess(width, 2.4, 0.4, 0.25));
      const FeatureId pane = scene.add(recess(1.1, 1.4, 0.95));
      scene.put_on(around, pane);
      const std::string label = labels(residential(), scene)[pane.index()];
      CHECK(label == (width < 5.5 ? "-" : "window"));
    }
  }

  TEST_CASE("what is too narrow for a door is a window") {
    CHECK(label_alone(recess(0.67, 2.1, 0)) == "window");
    CHECK(label_alone(recess(0.8, 2.1, 0)) == "door");
  }

  TEST_CASE("recesses in roofs are windows") {
    Values roof_window = recess(0.8, 0.9, 6.5, 0.1);
    roof_window["host_inclination"] = roof_window["inclination"] = 40.0;
    CHECK(label_alone(roof_window) == "window");
  }

  TEST_CASE("tall recesses at the ground are doors") {
    CHECK(label_alone(recess(1.0, 2.1, 0)) == "door");
    CHECK(label_alone(recess(0.85, 1.9, 0.15)) == "door");
    CHECK(label_alone(recess(2.4, 2.1, 0)) == "door");
    CHECK(label_alone(recess(4.8, 2.2, 0)) == "door");
  }

  TEST_CASE("a door above its stairs is a door and the stairs are stairs") {
    Scene scene;
    const FeatureId door = scene.add(recess(1.0, 2.1, 0.85));
    const FeatureId stairs = scene.add(block(1.3, 0.85, 1.2, 0));
    scene.relate_both("same_facade", door, stairs);
    CHECK(labels(residential(), scene) == Labels{"door", "stairs"});
    CHECK(label_alone(recess(1.0, 2.1, 0.85)) == "window");
    CHECK(label_alone(block(1.3, 0.85, 1.2, 0)) == "-");
  }

  TEST_CASE("slender blocks on roofs are chimneys and low ones are vents") {
    CHECK(label_alone(on_roof(0.5, 0.6, 1.4)) == "chimney");
    CHECK(label_alone(on_roof(0.25, 0.25, 1.19)) == "chimney");
    CHECK(label_alone(on_roof(1.2, 0.6, 1.6)) == "chimney");
    CHECK(label_alone(on_roof(0.3, 0.3, 0.4)) == "vent");
    CHECK(label_alone(on_roof(0.16, 0.16, 0.35)) == "vent");
  }

  TEST_CASE("a chimney with flues is still a chimney") {
    Scene scene;
    const FeatureId chimney = scene.add(on_roof(0.6, 0.6, 1.4));
    Values flue = recess(0.4, 0.3, 8.1, 0.3);
    flue["host_inclination"] = flue["inclination"] = 0.0;
    const FeatureId hole = scene.add(flue);
    scene.put_on(chimney, hole);
    CHECK(labels(residential(), scene) == Labels{"chimney", "-"});
  }

  TEST_CASE("a block on a roof with a window in it is a dormer") {
    Scene scene;
    const FeatureId dormer = scene.add(on_roof(1.8, 2.0, 1.6), {{"volume", 3.0}});
    const FeatureId window = scene.add(recess(1.1, 0.9, 7.4));
    scene.put_on(dormer, window);
    CHECK(labels(residential(), scene) == Labels{"dormer", "window"});
    CHECK(label_alone(on_roof(1.8, 2.0, 1.6)) == "-");
  }

  TEST_CASE("a small dormer is a dormer and no chimney") {
    Scene scene;
    const FeatureId dormer = scene.add(on_roof(1.3, 1.2, 1.2), {{"volume", 1.0}});
    scene.put_on(dormer, scene.add(recess(0.8, 0.7, 7.4)));
    CHECK(label_of(scene, dormer) == "dormer");
  }

  TEST_CASE("a slab with a door above it is a balcony and its door a door") {
    Scene scene;
    const FeatureId balcony = scene.add(block(3.0, 1.2, 1.2, 2.7));
    const FeatureId door = scene.add(recess(0.9, 2.1, 2.9));
    const FeatureId window = scene.add(recess(1.2, 1.3, 3.8));
    for (const FeatureId opening : {door, window}) {
      scene.relate_both("same_facade", balcony, opening);
      scene.relate_both("beside", balcony, opening);
    }
    CHECK(labels(residential(), scene) == Labels{"balcony", "door", "window"});
  }

  TEST_CASE("a slab above a door is a canopy") {
    Scene scene;
    const FeatureId canopy = scene.add(block(1.4, 0.15, 1.0, 2.3));
    const FeatureId door = scene.add(recess(1.0, 2.1, 0.1));
    scene.relate_both("same_facade", canopy, door);
    CHECK(labels(residential(), scene) == Labels{"canopy", "door"});
  }

  TEST_CASE("a room open to the outside is a loggia and its door a door") {
    Scene scene;
    const FeatureId loggia = scene.add(recess(3.0, 2.5, 2.9, 1.4));
    const FeatureId door = scene.add(recess(0.9, 2.1, 2.95));
    scene.put_on(loggia, door);
    CHECK(labels(residential(), scene) == Labels{"loggia", "door"});
  }

  TEST_CASE("a block on a wall with a window in it is a bay") {
    Scene scene;
    const FeatureId bay = scene.add(block(2.2, 2.6, 0.8, 2.6));
    scene.put_on(bay, scene.add(recess(1.2, 1.4, 3.6)));
    CHECK(labels(residential(), scene) == Labels{"bay", "window"});
  }

  TEST_CASE("panes in a frame are no windows of their own") {
    Scene scene;
    const FeatureId window = scene.add(recess(1.2, 1.4, 0.9));
    const FeatureId pane = scene.add(recess(0.5, 1.2, 1.0, 0.04));
    scene.put_on(window, pane);
    CHECK(labels(residential(), scene) == Labels{"window", "-"});
  }

  TEST_CASE("a parapet on a balcony and a screen on the parapet are no chimneys") {
    Scene scene;
    const FeatureId slab = scene.add(block(3.0, 0.2, 1.2, 2.7));
    Values flat = on_roof(1.1, 0.12, 0.95);
    flat["host_inclination"] = flat["inclination"] = 0.0;
    flat["depth"] = 0.95;
    const FeatureId parapet = scene.add(flat);
    const FeatureId screen = scene.add(flat);
    scene.put_on(slab, parapet);
    scene.put_on(parapet, screen);
    const Labels found = labels(residential(), scene);
    CHECK(found[parapet.index()] == "-");
    CHECK(found[screen.index()] == "-");
    CHECK(label_alone(flat) == "chimney");
  }

  TEST_CASE("the steps of stairs are no windows") {
    Scene scene;
    const FeatureId stairs = scene.add(block(1.3, 0.5, 1.0, 0));
    scene.put_on(stairs, scene.add(recess(1.3, 0.34, 0.17, 0.28)));
    CHECK(labels(residential(), scene)[1] == "-");
  }

  TEST_CASE("decor stays unknown") {
    CHECK(label_alone(block(1.2, 0.06, 0.12, 0.9)) == "-");   // sill
    CHECK(label_alone(block(0.3, 8.0, 0.15, 0)) == "-");      // pilaster
    CHECK(label_alone(block(12.0, 0.14, 0.15, 2.7)) == "-");  // cornice
    CHECK(label_alone(block(9.0, 0.5, 0.1, 0)) == "-");       // plinth
    CHECK(label_alone(recess(0.1, 3.0, 0.5)) == "-");         // joint
  }

  TEST_CASE("a frame before a wall is a window and a shutter beside it stays unknown") {
    Scene scene;
    const FeatureId window = scene.add(block(1.1, 1.4, 0.04, 0.95)),
                    shutter = scene.add(block(0.5, 1.4, 0.04, 0.95));
    scene.relate_both("same_facade", window, shutter);
    scene.relate_both("beside", window, shutter);
    CHECK(labels(residential(), scene) == Labels{"window", "-"});
  }

  TEST_CASE("a door elsewhere on the facade makes no balcony") {
    Scene scene;
    const FeatureId slab = scene.add(block(3.0, 0.2, 1.2, 2.7)),
                    window = scene.add(recess(0.9, 2.1, 2.9), {{"along", 9.0}});
    scene.relate_both("same_facade", slab, window);
    CHECK(labels(residential(), scene) == Labels{"-", "window"});
  }

  TEST_CASE("big parts stay unknown though they have windows") {
    Scene scene;
    const FeatureId wing = scene.add(block(8.0, 6.0, 5.0, 0));
    const FeatureId tower = scene.add(on_roof(5.0, 5.0, 6.0), {{"volume", 150.0}});
    const FeatureId roof = scene.add(on_roof(12.0, 9.0, 4.0), {{"volume", 200.0}});
    for (const FeatureId part : {wing, tower, roof})
      scene.put_on(part, scene.add(recess(1, 1.4, 3)));
    const Labels found = labels(residential(), scene);
    CHECK(found[wing.index()] == "-");
    CHECK(found[tower.index()] == "-");
    CHECK(found[roof.index()] == "-");
  }

  TEST_CASE("a feature of which nothing is known stays unknown") { CHECK(label_alone({}) == "-"); }

  TEST_CASE("at 1 to 20000 no opening chimney balcony or dormer is left") {
    Scene scene;
    const FeatureId dormer = scene.add(on_roof(1.8, 2.0, 1.6), {{"volume", 3.0}});
    scene.put_on(dormer, scene.add(recess(1.1, 0.9, 7.4)));
    scene.add(on_roof(0.5, 0.6, 1.4));
    const FeatureId balcony = scene.add(block(3.0, 1.2, 1.2, 2.7));
    const FeatureId door = scene.add(recess(0.9, 2.1, 2.9));
    scene.relate_both("same_facade", balcony, door);
    scene.relate_both("beside", balcony, door);
    const FeatureId wing = scene.add(block(14.0, 6.0, 5.0, 0));

    const RuleBase base = residential();
    const Interpretation verdicts = interpret(base, scene.table(), scene.graph());
    const auto omitted = [&](double scale) {
      return plan(base, scene.table(), scene.graph(), verdicts, scale).steps;
    };
    const auto far = omitted(20000);
    CHECK(far.size() == verdicts.verdicts.size() - 1);
    CHECK(std::ranges::none_of(far, [&](const Step& step) { return step.feature == wing; }));
    CHECK(omitted(200).empty());
    CHECK(omitted(1000).empty());
  }
}
