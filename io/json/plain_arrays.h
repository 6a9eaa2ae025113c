#pragma once

#include "io/json/json_scan.h"
#include "model/vec3.h"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// Arrays of arrays of whole numbers, all numbers equally deep.
struct NestedNumbers {
  static constexpr int kMaxDepth = 5;

  /// How many levels of arrays there are, 3 (surfaces, rings, numbers) to kMaxDepth.
  int depth = 0;
  /// All of them, in order.
  std::vector<int> numbers;
  /// By level, the innermost first: of each array where it ends in the list of the next inner
  /// level (that of the innermost ones: in `numbers`).
  std::array<std::vector<int>, kMaxDepth> ends;

  void clear();
};

/// The arrays under the keys "vertices" and "boundaries" of a CityJSON text: nearly all of its
/// bytes, and nothing but whole numbers. They are read here; what is left is short and goes to a
/// parser of JSON.
class PlainArrays {
 public:
  /// Reads those of `text`. False if one is not plain, and then nothing of this holds: "vertices"
  /// are arrays of three whole numbers of at most 16 digits, "boundaries" are as NestedNumbers, of
  /// at most 9 digits, without a sign, and no array but that of all vertices is empty. Nor may the
  /// text have a backslash. `text` is followed by a zero byte or by what stands behind it in a JSON
  /// text. What `cut` names, values in their order, is not looked at.
  bool read(std::string_view text, std::span<const TextRange> cut = {});

  /// The text with each of the arrays as its number from 0 on, within as many brackets as the
  /// array is deep, and {} for what was cut. It is valid JSON if and only if the text read is, and
  /// so are the values that were cut.
  [[nodiscard]] const std::string& rest() const { return rest_; }

  /// How many arrays there are; their places are ascending.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] TextRange place(std::size_t number) const { return arrays_[number].place; }
  /// Of an array under "boundaries".
  [[nodiscard]] const NestedNumbers& boundaries(std::size_t number) const {
    return arrays_[number].boundaries;
  }
  /// Of an array under "vertices": the numbers as they stand there.
  [[nodiscard]] const std::vector<Vec3>& vertices(std::size_t number) const {
    return arrays_[number].vertices;
  }

 private:
  struct Array {
    TextRange place;
    std::vector<Vec3> vertices;
    NestedNumbers boundaries;
  };

  bool read_arrays(std::string_view text, std::span<const TextRange> cut);
  Array& next_array();

  std::string rest_;
  /// Those of the last text, and behind them others whose memory the next one takes.
  std::vector<Array> arrays_;
  std::size_t size_ = 0;
};

}  // namespace oriel::detail
