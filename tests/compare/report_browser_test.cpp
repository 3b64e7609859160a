// The page as its readers see it: in Debian's Chromium, controlled by its keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "compare/report.h"
#include "comparisons.h"
#include "core/system/file.h"
#include "support/browser.h"

namespace careen {
namespace {

/// A report in a browser, which must report no errors at the end.
class ReportInBrowser : public testing::Test {
 protected:
  ~ReportInBrowser() override {
    EXPECT_TRUE(browser.complaints().empty()) << browser.complaints().front();
    EXPECT_TRUE(browser.requests().empty()) << browser.requests().front();
  }

  void write(const Comparison& comparison) { writeReport(folder / "report", comparison); }
  void open(const std::string& fragment = "") { browser.open(folder / "report/index.html", fragment); }
  std::string textOf(const std::string& selector) {
    return browser.evaluate("document.querySelector('" + selector + "').textContent");
  }
  bool isSeen(const std::string& selector) {
    return browser.evaluate("document.querySelector('" + selector + "').checkVisibility()");
  }
  double number(const std::string& expression) { return browser.evaluate(expression); }
  int zoom() { return std::stoi(textOf("#zoom")); }

  TemporaryFolder folder;
  Browser browser;
};

TEST_F(ReportInBrowser, opensAtTheFirstDifferenceAndKeysChooseOthers) {
  write(filmComparison(folder.path(), 8, 2, 5));
  open();
  EXPECT_EQ(textOf("#frame-name"), "000002.png, 3 of 8");
  EXPECT_EQ(textOf("#frame-verdict"), "different: 3 % of the pixels differ; at most 0.01 % may");
  EXPECT_EQ(textOf("#difference-caption"), "difference × 4");
  EXPECT_EQ(textOf("#pixel"),
            "Worst pixel (2, 18): expected 100 100 100, actual 140 140 140, off by +40 +40 +40 of 255");
  EXPECT_EQ(number("[...document.images].filter(image => image.naturalWidth === 96).length"), 5);
  browser.press("ArrowRight");
  EXPECT_EQ(textOf("#frame-name"), "000003.png, 4 of 8");
  browser.press("w");
  EXPECT_EQ(textOf("#frame-name"), "000005.png, 6 of 8");
  EXPECT_EQ(browser.evaluate("location.hash"), "#frame=000005.png");
  browser.press("f");
  browser.press("p");  // no earlier frame has pictures
  EXPECT_EQ(textOf("#frame-name"), "000002.png, 3 of 8");
  browser.press("ArrowLeft");
  EXPECT_EQ(textOf("#frame-verdict"), "same file");
  EXPECT_FALSE(isSeen("#panes"));
  EXPECT_EQ(textOf("#no-pictures"),
            "Both files are the same, byte for byte. Nearest frame with pictures: 000002.png.");
  browser.press("n");
  EXPECT_TRUE(isSeen("#panes"));
  EXPECT_EQ(textOf("#frame-name"), "000002.png, 3 of 8");
}

// The centre of the square on the screen: in the expected picture, the actual one and the difference.
TEST_F(ReportInBrowser, picturesAreSeenAsTheyAre) {
  write(filmComparison(folder.path(), 4, 2, 2));
  browser.setSize(1400, 1200);
  open();
  const auto boxes = browser.evaluate(
      "[...document.querySelectorAll('#side .view')].map(view => view.getBoundingClientRect().toJSON())");
  const Picture seen = decodePng(browser.screenshot(), "the screenshot");
  ASSERT_EQ(seen.width, 1400);
  std::vector<int> levels;
  for (const auto& box : boxes) {
    const double x = box.at("left").get<double>() + box.at("width").get<double>() * (2 + 9) / 96;
    const double y = box.at("top").get<double>() + box.at("height").get<double>() * 27 / 54;
    levels.push_back(
        seen.rgb[static_cast<std::size_t>(y) * seen.rowBytes() + 3 * static_cast<std::size_t>(x)]);
  }
  EXPECT_EQ(levels, (std::vector<int>{100, 220, 240}));  // the difference of 120, twice
}

TEST_F(ReportInBrowser, chartIsASliderForKeysAndPointer) {
  write(filmComparison(folder.path(), 8, 2, 5));
  open();
  browser.press("Tab");
  EXPECT_EQ(browser.evaluate("document.activeElement.id"), "frames-chart");
  EXPECT_EQ(browser.evaluate("getComputedStyle(document.activeElement).outlineStyle"), "solid");
  browser.press("End");
  EXPECT_EQ(textOf("#frame-name"), "000007.png, 8 of 8");
  EXPECT_EQ(browser.evaluate("document.activeElement.ariaValueNow"), "7");
  EXPECT_EQ(browser.evaluate("document.activeElement.ariaValueText"), "000007.png, different");
  browser.press("Home");
  EXPECT_EQ(textOf("#frame-name"), "000000.png, 1 of 8");
  const auto box =
      browser.evaluate("document.querySelector('#frames-chart svg').getBoundingClientRect().toJSON()");
  browser.click(box.at("left").get<double>() + 0.7 * box.at("width").get<double>(),
                box.at("top").get<double>() + 60);
  EXPECT_EQ(textOf("#frame-name"), "000005.png, 6 of 8");
  EXPECT_EQ(number("document.querySelectorAll('#frames-chart rect.different').length"), 6);
  EXPECT_NE(textOf("#frames-chart").find("▾ first"), std::string::npos);
}

TEST_F(ReportInBrowser, addressTellsFrameAndMode) {
  write(filmComparison(folder.path(), 8, 2, 5));
  open("#frame=000004.png&mode=wipe");
  EXPECT_EQ(textOf("#frame-name"), "000004.png, 5 of 8");
  EXPECT_TRUE(isSeen("#wipe"));
  EXPECT_FALSE(isSeen("#side"));
  const char* const clip =
      "parseFloat(getComputedStyle(document.querySelector('#one [data-which=expected]')).clipPath.split(' "
      "')[1])";
  EXPECT_NEAR(number(clip), 48, 1);  // half of 96 px is covered
  browser.press(".");
  EXPECT_LT(number(clip), 47);
  EXPECT_EQ(browser.evaluate("document.querySelector('[data-mode=wipe]').ariaPressed"), "true");
}

TEST_F(ReportInBrowser, blinksByItselfAndByHand) {
  write(filmComparison(folder.path(), 3, 1, 1));
  open();
  browser.press("b");
  EXPECT_EQ(textOf("#one-caption"), "expected");
  const char* const next =
      "new Promise(done => setTimeout(() => done(document.querySelector('#one-caption')"
      ".textContent), 700))";
  EXPECT_EQ(browser.evaluate(next), "actual");
  browser.press("b");
  EXPECT_TRUE(isSeen("#side"));
  browser.setMedia("prefers-reduced-motion", "reduce");
  browser.press("b");
  EXPECT_EQ(browser.evaluate(next), "expected – Space blinks by hand");
  browser.press(" ");
  EXPECT_EQ(textOf("#one-caption"), "actual – Space blinks by hand");
  EXPECT_EQ(browser.evaluate("document.querySelector('#one [data-which=expected]').style.visibility"),
            "hidden");
}

TEST_F(ReportInBrowser, zoomsByKeysAndWheelAndGoesToTheWorstPixel) {
  write(filmComparison(folder.path(), 3, 1, 1));
  browser.setSize(1400, 1600);
  open();
  const int whole = zoom();
  EXPECT_GT(whole, 300);  // of 96 px in a third of the page
  browser.press("+");
  EXPECT_NEAR(zoom(), 1.5 * whole, 2);
  browser.press("-");
  EXPECT_EQ(zoom(), whole);
  const auto box = browser.evaluate("document.querySelector('.view').getBoundingClientRect().toJSON()");
  const double x = box.at("left").get<double>() + 20;
  const double y = box.at("top").get<double>() + 20;
  browser.wheel(x, y, -200);
  EXPECT_GT(zoom(), 1.3 * whole);
  browser.press("0");
  EXPECT_EQ(zoom(), whole);
  browser.press("x");
  EXPECT_GE(zoom(), 800);
  const char* const offMiddle =
      "(() => { const view = document.querySelector('.view').getBoundingClientRect(); const cross = "
      "document.querySelector('.view .cross').getBoundingClientRect(); return Math.abs(cross.left + "
      "cross.width / 2 "
      "- view.left - view.width / 2) + Math.abs(cross.top + cross.height / 2 - view.top - view.height / 2); "
      "})()";
  EXPECT_LT(number(offMiddle), 1);
  browser.press("ArrowRight", true);
  EXPECT_NEAR(number(offMiddle), 40, 1);
  EXPECT_TRUE(isSeen(".cross"));
  browser.press("c");
  EXPECT_FALSE(isSeen(".cross"));
}

// Contrast of text and verdict colours with their background: WCAG 2.2, 1.4.3, requires 4.5.
TEST_F(ReportInBrowser, isLegibleByDayAndNightAndOnNarrowScreens) {
  write(filmComparison(folder.path(), 8, 2, 5));
  const char* const contrasts =
      "(() => { const light = code => { const c = code / 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) "
      "/ "
      "1.055) ** 2.4; }; const luminance = name => { const hex = getComputedStyle(document.documentElement)"
      ".getPropertyValue(name).trim(); const part = i => light(parseInt(hex.slice(1 + 2 * i, 3 + 2 * i), "
      "16)); "
      "return 0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2); }; const contrast = (a, b) => "
      "(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05); return Math.min(...['--ink', '--soft', '--same', "
      "'--warning', '--different', '--accent'].flatMap(name => ['--paper', '--panel'].map(ground => "
      "contrast(luminance(name), luminance(ground))))); })()";
  std::vector<std::string> papers;
  for (const char* scheme : {"light", "dark"}) {
    browser.setMedia("prefers-color-scheme", scheme);
    for (const int width : {1400, 500, 320}) {
      browser.setSize(width, 900);
      open();
      EXPECT_GE(number(contrasts), 4.5) << scheme;
      EXPECT_LE(number("document.documentElement.scrollWidth"), width);
    }
    papers.push_back(browser.evaluate("getComputedStyle(document.body).backgroundColor"));
  }
  EXPECT_NE(papers[0], papers[1]);
  EXPECT_GT(number("document.querySelectorAll('.view')[1].getBoundingClientRect().top"),
            number("document.querySelectorAll('.view')[0].getBoundingClientRect().bottom"));
}

TEST_F(ReportInBrowser, hostileNamesDoNothing) {
  const std::string name = "</script><img src=x onerror=document.title='struck'>&\"'{{style}}";
  Comparison comparison = filmComparison(folder.path(), 3, 1, 2);
  comparison.headline = comparison.facts[0].name = comparison.frames[1].name = name;
  comparison.frames[1].reasons = {name};
  write(comparison);
  open();
  EXPECT_EQ(textOf("h1"), name);
  EXPECT_EQ(textOf("#frame-verdict"), "different: " + name);
  EXPECT_EQ(browser.evaluate("document.title"), "✕ Different: " + name + " – careen compare");
  EXPECT_EQ(number("document.querySelectorAll('[onerror]').length"), 0);
}

TEST_F(ReportInBrowser, missingFrameIsShownAsFarAsItIsThere) {
  Comparison comparison = filmComparison(folder.path(), 3, 1, 1);
  std::filesystem::remove(folder / "actual/000001.png");
  comparison.frames[1].measured = false;
  comparison.frames[1].reasons = {"it is missing"};
  write(comparison);
  open();
  EXPECT_EQ(textOf("#frame-verdict"), "different: it is missing");
  EXPECT_EQ(textOf("[data-shows=actual]"), "missing, or not comparable");
  EXPECT_EQ(number("document.querySelector('[data-shows=expected] img').naturalWidth"), 96);
  EXPECT_EQ(textOf("#pixel"), "");
  browser.press("2");
  browser.press("x");
}

// The first pixel of the upper left region is part of its outline; the actual picture is grey there.
TEST_F(ReportInBrowser, ignoredRegionsAreStripedUntilTheMarksAreHidden) {
  Comparison comparison = filmComparison(folder.path(), 3, 1, 1);
  comparison.ignored.add("0,0,96,12");
  write(comparison);
  open();
  EXPECT_EQ(number("document.querySelectorAll('#side .view img.ignored').length"), 3);
  EXPECT_EQ(number("document.querySelector('#side img.ignored').naturalWidth"), 96);
  EXPECT_EQ(
      browser.evaluate("(() => { const image = document.querySelector('#side img.ignored'); const canvas = "
                       "new OffscreenCanvas(96, 54); const context = canvas.getContext('2d'); "
                       "context.drawImage(image, 0, 0); return [...context.getImageData(0, 11, 1, 2).data]"
                       ".join(' '); })()"),
      "255 225 77 255 0 0 0 0");
  EXPECT_TRUE(isSeen("#side img.ignored"));
  browser.press("c");
  EXPECT_FALSE(isSeen("#side img.ignored"));
}

// The expected one is narrower: wiping leaves of it what is left of the edge.
TEST_F(ReportInBrowser, picturesOfTwoSizesAreBothShown) {
  Comparison comparison = filmComparison(folder.path(), 2, 1, 1);
  writePng(folder / "actual/000001.png", squareOn(192, 54, 5, 200));
  comparison.frames[1].measured = false;
  comparison.frames[1].reasons = {"found a picture of 192x54 pixels, expected one of 96x54"};
  write(comparison);
  open();
  EXPECT_EQ(number("document.querySelector('[data-shows=expected] img').naturalWidth"), 96);
  EXPECT_EQ(number("document.querySelector('[data-shows=actual] img').naturalWidth"), 192);
  EXPECT_EQ(textOf("[data-shows=difference]"), "missing, or not comparable");
  browser.press("2");  // the edge is in the middle, where the expected one ends
  // "inset(0px)" or "inset(0px 38px 0px 0px)"
  const char* const cutOff =
      "(sides => parseFloat(sides[1] ?? sides[0]))(document.querySelector('#one "
      "[data-which=expected]').style.clipPath.replace('inset(', '').split(' '))";
  EXPECT_NEAR(number(cutOff), 0, 0.5);
  for (int i = 0; i < 10; ++i) {
    browser.press(",");
  }
  EXPECT_NEAR(number(cutOff), 0.2 * 192, 0.5);
}

TEST_F(ReportInBrowser, keysAreTold) {
  write(filmComparison(folder.path(), 3, 1, 1));
  open();
  EXPECT_FALSE(isSeen("#help"));
  browser.press("?");
  EXPECT_TRUE(isSeen("#help"));
  browser.press("ArrowRight");  // goes to the dialog now
  EXPECT_EQ(textOf("#frame-name"), "000001.png, 2 of 3");
  browser.press("Escape");
  EXPECT_FALSE(isSeen("#help"));
}

TEST_F(ReportInBrowser, equalsAreShort) {
  write(filmComparison(folder.path(), 5, 5, 5));
  browser.setSize(1400, 1000);
  open();
  EXPECT_FALSE(isSeen("#strip"));
  EXPECT_FALSE(isSeen("#frame"));
  EXPECT_LE(number("document.documentElement.scrollHeight"), 1000);
  EXPECT_EQ(textOf(".reason"), "All 5 frames are the same, byte for byte.");
}

TEST_F(ReportInBrowser, tenThousandFramesAreDrawnAtOnce) {
  Comparison comparison = filmComparison(folder.path(), 20, 3, 10);
  for (int k = 20; k < 10'000; ++k) {
    comparison.frames.push_back(sameFrame(frameName(k)));
  }
  comparison.frames[5001] = otherFrame(frameName(5001), 0.3);
  write(comparison);
  browser.setSize(1400, 1000);
  open("#frame=005001.png");
  EXPECT_EQ(textOf("#frame-name"), "005001.png, 5002 of 10000");
  // Positions of bars [of the width]: those at the beginning, and the single frame's in the middle.
  const Browser::Json bars = browser.evaluate(
      "document.querySelector('#frames-chart .bars').getAttribute('d').match(/M[0-9.]+/g).map(move => "
      "move.slice(1) / document.querySelector('#frames-chart svg').clientWidth)");
  EXPECT_LE(bars.size(), 20U);
  EXPECT_LT(bars.at(0), 0.02);
  EXPECT_NEAR(bars.at(bars.size() - 1).get<double>(), 0.5, 0.01);
}

TEST_F(ReportInBrowser, runShowsGrowthHorizonAndImpacts) {
  Comparison comparison = twoRuns();
  comparison.run->growthPerImpact = 4.3;
  write(comparison);
  open();
  EXPECT_NE(textOf("#growth-chart").find("horizon: beyond it, chaos"), std::string::npos);
  EXPECT_NE(textOf("#growth-chart").find("first impact that differs"), std::string::npos);
  browser.press("Tab");
  EXPECT_EQ(browser.evaluate("document.activeElement.id"), "growth-chart");
  browser.press("End");
  EXPECT_EQ(textOf("#growth-readout"),
            "1 s: 0.5 m and 0 rad apart, 1.336 of drifter – beyond the horizon this means "
            "nothing");
  browser.press("Home");
  EXPECT_EQ(textOf("#growth-readout"), "0 s: no difference");
  EXPECT_EQ(textOf("#first-impact"), "1 ← first");
  EXPECT_FALSE(isSeen("#frame"));
}

TEST_F(ReportInBrowser, horizonWithoutGrowthIsNotCalledChaos) {
  write(twoRuns());
  open();
  EXPECT_NE(textOf("#growth-chart").find("horizon"), std::string::npos);
  EXPECT_EQ(textOf("#growth-chart").find("chaos"), std::string::npos);
}

TEST_F(ReportInBrowser, junitIsXml) {
  Comparison comparison = filmComparison(folder.path(), 3, 1, 2);
  comparison.frames[1].name = "<script>\"&'\x01\xFF\u0085\uFFFF.png";
  comparison.frames[1].reasons = {"]]>\n & \x1B[31m"};
  const std::string parsed = "new DOMParser().parseFromString(" +
                             nlohmann::json(reportJunit(comparison)).dump() + ", 'application/xml')";
  EXPECT_TRUE(browser.evaluate(parsed + ".querySelector('parsererror') === null"));
  EXPECT_EQ(number(parsed + ".querySelectorAll('testsuites > testsuite > testcase[name][classname]').length"),
            4);
  EXPECT_EQ(number(parsed + ".querySelectorAll('testcase > failure[message][type]').length"), 3);
  EXPECT_EQ(browser.evaluate(parsed + ".querySelectorAll('testcase')[2].getAttribute('name')"),
            "<script>\"&'\uFFFD\uFFFD\uFFFD\uFFFD.png");
}

}  // namespace
}  // namespace careen
