#include "studio/session/open_buildings.h"

#include "oriel/segment.h"
#include "studio/session/work_log.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

Issue issue_of_file(const std::string& file, const std::string& sentence) {
  Issue issue;
  issue.code = Code::E123;
  issue.sentence = sentence;
  issue.place.file = file;
  return issue;
}

/// Segments a building, or says why it was passed over.
PipelineResult segment_or_pass(const Building& building, const PipelineOptions& options,
                               WorkLog* log, std::size_t number) {
  const std::string reason =
      log == nullptr ? "" : log->why_passed_over(WorkLog::Kind::building, number);
  if (reason.empty()) {
    const AtWork at_work(log, WorkLog::Kind::building, number);
    return segment(building, options);
  }
  PipelineResult passed_over;
  passed_over.is_passed_over = true;
  passed_over.issues.push_back(
      building_issue(Severity::error, Code::E123, building.id, "passed over: " + reason));
  return passed_over;
}

}  // namespace

void place_features(OpenBuilding& open) {
  static const Segmentation none;
  PipelineResult& result = open.segmented;
  if (result.is_done()) {
    open.owners = polygon_owners(*result.segmentation, *open.building);
    open.features = placed_features(*open.building, *result.segmentation, result.description.table);
  } else {
    open.owners = polygon_owners(none, *open.building);
    result.description = {};
  }
}

OpenBuildings::OpenBuildings(const SessionOptions& options)
    : options_(options), files_left_(options.files.size()), thread_([this] { run(); }) {}

OpenBuildings::~OpenBuildings() {
  is_ending_ = true;
  thread_.join();
}

BuildingList OpenBuildings::list() const {
  const std::lock_guard lock(mutex_);
  return buildings_;
}

std::vector<BuildingOfFile> OpenBuildings::read() const {
  const std::lock_guard lock(mutex_);
  return read_;
}

LoadingState OpenBuildings::loading() const {
  const std::lock_guard lock(mutex_);
  return {done_, buildings_.size() + files_left_};
}

std::vector<Issue> OpenBuildings::issues() const {
  const std::lock_guard lock(mutex_);
  return issues_;
}

bool OpenBuildings::has_truth() const {
  const std::lock_guard lock(mutex_);
  return !truth_.empty();
}

Vec3 OpenBuildings::origin_m() const {
  const std::lock_guard lock(mutex_);
  if (!origin_m_ && !read_.empty()) {
    origin_m_ = read_.front().building->frame.origin_m;
    for (const BuildingOfFile& read : read_) {
      const Vec3& corner = read.building->frame.origin_m;
      origin_m_->x = std::min(origin_m_->x, corner.x);
      origin_m_->y = std::min(origin_m_->y, corner.y);
      origin_m_->z = std::min(origin_m_->z, corner.z);
    }
  }
  return origin_m_.value_or(Vec3{});
}

void OpenBuildings::add_issues(const std::vector<Issue>& issues) {
  const std::lock_guard lock(mutex_);
  issues_.insert(issues_.end(), issues.begin(), issues.end());
}

void OpenBuildings::run() {
  read_truth_files();
  for (std::size_t i = 0; i < options_.files.size() && !is_ending_; ++i) read_file(i);
  std::size_t count = 0;
  {
    const std::lock_guard lock(mutex_);
    count = read_.size();
  }
  options_.for_each(count, [this](std::size_t number) {
    if (!is_ending_) segment_building(number);
  });
}

void OpenBuildings::read_truth_files() {
  LabelsAndTruth all;
  for (const std::string& path : options_.truth) {
    try {
      auto read = read_truths(path);
      add_issues(read.issues);
      if (!read.value) continue;
      const std::lock_guard lock(mutex_);
      for (const GroundTruth& truth : *read.value) {
        truth_[truth.building];
        add(truth, all);
      }
    } catch (const InputError& fault) {
      add_issues({fault.issue()});
    }
  }
  const std::lock_guard lock(mutex_);
  for (ExpectedObject& object : all.truth) truth_[object.building].push_back(std::move(object));
}

void OpenBuildings::read_file(std::size_t number) {
  const std::string& path = options_.files[number];
  WorkLog* log = options_.work_log;
  const std::string reason =
      log == nullptr ? "" : log->why_passed_over(WorkLog::Kind::file, number);
  std::vector<BuildingOfFile> read;
  std::vector<Issue> issues;
  try {
    if (!reason.empty()) {
      issues.push_back(issue_of_file(path, "passed over: " + reason));
    } else {
      const AtWork at_work(log, WorkLog::Kind::file, number);
      Reader reader(path, options_.read);
      while (auto record = reader.next()) {
        if (is_ending_) break;
        issues.insert(issues.end(), record->issues.begin(), record->issues.end());
        if (!record->value) continue;
        const auto document = std::make_shared<const Document>(std::move(*record->value));
        for (const Building& building : document->buildings)
          read.push_back({path, document, &building});
      }
    }
  } catch (const InputError& fault) {
    issues.push_back(fault.issue());
  }
  add_issues(issues);
  const std::lock_guard lock(mutex_);
  --files_left_;
  read_.insert(read_.end(), read.begin(), read.end());
  buildings_.resize(read_.size());
}

void OpenBuildings::segment_building(std::size_t number) {
  auto open = std::make_shared<OpenBuilding>();
  {
    const std::lock_guard lock(mutex_);
    const BuildingOfFile& read = read_[number];
    static_cast<BuildingOfFile&>(*open) = read;
    const auto truth = truth_.find(read.building->id);
    if (truth != truth_.end()) open->truth = truth->second;
  }
  open->segmented = segment_or_pass(*open->building, options_.label, options_.work_log, number);
  place_features(*open);
  const std::lock_guard lock(mutex_);
  buildings_[number] = std::move(open);
  ++done_;
}

}  // namespace oriel::studio
