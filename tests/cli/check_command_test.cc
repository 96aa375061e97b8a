// ambrig check: expectations met and not met on the screen, in JSON, JUnit and the page.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "tests/app/html_page.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class CheckCommand : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
    Write("calm.toml", ScenarioText("[expect]\ntouchdown = false\n"));
  }
  Json JsonFile(const std::string& name) const { return Json::parse(ReadText(folder_ / name)); }
};

TEST_F(CheckCommand, ExpectationsThatAreMetEndWithZero) {
  const Outcome o = Ambrig("check calm.toml --json out.json --html out.html --junit out.xml");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("1 scenario, 1 met, 0 not met"));
  const Json j = JsonFile("out.json");
  ASSERT_EQ(j.size(), 1u);
  EXPECT_EQ(j[0]["expect"]["touchdown"]["met"], true);
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_file((folder_ / "out.xml").c_str()));
  EXPECT_STREQ(xml.child("testsuite").attribute("failures").value(), "0");
  EXPECT_THAT(testing::Words(ReadText(folder_ / "out.html")), HasSubstr("\nmet\n"));
}

TEST_F(CheckCommand, WhatIsNotMetIsNamedWithWantedAndGot) {
  Write("fall.toml", Replaced(ScenarioText("[expect]\ntouchdown = true\ndrop = false\n"),
                              "name = \"t\"", "name = \"falls & <stays>\""));
  const Outcome o =
      Ambrig("check calm.toml fall.toml --json out.json --html out.html --junit out.xml --jobs 1");
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("NOT MET"));
  EXPECT_THAT(o.text, HasSubstr("touchdown: wanted true, got false"));
  EXPECT_THAT(o.text, HasSubstr("2 scenarios, 1 met, 1 not met"));
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_file((folder_ / "out.xml").c_str()));
  const pugi::xml_node suite = xml.child("testsuite");
  EXPECT_STREQ(suite.attribute("tests").value(), "2");
  EXPECT_STREQ(suite.attribute("failures").value(), "1");
  EXPECT_STREQ(suite.attribute("errors").value(), "0");
  const pugi::xml_node failed =
      suite.find_child_by_attribute("testcase", "name", "falls & <stays>");
  EXPECT_STREQ(failed.child("failure").attribute("message").value(),
               "touchdown: wanted true, got false");
  const std::string html = ReadText(folder_ / "out.html");
  EXPECT_THAT(html, HasSubstr("falls &amp; &lt;stays&gt;"));
  EXPECT_THAT(testing::Words(html), HasSubstr("\nnot met\ntouchdown: wanted true, got false\n"));
  EXPECT_EQ(JsonFile("out.json")[1]["expect"]["drop"]["met"], true);
}

// A scenario that cannot be read does not end the others; it is an error, not a failure.
TEST_F(CheckCommand, AScenarioThatCannotBeReadIsAnError) {
  Write("bad.toml", ScenarioText("[expect]\ntouchdown = 7\n"));
  const Outcome o = Ambrig("check bad.toml calm.toml --json out.json --junit out.xml");
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("bad.toml:"));
  EXPECT_THAT(o.text, HasSubstr("1 met, 1 not met"));
  const Json j = JsonFile("out.json");
  EXPECT_THAT(j[0]["error"].get<std::string>(), HasSubstr("expect.touchdown"));
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_file((folder_ / "out.xml").c_str()));
  EXPECT_STREQ(xml.child("testsuite").attribute("errors").value(), "1");
}

// Of a folder only scenarios with [expect] are run.
TEST_F(CheckCommand, AFolderMeansItsScenariosWithExpectations) {
  Write("plain.toml", ScenarioText(""));
  const Outcome o = Ambrig("check .");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_THAT(o.text, HasSubstr("1 scenario, 1 met"));
}

// Nor does a file of a folder that is not even TOML.
TEST_F(CheckCommand, AFileOfAFolderThatCannotBeReadIsAnError) {
  Write("broken.toml", "name = \n");
  const Outcome o = Ambrig("check . --junit out.xml");
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("broken.toml:1"));
  EXPECT_THAT(o.text, HasSubstr("2 scenarios, 1 met, 1 not met"));
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_file((folder_ / "out.xml").c_str()));
  EXPECT_STREQ(xml.child("testsuite").attribute("errors").value(), "1");
}

TEST_F(CheckCommand, AnEmptyTableOfExpectationsIsToldAsSuch) {
  Write("empty.toml", ScenarioText("[expect]\n"));
  const Outcome o = Ambrig("check empty.toml");
  EXPECT_EQ(o.exit, 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("nothing stands in its [expect]"));
}

TEST_F(CheckCommand, AcceptingNeedsAFolderOfBaselines) {
  const Outcome o = Ambrig("check calm.toml --accept");
  EXPECT_EQ(o.exit, 2);
  EXPECT_EQ(o.lines(), 1) << o.text;
  EXPECT_THAT(o.text, HasSubstr("--baseline"));
}

}  // namespace
}  // namespace ambrig
