#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace careen {

/// A ring buffer for pictures in memory that this process shares with those it forks: all of them see what
/// one of them writes.
class PictureRing {
 public:
  /// `pictureBytes` is the size of one picture; MachineError if there is not enough memory.
  PictureRing(std::int64_t places, std::size_t pictureBytes);
  ~PictureRing();
  PictureRing(const PictureRing&) = delete;
  PictureRing& operator=(const PictureRing&) = delete;
  PictureRing(PictureRing&&) = delete;
  PictureRing& operator=(PictureRing&&) = delete;

  std::int64_t places() const { return places_; }
  /// The slot of picture `index`; picture index + places uses the same slot.
  std::span<std::uint8_t> operator[](std::int64_t index) const;

 private:
  std::int64_t places_;
  std::size_t pictureBytes_;
  std::uint8_t* bytes_ = nullptr;
};

}  // namespace careen
