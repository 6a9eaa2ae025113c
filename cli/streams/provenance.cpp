#include "cli/streams/provenance.h"

#include "cli/batch/resume.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// What a stage made of what.
struct Step {
  std::vector<std::string> inputs;  ///< hashes
  std::uint64_t left_out = 0;       ///< records
};

/// The steps that a status file names, by the hash of their output; none if it cannot be read.
std::multimap<std::string, Step> steps_of(const fs::path& path) {
  std::multimap<std::string, Step> steps;
  std::ifstream file(path, std::ios::binary);
  const ordered_json status = ordered_json::parse(file, nullptr, false);
  if (!status.is_object() || !status.contains("outputs")) return steps;
  Step step;
  for (const auto& [name, sha256] : status.at("input_sha256").items())
    step.inputs.push_back(sha256);
  const ordered_json& records = status.at("records");
  step.left_out =
      records.at("refused").get<std::uint64_t>() + records.at("not_selected").get<std::uint64_t>();
  for (const auto& [name, mark] : marks_of(status.at("outputs"))) steps.emplace(mark.sha256, step);
  return steps;
}

}  // namespace

std::optional<Issue> check_provenance(const Shard& shard, const std::string& file,
                                      const FileMark& mark,
                                      const std::vector<std::string>& through) {
  const std::string status = shard.name + ".status.json";
  const fs::path status_file = fs::path(file).parent_path() / status;
  std::uint64_t expected = shard.features + 1;
  if (fs::exists(status_file) || !through.empty()) {
    std::multimap<std::string, Step> steps = steps_of(status_file);
    for (const std::string& folder : through) steps.merge(steps_of(fs::path(folder) / status));
    std::string sha256 = mark.sha256;
    bool has_step = false;
    while (sha256 != shard.sha256) {
      const auto step = steps.find(sha256);
      if (step == steps.end())
        return shard_issue(file, !has_step
                                     ? fmt::format("is not the output that {} lists", status)
                                     : fmt::format("was not made of shard {}: {} has another input",
                                                   shard.name, status));
      if (step->second.inputs.size() != 1)
        return shard_issue(file, "was made of several inputs; expected one shard");
      expected -= std::min(expected, step->second.left_out);
      sha256 = step->second.inputs[0];
      has_step = true;
      steps.erase(step);  // a stage may change nothing
    }
  }
  if (mark.lines == expected) return std::nullopt;
  return shard_issue(
      file, fmt::format("has {} lines; shard {} has {}, of which {} were left out", mark.lines,
                        shard.name, shard.features + 1, shard.features + 1 - expected));
}

}  // namespace oriel::cli
