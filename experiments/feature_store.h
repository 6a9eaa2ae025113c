#pragma once

#include "interpret/learn/sample.h"
#include "kernel/base/issue.h"
#include "kernel/base/parallel.h"
#include "kernel/neighbours/neighbours.h"
#include "kernel/perturb/perturb.h"
#include "oriel/options.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// The buildings of a file of models.
struct KeptFeatures {
  /// Without truth, and without features where a building could not be segmented. Boxes are those
  /// of before it was perturbed.
  std::vector<Sample> buildings;
  /// Warnings about buildings that could not be segmented.
  std::vector<Issue> issues;
};

/// How models become features.
struct FeatureRecipe {
  PipelineOptions options;
  std::optional<Perturbation> perturbation;
  /// LabelOptions::neighbours.
  std::shared_ptr<const NeighbourSearch> neighbours{};

  /// All that the features of a file depend on besides its bytes, as one text.
  [[nodiscard]] std::string text() const;
};

/// A file and the SHA-256 of its bytes.
struct HashedFile {
  std::string path;
  std::string sha256;
};

/// The SHA-256 of a file's bytes. Throws InputError E101.
std::string hash_of_file(const std::string& path);

/// Makes the features of models, once: they are kept as records in a folder, under a name made of
/// the bytes of the models, the recipe and the program, so that what is found there is never too
/// old. What comes of it is the same whether it was found or made.
class FeatureStore {
 public:
  /// `folder` is made if it is not there; empty: a temporary one that goes with the store.
  /// `program` says by which program features are made.
  FeatureStore(std::string folder, std::string program);
  ~FeatureStore();
  FeatureStore(const FeatureStore&) = delete;
  FeatureStore& operator=(const FeatureStore&) = delete;

  /// The features of each file, in their order. Buildings are segmented in shares by `for_each`;
  /// `step` is called now and then with the number of files that are done. Throws InputError for a
  /// file that cannot be read, OutputError E601 where records cannot be kept.
  std::vector<KeptFeatures> features_of(const std::vector<HashedFile>& files,
                                        const FeatureRecipe& recipe, const ForEachShare& for_each,
                                        const std::function<void(std::size_t)>& step);

 private:
  [[nodiscard]] std::string stem_of(const HashedFile& file, const FeatureRecipe& recipe) const;

  std::string folder_;
  std::string program_;
  bool is_temporary_ = false;
};

}  // namespace oriel
