#pragma once

#include "io/document.h"
#include "model/building.h"
#include "model/polygon_owners.h"
#include "oriel/corrections.h"
#include "oriel/result.h"
#include "oriel/score.h"
#include "studio/session/session.h"
#include "studio/session/standing.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace oriel::studio {

/// A building that was read.
struct BuildingOfFile {
  std::string file;
  /// The record that it is of.
  std::shared_ptr<const Document> document;
  /// One of the document's.
  const Building* building = nullptr;
};

/// A building that was read and segmented; it never changes.
struct OpenBuilding : BuildingOfFile {
  /// What segment() said of it, without rules.
  PipelineResult segmented;
  /// By Polygon::source.
  PolygonOwners owners;
  /// Ids and boxes of its features.
  std::vector<PlacedFeature> features;
  /// Of the files of truth; nothing: they do not speak of it.
  std::optional<std::vector<ExpectedObject>> truth;
};

/// Fills `owners` and `features`, from `segmented`.
void place_features(OpenBuilding& open);

/// The buildings by their number; null while one is not segmented yet.
using BuildingList = std::vector<std::shared_ptr<const OpenBuilding>>;

/// How far loading is.
struct LoadingState {
  std::size_t done = 0;
  std::size_t all = 0;
  [[nodiscard]] bool is_done() const { return done == all; }
};

/// Reads and segments the files of a session in the background: first all files are read, which
/// numbers the buildings, then the buildings are segmented. Functions may be called from any
/// thread.
class OpenBuildings {
 public:
  explicit OpenBuildings(const SessionOptions& options);
  /// Writes the samples that the options have, where there are none in their folder, and opens
  /// them. Throws RefusedRequest: 409 there are buildings, else as save_file() does.
  void open_samples();
  /// True as long as there are no files, but samples.
  [[nodiscard]] bool offers_samples() const;
  /// Waits for the building at work only.
  ~OpenBuildings();
  OpenBuildings(const OpenBuildings&) = delete;
  OpenBuildings& operator=(const OpenBuildings&) = delete;

  [[nodiscard]] BuildingList list() const;
  /// Those that were read, by number; the list above is as long.
  [[nodiscard]] std::vector<BuildingOfFile> read() const;
  [[nodiscard]] LoadingState loading() const;
  /// What is wrong with the files and their truth as a whole, so far.
  [[nodiscard]] std::vector<Issue> issues() const;
  /// True if files of truth were given that could be read.
  [[nodiscard]] bool has_truth() const;
  /// Where those stand that were read by then, by number; the same for ever once all are read,
  /// which is before one is segmented.
  [[nodiscard]] std::shared_ptr<const std::vector<Standing>> standings() const;

 private:
  void run();
  void read_truth_files();
  void read_file(std::size_t number);
  void segment_building(std::size_t number);
  [[nodiscard]] std::string sample_path(const std::string& name) const;
  void add_issues(const std::vector<Issue>& issues);

  /// Its files and truth are those of the samples once these are asked for.
  SessionOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable has_files_;
  std::vector<BuildingOfFile> read_;
  BuildingList buildings_;
  std::size_t files_left_ = 0;
  std::size_t done_ = 0;
  std::vector<Issue> issues_;
  /// Of what is read; only the thread asks for it.
  std::size_t corners_ = 0;
  std::map<std::string, std::vector<ExpectedObject>> truth_;
  std::vector<Standee> standees_;
  mutable std::shared_ptr<const std::vector<Standing>> standings_;
  std::atomic<bool> is_ending_ = false;
  /// The last member: it works with all of them.
  std::thread thread_;
};

}  // namespace oriel::studio
