// Files that no person writes: each must give a diagnostic, quickly and without a crash.
#include <gtest/gtest.h>

#include <random>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

/// The messages for `text` as a TOML and as a URDF file; both must be refused.
std::string refused(const std::string& text) {
  std::string messages;
  for (const char* path : {"f.toml", "f.urdf"}) {
    support::Diagnostics diagnostics(path, text);
    EXPECT_FALSE(read_mechanism(diagnostics).has_value()) << path;
    EXPECT_TRUE(diagnostics.has_errors()) << path;
    messages += diagnostics.format();
  }
  EXPECT_LT(messages.size(), 100'000u);
  return messages;
}

std::string repeated(const std::string& part, std::size_t size) {
  std::string text;
  while (text.size() < size) text += part;
  return text;
}

TEST(HostileInput, EmptyFile) {
  EXPECT_EQ(refused(""), "f.toml: error: the file is empty\nf.urdf: error: the file is empty\n");
}

TEST(HostileInput, TenMegabytesOfBrackets) {
  for (const char* part : {"[", "{", "<a>", "a.", "(", "\"", "'", "\n", "#", "<", "&", "="})
    refused(repeated(part, 10'000'000) + "x");
}

TEST(HostileInput, LessThanTheLargestFileOfBrackets) {
  for (const char* part :
       {"[",           "a=[",     "{a=",   "<a>", "<a b='", "</a>",       "<!--",     "a.",   "a=1\n",
        "[a.a]\n",     "\"",      "'''",   "\n",  "<",      "&lt;",       "=",        "a=\"", "[[body]]\n",
        "[[joint]]\n", "<robot>", "[a]\n", "]]>", "#\n",    "[[loop]]\n", "[loops]\n"})
    refused(repeated(part, 3'900'000) + "x");
}

TEST(HostileInput, DeepNestingIsNamed) {
  const std::string messages = refused("a = " + std::string(1000, '['));
  EXPECT_NE(messages.find("f.toml:1:37: error: nested deeper than 32 levels"), std::string::npos);
  EXPECT_NE(refused(repeated("a.", 1000) + "b = 1").find("nested deeper"), std::string::npos);
  EXPECT_NE(refused(repeated("<a>", 1000)).find("f.urdf:1:97: error: nested deeper than 32"),
            std::string::npos);
}

TEST(HostileInput, BinaryGarbage) {
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    std::string text(10'000, '\0');
    for (char& c : text) c = static_cast<char>(random());
    EXPECT_NE(refused(text).find("the file is not"), std::string::npos);
  }
}

TEST(HostileInput, ZeroBytes) {
  const std::string messages = refused(std::string("[model]\nname\0= 3", 16));
  EXPECT_NE(
      messages.find("f.toml:2:5: error: the file is not text: control character 0x00\n    2 | name?= 3\n"),
      std::string::npos);
}

TEST(HostileInput, Utf16) { refused(std::string("\xff\xfe[\0m\0]\0", 8)); }

TEST(HostileInput, ExpressionOfAMegabyte) {
  const std::string head = "[model]\nname = \"m\"\n[[body]]\nname = \"b\"\nmass = \"";
  const std::string tail =
      "\"\n[[joint]]\nname = \"j\"\ntype = \"revolute\"\nparent = \"world\"\nchild = \"b\"\n";
  for (const char* part : {"1+", "(", "-", "sin(", "2^", "x"})
    EXPECT_NE(refused(head + repeated(part, 1'000'000) + tail).find("longer than 2000 characters"),
              std::string::npos);
}

TEST(HostileInput, NameOfAMegabyte) {
  const std::string name(1'000'000, 'n');
  refused("[model]\nname = \"m\"\n" + name + " = 3\n[[body]]\nname = \"" + name + "\"\nmass = \"" +
          std::string(1'900, 'x') + "\"\n");
  refused("<robot name=\"" + name + "\"><link name=\"" + name + "\"/></robot>");
}

TEST(HostileInput, ManyLinksInOneLine) {
  std::string text = "<robot name=\"r\">";
  for (int i = 0; i < 1000; ++i) text += "<link name=\"l" + std::to_string(i) + "\"/>";
  for (int i = 0; i < 1000; ++i)
    text += "<joint name=\"j" + std::to_string(i) +
            "\" type=\"revolute\"><parent link=\"x\"/><child link=\"y\"/></joint>";
  refused(text + "</robot>");
  for (int i = 0; i < 100'000; ++i) text += "<link/>";
  EXPECT_NE(refused(text + "</robot>").find("more than 1000"), std::string::npos);
}

TEST(HostileInput, LongChainOfBodies) {
  std::string text = "[model]\nname = \"chain\"\n";
  for (int i = 0; i < 1000; ++i) {
    const std::string n = std::to_string(i);
    const std::string parent = i == 0 ? "world" : "b" + std::to_string(i - 1);
    text += "[[body]]\nname = \"b" + n + "\"\nmass = 1\n[[joint]]\nname = \"j" + n +
            "\"\ntype = \"revolute\"\nparent = \"" + parent + "\"\nchild = \"b" + n + "\"\n";
  }
  support::Diagnostics diagnostics("chain.toml", text);
  const auto mechanism = read_mechanism(diagnostics);
  ASSERT_TRUE(mechanism.has_value()) << diagnostics.format();
  EXPECT_EQ(moving_joints(*mechanism).size(), 1000u);
}

/// Every prefix of a valid file, and every file with one byte changed, is read or refused, never more.
TEST(HostileInput, DamagedFiles) {
  const std::string toml =
      "[model]\nname=\"m\"\n[parameters]\na={value=1}\n[[body]]\nname=\"b\"\nmass=\"a*2\"\n"
      "shape={kind=\"box\",size=[1,2,3]}\n[[joint]]\nname=\"j\"\ntype=\"prismatic\"\n"
      "parent=\"world\"\nchild=\"b\"\naxis=[0,1,0]\nrange=[-1,1]\n[[actuator]]\njoint=\"j\"\n"
      "[[loop]]\nname=\"k\"\ntype=\"rod\"\nfrom=\"b\"\nto=\"world\"\nlength=\"1+t\"\n"
      "[[loop]]\ntype=\"point_on_line\"\nfrom=\"world\"\nto=\"b\"\naxis=[0,1,0]\n"
      "[[loop]]\ntype=\"residual\"\nresidual=\"j-b.y\"\n"
      "[loops]\ntreatment=\"partitioned\"\nindependent=[\"j\"]\niterations=2\n";
  const std::string urdf =
      "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"><inertial><origin xyz=\"0 0 1\"/>"
      "<mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>"
      "</inertial></link><joint name=\"j\" type=\"revolute\"><parent link=\"a\"/>"
      "<child link=\"b\"/></joint></robot>";
  const std::string bytes = std::string(
      "\0\"'[]{}<>=.#/&\n\\\xff"
      "9-e",
      20);
  for (const auto& [path, text] : {std::pair("f.toml", toml), std::pair("f.urdf", urdf)}) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      for (std::size_t b = 0; b <= bytes.size(); ++b) {
        std::string damaged = text;
        if (b == bytes.size())
          damaged.resize(i);
        else
          damaged[i] = bytes[b];
        support::Diagnostics diagnostics(path, damaged);
        const bool read = read_mechanism(diagnostics).has_value();
        EXPECT_NE(read, diagnostics.has_errors());
        EXPECT_EQ(diagnostics.format().empty(), diagnostics.all().empty());
      }
    }
  }
}

}  // namespace
}  // namespace jourdain::model
