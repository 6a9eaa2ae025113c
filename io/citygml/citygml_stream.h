#pragma once

#include "io/citygml/xml_node.h"
#include "io/files/input.h"
#include "io/json/text.h"
#include "io/unread_object.h"
#include "kernel/base/issue.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::detail {

/// Walks through a CityGML file building by building: of the file, no more is held than a chunk of
/// it and the buildings that end in that chunk.
///
/// Parsed by Expat. Nothing is loaded from elsewhere, and a document type declaration is refused
/// before its entities are looked at, so that none is ever expanded.
class CityGmlStream {
 public:
  /// `input` and `name` must outlive the stream. Only with `notes_unread` take_unread() has
  /// anything.
  CityGmlStream(Input& input, const TextName& name, bool notes_unread = false);
  ~CityGmlStream();
  CityGmlStream(const CityGmlStream&) = delete;
  CityGmlStream& operator=(const CityGmlStream&) = delete;

  /// The next Building that is an object of the CityModel; nothing at the end, or where the file
  /// cannot be read on. Throws InputError E101 if reading fails.
  std::optional<XmlNode> next();

  /// Why the file cannot be read on: E102, E103, E105, E107, E113, E114, E115, E503, E505.
  [[nodiscard]] const std::optional<Issue>& issue() const;
  /// The srsName of the CityModel's envelope; empty where it is absent or was not yet met.
  [[nodiscard]] const std::string& srs_name() const;
  /// As Reader::take_unread().
  std::vector<UnreadObject> take_unread();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel::detail
