#include "cli/batch/run_options.h"

#include <utility>

namespace oriel::cli {

ReadOptions RunOptions::read_options() const {
  ReadOptions options;
  if (!lod.empty()) options.lod = lod;
  if (!from.empty()) options.format = parse_format(from);
  return options;
}

ReadOptions RunOptions::read_options(const std::string& input) const {
  ReadOptions options = read_options();
  if (!options.format && input == "-") options.format = kFormatOfStdin;
  return options;
}

bool RunOptions::is_piped_stream() const {
  return inputs.size() == 1 && inputs[0] == "-" && read_options("-").format == Format::cityjson_seq;
}

LabelOptions RunOptions::label_options(StageObserver observer) const {
  LabelOptions options;
  options.tolerances = tolerances;
  options.fits_noise = !is_plane_offset_given;
  options.repair = {*parse_closing(close), cap_area_m2,
                    crossings == "cut" ? Crossings::cut : Crossings::leave};
  options.order = order == "paper" ? Order::paper : Order::natural;
  options.budget = budget;
  options.ignores_semantics = ignores_semantics;
  options.lod = lod;
  options.observer = std::move(observer);
  options.measures_surfaces = !only_names_surfaces;
  options.measures_features = !only_labels_features;
  options.has_output = false;
  return options;
}

std::string RunOptions::configuration() const { return oriel::configuration(label_options()); }

bool RunOptions::allows(int set_aside, int buildings) const {
  const double number = std::stod(allowed_bad);
  if (allowed_bad.ends_with('%')) return set_aside * 100.0 <= number * buildings;
  return set_aside <= number;
}

}  // namespace oriel::cli
