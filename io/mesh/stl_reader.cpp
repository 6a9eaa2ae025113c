#include "io/json/words.h"
#include "io/mesh/mesh_reader.h"
#include "kernel/base/text/counted.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// Of binary files: what stands before the triangles, and what each of them takes.
constexpr std::size_t kStlHeaderBytes = 84, kStlTriangleBytes = 50;

/// Every triangle names its corners by their coordinates: those that are the same are one point.
class StlPoints {
 public:
  int number_of(Vec3 point, std::vector<Vec3>& points) {
    const Vec3 p = point + Vec3{0, 0, 0};  // -0 is 0
    const auto [found, is_new] = number_of_.try_emplace(p, static_cast<int>(points.size()));
    if (is_new) points.push_back(p);
    return found->second;
  }

 private:
  struct Hash {
    std::size_t operator()(Vec3 p) const noexcept {
      std::uint64_t hash = 0;
      for (const double x : {p.x, p.y, p.z})
        hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
      return hash ^ (hash >> 32U);
    }
  };
  std::unordered_map<Vec3, int, Hash> number_of_;
};

bool is_word(std::string_view word, std::string_view expected) {
  if (word.size() != expected.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if ((static_cast<unsigned char>(word[i]) | 0x20U) != static_cast<unsigned char>(expected[i]))
      return false;
  return true;
}

std::uint32_t whole_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;)
    number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

class StlReader {
 public:
  StlReader(std::string_view text, const TextName& name) : name_(name), text_(text), words_(text) {}

  Checked<Document> read() {
    if (!(is_binary() ? read_triangles() : read_solids()))
      return {std::nullopt, {std::move(*issue_)}};
    return document_of(std::move(mesh_), name_, Format::stl);
  }

 private:
  /// The header of a binary file may begin with "solid", too: its size tells, or what is no text.
  [[nodiscard]] bool is_binary() const {
    if (text_.size() < kStlHeaderBytes) return false;
    if (text_.size() == promised_size()) return true;
    const std::size_t start = text_.find_first_not_of(" \t\r\n");
    return start == std::string_view::npos || !is_word(text_.substr(start, 5), "solid") ||
           text_.substr(0, kStlHeaderBytes).find('\0') != std::string_view::npos;
  }

  [[nodiscard]] std::size_t promised_size() const {
    return kStlHeaderBytes + kStlTriangleBytes * whole_at(text_, kStlHeaderBytes - 4);
  }

  bool read_triangles() {
    const std::size_t count = whole_at(text_, kStlHeaderBytes - 4);
    if (text_.size() != promised_size()) {
      const bool is_cut = text_.size() < promised_size();
      issue_ =
          error_in(name_, {is_cut ? Code::E105 : Code::E167,
                           fmt::format("the file has {} bytes; its header promises {}, which "
                                       "take {}",
                                       text_.size(), counted(count, "triangle"), promised_size())});
      return false;
    }
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<int> face;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto point = point_at(kStlHeaderBytes + kStlTriangleBytes * i + 12 + 12 * corner);
        if (!point) return fail_at_triangle(i);
        face.push_back(points_.number_of(*point, mesh_.points));
      }
      add(std::move(face));
    }
    return true;
  }

  bool fail_at_triangle(std::size_t i) {
    issue_ = error_in(
        name_, {Code::E506, fmt::format("triangle {} (from 0) has a coordinate that is no finite "
                                        "number",
                                        i)});
    return false;
  }

  [[nodiscard]] std::optional<Vec3> point_at(std::size_t offset) const {
    std::array<double, 3> numbers{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      numbers[axis] = std::bit_cast<float>(whole_at(text_, offset + 4 * axis));
      if (!std::isfinite(numbers[axis])) return std::nullopt;
    }
    return Vec3{numbers[0], numbers[1], numbers[2]};
  }

  void add(std::vector<int> face) {
    mesh_.faces.push_back(std::move(face));
    mesh_.hints.push_back(solid_);
  }

  bool fail(std::string sentence, Code code = Code::E167) {
    issue_ = error_at(name_, text_, words_.offset(), {code, std::move(sentence)});
    return false;
  }

  /// The next word, on whatever line; nothing at the end of the file.
  std::optional<std::string_view> next() {
    auto word = words_.next_word();
    while (!word && words_.next_line()) word = words_.next_word();
    return word;
  }

  bool expect(std::string_view expected) {
    const auto word = next();
    if (word && is_word(*word, expected)) return true;
    return word ? fail(fmt::format("{} stands where {} was expected", in_quotes(*word), expected))
                : fail(fmt::format("the file ends; expected {}", expected), Code::E105);
  }

  bool read_solids() {
    auto word = next();
    if (!word) return fail("the file is empty; expected solid", Code::E102);
    if (!is_word(*word, "solid"))
      return fail(fmt::format("starts with {}; expected solid, or a binary STL", in_quotes(*word)),
                  Code::E107);
    while (word) {
      if (!is_word(*word, "solid"))
        return fail(fmt::format("{} follows a solid; expected solid or the end of the file",
                                in_quotes(*word)));
      solid_ = words_.rest_of_line();
      if (!read_facets()) return false;
      words_.rest_of_line();  // endsolid NAME
      word = words_.next_line() ? words_.next_word() : std::nullopt;
    }
    return true;
  }

  bool read_facets() {
    while (true) {
      const auto word = next();
      if (!word) return fail("the file ends inside a solid; expected endsolid", Code::E105);
      if (is_word(*word, "endsolid")) return true;
      if (!is_word(*word, "facet"))
        return fail(
            fmt::format("{} stands in a solid; expected facet or endsolid", in_quotes(*word)));
      if (!read_facet()) return false;
    }
  }

  bool read_facet() {
    if (!expect("normal")) return false;
    for (int axis = 0; axis < 3; ++axis)
      if (!read_number()) return false;
    if (!expect("outer") || !expect("loop")) return false;
    std::vector<int> face;
    for (int corner = 0; corner < 3; ++corner) {
      std::array<double, 3> point{};
      if (!expect("vertex") || !read_point(point)) return false;
      face.push_back(points_.number_of({point[0], point[1], point[2]}, mesh_.points));
    }
    add(std::move(face));
    return expect("endloop") && expect("endfacet");
  }

  bool read_point(std::array<double, 3>& point) {
    for (double& coordinate : point) {
      const auto number = read_number();
      if (!number) return false;
      if (!std::isfinite(*number))
        return fail(fmt::format("the coordinate is {}; expected a finite number", *number),
                    Code::E506);
      coordinate = *number;
    }
    return true;
  }

  std::optional<double> read_number() {
    const auto word = next();
    const auto number = word ? as_double(*word) : std::nullopt;
    if (!word)
      fail("the file ends; expected a number", Code::E105);
    else if (!number)
      fail(fmt::format("{} is not a number", in_quotes(*word)));
    return number;
  }

  const TextName& name_;
  std::string_view text_;
  WordReader words_;
  StlPoints points_;
  std::string solid_;
  RawMesh mesh_;
  std::optional<Issue> issue_;
};

}  // namespace

Checked<Document> read_stl(std::string_view text, const TextName& name) {
  return StlReader(text, name).read();
}

}  // namespace oriel::detail
