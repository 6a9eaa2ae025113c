#include "studio/lsp/workspace_folders.h"

#include "studio/lsp/file_uri.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace oriel::studio {

namespace {

namespace fs = std::filesystem;

bool is_yaml(const fs::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

bool is_below(const fs::path& folder, const fs::path& of) {
  const fs::path way = folder.lexically_normal().lexically_relative(of.lexically_normal());
  return !way.empty() && *way.begin() != "..";
}

}  // namespace

void WorkspaceFolders::add(const std::string& uri) {
  std::string folder = path_of_uri(uri);
  if (!folder.empty() && std::ranges::find(folders_, folder) == folders_.end())
    folders_.push_back(std::move(folder));
}

void WorkspaceFolders::open(const JsonValue& params) {
  if (!params.is_object()) return;
  const auto text = [&](const char* key) {
    const auto found = params.find(key);
    return found != params.end() && found->is_string() ? found->get<std::string>() : "";
  };
  if (const auto list = params.find("workspaceFolders"); list != params.end() && list->is_array())
    for (const JsonValue& folder : *list) add(folder.at("uri").get<std::string>());
  else if (const std::string uri = text("rootUri"); !uri.empty())
    add(uri);
  else if (const std::string path = text("rootPath"); !path.empty())
    add(uri_of_path(path));
}

void WorkspaceFolders::change(const JsonValue& params) {
  const JsonValue& event = params.at("event");
  for (const JsonValue& folder : event.at("removed"))
    std::erase(folders_, path_of_uri(folder.at("uri").get<std::string>()));
  for (const JsonValue& folder : event.at("added")) add(folder.at("uri").get<std::string>());
}

std::vector<std::string> WorkspaceFolders::yaml_files_beside(const std::string& file) const {
  std::vector<std::string> files;
  const fs::path folder = fs::path(file).parent_path();
  if (std::ranges::none_of(folders_, [&](const std::string& f) { return is_below(folder, f); }))
    return files;
  std::error_code problem;
  fs::directory_iterator at(folder, problem);
  for (const fs::directory_iterator end; !problem && at != end; at.increment(problem)) {
    std::error_code ignored;
    if (is_yaml(at->path()) && at->is_regular_file(ignored)) files.push_back(at->path().string());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace oriel::studio
