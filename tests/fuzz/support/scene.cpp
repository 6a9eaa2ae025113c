#include "tests/fuzz/support/scene.h"

namespace oriel::fuzz {

namespace {

DescribedBuilding made() {
  constexpr FeatureId kWing{0}, kWindow{1}, kUnknown{2};
  DescribedBuilding scene{FeatureTable("house", 3), {}};
  scene.table.set_id(kWing, "f0");
  scene.table.set_id(kWindow, "f1");
  scene.table.set_id(kUnknown, "f2");
  const auto set = [&](FeatureId id, const char* name, auto value) {
    scene.table.set(id, find_attribute(name).value(), value);
  };
  set(kWing, "sense", std::string("protrusion"));
  set(kWing, "a", 4.0);
  set(kWing, "base_height", 2.0);
  set(kWindow, "sense", std::string("hole"));
  set(kWindow, "width", 1.0);
  set(kWindow, "a", 0.2);
  set(kWindow, "host_inclination", 90.0);
  set(kUnknown, "sense", std::string("imprint"));
  scene.graph.set("host", {{kWindow, kWing}, {kUnknown, kWing}});
  scene.graph.set("contains", {{kWing, kWindow}, {kWing, kUnknown}});
  scene.graph.set("inside", {{kWindow, kWing}, {kUnknown, kWing}});
  scene.graph.set("same_facade", {{kWindow, kUnknown}, {kUnknown, kWindow}});
  return scene;
}

}  // namespace

const DescribedBuilding& scene() {
  static const DescribedBuilding building = made();
  return building;
}

}  // namespace oriel::fuzz
