#pragma once

#include "cli/commands/exhibit.h"
#include "oriel/label.h"
#include "oriel/write.h"

#include <cstddef>
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
  std::vector<std::string> scale_texts;
  /// Those of `--scales`, ascending.
  std::vector<double> scales;
  /// Of `--grid`, columns × rows; none: no limit.
  std::optional<std::size_t> most_panels;
};

/// Reads the format off the ending of a name; none for a page.
std::optional<PictureFormat> picture_format(const std::string& path);

/// Adds the options of pictures to a command, which has `--after`. Returns them.
std::vector<CLI::Option*> add_picture_arguments(CLI::App& command, PictureArguments& arguments);

/// Makes options of the texts. Throws CLI::ValidationError for what is none.
void settle(PictureArguments& arguments);

/// A picture with a panel of all buildings, with `--grid` one of each, with `--scales` one of each
/// at each scale, and with `--after` one more of each file.
class PictureExhibit final : public Exhibit {
 public:
  /// `before` is the caption of the first panel, where there are others after it.
  PictureExhibit(PictureArguments arguments, PictureFormat format, const RuleBase& rules,
                 LabelOptions options, std::string before)
      : arguments_(std::move(arguments)),
        format_(format),
        rules_(rules),
        options_(std::move(options)),
        before_(std::move(before)) {}

  std::vector<Issue> add(const Document& document, const Building& building,
                         const PipelineResult& result) override;
  void begin_after(const std::string& file) override;
  void add_after(const Building& building, const PipelineResult& result,
                 const CarriedLabels* carried) override;
  std::string made() override;

 private:
  [[nodiscard]] LabelledBuilding labelled(const Building& building,
                                          const PipelineResult& result) const;
  std::vector<Issue> add_scales(const Document& document, const Building& building,
                                const PipelineResult& result);

  PictureArguments arguments_;
  PictureFormat format_;
  const RuleBase& rules_;
  LabelOptions options_;
  std::string before_;
  std::vector<PicturePanel> panels_;
  std::size_t left_out_ = 0;
  bool has_after_ = false;
};

}  // namespace oriel::cli
