#include "model/description/word_column.h"

#include <utility>

namespace oriel {

void WordColumn::set(std::size_t row, std::string text) {
  if (text.empty()) {
    numbers_[row] = 0;
    return;
  }
  // Mostly the word of the row before.
  if (row > 0 && words_[numbers_[row - 1]] == text) {
    numbers_[row] = numbers_[row - 1];
    return;
  }
  const auto next = static_cast<std::uint32_t>(words_.size());
  const auto [place, is_new] = number_of_.try_emplace(text, next);
  if (is_new) words_.push_back(std::move(text));
  numbers_[row] = place->second;
}

}  // namespace oriel
