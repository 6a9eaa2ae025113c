#include "studio/session/pack_file.h"

#include "kernel/base/sha256.h"
#include "oriel/rules.h"
#include "studio/session/saved_file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

namespace fs = std::filesystem;

bool is_in_folder(const fs::path& real, const std::string& folder) {
  std::error_code problem;
  const fs::path root = fs::canonical(folder.empty() ? "." : folder, problem);
  if (problem) return false;
  const auto [at, rest] = std::ranges::mismatch(root, real);
  return at == root.end();
}

/// The folder of a file that may not exist yet, links resolved; empty if there is none.
fs::path real_folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  std::error_code problem;
  fs::path real = fs::canonical(parent.empty() ? "." : parent, problem);
  return problem ? fs::path() : real;
}

bool is_writable(const std::string& path) {
  std::error_code problem;
  if (path.empty()) return false;
  if (fs::exists(path, problem)) return access(path.c_str(), W_OK) == 0;
  return access(real_folder_of(path).c_str(), W_OK) == 0;
}

}  // namespace

PackFile::PackFile(const std::string& rules, std::vector<std::string> folders)
    : folders_(std::move(folders)), name_(rules) {
  if (const auto built_in = embedded_pack(rules)) {
    text_ = *built_in;
    return;
  }
  path_ = rules;
  if (auto text = read_text_file(path_)) {
    hash_ = sha256(*text);
    text_ = std::move(*text);
  }
}

std::string PackFile::name() const {
  const std::lock_guard lock(mutex_);
  return name_;
}

std::string PackFile::text() const {
  const std::lock_guard lock(mutex_);
  return text_;
}

StudioJson PackFile::state() const {
  const std::lock_guard lock(mutex_);
  return {{"name", path_.empty() ? name_ : fs::path(path_).filename().string()},
          {"path", path_.empty() ? StudioJson() : StudioJson(path_)},
          {"text", text_},
          {"hash", hash_},
          {"is_writable", is_writable(path_)}};
}

std::string PackFile::target_of(const std::optional<std::string>& path) const {
  if (!path || *path == path_) {
    if (path_.empty())
      throw RefusedRequest(400, "this pack is built in; say which file to save it to");
    return path_;
  }
  const bool has_ending = path->ends_with(".yaml") || path->ends_with(".yml");
  if (!has_ending || path->find('\0') != std::string::npos)
    throw RefusedRequest(400, "a pack is saved to a file whose name ends in .yaml");
  const fs::path folder = real_folder_of(*path);
  if (folder.empty()) throw RefusedRequest(400, fmt::format("there is no folder for '{}'", *path));
  const fs::path real = folder / fs::path(*path).filename();
  std::error_code problem;
  const bool leads_away = fs::is_symlink(real, problem);
  const auto is_around = [&](const std::string& each) { return is_in_folder(real, each); };
  if (leads_away || std::ranges::none_of(folders_, is_around))
    throw RefusedRequest(
        403, fmt::format("'{}' is outside of the folders that the studio was opened with", *path));
  return *path;
}

StudioJson PackFile::save(const RequestBody& body) {
  const std::string text = body.text("text");
  const std::string known = body.text("hash");
  const bool is_forced = body.flag("force");
  const auto path = body.optional_text("path");
  const std::lock_guard lock(mutex_);
  const std::string target = target_of(path);
  text_ = save_file(target, [&](const std::optional<std::string>& on_disk) {
    const std::string disk_hash = on_disk ? sha256(*on_disk) : "";
    if (!is_forced && on_disk && disk_hash != known)
      throw RefusedRequest(
          409,
          target == path_ ? "the file was changed on disk since it was opened; nothing was saved"
                          : fmt::format("'{}' is there already; nothing was saved", target),
          Code::none, {{"disk_text", *on_disk}, {"disk_hash", disk_hash}});
    return text;
  });
  path_ = name_ = target;
  hash_ = sha256(text_);
  return {{"hash", hash_}, {"path", path_}};
}

StudioJson PackFile::disk() const {
  const std::lock_guard lock(mutex_);
  if (path_.empty()) return {{"hash", ""}, {"is_changed", false}};
  const auto on_disk = read_text_file(path_);
  const std::string hash = on_disk ? sha256(*on_disk) : "";
  return {{"hash", hash}, {"is_changed", hash != hash_}};
}

}  // namespace oriel::studio
