#include "oriel/pipeline/targets.h"

#include "oriel/generalise.h"

#include <utility>

#include <fmt/format.h>

namespace oriel {

std::string Targets::recipe() const {
  std::string text = fmt::format("scale={}", scale.value_or(0));
  for (const Profile& profile : profiles)
    text += fmt::format(" {}={} edge={}", profile.level, profile.sha256,
                        profile.edge_min_m.value_or(0));
  return text;
}

std::string Targets::text() const {
  if (scale) return fmt::format("1:{}", *scale);
  std::string text;
  for (const Profile& profile : profiles) text += (text.empty() ? "LoD " : ", ") + profile.level;
  return text;
}

Targets at_scale(double denominator) { return {denominator, {}}; }

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
