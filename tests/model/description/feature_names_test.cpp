#include "model/description/feature_names.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

/// A building of which every feature has its place.
class Elevation {
 public:
  /// An opening in the wall that looks there, from `left` to `right` as seen from outside.
  FeatureId opening(const std::string& label, double azimuth_deg, double across, double bottom,
                    double top) {
    return add({{}, {}, {}, 90.0, azimuth_deg, true, box_at(azimuth_deg, across, bottom, top)},
               label);
  }
  FeatureId on_wall(const std::string& label, double azimuth_deg, double across, double bottom,
                    double top) {
    return add({{}, {}, {}, 90.0, azimuth_deg, false, box_at(azimuth_deg, across, bottom, top)},
               label);
  }
  FeatureId on_roof(const std::string& label, double slope_deg, double azimuth_deg, double x) {
    return add({{}, {}, {}, slope_deg, azimuth_deg, false, {{x, 0, 8}, {x + 1, 1, 9}}}, label);
  }
  FeatureId on(FeatureId host, const std::string& label, double across) {
    return add({{}, {}, host, 90.0, 180.0, true, box_at(180, across, 5, 6)}, label);
  }
  NameParts& operator[](FeatureId id) { return features_[id.index()]; }

  /// Texts that names are made of must outlive them.
  [[nodiscard]] std::vector<NameParts> features() const {
    std::vector<NameParts> all = features_;
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].id = ids_[i];
      all[i].label = labels_[i];
    }
    return all;
  }
  [[nodiscard]] std::vector<std::string> names() const { return feature_names(features()); }
  [[nodiscard]] std::string name(FeatureId id) const { return names()[id.index()]; }

 private:
  /// One metre wide, ten metres before the middle.
  static Box box_at(double azimuth_deg, double across, double bottom, double top) {
    const double azimuth = azimuth_deg * 3.141592653589793 / 180;
    const Vec3 right{-std::cos(azimuth), std::sin(azimuth), 0};
    const Vec3 out{std::sin(azimuth), std::cos(azimuth), 0};
    const Vec3 p = 10 * out + across * right;
    Box box;
    box.grow(p + Vec3{0, 0, bottom});
    box.grow(p + right + Vec3{0, 0, top});
    return box;
  }
  FeatureId add(NameParts feature, const std::string& label) {
    ids_.push_back(fmt::format("f{:04}", ids_.size()));
    labels_.push_back(label);
    features_.push_back(feature);
    return FeatureId{static_cast<int>(features_.size()) - 1};
  }

  std::vector<std::string> ids_, labels_;
  std::vector<NameParts> features_;
};

/// Some building with hosts before what stands on them.
Elevation any_elevation() {
  Elevation building;
  // As files have them: what lies together differs by some millimetres, half a millimetre at least.
  const auto metres = [](int most) {
    return *rc::gen::inRange(0, 2 * most) * 0.5 + *rc::gen::inRange(0, 21) * 0.0005;
  };
  const std::vector<std::string> labels = {"", "window", "door", "bay"};
  const int count = *rc::gen::inRange(1, 30);
  std::vector<FeatureId> all;
  for (int i = 0; i < count; ++i) {
    const std::string label = *rc::gen::elementOf(labels);
    const double azimuth = *rc::gen::inRange(0, 16) * 22.5;
    const double bottom = metres(9);
    const int kind = *rc::gen::inRange(0, 4);
    if (kind == 0) all.push_back(building.on_roof(label, metres(80), azimuth, metres(9)));
    if (kind == 1) all.push_back(building.on_wall(label, azimuth, metres(9), bottom, bottom + 1));
    if (kind == 2) all.push_back(building.opening(label, azimuth, metres(9), bottom, bottom + 1));
    if (kind != 3 || all.empty()) continue;
    all.push_back(building.on(*rc::gen::elementOf(all), label, metres(9)));
  }
  return building;
}

TEST_SUITE("model") {
  TEST_CASE("windows are counted from left to right as seen from outside storey by storey") {
    for (const auto& [azimuth, side] :
         {std::pair(0.0, "north"), std::pair(90.0, "east"), std::pair(180.0, "south"),
          std::pair(225.0, "southwest"), std::pair(350.0, "north")}) {
      Elevation building;
      const FeatureId right = building.opening("window", azimuth, 6, 1, 2);
      const FeatureId left = building.opening("window", azimuth, 2, 1, 2);
      const FeatureId above = building.opening("window", azimuth, 6, 4, 5);
      const FeatureId part = building.opening("", azimuth, 4, 1, 2);
      CHECK(building.name(left) == fmt::format("window 1 of facade {}, storey 1", side));
      CHECK(building.name(right) == fmt::format("window 2 of facade {}, storey 1", side));
      CHECK(building.name(above) == fmt::format("window 1 of facade {}, storey 2", side));
      CHECK(building.name(part) == fmt::format("part 1 of facade {}, storey 1", side));
    }
  }

  TEST_CASE("a door and the windows beside it are in one storey") {
    Elevation building;
    const FeatureId door = building.opening("door", 180, 0, 0, 2.1);
    const FeatureId window = building.opening("window", 180, 3, 0.9, 2.3);
    const FeatureId upper = building.opening("window", 180, 3, 3.7, 5.1);
    const FeatureId canopy = building.on_wall("canopy", 180, 0, 2.3, 2.5);
    const FeatureId sill = building.on_wall("sill", 180, 3, 3.6, 3.7);
    const FeatureId bay = building.on_wall("bay", 180, 9, 0, 5.5);
    CHECK(building.name(door) == "door 1 of facade south, storey 1");
    CHECK(building.name(window) == "window 1 of facade south, storey 1");
    CHECK(building.name(upper) == "window 1 of facade south, storey 2");
    CHECK(building.name(canopy) == "canopy 1 of facade south, storey 1");
    CHECK(building.name(sill) == "sill 1 of facade south, storey 2");
    // It reaches from one into the other.
    CHECK(building.name(bay) == "bay 1 of facade south");
  }

  TEST_CASE("what has no label makes no storey where something has one") {
    Elevation building;
    const FeatureId groove = building.opening("", 180, 0, 0, 0.2);
    const FeatureId window = building.opening("window", 180, 3, 1, 2);
    CHECK(building.name(window) == "window 1 of facade south, storey 1");
    CHECK(building.name(groove) == "part 1 of facade south, storey 1");
  }

  TEST_CASE("glass over several storeys does not make one of them") {
    Elevation building;
    building.opening("window", 90, 0, 0, 9);
    std::vector<FeatureId> windows;
    for (const double bottom : {1.0, 4.0, 7.0})
      windows.push_back(building.opening("window", 180, 0, bottom, bottom + 1.2));
    CHECK(building.name(windows[0]) == "window 1 of facade south, storey 1");
    CHECK(building.name(windows[1]) == "window 1 of facade south, storey 2");
    CHECK(building.name(windows[2]) == "window 1 of facade south, storey 3");
  }

  TEST_CASE("a landing window between the storeys takes no window of the one below") {
    Elevation building;
    const FeatureId first = building.opening("window", 180, 0, 0.9, 2.3);
    const FeatureId short_one = building.opening("window", 180, 3, 1.5, 2.3);
    const FeatureId landing = building.opening("window", 180, 6, 1.2, 3.8);
    CHECK(building.name(first) == "window 1 of facade south, storey 1");
    CHECK(building.name(short_one) == "window 2 of facade south, storey 1");
    CHECK(building.name(landing) == "window 1 of facade south");
  }

  TEST_CASE("roofs have slopes and what stands on a part is named after it") {
    Elevation building;
    const FeatureId chimney = building.on_roof("chimney", 40, 0, 2);
    const FeatureId dormer = building.on_roof("dormer", 40, 180, 2);
    const FeatureId window = building.on(dormer, "window", 0);
    const FeatureId pane = building.on(window, "", 0);
    const FeatureId bead = building.on(pane, "", 0);
    const FeatureId vent = building.on_roof("vent", 2, 180, 2);
    const FeatureId under = building.on_roof("", 180, 0, 2);
    CHECK(building.name(chimney) == "chimney 1 of roof slope north");
    CHECK(building.name(window) == "window 1 of dormer 1 of roof slope south");
    CHECK(building.name(pane) == "part 1 of window 1 of dormer 1 of roof slope south");
    // The nearest with a label counts.
    CHECK(building.name(bead) == "part 2 of window 1 of dormer 1 of roof slope south");
    CHECK(building.name(vent) == "vent 1 of the flat roof");
    CHECK(building.name(under) == "part 1 of the underside");
  }

  TEST_CASE("names within names end after three places") {
    Elevation building;
    FeatureId top = building.on_roof("dormer", 40, 180, 2);
    for (int i = 0; i < 5; ++i) top = building.on(top, "box", i);
    for (const std::string& name : building.names()) {
      std::size_t places = 0;
      for (std::size_t at = name.find(" of "); at != std::string::npos;
           at = name.find(" of ", at + 1))
        ++places;
      CHECK(places <= static_cast<std::size_t>(kMostPlaces));
    }
    CHECK(building.name(top).ends_with(" of box 1 of dormer 1 of roof slope south"));
  }

  TEST_CASE("hosts that go round in a circle have names") {
    Elevation building;
    const FeatureId a = building.opening("window", 180, 0, 1, 2);
    const FeatureId b = building.opening("door", 180, 2, 1, 2);
    building[a].host = b;
    building[b].host = a;
    const FeatureId c = building.opening("", 180, 4, 1, 2);
    building[c].host = c;
    const auto names = building.names();
    CHECK(std::set(names.begin(), names.end()).size() == 3);
  }

  TEST_CASE("no two features of a building have the same name") {
    CHECK(rc::check([] {
      const auto names = any_elevation().names();
      const std::set<std::string> once(names.begin(), names.end());
      RC_ASSERT(once.size() == names.size());
      RC_ASSERT(!once.contains(""));
    }));
  }

  TEST_CASE("names do not depend on the order of features nor on the origin") {
    CHECK(rc::check([] {
      const Elevation building = any_elevation();
      const std::vector<NameParts> features = building.features();
      const std::vector<std::string> names = feature_names(features);
      std::vector<std::size_t> order(features.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::shuffle(order.begin(), order.end(), std::mt19937(*rc::gen::inRange(0, 1000)));
      std::vector<int> row_of(order.size());
      for (std::size_t i = 0; i < order.size(); ++i) row_of[order[i]] = static_cast<int>(i);
      std::vector<NameParts> shuffled;
      for (const std::size_t row : order) {
        NameParts feature = features[row];
        if (feature.host.is_valid()) feature.host = FeatureId{row_of[feature.host.index()]};
        feature.box = feature.box.moved({604000, 5403766, 370});
        shuffled.push_back(feature);
      }
      const std::vector<std::string> same = feature_names(shuffled);
      for (std::size_t i = 0; i < order.size(); ++i) RC_ASSERT(same[i] == names[order[i]]);
    }));
  }

  TEST_CASE("a name is found whatever its case and commas and by its beginning") {
    const std::vector<std::string> names = {
        "window 1 of facade south, storey 1", "window 1 of facade south, storey 2",
        "window 10 of facade south, storey 1", "door 1 of facade south, storey 1"};
    using Rows = std::vector<std::size_t>;
    CHECK(find_names(names, "Window 1 of FACADE south storey  2 ") == Rows{1});
    CHECK(find_names(names, "window 1 of facade south, storey 1") == Rows{0});
    CHECK(find_names(names, "window 1") == Rows{0, 1});
    CHECK(find_names(names, "door") == Rows{3});
    CHECK(find_names(names, "doo").empty());
    CHECK(find_names(names, "").empty());
    CHECK(find_names(names, " , ").empty());
  }

  TEST_CASE("the names nearest to one that there is not are those of the fewest edits") {
    const std::vector<std::string> names = {"window 1 of facade south, storey 1",
                                            "window 2 of facade south, storey 1",
                                            "chimney 1 of roof slope north"};
    CHECK(nearest_names(names, "chimny 1 of roof slope north", 1) == std::vector{names[2]});
    CHECK(nearest_names(names, "window 3 of facade south, storey 1", 2) ==
          std::vector{names[0], names[1]});
    // The beginning of a name is compared with beginnings.
    CHECK(nearest_names(names, "chmney", 1) == std::vector{names[2]});
    CHECK(nearest_names(names, "widnow 2 of facde", 1) == std::vector{names[1]});
    CHECK(nearest_names({}, "window", 3).empty());
    CHECK(nearest_names(names, std::string(100'000, 'w'), 9).size() == 3);
  }
}

}  // namespace
}  // namespace oriel
