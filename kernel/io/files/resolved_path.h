#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace oriel::detail {

/// `path` in full with links resolved, the same whether the file is there yet or not.
inline std::string resolved(const std::string& path) {
  std::error_code error;
  const auto full = std::filesystem::absolute(path, error);
  if (error) return path;
  const auto target = std::filesystem::weakly_canonical(full, error);
  return error ? path : target.string();
}

}  // namespace oriel::detail
