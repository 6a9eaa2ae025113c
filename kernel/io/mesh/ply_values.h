#pragma once

#include "kernel/io/mesh/ply_header.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace oriel::detail {

/// The values of a PLY file's elements one after the other, in words or in bytes.
class PlyValues {
 public:
  virtual ~PlyValues() = default;

  /// Moves to the next element; false at the end of the file.
  virtual bool next_element() = 0;
  /// The value of a property that is no list; nothing, and what is `wrong`, if there is none.
  virtual std::optional<double> number(const PlyProperty& property, Fault& wrong) = 0;
  /// As number(), for the length of a list, at least 0, or a member of one.
  virtual std::optional<long long> length(const PlyProperty& property, Fault& wrong) = 0;
  virtual std::optional<long long> whole(const PlyProperty& property, Fault& wrong) = 0;
  /// What stands after the last property of an element, or after the last element, and its verb:
  /// "'x' follows".
  virtual std::optional<std::string> rest_of_element() = 0;
  virtual std::optional<std::string> rest_of_file() = 0;
  /// The finding at the value that was read last. `element` says which one it is of: "vertex 3".
  [[nodiscard]] virtual Issue error(const std::string& element, Fault fault) const = 0;
};

/// Those of `text` after `header`. Both must outlive what is returned.
std::unique_ptr<PlyValues> ply_values(std::string_view text, const TextName& name,
                                      const PlyHeader& header);

}  // namespace oriel::detail
