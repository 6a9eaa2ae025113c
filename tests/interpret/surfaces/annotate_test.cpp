#include "interpret/surfaces/annotate.h"

#include "kernel/describe/surfaces.h"
#include "model/version.h"
#include "tests/interpret/support.h"

#include <algorithm>
#include <numeric>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A rectangle from `corner` along two edges; it looks along their cross product.
struct Rectangle {
  Vec3 corner, first, second;
};

/// A house put together from polygons, with features that list some of them.
class House {
 public:
  int add(const Rectangle& r) {
    Polygon polygon;
    polygon.source = static_cast<int>(building.polygons.size());
    polygon.rings.emplace_back();
    for (const Vec3 p :
         {r.corner, r.corner + r.first, r.corner + r.first + r.second, r.corner + r.second}) {
      polygon.rings[0].push_back(static_cast<int>(building.vertices.size()));
      building.vertices.push_back(p);
    }
    building.polygons.push_back(polygon);
    return polygon.source;
  }

  /// A feature on a facet that is made of the polygons `around`.
  FeatureId add_feature(const char* label, Sense sense, double volume_m3, std::vector<int> polygons,
                        std::vector<int> around = {}) {
    Feature feature;
    feature.sense = sense;
    feature.volume_m3 = volume_m3;
    for (const int polygon : polygons)
      for (const int v : building.polygons[static_cast<std::size_t>(polygon)].rings[0])
        feature.box.grow(building.vertices[static_cast<std::size_t>(v)]);
    feature.source_polygons = std::move(polygons);
    if (!around.empty()) {
      segmentation.cells.emplace_back();
      segmentation.cells.back().facets.emplace_back();
      segmentation.cells.back().facets[0].polygons = std::move(around);
      segmentation.cells.back().facets[0].plane = PlaneId{0};
      feature.host_facet = CellFacet{CellId{static_cast<int>(segmentation.cells.size()) - 1}, 0};
    }
    segmentation.features.push_back(feature);
    const FeatureId id = scene.add({{"host_inclination", 90.0}});
    interpretation.verdicts.push_back({id, label, 0.876543, 0.5, "some.rule", ""});
    return id;
  }

  [[nodiscard]] SurfaceTable surfaces() const {
    const FeatureTable features = scene.table();
    return describe_surfaces(building, {}, {nullptr, &segmentation, &features});
  }

  [[nodiscard]] LabelledBuilding annotated(const AnnotateOptions& options = {}) const {
    const auto residential = load_pack_file("residential");
    REQUIRE(residential.value);
    return annotate(building, segmentation, scene.table(), scene.graph(), surfaces(),
                    interpretation, *residential.value, options);
  }

  Building building;
  Segmentation segmentation;
  Interpretation interpretation;
  Scene scene;
};

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

Vec3 times(double s, Vec3 p) { return s * p; }

/// Polygons 0 ground, 1 roof, 2 and 3 the left and the right half of the front wall.
House house() {
  House house;
  house.building.id = "b1";
  house.segmentation.planes.push_back({.normal = {0, -1, 0}});
  house.add({{0, 0, 0}, times(8, kY), times(10, kX)});
  house.add({{0, 0, 6}, times(10, kX), times(8, kY)});
  house.add({{0, 0, 0}, times(5, kX), times(6, kZ)});
  house.add({{5, 0, 0}, times(5, kX), times(6, kZ)});
  return house;
}

/// A recess of 1 x 1 m in the front wall at (x, z): pane, sill, lintel.
std::vector<int> add_recess(House& house, double x, double z) {
  return {house.add({{x, 0.1, z}, kX, kZ}), house.add({{x, 0, z}, kX, times(0.1, kY)}),
          house.add({{x, 0.1, z + 1}, kX, times(-0.1, kY)})};
}

std::string type_at(const LabelledBuilding& labelled, int polygon) {
  const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(polygon)];
  return surface < 0 ? "-" : labelled.surfaces[static_cast<std::size_t>(surface)].type;
}

/// The member called `name`, or "" where there is none.
std::string text_of(const Members& members, const std::string& name) {
  for (const auto& [key, value] : members)
    if (key == name) return std::get<std::string>(value);
  return "";
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a flush frame that is a window takes the polygons of its sashes") {
    House h = house();
    const int frame = h.add({{2, 0, 1}, times(2, kX), kZ});
    const auto left = add_recess(h, 2.1, 1), right = add_recess(h, 3.1, 1);
    const FeatureId left_sash = h.add_feature("", Sense::hole, 0.05, left, {2});
    const FeatureId right_sash = h.add_feature("", Sense::hole, 0.05, right, {2});
    std::vector<int> all{frame};
    all.insert(all.end(), left.begin(), left.end());
    all.insert(all.end(), right.begin(), right.end());
    const FeatureId window = h.add_feature("window", Sense::imprint, 0, all, {2});
    const auto hosted_by_window = [&](FeatureId sash) {
      h.segmentation.features[sash.index()].host = window;
    };
    hosted_by_window(left_sash);
    hosted_by_window(right_sash);
    const LabelledBuilding labelled = h.annotated();
    for (const int polygon : all) {
      CHECK(type_at(labelled, polygon) == "Window");
      CHECK(labelled.surface_of_polygon[static_cast<std::size_t>(polygon)] ==
            labelled.surface_of_polygon[static_cast<std::size_t>(frame)]);
    }
    CHECK(type_at(labelled, 2) == "WallSurface");
    const SemanticSurface& surface = labelled.surfaces[static_cast<std::size_t>(
        labelled.surface_of_polygon[static_cast<std::size_t>(frame)])];
    CHECK(surface.label->parts ==
          std::vector{h.scene.table().id(left_sash), h.scene.table().id(right_sash)});
  }

  TEST_CASE("the sill of a sash in an unlabelled frame belongs to the wall") {
    House h = house();
    const int frame = h.add({{2, 0, 1}, times(2, kX), kZ});
    const auto sash = add_recess(h, 2.1, 1);
    const FeatureId hole = h.add_feature("", Sense::hole, 0.05, sash, {2});
    std::vector<int> all{frame};
    all.insert(all.end(), sash.begin(), sash.end());
    const FeatureId owner = h.add_feature("", Sense::imprint, 0, all, {2});
    h.segmentation.features[hole.index()].host = owner;
    CHECK(type_at(h.annotated(), sash[1]) == "WallSurface");
  }

  TEST_CASE("every polygon is a surface named by where it looks") {
    House h = house();
    const int overhang = h.add({{10, 0, 3}, times(8, kY), kX});
    const LabelledBuilding labelled = h.annotated();
    CHECK(labelled.building == "b1");
    CHECK(type_at(labelled, 0) == "GroundSurface");
    CHECK(type_at(labelled, 1) == "RoofSurface");
    CHECK(type_at(labelled, 2) == "WallSurface");
    CHECK(type_at(labelled, 3) == "WallSurface");
    CHECK(type_at(labelled, overhang) == "OuterCeilingSurface");
    CHECK(labelled.surfaces.size() == 5);
    CHECK(labelled.installations.empty());
    CHECK_FALSE(labelled.geometry);
  }

  TEST_CASE("a window is one surface in the wall polygon it lies in") {
    House h = house();
    const std::vector<int> window = add_recess(h, 6, 2);
    h.add_feature("window", Sense::hole, 0.1, window, {2, 3});
    const LabelledBuilding labelled = h.annotated();
    const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(window[0])];
    for (const int polygon : window)
      CHECK(labelled.surface_of_polygon[static_cast<std::size_t>(polygon)] == surface);
    const SemanticSurface& pane = labelled.surfaces[static_cast<std::size_t>(surface)];
    CHECK(pane.type == "Window");
    CHECK(pane.parent == labelled.surface_of_polygon[3]);
    CHECK(pane.label->id == "f0");
    CHECK(pane.label->name == "window 1 of the walls and roofs");
    CHECK(pane.label->label == "window");
    CHECK(pane.label->rule == "some.rule");
    CHECK(pane.label->subclass.empty());
    CHECK(pane.label->score == 0.8765);
  }

  TEST_CASE("what is inside a window without a label is part of it") {
    House h = house();
    std::vector<int> window = add_recess(h, 2, 2);
    const int sash = h.add({{2.2, 0.15, 2.2}, times(0.4, kX), times(0.4, kZ)});
    window.push_back(sash);
    h.add_feature("window", Sense::hole, 0.1, window, {2});
    h.add_feature("", Sense::hole, 0.01, {sash});
    CHECK(type_at(h.annotated(), sash) == "Window");
  }

  TEST_CASE("a niche too narrow for a foot belongs to the wall") {
    House h = house();
    const std::vector<int> niche = add_recess(h, 2, 2);
    h.add_feature("", Sense::hole, 0.1, niche, {2});
    const LabelledBuilding labelled = h.annotated();
    CHECK(type_at(labelled, niche[0]) == "WallSurface");
    CHECK(type_at(labelled, niche[1]) == "WallSurface");
    CHECK(type_at(labelled, niche[2]) == "WallSurface");
  }

  TEST_CASE("a balcony is an installation with its polygons and codes") {
    House h = house();
    const int top = h.add({{2, -1, 3}, times(2, kX), kY});
    const int front = h.add({{2, -1, 2.8}, times(2, kX), times(0.2, kZ)});
    const int below = h.add({{2, -1, 2.8}, kY, times(2, kX)});
    h.add_feature("balcony", Sense::protrusion, 0.4, {top, front, below}, {2});
    const LabelledBuilding labelled = h.annotated();
    REQUIRE(labelled.installations.size() == 1);
    const Installation& balcony = labelled.installations[0];
    CHECK(balcony.id == "f0");
    CHECK(balcony.polygons == std::vector<int>{top, front, below});
    REQUIRE(balcony.surfaces.size() == 3);
    CHECK(balcony.surfaces[0] == labelled.surface_of_polygon[static_cast<std::size_t>(top)]);
    CHECK(type_at(labelled, top) == "OuterFloorSurface");
    CHECK(type_at(labelled, front) == "WallSurface");
    CHECK(type_at(labelled, below) == "OuterCeilingSurface");
    CHECK(balcony.label->class_code == "1000");
    CHECK(balcony.label->function == "1000");
    CHECK(balcony.label->codelist == "sig3d");
    CHECK(balcony.label->label == "balcony");

    const LabelledBuilding other = h.annotated({.codelist = "none", .attributes = {}});
    CHECK(other.installations[0].label->function.empty());
    CHECK(other.installations[0].label->codelist.empty());
  }

  TEST_CASE("a protrusion of a class that is not emitted is an installation without codes") {
    House h = house();
    const int top = h.add({{2, -1, 3}, times(2, kX), kY});
    const int below = h.add({{2, -1, 2.8}, kY, times(2, kX)});
    const int lamp = h.add({{2.5, -0.5, 2.7}, times(0.2, kY), times(0.2, kX)});
    h.add_feature("shelf", Sense::protrusion, 0.4, {top, below, lamp}, {2});
    h.add_feature("lamp", Sense::protrusion, 0.1, {lamp});
    const LabelledBuilding labelled = h.annotated();
    REQUIRE(labelled.installations.size() == 2);
    const Installation& shelf = labelled.installations[0];
    CHECK(shelf.polygons == std::vector<int>{top, below});
    CHECK(shelf.label->label == "shelf");
    CHECK(shelf.label->id == "f0");
    CHECK(shelf.label->class_code.empty());
    CHECK(shelf.label->function.empty());
    CHECK(labelled.installations[1].polygons == std::vector<int>{lamp});
    CHECK(type_at(labelled, below) == "OuterCeilingSurface");
  }

  TEST_CASE("a hole or a panel of a class that is not emitted is named by its surfaces") {
    for (const Sense sense : {Sense::hole, Sense::imprint}) {
      House h = house();
      const std::vector<int> niche = add_recess(h, 2, 2);
      h.add_feature("niche", sense, 0.1, niche, {2});
      const LabelledBuilding labelled = h.annotated();
      CHECK(labelled.installations.empty());
      for (const int polygon : niche) {
        const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(polygon)];
        const SharedLabel& label = labelled.surfaces[static_cast<std::size_t>(surface)].label;
        CHECK(type_at(labelled, polygon) == "WallSurface");
        CHECK(label->label == "niche");
        CHECK(label->id == "f0");
        CHECK(label->rule == "some.rule");
        // One surface for all of them: they are of one type.
        CHECK(surface == labelled.surface_of_polygon[static_cast<std::size_t>(niche[0])]);
      }
      const int wall = labelled.surface_of_polygon[2];
      CHECK(labelled.surfaces[static_cast<std::size_t>(wall)].label == SharedLabel());
    }
  }

  TEST_CASE("what is not emitted in a window stays window and names its part of it") {
    House h = house();
    std::vector<int> window = add_recess(h, 2, 2);
    const int lamella = h.add({{2.2, 0.15, 2.2}, times(0.4, kX), times(0.4, kZ)});
    window.push_back(lamella);
    h.add_feature("window", Sense::hole, 0.1, window, {2});
    h.add_feature("lamella", Sense::hole, 0.01, {lamella});
    const LabelledBuilding labelled = h.annotated();
    const auto surface_at = [&](int polygon) {
      return labelled.surfaces[static_cast<std::size_t>(
          labelled.surface_of_polygon[static_cast<std::size_t>(polygon)])];
    };
    CHECK(surface_at(lamella).type == "Window");
    CHECK(surface_at(lamella).label->label == "lamella");
    CHECK(surface_at(lamella).parent == surface_at(window[0]).parent);
    CHECK(surface_at(window[0]).label->label == "window");
  }

  TEST_CASE("a window of which another feature has all polygons keeps them") {
    House h = house();
    const std::vector<int> window = add_recess(h, 2, 2);
    h.add_feature("window", Sense::hole, 0.1, window, {2});
    h.add_feature("lamella", Sense::hole, 0.01, window);
    const LabelledBuilding labelled = h.annotated();
    for (const int polygon : window) {
      const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(polygon)];
      CHECK(labelled.surfaces[static_cast<std::size_t>(surface)].label->label == "window");
    }
  }

  TEST_CASE("a dormer holds its window and a chimney on it stands alone") {
    House h = house();
    const int front = h.add({{2, 1, 6}, times(2, kX), times(2, kZ)});
    const int roof = h.add({{2, 1, 8}, times(2, kX), times(2, kY)});
    const int pane = h.add({{2.5, 1.1, 6.5}, kX, kZ});
    const int flue = h.add({{3, 2, 9}, times(0.5, kX), times(0.5, kY)});
    h.add_feature("dormer", Sense::protrusion, 8, {front, roof, pane, flue}, {1});
    h.add_feature("window", Sense::hole, 0.1, {pane}, {front});
    h.add_feature("chimney", Sense::protrusion, 0.2, {flue}, {roof});
    const LabelledBuilding labelled = h.annotated({.codelist = "plateau", .attributes = {}});
    REQUIRE(labelled.installations.size() == 2);
    CHECK(labelled.installations[0].polygons == std::vector<int>{front, roof, pane});
    CHECK(labelled.installations[1].polygons == std::vector<int>{flue});
    CHECK(labelled.installations[0].label->function == "1053");
    CHECK(type_at(labelled, pane) == "Window");
    CHECK(type_at(labelled, roof) == "RoofSurface");
    const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(pane)];
    CHECK(labelled.surfaces[static_cast<std::size_t>(surface)].parent ==
          labelled.surface_of_polygon[static_cast<std::size_t>(front)]);
    CHECK(labelled.installations[0].surfaces[2] == surface);
  }

  TEST_CASE("an opening in a facet that a cut made finds the wall around it") {
    House h = house();
    const std::vector<int> window = add_recess(h, 6, 2);
    h.add_feature("window", Sense::hole, 0.1, window, {window[0]});
    const LabelledBuilding labelled = h.annotated();
    const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(window[0])];
    CHECK(labelled.surfaces[static_cast<std::size_t>(surface)].parent ==
          labelled.surface_of_polygon[3]);
  }

  TEST_CASE("an opening without a host facet has no parent") {
    House h = house();
    const std::vector<int> window = add_recess(h, 2, 2);
    h.add_feature("window", Sense::hole, 0.1, window);
    const LabelledBuilding labelled = h.annotated();
    const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(window[0])];
    CHECK(labelled.surfaces[static_cast<std::size_t>(surface)].parent == -1);
  }

  TEST_CASE("the order of the features does not matter") {
    House h = house();
    std::vector<int> window = add_recess(h, 2, 2);
    const int sash = h.add({{2.2, 0.15, 2.2}, times(0.4, kX), times(0.4, kZ)});
    window.push_back(sash);
    h.add_feature("", Sense::hole, 0.01, {sash});
    h.add_feature("window", Sense::hole, 0.1, window, {2});
    CHECK(type_at(h.annotated(), sash) == "Window");
  }

  TEST_CASE("a finer class is written as what it is a kind of") {
    const RuleBase base = load(
        "schema: oriel/1\n"
        "pack: {name: t, version: 1.0.0}\n"
        "classes: {window: {}, roof_window: {is: window}}\n"
        "rules: [{id: r, label: roof_window, require: sense = hole}]\n");
    House h = house();
    const std::vector<int> window = add_recess(h, 2, 2);
    h.add_feature("roof_window", Sense::hole, 0.1, window, {2});
    const LabelledBuilding labelled =
        annotate(h.building, h.segmentation, h.scene.table(), h.scene.graph(), h.surfaces(),
                 h.interpretation, base);
    const int surface = labelled.surface_of_polygon[static_cast<std::size_t>(window[0])];
    const SemanticSurface& pane = labelled.surfaces[static_cast<std::size_t>(surface)];
    CHECK(pane.type == "Window");
    CHECK(pane.label->label == "window");
    CHECK(pane.label->subclass == "roof_window");
  }

  TEST_CASE("the building says by what it was labelled") {
    const House h = house();
    const LabelledBuilding labelled =
        h.annotated({.codelist = "sig3d", .attributes = {{"oriel_config_sha256", "abc"}}});
    CHECK(text_of(labelled.attributes, "oriel_version") == kVersion);
    CHECK(text_of(labelled.attributes, "oriel_pack") == "residential 1.0.0");
    CHECK(text_of(labelled.attributes, "oriel_pack_sha256").size() == 64);
    CHECK(text_of(labelled.attributes, "oriel_config_sha256") == "abc");
  }
}
