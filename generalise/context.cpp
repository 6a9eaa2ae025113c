#include "generalise/context.h"

#include "generalise/removal/building_cells.h"

#include <iterator>
#include <utility>

namespace oriel {

std::int64_t corners_of(const Solid& solid) {
  std::int64_t corners = 0;
  for (const Facet& facet : solid.facets)
    for (const Loop& loop : facet.loops) corners += std::ssize(loop);
  return corners;
}

Issue RedrawContext::issue(Severity severity, Code code, FeatureId of, std::string sentence) const {
  Issue issue = building_issue(severity, code, table.building(), std::move(sentence));
  if (of.is_valid()) issue.place.feature = table.id(of);
  return issue;
}

bool RedrawContext::may_go_on(const Solid& on, std::int64_t steps) const {
  if (work == nullptr) return true;
  work->add(steps * corners_of(on));
  return !work->is_used_up();
}

std::shared_ptr<detail::BuildingCells> RedrawContext::shared_cells() const {
  if (cells) return cells;
  return std::make_shared<detail::BuildingCells>(solid, segmentation, options.tolerances);
}

std::optional<Violation> RedrawContext::violation_by(const Solid& left) const {
  if (!before) return std::nullopt;
  return violation(*before, measures_of(left, invariants), invariants);
}

}  // namespace oriel
