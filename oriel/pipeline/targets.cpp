#include "oriel/pipeline/targets.h"

namespace oriel {

double least_edge_m(const Profile* profile, std::optional<double> scale) {
  if (profile != nullptr && profile->edge_min_m) return *profile->edge_min_m;
  const auto sizes = profile != nullptr ? profile->thresholds(scale) : std::nullopt;
  return sizes ? sizes->c_m : kGapOnMap_m * scale.value_or(0);
}

Invariants invariants_of(const Profile* profile, const RuleBase& rules,
                         std::optional<double> scale) {
  Invariants invariants;
  invariants.limits = rules.limits();
  if (profile != nullptr) invariants.limits = stricter(invariants.limits, profile->limits);
  // Blocks have edges of their own, and what asks for edges everywhere takes their owners off.
  if (profile == nullptr || (profile->form == Profile::Form::as_is && !profile->edge_min_m))
    invariants.least_edge_m = least_edge_m(profile, scale);
  return invariants;
}

Invariants with_party_walls(Invariants invariants, const Document& document,
                            const Building& building, const Solid& solid) {
  if (invariants.limits.party_walls_pct)
    invariants.party_walls = party_walls(building, solid, document.buildings);
  return invariants;
}

}  // namespace oriel
