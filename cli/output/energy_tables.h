#pragma once

#include "cli/batch/outcome.h"
#include "cli/output/named_files.h"
#include "io/files/output_file.h"
#include "kernel/base/issue.h"
#include "oriel/energy.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace oriel::cli {

/// What --table, --unheated and --extension say.
struct EnergyArguments {
  std::vector<std::string> tables;  ///< "energy", "envelope=FILE"
  EnergyOptions energy;
  std::string extension;  ///< "energy", or empty

  [[nodiscard]] bool has_any() const { return !tables.empty() || !extension.empty(); }
};

/// Adds `--table NAME[=FILE]`, `--unheated CLASSES` and `--extension energy`.
void add_energy_arguments(CLI::App& command, EnergyArguments& arguments);

/// Throws CLI::ValidationError for classes in --unheated that the pack does not have, and where
/// nothing is written that they matter to.
void check_unheated(const EnergyArguments& arguments, const RuleBase& rules);

/// A warning E134 of buildings that came to the end without a body to measure.
Issue nothing_measured(int buildings);

/// The files of --table; each appears when all inputs are done.
class EnergyTables {
 public:
  /// Throws CLI::ValidationError for a table that there is none of, one that is named twice, and
  /// for two on stdout.
  EnergyTables(const EnergyArguments& arguments, bool is_safe);

  [[nodiscard]] bool has_any() const;
  /// One of them goes to stdout.
  [[nodiscard]] bool takes_stdout() const;
  /// Lines of JSON or CSV, in files: nothing stands between records.
  [[nodiscard]] bool is_of_lines() const;
  /// All that the bytes depend on.
  [[nodiscard]] std::string recipe() const;
  void name_files(NamedFiles& files) const;
  /// An input begins. What follows is kept unless it is a rehearsal.
  void begin(bool is_rehearsal);
  /// What is known of a building.
  [[nodiscard]] BuildingEnergy energy(const Building& building, const PipelineResult& result,
                                      const RuleBase& rules, const PipelineOptions& options,
                                      std::optional<int> stated_storeys) const;
  /// Adds its rows. Several threads may call both.
  void make(const BuildingEnergy& of, Product& product) const;
  void take(const Product& product);
  /// Adds the files and what is in them so far.
  void add_places(PartPlaces& places) const;
  void commit();

 private:
  struct Table {
    EnergyTable kind = EnergyTable::buildings;
    OutputPart part = OutputPart::energy;
    std::string path;  ///< empty: not asked for; "-": stdout
    TableFormat format = TableFormat::csv;
    std::unique_ptr<OutputFile> file{};
    bool is_empty = true;
  };

  EnergyOptions energy_;
  bool is_safe_ = false;
  std::array<Table, 2> tables_;
};

}  // namespace oriel::cli
