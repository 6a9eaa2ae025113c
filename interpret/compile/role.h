#pragma once

#include "interpret/pack/pack.h"

#include <string>
#include <string_view>

namespace oriel::rules {

/// What a feature is written as.
struct Role {
  /// Null: it is not written.
  const Emission* emission = nullptr;
  /// The class that has the emission: the label or what it is a kind of.
  std::string label;
  std::string subclass;

  [[nodiscard]] bool is_installation() const {
    return emission != nullptr && emission->type == "BuildingInstallation";
  }
  [[nodiscard]] bool is_opening() const { return emission != nullptr && !is_installation(); }
};

/// Of a feature with that label; of none without one.
Role role_of(const Pack& pack, std::string_view label);

}  // namespace oriel::rules
