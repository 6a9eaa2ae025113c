#include "examples/generator/output/output.h"

#include <system_error>
#include <utility>

namespace oriel::generator {

OutputFile::OutputFile(std::filesystem::path path)
    : path_(std::move(path)), part_(path_.string() + ".part") {
  stream_.open(part_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail();
}

OutputFile::~OutputFile() {
  if (is_finished_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputFile::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream_) fail();
}

void OutputFile::finish() {
  stream_.close();
  std::error_code error;
  if (stream_) std::filesystem::rename(part_, path_, error);
  if (!stream_ || error) fail();
  is_finished_ = true;
}

void OutputFile::fail() const { throw OutputError("cannot write " + path_.string()); }

}  // namespace oriel::generator
