#include "kernel/base/sha256.h"

#include <string>
#include <string_view>

#include <doctest/doctest.h>

using oriel::sha256;
using oriel::Sha256;

TEST_SUITE("model") {
  TEST_CASE("digests are those of the standard") {
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(sha256(std::string(1'000'000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  }

  TEST_CASE("bytes that come piece by piece have the digest of the whole") {
    std::string text;
    for (int i = 0; i < 300; ++i) text += static_cast<char>('a' + i % 26);
    for (const std::size_t first : {0, 1, 55, 56, 63, 64, 65, 128, 299, 300})
      for (const std::size_t step : {1, 63, 64, 65}) {
        CAPTURE(first);
        CAPTURE(step);
        Sha256 hash;
        hash.add(std::string_view(text).substr(0, first));
        CHECK(hash.digest() == sha256(std::string_view(text).substr(0, first)));
        for (std::size_t at = first; at < text.size(); at += step)
          hash.add(std::string_view(text).substr(at, step));
        CHECK(hash.digest() == sha256(text));
        CHECK(hash.bytes() == text.size());
      }
  }
}
