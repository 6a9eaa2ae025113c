#include "studio/session/open_buildings.h"

#include "io/tiles/earth.h"
#include "oriel/segment.h"
#include "studio/session/request_body.h"
#include "studio/session/saved_file.h"
#include "studio/session/work_log.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
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
    : options_(options), files_left_(options.files.size()), thread_([this] { run(); }) {
  const auto is_there = [&](const auto& sample) {
    return read_text_file(sample_path(sample.first)).has_value();
  };
  if (offers_samples() && std::ranges::all_of(options_.samples, is_there)) open_samples();
}

OpenBuildings::~OpenBuildings() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  has_files_.notify_all();
  thread_.join();
}

std::string OpenBuildings::sample_path(const std::string& name) const {
  return options_.samples_folder + "/" + name;
}

bool OpenBuildings::offers_samples() const {
  const std::lock_guard lock(mutex_);
  return options_.files.empty() && !options_.samples.empty();
}

void OpenBuildings::open_samples() {
  if (!offers_samples()) throw RefusedRequest(409, "buildings are open already");
  std::error_code problem;
  std::filesystem::create_directories(options_.samples_folder, problem);
  std::vector<std::string> files, truth;
  for (const auto& [name, text] : options_.samples) {
    const std::string path = sample_path(name);
    save_file(path, [&](const auto& on_disk) { return on_disk.value_or(std::string(text)); });
    if (name.ends_with(".truth.json")) truth.push_back(path);
    if (name.ends_with(".city.json")) files.push_back(path);
  }
  {
    const std::lock_guard lock(mutex_);
    // Another request may have been quicker; the thread reads the list from then on.
    if (!options_.files.empty()) throw RefusedRequest(409, "buildings are open already");
    options_.files = std::move(files);
    options_.truth = std::move(truth);
    files_left_ = options_.files.size();
  }
  has_files_.notify_all();
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

std::shared_ptr<const std::vector<Standing>> OpenBuildings::standings() const {
  const std::lock_guard lock(mutex_);
  if (!standings_ || standings_->size() != standees_.size())
    standings_ = std::make_shared<const std::vector<Standing>>(studio::standings(standees_));
  return standings_;
}

void OpenBuildings::add_issues(const std::vector<Issue>& issues) {
  const std::lock_guard lock(mutex_);
  issues_.insert(issues_.end(), issues.begin(), issues.end());
}

void OpenBuildings::run() {
  {
    std::unique_lock lock(mutex_);
    has_files_.wait(lock, [this] { return is_ending_ || !options_.files.empty(); });
  }
  read_truth_files();
  for (std::size_t i = 0; i < options_.files.size() && !is_ending_; ++i) {
    if (corners_ <= options_.most_corners) {
      read_file(i);
      continue;
    }
    const std::lock_guard lock(mutex_);
    issues_.push_back(issue_of_file(
        options_.files[i],
        fmt::format("passed over, as are all after it ({} of {} files): the studio keeps no more "
                    "than {} buildings of this size; open fewer at a time",
                    options_.files.size() - i, options_.files.size(), read_.size())));
    files_left_ = 0;
    break;
  }
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
        if (corners_ > options_.most_corners) {
          issues.push_back(issue_of_file(path,
                                         "its further buildings are passed over: the studio "
                                         "keeps no more; open fewer at a time"));
          break;
        }
        issues.insert(issues.end(), record->issues.begin(), record->issues.end());
        if (!record->value) continue;
        const auto document = std::make_shared<const Document>(std::move(*record->value));
        for (const Building& building : document->buildings) {
          read.push_back({path, document, &building});
          for (const Polygon& polygon : building.polygons)
            for (const auto& ring : polygon.rings) corners_ += ring.size();
        }
      }
    }
  } catch (const InputError& fault) {
    issues.push_back(fault.issue());
  }
  add_issues(issues);
  std::vector<Standee> standees;
  for (const BuildingOfFile& each : read)
    standees.push_back({path, box_of(*each.building), each.building->frame.origin_m,
                        short_name_of_crs(each.building->frame.crs)});
  const std::lock_guard lock(mutex_);
  --files_left_;
  read_.insert(read_.end(), read.begin(), read.end());
  standees_.insert(standees_.end(), standees.begin(), standees.end());
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
