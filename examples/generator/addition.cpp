#include "examples/generator/addition.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::generator {
namespace {

using Shape = Addition::Shape;
using Surface = Addition::Surface;

constexpr std::string_view kForm = "CLASS block|hole|panel on SURFACE [at X,Y] size WxH[xD]";
constexpr std::array<std::pair<std::string_view, Shape>, 3> kShapes{
    {{"block", Shape::block}, {"hole", Shape::hole}, {"panel", Shape::panel}}};
constexpr std::array<std::pair<std::string_view, Surface>, 7> kSurfaces{{{"wall", Surface::wall},
                                                                         {"front", Surface::front},
                                                                         {"back", Surface::back},
                                                                         {"left", Surface::left},
                                                                         {"right", Surface::right},
                                                                         {"gable", Surface::gable},
                                                                         {"roof", Surface::roof}}};

/// Metres that a thing may measure. What is deeper could meet another wall's.
constexpr double kLeastSide = 0.02, kMostSide = 50, kLeastDepth = 0.01, kMostBlock = 1.8,
                 kMostHole = 1.5;
/// Metres that it is deep where nothing is said.
constexpr double kBlockDepth = 0.5, kHoleDepth = 0.2, kPanelDepth = 0.05;

/// Reads one addition, word by word.
class AdditionReader {
 public:
  explicit AdditionReader(std::string_view text) : text_(text) {
    std::size_t begin = 0;
    while ((begin = text.find_first_not_of(" \t", begin)) != std::string_view::npos) {
      const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
      words_.push_back(text.substr(begin, end - begin));
      begin = end;
    }
  }

  Addition read() {
    addition_.text = text_;
    read_class(next("a class"));
    read_shape(next("block, hole or panel"));
    if (next("on") != "on") fail(fmt::format("'{}' where 'on' must stand", words_[next_ - 1]));
    read_surface(next("a surface"));
    bool has_size = false;
    while (next_ < words_.size()) {
      const std::string_view key = words_[next_++];
      if (key == "at" && !addition_.at) {
        const auto [x, y] = pair(next("a position"));
        addition_.at = Uv{micrometres_of(x), micrometres_of(y)};
      } else if (key == "size" && !has_size) {
        read_size(next("a size"));
        has_size = true;
      } else {
        fail(fmt::format("'{}' where 'at X,Y' or 'size WxH' may stand once", key));
      }
    }
    if (!has_size) fail("its size is missing");
    return std::move(addition_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw AdditionError(fmt::format("E140 '{}': {}; write \"{}\"", text_, what, kForm));
  }

  std::string_view next(const char* what) {
    if (next_ == words_.size()) fail(fmt::format("{} is missing at the end", what));
    return words_[next_++];
  }

  static Um micrometres_of(double metres) { return std::llround(metres * 1000) * 1000; }

  [[nodiscard]] double number(std::string_view word) const {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value) ||
        std::abs(value) > kMostSide * 10)
      fail(fmt::format("'{}' is not a number of metres", word));
    return value;
  }

  [[nodiscard]] std::pair<double, double> pair(std::string_view word) const {
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos) fail(fmt::format("'{}' is not a position X,Y", word));
    return {number(word.substr(0, comma)), number(word.substr(comma + 1))};
  }

  void read_class(std::string_view word) {
    const auto is_plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    };
    if (!std::ranges::all_of(word, is_plain) || word[0] < 'a')
      fail(fmt::format("'{}' is not the name of a class (small letters, digits and _)", word));
    if (word == "wall" || word == "roof" || word == "ground")
      fail(fmt::format("'{}' is a surface of the bare house, not a class to add", word));
    addition_.class_name = word;
  }

  void read_shape(std::string_view word) {
    const auto* shape =
        std::ranges::find(kShapes, word, &std::pair<std::string_view, Shape>::first);
    if (shape == kShapes.end()) fail(fmt::format("'{}' is not block, hole or panel", word));
    addition_.shape = shape->second;
    const bool is_opening = addition_.class_name == "window" || addition_.class_name == "door";
    if (is_opening && addition_.shape != Shape::hole)
      fail(fmt::format("a {} is a hole", addition_.class_name));
  }

  void read_surface(std::string_view word) {
    const std::string_view name = word.substr(0, word.find_first_of("0123456789"));
    const auto* surface =
        std::ranges::find(kSurfaces, name, &std::pair<std::string_view, Surface>::first);
    const std::string_view digits = word.substr(name.size());
    const bool has_numbers = name == "roof" || name == "gable";
    if (surface == kSurfaces.end() || (!digits.empty() && !has_numbers) || digits.size() > 2)
      fail(
          fmt::format("there is no surface '{}' (wall, front, back, left, right, gable, gable1 .., "
                      "roof, roof1 ..)",
                      word));
    addition_.surface = surface->second;
    if (digits.empty()) return;
    addition_.number = static_cast<int>(number(digits));
    if (addition_.number == 0) fail(fmt::format("'{}': surfaces are counted from 1", word));
  }

  void read_size(std::string_view word) {
    std::vector<double> sides;
    for (std::size_t begin = 0; begin <= word.size();) {
      const std::size_t end = std::min(word.find('x', begin), word.size());
      sides.push_back(number(word.substr(begin, end - begin)));
      begin = end + 1;
    }
    if (sides.size() == 2) sides.push_back(usual_depth());
    if (sides.size() != 3) fail(fmt::format("'{}' is not a size WxH or WxHxD", word));
    for (const double side : {sides[0], sides[1]})
      if (side < kLeastSide || side > kMostSide)
        fail(fmt::format("{} m must be within {} .. {} m", side, kLeastSide, kMostSide));
    const bool is_hole = addition_.shape == Shape::hole;
    const double most = is_hole ? kMostHole : kMostBlock, least = is_hole ? 0 : kLeastDepth;
    if (sides[2] < least || sides[2] > most)
      fail(fmt::format("its depth of {} m must be within {} .. {} m", sides[2], least, most));
    addition_.width = micrometres_of(sides[0]);
    addition_.height = micrometres_of(sides[1]);
    addition_.depth = micrometres_of(sides[2]);
  }

  [[nodiscard]] double usual_depth() const {
    if (addition_.shape == Shape::block) return kBlockDepth;
    return addition_.shape == Shape::hole ? kHoleDepth : kPanelDepth;
  }

  std::string_view text_;
  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
  Addition addition_;
};

}  // namespace

Addition read_addition(std::string_view text) { return AdditionReader(text).read(); }

}  // namespace oriel::generator
