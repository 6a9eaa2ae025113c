#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace oriel::detail {

/// The binary chunk of a GLB and the descriptions of what is in it.
class GlbBuffers {
 public:
  /// What a buffer view is for, as WebGL numbers it.
  enum class ViewTarget { none = 0, vertices = 34962, indices = 34963 };
  /// The type of the numbers, likewise.
  enum class NumberType { byte_u = 5121, short_u = 5123, int_u = 5125, single = 5126 };

  /// Appends bytes, from a multiple of eight on, and returns the number of their view. `stride`:
  /// how far vertices are apart; 0: no view of vertices.
  int add_view(std::string_view bytes, ViewTarget target, std::size_t stride = 0);

  /// Adds an accessor over a view and returns its number. `more` are further members.
  int add_accessor(int view, NumberType component, const char* type, std::size_t count,
                   nlohmann::ordered_json more = nlohmann::ordered_json::object());

  [[nodiscard]] const nlohmann::ordered_json& views() const { return views_; }
  [[nodiscard]] const nlohmann::ordered_json& accessors() const { return accessors_; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
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
