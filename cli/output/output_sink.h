#pragma once

#include "cli/batch/outcome.h"
#include "cli/output/named_files.h"
#include "oriel/write.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel::cli {

/// Where labelled buildings go: one file, stdout, or for several inputs a folder with a file of the
/// same name for each. A file appears when its input is done, whole.
class OutputSink {
 public:
  /// `to` is a format's name or empty: then the name of `out` says it, or, for a folder and stdout,
  /// the input's format (CityJSON for CityGML). Throws CLI::ValidationError if that makes no sense
  /// (several inputs and no folder, a stream into one file).
  OutputSink(std::string out, const std::string& to, std::vector<std::string> inputs,
             std::optional<Format> from, StlSolids solids = StlSolids::by_label);

  /// Lines of streams become lines of streams, or buildings of CityGML, and nothing else.
  [[nodiscard]] bool is_streaming() const;
  [[nodiscard]] bool is_stdout() const { return out_ == "-"; }
  /// A file has the attributes of features: OutputRecord::features is written.
  [[nodiscard]] bool has_attributes() const;
  /// Some output is a mesh or a GeoPackage, for which the buildings of a record are gathered, those
  /// that leave it too.
  [[nodiscard]] bool gathers_any() const;
  /// A file says which feature its faces belong to.
  [[nodiscard]] bool names_features() const;

  /// Adds the file of each input; `is_selection`: of a stream only some records are written.
  void name_files(NamedFiles& files, bool is_selection) const;
  /// The file at hand and its size so far.
  [[nodiscard]] PartPlace place() const;
  /// With `is_rehearsal` the bytes go to nowhere.
  void begin(std::size_t input, bool is_rehearsal);
  /// A record of an input on its way into its file. Several threads may call it.
  [[nodiscard]] std::shared_ptr<RecordText> record(std::size_t input, const Document& document,
                                                   WriteOptions options = {}) const;
  /// Puts what became of it into a product.
  static void finish(std::shared_ptr<RecordText> record, Product& product);
  /// All files are CityGML.
  [[nodiscard]] bool is_citygml() const;
  /// All files are CityJSON or CityJSONSeq, and made of such files.
  [[nodiscard]] bool is_cityjson() const;
  /// Files of such formats are made when all records are there.
  [[nodiscard]] bool is_gathering(std::size_t input) const;
  /// Puts a record of the input at hand into its place.
  void take(const Document& document, const Product& product);
  void add(const Document& document, OutputRecord output);
  /// Puts the file in its place and returns its path.
  std::string end();
  /// What was found in the files that are in their place, and is no longer here then.
  std::vector<Issue> take_issues() { return std::exchange(issues_, {}); }

 private:
  [[nodiscard]] Format format_of_input(std::size_t input) const;
  [[nodiscard]] Format format_of_output(std::size_t input) const;
  [[nodiscard]] std::string path_for(std::size_t input) const;
  [[nodiscard]] std::string loss(std::size_t input, bool is_selection) const;
  void check(std::size_t input) const;

  std::string out_;
  std::vector<std::string> inputs_;
  std::optional<Format> from_, to_;
  StlSolids solids_;
  bool is_folder_ = false;

  std::size_t input_ = 0;
  std::string path_;
  std::unique_ptr<RecordFile> file_;
  std::vector<Issue> issues_;
};

}  // namespace oriel::cli
