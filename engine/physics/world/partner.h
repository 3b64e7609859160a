#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace careen {

/// Collision partner of a body, as impacts are recorded: another body or a wall of the world, by its index.
/// Bodies come before walls, each in the order of their indices.
class Partner {
 public:
  constexpr Partner() = default;  ///< wall 0
  static constexpr Partner ofBody(int index) { return Partner(static_cast<std::uint32_t>(index)); }
  static constexpr Partner ofWall(std::size_t index) {
    return Partner(kWall | static_cast<std::uint32_t>(index));
  }

  constexpr bool isWall() const { return (key_ & kWall) != 0; }
  constexpr int body() const { return static_cast<int>(key_); }              ///< only of a body
  constexpr std::size_t wall() const { return std::size_t{key_ & ~kWall}; }  ///< only of a wall
  constexpr bool isBody(int index) const { return *this == ofBody(index); }

  friend constexpr auto operator<=>(const Partner&, const Partner&) = default;

 private:
  static constexpr std::uint32_t kWall = 0x80000000U;
  explicit constexpr Partner(std::uint32_t key) : key_(key) {}

  std::uint32_t key_ = kWall;
};

}  // namespace careen
