#pragma once

#include "kernel/base/nameless_file.h"
#include "kernel/neighbours/standing_building.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel::detail {

/// The outlines of all buildings of a city: in memory while they take no more than so many bytes,
/// else in a file without a name, those that stand near each other together, of which so many bytes
/// are held at a time. What the file does not take or give back is an OutputError E601.
class ShapeStore {
 public:
  /// The file is made in the folder once it is needed; issues call it FOLDER/.oriel-outlines.
  ShapeStore(std::size_t held_bytes, std::string folder)
      : held_bytes_(held_bytes), folder_(std::move(folder)) {}

  void add(StandingShape shape);
  /// After all were added: number i is the one that was added as number kept[i] from now on, the
  /// others are gone. `by_place` has the new numbers in an order in which neighbours come together.
  void arrange(std::span<const std::size_t> kept, std::span<const std::size_t> by_place);
  /// After arrange(), by several threads at the same time.
  [[nodiscard]] std::shared_ptr<const StandingShape> at(std::size_t i) const;

  [[nodiscard]] bool is_on_disk() const { return file_ != nullptr; }

 private:
  using HeldShape = std::shared_ptr<const StandingShape>;
  struct StoredSpan {
    std::uint64_t place = 0;
    std::size_t bytes = 0;
  };
  struct ShapeTile {
    std::vector<StandingShape> shapes;
    std::size_t bytes = 0;  ///< in memory
  };
  /// Where a tile is in the file, and in memory if it is there.
  struct TileSlot {
    StoredSpan span;
    std::size_t first = 0;  ///< position of its first shape
    std::shared_ptr<const ShapeTile> tile;
    std::list<std::size_t>::iterator used;
  };

  void open_file();
  void write(const std::string& bytes);
  void move_to_disk();
  void write_tiles(std::span<const std::size_t> kept, std::span<const std::size_t> by_place);
  [[nodiscard]] std::shared_ptr<const ShapeTile> read(const TileSlot& slot,
                                                      std::size_t shapes) const;
  [[nodiscard]] std::shared_ptr<const ShapeTile> tile_at(std::size_t number) const;

  std::size_t held_bytes_;
  std::string folder_;
  std::vector<HeldShape> held_;  ///< while none is on disk
  std::size_t bytes_ = 0;        ///< of them
  std::unique_ptr<NamelessFile> file_;
  std::uint64_t end_ = 0;             ///< of the file
  std::vector<StoredSpan> spans_;     ///< in the order of add(), until arrange()
  std::vector<std::uint32_t> where_;  ///< position in the file, by number

  mutable std::mutex mutex_;
  mutable std::vector<TileSlot> slots_;
  mutable std::list<std::size_t> used_;  ///< those in memory, the last used first
  mutable std::size_t tile_bytes_ = 0;   ///< of these
};

}  // namespace oriel::detail
