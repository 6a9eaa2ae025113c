#include "model/interpretation.h"

namespace oriel {

std::vector<std::vector<std::string>> groups_by_feature(const Interpretation& interpretation) {
  std::vector<std::vector<std::string>> groups(interpretation.verdicts.size());
  for (const Group& group : interpretation.groups)
    for (const FeatureId member : group.members) groups.at(member.index()).push_back(group.id);
  return groups;
}

std::vector<FeatureId> wholes_by_feature(const Interpretation& interpretation,
                                         std::span<const FeatureId> hosts) {
  const auto has_label = [&](FeatureId feature) {
    return !interpretation.verdicts.at(feature.index()).label.empty();
  };
  std::vector<FeatureId> wholes(hosts.size());
  for (std::size_t row = 0; row < hosts.size(); ++row) {
    if (has_label(FeatureId{static_cast<int>(row)})) continue;
    FeatureId whole = hosts[row];
    // Hosts of stored features may stand in a circle.
    for (std::size_t i = 0; i < hosts.size() && whole.is_valid() && !has_label(whole); ++i)
      whole = hosts[whole.index()];
    if (whole.is_valid() && has_label(whole)) wholes[row] = whole;
  }
  return wholes;
}

}  // namespace oriel
