#pragma once

#include <string>
#include <vector>

namespace oriel::test {

/// A minimal file with one error.
struct ErrorFile {
  /// `CODE_NUMBER.city.json`: oriel's code and val3dity's number, 000 where there is none.
  std::string name;
  std::string text;
};

/// What tests/data/errors holds, beside `valid.city.json`: one file for each error that validate
/// finds, mostly a cube of 4 m with that error and no other.
std::vector<ErrorFile> error_files();

}  // namespace oriel::test
