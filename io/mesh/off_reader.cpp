#include "io/json/words.h"
#include "io/mesh/mesh_reader.h"
#include "kernel/base/text/counted.h"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

class OffReader {
 public:
  OffReader(std::string_view text, const TextName& name) : name_(name), text_(text), words_(text) {}

  Checked<Document> read() {
    if (!read_header()) return refuse();
    for (long long i = 0; i < counts_[0]; ++i)
      if (!next_line(i, counts_[0], "vertices") || !read_vertex()) return refuse();
    for (long long i = 0; i < counts_[1]; ++i)
      if (!next_line(i, counts_[1], "faces") || !read_face()) return refuse();
    if (words_.next_line()) {
      const std::string_view word = *words_.next_word();
      fail(Code::E110,
           fmt::format("{} follows the last face; expected the end of the file", in_quotes(word)));
      return refuse();
    }
    return document_of(std::move(mesh_), name_, Format::off);
  }

 private:
  Checked<Document> refuse() { return {std::nullopt, {std::move(*issue_)}}; }

  bool fail(Code code, std::string sentence) {
    issue_ = error_at(name_, text_, words_.offset(), {code, std::move(sentence)});
    return false;
  }

  /// Moves to the line of part `i` of `count`.
  bool next_line(long long i, long long count, std::string_view what) {
    if (words_.next_line()) return true;
    return fail(Code::E110,
                fmt::format("the file ends after {} {}; its header promises {}", i, what, count));
  }

  /// "OFF", then on the same or the next line the numbers of vertices, faces and edges.
  bool read_header() {
    const bool has_word = words_.next_line();
    const auto word = words_.next_word();
    if (!has_word || *word != "OFF")
      return fail(has_word ? Code::E107 : Code::E102,
                  has_word ? fmt::format("starts with {}; expected OFF", in_quotes(*word))
                           : "the file is empty; expected OFF");
    auto number = words_.next_word();
    if (!number && words_.next_line()) number = words_.next_word();
    for (long long& count : counts_) {
      const auto value = number ? as_whole(*number) : std::nullopt;
      if (!value || *value < 0)
        return fail(Code::E110, "expected the numbers of vertices, faces and edges");
      count = *value;
      number = words_.next_word();
    }
    return !number ||
           fail(Code::E110, fmt::format("{} follows the three counts", in_quotes(*number)));
  }

  bool read_vertex() {
    std::array<double, 3> numbers{};
    for (double& coordinate : numbers) {
      const auto word = words_.next_word();
      const auto number = word ? as_double(*word) : std::nullopt;
      if (!number)
        return fail(Code::E110, fmt::format("vertex {} is not three numbers", mesh_.points.size()));
      if (!std::isfinite(*number))
        return fail(Code::E506, fmt::format("the coordinate is {}; expected a finite number",
                                            in_quotes(*word)));
      coordinate = *number;
    }
    if (const auto word = words_.next_word())
      return fail(Code::E110, fmt::format("{} follows the three coordinates", in_quotes(*word)));
    mesh_.points.push_back({numbers[0], numbers[1], numbers[2]});
    return true;
  }

  bool read_face() {
    const auto first = words_.next_word();
    const auto corners = as_whole(*first);
    if (!corners || *corners < 0)
      return fail(Code::E110, fmt::format("{} is not a number of vertices", in_quotes(*first)));
    if (*corners < 3)
      return fail(Code::E311, fmt::format("a face of {}; expected 3 or more (val3dity 101 "
                                          "TOO_FEW_POINTS)",
                                          counted(*corners, "vertex", "vertices")));
    std::vector<int> face;
    for (long long i = 0; i < *corners; ++i) {
      const auto word = words_.next_word();
      const auto number = word ? as_whole(*word) : std::nullopt;
      if (!number)
        return fail(Code::E110, fmt::format("a face of {} vertices lists {}", *corners, i));
      if (*number < 0 || *number >= counts_[0])
        return fail(Code::E203,
                    fmt::format("there is no vertex {}; there {} {}, counted from 0", *number,
                                agreeing(counts_[0], "is", "are"), counts_[0]));
      face.push_back(static_cast<int>(*number));
    }
    while (const auto colour = words_.next_word())
      if (!as_double(*colour))
        return fail(Code::E110, fmt::format("{} follows the face; expected a colour or nothing",
                                            in_quotes(*colour)));
    mesh_.faces.push_back(std::move(face));
    mesh_.hints.emplace_back();
    return true;
  }

  const TextName& name_;
  std::string_view text_;
  WordReader words_;
  std::array<long long, 3> counts_{};
  RawMesh mesh_;
  std::optional<Issue> issue_;
};

}  // namespace

Checked<Document> read_off(std::string_view text, const TextName& name) {
  return OffReader(text, name).read();
}

}  // namespace oriel::detail
