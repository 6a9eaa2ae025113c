#include "interpret/pack/read_limits.h"

#include "interpret/pack/loader.h"
#include "interpret/yaml/section.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

Limits read_limits(const YamlNode& node, Findings& findings) {
  Limits limits;
  const std::vector<std::pair<std::string, std::optional<double>*>> all{
      {"footprint-pct", &limits.footprint_pct},
      {"volume-pct", &limits.volume_pct},
      {"overhang-pct", &limits.overhang_pct},
      {"party-walls-pct", &limits.party_walls_pct},
      {"top-m", &limits.top_m},
      {"ridge-m", &limits.ridge_m},
      {"eaves-m", &limits.eaves_m}};
  std::vector<std::string> keys;
  for (const auto& [key, into] : all) keys.push_back(key);
  const Section section(node, "'invariants'", keys, findings);
  for (const auto& [key, into] : all) {
    const YamlNode* value = section.is_map() ? section.find(key) : nullptr;
    if (value == nullptr) continue;
    *into = read_number(*value, fmt::format("'{}'", key), findings);
    if (*into && !(**into > 0))
      findings.error(Code::R211, value->span, fmt::format("'{}' is more than 0", key));
  }
  return limits;
}

void read_invariants(const YamlNode& node, Loader& loader) {
  loader.pack.limits = read_limits(node, loader.findings);
}

}  // namespace oriel::rules
