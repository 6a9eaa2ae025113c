#include "io/json/words.h"
#include "io/mesh/mesh_reader.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// Findings after which a file is given up.
constexpr std::size_t kMaxFindings = 20;

constexpr std::array<std::string_view, 7> kIgnored{"vt", "vn", "vp", "l", "p", "s", "mtllib"};

class ObjReader {
 public:
  ObjReader(std::string_view text, const TextName& name)
      : name_(name), original_(text), joined_(join_lines(text)), words_(joined_) {}

  Checked<Document> read() {
    while (issues_.size() < kMaxFindings && words_.next_line()) read_statement();
    for (const Forward& forward : forwards_)
      if (forward.number >= mesh_.points.size() && issues_.size() < kMaxFindings)
        report(forward.offset, out_of_range(static_cast<long long>(forward.number) + 1));
    if (!issues_.empty()) return {std::nullopt, std::move(issues_)};
    return document_of(std::move(mesh_), name_, Format::obj);
  }

 private:
  /// A vertex that a face names before it is defined.
  struct Forward {
    std::size_t number;
    std::size_t offset;
  };

  /// `text` with a backslash at a line's end and that end as blanks: same offsets, longer lines.
  static std::string join_lines(std::string_view text) {
    std::string joined(text);
    for (std::size_t at = joined.find('\\'); at != std::string::npos;
         at = joined.find('\\', at + 1)) {
      const std::size_t end = joined.compare(at + 1, 1, "\r") == 0 ? at + 2 : at + 1;
      if (joined.compare(end, 1, "\n") == 0) std::fill(&joined[at], &joined[end] + 1, ' ');
    }
    return joined;
  }

  void report(std::size_t offset, Fault fault) {
    issues_.push_back(error_at(name_, original_, offset, std::move(fault)));
  }

  void read_statement() {
    const std::string_view keyword = *words_.next_word();
    if (keyword == "v") return read_vertex();
    if (keyword == "f") return read_face();
    if (keyword == "o") return set_name(object_);
    if (keyword == "g") return set_name(group_);
    if (keyword == "usemtl") return set_name(material_);
    if (std::ranges::find(kIgnored, keyword) == kIgnored.end())
      report(words_.offset(), {Code::E109, fmt::format("unknown statement {}; expected v, f, g, o, "
                                                       "usemtl or another statement of an OBJ file",
                                                       in_quotes(keyword))});
  }

  void set_name(std::string& name) {
    name = words_.rest_of_line();
    hint_.clear();
    for (const std::string* part : {&object_, &group_, &material_})
      if (!part->empty()) hint_ += (hint_.empty() ? "" : "/") + *part;
  }

  /// x y z, then nothing, a weight, or a colour.
  void read_vertex() {
    std::vector<double> numbers;
    while (const auto word = words_.next_word()) {
      const auto number = as_double(*word);
      if (!number)
        return report(words_.offset(),
                      {Code::E109, fmt::format("{} is not a number", in_quotes(*word))});
      if (!std::isfinite(*number))
        return report(words_.offset(),
                      {Code::E506, fmt::format("the coordinate is {}; expected a finite number",
                                               in_quotes(*word))});
      numbers.push_back(*number);
    }
    const std::size_t count = numbers.size();
    if (count != 3 && count != 4 && count != 6)
      return report(words_.offset(), {Code::E109, fmt::format("a vertex of {}; expected x y z",
                                                              counted(count, "number"))});
    mesh_.points.push_back({numbers[0], numbers[1], numbers[2]});
  }

  void read_face() {
    std::vector<int> face;
    while (const auto word = words_.next_word()) {
      const auto number = read_corner(*word);
      if (!number) return;
      face.push_back(*number);
    }
    if (face.size() < 3)
      return report(words_.offset(),
                    {Code::E311, fmt::format("a face of {}; expected 3 or more (val3dity 101 "
                                             "TOO_FEW_POINTS)",
                                             counted(face.size(), "vertex", "vertices"))});
    mesh_.faces.push_back(std::move(face));
    mesh_.hints.push_back(hint_);
  }

  static Fault out_of_range(long long number) {
    return {Code::E203, fmt::format("there is no vertex {}", number)};
  }

  /// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`; nothing after a finding.
  std::optional<int> read_corner(std::string_view word) {
    const std::size_t offset = words_.offset();
    const std::size_t slash = std::min(word.find('/'), word.size());
    const auto number = as_whole(word.substr(0, slash));
    bool is_good = number.has_value();
    std::string_view rest = word.substr(slash);
    for (int part = 0; is_good && !rest.empty(); ++part) {
      rest.remove_prefix(1);
      const std::string_view index = rest.substr(0, rest.find('/'));
      rest.remove_prefix(index.size());
      is_good = part < 2 && (as_whole(index) || (index.empty() && part == 0 && !rest.empty()));
    }
    if (!is_good) {
      report(offset,
             {Code::E109, fmt::format("{} is not a corner of a face; expected v, v/vt, v//vn or "
                                      "v/vt/vn",
                                      in_quotes(word))});
      return std::nullopt;
    }
    const auto count = static_cast<long long>(mesh_.points.size());
    const long long index = *number < 0 ? count + *number : *number - 1;
    if (*number == 0 || index < 0 || index > std::numeric_limits<int>::max()) {
      report(offset, out_of_range(*number));
      return std::nullopt;
    }
    if (index >= count) forwards_.push_back({static_cast<std::size_t>(index), offset});
    return static_cast<int>(index);
  }

  const TextName& name_;
  std::string_view original_;
  std::string joined_;
  WordReader words_;
  RawMesh mesh_;
  std::string object_, group_, material_, hint_;
  std::vector<Forward> forwards_;
  std::vector<Issue> issues_;
};

}  // namespace

Checked<Document> read_obj(std::string_view text, const TextName& name) {
  return ObjReader(text, name).read();
}

}  // namespace oriel::detail
