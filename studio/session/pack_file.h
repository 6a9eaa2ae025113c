#pragma once

#include "studio/session/request_body.h"

#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace oriel::studio {

/// Which pack is edited, and its file. Functions may be called from any thread.
class PackFile {
 public:
  /// `rules` is the name of a pack that is built in, or a file, which need not exist yet. `folders`
  /// are those that a copy may be saved to, with all below them.
  PackFile(const std::string& rules, std::vector<std::string> folders);

  /// As findings name it: what the pack is loaded as (EditedPack).
  [[nodiscard]] std::string name() const;
  /// The text as it was opened or saved last.
  [[nodiscard]] std::string text() const;
  /// {name, path, text, hash, is_writable}.
  [[nodiscard]] StudioJson state() const;

  /// The verb `save`; what cannot be written throws RefusedRequest, 409 with `disk_text` and
  /// `disk_hash` where the file is not the one that the page knows.
  StudioJson save(const RequestBody& body);
  /// The verb `disk`.
  [[nodiscard]] StudioJson disk() const;

 private:
  [[nodiscard]] std::string target_of(const std::optional<std::string>& path) const;

  const std::vector<std::string> folders_;
  mutable std::mutex mutex_;
  std::string name_;
  /// Empty: built in.
  std::string path_;
  std::string text_;
  /// Of the file as it was read or written last; empty: there was none.
  std::string hash_;
};

}  // namespace oriel::studio
