#include "io/tiles/tile_building.h"

#include "io/json/text.h"
#include "io/tiles/byte_stream.h"
#include "io/tiles/mesh_bytes.h"
#include "kernel/base/issue.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace oriel {

namespace {

/// Before each building: how many bytes its head has and how many its meshes.
struct BuildingSizes {
  std::uint64_t head = 0, meshes = 0;
};

void put_names(detail::ByteWriter& head, const TileBuilding& building,
               std::string FlatFeature::*name) {
  std::set<std::string> names;
  for (const FlatMesh& mesh : building.meshes)
    for (const FlatFeature& feature : mesh.features) names.insert(feature.*name);
  head.put(names.size());
  for (const std::string& one : names) head.put(one);
}

bool has_colour(const TileBuilding& building) {
  return std::ranges::any_of(building.meshes, [](const FlatMesh& mesh) {
    return std::ranges::any_of(
        mesh.features, [](const FlatFeature& feature) { return feature.colour.has_value(); });
  });
}

void get_names(detail::ByteReader& head, std::set<std::string>& names) {
  for (std::size_t left = head.count(1); left > 0; --left) {
    std::string name;
    head.get(name);
    names.insert(std::move(name));
  }
}

}  // namespace

std::string to_bytes(const TileBuilding& building) {
  detail::ByteWriter head;
  std::string meshes;
  head.put(building.id);
  head.put(building.crs);
  head.put(building.origin_m);
  head.put(building.mesh_at);
  head.put(building.error_m);
  std::vector<TileEntry::Stored> stored;
  for (const FlatMesh& mesh : building.meshes) {
    const std::string bytes = detail::to_bytes(mesh);
    stored.push_back({meshes.size(), bytes.size(), mesh.triangles.size(), box_of(mesh)});
    meshes += bytes;
  }
  head.put(stored);
  put_names(head, building, &FlatFeature::label);
  put_names(head, building, &FlatFeature::surface);
  head.put(has_colour(building));
  const std::string text = head.take();
  detail::ByteWriter out;
  out.put(BuildingSizes{text.size(), meshes.size()});
  return out.take() + text + meshes;
}

TileBuildings::TileBuildings(const std::string& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat found {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &found) != 0)
    fail(std::generic_category().message(errno));
  try {
    read_entries(static_cast<std::uint64_t>(found.st_size));
  } catch (const std::runtime_error& fault) {
    fail(fault.what());
  }
}

TileBuildings::~TileBuildings() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void TileBuildings::fail(const std::string& why) const {
  throw InputError(error_in(TextName{path_, 0}, {Code::E101, "cannot be read: " + why}));
}

std::string TileBuildings::read(std::uint64_t at, std::uint64_t bytes) const {
  std::string text(bytes, '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t got =
        ::pread(descriptor_, text.data() + done, text.size() - done, static_cast<off_t>(at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(std::generic_category().message(errno));
    if (got == 0) fail("the file ends too early");
    done += static_cast<std::size_t>(got);
  }
  return text;
}

void TileBuildings::read_entries(std::uint64_t size) {
  for (std::uint64_t at = 0; at < size;) {
    if (size - at < sizeof(BuildingSizes)) fail("the file ends too early");
    BuildingSizes sizes;
    const std::string text = read(at, sizeof sizes);
    detail::ByteReader(text).get(sizes);
    at += sizeof sizes;
    if (sizes.head > size - at || sizes.meshes > size - at - sizes.head)
      fail("the file ends too early");
    read_head(read(at, sizes.head), at + sizes.head);
    at += sizes.head + sizes.meshes;
  }
}

void TileBuildings::read_head(std::string_view text, std::uint64_t meshes_at) {
  detail::ByteReader head(text);
  TileEntry entry;
  head.get(entry.id);
  head.get(entry.crs);
  head.get(entry.origin_m);
  head.get(entry.mesh_at);
  head.get(entry.error_m);
  head.get(entry.meshes);
  for (TileEntry::Stored& stored : entry.meshes) stored.at += meshes_at;
  get_names(head, labels_);
  get_names(head, surfaces_);
  bool has_colour = false;
  head.get(has_colour);
  has_colours_ |= has_colour;
  entries_.push_back(std::move(entry));
}

FlatMesh TileBuildings::mesh(const TileEntry::Stored& stored) const {
  try {
    return detail::flat_mesh_of(read(stored.at, stored.bytes));
  } catch (const std::runtime_error& fault) {
    fail(fault.what());
  }
}

}  // namespace oriel
