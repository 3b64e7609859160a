#include "film/manifest.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/file.h"
#include "core/system/release.h"
#include "film/frame_range.h"

namespace careen {
namespace {

constexpr int kVersion = 1;

std::string sizeText(const PictureSettings& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

// A number in the file may be of any size and have a fraction; converting that would be undefined.
std::int64_t wholeNumber(const nlohmann::json& json, const std::string& key, std::int64_t least,
                         std::int64_t most) {
  const bool fits = json.is_number_integer() &&
                    !(json.is_number_unsigned() && json.get<std::uint64_t>() > std::uint64_t{INT64_MAX});
  if (!fits || json.get<std::int64_t>() < least || json.get<std::int64_t>() > most) {
    throw InputError("found " + json.dump() + " for " + key + ", expected a whole number from " +
                     std::to_string(least) + " to " + std::to_string(most));
  }
  return json.get<std::int64_t>();
}

// Fields missing in old manifests take their default, which is the behaviour of that time.
PictureSettings pictureFrom(const nlohmann::json& json) {
  PictureSettings picture;
  const nlohmann::json& size = json.at("size");
  picture.width = static_cast<int>(wholeNumber(size.at(0), "size", 1, kLargestFilm));
  picture.height = static_cast<int>(wholeNumber(size.at(1), "size", 1, kLargestFilm));
  picture.rate = parseFrameRate(json.at("fps").get<std::string>());
  picture.look = lookNamed(json.value("look", nameOf(picture.look)));
  picture.antialiasing = antialiasingNamed(json.value("antialiasing", nameOf(picture.antialiasing)));
  const std::string shutter = json.value("shutter", "none");
  picture.shutter = shutter == "none" ? Shutter() : parseShutter(shutter);
  picture.overlays = OverlaySet::named(json.value("overlays", "none"));
  picture.light = LightParts::named(json.value("light", picture.light.text()));
  picture.alpha = json.value("alpha", false);
  return picture;
}

FilmManifest fromJson(const nlohmann::json& json) {
  if (json.at("careen_film") != kVersion) {
    throw InputError("another version");
  }
  FilmManifest manifest;
  manifest.program = json.value("program", "");  // missing in old manifests, as are the next two
  manifest.renderer = json.value("renderer", "");
  manifest.libraries = json.value("libraries", "");
  manifest.sceneHash = json.at("scene_hash").get<std::string>();
  manifest.stateHash = json.at("state_hash").get<std::string>();
  manifest.shownAs = json.value("shown_as", "");
  manifest.ghost = json.value("ghost", "");
  manifest.beside = json.value("beside", "");
  manifest.plot = json.value("plot", "");
  manifest.picture = pictureFrom(json);
  manifest.frameCount = wholeNumber(json.at("frame_count"), "frame_count", 0, kMostFrames);
  if (const std::string frames = json.at("frames").get<std::string>(); !frames.empty()) {
    manifest.frames = framesOf(parseFrameRanges(frames), manifest.frameCount);
  }
  if (const auto hashes = json.find("hashes"); hashes != json.end()) {
    for (const auto& [frame, hash] : hashes->items()) {
      const std::vector<std::int64_t> one = framesOf(parseFrameRanges(frame), manifest.frameCount);
      if (one.size() != 1) {
        throw InputError("found a hash of " + frame + ", expected one of a single frame");
      }
      manifest.hashes[one[0]] = hash.get<std::string>();
    }
  }
  return manifest;
}

nlohmann::ordered_json hashesOf(const FilmManifest& manifest) {
  nlohmann::ordered_json::object_t hashes;
  for (const auto& [frame, hash] : manifest.hashes) {
    hashes.emplace_back(std::to_string(frame), hash);  // at its end, without a search for the key
  }
  return hashes;
}

}  // namespace

std::string frameHash(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.text();
}

std::string librariesHere() {
  const auto version = [](int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  return "Eigen " + version(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION) +
         ", nlohmann-json " +
         version(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH) +
         ", " + cLibrary();
}

std::optional<FilmManifest> readManifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / kManifestName;
  std::error_code none;
  if (!std::filesystem::exists(path, none)) {
    return std::nullopt;
  }
  try {
    return fromJson(nlohmann::json::parse(readFile(path)));
  } catch (const std::exception& error) {
    throw InputError(path.string() + ": is not a film manifest: " + error.what());
  }
}

void writeManifest(const std::filesystem::path& folder, const FilmManifest& manifest) {
  const PictureSettings& picture = manifest.picture;
  nlohmann::ordered_json json = {
      {"careen_film", kVersion},
      {"program", manifest.program},
      {"renderer", manifest.renderer},
      {"libraries", manifest.libraries},
      {"scene_hash", manifest.sceneHash},
      {"state_hash", manifest.stateHash},
      {"size", {picture.width, picture.height}},
      {"fps", picture.rate.text()},
      {"look", nameOf(picture.look)},
      {"antialiasing", nameOf(picture.antialiasing)},
      {"shutter", picture.shutter.text()},
      {"overlays", picture.overlays.text()},
      {"light", picture.light.text()},
      {"frame_count", manifest.frameCount},
      {"frames", rangesText(manifest.frames)},
  };
  if (picture.alpha) {
    json["alpha"] = true;
  }
  if (!manifest.shownAs.empty()) {
    json["shown_as"] = manifest.shownAs;
  }
  if (!manifest.ghost.empty()) {
    json["ghost"] = manifest.ghost;
  }
  if (!manifest.beside.empty()) {
    json["beside"] = manifest.beside;
  }
  if (!manifest.plot.empty()) {
    json["plot"] = manifest.plot;
  }
  if (!manifest.hashes.empty()) {
    json["hashes"] = hashesOf(manifest);
  }
  writeFile(folder / kManifestName, json.dump(2) + "\n");
}

std::string differenceOf(const FilmManifest& there, const FilmManifest& asked) {
  const auto compare = [](const char* what, const std::string& a, const std::string& b) {
    return a == b ? std::string() : std::string(what) + " " + a + " there, " + b + " now; ";
  };
  std::string text =
      compare("scene", there.sceneHash, asked.sceneHash) + compare("run", there.stateHash, asked.stateHash) +
      compare("shown as", there.shownAs.empty() ? "its scene" : there.shownAs,
              asked.shownAs.empty() ? "its scene" : asked.shownAs) +
      compare("ghost", there.ghost.empty() ? "none" : there.ghost,
              asked.ghost.empty() ? "none" : asked.ghost) +
      compare("beside", there.beside.empty() ? "none" : there.beside,
              asked.beside.empty() ? "none" : asked.beside) +
      compare("plot", there.plot.empty() ? "none" : there.plot, asked.plot.empty() ? "none" : asked.plot) +
      compare("size", sizeText(there.picture), sizeText(asked.picture)) +
      compare("fps", there.picture.rate.text(), asked.picture.rate.text()) +
      compare("look", nameOf(there.picture.look), nameOf(asked.picture.look)) +
      compare("antialiasing", nameOf(there.picture.antialiasing), nameOf(asked.picture.antialiasing)) +
      compare("shutter", there.picture.shutter.text(), asked.picture.shutter.text()) +
      compare("overlays", there.picture.overlays.text(), asked.picture.overlays.text()) +
      compare("light", there.picture.light.text(), asked.picture.light.text()) +
      compare("alpha", there.picture.alpha ? "yes" : "no", asked.picture.alpha ? "yes" : "no") +
      compare("frames in all", std::to_string(there.frameCount), std::to_string(asked.frameCount)) +
      compare("program", there.program, asked.program) +
      (there.renderer.empty() || asked.renderer.empty()
           ? ""
           : compare("renderer", there.renderer, asked.renderer));
  return text.empty() ? text : text.substr(0, text.size() - 2);
}

}  // namespace careen
