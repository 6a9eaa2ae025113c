#include "kernel/base/name.h"

#include <mutex>
#include <ostream>
#include <unordered_set>

namespace oriel {

namespace {

struct KeptTexts {
  std::mutex mutex;
  /// Texts stay where they are when others are added.
  std::unordered_set<std::string> texts;
};

/// Never destroyed: names may be used while the process ends.
KeptTexts& kept_texts() {
  static auto* const all = new KeptTexts;
  return *all;
}

}  // namespace

const std::string Name::kEmpty;

const std::string* Name::kept(std::string_view text) {
  if (text.empty()) return nullptr;
  KeptTexts& all = kept_texts();
  const std::lock_guard lock(all.mutex);
  return &*all.texts.emplace(text).first;
}

std::ostream& operator<<(std::ostream& out, Name name) { return out << name.text(); }

}  // namespace oriel
