#include "services/dds/src/domain/cyclone_uri.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::dds {
namespace {

TEST(UriXml, IsWhatFilesHoldAndXmlItself) {
  const test::TempDir folder;
  std::ofstream(folder.path() / "a.xml") << "<a/>";
  std::ofstream(folder.path() / "b.xml") << "<b/>";
  const std::string a = (folder.path() / "a.xml").string();
  const std::string b = (folder.path() / "b.xml").string();
  EXPECT_EQ(UriXml("file://" + a + "," + b), "<a/><b/>");
  EXPECT_EQ(UriXml(a + ",<c x=\"1,2\"/>"), "<a/><c x=\"1,2\"/>");
  EXPECT_EQ(UriXml("file:///nowhere.xml"), "");
  EXPECT_EQ(UriXml(""), "");
}

TEST(ChoosesInterface, OfTheNameOrAnyOrByAddress) {
  const std::string named =
      "<General><Interfaces><NetworkInterface priority='1' name='lo'/></Interfaces></General>";
  EXPECT_TRUE(ChoosesInterface(named, "lo"));
  EXPECT_FALSE(ChoosesInterface(named, "l"));
  EXPECT_TRUE(ChoosesInterfaces(named));
  EXPECT_TRUE(ChoosesInterfaces("<NetworkInterfaceAddress>wlan0</NetworkInterfaceAddress>"));
  EXPECT_FALSE(ChoosesInterfaces("<General><AllowMulticast>true</AllowMulticast></General>"));
}

}  // namespace
}  // namespace trailcast::dds
