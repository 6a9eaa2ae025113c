#include "examples/generator/command.h"

#include "examples/generator/arguments.h"
#include "examples/generator/generate.h"
#include "examples/generator/output/citygml.h"
#include "examples/generator/output/cityjson.h"
#include "examples/generator/output/output.h"
#include "examples/generator/output/truth.h"

#include <functional>
#include <optional>
#include <ostream>

#include <fmt/format.h>

namespace oriel::generator {
namespace {

namespace fs = std::filesystem;

/// One house as it is written.
struct Sample {
  Building labelled, stripped;
};

Sample make_sample(const Arguments& arguments, int index) {
  const Options& options = arguments.options;
  const std::string id =
      arguments.count == 1 ? arguments.name : fmt::format("{}-{:06}", arguments.name, index + 1);
  Sample sample{{id, generate(options, index), options.origin}, {id, {}, options.origin}};
  Random random(options.seed ^ 0x5eed, static_cast<std::uint64_t>(index));
  sample.stripped.body = shuffled(sample.labelled.body, random);
  return sample;
}

void write_file(const fs::path& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.finish();
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError("cannot make the folder " + folder.string());
}

CityGml version_of(const Arguments& arguments) {
  return arguments.format == "citygml3" ? CityGml::v3 : CityGml::v2;
}

void write_folder(const Arguments& arguments) {
  const fs::path folder = arguments.output;
  make_folder(folder);
  for (int i = 0; i < arguments.count; ++i) {
    const Sample sample = make_sample(arguments, i);
    const std::string& id = sample.labelled.id;
    if (arguments.format == "cityjson") {
      write_file(folder / (id + ".labelled.city.json"),
                 cityjson(sample.labelled, Content::labelled));
      write_file(folder / (id + ".stripped.city.json"),
                 cityjson(sample.stripped, Content::stripped));
    } else {
      const CityGml version = version_of(arguments);
      write_file(folder / (id + ".labelled.gml"),
                 citygml(sample.labelled, Content::labelled, version));
      write_file(folder / (id + ".stripped.gml"),
                 citygml(sample.stripped, Content::stripped, version));
    }
    write_file(folder / (id + ".truth.json"), truth_json(sample.stripped));
  }
}

/// Where the truths of a stream go: nowhere, into one file of lines, or into a file each.
class TruthSink {
 public:
  explicit TruthSink(const std::string& path) : path_(path) {
    if (path.ends_with(".jsonl"))
      lines_.emplace(path);
    else if (!path.empty())
      make_folder(path);
  }
  void write(const Building& building) {
    if (path_.empty()) return;
    const std::string truth = truth_json(building);
    if (lines_)
      lines_->write(truth);
    else
      write_file(fs::path(path_) / (building.id + ".truth.json"), truth);
  }
  void finish() {
    if (lines_) lines_->finish();
  }

 private:
  std::string path_;
  std::optional<OutputFile> lines_;
};

void write_stream(const Arguments& arguments, const std::function<void(std::string_view)>& write) {
  TruthSink truths(arguments.truth);
  const bool is_gml = arguments.is_gml_file();
  const CityGml version = version_of(arguments);
  const Content content = arguments.is_labelled ? Content::labelled : Content::stripped;
  write(is_gml ? citygml_head(version) : cityjson_header(arguments.options.origin));
  for (int i = 0; i < arguments.count; ++i) {
    const Sample sample = make_sample(arguments, i);
    const Building& written = arguments.is_labelled ? sample.labelled : sample.stripped;
    write(is_gml ? citygml_member(written, content, version) : cityjson_feature(written, content));
    truths.write(written);
  }
  if (is_gml) write(citygml_foot());
  truths.finish();
}

void write_output(const Arguments& arguments, std::ostream& out) {
  if (arguments.output == "-") {
    write_stream(arguments, [&](std::string_view text) {
      if (!out.write(text.data(), static_cast<std::streamsize>(text.size())))
        throw OutputError("cannot write to the standard output");
    });
    if (!out.flush()) throw OutputError("cannot write to the standard output");
  } else if (arguments.output.ends_with(".city.jsonl") || arguments.is_gml_file()) {
    OutputFile file(arguments.output);
    write_stream(arguments, [&](std::string_view text) { file.write(text); });
    file.finish();
  } else {
    write_folder(arguments);
  }
}

}  // namespace

int run_command(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Arguments arguments;
  if (const std::optional<int> code = read_arguments(argc, argv, arguments, out, err)) return *code;
  try {
    write_output(arguments, out);
  } catch (const OutputError& error) {
    err << "oriel-generate: " << error.what() << '\n';
    return 6;
  } catch (const std::exception& error) {
    err << "oriel-generate: internal error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace oriel::generator
