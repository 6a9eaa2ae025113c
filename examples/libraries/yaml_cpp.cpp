// yaml-cpp: reads rule packs, with the place of every node for messages.
// Trap: duplicate keys are accepted silently; only iterating over the map shows both.
// Trap: lines and columns of a Mark count from 0, and there is no end mark.
#include <cstdio>
#include <set>
#include <string>

#include <yaml-cpp/yaml.h>

int main() {
  const YAML::Node pack = YAML::Load(
      "rules:\n"
      "  - id: door.ground\n"
      "    label: door\n"
      "    label: window\n");
  const YAML::Node rule = pack["rules"][0];

  std::set<std::string> keys;
  int duplicates = 0;
  for (const auto& entry : rule) {
    if (keys.insert(entry.first.as<std::string>()).second) continue;
    ++duplicates;
    const YAML::Mark mark = entry.first.Mark();
    std::printf("pack.yaml:%d:%d: duplicate key '%s'\n", mark.line + 1, mark.column + 1,
                entry.first.as<std::string>().c_str());
  }
  std::printf("yaml-cpp itself said nothing and took '%s'\n",
              rule["label"].as<std::string>().c_str());
  return duplicates == 1 ? 0 : 1;
}
