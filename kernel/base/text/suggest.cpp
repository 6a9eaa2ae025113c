#include "kernel/base/text/suggest.h"

#include "kernel/base/text/edit_distance.h"

#include <algorithm>
#include <cstddef>

namespace oriel {

namespace {

/// Names longer than this are not compared: nobody's typo is that long.
constexpr std::size_t kLongestName = 64;

/// Names of earlier packs, with what they are called now and what a reader of such a pack must
/// know.
struct RenamedAttribute {
  std::string_view old_name, name, explanation;
};
constexpr RenamedAttribute kRenamed[] = {
    {"height_of", "height",
     "'height' is the feature's own height and 'base_height' that of its foot over the ground"},
    {"height", "base_height", "'base_height' is the height of the lowest point"},
};

std::string renamed_to(std::string_view name, const std::vector<std::string>& candidates) {
  for (const RenamedAttribute& renamed : kRenamed)
    if (renamed.old_name == name && contains(candidates, renamed.name))
      return "; did you mean '" + std::string(renamed.name) + "'? " +
             std::string(renamed.explanation);
  return "";
}

}  // namespace

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.size() > kLongestName) return "";
  std::size_t best = std::max<std::size_t>(1, name.size() / 3) + 1;
  std::string found;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestName || candidate == name) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= best || distance >= candidate.size()) continue;
    best = distance;
    found = candidate;
  }
  return found;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  if (std::string renamed = renamed_to(name, candidates); !renamed.empty()) return renamed;
  const std::string found = nearest(name, candidates);
  return found.empty() ? "" : "; did you mean '" + found + "'?";
}

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace oriel
