#include "tests/generalise/line.h"

#include "interpret/labelling/interpret.h"
#include "interpret/plan/plan.h"
#include "interpret/surfaces/annotate.h"
#include "io/reader.h"
#include "io/writer.h"
#include "kernel/describe/surfaces.h"
#include "kernel/segment/flush/imprints.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <unistd.h>
#include <utility>

#include <doctest/doctest.h>

namespace oriel::test {

namespace {

Line line_of(Document document) {
  Line line;
  line.document = std::move(document);
  auto solid = solidify(line.building());
  REQUIRE(solid.value);
  line.solid = std::move(*solid.value);
  line.segmentation = segment(line.building(), line.solid);
  add_imprints(line.building(), line.solid, line.segmentation);
  line.description = describe(line.building(), line.segmentation);
  line.interpretation = interpret(residential(), line.description.table, line.description.graph);
  line.labelled =
      annotate(line.building(), line.segmentation, line.description.table, line.description.graph,
               describe_surfaces(line.building(), {},
                                 {&line.solid, &line.segmentation, &line.description.table}),
               line.interpretation, residential());
  return line;
}

}  // namespace

std::vector<FeatureId> Line::features(const std::string& label) const {
  std::vector<FeatureId> found;
  for (const Verdict& verdict : interpretation.verdicts)
    if (verdict.label == label) found.push_back(verdict.feature);
  return found;
}

RedrawContext Line::context(Invariants invariants) const {
  return {building(), labelled,       solid, segmentation,
          table(),    interpretation, {},    std::move(invariants)};
}

Plan Line::plan_at(double scale, const RuleBase& pack) const {
  return plan(pack, table(), description.graph, interpretation, scale);
}

const RuleBase& residential() {
  static const RuleBase pack = *load_pack_file("residential").value;
  return pack;
}

Line line_of_file(const std::string& path) {
  Reader reader(path);
  auto record = reader.next();
  REQUIRE(record);
  REQUIRE(record->value);
  REQUIRE(!record->value->buildings.empty());
  return line_of(std::move(*record->value));
}

Line line_of_text(const std::string& text) {
  std::string name = std::filesystem::temp_directory_path() / "oriel-test-XXXXXX.city.json";
  const int descriptor = ::mkstemps(name.data(), 10);
  REQUIRE(descriptor >= 0);
  ::close(descriptor);
  std::ofstream(name, std::ios::binary) << text;
  Line line = line_of_file(name);
  std::remove(name.c_str());
  return line;
}

Line line_of(Building building) {
  Document document;
  document.buildings.push_back(std::move(building));
  return line_of(std::move(document));
}

Line line_of_sample(const std::string& name) {
  return line_of_file(std::string(ORIEL_SOURCE_DIR) + "/examples/samples/" + name +
                      ".stripped.city.json");
}

const std::vector<std::string>& samples() {
  static const std::vector<std::string> names{"block",       "hip",       "house",   "house-flush",
                                              "house-noisy", "house-utm", "l-house", "row"};
  return names;
}

Coarser generalised(const Line& line, double scale) {
  Coarser out;
  out.scale = scale;
  out.plan = line.plan_at(scale);
  auto checked = generalise(line.context(), out.plan);
  out.issues = std::move(checked.issues);
  REQUIRE(checked.value);
  out.generalised = *checked.value;
  out.redrawn = redraw(line.context(), std::move(*checked.value));
  return out;
}

std::string written(const Line& line, const Coarser& coarser) {
  return write_cityjson(line.document, {coarser.redrawn.labelled},
                        {.removed = coarser.redrawn.removed_ids});
}

}  // namespace oriel::test
