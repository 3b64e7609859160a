#include "exchange/mjcf_frame.h"

#include <gtest/gtest.h>

#include "support/input_error.h"

namespace careen {
namespace {

const std::string kSizes = R"(<default><geom type="box" size="1 1 1"/>
  <default class="small"><geom size="0.1 0.1 0.1"/></default>
  <default class="flat"><geom size="1 1 0.1"/></default></default>)";

struct FramedBody {
  MjcfDocument document;
  MjcfDefaults defaults;
  std::vector<MjcfContent> contents;
  explicit FramedBody(const std::string& elements)
      : document("<mujoco>" + kSizes + "<body>" + elements + "</body></mujoco>", "m.xml"),
        defaults(document),
        contents(contentsOf(document, defaults, *document.sections("body")[0], MjcfDefaults::kMain)) {}
};

// x of a frame that is turned by 90° about z is y of its body.
TEST(MjcfFrame, whatIsInItIsPlacedInItsBody) {
  const FramedBody body(R"(<geom pos="1 2 3"/><frame pos="0 0 5" euler="0 0 90"><geom pos="1 0 0"/>
      <frame pos="2 0 0" axisangle="0 0 1 90"><geom pos="1 0 0" quat="0 0 0 1"/></frame></frame><geom/>)");
  ASSERT_EQ(body.contents.size(), 4U);
  EXPECT_FALSE(body.contents[0].frame);
  EXPECT_EQ(geomOf(body.defaults, body.contents[0]).position, Vec3(1, 2, 3));
  EXPECT_LT((geomOf(body.defaults, body.contents[1]).position - Vec3(0, 1, 5)).norm(), 1e-15);
  const MjcfGeom inner = geomOf(body.defaults, body.contents[2]);
  EXPECT_LT((inner.position - Vec3(-1, 2, 5)).norm(), 1e-15);
  EXPECT_LT((inner.turn.toRotationMatrix() - Mat3(Mat3::Identity())).norm(), 1e-15) << "180° and 180°";
  EXPECT_FALSE(body.contents[3].frame);
  const MjcfFrame lifted = body.contents[1].in({Vec3(7, 0, 0), Quat::Identity()});
  EXPECT_LT((lifted.position - Vec3(7, 0, 5)).norm(), 1e-15);
}

TEST(MjcfFrame, classesAreThoseOfTheNearest) {
  const FramedBody body(R"(<frame childclass="small"><geom/><frame><geom/><geom class="flat"/></frame>
      <frame childclass="flat"><geom/></frame></frame><geom/>)");
  std::vector<std::vector<double>> sizes;
  for (const MjcfContent& each : body.contents) {
    sizes.push_back(geomOf(body.defaults, each).size);
  }
  const std::vector<double> small = {0.1, 0.1, 0.1};
  const std::vector<double> flat = {1, 1, 0.1};
  EXPECT_EQ(sizes, (std::vector<std::vector<double>>{small, small, flat, flat, {1, 1, 1}}));
}

TEST(MjcfFrame, refusesWhatMakesNoSenseInIt) {
  EXPECT_EQ(inputErrorOf([] { FramedBody("\n<frame><inertial/></frame>"); }),
            "m.xml:4:9: found <inertial> in <frame>, expected it in <body>");
  EXPECT_EQ(inputErrorOf([] { FramedBody("\n<frame childclass='no'/>"); }),
            "m.xml:4:8: found childclass=\"no\" for <frame>, expected a class of <default>");
  EXPECT_EQ(inputErrorOf([] { FramedBody("\n<frame quat='0 0 0 0'/>"); }),
            "m.xml:4:8: found quat=\"0 0 0 0\" for <frame>, expected a rotation, not 0");
}

}  // namespace
}  // namespace careen
