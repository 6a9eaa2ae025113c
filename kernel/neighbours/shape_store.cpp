#include "kernel/neighbours/shape_store.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace oriel::detail {

namespace {

/// What a tile takes in the file: some ten houses with the windows of their walls left out, so that
/// a building and those beside it take few reads.
constexpr std::size_t kTile_bytes = 1 << 16;
/// What malloc adds to a piece of memory.
constexpr std::size_t kPerPiece_bytes = 16;

std::size_t bytes_of(const std::vector<Outline>& outlines) {
  std::size_t sum = outlines.capacity() * sizeof(Outline) + kPerPiece_bytes;
  for (const Outline& outline : outlines)
    sum += outline.capacity() * sizeof(Vec3) + kPerPiece_bytes;
  return sum;
}

std::size_t bytes_of(const StandingShape& shape) {
  std::size_t sum = sizeof shape + shape.walls.capacity() * sizeof(UprightWall);
  for (const UprightWall& wall : shape.walls) sum += bytes_of(wall.outlines);
  for (const auto& piece : shape.ground) sum += bytes_of(piece) + sizeof piece;
  return sum + 3 * kPerPiece_bytes;
}

template <class Value>
void put(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_outlines(std::string& bytes, const std::vector<Outline>& outlines) {
  put(bytes, outlines.size());
  for (const Outline& outline : outlines) {
    put(bytes, outline.size());
    for (const Vec3& p : outline) put(bytes, p);
  }
}

std::string packed(const StandingShape& shape) {
  std::string bytes;
  put(bytes, shape.walls.size());
  for (const UprightWall& wall : shape.walls) {
    put_outlines(bytes, wall.outlines);
    put(bytes, wall.normal);
    put(bytes, wall.box);
  }
  put(bytes, shape.ground.size());
  for (const auto& piece : shape.ground) put_outlines(bytes, piece);
  return bytes;
}

/// What packed() wrote, in order.
class Unpacker {
 public:
  explicit Unpacker(std::span<const char> bytes) : rest_(bytes) {}

  StandingShape shape() {
    StandingShape out;
    out.walls.resize(take<std::size_t>());
    for (UprightWall& wall : out.walls) {
      wall.outlines = outlines();
      wall.normal = take<Vec3>();
      wall.box = take<Box>();
    }
    out.ground.resize(take<std::size_t>());
    for (auto& piece : out.ground) piece = outlines();
    return out;
  }

 private:
  template <class Value>
  Value take() {
    Value value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_ = rest_.subspan(sizeof value);
    return value;
  }

  std::vector<Outline> outlines() {
    std::vector<Outline> out(take<std::size_t>());
    for (Outline& outline : out) {
      outline.resize(take<std::size_t>());
      for (Vec3& p : outline) p = take<Vec3>();
    }
    return out;
  }

  std::span<const char> rest_;
};

}  // namespace

void ShapeStore::open_file() {
  file_ = std::make_unique<NamelessFile>(folder_, folder_ + "/.oriel-outlines");
  file_->forget_name();
  end_ = 0;
}

void ShapeStore::write(const std::string& bytes) {
  file_->append(bytes);
  spans_.push_back({end_, bytes.size()});
  end_ += bytes.size();
}

void ShapeStore::move_to_disk() {
  open_file();
  for (const HeldShape& shape : held_) write(packed(*shape));
  held_ = {};
}

void ShapeStore::add(StandingShape shape) {
  if (file_) return write(packed(shape));
  bytes_ += bytes_of(shape);
  held_.push_back(std::make_shared<const StandingShape>(std::move(shape)));
  if (bytes_ > held_bytes_) move_to_disk();
}

void ShapeStore::arrange(std::span<const std::size_t> kept, std::span<const std::size_t> by_place) {
  if (file_) return write_tiles(kept, by_place);
  std::vector<HeldShape> held;
  held.reserve(kept.size());
  for (const std::size_t i : kept) held.push_back(std::move(held_[i]));
  held_ = std::move(held);
}

/// Into a second file; the first is given up.
void ShapeStore::write_tiles(std::span<const std::size_t> kept,
                             std::span<const std::size_t> by_place) {
  file_->flush();
  const std::unique_ptr<NamelessFile> unsorted = std::move(file_);
  const std::vector<StoredSpan> spans = std::exchange(spans_, {});
  open_file();
  where_.resize(kept.size());
  std::string bytes;
  for (std::size_t position = 0; position < by_place.size(); ++position) {
    const StoredSpan& from = spans[kept[by_place[position]]];
    where_[by_place[position]] = static_cast<std::uint32_t>(position);
    if (slots_.empty() || slots_.back().span.bytes >= kTile_bytes)
      slots_.push_back({{end_, 0}, position, nullptr, used_.end()});
    bytes.resize(from.bytes);
    unsorted->read_at(from.place, bytes);
    file_->append(bytes);
    end_ += bytes.size();
    slots_.back().span.bytes += bytes.size();
  }
  file_->flush();
}

std::shared_ptr<const ShapeStore::ShapeTile> ShapeStore::read(const TileSlot& slot,
                                                              std::size_t shapes) const {
  std::string bytes(slot.span.bytes, '\0');
  file_->read_at(slot.span.place, bytes);
  auto tile = std::make_shared<ShapeTile>();
  tile->shapes.reserve(shapes);
  Unpacker unpacker(bytes);
  for (std::size_t i = 0; i < shapes; ++i) {
    tile->shapes.push_back(unpacker.shape());
    tile->bytes += bytes_of(tile->shapes.back());
  }
  return tile;
}

/// Two threads may read the same tile at the same time; they read the same.
std::shared_ptr<const ShapeStore::ShapeTile> ShapeStore::tile_at(std::size_t number) const {
  TileSlot& slot = slots_[number];
  {
    const std::lock_guard lock(mutex_);
    if (slot.tile) {
      used_.splice(used_.begin(), used_, slot.used);
      return slot.tile;
    }
  }
  const std::size_t end = number + 1 < slots_.size() ? slots_[number + 1].first : where_.size();
  std::shared_ptr<const ShapeTile> tile = read(slot, end - slot.first);
  const std::lock_guard lock(mutex_);
  if (slot.tile) return tile;
  slot.tile = tile;
  slot.used = used_.insert(used_.begin(), number);
  tile_bytes_ += tile->bytes;
  while (tile_bytes_ > held_bytes_ && used_.size() > 1) {
    TileSlot& last = slots_[used_.back()];
    tile_bytes_ -= last.tile->bytes;
    last.tile.reset();
    used_.pop_back();
  }
  return tile;
}

std::shared_ptr<const StandingShape> ShapeStore::at(std::size_t i) const {
  if (!file_) return held_[i];
  const std::size_t position = where_[i];
  const auto next = std::ranges::upper_bound(slots_, position, {}, &TileSlot::first);
  const auto number = static_cast<std::size_t>(next - slots_.begin()) - 1;
  const std::shared_ptr<const ShapeTile> tile = tile_at(number);
  return {tile, &tile->shapes[position - slots_[number].first]};
}

}  // namespace oriel::detail
