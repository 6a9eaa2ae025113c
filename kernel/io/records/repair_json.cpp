#include "kernel/io/records/repair_json.h"

#include "kernel/io/json/json_fields.h"

#include <array>

namespace oriel {

namespace {

using detail::append_field;
using detail::append_json_array;
using detail::append_json_key;
using detail::append_objects;
using detail::append_vector;

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
