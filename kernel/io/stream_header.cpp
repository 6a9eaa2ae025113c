#include "kernel/io/stream_header.h"

#include "kernel/io/detail/raw_json.h"

#include <nlohmann/json.hpp>

namespace oriel {

std::string stream_header_facts(std::string_view header) {
  using detail::RawNode;
  const RawNode root(header);
  nlohmann::json facts = nlohmann::json::object();
  const auto take = [&](const RawNode& node, const std::string& key) {
    const std::string_view value = node.value_of(key);
    if (!value.empty()) facts[key] = nlohmann::json::parse(value, nullptr, false);
  };
  take(root, "version");
  take(root, "transform");
  if (const std::string_view metadata = root.value_of("metadata"); RawNode::is_object(metadata))
    take(RawNode(metadata), "referenceSystem");
  return facts.dump();
}

}  // namespace oriel
