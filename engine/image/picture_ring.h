#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace careen {

/// Room for the pixels of a few pictures that this process shares with those it forks: what one writes there
/// the others read.
class PictureRing {
 public:
  /// Pictures of so many bytes; MachineError if there is no memory for them.
  PictureRing(std::int64_t places, std::size_t pictureBytes);
  ~PictureRing();
  PictureRing(const PictureRing&) = delete;
  PictureRing& operator=(const PictureRing&) = delete;
  PictureRing(PictureRing&&) = delete;
  PictureRing& operator=(PictureRing&&) = delete;

  std::int64_t places() const { return places_; }
  /// The place of picture `index`; it is that of picture index + places, too.
  std::span<std::uint8_t> operator[](std::int64_t index) const;

 private:
  std::int64_t places_;
  std::size_t pictureBytes_;
  std::uint8_t* bytes_ = nullptr;
};

}  // namespace careen
