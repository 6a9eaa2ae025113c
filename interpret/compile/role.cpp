#include "interpret/compile/role.h"

#include "interpret/pack/names.h"

namespace oriel::rules {

Role role_of(const Pack& pack, std::string_view label) {
  if (label.empty()) return {};
  for (ClassId id = index_of(pack.classes, label); id != kNoClass;
       id = pack.classes[static_cast<std::size_t>(id)].parent) {
    const Class& c = pack.classes[static_cast<std::size_t>(id)];
    if (c.emission)
      return {&*c.emission, c.name, c.name == label ? std::string() : std::string(label)};
  }
  return {};
}

}  // namespace oriel::rules
