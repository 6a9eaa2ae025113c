#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace oriel {

/// One text for each row, of which there are few that differ: each stands once, and a row has the
/// number of its word. The word 0 is "", a missing text.
class WordColumn {
 public:
  WordColumn() = default;
  /// All are missing.
  explicit WordColumn(std::size_t rows) : numbers_(rows, 0), words_(1) {}

  [[nodiscard]] const std::string& operator[](std::size_t row) const {
    return words_[numbers_[row]];
  }
  [[nodiscard]] bool empty() const { return numbers_.empty(); }

  /// Also words that stand in no row any more.
  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }
  /// By row: its word.
  [[nodiscard]] const std::vector<std::uint32_t>& numbers() const { return numbers_; }

  void set(std::size_t row, std::string text);

 private:
  std::vector<std::uint32_t> numbers_;
  std::vector<std::string> words_;
  /// Of all words but "".
  std::unordered_map<std::string, std::uint32_t> number_of_;
};

}  // namespace oriel
