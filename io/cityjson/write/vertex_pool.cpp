#include "io/cityjson/write/vertex_pool.h"

#include "io/cityjson/write/geometry_text.h"
#include "io/json/raw_json.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// No coarser than this: what surveys are written in. The factor allows for scales such as
/// 1.0000001e-3.
constexpr double kCoarsest_m = 1.01 * 0.001;

double coarsest_scale(const Transform& transform) {
  return std::max({transform.scale.x, transform.scale.y, transform.scale.z});
}

/// The whole number `text` times 10^digits, as text; other text stays.
std::string grown(std::string_view text, int digits) {
  std::string number(text);
  if (number.find_first_of(".eE") != std::string::npos)
    number = fmt::format("{:.0f}", std::strtod(number.c_str(), nullptr));
  if (number.find_first_not_of("-0") != std::string::npos)
    number.append(static_cast<std::size_t>(digits), '0');
  return number;
}

/// The integers of a vertex's text, or nothing.
std::optional<std::array<std::int64_t, 3>> key_of(std::string_view vertex) {
  std::array<std::int64_t, 3> key{};
  std::size_t count = 0;
  bool is_good = RawNode::is_array(vertex);
  const auto read = [&](std::string_view number) {
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(),
                                              key[std::min<std::size_t>(count++, 2)]);
    is_good = is_good && error == std::errc() && end == number.data() + number.size();
  };
  if (is_good) for_each_element(vertex, read);
  if (!is_good || count != 3) return std::nullopt;
  return key;
}

std::string vertex_text(std::string_view vertex, int digits) {
  if (digits == 0 || !RawNode::is_array(vertex)) return std::string(vertex);
  std::string text = "[";
  for_each_element(vertex, [&](std::string_view number) {
    if (text.size() > 1) text += ',';
    text += grown(number, digits);
  });
  return text + "]";
}

}  // namespace

Transform finer(const Transform& transform, int digits) {
  const Vec3 s = transform.scale;
  return {{scaled_down(s.x, digits), scaled_down(s.y, digits), scaled_down(s.z, digits)},
          transform.translate};
}

std::array<std::int64_t, 3> rounded(Vec3 local, const Frame& frame, const Transform& transform) {
  const Vec3 from = local - (transform.translate - frame.origin_m);
  return {std::llround(from.x / transform.scale.x), std::llround(from.y / transform.scale.y),
          std::llround(from.z / transform.scale.z)};
}

Vec3 local_point(const std::array<std::int64_t, 3>& key, const Frame& frame,
                 const Transform& transform) {
  const Vec3 s = transform.scale;
  return (transform.translate - frame.origin_m) + Vec3{s.x * static_cast<double>(key[0]),
                                                       s.y * static_cast<double>(key[1]),
                                                       s.z * static_cast<double>(key[2])};
}

double scaled_down(double number, int digits) {
  std::array<char, 48> buffer;
  char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                  std::chars_format::scientific)
                        .ptr;
  const std::string text(buffer.data(), end);
  const std::size_t e = text.find('e');
  const int exponent = std::stoi(text.substr(e + 1)) - digits;
  return std::stod(text.substr(0, e + 1) + std::to_string(exponent));
}

int finer_digits(const Transform& transform) {
  int digits = 0;
  while (coarsest_scale(finer(transform, digits)) > kCoarsest_m) ++digits;
  return digits;
}

FileVertices::FileVertices(std::string_view vertices, const Transform& transform, int digits)
    : transform_(finer(transform, digits)), digits_(digits) {
  for_each_element(vertices, [&](std::string_view vertex) { there_.push_back(vertex); });
  slots_.assign(std::bit_ceil(2 * there_.size() + 2), -1);
  for (std::size_t i = 0; i < there_.size(); ++i)
    if (const auto key = key_at(i)) enter(static_cast<int>(i), *key);
  is_used_.resize(there_.size());
}

std::string FileVertices::text_of(std::size_t number) const {
  if (number < there_.size()) return vertex_text(there_[number], digits_);
  std::string text;
  append_json_array(text, added_[number - there_.size()]);
  return text;
}

std::optional<FileVertices::Key> FileVertices::key_at(std::size_t number) const {
  if (number >= there_.size()) return added_[number - there_.size()];
  return digits_ == 0 ? key_of(there_[number]) : key_of(text_of(number));
}

/// Where the vertex with this key is, or would be.
std::size_t FileVertices::slot_of(const Key& key) const {
  std::uint64_t hash = 0;
  for (const std::int64_t value : key)
    hash = (hash ^ static_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ULL;
  std::size_t slot = (hash ^ (hash >> 32U)) & (slots_.size() - 1);
  const auto is_other = [&](int number) { return key_at(static_cast<std::size_t>(number)) != key; };
  while (slots_[slot] >= 0 && is_other(slots_[slot])) slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

/// The first vertex with a key stands for all.
void FileVertices::enter(int number, const Key& key) {
  int& slot = slots_[slot_of(key)];
  if (slot >= 0) return;
  slot = number;
  if (2 * ++taken_ <= slots_.size()) return;
  const std::vector<int> old = std::exchange(slots_, std::vector<int>(2 * slots_.size(), -1));
  for (const int there : old)
    if (there >= 0) slots_[slot_of(*key_at(static_cast<std::size_t>(there)))] = there;
}

std::vector<int> FileVertices::add(const PlacedSolid& placed) {
  std::vector<int> numbers;
  for (const Vertex& vertex : placed.solid->vertices) {
    const Key key = rounded(vertex.point, *placed.frame, transform_);
    numbers.push_back(slots_[slot_of(key)]);
    if (numbers.back() >= 0) continue;
    numbers.back() = static_cast<int>(is_used_.size());
    added_.push_back(key);
    is_used_.push_back(false);
    enter(numbers.back(), key);
  }
  return numbers;
}

void FileVertices::mark_used(std::string_view object) {
  for_each_boundaries(object, [&](std::string_view array) {
    for_each_number(array, [&](std::size_t, std::size_t, std::size_t number) {
      if (number < is_used_.size()) is_used_[number] = true;
    });
  });
}

void FileVertices::renumber() {
  slots_ = std::vector<int>();
  new_number_.assign(is_used_.size(), -1);
  int next = 0;
  for (std::size_t i = 0; i < is_used_.size(); ++i)
    if (is_used_[i]) new_number_[i] = next++;
}

std::string FileVertices::renumbered(std::string_view object) const {
  return with_vertex_numbers(object, [&](std::size_t number) {
    const bool is_known = number < new_number_.size();
    return is_known ? new_number_[number] : static_cast<std::int64_t>(number);
  });
}

std::string FileVertices::text() const {
  std::string text = "[";
  for (std::size_t i = 0; i < is_used_.size(); ++i) {
    if (!is_used_[i]) continue;
    if (text.size() > 1) text += ',';
    text += text_of(i);
  }
  return text + "]";
}

}  // namespace oriel::detail
