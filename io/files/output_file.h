#pragma once

#include "kernel/base/sha256.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace oriel {

/// Throws OutputError E601: `path` cannot be written for the system's reason, or another process is
/// writing it (EWOULDBLOCK).
[[noreturn]] void fail_to_write(const std::string& path, int reason);

/// A file that appears whole or not at all: bytes go to a temporary file beside it, which `commit`
/// syncs and renames; without `commit` it vanishes. "-" is stdout; it and what is no regular file
/// (/dev/null, a pipe) are written directly. Where the path is a link, the file it names is
/// replaced; a file that is replaced passes on its permissions. Failures throw OutputError E601
/// with the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends `bytes`, which may stay in memory until `commit`.
  void append(std::string_view bytes);

  /// Writes what is left and puts the file in its place. Nothing may be appended after it.
  void commit();

  /// How many bytes it has; of a file that goes on (PartialFiles) those of the earlier run, too.
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  friend class PartialFiles;

  void open_temporary();
  void open_partial();
  void flush();
  void write(std::string_view bytes);
  [[noreturn]] void fail(int reason) { fail_to_write(path_, reason); }

  /// As it was given, for messages.
  std::string path_;
  /// The file to replace, links resolved.
  std::string target_;
  /// The temporary file, or empty if the bytes go to their place directly.
  std::string temporary_;
  /// Its place in the list that remove_temporary_files goes by, or -1.
  int listed_ = -1;
  int descriptor_ = -1;
  std::string buffer_;
  std::uint64_t size_ = 0;
  std::uint64_t lines_ = 0;  ///< with PartialFiles only, and so the hash
  Sha256 hash_;
};

/// Deletes the temporary files of all OutputFiles that are open. For the handler of a signal that
/// ends the program: nothing in it is forbidden there.
void remove_temporary_files() noexcept;

/// Writes `bytes` as the whole content of `path`, as OutputFile does.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace oriel
