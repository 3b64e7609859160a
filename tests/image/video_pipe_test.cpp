#include "image/video_pipe.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>

#include <csignal>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "pictures.h"
#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

void write(VideoPipe& pipe, const Picture& picture) {
  for (std::size_t sent = 0; sent < picture.rgb.size();) {
    pollfd writable{.fd = pipe.descriptor(), .events = POLLOUT, .revents = 0};
    poll(&writable, 1, -1);
    sent += pipe.write(std::span(picture.rgb).subspan(sent));
  }
}

void film(const VideoSettings& settings, int frames) {
  VideoPipe pipe(settings);
  for (int frame = 0; frame < frames; ++frame) {
    write(pipe, shadedTiles(settings.width, settings.height, static_cast<unsigned>(frame)));
  }
  pipe.finish();
}

std::string errorOf(const VideoSettings& settings, int frames) {
  try {
    film(settings, frames);
  } catch (const MachineError& error) {
    return error.what();
  }
  return {};
}

std::string probe(const TemporaryFolder& folder, const std::string& entries,
                  const std::string& name = "film.mp4") {
  const Ended ended = Process({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v",
                               "-show_entries", "stream=" + entries, "-of", "csv=p=0", name},
                              folder.path())
                          .wait();
  return ended.out + ended.err;
}

TEST(VideoPipe, makesAFilmOfTheExactRateThatPlaysWhileItLoads) {
  const TemporaryFolder folder;
  film({.path = folder / "film.mp4",
        .width = 64,
        .height = 48,
        .rateNumerator = 24000,
        .rateDenominator = 1001},
       5);
  EXPECT_EQ(probe(folder, "codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames"),
            "h264,64,48,yuv420p,24000/1001,5\n");
  const std::string bytes = textOf(folder / "film.mp4");
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
  EXPECT_EQ(folder.files(), std::vector<std::string>{"film.mp4"});
}

// ffmpeg takes names for options, protocols and patterns of many files.
TEST(VideoPipe, takesANameForANameOnly) {
  for (const std::string name : {"-y.mp4", "|touch made;.mp4", "%03d.mp4", "file:x.mp4", "pipe:1.mp4",
                                 "concat:a|b.mp4", "it's \"so\", and\nso.mp4", "$(touch made).mp4"}) {
    const TemporaryFolder folder;
    film({.path = folder / name, .width = 16, .height = 16}, 2);
    EXPECT_EQ(folder.files(), std::vector<std::string>{name});
  }
}

TEST(VideoPipe, everyKindOfFilmIsMadeAndTellsItsColours) {
  struct Case {
    std::string name;
    std::string codec;
    std::string is;
  };
  const TemporaryFolder folder;
  for (const char* quality : {"draft", "good", "best"}) {
    for (const Case& each : {Case{"h264.mp4", "", "h264"},
                             {"vp9.mp4", "vp9", "vp9"},
                             {"av1.mp4", "av1", "av1"},
                             {"h264.mkv", "", "h264"},
                             {"vp9.webm", "", "vp9"},
                             {"av1.webm", "av1", "av1"}}) {
      film({.path = folder / each.name,
            .codec = each.codec,
            .quality = videoQualityNamed(quality),
            .width = 128,
            .height = 96,
            .rateNumerator = 24000,
            .rateDenominator = 1001},
           5);
      EXPECT_EQ(
          probe(
              folder,
              "codec_name,color_range,color_space,color_transfer,color_primaries,r_frame_rate,nb_read_frames",
              each.name),
          each.is + ",tv,bt709,iec61966-2-1,bt709,24000/1001,5\n")
          << each.name << ' ' << quality;
    }
  }
}

// The frames of an animated picture have the requested rate, up to the resolution of its clock.
TEST(VideoPipe, animatedPicturesAreMade) {
  const TemporaryFolder folder;
  for (const char* quality : {"draft", "good", "best"}) {
    VideoSettings settings{.path = folder / "film.gif",
                           .quality = videoQualityNamed(quality),
                           .width = 65,
                           .height = 49,
                           .rateNumerator = 25};
    film(settings, 5);
    EXPECT_EQ(probe(folder, "codec_name,width,height,r_frame_rate,nb_read_frames", "film.gif"),
              "gif,65,49,25/1,5\n");
    settings.path = folder / "film.webp";
    VideoPipe pipe(settings);
    for (unsigned frame = 0; frame < 5; ++frame) {
      write(pipe, noise(65, 49, frame));  // frames that are too similar would be merged
    }
    pipe.finish();
    const std::string bytes = textOf(folder / "film.webp");
    EXPECT_TRUE(bytes.starts_with("RIFF"));
    int frames = 0;
    for (std::size_t at = bytes.find("ANMF"); at != std::string::npos; at = bytes.find("ANMF", at + 4)) {
      ++frames;
      EXPECT_EQ(static_cast<unsigned char>(bytes[at + 20]), 40);  // [ms]
    }
    EXPECT_EQ(frames, 5);
  }
}

TEST(VideoPipe, oddSizesAreMadeEven) {
  const TemporaryFolder folder;
  film({.path = folder / "film.mp4", .width = 33, .height = 17}, 2);
  EXPECT_EQ(probe(folder, "width,height"), "34,18\n");
}

TEST(VideoPipe, ofAnOddSizeTheLastColumnAndRowComeTwice) {
  const TemporaryFolder folder;
  Picture grey{.width = 33, .height = 17, .rgb = std::vector<std::uint8_t>(33 * 17 * 3, 200)};
  VideoPipe pipe({.path = folder / "film.mkv", .quality = VideoQuality::kBest, .width = 33, .height = 17});
  write(pipe, grey);
  pipe.finish();
  const Ended ended = Process({"ffmpeg", "-nostdin", "-loglevel", "error", "-i", "film.mkv", "-f", "rawvideo",
                               "-pix_fmt", "gray", "back.gray"},
                              folder.path())
                          .wait();
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::string back = textOf(folder / "back.gray");
  ASSERT_EQ(back.size(), 34U * 18);
  // Measured: 0; by 184 with a black border.
  for (const char pixel : back) {
    ASSERT_NEAR(static_cast<unsigned char>(pixel), static_cast<unsigned char>(back[0]), 3);
  }
}

// A picture of one colour, encoded and decoded.
TEST(VideoPipe, keepsColours) {
  const TemporaryFolder folder;
  Picture green{.width = 64, .height = 64, .rgb = {}};
  for (int pixel = 0; pixel < 64 * 64; ++pixel) {
    green.rgb.insert(green.rgb.end(), {40, 200, 90});
  }
  VideoPipe pipe({.path = folder / "film.mp4", .width = 64, .height = 64});
  write(pipe, green);
  pipe.finish();
  const Ended ended =
      Process({"ffmpeg", "-nostdin", "-loglevel", "error", "-i", "film.mp4", "-vf",
               "scale=in_color_matrix=bt709", "-f", "rawvideo", "-pix_fmt", "rgb24", "back.rgb"},
              folder.path())
          .wait();
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::string back = textOf(folder / "back.rgb");
  ASSERT_EQ(back.size(), green.rgb.size());
  constexpr std::size_t kPixel = 2000;
  // Measured: off by 1, 1, 0; by 14, 23 with BT.601's matrix.
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(static_cast<unsigned char>(back[3 * kPixel + channel]), green.rgb[channel], 4) << channel;
  }
}

TEST(VideoPipe, sameFramesGiveTheSameBytes) {
  const TemporaryFolder folder;
  for (const char* suffix : {".mp4", ".mkv", ".webm", ".webp", ".gif"}) {
    for (const char* name : {"a", "b"}) {
      film({.path = folder / (std::string(name) + suffix), .width = 320, .height = 180}, 10);
    }
    EXPECT_EQ(textOf(folder / (std::string("a") + suffix)), textOf(folder / (std::string("b") + suffix)))
        << suffix;
  }
}

TEST(VideoPipe, missingFfmpegIsNamedWithWhatToInstall) {
  const TemporaryFolder folder;
  const EnvironmentVariable path("PATH", folder.path());
  const std::string said = errorOf({.path = folder / "film.mp4", .width = 64, .height = 48}, 1);
  EXPECT_NE(said.find("apt install ffmpeg"), std::string::npos) << said;
  EXPECT_TRUE(folder.files().empty());
}

// An ffmpeg that reads a little, complains and ends: writing to it must raise an error, not SIGPIPE.
TEST(VideoPipe, tellsWhatFfmpegSaidWhenItFails) {
  const TemporaryFolder folder;
  folder.write("ffmpeg", "#!/bin/sh\nhead -c 1000 >/dev/null\necho 'the disk is full' >&2\nexit 1\n");
  std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
  const EnvironmentVariable path("PATH", folder.path().string() + ":/usr/bin:/bin");
  const VideoSettings settings{.path = folder / "film.mp4", .width = 640, .height = 480};
  for (const int frames : {0, 1, 3}) {
    const std::string said = errorOf(settings, frames);
    EXPECT_NE(said.find("film.mp4: ffmpeg"), std::string::npos) << said;
    EXPECT_NE(said.find("the disk is full"), std::string::npos) << said;
  }
  EXPECT_EQ(folder.files(), std::vector<std::string>{"ffmpeg"});
}

// Files that may not grow further stand for a full disk, of which ffmpeg alone says nothing in its exit
// status.
TEST(VideoPipe, aFullDiskIsAnErrorAndLeavesNothing) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const char* suffix : {".mp4", ".mkv", ".webm", ".webp", ".gif"}) {
    const TemporaryFolder folder;
    const rlimit small{.rlim_cur = 24576, .rlim_max = before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    std::string said;
    try {
      VideoPipe pipe({.path = folder / (std::string("film") + suffix), .width = 320, .height = 240});
      for (unsigned frame = 0; frame < 20; ++frame) {
        write(pipe, noise(320, 240, frame));
      }
      pipe.finish();
    } catch (const MachineError& error) {
      said = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_NE(said.find("ffmpeg"), std::string::npos) << suffix << ": " << said;
    EXPECT_TRUE(folder.files().empty()) << suffix;
  }
  std::signal(SIGXFSZ, handler);
}

TEST(VideoPipe, unwritablePlaceIsAnErrorBeforeAnyFrame) {
  const TemporaryFolder folder;
  EXPECT_THROW(VideoPipe({.path = folder / "none/film.mp4", .width = 64, .height = 48}), MachineError);
}

TEST(VideoPipe, givenUpLeavesNothingAndKeepsTheOldFilm) {
  const TemporaryFolder folder;
  folder.write("film.mp4", "the old film");
  {
    VideoPipe pipe({.path = folder / "film.mp4", .width = 64, .height = 48});
    write(pipe, shadedTiles(64, 48));
    EXPECT_EQ(folder.files().size(), 2U);
  }
  EXPECT_EQ(folder.files(), std::vector<std::string>{"film.mp4"});
  EXPECT_EQ(textOf(folder / "film.mp4"), "the old film");
}

TEST(VideoPipe, removesWhatAKilledRunLeft) {
  const TemporaryFolder folder;
  const int dead = 999999999;  // above the largest process ID
  folder.write(".film.mp4." + std::to_string(dead) + ".partial", "half");
  folder.write(".film.mp4.1.partial", "of a process that lives");
  folder.write(".film.mp4.mine.partial", "not ours");
  film({.path = folder / "film.mp4", .width = 64, .height = 48}, 1);
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{".film.mp4.1.partial", ".film.mp4.mine.partial", "film.mp4"}));
}

}  // namespace
}  // namespace careen
