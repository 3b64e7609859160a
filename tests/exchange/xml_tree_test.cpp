#include "exchange/xml_tree.h"

#include <gtest/gtest.h>

#include "support/input_error.h"

namespace careen {
namespace {

std::string xmlError(const std::string& text) {
  return inputErrorOf([&] { XmlTree(text, "m.xml"); });
}

TEST(XmlTree, knowsWhereEverythingStands) {
  const XmlTree tree(
      "\xEF\xBB\xBF<?xml version='1.0'?>\n<!-- \xC3\xA4 -->\n<a one = '1'\n  two=\"&lt;2&gt; 'x' = y\">\n"
      "  text <b/> <c d='\xC3\xA4'><e f='g'/></c></a>\n",
      "m.xml");
  const XmlElement& root = tree.root();
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(tree.place(root.offset), "3:2");
  ASSERT_EQ(root.attributes.size(), 2U);
  EXPECT_EQ(root.text("one"), "1");
  EXPECT_EQ(tree.place(root.find("one")->offset), "3:4");
  EXPECT_EQ(root.text("two"), "<2> 'x' = y");
  EXPECT_EQ(tree.place(root.find("two")->offset), "4:3");
  EXPECT_EQ(root.find("three"), nullptr);
  EXPECT_EQ(root.text("three"), "");
  ASSERT_EQ(root.children.size(), 2U);  // without the text
  EXPECT_EQ(tree.place(root.children[0].offset), "5:9");
  EXPECT_EQ(root.children[1].children[0].text("f"), "g");
  // Columns count characters: ä is one.
  EXPECT_EQ(tree.place(root.children[1].children[0].find("f")->offset), "5:25");
}

TEST(XmlTree, refusesWhatIsNoXml) {
  EXPECT_EQ(xmlError(""), "m.xml:1:1: found no document element found, expected well-formed XML");
  EXPECT_NE(xmlError("<a>\n  <b>").find("m.xml:2:"), std::string::npos);
  EXPECT_NE(xmlError("<a>\n<b></a>").find("m.xml:2:"), std::string::npos);
  EXPECT_NE(xmlError("<a b=1/>").find("expected well-formed XML"), std::string::npos);
  EXPECT_EQ(xmlError(std::string("<a>\0</a>", 8)), "m.xml:1:4: found a zero byte, expected XML text");
  EXPECT_TRUE(xmlError("\x7f"
                       "ELF\x02\x01\x01")
                  .starts_with("m.xml:1:"));
  EXPECT_EQ(xmlError("<a/>\n<b/>"), "m.xml:2:2: found a second element <b>, expected the end of the file");
  EXPECT_EQ(xmlError("<a b='1' b='2'/>"),
            "m.xml:1:10: found the attribute b again, expected each once; it stands at 1:4 already");
}

TEST(XmlTree, expandsNoEntities) {
  std::string bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE l [\n <!ENTITY a0 \"lol\">\n";
  for (int i = 1; i < 10; ++i) {
    const std::string last = "&a" + std::to_string(i - 1) + ";";
    bomb += " <!ENTITY a" + std::to_string(i) + " \"" + last + last + last + last + last + last + last +
            last + last + last + "\">\n";
  }
  EXPECT_EQ(xmlError(bomb + "]>\n<mujoco>&a9;</mujoco>"),
            "m.xml:2:1: found a document type, expected none: no entity is expanded");
}

TEST(XmlTree, deepAndLongFilesEndInAMessage) {
  const auto nested = [](int depth) {
    std::string text;
    for (int i = 0; i < depth; ++i) {
      text += "<a>";
    }
    for (int i = 0; i < depth; ++i) {
      text += "</a>";
    }
    return text;
  };
  EXPECT_EQ(xmlError(nested(kDeepestXml)), "no error");
  EXPECT_EQ(xmlError(nested(kDeepestXml + 1)),
            "m.xml:1:194: found elements nested deeper than 64, expected a flatter file");
  EXPECT_NE(xmlError(nested(1'000'000)).find("nested deeper than 64"), std::string::npos);
  EXPECT_EQ(xmlError(std::string(100'000'000, '<')),
            "m.xml: found 100000000 bytes of XML, expected at most 67108864");
}

}  // namespace
}  // namespace careen
