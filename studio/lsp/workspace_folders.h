#pragma once

#include "studio/lsp/json_value.h"

#include <string>
#include <vector>

namespace oriel::studio {

/// The folders that a client works in.
class WorkspaceFolders {
 public:
  /// Those of the params of `initialize`: `workspaceFolders`, else `rootUri`, else `rootPath`.
  void open(const JsonValue& params);
  /// Of the notification `workspace/didChangeWorkspaceFolders`.
  void change(const JsonValue& params);

  /// The YAML files in the folder of `file`, sorted, if that is one of these folders or below:
  /// packs extend others of their own folder only.
  [[nodiscard]] std::vector<std::string> yaml_files_beside(const std::string& file) const;

 private:
  void add(const std::string& uri);

  std::vector<std::string> folders_;
};

}  // namespace oriel::studio
