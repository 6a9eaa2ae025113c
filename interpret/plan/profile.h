#pragma once

#include "interpret/pack/rule_base.h"
#include "interpret/score/significance.h"
#include "kernel/base/issue.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"
#include "model/plan.h"
#include "model/segmentation.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace oriel {

/// What a level of detail or a map asks for, whatever the rules call things: one level of a file
/// under rules/profiles/ (docs/generalisation.md, "Profiles").
struct Profile {
  /// The building's form: as it is, one flat block, or one for each main part of the roof.
  enum class Form { as_is, block, blocks };

  /// What is a part of the building and not a detail on it, so that it does not go for its size
  /// (plan_by_profile): what has this height and, seen from above, on average this area; a
  /// protrusion that covers the least area of the sizes; all of a building that is smaller than
  /// that area times c; the highest part, if it rises by more than c over the rest.
  struct MainPart {
    double height_m = 0;
    double area_m2 = 0;
  };

  std::string name;    ///< "lod"
  std::string level;   ///< "2.0"
  std::string sha256;  ///< of the file's text
  Form form = Form::as_is;
  /// Of `block` and `blocks`: courtyards and separate pieces with less area go.
  double least_piece_m2 = 0;
  /// Of `block`: shorter edges of the footprint go, where they can; 0: none do.
  double footprint_edge_m = 0;
  /// Classes of the pack; what is of one of them, or under it, always goes, or always stays.
  std::vector<std::string> omit, keep;
  bool omits_imprints = false;  ///< those without label
  /// What reaches the ground goes only if it is of one of these classes; missing: it may go.
  std::optional<std::vector<std::string>> on_ground;
  std::optional<Thresholds> sizes;
  std::optional<MainPart> part;  ///< missing: size alone decides
  /// Instead of `sizes`: the least length on the map.
  std::optional<double> map_mm;
  /// The least length of an edge and a gap that the whole result is to have; missing: that of what
  /// is new only, the thresholds' c.
  std::optional<double> edge_min_m;
  /// Features with an edge below `edge_min_m` go if their middle extent b is below this.
  std::optional<double> edge_owner_b_m;
  /// An STL has a solid for each class of surfaces (WallSurface), not for each label.
  bool names_classes = false;
  /// Verdicts that make a feature go that neither the pack nor the lists above decide of; sheets
  /// are below.
  std::set<Significance> omitted;
  /// What becomes of such sheets: the operator "omit", "flatten" or "enlarge"; missing: they stay.
  std::map<SheetPlace, std::string> sheets;
  /// What an operation must not change by more than that.
  Limits limits;

  /// Buildings that adjoin become one (generalise/city/city_groups.h).
  struct Groups {
    double gap_mm = 0;           ///< on the map; narrower gaps between them are closed
    double like_height_m = 3;    ///< their roofs differ by no more
    double from_scale = 10'000;  ///< at larger scales each stays by itself
    double row_ratio = 0;        ///< of a row of detached buildings this share stays; 0: all do
    double rows_from_scale = 25'000;  ///< at larger scales all do
  };
  std::optional<Groups> groups;  ///< missing: none does

  /// "lod:2.0".
  [[nodiscard]] std::string title() const { return name + ":" + level; }
  /// Map thresholds need a scale; others leave it aside. Nothing if there are neither.
  [[nodiscard]] std::optional<Thresholds> thresholds(std::optional<double> scale) const;
};

/// The profile for another least edge; if it had one, its sizes change in the same ratio.
Profile with_edge_min(Profile profile, double edge_min_m);

/// A level of the profile in `text`, called `file` in places. `level` may be empty if there is only
/// one. Findings have codes: R2xx as in packs, R274 sizes that are no chain, R275 no such level,
/// R272 both sizes and a length on the map, or neither where verdicts need them.
Checked<Profile> load_profile(std::string text, std::string file, const std::string& level);

/// The same of "NAME" or "NAME:LEVEL": of a profile built in, else of the file NAME.
Checked<Profile> load_profile_file(const std::string& name_and_level);

/// The names of the profiles that were built in, sorted.
std::vector<std::string> embedded_profiles();

/// What a profile is used for.
enum class ProfileUse {
  level,   ///< its own level of detail
  scale,   ///< a map at some scale
  series,  ///< maps at several scales, and what leads from one to the next
  tiles    ///< the same, of which a viewer shows several at once
};

/// What of a profile has no effect, which is probably not meant: a warning R273 for each class that
/// it names and the pack does not have, R276 if it asks for blocks at a scale, R277 if it asks for
/// groups of buildings where nobody knows what stands beside them (`has_neighbours`), or not at a
/// scale. An error R278 if it asks for groups in tiles, which show buildings at several scales at
/// once.
std::vector<Issue> check_profile(const Profile& profile, const RuleBase& base, ProfileUse use,
                                 bool has_neighbours = false);

/// Adds to `plan`, which may be empty, what the profile asks for of features without a step there:
/// first its lists of classes, then the verdict of significance, unless it is a part of the
/// building (Profile::MainPart). A recess that reaches the ground and is deep, or has no lintel, is
/// part of the ground plan: it stays where what is on the ground stays. A feature that carries one
/// that is to stay by the profile does not go for its size. Steps are called "NAME:LEVEL/omit" or
/// "NAME:LEVEL/VERDICT", of sheets with their place as verdict. `flatten` of a recess with a label
/// is a step `collapse`, so that its outline stays; `enlarge` grows to c, and what has no label
/// goes instead; what is enclosed and material is merged into its host. `scale` is needed by map
/// profiles.
Plan plan_by_profile(Plan plan, const Profile& profile, const RuleBase& base,
                     const Segmentation& segmentation, const FeatureTable& table,
                     const Interpretation& interpretation, std::optional<double> scale);

}  // namespace oriel
