#include "kernel/io/gltf/meshopt.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <meshoptimizer.h>
#include <mutex>
#include <vector>

namespace oriel::detail {

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

}  // namespace

std::string meshopt_vertices(std::string_view bytes, std::size_t stride) {
  choose_versions();
  const std::size_t count = bytes.size() / stride;
  std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
  out.resize(meshopt_encodeVertexBuffer(start_of(out), out.size(), bytes.data(), count, stride));
  return out;
}

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

}  // namespace oriel::detail
