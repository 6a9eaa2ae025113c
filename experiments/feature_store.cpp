#include "experiments/feature_store.h"

#include "experiments/perturb.h"
#include "io/files/input.h"
#include "io/files/output_file.h"
#include "io/reader.h"
#include "io/records/feature_records.h"
#include "kernel/base/own_fault.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/counted.h"
#include "oriel/segment.h"
#include "oriel/stored_samples.h"
#include "oriel/write.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {

namespace {

namespace fs = std::filesystem;
using KeptJson = nlohmann::ordered_json;

/// So many buildings are held in memory while they are segmented.
constexpr std::size_t kShareOfBuildings = 256;
constexpr const char* kRecordsEnd = ".csv";
constexpr const char* kBuildingsEnd = ".json";

/// A file whose features are being made.
struct FileAtWork {
  explicit FileAtWork(const std::string& stem) : writer(stem + kRecordsEnd) {}
  FeatureRecordWriter writer;
  KeptJson buildings = KeptJson::array();
};

/// A building that waits for its turn, and what came of it.
struct BuildingAtWork {
  FileAtWork* file = nullptr;
  Building building;
  std::string records;
  /// Why it has no features.
  std::optional<Issue> fault;
};

void put_boxes(std::vector<FeatureRecord>& records, const std::vector<Box>& boxes) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto& [low, high] = boxes[i];
    records[i].aabb_m = {low.x, low.y, low.z, high.x, high.y, high.z};
  }
}

/// Segments the building as the recipe says.
void make_features(BuildingAtWork& work, const FeatureRecipe& recipe) {
  std::optional<Perturbed> changed;
  if (recipe.perturbation) changed = perturbed(work.building, *recipe.perturbation);
  const PipelineResult result =
      segment(changed ? changed->building : work.building, recipe.options, recipe.neighbours);
  if (!result.is_done()) {
    const auto why = std::ranges::find(result.issues, Severity::error, &Issue::severity);
    work.fault = why == result.issues.end() ? Issue() : *why;
    return;
  }
  auto records = feature_records(work.building, result);
  if (changed) put_boxes(records, boxes_before(result, *changed));
  work.records = FeatureRecordWriter::text(RecordFormat::csv, records);
}

/// Makes the features of files that are given one after the other.
class FeatureMaker {
 public:
  FeatureMaker(const FeatureRecipe& recipe, const ForEachShare& for_each)
      : recipe_(recipe), for_each_(for_each) {}

  /// Reads a file; its features are in `stem` once finish() was called.
  void add(const std::string& path, const std::string& stem) {
    auto file = std::make_unique<FileAtWork>(stem);
    ReadOptions options;
    if (!recipe_.options.lod.empty()) options.lod = recipe_.options.lod;
    Reader reader(path, options);
    while (auto record = reader.next()) {
      expect_readable(*record, path);
      for (Building& building : record->value->buildings) {
        waiting_.push_back({file.get(), std::move(building), "", std::nullopt});
        if (waiting_.size() >= kShareOfBuildings) work();
      }
    }
    open_.emplace_back(stem, std::move(file));
    if (waiting_.empty()) commit();
  }

  void finish() {
    work();
    commit();
  }

 private:
  static void expect_readable(const Checked<Document>& record, const std::string& path) {
    for (const Issue& issue : record.issues)
      if (issue.severity == Severity::error) throw InputError(issue);
    if (record.value) return;
    Issue issue;
    issue.code = Code::E101;
    issue.sentence = "a record cannot be read";
    issue.place.file = path;
    throw InputError(std::move(issue));
  }

  /// What rests on a fault of oriel's own (memory that was short, say) is neither kept nor
  /// measured.
  static void refuse_own_fault(const BuildingAtWork& done) {
    if (!is_own_fault(*done.fault)) return;
    Issue issue = *done.fault;
    issue.place.building = done.building.id;
    throw InputError(std::move(issue));
  }

  void work() {
    for_each_(waiting_.size(), [&](std::size_t i) { make_features(waiting_[i], recipe_); });
    for (BuildingAtWork& done : waiting_) {
      if (!done.records.empty()) done.file->writer.append(std::string_view(done.records));
      KeptJson entry{{"id", done.building.id}};
      if (done.fault) {
        refuse_own_fault(done);
        entry["code"] = to_string(done.fault->code);
        entry["fault"] = done.fault->sentence;
      }
      done.file->buildings.push_back(std::move(entry));
    }
    waiting_.clear();
  }

  /// The list of buildings comes last: where it is the records are whole.
  void commit() {
    for (auto& [stem, file] : open_) {
      file->writer.commit();
      write_file(stem + kBuildingsEnd,
                 file->buildings.dump(-1, ' ', false, KeptJson::error_handler_t::replace) + "\n");
    }
    open_.clear();
  }

  const FeatureRecipe& recipe_;
  const ForEachShare& for_each_;
  std::vector<BuildingAtWork> waiting_;
  /// Files that were read to their end.
  std::vector<std::pair<std::string, std::unique_ptr<FileAtWork>>> open_;
};

/// The list of the buildings that were kept of a file; nothing if there is none, or no whole one.
std::optional<KeptJson> kept_buildings(const std::string& stem) {
  std::error_code problem;
  const bool is_there =
      fs::exists(stem + kBuildingsEnd, problem) && fs::exists(stem + kRecordsEnd, problem);
  if (!is_there) return std::nullopt;
  auto list = KeptJson::parse(Input(stem + kBuildingsEnd).read_all(), nullptr, false);
  const bool is_whole =
      list.is_array() && std::ranges::all_of(list, [](const KeptJson& entry) {
        return entry.is_object() && entry.contains("id") && entry["id"].is_string();
      });
  if (!is_whole) return std::nullopt;
  return list;
}

/// What was kept of a file of models, its buildings in its order.
KeptFeatures read_kept(const std::string& stem) {
  KeptFeatures kept;
  std::map<std::string, Sample> by_id;
  for (Sample& sample : read_stored_samples(stem + kRecordsEnd, nullptr, kept.issues)) {
    std::string id = sample.features.table.building();
    by_id.emplace(std::move(id), std::move(sample));
  }
  const auto list = kept_buildings(stem);
  for (const KeptJson& entry : list ? *list : KeptJson::array()) {
    const std::string id = entry["id"];
    auto found = by_id.find(id);
    if (found != by_id.end())
      kept.buildings.push_back(std::move(found->second));
    else
      kept.buildings.push_back({{FeatureTable(id, 0), {}}, {}, {}});
    if (entry.contains("fault"))
      kept.issues.push_back(building_issue(
          Severity::warning, code_of(entry.value("code", "")).value_or(Code::none), id,
          "could not be segmented, so that all its objects count as missed: " +
              entry.value("fault", "")));
  }
  return kept;
}

[[noreturn]] void refuse_folder_of(const std::string& folder, const std::error_code& problem) {
  Issue issue;
  issue.code = Code::E601;
  issue.sentence = "the folder cannot be made: " + problem.message();
  issue.place.file = folder;
  throw OutputError(std::move(issue));
}

std::string temporary_folder() {
  std::string name = (fs::temp_directory_path() / "oriel-features-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    refuse_folder_of(name, std::error_code(errno, std::generic_category()));
  return name;
}

}  // namespace

std::string FeatureRecipe::text() const {
  std::string text = configuration(options);
  if (neighbours) text += " neighbours=" + neighbours->sha256();
  if (!perturbation) return text;
  const Perturbation& p = *perturbation;
  return text + fmt::format(
                    " perturbed seed={} noise_m={} kind={} rotation_deg={} shift_m={},{},{} "
                    "missing={} triangulates={}",
                    p.seed, p.noise_m, p.noise_kind == NoiseKind::normal ? "normal" : "uniform",
                    p.rotation_deg, p.shift_m.x, p.shift_m.y, p.shift_m.z, p.missing_share,
                    p.triangulates);
}

std::string hash_of_file(const std::string& path) {
  Input input(path);
  input.hash();
  while (!input.read_some().empty()) {
  }
  return input.digest();
}

FeatureStore::FeatureStore(std::string folder, std::string program)
    : folder_(std::move(folder)), program_(std::move(program)), is_temporary_(folder_.empty()) {
  if (is_temporary_) folder_ = temporary_folder();
  std::error_code problem;
  fs::create_directories(folder_, problem);
  if (problem) refuse_folder_of(folder_, problem);
}

FeatureStore::~FeatureStore() {
  std::error_code ignored;
  if (is_temporary_) fs::remove_all(folder_, ignored);
}

std::string FeatureStore::stem_of(const HashedFile& file, const FeatureRecipe& recipe) const {
  // The name of the file says its format, and of some formats the building's id.
  return folder_ + "/" +
         sha256(fmt::format("{}\n{}\n{}\n{}", program_, recipe.text(), file.sha256,
                            fs::path(file.path).filename().string()));
}

std::vector<KeptFeatures> FeatureStore::features_of(const std::vector<HashedFile>& files,
                                                    const FeatureRecipe& recipe,
                                                    const ForEachShare& for_each,
                                                    const std::function<void(std::size_t)>& step) {
  FeatureMaker maker(recipe, for_each);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string stem = stem_of(files[i], recipe);
    if (!kept_buildings(stem)) maker.add(files[i].path, stem);
    step(i);
  }
  maker.finish();
  std::vector<KeptFeatures> all(files.size());
  for_each(files.size(), [&](std::size_t i) { all[i] = read_kept(stem_of(files[i], recipe)); });
  step(files.size());
  return all;
}

}  // namespace oriel
