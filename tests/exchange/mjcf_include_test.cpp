#include "exchange/mjcf_include.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "support/input_error.h"
#include "support/process.h"

namespace careen {
namespace {

// Names of the elements with their files' in brackets, as they stand after all is included.
std::string outline(const XmlElement& element) {
  std::string text = element.name;
  for (const XmlElement& child : element.children) {
    text += (&child == element.children.data() ? "(" : " ") + outline(child);
  }
  return text + (element.children.empty() ? "" : ")");
}

class MjcfInclude : public testing::Test {
 protected:
  XmlTree included(const std::string& name) const {
    const std::filesystem::path path = folder_ / name;
    XmlTree tree(textOf(path), path.string());
    includeFiles(tree);
    return tree;
  }
  // Without the folder's name.
  std::string refusal(const std::string& name) const {
    std::string message = inputErrorOf([&] { included(name); });
    const std::string folder = folder_.path().string() + "/";
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }

  TemporaryFolder folder_;
};

TEST_F(MjcfInclude, elementsStandWhereTheyAreIncluded) {
  folder_.write("m.xml", "<mujoco><a/><include file='one.xml'/><b><include file='two.xml'/></b></mujoco>");
  folder_.write("one.xml", "<mujocoinclude><c/>\n<d><e/></d></mujocoinclude>");
  folder_.write("two.xml", "<any>\n\n<f g='h'/></any>");
  const XmlTree tree = included("m.xml");
  EXPECT_EQ(outline(tree.root()), "mujoco(a c d(e) b(f))");
  const XmlElement& f = tree.root().children[3].children[0];
  EXPECT_EQ(inputErrorOf([&] { tree.fail(f.find("g")->offset, "g", "none"); }),
            (folder_ / "two.xml").string() + ":3:4: found g, expected none");
  EXPECT_EQ(inputErrorOf([&] { tree.fail(tree.root().children[0].offset, "a", "none"); }),
            (folder_ / "m.xml").string() + ":1:10: found a, expected none");
}

TEST_F(MjcfInclude, looksBesideTheModelThenBesideTheFile) {
  std::filesystem::create_directory(folder_ / "parts");
  folder_.write("m.xml", "<mujoco><include file='parts/one.xml'/></mujoco>");
  folder_.write("parts/one.xml", "<x><include file='both.xml'/><include file='near.xml'/></x>");
  folder_.write("both.xml", "<x><of-the-model/></x>");
  folder_.write("parts/both.xml", "<x><of-the-part/></x>");
  folder_.write("parts/near.xml", "<x><near/></x>");
  EXPECT_EQ(outline(included("m.xml").root()), "mujoco(of-the-model near)");
}

TEST_F(MjcfInclude, eachFileOnlyOnce) {
  folder_.write("m.xml", "<mujoco><include file='one.xml'/><include file='./one.xml'/></mujoco>");
  folder_.write("one.xml", "<x><y/></x>");
  EXPECT_EQ(
      refusal("m.xml"),
      "m.xml:1:43: found file=\"./one.xml\" for <include>, expected each file once; this one has been read");
  folder_.write("self.xml", "<mujoco>\n<include file='self.xml'/></mujoco>");
  EXPECT_EQ(refusal("self.xml").substr(0, 46), "self.xml:2:10: found file=\"self.xml\" for <incl");
  folder_.write("a.xml", "<mujoco><include file='b.xml'/></mujoco>");
  folder_.write("b.xml", "<x><include file='a.xml'/></x>");
  EXPECT_EQ(refusal("a.xml").substr(0, 34), "b.xml:1:13: found file=\"a.xml\" for");
}

TEST_F(MjcfInclude, saysWhatItCannotInclude) {
  folder_.write("m.xml", "<mujoco><include file='no.xml'/></mujoco>");
  EXPECT_EQ(refusal("m.xml"),
            "m.xml:1:18: found file=\"no.xml\" for <include>, expected a file beside the model");
  folder_.write("m.xml", "<mujoco><include file='.'/></mujoco>");
  EXPECT_EQ(refusal("m.xml"), "m.xml:1:18: found file=\".\" for <include>, expected a file beside the model");
  folder_.write("no.xml", "<x/>");
  folder_.write("m.xml", "<mujoco><include file='no.xml'/></mujoco>");
  EXPECT_NE(refusal("m.xml").find("expected a file with elements in its root"), std::string::npos);
  folder_.write("no.xml", "<x>\n<y></x>");
  EXPECT_EQ(refusal("m.xml").substr(0, 9), "no.xml:2:");
  for (const char* const wrong :
       {"<include/>", "<include file='no.xml' a='b'/>", "<include file='no.xml'><a/></include>"}) {
    folder_.write("m.xml", "<mujoco>" + std::string(wrong) + "</mujoco>");
    EXPECT_EQ(refusal("m.xml").substr(0, 51), "m.xml:1:10: found an <include> with more or less th") << wrong;
  }
}

TEST_F(MjcfInclude, longChainsEndInAMessage) {
  for (int i = 0; i < 100; ++i) {
    folder_.write(std::to_string(i) + ".xml",
                  "<mujoco><include file='" + std::to_string(i + 1) + ".xml'/></mujoco>");
  }
  EXPECT_NE(refusal("0.xml").find("found elements nested deeper than 64"), std::string::npos);
  folder_.write("100.xml", "<x><y/></x>");
  EXPECT_EQ(outline(included("80.xml").root()), "mujoco(y)");
}

}  // namespace
}  // namespace careen
