#pragma once

#include "interpret/learn/folds.h"
#include "interpret/learn/learning_set.h"
#include "interpret/learn/search/param_search.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace oriel {

/// What params were fitted to, and what the parts of the samples said of it.
struct ParamFit {
  /// The pack's own values where nothing pays.
  Setting at;
  /// Why it is these, or empty.
  std::string reason;
  /// By part what the search outside it found; and once more with the params that parts agree on.
  std::vector<Setting> searched, agreed;
};

/// Fits params to samples, in the same way for whichever samples.
class ParamFitter {
 public:
  /// Only params in `free` are moved. The set must outlive it.
  ParamFitter(const LearningSet& set, std::vector<std::size_t> free, double penalty, int restarts,
              std::uint64_t seed)
      : set_(set),
        base_(set.setting()),
        free_(std::move(free)),
        penalty_(penalty),
        restarts_(restarts),
        seed_(seed) {}

  /// Searches on all of `samples` and on those outside each of the parts of them: one param after
  /// the other until nothing is gained, again from other settings, and then together. Only params
  /// that at least half of the parts change the same way are changed, in a second search with these
  /// alone. If the parts, each with what was found outside it, are not better with that than with
  /// the pack, the pack's values stay.
  [[nodiscard]] ParamFit fit(const SamplePart& samples, const std::vector<SamplePart>& parts) const;

  /// How many of these settings change the param up or down as `value` does.
  [[nodiscard]] std::size_t count_like(const std::vector<Setting>& settings, std::size_t param,
                                       double value) const;

 private:
  /// One on all samples, then one for each part.
  using Runs = std::vector<SearchRun>;

  [[nodiscard]] Runs fresh_runs(const ParamSearch& search, const SamplePart& samples,
                                const std::vector<SamplePart>& parts) const;
  [[nodiscard]] Runs search(const SamplePart& samples, const std::vector<SamplePart>& parts) const;
  void begin_again(const ParamSearch& search, int restart, Runs& best) const;
  void refine(const ParamSearch& search, SearchRun& run) const;
  [[nodiscard]] std::vector<std::size_t> agreed_params(const ParamFit& fit) const;
  [[nodiscard]] Runs search_again(const Runs& runs, const std::vector<SamplePart>& parts,
                                  const std::vector<std::size_t>& agreed) const;
  [[nodiscard]] std::string fault_of(const ParamFit& fit,
                                     const std::vector<SamplePart>& parts) const;

  const LearningSet& set_;
  Setting base_;
  std::vector<std::size_t> free_;
  double penalty_;
  int restarts_;
  std::uint64_t seed_;
};

/// By sample of the parts its outcome with the setting of its part.
std::vector<LabelOutcome> held_out_outcomes(const LearningSet& set,
                                            const std::vector<SamplePart>& parts,
                                            const std::vector<Setting>& settings);
/// The samples of all parts.
SamplePart samples_of_parts(const std::vector<SamplePart>& parts);

}  // namespace oriel
