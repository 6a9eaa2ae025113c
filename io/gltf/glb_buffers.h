#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace oriel::detail {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// The binary chunk of a GLB and the descriptions of what is in it.
class GlbBuffers {
 public:
  /// What a buffer view is for, as WebGL numbers it.
  enum class ViewTarget { none = 0, vertices = 34962, indices = 34963 };
  /// The type of the numbers, likewise.
  enum class NumberType { byte_u = 5121, short_u = 5123, int_u = 5125, single = 5126 };

  /// With `compresses`, views of vertices and indices are compressed where that makes the file
  /// smaller (EXT_meshopt_compression), so that decoders give back the same bytes.
  explicit GlbBuffers(bool compresses = false) : compresses_(compresses) {}

  /// Appends bytes, from a multiple of eight on, and returns the number of their view. `stride`:
  /// how far vertices or indices are apart; 0: the view has neither.
  int add_view(std::string_view bytes, ViewTarget target, std::size_t stride = 0);

  /// Adds an accessor over a view and returns its number. `more` are further members.
  int add_accessor(int view, NumberType component, const char* type, std::size_t count,
                   nlohmann::ordered_json more = nlohmann::ordered_json::object());

  [[nodiscard]] const nlohmann::ordered_json& views() const { return views_; }
  [[nodiscard]] const nlohmann::ordered_json& accessors() const { return accessors_; }
  /// The bytes, and what those that are compressed become.
  [[nodiscard]] nlohmann::ordered_json buffers() const;
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  /// The extension is needed to read some view.
  [[nodiscard]] bool has_compressed() const { return decoded_bytes_ > 0; }

 private:
  [[nodiscard]] bool add_compressed(std::string_view bytes, ViewTarget target, std::size_t stride,
                                    nlohmann::ordered_json& view);

  bool compresses_;
  std::string bytes_;
  /// Of all that are compressed.
  std::size_t decoded_bytes_ = 0;
  nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
};

/// The bytes of numbers, one behind the other.
template <class Numbers>
std::string_view bytes_of(const Numbers& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()),
          numbers.size() * sizeof(typename Numbers::value_type)};
}

/// The two chunks as a file. Throws std::length_error if it would be larger than 4 GB.
std::string glb_file(const nlohmann::ordered_json& head, const std::string& bytes);

}  // namespace oriel::detail
