#include "interpret/surfaces/label_classes.h"

#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"

#include <algorithm>

namespace oriel {

LabelledAs labelled_as(const RuleBase& base, std::string_view label) {
  const rules::Role role = rules::role_of(base.pack(), label);
  if (role.emission == nullptr) return LabelledAs::other;
  if (role.emission->type == "Window") return LabelledAs::window;
  return role.emission->type == "Door" ? LabelledAs::door : LabelledAs::other;
}

bool is_of_class(const RuleBase& base, std::string_view label, std::string_view name) {
  const auto& classes = base.pack().classes;
  const auto found = std::ranges::find(classes, label, &rules::Class::name);
  if (found == classes.end()) return false;
  for (const rules::Class* c = &*found;; c = &classes[static_cast<std::size_t>(c->parent)]) {
    if (c->name == name) return true;
    if (c->parent == rules::kNoClass) return false;
  }
}

std::vector<std::string> class_names(const RuleBase& base) {
  std::vector<std::string> names;
  for (const rules::Class& c : base.pack().classes) names.push_back(c.name);
  return names;
}

}  // namespace oriel
