#include "oriel/neighbours.h"

#include "io/objects/ground_areas.h"

#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Roads may end before they come to the buildings.
constexpr double kBeside_m = 1000;

/// Coordinates of another reference system lie somewhere else.
void check_place(const std::vector<GroundArea>& areas, const NeighbourSearch& search,
                 const std::string& file) {
  Box its, all;
  for (const GroundArea& area : areas)
    for (const Vec3 p : area[0]) its.grow(p);
  for (const StandingBuilding& building : search.buildings())
    if (!building.box.is_empty()) all.grow(building.box.moved(building.origin_m));
  if (all.is_empty()) return;
  const bool is_there = its.min.x <= all.max.x + kBeside_m && all.min.x <= its.max.x + kBeside_m &&
                        its.min.y <= all.max.y + kBeside_m && all.min.y <= its.max.y + kBeside_m;
  if (is_there) return;
  Issue issue;
  issue.code = Code::E192;
  issue.place.file = file;
  issue.sentence = fmt::format(
      "lies elsewhere: x from {:.6g} to {:.6g} and y from {:.6g} to {:.6g}, the buildings x from "
      "{:.6g} to {:.6g} and y from {:.6g} to {:.6g}; it must be in their reference system",
      its.min.x, its.max.x, its.min.y, its.max.y, all.min.x, all.max.x, all.min.y, all.max.y);
  throw InputError(std::move(issue));
}

}  // namespace

void add_buildings(const std::string& file, const ReadOptions& options, NeighbourSearch& search,
                   const std::function<void(const std::vector<Issue>&)>& tell) {
  Reader reader(file, options);
  while (const auto document = reader.next()) {
    tell(document->issues);
    if (!document->value) continue;
    for (const Building& building : document->value->buildings) search.add(building);
  }
}

std::vector<Issue> faults_beside(std::vector<Issue> issues) {
  std::erase_if(issues, [](const Issue& issue) { return issue.severity != Severity::error; });
  for (Issue& issue : issues) issue.severity = Severity::warning;
  return issues;
}

std::shared_ptr<const KeptGround> read_kept_ground(const std::vector<std::string>& files,
                                                   const NeighbourSearch* search) {
  auto kept = std::make_shared<KeptGround>();
  for (const std::string& file : files) {
    std::vector<GroundArea> areas = read_ground_areas(file);
    if (search != nullptr) check_place(areas, *search, file);
    for (GroundArea& area : areas) kept->add(std::move(area));
  }
  kept->finish();
  return kept;
}

}  // namespace oriel
