#include "io/gltf/glb_buffers.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <meshoptimizer.h>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

namespace oriel::detail {

using nlohmann::ordered_json;

namespace {

/// The versions that the extension asks for are states of the whole program.
void choose_versions() {
  static std::once_flag is_chosen;
  std::call_once(is_chosen, [] {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
  });
}

unsigned char* start_of(std::string& bytes) {
  return reinterpret_cast<unsigned char*>(bytes.data());
}

/// Bytes of vertices, `stride` bytes each (a multiple of four, 256 at most), as the glTF extension
/// EXT_meshopt_compression has them in mode ATTRIBUTES, without a filter: decoders give back the
/// same bytes.
std::string meshopt_vertices(std::string_view bytes, std::size_t stride) {
  choose_versions();
  const std::size_t count = bytes.size() / stride;
  std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
  out.resize(meshopt_encodeVertexBuffer(start_of(out), out.size(), bytes.data(), count, stride));
  return out;
}

/// Numbers of vertices, of `stride` bytes each (2 or 4), in mode INDICES: decoders give back the
/// same bytes, which mode TRIANGLES does not promise.
std::string meshopt_indices(std::string_view bytes, std::size_t stride) {
  choose_versions();
  std::vector<unsigned int> numbers(bytes.size() / stride);  // little-endian, as glTF
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::memcpy(&numbers[i], bytes.data() + i * stride, stride);
  const unsigned int most = numbers.empty() ? 0 : *std::ranges::max_element(numbers);
  std::string out(meshopt_encodeIndexSequenceBound(numbers.size(), std::size_t{most} + 1), '\0');
  out.resize(
      meshopt_encodeIndexSequence(start_of(out), out.size(), numbers.data(), numbers.size()));
  return out;
}

/// EXT_structural_metadata wants its views at multiples of eight; for the others four would do.
constexpr std::size_t kAlignment = 8;

/// What it takes to say that a view is compressed, and that a file has such views, at most.
constexpr std::size_t kDescription = 400;

void pad(std::string& bytes, std::size_t to, char with) {
  while (bytes.size() % to != 0) bytes += with;
}

void pad_count(std::size_t& count, std::size_t to) { count = (count + to - 1) / to * to; }

void append_number(std::string& bytes, std::size_t number) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>((number >> (8 * i)) & 0xFFU);
}

void append_chunk(std::string& file, std::string_view kind, const std::string& bytes) {
  append_number(file, bytes.size());
  file += kind;
  file += bytes;
}

}  // namespace

int GlbBuffers::add_view(std::string_view bytes, ViewTarget target, std::size_t stride) {
  pad(bytes_, kAlignment, '\0');
  ordered_json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
  if (target == ViewTarget::vertices) view["byteStride"] = stride;
  if (target != ViewTarget::none) view["target"] = static_cast<int>(target);
  if (!add_compressed(bytes, target, stride, view)) bytes_ += bytes;
  views_.push_back(std::move(view));
  return static_cast<int>(views_.size()) - 1;
}

bool GlbBuffers::add_compressed(std::string_view bytes, ViewTarget target, std::size_t stride,
                                ordered_json& view) {
  if (!compresses_ || target == ViewTarget::none) return false;
  const bool is_vertices = target == ViewTarget::vertices;
  const std::string smaller =
      is_vertices ? meshopt_vertices(bytes, stride) : meshopt_indices(bytes, stride);
  if (smaller.size() + kDescription >= bytes.size()) return false;
  pad_count(decoded_bytes_, kAlignment);
  view["buffer"] = 1;
  view["byteOffset"] = decoded_bytes_;
  view["extensions"][kMeshoptExtension] = {{"buffer", 0},
                                           {"byteOffset", bytes_.size()},
                                           {"byteLength", smaller.size()},
                                           {"byteStride", stride},
                                           {"count", bytes.size() / stride},
                                           {"mode", is_vertices ? "ATTRIBUTES" : "INDICES"}};
  decoded_bytes_ += bytes.size();
  bytes_ += smaller;
  return true;
}

ordered_json GlbBuffers::buffers() const {
  ordered_json all = ordered_json::array({{{"byteLength", bytes_.size()}}});
  if (has_compressed())
    all.push_back({{"byteLength", decoded_bytes_},
                   {"extensions", {{kMeshoptExtension, {{"fallback", true}}}}}});
  return all;
}

int GlbBuffers::add_accessor(int view, NumberType component, const char* type, std::size_t count,
                             ordered_json more) {
  ordered_json accessor{{"bufferView", view},
                        {"componentType", static_cast<int>(component)},
                        {"count", count},
                        {"type", type}};
  accessor.update(more);
  accessors_.push_back(std::move(accessor));
  return static_cast<int>(accessors_.size()) - 1;
}

std::string glb_file(const ordered_json& head, const std::string& bytes) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  std::string text = head.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  pad(text, 4, ' ');
  std::string padded = bytes;
  pad(padded, 4, '\0');
  const std::size_t size =
      kHeader + kChunkHeader + text.size() + (padded.empty() ? 0 : kChunkHeader + padded.size());
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("a GLB has 4 GB at most");
  std::string file = "glTF";
  file.reserve(size);
  append_number(file, 2);
  append_number(file, size);
  append_chunk(file, "JSON", text);
  if (!padded.empty()) append_chunk(file, std::string_view("BIN\0", 4), padded);
  return file;
}

}  // namespace oriel::detail
