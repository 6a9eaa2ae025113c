#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace oriel::generator {

/// A file or stream could not be written; what() says which.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that appears under its name when it is complete: it is written beside it and renamed.
/// Throws OutputError.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Removes what was written if finish was not reached.
  ~OutputFile();

  void write(std::string_view text);
  void finish();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_, part_;
  std::ofstream stream_;
  bool is_finished_ = false;
};

}  // namespace oriel::generator
