// Frictions of pairs are compared with MuJoCo's in import_mjcf_test.
#include "exchange/mjcf_contacts.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "support/input_error.h"

namespace careen {
namespace {

using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

MjcfContacts contactsOf(const std::string& elements, FilterParent filter = FilterParent::kYes) {
  MjcfDocument document("<mujoco>" + elements + "</mujoco>", "m.xml");
  const MjcfModel model = readModel(document);
  return readContacts(document, model, filter);
}
std::string meetingBox(const std::string& name) {
  return "<geom name=\"" + name + R"(" type="box" size="0.1 0.1 0.1"/>)";
}

// 0 stands, 1 hangs on it, 2 is one with 1, 3 hangs on 2; 4 flies.
const std::string kMeeting =
    "<worldbody><body name=\"0\">" + meetingBox("0") + "<body name=\"1\"><joint/>" + meetingBox("1") +
    "<body name=\"2\">" + meetingBox("2") + "<body name=\"3\"><joint/>" + meetingBox("3") +
    "</body></body></body></body><body name=\"4\"><freejoint/>" + meetingBox("4") + "</body></worldbody>";

TEST(MjcfContacts, aBodyMeetsWhatItIsInOnlyIfThatStandsStill) {
  EXPECT_EQ(contactsOf(kMeeting).apart, (Pairs{{1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(contactsOf(kMeeting, FilterParent::kNo).apart, (Pairs{{1, 2}}));
}

TEST(MjcfContacts, excludesPassThroughAndPairsDoNot) {
  EXPECT_EQ(contactsOf(kMeeting + R"(<contact><exclude body1="0" body2="1"/><exclude body1="4" body2="3"/>
      <pair geom1="3" geom2="1"/><pair geom1="4" geom2="3"/></contact>)")
                .apart,
            (Pairs{{0, 1}, {1, 2}, {2, 3}}));
}

TEST(MjcfContacts, bitsKeepBoxesApart) {
  const std::string free = "<body><freejoint/>" + meetingBox("a") + "</body><body><freejoint/>";
  EXPECT_EQ(contactsOf("<worldbody>" + free +
                       R"(<geom type="box" size="1 1 1" contype="2" conaffinity="2"/></body></worldbody>)")
                .apart,
            (Pairs{{0, 1}}));
}

// Frictions of pairs that there are not need not fit.
TEST(MjcfContacts, whatPassesThroughHasNoFriction) {
  const auto free = [](const std::string& name, const std::string& friction) {
    return "<body name=\"" + name + "\"><freejoint/><geom name=\"" + name +
           R"(" type="box" size="1 1 1" friction=")" + friction + "\"/></body>";
  };
  const std::string two = "<worldbody>" + free("a", "0.25") + free("b", "1") +
                          "<geom name=\"f\" type=\"plane\" friction=\"1\"/></worldbody>";
  const std::string pairs = R"(<pair geom1="a" geom2="f" friction="0.5 0.5"/>)";
  EXPECT_NE(
      inputErrorOf([&] {
        contactsOf(two + "<contact>" + pairs + R"(<pair geom1="a" geom2="b" friction="0 0"/></contact>)");
      }),
      "no error");
  const MjcfContacts contacts =
      contactsOf(two + "<contact>" + pairs + R"(<exclude body1="a" body2="b"/></contact>)");
  EXPECT_EQ(contacts.frictions, (std::vector<double>{0.25, 1, 1}));
  EXPECT_FALSE(contacts.isRefitted);
}

TEST(MjcfContacts, nothingGoesThroughWalls) {
  const std::string floor = "<worldbody><geom name=\"f\" type=\"plane\"/><body name=\"b\"><freejoint/>" +
                            meetingBox("b") + "</body></worldbody>";
  EXPECT_NE(inputErrorOf([&] {
              contactsOf(floor + "\n<contact><exclude body1=\"world\" body2=\"b\"/></contact>");
            }).find("m.xml:2:11: found \"f\", which goes through \"b\""),
            std::string::npos);
}

}  // namespace
}  // namespace careen
