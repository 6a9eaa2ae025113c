#pragma once

#include "io/reader.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

namespace oriel::test {

/// A folder of its own that vanishes with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "oriel-io-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

  /// Writes a file and gives its path. A file of that name is removed first: to truncate it would
  /// make some file systems wait for the disk.
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }

  [[nodiscard]] std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All records of a file.
inline std::vector<Checked<Document>> read_all(const std::string& path, ReadOptions options = {}) {
  Reader reader(path, std::move(options));
  std::vector<Checked<Document>> records;
  while (auto record = reader.next()) records.push_back(std::move(*record));
  return records;
}

/// The only record of a file with that name and content.
inline Checked<Document> read_text(const std::string& text, const std::string& name = "a.city.json",
                                   ReadOptions options = {}) {
  const TemporaryFolder folder;
  auto records = read_all(folder.write(name, text), std::move(options));
  return std::move(records.at(0));
}

/// The codes of all issues, separated by blanks.
inline std::string codes_of(const std::vector<Issue>& issues) {
  std::string codes;
  for (const Issue& issue : issues) codes += (codes.empty() ? "" : " ") + to_string(issue.code);
  return codes;
}

}  // namespace oriel::test
