#include "kernel/model/interpretation.h"

namespace oriel {

std::vector<std::vector<std::string>> groups_by_feature(const Interpretation& interpretation) {
  std::vector<std::vector<std::string>> groups(interpretation.verdicts.size());
  for (const Group& group : interpretation.groups)
    for (const FeatureId member : group.members) groups.at(member.index()).push_back(group.id);
  return groups;
}

}  // namespace oriel
