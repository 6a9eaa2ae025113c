#include "kernel/io/cityjson/stream_header.h"

#include "kernel/base/sha256.h"
#include "kernel/io/json/raw_json.h"

#include <vector>

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

using detail::RawNode;
using nlohmann::json;

json facts_of(const RawNode& root, const std::vector<std::string>& keys) {
  json facts = json::object();
  const auto take = [&](const RawNode& node, const std::string& key) {
    const std::string_view value = node.value_of(key);
    if (!value.empty()) facts[key] = json::parse(value, nullptr, false);
  };
  for (const std::string& key : keys) take(root, key);
  if (const std::string_view metadata = root.value_of("metadata"); RawNode::is_object(metadata))
    take(RawNode(metadata), "referenceSystem");
  return facts;
}

}  // namespace

std::string stream_header_facts(std::string_view header) {
  return facts_of(RawNode(header), {"version", "transform"}).dump();
}

std::string file_facts(std::string_view header) {
  const RawNode root(header);
  json facts = facts_of(root, {"version"});
  constexpr const char* kTemplates = "geometry-templates";
  if (const std::string_view templates = root.value_of(kTemplates); !templates.empty())
    facts[kTemplates] = sha256(templates);
  return facts.dump();
}

}  // namespace oriel
