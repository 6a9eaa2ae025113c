#include "io/records/stage_json.h"

#include "kernel/base/text/json_text.h"
#include "model/description/feature_names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace oriel {

namespace {

using oriel::append_field;

void append_field(std::string& out, std::string_view key, const std::optional<double>& value) {
  append_field(out, key, value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

void append_field(std::string& out, std::string_view key, std::size_t count) {
  append_field(out, key, static_cast<std::int64_t>(count));
}

template <class Ids>
void append_ids(std::string& out, std::string_view key, const Ids& ids) {
  std::vector<int> numbers;
  numbers.reserve(ids.size());
  for (const auto id : ids) numbers.push_back(id.value);
  append_json_key(out, key);
  append_json_array(out, numbers);
}

void append_planes(std::string& out, const Segmentation& segmentation) {
  append_objects(out, "planes", segmentation.planes, [&](const Plane& plane) {
    append_field(out, "id", static_cast<int>(&plane - segmentation.planes.data()));
    append_vector(out, "normal", plane.normal);
    append_field(out, "offset_m", plane.offset_m);
  });
}

void append_cells(std::string& out, const Segmentation& segmentation) {
  append_objects(out, "cells", segmentation.cells, [&](const Cell& cell) {
    append_field(out, "id", static_cast<int>(&cell - segmentation.cells.data()));
    append_field(out, "sign", cell.sign);
    append_field(out, "volume_m3", cell.volume_m3);
    append_field(out, "convex", cell.is_convex);
    append_field(out, "flag", std::string_view(to_string(cell.flag)));
  });
}

/// Appends the kind of a node, and what a leaf is or where another node was cut.
void append_node(std::string& out, const CsgNode& node) {
  if (node.kind == CsgNode::Kind::leaf) {
    append_field(out, "kind", std::string_view("leaf"));
    append_field(out, "cell", node.cell.value);
    return;
  }
  const bool is_union = node.kind == CsgNode::Kind::unite;
  append_field(out, "kind", std::string_view(is_union ? "union" : "difference"));
  append_ids(out, "planes", node.planes);
  append_field(out, "value", node.value);
  append_field(out, "quality", node.quality);
}

/// Appends a tree as nested objects, or null. What is still to be written waits on a stack of its
/// own, so that deep trees do not need the program's.
void append_nested(std::string& out, std::span<const CsgNode> nodes, NodeId root) {
  append_json_key(out, "tree");
  std::vector<std::variant<std::string_view, NodeId>> todo{root};
  if (!root.is_valid()) todo.front() = "null";
  const auto push = [&](const std::vector<NodeId>& children) {
    for (std::size_t i = children.size(); i-- > 0;) {
      todo.emplace_back(children[i]);
      if (i > 0) todo.emplace_back(",");
    }
  };
  while (!todo.empty()) {
    const auto item = todo.back();
    todo.pop_back();
    if (const auto* text = std::get_if<std::string_view>(&item)) {
      out += *text;
      continue;
    }
    const CsgNode& node = nodes[std::get<NodeId>(item).index()];
    out += '{';
    append_node(out, node);
    out += node.kind == CsgNode::Kind::leaf ? "}" : R"(,"rest":[)";
    if (node.kind == CsgNode::Kind::leaf) continue;
    todo.emplace_back("]}");
    push(node.parts);
    todo.emplace_back(R"(],"parts":[)");
    push(node.rest);
  }
}

template <class Id>
void append_id(std::string& out, std::string_view key, Id id) {
  append_json_key(out, key);
  if (id.is_valid())
    append_json(out, id.value);
  else
    out += "null";
}

/// Vertices are numbered anew: those that faces use, in their order.
void append_complex(std::string& out, const CellComplex& complex, std::size_t cells) {
  std::vector<int> number(complex.vertices().size(), -1);
  for (const Face& face : complex.faces())
    for (const Loop& loop : face.loops)
      for (const int v : loop) number[static_cast<std::size_t>(v)] = 0;
  std::vector<Vec3> used;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(used.size());
    used.push_back(complex.vertices()[v].point);
  }
  append_list(out, "vertices", used, [&](Vec3 v) {
    append_json_array(out, std::array{v.x, v.y, v.z});
  });
  append_objects(out, "faces", complex.faces(), [&](const Face& face) {
    append_field(out, "id", static_cast<int>(&face - complex.faces().data()));
    append_field(out, "plane", face.plane.value);
    append_id(out, "front", face.front);
    append_id(out, "behind", face.behind);
    append_field(out, "area_m2", face.area_m2);
    append_list(out, "loops", face.loops, [&](Loop loop) {
      for (int& v : loop) v = number[static_cast<std::size_t>(v)];
      append_json_array(out, loop);
    });
  });
  // Each pair once, at the cell with the smaller id; the outside is always the neighbour.
  std::vector<std::pair<CellId, Contact>> contacts;
  for (int c = 0; c < static_cast<int>(cells); ++c)
    for (const Contact& contact : complex.neighbours({c}))
      if (!contact.cell.is_valid() || contact.cell.value > c)
        contacts.emplace_back(CellId{c}, contact);
  append_objects(out, "contacts", contacts, [&](const std::pair<CellId, Contact>& contact) {
    append_id(out, "cell", contact.first);
    append_id(out, "neighbour", contact.second.cell);
    append_field(out, "area_m2", contact.second.area_m2);
  });
  append_field(out, "open_edges", complex.open_edge_count());
}

void append_id(std::string& out, std::string_view key, const FeatureTable& table, FeatureId id) {
  append_json_key(out, key);
  if (id.is_valid())
    append_json(out, std::string_view(table.id(id)));
  else
    out += "null";
}

/// "natural" for a cut along existing edges; then, of a feature that is not split further, why.
std::vector<std::string> flags_of(const Segmentation& segmentation, const Feature& feature) {
  std::vector<std::string> flags;
  if (feature.is_natural) flags.emplace_back("natural");
  if (feature.is_uncut) flags.emplace_back("uncut");
  if (!feature.node.is_valid()) return flags;
  const CsgNode& node = segmentation.nodes[feature.node.index()];
  if (node.kind == CsgNode::Kind::leaf && node.cell.is_valid())
    flags.push_back(to_string(segmentation.cells[node.cell.index()].flag));
  return flags;
}

void append_feature(std::string& out, const Building& building, const Segmentation& segmentation,
                    const FeatureTable& table, const Feature& feature, const std::string& name) {
  const FeatureId id{static_cast<int>(&feature - segmentation.features.data())};
  const bool has_cut =
      (feature.sense == Sense::protrusion || feature.sense == Sense::hole) && !feature.is_uncut;
  const Box box = feature.box.moved(building.frame.origin_m);
  out += '{';
  append_id(out, "id", table, id);
  append_field(out, "name", std::string_view(name));
  append_id(out, "parent", table, feature.parent);
  append_id(out, "host", table, feature.host);
  append_field(out, "sense", std::string_view(to_string(feature.sense)));
  append_field(out, "value", feature.value);
  append_field(out, "quality", feature.quality);
  append_field(out, "new_area_m2", feature.new_area_m2);
  append_field(out, "old_area_m2", feature.old_area_m2);
  append_ids(out, "planes", feature.planes);
  append_field(out, "split_order", has_cut ? feature.planes.size() : 0);
  append_field(out, "volume_m3", feature.volume_m3);
  append_json_key(out, "aabb_m");
  append_json_array(out,
                    std::array{box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z});
  append_json_key(out, "source_polygons");
  append_json_array(out, feature.source_polygons);
  append_json_key(out, "flags");
  append_json_array(out, flags_of(segmentation, feature));
  out += '}';
}

void append_stats(std::string& out, const SegmentationStats& stats) {
  append_json_key(out, "stats");
  out += '{';
  append_field(out, "leaves", stats.leaves);
  append_field(out, "inner", stats.inner);
  append_field(out, "recursions", stats.recursions);
  append_field(out, "protrusion_tests", stats.protrusion_tests);
  append_field(out, "hole_tests", stats.hole_tests);
  append_field(out, "candidates", stats.candidates);
  append_field(out, "instanced", stats.instanced);
  out += '}';
}

void append_issue(std::string& out, const Issue& issue) {
  out += '{';
  append_field(out, "severity", std::string_view(to_string(issue.severity)));
  append_field(out, "code", to_string(issue.code));
  append_field(out, "sentence", std::string_view(issue.sentence));
  append_field(out, "feature", std::string_view(issue.place.feature));
  out += '}';
}

}  // namespace

void append_tree(std::string& out, std::span<const CsgNode> nodes, NodeId root, TreeForm form) {
  if (form == TreeForm::nested) return append_nested(out, nodes, root);
  append_id(out, "root", root);
  append_objects(out, "nodes", nodes, [&](const CsgNode& node) {
    append_field(out, "id", static_cast<int>(&node - nodes.data()));
    append_node(out, node);
    if (node.kind == CsgNode::Kind::leaf) return;
    append_ids(out, "rest", node.rest);
    append_ids(out, "parts", node.parts);
  });
}

std::string segmentation_json(const Building& building, const Segmentation& segmentation,
                              const FeatureTable& table, const CellComplex* complex,
                              TreeForm form) {
  std::string out = "{";
  append_field(out, "id", std::string_view(building.id));
  append_json_key(out, "frame");
  out += '{';
  append_vector(out, "origin_m", building.frame.origin_m);
  append_field(out, "crs", std::string_view(building.frame.crs));
  out += '}';
  append_planes(out, segmentation);
  append_field(out, "order", std::string_view(to_string(segmentation.order)));
  append_cells(out, segmentation);
  if (complex != nullptr) append_complex(out, *complex, segmentation.cells.size());
  append_tree(out, segmentation.nodes, segmentation.root, form);
  const std::vector<std::string> names = feature_names(segmentation, table, nullptr);
  append_list(out, "features", segmentation.features, [&](const Feature& feature) {
    const auto row = static_cast<std::size_t>(&feature - segmentation.features.data());
    append_feature(out, building, segmentation, table, feature, names.at(row));
  });
  append_stats(out, segmentation.stats);
  append_list(out, "issues", segmentation.issues,
              [&](const Issue& issue) { append_issue(out, issue); });
  return out + "}\n";
}

namespace {

void append_left_out(std::string& out, std::string_view key, const std::vector<int>& polygons,
                     double area_m2) {
  append_json_key(out, key);
  out += '{';
  append_field(out, "area_m2", area_m2);
  append_json_key(out, "polygons");
  append_json_array(out, polygons);
  out += '}';
}

}  // namespace

std::string repair_json(const Building& building, bool is_solid, const RepairReport& report,
                        const std::vector<Issue>& issues) {
  const Vec3 origin = building.frame.origin_m;
  std::string out = "{";
  append_field(out, "id", building.id);
  append_field(out, "is_solid", is_solid);
  append_field(out, "was_needed", report.was_needed);
  append_json_key(out, "duplicates");
  append_json_array(out, report.duplicates);
  append_field(out, "t_vertices", report.t_vertices);
  append_field(out, "cut", report.cut);
  append_field(out, "crowded_edges", report.crowded_edges);
  append_field(out, "turned", report.turned);
  append_left_out(out, "dangling", report.dangling, report.dangling_area_m2);
  append_left_out(out, "inner", report.inner, report.inner_area_m2);
  append_objects(out, "caps", report.caps, [&](const Cap& cap) {
    append_field(out, "area_m2", cap.area_m2);
    append_vector(out, "centre", cap.centre + origin);
    append_field(out, "kind", to_string(cap.kind));
  });
  append_field(out, "detached_shells", report.detached_shells);
  append_field(out, "cavities", report.cavities);
  append_objects(out, "open_edges", report.open_edges, [&](const OpenEdge& edge) {
    append_vector(out, "from", edge.from + origin);
    append_vector(out, "to", edge.to + origin);
    append_field(out, "polygon", edge.polygon);
  });
  append_objects(out, "issues", issues, [&](const Issue& issue) {
    append_field(out, "severity", to_string(issue.severity));
    append_field(out, "code", to_string(issue.code));
    append_field(out, "sentence", issue.sentence);
  });
  return out + "}\n";
}

}  // namespace oriel
