#pragma once

#include "interpret/yaml/yaml_scan.h"

#include <cstddef>
#include <vector>

namespace oriel::rules {

/// Reads maps and lists in { } and [ ], which may go over lines, up to what is wrong in them.
class YamlBrackets {
 public:
  explicit YamlBrackets(YamlScan& scan) : scan_(&scan) {}

  [[nodiscard]] bool are_open() const { return !brackets_.empty(); }
  /// Reads on from `at` in the line at hand. Returns where what follows the outermost bracket
  /// begins; kNowhere if it is open at the end of the line, or there is a fault.
  std::size_t read(std::size_t at);
  /// The innermost is never closed: its text ends at `end`.
  void report_open(std::size_t end);

 private:
  /// A { or [ that is open, and what was read of the entry at hand.
  struct OpenBracket {
    std::size_t offset = 0;
    char closes_by = '}';
    bool has_colon = false;
    /// A text or bracket has ended: a comma or a colon must follow.
    bool is_complete = false;
    bool is_plain = false;  ///< what has ended is a text without quotes
    std::size_t value_begin = kNowhere;
    std::size_t value_end = kNowhere;

    void begin_entry() {
      has_colon = is_complete = is_plain = false;
      value_begin = value_end = kNowhere;
    }
  };

  std::size_t read_in_brackets(std::size_t at);
  std::size_t read_close(std::size_t at);
  std::size_t read_open(std::size_t at);
  std::size_t read_quoted(std::size_t at);
  std::size_t read_plain(std::size_t at);
  std::size_t read_colon(std::size_t at);
  [[nodiscard]] std::size_t end_of_entry(std::size_t at) const;
  void report_missing_comma(std::size_t at);

  YamlScan* scan_;
  std::vector<OpenBracket> brackets_;
};

}  // namespace oriel::rules
