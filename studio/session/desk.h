#pragma once

#include "studio/session/labels/pack_runner.h"
#include "studio/session/learning/correction_book.h"
#include "studio/session/learning/learning_job.h"
#include "studio/session/learning/sample_store.h"
#include "studio/session/open_buildings.h"
#include "studio/session/pack_file.h"
#include "studio/session/request_body.h"
#include "studio/session/scale_cache.h"
#include "studio/session/session.h"
#include "studio/session/verbs/drawing_progress.h"
#include "studio/session/verbs/newest_wins.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace oriel::studio {

/// All that a session keeps.
struct Desk {
  explicit Desk(SessionOptions session)
      : options(std::move(session)),
        file(options.rules, options.folders),
        corrections(options.corrections),
        buildings(options),
        runner(options, buildings, corrections, file) {}

  const SessionOptions options;
  PackFile file;
  CorrectionBook corrections;
  OpenBuildings buildings;
  PackRunner runner;
  ScaleCache scales;
  DrawingProgress drawing;
  /// Explanations with what would change a label, and drawings for a scale: both may take long.
  NewestWins explanations, drawings;
  SampleStore samples;
  /// The last member: it works with what it was given.
  LearningJob learning;
};

/// A building that a request names, with what the last good pack says of it.
struct AskedBuilding {
  std::size_t number = 0;
  std::shared_ptr<const LabelledBuildings> all;
  std::shared_ptr<const LabelledFeatures> labelled;
};

/// The building in the member "building" of the body. Throws RefusedRequest: 400 there is none of
/// that number, 409 it is not loaded yet or no pack was good.
AskedBuilding asked_building(Desk& desk, const RequestBody& body);

/// The feature in the member "feature", of that building. Throws RefusedRequest 400.
FeatureId asked_feature(const RequestBody& body, const OpenBuilding& building);

/// The verbs: each takes a request and gives its answer, or throws RefusedRequest.
StudioJson answer_state(Desk& desk, const RequestBody& body);
/// Bytes instead of JSON (building_bytes).
std::string geometry_bytes(Desk& desk, const RequestBody& body);
StudioJson answer_features(Desk& desk, const RequestBody& body);
StudioJson answer_surfaces(Desk& desk, const RequestBody& body);
StudioJson answer_explain(Desk& desk, const RequestBody& body);
StudioJson answer_search(Desk& desk, const RequestBody& body);
StudioJson answer_curve(Desk& desk, const RequestBody& body);
StudioJson answer_learn(Desk& desk, const RequestBody& body);
StudioJson answer_ask(Desk& desk, const RequestBody& body);
StudioJson answer_scale(Desk& desk, const RequestBody& body);
StudioJson answer_truth(Desk& desk, const RequestBody& body);
StudioJson answer_correct(Desk& desk, const RequestBody& body);
StudioJson answer_corrections(Desk& desk, const RequestBody& body);

}  // namespace oriel::studio
