#include "image/picture_ring.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/error.h"

namespace careen {

PictureRing::PictureRing(std::int64_t places, std::size_t pictureBytes)
    : places_(places), pictureBytes_(pictureBytes) {
  if (places_ == 0) {
    return;
  }
  void* const memory = mmap(nullptr, static_cast<std::size_t>(places_) * pictureBytes_,
                            PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) {
    throw MachineError("no memory for " + std::to_string(places_) + " pictures of " +
                       std::to_string(pictureBytes_) + " bytes: " + std::strerror(errno));
  }
  bytes_ = static_cast<std::uint8_t*>(memory);
}

PictureRing::~PictureRing() {
  if (bytes_ != nullptr) {
    munmap(bytes_, static_cast<std::size_t>(places_) * pictureBytes_);
  }
}

std::span<std::uint8_t> PictureRing::operator[](std::int64_t index) const {
  return {bytes_ + static_cast<std::size_t>(index % places_) * pictureBytes_, pictureBytes_};
}

}  // namespace careen
