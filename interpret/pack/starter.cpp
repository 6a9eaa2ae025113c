#include "interpret/pack/starter.h"

#include "interpret/pack/embedded.h"
#include "interpret/pack/pack.h"
#include "interpret/pack/rule_base.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// What the files of rules/starter call the new class.
constexpr std::string_view kPlaceholder = "my_class";

std::string renamed(std::string_view text, const std::string& name) {
  std::string result;
  for (std::size_t at = 0; (at = text.find(kPlaceholder)) != std::string_view::npos;) {
    result += text.substr(0, at);
    result += name;
    text.remove_prefix(at + kPlaceholder.size());
  }
  return result.append(text);
}

/// Small letters first: what packs and files can be called alike.
bool is_plain_name(const std::string& name) {
  const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
  return !name.empty() && is_small(name[0]) && std::ranges::all_of(name, [&](char c) {
    return is_small(c) || (c >= '0' && c <= '9') || c == '_';
  });
}

Issue unusable(const std::string& name, const std::string& why) {
  Issue issue;
  issue.code = Code::R216;
  issue.severity = Severity::error;
  issue.sentence = fmt::format("'{}' {}", name, why);
  return issue;
}

}  // namespace

Checked<std::vector<StarterFile>> starter_pack(const std::string& name) {
  Checked<std::vector<StarterFile>> checked;
  if (!is_plain_name(name)) {
    checked.issues.push_back(unusable(
        name, "cannot name a class: a small letter comes first, then letters, digits and _"));
    return checked;
  }
  const auto residential = load_pack_file("residential");
  const auto& classes = residential.value->pack().classes;
  if (std::ranges::find(classes, name, &rules::Class::name) != classes.end()) {
    checked.issues.push_back(
        unusable(name, "is a class of residential, which the new pack extends; take another name"));
    return checked;
  }
  std::vector<StarterFile> files;
  for (const rules::EmbeddedPack& file : rules::embedded_starter())
    files.push_back({renamed(file.name, name), renamed(file.text, name)});
  const auto loaded = load_pack(files.front().text, files.front().name);
  if (loaded.value)
    checked.value = std::move(files);
  else
    checked.issues.push_back(
        unusable(name, "has a meaning of its own in rules; take another name"));
  return checked;
}

}  // namespace oriel
