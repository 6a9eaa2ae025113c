#include "oriel/pipeline/pipeline.h"

#include "interpret/labelling/interpret.h"
#include "kernel/base/index.h"
#include "kernel/base/own_fault.h"
#include "kernel/base/text/counted.h"
#include "kernel/segment/flush/imprints.h"
#include "kernel/segment/rings/ring_features.h"
#include "kernel/solidify/noise.h"
#include "kernel/solidify/open_shell.h"
#include "kernel/solidify/solidify.h"
#include "kernel/solidify/supposed_solid.h"
#include "model/canonical_order.h"
#include "oriel/corrections.h"
#include "oriel/pipeline/outlook.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <span>

#include <fmt/format.h>

namespace oriel {

namespace {

void append(std::vector<Issue>& all, std::vector<Issue> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// What stood for an error is a warning now, and says how it goes on.
void continue_with(const char* what, std::vector<Issue>& issues) {
  for (Issue& issue : issues) {
    if (issue.severity != Severity::error) continue;
    issue.severity = Severity::warning;
    issue.sentence += what;
  }
}

Issue supposed_faces(const Building& building, std::span<const Cap> faces) {
  double sum = 0, largest = 0;
  for (const Cap& face : faces) {
    sum += face.area_m2;
    largest = std::max(largest, face.area_m2);
  }
  return building_issue(Severity::warning, Code::E319, building.id,
                        fmt::format("{} assumed, {:.2f} m² together, the largest {:.2f} m²: "
                                    "features are found as if {} there",
                                    counted(faces.size(), "missing face was", "missing faces were"),
                                    sum, largest, agreeing(faces.size(), "it were", "they were")));
}

/// What came of a building that solidify found open, to go on with: with the solid that it would be
/// if the faces that are missing were there, if holes may be closed at all, else with the facets
/// that there are. With a supposed solid the last issue is what is to be said of its features.
PipelineResult opened(const Building& building, const LabelOptions& options, PipelineResult out) {
  const auto is_geometry = [](const Issue& issue) {
    return issue.severity != Severity::error || is_about_geometry(issue.code);
  };
  if (!std::ranges::all_of(out.issues, is_geometry)) return out;
  auto supposed = options.repair.close == Closing::none
                      ? std::nullopt
                      : supposed_solid(building, out.tolerances, options.budget);
  if (supposed) {
    continue_with("; missing faces are assumed", out.issues);
    append(out.issues, std::move(supposed->issues));
    out.issues.push_back(supposed_faces(building, supposed->faces));
    out.solid = std::move(supposed->solid);
    out.body = BodyKind::supposed_solid;
  } else if ((out.solid = open_shell(building, out.tolerances))) {
    continue_with("; features are taken from its rings, nothing is cut", out.issues);
    out.body = BodyKind::open_shell;
  }
  return out;
}

/// The building without what its input calls the polygons.
Building without_hints(Building building) {
  for (Polygon& polygon : building.polygons) polygon.hint.clear();
  return building;
}

Issue noise_note(const Building& building, const Tolerances& fitted) {
  return building_issue(
      Severity::note, Code::E126, building.id,
      fmt::format("corners lie up to {:.1f} mm off the planes of nine in ten polygons: points "
                  "within {:.1f} mm of a plane count as on it (--plane-offset)",
                  1e3 * noise_of(building), 1e3 * fitted.plane_offset_m));
}

/// Only what the rules read, where nothing else was asked for.
DescribeOptions describe_options(const RuleBase* rules, const LabelOptions& options) {
  if (rules == nullptr || options.measures_features) return {{}, {}, options.budget};
  return {rules->attributes_read(), rules->relations_read(), options.budget};
}

/// By Polygon::source whether a facet of the solid has the polygon, or a part of it.
std::vector<bool> polygons_in(const Solid& solid, const Building& building) {
  std::vector<bool> is_in(building.polygons.size());
  for (const Facet& facet : solid.facets)
    for (const int polygon : facet.polygons) is_in.at(static_cast<std::size_t>(polygon)) = true;
  return is_in;
}

/// The building without the faces in which installations touch it: they are within the solid, and
/// no openings of what they lie on.
Building without_contacts(Building building, const PipelineResult& result) {
  const std::vector<bool> is_in = polygons_in(*result.solid, building);
  const auto first = static_cast<int>(building.installations.front().first_polygon);
  std::erase_if(building.polygons, [&](const Polygon& polygon) {
    return polygon.source >= first && !is_in[static_cast<std::size_t>(polygon.source)] &&
           std::ranges::binary_search(result.repair.inner, polygon.source);
  });
  return building;
}

Segmentation all_features(const Building& building, const PipelineResult& result,
                          const SegmentOptions& options) {
  const Solid& solid = *result.solid;
  Segmentation found = result.is_solid() ? segment(building, solid, options) : segment_open(solid);
  add_ring_features(building, solid, found, options.tolerances, options.budget);
  if (building.installations.empty())
    add_imprints(building, solid, found, options.tolerances, options.budget);
  else
    add_imprints(without_contacts(building, result), solid, found, options.tolerances,
                 options.budget);
  return found;
}

Issue left_out_note(const Building& building) {
  const std::size_t count = building.installations.size();
  return building_issue(
      Severity::note, Code::E320, building.id,
      fmt::format("does not form a closed solid together with {} that {} on it; its solid is made "
                  "without {}",
                  count == 1 ? "the installation" : "the " + counted(count, "installation"),
                  agreeing(count, "stands", "stand"), agreeing(count, "it", "them")));
}

int count_lumps(const Solid& solid) {
  int count = 0;
  for (const Shell& shell : solid.shells) count = std::max(count, shell.lump + 1);
  return count;
}

/// True if the solid is in one, and some facet is of an installation's polygons, for each of them.
bool has_all_in_one(const Building& building, const Solid& solid) {
  const std::vector<bool> is_used = polygons_in(solid, building);
  for (std::size_t i = 0; i < building.installations.size(); ++i) {
    const bool is_last = i + 1 == building.installations.size();
    const auto first = static_cast<std::ptrdiff_t>(building.installations[i].first_polygon);
    const auto end = is_last
                         ? std::ssize(is_used)
                         : static_cast<std::ptrdiff_t>(building.installations[i + 1].first_polygon);
    if (std::find(is_used.begin() + first, is_used.begin() + end, true) == is_used.begin() + end)
      return false;
  }
  return count_lumps(solid) == 1;
}

/// The solid of a building united with what stands on it, or if they make none that of the building
/// alone.
Solidified solid_with_installations(const Building& building, const Tolerances& tolerances,
                                    const RepairOptions& repair, Work& work) {
  Solidified whole = solidify(building, tolerances, repair, work);
  if (building.installations.empty()) return whole;
  if (whole.value && has_all_in_one(building, *whole.value)) return whole;
  // Closed bodies that touch it or stand in it are lumps beside it unless they are cut.
  RepairOptions cutting = repair;
  cutting.crossings = Crossings::cut_closed;
  Solidified united = solidify(building, tolerances, cutting, work);
  if (united.value && (!whole.value || count_lumps(*united.value) < count_lumps(*whole.value)))
    return united;
  if (whole.value) return whole;
  Solidified alone = solidify(without_installations(building), tolerances, repair, work);
  if (!alone.value) return whole;
  alone.issues.push_back(left_out_note(building));
  return alone;
}

/// A hole of less is no window that stands open but a gap of the model.
constexpr double kLeastOpening_m2 = 0.1;

/// What was closed is no feature any more: E316 says of how many holes that may matter.
void warn_of_closed_openings(const std::vector<Cap>& caps, std::vector<Issue>& issues) {
  const auto count = std::ranges::count_if(caps, [](const Cap& cap) {
    return cap.kind == CapKind::hole && cap.area_m2 >= kLeastOpening_m2;
  });
  if (count == 0) return;
  for (Issue& issue : issues)
    if (issue.code == Code::E316)
      issue.sentence += fmt::format(
          "; {} may be {}, which cannot be found once closed (--close none keeps holes open)",
          count == std::ssize(caps) ? std::string(agreeing(count, "it", "they"))
                                    : fmt::format("{} of them", count),
          agreeing(count, "an open window or door", "open windows or doors"));
}

/// With labels of the features: what the rules say, and what people say.
Checked<FoundFeatures> named(const Building& building, const RuleBase& rules,
                             const LabelOptions& options, Checked<FoundFeatures> found) {
  try {
    auto& [segmentation, description, interpretation, corrections] = found.value.value();
    interpretation = measured(
        options.observer, Stage::interpret, "interpreted", building,
        [&] { return interpret(rules, description.table, description.graph); },
        [](const Interpretation& made) {
          const auto unknown = std::ranges::count_if(made.verdicts, &Name::empty, &Verdict::label);
          return fmt::format("labelled={}", std::ssize(made.verdicts) - unknown);
        });
    append(found.issues, interpretation.issues);
    if (!options.corrections) return found;
    const auto features = placed_features(building, *segmentation, description.table);
    const auto corrected = options.corrections->find(building.id, features, found.issues);
    for (const auto& [feature, correction] : corrected)
      corrections.push_back({interpretation.verdicts.at(feature), correction->by, correction->why,
                             correction->place});
    correct(corrected, interpretation);
  } catch (const std::exception& fault) {
    found.value.reset();
    found.issues.push_back(own_fault(building, fault));
  }
  return found;
}

/// What the stages between the solid and the surfaces find.
Checked<FoundFeatures> find_features(const Building& building, const RuleBase* rules,
                                     const LabelOptions& options, const PipelineResult& so_far) {
  Checked<FoundFeatures> found{FoundFeatures{}, so_far.issues};
  try {
    Segmentation& segmentation = found.value->segmentation.emplace(measured(
        options.observer, Stage::segment, "segmented", building,
        [&] { return all_features(building, so_far, segment_options(options, so_far.tolerances)); },
        [](const Segmentation& made) { return fmt::format("features={}", made.features.size()); }));
    append(found.issues, segmentation.issues);
    if (so_far.body == BodyKind::supposed_solid)
      segmentation.issues.insert(segmentation.issues.begin(), so_far.issues.back());
    Description& description = found.value->description = measured(
        options.observer, Stage::describe, "described", building,
        [&] { return describe(building, segmentation, describe_options(rules, options)); },
        [](const Description& made) { return fmt::format("features={}", made.table.rows()); });
    append(found.issues, description.issues);
    describe_outlook_of_features(segmentation, options, so_far.surroundings, description.table);
  } catch (const std::exception& fault) {
    found.value.reset();
    found.issues.push_back(own_fault(building, fault));
  }
  if (rules == nullptr || !found.value) return found;
  return named(building, *rules, options, std::move(found));
}

PipelineResult with(Checked<FoundFeatures> found, PipelineResult out) {
  static_cast<FoundFeatures&>(out) = std::move(found.value).value_or(FoundFeatures{});
  out.issues = std::move(found.issues);
  return out;
}

/// With all that comes before the surfaces.
PipelineResult with_features(const Building& building, const RuleBase* rules,
                             const LabelOptions& options, PipelineResult out) {
  try {
    warn_of_closed_openings(out.repair.caps, out.issues);
    if (!out.solid)
      out = measure(options.observer, Stage::solidify,
                    [&] { return opened(building, options, out); });
    if (!out.solid) return out;
  } catch (const std::exception& fault) {
    out.issues.push_back(own_fault(building, fault));
    return out;
  }
  auto found = find_features(building, rules, options, out);
  return with(std::move(found), std::move(out));
}

/// Gives the polygons that a result names other numbers.
PipelineResult renumbered(const std::vector<int>& number_of, PipelineResult out) {
  const auto number = [&](int polygon) { return polygon < 0 ? polygon : number_of[at(polygon)]; };
  const auto renumber = [&](std::vector<int>& polygons) {
    std::ranges::transform(polygons, polygons.begin(), number);
    std::ranges::sort(polygons);
  };
  for (auto* polygons : {&out.repair.duplicates, &out.repair.dangling, &out.repair.inner})
    renumber(*polygons);
  for (OpenEdge& edge : out.repair.open_edges) edge.polygon = number(edge.polygon);
  if (out.solid)
    for (Facet& facet : out.solid->facets) renumber(facet.polygons);
  if (!out.segmentation) return out;
  for (Cell& cell : out.segmentation->cells)
    for (Facet& facet : cell.facets) renumber(facet.polygons);
  for (Feature& feature : out.segmentation->features) renumber(feature.source_polygons);
  return out;
}

PipelineResult with_surfaces(const Building& building, const RuleBase& rules,
                             const LabelOptions& options, PipelineResult out) {
  try {
    static_cast<FoundSurfaces&>(out) = options.measures_surfaces
                                           ? describe_all_surfaces(building, options, out)
                                           : name_surfaces(building, rules, options, out);
  } catch (const std::exception& fault) {
    out.segmentation.reset();  // nothing is drawn or counted of it
    out.issues.push_back(own_fault(building, fault));
  }
  return out;
}

PipelineResult make_solid(const CanonicalOrder& order, const Tolerances& tolerances,
                          const RepairOptions& repair, Work& work, const StageObserver& observer) {
  PipelineResult out;
  try {
    auto solid = measured(
        observer, Stage::solidify, "solidified", order.building,
        [&] { return solid_with_installations(order.building, tolerances, repair, work); },
        [](const auto& made) {
          return fmt::format("facets={} issues={}", made.value ? made.value->facets.size() : 0,
                             made.issues.size());
        });
    out.issues = std::move(solid.issues);
    out.repair = std::move(solid.report);
    out.solid = std::move(solid.value);
    out = renumbered(order.to_reading, std::move(out));
  } catch (const std::exception& fault) {
    out.issues.push_back(own_fault(order.building, fault));
  }
  return out;
}

PipelineResult go_on(PipelineResult out, const Building& building, const CanonicalOrder& order,
                     const RuleBase* rules, const Tolerances& tolerances,
                     const LabelOptions& options) {
  out.tolerances = tolerances;
  if (options.neighbours) {
    out.surroundings = options.neighbours->of(building);
    append(out.issues, out.surroundings->issues);
  }
  if (std::ranges::none_of(out.issues, is_own_fault)) {
    out = renumbered(order.from_reading, std::move(out));
    out = options.ignores_semantics
              ? with_features(without_hints(order.building), rules, options, std::move(out))
              : with_features(order.building, rules, options, std::move(out));
    out = renumbered(order.to_reading, std::move(out));
  }
  if (rules == nullptr) return out;
  return with_surfaces(building, *rules, options, std::move(out));
}

}  // namespace

/// A scratch file that fails is none, and ends the run.
Issue own_fault(const Building& building, const std::exception& fault) {
  if (dynamic_cast<const OutputError*>(&fault) != nullptr) throw;
  Issue issue = own_fault(fault);
  issue.place.building = building.id;
  return issue;
}

std::optional<Issue> no_body(const Building& building, const PipelineOptions& options) {
  if (!options.lod.empty() || !has_only_outline(building)) return std::nullopt;
  return building_issue(
      Severity::error, Code::E205, building.id,
      fmt::format("has no geometry above lod {}, which is an outline on the ground or of the roof; "
                  "expected lod 1 or higher",
                  building.lod));
}

bool has_only_outline(const Building& building) { return building.lod.starts_with('0'); }

PipelineResult run_to_solid(const Building& building, const Tolerances& tolerances,
                            const RepairOptions& repair, Work& work,
                            const StageObserver& observer) {
  return make_solid(CanonicalOrder(building), tolerances, repair, work, observer);
}

PipelineResult run_from_solid(PipelineResult out, const Building& building, const RuleBase* rules,
                              const Tolerances& tolerances, const LabelOptions& options) {
  return go_on(std::move(out), building, CanonicalOrder(building), rules, tolerances, options);
}

PipelineResult name_segmented(const Building& building, PipelineResult segmented,
                              const RuleBase& rules, const LabelOptions& options) {
  if (segmented.is_done()) {
    Checked<FoundFeatures> found{std::move(static_cast<FoundFeatures&>(segmented)),
                                 segmented.issues};
    found = named(building, rules, options, std::move(found));
    segmented = with(std::move(found), std::move(segmented));
  }
  return with_surfaces(building, rules, options, std::move(segmented));
}

PipelineResult run_pipeline(const Building& building, const RuleBase* rules,
                            const LabelOptions& options) {
  const Tolerances& given = options.tolerances;
  if (auto issue = no_body(building, options)) {
    PipelineResult without;
    without.issues.push_back(std::move(*issue));
    return run_from_solid(std::move(without), building, rules, given, options);
  }
  const CanonicalOrder order(building);
  const Tolerances fitted =
      options.fits_noise ? fitted_to_noise(given, noise_of(order.building)) : given;
  Work work(options.budget);
  PipelineResult result = go_on(make_solid(order, fitted, options.repair, work, options.observer),
                                building, order, rules, fitted, options);
  if (fitted.plane_offset_m != given.plane_offset_m)
    result.issues.push_back(noise_note(order.building, fitted));
  return result;
}

}  // namespace oriel
