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
#include <vector>

#include <fmt/format.h>

namespace oriel::generator {
namespace {

namespace fs = std::filesystem;

/// One house as it is written.
struct Sample {
  Building labelled, stripped;
};

/// By addition: how many houses have no room for it.
using HousesWithoutRoom = std::vector<int>;

/// Of several houses an AdditionError says on which one there is no room.
Body body_of(const Arguments& arguments, int index, const std::string& id) {
  try {
    return generate(arguments.options, index);
  } catch (const AdditionError& error) {
    if (arguments.count == 1) throw;
    throw AdditionError(fmt::format("{} ({})", error.what(), id));
  }
}

Sample make_sample(const Arguments& arguments, int index, HousesWithoutRoom& without_room) {
  const Options& options = arguments.options;
  const std::string id =
      arguments.count == 1 ? arguments.name : fmt::format("{}-{:06}", arguments.name, index + 1);
  Sample sample{{id, body_of(arguments, index, id), options.origin}, {id, {}, options.origin}};
  without_room.resize(options.additions.size());
  for (const int addition : sample.labelled.body.without_room)
    ++without_room[static_cast<std::size_t>(addition)];
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

void write_folder(const Arguments& arguments, HousesWithoutRoom& without_room) {
  const fs::path folder = arguments.output;
  make_folder(folder);
  for (int i = 0; i < arguments.count; ++i) {
    const Sample sample = make_sample(arguments, i, without_room);
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

void write_stream(const Arguments& arguments, const std::function<void(std::string_view)>& write,
                  HousesWithoutRoom& without_room) {
  TruthSink truths(arguments.truth);
  const bool is_gml = arguments.is_gml_file();
  const CityGml version = version_of(arguments);
  const Content content = arguments.is_labelled ? Content::labelled : Content::stripped;
  write(is_gml ? citygml_head(version) : cityjson_header(arguments.options.origin));
  for (int i = 0; i < arguments.count; ++i) {
    const Sample sample = make_sample(arguments, i, without_room);
    const Building& written = arguments.is_labelled ? sample.labelled : sample.stripped;
    write(is_gml ? citygml_member(written, content, version) : cityjson_feature(written, content));
    truths.write(written);
  }
  if (is_gml) write(citygml_foot());
  truths.finish();
}

void write_output(const Arguments& arguments, std::ostream& out, HousesWithoutRoom& without_room) {
  if (arguments.output == "-") {
    const auto write = [&](std::string_view text) {
      if (!out.write(text.data(), static_cast<std::streamsize>(text.size())))
        throw OutputError("cannot write to the standard output");
    };
    write_stream(arguments, write, without_room);
    if (!out.flush()) throw OutputError("cannot write to the standard output");
  } else if (arguments.output.ends_with(".city.jsonl") || arguments.is_gml_file()) {
    OutputFile file(arguments.output);
    write_stream(
        arguments, [&](std::string_view text) { file.write(text); }, without_room);
    file.finish();
  } else {
    write_folder(arguments, without_room);
  }
}

/// Says what was left out; 3 if something was that no house has room for.
int report_room(const Arguments& arguments, const HousesWithoutRoom& without_room,
                std::ostream& err) {
  int code = 0;
  for (std::size_t i = 0; i < without_room.size(); ++i) {
    if (without_room[i] == 0) continue;
    err << fmt::format("oriel-generate: warning: E141 {} of {} {} no room for '{}'\n",
                       without_room[i], arguments.count,
                       arguments.count == 1 ? "house has" : "houses have",
                       arguments.options.additions[i].text);
    if (without_room[i] == arguments.count) code = 3;
  }
  return code;
}

}  // namespace

int run_command(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  Arguments arguments;
  if (const std::optional<int> code = read_arguments(argc, argv, arguments, out, err)) return *code;
  try {
    HousesWithoutRoom without_room;
    write_output(arguments, out, without_room);
    return report_room(arguments, without_room, err);
  } catch (const AdditionError& error) {
    err << "oriel-generate: --add: " << error.what() << '\n';
    return 2;
  } catch (const OutputError& error) {
    err << "oriel-generate: " << error.what() << '\n';
    return 6;
  } catch (const std::exception& error) {
    err << "oriel-generate: internal error: " << error.what() << '\n';
    return 1;
  }
}

}  // namespace oriel::generator
