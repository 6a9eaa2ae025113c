#pragma once

#include "cli/batch/run_options.h"
#include "io/document.h"
#include "kernel/base/issue.h"
#include "oriel/result.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// What happens with the lines of a CityJSONSeq. They have their line ends.
struct LineVisitor {
  std::function<void(const std::string&)> header;
  std::function<void(const std::string&)> feature;
};

/// Turns an input into a CityJSONSeq, record by record: CityJSON, OBJ and OFF are taken apart into
/// features, CityGML becomes lines, the lines of a CityJSONSeq stay as they are.
class StreamLines {
 public:
  /// A feature of which nothing is selected is left out.
  StreamLines(LineVisitor visitor, const Selection& selection)
      : visitor_(std::move(visitor)), selection_(selection) {}

  void begin() { is_first_ = true; }
  /// How many lines were given to the visitor, headers not counted.
  [[nodiscard]] std::size_t features() const { return features_; }
  /// `lines` belong to the document's buildings.
  void add(const Document& document, const std::vector<PipelineResult>& lines);

 private:
  void take_apart(const Document& document, const std::vector<PipelineResult>& lines);
  void give(const std::string& line);

  LineVisitor visitor_;
  const Selection& selection_;
  bool is_first_ = true;  ///< record of its input
  std::size_t features_ = 0;
};

/// Several inputs that become one stream, or one file, have one header: this compares the later
/// ones with the first.
class CommonHeader {
 public:
  /// What becomes of the inputs: a stream has one grid, a file may be given a finer one.
  enum class Of { stream, file };
  explicit CommonHeader(Of of = Of::stream) : of_(of) {}

  /// Nothing if `header`, a CityJSON object, has the facts of the first (stream_header_facts, of a
  /// file file_facts). Else an error E116 in `input`.
  std::optional<Issue> check(const std::string& header, const std::string& input);

 private:
  Of of_;
  std::string facts_, input_;  ///< of the first
};

}  // namespace oriel::cli
