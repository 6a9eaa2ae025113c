#pragma once

#include "kernel/base/issue.h"
#include "kernel/base/sha256.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::cli {

/// A part of a stream: a CityJSONSeq of its own, with the stream's header.
struct Shard {
  std::string name;  ///< of its file, without folder and extension
  std::uint64_t features = 0;
  std::uint64_t bytes = 0;
  std::string sha256;
  std::string ids_sha256;  ///< SHA-256 of the ids of the features, each with a line end
};

/// The shards of a stream in their order, as split.json lists them next to their files.
struct ShardList {
  std::vector<Shard> shards;

  [[nodiscard]] std::string json() const;
  /// Throws InputError: what read_json_file says, E118 it is no list of shards.
  static ShardList load(const std::string& path);
};

inline constexpr const char* kShardList = "split.json";
inline constexpr const char* kShardExtension = ".city.jsonl";

/// An error E118: shards do not make up the whole.
Issue shard_issue(const std::string& file, std::string sentence);

/// The file of a shard while it grows, as PATH.partial, which goes if it is not committed. It is
/// open only while it is written to, so that there may be any number of them. Failures throw
/// OutputError E601.
class ShardFile {
 public:
  ShardFile(const std::string& folder, std::string name);
  ~ShardFile();
  ShardFile(const ShardFile&) = delete;
  ShardFile& operator=(const ShardFile&) = delete;

  void append(std::string_view line);
  /// Writes what is in memory.
  void flush();
  /// Puts the file in its place. `features`: lines without the header.
  Shard commit();

 private:
  [[nodiscard]] std::string partial() const;

  std::string name_, path_;
  std::string buffer_;
  bool is_begun_ = false;
  std::uint64_t lines_ = 0;
  Sha256 hash_, ids_;
};

}  // namespace oriel::cli
