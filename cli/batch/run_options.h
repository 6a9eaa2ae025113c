#pragma once

#include "kernel/base/issue.h"
#include "model/building.h"
#include "oriel/label.h"
#include "oriel/neighbours.h"
#include "oriel/read.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace oriel::cli {

/// Which buildings a command works on: those for which all that is asked for holds, or, excluding,
/// the others. The words are cjseq's.
struct Selection {
  /// One of these ids; empty: any.
  std::vector<std::string> ids;
  /// xmin, ymin, xmax, ymax in the input's coordinates, around the middle of the building's box;
  /// empty: anywhere.
  std::vector<double> bbox;
  /// The type of the feature's object (Building, Road, …), of which a BuildingPart is a part;
  /// empty: any.
  std::string cotype;
  /// One in so many, drawn by `seed` and the building's id, so that neither order nor shards
  /// matter; 1: all.
  std::uint64_t one_in = 1;
  std::uint64_t seed = 0;
  bool is_exclusion = false;

  /// Nothing was asked for.
  [[nodiscard]] bool is_all() const;
  /// A building of a feature of this type.
  [[nodiscard]] bool takes(const Building& building, const std::string& type) const;
  /// Of a building of which only the id is known: with `bbox` it fits nowhere.
  [[nodiscard]] bool takes(const std::string& id, const std::string& type) const;
  /// A feature without a building that could be read: only if a type was asked for.
  [[nodiscard]] bool takes_feature(const std::string& id, const std::string& type) const;
  /// A warning E130 for each id that was asked for and is none of `found`, or for a selection that
  /// took nothing (`has_any` is false). Of the ids `seen` that is named which was probably meant.
  [[nodiscard]] std::vector<Issue> unmet(const std::set<std::string>& found, bool has_any,
                                         const std::vector<std::string>& seen = {}) const;

 private:
  [[nodiscard]] bool fits(const std::string& id, const std::string& type) const;
};

/// Options that all commands over buildings share.
struct RunOptions {
  std::vector<std::string> inputs;
  std::string lod;
  std::string from;
  std::string order = "natural";
  Tolerances tolerances;
  /// --plane-offset was given: it holds as it is, also for noisy buildings.
  bool is_plane_offset_given = false;
  std::string close = to_string(RepairOptions{}.close);
  double cap_area_m2 = RepairOptions{}.cap_area_m2;
  std::string crossings = "leave";
  std::int64_t budget = SegmentOptions{}.budget;
  /// What the input calls its polygons is not looked at.
  bool ignores_semantics = false;
  bool is_verbose = false;
  /// The command has --force; and it was given: -o may replace an input.
  bool offers_force = false;
  bool is_forced = false;
  std::string timings_file;
  int repeat = 1;
  /// Records that are worked on at the same time; results do not depend on it.
  int jobs = 1;
  /// Buildings are worked on in forked processes.
  bool is_isolated = false;
  /// By the clock, for one building in such a process; 0: as long as it takes.
  double most_seconds = 0;
  Selection selection;
  /// Where STEM.status.json and STEM.quarantine.jsonl go; empty: nowhere.
  std::string status_stem;
  /// bar, json, none; empty: a bar on a terminal.
  std::string progress;
  /// STEM.status.json of an earlier run, from which results are taken; empty: of none.
  std::string reuse;
  /// The command goes on where it was killed.
  bool is_resumable = false;
  /// So much may be set aside and all is well: a number of buildings, or a share of them.
  std::string allowed_bad = "0";
  /// Nothing to work on, and ids that are not there, are reported (E130, E134).
  bool reports_emptiness = true;
  /// Features are what the command is about: of buildings without any it says so (E134).
  bool seeks_features = false;
  /// ... and they are all that it gives: without any, nothing was done.
  bool gives_only_features = false;
  /// ReadOptions::joins_installations.
  bool joins_installations = false;
  /// Only what was read is asked for: buildings do not pass the pipeline.
  bool ends_at_reading = false;
  /// Only the solid is asked for: buildings are not segmented.
  bool ends_at_solid = false;
  /// What is asked of surfaces is what they are, and of features their labels: attributes are
  /// measured as far as rules read them.
  bool only_names_surfaces = false;
  bool only_labels_features = false;
  /// What people say against the rules (--corrections); null: nothing.
  std::shared_ptr<const Corrections> corrections;
  /// --neighbours, as often as it was given: a file to look at, or kInputsOnly.
  std::vector<std::string> neighbours_of;
  /// What was found there; null: nothing was asked for.
  std::shared_ptr<const NeighbourSearch> neighbours;
  /// --keep-free, as often as it was given: files of roads and parcels.
  std::vector<std::string> keep_free;
  /// What they have; null: nothing was asked for.
  std::shared_ptr<const KeptGround> kept;

  [[nodiscard]] ReadOptions read_options() const;
  /// The same for one of the inputs: stdin is a CityJSONSeq unless --from says more.
  [[nodiscard]] ReadOptions read_options(const std::string& input) const;
  /// The one input is a stream on stdin; what comes of it goes to stdout if nothing else is said.
  [[nodiscard]] bool is_piped_stream() const;
  /// What the library does with a building, without outputs; `observer` gets the time of each
  /// stage.
  [[nodiscard]] LabelOptions label_options(StageObserver observer = {}) const;
  /// All that a result depends on besides input and rules, as one text: what oriel_config_sha256 is
  /// made of.
  [[nodiscard]] std::string configuration() const;
  /// True if no more of `buildings` was set aside than --allow-bad says.
  [[nodiscard]] bool allows(int set_aside, int buildings) const;
};

/// A warning E134: there is `what` ("no building") in the inputs.
Issue nothing_to_work_on(const std::vector<std::string>& inputs, const std::string& what);

/// A warning E131 of a comparison that had nothing to compare.
Issue nothing_compared(std::string sentence);

/// A warning E134: none of so many buildings has a feature.
Issue no_feature_found(const std::vector<std::string>& inputs, int buildings);

}  // namespace oriel::cli
