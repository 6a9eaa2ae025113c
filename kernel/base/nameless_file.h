#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace oriel {

/// A file without a name in a folder: it is gone when it is closed, whatever ends the program. What
/// fails throws OutputError E601 about `about`, the file or folder that it is written for.
class NamelessFile {
 public:
  NamelessFile(const std::string& folder, std::string about);
  ~NamelessFile();
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;

  /// The name by which it may be opened once more until forget_name().
  [[nodiscard]] const std::string& name() const { return name_; }
  void forget_name();

  void append(std::string_view bytes);
  /// Calls `take` with all bytes in order, in pieces; it returns how many of a piece it took, and
  /// gets the rest once more with the bytes that follow.
  void read(const std::function<std::size_t(std::string_view)>& take);
  /// All that was appended is in the file.
  void flush();
  /// So many bytes of it from a place on, which were flushed; several threads may ask.
  void read_at(std::uint64_t place, std::span<char> bytes) const;

 private:
  [[noreturn]] void fail(int reason, const char* what = "cannot be written") const;

  std::string about_;
  std::string name_;
  int descriptor_ = -1;
  std::string buffer_;
};

/// The folder for scratch files of an output: its own, or that of temporary files if it goes to a
/// pipe or a device.
std::string scratch_folder(const std::string& output);

}  // namespace oriel
