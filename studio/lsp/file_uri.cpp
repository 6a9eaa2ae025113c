#include "studio/lsp/file_uri.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

std::optional<int> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

bool is_plain_in_uri(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-._~/").find(c) != std::string_view::npos;
}

}  // namespace

std::string path_of_uri(std::string_view uri) {
  constexpr std::string_view kScheme = "file://";
  if (!uri.starts_with(kScheme)) return std::string(uri);
  std::string_view rest = uri.substr(kScheme.size());
  // The host, which is empty or this one.
  rest.remove_prefix(std::min(rest.find('/'), rest.size()));
  std::string path;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const auto high = rest[i] == '%' && i + 2 < rest.size() ? hex_digit(rest[i + 1]) : std::nullopt;
    const auto low = high ? hex_digit(rest[i + 2]) : std::nullopt;
    if (low) i += 2;
    path += low ? static_cast<char>(*high * 16 + *low) : rest[i];
  }
  // What no file can be called means no file.
  return path.find('\0') == std::string::npos ? path : std::string(uri);
}

std::string uri_of_path(std::string_view path) {
  std::string uri = "file://";
  for (const char c : path)
    uri += is_plain_in_uri(c) ? std::string(1, c)
                              : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return uri;
}

}  // namespace oriel::studio
