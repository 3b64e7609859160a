#include "image/video_format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>

#include "core/error.h"
#include "core/names.h"

namespace careen {
namespace {

using Arguments = std::vector<std::string>;

constexpr std::array<std::string_view, 3> kQualities = {"draft", "good", "best"};

constexpr std::array<std::string_view, 5> kSuffixes = {".mp4", ".mkv", ".webm", ".webp", ".gif"};

constexpr std::array<std::string_view, 3> kVideoCodecs = {"h264", "vp9", "av1"};
constexpr std::array<std::string_view, 2> kWebmCodecs = {"vp9", "av1"};
constexpr std::array<std::string_view, 1> kWebpCodecs = {"webp"};
constexpr std::array<std::string_view, 1> kGifCodecs = {"gif"};

struct Container {
  std::string_view muxer;                    // name in ffmpeg
  std::span<const std::string_view> codecs;  // the default first
};
constexpr std::array<Container, kSuffixes.size()> kContainers = {{{"mp4", kVideoCodecs},
                                                                  {"matroska", kVideoCodecs},
                                                                  {"webm", kWebmCodecs},
                                                                  {"webp", kWebpCodecs},
                                                                  {"gif", kGifCodecs}}};

// Chroma is subsampled, so width and height are made even: the last column or row comes twice. ffmpeg 9 tags
// a film as its frames are, ffmpeg 5 as the options say.
std::string yuvFilter(int width, int height) {
  const std::string toYuv =
      "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p,"
      "setparams=color_primaries=bt709:color_trc=iec61966-2-1";
  if (width % 2 == 0 && height % 2 == 0) {
    return toYuv;
  }
  return "format=gbrp,pad=ceil(iw/2)*2:ceil(ih/2)*2,fillborders=right=" + std::to_string(width % 2) +
         ":bottom=" + std::to_string(height % 2) + ":mode=smear," + toYuv;
}

const Container& containerOf(const VideoSettings& settings) {
  const std::string suffix = settings.path.extension().string();
  const auto* const found = std::find(kSuffixes.begin(), kSuffixes.end(), suffix);
  if (found == kSuffixes.end()) {
    throw InputError(settings.path.string() + ": found a video's name that ends in '" + suffix +
                     "', expected one of: " + listed(kSuffixes));
  }
  return kContainers.at(static_cast<std::size_t>(found - kSuffixes.begin()));
}

std::string codecOf(const VideoSettings& settings) {
  const std::span<const std::string_view> codecs = containerOf(settings).codecs;
  if (settings.codec.empty()) {
    return std::string(codecs[0]);
  }
  if (std::find(codecs.begin(), codecs.end(), settings.codec) == codecs.end()) {
    throw InputError(settings.path.string() + ": found codec '" + settings.codec + "', expected for " +
                     settings.path.extension().string() + " one of: " + listed(codecs));
  }
  return settings.codec;
}

// By quality: draft, good, best.
Arguments pick(VideoQuality quality, const std::array<Arguments, 3>& choices) {
  return choices.at(static_cast<std::size_t>(quality));
}

Arguments encoderArguments(const std::string& codec, VideoQuality quality) {
  if (codec == "h264") {
    // aq-mode 3 spares bits least in the dark, and a strength of 1.3 in place of 1 least where little
    // happens: there gradients would show blocks, for a third of the bytes.
    return pick(
        quality,
        {Arguments{"-c:v", "libx264", "-preset", "ultrafast", "-crf", "28"},
         {"-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-aq-mode", "3", "-aq-strength", "1.3"},
         {"-c:v", "libx264", "-preset", "slow", "-crf", "12", "-aq-mode", "3", "-aq-strength", "1.3"}});
  }
  if (codec == "vp9") {  // bit rate 0: constant quality
    Arguments arguments = pick(quality, {Arguments{"-deadline", "realtime", "-cpu-used", "8", "-crf", "40"},
                                         {"-deadline", "good", "-cpu-used", "4", "-crf", "24"},
                                         {"-deadline", "good", "-cpu-used", "1", "-crf", "12"}});
    arguments.insert(arguments.begin(), {"-c:v", "libvpx-vp9", "-row-mt", "1", "-b:v", "0"});
    return arguments;
  }
  if (codec == "av1") {
    return pick(quality, {Arguments{"-c:v", "libsvtav1", "-preset", "12", "-crf", "45"},
                          {"-c:v", "libsvtav1", "-preset", "8", "-crf", "26"},
                          {"-c:v", "libsvtav1", "-preset", "4", "-crf", "14"}});
  }
  if (codec == "webp") {
    Arguments arguments = pick(quality, {Arguments{"-quality", "60", "-compression_level", "1"},
                                         {"-quality", "85", "-compression_level", "4"},
                                         {"-lossless", "1", "-quality", "75", "-compression_level", "4"}});
    arguments.insert(arguments.begin(), {"-c:v", "libwebp_anim", "-loop", "0"});
    return arguments;
  }
  return {"-c:v", "gif", "-loop", "0"};
}

// WebP converts RGB to its own YUV, which is not BT.709. Every frame of a GIF has its own palette: a common
// palette would keep all frames in memory.
std::string filterOf(const std::string& codec, const VideoSettings& settings) {
  if (codec == "webp") {
    return "format=bgra";
  }
  if (codec == "gif") {
    constexpr std::array<const char*, 3> kDither = {"none", "bayer:bayer_scale=4", "sierra2_4a"};
    return std::string("split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=") +
           kDither.at(static_cast<std::size_t>(settings.quality));
  }
  return yuvFilter(settings.width, settings.height);
}

}  // namespace

VideoQuality videoQualityNamed(std::string_view name) {
  return static_cast<VideoQuality>(indexAmong(name, kQualities));
}

bool needsEvenSize(const VideoSettings& settings) {
  const std::string codec = codecOf(settings);
  return codec != "webp" && codec != "gif";
}

void checkVideo(const VideoSettings& settings) {
  // GIF times are in hundredths of a second, and players replace delays below two of them by ten.
  if (codecOf(settings) == "gif" && settings.rateNumerator > 50 * settings.rateDenominator) {
    throw InputError(settings.path.string() + ": found " + std::to_string(settings.rateNumerator) + "/" +
                     std::to_string(settings.rateDenominator) +
                     " frames per second, expected at most 50 for a GIF");
  }
  if (!settings.sound.empty() && !needsEvenSize(settings)) {
    throw InputError(settings.path.string() + ": found " + settings.path.extension().string() +
                     ", which has no sound, expected .mp4, .mkv or .webm for a film with sound");
  }
}

Arguments ffmpegCommand(const VideoSettings& settings, const std::filesystem::path& output,
                        const std::filesystem::path& sound) {
  const std::string codec = codecOf(settings);
  const std::string size = std::to_string(settings.width) + "x" + std::to_string(settings.height);
  const std::string rate =
      std::to_string(settings.rateNumerator) + "/" + std::to_string(settings.rateDenominator);
  // -xerror: a failed write, as on a full disk, otherwise ends with status 0 and a truncated film.
  Arguments command = {"ffmpeg",     "-nostdin", "-xerror",  "-loglevel", "error",       "-y",
                       "-f",         "rawvideo", "-pix_fmt", "rgb24",     "-video_size", size,
                       "-framerate", rate,       "-i",       "pipe:0"};
  const auto add = [&command](const Arguments& arguments) {
    command.insert(command.end(), arguments.begin(), arguments.end());
  };
  if (!sound.empty()) {
    add({"-i", "file:" + sound.string()});
    add(settings.path.extension() == ".webm" ? Arguments{"-c:a", "libopus", "-b:a", "160k"}
                                             : Arguments{"-c:a", "aac", "-b:a", "192k"});
    add({"-flags:a", "+bitexact"});
  }
  add({"-vf", filterOf(codec, settings)});
  add(encoderArguments(codec, settings.quality));
  if (needsEvenSize(settings)) {
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range",
         "tv"});
  }
  add({"-fflags", "+bitexact", "-flags:v", "+bitexact"});
  if (settings.path.extension() == ".mp4") {
    add({"-movflags", "+faststart"});
  }
  add({"-f", std::string(containerOf(settings).muxer), "file:" + output.string()});
  return command;
}

}  // namespace careen
