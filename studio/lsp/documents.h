#pragma once

#include "studio/editing/edited_pack.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::studio {

/// A document that is open in an editor.
struct OpenDocument {
  std::string uri{};
  std::optional<std::int64_t> version{};
  std::string text{};
  /// What is known of the text; made when it is asked for.
  std::unique_ptr<EditedPack> pack;
  /// Its findings have not been told since it changed.
  bool is_dirty = true;
};

/// False for YAML that is about something else: it has keys that are not indented, and `schema:
/// oriel…`, `pack:`, `extends:` and `tests_for:` are none of them. Editors send all files that are
/// YAML; those are left alone.
bool is_of_oriel(const EditedPack& pack);

/// A change of a document: of the piece between two places, or of all of it.
struct DocumentChange {
  std::optional<std::pair<TextPlace, TextPlace>> range{};
  std::string text{};
};

/// The open documents, by URI.
class OpenDocuments {
 public:
  void open(const std::string& uri, std::optional<std::int64_t> version, std::string text);
  /// False if it is not open.
  bool change(const std::string& uri, std::optional<std::int64_t> version,
              const std::vector<DocumentChange>& changes);
  bool close(const std::string& uri);

  /// Null if it is not open.
  [[nodiscard]] OpenDocument* find(const std::string& uri);
  /// What is known of an open document.
  const EditedPack& pack_of(OpenDocument& document);
  /// Those of which findings are to be told, by URI.
  [[nodiscard]] std::vector<OpenDocument*> dirty();
  [[nodiscard]] bool has_dirty() const;
  /// Of all of them, sorted.
  [[nodiscard]] std::vector<std::string> uris() const;

 private:
  /// What is known of a document that has changed, and of those that extend or test it.
  void forget(const std::string& uri);

  std::map<std::string, OpenDocument> documents_;
};

}  // namespace oriel::studio
