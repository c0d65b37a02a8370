#pragma once

#include "core/math/Types.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

/// \file Numbering.h
/// A hash table that counts.

namespace vantage
{

/// Numbers distinct keys from 0 on, in the order in which they first come up. `Hash` turns a key
/// into 64 bits of which the lowest are well mixed. Open addressing, O(1) a key.
template <typename Key, typename Hash>
class Numbering
{
public:
  /// More keys than expected only cost time.
  explicit Numbering(std::size_t expectedKeys)
  {
    std::size_t slots = 4;
    while (2 * slots < 3 * expectedKeys)
    {
      slots *= 2;
    }
    this->Slots.assign(slots, Free);
  }

  std::uint32_t Of(const Key& key)
  {
    std::size_t slot = this->SlotOf(key);
    if (this->Slots[slot] == Free)
    {
      if (3 * (this->Numbered.size() + 1) > 2 * this->Slots.size())
      {
        this->Grow();
        slot = this->SlotOf(key);
      }
      this->Slots[slot] = static_cast<std::uint32_t>(this->Numbered.size());
      this->Numbered.push_back(key);
    }
    return this->Slots[slot];
  }

  const std::vector<Key>& Keys() const { return this->Numbered; }

private:
  static constexpr std::uint32_t Free = 0xffffffffu;

  /// Where the number of the key is, or is to go.
  std::size_t SlotOf(const Key& key) const
  {
    const std::size_t mask = this->Slots.size() - 1;
    std::size_t slot = Hash()(key) & mask;
    while (this->Slots[slot] != Free && !(this->Numbered[this->Slots[slot]] == key))
    {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  void Grow()
  {
    this->Slots.assign(2 * this->Slots.size(), Free);
    for (std::uint32_t number = 0; number < this->Numbered.size(); ++number)
    {
      this->Slots[this->SlotOf(this->Numbered[number])] = number;
    }
  }

  std::vector<std::uint32_t> Slots; ///< a power of two, a third of them free at least
  std::vector<Key> Numbered;
};

/// A point as a key. \pre no coordinate is -0, which equals 0 but not to the bit
struct HashOfPoint
{
  std::uint64_t operator()(const Vec3& point) const
  {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &point[axis], sizeof(bits));
      hash = (hash ^ bits ^ (bits >> 29)) * 0x9e3779b97f4a7c15ull;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/// For keys that are hashes already.
struct Itself
{
  std::uint64_t operator()(std::uint64_t key) const { return key; }
};

} // namespace vantage
