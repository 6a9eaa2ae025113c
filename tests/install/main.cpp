// Labels the first building of a file and generalises it: consumer FILE.

#include "generalise/generalise.h"
#include "interpret/labelling/interpret.h"
#include "interpret/plan/plan.h"
#include "interpret/surfaces/annotate.h"
#include "kernel/describe/describe.h"
#include "kernel/describe/surfaces.h"
#include "kernel/io/reader.h"
#include "kernel/io/writer.h"
#include "kernel/model/version.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <cstdio>
#include <map>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  oriel::Reader reader(argv[1]);
  const auto record = reader.next();
  if (!record || !record->value) return 1;
  const oriel::Building& building = record->value->buildings.at(0);

  const auto solid = oriel::solidify(building);
  if (!solid.value) return 1;
  const auto segmentation = oriel::segment(building, *solid.value);
  const auto [table, graph] = oriel::describe(building, segmentation);
  const auto pack = oriel::load_pack_file("residential");
  if (!pack.value) return 1;
  const auto found = oriel::interpret(*pack.value, table, graph);
  std::map<std::string, int> counts;
  for (const oriel::Verdict& verdict : found.verdicts) ++counts[verdict.label];

  const auto plan = oriel::plan(*pack.value, table, graph, found, 20000);
  const auto coarse = oriel::generalise(*solid.value, segmentation, table, found, plan);
  if (!coarse.value || !oriel::is_closed(coarse.value->solid)) return 1;
  const auto surfaces =
      oriel::describe_surfaces(building, {}, {&*solid.value, &segmentation, &table});
  const auto labelled =
      oriel::annotate(building, segmentation, table, graph, surfaces, found, *pack.value);
  const std::string text = oriel::write_cityjson(*record->value, {labelled});

  std::printf("oriel %s: %d windows, %zu facets of %zu left, %zu bytes\n", oriel::kVersion,
              counts["window"], coarse.value->solid.facets.size(), solid.value->facets.size(),
              text.size());
  return counts["window"] > 0 ? 0 : 1;
}
