#include "render/film/film_pictures.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/error.h"

namespace careen {
namespace {

// All pictures are of the same height.
Picture joined(const std::vector<Picture>& pictures) {
  Picture all{.width = 0, .height = pictures.front().height, .rgb = {}};
  for (const Picture& each : pictures) {
    all.width += each.width;
  }
  all.rgb.reserve(all.rowBytes() * static_cast<std::size_t>(all.height));
  for (std::size_t row = 0; row < static_cast<std::size_t>(all.height); ++row) {
    for (const Picture& each : pictures) {
      const std::uint8_t* const begin = each.rgb.data() + row * each.rowBytes();
      all.rgb.insert(all.rgb.end(), begin, begin + each.rowBytes());
      if (!each.alpha.empty()) {
        const auto columns = static_cast<std::ptrdiff_t>(each.width);
        const auto from = each.alpha.begin() + static_cast<std::ptrdiff_t>(row) * columns;
        all.alpha.insert(all.alpha.end(), from, from + columns);
      }
    }
  }
  return all;
}

void entitle(Trajectory& run, const std::string& name) {
  constexpr double kAlways = std::numeric_limits<double>::infinity();  // so that it does not fade
  run.stage.scenery.titles.push_back(
      {.from = -kAlways, .to = kAlways, .text = name, .place = TitlePlace::kBottom});
}

}  // namespace

FilmPictures::FilmPictures(const Trajectory& run, const ShownBesides& besides) : quantity_(besides.plot) {
  if (quantity_ == PlotQuantity::kDistance && besides.beside.empty()) {
    throw InputError("found a plot of distances and one run, expected others beside it");
  }
  const auto add = [this](const Trajectory& shown, const Trajectory* itsGhost) {
    Shown& each = shown_.emplace_back();
    each.run = &shown;
    each.ghost = itsGhost;
    each.filming = std::make_unique<Filming>(shown);
  };
  add(run, besides.ghost);
  for (const Trajectory* const each : besides.beside) {
    add(*each, nullptr);
  }
}

double FilmPictures::duration() const {
  double longest = 0;
  for (const Shown& each : shown_) {
    longest = std::max(longest, each.filming->duration());
  }
  return longest;
}

PictureSettings FilmPictures::settings() const {
  PictureSettings all = shown_.front().run->stage.picture;
  all.width *= static_cast<int>(shown_.size());
  all.height += quantity_ ? plotHeight(all.height) : 0;
  return all;
}

void FilmPictures::turnCamera(const Orbit& orbit) {
  for (const Shown& each : shown_) {
    each.filming->turnCamera(orbit);
  }
}

void FilmPictures::makeOverlays() {
  for (Shown& each : shown_) {
    each.overlays = overlaysOf(*each.run, each.ghost);
  }
  if (quantity_) {
    std::vector<FilmPlot::Shown> runs;
    for (const Shown& each : shown_) {
      runs.push_back({.run = each.run, .filming = each.filming.get(), .name = each.run->stage.name});
    }
    const PictureSettings whole = settings();
    plot_.emplace(*quantity_, runs, duration(), whole.width,
                  whole.height - shown_.front().run->stage.picture.height);
  }
}

void FilmPictures::open(const RenderOptions& options) {
  for (Shown& each : shown_) {
    RenderOptions own = options;
    each.filming->prepare(own);
    each.renderer = std::make_unique<Renderer>(*each.run, own);
  }
}

Picture FilmPictures::draw(double filmTime) {
  std::vector<Picture> pictures;
  for (Shown& each : shown_) {
    const PictureSettings& picture = each.run->stage.picture;
    pictures.push_back(each.filming->draw(*each.renderer, filmTime, picture.shutter, picture.rate));
    if (each.overlays) {
      each.filming->explain(*each.renderer, pictures.back(), filmTime, *each.overlays);
    }
  }
  Picture picture = pictures.size() == 1 ? std::move(pictures.front()) : joined(pictures);
  return plot_ ? withPlot(picture, filmTime) : picture;
}

Picture FilmPictures::withPlot(const Picture& above, double filmTime) {
  const auto pixelsOf = [](int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  };
  const std::size_t pixels = pixelsOf(plot_->width(), plot_->height());
  Picture below{.width = plot_->width(), .height = plot_->height(), .rgb = {}};
  below.rgb.resize(3 * pixels);
  below.alpha.resize(above.alpha.empty() ? 0 : pixels);
  shown_.front().renderer->drawOver(below, plot_->shapesAt(filmTime));
  Picture both = above;
  both.height += below.height;
  both.rgb.insert(both.rgb.end(), below.rgb.begin(), below.rgb.end());
  both.alpha.insert(both.alpha.end(), below.alpha.begin(), below.alpha.end());
  return both;
}

Picture FilmPictures::drawStrobe(std::span<const double> filmTimes) {
  Shown& first = shown_.front();
  Picture picture = first.filming->drawStrobe(*first.renderer, filmTimes);
  if (first.overlays) {
    first.filming->explainStrobe(*first.renderer, picture, filmTimes, *first.overlays);
  }
  return picture;
}

DrawFigures FilmPictures::figures() const {
  DrawFigures all;
  for (const Shown& each : shown_) {
    const DrawFigures& figures = each.renderer->figures();
    all.frames += figures.frames;
    all.shadowPasses += figures.shadowPasses;
    all.occlusionPasses += figures.occlusionPasses;
    all.overlayPasses += figures.overlayPasses;
    all.drawSeconds += figures.drawSeconds;
    all.readSeconds += figures.readSeconds;
  }
  return all;
}

void showFirst(Trajectory& run, const std::string& name) {
  Stage& stage = run.stage;
  if (!stage.camera) {
    stage.camera = Filming(run).camera(0);
  }
  stage.picture.overlays.add(Overlay::kTime);
  entitle(run, name);
  stage.name = name;
}

void showBeside(Trajectory& run, const Trajectory& first, const std::string& name) {
  const auto sameBox = [&](std::optional<std::size_t>& body) {
    if (!body) {
      return;
    }
    const std::string& wanted = first.world.bodies[*body].name;
    const auto found = std::find_if(run.world.bodies.begin(), run.world.bodies.end(),
                                    [&](const Body& each) { return each.name == wanted; });
    if (found == run.world.bodies.end()) {
      throw InputError("found no box '" + wanted + "', which the camera needs, expected one in each run");
    }
    body = static_cast<std::size_t>(found - run.world.bodies.begin());
  };
  Stage& stage = run.stage;
  static_cast<Showing&>(stage) = static_cast<const Showing&>(first.stage);
  stage.picture.overlays.remove(Overlay::kTime);
  stage.scenery.titles.clear();
  sameBox(stage.cameraMove.followed);
  if (stage.focus) {
    sameBox(stage.focus->body);
  }
  entitle(run, name);
  stage.name = name;
}

}  // namespace careen
