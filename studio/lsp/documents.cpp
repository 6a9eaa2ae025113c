#include "studio/lsp/documents.h"

#include "studio/lsp/file_uri.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

namespace oriel::studio {

bool is_of_oriel(const EditedPack& pack) {
  if (pack.kind() != EditedPack::Kind::pack) return pack.kind() != EditedPack::Kind::other;
  bool has_keys = false;
  const std::string_view text = pack.text();
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t end = std::min(text.find('\n', line), text.size());
    const std::string_view content = text.substr(line, end - line);
    for (const std::string_view key : {"schema: oriel", "pack:", "extends:"})
      if (content.starts_with(key)) return true;
    const bool is_indented =
        content.empty() || std::string_view(" \t#-").find(content[0]) != content.npos;
    has_keys = has_keys || (!is_indented && content.find(':') != std::string_view::npos);
    line = end + 1;
  }
  return !has_keys;
}

void OpenDocuments::forget(const std::string& uri) {
  std::vector<std::string> changed = {uri};
  std::set<std::string> seen;
  while (!changed.empty()) {
    const std::string one = std::move(changed.back());
    changed.pop_back();
    if (!seen.insert(one).second) continue;
    if (OpenDocument* document = find(one)) {
      document->pack.reset();
      document->is_dirty = true;
    }
    const std::string name = std::filesystem::path(path_of_uri(one)).filename().string();
    for (const auto& [other, document] : documents_)
      if (!name.empty() && document.text.find(name) != std::string::npos) changed.push_back(other);
  }
}

void OpenDocuments::open(const std::string& uri, std::optional<std::int64_t> version,
                         std::string text) {
  documents_[uri] = {uri, version, std::move(text), nullptr, true};
  forget(uri);
}

bool OpenDocuments::change(const std::string& uri, std::optional<std::int64_t> version,
                           const std::vector<DocumentChange>& changes) {
  OpenDocument* document = find(uri);
  if (document == nullptr) return false;
  for (const DocumentChange& change : changes) {
    if (!change.range) {
      document->text = change.text;
      continue;
    }
    const TextPlaces places(document->text);
    const std::size_t begin = places.offset(change.range->first);
    const std::size_t end = std::max(begin, places.offset(change.range->second));
    document->text.replace(begin, end - begin, change.text);
  }
  document->version = version;
  forget(uri);
  return true;
}

bool OpenDocuments::close(const std::string& uri) {
  const bool was_open = documents_.erase(uri) > 0;
  if (was_open) forget(uri);
  return was_open;
}

OpenDocument* OpenDocuments::find(const std::string& uri) {
  const auto found = documents_.find(uri);
  return found == documents_.end() ? nullptr : &found->second;
}

const EditedPack& OpenDocuments::pack_of(OpenDocument& document) {
  if (document.pack) return *document.pack;
  const auto text_in_editor = [this](const std::string& path) -> std::optional<std::string> {
    const OpenDocument* other = find(uri_of_path(path));
    return other == nullptr ? std::nullopt : std::optional(other->text);
  };
  document.pack =
      std::make_unique<EditedPack>(document.text, path_of_uri(document.uri), text_in_editor);
  return *document.pack;
}

std::vector<OpenDocument*> OpenDocuments::dirty() {
  std::vector<OpenDocument*> dirty;
  for (auto& [uri, document] : documents_)
    if (document.is_dirty) dirty.push_back(&document);
  return dirty;
}

bool OpenDocuments::has_dirty() const {
  return std::ranges::any_of(documents_, [](const auto& named) { return named.second.is_dirty; });
}

std::vector<std::string> OpenDocuments::uris() const {
  std::vector<std::string> uris;
  for (const auto& [uri, document] : documents_) uris.push_back(uri);
  return uris;
}

}  // namespace oriel::studio
