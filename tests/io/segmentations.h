#pragma once

#include "model/building.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/segmentation.h"

#include <string>

namespace oriel::test {

/// A building with a bay (f0) and a window in it (f1), enough of a segmentation to be written.
struct SmallSegmentation {
  Building building;
  Segmentation segmentation;
  FeatureTable table;
  FeatureGraph graph;

  SmallSegmentation() : table("house", 2) {
    building.id = "house";
    building.frame = {{678114, 5403766, 414}, "EPSG:25832"};
    Plane plane;
    plane.normal = {0, -1, 0};
    plane.offset_m = -0.5;
    segmentation.planes = {plane, plane};
    segmentation.cells.resize(3);
    segmentation.cells[2].sign = -1;
    segmentation.cells[2].volume_m3 = 0.125;
    segmentation.cells[2].flag = LeafFlag::own;
    segmentation.nodes.resize(5);
    segmentation.nodes[0] = {CsgNode::Kind::unite, {PlaneId{0}}, 0.25, 0.5,
                             {NodeId{1}},          {NodeId{2}},  {}};
    segmentation.nodes[1].cell = CellId{0};
    segmentation.nodes[2] = {
        CsgNode::Kind::subtract, {PlaneId{1}}, 0.75, {}, {NodeId{3}}, {NodeId{4}}, {}};
    segmentation.nodes[3].cell = CellId{1};
    segmentation.nodes[4].cell = CellId{2};
    segmentation.root = NodeId{0};

    Feature bay;
    bay.node = NodeId{2};
    bay.planes = {PlaneId{0}};
    bay.value = 0.25;
    bay.box = {{0, 0, 0}, {1, 2, 3}};
    bay.source_polygons = {1, 2, 5};
    Feature window;
    window.sense = Sense::hole;
    window.parent = window.host = FeatureId{0};
    window.node = NodeId{4};
    window.is_natural = true;
    window.planes = {PlaneId{1}};
    window.volume_m3 = 0.1;
    window.box = {{0.25, 0.5, 1}, {0.75, 0.625, 2}};
    window.source_polygons = {5};
    segmentation.features = {bay, window};
    segmentation.stats = {3, 2, 5, 10, 20, 4};
    segmentation.issues = {
        {Severity::warning, Code::E901, "a \"budget\"", {"", 0, 0, "house", "w1"}, ""}};

    table.set_id(FeatureId{0}, "b1");
    table.set_id(FeatureId{1}, "w1");
    table.set(FeatureId{0}, Attribute::volume, 1.0 / 3);
    table.set(FeatureId{1}, Attribute::natural, 1);
    table.set(FeatureId{1}, Attribute::sense, "hole");
    graph.set("host", {{FeatureId{1}, FeatureId{0}}});
    graph.set("contains", {{FeatureId{0}, FeatureId{1}}});
    graph.set("alike", {{FeatureId{1}, FeatureId{0}}, {FeatureId{0}, FeatureId{1}}});
  }
};

}  // namespace oriel::test
