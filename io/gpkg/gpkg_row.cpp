#include "io/gpkg/gpkg_row.h"

#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

namespace oriel::detail {

namespace {

void put_number(std::string& bytes, std::uint64_t number) {
  bytes.append(std::bit_cast<std::array<char, 8>>(number).data(), 8);
}

void put_number(std::string& bytes, double number) {
  put_number(bytes, std::bit_cast<std::uint64_t>(number));
}

void put_text_bytes(std::string& bytes, std::string_view text) {
  put_number(bytes, text.size());
  bytes += text;
}

void put_value(std::string& bytes, const GpkgValue& value) {
  bytes += static_cast<char>(value.index());
  std::visit(
      [&](const auto& known) {
        using Known = std::decay_t<decltype(known)>;
        if constexpr (std::is_same_v<Known, std::string>)
          put_text_bytes(bytes, known);
        else if constexpr (std::is_same_v<Known, double>)
          put_number(bytes, known);
        else if constexpr (!std::is_same_v<Known, std::monostate>)
          put_number(bytes, static_cast<std::uint64_t>(known));
      },
      value);
}

/// Takes apart what append_row() has put together.
class RowBytes {
 public:
  explicit RowBytes(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t number() {
    std::uint64_t number = 0;
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }
  double real() { return std::bit_cast<double>(number()); }
  std::string text() {
    const std::uint64_t size = number();
    return std::string(take(size));
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
  Vec3 point() {
    const double x = real(), y = real(), z = real();
    return {x, y, z};
  }
  GpkgValue value() {
    switch (byte()) {
      case 1:
        return number() != 0;
      case 2:
        return static_cast<std::int64_t>(number());
      case 3:
        return real();
      case 4:
        return text();
      default:
        return {};
    }
  }

 private:
  std::string_view take(std::uint64_t size) {
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::string_view bytes_;
};

GpkgRow row_of(RowBytes bytes) {
  GpkgRow row;
  row.table = static_cast<GpkgTable>(bytes.byte());
  row.geometry = bytes.text();
  row.box.min = bytes.point();
  row.box.max = bytes.point();
  const std::uint64_t cells = bytes.number();
  for (std::uint64_t i = 0; i < cells; ++i) {
    GpkgCell& cell = row.cells.emplace_back();
    cell.column = bytes.text();
    cell.role = static_cast<GpkgRole>(bytes.byte());
    cell.value = bytes.value();
  }
  return row;
}

}  // namespace

void append_row(std::string& bytes, const GpkgRow& row) {
  std::string own;
  own += static_cast<char>(row.table);
  put_text_bytes(own, row.geometry);
  for (const Vec3 p : {row.box.min, row.box.max})
    for (const double x : {p.x, p.y, p.z}) put_number(own, x);
  put_number(own, row.cells.size());
  for (const GpkgCell& cell : row.cells) {
    put_text_bytes(own, cell.column);
    own += static_cast<char>(cell.role);
    put_value(own, cell.value);
  }
  put_text_bytes(bytes, own);
}

std::size_t for_each_row(std::string_view bytes, const std::function<void(GpkgRow)>& visit) {
  std::size_t taken = 0;
  while (bytes.size() - taken >= sizeof(std::uint64_t)) {
    RowBytes rest(bytes.substr(taken));
    const std::uint64_t size = rest.number();
    if (bytes.size() - taken - sizeof size < size) break;
    visit(row_of(RowBytes(bytes.substr(taken + sizeof size, size))));
    taken += sizeof size + size;
  }
  return taken;
}

}  // namespace oriel::detail
