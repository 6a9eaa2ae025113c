#include "cli/streams/shards.h"

#include "cli/batch/resume.h"
#include "io/cityjson/stream_header.h"
#include "io/files/output_file.h"
#include "io/json/json_check.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel::cli {

using nlohmann::ordered_json;

std::string ShardList::json() const {
  ordered_json list = ordered_json::array();
  std::uint64_t features = 0;
  for (const Shard& shard : shards) {
    list.push_back({{"name", shard.name},
                    {"features", shard.features},
                    {"bytes", shard.bytes},
                    {"sha256", shard.sha256},
                    {"ids_sha256", shard.ids_sha256}});
    features += shard.features;
  }
  return ordered_json{{"features", features}, {"shards", list}}.dump(2) + '\n';
}

ShardList ShardList::load(const std::string& path) {
  ShardList list;
  const ordered_json json = read_json_file(path);
  try {
    for (const auto& shard : json.at("shards"))
      list.shards.push_back({shard.at("name"), count_of(shard.at("features")),
                             count_of(shard.at("bytes")), shard.at("sha256"),
                             shard.at("ids_sha256")});
  } catch (const ordered_json::exception& error) {
    throw InputError(shard_issue(path, "is not a list of shards: " + reason_of(error)));
  }
  return list;
}

Issue shard_issue(const std::string& file, std::string sentence) {
  Issue issue;
  issue.code = Code::E118;
  issue.sentence = std::move(sentence);
  issue.place.file = file;
  return issue;
}

ShardFile::ShardFile(const std::string& folder, std::string name)
    : name_(std::move(name)),
      path_((std::filesystem::path(folder) / (name_ + kShardExtension)).string()) {}

ShardFile::~ShardFile() {
  std::error_code error;
  if (is_begun_) std::filesystem::remove(partial(), error);
}

std::string ShardFile::partial() const { return path_ + ".partial"; }

void ShardFile::append(std::string_view line) {
  buffer_ += line;
  hash_.add(line);
  if (lines_++ > 0) ids_.add(feature_id(line) + '\n');
}

void ShardFile::flush() {
  errno = 0;
  std::ofstream file(
      partial(),
      std::ios::binary | (std::exchange(is_begun_, true) ? std::ios::app : std::ios::trunc));
  file.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file.close();
  if (!file) fail_to_write(path_, errno);
  buffer_.clear();
}

Shard ShardFile::commit() {
  flush();
  if (std::rename(partial().c_str(), path_.c_str()) != 0) fail_to_write(path_, errno);
  is_begun_ = false;
  return {name_, lines_ - 1, hash_.bytes(), hash_.digest(), ids_.digest()};
}

}  // namespace oriel::cli
