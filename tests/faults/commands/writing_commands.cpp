#include "tests/cli/cubes.h"
#include "tests/faults/commands/faulted_run.h"

namespace oriel::test {

namespace {

using Words = std::vector<std::string>;

Files house() { return {{"in.city.json", bytes_of(sample("house"))}}; }
Files stream() { return {{"in.city.jsonl", cube_lines({"a", "b", "c", "d"})}}; }

Files experiment() {
  Files files = house();
  files["house.truth.json"] = bytes_of(replaced(sample("house"), ".stripped.city", ".truth"));
  files["e.yaml"] =
      "schema: oriel-experiment/1\nname: small\nbootstrap: 5\nsets: {house: {models: "
      "in.city.json, truth: house.truth.json}}\nrules: residential\n"
      "sweep: {params: [narrowest], values: 2}\n";
  return files;
}

constexpr const char* kPack = R"(schema: oriel/1
pack: {name: small, version: 1.0.0}
classes: {window: {}}
rules:
  - {id: w,   label: window, require: height > 1 m}
)";

}  // namespace

std::vector<WritingCommand> writing_commands() {
  const Words label{"label",           "@/in.city.json", "-o",
                    "@/out.city.json", "--features",     "@/parts.csv"};
  const Words split{"split", "@/in.city.jsonl", "--count", "2", "-o", "@/shards"};
  const Words series{"generalise", "@/in.city.json", "--series", "1:500,1:5000", "-o", "@/house"};
  const Words reuse{"label",      "@/in.city.jsonl",  "-o",       "@/out.city.jsonl",
                    "--features", "@/parts.csv",      "--status", "@/run",
                    "--reuse",    "@/run.status.json"};
  const std::string source = ORIEL_SOURCE_DIR;
  return {
      {"cat", {"cat", "@/in.city.json", "-o", "@/out.city.jsonl", "--status", "@/run"}, house()},
      {"collect", {"collect", "@/in.city.jsonl", "-o", "@/out.city.json"}, stream()},
      {"split", split, stream()},
      {"merge",
       {"merge", "@/shards/000001.city.jsonl", "@/shards/000000.city.jsonl", "--split",
        "@/shards/split.json", "-o", "@/out.city.jsonl"},
       stream(),
       {split}},
      {"segment",
       {"segment", "@/in.city.json", "--json", "-o", "@/out.json", "--features", "@/parts.jsonl"},
       house()},
      {.name = "tiles",
       .words = {"tiles", "@/in.city.json", "-o", "@/tiles", "--scales", "1:500,1:5000"},
       .inputs = house(),
       .is_resumable = true,
       .needs_memory = true},
      {"label", label, house()},
      {"label onto old files", label, house(), {label}},
      {"label --timings",
       {"label", "@/in.city.json", "-o", "@/a.obj", "--timings", "@/times.json"},
       house()},
      {.name = "label --resume",
       .words = {"label", "@/in.city.jsonl", "-o", "@/out.city.jsonl", "--features", "@/parts.csv",
                 "--status", "@/run", "--resume"},
       .inputs = stream(),
       .is_resumable = true},
      {.name = "label --reuse",
       .words = reuse,
       .inputs = stream(),
       .first = {reuse},
       .is_resumable = true},
      {"label to GeoPackage", {"label", "@/in.city.json", "-o", "@/out.gpkg"}, house()},
      {.name = "label to CityGML",
       .words = {"label", "@/in.city.jsonl", "-o", "@/out.gml", "--status", "@/run", "--resume"},
       .inputs = stream(),
       .is_resumable = true},
      {.name = "label --isolate",
       .words = {"label", "@/in.city.jsonl", "-o", "@/out.city.jsonl", "--isolate"},
       .inputs = stream()},
      {.name = "label -j",
       .words = {"label", "@/in.city.jsonl", "-o", "@/out.city.jsonl", "-j", "2"},
       .inputs = stream(),
       .has_threads = true},
      {"generalise",
       {"generalise", "@/in.city.json", "--scale", "1:5000", "-o", "@/out.city.json", "--explain",
        "@/why.jsonl", "--metrics", "@/figures.jsonl", "--features", "@/parts.csv"},
       house()},
      {"generalise --series", series, house()},
      {"generalise --at",
       {"generalise", "--from", "@/house", "--at", "1:2000", "-o", "@/out.city.json"},
       house(),
       {series}},
      {"repair",
       {"repair", "@/in.city.json", "-o", "@/out.obj", "--report", "@/report.jsonl"},
       house()},
      {"view", {"view", "@/in.city.json", "-o", "@/page.html"}, house()},
      {"interpret", {"interpret", "@/parts.csv", "-o", "@/again.json"}, house(), {label}},
      {"score",
       {"score", "@/parts.csv", "--truth", source + "/examples/samples/house.truth.json",
        "--per-building", "@/each.csv", "--curve", "@/curve.csv", "--join", "@/joined.csv"},
       house(),
       {label}},
      {.name = "experiment run",
       .words = {"experiment", "run", "@/e.yaml", "-o", "@/out", "--resume"},
       .inputs = experiment(),
       .is_resumable = true},
      {"validate", {"validate", "@/in.city.json", "--json", "-o", "@/found.jsonl"}, house()},
      {"rules fmt", {"rules", "fmt", "-w", "@/small.yaml"}, {{"small.yaml", kPack}}},
      {"rules new", {"rules", "new", "@/thing"}, {}},
      {"rules test",
       {"rules", "test", source + "/rules/residential.test.yaml", "--junit", "@/report.xml"},
       {}},
  };
}

}  // namespace oriel::test
