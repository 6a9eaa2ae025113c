#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace oriel {

/// "1 rule", "2 rules", "0 rules". `plural` where it is not the noun with an s: "vertices".
template <std::integral Count>
std::string counted(Count count, std::string_view noun, std::string_view plural = {}) {
  std::string text = std::to_string(count) + " ";
  text += count == 1 || plural.empty() ? noun : plural;
  if (count != 1 && plural.empty()) text += "s";
  return text;
}

/// "1 of 1 building", "0 of 2 buildings": the noun goes with the number of all.
template <std::integral Count>
std::string counted_of(Count count, Count all, std::string_view noun,
                       std::string_view plural = {}) {
  return std::to_string(count) + " of " + counted(all, noun, plural);
}

/// The word that goes with a count: "is", or "are".
template <std::integral Count>
std::string_view agreeing(Count count, std::string_view with_one, std::string_view with_several) {
  return count == 1 ? with_one : with_several;
}

/// That of counted_of(): "1 of 2 buildings is", "0 of 1 building is", "0 of 2 buildings are".
template <std::integral Count>
std::string_view agreeing_of(Count count, Count all, std::string_view with_one,
                             std::string_view with_several) {
  return agreeing(all == 1 ? all : count, with_one, with_several);
}

}  // namespace oriel
