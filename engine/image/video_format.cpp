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

constexpr std::array<std::string_view, 7> kSuffixes = {".mp4",  ".mkv", ".mov", ".webm",
                                                       ".webp", ".gif", ".apng"};

/// How colours are kept: as luma and chroma, chroma for two by two pixels or for each, or as RGB.
enum class Samples { kYuv420, kYuv444, kRgb };
struct Codec {
  std::string_view name;
  Samples samples;
  bool hasAlpha;
};
constexpr std::array<Codec, 9> kCodecs = {{{"h264", Samples::kYuv420, false},
                                           {"h264-444", Samples::kYuv444, false},
                                           {"vp9", Samples::kYuv420, true},
                                           {"vp9-444", Samples::kYuv444, false},
                                           {"av1", Samples::kYuv420, false},
                                           {"prores", Samples::kYuv444, true},
                                           {"webp", Samples::kRgb, true},
                                           {"gif", Samples::kRgb, false},
                                           {"apng", Samples::kRgb, true}}};

constexpr std::array<std::string_view, 5> kMp4Codecs = {"h264", "h264-444", "vp9", "vp9-444", "av1"};
constexpr std::array<std::string_view, 3> kMovCodecs = {"prores", "h264", "h264-444"};
constexpr std::array<std::string_view, 3> kWebmCodecs = {"vp9", "vp9-444", "av1"};
constexpr std::array<std::string_view, 1> kWebpCodecs = {"webp"};
constexpr std::array<std::string_view, 1> kGifCodecs = {"gif"};
constexpr std::array<std::string_view, 1> kApngCodecs = {"apng"};

struct Container {
  std::string_view muxer;                    // name in ffmpeg
  std::span<const std::string_view> codecs;  // the default first
  std::string_view soundCodec;               // empty: none
  bool hasAlpha;
};
constexpr std::array<Container, kSuffixes.size()> kContainers = {{{"mp4", kMp4Codecs, "aac", false},
                                                                  {"matroska", kMp4Codecs, "aac", true},
                                                                  {"mov", kMovCodecs, "pcm_s16le", true},
                                                                  {"webm", kWebmCodecs, "libopus", true},
                                                                  {"webp", kWebpCodecs, "", true},
                                                                  {"gif", kGifCodecs, "", false},
                                                                  {"apng", kApngCodecs, "", true}}};

// Where chroma is subsampled, width and height are made even: the last column or row comes twice. ffmpeg 9
// tags a film as its frames are, ffmpeg 5 as the options say.
std::string yuvFilter(const VideoSettings& settings, Samples samples) {
  const std::string alpha = settings.alpha ? "a" : "";
  const bool isHalved = samples == Samples::kYuv420;
  std::string toYuv = "scale=out_color_matrix=bt709:out_range=tv,format=yuv" + alpha +
                      (isHalved ? "420p" : "444p10le") +
                      ",setparams=color_primaries=bt709:color_trc=iec61966-2-1";
  const int right = settings.width % 2;
  const int bottom = settings.height % 2;
  if (!isHalved || (right == 0 && bottom == 0)) {
    return toYuv;
  }
  return "format=gbr" + alpha + "p,pad=ceil(iw/2)*2:ceil(ih/2)*2,fillborders=right=" + std::to_string(right) +
         ":bottom=" + std::to_string(bottom) + ":mode=smear," + toYuv;
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

const Codec& codecOf(const VideoSettings& settings) {
  const std::span<const std::string_view> codecs = containerOf(settings).codecs;
  const std::string_view name = settings.codec.empty() ? codecs[0] : std::string_view(settings.codec);
  if (std::find(codecs.begin(), codecs.end(), name) == codecs.end()) {
    throw InputError(settings.path.string() + ": found codec '" + settings.codec + "', expected for " +
                     settings.path.extension().string() + " one of: " + listed(codecs));
  }
  return *std::find_if(kCodecs.begin(), kCodecs.end(), [&](const Codec& each) { return each.name == name; });
}

// By quality: draft, good, best.
Arguments pick(VideoQuality quality, const std::array<Arguments, 3>& choices) {
  return choices.at(static_cast<std::size_t>(quality));
}

Arguments encoderArguments(std::string_view codec, const VideoSettings& settings) {
  const VideoQuality quality = settings.quality;
  if (codec.starts_with("h264")) {
    // aq-mode 3 spares bits least in the dark, and a strength of 1.3 in place of 1 least where little
    // happens: there gradients would show blocks, for a third of the bytes.
    return pick(
        quality,
        {Arguments{"-c:v", "libx264", "-preset", "ultrafast", "-crf", "28"},
         {"-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-aq-mode", "3", "-aq-strength", "1.3"},
         {"-c:v", "libx264", "-preset", "slow", "-crf", "12", "-aq-mode", "3", "-aq-strength", "1.3"}});
  }
  if (codec.starts_with("vp9")) {  // bit rate 0: constant quality
    Arguments arguments = pick(quality, {Arguments{"-deadline", "realtime", "-cpu-used", "8", "-crf", "40"},
                                         {"-deadline", "good", "-cpu-used", "4", "-crf", "24"},
                                         {"-deadline", "good", "-cpu-used", "1", "-crf", "12"}});
    arguments.insert(arguments.begin(), {"-c:v", "libvpx-vp9", "-row-mt", "1", "-b:v", "0"});
    if (settings.alpha) {
      arguments.insert(arguments.end(), {"-auto-alt-ref", "0"});  // it cannot do both
    }
    return arguments;
  }
  if (codec == "av1") {
    return pick(quality, {Arguments{"-c:v", "libsvtav1", "-preset", "12", "-crf", "45"},
                          {"-c:v", "libsvtav1", "-preset", "8", "-crf", "26"},
                          {"-c:v", "libsvtav1", "-preset", "4", "-crf", "14"}});
  }
  if (codec == "prores") {
    Arguments arguments =
        pick(quality, {Arguments{"-qscale:v", "13"}, {"-qscale:v", "9"}, {"-qscale:v", "4"}});
    arguments.insert(arguments.begin(), {"-c:v", "prores_ks", "-profile:v", "4444", "-vendor", "apl0"});
    return arguments;
  }
  if (codec == "webp") {
    Arguments arguments = pick(quality, {Arguments{"-quality", "60", "-compression_level", "1"},
                                         {"-quality", "85", "-compression_level", "4"},
                                         {"-lossless", "1", "-quality", "75", "-compression_level", "4"}});
    arguments.insert(arguments.begin(), {"-c:v", "libwebp_anim", "-loop", "0"});
    return arguments;
  }
  if (codec == "apng") {  // always lossless: only its size differs
    return pick(quality, {Arguments{"-c:v", "apng", "-plays", "0", "-pred", "sub", "-compression_level", "1"},
                          {"-c:v", "apng", "-plays", "0", "-pred", "paeth"},
                          {"-c:v", "apng", "-plays", "0", "-pred", "mixed", "-compression_level", "9"}});
  }
  return {"-c:v", "gif", "-loop", "0"};
}

// WebP converts RGB to its own YUV, which is not BT.709. Every frame of a GIF has its own palette: a common
// palette would keep all frames in memory.
std::string filterOf(const Codec& codec, const VideoSettings& settings) {
  if (codec.name == "webp") {
    return "format=bgra";
  }
  if (codec.name == "apng") {
    return settings.alpha ? "format=rgba" : "format=rgb24";
  }
  if (codec.name == "gif") {
    constexpr std::array<const char*, 3> kDither = {"none", "bayer:bayer_scale=4", "sierra2_4a"};
    const int rate = fallbackRate(settings);
    return (rate > 0 ? "fps=" + std::to_string(rate) + "," : std::string()) +
           std::string("split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=") +
           kDither.at(static_cast<std::size_t>(settings.quality));
  }
  return yuvFilter(settings, codec.samples);
}

template <class Has>
std::string suffixesThat(const Has& has) {
  std::vector<std::string_view> suffixes;
  for (std::size_t i = 0; i < kSuffixes.size(); ++i) {
    if (has(kContainers.at(i))) {
      suffixes.push_back(kSuffixes.at(i));
    }
  }
  return listed(suffixes);
}

}  // namespace

VideoQuality videoQualityNamed(std::string_view name) {
  return static_cast<VideoQuality>(indexAmong(name, kQualities));
}

bool needsEvenSize(const VideoSettings& settings) { return codecOf(settings).samples == Samples::kYuv420; }

int fallbackRate(const VideoSettings& settings) {
  constexpr int kFastestGif = 50;
  return codecOf(settings).name == "gif" && settings.rateNumerator > kFastestGif * settings.rateDenominator
             ? kFastestGif
             : 0;
}

void checkVideo(const VideoSettings& settings) {
  const Codec& codec = codecOf(settings);
  const Container& container = containerOf(settings);
  const std::string found = settings.path.string() + ": found " + settings.path.extension().string();
  if (settings.alpha && !container.hasAlpha) {
    throw InputError(found + ", which has no alpha, expected one of: " +
                     suffixesThat([](const Container& each) { return each.hasAlpha; }));
  }
  if (settings.alpha && !codec.hasAlpha) {
    throw InputError(found + " by codec '" + std::string(codec.name) + "', which has no alpha, expected " +
                     (container.muxer == "mov" ? "prores" : "vp9"));
  }
  if (!settings.sound.empty() && container.soundCodec.empty()) {
    throw InputError(found + ", which has no sound, expected one of: " +
                     suffixesThat([](const Container& each) { return !each.soundCodec.empty(); }));
  }
}

Arguments ffmpegCommand(const VideoSettings& settings, const std::filesystem::path& output,
                        const std::filesystem::path& sound) {
  const Codec& codec = codecOf(settings);
  const Container& container = containerOf(settings);
  const std::string size = std::to_string(settings.width) + "x" + std::to_string(settings.height);
  const std::string rate =
      std::to_string(settings.rateNumerator) + "/" + std::to_string(settings.rateDenominator);
  // -xerror: a failed write, as on a full disk, otherwise ends with status 0 and a truncated film.
  Arguments command = {
      "ffmpeg",      "-nostdin", "-xerror",    "-loglevel", "error",
      "-y",          "-f",       "rawvideo",   "-pix_fmt",  settings.alpha ? "rgba" : "rgb24",
      "-video_size", size,       "-framerate", rate,        "-i",
      "pipe:0"};
  const auto add = [&command](const Arguments& arguments) {
    command.insert(command.end(), arguments.begin(), arguments.end());
  };
  if (!sound.empty()) {
    add({"-i", "file:" + sound.string()});
    add({"-c:a", std::string(container.soundCodec), "-flags:a", "+bitexact"});
    if (container.soundCodec != "pcm_s16le") {
      add({"-b:a", container.soundCodec == "libopus" ? "160k" : "192k"});
    }
  }
  add({"-vf", filterOf(codec, settings)});
  add(encoderArguments(codec.name, settings));
  if (codec.samples != Samples::kRgb) {
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range",
         "tv"});
  }
  add({"-fflags", "+bitexact", "-flags:v", "+bitexact"});
  if (settings.path.extension() == ".mp4") {
    add({"-movflags", "+faststart"});
  }
  add({"-f", std::string(container.muxer), "file:" + output.string()});
  return command;
}

}  // namespace careen
