#include "io/files/gzip.h"

#include <algorithm>
#include <limits>
#include <new>
#include <zlib.h>

namespace oriel {

namespace {

/// The largest window of zlib, and that a gzip header goes before.
constexpr int kGzipWindow = 15 + 16;
constexpr int kMostMemory = 9;
/// "Unknown", in the byte for the system.
constexpr int kNoSystem = 255;

/// A stream of zlib that ends with its scope.
struct DeflateStream : z_stream {
  DeflateStream() : z_stream{} {
    if (deflateInit2(this, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow, kMostMemory,
                     Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::bad_alloc();
  }
  ~DeflateStream() { deflateEnd(this); }
  DeflateStream(const DeflateStream&) = delete;
  DeflateStream& operator=(const DeflateStream&) = delete;
};

}  // namespace

std::string gzip(std::string_view bytes) {
  DeflateStream stream;
  gz_header header{};
  header.os = kNoSystem;
  deflateSetHeader(&stream, &header);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  constexpr std::size_t kMost = std::numeric_limits<uInt>::max();  // that zlib takes at once
  std::size_t read = 0, written = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    const std::size_t part = std::min(bytes.size() - read, kMost);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + read));
    stream.avail_in = static_cast<uInt>(part);
    const std::size_t room = std::min(out.size() - written, kMost);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + written);
    stream.avail_out = static_cast<uInt>(room);
    state = deflate(&stream, read + part == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    read += part - stream.avail_in;
    written += room - stream.avail_out;
  }
  out.resize(written);
  return out;
}

}  // namespace oriel
