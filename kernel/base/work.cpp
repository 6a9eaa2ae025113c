#include "kernel/base/work.h"

#include <fmt/format.h>

namespace oriel {

Issue used_up(const std::string& building, std::int64_t budget, const std::string& stage,
              const std::string& outcome) {
  return building_issue(
      Severity::warning, Code::E502, building,
      fmt::format("{} used up the work budget of {} steps; {}", stage, budget, outcome));
}

}  // namespace oriel
