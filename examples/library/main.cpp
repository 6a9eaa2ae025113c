// Labels the buildings of a file and redraws them for 1:5000: library INPUT LABELLED COARSE.

#include <cstdio>
#include <exception>
#include <oriel/oriel.h>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  const oriel::RuleBase rules = oriel::load_pack_file("residential").value.value();
  const std::vector<oriel::Document> records = oriel::read(argv[1]).value.value();
  std::vector<oriel::OutputRecord> labelled(records.size()), coarse(records.size());
  for (std::size_t i = 0; i < records.size(); ++i)
    for (const oriel::Building& building : records[i].buildings) {
      const oriel::PipelineResult result = oriel::label(building, rules);
      for (const oriel::Issue& issue : result.issues) std::puts(oriel::to_string(issue).c_str());
      std::printf("%s: %zu features\n", building.id.c_str(), result.interpretation.verdicts.size());
      oriel::add(result.output, labelled[i]);
      oriel::add(oriel::generalise(records[i], building, result, rules, oriel::at_scale(5000)),
                 coarse[i]);
    }
  oriel::write(argv[2], records, labelled);
  oriel::write(argv[3], records, coarse);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
