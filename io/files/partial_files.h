#pragma once

#include "io/files/output_file.h"

#include <cstdint>
#include <map>
#include <string>

namespace oriel {

namespace detail {
/// `path` in full with links resolved, the same whether the file is there yet or not.
std::string resolved(const std::string& path);
}  // namespace detail

/// What is known of an output file up to some place.
struct FileMark {
  std::uint64_t bytes = 0;
  std::uint64_t lines = 0;
  std::string sha256;
  bool operator==(const FileMark&) const = default;
};
using FileMarks = std::map<std::string, FileMark>;  ///< by path

/// The OutputFiles of this process that are regular files, so that a run can be killed and go on.
/// Not for several threads at once.
class PartialFiles {
 public:
  /// From now on files are hashed and their lines counted.
  static void watch();
  /// The same, and a file grows as PATH.partial, which no other process can write meanwhile and
  /// which stays when the program is killed.
  static void go_on();
  /// The same, and it also stays when the program ends otherwise before commit.
  static void keep();
  static bool are_watched();
  static bool can_go_on();
  static bool are_kept();

  /// Makes PATH.partial again what it was at its mark, also where the file has been put in its
  /// place since; OutputFiles that are opened for these paths go on there. False, and nothing is
  /// changed, if a file with those bytes is not there. Throws InputError E101 if one cannot be
  /// read.
  static bool restore(const FileMarks& marks);
  /// Writes what open files hold in memory and returns their marks. Throws OutputError E601.
  static FileMarks flush();
  /// The files that were put in their place since the last call.
  static FileMarks take_done();

  /// The mark of the first `bytes` bytes of a file; of fewer if it is shorter, of none if there is
  /// no such file. Throws InputError E101 if it cannot be read.
  static FileMark mark_of(const std::string& path, std::uint64_t bytes);

 private:
  friend class OutputFile;
  static std::string name_of(const std::string& target);
  static void enter(OutputFile& file);
  static void leave(OutputFile& file);
  static void note_done(const OutputFile& file);
};

}  // namespace oriel
