#pragma once

#include "cli/commands/view/exhibit.h"
#include "cli/options/feature_choice.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/logging.h"
#include "oriel/picture.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace oriel::cli {

/// What `oriel view` was told of a picture.
struct PictureArguments {
  PictureOptions options;
  std::string facade, size, grid;
  bool is_plan = false, has_no_legend = false;
  std::vector<std::string> scale_texts, lods, truth_files;
  /// The feature that is explained; empty: none is.
  std::string explained;
  /// No option says from where it is looked at.
  bool looks_from_default = true;
  /// Of `--scales`, ascending, and `--to-lod`.
  std::vector<Targets> targets;
  /// By building.
  std::map<std::string, GroundTruth> truths;
  /// Of `--grid`, columns × rows; none: no limit.
  std::optional<std::size_t> most_panels;
};

/// Reads the format off the ending of a name; none for a page.
std::optional<PictureFormat> picture_format(const std::string& path);

/// Adds the options of pictures to a command, which has `--after`. Returns them.
std::vector<CLI::Option*> add_picture_arguments(CLI::App& command, PictureArguments& arguments);

/// Makes options of the texts. Throws CLI::ValidationError for what is none.
void settle(PictureArguments& arguments);

/// Makes targets of scales and levels of detail. False if a profile cannot be used, which is
/// reported. Throws CLI::ValidationError.
bool settle_targets(PictureArguments& arguments, const RuleBase& rules, Report& report);

/// Reads the files of `--compare`, and reports what is wrong with them.
ExitCode read_truth(PictureArguments& arguments, Report& report);

/// A picture with a panel of all buildings, with `--grid` one of each, with `--scales` and
/// `--to-lod` one of each for each target, and with `--after` one more of each file; with
/// `--explain` of a feature with its building, and of what is near it alone.
class PictureExhibit final : public Exhibit {
 public:
  /// `before` is the caption of the first panel, where there are others after it.
  PictureExhibit(PictureArguments arguments, PictureFormat format, const RuleBase& rules,
                 LabelOptions options, std::string before)
      : arguments_(std::move(arguments)),
        format_(format),
        rules_(rules),
        options_(std::move(options)),
        before_(std::move(before)),
        choice_(arguments_.explained, "--explain") {}

  std::vector<Issue> add(const Document& document, const Building& building,
                         const PipelineResult& result) override;
  void begin_after(const std::string& file) override;
  void add_after(const Building& building, const PipelineResult& result,
                 const CarriedLabels* carried) override;
  void check(ExitCode code) const override;
  std::string made() override;

 private:
  void add_explained(const Building& building, const PipelineResult& result);
  void add_to(PicturePanel& panel, const Building& building, const PipelineResult& result);

  PictureArguments arguments_;
  PictureFormat format_;
  const RuleBase& rules_;
  LabelOptions options_;
  std::string before_;
  std::vector<PicturePanel> panels_;
  FeatureChoice choice_;
  ComparedCounts compared_;
  std::size_t left_out_ = 0, with_truth_ = 0, without_truth_ = 0;
  bool has_after_ = false;
};

}  // namespace oriel::cli
