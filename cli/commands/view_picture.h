#pragma once

#include "io/cityjson/carried_labels.h"
#include "io/document.h"
#include "oriel/label.h"
#include "oriel/write.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace oriel::cli {

/// What `oriel view` was told of a picture.
struct PictureArguments {
  PictureOptions options;
  std::string facade, size, grid;
  bool is_plan = false, has_no_legend = false;
  std::vector<std::string> scale_texts;
  /// Those of `--scales`, ascending.
  std::vector<double> scales;
  /// Of `--grid`, columns × rows; none: no limit.
  std::optional<std::size_t> most_panels;
};

/// Reads the format off the ending of a name; none for a page.
std::optional<PictureFormat> picture_format(const std::string& path);

/// Adds the options of pictures to a command.
void add_picture_arguments(CLI::App& command, PictureArguments& arguments);

/// Makes options of the texts. Throws CLI::ValidationError for what is none, and for options of a
/// picture where a page is written.
void settle(PictureArguments& arguments, bool is_picture, bool has_after);

/// Puts what a file says of a building's parts in the form in which it is written.
LabelledBuilding labelled_as(const Building& building, const CarriedLabels& carried);

/// Gathers the buildings of a run as panels: one of all of them, with `--grid` one of each, with
/// `--scales` one of each at each scale; with `--after` one more of each file.
class PanelGatherer {
 public:
  PanelGatherer(const PictureArguments& arguments, const RuleBase& rules, LabelOptions options)
      : arguments_(arguments), rules_(rules), options_(std::move(options)) {}

  void add(const Document& document, const Building& building, const PipelineResult& result);

  /// From here on buildings are what became of those before; they have a panel of that caption.
  void begin_after(const std::string& before, const std::string& after);
  /// Adds one of them, with the labels that its file has; null: those of `result`.
  void add_after(const Building& building, const PipelineResult& result,
                 const CarriedLabels* carried);

  /// Gives the panels, moved to the origin, with what differs from the first one marked in those
  /// after it. Throws InputError E163 if buildings of one panel are so far apart that nothing would
  /// be seen.
  [[nodiscard]] std::vector<PicturePanel> panels() const;
  /// How many panels there was no room for.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }

 private:
  void add_scales(const Document& document, const Building& building, const PipelineResult& result);

  const PictureArguments& arguments_;
  const RuleBase& rules_;
  LabelOptions options_;
  std::vector<PicturePanel> panels_;
  std::size_t left_out_ = 0;
  bool has_after_ = false;
};

}  // namespace oriel::cli
