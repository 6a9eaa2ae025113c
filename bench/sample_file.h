#pragma once

#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "examples/generator/random.h"
#include "io/files/output_file.h"
#include "io/reader.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

namespace oriel::bench {

/// A generated house as a file that goes with the object.
class SampleFile {
 public:
  explicit SampleFile(const generator::Options& options) {
    generator::Random random(options.seed);
    generator::Building house{"house", generator::generate(options, 0), options.origin};
    house.body = generator::shuffled(house.body, random);
    path_ = (std::filesystem::temp_directory_path() /
             ("oriel-bench-" + std::to_string(options.windows) + "-" +
              std::to_string(options.jitter) + ".city.json"))
                .string();
    write_file(path_, generator::cityjson(house, generator::Content::stripped));
  }
  ~SampleFile() { std::remove(path_.c_str()); }
  SampleFile(const SampleFile&) = delete;
  SampleFile& operator=(const SampleFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] Document document() const { return std::move(*Reader(path_).next()->value); }

 private:
  std::string path_;
};

}  // namespace oriel::bench
