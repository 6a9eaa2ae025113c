#include "io/cityjson/id_set.h"

#include <utility>

namespace oriel {

namespace {

constexpr std::size_t kFirstSlots = 1024;  // a power of two

/// splitmix64's finaliser.
std::uint64_t mixed(std::uint64_t hash) {
  hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
  return hash ^ (hash >> 31U);
}

}  // namespace

std::size_t IdSet::slot_of(const Key& key) const {
  std::size_t slot = key[0] & (slots_.size() - 1);
  while (slots_[slot] != Key{} && slots_[slot] != key) slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

void IdSet::grow() {
  const std::vector<Key> old =
      std::exchange(slots_, std::vector<Key>(slots_.empty() ? kFirstSlots : 2 * slots_.size()));
  for (const Key& key : old)
    if (key != Key{}) slots_[slot_of(key)] = key;
}

bool IdSet::insert(std::string_view id) {
  if (2 * (count_ + 1) > slots_.size()) grow();
  // FNV-1a twice, from two starts and with two odd factors.
  Key key{0xcbf29ce484222325U, 0x9e3779b97f4a7c15U};
  for (const char byte : id) {
    key[0] = (key[0] ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    key[1] = mixed(key[1] + static_cast<unsigned char>(byte));
  }
  key = {mixed(key[0]), key[1] | 1U};  // never a free slot
  Key& slot = slots_[slot_of(key)];
  if (slot == key) return false;
  slot = key;
  ++count_;
  return true;
}

}  // namespace oriel
