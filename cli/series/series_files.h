#pragma once

#include "cli/commands/labelling.h"
#include "cli/output/output_sink.h"
#include "cli/streams/common_header.h"
#include "kernel/io/cityjson/cityjson_collector.h"
#include "kernel/io/files/output_file.h"
#include "oriel/write.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace oriel::cli {

/// The files of a series: one for each scale, and the log. They appear when all inputs are done.
///
/// - Of one input that is no stream, NAME.1-N.city.json, where all else stays byte for byte.
/// - Of several such, one CityJSON file, held in memory; with grids of their own they get one of
///   micrometres, made coarser if all vertices allow it.
/// - Of streams, NAME.1-N.city.jsonl under the header of the first, line by line.
class SeriesFiles {
 public:
  /// `scales` ascend. Refuses with G414 (refuse_usage) what makes no series.
  SeriesFiles(const LabelArguments& arguments, const std::vector<double>& scales);

  /// Before the first record of an input; with `is_rehearsal` nothing is kept.
  void begin(std::size_t input, bool is_rehearsal);
  /// A record at all scales, and its lines of the log (operation_line). Adds nothing if it has the
  /// id of a CityObject that an earlier input had, and returns that. Throws InputError E116 if its
  /// input does not go with the first.
  std::optional<std::string> add(const Document& document, const std::vector<OutputRecord>& levels,
                                 const std::string& lines);
  void end();
  void commit();

 private:
  enum class Kind { one_file, several_files, streams };
  struct Level {
    std::unique_ptr<OutputSink> destination;  ///< of one file
    std::unique_ptr<OutputFile> file;
    CityJsonCollector collector;
  };

  static Kind kind_of(const LabelArguments& arguments);
  [[nodiscard]] std::string path_of(double scale) const;
  void check_header(const std::string& header, const Document& document);
  [[nodiscard]] std::optional<std::string> twin(const Document& document,
                                                const std::vector<std::string>& texts) const;
  void add_text(Level& level, const std::string& text, bool is_header) const;

  const LabelArguments& arguments_;
  const std::vector<double>& scales_;
  Kind kind_;
  std::vector<Level> levels_;  ///< by scale
  std::unique_ptr<OutputFile> log_;
  CommonHeader headers_;
  std::unordered_set<std::string> ids_;  ///< of buildings, of several inputs
  std::size_t input_ = 0;
  bool is_first_ = true;    ///< record of the input
  bool has_ended_ = false;  ///< an input did
};

}  // namespace oriel::cli
