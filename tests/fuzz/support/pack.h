#pragma once

#include "interpret/pack/rule_base.h"

namespace oriel::fuzz {

/// The pack that the command takes where none is named.
inline const RuleBase& default_pack() {
  static const RuleBase pack = load_pack_file("residential").value.value();
  return pack;
}

}  // namespace oriel::fuzz
